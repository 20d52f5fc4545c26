"""``recollect`` with something wrong at the first card: ``python -m tests.ui.stuck_kiosk WRONG`` and its arguments."""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from unittest.mock import patch

from PySide6.QtCore import QTimer

from kiosk.cli.main import main
from kiosk.guard import Limits, guarded

QUICK = Limits(silence=1, stuck=0.5)
LARGER_THAN_A_MUTEX = 256
"""Bytes."""


def fault(*_: object) -> None:
    """Raise a fault of ours."""
    raise KeyError("unicorn")


def with_pythons_lock(*_: object) -> None:
    """Wait without an end, as a binding that never comes to its end lets Python wait."""
    wait_for_ever(ctypes.PyDLL(None))


def without_pythons_lock(*_: object) -> None:
    """Wait without an end where other threads of Python can go on."""
    QTimer.singleShot(0, lambda: wait_for_ever(ctypes.CDLL(None)))


def wait_for_ever(library: ctypes.CDLL) -> None:
    """Lock a mutex twice, which no signal ends, and which takes no processor from the other tests."""
    mutex = ctypes.create_string_buffer(LARGER_THAN_A_MUTEX)
    library.pthread_mutex_init(mutex, None)
    beats[-1]()
    os.write(2, b"stuck\n")
    for _ in range(2):
        library.pthread_mutex_lock(mutex)


@contextmanager
def heard(limits: Limits) -> Iterator[Callable[[], None]]:
    """Guard this process, and keep its sign of life: the first card may be turned before the first one is due."""
    with guarded(limits) as beat:
        beats.append(beat)
        yield beat


beats: list[Callable[[], None]] = []
WRONG: dict[str, Callable[..., None]] = {
    "fault": fault,
    "with lock": with_pythons_lock,
    "without lock": without_pythons_lock,
}

if __name__ == "__main__":
    wrong = WRONG[sys.argv.pop(1)]
    limits = Limits(silence=60, stuck=0.2) if "--slowly" in sys.argv else QUICK
    sys.argv = [argument for argument in sys.argv if argument != "--slowly"]
    with (
        patch("kiosk.ui.screens.board.BoardScreen.reveal", wrong),
        patch("kiosk.cli.rehearse.guarded", partial(heard, limits)),
    ):
        main()
