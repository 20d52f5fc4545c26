"""One small object per screen: what it shows, and what the visitor did. No object knows what comes next."""

from __future__ import annotations

from PySide6.QtCore import Property, QObject, Signal, Slot
from PySide6.QtQml import QmlElement

from kiosk.assistant.wording import Catalogue

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

MS_PER_SECOND = 1000
SECONDS_PER_MINUTE = 60


@QmlElement
class KioskScreen(QObject):
    """The window as a whole: which screen is shown, and whether somebody is asked if they are still there."""

    changed = Signal()
    confirmed = Signal()
    """The visitor said that they are still there."""
    left = Signal()
    """The experimenter leaves the kiosk."""
    unsettled = Signal()
    """Something else is shown than a moment ago."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._screen = "attract"
        self._asks_still_there = False
        self._leaving = False
        self._settled = True

    def show(self, screen: str) -> None:
        """Show the screen of this name; it takes no input until ``settle``."""
        self._screen = screen
        self._unsettle()

    def settle(self) -> None:
        """Take input: whoever clicked twice on the last screen has let go by now."""
        self._settled = True
        self.changed.emit()

    def ask_still_there(self, *, asks: bool) -> None:
        """Ask over whatever is shown, or stop asking."""
        if asks != self._asks_still_there:
            self._asks_still_there = asks
            self._unsettle()

    @property
    def shown(self) -> str:
        """The name of the screen that is shown."""
        return self._screen

    @Property(str, notify=changed)
    def screen(self) -> str:
        """The name of the screen that is shown."""
        return self._screen

    @Property(bool, notify=changed)
    def asksStillThere(self) -> bool:  # noqa: N802 - QML's convention
        """Whether the visitor is asked if they are still there."""
        return self._asks_still_there

    def _unsettle(self) -> None:
        self._settled = False
        self.changed.emit()
        self.unsettled.emit()

    @property
    def takes_input(self) -> bool:
        """Whether what is shown can be tapped."""
        return self._settled

    @Property(bool, notify=changed)
    def settled(self) -> bool:
        """Whether what is shown can be tapped."""
        return self._settled

    @Property(bool, notify=changed)
    def leaving(self) -> bool:
        """Whether the window may be closed."""
        return self._leaving

    def let_go(self) -> None:
        """Let the window be closed."""
        self._leaving = True
        self.changed.emit()

    @Slot()
    def confirm(self) -> None:
        """The visitor is still there."""
        self.confirmed.emit()

    @Slot()
    def leave(self) -> None:
        """The experimenter leaves the kiosk."""
        self.left.emit()


@QmlElement
class AttractScreen(QObject):
    """What draws people in: a row of cards, of which one pair after another is turned up."""

    changed = Signal()
    started = Signal()

    def __init__(self, pictures: tuple[str, ...], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._pictures = list(pictures)
        self._shown = 0

    def turn(self) -> None:
        """Turn up the next card."""
        self._shown = (self._shown + 1) % len(self._pictures)
        self.changed.emit()

    @Property(list, constant=True)
    def pictures(self) -> list[str]:
        """Where the pictures of the cards are, as addresses."""
        return self._pictures

    @Property(int, notify=changed)
    def shown(self) -> int:
        """Which of the cards is turned up."""
        return self._shown

    @Slot()
    def start(self) -> None:
        """A visitor begins."""
        self.started.emit()


@QmlElement
class IntroductionScreen(QObject):
    """What the game is about."""

    continued = Signal()

    @Slot()
    def proceed(self) -> None:
        """The visitor is ready."""
        self.continued.emit()


@QmlElement
class ResultScreen(QObject):
    """What the visitor achieved."""

    changed = Signal()
    continued = Signal()

    def __init__(self, catalogue: Catalogue, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._catalogue = catalogue
        self._pairs = self._moves = self._time = ""

    def show(self, pairs: int, moves: int, time_ms: int) -> None:
        """Show a finished game."""
        minutes, seconds = divmod(round(time_ms / MS_PER_SECOND), SECONDS_PER_MINUTE)
        self._pairs, self._moves = str(pairs), str(moves)
        self._time = self._catalogue.text("result-time", minutes=minutes, seconds=seconds)
        self.changed.emit()

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
        """In what time."""
        return self._time

    @Slot()
    def proceed(self) -> None:
        """The visitor has seen it."""
        self.continued.emit()


@QmlElement
class QuestionScreen(QObject):
    """One question with its scale."""

    changed = Signal()
    answered = Signal(str, int)
    """The item's name, and the answer from 1."""
    continued = Signal()

    def __init__(self, catalogue: Catalogue, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._catalogue = catalogue
        self._item = ""
        self._text = self._progress = ""
        self._points = self._chosen = 0
        self._last = False

    def ask(self, questionnaire: str, item: str, points: int, number: int, of: int) -> None:
        """Ask an item, ``number`` ``of`` so many; no answer is chosen."""
        self._item = item
        self._text = self._catalogue.text(f"question-{questionnaire}-{item}")
        self._progress = self._catalogue.text("questions-progress", number=number, all=of)
        self._points, self._chosen, self._last = points, 0, number == of
        self.changed.emit()

    def show_answer(self, value: int) -> None:
        """Show which answer is chosen."""
        self._chosen = value
        self.changed.emit()

    @property
    def scale(self) -> int:
        """The highest answer there is."""
        return self._points

    @property
    def answer(self) -> int | None:
        """The chosen answer, from 1."""
        return self._chosen or None

    @Property(str, notify=changed)
    def text(self) -> str:
        """The question."""
        return self._text

    @Property(str, notify=changed)
    def progress(self) -> str:
        """Which question of how many this is."""
        return self._progress

    @Property(int, notify=changed)
    def points(self) -> int:
        """How many answers there are."""
        return self._points

    @Property(int, notify=changed)
    def chosen(self) -> int:
        """The chosen answer, from 1; 0 for none."""
        return self._chosen

    @Property(bool, notify=changed)
    def last(self) -> bool:
        """Whether no further question follows."""
        return self._last

    @Slot(int)
    def choose(self, value: int) -> None:
        """The visitor chooses an answer."""
        self.answered.emit(self._item, value)

    @Slot()
    def proceed(self) -> None:
        """The visitor goes on."""
        self.continued.emit()
