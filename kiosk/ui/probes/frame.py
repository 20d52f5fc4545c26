"""How long the software renderer takes for a whole frame of the kiosk, drawn where nobody sees it."""

from __future__ import annotations

from collections.abc import Iterator
from time import perf_counter

from PySide6.QtCore import QEventLoop

from kiosk.findings import Finding
from kiosk.study.plan import Study
from kiosk.ui.qt_platform import obstacle
from kiosk.ui.window import Display, Mode, Pace, Window

WHAT = "drawing"

WIDTH, HEIGHT = 1920, 1080
FRAMES = 8
_FADED = 0.99
SLOW_MS = 50.0
"""A screen that fades draws all of itself again and again; at less than 20 a second that is seen as steps."""


def frame(study: Study) -> Iterator[Finding]:
    """Open the kiosk's window off the screen, and draw its first page several times."""
    found = obstacle()
    if found is not None and not found.of_the_screen:
        yield Finding.bad(WHAT, found.words, found.remedy)
        return
    window = Window(study, Mode(Display.NOWHERE, Pace.VIRTUAL))
    try:
        window.shown.setWidth(WIDTH)
        window.shown.setHeight(HEIGHT)
        window.show()
        QEventLoop().processEvents()
        times = sorted(_drawn_ms(window, opacity) for opacity in (_FADED, 1.0) * (FRAMES // 2))
    finally:
        window.close()
    yield told(times[len(times) // 2])


def told(usual_ms: float) -> Finding:
    """What it means that a frame takes so long."""
    words = f"a whole frame of {WIDTH} x {HEIGHT} takes {usual_ms:.0f} ms without a graphics card"
    if usual_ms > SLOW_MS:
        return Finding.warning(WHAT, words, "end other programs, or set screen.motion to false")
    return Finding.good(WHAT, words)


def _drawn_ms(window: Window, opacity: float) -> float:
    """Change everything a little: what has not changed is not drawn again."""
    window.shown.contentItem().setOpacity(opacity)
    begun = perf_counter()
    window.shown.grabWindow()
    return (perf_counter() - begun) * 1000
