"""The voice's process: what it measures, what it reports, and what it does without a sound card or an engine."""

from __future__ import annotations

import json
import subprocess
import sys
import wave
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from kiosk.robots import LOUDNESS_MS
from kiosk.robots.tts_worker import AudioPlayer, RenderedSpeech, described, voice_of

RATE = 8000


def wav(file: Path, samples: np.ndarray[Any, np.dtype[np.float64]]) -> Path:
    """A mono file of 16 bit with these samples, from -1 to 1."""
    with wave.open(str(file), "wb") as audio:
        audio.setnchannels(1)
        audio.setsampwidth(2)
        audio.setframerate(RATE)
        audio.writeframes((samples * (2**15 - 1)).astype("<i2").tobytes())
    return file


def test_a_sound_tells_its_length_and_is_louder_where_it_is_louder(tmp_path: Path) -> None:
    silence, tone = np.zeros(RATE // 2), 0.2 * np.sin(np.arange(RATE // 2))
    sound = RenderedSpeech.of(wav(tmp_path / "a.wav", np.concatenate([silence, tone])))
    assert sound.duration_ms == 1000
    assert len(sound.loudness) == 1000 // LOUDNESS_MS
    assert set(sound.loudness[:12]) == {0.0}
    assert min(sound.loudness[13:]) > 0.4


def test_loudness_never_leaves_its_range(tmp_path: Path) -> None:
    sound = RenderedSpeech.of(wav(tmp_path / "a.wav", np.ones(RATE)))
    assert set(sound.loudness) == {1.0}


def test_what_is_no_sound_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "a.wav"
    file.write_bytes(b"RIFF")
    with pytest.raises((wave.Error, EOFError)):
        RenderedSpeech.of(file)


def test_a_player_without_a_program_keeps_the_time_in_silence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    player = AudioPlayer()
    assert not player.audible
    player.play(RenderedSpeech(tmp_path / "a.wav", 60_000, ()))
    assert player.playing()
    player.stop()
    assert not player.playing()


@pytest.mark.skipif(sys.platform == "win32", reason="a program that fails is a shell script here")
def test_a_player_whose_program_fails_keeps_the_time_in_silence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "aplay"
    program.write_text("#!/bin/sh\nexit 1\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    player = AudioPlayer()
    player.play(RenderedSpeech(tmp_path / "a.wav", 60_000, ()))
    while player.audible:
        assert player.playing()
    assert player.playing()
    player.stop()


class Process:
    """The voice's process, spoken to as the interface does."""

    def __init__(self, child: subprocess.Popen[str]) -> None:
        self.child = child

    def send(self, command: dict[str, object]) -> None:
        """Send one command."""
        assert self.child.stdin is not None
        self.child.stdin.write(json.dumps(command) + "\n")
        self.child.stdin.flush()

    def hear(self) -> dict[str, Any]:
        """The next event."""
        assert self.child.stdout is not None
        event: dict[str, Any] = json.loads(self.child.stdout.readline())
        return event


@pytest.fixture
def process() -> Iterator[Process]:
    """The real thing, with whatever engine this machine has."""
    command = [sys.executable, "-m", "kiosk.robots.tts_worker", "en", "300", "0.5"]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    with subprocess.Popen(command, text=True, **pipes) as child:  # type: ignore[call-overload]
        yield Process(child)
        assert child.stdin is not None
        child.stdin.close()
        assert child.wait(timeout=10) == 0


def test_a_sentence_is_started_with_its_length_and_finished(process: Process) -> None:
    ready = process.hear()
    if ready["event"] == "unavailable":
        pytest.skip(ready["why"])
    process.send({"say": 5, "text": "Hi."})
    started, finished = process.hear(), process.hear()
    assert (started["event"], started["id"]) == ("started", 5)
    assert abs(len(started["loudness"]) * LOUDNESS_MS - started["duration_ms"]) <= LOUDNESS_MS
    assert max(started["loudness"]) > 0
    assert (finished["event"], finished["id"]) == ("finished", 5)


def test_a_sentence_that_is_stopped_is_not_reported_and_the_next_one_is(process: Process) -> None:
    if process.hear()["event"] == "unavailable":
        pytest.skip("there is no speech engine")
    process.send({"say": 1, "text": "This sentence is stopped long before it comes to its end."})
    assert process.hear()["id"] == 1
    process.send({"stop": True})
    process.send({"say": 2, "text": "Hi."})
    assert [process.hear()["id"], process.hear()["event"]] == [2, "finished"]


def test_the_installed_voices_are_told_while_a_sentence_goes_on(process: Process) -> None:
    if process.hear()["event"] == "unavailable":
        pytest.skip("there is no speech engine")
    process.send({"say": 1, "text": "Hi."})
    process.send({"voices": True})
    started, told, finished = process.hear(), process.hear(), process.hear()
    assert [started["event"], told["event"], finished["event"]] == ["started", "voices", "finished"]
    assert any(code.startswith("en") for voice in told["voices"] for code in voice["languages"])


def test_a_voice_that_is_told_to_quit_ends(process: Process) -> None:
    process.hear()
    process.send({"quit": True})
    assert process.child.wait(timeout=10) == 0


class Installed(NamedTuple):
    """A voice as the engine tells it."""

    id: str
    name: str
    languages: list[bytes]


VOICES = [
    Installed(f"x/{code}", code.upper(), [b"\x05" + code.encode()])
    for code in ("nog", "nb", "haw", "smj", "pt", "pt-br", "cmn", "yue", "en-gb-x-rp", "en-gb", "en-us", "he", "fil")
]


@pytest.mark.parametrize(
    ("language", "code"),
    [
        *[("no", "nb"), ("ha", None), ("sm", None), ("pt-BR", "pt-br"), ("pt_br", "pt-br"), ("pt", "pt")],
        ("zh", "cmn"),
        *[("en", "en-gb"), ("en-US", "en-us"), ("iw", "he"), ("tl", "fil"), ("pt-AO", "pt"), ("de", None)],
    ],
)
def test_a_language_is_spoken_by_a_voice_of_the_same_language_or_by_none(language: str, code: str | None) -> None:
    chosen = voice_of(language, VOICES)
    assert chosen == next((voice for voice in VOICES if voice.name == str(code).upper()), None)


def test_a_voice_is_named_with_what_it_speaks() -> None:
    assert described(Installed("gmq/nb", "Norwegian Bokmål", [b"\x05nb"])) == "Norwegian Bokmål (nb)"
