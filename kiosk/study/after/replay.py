"""A stored sitting, handled again: what every event led to, and whether that is what was recorded."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from kiosk.study import commands as do
from kiosk.study.commands import Command
from kiosk.study.events import Event, Stage, WorldEvent
from kiosk.study.plan import Plan
from kiosk.study.session import Session
from kiosk.study.stages import UnexpectedEvent


@dataclass(frozen=True)
class Step:
    """One event from outside, what it led to, and the stage that the sitting was in afterwards.

    ``seq`` is the event's number in the record, from 1; ``agrees``: what was concluded then is what is concluded now.
    """

    seq: int
    event: WorldEvent
    commands: tuple[Command, ...]
    stage: Stage
    agrees: bool


def replayed(plan: Plan, seed: int, events: Sequence[Event]) -> tuple[Step, ...]:
    """The steps of a sitting from its events, numbered from 1; it ends where the program of today refuses an event."""
    session = Session(plan, seed)
    steps: list[Step] = []
    for index, event in enumerate(events):
        if not isinstance(event, WorldEvent):
            continue
        try:
            commands = session.handle(event)
        except UnexpectedEvent:
            break
        concluded = [command.event for command in commands if isinstance(command, do.Record)]
        recorded = list(events[index + 1 : index + 1 + len(concluded)])
        steps.append(Step(index + 1, event, commands, session.stage, agrees=concluded == recorded))
    return tuple(steps)


def first_difference(steps: Iterable[Step], events: Sequence[Event]) -> int | None:
    """The number of the first event that today comes out otherwise than it was recorded; None if all agree."""
    steps = tuple(steps)
    differing = next((step.seq for step in steps if not step.agrees), None)
    if differing is not None:
        return differing
    reached = {step.seq for step in steps}
    world = (number for number, event in enumerate(events, 1) if isinstance(event, WorldEvent))
    return next((number for number in world if number not in reached), None)
