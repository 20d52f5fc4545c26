"""A kiosk without a screen, for tests: on virtual time unless told otherwise."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from time import monotonic

from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtGui import QGuiApplication
from PySide6.QtQuick import QQuickWindow

from kiosk.config import Settings
from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import SessionKind
from kiosk.experiment.session_config import StudyConfig
from kiosk.robots.driver import RobotDriver
from kiosk.store.recorder import Recorder
from kiosk.study.loader import read_study
from kiosk.ui.app import App
from kiosk.ui.condition_assigner import ConditionAssigner, RunContext
from kiosk.ui.screens.registry import ScreenSet
from kiosk.ui.window import ClockMode, RunMode, Window, WindowMode
from tests.patience import PATIENCE_S
from tests.samples import SHORT

VIRTUAL = RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL)
HALF = RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL, size=(960, 540))
"""A window of half the usual size, for tests of what happens: a session in it takes a quarter less to draw."""

SMALL = Settings.model_validate(
    {
        "game": {"rows": 2, "columns": 3},
        "practice": {"rows": 2, "columns": 2},
        "questionnaires": ["gallery"],
        "consent": {"contact": "study@university.test"},
    }
)
"""Every stage and every kind of item, on small boards."""


def short(**sections: object) -> Settings:
    """Return a study without anything to be decided beforehand; ``sections`` are those of a study file."""
    return Settings.model_validate({"stages": SHORT, "questionnaires": ["trust"], **sections})


BRIEF = short(game={"rows": 3, "columns": 4})
"""The same with half the cards, for tests that play sessions of which hints matter: they take half as long."""

TINY = short(game={"rows": 2, "columns": 3})
"""The same with a quarter of the cards, for tests in which a session only has to come to its end."""


PLAIN = short()
"""The same as the study file gives it."""

_OFTEN = [PLAIN, BRIEF, TINY, SMALL]


def often(settings: Settings) -> Settings:
    """Return these settings, whose study is then read only once."""
    _OFTEN.append(settings)
    return settings


@cache
def _often(number: int) -> StudyConfig:
    return read_study(_OFTEN[number])


def study_of(settings: Settings) -> StudyConfig:
    """Return the study of these settings; those that hundreds of tests share are read once."""
    number = next((number for number, shared in enumerate(_OFTEN) if shared is settings), None)
    return read_study(settings) if number is None else _often(number)


def process_until(holds: Callable[[], bool]) -> None:
    """Let Qt do what waits until something is so; fails if it never is."""
    deadline = monotonic() + PATIENCE_S
    while not holds():
        QGuiApplication.processEvents()
        assert monotonic() < deadline, "what was waited for never came"


def resize(window: QQuickWindow, screens: ScreenSet, width: int, height: int) -> None:
    """Give a window this size while it shows no page, and let go of those that were made.

    A page would be laid out and painted in both sizes, and again with each page after it, for as long as it is there.
    """
    ground = window.contentItem()
    if (ground.width(), ground.height()) == (width, height):
        return
    screens.kiosk.show("")
    let_go_of_pages(window)
    window.resize(width, height)
    process_until(lambda: (ground.width(), ground.height()) == (width, height))


def let_go_of_pages(window: QQuickWindow) -> None:
    """Let go of the pages that are out of sight: each would be laid out as often as the one in sight."""
    for item in window.contentItem().childItems():
        for page in (item, *item.childItems()):
            if page.inherits("QQuickLoader") and page.property("shown") is not None:
                page.setProperty("active", page.property("shown"))
    free()


def free() -> None:
    """Free what Qt is to delete later: a test has no event loop, so it would be laid out again and again until then."""
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


@contextmanager
def open_window(study: StudyConfig) -> Iterator[Window]:
    """Open the window of a study, with no kiosk behind it; there must be an application object."""
    window = Window(study, RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL))
    window.show()
    process_until(window.shown.isExposed)
    yield window
    window.close()


@contextmanager
def headless(  # noqa: PLR0913 - all that a kiosk can differ in
    settings: Settings | StudyConfig,
    data: Path,
    *,
    seed: int = 1,
    condition: str | None = "tom",
    mode: RunMode = VIRTUAL,
    robot: RobotDriver | None = None,
    kind: SessionKind = SessionKind.SIMULATED,
    opened: Callable[[Path], Recorder] = Recorder,
) -> Iterator[App]:
    """Provide a kiosk with this study, in this condition, or None for its list's; every session has the same seed.

    ``opened`` gives the recorder of a data folder.
    """
    study = study_of(settings) if isinstance(settings, Settings) else settings
    fixed = Condition.from_name(condition) if condition else None
    origin = RunContext("a test", kind=kind, seed=lambda: seed, condition=fixed)
    with opened(data) as recorder, App(mode, recorder, ConditionAssigner(study, recorder, origin), robot) as app:
        yield app
