"""What became of a session, at a glance."""

from __future__ import annotations

import pytest

from kiosk.experiment import events as happened
from kiosk.experiment.events import EmbodimentName, Event, Stage, Status
from kiosk.experiment.projections import PauseInterval, SessionSummary, StageVisit, summarise_session
from tests.experiment.driver import Driver, driven_to
from tests.samples import INFORMATION, whole

UNDERWAY = list(Stage)[1:-1]


def test_of_nothing_nothing_became() -> None:
    assert summarise_session([]) == SessionSummary(
        entered=(),
        last=None,
        status=None,
        game_completed=False,
        consent=None,
        body_changes=(),
        pauses=(),
        resumptions=(),
    )


def test_a_whole_session_went_through_every_stage() -> None:
    driver = driven_to(Stage.OVER)
    seen = summarise_session(driver.events)
    assert [entered.stage for entered in seen.entered] == list(Stage)[1:]
    assert [entered.at_ms for entered in seen.entered] == sorted(entered.at_ms for entered in seen.entered)
    assert seen.entered[-1].at_ms == driver.now
    assert (seen.last, seen.status, seen.game_completed) == (Stage.THANKS, Status.COMPLETED, True)
    assert (seen.body_changes, seen.pauses, seen.resumptions) == ((), (), ())
    assert seen.consent is not None
    assert (seen.consent.version, seen.consent.purposes) == (INFORMATION.version, ("store", "share"))


@pytest.mark.parametrize("stage", UNDERWAY)
def test_a_session_that_was_ended_tells_in_which_stage_and_how(stage: Stage) -> None:
    driver = driven_to(stage)
    assert summarise_session(driver.events).status is None
    assert summarise_session(driver.events).last is stage
    driver.end()
    seen = summarise_session(driver.events)
    assert (seen.last, seen.status) == (stage, Status.STOPPED)
    assert seen.game_completed is (UNDERWAY.index(stage) > UNDERWAY.index(Stage.GAME))
    assert (seen.consent is None) is (stage in {Stage.ABOUT, Stage.CONSENT})


def test_every_pair_found_is_not_yet_a_completed_game() -> None:
    events: list[Event] = [happened.StageEntered(at_ms=0, stage=Stage.GAME)]
    assert not summarise_session(events).game_completed
    assert summarise_session([*events, happened.GameFinished(at_ms=9)]).game_completed


def test_a_session_that_went_on_after_an_interruption_has_not_ended() -> None:
    driver = driven_to(Stage.PRACTICE)
    cut = [*driver.events, happened.SessionEnded(at_ms=driver.now, status=Status.INTERRUPTED)]
    assert summarise_session(cut).status is Status.INTERRUPTED
    resumed = Driver.resumed(driver.plan, 5, driver.world, EmbodimentName.robot("furhat"))
    later = [*cut, *resumed.events[len(driver.events) :]]
    seen = summarise_session(later)
    assert seen.status is None
    assert seen.resumptions == (happened.SessionResumed(at_ms=driver.now, body=EmbodimentName.robot("furhat")),)
    assert [entered.stage for entered in seen.entered[-2:]] == [Stage.PRACTICE, Stage.PRACTICE]
    resumed.to(Stage.OVER)
    assert summarise_session([*cut, *resumed.events[len(driver.events) :]]).status is Status.COMPLETED


def test_pauses_are_told_from_when_to_when() -> None:
    driver = driven_to(Stage.INTRODUCTION, whole())
    for wait in (300, 4000):
        driver.pause()
        driver.spend(wait)
        driver.end_pause()
        driver.spend(100)
    began = driver.now - 100 - 4000 - 100 - 300
    driver.pause()
    pauses = (PauseInterval(began, began + 300), PauseInterval(began + 400, began + 4400), PauseInterval(driver.now))
    assert summarise_session(driver.events).pauses == pauses
    driver.spend(50)
    driver.end()
    assert summarise_session(driver.events).pauses == (*pauses[:2], PauseInterval(driver.now - 50, driver.now))


def test_a_pause_that_was_cut_off_is_over_when_the_session_goes_on() -> None:
    events = [happened.PauseRequested(at_ms=10), happened.SessionResumed(at_ms=30, body=EmbodimentName.AVATAR)]
    assert summarise_session(events).pauses == (PauseInterval(10, 30),)
    assert summarise_session([*events, happened.PauseRequested(at_ms=40)]).pauses == (
        PauseInterval(10, 30),
        PauseInterval(40),
    )


def test_changes_of_the_body_are_told_with_why() -> None:
    driver = driven_to(Stage.GAME)
    driver.send(happened.RobotDisconnected(at_ms=driver.now, why="the plug"))
    changed = happened.EmbodimentChanged(at_ms=driver.now, body=EmbodimentName.AVATAR, why="the plug")
    assert summarise_session(driver.events).body_changes == (changed,)


def test_a_stage_is_told_with_its_time() -> None:
    events = [happened.StageEntered(at_ms=7, stage=Stage.AGE), happened.StageEntered(at_ms=9, stage=Stage.OVER)]
    seen = summarise_session(events)
    assert (seen.entered, seen.last) == ((StageVisit(Stage.AGE, 7), StageVisit(Stage.OVER, 9)), Stage.AGE)
