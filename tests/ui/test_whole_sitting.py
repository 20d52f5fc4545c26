"""A visitor clicks through the real window, and everything that happened is in the database."""

from __future__ import annotations

import json
from itertools import pairwise

import pytest

from kiosk.settings import STAGES, Settings
from kiosk.store.reading import archive
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Command
from kiosk.study.events import Stage, Status, Unstored, WorldEvent
from kiosk.study.session import Session
from kiosk.ui.rehearsing.rehearsal import Rehearsal
from kiosk.ui.rehearsing.visitor import Character, Manner
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.headless import SMALL


def test_a_whole_sitting_by_mouse_leaves_its_events_its_hints_its_answers_and_its_consent(
    make_booth: MakeBooth,
) -> None:
    booth = make_booth(settings=Settings())
    booth.rehearse(seed=1)
    with archive(booth.data) as stored:
        (sitting,) = stored.sittings()
        events, plan = stored.events(sitting.id), stored.plan(sitting.id)
    assert sitting.status is Status.COMPLETED
    assert sitting.measures.pairs == 12
    assert sitting.measures.flips == 2 * sitting.measures.moves
    hints = [event for event in events if isinstance(event, happened.HintGiven)]
    assert len(hints) == sitting.measures.hints > 0
    assert all(hint.sentence for hint in hints)
    stages = [event.stage.value for event in events if isinstance(event, happened.StageEntered)]
    assert stages == [*STAGES, "over"]
    (consent,) = (event for event in events if isinstance(event, happened.ConsentGiven))
    assert {"take_part", "store"} <= set(consent.purposes)
    answered = {event.item for event in events if isinstance(event, happened.AnswerGiven)}
    assert answered == {item.id for asked in (plan.about_you, *plan.questionnaires) for item in asked.questions}
    assert isinstance(events[-1], happened.SittingEnded)


@pytest.mark.parametrize(
    ("manner", "why"), [(Manner.DECLINES, Unstored.DECLINED), (Manner.UNDER_AGE, Unstored.UNDER_AGE)]
)
def test_who_declines_or_is_too_young_plays_to_the_end_and_nothing_is_stored_of_it(
    make_booth: MakeBooth, manner: Manner, why: Unstored
) -> None:
    booth = make_booth(settings=SMALL)
    why_not: list[Unstored] = []
    rehearsal = Rehearsal(booth.app, 1, visitor=Character(manner))
    watch = booth.app.conductor.witness
    assert watch is not None

    def look(event: WorldEvent, commands: tuple[Command, ...], stage: Stage) -> None:
        why_not.extend(command.why for command in commands if isinstance(command, do.ForgetSitting))
        watch(event, commands, stage)

    booth.app.conductor.witness = look
    rehearsal.run()
    assert why_not == [why]
    assert booth.screen == "attract"
    with archive(booth.data) as stored:
        assert list(stored.sittings()) == []


@pytest.mark.parametrize("stage", ["consent", "about_you", "practice", "game", "result", "questions", "debrief"])
def test_whoever_walks_away_is_asked_and_then_the_kiosk_is_free_again(make_booth: MakeBooth, stage: str) -> None:
    booth = make_booth(settings=SMALL)
    asked: list[bool] = []
    kiosk = booth.app.screens.kiosk
    kiosk.changed.connect(lambda: asked.append(bool(kiosk.property("asksStillThere"))))
    booth.rehearse(1, Character(Manner.LEAVES, Stage(stage)))
    assert True in asked
    assert booth.screen == "attract"
    with archive(booth.data) as stored:
        endings = [sitting.status for sitting in stored.sittings()]
    assert endings == ([] if stage == "consent" else [Status.ABANDONED])


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_whoever_clicks_twice_and_taps_everywhere_comes_to_the_end_too(make_booth: MakeBooth, seed: int) -> None:
    booth = make_booth(settings=SMALL)
    booth.rehearse(seed, Character(Manner.HASTY))
    with archive(booth.data) as stored:
        assert [sitting.status for sitting in stored.sittings()] == [Status.COMPLETED]


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
