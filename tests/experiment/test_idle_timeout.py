"""Who is there: asked after a time without a tap, and not while the experimenter has stopped the session."""

from __future__ import annotations

from dataclasses import replace

import pytest

from kiosk.assistance.policy import ActionSpec
from kiosk.config import Idle, Practice, Timing
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.events import Timer
from kiosk.experiment.information import ConsentPage, Page, Purpose
from kiosk.experiment.items import ShortText
from kiosk.experiment.outcomes import Stage, Status
from kiosk.experiment.transitions import InvalidTransition
from kiosk.game import Position
from tests.experiment.driver import SPEECH_TIME, Driver, Voice, driven_to, with_memory
from tests.experiment.examples import EXAMPLES
from tests.experiment.table import a_pair, playing
from tests.samples import INFORMATION, always, likert, questionnaire, whole

LONG_ENOUGH = {
    Stage.ABOUT: 60_000,
    Stage.AGE: 45_000,
    Stage.CONSENT: 90_000,
    Stage.ABOUT_YOU: 60_000,
    Stage.INTRODUCTION: 45_000,
    Stage.PRACTICE: 60_000,
    Stage.GAME: 120_000,
    Stage.RESULT: 45_000,
    Stage.QUESTIONS: 60_000,
    Stage.DEBRIEF: 90_000,
    Stage.THANKS: 45_000,
}
"""How long every stage waits before it asks, in ms, if the study file does not say otherwise."""

LASTING = whole(policy=always(ActionSpec.NO_HELP), timing=Timing(thanks_ms=10**6))
"""A session whose thanks do not end by themselves before the visitor can be asked."""


def test_there_is_a_time_for_every_stage() -> None:
    assert list(LONG_ENOUGH) == list(Stage)[1:-1]


@pytest.mark.parametrize(("stage", "after"), list(LONG_ENOUGH.items()))
def test_whoever_does_nothing_is_asked_whether_they_are_still_there(stage: Stage, after: int) -> None:
    driver = driven_to(stage, LASTING)
    at = driver.now
    driver.spend(after - 1)
    assert not driver.view.still_there
    driver.spend(1)
    assert driver.view.still_there
    assert (driver.now, driver.stage) == (at + after, stage)


def test_in_the_game_they_may_think_for_longer() -> None:
    driver = playing()
    driver.spend(119_999)
    assert not driver.view.still_there
    driver.spend(1)
    assert driver.view.still_there


@pytest.mark.parametrize("stage", LONG_ENOUGH)
def test_whoever_does_not_answer_has_left_and_the_session_is_abandoned_there(stage: Stage) -> None:
    driver = driven_to(stage, LASTING)
    while not driver.view.still_there:
        driver.wait()
    asked_at = driver.now
    driver.spend(19_999)
    assert driver.stage is stage
    driver.spend(1)
    assert (driver.now, driver.view.ended) == (asked_at + 20_000, Status.ABANDONED)
    assert [type(event).__name__ for event in driver.events[-3:]] == ["IdleTimedOut", "StageEntered", "SessionEnded"]
    assert not driver.running


@pytest.mark.parametrize("stage", LONG_ENOUGH)
def test_whoever_answers_goes_on_where_they_were(stage: Stage) -> None:
    driver = driven_to(stage, LASTING)
    while not driver.view.still_there:
        driver.wait()
    driver.send(happened.PresenceConfirmed(at_ms=driver.now))
    assert (driver.view.still_there, driver.stage) == (False, stage)
    assert driver.running.keys() - {Timer.PRACTICE, Timer.THANKS} == {Timer.IDLE}
    assert driver.running[Timer.IDLE] == driver.now + LONG_ENOUGH[stage]


def test_any_tap_is_an_answer_too() -> None:
    driver = playing()
    while not driver.view.still_there:
        driver.wait()
    outcome = driver.tap(Position(0, 0))
    assert not driver.view.still_there
    assert do.StopTimer(Timer.STILL_THERE) in outcome.effects
    assert Timer.STILL_THERE not in driver.running


def test_every_tap_starts_the_idle_time_anew() -> None:
    driver = playing(ActionSpec.SUG_CARD, Voice.IS_SILENT)
    driver.spend(1000)
    driver.tap(Position(0, 0))
    assert driver.running[Timer.IDLE] == driver.now + 120_000


@pytest.mark.parametrize("stage", LONG_ENOUGH)
def test_activity_puts_the_question_off_from_the_moment_when_it_was_seen(stage: Stage) -> None:
    driver = driven_to(stage, LASTING)
    driver.spend(LONG_ENOUGH[stage] - 1)
    driver.send(happened.UserActivity(at_ms=driver.now, ago_ms=20_000))
    assert driver.running[Timer.IDLE] == driver.now - 20_000 + LONG_ENOUGH[stage]
    assert not driver.view.still_there


def test_activity_answers_the_question_and_a_time_to_come_is_refused() -> None:
    driver = playing()
    while not driver.view.still_there:
        driver.wait()
    with pytest.raises(InvalidTransition):
        driver.send(happened.UserActivity(at_ms=driver.now, ago_ms=-1))
    driver.send(happened.UserActivity(at_ms=driver.now, ago_ms=0))
    assert not driver.view.still_there
    assert Timer.STILL_THERE not in driver.running


LONG_TEXT = "word " * 1000


@pytest.mark.parametrize("stage", [Stage.ABOUT, Stage.CONSENT, Stage.ABOUT_YOU, Stage.QUESTIONS, Stage.DEBRIEF])
def test_a_text_that_takes_longer_to_read_puts_the_question_off_until_then(stage: Stage) -> None:
    page = Page(title="A page", paragraphs=(LONG_TEXT,))
    consent = ConsentPage(title="Consent", paragraphs=("a line",), purposes=(Purpose(id="store", text=LONG_TEXT),))
    long = replace(
        LASTING,
        information=INFORMATION.model_copy(update={"about": page, "consent": consent, "debrief": page}),
        about_you=questionnaire("about-you", ShortText(id="t", kind="text", text={"en": LONG_TEXT, "it": "no"})),
        questionnaires=(questionnaire("closing", likert("short"), likert("long", text={"en": LONG_TEXT})),),
    )
    driver = driven_to(stage, long)
    least = Timing().reading_ms_per_char * len(LONG_TEXT)
    assert least <= driver.running[Timer.IDLE] - driver.now < 1.2 * least


def test_a_sentence_that_ends_does_not_show_that_somebody_is_there() -> None:
    driver = playing(ActionSpec.SUG_CARD)
    until = driver.running[Timer.IDLE]
    driver.wait_until_open()
    assert driver.running[Timer.IDLE] == until


def test_a_stage_that_ends_by_itself_takes_the_question_with_it() -> None:
    driver = driven_to(
        Stage.GAME, whole(policy=always(ActionSpec.NO_HELP), idle_ms=Idle(game=1000), timing=Timing(finish_ms=1500))
    )
    while len(driver.view.found) < 24:
        for place in a_pair(driver):
            driver.flip(place)
    driver.spend(1000)
    assert driver.view.still_there
    driver.spend(500)
    assert driver.stage is Stage.RESULT
    assert not driver.view.still_there


# Pauses

TAPS = [event for event in EXAMPLES.values() if event.by_visitor and not isinstance(event, happened.SessionStarted)]


def at(driver: Driver, event: happened.WorldEvent) -> happened.WorldEvent:
    """Return the event, now."""
    return replace(event, at_ms=driver.now)


@pytest.mark.parametrize("stage", LONG_ENOUGH)
def test_while_the_session_is_paused_a_visitor_can_do_nothing(stage: Stage) -> None:
    driver = driven_to(stage, LASTING)
    assert do.ShowPause() in driver.pause().effects
    steps = len(driver.steps)
    for event in TAPS:
        with pytest.raises(InvalidTransition):
            driver.send(at(driver, event))
        assert (driver.stage, driver.view.paused, len(driver.steps)) == (stage, True, steps), event


@pytest.mark.parametrize("stage", LONG_ENOUGH)
def test_in_a_pause_nobody_is_asked_and_afterwards_the_idle_time_starts_anew(stage: Stage) -> None:
    driver = driven_to(stage, LASTING)
    driver.spend(LONG_ENOUGH[stage] - 1)
    driver.pause()
    assert not driver.running.keys() & {Timer.IDLE, Timer.STILL_THERE}
    driver.spend(200_000)
    assert (driver.stage, driver.view.still_there) == (stage, False)
    driver.end_pause()
    assert not driver.view.paused
    assert driver.running[Timer.IDLE] == driver.now + LONG_ENOUGH[stage]


@pytest.mark.parametrize("stage", LONG_ENOUGH)
def test_a_pause_that_nobody_ends_ends_the_session(stage: Stage) -> None:
    driver = driven_to(stage, LASTING)
    driver.pause()
    # A practice comes to its own end in a pause as well, and the pause goes on over the game.
    counted_from = driver.now + (300_000 if stage is Stage.PRACTICE else 0)
    while driver.view.ended is None:
        driver.wait()
    assert (driver.now, driver.view.paused) == (counted_from + 900_000, False)
    assert driver.view.ended is Status.ABANDONED
    assert not driver.running


@pytest.mark.parametrize("stage", LONG_ENOUGH)
def test_a_pause_takes_the_question_away(stage: Stage) -> None:
    driver = driven_to(stage, LASTING)
    while not driver.view.still_there:
        driver.wait()
    driver.pause()
    assert not driver.view.still_there
    driver.spend(60_000)
    assert (driver.stage, driver.view.ended) == (stage, None)


@pytest.mark.parametrize("stage", LONG_ENOUGH)
def test_a_pause_begins_and_ends_once(stage: Stage) -> None:
    driver = driven_to(stage, LASTING)
    with pytest.raises(InvalidTransition):
        driver.end_pause()
    for _ in range(2):
        driver.pause()
        with pytest.raises(InvalidTransition):
            driver.pause()
        driver.end_pause()
        with pytest.raises(InvalidTransition):
            driver.end_pause()


@pytest.mark.parametrize("stage", LONG_ENOUGH)
@pytest.mark.parametrize("status", [Status.STOPPED, Status.INTERRUPTED])
def test_a_paused_session_can_be_ended_and_leaves_no_cover_behind(stage: Stage, status: Status) -> None:
    driver = driven_to(stage, LASTING)
    driver.pause()
    if status is Status.STOPPED:
        driver.end()
    else:
        driver.send(happened.ApplicationClosed(at_ms=driver.now))
    assert (driver.view.ended, driver.view.paused, driver.running) == (status, False, {})


def test_a_pause_lasts_across_a_change_of_the_stage() -> None:
    driver = driven_to(
        Stage.PRACTICE, whole(policy=always(ActionSpec.NO_HELP), practice=Practice(max_duration_ms=5000))
    )
    driver.pause()
    driver.spend(6000)
    assert (driver.stage, driver.view.paused) == (Stage.GAME, True)
    assert Timer.IDLE not in driver.running
    with pytest.raises(InvalidTransition):
        driver.tap(driver.view.closed[0])
    driver.end_pause()
    assert driver.running[Timer.IDLE] == driver.now + LONG_ENOUGH[Stage.GAME]
    driver.play(with_memory(1))
    first, *_, last = driver.noted(happened.CardFlipped)
    assert driver.session.measures.completion_with_speech_ms == last.at_ms - first.at_ms


def test_thanks_that_end_in_a_pause_end_the_session_and_leave_no_cover_behind() -> None:
    driver = driven_to(Stage.THANKS)
    driver.pause()
    driver.spend(12_000)
    assert (driver.view.ended, driver.view.paused, driver.running) == (Status.COMPLETED, False, {})


@pytest.mark.parametrize("wait", [0, 500, 2500])
def test_both_clocks_of_the_game_leave_a_pause_out(wait: int) -> None:
    """A pause of a minute, begun while a hint is still said, at its end, or after it, as against no pause at all."""
    paused, straight = (playing(ActionSpec.SUG_CARD, seed=3) for _ in range(2))
    for driver in (paused, straight):
        driver.flip(driver.view.closed[0])
        driver.spend(wait)
    held = paused.view.held is not None
    paused.pause()
    paused.spend(60_000)
    paused.end_pause()
    for driver in (paused, straight):
        driver.play(with_memory(3))
    one, other = paused.session.measures, straight.session.measures
    assert one.flips == other.flips
    assert one.completion_ms == other.completion_ms
    # A hint that is heard within the pause holds the board no longer after it.
    assert other.completion_with_speech_ms - one.completion_with_speech_ms == (SPEECH_TIME - wait if held else 0)
