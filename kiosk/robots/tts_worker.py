"""The text-to-speech worker: a process that renders sentences and plays them on the sound device."""

from __future__ import annotations

import json
import os
import queue
import sys
import tempfile
import threading
import time
import wave
from collections.abc import Iterable, Iterator, Mapping
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pyttsx3

from kiosk.language_codes import distance
from kiosk.robots.audio import Clip, Player, create_player, loudness_steps

_TEND_S = 0.25
"""How often the sound device is looked at."""
_RENDER_S = 3.0
"""Rendering takes 10 to 60 ms; an engine that takes this long will never be done."""
_PROBE_S = 3.0

_NO_SOUND = (OSError, RuntimeError, EOFError, wave.Error)
"""What rendering raises when no sound came of it."""


class SpeechEngine:
    """The speech engine: renders a sentence to a file. pyttsx3 plays unreliably, but it renders well."""

    rate = 22_050
    """Samples a second of most voices."""

    def __init__(self, language: str, rate: int) -> None:
        """Take the nearest voice of the language; raises whatever the engine raises when it is missing."""
        self._engine = pyttsx3.init()
        self._done = threading.Event()
        self._engine.connect("finished-utterance", lambda **_: self._done.set())
        self._engine.setProperty("rate", rate)
        self._engine.setProperty("volume", 1.0)
        found = self._engine.getProperty("voices")
        chosen = voice_of(language, found)
        self.voice = None if chosen is None else str(chosen.id)
        self.spoken = "" if chosen is None else described(chosen)
        self.voices = [{"id": str(voice.id), "name": str(voice.name), "languages": _codes(voice)} for voice in found]
        if self.voice is not None:
            self._engine.setProperty("voice", self.voice)

    def render(self, text: str, file: Path) -> Clip:
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
        return Clip.read(file)


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


Commands = queue.Queue[dict[str, Any] | None]


class TtsWorker:
    """Takes one command after another, and never renders or plays two sentences at once."""

    def __init__(
        self,
        engine: SpeechEngine,
        player: Player,
        report: WorkerReport,
        file: Path,
        commands: Commands,
    ) -> None:
        """Render into ``file``; what the player posts is among the commands, and ``None`` ends the work."""
        self._engine = engine
        self._player = player
        self._report = report
        self._file = file
        self._commands = commands
        self._saying: int | None = None
        self._told: dict[str, object] = {}
        self._sounds: dict[str, Clip] = {}

    def run(self) -> None:
        """Work until the commands end."""
        for command in self._next_commands():
            if "event" in command:
                self._hear(command)
            elif "play" in command:
                self._play(str(command["play"]))
            elif "volume" in command:
                self._player.set_volume(float(command["volume"]))
            elif "voices" in command:
                self._report("voices", voices=self._engine.voices)
            elif "render" in command:
                self._render(str(command["render"]))
            else:
                self._stop()
                if "say" in command:
                    self._say(int(command["say"]), str(command["text"]))

    def _stop(self) -> None:
        """Be silent: a sentence never waits for a sound."""
        self._player.stop()
        self._saying = None

    def _play(self, file: str) -> None:
        """Play a short sound in place of any other, but not while a sentence is under way."""
        if self._saying is None:
            if file not in self._sounds:
                self._sounds[file] = Clip.read(Path(file))
            self._player.play(None, self._sounds[file])

    def _render(self, text: str) -> None:
        """Render a text that nobody is to hear."""
        begun = time.monotonic()
        try:
            sound = self._engine.render(text, self._file)
        except _NO_SOUND as error:
            self._report("failed", why=str(error) or type(error).__name__)
            return
        took_ms = round((time.monotonic() - begun) * 1000)
        self._report("rendered", duration_ms=sound.duration_ms, took_ms=took_ms)

    def _next_commands(self) -> Iterator[dict[str, Any]]:
        """Every command in turn; look after the sound device between them."""
        while True:
            try:
                command = self._commands.get(timeout=_TEND_S)
            except queue.Empty:
                self._player.tend()
                continue
            if command is None:
                self._stop()
                return
            yield command
            self._player.tend()

    def _hear(self, event: dict[str, Any]) -> None:
        """Pass on what the player posted; what comes late of a sentence before is left out."""
        if event["event"] == "device":
            self._report("device", device=event["device"], why=event.get("why", ""))
            return
        if event["id"] != self._saying:
            return
        if event["event"] == "started":
            self._report("started", id=self._saying, **self._told)
            return
        self._saying = None
        if event["event"] == "finished":
            self._report("finished", id=event["id"])
        else:
            self._report("failed", id=event["id"], why=event["why"])

    def _say(self, number: int, text: str) -> None:
        if not self._player.device:
            self._report("failed", id=number, why=self._player.why)
            return
        try:
            sound = self._engine.render(text, self._file)
        except _NO_SOUND as error:
            self._report("failed", id=number, why=str(error) or type(error).__name__)
            return
        self._saying = number
        self._told = {"duration_ms": sound.duration_ms, "loudness": loudness_steps(sound)}
        self._player.play(number, sound)


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


def _read_into(commands: Commands) -> None:
    try:
        for line in sys.stdin:
            command = json.loads(line)
            if "quit" in command:
                return
            commands.put(command)
    finally:
        # Whatever ends the input, a line that is no command too, ends the work: nobody is left to speak to.
        commands.put(None)


def run_tts_worker(options: Mapping[str, Any]) -> None:
    """Find the engine and the sound device, say what was found, and work.

    ``options`` are ``language``, ``rate`` (words a minute), ``volume`` (0 to 1) and ``device``; with ``probe`` the
    device is tried with a moment of silence, and no engine is looked for.
    """
    report = WorkerReport()
    commands: Commands = queue.Queue()
    device, volume = str(options.get("device", "")), float(options["volume"])
    if options.get("probe"):
        with closing(create_player(commands.put, SpeechEngine.rate, device, volume)) as player:
            report("probed", **_probed(player, commands))
        return
    threading.Thread(target=_read_into, args=(commands,), daemon=True).start()
    try:
        engine = SpeechEngine(str(options["language"]), int(options["rate"]))
    except Exception as error:  # noqa: BLE001 - engines raise whatever they like when a library is missing
        report("unavailable", why=f"no speech engine: {error}")
        return
    with (
        closing(create_player(commands.put, engine.rate, device, volume)) as player,
        tempfile.TemporaryDirectory(prefix="recollect-voice-") as folder,
    ):
        report("ready", voice=engine.voice, spoken=engine.spoken, device=player.device, why=player.why)
        TtsWorker(engine, player, report, Path(folder) / "sentence.wav", commands).run()


def _probed(player: Player, events: Commands) -> dict[str, object]:
    """Play a tenth of a second of silence; returns the ``device`` that took it, and ``why`` if none did."""
    deadline = time.monotonic() + _PROBE_S
    player.play(0, Clip(np.zeros(SpeechEngine.rate // 10, np.int16), SpeechEngine.rate))
    device, why = player.device, player.why
    while time.monotonic() < deadline:
        try:
            event = events.get(timeout=_TEND_S / 10)
        except queue.Empty:
            player.tend()
            continue
        if event is not None and event["event"] == "finished":
            return {"device": device, "why": ""}
        if event is not None and event["event"] == "broken":
            return {"device": "", "why": event["why"]}
    return {"device": "", "why": f"{device or 'the sound device'} takes no sound" if device else why}


if __name__ == "__main__":
    run_tts_worker(json.loads(sys.argv[1]))
