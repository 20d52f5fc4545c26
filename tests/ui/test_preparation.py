"""What a start leaves out is done afterwards, a step at a time."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer
from pytestqt.qtbot import QtBot

from kiosk.ui.preparation import Preparation


def test_other_events_come_between_the_steps(qtbot: QtBot) -> None:
    happened: list[str] = []
    owner = QObject()

    def step() -> None:
        happened.append("step")
        QTimer.singleShot(0, owner, lambda: happened.append("event"))

    preparation = Preparation(owner, [step, step])
    assert happened == []
    qtbot.waitUntil(lambda: preparation.done)
    assert happened == ["step", "event", "step", "event"]
