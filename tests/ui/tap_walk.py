"""Counts the functions that carry a tap on a card to its pixel, and to the mark of its hint.

``walks`` plays with the mouse until a tap leads to a hint, and watches every call with ``sys.setprofile``. A hop is a
function of ``kiosk/`` that is on the way: it is on the stack when an effect is concluded, when it is written to the
database, or when it reaches the screen, the voice or the clock. A function counts once for each event, however often
it is called. Generated constructors, and the clock that stands in for Qt's timers, are not counted.

``python -m tests.ui.tap_walk`` writes the walk into docs/explanation/how-it-works.md.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from types import CodeType, FrameType
from typing import Any
from unittest.mock import patch

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("QT_QUICK_BACKEND", "software")

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from kiosk.experiment import effects as do
from kiosk.experiment.events import Timer
from kiosk.ui.app import App
from kiosk.ui.event_loop import VirtualClock
from kiosk.ui.simulated_visitor import find_item, item_centre, lay_out
from kiosk.ui.voice import SilentVoice
from tests.ui.headless import headless, short

PAGE = Path(__file__).parent.parent.parent / "docs" / "explanation" / "how-it-works.md"
KIOSK = Path(do.__file__).parent.parent
_NOT_ON_THE_WAY = {"VirtualClock.jump", "VirtualClock._end"}
_OF_A_FUNCTION = {"<genexpr>", "<listcomp>", "<dictcomp>", "<setcomp>"}


@dataclass(frozen=True)
class Hop:
    """One function of the kiosk."""

    file: str
    name: str

    @classmethod
    def of(cls, code: CodeType) -> Hop | None:
        """Return the function of a code object; None if it is not one of the kiosk's, or not on the way."""
        path = Path(code.co_filename)
        if KIOSK not in path.parents or code.co_name in _OF_A_FUNCTION or code.co_qualname in _NOT_ON_THE_WAY:
            return None
        return cls(path.relative_to(KIOSK.parent).as_posix(), code.co_qualname.replace(".<locals>", ""))


@dataclass
class Leg:
    """One event on its way to one effect."""

    effect: str
    arrives_in: str
    """The last function before Qt, the voice or the system takes over."""
    hops: list[Hop] = field(default_factory=list)

    def add(self, frame: FrameType | None) -> None:
        """Add everything that is on this stack."""
        stack: list[Hop] = []
        while frame is not None:
            hop = Hop.of(frame.f_code)
            if hop is not None:
                stack.insert(0, hop)
            frame = frame.f_back
        self.hops += [hop for hop in dict.fromkeys(stack) if hop not in self.hops]


class Watch:
    """Watches for one effect after another, each from the event that leads to it until it has arrived."""

    def __init__(self, *legs: Leg) -> None:
        self.legs = legs
        self._left = list(legs)
        self._concluded = False

    @property
    def over(self) -> bool:
        """Whether the last effect has arrived."""
        return not self._left

    @property
    def hops(self) -> int:
        """How many hops there are on all legs together."""
        return sum(len(leg.hops) for leg in self.legs)

    def see(self, frame: FrameType, event: str, arg: Any) -> None:
        """Take one call from the interpreter."""
        if self.over:
            return
        leg = self._left[0]
        if event == "c_call" and self._concluded and getattr(arg, "__name__", "") == "executemany":
            leg.add(frame)
        elif event == "call" and _constructs(frame, leg.effect):
            self._concluded = True
            leg.add(frame.f_back)
        elif event == "call" and self._concluded and frame.f_code.co_qualname == leg.arrives_in:
            leg.add(frame)
            self._left.pop(0)
            self._concluded = False


def _constructs(frame: FrameType, effect: str) -> bool:
    """Whether this is the call of the effect's constructor; of all timers only the mark's is meant."""
    if (frame.f_code.co_filename, frame.f_code.co_name) != ("<string>", "__init__"):
        return False
    if frame.f_locals.get("timer") not in (None, Timer.MARK):
        return False
    return type(frame.f_locals["self"]).__name__ == effect


@contextmanager
def _watching(*watches: Watch) -> Iterator[None]:
    def see(frame: FrameType, event: str, arg: Any) -> None:
        for watch in watches:
            watch.see(frame, event, arg)

    before = sys.getprofile()
    sys.setprofile(see)
    try:
        yield
    finally:
        sys.setprofile(before)


class LateVoice(SilentVoice):
    """A silent voice that begins a little after it was asked to, as one with a sound does."""

    def say(self, number: int, sentence: str) -> None:
        """Begin soon."""
        self.stop()
        self._wait = self._clock.after(self.MS_PER_CHARACTER * len(sentence), lambda: self.finished.emit(number))
        self._clock.after(40, lambda: self.started.emit(number, []))


def walks() -> tuple[Watch, Watch]:
    """Return the walk of a tap to its pixel, and that of the same tap to the mark of its hint."""
    late, data = patch("kiosk.ui.app.SilentVoice", LateVoice), TemporaryDirectory()
    with late, data as folder, headless(short(), Path(folder)) as app:
        _click(app, "start-en")
        _click(app, "continue")
        while True:
            pixel = Watch(Leg("RevealCard", "BoardScreen.data"))
            mark = Watch(
                Leg("Speak", "AvatarBody.say"),
                Leg("StartTimer", "VirtualClock.after"),
                Leg("HighlightHint", "BoardScreen.markRow"),
            )
            _tap(app, pixel, mark)
            if pixel.over and mark.over:
                return pixel, mark


def _tap(app: App, *watches: Watch) -> None:
    """Tap the first closed card, and let time pass until the next one can be tapped; draw what is to be seen."""
    board = app.screens.board
    card = f"card-{board.location(board.closed[0])}"
    with _watching(*watches):
        _click(app, card)
        app.window.grabWindow()
        while not board.accepts_taps:
            _jump(app)
        app.window.grabWindow()


def _click(app: App, name: str) -> None:
    while not app.screens.kiosk.takes_input:
        _jump(app)
    lay_out(app.window)
    item = find_item(app.window.contentItem(), name)
    assert item is not None, name
    left, none = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    QTest.mouseClick(app.window, left, none, item_centre(item))


def _jump(app: App) -> None:
    assert isinstance(app.clock, VirtualClock)
    app.clock.jump()


_ARRIVALS = {
    "RevealCard": "the card's new picture is on the screen",
    "Speak": "the voice, a process of its own, has the sentence",
    "StartTimer": "the voice has begun, and the mark is due",
    "HighlightHint": "the mark is on the screen",
}


def section(pixel: Watch, mark: Watch) -> str:
    """Return the walk as it stands in the documentation."""
    lines = [f"To its pixel, {pixel.hops} hops:", ""]
    lines += _listed(pixel.legs[0])
    lines += ["", f"To the mark of its hint, {mark.hops} hops: the same tap, then the voice, then a timer.", ""]
    for leg in mark.legs:
        lines += [*_listed(leg), ""]
    return "\n".join(lines).rstrip() + "\n"


def _listed(leg: Leg) -> list[str]:
    lines = [f"{number}. `{hop.name}` ({hop.file})" for number, hop in enumerate(leg.hops, 1)]
    return [*lines[:-1], f"{lines[-1]}: {_ARRIVALS[leg.effect]}"]


def main() -> None:
    """Write the walk into the documentation."""
    application = QGuiApplication(sys.argv)
    written = section(*walks())
    text = re.sub(
        r"<!-- walk -->\n.*<!-- /walk -->",
        f"<!-- walk -->\n{written}<!-- /walk -->",
        PAGE.read_text("utf-8"),
        flags=re.DOTALL,
    )
    PAGE.write_text(text, "utf-8")
    del application
    sys.stdout.write(written)


if __name__ == "__main__":
    main()
