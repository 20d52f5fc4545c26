"""What became of a session, at a glance."""

from __future__ import annotations

from dataclasses import replace

import pytest

from kiosk.experiment import events as happened
from kiosk.experiment.events import Event, InputDevice
from kiosk.experiment.intervals import Interval
from kiosk.experiment.outcomes import EmbodimentName, Stage, Status
from kiosk.experiment.session_state import SessionState, StageVisit
from tests.experiment.driver import Driver, driven_to
from tests.samples import INFORMATION, whole

UNDERWAY = list(Stage)[1:-1]


def test_of_nothing_nothing_became() -> None:
    assert SessionState.from_events([]) == SessionState(
        stages=(),
        pauses=(),
        boards=(),
        sentences=(),
        responses={},
        shown_items={},
        consent=None,
        practice_end=None,
        game_completed=False,
        embodiment_changes=(),
        resumptions=(),
        status=None,
    )


def test_a_whole_session_went_through_every_stage() -> None:
    driver = driven_to(Stage.OVER)
    seen = SessionState.from_events(driver.events)
    assert [entered.stage for entered in seen.stages] == list(Stage)[1:]
    assert [entered.at_ms for entered in seen.stages] == sorted(entered.at_ms for entered in seen.stages)
    assert seen.stages[-1].at_ms == driver.now
    assert (seen.last_stage, seen.status, seen.game_completed) == (Stage.THANKS, Status.COMPLETED, True)
    assert (seen.embodiment_changes, seen.pauses, seen.resumptions) == ((), (), ())
    assert seen.consent is not None
    assert (seen.consent.version, seen.consent.purposes) == (INFORMATION.version, ("store", "share"))


@pytest.mark.parametrize("stage", UNDERWAY)
def test_a_session_that_was_ended_tells_in_which_stage_and_how(stage: Stage) -> None:
    driver = driven_to(stage)
    assert SessionState.from_events(driver.events).status is None
    assert SessionState.from_events(driver.events).last_stage is stage
    driver.end()
    seen = SessionState.from_events(driver.events)
    assert (seen.last_stage, seen.status) == (stage, Status.STOPPED)
    assert seen.game_completed is (UNDERWAY.index(stage) > UNDERWAY.index(Stage.GAME))
    assert (seen.consent is None) is (stage in {Stage.ABOUT, Stage.AGE, Stage.CONSENT})


def test_every_pair_found_is_not_yet_a_completed_game() -> None:
    events: list[Event] = [happened.StageEntered(at_ms=0, stage=Stage.GAME)]
    assert not SessionState.from_events(events).game_completed
    assert SessionState.from_events([*events, happened.GameFinished(at_ms=9)]).game_completed


def test_a_session_that_went_on_after_an_interruption_has_not_ended() -> None:
    driver = driven_to(Stage.PRACTICE)
    cut = [*driver.events, happened.SessionEnded(at_ms=driver.now, status=Status.INTERRUPTED)]
    assert SessionState.from_events(cut).status is Status.INTERRUPTED
    resumed = Driver.resumed(driver.plan, 5, driver.world, EmbodimentName.robot("furhat"))
    later = [*cut, *resumed.events[len(driver.events) :]]
    seen = SessionState.from_events(later)
    assert seen.status is None
    assert seen.resumptions == (happened.SessionResumed(at_ms=driver.now, embodiment=EmbodimentName.robot("furhat")),)
    assert [entered.stage for entered in seen.stages[-2:]] == [Stage.PRACTICE, Stage.PRACTICE]
    resumed.to(Stage.OVER)
    assert SessionState.from_events([*cut, *resumed.events[len(driver.events) :]]).status is Status.COMPLETED


def test_pauses_are_told_from_when_to_when() -> None:
    driver = driven_to(Stage.INTRODUCTION, whole())
    for wait in (300, 4000):
        driver.pause()
        driver.spend(wait)
        driver.end_pause()
        driver.spend(100)
    began = driver.now - 100 - 4000 - 100 - 300
    driver.pause()
    pauses = (Interval(began, began + 300), Interval(began + 400, began + 4400), Interval(driver.now))
    assert SessionState.from_events(driver.events).pauses == pauses
    driver.spend(50)
    driver.end()
    assert SessionState.from_events(driver.events).pauses == (*pauses[:2], Interval(driver.now - 50, driver.now))


def test_a_pause_that_was_cut_off_is_over_when_the_session_goes_on() -> None:
    events = [happened.PauseRequested(at_ms=10), happened.SessionResumed(at_ms=30, embodiment=EmbodimentName.AVATAR)]
    assert SessionState.from_events(events).pauses == (Interval(10, 30),)
    assert SessionState.from_events([*events, happened.PauseRequested(at_ms=40)]).pauses == (
        Interval(10, 30),
        Interval(40),
    )


def test_changes_of_the_body_are_told_with_why() -> None:
    driver = driven_to(Stage.GAME)
    driver.send(happened.RobotDisconnected(at_ms=driver.now, why="the plug"))
    changed = happened.EmbodimentChanged(at_ms=driver.now, embodiment=EmbodimentName.AVATAR, why="the plug")
    assert SessionState.from_events(driver.events).embodiment_changes == (changed,)


def test_a_stage_is_told_with_its_time() -> None:
    events = [happened.StageEntered(at_ms=7, stage=Stage.AGE), happened.StageEntered(at_ms=9, stage=Stage.OVER)]
    seen = SessionState.from_events(events)
    assert (seen.stages, seen.last_stage) == ((StageVisit(Stage.AGE, 7), StageVisit(Stage.OVER, 9)), Stage.AGE)


def test_a_flip_keeps_what_it_was_tapped_with_when_its_card_is_turned_back_or_its_pair_found() -> None:
    way = ((40, 0.5, 0.25), (7, 1.0, 0.5))
    events = [
        replace(event, device=InputDevice.TOUCH, trace=way) if isinstance(event, happened.CardSelected) else event
        for event in driven_to(Stage.OVER).events
    ]
    flips = [flip for dealt in SessionState.from_events(events).boards for flip in dealt.flips.values()]
    assert {flip.event.matched for flip in flips} == {None, False, True}
    assert all(flip.exposure_ms is not None for flip in flips)
    assert {(flip.device, flip.trace) for flip in flips} == {(InputDevice.TOUCH, way)}
