"""Clips of sound in memory: read, joined, trimmed and brought to one loudness, and how a mouth moves with them."""

from __future__ import annotations

import io
import wave
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from kiosk.robots import LOUDNESS_MS

try:
    import miniaudio
except ImportError:  # no wheel for this machine
    miniaudio = None

Samples = NDArray[np.int16]

FADE_MS = 5
"""A sound that is broken off fades in this time: cut at once, it would click."""

FULL_LOUDNESS = 0.25
"""The root mean square, of full scale, at which the mouth is wide open: loud vowels reach about this."""


@dataclass(frozen=True)
class Clip:
    """A mono sound of 16 bit; ``rate`` in samples per second."""

    samples: Samples
    rate: int

    @classmethod
    def read(cls, file: Path) -> Self:
        """Read a WAV file; raises OSError, wave.Error or EOFError if it is none of 8, 16, 24 or 32 bit."""
        return cls.from_bytes(file.read_bytes())

    @classmethod
    def from_bytes(cls, content: bytes) -> Self:
        """Read what a WAV file holds; several channels become one."""
        with wave.open(io.BytesIO(content)) as audio:
            rate, channels, width = audio.getframerate(), audio.getnchannels(), audio.getsampwidth()
            raw = audio.readframes(audio.getnframes())
        samples = _as_16_bit(raw[: len(raw) // (width * channels) * width * channels], width)
        if channels > 1:
            samples = samples.reshape(-1, channels).mean(axis=1).astype(np.int16)
        return cls(samples, rate)

    @classmethod
    def of(cls, values: NDArray[Any], rate: int) -> Self:
        """Make a clip of numbers from -1 to 1; what lies beyond is cut off."""
        return cls((np.clip(values, -1, 1) * (2**15 - 1)).astype(np.int16), rate)

    @property
    def values(self) -> NDArray[np.float64]:
        """The samples from -1 to 1."""
        return self.samples / 2**15

    @property
    def duration_ms(self) -> int:
        """How long it lasts."""
        return len(self.samples) * 1000 // self.rate

    def to_bytes(self) -> bytes:
        """Return it as a WAV file."""
        content = io.BytesIO()
        with wave.open(content, "wb") as audio:
            audio.setnchannels(1)
            audio.setsampwidth(2)
            audio.setframerate(self.rate)
            audio.writeframes(self.samples.astype("<i2").tobytes())
        return content.getvalue()

    def write(self, file: Path) -> None:
        """Write it as a WAV file."""
        file.write_bytes(self.to_bytes())

    def at_rate(self, rate: int) -> Clip:
        """Return the same sound at another rate."""
        if rate == self.rate or not len(self.samples):
            return Clip(self.samples, rate)
        if miniaudio is not None:
            kind = miniaudio.SampleFormat.SIGNED16
            raw = miniaudio.convert_frames(kind, 1, self.rate, self.samples.tobytes(), kind, 1, rate)
            return Clip(np.frombuffer(raw, dtype=np.int16), rate)
        count = len(self.samples) * rate // self.rate
        at = np.arange(count) * (self.rate / rate)
        return Clip(np.interp(at, np.arange(len(self.samples)), self.samples).astype(np.int16), rate)


def _as_16_bit(raw: bytes, width: int) -> Samples:
    if width == 1:
        return (np.frombuffer(raw, dtype=np.uint8).astype(np.int16) - 128) << 8
    if width == 3:  # noqa: PLR2004 - bytes of a sample
        whole = np.frombuffer(raw, dtype=np.uint8).reshape(-1, 3)
        return np.ascontiguousarray(whole[:, 1:]).view("<i2").ravel().astype(np.int16)
    if width == 4:  # noqa: PLR2004 - bytes of a sample
        return (np.frombuffer(raw, dtype="<i4") >> 16).astype(np.int16)
    return np.frombuffer(raw, dtype="<i2").astype(np.int16)


def joined(parts: Sequence[Clip], pause_ms: int = 0) -> Clip:
    """Put clips of one rate one after another, with silence between them."""
    rate = parts[0].rate
    pause = np.zeros(rate * pause_ms // 1000, np.int16)
    pieces = [piece for part in parts for piece in (part.at_rate(rate).samples, pause)]
    return Clip(np.concatenate(pieces[:-1]), rate)


def loudness_steps(clip: Clip) -> tuple[float, ...]:
    """How far the mouth opens, from 0 to 1, at each step of 40 ms."""
    opening = np.clip(np.sqrt((_mouth_steps(clip) ** 2).mean(axis=1)) / FULL_LOUDNESS, 0, 1)
    return tuple(round(float(value), 2) for value in opening)


_SHAPE_LIMITS = ((600.0, "round"), (1500.0, "open"), (3000.0, "wide"))
_CLOSED = 0.06


def mouth_shapes(clip: Clip) -> tuple[str, ...]:
    """Name the mouth's shape at each step of 40 ms: closed, round, open, wide or teeth."""
    steps = _mouth_steps(clip)
    step = steps.shape[1]
    power = np.abs(np.fft.rfft(steps * np.hanning(step), axis=1)) ** 2
    middle = (power * np.fft.rfftfreq(step, 1 / clip.rate)).sum(axis=1) / (power.sum(axis=1) + 1e-12)
    return tuple(
        "closed" if opening < _CLOSED else next((name for limit, name in _SHAPE_LIMITS if centre < limit), "teeth")
        for opening, centre in zip(loudness_steps(clip), middle, strict=True)
    )


def _mouth_steps(clip: Clip) -> NDArray[np.float64]:
    """Return the samples from -1 to 1, a row for each step of the mouth; silence fills the last one."""
    step = clip.rate * LOUDNESS_MS // 1000
    return np.pad(clip.values, (0, -len(clip.samples) % step)).reshape(-1, step)


TARGET_LUFS = -20.0
"""The loudness of every sentence and sound at full volume, by ITU-R BS.1770."""
_PEAK = 0.89
"""No sample is made larger than this, of full scale."""
_BLOCK_S, _STEP_S = 0.4, 0.1
_ABSOLUTE_GATE, _RELATIVE_GATE = -70.0, -10.0
_ONSET_DB, _QUIET_DB = -32.0, -40.0
"""What is so far below a clip's peak is silence, at its beginning and at its end."""
_LEAD_MS, _MARGIN_MS = 3, 20
"""How much of it stays: at the beginning just enough to fade in, for a sentence is to be heard at once."""


def loudness_lufs(clip: Clip) -> float:
    """Measure the integrated loudness in LUFS (ITU-R BS.1770-4, mono); minus infinity for silence.

    The weighting is applied to the spectrum of each block of 400 ms; a shorter clip is one block.
    """
    length = min(len(clip.samples), int(clip.rate * _BLOCK_S))
    if not length:
        return -np.inf
    starts = range(0, len(clip.samples) - length + 1, max(1, int(clip.rate * _STEP_S)))
    values = clip.values
    blocks = np.stack([values[start : start + length] for start in starts])
    power = np.abs(np.fft.rfft(blocks, axis=1)) ** 2 * _k_weight(length, clip.rate)
    power[:, 1:] *= 2
    squares = power.sum(axis=1) / length**2
    with np.errstate(divide="ignore"):
        levels = -0.691 + 10 * np.log10(squares)
        kept = levels > _ABSOLUTE_GATE
        if not kept.any():
            return -np.inf
        relative = -0.691 + 10 * np.log10(squares[kept].mean()) + _RELATIVE_GATE
        return float(-0.691 + 10 * np.log10(squares[kept & (levels > relative)].mean()))


def _k_weight(length: int, rate: int) -> NDArray[np.float64]:
    """Return the squared response of BS.1770's two filters at the frequencies of a spectrum."""
    z = np.exp(-2j * np.pi * np.fft.rfftfreq(length))
    k, q, gain = np.tan(np.pi * 1681.974450955533 / rate), 0.7071752369554196, 10 ** (3.999843853973347 / 20)
    band = gain**0.4996667741545416
    above = (gain + band * k / q + k * k) + 2 * (k * k - gain) * z + (gain - band * k / q + k * k) * z**2
    shelf = above / ((1 + k / q + k * k) + 2 * (k * k - 1) * z + (1 - k / q + k * k) * z**2)
    k, q = np.tan(np.pi * 38.13547087602444 / rate), 0.5003270373238773
    norm = 1 + k / q + k * k
    high = (1 - 2 * z + z**2) / (1 + 2 * (k * k - 1) / norm * z + (1 - k / q + k * k) / norm * z**2)
    weight: NDArray[np.float64] = np.abs(shelf * high) ** 2
    return weight


def levelled(clip: Clip) -> Clip:
    """Bring a clip to the loudness that all have, as far as its peaks allow."""
    loudness = loudness_lufs(clip)
    if not np.isfinite(loudness):
        return clip
    peak = float(np.abs(clip.values).max())
    return Clip.of(clip.values * min(10 ** ((TARGET_LUFS - loudness) / 20), _PEAK / peak), clip.rate)


def trimmed(clip: Clip) -> Clip:
    """Cut silence off both ends, and let the ends fade so that clips join without a click."""
    step = clip.rate // 1000
    frames = np.abs(clip.values[: len(clip.samples) // step * step]).reshape(-1, step).max(axis=1)
    peak = frames.max(initial=0)
    onset, heard = (np.flatnonzero(frames > peak * 10 ** (level / 20)) for level in (_ONSET_DB, _QUIET_DB))
    if not len(onset):
        return Clip(clip.samples[:0], clip.rate)
    lead, margin = (clip.rate * ms // 1000 for ms in (_LEAD_MS, _MARGIN_MS))
    values = clip.values[max(0, onset[0] * step - lead) : (heard[-1] + 1) * step + margin].copy()
    rise, fall = (min(len(values) // 2, clip.rate * ms // 1000) for ms in (_LEAD_MS, FADE_MS))
    values[:rise] *= np.linspace(0, 1, rise)
    values[len(values) - fall :] *= np.linspace(1, 0, fall)
    return Clip.of(values, clip.rate)
