"""The engines that turn a sentence into a clip, all offline: the best one that is installed for each language."""

from __future__ import annotations

import contextlib
import sys
import tempfile
import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from kiosk.language_codes import distance
from kiosk.robots.clips import Clip

_RENDER_S = 3.0
"""Rendering takes 10 to 60 ms; an engine that takes this long will never be done."""

USUAL_RATE = 150
"""The words a minute at which Pico and hibari speak unless told otherwise."""


class SpeechEngine(Protocol):
    """Renders sentences of one language; ``voice`` is None if no voice speaks it."""

    name: str
    version: str
    licence: str
    rate: int
    """Samples a second."""
    spoken: str
    """The voice in words for people."""

    @property
    def voice(self) -> str | None:
        """The name of the voice; None if none speaks the language."""
        ...

    @property
    def voices(self) -> Sequence[Mapping[str, Any]]:
        """Every voice that the engine has: id, name and languages."""
        ...

    def render(self, text: str) -> Clip:
        """Render a sentence; raises OSError, RuntimeError, EOFError or wave.Error if no sound came of it."""
        ...


class PicoEngine:
    """SVOX Pico (Apache License 2.0), with the voices that come in its package."""

    name = "pico"
    licence = "Apache-2.0"
    rate = 16_000
    codes = ("en-US", "en-GB", "it-IT", "es-ES", "de-DE", "fr-FR")

    def __init__(self, language: str, rate: int) -> None:
        """Take the voice of the language, at so many words a minute; raises ImportError if it is not installed."""
        from py_nanotts import NanoTTS  # noqa: PLC0415 - there is no build of it for every machine

        self._engine = NanoTTS()
        self._speed = rate / USUAL_RATE
        self.version = _version("py-nanotts")
        self.voice = _nearest(language, self.codes)
        self.spoken = f"SVOX Pico ({self.voice})"
        self.voices = [{"id": code, "name": f"SVOX Pico {code}", "languages": [code]} for code in self.codes]

    def render(self, text: str) -> Clip:
        """Render a sentence."""
        # The engine reads markup: a bare sign of it would be swallowed with what follows.
        plain = text.replace("<", " ").replace(">", " ").replace("&", " ")
        raw = self._engine.speak(plain, self.voice, speed=self._speed)
        if not raw:
            raise RuntimeError("the engine made no sound of the sentence")
        return Clip(np.frombuffer(raw, dtype="<i2").astype(np.int16), self.rate)


class HibariEngine:
    """hibari (Apache License 2.0), which speaks American English; installed with the extra ``natural``."""

    name = "hibari"
    licence = "Apache-2.0"
    rate = 24_000

    def __init__(self, language: str, rate: int) -> None:
        """Load its model, which takes half a second; raises ImportError if it is not installed."""
        from hibari import Hibari  # noqa: PLC0415 - an extra

        self._speed = rate / USUAL_RATE
        self.version = _version("hibari-tts")
        self.voice = "heart" if distance(language, "en-US") is not None else None
        self._engine = Hibari() if self.voice else None
        self.spoken = "hibari heart (en-US)"
        self.voices = [{"id": "heart", "name": "hibari heart", "languages": ["en-US"]}]

    def render(self, text: str) -> Clip:
        """Render a sentence, the same each time."""
        if self._engine is None:
            raise RuntimeError("no voice of hibari speaks the language")
        return Clip.of(self._engine(text, speed=self._speed, seed=1), self.rate)


def _nearest(language: str, codes: Iterable[str]) -> str | None:
    near = [(far, number, code) for number, code in enumerate(codes) if (far := distance(language, code)) is not None]
    return min(near)[2] if near else None


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "unknown"


class SystemEngine:
    """The system's own voices by pyttsx3, which plays unreliably, but renders well."""

    name = "system"
    licence = "that of the system's voices"

    rate = 22_050
    """Samples a second of most voices."""

    def __init__(self, language: str, rate: int) -> None:
        """Take the nearest voice of the language; raises whatever the engine raises when it is missing."""
        import pyttsx3  # noqa: PLC0415 - loads the system's speech library

        self._engine = pyttsx3.init()
        self.version = _version("pyttsx3")
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

    def render(self, text: str) -> Clip:
        """Render a sentence; raises RuntimeError if no voice speaks the language."""
        if self.voice is None:
            raise RuntimeError("no installed voice speaks the language")
        with tempfile.TemporaryDirectory(prefix="recollect-voice-") as folder:
            return self._rendered(text, Path(folder) / "sentence.wav")

    def _rendered(self, text: str, file: Path) -> Clip:
        # runAndWait comes back after 10 ms, done or not.
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
    """Return the languages of a voice as codes; espeak gives them as bytes that begin with a priority."""
    codes = (code.decode(errors="ignore") if isinstance(code, bytes) else str(code) for code in voice.languages)
    return [code.strip("\x05\x02") for code in codes]


ENGINES: dict[str, type[PicoEngine | HibariEngine | SystemEngine]] = {
    "hibari": HibariEngine,
    "pico": PicoEngine,
    "system": SystemEngine,
}
"""The engines by the names that a study file calls them, the most intelligible first."""
_PACKAGES = {"hibari": "hibari", "pico": "py_nanotts", "system": "pyttsx3"}


def is_installed(name: str) -> bool:
    """Whether the engine of this name is there; it is not loaded."""
    return find_spec(_PACKAGES[name]) is not None


_SLOW = {"hibari"}
"""Engines that take longer for a sentence than the kiosk waits: they make packs, and do not speak live."""


def create_engine(language: str, rate: int, name: str = "", *, is_live: bool = False) -> SpeechEngine:
    """Start the engine of this name or, without one, the best that speaks the language.

    With ``is_live`` only those are taken that render a sentence while a visitor waits for it.

    Raises whatever an engine raises if none can be started; its ``voice`` is None if none speaks the language.
    """
    if name:
        return ENGINES[name](language, rate)
    for each in ("hibari", "pico"):
        if not (is_live and each in _SLOW) and find_spec(_PACKAGES[each]) is not None:
            with contextlib.suppress(ImportError, OSError):
                engine = ENGINES[each](language, rate)
                if engine.voice is not None:
                    return engine
    return SystemEngine(language, rate)
