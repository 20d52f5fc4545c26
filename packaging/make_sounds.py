"""Makes the short sounds of the game, ``assets/sounds/*.wav``: run it without arguments, with Recollect installed.

Each note is a struck bar of wood: a few partials that die away, the higher ones sooner, behind a soft mallet. All are
brought to the loudness of the voice, and the same numbers come out each time.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from kiosk.robots.clips import Clip, levelled, loudness_lufs

FOLDER = Path(__file__).resolve().parent.parent / "assets" / "sounds"
RATE = 22_050

Samples = NDArray[np.float64]

PARTIALS = ((1.0, 1.0, 1.0), (2.0, 0.18, 0.7), (3.98, 0.22, 0.3), (9.2, 0.03, 0.12))
"""Of a bar that is tuned as a marimba's: times the note's frequency, strength, and times its length."""
ROOM = ((0.019, 0.22), (0.031, 0.16), (0.047, 0.11), (0.071, 0.07))
"""Echoes of a small room: seconds later, and how strong."""


@dataclass(frozen=True)
class Note:
    """A stroke: frequency in Hz, beginning, the time in which it fades to a twentieth, and the mallet, in seconds."""

    hertz: float
    at: float
    fades: float
    strength: float = 1.0
    mallet: float = 0.006


C4, E4, G4, A4, C5, D5, E5, G5, C6, E6 = (
    261.63, 329.63, 392.0, 440.0, 523.25, 587.33, 659.26, 783.99, 1046.5, 1318.51,
)  # fmt: skip

SOUNDS: dict[str, tuple[Note, ...]] = {
    "flip": (Note(E5, 0.0, 0.07, mallet=0.004), Note(C4, 0.0, 0.05, 0.6, mallet=0.004)),
    "match": (Note(G4, 0.0, 0.35), Note(C5, 0.09, 0.4), Note(E5, 0.18, 0.5, 1.1)),
    # Two soft notes that sink by a whole tone: "not this time", and no more.
    "miss": (Note(E4, 0.0, 0.25, mallet=0.02), Note(D5 / 2, 0.15, 0.35, 0.9, mallet=0.025)),
    "end": (
        *(Note(hertz, 0.1 * number, 0.5) for number, hertz in enumerate((C4, E4, G4, C5, E5, G5))),
        *(Note(hertz, 0.68, 1.0, 0.8) for hertz in (C4, G4, E5, C6)),
        Note(G5, 0.86, 0.6, 0.4),
        Note(E6, 0.98, 0.6, 0.35),
    ),
    "nudge": (Note(A4 / 2, 0.0, 0.09, mallet=0.012), Note(G4 / 2, 0.09, 0.11, 0.9, mallet=0.012)),
    "button": (Note(C5, 0.0, 0.09), Note(G4, 0.0, 0.08, 0.5)),
    # Twice a falling fourth, as at a counter: like nothing that the game plays.
    "alarm": (Note(C5, 0.0, 0.2), Note(G4, 0.13, 0.2), Note(C5, 0.34, 0.2), Note(G4, 0.47, 0.25)),
}
"""For each sound its notes."""


def stroke(note: Note) -> Samples:
    """Return one note, until it cannot be heard."""
    time = np.arange(int(RATE * note.fades * 2)) / RATE
    tone = np.zeros_like(time)
    for times, strength, lasts in PARTIALS:
        if times * note.hertz < RATE / 2:
            tone += strength * np.sin(2 * np.pi * times * note.hertz * time) * np.exp(-3 * time / (note.fades * lasts))
    attack = 0.5 - 0.5 * np.cos(np.pi * np.minimum(time / note.mallet, 1))
    struck: Samples = note.strength * tone * attack
    return struck


def sound(notes: Iterable[Note]) -> Clip:
    """Return all notes of a sound in their room, fading out, at the loudness that all sounds have."""
    mixed = np.zeros(RATE * 4)
    for note in notes:
        tone = stroke(note)
        for later, strength in ((0.0, 1.0), *ROOM):
            mixed[int(RATE * (note.at + later)) :][: len(tone)] += strength * tone
    heard = np.flatnonzero(np.abs(mixed) > np.abs(mixed).max() * 0.01)
    dry = mixed[: heard[-1]]
    tail = min(len(dry) // 3, RATE // 20)
    dry[len(dry) - tail :] *= 0.5 + 0.5 * np.cos(np.pi * np.arange(tail) / tail)
    return levelled(Clip.of(0.5 * dry / np.abs(dry).max(), RATE))


def main() -> None:
    """Write them all, and say how long and how loud each is."""
    FOLDER.mkdir(exist_ok=True)
    for name, notes in SOUNDS.items():
        clip = sound(notes)
        clip.write(FOLDER / f"{name}.wav")
        peak = np.abs(clip.values).max()
        sys.stdout.write(f"{name:8}{clip.duration_ms:5} ms {loudness_lufs(clip):6.1f} LUFS, peak {peak:.2f}\n")


if __name__ == "__main__":
    main()
