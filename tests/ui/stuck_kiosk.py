"""``recollect`` with something wrong at the first card: ``python -m tests.ui.stuck_kiosk WRONG`` and its arguments."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from unittest.mock import patch

from PySide6.QtCore import QMetaObject
from PySide6.QtQml import QJSEngine, QQmlComponent, QQmlEngine

from kiosk.cli.main import main
from kiosk.supervisor import Limits, guarded

QUICK = Limits(silence=1, stuck=0.5)

ENDLESS = b"""
import QtQml
Timer {
    interval: 1
    onTriggered: { console.log("stuck"); for (;;) {} }
}
"""


def fault(*_: object) -> None:
    """Raise a fault of ours."""
    raise KeyError("unicorn")


def with_pythons_lock(*_: object) -> None:
    """Evaluate a binding without an end from Python, which waits for it."""
    engine = QJSEngine()
    engine.installExtensions(QJSEngine.Extension.ConsoleExtension)
    beats[-1]()
    engine.evaluate("console.log('stuck'); for (;;) {}")


def without_pythons_lock(*_: object) -> None:
    """Evaluate the same out of Qt's own event loop."""
    kept.append(engine := QQmlEngine())
    kept.append(component := QQmlComponent(engine))
    component.setData(ENDLESS, "")
    kept.append(timer := component.create())
    beats[-1]()
    QMetaObject.invokeMethod(timer, "start")


@contextmanager
def heard(limits: Limits) -> Iterator[Callable[[], None]]:
    """Guard this process, and keep its sign of life: the first card may be turned before the first one is due."""
    with guarded(limits) as beat:
        beats.append(beat)
        yield beat


beats: list[Callable[[], None]] = []
kept: list[object] = []
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
