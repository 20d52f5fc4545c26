"""The command that writes one page about a day at the booth, to be read in the evening."""

from __future__ import annotations

import html
import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from datetime import datetime
from pathlib import Path
from statistics import median

import click

from kiosk.cli.options import json_option, sessions_data_option
from kiosk.cli.terminal import counted, tell_line
from kiosk.config import ASSETS
from kiosk.experiment.experimenter import AuditEvent
from kiosk.experiment.outcomes import SessionKind, Stage, Status
from kiosk.files import write_file
from kiosk.store.day_report import DayReport, DaySession, Happening, quantile, read_day_report
from kiosk.units import as_minutes

CSS = ASSETS / "report" / "page.css"
_OWN_CSS = """
body{display:block}
table.lines{width:100%}
.line{display:flex;height:1.3rem;min-width:2px;border-radius:.2rem;overflow:hidden}
.line i{display:block;height:100%;border-right:1px solid #fff}
.key{display:flex;flex-wrap:wrap;gap:.2rem 1rem;font-size:.86rem;padding:0;list-style:none}
.key i{display:inline-block;width:.9rem;height:.9rem;border-radius:.2rem;margin-right:.35rem;vertical-align:-.1rem}
.lines td:last-child{width:55%}
.look{background:#fbeedb;border-left:5px solid #8a4b00;padding:.8rem 1rem;margin:1rem 0}
.look ul{margin:0;padding-left:1.2rem}
.well{background:#e2f2e7;border-color:#1d6b3a}
@media print{.line i{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
"""
_COLOURS = {
    Stage.ATTRACT: "#d7dade",
    Stage.ABOUT: "#b7c4d1",
    Stage.AGE: "#9fb3c8",
    Stage.CONSENT: "#7f9ab5",
    Stage.ABOUT_YOU: "#5f7f9f",
    Stage.INTRODUCTION: "#d9c48f",
    Stage.PRACTICE: "#c9a24a",
    Stage.GAME: "#1f5f6b",
    Stage.RESULT: "#5fa08f",
    Stage.QUESTIONS: "#7a4f8a",
    Stage.DEBRIEF: "#b58ac4",
    Stage.THANKS: "#e2cfe8",
}
_P95 = 0.95


@click.command()
@sessions_data_option
@click.option("--date", "day", type=click.DateTime(["%Y-%m-%d"]), help="The day, such as 2026-05-01; today by default.")
@click.option("--out", type=click.Path(path_type=Path), help="The page; by default day-DATE.html here.")
@click.option("--with-rehearsals", is_flag=True, help="Also rehearsals.")
@json_option
def day_command(data: Path, day: datetime | None, out: Path | None, *, with_rehearsals: bool, as_json: bool) -> None:
    """Write one page about a day at the booth.

    It has time lines, dropouts, faults, and what needs attention tomorrow. It has no condition, code or answer.
    """
    chosen = day.date() if day else datetime.now().astimezone().date()
    kinds = {SessionKind.STUDY, SessionKind.TRIAL} | ({SessionKind.SIMULATED} if with_rehearsals else set())
    report = read_day_report(data, chosen, frozenset(kinds))
    page = out or Path(f"day-{chosen}.html")
    write_file(page, day_page(report))
    completed = sum(session.status is Status.COMPLETED for session in report.sessions)
    cautions = report.cautions()
    if as_json:
        told = {"page": str(page), "date": str(chosen), "sessions": len(report.sessions), "completed": completed}
        click.echo(json.dumps(told | {"cautions": cautions}))
        return
    click.echo(
        f"{page} is about {counted(len(report.sessions), 'session')} of {chosen}, {completed} of them completed."
    )
    for caution in cautions:
        tell_line(f"look at: {caution}")


def day_page(report: DayReport) -> str:
    """Return the day as one HTML page; it asks for nothing outside itself, and prints."""
    sections = "".join(
        f'<section><h2 id="{name}">{html.escape(title)}</h2>{body}</section>\n'
        for name, title, body in _sections(report)
    )
    title = f"The day at the booth: {report.day:%A, %d %B %Y}"
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{html.escape(title)}</title>\n<style>{CSS.read_text('utf-8')}{_OWN_CSS}</style></head>\n"
        f"<body><header><h1>{html.escape(title)}</h1>{_facts(report)}</header>\n<main>{sections}</main></body></html>\n"
    )


def _facts(report: DayReport) -> str:
    sessions = report.sessions
    completed = [session for session in sessions if session.status is Status.COMPLETED]
    early = sum(session.ended_early for session in sessions)
    facts = {
        "Sessions": str(len(sessions)),
        "Completed": str(len(completed)),
        "Ended early": str(early),
        "Usual length (min:s)": as_minutes(median(session.duration_ms for session in completed)) if completed else "-",
        "From, to": f"{sessions[0].began:%H:%M} - {sessions[-1].began:%H:%M}" if sessions else "-",
    }
    rows = "".join(f"<div><dt>{name}</dt><dd>{html.escape(value)}</dd></div>" for name, value in facts.items())
    return f"<dl>{rows}</dl>"


def _sections(report: DayReport) -> Iterator[tuple[str, str, str]]:
    cautions = report.cautions()
    listed = "".join(f"<li>{html.escape(caution)}</li>" for caution in cautions)
    look = f"<ul>{listed}</ul>" if cautions else "Nothing."
    yield "tomorrow", "What to look at tomorrow", f'<div class="look{"" if cautions else " well"}">{look}</div>'
    yield "sessions", "Sessions", _time_lines(report)
    yield "stages", "Durations by stage", _stages(report)
    early = [session for session in report.sessions if session.ended_early]
    yield (
        "dropouts",
        "Dropouts",
        _table(
            ("Session", "Ended at", "How", "In", "After (min:s)"),
            ((str(each.number), f"{each.ended:%H:%M}", *_ending(each), as_minutes(each.duration_ms)) for each in early),
        ),
    )
    yield "faults", "Faults", _table(("Session", "At", "What"), _happenings(report, lambda each: each.faults))
    yield (
        "changes",
        "Robot and voice",
        _table(("Session", "At", "What"), _happenings(report, lambda each: each.changes)),
    )
    yield "latency", "From a sentence's request to its first sound", _latency(report)
    yield (
        "deviations",
        "Deviations",
        _table(("At", "What"), ((f"{note.at:%H:%M}", note.words) for note in report.deviations)),
    )
    copies = report.noted(AuditEvent.BACKUP_MADE, AuditEvent.BACKUP_FAILED)
    yield "backups", "Copies", _table(("At", "What"), ((f"{note.at:%H:%M}", note.words) for note in copies))


def _time_lines(report: DayReport) -> str:
    longest = max((session.duration_ms for session in report.sessions), default=0)
    rows = "".join(
        f'<tr><th scope="row">{session.number}</th><td>{html.escape(session.name)}</td><td>{session.began:%H:%M}</td>'
        f'<td class="num">{as_minutes(session.duration_ms)}</td><td>{html.escape(" in ".join(_ending(session)))}</td>'
        f"<td>{_line(session, longest)}</td></tr>\n"
        for session in report.sessions
    )
    if not rows:
        return "<p>None.</p>"
    stages = [stage for stage in Stage if any(span.stage is stage for each in report.sessions for span in each.spans)]
    key = "".join(
        f'<li><i style="background:{_COLOURS.get(stage, "#888")}"></i>{_named(stage)}</li>' for stage in stages
    )
    heads = "".join(
        f'<th scope="col">{head}</th>' for head in ("Session", "Who", "Began", "Took (min:s)", "Ended", "Stages")
    )
    return (
        f'<ul class="key">{key}</ul><div class="scroll"><table class="lines"><thead><tr>{heads}</tr></thead>'
        f"<tbody>{rows}</tbody></table></div>"
    )


def _line(session: DaySession, longest_ms: int) -> str:
    told = ", ".join(f"{_named(span.stage)} {as_minutes(span.end_ms - span.begin_ms)}" for span in session.spans)
    parts = "".join(
        f'<i style="flex:{max(1, span.end_ms - span.begin_ms)};background:{_COLOURS.get(span.stage, "#888")}" '
        f'title="{_named(span.stage)} {as_minutes(span.end_ms - span.begin_ms)}"></i>'
        for span in session.spans
    )
    width = 100 * session.duration_ms / longest_ms if longest_ms else 0
    return f'<div class="line" role="img" aria-label="{html.escape(told)}" style="width:{width:.1f}%">{parts}</div>'


def _stages(report: DayReport) -> str:
    rows = (
        (_named(stage), str(len(taken)), *(as_minutes(each) for each in (taken[0], median(taken), taken[-1])))
        for stage, taken in report.stage_durations_ms().items()
    )
    return _table(("Stage", "Visits", "Shortest (min:s)", "Median", "Longest"), rows)


def _latency(report: DayReport) -> str:
    found = report.latencies_ms
    late, usual = quantile(found, _P95), quantile(found, 0.5)
    if late is None or usual is None:
        return "<p>No sentence was heard.</p>"
    asked = sum(session.sentences for session in report.sessions)
    shown = sum(session.shown_only for session in report.sessions)
    return (
        f"<p>{len(found)} times a voice began: median {usual:,.0f} ms, 95 % within {late:,.0f} ms, at most "
        f"{found[-1]:,} ms. Of {asked} sentences, {shown} were not heard to their end; all were shown.</p>"
    )


def _happenings(report: DayReport, of: Callable[[DaySession], Sequence[Happening]]) -> Iterator[tuple[str, ...]]:
    for session in report.sessions:
        for each in of(session):
            yield str(session.number), f"{each.at:%H:%M:%S}", each.words


def _table(heads: Sequence[str], rows: Iterable[tuple[str, ...]]) -> str:
    body = "".join(f"<tr>{''.join(f'<td>{html.escape(cell)}</td>' for cell in row)}</tr>\n" for row in rows)
    if not body:
        return "<p>None.</p>"
    named = "".join(f'<th scope="col">{html.escape(head)}</th>' for head in heads)
    return f'<div class="scroll"><table><thead><tr>{named}</tr></thead><tbody>{body}</tbody></table></div>'


def _ending(session: DaySession) -> tuple[str, str]:
    how = session.status.value if session.status else "under way"
    return how, _named(session.last_stage) if session.last_stage else "no stage"


def _named(stage: Stage) -> str:
    return stage.value.replace("_", " ")
