"""The voice may be missing, hang or die at any moment: every sentence is finished or given up, and no tap is lost."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QProcess
from pytestqt.qtbot import QtBot

from kiosk.config import VoiceConfig as VoiceSettings
from kiosk.experiment.event_records import from_record, to_record
from kiosk.experiment.events import SpeechStarted
from kiosk.ui.voice import EngineVoice, NoVoice

SPEAKS = """
import json, sys
for line in sys.stdin:
    command = json.loads(line)
    if "say" in command:
        n = command["say"]
        print(json.dumps({"event": "started", "id": n, "duration_ms": 10, "loudness": [0.5]}), flush=True)
        print(json.dumps({"event": "finished", "id": n}), flush=True)
"""
READY = """
import json, sys
print(json.dumps({"event": "ready", "voice": "en", "device": "Speaker"}), flush=True)
sys.stdin.read()
"""
SPEAKS_NONSENSE_FIRST = "print('Audio saved!', flush=True); print('[1, 2]', flush=True)" + SPEAKS
HANGS = "import sys\nfor line in sys.stdin: pass"
DIES_WHEN_IT_SHOULD_SPEAK = "import sys\nsys.stdin.readline(); sys.exit(3)"
STARTS_AND_HANGS = """
import json, sys
n = json.loads(sys.stdin.readline())["say"]
print(json.dumps({"event": "started", "id": n, "duration_ms": 10, "loudness": []}), flush=True)
for line in sys.stdin: pass
"""
CANNOT_RENDER = """
import json, sys
for line in sys.stdin:
    command = json.loads(line)
    if "say" in command:
        print(json.dumps({"event": "failed", "id": command["say"], "why": "no sound came of it"}), flush=True)
"""
HAS_NO_ENGINE = """
import json, sys
print(json.dumps({"event": "unavailable", "why": "no speech engine"}), flush=True)
sys.stdin.read()
"""
HANGS_ONCE_THEN_SPEAKS = (
    """
import pathlib, sys
marker = pathlib.Path(sys.argv[1])
if not marker.exists():
    marker.touch()
    sys.stdin.read()
"""
    + SPEAKS
)


@pytest.fixture
def voices() -> Iterator[list[EngineVoice]]:
    """Voices that are ended when the test is."""
    made: list[EngineVoice] = []
    yield made
    for voice in made:
        voice.close()


def engine(voices: list[EngineVoice], program: str, *arguments: str) -> EngineVoice:
    """Return a voice whose engine is a small program, with short deadlines."""
    command = (sys.executable, "-c", program, *arguments)
    voice = EngineVoice(VoiceSettings(), "en", command, start_deadline_ms=1_500, end_grace_ms=200)
    voices.append(voice)
    return voice


@pytest.mark.parametrize("program", [SPEAKS, SPEAKS_NONSENSE_FIRST], ids=["plain", "nonsense first"])
def test_a_sentence_starts_with_its_loudness_and_finishes(
    qtbot: QtBot, voices: list[EngineVoice], program: str, caplog: pytest.LogCaptureFixture
) -> None:
    voice = engine(voices, program)
    reports: list[tuple[object, ...]] = []
    voice.started.connect(lambda *started: reports.append(started))
    voice.finished.connect(lambda *finished: reports.append(finished))
    with qtbot.waitSignal(voice.finished):
        voice.say(7, "Hello")
    assert reports == [(7, [0.5]), (7,)]
    caplog.clear()


@pytest.mark.parametrize(
    ("program", "why"),
    [
        (HANGS, "the voice did not answer in time"),
        (DIES_WHEN_IT_SHOULD_SPEAK, "the voice is gone"),
        (STARTS_AND_HANGS, "the voice did not answer in time"),
        (CANNOT_RENDER, "no sound came of it"),
    ],
    ids=["hangs", "dies", "hangs while speaking", "cannot render"],
)
def test_a_sentence_that_will_not_be_heard_is_given_up_with_a_reason(
    qtbot: QtBot, voices: list[EngineVoice], program: str, why: str, caplog: pytest.LogCaptureFixture
) -> None:
    voice = engine(voices, program)
    with qtbot.waitSignal(voice.failed, timeout=10_000) as failed:
        voice.say(1, "Hello")
    assert failed.args == [1, why]
    caplog.clear()


def test_a_missing_program_gives_every_sentence_up_at_once(
    qtbot: QtBot, voices: list[EngineVoice], caplog: pytest.LogCaptureFixture
) -> None:
    voice = EngineVoice(VoiceSettings(), "en", ("/nowhere/voice",))
    voices.append(voice)
    for number in range(1, 6):
        with qtbot.waitSignal(voice.failed):
            voice.say(number, "Hello")
    caplog.clear()


def test_without_an_engine_nothing_is_tried_again(
    qtbot: QtBot, voices: list[EngineVoice], caplog: pytest.LogCaptureFixture
) -> None:
    voice = engine(voices, HAS_NO_ENGINE)
    with qtbot.waitSignal(voice.failed):
        voice.say(1, "Hello")
    with qtbot.waitSignal(voice.failed) as failed:
        voice.say(2, "Hello")
    assert failed.args == [2, "there is no voice"]
    caplog.clear()


def test_an_engine_that_hung_is_ended_and_another_one_speaks(
    qtbot: QtBot, voices: list[EngineVoice], tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    voice = engine(voices, HANGS_ONCE_THEN_SPEAKS, str(tmp_path / "hung"))
    with qtbot.waitSignal(voice.failed, timeout=10_000):
        voice.say(1, "Hello")
    with qtbot.waitSignal(voice.finished, timeout=10_000) as finished:
        voice.say(2, "Hello again")
    assert finished.args == [2]
    caplog.clear()


def test_a_sentence_that_was_stopped_is_not_reported_any_more(qtbot: QtBot, voices: list[EngineVoice]) -> None:
    voice = engine(voices, SPEAKS)
    reports: list[int] = []
    voice.finished.connect(reports.append)
    voice.say(1, "Hello")
    voice.stop()
    with qtbot.waitSignal(voice.finished):
        voice.say(2, "Hello")
    assert reports == [2]


def test_a_voice_that_is_switched_off_leaves_every_sentence_to_be_read(qtbot: QtBot) -> None:
    voice = NoVoice()
    with qtbot.waitSignal(voice.failed) as failed:
        voice.say(3, "Hello")
    assert failed.args == [3, "the voice is switched off"]


IS_READY_THEN_HANGS_ONCE = """
import json, pathlib, sys
print(json.dumps({"event": "ready", "voice": "en", "device": "null"}), flush=True)
marker = pathlib.Path(sys.argv[1])
if not marker.exists():
    marker.touch()
    for line in sys.stdin: pass
"""


def test_a_hung_engine_is_ended_and_started_again_within_a_second(
    qtbot: QtBot, voices: list[EngineVoice], tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    voice = engine(voices, IS_READY_THEN_HANGS_ONCE + SPEAKS, str(tmp_path / "hung"))
    qtbot.waitUntil(lambda: "speaks" in voice.health.message)
    with qtbot.waitSignal(voice.failed, timeout=1_000):
        voice.say(1, "Hello")
    with qtbot.waitSignal(voice.finished, timeout=10_000):
        voice.say(2, "Hello again")
    caplog.clear()


@pytest.mark.parametrize(
    ("ready", "words"),
    [
        ({"voice": "gmw/en", "device": "Speaker"}, "the voice gmw/en speaks"),
        ({"voice": None, "device": "Speaker"}, "sentences are only shown: no installed voice speaks 'en'"),
        ({"voice": "en", "device": "", "why": "no card"}, "sentences are only shown: no card"),
    ],
)
def test_the_experimenter_is_told_what_the_voice_can_do(
    qtbot: QtBot, voices: list[EngineVoice], ready: dict[str, object], words: str, caplog: pytest.LogCaptureFixture
) -> None:
    line = json.dumps({"event": "ready", **ready})
    voice = engine(voices, f"import sys; print({line!r}, flush=True); sys.stdin.read()")
    qtbot.waitUntil(lambda: voice.health.message == words)
    caplog.clear()


def test_a_missing_engine_is_told_in_words(
    qtbot: QtBot, voices: list[EngineVoice], caplog: pytest.LogCaptureFixture
) -> None:
    voice = engine(voices, HAS_NO_ENGINE)
    qtbot.waitUntil(lambda: voice.health.message == "sentences are only shown: no speech engine")
    assert not voice.health.is_ok
    caplog.clear()


TELLS_ITS_MANNER = """
import json, sys
given = json.loads(sys.argv[-1])
volume = given["volume"]
def tell():
    voice = f"of {given['language']} at {volume}"
    print(json.dumps({"event": "ready", "voice": voice, "device": "Speaker"}), flush=True)
tell()
for line in sys.stdin:
    volume = json.loads(line).get("volume", volume)
    tell()
"""


def test_another_volume_holds_at_once_and_another_language_is_spoken_by_a_new_process(
    qtbot: QtBot, voices: list[EngineVoice]
) -> None:
    voice = engine(voices, TELLS_ITS_MANNER)
    qtbot.waitUntil(lambda: voice.health.message == "the voice of en at 0.9 speaks")
    voice.set_volume(0.4)
    qtbot.waitUntil(lambda: voice.health.message == "the voice of en at 0.4 speaks")
    voice.set_language("it")
    qtbot.waitUntil(lambda: voice.health.message == "the voice of it at 0.4 speaks")


LOSES_ITS_DEVICE = """
import json, sys
print(json.dumps({"event": "ready", "voice": "en", "device": "Speaker"}), flush=True)
n = json.loads(sys.stdin.readline())["say"]
print(json.dumps({"event": "started", "id": n, "duration_ms": 9000, "loudness": []}), flush=True)
print(json.dumps({"event": "failed", "id": n, "why": "the sound device is gone"}), flush=True)
for _ in range(2):
    print(json.dumps({"event": "device", "device": "", "why": "the sound device is gone"}), flush=True)
sys.stdin.readline()
print(json.dumps({"event": "device", "device": "Speaker", "why": ""}), flush=True)
sys.stdin.read()
"""


def test_a_sentence_whose_device_goes_away_fails_and_the_experimenter_is_told_until_it_is_back(
    qtbot: QtBot, voices: list[EngineVoice], caplog: pytest.LogCaptureFixture
) -> None:
    voice = engine(voices, LOSES_ITS_DEVICE)
    told: list[tuple[object, ...]] = []
    voice.health_changed.connect(lambda *change: told.append(change))
    with qtbot.waitSignal(voice.failed) as failed:
        voice.say(1, "Hello")
    assert failed.args == [1, "the sound device is gone"]
    qtbot.waitUntil(lambda: voice.health.message == "sentences are only shown: the sound device is gone")
    voice.set_volume(0.5)
    qtbot.waitUntil(lambda: voice.health.is_ok)
    assert told == [(False, "sentences are only shown: the sound device is gone"), (True, "the voice en speaks")]
    caplog.clear()


def test_at_volume_0_the_panel_does_not_say_that_the_voice_speaks(qtbot: QtBot, voices: list[EngineVoice]) -> None:
    voice = engine(voices, READY)
    qtbot.waitUntil(lambda: voice.health.message == "the voice en speaks")
    voice.set_volume(0)
    assert (voice.health.is_ok, voice.health.message) == (False, "sentences are only shown: the volume is 0")
    voice.set_volume(0.5)
    assert voice.health.is_ok


SPEAKS_LATE = """
import json, sys
late = None
for line in sys.stdin:
    command = json.loads(line)
    if "say" in command:
        if late is not None:
            print(json.dumps({"event": "started", "id": late, "duration_ms": 10, "loudness": [0.1]}), flush=True)
            print(json.dumps({"event": "finished", "id": late}), flush=True)
        late = command["say"]
        print(json.dumps({"event": "started", "id": late, "duration_ms": 10, "loudness": [0.9]}), flush=True)
"""


def test_what_comes_late_of_the_last_session_is_not_taken_for_this_ones_sentence(
    qtbot: QtBot, voices: list[EngineVoice]
) -> None:
    voice = engine(voices, SPEAKS_LATE)
    heard: list[list[float]] = []
    voice.started.connect(lambda _, loudness: heard.append(loudness))
    voice.finished.connect(lambda _: heard.append([]))
    voice.say(1, "Goodbye")
    qtbot.waitUntil(lambda: len(heard) == 1)
    voice.stop()
    with qtbot.waitSignal(voice.started):
        voice.say(1, "Hello")
    assert heard == [[0.9], [0.9]]
    voice.stop()


TELLS_WHAT_SPEAKS = """
import json, sys
n = json.loads(sys.stdin.readline())["say"]
by = {"engine": "pico", "engine_version": "1", "voice": "en-US", "pack": "abc", "device": "Speaker"}
started = {"event": "started", "id": n, "duration_ms": 9000, "loudness": [0.5], "shapes": ["open"], "by": by}
print(json.dumps(started), flush=True)
sys.stdin.read()
"""


def test_it_is_known_what_speaks_a_sentence_and_the_record_can_hold_it(qtbot: QtBot, voices: list[EngineVoice]) -> None:
    voice = engine(voices, TELLS_WHAT_SPEAKS)
    with qtbot.waitSignal(voice.started):
        voice.say(1, "Hello")
    assert voice.shapes == ("open",)
    event = SpeechStarted(at_ms=5, utterance=1, **voice.spoken_by)
    assert (event.engine, event.voice, event.pack, event.volume) == ("pico", "en-US", "abc", 0.9)
    assert from_record(to_record(event)) == event
    voice.stop()


IGNORES_ITS_INPUT = "import signal; signal.pause()"


@pytest.mark.parametrize("closed", [False, True], ids=["in time", "at the end"])
def test_a_process_that_is_let_go_is_not_deleted_while_it_runs(
    qtbot: QtBot, voices: list[EngineVoice], *, closed: bool
) -> None:
    """Qt would warn, which fails a test, and hold up the kiosk until the process has ended."""
    voice = engine(voices, IGNORES_ITS_INPUT)
    [first] = voice.findChildren(QProcess)
    assert first.waitForStarted()
    voice.set_language("it")
    assert len(voice.findChildren(QProcess)) == 2
    if closed:
        voice.close()
        assert first.state() is QProcess.ProcessState.NotRunning
    else:
        qtbot.waitUntil(lambda: len(voice.findChildren(QProcess)) == 1)
