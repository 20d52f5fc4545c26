"""Looking at what speaks: every device that fails has its words and its remedy, and nothing is heard or changed."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from kiosk.config import RobotConfig, VoiceConfig
from kiosk.preflight import CheckResult, Severity
from kiosk.robots import registry as robots_checks
from kiosk.robots import sound_device, voice_program
from kiosk.robots.embodiment import Health
from kiosk.robots.registry import SLOW_MS, pack_check, robot_check, say_check, sound_check, voice_check, within_s
from tests.robots.furhat_fake import FurhatFake, Mode
from tests.robots.realtime_fake import RealtimeFake

LANGUAGES = ("en", "it")


def python(program: str) -> tuple[str, ...]:
    """Return a command that runs this program."""
    return (sys.executable, "-c", program)


def saying(*events: Mapping[str, object], code: int = 0) -> tuple[str, ...]:
    """Return a voice's process that says this and ends."""
    return python(
        f"import sys; sys.stdin.read(); print('''{chr(10).join(map(json.dumps, events))}'''); sys.exit({code})"
    )


def alone(results: object) -> CheckResult:
    """Return the one thing that was found."""
    (found,) = list(results)  # type: ignore[call-overload]
    assert isinstance(found, CheckResult)
    assert found.is_ok == (found.remedy == "")
    return found


# Sound


def test_a_device_that_plays_silence_is_well() -> None:
    found = alone(sound_check(saying({"event": "probed", "device": "Loudspeaker", "why": ""}), busy=False))
    assert found == CheckResult("sound", Severity.OK, "Loudspeaker plays")


@pytest.mark.skipif(not sound_device.HAS_STREAM, reason="miniaudio has no build for this machine")
def test_the_voices_own_process_tries_the_device_of_the_study() -> None:
    settings = VoiceConfig(device=sound_device.NOWHERE)
    assert (
        alone(sound_check(voice_program(settings, "en", probe=True), busy=False)).message
        == f"{sound_device.NOWHERE} plays"
    )


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (saying({"event": "probed", "device": "", "why": "there is no sound device"}), "there is no sound device"),
        (python("import sys; sys.exit(3)"), "the sound's process died"),
        (("/nowhere/python",), "cannot be started"),
    ],
    ids=["no device", "dies", "is missing"],
)
def test_a_sound_device_that_fails_is_told_of_with_a_remedy(command: tuple[str, ...], words: str) -> None:
    found = alone(sound_check(command, busy=False))
    assert found.severity is Severity.WARNING
    assert words in found.message
    assert "loudspeaker" in found.remedy


def test_the_sound_card_of_a_kiosk_at_work_is_left_alone(tmp_path: Path) -> None:
    found = alone(sound_check(python(f"open({str(tmp_path / 'played')!r}, 'w')"), busy=True))
    assert found.severity is Severity.OK
    assert list(tmp_path.iterdir()) == []


def test_a_kiosk_at_work_that_is_not_heard_is_no_reason_to_say_that_all_is_well() -> None:
    told = Health(is_ok=False, message="sentences are only shown: there is no sound device")
    found = alone(sound_check(python(""), busy=True, told=told))
    assert found.severity is Severity.WARNING
    assert "there is no sound device" in found.message
    heard = alone(sound_check(python(""), busy=True, told=Health(is_ok=True, message="the voice en speaks")))
    assert (heard.severity, "the voice en speaks" in heard.message) == (Severity.OK, True)


# Voice


def test_a_voice_that_renders_in_time_is_well() -> None:
    ready, rendered = {"event": "ready", "voice": "gmw/en"}, {"event": "rendered", "took_ms": 20, "duration_ms": 900}
    found = alone(voice_check(saying(ready, rendered), "en", "Hello."))
    assert found == CheckResult("voice: en", Severity.OK, "gmw/en has a sentence ready in 20 ms")


@pytest.mark.parametrize(
    ("events", "words"),
    [
        ([{"event": "unavailable", "why": "no libespeak"}], "no libespeak"),
        ([{"event": "ready", "voice": None}], "no installed voice speaks 'en'"),
        ([{"event": "ready", "voice": "gmw/en"}, {"event": "failed", "why": "no sound came"}], "no sound came"),
        ([{"event": "ready", "voice": "gmw/en"}], "died"),
        ([], "died"),
        ([{"no": "event"}], "died"),
        ([{"event": "ready", "voice": "v"}, {"event": "rendered", "took_ms": SLOW_MS + 1}], str(SLOW_MS + 1)),
    ],
)
def test_a_voice_that_fails_is_told_of_and_keeps_nobody_from_playing(
    events: list[Mapping[str, object]], words: str
) -> None:
    found = alone(voice_check(saying(*events, code=3), "en", "Hello."))
    assert found.severity is Severity.WARNING
    assert words in found.message


def test_a_voice_that_hangs_is_ended_and_what_it_left_goes_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(robots_checks, "WITHIN_S", 1)
    noted = tmp_path / "noted"
    program = f"import tempfile, time; open({str(noted)!r}, 'w').write(tempfile.mkdtemp()); time.sleep(60)"
    found = alone(voice_check(python(program), "en", "Hello."))
    assert (found.severity, "hangs" in found.message) == (Severity.WARNING, True)
    assert not Path(noted.read_text()).exists()


def test_a_voice_that_cannot_be_started_is_told_of() -> None:
    found = alone(voice_check(("/nowhere/python",), "en", "Hello."))
    assert (found.severity, "cannot be started" in found.message) == (Severity.WARNING, True)


def test_the_voices_own_process_renders_and_plays_nothing(tmp_path: Path) -> None:
    """With a fake engine, and a player that would leave a note."""
    engine = (
        "import numpy, pathlib, kiosk.robots.tts_worker as s\n"
        "class E:\n"
        " name, version, licence = 'fake', '1', 'MIT'\n"
        " voice, spoken, voices, rate = 'fake', 'Fake (en)', [], 8000\n"
        " def __init__(self, *a): pass\n"
        " def render(self, text): return s.Clip(numpy.zeros(1600, numpy.int16), 8000)\n"
        "class P:\n"
        " device, why = 'Loudspeaker', ''\n"
        f" def play(self, *a): pathlib.Path({str(tmp_path / 'played')!r}).touch()\n"
        " def stop(self): pass\n"
        " tend = close = stop\n"
        "s.create_engine = lambda *a, **k: E()\n"
        "s.create_player = lambda *a: P()\n"
        "s.run_tts_worker({'language': 'en', 'rate': 150, 'volume': 1.0})\n"
    )
    found = alone(voice_check(python(engine), "en", "Hello."))
    assert found.severity is Severity.OK
    assert found.message.startswith("Fake (en) has a sentence ready in ")
    assert not (tmp_path / "played").exists()


# Robot


def of(fake: FurhatFake | RealtimeFake, kind: str = "furhat", **more: object) -> RobotConfig:
    """Return the settings for a robot on the loopback that has half a second for everything."""
    quick = dict.fromkeys(("connect_deadline_ms", "answer_deadline_ms"), 500)
    return RobotConfig.model_validate({"kind": kind, "host": "127.0.0.1", "port": fake.port} | quick | more)


def test_a_study_without_a_robot_lacks_none() -> None:
    assert alone(robot_check(RobotConfig(), LANGUAGES, busy=False)).severity is Severity.OK


def test_a_robot_that_is_well_has_a_voice_for_every_language_and_keeps_the_one_it_has() -> None:
    with FurhatFake() as fake:
        found = list(robot_check(of(fake), LANGUAGES, busy=True))
        assert [each.message for each in found[1:]] == ["Matthew (en-US)", "Bianca (it-IT)"]
        assert {each.severity for each in found} == {Severity.OK}
        assert (fake.voice, fake.sentences, fake.refusals) == (None, [], [])


def test_a_robot_without_a_language_is_told_of_that_one_alone() -> None:
    with FurhatFake() as fake:
        found = list(robot_check(of(fake), ("en", "de"), busy=False))
    assert [(each.name, each.severity) for each in found[1:]] == [
        ("robot: en", Severity.OK),
        ("robot: de", Severity.WARNING),
    ]


@pytest.mark.parametrize("mode", [Mode.HANG, Mode.TRICKLE, Mode.SERVER_ERROR, Mode.GARBAGE, Mode.REFUSE, Mode.DROP])
def test_a_robot_that_fails_leaves_the_session_to_the_avatar(mode: Mode) -> None:
    with FurhatFake() as fake:
        fake.mode = mode
        found = alone(robot_check(of(fake), LANGUAGES, busy=False))
    assert (found.severity, "avatar" in found.remedy) == (Severity.WARNING, True)


def test_a_robot_of_the_other_interface_is_asked_and_let_go() -> None:
    with RealtimeFake() as fake:
        assert alone(robot_check(of(fake, "furhat-realtime"), LANGUAGES, busy=False)).severity is Severity.OK


def test_a_robot_that_would_have_to_be_changed_is_left_to_the_kiosk_that_has_it() -> None:
    with RealtimeFake() as fake:
        pass
    found = alone(robot_check(of(fake, "furhat-realtime"), LANGUAGES, busy=True))
    assert (found.severity, "panel" in found.message) == (Severity.OK, True)


def test_a_robot_has_as_long_as_its_own_deadlines_and_less_than_twenty_seconds() -> None:
    assert within_s(RobotConfig()) <= 15
    assert within_s(RobotConfig(answer_deadline_ms=3000)) > within_s(RobotConfig())


def test_a_test_sentence_is_told_with_who_said_it_and_where_or_why_nothing_was_heard() -> None:
    by = {"engine": "pico", "voice": "en-US", "device": "Loudspeaker"}
    started = {"event": "started", "id": 1, "duration_ms": 2300, "by": by}
    well = say_check(saying(started, {"event": "finished", "id": 1}), "en", "Hello")
    assert well.is_ok
    assert well.message == "en-US of pico said a sentence of 2.3 s on Loudspeaker"
    ill = say_check(saying(started, {"event": "failed", "id": 1, "why": "the sound device is gone"}), "en", "Hello")
    assert not ill.is_ok
    assert ill.message == "nothing was heard: the sound device is gone"
    assert say_check(python("pass"), "en", "Hello").message == "nothing was heard: the voice's process died"


def test_a_language_without_a_pack_for_the_robot_is_told_of_with_a_remedy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("platformdirs.user_cache_dir", lambda *_, **__: str(tmp_path))
    settings = VoiceConfig(speakers={"it": str(tmp_path / "nowhere")})
    english, italian = pack_check(settings, LANGUAGES)
    assert (english.severity, italian.severity) == (Severity.WARNING, Severity.ERROR)
    assert english.remedy == "'recollect voice render --language en' makes it"
    assert "there is no voice pack in" in italian.message
