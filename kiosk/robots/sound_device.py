"""Play clips on the sound device: through one stream that stays open, or with a program for each."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
import threading
import time
from collections.abc import Callable, Generator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from kiosk.robots.clips import FADE_MS, Clip, Samples

try:
    import miniaudio
except ImportError:  # no wheel for this machine
    miniaudio = None

HAS_STREAM = miniaudio is not None
"""Whether sounds are played through one stream; else a program plays each of them."""

PERIOD_MS = 5
PERIODS = 2
"""The device asks for this much at a time, and holds this many: a sound waits 10 ms at most before it is heard."""

STALLED_S = 1.5
"""A device that asks for no samples for this long is gone, whatever else it says."""

REOPEN_S = 2.0
"""How long after a failure the device is tried again."""

PROVEN_S = 0.1
"""A device that is opened again counts as back when it asks for samples this long after: all ask for some at once."""

LOOK_S = 2.0
"""How often a sound server is asked which devices it has."""

RATES = (48_000, 44_100)
"""Samples a second that are tried with a device that does not take the clips' own."""

NOWHERE = "null"
"""The device that keeps the time of a real one and is heard by no one; for rehearsals and tests."""

NO_DEVICE = "there is no sound device"
BUSY = "another program uses the sound device"
GONE = "the sound device is gone"
_BUSY_RESULTS = frozenset({-19, -103})
"""miniaudio's ``MA_BUSY`` and ``MA_ALREADY_IN_USE``."""
_PLACEHOLDER = b"auto_null\0"
"""The sink that PulseAudio and PipeWire make up while there is no sound card; its name is translated, its id is not."""
_SOUND_SERVER = "PulseAudio"
"""The backend that moves a stream to another device, or to the placeholder, without a word."""


Post = Callable[[dict[str, Any]], None]
"""Takes what becomes of a sound; may be called from any thread."""


class Player(Protocol):
    """Plays one sound at a time and posts ``started``, ``finished``, ``broken`` with its number, and ``device``."""

    device: str
    """The name of the device; empty while there is none."""
    why: str
    """Why there is none."""

    def play(self, number: int | None, clip: Clip) -> None:
        """Begin to play, in place of any other sound; nothing is posted of one without a number."""
        ...

    @property
    def busy(self) -> bool:
        """Whether a sound is under way."""
        ...

    def stop(self) -> None:
        """Be silent; nothing more is posted."""
        ...

    def tend(self) -> None:
        """See whether the device is still there, or back."""
        ...

    def set_volume(self, volume: float) -> None:
        """Set the volume, from 0 to 1."""
        ...

    def close(self) -> None:
        """Let go of the device."""
        ...


@dataclass
class _Sound:
    """A sound under way; ``begins`` and ``ends`` count samples of the stream, before which it is not heard."""

    number: int | None
    samples: Samples
    begins: int
    at: int = 0
    ends: int | None = None
    is_started: bool = False


class StreamPlayer:
    """Plays through one stream that stays open: silence runs when nothing else does, so that a sound begins at once.

    Starts and ends are posted when the samples have left the device's buffer. A device that goes away, or that stops
    asking for samples, breaks off the sound; it is tried again every two seconds. A device that does not take the rate
    of the clips is opened at its own, and every clip is converted.
    """

    def __init__(self, post: Post, rate: int, device: str = "", volume: float = 1.0) -> None:
        """Open the device of this name, or the system's own; ``rate`` is that of most sounds."""
        self.device = ""
        self.why = NO_DEVICE
        self._post = post
        self._rate = rate
        self._wanted = device
        self._volume = volume
        self._lock = threading.Lock()
        self._sound: _Sound | None = None
        self._tail: Samples = np.zeros(0, np.int16)
        self._given = 0
        self._held = rate * PERIOD_MS * PERIODS // 1000
        self._asked_at = 0.0
        self._tried_at = 0.0
        self._stream: Any = None
        self._name = ""
        self._missing = ""
        self._closing = threading.Event()
        if self._is_open():
            self.device = self._name

    @property
    def busy(self) -> bool:
        """Whether a sound is under way."""
        return self._sound is not None

    def play(self, number: int | None, clip: Clip) -> None:
        """Begin to play, in place of any other sound."""
        if not self.device:
            if number is not None:
                self._post({"event": "broken", "id": number, "why": self.why})
            return
        samples = clip.at_rate(self._rate).samples
        with self._lock:
            self._fade_out()
            self._sound = _Sound(number, samples, self._given)

    def stop(self) -> None:
        """Be silent; nothing more is posted."""
        with self._lock:
            self._fade_out()

    def set_volume(self, volume: float) -> None:
        """Set the volume, from 0 to 1."""
        self._volume = volume

    def tend(self) -> None:
        """Break off what a lost device played, and look for one."""
        now = time.monotonic()
        if self._stream is None:
            if now - self._tried_at > REOPEN_S:
                self._is_open()
        elif self._missing:
            self._lose(self._missing)
        elif now - self._asked_at > STALLED_S:
            self._lose(GONE)
        elif not self.device and self._asked_at - self._tried_at > PROVEN_S:
            self.device = self._name
            self._post({"event": "device", "device": self.device})

    def close(self) -> None:
        """Let go of the device."""
        self._closing.set()
        stream, self._stream = self._stream, None
        if stream is not None:
            stream.close()

    def _is_open(self) -> bool:
        """Open the device; returns whether it could be. It has ``device`` only once it has proved to play."""
        self._tried_at = time.monotonic()
        try:
            chosen = _chosen(self._wanted)
            stream = self._opened(chosen)
            asking = self._ask()
            next(asking)
            self._asked_at = time.monotonic()
            stream.start(asking)
        except LookupError as error:
            self.why = str(error)
            return False
        except miniaudio.MiniaudioError as error:
            self.why = NO_DEVICE if _BUSY_RESULTS.isdisjoint(error.args) else BUSY
            return False
        self._stream = stream
        self._missing = ""
        self._name = chosen.name or f"system default ({stream.backend})"
        if stream.backend == _SOUND_SERVER:
            threading.Thread(target=self._watch, args=(stream,), daemon=True).start()
        return True

    def _opened(self, chosen: _Chosen) -> Any:
        """Open a device at the rate of most sounds, or at one that it takes; raises MiniaudioError."""
        failure: Exception | None = None
        for rate in (self._rate, *RATES):
            try:
                stream = miniaudio.PlaybackDevice(
                    miniaudio.SampleFormat.SIGNED16,
                    1,
                    rate,
                    PERIOD_MS,
                    callback_periods=PERIODS,
                    app_name="Recollect",
                    **chosen.options,
                )
            except miniaudio.MiniaudioError as error:
                failure = failure or error
                continue
            self._rate, self._held = rate, rate * PERIOD_MS * PERIODS // 1000
            return stream
        raise failure or miniaudio.MiniaudioError(NO_DEVICE)

    def _watch(self, stream: Any) -> None:
        """Ask the sound server, as long as a stream is open, whether its device is still there."""
        while not self._closing.wait(LOOK_S) and self._stream is stream:
            try:
                _chosen(self._wanted)
            except LookupError as error:
                self._missing = str(error)
                return
            except miniaudio.MiniaudioError:
                self._missing = GONE
                return

    def _lose(self, why: str) -> None:
        stream, self._stream = self._stream, None
        was_there = bool(self.device)
        self.device, self.why = "", why
        with self._lock:
            sound, self._sound = self._sound, None
        if sound is not None and sound.number is not None:
            self._post({"event": "broken", "id": sound.number, "why": why})
        if was_there:
            self._post({"event": "device", "device": "", "why": why})
        # A device that hangs may not come back from this.
        threading.Thread(target=stream.close, daemon=True).start()
        self._tried_at = time.monotonic()

    def _ask(self) -> Generator[bytes, int, None]:
        """Yield samples for the thread of the stream, which sends how many it wants."""
        wanted = yield b""
        while True:
            wanted = yield self._next(wanted)

    def _next(self, count: int) -> bytes:
        self._asked_at = time.monotonic()
        with self._lock:
            chunk = np.zeros(count, np.int16)
            faded = self._tail[:count]
            chunk[: len(faded)] = faded
            self._tail = self._tail[count:]
            sound = self._sound
            if sound is not None:
                piece = sound.samples[sound.at : sound.at + count]
                chunk[: len(piece)] += (piece * self._volume).astype(np.int16)
                sound.at += len(piece)
                if sound.at >= len(sound.samples) and sound.ends is None:
                    sound.ends = self._given + len(piece)
            self._given += count
            told = self._told(sound)
        for event in told:
            self._post(event)
        return chunk.tobytes()

    def _told(self, sound: _Sound | None) -> list[dict[str, Any]]:
        """Return what can be said of a sound now that the device has played all but what it holds."""
        if sound is None:
            return []
        played = self._given - self._held
        told = []
        if not sound.is_started and played >= sound.begins:
            sound.is_started = True
            told.append({"event": "started", "id": sound.number})
        if sound.ends is not None and played >= sound.ends:
            self._sound = None
            told.append({"event": "finished", "id": sound.number})
        return told if sound.number is not None else []

    def _fade_out(self) -> None:
        """Let go of the sound under way; its next few samples fade."""
        sound, self._sound = self._sound, None
        if sound is not None:
            rest = sound.samples[sound.at : sound.at + self._rate * FADE_MS // 1000]
            self._tail = (rest * np.linspace(self._volume, 0, len(rest))).astype(np.int16)


@dataclass(frozen=True)
class _Chosen:
    """A device as miniaudio takes it; without a name it is the system's own."""

    name: str
    options: dict[str, Any]


def _chosen(wanted: str) -> _Chosen:
    """Find a device by its name or a part of it; raises LookupError with the names that there are.

    Raises LookupError as well where a sound server has nothing but its placeholder for a sound card.
    """
    if wanted == NOWHERE:
        return _Chosen(NOWHERE, {"backends": [miniaudio.Backend.NULL]})
    real = [backend for backend in miniaudio.Backend if backend is not miniaudio.Backend.NULL]
    real = [backend for backend in real if miniaudio.is_backend_enabled(backend)]
    there = _playbacks(real)
    if not wanted:
        if there and all(bytes(miniaudio.ffi.buffer(each)).startswith(_PLACEHOLDER) for each in there.values()):
            raise LookupError(f"{NO_DEVICE}, only {', '.join(there)}, which is no sound card")
        return _Chosen("", {"backends": real})
    name = next((name for name in there if wanted.casefold() in name.casefold()), None)
    if name is None:
        raise LookupError(f"there is no sound device {wanted!r}, only {', '.join(there) or 'none'}")
    return _Chosen(name, {"backends": real, "device_id": there[name]})


def _playbacks(backends: list[Any]) -> dict[str, Any]:
    """Return the ids of the sound devices by their names; raises MiniaudioError."""
    devices = miniaudio.Devices(backends)
    return {str(each["name"]): each["id"] for each in devices.get_playbacks()}


_QUIET = {"aplay": ("-q",), "afplay": ()}
"""The programs that are looked for, in this order, and what keeps them from talking."""


def player_command() -> tuple[str, ...] | None:
    """Return the command that plays the file that is added to it; None if there is no such program."""
    path = next((path for name in _QUIET if (path := shutil.which(name))), None)
    return (path, *_QUIET[Path(path).name]) if path else None


class CommandPlayer:
    """Plays with a child process for each sound, where miniaudio has no build; starts and ends are the child's."""

    def __init__(self, post: Post, volume: float = 1.0) -> None:
        """Look for a program that plays."""
        self._post = post
        self._command = player_command()
        self._volume = volume
        self._child: subprocess.Popen[bytes] | None = None
        self._number: int | None = None
        self._folder = tempfile.TemporaryDirectory(prefix="recollect-sound-")
        self.device = "" if self._command is None else Path(self._command[0]).name
        self.why = "there is no program that plays sound"
        if self._command is not None:
            # The program is there even where no sound card is: a moment of silence tells.
            self.play(None, Clip(np.zeros(RATES[0] // 50, np.int16), RATES[0]))

    @property
    def busy(self) -> bool:
        """Whether a sound is under way."""
        return self._child is not None

    def play(self, number: int | None, clip: Clip) -> None:
        """Begin to play, in place of any other sound."""
        self.stop()
        if self._command is None:
            if number is not None:
                self._post({"event": "broken", "id": number, "why": self.why})
            return
        file = Path(self._folder.name) / "sound.wav"
        Clip((clip.samples * self._volume).astype(np.int16), clip.rate).write(file)
        command = (*self._command, str(file))
        self._child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # noqa: S603
        self._number = number
        if number is not None:
            self._post({"event": "started", "id": number})

    def stop(self) -> None:
        """Be silent; nothing more is posted."""
        child, self._child = self._child, None
        if child is not None:
            child.kill()
            child.wait()

    def tend(self) -> None:
        """See whether the child has ended; one that fails has no sound card."""
        code = None if self._child is None else self._child.poll()
        if code is None:
            return
        self._child = None
        if self._number is not None:
            end = {"event": "finished"} if code == 0 else {"event": "broken", "why": NO_DEVICE}
            self._post(end | {"id": self._number})
        self._notice(plays=code == 0)

    def set_volume(self, volume: float) -> None:
        """Set the volume, from 0 to 1, from the next sound on."""
        self._volume = volume

    def close(self) -> None:
        """Be silent, and leave no file."""
        self.stop()
        self._folder.cleanup()

    def _notice(self, *, plays: bool) -> None:
        name = Path(self._command[0]).name if plays and self._command is not None else ""
        if name != self.device:
            self.device, self.why = name, NO_DEVICE
            self._post({"event": "device", "device": name} | ({} if plays else {"why": NO_DEVICE}))


def create_player(post: Post, rate: int, device: str, volume: float) -> Player:
    """Return the player of this machine: one stream where miniaudio has a build, else a program for each sound."""
    if miniaudio is None:
        return CommandPlayer(post, volume)
    return StreamPlayer(post, rate, device, volume)
