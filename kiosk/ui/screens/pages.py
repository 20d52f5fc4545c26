"""The screens that a visitor reads or consents on, one small object each."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from PySide6.QtCore import Property, QObject, QUrl, Signal, Slot
from PySide6.QtQml import QmlElement

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.information import ConsentPage, Page
from kiosk.units import MS_PER_SECOND, SECONDS_PER_MINUTE

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1


_MAIL_ADDRESS = re.compile(r"[^\s<>(),;:@]+@[^\s<>(),;:@]*[^\s<>(),;:@.]")

QUIET_MODULES = 4
"""The white frame that a QR code must have to be found, in its own squares."""


def _lines(page: Page | None) -> list[dict[str, str]]:
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
        return _lines(self._page)


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


SUMMARY_MOST = 120
"""How many characters of a summary a QR code has room for with squares that a telephone can read."""


@QmlElement
class DebriefScreen(PageScreen):
    """What the study was about, and the code to withdraw with, to be written down or photographed."""

    given = Signal()
    """Another code, contact or language."""

    def __init__(self, catalogue: Catalogue, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._catalogue = catalogue
        self._code = self._contact = self._summary = ""
        self._returns = False

    def set_language(self, catalogue: Catalogue) -> None:
        """Say in this language what the code is for."""
        self._catalogue = catalogue
        self.given.emit()

    def give_contact(self, contact: str) -> None:
        """Tell whom to write to."""
        self._contact = contact
        self.given.emit()

    def give_summary(self, summary: str) -> None:
        """Put what the study was about into the QR code, unless it is too long."""
        self._summary = summary if len(summary) <= SUMMARY_MOST else ""
        self.given.emit()

    def give_code(self, code: str, *, returns: bool = False) -> None:
        """Show this code; with an empty one nothing is said about withdrawing.

        With ``returns``, it is also said that the visitor can come back with it.
        """
        if (code, returns) != (self._code, self._returns):
            self._code, self._returns = code, returns
            self.given.emit()

    def clear(self) -> None:
        """Show no page and no code."""
        self._code = self._contact = self._summary = ""
        self._returns = False
        self.given.emit()
        super().clear()

    @property
    def shown_code(self) -> str:
        """The code on the card; empty if there is none."""
        return self._code

    @property
    def payload(self) -> str:
        """The content of the QR code: a letter to be sent, or else what to write in one."""
        if not self._code:
            return ""
        subject = self._catalogue.text("debrief-subject", code=self._code)
        addresses = _MAIL_ADDRESS.findall(self._contact)
        if len(addresses) == 1:
            body = f"&body={QUrl.toPercentEncoding(self._summary).toStdString()}" if self._summary else ""
            return f"mailto:{addresses[0]}?subject={QUrl.toPercentEncoding(subject).toStdString()}{body}"
        return "\n".join(filter(None, (subject, self._contact, self._summary)))

    @Property(str, notify=given)
    def code(self) -> str:
        """Return the code; empty if there is none."""
        return self._code

    @Property(str, notify=given)
    def withdrawing(self) -> str:
        """Return what the code is for, in words."""
        if not self._code:
            return ""
        if not self._contact:
            return self._catalogue.text("debrief-withdraw-here")
        return self._catalogue.text("debrief-withdraw-by-mail", contact=self._contact)

    @Property(str, notify=given)
    def scanning(self) -> str:
        """Return what a telephone finds in the QR code, in a few words."""
        if not self._code:
            return ""
        if self.payload.startswith("mailto:"):
            return self._catalogue.text("debrief-scan-letter")
        return self._catalogue.text("debrief-scan-summary" if self._summary else "debrief-scan")

    @Property(str, notify=given)
    def returning(self) -> str:
        """Return that the visitor can come back with the code; empty if they cannot."""
        return self._catalogue.text("debrief-return") if self._code and self._returns else ""

    @Property(str, notify=given)
    def questions(self) -> str:
        """Return whom to ask; empty without a contact, and beside a code, which names the contact already."""
        if self._code or not self._contact:
            return ""
        return self._catalogue.text("debrief-questions", contact=self._contact)

    @Property(str, notify=given)
    def picture(self) -> str:
        """Return the QR code as a data address, one pixel for each of its squares, with its white frame."""
        return _qr_code(self.payload)[0] if self._code else ""

    @Property(int, notify=given)
    def squares(self) -> int:
        """How many squares the picture is wide; 0 without one."""
        return _qr_code(self.payload)[1] if self._code else 0


# A visitor's code is drawn once, however often the page asks for it.
@lru_cache(maxsize=4)
def _qr_code(payload: str) -> tuple[str, int]:
    """Return a QR code as a data address, and how many squares it is wide with its frame."""
    import segno  # noqa: PLC0415 - the start screen does not wait for it

    code = segno.make(payload, micro=False)
    return str(code.png_data_uri(scale=1, border=QUIET_MODULES)), int(code.symbol_size(border=QUIET_MODULES)[0])


def draw_first_code() -> None:
    """Load what draws QR codes before a session begins with one."""
    _qr_code("prepared")


@QmlElement
class ThanksScreen(ReadingScreen):
    """The end."""

    def clear(self) -> None:
        """Do nothing: it is the same for every visitor."""


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
        return _lines(self._page) if self._page is not None and self._page.points else []

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

    @Property(bool, notify=marked)
    def complete(self) -> bool:
        """Whether every required purpose is ticked."""
        return self._page is not None and not self.needed

    @Property(str, notify=marked)
    def waiting(self) -> str:
        """Return what is still to be ticked to take part; empty if nothing is."""
        return self._catalogue.text("consent-waits", number=len(self.needed)) if self.needed else ""

    @Property(str, notify=marked)
    def toGo(self) -> str:  # noqa: N802 - QML's convention
        """Return the same in two or three words, for the button itself."""
        return self._catalogue.text("consent-to-go", number=len(self.needed)) if self.needed else ""

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
