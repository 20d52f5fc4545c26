"""The first picture on the screen, shown while the rest of the kiosk is loaded.

It needs little of Qt, nothing of Qt Quick, and no settings. The kiosk's own window comes above it.
"""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QGuiApplication, QIcon, QPainter, QPaintEvent, QRasterWindow

from kiosk.files import open_to_read
from kiosk.places import ASSETS
from kiosk.ui.qt_platform import draw_in_software, numbered_screens

PAPER = "#FBF6EC"
"""The background of a study that names none."""
WHITE = "#FFFFFF"
"""The background with high contrast."""

_ICON = ASSETS / "icon.svg"
_ICON_PART = 6
"""The icon takes one in so many of the shorter side."""
_DEADLINE_S = 1.0
"""How long to wait for the screen; then the kiosk goes on loading."""
_MOST_BYTES = 1_000_000
"""A larger file is no study file."""
_MATTERS = re.compile(r"\s*(display|background|contrast|name|logo)\s*=")


@dataclass(frozen=True)
class Look:
    """How the picture looks, and on which screen."""

    display: int = 0
    background: str = PAPER
    icon: bool = True
    """Whether it has the icon of Recollect; a study with a name or a logo of its own has not."""


def look_of(study: Path | None) -> Look:
    """Return what a study file says of the look.

    Whatever is wrong in the file is found when it is read as a whole.
    """
    if study is None:
        return Look()
    # A packed study has what belongs to this kiosk in a file beside it.
    file = study if study.suffix == ".toml" else study.with_suffix(".local.toml")
    import tomllib  # noqa: PLC0415 - without a study file there is nothing to read

    told: dict[str, Any] = {}
    with suppress(OSError, ValueError, RecursionError), open_to_read(file) as opened:
        told = tomllib.loads("\n".join(_about_the_look(opened.read(_MOST_BYTES).decode("utf-8-sig"))))
    screen, look = _table(told, "screen"), _table(told, "look")
    display, background = screen.get("display"), look.get("background")
    if not (isinstance(background, str) and QColor.isValidColorName(background)):
        background = PAPER
    return Look(
        display if isinstance(display, int) else 0,
        WHITE if screen.get("contrast") == "high" else background,
        icon=file is study and not (look.get("name") or look.get("logo")),
    )


def _about_the_look(text: str) -> Iterator[str]:
    """Yield the lines that matter here: others can take long to be parsed."""
    inside = False
    for line in text.splitlines():
        if line.lstrip().startswith("["):
            inside = line.partition("#")[0].strip() in {"[screen]", "[look]"}
            if inside:
                yield line
        elif inside and _MATTERS.match(line):
            yield line


def _table(told: dict[str, Any], name: str) -> dict[str, Any]:
    found = told.get(name)
    return found if isinstance(found, dict) else {}


class Splash(QRasterWindow):
    """The window with the picture."""

    def __init__(self, look: Look) -> None:
        """Make it; it is not shown yet."""
        super().__init__()
        self._look = look
        self.painted = False
        """Whether the picture has been on the screen."""

    def paintEvent(self, _: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Paint the background and the icon."""
        everything = QRect(0, 0, self.width(), self.height())
        painter = QPainter(self)
        painter.fillRect(everything, QColor(self._look.background))
        if self._look.icon:
            side = min(self.width(), self.height()) // _ICON_PART
            place = QRect(0, 0, side, side)
            place.moveCenter(everything.center())
            QIcon(str(_ICON)).paint(painter, place)
        painter.end()
        self.painted = True


def show(look: Look) -> Splash:
    """Cover the screen, and return the window once its picture is there."""
    draw_in_software()
    existing = QGuiApplication.instance()
    application = existing if isinstance(existing, QGuiApplication) else QGuiApplication(["recollect"])
    splash = Splash(look)
    screens = numbered_screens()
    screen = screens[look.display] if 0 <= look.display < len(screens) else screens[0]
    # The focus is for the kiosk's own window, which also stays above this one.
    splash.setFlags(Qt.WindowType.FramelessWindowHint | Qt.WindowType.WindowDoesNotAcceptFocus)
    splash.setScreen(screen)
    splash.setGeometry(screen.geometry())
    # Not showFullScreen, which asks for the focus.
    splash.setWindowStates(Qt.WindowState.WindowFullScreen)
    splash.setVisible(True)
    until = time.monotonic() + _DEADLINE_S
    while not splash.painted and time.monotonic() < until:
        application.processEvents()
    return splash


@contextmanager
def startup_splash(look: Look) -> Iterator[Splash]:
    """Cover the screen until the window is hidden, or at the latest until this ends."""
    splash = show(look)
    try:
        yield splash
    finally:
        splash.hide()
        splash.deleteLater()
