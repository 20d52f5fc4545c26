"""The text-to-speech worker: a process that renders and plays sentences."""

from __future__ import annotations

import json
import os
import queue
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import wave
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyttsx3

from kiosk.language_codes import distance
from kiosk.robots import LOUDNESS_MS

_QUIET = {"aplay": ("-q",), "afplay": ()}
"""The programs that are looked for, in this order, and what keeps them from talking."""


def player_command() -> tuple[str, ...] | None:
    """The command that plays the file that is added to it; None if there is no such program."""
    path = next((path for name in _QUIET if (path := shutil.which(name))), None)
    return (path, *_QUIET[Path(path).name]) if path else None


_POLL_S = 0.01
_RENDER_S = 3.0
"""Rendering takes 10 to 60 ms; an engine that takes this long will never be done."""

_NO_SOUND = (OSError, RuntimeError, EOFError, wave.Error)
"""What rendering raises when no sound came of it."""

_FULL_LOUDNESS = 0.25
"""The root mean square, of full scale, at which the mouth is wide open: loud vowels of espeak-ng reach about this."""


@dataclass(frozen=True)
class RenderedSpeech:
    """A rendered sentence: its file, its length, and how loud it is from step to step."""

    file: Path
    duration_ms: int
    loudness: tuple[float, ...]

    @classmethod
    def of(cls, file: Path) -> RenderedSpeech:
        """Measure a WAV file of 16 bit; raises wave.Error or EOFError if it is none."""
        with wave.open(str(file)) as audio:
            rate, channels = audio.getframerate(), audio.getnchannels()
            samples = np.frombuffer(audio.readframes(audio.getnframes()), dtype="<i2") / 2**15
        step = rate * channels * LOUDNESS_MS // 1000
        padded = np.pad(samples, (0, -len(samples) % step)).reshape(-1, step)
        opening = np.clip(np.sqrt((padded**2).mean(axis=1)) / _FULL_LOUDNESS, 0, 1)
        return cls(file, len(samples) * 1000 // (rate * channels), tuple(round(float(value), 2) for value in opening))


class SpeechEngine:
    """The speech engine: renders a sentence to a file. pyttsx3 plays unreliably, but it renders well."""

    def __init__(self, language: str, rate: int, volume: float) -> None:
        """Take the nearest voice of the language; raises whatever the engine raises when it is missing."""
        self._engine = pyttsx3.init()
        self._done = threading.Event()
        self._engine.connect("finished-utterance", lambda **_: self._done.set())
        self._engine.setProperty("rate", rate)
        self._engine.setProperty("volume", volume)
        found = self._engine.getProperty("voices")
        chosen = voice_of(language, found)
        self.voice = None if chosen is None else str(chosen.id)
        self.spoken = "" if chosen is None else described(chosen)
        self.voices = [{"id": str(voice.id), "name": str(voice.name), "languages": _codes(voice)} for voice in found]
        if self.voice is not None:
            self._engine.setProperty("voice", self.voice)

    def render(self, text: str, file: Path) -> RenderedSpeech:
        """Render a sentence; raises OSError, wave.Error or EOFError if no sound came of it.

        Raises RuntimeError if no voice speaks the language: another one would make nonsense of it.
        """
        if self.voice is None:
            raise RuntimeError("no installed voice speaks the language")
        # runAndWait comes back after 10 ms, done or not; what lies there until then is the sentence before.
        file.unlink(missing_ok=True)
        self._done.clear()
        self._engine.save_to_file(text, str(file))
        self._engine.runAndWait()
        # On Windows it renders at once, and reports nothing.
        if sys.platform != "win32" and not self._done.wait(_RENDER_S):
            raise RuntimeError("the engine did not render the sentence in time")
        return RenderedSpeech.of(file)


def voice_of(language: str, voices: Iterable[Any]) -> Any | None:
    """Choose the engine's voice for a language: the nearest by its code, and of those the plainest."""
    near = [(far, voice) for voice in voices for far in _distances(voice, language)]
    return min(near, key=lambda each: (each[0], len(str(each[1].id)), str(each[1].id)))[1] if near else None


def _distances(voice: Any, language: str) -> Iterator[int]:
    far = (distance(language, code) for code in _codes(voice))
    return (each for each in far if each is not None)


def described(voice: Any) -> str:
    """Name a voice and what it speaks, for people."""
    return f"{voice.name} ({', '.join(_codes(voice))})"


def _codes(voice: Any) -> list[str]:
    """The languages of a voice as codes; espeak gives them as bytes that begin with a priority."""
    codes = (code.decode(errors="ignore") if isinstance(code, bytes) else str(code) for code in voice.languages)
    return [code.strip("\x05\x02") for code in codes]


class AudioPlayer:
    """Plays a file with a child process that can be ended at once; silence, of the same length, without one."""

    def __init__(self) -> None:
        """Look for a program that plays."""
        self._command = player_command()
        self._child: subprocess.Popen[bytes] | None = None
        self._silent_until = 0.0
        self.audible = self._command is not None

    def play(self, sound: RenderedSpeech) -> None:
        """Begin to play."""
        self._silent_until = time.monotonic() + sound.duration_ms / 1000
        if self._command is not None:
            command = (*self._command, str(sound.file))
            self._child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # noqa: S603

    def playing(self) -> bool:
        """Whether the sentence is still under way."""
        if self._child is not None:
            code = self._child.poll()
            if code is None:
                return True
            # A player that fails has no sound card: the rest of the sentence's time passes in silence.
            self.audible = code == 0
            self._child = None
            if code == 0:
                return False
        return not self.audible and time.monotonic() < self._silent_until

    def stop(self) -> None:
        """Be silent at once."""
        if self._child is not None:
            self._child.kill()
            self._child.wait()
            self._child = None
        self._silent_until = 0.0


class TtsWorker:
    """Takes one command after another, and never renders or plays two sentences at once."""

    def __init__(
        self,
        engine: SpeechEngine,
        player: AudioPlayer,
        report: WorkerReport,
        file: Path,
        commands: queue.Queue[dict[str, Any] | None],
    ) -> None:
        """Render into ``file``; ``None`` among the commands ends the work."""
        self._engine = engine
        self._player = player
        self._sounds = AudioPlayer()
        self._report = report
        self._file = file
        self._commands = commands
        self._saying: int | None = None

    def run(self) -> None:
        """Work until the commands end."""
        for command in self._next_commands():
            if "play" in command:
                self._play(Path(command["play"]))
            elif "voices" in command:
                self._report("voices", voices=self._engine.voices)
            elif "render" in command:
                self._render(str(command["render"]))
            else:
                self._stop()
                if "say" in command:
                    self._say(int(command["say"]), str(command["text"]))

    def _stop(self) -> None:
        """Be silent: a sound card may take only one at a time, and a sentence never waits for a sound."""
        self._sounds.stop()
        self._player.stop()
        self._saying = None

    def _play(self, file: Path) -> None:
        """Play a short sound in place of any other, but not while a sentence is under way."""
        if self._saying is None:
            self._sounds.stop()
            self._sounds.play(RenderedSpeech(file, 0, ()))

    def _render(self, text: str) -> None:
        """Render a text that nobody is to hear."""
        begun = time.monotonic()
        try:
            sound = self._engine.render(text, self._file.with_name("unheard.wav"))
        except _NO_SOUND as error:
            self._report("failed", why=str(error) or type(error).__name__)
            return
        took_ms = round((time.monotonic() - begun) * 1000)
        self._report("rendered", duration_ms=sound.duration_ms, took_ms=took_ms)

    def _next_commands(self) -> Iterator[dict[str, Any]]:
        """Every command in turn; while a sentence is under way, look after it as well."""
        while True:
            try:
                busy = self._saying is not None or self._sounds.playing()
                command = self._commands.get(timeout=_POLL_S if busy else None)
            except queue.Empty:
                self._look_after_sentence()
                continue
            if command is None:
                self._stop()
                return
            yield command

    def _look_after_sentence(self) -> None:
        if self._saying is not None and not self._player.playing():
            self._report("finished", id=self._saying, audible=self._player.audible)
            self._saying = None

    def _say(self, number: int, text: str) -> None:
        try:
            sound = self._engine.render(text, self._file)
        except _NO_SOUND as error:
            self._report("failed", id=number, why=str(error) or type(error).__name__)
            return
        self._player.play(sound)
        self._saying = number
        self._report("started", id=number, duration_ms=sound.duration_ms, loudness=sound.loudness)


class WorkerReport:
    """The way back to the interface, kept clear of whatever an engine prints."""

    def __init__(self) -> None:
        """Take standard output for events alone; from here on, prints go to standard error."""
        self._lines = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())

    def __call__(self, event: str, **values: object) -> None:
        """Send one event."""
        self._lines.write(json.dumps({"event": event, **values}) + "\n")
        self._lines.flush()


def _read_into(commands: queue.Queue[dict[str, Any] | None]) -> None:
    try:
        for line in sys.stdin:
            command = json.loads(line)
            if "quit" in command:
                return
            commands.put(command)
    finally:
        # Whatever ends the input, a line that is no command too, ends the work: nobody is left to speak to.
        commands.put(None)


def run_tts_worker(language: str, rate: int, volume: float) -> None:
    """Find the engine, say what was found, and work."""
    report = WorkerReport()
    commands: queue.Queue[dict[str, Any] | None] = queue.Queue()
    threading.Thread(target=_read_into, args=(commands,), daemon=True).start()
    try:
        engine = SpeechEngine(language, rate, volume)
    except Exception as error:  # noqa: BLE001 - engines raise whatever they like when a library is missing
        report("unavailable", why=f"no speech engine: {error}")
        return
    plays = AudioPlayer()
    report("ready", voice=engine.voice, spoken=engine.spoken, player=plays.audible)
    with tempfile.TemporaryDirectory(prefix="recollect-voice-") as folder:
        TtsWorker(engine, plays, report, Path(folder) / "sentence.wav", commands).run()


if __name__ == "__main__":
    run_tts_worker(sys.argv[1], int(sys.argv[2]), float(sys.argv[3]))
