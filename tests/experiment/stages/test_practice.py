"""The practice: a game in which nothing counts, with no help or a sample of it, and which may be left at any time."""

from __future__ import annotations

from dataclasses import replace

import pytest

from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.config import ConditionConfig, Practice, Timing
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import Event, PracticeEnd, Timer
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.projections import Measures
from tests.experiment.driver import Driver, driven_to, with_memory
from tests.experiment.table import a_pair, another, miss
from tests.samples import ANIMALS, FRUIT, always, whole

TOLD = (happened.BoardDealt, happened.AssistanceDecided, happened.HintGiven, happened.CardFlipped)
HELPFUL = always(ActionSpec.SUG_CARD)


def practising(longest: int = 300_000) -> Driver:
    """Return a practice that has just begun, in a study whose assistant helps before every flip."""
    return driven_to(Stage.PRACTICE, whole(policy=HELPFUL, practice=Practice(max_duration_ms=longest)))


def within(driver: Driver, stage: Stage) -> list[Event]:
    """Return what happened in a stage, from its beginning on."""
    events = driver.events
    begun = next(i for i, e in enumerate(events) if isinstance(e, happened.StageEntered) and e.stage is stage)
    later = (i for i, e in enumerate(events) if isinstance(e, happened.StageEntered) and i > begun)
    return events[begun : next(later, None)]


def test_it_has_a_board_and_a_deck_of_its_own() -> None:
    driver = practising()
    assert do.ShowBoard(rows=3, columns=4, pairs=6, deck="fruit", practice=True) in driver.steps[-1].outcome.effects
    assert driver.view.screen == "practice"
    dealt = driver.noted(happened.BoardDealt)[-1]
    assert set(dealt.cards) == set(FRUIT)
    driver.to(Stage.GAME)
    assert driver.view.screen == "board"
    assert set(driver.noted(happened.BoardDealt)[-1].cards) <= set(ANIMALS)
    assert not set(FRUIT) & set(ANIMALS)


def test_the_board_is_open_while_it_is_explained() -> None:
    driver = practising()
    assert driver.view.bubble
    assert driver.view.held is None
    driver.tap(driver.view.closed[0])
    assert len(driver.view.up) == 1


def test_its_first_sentence_ends_with_what_to_do_which_the_bubble_shows_apart() -> None:
    (said,) = (each for each in practising().steps[-1].outcome.effects if isinstance(each, do.Speak))
    assert said.advice == "Turn over any card."
    assert said.sentence.endswith(f" {said.advice}")


def test_nothing_is_decided_and_no_hint_is_given() -> None:
    driver = practising()
    driver.play(with_memory(1))
    practised = within(driver, Stage.PRACTICE)
    kinds = {type(event) for event in practised}
    assert happened.CardFlipped in kinds
    assert not kinds & {
        happened.AssistanceDecided,
        happened.HintGiven,
        happened.HintHighlighted,
        happened.BoardUnlocked,
    }
    assert driver.noted(happened.AssistanceDecided)[0].flip == 1


SAMPLED = Practice(hints=True)
LOCATED = ("sug_col", "sug_row", "sug_card")


def hinted(driver: Driver) -> list[happened.HintGiven]:
    """Return the hints of the practice."""
    return [event for event in within(driver, Stage.PRACTICE) if isinstance(event, happened.HintGiven)]


@pytest.mark.parametrize("condition", [Condition.TOM, Condition.NOTOM])
@pytest.mark.parametrize(("rows", "columns"), [(1, 4), (2, 3), (2, 4), (3, 4)])
def test_it_brings_one_hint_of_each_kind_on_every_board_that_has_enough_flips(
    condition: Condition, rows: int, columns: int
) -> None:
    practice = Practice(rows=rows, columns=columns, hints=True)
    driver = driven_to(Stage.PRACTICE, whole(condition, practice=practice))
    driver.play(with_memory(1))
    given = hinted(driver)
    assert [hint.action.name for hint in given] == list(LOCATED)
    assert {hint.card for hint in given} >= {FlipInMove.SECOND}
    marked = [event for event in within(driver, Stage.PRACTICE) if isinstance(event, happened.HintHighlighted)]
    assert [event.flip for event in marked] == [hint.flip for hint in given]
    assert {hint.name for hint in given} <= set(FRUIT)


def test_its_hints_come_for_first_and_for_second_cards() -> None:
    driver = driven_to(Stage.PRACTICE, whole(practice=SAMPLED))
    driver.play(with_memory(0))
    assert [(hint.flip, hint.card) for hint in hinted(driver)] == [
        (2, FlipInMove.SECOND),
        (5, FlipInMove.FIRST),
        (8, FlipInMove.SECOND),
    ]


def test_where_no_place_is_named_it_brings_one_reminder() -> None:
    reminding = {"reminded": ConditionConfig(location=False)}
    driver = driven_to(Stage.PRACTICE, whole(Condition("reminded"), practice=SAMPLED, conditions=reminding))
    driver.play(with_memory(1))
    (only,) = hinted(driver)
    assert (only.row, only.column) == (None, None)
    assert not any(isinstance(event, happened.HintHighlighted) for event in within(driver, Stage.PRACTICE))


def test_where_there_is_no_help_the_practice_has_none_either() -> None:
    driver = driven_to(Stage.PRACTICE, whole(Condition.NO_ASSISTANCE, practice=SAMPLED))
    driver.play(with_memory(1))
    assert hinted(driver) == []


def test_the_game_is_the_same_with_and_without_hints_in_the_practice() -> None:
    games = []
    for practice in (Practice(), SAMPLED):
        driver = driven_to(Stage.PRACTICE, whole(practice=practice))
        driver.play(with_memory(0))
        driver.play(with_memory(1))
        told = (happened.BoardDealt, happened.CardFlipped, happened.HintGiven)
        games.append([event for event in within(driver, Stage.GAME) if isinstance(event, told)])
    plain, sampled = ([_without_number(event) for event in game] for game in games)
    assert plain == sampled


def _without_number(event: Event) -> object:
    """Return an event without its time and the number of its sentence."""
    changed = {"at_ms": 0} | ({"utterance": 0} if isinstance(event, happened.HintGiven) else {})
    return replace(event, **changed)


def test_hints_of_the_practice_are_no_decisions_and_count_in_no_measure() -> None:
    driver = driven_to(Stage.PRACTICE, whole(policy=always(ActionSpec.NO_HELP), practice=SAMPLED))
    driver.play(with_memory(1))
    assert len(hinted(driver)) == 3
    assert not any(isinstance(event, happened.AssistanceDecided) for event in within(driver, Stage.PRACTICE))
    driver.play(with_memory(1))
    assert driver.session.measures.hints == 0


def test_a_hint_of_the_practice_is_said_again_in_another_language() -> None:
    driver = driven_to(Stage.PRACTICE, whole(practice=SAMPLED))
    driver.tap(driver.view.closed[0])
    english = driver.view.bubble
    driver.send(happened.LanguageSelected(at_ms=driver.now, language="it"))
    assert driver.view.bubble not in ("", english)


def test_a_practice_that_begins_anew_brings_its_hints_again() -> None:
    sampled = whole(practice=SAMPLED)
    past = driven_to(Stage.PRACTICE, sampled)
    past.tap(past.view.closed[0])
    assert past.view.held is do.BoardWait.SPEAKING
    driver = Driver.resumed(sampled, 5, past.world)
    assert driver.view.held is None
    driver.tap(driver.view.closed[0])
    assert driver.noted(happened.HintGiven)[-1].flip == 2


def test_two_different_cards_turn_back_as_in_the_game() -> None:
    driver = practising()
    miss(driver)
    assert driver.view.held is do.BoardWait.TURNING_BACK
    driver.tap(another(driver))
    assert len(driver.noted(happened.CardSelectionRejected)) == 1
    driver.wait_until_open()
    assert driver.view.up == {}
    assert driver.stage is Stage.PRACTICE


def test_it_ends_when_every_pair_was_found_and_looked_at() -> None:
    driver = practising()
    while len(driver.view.found) < 12:
        for place in a_pair(driver):
            driver.flip(place)
    found_at = driver.now
    assert driver.stage is Stage.PRACTICE
    driver.wait_until_open()
    assert (driver.stage, driver.now) == (Stage.GAME, found_at + driver.plan.settings.timing.finish_ms)
    assert driver.noted(happened.PracticeFinished) == [
        happened.PracticeFinished(at_ms=driver.now, how=PracticeEnd.FOUND)
    ]
    assert driver.noted(happened.GameFinished) == []


def test_it_can_be_left_at_once() -> None:
    driver = practising()
    driver.skip()
    assert driver.stage is Stage.GAME
    assert driver.noted(happened.PracticeFinished)[0].how is PracticeEnd.LEFT
    assert not driver.view.up


def test_it_can_be_left_while_two_cards_turn_back_and_nothing_of_that_comes_into_the_game() -> None:
    driver = practising()
    miss(driver)
    driver.skip()
    assert Timer.TURN_BACK not in driver.running
    assert Timer.PRACTICE not in driver.running
    assert driver.view.up == {}


def test_it_ends_by_itself_after_its_time() -> None:
    driver = practising(longest=30_000)
    began = driver.now
    driver.spend(29_999)
    assert driver.stage is Stage.PRACTICE
    driver.spend(1)
    assert (driver.stage, driver.now) == (Stage.GAME, began + 30_000)
    assert driver.noted(happened.PracticeFinished)[0].how is PracticeEnd.TIME


def test_a_tap_does_not_make_it_longer() -> None:
    driver = practising(longest=30_000)
    until = driver.running[Timer.PRACTICE]
    driver.spend(20_000)
    driver.tap(driver.view.closed[0])
    assert driver.running[Timer.PRACTICE] == until


def test_it_ends_once_even_if_its_time_is_over_while_the_last_pair_is_looked_at() -> None:
    driver = driven_to(
        Stage.PRACTICE, whole(timing=Timing(finish_ms=60_000), practice=Practice(max_duration_ms=30_000))
    )
    while len(driver.view.found) < 12:
        for place in a_pair(driver):
            driver.flip(place)
    driver.spend(30_000)
    assert [event.how for event in driver.noted(happened.PracticeFinished)] == [PracticeEnd.TIME]
    assert driver.stage is Stage.GAME


@pytest.mark.parametrize("much", [0, 1, 5])
def test_its_flips_never_count(much: int) -> None:
    driver = driven_to(Stage.PRACTICE)
    for _ in range(much):
        miss(driver)
    assert driver.session.measures == Measures()
    driver.to(Stage.GAME)
    assert driver.session.measures.flips == 0
    driver.play(with_memory(1))
    played = [event for event in within(driver, Stage.GAME) if isinstance(event, happened.CardFlipped)]
    assert driver.session.measures.flips == len(played)
    assert [flip.number for flip in played] == list(range(1, len(played) + 1))
    result = driver.view.result
    assert result is not None
    assert (result.pairs, result.moves) == (3, len(played) // 2)


@pytest.mark.parametrize("much", [0, 3])
def test_how_long_somebody_practised_changes_nothing_of_the_game(much: int) -> None:
    """The board, the targets and the wordings come from streams of chance of their own."""
    games = []
    for flips in (0, much):
        driver = driven_to(Stage.PRACTICE)
        for _ in range(flips):
            miss(driver)
        driver.to(Stage.GAME)
        driver.play(with_memory(2))
        told = (event for event in within(driver, Stage.GAME) if isinstance(event, TOLD))
        games.append([replace(event, at_ms=0) for event in told])
    assert games[0] == games[1]


def test_its_end_is_recorded_before_the_game_begins() -> None:
    driver = practising()
    kinds = [type(event).__name__ for event in driver.skip().events]
    assert kinds[:3] == ["PracticeFinished", "StageEntered", "BoardDealt"]
