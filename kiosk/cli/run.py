"""Commands that open the kiosk, supervised or not, and their internal processes."""

from __future__ import annotations

import json
import logging
import signal
import sys
from collections.abc import Callable, Iterable
from dataclasses import asdict
from pathlib import Path
from random import SystemRandom
from typing import Any

import click

from kiosk import UserInputError, program
from kiosk.cli.composition import check_pin, code_commit, log_into, read_settings
from kiosk.cli.main import BAD_INPUT
from kiosk.cli.options import (
    data_option,
    json_option,
    read_catalogue,
    robot_host_option,
    robot_port_option,
    shipped_languages,
    site_option,
    study_option,
)
from kiosk.experiment.session_config import kind_of
from kiosk.preflight import CheckResult
from kiosk.robots.registry import check_robot
from kiosk.robots.tts_worker import run_tts_worker
from kiosk.store.recorder import Recorder
from kiosk.study.loader import read_study
from kiosk.supervisor import REFUSED, Supervisor, SupervisorEvent, SupervisorEventKind, Timeouts, guarded
from kiosk.ui.app import App
from kiosk.ui.checks import to_json
from kiosk.ui.qt_platform import missing_library, obstacle
from kiosk.ui.session_runner import ConditionAssigner, RunContext
from kiosk.ui.window import RunMode, WindowMode, check_screen

SEED_BITS = 63
"""As many as the column holds: boards are published, and nobody shall find a seed, and with it the code, by trying."""


@click.command("open")
@data_option
@study_option
@robot_host_option
@robot_port_option
@site_option
@click.option("--unattended", is_flag=True, hidden=True, help="Refuse a study without a PIN; the supervisor says so.")
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
    """Open the kiosk until it is left; returns what is told of it."""
    prepared = read_study(read_settings(study, robot_host, robot_port))
    check_robot(prepared.settings)
    if unattended:
        check_pin(prepared.settings)
    chance = SystemRandom()
    origin = RunContext(code_commit(), simulated=kind_of(prepared.settings), seed=lambda: chance.getrandbits(SEED_BITS))
    mode = RunMode(WindowMode.WINDOW if window else WindowMode.FULL_SCREEN)
    check_screen(mode.display)
    with Recorder(data, site) as recorder:
        log_into(data)
        with App(mode, recorder, ConditionAssigner(prepared, recorder, origin), beat=beat) as app:
            app.run()
    return {"data": str(data), "sessions": recorder.sessions_begun, "interrupted_before": list(recorder.recovered)}


# Qt is loaded by the look itself: where the system lacks a library that it needs, that is what is found.
# ruff: noqa: PLC0415


@click.group(hidden=True)
def display_command() -> None:
    """Look at the display and print what was found; a check starts it."""


@display_command.command()
@click.argument("number", type=int)
def screens_command(number: int) -> None:
    """Look at the screens, of which the kiosk is to cover this one."""

    def look() -> Iterable[CheckResult]:
        from kiosk.ui.checks import screens_check as look_at

        return look_at(number)

    _print("screen", look)


@display_command.command()
def pictures() -> None:
    """Draw the pictures that are named on standard input."""
    from kiosk.ui.checks import draw as draw_pictures

    draw_pictures(sys.stdin, sys.stdout)


@display_command.command()
@study_option
def frame_command(study: Path | None) -> None:
    """Draw the kiosk where nobody sees it."""

    def look() -> Iterable[CheckResult]:
        from kiosk.ui.checks import frame_check as draw

        return draw(read_study(read_settings(study)))

    _print("drawing", look)


def _print(what: str, look: Callable[[], Iterable[CheckResult]]) -> None:
    try:
        found = to_json(look())
    except ImportError as error:
        missing = missing_library(error)
        if missing is None:
            raise
        found = to_json([CheckResult.bad(what, missing.words, missing.remedy)])
    click.echo(found)


@click.command(hidden=True)
@click.argument("options")
def voice_command(options: str) -> None:
    """Be the voice, in a process of its own; the kiosk starts it."""
    run_tts_worker(json.loads(options))


_TROUBLE = {
    SupervisorEventKind.DIED,
    SupervisorEventKind.HUNG,
    SupervisorEventKind.SWELLED,
    SupervisorEventKind.PAUSE,
    SupervisorEventKind.REFUSED,
    SupervisorEventKind.NO_MEANWHILE,
}

_log = logging.getLogger(__name__)


@click.command()
@data_option
@click.option(
    "--silence",
    type=click.FloatRange(1, 600),
    default=Timeouts.silence,
    show_default=True,
    help="Seconds without a sign of life after which the kiosk hangs.",
)
@click.option("--json", "as_json", is_flag=True, help="Print what happens as JSON lines, for programs.")
@click.argument("options", nargs=-1, type=click.UNPROCESSED)
@click.pass_context
def keep_command(
    context: click.Context, data: Path, silence: float, options: tuple[str, ...], *, as_json: bool
) -> None:
    """Open the kiosk and start it again whenever it dies or hangs; it ends when the experimenter leaves it.

    The study needs a PIN: 'recollect study set-pin' prints the lines for its file.

    OPTIONS after -- are those of 'recollect open'.
    """
    _refuse_without_pin(options)
    log_into(data, shared=True)

    def tell(happening: SupervisorEvent) -> None:
        if as_json:
            click.echo(json.dumps(asdict(happening) | {"what": happening.what.value}))
        _write_down(happening)

    kiosk = program("open", "--unattended", "--data", str(data), *options)
    supervisor = Supervisor(kiosk, program("_splash"), tell, Timeouts(silence=silence))
    for ending in (signal.SIGINT, signal.SIGTERM):
        signal.signal(ending, lambda *_: supervisor.end())
    code = supervisor.run()
    if code == REFUSED:
        click.echo("recollect: the kiosk refused what it was given, so it is not started again", err=True)
    context.exit(code)


def _refuse_without_pin(options: tuple[str, ...]) -> None:
    """Raise BadInput for a study without a PIN, before a window is shown; what else is wrong the kiosk says."""
    only_study = click.Command("open", params=[click.Option(["--study"], type=click.Path(path_type=Path))])
    only_study.ignore_unknown_options = only_study.allow_extra_args = True
    study = only_study.make_context("open", list(options), resilient_parsing=True).params["study"]
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


@click.command(hidden=True)
def splash_command() -> None:
    """Show the calm window that lies underneath the kiosk; the supervisor starts it."""
    if obstacle() is not None:
        # The kiosk, which meets it as well, says what to do.
        sys.exit(BAD_INPUT)
    from kiosk.ui.splash import show_splash

    show_splash([read_catalogue(language).text("splash-line") for language in shipped_languages()])
