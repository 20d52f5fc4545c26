"""The debrief: whom to ask, and the code to withdraw or come back with, to read and to scan."""

from __future__ import annotations

import re
from functools import lru_cache

from PySide6.QtCore import Property, QObject, QUrl, Signal
from PySide6.QtQml import QmlElement

from kiosk.assistance.wording import Catalogue
from kiosk.ui.screens.pages import PageScreen

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

_MAIL_ADDRESS = re.compile(r"[^\s<>(),;:@]+@[^\s<>(),;:@]*[^\s<>(),;:@.]")

QUIET_MODULES = 4
"""The white frame that a QR code must have to be found, in its own squares."""

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
        if catalogue is not self._catalogue:
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
        # The points first: without them the page has nothing to find room for once the code goes.
        super().clear()
        if self._code or self._contact or self._summary or self._returns:
            self._code = self._contact = self._summary = ""
            self._returns = False
            self.given.emit()

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
