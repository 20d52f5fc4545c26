"""A program that has sessions written and never ended: a test kills the writing process in the middle.

It reads folders, one a line, and forks a writer for each, which saves loading everything anew. The writer prints its
process number, then, after every batch of events, how many have been acknowledged; ``gone`` says that it is dead.
"""

from __future__ import annotations

import os
import sys
from itertools import count
from pathlib import Path

from kiosk.experiment.events import CardSelected, CardSelectionRejected, SessionStarted
from kiosk.experiment.outcomes import SessionKind
from kiosk.game import Position
from kiosk.store.recorder import Provenance, Recorder
from tests.samples import plan

GONE = "gone"


def main() -> None:
    """Fork a writer for every folder that is named."""
    for line in sys.stdin:
        writer = os.fork()
        if writer == 0:
            write(Path(line.rstrip("\n")))
        os.waitpid(writer, 0)
        say(GONE)


def write(folder: Path) -> None:
    """Begin a session and write on and on."""
    say(os.getpid())
    with Recorder(folder) as recorder:
        recorder.begin(Provenance(plan(), 1, "avatar", "abc123", kind=SessionKind.SIMULATED), [SessionStarted(at_ms=0)])
        say(1)
        for number in count(1):
            position = Position(number, number)
            recorder.append(
                [
                    CardSelected(at_ms=number, position=position),
                    CardSelectionRejected(at_ms=number, position=position, why=None),
                ]
            )
            say(1 + 2 * number)


def say(what: object) -> None:
    """Print it at once."""
    sys.stdout.write(f"{what}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
