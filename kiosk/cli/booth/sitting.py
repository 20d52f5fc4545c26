"""The command that opens the kiosk for visitors."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from random import SystemRandom
from typing import Any

import click

from kiosk.cli.options import data_option, json_option, robot_host_option, robot_port_option, site_option, study_option
from kiosk.cli.wiring import check_pin, code_commit, log_into, read_settings
from kiosk.keeping.guard import guarded
from kiosk.store.recorder import Recorder
from kiosk.study.declared.checked.whole import read_study
from kiosk.study.session_kind import kind_of
from kiosk.ui.app import App
from kiosk.ui.desk import Desk, Origin
from kiosk.ui.window import Display, Mode, check_screen

SEED_BITS = 63
"""As many as the column holds: boards are published, and nobody shall find a seed, and with it the code, by trying."""


@click.command("open")
@data_option
@study_option
@robot_host_option
@robot_port_option
@site_option
@click.option("--unattended", is_flag=True, hidden=True, help="Refuse a study without a PIN; the keeper says so.")
@click.option("--window", is_flag=True, help="Open a window instead of the full screen.")
@json_option
def open_kiosk(
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    *,
    unattended: bool,
    window: bool,
    as_json: bool,
) -> None:
    """Open the kiosk for visitors; Ctrl+Shift+Q leaves it."""
    with guarded() as beat:
        told = _open(data, study, site, robot_host, robot_port, beat, unattended=unattended, window=window)
    click.echo(json.dumps(told) if as_json else f"{told['sittings']} sittings were recorded in {data}.")


def _open(
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    beat: Callable[[], None],
    *,
    unattended: bool,
    window: bool,
) -> dict[str, Any]:
    """Open the kiosk until it is left; returns what is told of it."""
    prepared = read_study(read_settings(study, robot_host, robot_port))
    if unattended:
        check_pin(prepared.settings)
    chance = SystemRandom()
    origin = Origin(code_commit(), simulated=kind_of(prepared.settings), seed=lambda: chance.getrandbits(SEED_BITS))
    mode = Mode(Display.WINDOW if window else Display.FULL_SCREEN)
    check_screen(mode.display)
    with Recorder(data, site) as recorder:
        log_into(data)
        with App(mode, recorder, Desk(prepared, recorder, origin), beat=beat) as app:
            app.run()
    return {"data": str(data), "sittings": recorder.begun, "interrupted_before": list(recorder.recovered)}
