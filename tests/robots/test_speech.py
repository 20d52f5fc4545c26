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

from kiosk.config import VoiceConfig
from kiosk.robots import LOUDNESS_MS, voice_options
from kiosk.robots.clips import Clip, loudness_steps
from kiosk.robots.sound_device import NOWHERE
from kiosk.robots.tts_engines import described, voice_of
from tests.patience import Program, started

RATE = 8000
FAST = VoiceConfig(rate=300, device=NOWHERE)


def wav(file: Path, samples: np.ndarray[Any, np.dtype[np.float64]]) -> Path:
    """Return a mono file of 16 bit with these samples, from -1 to 1."""
    Clip.of(samples, RATE).write(file)
    return file


def test_a_sound_tells_its_length_and_is_louder_where_it_is_louder(tmp_path: Path) -> None:
    silence, tone = np.zeros(RATE // 2), 0.2 * np.sin(np.arange(RATE // 2))
    sound = Clip.read(wav(tmp_path / "a.wav", np.concatenate([silence, tone])))
    loudness = loudness_steps(sound)
    assert sound.duration_ms == 1000
    assert len(loudness) == 1000 // LOUDNESS_MS
    assert set(loudness[:12]) == {0.0}
    assert min(loudness[13:]) > 0.4


def test_loudness_never_leaves_its_range() -> None:
    assert set(loudness_steps(Clip.of(np.ones(RATE), RATE))) == {1.0}


def test_what_is_no_sound_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "a.wav"
    file.write_bytes(b"RIFF")
    with pytest.raises((wave.Error, EOFError)):
        Clip.read(file)


@pytest.mark.parametrize("width", [1, 2, 3, 4])
@pytest.mark.parametrize("channels", [1, 2])
def test_sounds_of_any_width_and_number_of_channels_become_the_same(tmp_path: Path, width: int, channels: int) -> None:
    levels = [0.0, 0.5, -0.5, 0.25]
    whole = b"".join(
        (round(level * 2 ** (8 * width - 1)) + (128 if width == 1 else 0)).to_bytes(width, "little", signed=width > 1)
        for level in levels
        for _ in range(channels)
    )
    with wave.open(str(tmp_path / "a.wav"), "wb") as audio:
        audio.setnchannels(channels)
        audio.setsampwidth(width)
        audio.setframerate(RATE)
        audio.writeframes(whole)
    assert Clip.read(tmp_path / "a.wav").values.tolist() == pytest.approx(levels, abs=0.01)


class Process:
    """The voice's process, spoken to as the interface does."""

    def __init__(self, child: Program) -> None:
        self.child = child

    def send(self, command: dict[str, object]) -> None:
        """Send one command."""
        self.child.stdin.write(json.dumps(command) + "\n")
        self.child.stdin.flush()

    def hear(self) -> dict[str, Any]:
        """Return the next event."""
        event: dict[str, Any] = json.loads(self.child.stdout.readline())
        return event


@pytest.fixture
def process() -> Iterator[Process]:
    """Provide the real thing, with whatever engine this machine has."""
    command = [sys.executable, "-m", "kiosk.robots.tts_worker", voice_options(FAST, "en")]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    with started(command, text=True, **pipes) as child:
        yield Process(child)
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
    process.send({"say": 1, "text": "This sentence is long enough for a question."})
    started = process.hear()
    process.send({"voices": True})
    told, finished = process.hear(), process.hear()
    assert [started["event"], told["event"], finished["event"]] == ["started", "voices", "finished"]
    assert any(code.startswith("en") for voice in told["voices"] for code in voice["languages"])


def test_a_voice_that_is_told_to_quit_ends(process: Process) -> None:
    process.hear()
    process.send({"quit": True})
    assert process.child.wait(timeout=10) == 0


def test_a_voice_that_is_told_to_finish_ends_once_its_sentence_is_over(process: Process) -> None:
    if process.hear()["event"] == "unavailable":
        pytest.skip("there is no speech engine")
    process.send({"say": 1, "text": "Hi."})
    process.send({"finish": True})
    assert [process.hear()["event"], process.hear()["event"]] == ["started", "finished"]
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
