"""The questions before anything is stored: whether a visitor is old enough, and what they agree to."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import Property, QObject, Signal, Slot
from PySide6.QtQml import QmlElement

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.information import ConsentPage
from kiosk.ui.screens.pages import signed_lines

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1


@QmlElement
class ConsentScreen(QObject):
    """What can be agreed to: one box for each purpose."""

    changed = Signal()
    marked = Signal()
    """Another box was ticked, or is missed; apart from ``changed``, so that the boxes stay the same boxes."""
    missed = Signal(str)
    """The first box that is missed is to be brought into view."""
    ticked = Signal(str, bool)
    """The visitor set or took away the tick of a purpose."""
    agreed = Signal()
    declined = Signal()

    def __init__(self, catalogue: Catalogue, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._catalogue = catalogue
        self._page: ConsentPage | None = None
        self._ticks: frozenset[str] = frozenset()
        self._missing: tuple[str, ...] = ()

    def set_language(self, catalogue: Catalogue) -> None:
        """Say in this language what is still to be ticked."""
        self._catalogue = catalogue
        self.marked.emit()

    def show(self, page: ConsentPage) -> None:
        """Show this page; nothing is ticked."""
        self._page = page
        self._mark(frozenset(), ())
        self.changed.emit()

    def show_ticks(self, purposes: frozenset[str]) -> None:
        """Show which purposes are ticked."""
        self._mark(purposes, tuple(name for name in self._missing if name not in purposes))

    def show_missing(self, purposes: tuple[str, ...]) -> None:
        """Show which ticks are missed."""
        self._mark(self._ticks, purposes)
        self.missed.emit(purposes[0])

    def clear(self) -> None:
        """Show nothing."""
        self._page = None
        self._mark(frozenset(), ())
        self.changed.emit()

    def _mark(self, ticks: frozenset[str], missing: tuple[str, ...]) -> None:
        self._ticks, self._missing = ticks, missing
        self.marked.emit()

    @property
    def offered(self) -> tuple[str, ...]:
        """The purposes that are shown, as anybody in front of the screen can see."""
        return () if self._page is None else tuple(purpose.id for purpose in self._page.purposes)

    @property
    def ticked_purposes(self) -> frozenset[str]:
        """The purposes that have a tick."""
        return self._ticks

    @property
    def needed(self) -> frozenset[str]:
        """The required ones that have no tick yet, as anybody in front of the screen can see."""
        return frozenset() if self._page is None else self._page.required - self._ticks

    @Property(str, notify=changed)
    def title(self) -> str:
        """Return the title."""
        return "" if self._page is None else self._page.title

    @Property(list, notify=changed)
    def paragraphs(self) -> list[str]:
        """Return the paragraphs, in their order."""
        return [] if self._page is None else list(self._page.paragraphs)

    @Property(list, notify=changed)
    def points(self) -> list[dict[str, str]]:
        """Return what stands for the paragraphs at first, each with its drawing; empty if they stand for themselves."""
        return signed_lines(self._page) if self._page is not None and self._page.points else []

    @Property(list, notify=changed)
    def purposes(self) -> list[dict[str, Any]]:
        """Return the purposes, in their order: name, text, and whether each is required."""
        shown = () if self._page is None else self._page.purposes
        return [{"id": purpose.id, "text": purpose.text, "required": purpose.required} for purpose in shown]

    @Property(list, notify=marked)
    def ticks(self) -> list[str]:
        """Return the purposes that are ticked."""
        return sorted(self._ticks)

    @Property(list, notify=marked)
    def missing(self) -> list[str]:
        """Return the purposes whose ticks are missed."""
        return list(self._missing)

    @Property(str, notify=marked)
    def toGo(self) -> str:  # noqa: N802 - QML's convention
        """Return how many boxes are to be ticked to take part; empty once all of them are."""
        return self._name_boxes("")

    @Property(str, notify=marked)
    def toGoLine(self) -> str:  # noqa: N802 - QML's convention
        """Return which boxes are to be ticked to take part, in short; empty once all of them are."""
        return self._name_boxes("-line")

    def _name_boxes(self, kind: str) -> str:
        if self._page is None or not self.needed:
            return ""
        required = [purpose.required for purpose in self._page.purposes]
        number = sum(required)
        come_first = number < len(required) and all(required[:number])
        return self._catalogue.text(("consent-first" if come_first else "consent-to-go") + kind, number=number)

    @Slot(str, bool)
    def tick(self, purpose: str, ticked: bool) -> None:  # noqa: FBT001 - QML gives no names
        """Set a tick, or take it away."""
        self.ticked.emit(purpose, ticked)

    @Slot()
    def agree(self) -> None:
        """Agree to what is ticked."""
        self.agreed.emit()

    @Slot()
    def decline(self) -> None:
        """Play without taking part."""
        self.declined.emit()


@QmlElement
class AgeScreen(QObject):
    """Whether the visitor is old enough."""

    changed = Signal()
    answered = Signal(bool)
    """The visitor said whether they are."""

    def __init__(self, catalogue: Catalogue, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._catalogue = catalogue
        self._adult = 0

    def set_language(self, catalogue: Catalogue) -> None:
        """Ask in this language."""
        self._catalogue = catalogue
        self.changed.emit()

    def ask(self, adult: int) -> None:
        """Ask for this age in years."""
        self._adult = adult
        self.changed.emit()

    def clear(self) -> None:
        """Ask nothing."""
        self._adult = 0
        self.changed.emit()

    @Property(str, notify=changed)
    def question(self) -> str:
        """Return the question."""
        return self._text("age-question")

    @Property(str, notify=changed)
    def older(self) -> str:
        """Return what a yes says."""
        return self._text("age-older")

    @Property(str, notify=changed)
    def younger(self) -> str:
        """Return what a no says."""
        return self._text("age-younger")

    def _text(self, message: str) -> str:
        return self._catalogue.text(message, adult=self._adult) if self._adult else ""

    @Slot(bool)
    def answer(self, adult: bool) -> None:  # noqa: FBT001 - QML gives no names
        """Answer."""
        self.answered.emit(adult)
