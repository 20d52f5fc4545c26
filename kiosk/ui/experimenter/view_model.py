"""What the experimenter's console and its cards show."""

from __future__ import annotations

from enum import Enum
from typing import Any

from PySide6.QtCore import Property, QObject, Signal, Slot
from PySide6.QtQml import QmlElement

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1


class AuthorisationStep(Enum):
    """What the card asks for."""

    NOTHING = ""
    PIN = "pin"
    WAIT = "wait"
    """A wrong PIN came; no other try is allowed yet."""
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
        self._step = AuthorisationStep.NOTHING
        self._title = self._line = self._text = ""
        self._reasons: list[str] = []
        self._by_touch = False

    def show(  # noqa: PLR0913 - all that is on it
        self,
        step: AuthorisationStep,
        title: str,
        line: str = "",
        text: str = "",
        reasons: tuple[str, ...] = (),
        *,
        by_touch: bool = False,
    ) -> None:
        """Ask for something; ``text`` is what was typed so far, as it may be seen; ``by_touch`` brings keys for it."""
        self._by_touch = by_touch
        self._step, self._title, self._line, self._text, self._reasons = step, title, line, text, list(reasons)
        self.changed.emit()

    def hide(self) -> None:
        """Go away, with nothing left of what was typed."""
        self.show(AuthorisationStep.NOTHING, "")

    @property
    def asks_for(self) -> AuthorisationStep:
        """What the card asks for now."""
        return self._step

    @Property(str, notify=changed)
    def step(self) -> str:
        """Return what it asks for: pin, wait, reason, words; nothing while it is away."""
        return self._step.value

    @Property(str, notify=changed)
    def title(self) -> str:
        """Return what is wanted, in a word."""
        return self._title

    @Property(str, notify=changed)
    def line(self) -> str:
        """How to go on, in a sentence."""
        return self._line

    @Property(str, notify=changed)
    def text(self) -> str:
        """Return what was typed: dots for digits."""
        return self._text

    @Property(list, notify=changed)
    def reasons(self) -> list[str]:
        """Return the reasons to choose from, in the order of their digits."""
        return self._reasons

    @Property(bool, notify=changed)
    def byTouch(self) -> bool:  # noqa: N802 - QML's convention
        """Return whether the experimenter answers on the screen."""
        return self._by_touch

    @Slot(str)
    def type(self, digit: str) -> None:
        """Type a digit on the screen."""
        self.typed.emit(digit)

    @Slot()
    def erase(self) -> None:
        """Take back the last digit on the screen."""
        self.erased.emit()

    @Slot()
    def enter(self) -> None:
        """Submit what was typed on the screen."""
        self.entered.emit()

    @Slot(int)
    def choose(self, number: int) -> None:
        """Choose the reason of this number, from 1, with the pointer."""
        self.typed.emit(str(number))

    @Slot()
    def cancel(self) -> None:
        """Put the card away."""
        self.cancelled.emit()


@QmlElement
class NoteScreen(QObject):
    """A note at the screen's edge, for a moment: a few words, or a choice as dots."""

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
        """Return the words; empty for none."""
        return self._text

    @Property(int, notify=changed)
    def chosen(self) -> int:
        """Which dot is filled, from 0."""
        return self._chosen

    @Property(int, notify=changed)
    def dots(self) -> int:
        """How many dots there are; 0 for none."""
        return self._of


Row = dict[str, Any]
"""One line of a list, by the names that QML uses."""


@QmlElement
class PanelScreen(QObject):
    """What the panel shows."""

    opened = Signal()
    health_changed = Signal()
    today_changed = Signal()
    records_changed = Signal()
    choices_changed = Signal()
    alarms_changed = Signal()
    wished = Signal(str, str)
    """Something was chosen: which action, and what of it."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._open = False
        self._words: dict[str, str] = {}
        self._health: Row = {"matters": [], "lines": [], "more": []}
        self._today: Row = {"clock": "", "tiles": []}
        self._shortcuts: Row = {"title": "", "rows": []}
        self._records: Row = {
            "listed": False,
            "cells": [],
            "visits": "",
            "sessions": [],
            "deviations": [],
            "more": "",
            "resumable": [],
        }
        self._choices: Row = {}
        self._alarms: list[Row] = []

    def set_language(self, words: dict[str, str]) -> None:
        """Show the fixed texts in these words."""
        self._words = words
        self.opened.emit()

    def list_shortcuts(self, shortcuts: Row) -> None:
        """Show these shortcuts: a ``title``, and ``rows`` of ``keys`` and ``words`` for what they do."""
        self._shortcuts = shortcuts
        self.opened.emit()

    def open(self, is_open: bool) -> None:  # noqa: FBT001 - it is what is set
        """Come, or go away."""
        self._open = is_open
        self.opened.emit()

    def show_health(self, health: Row) -> None:
        """Show how everything is: lists of a health line's fields.

        ``matters`` are not well or to be done, ``lines`` are well, and ``more`` is what stays as it is all day.
        """
        if health != self._health:
            self._health = health
            self.health_changed.emit()

    def show_today(self, today: Row) -> None:
        """Show the ``clock``, and the ``tiles`` of the day: ``name``, ``title``, ``value`` and ``line``."""
        if today != self._today:
            self._today = today
            self.today_changed.emit()

    def show_records(self, records: Row) -> None:
        """Show what is stored: ``cells`` and whether they are ``listed``, ``visits``, ``sessions`` and so on."""
        if records != self._records:
            self._records = records
            self.records_changed.emit()

    def show_choices(self, choices: Row) -> None:
        """Show what can be chosen, and what is chosen now."""
        if choices != self._choices:
            self._choices = choices
            self.choices_changed.emit()

    def show_alarms(self, alarms: list[Row]) -> None:
        """Show the alarms: ``when``, ``words``, and whether each still ``holds``."""
        if alarms != self._alarms:
            self._alarms = alarms
            self.alarms_changed.emit()

    @property
    def is_open(self) -> bool:
        """Whether the panel is to be seen."""
        return self._open

    @Property(bool, notify=opened)
    def shown(self) -> bool:
        """Whether the panel is to be seen."""
        return self._open

    @Property("QVariantMap", notify=opened)  # type: ignore[arg-type]  # the stubs know no names of Qt's types
    def words(self) -> dict[str, str]:
        """Return the fixed texts, by the names of their messages."""
        return self._words

    @Property("QVariantMap", notify=health_changed)  # type: ignore[arg-type]
    def health(self) -> Row:
        """How everything is."""
        return self._health

    @Property("QVariantMap", notify=today_changed)  # type: ignore[arg-type]
    def today(self) -> Row:
        """Return the clock, and the day in numbers."""
        return self._today

    @Property("QVariantMap", notify=opened)  # type: ignore[arg-type]
    def shortcuts(self) -> Row:
        """Return the shortcuts, and what they do."""
        return self._shortcuts

    @Property("QVariantMap", notify=records_changed)  # type: ignore[arg-type]
    def records(self) -> Row:
        """Return what is stored."""
        return self._records

    @Property("QVariantMap", notify=choices_changed)  # type: ignore[arg-type]
    def choices(self) -> Row:
        """Return what can be chosen."""
        return self._choices

    @Property(list, notify=alarms_changed)
    def alarms(self) -> list[Row]:
        """Return the alarms, those that hold first."""
        return self._alarms

    @Slot(str, str)
    def wish(self, action: str, choice: str) -> None:
        """Ask for an action with a choice."""
        self.wished.emit(action, choice)


@QmlElement
class ExperimenterScreen(QObject):
    """All that the experimenter sees, and the shortcuts that are listened for."""

    shortcuts_changed = Signal()
    calls_changed = Signal()
    pressed = Signal(str)
    """The shortcut of the action of this name was pressed."""
    held = Signal()
    """The corner was held."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._shortcuts: list[Row] = []
        self._calls = self._corner_holds = False
        self._card, self._note, self._panel = CardScreen(self), NoteScreen(self), PanelScreen(self)

    @property
    def parts(self) -> tuple[CardScreen, NoteScreen, PanelScreen]:
        """The card, the note and the panel."""
        return self._card, self._note, self._panel

    def listen_for(self, shortcuts: dict[str, str], *, corner: bool) -> None:
        """Listen for these shortcuts, by the names of their actions, and for a finger held in the corner or not."""
        self._shortcuts = [{"action": action, "shortcut": shortcut} for action, shortcut in shortcuts.items()]
        self._corner_holds = corner
        self.shortcuts_changed.emit()

    @Property(bool, notify=shortcuts_changed)
    def cornerHolds(self) -> bool:  # noqa: N802 - QML's convention
        """Whether a held corner asks for the PIN."""
        return self._corner_holds

    def call(self, *, calls: bool) -> None:
        """Show or hide the mark that calls the experimenter; it has no words, for a visitor may be looking."""
        if calls is not self._calls:
            self._calls = calls
            self.calls_changed.emit()

    @Property(bool, notify=calls_changed)
    def calls(self) -> bool:
        """Whether the experimenter is called."""
        return self._calls

    @Property(list, notify=shortcuts_changed)
    def shortcuts(self) -> list[Row]:
        """Every ``shortcut`` with its ``action``."""
        return self._shortcuts

    @Property(CardScreen, constant=True)
    def card(self) -> CardScreen:
        """Return the card that asks."""
        return self._card

    @Property(NoteScreen, constant=True)
    def note(self) -> NoteScreen:
        """Return the note at the edge."""
        return self._note

    @Property(PanelScreen, constant=True)
    def panel(self) -> PanelScreen:
        """Return the panel."""
        return self._panel

    @Slot()
    def hold(self) -> None:
        """Report that the corner was held."""
        self.held.emit()

    @Slot(str)
    def press(self, action: str) -> None:
        """Report a pressed shortcut."""
        self.pressed.emit(action)
