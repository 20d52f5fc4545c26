"""A kiosk without a screen, on virtual time, with a data folder of its own."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import mkdtemp

os.environ["QT_QPA_PLATFORM"] = "offscreen"
os.environ["QT_QUICK_BACKEND"] = "software"
os.environ["QSG_RENDER_LOOP"] = "basic"
os.environ["QT_NO_GUI_THREADPOOL"] = "1"

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible, QGuiApplication
from PySide6.QtQuick import QQuickItem
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.experiment.questionnaire import Item
from kiosk.store.queries import SessionRepository, open_repository
from kiosk.store.recorder import Recorder
from kiosk.ui.app import App
from kiosk.ui.event_loop import VirtualClock
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.simulated_visitor import BehaviourProfile, UiDriver, find_item, item_centre, lay_out
from kiosk.ui.window import RunMode, Window
from tests.ui.headless import HALF, PLAIN, free, headless, process_until, resize


@pytest.fixture(scope="session")
def qapp_cls() -> type[QGuiApplication]:
    """Return an application without widgets, as the kiosk has none."""
    return QGuiApplication


@pytest.fixture(scope="session", autouse=True)
def one_engine() -> Iterator[None]:
    """Compile the screens once for all windows of these tests; each has its own objects on them."""
    Window.reuses_engine = True
    yield
    Window.reuses_engine = False
    Window.drop_engine()


LOOKS = {"textSize": 1.0, "highContrast": False, "boardOnRight": False}
"""What tests change of a window beside its size, as it is in a study that says nothing of it."""


@pytest.fixture(autouse=True)
def freed() -> Iterator[None]:
    """Free at the end of each test what Qt is to delete later, for the next one may have the same window."""
    yield
    free()


@dataclass
class Booth:
    """A kiosk at work, and the hand and eye of a visitor in front of it."""

    app: App
    data: Path

    def item(self, name: str) -> QQuickItem:
        """Return the visible item of this name, where it belongs."""
        lay_out(self.app.window)
        item = find_item(self.app.window.contentItem(), name)
        assert item is not None, f"there is no {name} on the screen {self.screen}"
        return item

    def sees(self, name: str) -> bool:
        """Whether an item of this name is to be seen."""
        return find_item(self.app.window.contentItem(), name) is not None

    def click(self, name: str, button: Qt.MouseButton = Qt.MouseButton.LeftButton) -> None:
        """Click in the middle of an item, once the screen takes input; fields to type into are touched."""
        self.settle()
        if name.startswith(("text-", "number-", "key-")) and button is Qt.MouseButton.LeftButton:
            UiDriver(self.app.window).click(name)
            return
        QTest.mouseClick(self.app.window, button, Qt.KeyboardModifier.NoModifier, item_centre(self.item(name)))

    def press(self, key: Qt.Key, modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier) -> None:
        """Press and release a key, once the screen takes input."""
        self.settle()
        QTest.keyClick(self.app.window, key, modifiers)

    def settle(self) -> None:
        """Let a screen that has just come take input."""
        self.wait_until(lambda: self.app.screens.kiosk.takes_input)

    def prepare_pages(self) -> None:
        """Have every page made, as a booth has them after its first frame."""
        shown, kiosk = self.screen, self.app.screens.kiosk
        kiosk.begin((), kiosk.spoken_language, self.app.assigner.study.settings.consent)
        kiosk.clear()
        for page in ("about", "consent", "age", "introduction", "game", "result", "debrief", "thanks", shown):
            kiosk.show(page)
        # Without ever having had cards, the board has not chosen a first one.
        self.app.screens.board.deal(2, 2, 2, "animals")
        self.app.screens.board.clear()
        self.settle()

    def jump(self) -> None:
        """Let time pass until the next wait ends."""
        assert isinstance(self.app.clock, VirtualClock)
        self.app.clock.jump()

    def wait_until(self, condition: Callable[[], bool]) -> None:
        """Let time pass until something is so; nothing in a session takes ten thousand waits."""
        for _ in range(10_000):
            if condition():
                return
            self.jump()
        pytest.fail(f"it never came; the screen is {self.screen}")

    @property
    def screen(self) -> str:
        """The name of the screen that is shown."""
        return self.app.screens.kiosk.shown

    def ask(self, *items: Item) -> None:
        """Show a page of these items."""
        self.app.screens.form.show(items, 1, 1)
        self.app.screens.kiosk.show("form")
        self.settle()

    def start_game(self) -> None:
        """Go from attract to the game of a short study."""
        self.click("start-en")
        self.click("continue")

    def rehearse(self, seed: int, visitor: BehaviourProfile = BehaviourProfile()) -> None:  # noqa: B008 - it is frozen
        """Let a simulated visitor go through a whole session."""
        Rehearsal(self.app, seed, visitor=visitor).run()


MakeBooth = Callable[..., Booth]


@pytest.fixture
def run_mode() -> RunMode:
    """Return how the booths of these tests run: drawn fast, in half the usual size; a module may have its own."""
    return HALF


@pytest.fixture
def make_booth(qtbot: QtBot, tmp_path: Path, run_mode: RunMode) -> Iterator[MakeBooth]:
    """Build a booth, with a short study unless told otherwise; all are taken down at the end."""
    with ExitStack() as built:

        def make(
            seed: int = 1,
            condition: str = "tom",
            settings: Settings | None = None,
            opened: Callable[[Path], Recorder] = Recorder,
        ) -> Booth:
            data = Path(mkdtemp(dir=tmp_path))
            kiosk = headless(settings or PLAIN, data, seed=seed, condition=condition, mode=run_mode, opened=opened)
            app = built.enter_context(kiosk)
            qtbot.waitUntil(lambda: app.window.isExposed() and app.window.isActive())
            return Booth(app, data)

        yield make


@pytest.fixture
def booth(make_booth: MakeBooth) -> Booth:
    """One booth in the condition ToM, with a short study."""
    return make_booth()


@contextmanager
def shared_booth(
    settings: Settings, data: Path, *, mode: RunMode = HALF, opened: Callable[[Path], Recorder] = Recorder
) -> Iterator[Booth]:
    """Open a booth for all tests of a module, by default in half the usual size; its window has the keyboard."""
    with headless(settings, data, mode=mode, opened=opened) as app:
        process_until(lambda: app.window.isExposed() and app.window.isActive())
        yield Booth(app, data)


@pytest.fixture(scope="module")
def module_booth(qapp: QGuiApplication, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Booth]:  # noqa: ARG001 - Qt is to be there
    """Provide one booth for all tests of a module: they show pages and begin no session."""
    with shared_booth(PLAIN, tmp_path_factory.mktemp("booth")) as booth:
        yield booth


@pytest.fixture
def resting_booth(module_booth: Booth, qtbot: QtBot) -> Booth:
    """Return that booth, with nothing left of the test before."""
    window, screens = module_booth.app.window, module_booth.app.screens
    # The test before may have had another window.
    window.requestActivate()
    qtbot.waitUntil(window.isActive)
    screens.clear()
    screens.kiosk.show("attract")
    return module_booth


@pytest.fixture
def restored_booth(module_booth: Booth, request: pytest.FixtureRequest) -> Booth:
    """Return that booth with the looks and the size that it had at first."""
    window, screens = module_booth.app.window, module_booth.app.screens
    resize(window, screens, *HALF.size)
    for name, value in LOOKS.items():
        window.setProperty(name, value)
    # It shows a page again, which would be laid out for each of these.
    rested: Booth = request.getfixturevalue("resting_booth")
    return rested


@pytest.fixture
def stored(booth: Booth) -> Iterator[SessionRepository]:
    """Provide what the booth has stored."""
    with open_repository(booth.data) as there:
        yield there


@pytest.fixture(scope="module")
def spoken(qapp: QGuiApplication) -> Iterator[None]:  # noqa: ARG001 - Qt is to be there before
    """Provide a program that reads the screen aloud is there."""
    before = QAccessible.isActive()
    QAccessible.setActive(True)
    yield
    QAccessible.setActive(before)
