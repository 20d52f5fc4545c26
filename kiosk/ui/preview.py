"""Show every screen of a study while it is written, with the file and key of each text."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Protocol

from PySide6.QtCore import Property, QCoreApplication, QEvent, QObject, QPointF, QSize, QTimer, QUrl, Signal, Slot
from PySide6.QtGui import QImage
from PySide6.QtQml import QmlElement, QQmlApplicationEngine
from PySide6.QtQuick import QQuickImageProvider, QQuickItem, QQuickWindow

from kiosk import UserInputError
from kiosk.experiment import effects as do
from kiosk.experiment.condition import Condition
from kiosk.experiment.effects import Effect
from kiosk.experiment.items import Response
from kiosk.experiment.relevance import hidden_items
from kiosk.experiment.session_config import SessionConfig, StudyConfig
from kiosk.experiment.transitions import StageOrder
from kiosk.ui.event_loop import EventLoop, WallClock
from kiosk.ui.preview_screens import form_pages, screen_effects, stage_of
from kiosk.ui.renderer import Renderer
from kiosk.ui.replay import avatar_alone
from kiosk.ui.simulated_visitor import touch
from kiosk.ui.window import ClockMode, RunMode, Window, WindowMode

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

QML = Path(__file__).parent / "qml" / "Preview.qml"
SIZES = ("1920 x 1080", "1280 x 720", "1080 x 1920", "720 x 1280")
POLL_MS = 100
"""How often the files are looked at; a change is shown within a second."""
SETTLE_MS = 300
"""Pictures that are loaded in the background are there by then."""


@dataclass(frozen=True)
class FoundText:
    """A text that was clicked on: its file, its key there, and how it is written."""

    file: Path
    key: str
    text: str
    note: str = ""
    """Where it is written to if that is another place, or why it cannot be changed."""
    is_editable: bool = True


class StudyTexts(Protocol):
    """Reads a study, and finds and changes its texts."""

    def read(self) -> StudyConfig:
        """Return the study as its files are now; raises UserInputError."""
        ...

    def find(self, plan: SessionConfig, shown: str) -> FoundText | None:
        """Return the text that reads like this on a screen in the language of a plan."""
        ...

    def change(self, text: str) -> None:
        """Write the text that was found last; raises UserInputError and changes nothing if that is impossible."""
        ...


class _Picture(QQuickImageProvider):
    """Hands the picture of the visitor's screen to QML."""

    def __init__(self) -> None:
        super().__init__(QQuickImageProvider.ImageType.Image)
        self.image = QImage(1, 1, QImage.Format.Format_RGB32)

    def requestImage(self, _id: str, size: QSize, _wanted: QSize) -> QImage:  # noqa: N802 - Qt's name
        """Return the newest picture."""
        size.setWidth(self.image.width())
        size.setHeight(self.image.height())
        return self.image


@QmlElement
class PreviewModel(QObject):
    """What the preview's window shows, and what is done in it."""

    changed = Signal()
    drawn = Signal()
    found_changed = Signal()
    left = Signal()

    def __init__(self, file: Path, texts: StudyTexts, display: WindowMode, owner: QObject | None = None) -> None:
        """Read the study; raises UserInputError if it is wrong already."""
        super().__init__(owner)
        self.picture = _Picture()
        self._file = file
        self._texts = texts
        self._mode = RunMode(display, ClockMode.VIRTUAL)
        self._study = texts.read()
        self._seen = self._state()
        self._fault = ""
        self._found: FoundText | None = None
        self._drawn = 0
        self._screen, self._size = "attract", SIZES[0]
        self._language = self._study.languages[0]
        self._condition = self._study.settings.assistance.condition
        self._given: dict[str, dict[str, Response]] | None = None
        """The answers by questionnaire while the viewer answers; None: every item is shown."""
        self._settled = QTimer(self, singleShot=True)
        self._settled.timeout.connect(self._draw)
        self._open()
        self._show()
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.poll)
        self._timer.start(POLL_MS)

    def close(self) -> None:
        """Close the visitor's screen."""
        self._timer.stop()
        self._settled.stop()
        self._window.close()

    def poll(self) -> None:
        """Read the study again if a file has changed; a wrong one leaves the last good view, with a sentence."""
        now = self._state()
        if now == self._seen:
            return
        self._seen = now
        self.reload()

    def reload(self) -> None:
        """Read the study, and show the same screen of it."""
        try:
            study = self._texts.read()
        except UserInputError as refusal:
            self._fault = "\n".join(refusal.sentences)
            self.changed.emit()
            return
        self._fault = ""
        self._study = study
        self._seen = self._state()
        self._window.close()
        self._open()
        self._show()

    @property
    def window(self) -> QQuickWindow:
        """The visitor's screen, which is drawn and not shown."""
        return self._window.shown

    def _open(self) -> None:
        self._window = Window(self._study, self._mode)
        clock = WallClock(self._window.owner)
        self._renderer = Renderer(self._window.screens, clock, lambda _: None)
        self._renderer.embodiments = avatar_alone(self._window, clock, self._study.plans[0])
        self._window.screens.form.answered.connect(self._answer)
        self._window.screens.form.continued.connect(self._go_on)

    def _plan(self) -> SessionConfig:
        languages = self._study.languages
        language = self._language if self._language in languages else languages[0]
        return self._study.plan(language, Condition(self._condition))

    def _show(self) -> None:
        """Show what is chosen, or the first of it where the study has it no longer."""
        if self._language not in self._study.languages:
            self._language = self._study.languages[0]
        if self._condition not in self.conditions_of(self._study):
            self._condition = self._study.settings.assistance.condition
        plan = self._plan()
        if self._screen not in self._get_screens():
            self._screen = "attract"
        width, height = map(int, self._size.split(" x "))
        if (self.window.width(), self.window.height()) != (width, height):
            # A window that was drawn and is not shown hears of no other size; one without a native window does.
            self.window.destroy()
            self.window.resize(width, height)
        self._renderer.reset("attract")
        self._renderer.begin(plan)
        self._show_progress(plan)
        self._renderer.perform(self._effects(plan))
        self._draw()
        self._settled.start(SETTLE_MS)
        self.changed.emit()

    def _show_progress(self, plan: SessionConfig) -> None:
        """Show how far the visit is and whether a visitor can go back, or that there is no visit yet."""
        kiosk = self._window.screens.kiosk
        if self._screen == "attract":
            kiosk.clear()
        elif stage := stage_of(self._screen):
            kiosk.reach(stage.value)
            page = form_pages(plan).get(self._screen)
            order = StageOrder.of(plan.settings.stages)
            is_later = page is not None and page.number > 1
            kiosk.offer_back(offered=is_later or order.before(stage, kept=True) is not None)

    def _effects(self, plan: SessionConfig) -> tuple[Effect, ...]:
        page = form_pages(plan).get(self._screen)
        if page is None or self._given is None:
            return screen_effects(plan)[self._screen]
        given = self._given.get(page.asked.id, {})
        answers = (do.ShowAnswer(item.id, given[item.id]) for item in page.items if item.id in given)
        return (page.effect(page.hidden(given)), *answers)

    def _answer(self, item: str, value: Response | None) -> None:
        """Keep an answer, and show and hide the items that have conditions on it."""
        page = form_pages(self._plan()).get(self._screen)
        if page is None or self._given is None:
            return
        given = self._given.setdefault(page.asked.id, {})
        if value is None:
            given.pop(item, None)
        else:
            given[item] = value
        for hidden in hidden_items(page.asked.items, given):
            given.pop(hidden, None)
        self._renderer.perform((do.ShowAnswer(item, value), do.HideItems(page.hidden(given))))
        self.changed.emit()

    def _go_on(self) -> None:
        """Show the screen after this one."""
        screens = self._get_screens()
        self._screen = screens[min(screens.index(self._screen) + 1, len(screens) - 1)]
        self._show()

    def _draw(self) -> None:
        self.picture.image = self.window.grabWindow()
        self._drawn += 1
        self.drawn.emit()

    @staticmethod
    def conditions_of(study: StudyConfig) -> list[str]:
        """Return the names of all conditions of a study."""
        return list(study.settings.all_conditions)

    def _state(self) -> dict[Path, tuple[int, int]]:
        """Return when each file of the study was changed last, and its size."""
        folder = self._file.absolute().parent
        own = [source.path for source in self._study.sources if not source.is_shipped]
        places = {self._file, *_children(folder)}
        for path in own:
            places |= {path, *(path.rglob("*") if path.is_dir() else ())}
        return dict(filter(None, map(_stamp, places)))

    def _get_screens(self) -> list[str]:
        """Return the screens by their names, without the pages of which the answers so far hide every item."""
        plan = self._plan()
        screens, given = list(screen_effects(plan)), self._given
        if given is not None:
            pages = form_pages(plan).items()
            hidden = {name for name, page in pages if len(page.hidden(given.get(page.asked.id, {}))) == len(page.items)}
            screens = [name for name in screens if name not in hidden]
        return screens

    def _get_languages(self) -> list[str]:
        return list(self._study.languages)

    def _get_conditions(self) -> list[str]:
        return self.conditions_of(self._study)

    def _get_found(self) -> str:
        return f"{self._found.file}: {self._found.key}" if self._found else ""

    screens = Property(list, _get_screens, notify=changed)
    languages = Property(list, _get_languages, notify=changed)
    conditions = Property(list, _get_conditions, notify=changed)
    sizes = Property(list, lambda _: list(SIZES), constant=True)
    screen = Property(str, lambda self: self._screen, notify=changed)
    language = Property(str, lambda self: self._language, notify=changed)
    condition = Property(str, lambda self: self._condition, notify=changed)
    size = Property(str, lambda self: self._size, notify=changed)
    answering = Property(bool, lambda self: self._given is not None, notify=changed)
    to_answer = Property(str, lambda self: self._plan().catalogue.text("preview-answer"), notify=changed)
    title = Property(str, lambda self: self._study.settings.title, notify=changed)
    fault = Property(str, lambda self: self._fault, notify=changed)
    number = Property(int, lambda self: self._drawn, notify=drawn)
    found = Property(str, _get_found, notify=found_changed)
    text = Property(str, lambda self: self._found.text if self._found else "", notify=found_changed)
    note = Property(str, lambda self: self._found.note if self._found else "", notify=found_changed)
    editable = Property(bool, lambda self: bool(self._found and self._found.is_editable), notify=found_changed)

    @Slot(str, str)
    def pick(self, what: str, value: str) -> None:
        """Show another screen, language, size or condition."""
        setattr(self, f"_{what}", value)
        self._find("")
        self._show()

    @Slot(bool)
    def answer(self, answers: bool) -> None:  # noqa: FBT001 - it is what is set
        """Let the viewer answer the forms from the beginning, or show every item and find texts."""
        self._given = {} if answers else None
        self._find("")
        self._show()

    @Slot(float, float)
    def press(self, x: float, y: float) -> None:
        """Find the text at a place of the visitor's screen, or touch it there; both are shares of its size."""
        point = QPointF(x * self.window.width(), y * self.window.height())
        if self._given is not None and self._screen in form_pages(self._plan()):
            touch(self.window, point.toPoint())
            self._draw()
            self._settled.start(SETTLE_MS)
            return
        for shown in _texts_at(self.window.contentItem(), point):
            if self._find(shown):
                return

    @Slot(float, float, float)
    def scroll(self, x: float, y: float, by: float) -> None:
        """Scroll what is at a place of the visitor's screen, by a share of its height."""
        point = QPointF(x * self.window.width(), y * self.window.height())
        for item in _items_at(self.window.contentItem(), point):
            length = item.property("contentHeight")
            if item.inherits("QQuickFlickable") and length > item.height():
                moved = item.property("contentY") + by * item.height()
                item.setProperty("contentY", max(0.0, min(moved, length - item.height())))
                self._draw()
                return

    @Slot(str)
    def write(self, text: str) -> None:
        """Change the text that was clicked on; what is wrong with it is said, and nothing is changed."""
        try:
            self._texts.change(text)
        except UserInputError as refusal:
            self._fault = "\n".join(refusal.sentences)
            self.changed.emit()
            return
        self._find("")
        self.reload()

    @Slot()
    def leave(self) -> None:
        """End the preview."""
        self.left.emit()

    def _find(self, shown: str) -> bool:
        self._found = self._texts.find(self._plan(), shown) if shown else None
        self.found_changed.emit()
        return self._found is not None


def _children(folder: Path) -> Iterator[Path]:
    try:
        yield from folder.iterdir()
    except OSError:
        return


def _stamp(path: Path) -> tuple[Path, tuple[int, int]] | None:
    try:
        known = path.stat()
    except OSError:
        return None
    return path, (known.st_mtime_ns, known.st_size)


def _items_at(item: QQuickItem, point: QPointF) -> Iterator[QQuickItem]:
    """Yield the visible items at a point of the window, the uppermost first."""
    for child in sorted(item.childItems(), key=lambda each: each.z())[::-1]:
        if child.isVisible() and child.opacity() > 0:
            yield from _items_at(child, point)
            if child.contains(child.mapFromScene(point)):
                yield child


def _texts_at(item: QQuickItem, point: QPointF) -> Iterator[str]:
    for each in _items_at(item, point):
        for name in ("text", "words"):
            shown = each.property(name)
            if isinstance(shown, str) and shown.strip():
                yield shown


def show_preview(file: Path, texts: StudyTexts, display: WindowMode = WindowMode.WINDOW) -> None:
    """Show the preview's window until it is closed; raises UserInputError if the study is wrong at the beginning."""
    model = PreviewModel(file, texts, display)
    engine = QQmlApplicationEngine()
    errors: list[BaseException] = []
    try:
        engine.addImageProvider("visitor", model.picture)
        engine.setInitialProperties({"preview": model})
        engine.load(QUrl.fromLocalFile(str(QML)))
        loop = EventLoop(WallClock(engine), engine, partial(_keep, errors, model))
        try:
            model.left.connect(loop.quit)
            loop.run()
        finally:
            loop.close()
    finally:
        for window in engine.rootObjects():
            window.setProperty("visible", False)  # noqa: FBT003 - Qt's way to set a property
        engine.deleteLater()
        # Before the model that its windows look at.
        QCoreApplication.sendPostedEvents(engine, QEvent.Type.DeferredDelete)
        model.close()
    if errors:
        raise errors[0]


def _keep(
    errors: list[BaseException],
    model: PreviewModel,
    _kind: type[BaseException],
    fault: BaseException,
    _at: TracebackType | None,
) -> None:
    errors.append(fault)
    model.leave()
