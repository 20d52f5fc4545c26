"""The screens that a visitor only reads, one small object each."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Property, QObject, Signal, Slot
from PySide6.QtQml import QmlElement

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.information import Page
from kiosk.units import MS_PER_SECOND, SECONDS_PER_MINUTE

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1


def signed_lines(page: Page | None) -> list[dict[str, str]]:
    """Return the lines of a page, each with its text and the name of its drawing; none without a page."""
    return [] if page is None else [{"text": text, "sign": sign} for text, sign in page.lines]


@QmlElement
class ReadingScreen(QObject):
    """Something to read, with one way on.

    A property's signal is declared in the class of the property: Qt does not find it in a base.
    """

    continued = Signal()
    """The visitor goes on."""

    @Slot()
    def proceed(self) -> None:
        """Go on to the next page."""
        self.continued.emit()


@QmlElement
class PageScreen(ReadingScreen):
    """A title and some paragraphs."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._page: Page | None = None

    def show(self, page: Page) -> None:
        """Show this page."""
        self._page = page
        self.changed.emit()

    def clear(self) -> None:
        """Show nothing."""
        # What is clear already is not laid out once more.
        if self._page is not None:
            self._page = None
            self.changed.emit()

    @Property(str, notify=changed)
    def title(self) -> str:
        """Return the title."""
        return "" if self._page is None else self._page.title

    @Property(list, notify=changed)
    def paragraphs(self) -> list[str]:
        """Return the paragraphs, in their order."""
        return [] if self._page is None else list(self._page.paragraphs)

    @Property(list, notify=changed)
    def lines(self) -> list[dict[str, str]]:
        """Return the lines, each with its text and the name of its drawing."""
        return signed_lines(self._page)


@QmlElement
class AboutScreen(PageScreen):
    """What the study is about."""


@QmlElement
class IntroductionScreen(ReadingScreen):
    """What the game is about."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._helped = self._points = True

    def show(self, *, helped: bool, points: bool = True) -> None:
        """Speak of hints, or not; with ``points``, show how they mark the board."""
        self._helped, self._points = helped, points
        self.changed.emit()

    def clear(self) -> None:
        """Speak of hints, as for most."""
        self.show(helped=True)

    @Property(bool, notify=changed)
    def helped(self) -> bool:
        """Whether hints are spoken of."""
        return self._helped

    @Property(bool, notify=changed)
    def points(self) -> bool:
        """Whether hints mark a place on the board."""
        return self._points


@QmlElement
class ResultScreen(ReadingScreen):
    """What the visitor achieved."""

    changed = Signal()

    def __init__(self, catalogue: Catalogue, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._catalogue = catalogue
        self._pairs = self._moves = self._time = self._clock = self._hints = ""
        self._pictures: list[str] = []

    def set_language(self, catalogue: Catalogue) -> None:
        """Tell the time in this language, from the next result on."""
        self._catalogue = catalogue

    def show(self, pairs: int, moves: int, time_ms: int, hints: int = 0, pictures: Sequence[str] = ()) -> None:
        """Show a finished game, with the pictures of its pairs as addresses; of hints nothing if there were none."""
        self._hints = str(hints or "")
        self._pictures = list(pictures)
        minutes, seconds = divmod(round(time_ms / MS_PER_SECOND), SECONDS_PER_MINUTE)
        self._pairs, self._moves = str(pairs), str(moves)
        self._time = self._catalogue.text("result-time", minutes=minutes, seconds=seconds)
        self._clock = f"{minutes}:{seconds:02}"
        self.changed.emit()

    def clear(self) -> None:
        """Show no figures."""
        self._pairs = self._moves = self._time = self._clock = self._hints = ""
        self._pictures = []
        self.changed.emit()

    @Property(str, notify=changed)
    def hints(self) -> str:
        """How many hints the helper gave; empty for none."""
        return self._hints

    @Property(list, notify=changed)
    def pictures(self) -> list[str]:
        """Return the pictures of the pairs that were found, as addresses."""
        return self._pictures

    @Property(str, notify=changed)
    def pairs(self) -> str:
        """How many pairs were found."""
        return self._pairs

    @Property(str, notify=changed)
    def moves(self) -> str:
        """In how many moves."""
        return self._moves

    @Property(str, notify=changed)
    def time(self) -> str:
        """Return the time in words, to be read aloud."""
        return self._time

    @Property(str, notify=changed)
    def clock(self) -> str:
        """Return the time as minutes and seconds, such as "1:05"."""
        return self._clock


@QmlElement
class ThanksScreen(ReadingScreen):
    """The end."""

    def clear(self) -> None:
        """Do nothing: it is the same for every visitor."""
