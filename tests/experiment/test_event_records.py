"""An event is written as plain JSON, and comes back as it was."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kiosk.assistance.mentaliser import HintReason
from kiosk.assistance.policy import ACTIONS, ActionSpec, FlipInMove, GateDecision, MoveOutcome, Phase
from kiosk.experiment import event_records
from kiosk.experiment import events as happened
from kiosk.experiment.event_records import from_record, to_record
from kiosk.experiment.events import Event, PracticeEnd, SessionEvent, Timer, WorldEvent
from kiosk.experiment.items import Answer
from kiosk.experiment.outcomes import EmbodimentKind, EmbodimentName, NotRecordedReason, Stage, Status
from kiosk.game import FlipRejection, Position
from tests.experiment.driver import Driver, with_memory
from tests.samples import whole


def kinds(family: type[Any]) -> Iterator[type[Any]]:
    """Every class of a family that has none below it."""
    for kind in family.__subclasses__():
        yield from kinds(kind) if kind.__subclasses__() else [kind]


EVERY_EVENT = list(kinds(Event))


st.register_type_strategy(float, st.floats(allow_nan=False, allow_infinity=False))
st.register_type_strategy(ActionSpec, st.sampled_from(ACTIONS))
st.register_type_strategy(
    EmbodimentName, st.one_of(st.just(EmbodimentName.AVATAR), st.text(min_size=1).map(EmbodimentName.robot))
)


@pytest.mark.parametrize("kind", EVERY_EVENT, ids=lambda kind: str(kind.__name__))
# An event has few fields, and there are many kinds with the same ones.
@settings(max_examples=30)
@given(st.data())
def test_any_event_comes_back_from_its_record_as_it_was(kind: type[Event], data: st.DataObject) -> None:
    event = data.draw(st.builds(kind))
    record = json.loads(json.dumps(to_record(event)))
    assert record["type"] == kind.__name__
    assert from_record(record) == event
    assert type(from_record(record)) is kind
    # In this order it is read in the general way, which takes longer.
    assert from_record(dict(reversed(record.items()))) == event


def test_every_event_is_from_outside_or_a_conclusion() -> None:
    assert {*kinds(WorldEvent), *kinds(SessionEvent)} == set(EVERY_EVENT)
    assert len({kind.__name__ for kind in EVERY_EVENT}) == len(EVERY_EVENT)


def test_a_tap_shows_that_somebody_is_there_and_a_clock_does_not() -> None:
    assert {kind.__name__ for kind in kinds(WorldEvent) if kind.by_visitor} == {
        "SessionStarted",
        "ContinuePressed",
        "BackPressed",
        "StopPressed",
        "RepeatPressed",
        "LanguageSelected",
        "TextSizeSelected",
        "SoundSelected",
        "ConsentPurposeToggled",
        "ConsentSubmitted",
        "ConsentDeclined",
        "AgeConfirmed",
        "PracticeSkipped",
        "CardSelected",
        "ResponseGiven",
        "PresenceConfirmed",
        "TypingActivity",
        "UserActivity",
    }


def test_a_record_can_be_read_without_the_program() -> None:
    flipped = happened.CardFlipped(at_ms=12, number=2, move=1, position=Position(0, 5), card="owl", matched=False)
    assert to_record(flipped) == {
        "type": "CardFlipped",
        "at_ms": 12,
        "number": 2,
        "move": 1,
        "position": {"row": 0, "column": 5},
        "card": "owl",
        "matched": False,
    }
    decided = happened.AssistanceDecided(
        at_ms=3,
        flip=7,
        card=FlipInMove.SECOND,
        game=Phase.MIDDLE,
        last=ActionSpec.SUG_ROW,
        outcome=MoveOutcome.S_WRONG,
        gate=GateDecision.STILL_EXPLORING,
        action=ActionSpec.NO_HELP,
        greedy=ActionSpec.NO_HELP,
        probability=1.0,
        randomised=False,
    )
    assert to_record(decided) == {
        "type": "AssistanceDecided",
        "at_ms": 3,
        "flip": 7,
        "card": "second",
        "game": "middle",
        "last": "sug_row",
        "outcome": "s_wrong",
        "gate": "still_exploring",
        "action": "no_help",
        "greedy": "no_help",
        "probability": 1.0,
        "randomised": False,
    }


@pytest.mark.parametrize("kind", EVERY_EVENT, ids=lambda kind: str(kind.__name__))
def test_what_is_not_of_its_kind_is_read_as_in_general_or_not_at_all(kind: type[Event]) -> None:
    assert event_records._kind_to_read(kind.__name__)[1] is not None
    for wrong in ({}, {"at_ms": "early"}, {"at_ms": 3.0}, {"at_ms": True, "more": 1}, {"at_ms": None}):
        event: Event | None
        try:
            event = event_records._converter().structure(wrong, kind)
        except Exception:  # noqa: BLE001 - whatever it is, it is not an event
            event = None
        if event is None:
            with pytest.raises(ValueError, match="event"):
                from_record({"type": kind.__name__, **wrong})
        else:
            assert repr(from_record({"type": kind.__name__, **wrong})) == repr(event)


@pytest.mark.parametrize(
    ("closed_set", "names"),
    [
        (
            Stage,
            "attract about age consent about_you introduction practice game result questions debrief thanks over",
        ),
        (
            Timer,
            "turn_back mark reading speech_deadline hold mood finish practice thanks pause idle still_there hesitation",
        ),
        (Status, "completed abandoned stopped withdrawn interrupted"),
        (NotRecordedReason, "declined under_age left"),
        (PracticeEnd, "found left time"),
        (EmbodimentKind, "avatar robot"),
        (FlipInMove, "first second"),
    ],
)
def test_the_names_in_the_records_are_fixed_for_ever(closed_set: Any, names: str) -> None:
    assert [member.value for member in closed_set] == names.split()


@pytest.mark.parametrize("value", [None, 3, "owl", "", (), ("en",), ("en", "it")])
def test_an_answer_is_a_number_a_text_some_options_or_none(value: Answer | None) -> None:
    given_one = happened.ResponseGiven(at_ms=1, item="age", value=value)
    record = json.loads(json.dumps(to_record(given_one)))
    assert record["value"] == (list(value) if isinstance(value, tuple) else value)
    assert from_record(record) == given_one


def test_why_a_tap_was_ignored_and_why_a_hint_was_given_are_told_by_name() -> None:
    ignored = happened.CardSelectionRejected(at_ms=1, position=Position(0, 0), why=FlipRejection.TURNING_BACK)
    assert to_record(ignored)["why"] == "two cards are still turning back"
    assert to_record(happened.CardSelectionRejected(at_ms=1, position=Position(0, 0), why=None))["why"] is None
    assert {reason.value for reason in HintReason} == {
        *("nothing-known", "one-seen-once", "both-seen-once", "often-and-never"),
        *("often-and-once", "both-often", "first-sight", "open-once-mate-often"),
    }


@pytest.mark.parametrize(
    "record",
    [
        {},
        {"at_ms": 1},
        {"type": "SessionStarted"},
        {"type": "NoSuchEvent", "at_ms": 1},
        {"type": "SessionStarted", "at_ms": "soon"},
        {"type": "SessionStarted", "at_ms": None},
        {"type": "SessionStarted", "at_ms": 1, "why": "an extra key"},
        {"type": "CardSelected", "at_ms": 1},
        {"type": "CardSelected", "at_ms": 1, "position": 5},
        {"type": "CardSelected", "at_ms": 1, "position": {"row": 1}},
        {"type": "StageEntered", "at_ms": 1, "stage": "moon"},
        {"type": "TimerExpired", "at_ms": 1, "timer": "TURN_BACK"},
        {"type": "ResponseGiven", "at_ms": 1, "item": "age"},
        {"type": "ResponseGiven", "at_ms": 1, "item": "age", "value": True},
        {"type": "ResponseGiven", "at_ms": 1, "item": "age", "value": 1.5},
        {"type": "ResponseGiven", "at_ms": 1, "item": "age", "value": ["en", 1]},
        {"type": "AgeConfirmed", "at_ms": 1},
    ],
    ids=str,
)
def test_anything_else_is_refused(record: dict[str, Any]) -> None:
    with pytest.raises((ValueError, KeyError)):
        from_record(record)


def test_a_whole_session_comes_back_from_its_records() -> None:
    driver = Driver(whole())
    driver.whole_session(with_memory(1))
    text = json.dumps([to_record(event) for event in driver.events])
    assert [from_record(record) for record in json.loads(text)] == driver.events
