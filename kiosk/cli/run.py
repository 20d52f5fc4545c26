"""Commands that open the kiosk, supervised or not, and play a stored session again in its window."""

from __future__ import annotations

import json
import logging
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path

import click

from kiosk import UserInputError, program
from kiosk.cli.composition import check_pin, read_settings
from kiosk.cli.options import data_option, robot_host_option, robot_port_option, site_option, study_option
from kiosk.cli.terminal import counted, tell_line
from kiosk.garbage import no_collections
from kiosk.guard import guarded
from kiosk.supervisor import REFUSED, Supervisor, SupervisorEvent, SupervisorEventKind, Timeouts
from kiosk.ui.qt_platform import obstacle, remove_import_hook

# What opens the kiosk is loaded once the first picture is on the screen.
# ruff: noqa: PLC0415


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
    """Open the kiosk for visitors.

    Ctrl+Shift+Q leaves it. Without a PIN in the study file it runs a trial, which is not exported.
    """
    if supervise:
        _refuse_without_pin(study)
        context.exit(
            supervise_kiosk(data, study, site, robot_host, robot_port, window=window, silence=silence, as_json=as_json)
        )
    # Above the supervisor's calm window it would only be one more picture that changes.
    shown = not (window or unattended)
    with guarded() as beat, no_collections() as collect, _splash(study, shown=shown) as hide:
        # Before most of the modules, so that their sources are not read.
        remove_import_hook()
        from kiosk.cli.opening import Opening, open_kiosk

        def opened() -> None:
            hide()
            collect()

        asked = Opening(data, study, site, robot_host, robot_port, unattended=unattended, window=window)
        told = open_kiosk(asked, beat, opened)
    tell_line(json.dumps(told) if as_json else f"{counted(told['sessions'], 'session')} recorded in {data}.")


@contextmanager
def _splash(study: Path | None, *, shown: bool) -> Iterator[Callable[[], None]]:
    """Show the first picture, if there is a screen to show it on; gives what hides it."""
    if not shown or obstacle() is not None:
        # What hinders the picture hinders the kiosk as well, which says so.
        yield lambda: None
        return
    from kiosk.ui.startup_splash import look_of, startup_splash

    with startup_splash(look_of(study)) as window:
        yield window.hide


_TROUBLE = {
    SupervisorEventKind.DIED,
    SupervisorEventKind.HUNG,
    SupervisorEventKind.SWELLED,
    SupervisorEventKind.PAUSE,
    SupervisorEventKind.REFUSED,
    SupervisorEventKind.NO_MEANWHILE,
}

_log = logging.getLogger(__name__)


def supervise_kiosk(
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    *,
    window: bool,
    silence: float = Timeouts.silence,
    as_json: bool,
) -> int:
    """Keep a kiosk open for visitors until it is left; returns the exit code."""
    given = {"--study": study, "--robot-host": robot_host, "--robot-port": robot_port}
    options = (str(word) for option in given.items() if option[1] is not None for word in option)
    flags = ("--unattended", "--window") if window else ("--unattended",)
    kiosk = program("run", *flags, "--data", str(data), "--site", site, *options)
    return _supervise(kiosk, data, silence, as_json=as_json)


def _supervise(kiosk: Sequence[str], data: Path, silence: float, *, as_json: bool) -> int:
    """Start the kiosk with this command, again and again, until it is left; returns the exit code."""
    from kiosk.cli.log import log_into

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
