"""ToM and noToM, on the same seeds with the same visitor, differ where the design says and nowhere else.

The visitor, who forgets half the time, does not mind the hints, so that whatever differs comes from the assistant.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from kiosk.assistance.policy import FlipInMove, Gate
from kiosk.assistance.wording import Catalogue
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import AssistanceDecided, BoardDealt, CardFlipped, HintGiven, HintHighlighted
from tests.experiment.driver import Driver, forgetful
from tests.samples import CATALOGUES, mixed, plan

SEEDS = range(12)
Sessions = list[tuple[Driver, Driver]]


def session(condition: Condition, seed: int, catalogue: Catalogue = CATALOGUES["en"]) -> Driver:
    """Return a game played to its end, in this condition, behind the gate."""
    driver = Driver(replace(plan(condition, mixed(seed, Gate())), catalogue=catalogue), seed)
    driver.to_the_game()
    driver.play(forgetful(seed))
    return driver


@pytest.fixture(scope="module")
def both() -> Sessions:
    """Every seed in both conditions: ToM, noToM."""
    return [(session(Condition.TOM, seed), session(Condition.NOTOM, seed)) for seed in SEEDS]


def hints(both: Sessions, card: FlipInMove) -> list[tuple[HintGiven, HintGiven]]:
    """Return the hints before a first or a second card, side by side."""
    pairs = []
    for tom, notom in both:
        pairs += list(zip(tom.noted(HintGiven), notom.noted(HintGiven), strict=True))
    return [(tom, notom) for tom, notom in pairs if tom.card is card]


def test_the_boards_and_the_flips_are_the_same(both: Sessions) -> None:
    for tom, notom in both:
        assert tom.noted(BoardDealt)[0].cards == notom.noted(BoardDealt)[0].cards
        assert [(f.number, f.position) for f in tom.noted(CardFlipped)] == [
            (f.number, f.position) for f in notom.noted(CardFlipped)
        ]


def test_the_states_the_gate_and_the_actions_are_the_same(both: Sessions) -> None:
    for tom, notom in both:
        assert [replace(decided, at_ms=0) for decided in tom.noted(AssistanceDecided)] == [
            replace(decided, at_ms=0) for decided in notom.noted(AssistanceDecided)
        ]


def test_hints_come_before_the_same_flips_and_are_marked(both: Sessions) -> None:
    for tom, notom in both:
        assert tom.noted(HintGiven)
        assert [hint.flip for hint in tom.noted(HintGiven)] == [hint.flip for hint in notom.noted(HintGiven)]
        assert [mark.flip for mark in tom.noted(HintHighlighted)] == [
            mark.flip for mark in notom.noted(HintHighlighted)
        ]


def test_on_a_second_card_both_point_to_the_mate_just_as_precisely(both: Sessions) -> None:
    seconds = hints(both, FlipInMove.SECOND)
    assert len(seconds) > 50
    for tom, notom in seconds:
        assert replace(tom, at_ms=0, sentence="") == replace(notom, at_ms=0, sentence="")


def test_on_a_first_card_they_are_as_precise_and_point_elsewhere(both: Sessions) -> None:
    firsts = hints(both, FlipInMove.FIRST)
    assert len(firsts) > 50
    for tom, notom in firsts:
        assert tom.action is notom.action
        assert (tom.row is None, tom.column is None) == (notom.row is None, notom.column is None)
    elsewhere = [tom.target != notom.target for tom, notom in firsts]
    assert sum(elsewhere) > 0.8 * len(firsts)


def test_only_tom_points_to_mates_of_what_was_flipped_most(both: Sessions) -> None:
    firsts = hints(both, FlipInMove.FIRST)
    assert all(tom.mate_seen >= tom.seen for tom, _ in firsts)
    assert all(tom.mate_seen > 0 for tom, _ in firsts)
    assert any(notom.mate_seen == 0 for _, notom in firsts)


@pytest.mark.parametrize("language", ["en", "it", "es"])
def test_the_sentences_differ_by_the_reason_only(language: str) -> None:
    """Before a second card ToM says noToM's very sentence, with a reason before it."""
    catalogue = CATALOGUES[language]
    for seed in SEEDS[:4]:
        tom, notom = (session(condition, seed, catalogue) for condition in (Condition.TOM, Condition.NOTOM))
        for explained, plain in hints([(tom, notom)], FlipInMove.SECOND):
            reason = explained.sentence.removesuffix(plain.sentence)
            assert reason != explained.sentence
            known = catalogue.wordings(f"reason-second-{explained.reason.value}", **catalogue.card(explained.name))
            assert reason.strip() in known


def test_before_a_first_card_the_words_for_the_place_are_the_same_too(both: Sessions) -> None:
    for tom, notom in hints(both, FlipInMove.FIRST):
        there = notom.sentence
        for given, taken in ((tom.row, notom.row), (tom.column, notom.column)):
            assert (given is None) == (taken is None)
        assert wordless(tom.sentence).endswith(wordless(there))


def wordless(sentence: str) -> str:
    """Return a sentence without its figures."""
    return "".join("#" if letter.isdigit() else letter for letter in sentence)


def test_no_sentence_is_said_twice_running(both: Sessions) -> None:
    for sessions in both:
        for driver in sessions:
            said = [hint.sentence for hint in driver.noted(HintGiven)]
            assert all(one != following for one, following in pairwise(said))


def test_the_other_two_cells_separate_the_choice_from_the_explanation() -> None:
    for seed in SEEDS[:4]:
        tom, notom, unexplained, explained = (
            session(condition, seed).noted(HintGiven)
            for condition in (
                *(Condition.TOM, Condition.NOTOM),
                *(Condition.MENTALISED_UNEXPLAINED, Condition.RANDOM_EXPLAINED),
            )
        )
        assert [hint.target for hint in unexplained] == [hint.target for hint in tom]
        assert [hint.target for hint in explained] == [hint.target for hint in notom]
        assert [hint.sentence for hint in unexplained] != [hint.sentence for hint in tom]
        assert all(a.sentence.endswith(b.sentence) for a, b in zip(explained, notom, strict=True))
        assert all(a.sentence.endswith(b.sentence) for a, b in zip(tom, unexplained, strict=True))
