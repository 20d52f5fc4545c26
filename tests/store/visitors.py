"""People who come to a booth: whether they finish, leave, or are put where the experimenter says."""

from __future__ import annotations

import sqlite3
from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

from kiosk.experiment import events as happened
from kiosk.experiment.condition import AllocationSlot, Condition
from kiosk.experiment.events import Event
from kiosk.experiment.outcomes import AllocationSource, NotRecordedReason, SessionKind, Status
from kiosk.store.codes import issue_code
from kiosk.store.database import FILE, open_for_writing
from kiosk.store.participants import Participant
from kiosk.store.recorder import Provenance, Recorder

BEGUN = (happened.SessionStarted(at_ms=0),)
LEFT = (*BEGUN, happened.SessionEnded(at_ms=5, status=Status.ABANDONED))
FINISHED = (*BEGUN, happened.GameFinished(at_ms=5))
COMPLETED = (*FINISHED, happened.SessionEnded(at_ms=9, status=Status.COMPLETED))
FOUR = {Condition.TOM: 4, Condition.NOTOM: 4}
CHEAP = 2**5
"""What a code costs in tests that give many, as none is to hold against an attack."""


def rows(folder: Path, query: str) -> list[tuple[Any, ...]]:
    """Return what stands in the database of a folder."""
    with closing(sqlite3.connect(folder / FILE)) as connection:
        return connection.execute(query).fetchall()


def new_code(folder: Path, session: int = 1) -> str:
    """Give the person of a session one more code: those that were given are stored nowhere."""
    with closing(open_for_writing(folder)) as connection:
        return issue_code(connection, session, "")


def saying(words: str) -> tuple[Event, ...]:
    """Return a completed session in which these words were recorded."""
    return (*FINISHED, happened.SpeechFailed(at_ms=7, utterance=1, why=words), *COMPLETED[2:])


def seated(
    recorder: Recorder,
    provenance: Provenance,
    events: Sequence[Event] = COMPLETED,
    *,
    allocation_source: AllocationSource = AllocationSource.LIST,
    kind: SessionKind = SessionKind.SIMULATED,
) -> AllocationSlot | None:
    """Have a visitor play in the next place, or without one, and return the place."""
    place = recorder.next_slot(kind=kind) if allocation_source is AllocationSource.LIST else None
    plan = replace(provenance.plan, condition=place.condition) if place else provenance.plan
    recorder.begin(replace(provenance, plan=plan, slot=place, allocation_source=allocation_source, kind=kind), events)
    return place


def a_day(folder: Path, provenance: Provenance, site: str = "", seed: int = 1) -> list[Participant]:
    """Return a day at a booth: three people, two rehearsals, two who were not stored, and a deviation."""
    with Recorder(folder, site) as recorder:
        recorder.create_allocation_list(FOUR, 4, seed, kind=SessionKind.STUDY)
        people = []
        for number, (events, kind) in enumerate(
            [
                (saying(f"{site} one"), SessionKind.STUDY),
                (LEFT, SessionKind.STUDY),
                (COMPLETED, SessionKind.SIMULATED),
                (saying(f"{site} two"), SessionKind.STUDY),
            ]
        ):
            place = recorder.next_slot(kind=kind) if kind is SessionKind.STUDY else None
            plan = replace(provenance.plan, condition=place.condition) if place else provenance.plan
            session = replace(provenance, plan=plan, seed=seed * 100 + number, kind=kind, slot=place)
            people.append(
                recorder.begin(replace(session, allocation_source=AllocationSource.LIST if place else None), events)
            )
        recorder.count_visit(NotRecordedReason.DECLINED, kind=SessionKind.STUDY)
        recorder.count_visit(NotRecordedReason.UNDER_AGE, kind=SessionKind.STUDY)
        recorder.add_audit_event("deviation", {"why": f"the robot of {site} fell over"})
    return people
