"""The command that tries everything a booth needs, and says what to do about the rest."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import click
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from kiosk import BadInput
from kiosk.cli.booth.checking.all import Booth, probes
from kiosk.cli.booth.checking.together import look
from kiosk.cli.options import data_option, json_option, robot_host_option, robot_port_option, site_option, study_option
from kiosk.cli.progress import progress_bar
from kiosk.cli.wiring import read_settings
from kiosk.findings import Finding, State
from kiosk.settings import Settings
from kiosk.store.database import in_use
from kiosk.store.people.participants import checked_site
from kiosk.study.declared.checked.whole import read_study
from kiosk.study.plan import Study

NOT_READY = 1
"""The exit code when no sitting can be held."""

_MARKS = {State.GOOD: "yes", State.WARNING: "but", State.BAD: "NO"}
_STYLES = {State.GOOD: "green", State.WARNING: "yellow", State.BAD: "bold red"}
LEAST_WIDTH = 100


@click.command()
@data_option
@study_option
@site_option
@robot_host_option
@robot_port_option
@json_option
@click.pass_context
def check(
    context: click.Context,
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    *,
    as_json: bool,
) -> None:
    """Try everything that a booth needs; exit code 1 if no sitting can be held. Nothing is heard, shown or kept."""
    booth = _booth(data, checked_site(site), study, robot_host, robot_port)
    looks = tuple(probes(booth))
    with progress_bar("looking", len(looks), hidden=as_json) as tell:
        found = look(looks, tell)
    ready = all(finding.state is not State.BAD for finding in found)
    if as_json:
        rows = [asdict(finding) | {"state": finding.state.value} for finding in found]
        click.echo(json.dumps({"ready": ready, "findings": rows}))
    else:
        _show(found, ready=ready)
    if booth.faults:
        raise BadInput(*booth.faults)
    context.exit(0 if ready else NOT_READY)


def _booth(data: Path, site: str, file: Path | None, host: str | None, port: int | None) -> Booth:
    """What is to be looked at; what is wrong with the study file is among it."""
    if data.exists() and not data.is_dir():
        raise BadInput(f"the data folder {data} cannot be used: it is a file")
    settings: Settings | None = None
    study: Study | None = None
    faults: tuple[str, ...] = ()
    try:
        settings = read_settings(file, host, port)
        study = read_study(settings)
    except BadInput as refusal:
        faults = refusal.sentences
    return Booth(data, site, in_use(data), file, settings, study, faults)


def _show(found: tuple[Finding, ...], *, ready: bool) -> None:
    console = Console()
    console.width = max(console.width, LEAST_WIDTH)
    table = Table(box=None, show_header=False, pad_edge=False)
    for finding in found:
        style = _STYLES[finding.state]
        words = finding.words if finding.well else f"{finding.words}\n-> {finding.remedy}"
        table.add_row(f"[{style}]{_MARKS[finding.state]}[/]", finding.what, escape(words))
    console.print(table)
    bad, warnings = (sum(finding.state is state for finding in found) for state in (State.BAD, State.WARNING))
    console.print(_verdict(bad, warnings, ready=ready))


def _verdict(bad: int, warnings: int, *, ready: bool) -> str:
    if not ready:
        return f"No sitting can be held before what is marked {_MARKS[State.BAD]} is mended ({bad})."
    return f"A sitting can be held; to see to: {warnings or 'nothing'}."
