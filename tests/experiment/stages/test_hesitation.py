"""A visitor who waits longer than they usually do gets a hint, if the study asks for it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from kiosk.assistance.policy import ActionSpec, FlipInMove, Gate
from kiosk.config import AssistanceConfig
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import Timer
from kiosk.experiment.session_state import SessionState
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.store.queries import DecisionExplainer, open_repository
from tests.experiment.driver import ONE_TAP, Driver, at_random, replay
from tests.export.conftest import rows_of
from tests.export.visitors import store
from tests.samples import always, mixed, plan

OWN_TIMES = 4
RULE = {"hesitation_max": 2, "hesitation_times": 3.0, "hesitation_flips": OWN_TIMES, "hesitation_least_ms": 1_000}
USUAL = ONE_TAP
THRESHOLD = 3 * USUAL


def playing(flips: int, *, policy: Any = None, condition: Condition = Condition.TOM, **changed: Any) -> Driver:
    """Return a game after so many quick flips, in which the board has just opened."""
    chosen = policy or always(ActionSpec.NO_HELP)
    driver = Driver(plan(condition, chosen, assistance=AssistanceConfig(**RULE | changed)), 3)
    driver.to_the_game()
    choose = at_random(3)
    for _ in range(flips):
        driver.flip(choose(driver.view))
    driver.wait_until_open()
    return driver


def hesitate(driver: Driver) -> None:
    """Wait for a hint, follow it or not, and flip on."""
    driver.spend(THRESHOLD)
    driver.flip(at_random(7)(driver.view))
    driver.wait_until_open()


def test_who_waits_longer_than_usual_gets_one_hint_for_this_flip() -> None:
    driver = playing(2 * OWN_TIMES)
    assert driver.running[Timer.HESITATION] == driver.now + THRESHOLD
    driver.spend(THRESHOLD - 1)
    assert not driver.noted(happened.HintGiven)
    driver.spend(1)
    (noticed,), (hint,) = driver.noted(happened.HesitationNoticed), driver.noted(happened.HintGiven)
    assert (noticed.waited_ms, noticed.usual_ms, noticed.threshold_ms) == (THRESHOLD, USUAL, THRESHOLD)
    assert (noticed.flip, noticed.card) == (hint.flip, hint.card) == (2 * OWN_TIMES + 1, FlipInMove.FIRST)
    assert hint.action is noticed.action is ActionSpec.SUG_COL
    decided = driver.noted(happened.AssistanceDecided)
    assert [event.flip for event in decided] == list(range(1, 2 * OWN_TIMES + 2))
    assert decided[-1].action is ActionSpec.NO_HELP
    driver.flip(at_random(7)(driver.view))
    assert driver.noted(happened.AssistanceDecided)[-1].last is ActionSpec.SUG_COL


@pytest.mark.parametrize(
    ("flips", "changed"),
    [
        (2 * OWN_TIMES - 2, {}),
        (2 * OWN_TIMES, {"hesitation_max": 0}),
        (2 * OWN_TIMES, {"condition": Condition.NO_ASSISTANCE}),
        (2 * OWN_TIMES, {"policy": always(ActionSpec.SUG_ROW, Gate(2 * OWN_TIMES, 0, 0))}),
    ],
    ids=["too few own times", "off", "no help in the condition", "already helped"],
)
def test_nobody_hesitates_here(flips: int, changed: dict[str, Any]) -> None:
    driver = playing(flips, **changed)
    assert Timer.HESITATION not in driver.running
    driver.spend(20 * USUAL)
    assert not driver.noted(happened.HesitationNoticed)


def test_there_are_no_more_such_hints_in_a_game_than_the_study_allows() -> None:
    driver = playing(2 * OWN_TIMES)
    for _ in range(5):
        hesitate(driver)
    assert len(driver.noted(happened.HesitationNoticed)) == RULE["hesitation_max"]


def test_the_wait_is_never_shorter_than_the_least_one() -> None:
    driver = playing(2 * OWN_TIMES, hesitation_least_ms=30_000)
    assert driver.running[Timer.HESITATION] == driver.now + 30_000


def test_a_moving_pointer_puts_the_hint_off_until_it_rests() -> None:
    driver = playing(2 * OWN_TIMES, hesitation_still_ms=1_500)
    driver.spend(THRESHOLD - 1)
    driver.now += 1
    outcome = driver.send(happened.UserActivity(at_ms=driver.now, ago_ms=100))
    assert do.StartTimer(Timer.HESITATION, 1_400) in outcome.effects
    assert not driver.noted(happened.HintGiven)
    driver.spend(1_400)
    (noticed,) = driver.noted(happened.HesitationNoticed)
    assert (noticed.waited_ms, noticed.threshold_ms) == (THRESHOLD + 1_400, THRESHOLD)


def test_a_pointer_that_rests_again_when_the_wait_ends_does_not_put_it_off() -> None:
    driver = playing(2 * OWN_TIMES, hesitation_still_ms=1_500)
    driver.spend(THRESHOLD - 1)
    driver.now += 1
    driver.send(happened.UserActivity(at_ms=driver.now, ago_ms=1_500))
    assert len(driver.noted(happened.HesitationNoticed)) == 1
    assert Timer.HESITATION not in driver.running


def test_a_wait_with_a_pause_in_it_is_no_hesitation_and_no_time_of_their_own() -> None:
    driver = playing(2 * OWN_TIMES)
    driver.pause()
    driver.spend(20 * USUAL)
    driver.end_pause()
    driver.spend(20 * USUAL)
    assert not driver.noted(happened.HesitationNoticed)
    choose = at_random(5)
    driver.flip(choose(driver.view))
    driver.flip(choose(driver.view))
    driver.wait_until_open()
    assert driver.running[Timer.HESITATION] == driver.now + THRESHOLD


def test_such_a_hint_comes_out_again_in_a_replay_and_in_an_explanation_and_is_exported(tmp_path: Path) -> None:
    driver = playing(2 * OWN_TIMES, policy=mixed(5, Gate()), hesitation_max=1)
    while not driver.noted(happened.HesitationNoticed):
        hesitate(driver)
    hesitate(driver)
    assert replay(driver.plan, 3, driver.world) == [step.outcome for step in driver.steps]
    game = SessionState.from_events(driver.events).game
    assert game is not None
    (flip,) = game.hesitations
    driver.end()
    store(tmp_path / "data", [(driver, 3)])
    with open_repository(tmp_path / "data") as sessions:
        explainer = DecisionExplainer(sessions, 1)
        told = {each: explainer.explain(each).to_json() for each in explainer.flips}
    assert told[flip]["hesitation"]["usual_ms"] == game.hesitations[flip].usual_ms
    assert told[flip]["action"] == "sug_col"
    assert told[flip]["said"] == game.hints[flip].given.sentence
    assert [each for each in told if "hesitation" in told[each]] == [flip]
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    triggers = {int(row["flip"]): row["trigger"] for row in rows_of(tmp_path / "out", "hints")}
    assert triggers == {each: "hesitation" if each == flip else "decision" for each in game.hints}


def test_a_table_that_goes_on_learning_is_refused_beside_it() -> None:
    with pytest.raises(ValidationError, match="step must be 0 with hesitation_max"):
        AssistanceConfig(step=0.1, hesitation_max=1)
