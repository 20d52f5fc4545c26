"""A visitor clicks through the real window, and everything that happened is in the database."""

from __future__ import annotations

import json
from itertools import pairwise

from kiosk.store.reading import archive
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.events import Stage, Status, WorldEvent
from kiosk.study.session import Session
from tests.ui.conftest import Booth, MakeBooth


def test_a_whole_sitting_by_mouse_leaves_its_events_its_hints_and_its_result(booth: Booth) -> None:
    booth.rehearse(seed=1)
    with archive(booth.data) as stored:
        (sitting,) = stored.sittings()
        events = stored.events(sitting.id)
    assert sitting.status is Status.COMPLETED
    assert sitting.measures.pairs == 12
    assert sitting.measures.flips == 2 * sitting.measures.moves
    hints = [event for event in events if isinstance(event, happened.HintGiven)]
    assert len(hints) == sitting.measures.hints > 0
    assert all(hint.sentence for hint in hints)
    stages = [event.stage for event in events if isinstance(event, happened.StageEntered)]
    assert stages == [Stage.INTRODUCTION, Stage.GAME, Stage.RESULT, Stage.QUESTIONS, Stage.OVER]
    answers = {event.item: event.value for event in events if isinstance(event, happened.AnswerGiven)}
    assert set(answers) == {"enjoyed", "helped", "understood"}
    assert isinstance(events[-1], happened.SittingEnded)


def test_every_flip_in_the_database_is_a_card_that_was_clicked_just_before(booth: Booth) -> None:
    booth.rehearse(seed=2)
    with archive(booth.data) as stored:
        events = stored.events(1)
    flips = 0
    for before, event in pairwise(events):
        if isinstance(event, happened.CardFlipped):
            assert isinstance(before, happened.CardTapped)
            assert before.position == event.position
            assert before.at_ms == event.at_ms
            flips += 1
    assert flips >= 24


def test_a_stored_sitting_handled_again_gives_the_same_records(booth: Booth) -> None:
    booth.rehearse(seed=3)
    with archive(booth.data) as stored:
        events = stored.events(1)
        again = Session(stored.plan(1), stored.seed(1))
    replayed: list[happened.Event] = []
    for event in events:
        if isinstance(event, WorldEvent):
            commands = again.handle(event)
            replayed += [event, *(command.event for command in commands if isinstance(command, do.Record))]
    assert replayed == events


def test_the_same_seed_plays_the_same_sitting_to_the_millisecond(make_booth: MakeBooth) -> None:
    stories = []
    for _ in range(2):
        booth = make_booth(seed=5)
        booth.rehearse(seed=5)
        with archive(booth.data) as stored:
            stories.append(json.dumps(stored.records(1)))
    assert stories[0] == stories[1]


def test_without_help_a_visitor_plays_alone(make_booth: MakeBooth) -> None:
    booth = make_booth(condition="no_assistance")
    booth.rehearse(seed=1)
    with archive(booth.data) as stored:
        assert stored.sittings()[0].measures.hints == 0


def test_one_sitting_after_another_is_played_in_the_same_window(booth: Booth) -> None:
    for seed in (1, 2, 3):
        booth.rehearse(seed=seed)
        assert booth.screen == "attract"
    with archive(booth.data) as stored:
        assert [sitting.status for sitting in stored.sittings()] == [Status.COMPLETED] * 3
