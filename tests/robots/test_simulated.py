"""The robot of a rehearsed day fails in every way, also in mid-sentence."""

from __future__ import annotations

import pytest

from kiosk.experiment.effects import Mood
from kiosk.robots import simulated
from kiosk.robots.driver import FailureKind, RobotError, Utterance
from kiosk.robots.simulated import FlakyRobot

SENTENCES = 100


def say(robot: FlakyRobot) -> tuple[int, FailureKind | None]:
    """Have it say a sentence: how often it began, and how it failed."""
    begun: list[None] = []
    try:
        robot.say(Utterance("Look at row 2.", lambda: begun.append(None)))
    except RobotError as failure:
        return len(begun), failure.kind
    return len(begun), None


def broken_off(seed: int) -> list[int]:
    """Which of a hundred sentences a robot that fails at nothing else breaks off after it began."""
    robot = FlakyRobot(seed, fails=0)
    said = [say(robot) for _ in range(SENTENCES)]
    assert set(said) <= {(1, None), (1, FailureKind.DROPPED)}
    return [number for number, (_, failure) in enumerate(said) if failure]


def test_it_breaks_off_some_sentences_after_they_began_and_the_same_ones_for_the_same_seed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(simulated, "BREAKS_OFF_AFTER_S", 0)
    of_seed = {seed: broken_off(seed) for seed in (1, 2, 3)}
    assert of_seed == {seed: broken_off(seed) for seed in (1, 2, 3)}
    assert of_seed[1] != of_seed[2]
    for sentences in of_seed.values():
        assert 0 < len(sentences) < SENTENCES / 10


def test_which_sentences_break_off_does_not_depend_on_the_other_calls(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(simulated, "BREAKS_OFF_AFTER_S", 0)
    robot = FlakyRobot(1, fails=0)
    found = []
    for number in range(SENTENCES):
        robot.express(Mood.HAPPY)
        if say(robot)[1]:
            found.append(number)
    assert found == broken_off(1)


def test_a_sentence_that_nobody_waits_for_is_given_up_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(simulated, "BREAKS_OFF_AFTER_S", 3600)
    saying = Utterance("Look at row 2.", lambda: None)
    saying.cancel()
    with pytest.raises(RobotError) as failure:
        FlakyRobot(1, fails=0, breaks_off=1).say(saying)
    assert failure.value.kind is FailureKind.CUT
