"""A kiosk without a screen, for tests: on virtual time unless told otherwise."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from kiosk.robot.device import Robot
from kiosk.settings import Settings
from kiosk.store.recorder import Recorder
from kiosk.study.condition import Condition
from kiosk.study.declared.checked.whole import read_study
from kiosk.study.session_kind import SessionKind
from kiosk.ui.app import App
from kiosk.ui.desk import Desk, Origin
from kiosk.ui.window import Display, Mode, Pace
from tests.samples import SHORT

VIRTUAL = Mode(Display.NOWHERE, Pace.VIRTUAL)

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
    """A study without anything to be decided beforehand; ``sections`` are those of a study file."""
    return Settings.model_validate({"stages": SHORT, "questionnaires": ["trust"], **sections})


@contextmanager
def headless(  # noqa: PLR0913 - all that a kiosk can differ in
    settings: Settings,
    data: Path,
    *,
    seed: int = 1,
    condition: str | None = "tom",
    mode: Mode = VIRTUAL,
    robot: Robot | None = None,
    kind: SessionKind = SessionKind.SIMULATED,
    opened: Callable[[Path], Recorder] = Recorder,
) -> Iterator[App]:
    """A kiosk with this study, in this condition, or None for its list's; every sitting has the same seed.

    ``opened`` gives the recorder of a data folder.
    """
    study = read_study(settings)
    fixed = Condition.named(condition) if condition else None
    origin = Origin("a test", simulated=kind, seed=lambda: seed, condition=fixed)
    with opened(data) as recorder, App(mode, recorder, Desk(study, recorder, origin), robot) as app:
        yield app
