"""Commands that open the kiosk, supervised or not, and their internal processes."""

from __future__ import annotations

import json
import logging
import signal
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path
from random import SystemRandom
from typing import Any

import click

from kiosk import UserInputError, program
from kiosk.cli.composition import check_pin, code_commit, log_into, read_settings
from kiosk.cli.options import (
    data_option,
    robot_host_option,
    robot_port_option,
    site_option,
    study_option,
)
from kiosk.experiment.session_config import kind_of
from kiosk.robots.registry import check_robot
from kiosk.store.recorder import Recorder
from kiosk.study.loader import read_study
from kiosk.supervisor import REFUSED, Supervisor, SupervisorEvent, SupervisorEventKind, Timeouts, guarded
from kiosk.ui.app import App
from kiosk.ui.session_runner import ConditionAssigner, RunContext
from kiosk.ui.window import RunMode, WindowMode, check_screen

SEED_BITS = 63
"""As many as the column holds. Boards are published: seeds, and so codes, must not be found by trying."""


@click.command("run")
@data_option
@study_option
@robot_host_option
@robot_port_option
@site_option
@click.option("--window", is_flag=True, help="Open a window instead of the full screen.")
@click.option(
    "--supervise",
    is_flag=True,
    help="Start the kiosk again whenever it dies or hangs; the study needs a PIN ('recollect study set-pin').",
)
@click.option(
    "--silence",
    type=click.FloatRange(1, 600),
    default=Timeouts.silence,
    show_default=True,
    help="With --supervise: seconds without a sign of life after which the kiosk hangs.",
)
@click.option("--unattended", is_flag=True, hidden=True, help="Refuse a study without a PIN; the supervisor says so.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON, for programs; with --supervise a line per event.")
@click.pass_context
def run_command(
    context: click.Context,
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    silence: float,
    *,
    window: bool,
    supervise: bool,
    unattended: bool,
    as_json: bool,
) -> None:
    """Open the kiosk for visitors; Ctrl+Shift+Q leaves it."""
    if supervise:
        _refuse_without_pin(study)
        given = {"--study": study, "--robot-host": robot_host, "--robot-port": robot_port}
        options = (str(word) for option in given.items() if option[1] is not None for word in option)
        flags = ("--unattended", "--window") if window else ("--unattended",)
        kiosk = program("run", *flags, "--data", str(data), "--site", site, *options)
        context.exit(_supervise(kiosk, data, silence, as_json=as_json))
    with guarded() as beat:
        told = _open(data, study, site, robot_host, robot_port, beat, unattended=unattended, window=window)
    click.echo(json.dumps(told) if as_json else f"{told['sessions']} sessions were recorded in {data}.")


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
    """Open the kiosk until it is left; returns what to report of it."""
    prepared = read_study(read_settings(study, robot_host, robot_port))
    check_robot(prepared.settings)
    if unattended:
        check_pin(prepared.settings)
    chance = SystemRandom()
    origin = RunContext(code_commit(), kind=kind_of(prepared.settings), seed=lambda: chance.getrandbits(SEED_BITS))
    mode = RunMode(WindowMode.WINDOW if window else WindowMode.FULL_SCREEN)
    check_screen(mode.display)
    with Recorder(data, site) as recorder:
        log_into(data)
        with App(mode, recorder, ConditionAssigner(prepared, recorder, origin), beat=beat) as app:
            app.run()
    return {"data": str(data), "sessions": recorder.sessions_begun, "interrupted_before": list(recorder.recovered)}


_TROUBLE = {
    SupervisorEventKind.DIED,
    SupervisorEventKind.HUNG,
    SupervisorEventKind.SWELLED,
    SupervisorEventKind.PAUSE,
    SupervisorEventKind.REFUSED,
    SupervisorEventKind.NO_MEANWHILE,
}

_log = logging.getLogger(__name__)


def _supervise(kiosk: Sequence[str], data: Path, silence: float, *, as_json: bool) -> int:
    """Start the kiosk with this command, again and again, until it is left; returns the exit code."""
    log_into(data, shared=True)

    def tell(happening: SupervisorEvent) -> None:
        if as_json:
            click.echo(json.dumps(asdict(happening) | {"what": happening.what.value}))
        _write_down(happening)

    supervisor = Supervisor(kiosk, program("_splash"), tell, Timeouts(silence=silence))
    for ending in (signal.SIGINT, signal.SIGTERM):
        signal.signal(ending, lambda *_: supervisor.end())
    code = supervisor.run()
    if code == REFUSED:
        click.echo("recollect: the kiosk refused what it was given, so it is not started again", err=True)
    return code


def _refuse_without_pin(study: Path | None) -> None:
    """Raise UserInputError for a study without a PIN, before a window is shown; the kiosk reports other mistakes."""
    try:
        settings = read_settings(study)
    except UserInputError:
        return
    check_pin(settings)


def _write_down(happening: SupervisorEvent) -> None:
    """Into the log of the data folder: trouble, and that it is over."""
    if happening.what in _TROUBLE or happening.away_s is not None:
        away = "" if happening.away_s is None else f" ({happening.away_s:.1f} s)"
        detail = f": {happening.detail}" if happening.detail else ""
        _log.warning("start %d of the kiosk: %s%s%s", happening.start, happening.what.value, detail, away)
