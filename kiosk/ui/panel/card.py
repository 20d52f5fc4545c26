"""What lies over the visitor's screen when the experimenter does something: a small card, or a note at the edge.

Neither says what it is about: whoever sits in front of it learns nothing of the study.
"""

from __future__ import annotations

from enum import Enum

from PySide6.QtCore import Property, QObject, Signal, Slot
from PySide6.QtQml import QmlElement

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1


class Step(Enum):
    """What the card asks for."""

    NOTHING = ""
    PIN = "pin"
    WAIT = "wait"
    """A wrong PIN came; nobody may try again yet."""
    REASON = "reason"
    WORDS = "words"
    """The reason is none of the list."""


@QmlElement
class CardScreen(QObject):
    """The card that asks for the PIN and the reason."""

    changed = Signal()
    typed = Signal(str)
    erased = Signal()
    entered = Signal()
    cancelled = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._step = Step.NOTHING
        self._title = self._line = self._text = ""
        self._reasons: list[str] = []

    def show(self, step: Step, title: str, line: str = "", text: str = "", reasons: tuple[str, ...] = ()) -> None:
        """Ask for something; ``text`` is what was typed so far, as it may be seen."""
        self._step, self._title, self._line, self._text, self._reasons = step, title, line, text, list(reasons)
        self.changed.emit()

    def hide(self) -> None:
        """Go away, with nothing left of what was typed."""
        self.show(Step.NOTHING, "")

    @property
    def asks_for(self) -> Step:
        """What the card asks for now."""
        return self._step

    @Property(str, notify=changed)
    def step(self) -> str:
        """What it asks for: pin, wait, reason, words; nothing while it is away."""
        return self._step.value

    @Property(str, notify=changed)
    def title(self) -> str:
        """What is wanted, in a word."""
        return self._title

    @Property(str, notify=changed)
    def line(self) -> str:
        """How to go on, in a sentence."""
        return self._line

    @Property(str, notify=changed)
    def text(self) -> str:
        """What was typed: dots for digits."""
        return self._text

    @Property(list, notify=changed)
    def reasons(self) -> list[str]:
        """The reasons to choose from, in the order of their digits."""
        return self._reasons

    @Slot(int)
    def choose(self, number: int) -> None:
        """The reason of this number, from 1, was chosen with the pointer."""
        self.typed.emit(str(number))

    @Slot()
    def cancel(self) -> None:
        """The card was put away."""
        self.cancelled.emit()


@QmlElement
class NoteScreen(QObject):
    """A note at the screen's edge, for a moment: a few words, or which of so many was chosen, as dots."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._text = ""
        self._chosen = self._of = 0

    def tell(self, text: str) -> None:
        """Show a few words."""
        self._text, self._chosen, self._of = text, 0, 0
        self.changed.emit()

    def point(self, chosen: int, of: int) -> None:
        """Show which one of so many, from 0, was chosen."""
        self._text, self._chosen, self._of = "", chosen, of
        self.changed.emit()

    def hide(self) -> None:
        """Go away."""
        self.tell("")

    @Property(str, notify=changed)
    def text(self) -> str:
        """The words; empty for none."""
        return self._text

    @Property(int, notify=changed)
    def chosen(self) -> int:
        """Which dot is filled, from 0."""
        return self._chosen

    @Property(int, notify=changed)
    def dots(self) -> int:
        """How many dots there are; 0 for none."""
        return self._of
