"""The panel as QML sees it: texts and choices in, wishes out. It knows neither what a wish does nor whether it may."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import Property, QObject, Signal, Slot
from PySide6.QtQml import QmlElement

from kiosk.ui.panel.card import CardScreen, NoteScreen

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

Row = dict[str, Any]
"""One line of a list, by the names that QML uses."""


@QmlElement
class PanelScreen(QObject):
    """What the panel shows."""

    opened = Signal()
    health_changed = Signal()
    records_changed = Signal()
    choices_changed = Signal()
    wished = Signal(str, str)
    """Something was chosen: which deed, and what of it."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._open = False
        self._words: dict[str, str] = {}
        self._health: Row = {"well": True, "summary": "", "lines": []}
        self._records: Row = {"cells": [], "visits": "", "sittings": [], "deviations": [], "more": "", "resumable": []}
        self._choices: Row = {}

    def speak(self, words: dict[str, str]) -> None:
        """Show the fixed texts in these words."""
        self._words = words
        self.opened.emit()

    def open(self, is_open: bool) -> None:  # noqa: FBT001 - it is what is set
        """Come, or go away."""
        self._open = is_open
        self.opened.emit()

    def show_health(self, health: Row) -> None:
        """Show how everything is: ``well``, ``summary``, and ``lines`` of ``name``, ``words`` and ``well``."""
        if health != self._health:
            self._health = health
            self.health_changed.emit()

    def show_records(self, records: Row) -> None:
        """Show what is stored: ``cells``, ``visits``, ``sittings``, ``deviations`` and ``resumable``."""
        if records != self._records:
            self._records = records
            self.records_changed.emit()

    def show_choices(self, choices: Row) -> None:
        """Show what can be chosen, and what is chosen now."""
        if choices != self._choices:
            self._choices = choices
            self.choices_changed.emit()

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
        """The fixed texts, by the names of their messages."""
        return self._words

    @Property("QVariantMap", notify=health_changed)  # type: ignore[arg-type]
    def health(self) -> Row:
        """How everything is."""
        return self._health

    @Property("QVariantMap", notify=records_changed)  # type: ignore[arg-type]
    def records(self) -> Row:
        """What is stored."""
        return self._records

    @Property("QVariantMap", notify=choices_changed)  # type: ignore[arg-type]
    def choices(self) -> Row:
        """What can be chosen."""
        return self._choices

    @Slot(str, str)
    def wish(self, deed: str, choice: str) -> None:
        """The experimenter wants this done."""
        self.wished.emit(deed, choice)


@QmlElement
class ExperimenterScreen(QObject):
    """All that the experimenter sees, and the chords that are listened for."""

    chords_changed = Signal()
    pressed = Signal(str)
    """The chord of the deed of this name was pressed."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._chords: list[Row] = []
        self._card, self._note, self._panel = CardScreen(self), NoteScreen(self), PanelScreen(self)

    @property
    def parts(self) -> tuple[CardScreen, NoteScreen, PanelScreen]:
        """The card, the note and the panel."""
        return self._card, self._note, self._panel

    def listen_for(self, chords: dict[str, str]) -> None:
        """Listen for these chords, by the names of their deeds."""
        self._chords = [{"deed": deed, "chord": chord} for deed, chord in chords.items()]
        self.chords_changed.emit()

    @Property(list, notify=chords_changed)
    def chords(self) -> list[Row]:
        """Every ``chord`` with its ``deed``."""
        return self._chords

    @Property(CardScreen, constant=True)
    def card(self) -> CardScreen:
        """The card that asks."""
        return self._card

    @Property(NoteScreen, constant=True)
    def note(self) -> NoteScreen:
        """The note at the edge."""
        return self._note

    @Property(PanelScreen, constant=True)
    def panel(self) -> PanelScreen:
        """The panel."""
        return self._panel

    @Slot(str)
    def press(self, deed: str) -> None:
        """A chord was pressed."""
        self.pressed.emit(deed)
