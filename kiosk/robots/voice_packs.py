"""Voice packs: a folder of clips, one for each part of a sentence.

A manifest names the voice.
"""

from __future__ import annotations

import hashlib
import json
import logging
import re
import wave
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np
import platformdirs

from kiosk import UserInputError
from kiosk.files import parse_json
from kiosk.robots.clips import TARGET_LUFS, Clip, joined, levelled, loudness_lufs, trimmed
from kiosk.robots.tts_engines import ENGINES, SpeechEngine, is_installed

if TYPE_CHECKING:
    from kiosk.config import VoiceConfig
    from kiosk.robots.driver import SpokenClip

_log = logging.getLogger(__name__)

MANIFEST = "pack.json"
PAUSE_MS = 250
"""Between the parts of a sentence, as between two sentences of a calm speaker."""
LOUDNESS_TOLERANCE = 2.0
"""LU by which a clip may differ from the others."""
_CLIPPED = 4
"""Samples at full scale, one after another, that are heard as distortion."""
_KEY_LENGTH = 24
_SENTENCE_END = re.compile(r"(?<=[.!?\u2026\u3002\uff01\uff1f])\s+")


def key_of(language: str, text: str) -> str:
    """Return the name of the clip of a text: the beginning of the SHA-256 of its language and its words."""
    return hashlib.sha256(f"{language}\n{text}".encode()).hexdigest()[:_KEY_LENGTH]


def cache_folder(language: str, engine: str, rate: int) -> Path:
    """Where the pack lies that is rendered from an engine once and for all studies."""
    return Path(platformdirs.user_cache_dir("recollect", appauthor=False)) / "voices" / f"{language}-{engine}-{rate}"


@dataclass(frozen=True)
class PackLabel:
    """What a manifest says of all its clips: their language, the engine or person who spoke them, and the licence."""

    language: str
    spoken_by: Mapping[str, str]
    licence: str

    @classmethod
    def of_person(cls, language: str, speaker: str, licence: str) -> PackLabel:
        """Return the label of clips that a person recorded."""
        return cls(language, {"engine": "person", "engine_version": "", "voice": speaker}, licence)


@dataclass(frozen=True)
class VoicePack:
    """A pack as its manifest describes it; ``sha256`` is over all its clips and who spoke them."""

    folder: Path
    language: str
    spoken_by: dict[str, str]
    licence: str
    rate: int
    clips: Mapping[str, Mapping[str, Any]]
    sha256: str

    @classmethod
    def read(cls, folder: Path) -> Self:
        """Read the manifest in a folder; raises UserInputError if there is none that can be used."""
        try:
            told = parse_json((folder / MANIFEST).read_text("utf-8"))
            by = {name: str(told["spoken_by"][name]) for name in ("engine", "engine_version", "voice")}
            clips = {str(key): dict(clip) for key, clip in told["clips"].items()}
            for clip in clips.values():
                clip["text"], clip["sha256"]
            return cls(
                folder, str(told["language"]), by, str(told["licence"]), int(told["rate"]), clips, told["sha256"]
            )
        except OSError as error:
            raise UserInputError(f"there is no voice pack in {folder}: {MANIFEST}: {error.strerror}") from error
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise UserInputError(f"{folder / MANIFEST} is no manifest of a voice pack") from error

    @classmethod
    def read_if_there(cls, folder: Path) -> Self | None:
        """Read a pack of the cache; None if there is none that can be used."""
        try:
            return cls.read(folder)
        except UserInputError:
            return None

    @property
    def voice(self) -> str:
        """The name of the voice."""
        return self.spoken_by["voice"]

    @property
    def described(self) -> str:
        """The pack in words for people."""
        return f"{self.voice} of {self.spoken_by['engine']} ({len(self.clips)} clips)"

    def path(self, key: str) -> Path:
        """Where a clip lies."""
        return self.folder / f"{key}.wav"

    def find(self, text: str) -> list[Path] | None:
        """Return the clips that say a text, whole or part by part; None if one is missing."""
        ends = [*(match.end() for match in _SENTENCE_END.finditer(text)), len(text)]
        begin, found = 0, []
        while begin < len(text):
            fits = (end for end in reversed(ends) if end > begin and self._key(text[begin:end]) in self.clips)
            end = next(fits, None)
            if end is None:
                return None
            found.append(self.path(self._key(text[begin:end])))
            begin = end
        return found if found and all(path.is_file() for path in found) else None

    def clips_of(self, text: str) -> list[Clip] | None:
        """Return the sounds that say a text.

        It is None if one is missing, cannot be read or was changed since it was made.
        """
        clips = []
        for path in self.find(text) or ():
            try:
                content = path.read_bytes()
                if hashlib.sha256(content).hexdigest() != self.clips[path.stem]["sha256"]:
                    return None
                clips.append(Clip.from_bytes(content))
            except (OSError, wave.Error, EOFError):
                return None
        return clips or None

    def _key(self, text: str) -> str:
        return key_of(self.language, text.strip())

    def missing(self, texts: Iterable[str]) -> tuple[str, ...]:
        """Those of the texts that it cannot say."""
        return tuple(text for text in texts if self.find(text) is None)

    def faults(self) -> Iterator[str]:
        """Say what is wrong with the pack: clips that are gone, changed, silent, clipped or of another loudness."""
        if self.sha256 != _hash(self.spoken_by, self.clips):
            yield "the manifest was changed by hand: its hash is not that of its clips"
        for key, told in self.clips.items():
            fault = self._fault(key, told)
            if fault:
                yield f"{key}.wav ({told['text']!r}) {fault}"

    def _fault(self, key: str, told: Mapping[str, Any]) -> str | None:
        try:
            content = self.path(key).read_bytes()
            clip = Clip.from_bytes(content)
        except OSError as error:
            return f"cannot be read: {error.strerror}"
        except (wave.Error, EOFError):
            return "is no WAV file"
        if hashlib.sha256(content).hexdigest() != told["sha256"]:
            return "was changed since the pack was made"
        return sound_fault(clip) or loudness_fault(clip)


def find_pack(settings: VoiceConfig, language: str) -> VoicePack | None:
    """Return the pack that speaks a language: the one that is named, or the cache's of the best engine.

    It is that of the avatar's voice, which has no other way without an engine. Raises UserInputError for a folder that
    is no pack.
    """
    speaker = settings.speakers.get(language, "")
    if speaker and speaker not in ENGINES:
        return VoicePack.read(Path(speaker))
    for name in (speaker,) if speaker else ENGINES:
        pack = VoicePack.read_if_there(cache_folder(language, name, settings.rate)) if is_installed(name) else None
        if pack is not None:
            return pack
    return None


class PackClips:
    """The clips of the avatar's packs for another body, such as a robot that plays what it fetches."""

    def __init__(self, settings: VoiceConfig) -> None:
        """Read a pack when its language is spoken for the first time."""
        self._settings = settings
        self._packs: dict[str, VoicePack | None] = {}

    def __call__(self, language: str, text: str) -> SpokenClip | None:
        """Return the clip that says a text; None if the language has no pack that can say it."""
        if language not in self._packs:
            try:
                self._packs[language] = find_pack(self._settings, language)
            except UserInputError as refusal:
                _log.warning("%s", refusal)
                self._packs[language] = None
        pack = self._packs[language]
        parts = None if pack is None else pack.clips_of(text)
        if pack is None or not parts:
            return None
        clip = joined(parts, PAUSE_MS)
        from kiosk.robots.driver import SpokenClip  # noqa: PLC0415 - the voice's process needs nothing of it

        return SpokenClip(clip.to_bytes(), clip.duration_ms, pack.spoken_by | {"pack": pack.sha256})


def sound_fault(clip: Clip) -> str | None:
    """Say what makes a recording useless, silence or clipping; None if nothing does."""
    if not np.isfinite(loudness_lufs(clip)):
        return "is silent"
    full = np.abs(clip.samples.astype(int)) >= 2**15 - 1
    if np.convolve(full, np.ones(_CLIPPED), "valid").max(initial=0) >= _CLIPPED:
        return "is clipped: record it with a lower level"
    return None


def loudness_fault(clip: Clip) -> str | None:
    """Say how far the loudness of a clip is from that of all clips; None if it is near enough."""
    off = loudness_lufs(clip) - TARGET_LUFS
    if abs(off) > LOUDNESS_TOLERANCE:
        return f"is {abs(off):.1f} LU {'louder' if off > 0 else 'softer'} than it should be"
    return None


def _hash(spoken_by: Mapping[str, str], clips: Mapping[str, Mapping[str, Any]]) -> str:
    lines = [json.dumps(dict(spoken_by), sort_keys=True), *(f"{key} {clips[key]['sha256']}" for key in sorted(clips))]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


Progress = Callable[[int], None]


def render_pack(engine: SpeechEngine, language: str, texts: Sequence[str], folder: Path, tell: Progress) -> VoicePack:
    """Render what a folder's pack does not hold yet; ``tell`` hears how many texts are done.

    Raises what the engine raises; the clips that were rendered until then are kept.
    """
    if engine.voice is None:
        raise UserInputError(f"no voice of {engine.name} speaks {language!r}")
    by = {"engine": engine.name, "engine_version": engine.version, "voice": engine.voice}
    before = VoicePack.read_if_there(folder)
    kept = before.clips if before is not None and before.spoken_by == by and before.language == language else {}

    def clips() -> Iterator[tuple[str, Clip]]:
        for number, text in enumerate(texts, 1):
            if key_of(language, text) not in kept:
                yield text, engine.render(text)
            tell(number)

    return write_pack(folder, PackLabel(language, by, engine.licence), clips(), kept)


def write_pack(
    folder: Path,
    label: PackLabel,
    sounds: Iterable[tuple[str, Clip]],
    kept: Mapping[str, Mapping[str, Any]] | None = None,
) -> VoicePack:
    """Write clips, trimmed and levelled, and the manifest of them and of those that are ``kept``."""
    folder.mkdir(parents=True, exist_ok=True)
    clips = {key: dict(clip) for key, clip in (kept or {}).items()}
    rate = 0
    try:
        for text, sound in sounds:
            clip = levelled(trimmed(sound))
            rate = clip.rate
            key = key_of(label.language, text)
            clip.write(folder / f"{key}.wav")
            digest = hashlib.sha256((folder / f"{key}.wav").read_bytes()).hexdigest()
            clips[key] = {"text": text, "sha256": digest, "duration_ms": clip.duration_ms}
    finally:
        rate = rate or next((Clip.read(folder / f"{key}.wav").rate for key in clips), 0)
        told = {
            "language": label.language,
            "spoken_by": dict(label.spoken_by),
            "licence": label.licence,
            "rate": rate,
            "loudness_lufs": TARGET_LUFS,
            "sha256": _hash(label.spoken_by, clips),
            "clips": clips,
        }
        written = folder / f"{MANIFEST}.new"
        written.write_text(json.dumps(told, ensure_ascii=False, indent=1), "utf-8")
        written.replace(folder / MANIFEST)
    return VoicePack.read(folder)


def recording_name(number: int) -> str:
    """Return the name of the recording of a numbered text."""
    return f"{number:03}.wav"


def import_recordings(recordings: Path, folder: Path, texts: Sequence[str], label: PackLabel) -> VoicePack:
    """Make a pack of a person's recordings, numbered as the script is.

    Raises UserInputError for a recording that is none, silent or clipped; nothing is written then.
    """
    sounds, faults = [], []
    for number, text in enumerate(texts, 1):
        file = recordings / recording_name(number)
        if not file.is_file():
            continue
        try:
            clip = Clip.read(file)
        except (OSError, wave.Error, EOFError):
            faults.append(f"{file} is no WAV file")
            continue
        # How loud it is does not matter: all recordings are levelled.
        if fault := sound_fault(clip):
            faults.append(f"{file} {fault}")
        sounds.append((text, clip))
    if not sounds and not faults:
        faults.append(f"there is no recording in {recordings}, such as {recording_name(1)}")
    if faults:
        raise UserInputError(*faults)
    rate = max(clip.rate for _, clip in sounds)
    return write_pack(folder, label, [(text, clip.at_rate(rate)) for text, clip in sounds])
