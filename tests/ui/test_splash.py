"""The calm window: readable in every language, and gone when the supervisor ends."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtQml import QQmlApplicationEngine
from PySide6.QtQuick import QQuickItem, QQuickWindow
from pytestqt.qtbot import QtBot

from kiosk import program
from kiosk.assistance.wording import Catalogue
from kiosk.cli.options import shipped_languages
from kiosk.config import ASSETS
from kiosk.sd_notify import NotifySocketListener
from kiosk.ui.simulated_visitor import lay_out
from kiosk.ui.splash import _window
from tests.patience import started

LONG = 20.0
"""Seconds; nothing here takes as long unless it fails."""

LINES = [Catalogue(ASSETS / "sentences" / language).text("splash-line") for language in shipped_languages()]


def texts(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every text in an item."""
    if item.property("truncated") is not None:
        yield item
    for child in item.childItems():
        yield from texts(child)


@pytest.mark.parametrize("size", [(1280, 720), (1920, 1080), (1080, 1920)])
def test_every_language_says_it_and_nothing_is_cut_off(qtbot: QtBot, size: tuple[int, int]) -> None:
    engine = QQmlApplicationEngine()
    window: QQuickWindow = _window(engine, LINES)
    window.setGeometry(0, 0, *size)
    qtbot.waitUntil(window.isExposed)
    lay_out(window)
    shown = list(texts(window.contentItem()))
    assert [text.property("text") for text in shown] == LINES
    inside = QRectF(0, 0, *size)
    for text in shown:
        assert inside.contains(text.mapRectToScene(QRectF(0, 0, text.width(), text.height())))
    assert window.close() is False
    window.destroy()


@pytest.mark.skipif(sys.platform == "win32", reason="there are no Unix sockets")
def test_it_tells_when_it_is_there_and_goes_with_whoever_listens(tmp_path: Path) -> None:
    listener = NotifySocketListener(tmp_path)
    with started(program("_splash"), env=os.environ | listener.environment) as window:
        assert listener.hear(LONG) == {"READY": "1"}
        listener.close()
        assert window.wait(LONG) == 0
