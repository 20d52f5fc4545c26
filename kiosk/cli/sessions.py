"""Commands that list and print stored sessions."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from kiosk import UserInputError
from kiosk.cli.options import json_option, sessions_data_option
from kiosk.cli.terminal import console, counted, one_line, tell_caution, tell_line
from kiosk.experiment.outcomes import Disposition, SessionKind, Status
from kiosk.store.listing import RUNNING, SessionFilter, SessionList, SessionTotals, StoredSession, opened
from kiosk.units import MS_PER_SECOND, as_minutes

if TYPE_CHECKING:
    from rich.table import Table

    from kiosk.store.participants import EnrolmentCounts

WIDTH = 160
"""Characters that a line of the list may need."""

PER_PAGE = 50

_WORDS = ("condition", "embodiment", "status", "stage", "allocation_source")
_COUNTS = ("pairs", "moves", "flips", "hints")
_VISITORS = {"person": SessionKind.STUDY, "trial": SessionKind.TRIAL, "simulated": SessionKind.SIMULATED}
_NAMES = {kind: name for name, kind in _VISITORS.items()}
_FATES = {
    Disposition.CONSUMED: "game completed",
    Disposition.UNDER_WAY: "under way",
    Disposition.DROPPED_OUT: "dropped out",
    Disposition.OVERRIDDEN: "chosen by hand",
    Disposition.BEYOND: "beyond the list",
    Disposition.RETURNING: "came back",
    Disposition.UNLISTED: "without a list",
}
_STATUSES = [RUNNING, *(status.value for status in Status)]
_DAY = click.DateTime(["%Y-%m-%d"])


@click.command()
@sessions_data_option
@click.option("--visitor", type=click.Choice(list(_VISITORS)), help="Only sessions of people, of trials, or simulated.")
@click.option("--condition", help="Only sessions in this condition.")
@click.option("--status", type=click.Choice(_STATUSES), help="Only sessions that ended so, or are running.")
@click.option("--site", help="Only sessions of this site.")
@click.option("--since", type=_DAY, help="Only sessions of this day, such as 2026-05-01, and later.")
@click.option("--until", type=_DAY, help="Only sessions of this day and earlier.")
@click.option("--page", type=click.IntRange(min=1), help=f"{PER_PAGE} sessions; page 1 has the newest.")
@click.option("--all", "everything", is_flag=True, help="All sessions, not only the newest page.")
@json_option
def sessions_command(
    data: Path,
    visitor: str | None,
    condition: str | None,
    status: str | None,
    site: str | None,
    since: datetime | None,
    until: datetime | None,
    page: int | None,
    *,
    everything: bool,
    as_json: bool,
) -> None:
    """List the stored sessions and how they ended.

    Each has its time, condition and stage. Below them are their number by status, and how far each condition is from
    its target. --json lists all of them, unless you ask for a page.
    """
    if page is not None and everything:
        raise click.UsageError("choose --page or --all")
    which = SessionFilter(
        kind=_VISITORS[visitor] if visitor else None,
        condition=condition,
        status=status,
        site=site,
        since=since.date() if since else None,
        until=until.date() if until else None,
    )
    whole = everything or (as_json and page is None)
    skip = 0 if whole else ((page or 1) - 1) * PER_PAGE
    with opened(data, SessionList) as stored:
        if condition is not None and condition not in stored.conditions():
            raise UserInputError(
                f"no session is in the condition {condition!r}; there are {', '.join(stored.conditions()) or 'none'}"
            )
        listed = stored.sessions(which, newest=-1 if whole else PER_PAGE, skip=skip, tell=_caution)
        if as_json:
            click.echo(json.dumps([_row(session) for session in listed]))
            return
        totals = stored.totals(which)
        enrolled = stored.counts(kind=SessionKind.STUDY) if stored.has_list(kind=SessionKind.STUDY) else None
    click.echo("\n".join(_table(listed)))
    for line in _totals(totals, len(listed), skip):
        click.echo(line)
    if enrolled is not None and any(cell.quota for cell in enrolled.cells.values()):
        console(least_width=WIDTH).print(_targets(enrolled))


def _caution(what: str) -> None:
    tell_caution(what, err=True)


def _table(listed: Sequence[StoredSession]) -> Iterator[str]:
    """Yield the lines of the list; thousands of them would take a table of rich minutes."""
    headings = ("session", "participant", "started", "duration", *_WORDS, "visitor", *_COUNTS)
    rows = [headings, *(_cells(session) for session in listed)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    right = [heading in {*_COUNTS, "duration"} for heading in headings]
    for row in rows:
        cells = zip(row, widths, right, strict=True)
        yield "  ".join(cell.rjust(width) if number else cell.ljust(width) for cell, width, number in cells).rstrip()


def _cells(session: StoredSession) -> tuple[str, ...]:
    row = session.to_json()
    times = (f"{session.began:%Y-%m-%d %H:%M}", as_minutes(session.duration_ms))
    visit = f" (visit {session.visit})" if session.visit > 1 else ""
    words = (
        row["session"],
        row["participant"] and f"{row['participant']}{visit}",
        *times,
        *(row[key] for key in _WORDS),
        _NAMES[session.kind],
    )
    return (*map(_word, words), *(str(row[key]) for key in _COUNTS))


def _row(session: StoredSession) -> dict[str, Any]:
    times = {"started_at": session.started_at, "started_local": session.began.isoformat(timespec="seconds")}
    return session.to_json() | times


def _totals(totals: SessionTotals, shown: int, skip: int) -> Iterator[str]:
    """Yield how many sessions there are, by status, and which of them are shown."""
    yield ""
    if not totals.sessions:
        yield "No sessions."
        return
    counts = ", ".join(f"{number:,} {status}" for status, number in sorted(totals.by_status.items()))
    lasted = "" if totals.median_ms is None else f"; a completed one lasts {as_minutes(totals.median_ms)} (median)"
    yield f"{counted(totals.sessions, 'session')}: {counts}{lasted}."
    if shown < totals.sessions:
        last = totals.sessions - skip
        first = f"{last - shown + 1:,} to {last:,}" if shown else "none"
        yield f"Shown: {first} of {totals.sessions:,}. --page N shows older ones, --all all of them."


def _targets(enrolled: EnrolmentCounts) -> Table:
    """Return the people in each condition against its target; every session of the data folder counts."""
    from rich.table import Table  # noqa: PLC0415 - few lists have targets

    table = Table(box=None, title="People, against the targets", title_justify="left", title_style="")
    fates = [fate for fate in _FATES if any(cell.fates[fate] for cell in enrolled.cells.values())]
    fates = [Disposition.CONSUMED, *(fate for fate in fates if fate is not Disposition.CONSUMED)]
    for heading in ("condition", "target", *(_FATES[fate] for fate in fates), "still to come", "deleted"):
        table.add_column(heading, no_wrap=True, justify="left" if heading == "condition" else "right")
    for condition, cell in enrolled.cells.items():
        numbers = [cell.quota, *(cell.fates[fate] for fate in fates)]
        numbers += [max(0, cell.quota - cell.fates[Disposition.CONSUMED]), cell.withdrawn]
        table.add_row(condition.name, *map(str, numbers))
    return table


def _word(value: object) -> str:
    return "-" if value is None else one_line(str(value))


@click.command()
@click.argument("session", type=int)
@sessions_data_option
@json_option
def events_command(session: int, data: Path, *, as_json: bool) -> None:
    """List what happened in a SESSION, in order."""
    from kiosk.store.queries import open_repository  # noqa: PLC0415 - the list of sessions does without

    with open_repository(data) as stored:
        records, broken = stored.records(session), stored.broken_events(session)
    for each in broken:
        _caution(str(each))
    if as_json:
        click.echo(json.dumps(records))
        return
    for record in records:
        seq, at_ms, kind = (record.pop(key) for key in ("seq", "at_ms", "type"))
        origin = record.pop("origin")
        details = "  ".join(f"{key}={json.dumps(value, ensure_ascii=False)}" for key, value in record.items())
        mark = "<" if origin == "world" else ">"
        tell_line(f"{seq:5} {at_ms / MS_PER_SECOND:9.3f} s {mark} {kind:18} {details}")
