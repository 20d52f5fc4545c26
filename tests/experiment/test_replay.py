"""The stored events of a session, handled again, give the same outcomes again."""

from __future__ import annotations

import json

import pytest

from kiosk.experiment.condition import CONDITIONS, Condition
from kiosk.experiment.event_records import from_record, to_record
from kiosk.experiment.events import BoardDealt, WorldEvent
from tests.experiment.driver import Driver, Voice, at_random, forgetful, replay
from tests.samples import mixed, plan, whole


def session(seed: int, voice: Voice = Voice.SPEAKS, condition: Condition = Condition.TOM) -> Driver:
    """Return a whole session of all stages."""
    driver = Driver(whole(condition, mixed(seed)), seed, voice)
    driver.whole_session(forgetful(seed))
    return driver


@pytest.mark.parametrize("voice", Voice)
@pytest.mark.parametrize("condition", CONDITIONS)
def test_the_same_events_lead_to_the_same_outcome(voice: Voice, condition: Condition) -> None:
    played = session(7, voice, condition)
    assert replay(played.plan, 7, played.world) == [step.outcome for step in played.steps]


def test_so_do_events_that_were_written_and_read_again() -> None:
    played = session(8)
    text = json.dumps([to_record(event) for event in played.events])
    stored = [from_record(record) for record in json.loads(text)]
    world = [event for event in stored if isinstance(event, WorldEvent)]
    assert replay(played.plan, 8, world) == [step.outcome for step in played.steps]


def test_the_same_seed_and_visitor_make_the_same_session() -> None:
    assert session(9).steps == session(9).steps


def test_another_seed_makes_another_session() -> None:
    played = session(10)
    dealt = played.noted(BoardDealt)[0]
    to_the_board = next(number for number, step in enumerate(played.steps, 1) if dealt in step.outcome.events)
    other = replay(played.plan, 11, played.world[:to_the_board])
    assert other != [step.outcome for step in played.steps[:to_the_board]]


def test_two_sessions_of_one_plan_do_not_meet() -> None:
    shared = plan(policy=mixed(3))
    apart = [Driver(plan(policy=mixed(3)), seed) for seed in (1, 2)]
    together = [Driver(shared, seed) for seed in (1, 2)]
    for driver in (*apart, *together):
        driver.to_the_game()
    for alone in apart:
        alone.play(at_random(5))
    visitors = [at_random(5), at_random(5)]
    for _ in range(20):
        for driver, choose in zip(together, visitors, strict=True):
            driver.wait_until_open()
            driver.flip(choose(driver.view))
    for alone, driver in zip(apart, together, strict=True):
        assert driver.steps == alone.steps[: len(driver.steps)]
