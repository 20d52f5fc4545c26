"""Looking at what speaks: every device that fails has its words and its remedy, and nothing is heard or changed."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from kiosk.config import RobotConfig
from kiosk.preflight import CheckResult, Severity
from kiosk.robots import checks as robots_checks
from kiosk.robots.checks import SLOW_MS, robot_check, sound_check, voice_check, within_s
from tests.robots.furhat_fake import FurhatFake, Mode
from tests.robots.realtime_fake import RealtimeFake

LANGUAGES = ("en", "it")


def python(program: str) -> tuple[str, ...]:
    """A command that runs this program."""
    return (sys.executable, "-c", program)


def saying(*events: Mapping[str, object], code: int = 0) -> tuple[str, ...]:
    """A voice's process that says this and ends."""
    return python(
        f"import sys; sys.stdin.read(); print('''{chr(10).join(map(json.dumps, events))}'''); sys.exit({code})"
    )


def alone(findings: object) -> CheckResult:
    """The one thing that was found."""
    (found,) = list(findings)  # type: ignore[call-overload]
    assert isinstance(found, CheckResult)
    assert found.well == (found.remedy == "")
    return found


# Sound


def test_a_player_that_plays_silence_is_well(tmp_path: Path) -> None:
    heard = tmp_path / "heard.wav"
    found = alone(sound_check(python(f"import sys, shutil; shutil.copy(sys.argv[1], {str(heard)!r})"), busy=False))
    assert found.state is Severity.GOOD
    assert set(heard.read_bytes()[44:]) == {0}


def test_a_machine_without_a_player_is_told_to_get_one() -> None:
    found = alone(sound_check(None, busy=False))
    assert (found.state, "alsa-utils" in found.remedy) == (Severity.WARNING, True)


def test_without_a_sound_card_the_players_own_words_are_told() -> None:
    found = alone(sound_check(python("import sys; sys.exit('aplay: no such card')"), busy=False))
    assert found.state is Severity.WARNING
    assert "aplay: no such card" in found.words


def test_a_player_that_is_gone_is_told_of() -> None:
    found = alone(sound_check(("/nowhere/aplay",), busy=False))
    assert (found.state, "/nowhere/aplay" in found.words) == (Severity.WARNING, True)


def test_the_sound_card_of_a_kiosk_at_work_is_left_alone(tmp_path: Path) -> None:
    found = alone(sound_check(python(f"open({str(tmp_path / 'played')!r}, 'w')"), busy=True))
    assert found.state is Severity.GOOD
    assert list(tmp_path.iterdir()) == []


# Voice


def test_a_voice_that_renders_in_time_is_well() -> None:
    ready, rendered = {"event": "ready", "voice": "gmw/en"}, {"event": "rendered", "took_ms": 20, "duration_ms": 900}
    found = alone(voice_check(saying(ready, rendered), "en", "Hello."))
    assert found == CheckResult("voice: en", Severity.GOOD, "gmw/en has a sentence ready in 20 ms")


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
    assert found.state is Severity.WARNING
    assert words in found.words


def test_a_voice_that_hangs_is_ended_and_what_it_left_goes_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(robots_checks, "WITHIN_S", 1)
    noted = tmp_path / "noted"
    program = f"import tempfile, time; open({str(noted)!r}, 'w').write(tempfile.mkdtemp()); time.sleep(60)"
    found = alone(voice_check(python(program), "en", "Hello."))
    assert (found.state, "hangs" in found.words) == (Severity.WARNING, True)
    assert not Path(noted.read_text()).exists()


def test_a_voice_that_cannot_be_started_is_told_of() -> None:
    found = alone(voice_check(("/nowhere/python",), "en", "Hello."))
    assert (found.state, "cannot be started" in found.words) == (Severity.WARNING, True)


def test_the_voices_own_process_renders_and_plays_nothing(tmp_path: Path) -> None:
    """With a fake engine: it writes a file of the sentence's length, and a player would be noted."""
    player = tmp_path / "aplay"
    player.write_text(f"#!/bin/sh\ntouch {tmp_path}/played\n")
    player.chmod(0o700)
    engine = (
        "import wave, kiosk.robots.tts_worker as s\n"
        "class E:\n"
        " voice, spoken, voices = 'fake', 'Fake (en)', []\n"
        " def __init__(self, *a): pass\n"
        " def render(self, text, file):\n"
        "  w = wave.open(str(file), 'wb'); w.setnchannels(1); w.setsampwidth(2); w.setframerate(8000)\n"
        "  w.writeframes(bytes(1600)); w.close(); return s.RenderedSpeech.of(file)\n"
        "s.SpeechEngine = E\n"
        "s.run_tts_worker('en', 150, 1.0)\n"
    )
    command = ("env", f"PATH={tmp_path}:{os.environ['PATH']}", *python(engine))
    found = alone(voice_check(command, "en", "Hello."))
    assert found.state is Severity.GOOD
    assert found.words.startswith("Fake (en) has a sentence ready in ")
    assert not (tmp_path / "played").exists()


# Robot


def of(fake: FurhatFake | RealtimeFake, kind: str = "furhat", **more: object) -> RobotConfig:
    """The settings for a robot on the loopback that has half a second for everything."""
    quick = dict.fromkeys(("connect_deadline", "answer_deadline"), 500)
    return RobotConfig.model_validate({"kind": kind, "host": "127.0.0.1", "port": fake.port} | quick | more)


def test_a_study_without_a_robot_lacks_none() -> None:
    assert alone(robot_check(RobotConfig(), LANGUAGES, busy=False)).state is Severity.GOOD


def test_a_robot_that_is_well_has_a_voice_for_every_language_and_keeps_the_one_it_has() -> None:
    with FurhatFake() as fake:
        found = list(robot_check(of(fake), LANGUAGES, busy=True))
        assert [each.words for each in found[1:]] == ["Matthew (en-US)", "Bianca (it-IT)"]
        assert {each.state for each in found} == {Severity.GOOD}
        assert (fake.voice, fake.sentences, fake.refusals) == (None, [], [])


def test_a_robot_without_a_language_is_told_of_that_one_alone() -> None:
    with FurhatFake() as fake:
        found = list(robot_check(of(fake), ("en", "de"), busy=False))
    assert [(each.what, each.state) for each in found[1:]] == [
        ("robot: en", Severity.GOOD),
        ("robot: de", Severity.WARNING),
    ]


@pytest.mark.parametrize("mode", [Mode.HANG, Mode.TRICKLE, Mode.SERVER_ERROR, Mode.GARBAGE, Mode.REFUSE, Mode.DROP])
def test_a_robot_that_fails_leaves_the_session_to_the_avatar(mode: Mode) -> None:
    with FurhatFake() as fake:
        fake.mode = mode
        found = alone(robot_check(of(fake), LANGUAGES, busy=False))
    assert (found.state, "avatar" in found.remedy) == (Severity.WARNING, True)


def test_a_robot_of_the_other_interface_is_asked_and_let_go() -> None:
    with RealtimeFake() as fake:
        assert alone(robot_check(of(fake, "furhat-realtime"), LANGUAGES, busy=False)).state is Severity.GOOD


def test_a_robot_that_would_have_to_be_changed_is_left_to_the_kiosk_that_has_it() -> None:
    with RealtimeFake() as fake:
        pass
    found = alone(robot_check(of(fake, "furhat-realtime"), LANGUAGES, busy=True))
    assert (found.state, "panel" in found.words) == (Severity.GOOD, True)


def test_a_robot_has_as_long_as_its_own_deadlines_and_less_than_twenty_seconds() -> None:
    assert within_s(RobotConfig()) <= 15
    assert within_s(RobotConfig(answer_deadline=3000)) > within_s(RobotConfig())
