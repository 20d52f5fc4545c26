"""Screenshots of a session: one for each moment that is worth it, and all of them on one sheet."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from time import monotonic

from PySide6.QtCore import QCoreApplication, QEventLoop, QSize, Qt
from PySide6.QtGui import QImage, QPainter
from PySide6.QtQuick import QQuickItem, QQuickWindow

from kiosk import DISK_FULL, StorageError, UserInputError, is_nearly_full, unwritable
from kiosk.experiment import effects as do
from kiosk.experiment.effects import Effect, Mood
from kiosk.experiment.outcomes import Stage
from kiosk.ui.event_loop import Clock


def make_folder(folder: Path) -> None:
    """Make the folder for the pictures, if it is not there; raises UserInputError or StorageError."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise unwritable(f"the folder for the pictures, {folder}, cannot be made", error) from error


LAYOUTS = {"wide": (1920, 1080), "upright": (1080, 1920)}
"""Sizes of the window, in pixels, by their names."""
_THUMB, _CAPTION, _IN_A_ROW = 480, 30, {"wide": 4, "upright": 8}


def layout_of(size: QSize) -> str:
    """Name the layout of a window of this size."""
    return "wide" if size.width() >= size.height() else "upright"


def resize(window: QQuickWindow, layout: str) -> None:
    """Give a window that is on no screen the size of a layout, at once."""
    window.resize(*LAYOUTS[layout])
    QCoreApplication.processEvents()


class ContactSheet:
    """Small pictures of a session in one picture, in their order, each with its name."""

    def __init__(self) -> None:
        """Begin with no picture."""
        self._taken: list[tuple[str, QImage]] = []

    def add(self, name: str, picture: QImage) -> None:
        """Add a picture; only a small copy is kept."""
        height = _THUMB * 9 // 16
        self._taken.append((name, picture.scaledToHeight(height, Qt.TransformationMode.SmoothTransformation)))

    def save(self, file: Path) -> None:
        """Write all of them into one PNG file; raises UserInputError or StorageError."""
        if not self._taken:
            return
        small = self._taken[0][1].size()
        columns = min(len(self._taken), _IN_A_ROW[layout_of(small)])
        wide, high = small.width() + _CAPTION, small.height() + 2 * _CAPTION
        rows = -(-len(self._taken) // columns)
        sheet = QImage(columns * wide + _CAPTION, rows * high + _CAPTION, QImage.Format.Format_RGB32)
        sheet.fill(Qt.GlobalColor.white)
        painter = QPainter(sheet)
        font = painter.font()
        font.setPixelSize(_CAPTION * 2 // 3)
        painter.setFont(font)
        for number, (name, picture) in enumerate(self._taken):
            x, y = _CAPTION + number % columns * wide, _CAPTION + number // columns * high
            painter.drawImage(x, y, picture)
            painter.drawText(x, y + small.height() + _CAPTION * 4 // 5, name)
        painter.end()
        if not sheet.save(str(file)):
            raise unwritten(file)


PICTURE_QUALITY = 70
"""How hard a picture is compressed, as Qt counts: it takes two thirds of the usual time, and a sixth more space."""

_LOADING_S = 2.0
"""How long a picture that is still loaded is waited for."""


class Screenshots:
    """Saves ``NN-moment.png`` in a folder, numbered in the order in which the moments came."""

    def __init__(
        self,
        window: QQuickWindow,
        folder: Path | None,
        clock: Clock,
        settle_ms: int,
        before: Screenshots | None = None,
    ) -> None:
        """Take pictures of this window, ``settle_ms`` after their moment, when nothing moves any more.

        Without a folder they are only put on the sheet. Numbers and sheet go on from those ``before``, if there are.
        """
        self.sheet: ContactSheet = ContactSheet() if before is None else before.sheet
        self.layout = layout_of(window.size())
        self._window = window
        self.folder = folder
        self._clock = clock
        self._settle_ms = settle_ms
        self._taken: list[str] = [] if before is None else before._taken

    def watch(self, effects: Iterable[Effect], stage: Stage) -> None:
        """Take a picture if these effects, in this stage, were the first to bring their moment."""
        moment = moment_of(effects, stage)
        if moment is not None:
            self.take(moment)

    def take(self, moment: str) -> None:
        """Take a picture of what is shown now, the first time that it is called so."""
        if moment in self._taken:
            return
        self._taken.append(moment)
        self._take_when_settled(f"{len(self._taken):02}-{moment}.png")

    def _take_when_settled(self, name: str) -> None:
        if self._settle_ms == 0:
            self._save(name)
        else:
            self._clock.after(self._settle_ms, lambda: self._save(name))

    def _save(self, name: str) -> None:
        picture = self._window.grabWindow()
        until = monotonic() + _LOADING_S
        while _loads(self._window.contentItem()) and monotonic() < until:
            QCoreApplication.processEvents(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
            picture = self._window.grabWindow()
        self.sheet.add(Path(name).stem, picture)
        if self.folder is not None and not picture.save(str(self.folder / name), quality=PICTURE_QUALITY):
            raise unwritten(self.folder / name)


def _loads(item: QQuickItem) -> bool:
    """Whether a picture to be seen is still loaded, as one is that has a data address."""
    if not item.isVisible():
        return False
    loading = item.inherits("QQuickImageBase") and item.property("source").isValid() and item.property("progress") < 1
    return loading or any(_loads(child) for child in item.childItems())


def unwritten(picture: Path) -> UserInputError | StorageError:
    """Return what to raise when a picture could not be written; Qt does not say why."""
    what = f"the picture {picture} cannot be written"
    return StorageError(f"{what}: {DISK_FULL}") if is_nearly_full(picture.parent) else UserInputError(what)


_NAMES: dict[type[Effect], tuple[int, str]] = {
    do.ShowAbout: (2, "about"),
    do.ShowConsent: (2, "consent"),
    do.ShowAgeQuestion: (2, "age"),
    do.ShowValidationErrors: (2, "missing"),
    do.ShowIntroduction: (2, "introduction"),
    do.RevealCard: (4, "card"),
    do.MarkMatched: (2, "pair"),
    do.ShowResult: (2, "result"),
    do.ShowAnswer: (2, "answer"),
    do.HideItems: (2, "other-items"),
    do.ShowDebrief: (2, "debrief"),
    do.ShowThanks: (2, "thanks"),
    do.AskStillThere: (2, "still-there"),
    do.ShowPause: (2, "pause"),
}


def moment_of(effects: Iterable[Effect], stage: Stage) -> str | None:
    """Return the name for a picture of what these effects bring, if it is worth one.

    A mark goes before its card, and a face comes after all else. What comes at once is one picture, so a face or a card
    has one of its own only where it comes alone.
    """
    moments = [moment for effect in effects if (moment := _moment(effect, stage)) is not None]
    return min(moments, default=(0, None))[1]


def _moment(effect: Effect, stage: Stage) -> tuple[int, str] | None:
    """Return what an effect brings, with its rank: the lowest gives the picture its name."""
    match effect:
        case do.ShowBoard(practice=practice):
            return 0, "practice" if practice else "board"
        case do.ShowItems(number=number):
            return 0, f"{'about-you' if stage is Stage.ABOUT_YOU else 'items'}-{number}"
        case do.HighlightHint(row=row, column=column):
            return 1, _mark(row, column)
        case do.LockBoard(wait=wait):
            return 3, wait.value.replace("_", "-")
        case do.SetExpression(mood=mood):
            return None if mood is Mood.IDLE else (5, mood.value)
        case _:
            return _NAMES.get(type(effect))


def _mark(row: int | None, column: int | None) -> str:
    if column is None:
        return "mark-row"
    return "mark-column" if row is None else "mark-card"
