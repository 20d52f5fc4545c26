"""Lists of the panel: the day in numbers, sessions, deviations and shortcuts, and what conditions are called."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from datetime import datetime
from string import ascii_uppercase
from typing import Any

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.booth_status import DayCounts
from kiosk.experiment.condition import Condition, in_design_order
from kiosk.experiment.experimenter import Action, AuditEvent, DeviationReason
from kiosk.experiment.outcomes import Disposition, Stage, Status
from kiosk.store.participants import CountCell, EnrolmentCounts
from kiosk.store.snapshot import DashboardSnapshot, SnapshotAuditEvent, SnapshotSession
from kiosk.ui.experimenter.view_model import Row
from kiosk.units import MS_PER_MINUTE, MS_PER_SECOND

DEVIATIONS_SHOWN = 5

Translate = Callable[..., str]

NameCondition = Callable[[Condition | None], str]
"""Returns what a condition is called; None is the list's."""


def session_rows(seen: DashboardSnapshot, catalogue: Catalogue, name: NameCondition, *, played: bool) -> Row:
    """Return every list of the panel that follows from the records.

    During a session the conditions of all sessions are hidden: from those before, the present one could be guessed.
    """
    translate = catalogue.text
    visits = {why.value: number for why, number in seen.counts.visits.items()}
    told = (lambda _: translate("console-hidden")) if played else name
    return {
        "listed": any(cell.quota for cell in seen.counts.cells.values()),
        "cells": [_cell(name(condition), cell) for condition, cell in seen.counts.cells.items()],
        "visits": translate("console-visits", **visits),
        "sessions": [_session(session, translate, told) for session in seen.sessions],
        "deviations": [_deviation(noted, translate, told) for noted in seen.deviations[:DEVIATIONS_SHOWN]],
        "more": _more(len(seen.deviations) - DEVIATIONS_SHOWN, translate),
        "resumable": [_resumable(session, translate) for session in seen.resumable],
    }


def today_rows(
    day: DayCounts, counts: EnrolmentCounts, stage: tuple[str, int], now: datetime, catalogue: Catalogue
) -> Row:
    """Return the clock and the day in numbers; ``stage`` is the present one, and its age in ms."""
    translate = catalogue.text
    done = sum(cell.fates[Disposition.CONSUMED] for cell in counts.cells.values())
    target = sum(cell.quota for cell in counts.cells.values())
    name, lasted_ms = stage
    numbers = (
        # Without any, there is nothing more to tell.
        (
            "visitors",
            str(day.begun),
            translate("console-today-early", early=day.ended_early) if day.ended_early else "",
        ),
        ("completed", str(day.completed), translate("console-today-hour", done=day.last_hour) if day.last_hour else ""),
        (
            "target",
            f"{done} / {target}" if target else str(done or "-"),
            _forecast(day, max(0, target - done), now, catalogue),
        ),
        (
            "stage",
            stage_name(name, catalogue),
            translate(
                "console-today-minutes" if name in (Stage.ATTRACT.value, Stage.OVER.value) else "console-today-begun",
                minutes=lasted_ms // MS_PER_MINUTE,
            ),
        ),
    )
    return {
        "clock": f"{now:%H:%M}",
        "tiles": [
            {"name": name, "title": translate(f"console-today-{name}"), "value": value, "line": line}
            for name, value, line in numbers
        ],
    }


def stage_name(stage: str, catalogue: Catalogue) -> str:
    """Return what the console calls a stage, where it stands alone."""
    words = catalogue.text(f"console-stage-{_kebab(stage)}")
    return words[:1].upper() + words[1:]


SHORTCUTS = (
    Action.PANEL,
    Action.PAUSE,
    Action.ABORT,
    Action.NEXT,
    Action.REPEAT,
    Action.MUTE,
    Action.VOLUME,
    Action.CONDITION,
    Action.EMBODIMENT,
    Action.QUIT,
)
"""The actions with shortcuts, the most needed first."""


def shortcut_rows(keys: Mapping[Action, str], catalogue: Catalogue) -> Row:
    """Return the shortcuts as the panel shows them.

    Keys that are held down for all of them stand in the title alone.
    """
    there = [action for action in SHORTCUTS if action in keys]
    held = {keys[action].rpartition("+")[0] for action in there}
    common = held.pop() if len(held) == 1 else ""
    return {
        "title": catalogue.text("console-shortcuts-held", keys=common)
        if common
        else catalogue.text("console-shortcuts"),
        "rows": [
            {
                "keys": keys[action].rpartition("+")[2] if common else keys[action],
                "words": catalogue.text(f"console-shortcut-{action.value}"),
            }
            for action in there
        ],
    }


def _forecast(day: DayCounts, games: int, now: datetime, catalogue: Catalogue) -> str:
    if games == 0:
        return ""
    hours = day.hours_for(games, now)
    if hours is None:
        return catalogue.text("console-today-no-pace")
    return catalogue.text("console-today-forecast", hours=f"{hours:.0f}" if hours >= 1 else "<1")


def neutral_names(conditions: Iterable[Condition | None], translate: Translate) -> NameCondition:
    """Call conditions A, B, C in the order of the design, so that no name tells what they are."""
    letters = {
        condition: ascii_uppercase[at] if at < len(ascii_uppercase) else str(at + 1)
        for at, condition in enumerate(in_design_order({each for each in conditions if each is not None}))
    }
    return lambda condition: translate("console-automatic") if condition is None else letters.get(condition, "?")


_AUTOMATIC = "automatic"
"""What the record says of the list's condition."""


def condition_name(condition: Condition | None, translate: Translate) -> str:
    """Return what a condition is called in the panel; None is the list's."""
    if condition is None:
        return translate("console-automatic")
    if not condition.is_known:
        return translate("console-condition-declared", name=condition.name)
    return translate(f"console-condition-{_kebab(condition.name)}")


def _cell(name: str, cell: CountCell) -> Row:
    done, quota = cell.fates[Disposition.CONSUMED], cell.quota
    return {
        "name": name,
        "done": f"{done} / {quota}" if quota else str(cell.fates[Disposition.UNLISTED]),
        "listed": quota > 0,
        "share": min(1.0, done / quota) if quota else 0.0,
        "counts": [
            str(number)
            for number in (
                cell.fates[Disposition.DROPPED_OUT],
                cell.fates[Disposition.OVERRIDDEN],
                cell.fates[Disposition.BEYOND],
                cell.withdrawn,
            )
        ],
    }


def _session(session: SnapshotSession, translate: Translate, told: NameCondition) -> Row:
    return {
        "participant": session.participant or "-",
        "when": _time(datetime.fromisoformat(session.started_at)),
        "condition": told(session.condition),
        "stage": translate(f"console-stage-{_kebab(session.stage.value)}") if session.stage else "-",
        "status": translate(f"console-status-{session.status.value if session.status else 'running'}"),
        "reason": _reason(session.reason, translate),
        "robot": translate("console-robot-lost") if session.robot_lost else "",
        "under_way": session.status is None,
        "odd": session.robot_lost or session.status in (Status.ABANDONED, Status.INTERRUPTED, Status.STOPPED),
    }


def _resumable(session: SnapshotSession, translate: Translate) -> Row:
    stage = translate(f"console-stage-{_kebab(session.stage.value)}") if session.stage else "-"
    when = _time(datetime.fromisoformat(session.started_at))
    return {
        "number": str(session.number),
        "label": translate("console-resume-one", participant=session.participant, when=when, stage=stage),
    }


def _deviation(noted: SnapshotAuditEvent, translate: Translate, told: NameCondition) -> Row:
    when = datetime.fromtimestamp(noted.wall_ms / MS_PER_SECOND).astimezone()
    reason = str(noted.payload.get("reason") or "")
    return {
        "when": f"{when:%H:%M}",
        "words": translate(f"console-note-{_kebab_of(noted.kind)}", what=_what(noted, translate, told)),
        "reason": _reason(reason, translate),
    }


def _more(number: int, translate: Translate) -> str:
    """How many are not shown; nothing if all are."""
    return translate("console-deviations-more", number=number) if number > 0 else ""


def _what(noted: SnapshotAuditEvent, translate: Translate, told: NameCondition) -> str:
    """Return the one thing that a note is about, in words."""
    payload: dict[str, Any] = noted.payload
    match noted.kind:
        case AuditEvent.CONDITION_CHOSEN:
            name = str(payload.get("condition", _AUTOMATIC))
            return told(None if name == _AUTOMATIC else Condition(name))
        case AuditEvent.VOLUME_CHANGED:
            return f"{payload.get('volume', 0):.0%}"
        case AuditEvent.MUTE_CHANGED:
            return translate("console-mute-on" if payload.get("muted") else "console-mute-off")
        case AuditEvent.SESSION_ABORTED | AuditEvent.APPLICATION_QUIT:
            stage = str(payload.get("stage", ""))
            return translate(f"console-stage-{_kebab(stage)}") if stage else ""
        case AuditEvent.DISK_SPACE_CHANGED:
            return translate(f"console-room-{payload.get('level', 'enough')}")
    of = {
        AuditEvent.EMBODIMENT_CHOSEN: "embodiment",
        AuditEvent.LANGUAGE_CHOSEN: "language",
        AuditEvent.SESSION_RESUMED: "session",
    }
    of |= {AuditEvent.PIN_REFUSED: "in_a_row", AuditEvent.BACKUP_FAILED: "why", AuditEvent.VOICE_CHANGED: "message"}
    of |= {AuditEvent.WITHDRAWN_AGAIN: "people", AuditEvent.WITHDRAWN_LIST_MISSING: "list"}
    value = payload.get(of.get(noted.kind, ""), "")
    return value if isinstance(value, str) else json.dumps(value)


def _reason(reason: str, translate: Translate) -> str:
    """Return a reason of the list in the panel's language, one in the experimenter's words as it is."""
    for each in DeviationReason:
        if reason == each.value:
            return translate(f"console-reason-{each.name.lower()}")
    return reason.removeprefix(f"{DeviationReason.OTHER.value}: ")


def _time(when: datetime) -> str:
    """Return the time of day; with the day if that is another one."""
    local = when.astimezone()
    return f"{local:%H:%M}" if local.date() == datetime.now().astimezone().date() else f"{local:%d.%m. %H:%M}"


def _kebab(name: str) -> str:
    return name.replace("_", "-")


def _kebab_of(note: AuditEvent) -> str:
    return note.name.lower().replace("_", "-")
