"""People who come to a booth: whether they finish, leave, or are put where the experimenter says."""

from __future__ import annotations

import sqlite3
from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

from kiosk.store.database import FILE
from kiosk.store.people.participants import Participant
from kiosk.store.recorder import Provenance, Recorder
from kiosk.study import events as happened
from kiosk.study.allocation import Allotted, Place
from kiosk.study.condition import Condition
from kiosk.study.events import Event, Status, Unstored
from kiosk.study.session_kind import SessionKind

BEGUN = (happened.StartTapped(at_ms=0),)
LEFT = (*BEGUN, happened.SittingEnded(at_ms=5, status=Status.ABANDONED))
FINISHED = (*BEGUN, happened.GameFinished(at_ms=5))
COMPLETED = (*FINISHED, happened.SittingEnded(at_ms=9, status=Status.COMPLETED))
FOUR = {Condition.TOM: 4, Condition.NOTOM: 4}


def rows(folder: Path, query: str) -> list[tuple[Any, ...]]:
    """What stands in the database of a folder."""
    with closing(sqlite3.connect(folder / FILE)) as connection:
        return connection.execute(query).fetchall()


def saying(words: str) -> tuple[Event, ...]:
    """A completed sitting in which these words were recorded."""
    return (*FINISHED, happened.SpeechFailed(at_ms=7, utterance=1, why=words), *COMPLETED[2:])


def seated(
    recorder: Recorder,
    provenance: Provenance,
    events: Sequence[Event] = COMPLETED,
    *,
    allotted: Allotted = Allotted.LIST,
    simulated: bool | SessionKind = True,
) -> Place | None:
    """Have somebody play in the next place, or without one, and say which place it was."""
    place = recorder.next_place(simulated=simulated) if allotted is Allotted.LIST else None
    plan = replace(provenance.plan, condition=place.condition) if place else provenance.plan
    recorder.begin(replace(provenance, plan=plan, place=place, allotted=allotted, simulated=simulated), events)
    return place


def a_day(folder: Path, provenance: Provenance, site: str = "", seed: int = 1) -> list[Participant]:
    """A day at a booth: three people, two rehearsals, two who were not stored, and a deviation."""
    with Recorder(folder, site) as recorder:
        recorder.fix_list(FOUR, 4, seed, simulated=False)
        people = []
        for number, (events, simulated) in enumerate(
            [(saying(f"{site} one"), False), (LEFT, False), (COMPLETED, True), (saying(f"{site} two"), False)]
        ):
            place = None if simulated else recorder.next_place(simulated=False)
            plan = replace(provenance.plan, condition=place.condition) if place else provenance.plan
            sitting = replace(provenance, plan=plan, seed=seed * 100 + number, simulated=simulated, place=place)
            people.append(recorder.begin(replace(sitting, allotted=Allotted.LIST if place else None), events))
        recorder.count_visit(Unstored.DECLINED, simulated=False)
        recorder.count_visit(Unstored.UNDER_AGE, simulated=False)
        recorder.note("deviation", {"why": f"the robot of {site} fell over"})
    return people
