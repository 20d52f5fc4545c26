"""Opens the kiosk for visitors. ``run`` loads this module once a first picture is on the screen."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import SystemRandom
from typing import Any

from kiosk.cli.composition import check_pin, code_commit_beside, read_settings
from kiosk.cli.log import log_into
from kiosk.experiment.session_config import kind_of
from kiosk.lazy_dataclass import dataclass
from kiosk.robots.registry import check_robot
from kiosk.store.database import wait_until_free
from kiosk.store.recorder import Recorder
from kiosk.study.loader import read_study
from kiosk.ui.app import App
from kiosk.ui.condition_assigner import ConditionAssigner, RunContext
from kiosk.ui.event_loop import after_first_frame
from kiosk.ui.window import RunMode, Window, WindowMode, check_screen

SEED_BITS = 63
"""As many as the column holds. Boards are published: seeds, and so codes, must not be found by trying."""

LEFTOVER_S = 15.0
"""How long a supervised kiosk waits for one before it whose supervisor was lost: that one ends by itself."""


@dataclass(frozen=True)
class Opening:
    """What the command line says of the kiosk to open."""

    data: Path
    study: Path | None
    site: str
    robot_host: str | None
    robot_port: int | None
    unattended: bool
    window: bool


def open_kiosk(asked: Opening, beat: Callable[[], None], drawn: Callable[[], None]) -> dict[str, Any]:
    """Open the kiosk until it is left, and return what to report of it.

    ``beat`` is called out of the event loop, and ``drawn`` once the kiosk's own first frame is on the screen.
    """
    commit = code_commit_beside()
    Window.begin_to_load()
    try:
        return _open(asked, beat, drawn, commit)
    finally:
        # What was refused has opened no window.
        Window.drop_engine()


def _open(
    asked: Opening, beat: Callable[[], None], drawn: Callable[[], None], commit: Callable[[], str]
) -> dict[str, Any]:
    prepared = read_study(read_settings(asked.study, asked.robot_host, asked.robot_port))
    check_robot(prepared.settings)
    if asked.unattended:
        check_pin(prepared.settings)
    chance = SystemRandom()
    origin = RunContext(commit(), kind=kind_of(prepared.settings), seed=lambda: chance.getrandbits(SEED_BITS))
    mode = RunMode(WindowMode.WINDOW if asked.window else WindowMode.FULL_SCREEN)
    check_screen(mode.display)
    if asked.unattended:
        wait_until_free(asked.data, LEFTOVER_S)
    with Recorder(asked.data, asked.site) as recorder:
        log_into(asked.data)
        with App(mode, recorder, ConditionAssigner(prepared, recorder, origin), beat=beat) as app:
            after_first_frame(app.window, drawn)
            app.run()
    return {
        "data": str(asked.data),
        "sessions": recorder.sessions_recorded,
        "interrupted_before": list(recorder.recovered),
    }
