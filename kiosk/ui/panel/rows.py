"""What is stored, as lines of the panel, in the experimenter's language.

While somebody plays no condition is told, of them or of those before: whoever sits there may look up, and so may who
asks them.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from datetime import datetime
from typing import Any

from kiosk.assistant.wording import Catalogue
from kiosk.store.glance import Glance, Noted, Seen
from kiosk.store.people.counting import Cell, Fate
from kiosk.study.booth.deeds import Reason
from kiosk.study.booth.notes import Note
from kiosk.study.condition import Condition
from kiosk.study.events import Status
from kiosk.ui.panel.screen import Row
from kiosk.units import MS_PER_SECOND

DEVIATIONS_SHOWN = 5

Told = Callable[..., str]


def rows(seen: Glance, catalogue: Catalogue, *, played: bool) -> Row:
    """Every list of the panel that follows from the records; while somebody plays, none tells of a condition."""
    told = _discreet(catalogue.text) if played else catalogue.text
    visits = {why.value: number for why, number in seen.counts.visits.items()}
    cells = {} if played else seen.counts.cells
    return {
        "cells": [_cell(condition, cell, told) for condition, cell in cells.items()],
        "visits": told("desk-visits", **visits),
        "sittings": [_sitting(sitting, told) for sitting in seen.sittings],
        "deviations": [_deviation(noted, told) for noted in seen.deviations[:DEVIATIONS_SHOWN]],
        "more": _more(len(seen.deviations) - DEVIATIONS_SHOWN, told),
        "resumable": [_resumable(sitting, told) for sitting in seen.resumable],
    }


def _discreet(told: Told) -> Told:
    """The same words, but for the names of conditions: from those before, the one of now could be guessed."""

    def tell(message: str, **what: str | int) -> str:
        return told("desk-hidden" if message.startswith(_OF_CONDITIONS) else message, **what)

    return tell


_OF_CONDITIONS = ("desk-condition-", "desk-automatic")


def condition_name(condition: Condition | None, told: Told) -> str:
    """What a condition is called in the panel; None is the list's."""
    return told("desk-automatic" if condition is None else f"desk-condition-{condition.name.lower().replace('_', '-')}")


def _cell(condition: Condition, cell: Cell, told: Told) -> Row:
    done, quota = cell.fates[Fate.CONSUMED], cell.quota
    return {
        "name": condition_name(condition, told),
        "done": f"{done} / {quota}" if quota else str(cell.fates[Fate.UNLISTED] or ""),
        "share": min(1.0, done / quota) if quota else 0.0,
        "counts": [
            str(number or "")
            for number in (
                cell.fates[Fate.DROPPED_OUT],
                cell.fates[Fate.OVERRIDDEN],
                cell.fates[Fate.BEYOND],
                cell.withdrawn,
            )
        ],
    }


def _sitting(sitting: Seen, told: Told) -> Row:
    return {
        "participant": sitting.participant or "-",
        "when": _time(datetime.fromisoformat(sitting.started_at)),
        "condition": condition_name(sitting.condition, told),
        "stage": told(f"desk-stage-{_kebab(sitting.stage.value)}") if sitting.stage else "-",
        "status": told(f"desk-status-{sitting.status.value if sitting.status else 'running'}"),
        "robot": told("desk-robot-lost") if sitting.robot_lost else "",
        "odd": sitting.robot_lost or sitting.status in (Status.ABANDONED, Status.INTERRUPTED, Status.STOPPED),
    }


def _resumable(sitting: Seen, told: Told) -> Row:
    stage = told(f"desk-stage-{_kebab(sitting.stage.value)}") if sitting.stage else "-"
    when = _time(datetime.fromisoformat(sitting.started_at))
    return {
        "number": str(sitting.number),
        "label": told("desk-resume-one", participant=sitting.participant, when=when, stage=stage),
    }


def _deviation(noted: Noted, told: Told) -> Row:
    when = datetime.fromtimestamp(noted.wall_ms / MS_PER_SECOND).astimezone()
    reason = str(noted.body.get("reason") or "")
    return {
        "when": f"{when:%H:%M}",
        "words": told(f"desk-note-{_kebab_of(noted.note)}", what=_what(noted, told)),
        "reason": _reason(reason, told),
    }


def _more(number: int, told: Told) -> str:
    """How many are not shown; nothing if all are."""
    return told("desk-deviations-more", number=number) if number > 0 else ""


def _what(noted: Noted, told: Told) -> str:
    """The one thing that a note is about, in words."""
    body: dict[str, Any] = noted.body
    match noted.note:
        case Note.CONDITION_CHOSEN:
            named = {condition.value: condition for condition in Condition}
            return condition_name(named.get(body.get("condition", "")), told)
        case Note.VOLUME_CHANGED:
            return f"{body.get('volume', 0):.0%}"
        case Note.SOUND_CHANGED:
            return told("desk-quiet-on" if body.get("quiet") else "desk-quiet-off")
        case Note.SITTING_STOPPED | Note.KIOSK_LEFT:
            stage = str(body.get("stage", ""))
            return told(f"desk-stage-{_kebab(stage)}") if stage else ""
        case Note.ROOM_CHANGED:
            return told(f"desk-room-{body.get('level', 'enough')}")
    of = {Note.BODY_CHOSEN: "body", Note.LANGUAGE_CHOSEN: "language", Note.SITTING_RESUMED: "sitting"}
    of |= {Note.PIN_REFUSED: "in_a_row", Note.BACKUP_FAILED: "why"}
    value = body.get(of.get(noted.note, ""), "")
    return value if isinstance(value, str) else json.dumps(value)


def _reason(reason: str, told: Told) -> str:
    """A reason of the list in the panel's language, one in the experimenter's words as it is."""
    for each in Reason:
        if reason == each.value:
            return told(f"desk-reason-{each.name.lower()}")
    return reason.removeprefix(f"{Reason.OTHER.value}: ")


def _time(when: datetime) -> str:
    """The time of day; with the day if that is another one."""
    local = when.astimezone()
    return f"{local:%H:%M}" if local.date() == datetime.now().astimezone().date() else f"{local:%d.%m. %H:%M}"


def _kebab(name: str) -> str:
    return name.replace("_", "-")


def _kebab_of(note: Note) -> str:
    return note.name.lower().replace("_", "-")
