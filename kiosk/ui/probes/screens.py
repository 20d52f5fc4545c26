"""The screens, the window manager, and whether the screen can be kept lit; no window is shown for it.

Run in a process of its own: where Qt finds no screen it ends the process.
"""

from __future__ import annotations

from collections.abc import Iterator
from time import monotonic

from PySide6.QtCore import QEventLoop
from PySide6.QtGui import QGuiApplication, QScreen

from kiosk.findings import Finding
from kiosk.ui.booth.awake import Awake
from kiosk.ui.booth.full_screen import numbered_screens
from kiosk.ui.booth.ways import ANSWER_MS, ways
from kiosk.ui.qt_platform import obstacle
from kiosk.units import MS_PER_SECOND

DISPLAY, DESKTOP, LIT = "screen", "desktop", "kept lit"

LEAST_HIGH, LEAST_WIDE = 720, 1280
"""The smallest screen, lying or standing, that every page is tried on."""

_TICK_MS = 20
_PLUG_IN = "plug one in, and run this in the booth's own session"


def screens(number: int) -> Iterator[Finding]:
    """Everything about the screen of a number and what surrounds it."""
    found = obstacle()
    if found is not None:
        yield Finding.bad(DISPLAY, found.words, _PLUG_IN if found.of_the_screen else found.remedy)
        return
    application = QGuiApplication.instance() or QGuiApplication(["recollect"])
    yield screen(numbered_screens(), number)
    yield Finding.good(DESKTOP, f"{QGuiApplication.platformName()}, {_window_manager()}")
    yield _lit()
    del application


def screen(there: list[QScreen], number: int) -> Finding:
    """The screen that the kiosk will cover."""
    if number >= len(there):
        words = f"there is no screen {number}, so the kiosk covers the primary one; there are {len(there)}"
        return Finding.warning(DISPLAY, words, "plug it in, or change screen.number in the study file")
    size, ratio = there[number].size(), there[number].devicePixelRatio()
    words = f"{size.width()} x {size.height()}, {ratio:g} device pixels each, {len(there)} in all"
    if min(size.width(), size.height()) < LEAST_HIGH or max(size.width(), size.height()) < LEAST_WIDE:
        remedy = f"use one of at least {LEAST_WIDE} x {LEAST_HIGH}: texts may not fit on it"
        return Finding.warning(DISPLAY, words, remedy)
    return Finding.good(DISPLAY, words)


def _window_manager() -> str:
    if QGuiApplication.platformName() != "xcb":
        return "which places the windows itself"
    from kiosk.ui.booth.x_server import window_manager  # noqa: PLC0415 - only where there is an X server

    name = window_manager()
    return f"windows are placed by {name}" if name else "nobody places the windows, so the kiosk does"


def _lit() -> Finding:
    """Ask all that can hold off the screen saver, wait for an answer, and take it back."""
    awake = Awake(ways())
    end = monotonic() + ANSWER_MS / MS_PER_SECOND
    loop = QEventLoop()
    while not awake.health.well and monotonic() < end:
        loop.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, _TICK_MS)
    health = awake.health
    awake.release()
    if health.well:
        return Finding.good(LIT, health.words)
    return Finding.warning(LIT, health.words, "switch screen saver and sleep off in the system's settings")
