"""Pictures of a sitting: the first time that each kind of moment comes, what the window shows is saved."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from PySide6.QtQuick import QQuickWindow

from kiosk import DISK_FULL, BadInput, StoreFailed, is_nearly_full, unwritable
from kiosk.study import commands as do
from kiosk.study.commands import Command
from kiosk.study.events import Stage
from kiosk.ui.clock import Clock


def make_folder(folder: Path) -> None:
    """Make the folder for the pictures, if it is not there; raises BadInput or StoreFailed."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise unwritable(f"the folder for the pictures, {folder}, cannot be made", error) from error


class Shots:
    """Saves ``NN-moment.png`` in a folder, numbered in the order in which the moments came."""

    def __init__(self, window: QQuickWindow, folder: Path, clock: Clock, settle_ms: int) -> None:
        """Take pictures of this window, ``settle_ms`` after their moment, when nothing moves any more."""
        self._window = window
        self._folder = folder
        self._clock = clock
        self._settle_ms = settle_ms
        self._taken: list[str] = []

    def watch(self, commands: tuple[Command, ...], stage: Stage) -> None:
        """Take a picture if these commands, which led to this stage, were the first to bring their moment."""
        for moment in _moments(commands, stage):
            if moment not in self._taken:
                self._taken.append(moment)
                self._take_when_settled(f"{len(self._taken):02}-{moment}.png")

    def take(self, moment: str) -> None:
        """Take a picture of what is shown now."""
        self._taken.append(moment)
        self._take_when_settled(f"{len(self._taken):02}-{moment}.png")

    def _take_when_settled(self, name: str) -> None:
        if self._settle_ms == 0:
            self._save(name)
        else:
            self._clock.after(self._settle_ms, lambda: self._save(name))

    def _save(self, name: str) -> None:
        file = self._folder / name
        if not self._window.grabWindow().save(str(file)):
            raise unwritten(file)


def unwritten(picture: Path) -> BadInput | StoreFailed:
    """Return what to raise when a picture could not be written; Qt does not say why."""
    what = f"the picture {picture} cannot be written"
    return StoreFailed(f"{what}: {DISK_FULL}") if is_nearly_full(picture.parent) else BadInput(what)


_NAMES: dict[type[Command], str] = {
    do.ShowAbout: "about",
    do.ShowConsent: "consent",
    do.ShowTicks: "ticks",
    do.ShowAgeQuestion: "age",
    do.ShowMissing: "missing",
    do.ShowIntroduction: "introduction",
    do.TurnUp: "card",
    do.ShowPair: "pair",
    do.ShowResult: "result",
    do.ShowAnswer: "answer",
    do.ShowDebrief: "debrief",
    do.ShowThanks: "thanks",
    do.AskStillThere: "still-there",
    do.ShowPause: "pause",
}


def _moments(commands: tuple[Command, ...], stage: Stage) -> Iterable[str]:
    """What these commands have brought, in names for files."""
    for command in commands:
        match command:
            case do.ShowBoard(practice=practice):
                yield "practice" if practice else "board"
            case do.HoldBoard(wait=wait):
                yield wait.value.replace("_", "-")
            case do.ShowMark(row=row, column=column):
                yield _mark(row, column)
            case do.Express(mood=mood):
                yield mood.value
            case do.ShowItems(number=number):
                yield f"{'about-you' if stage is Stage.ABOUT_YOU else 'items'}-{number}"
            case _ if type(command) in _NAMES:
                yield _NAMES[type(command)]


def _mark(row: int | None, column: int | None) -> str:
    if column is None:
        return "mark-row"
    return "mark-column" if row is None else "mark-card"
