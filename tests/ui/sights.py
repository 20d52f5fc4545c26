"""Faults found on one screen: what a screen reader misses, how texts are written, what overlaps."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QRect
from PySide6.QtGui import QImage
from PySide6.QtQuick import QQuickItem, QQuickWindow

from tests.ui.looking import (
    EXPERIMENTERS,
    background,
    contrast,
    controls,
    identity,
    is_text,
    items,
    lies_in,
    painted,
    place,
    untold,
)

BOARD_SHARE = 0.715
"""How much of a wide window the board and all other screens have; the assistant has the rest."""
ATTRACT_SHARE = 0.64
"""The same of the attract screen, whose assistant is larger."""
OVER_EVERYTHING = ("CalmCard", *EXPERIMENTERS)


@dataclass(frozen=True)
class Written:
    """One text as it stands on a screen of 1080 lines."""

    words: str
    pixels: int
    contrast: float
    for_experimenters: bool


@dataclass(frozen=True)
class Sight:
    """What was found on one screen."""

    moment: str
    untold: tuple[str, ...]
    written: tuple[Written, ...]
    strayed: tuple[str, ...]
    """What lies on the wrong side of the window."""
    covered: tuple[str, ...]
    """Texts on which a bar lies that scrolls."""


def look(window: QQuickWindow, moment: str, side: str) -> Sight:
    """Look closely at what stands there."""
    picture = window.grabWindow()
    every = list(items(window.contentItem()))
    controlling = controls(every)
    bars = _bars(every)
    shown = [text for text in every if is_text(text)]
    in_front = _in_front(shown, [item for item in every if _covers(item)])
    share = ATTRACT_SHARE if moment.startswith("attract") else BOARD_SHARE
    return Sight(
        moment,
        tuple(untold(window, every, controlling)),
        tuple(_written(picture, text) for text in in_front if not painted(text).isEmpty()),
        tuple(_name(item) for item in _laid_out(every, controlling) if _is_astray(window, item, side, share)),
        tuple(_name(text) for text in in_front if any(bar.intersects(painted(text)) for bar in bars)),
    )


def _in_front(shown: Sequence[QQuickItem], over: Sequence[QQuickItem]) -> list[QQuickItem]:
    """Return the texts over which nothing lies: the rest steps back by intent."""
    covered = [place(item) for item in over]
    if not any(item.objectName() == "panel" or lies_in(item, "CalmCard") for item in over):
        return [
            text
            for text in shown
            if lies_in(text, *OVER_EVERYTHING) or not any(each.intersects(painted(text)) for each in covered)
        ]
    card = next((place(item) for item in over if item.objectName() == "pin-card"), None)
    return [
        text
        for text in shown
        if lies_in(text, *OVER_EVERYTHING)
        and (card is None or lies_in(text, "PinCard") or not card.intersects(painted(text)))
    ]


def _covers(item: QQuickItem) -> bool:
    return item.objectName() in {"panel", "pin-card", "experimenter-note"} or (
        item.metaObject().className().startswith("CalmCard")
    )


def _written(picture: QImage, text: QQuickItem) -> Written:
    color, paper = text.property("color"), background(picture, painted(text))
    return Written(
        str(text.property("text")),
        text.property("font").pixelSize(),
        round(contrast(color, paper), 2),
        lies_in(text, *EXPERIMENTERS),
    )


def _laid_out(every: Iterable[QQuickItem], controlling: set[int]) -> Iterator[QQuickItem]:
    """Yield the texts and controls of a visitor's screen, and the assistant's bubble."""
    for item in every:
        if (item.inherits("QQuickText") or identity(item) in controlling) and not lies_in(item, *OVER_EVERYTHING):
            yield item


def _bars(every: Sequence[QQuickItem]) -> list[QRect]:
    """Return where the bars are that can be seen; a number's keys stand over the page, and over its bar."""
    found = [place(item) for item in every if item.inherits("QQuickScrollBar")]
    keys = [place(item) for item in every if item.metaObject().className().startswith("ScreenKeyboard")]
    return [bar for bar in found if not any(over.contains(bar.center()) for over in keys)]


def _is_astray(window: QQuickWindow, item: QQuickItem, side: str, share: float) -> bool:
    """Whether the middle of an item is not on its side: screens where the board is, the assistant on the other."""
    across = place(item).center().x() / window.width()
    from_the_board = across if side == "left" else 1 - across
    # The keys of a number stand in the assistant's place, as does a ticket, and those of letters below the page.
    return not lies_in(item, "ScreenKeyboard") and (
        (from_the_board > share) is not lies_in(item, "SidePanel", "Corner", "Ticket")
    )


def _name(item: QQuickItem) -> str:
    return f"{item.objectName()} {item.property('text') or ''}".strip()
