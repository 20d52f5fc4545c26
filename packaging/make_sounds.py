"""Makes the short sounds of the game, ``assets/sounds/*.wav``, out of sums of sines; run it without arguments.

Quiet on purpose: at their loudest a tenth of full scale, so that they stay below the voice.
"""

from __future__ import annotations

import wave
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

FOLDER = Path(__file__).resolve().parent.parent / "assets" / "sounds"
RATE = 22_050
LOUDEST = 0.1

Samples = NDArray[np.float64]

SOUNDS: dict[str, tuple[tuple[float, float, float], ...]] = {
    "flip": ((1200, 0.0, 0.04),),
    "match": ((659.3, 0.0, 0.22), (987.8, 0.08, 0.3)),
    "miss": ((311.1, 0.0, 0.18), (261.6, 0.1, 0.26)),
    "end": ((523.3, 0.0, 0.3), (659.3, 0.12, 0.3), (784.0, 0.24, 0.3), (1046.5, 0.36, 0.6)),
}
"""For each sound its notes: frequency in Hz, beginning and length in seconds."""


def note(frequency: float, length: float) -> Samples:
    """Return a soft stroke: a sine and a little of its octave, at once there and fading away."""
    time = np.arange(int(RATE * length)) / RATE
    tone = np.sin(2 * np.pi * frequency * time) + 0.25 * np.sin(4 * np.pi * frequency * time)
    fade: Samples = np.minimum(time / 0.004, 1) * np.exp(-5 * time / length)
    faded: Samples = tone * fade
    return faded


def sound(notes: tuple[tuple[float, float, float], ...]) -> Samples:
    """All notes of a sound, with a moment of silence behind them."""
    mixed = np.zeros(int(RATE * (max(begin + length for _, begin, length in notes) + 0.02)))
    for frequency, begin, length in notes:
        tone = note(frequency, length)
        mixed[int(RATE * begin) :][: len(tone)] += tone
    scaled: Samples = mixed / np.abs(mixed).max() * LOUDEST
    return scaled


def main() -> None:
    """Write them all."""
    FOLDER.mkdir(exist_ok=True)
    for name, notes in SOUNDS.items():
        with wave.open(str(FOLDER / f"{name}.wav"), "wb") as file:
            file.setparams((1, 2, RATE, 0, "NONE", ""))
            file.writeframes((sound(notes) * 2**15).astype("<i2").tobytes())


if __name__ == "__main__":
    main()
