"""Try every page of a study in every language and window, and find texts that are cut off."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory

from kiosk.cli.composition import code_commit
from kiosk.cli.rehearse import open_recorder
from kiosk.config import RobotConfig
from kiosk.experiment.outcomes import SessionKind, Stage
from kiosk.experiment.session_config import StudyConfig
from kiosk.guard import guarded
from kiosk.study.loader import read_study
from kiosk.ui.app import App
from kiosk.ui.condition_assigner import ConditionAssigner, RunContext
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.simulated_visitor import BehaviourKind, BehaviourProfile, MemoryTraits, ReadingDriver, UiTimeout
from kiosk.ui.window import ClockMode, RunMode, WindowMode

SIZES = ((1280, 720), (1920, 1080), (1080, 1920))
"""The windows that every page is tried in, in pixels: the smallest, the usual one, and one that stands upright."""


def walk_pages(study: StudyConfig) -> Iterator[tuple[bool, str]]:
    """Go through a session in every language and window; yields whether something is a fault, and a sentence about it.

    Nothing is kept, and no robot is looked for.
    """
    settings = study.settings
    alone = settings.model_copy(update={"robot": RobotConfig()}).with_base_dir(settings)
    study = read_study(alone)
    fixed = study.condition(alone.assistance.condition)
    origin = RunContext(code_commit(), kind=SessionKind.SIMULATED, seed=lambda: 1, condition=fixed)
    mode = RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL)
    for language, (width, height) in product(study.languages, SIZES):
        place = f"in {language!r}, on a window of {width} x {height}"
        cut: dict[str, None] = {}
        stuck = _walk(study, mode, origin, language, (width, height), cut)
        if stuck is not None:
            yield True, f"{place}, a session cannot go on: {stuck}"
        for text in cut:
            shown = text if len(text) <= _SHOWN_CHARACTERS else f"{text[:_SHOWN_CHARACTERS]}..."
            yield False, f"{place}, a text is cut off: {shown!r}; make it shorter"


_SHOWN_CHARACTERS = 60


def _walk(
    study: StudyConfig,
    mode: RunMode,
    origin: RunContext,
    language: str,
    size: tuple[int, int],
    cut: dict[str, None],
) -> UiTimeout | None:
    """Go through one session, and add texts that are cut off to ``cut``; return why it stuck."""
    with (
        TemporaryDirectory() as unkept,
        guarded() as beat,
        open_recorder(Path(unkept), mode) as recorder,
        App(mode, recorder, ConditionAssigner(study, recorder, origin), beat=beat) as app,
    ):
        app.window.resize(*size)
        screens = app.screens
        hand = partial(
            ReadingDriver,
            page=lambda: (screens.kiosk.shown, tuple(item.id for item in screens.form.shown)),
            tell=lambda text: cut.update({text: None}),
        )
        visitor = BehaviourProfile(BehaviourKind.COMPLETES, Stage.GAME, language, MemoryTraits())
        try:
            Rehearsal(app, 1, None, visitor, hand).run()
        except UiTimeout as stuck:
            return stuck
    return None
