"""The text-to-speech worker: a process that renders sentences and plays them on the sound device."""

from __future__ import annotations

import json
import os
import queue
import sys
import threading
import time
import wave
from collections.abc import Iterator, Mapping
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np

from kiosk import UserInputError
from kiosk.robots.clips import Clip, joined, levelled, loudness_steps, mouth_shapes, trimmed
from kiosk.robots.sound_device import Player, create_player
from kiosk.robots.tts_engines import ENGINES, create_engine
from kiosk.robots.voice_packs import PAUSE_MS, VoicePack, cache_folder

_TEND_S = 0.25
"""How often the sound device is looked at."""
_PROBE_S, _PROBE_RATE = 3.0, 48_000

_NO_SOUND = (OSError, RuntimeError, EOFError, wave.Error)
"""What rendering raises when no sound came of it."""


Commands = queue.Queue[dict[str, Any] | None]


class SpeechSource:
    """Where sentences come from: a pack of clips as far as it goes, and an engine for the rest."""

    def __init__(self, language: str, rate: int, speaker: str = "") -> None:
        """Take the engine or the pack that ``speaker`` names, or the best engine with the pack rendered from it.

        Raises UserInputError for a folder that is no pack, and what an engine raises if it cannot be started.
        """
        self.language = language
        self.pack = VoicePack.read(Path(speaker)) if speaker and speaker not in ENGINES else None
        self.engine = create_engine(language, rate, speaker if speaker in ENGINES else "")
        if self.pack is None and self.engine.voice is not None:
            self.pack = VoicePack.read_if_there(cache_folder(language, self.engine.name, rate))
            if self.pack is None and not speaker:
                self._take_live_engine(rate)
        self.rate = self.engine.rate if self.pack is None else self.pack.rate

    def _take_live_engine(self, rate: int) -> None:
        """Take the best engine that is quick enough without a pack, with the pack rendered from that one."""
        self.engine = create_engine(self.language, rate, is_live=True)
        if self.engine.voice is not None:
            self.pack = VoicePack.read_if_there(cache_folder(self.language, self.engine.name, rate))

    @property
    def voice(self) -> str | None:
        """The name of the voice; None if there is none."""
        return self.engine.voice if self.pack is None else self.pack.voice

    @property
    def spoken_by(self) -> dict[str, str]:
        """The engine, its version, the voice and the hash of the pack, if there is one, that speak most sentences."""
        if self.pack is not None:
            return self.pack.spoken_by | {"pack": self.pack.sha256}
        engine = self.engine
        return {"engine": engine.name, "engine_version": engine.version, "voice": engine.voice or "", "pack": ""}

    def clip(self, text: str) -> tuple[Clip, dict[str, str]]:
        """Return the sound of a sentence, with the engine, version, voice and hash of the pack that it came from.

        A clip that was changed since its pack was made is not of this pack any more: the engine speaks instead.
        """
        parts = None if self.pack is None else self.pack.clips_of(text)
        if parts:
            return joined(parts, PAUSE_MS), self.spoken_by
        engine = self.engine
        by = {"engine": engine.name, "engine_version": engine.version, "voice": engine.voice or "", "pack": ""}
        return levelled(trimmed(engine.render(text))), by


class TtsWorker:
    """Takes one command after another, and never renders or plays two sentences at once."""

    def __init__(
        self,
        source: SpeechSource,
        player: Player,
        report: WorkerReport,
        commands: Commands,
    ) -> None:
        """Work through the commands until ``None`` comes; what the player posts is among them."""
        self._source = source
        self._player = player
        self._report = report
        self._commands = commands
        self._saying: int | None = None
        self._told: dict[str, object] = {}
        self._ends = False
        """Whether the work ends with the sentence that is under way."""
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
                self._report("voices", voices=self._source.engine.voices)
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
                self._sounds[file] = levelled(Clip.read(Path(file)))
            self._player.play(None, self._sounds[file])

    def _render(self, text: str) -> None:
        """Render a text without playing it."""
        begun = time.monotonic()
        try:
            sound, _ = self._source.clip(text)
        except _NO_SOUND as error:
            self._report("failed", why=str(error) or type(error).__name__)
            return
        took_ms = round((time.monotonic() - begun) * 1000)
        self._report("rendered", duration_ms=sound.duration_ms, took_ms=took_ms)

    def _next_commands(self) -> Iterator[dict[str, Any]]:
        """Every command in turn; look after the sound device between them."""
        while not self._ends or self._saying is not None:
            try:
                command = self._commands.get(timeout=_TEND_S)
            except queue.Empty:
                self._player.tend()
                continue
            if command is None:
                self._stop()
                return
            if "finish" in command:
                self._ends = True
            else:
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
            sound, by = self._source.clip(text)
        except _NO_SOUND as error:
            self._report("failed", id=number, why=str(error) or type(error).__name__)
            return
        self._saying = number
        # It is heard first, and looked at while the device still waits for its first samples.
        self._player.play(number, sound)
        self._told = {
            "duration_ms": sound.duration_ms,
            "loudness": loudness_steps(sound),
            "shapes": mouth_shapes(sound),
            "by": by | {"device": self._player.device},
        }


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
    is_finishing = False
    try:
        for line in sys.stdin:
            command = json.loads(line)
            if "quit" in command:
                return
            commands.put(command)
            if "finish" in command:
                is_finishing = True
                return
    finally:
        # Whatever ends the input, a line that is no command too, ends the work: the kiosk is gone.
        if not is_finishing:
            commands.put(None)


def run_tts_worker(options: Mapping[str, Any]) -> None:
    """Find the voice and the sound device, say what was found, and work.

    ``options`` are ``language``, ``rate`` (words a minute), ``speaker`` (an engine, or the folder of a pack),
    ``volume`` (0 to 1) and ``device``; with ``probe`` the device is tried with a moment of silence, and no voice is
    looked for.
    """
    report = WorkerReport()
    commands: Commands = queue.Queue()
    device, volume = str(options.get("device", "")), float(options["volume"])
    if options.get("probe"):
        with closing(create_player(commands.put, _PROBE_RATE, device, volume)) as player:
            report("probed", **_probed(player, commands))
        return
    threading.Thread(target=_read_into, args=(commands,), daemon=True).start()
    try:
        source = SpeechSource(str(options["language"]), int(options["rate"]), str(options.get("speaker", "")))
    except UserInputError as error:
        report("unavailable", why=str(error))
        return
    except Exception as error:  # noqa: BLE001 - engines raise whatever they like when a library is missing
        report("unavailable", why=f"no speech engine: {error}")
        return
    with closing(create_player(commands.put, source.rate, device, volume)) as player:
        spoken = source.engine.spoken if source.pack is None else source.pack.described
        by = source.spoken_by
        report("ready", voice=source.voice, spoken=spoken, by=by, device=player.device, why=player.why)
        TtsWorker(source, player, report, commands).run()


def _probed(player: Player, events: Commands) -> dict[str, object]:
    """Play a tenth of a second of silence; returns the ``device`` that took it, and ``why`` if none did."""
    deadline = time.monotonic() + _PROBE_S
    player.play(0, Clip(np.zeros(_PROBE_RATE // 10, np.int16), _PROBE_RATE))
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
