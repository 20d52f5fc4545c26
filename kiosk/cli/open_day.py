"""The command `open-day`: the morning checklist of a booth, which ends with the kiosk running supervised."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import click

from kiosk import StorageError, UserInputError
from kiosk.cli.check import CheckTargets, all_checks, booth_of, in_order_of_severity, run_checks, say_all, show
from kiosk.cli.composition import check_pin
from kiosk.cli.devices import greet
from kiosk.cli.options import (
    data_option,
    json_option,
    progress_bar,
    robot_host_option,
    robot_port_option,
    site_option,
    study_option,
)
from kiosk.cli.run import supervise_kiosk
from kiosk.cli.terminal import confirm, tell_line
from kiosk.config import Settings
from kiosk.experiment.session_config import StudyConfig
from kiosk.preflight import WHAT, CheckResult, Severity
from kiosk.store import drives, maintenance
from kiosk.store.copies import CopyKind, note_copy
from kiosk.store.database import has_database, in_use
from kiosk.store.participants import checked_site

HELLO = "attract-greeting"
"""What the robot says: a word of welcome that every language has."""

NOT_OPENED = 1
"""The exit code when the day was not opened."""


@dataclass(frozen=True)
class Step:
    """One step of the morning: whether it went well, and what came of it."""

    step: str
    ok: bool
    found: str
    may_go_on: bool = True
    """Whether you may go on where it did not go well."""


Ask = Callable[[str], bool]
"""Puts a question that is answered with yes or no."""


@click.command("open-day")
@data_option
@study_option
@site_option
@robot_host_option
@robot_port_option
@click.option("--to", metavar="PLACE", help="Copy the data there as well: a folder, a drive by name, or 'stick'.")
@click.option("--window", is_flag=True, help="Open a window instead of the full screen.")
@click.option("--yes", is_flag=True, help="Ask nothing; every answer is yes.")
@json_option
@click.pass_context
def open_day_command(
    context: click.Context,
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    to: str | None,
    *,
    window: bool,
    yes: bool,
    as_json: bool,
) -> None:
    """Go through the morning checklist, then open the kiosk.

    Everything is checked, the voice and the robot say a sentence, the data are copied, and you are reminded of what
    the study file lists in experimenter.reminders. Then the kiosk opens, supervised. Exit code 1 if something keeps
    it closed.
    """
    booth = booth_of(data, checked_site(site), study, robot_host, robot_port)
    if booth.settings is None or booth.study is None:
        raise UserInputError(*booth.faults)
    check_pin(booth.settings)
    if in_use(data):
        raise UserInputError(f"a kiosk is open on {data} already: leave it first")

    def ask(question: str) -> bool:
        return yes or confirm(question, default=True)

    def tell(step: Step) -> None:
        if as_json:
            click.echo(json.dumps({"step": step.step, "ok": step.ok, "found": step.found}))
        else:
            tell_line(f"{'OK' if step.ok else 'WARN':6}{step.step:12}{step.found}")

    for step in _steps(booth, booth.settings, booth.study, to, ask, as_json=as_json):
        tell(step)
        if not step.ok and not (step.may_go_on and ask(f"{step.step}: go on all the same?")):
            context.exit(NOT_OPENED)
    tell(Step("kiosk", ok=True, found="it opens now, supervised"))
    context.exit(supervise_kiosk(data, study, site, robot_host, robot_port, window=window, as_json=as_json))


def _steps(
    booth: CheckTargets, settings: Settings, study: StudyConfig, to: str | None, ask: Ask, *, as_json: bool
) -> Iterator[Step]:
    """Take one step after another."""
    yield _checked(booth, as_json=as_json)
    yield from _voice(settings, say_all(booth), ask)
    yield from _robot(settings, study, ask)
    yield _backup(settings, booth.folder)
    if to is not None:
        yield _carried(settings, booth.folder, to)
    for reminder in settings.experimenter.reminders:
        yield Step("reminder", ask(f"{reminder} - done?"), reminder)


def _checked(booth: CheckTargets, *, as_json: bool) -> Step:
    """Try everything, and show it to a person."""
    looks = tuple(all_checks(booth))
    with progress_bar("looking", len(looks), hidden=as_json) as tell:
        found = run_checks(looks, tell)
    # It ends with a supervisor, so there is no need for another one.
    found = in_order_of_severity(each for each in found if each.name != WHAT or each.is_ok)
    if not as_json:
        show(found)
    failing = ", ".join(each.name for each in found if each.severity is Severity.ERROR)
    if failing:
        return Step("check", ok=False, found=f"no session can be held: {failing}", may_go_on=False)
    warnings = ", ".join(dict.fromkeys(each.name for each in found if not each.is_ok))
    return Step("check", ok=not warnings, found=f"a session can be held; warnings: {warnings or 'none'}")


def _voice(settings: Settings, said: Iterator[CheckResult], ask: Ask) -> Iterator[Step]:
    """Say a sentence in every language, and ask whether it was heard."""
    if not settings.voice.enabled:
        yield Step("voice", ok=True, found="switched off in the study file")
        return
    for result in said:
        heard = result.is_ok and ask(f"{result.message}. Did you hear it?")
        found = result.message if heard or not result.is_ok else "you did not hear it: look at the loudspeaker's volume"
        yield Step("voice", heard, found)


def _robot(settings: Settings, study: StudyConfig, ask: Ask) -> Iterator[Step]:
    """Have the robot say hello; without it the avatar helps."""
    plan = study.plans[0]
    tried = greet(settings, plan.language, plan.catalogue.wordings(HELLO)[0])
    if tried is None:
        yield Step("robot", ok=True, found="none in the study file: the avatar helps")
    elif not tried.worked:
        yield Step("robot", ok=False, found=f"{tried.found}; the avatar helps in its place")
    else:
        heard = ask("The robot said hello. Did it?")
        yield Step("robot", heard, "it said hello" if heard else "you did not hear it say hello: look at its volume")


def _backup(settings: Settings, data: Path) -> Step:
    if not has_database(data):
        return Step("backup", ok=True, found="nothing is stored yet")
    try:
        copy = maintenance.back_up(data, data / maintenance.FOLDER, settings.experimenter.backups)
    except (StorageError, UserInputError) as failure:
        return Step("backup", ok=False, found=str(failure))
    return Step("backup", ok=True, found=f"{copy}, {copy.stat().st_size:,} bytes")


def _carried(settings: Settings, data: Path, to: str) -> Step:
    if not has_database(data):
        return Step("copy", ok=True, found="nothing is stored yet")
    try:
        carried = drives.carry(data, drives.destination(to), settings.experimenter.backups)
    except (StorageError, UserInputError) as failure:
        return Step("copy", ok=False, found=str(failure))
    note_copy(data, CopyKind.BACKUP, carried.file)
    return Step("copy", ok=True, found=f"{carried.file}, {carried.bytes:,} bytes, read back alike")
