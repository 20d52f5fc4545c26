"""The card on which visitors who were here before type their code."""

from __future__ import annotations

from PySide6.QtCore import Property, QObject, Signal, Slot
from PySide6.QtQml import QmlElement

from kiosk import UserInputError
from kiosk.assistance.wording import Catalogue
from kiosk.store.codes import ALPHABET, CHANCE_CHARACTERS, checked_code

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

_LENGTH = CHANCE_CHARACTERS + 1
_HALF = _LENGTH // 2
_ROW = 8
_EMPTY = "·"


@QmlElement
class ReturnScreen(QObject):
    """A code as it is typed; whether it is known is found out elsewhere."""

    changed = Signal()
    entered = Signal(str)
    """The visitor typed a whole code whose last character fits."""

    def __init__(self, catalogue: Catalogue, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._catalogue = catalogue
        self._site = ""
        self._typed = self._message = ""
        self._offered = self._checks = False

    def set_language(self, catalogue: Catalogue) -> None:
        """Speak this language."""
        self._catalogue = catalogue
        self.changed.emit()

    def offer(self, *, offered: bool, site: str = "") -> None:
        """Let a visitor say that they were here before, or not; codes begin with the site."""
        self._offered, self._site = offered, site
        self.changed.emit()

    def wait(self, *, checks: bool) -> None:
        """Take no key while a code is looked for."""
        self._checks = checks
        self.changed.emit()

    def refuse(self) -> None:
        """Say that the code is not known here, and let another one be typed."""
        self._typed, self._message = "", "return-unknown"
        self.changed.emit()

    @Slot()
    def clear(self) -> None:
        """Show no code."""
        self._typed = self._message = ""
        self._checks = False
        self.changed.emit()

    @Property(bool, notify=changed)
    def offered(self) -> bool:
        """Whether a visitor can say that they were here before."""
        return self._offered

    @Property(bool, notify=changed)
    def checks(self) -> bool:
        """Whether a code is being looked for."""
        return self._checks

    @Property(list, constant=True)
    def keys(self) -> list[str]:
        """Return the rows of keys; every code is made of these characters."""
        return [ALPHABET[at : at + _ROW] for at in range(0, len(ALPHABET), _ROW)]

    @Property(str, notify=changed)
    def shown(self) -> str:
        """Return what is typed, with a point for each character that is still to come."""
        typed = self._typed.ljust(_LENGTH, _EMPTY)
        return "-".join(part for part in (self._site, typed[:_HALF], typed[_HALF:]) if part)

    @Property(str, notify=changed)
    def line(self) -> str:
        """Return what is to be said to the visitor."""
        return self._catalogue.text(self._message or "return-line")

    @Property(bool, notify=changed)
    def whole(self) -> bool:
        """Whether it is a code that can be looked for."""
        return self._is_whole()

    @Slot(str, result=bool)
    def type(self, text: str) -> bool:
        """Add a character; returns whether it is one of a code."""
        character = text.upper()
        if len(character) != 1 or character not in ALPHABET:
            return False
        if not self._checks and len(self._typed) < _LENGTH:
            self._typed += character
            self._message = "return-mistyped" if self._is_mistyped() else ""
            self.changed.emit()
        return True

    @Slot()
    def erase(self) -> None:
        """Take back the last character."""
        if self._typed and not self._checks:
            self._typed, self._message = self._typed[:-1], ""
            self.changed.emit()

    @Slot()
    def enter(self) -> None:
        """Have the code looked for, if it is whole."""
        if self._is_whole():
            self.entered.emit(self._typed)

    def _is_whole(self) -> bool:
        return len(self._typed) == _LENGTH and not self._message and not self._checks

    def _is_mistyped(self) -> bool:
        if len(self._typed) < _LENGTH:
            return False
        try:
            checked_code(self._typed)
        except UserInputError:
            return True
        return False
