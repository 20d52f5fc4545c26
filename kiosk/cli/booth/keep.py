"""``recollect keep`` keeps the kiosk up where no system service does, and shows something calm while it is away."""

from __future__ import annotations

import json
import logging
import signal
import sys
from dataclasses import asdict
from pathlib import Path

import click

from kiosk import BadInput, program
from kiosk.cli.front import BAD_INPUT
from kiosk.cli.languages import catalogue, languages
from kiosk.cli.options import data_option
from kiosk.cli.wiring import check_pin, log_into, read_settings
from kiosk.keeping.keeper import REFUSED, Happening, Keeper, What
from kiosk.keeping.watch import Patience
from kiosk.ui.qt_platform import obstacle

_TROUBLE = {What.DIED, What.HUNG, What.SWELLED, What.PAUSE, What.REFUSED, What.NO_MEANWHILE}

_log = logging.getLogger(__name__)


@click.command()
@data_option
@click.option(
    "--silence",
    type=click.FloatRange(1, 600),
    default=Patience.silence,
    show_default=True,
    help="Seconds without a sign of life after which the kiosk hangs.",
)
@click.option("--json", "as_json", is_flag=True, help="Print what happens as JSON lines, for programs.")
@click.argument("options", nargs=-1, type=click.UNPROCESSED)
@click.pass_context
def keep(context: click.Context, data: Path, silence: float, options: tuple[str, ...], *, as_json: bool) -> None:
    """Open the kiosk and start it again whenever it dies or hangs; it ends when the experimenter leaves it.

    The study needs a PIN: 'recollect study pin' prints the lines for its file.

    OPTIONS after -- are those of 'recollect open'.
    """
    _refuse_without_pin(options)
    log_into(data, shared=True)

    def tell(happening: Happening) -> None:
        if as_json:
            click.echo(json.dumps(asdict(happening) | {"what": happening.what.value}))
        _write_down(happening)

    kiosk = program("open", "--unattended", "--data", str(data), *options)
    keeper = Keeper(kiosk, program("meanwhile"), tell, Patience(silence=silence))
    for ending in (signal.SIGINT, signal.SIGTERM):
        signal.signal(ending, lambda *_: keeper.end())
    code = keeper.run()
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
    except BadInput:
        return
    check_pin(settings)


def _write_down(happening: Happening) -> None:
    """Into the log of the data folder: trouble, and that it is over."""
    if happening.what in _TROUBLE or happening.away_s is not None:
        away = "" if happening.away_s is None else f" ({happening.away_s:.1f} s)"
        detail = f": {happening.detail}" if happening.detail else ""
        _log.warning("start %d of the kiosk: %s%s%s", happening.start, happening.what.value, detail, away)


@click.command(hidden=True)
def meanwhile() -> None:
    """Show the calm window that lies underneath the kiosk; the keeper starts it."""
    if obstacle() is not None:
        # The kiosk, which meets it as well, says what to do.
        sys.exit(BAD_INPUT)
    from kiosk.ui.meanwhile import show_meanwhile  # noqa: PLC0415 - the keeper itself opens no window

    show_meanwhile([catalogue(language).text("meanwhile-line") for language in languages()])
