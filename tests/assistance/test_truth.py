"""Whatever the assistant says is true of what this player has seen, and gives away what the action allows and no more.

Everything here is worked out a second time, from the bare list of flips and the text of the sentence.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import product
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.assistance.assistant import Assistant
from kiosk.assistance.claims import false_claims, false_places
from kiosk.assistance.hint_sentences import PlainSentences, ReasonedSentences, ReminderSentences, Wording, reasoning
from kiosk.assistance.mentaliser import Hint, Mentaliser, TargetRule
from kiosk.assistance.policy import NO_GATE, ActionSpec, FlipInMove, Gate
from kiosk.game import Board, Concentration, IllegalFlip, Position
from tests.samples import ANIMALS, CATALOGUES, always

HELP = (ActionSpec.SUG_COL, ActionSpec.SUG_ROW, ActionSpec.SUG_CARD)
LANGUAGES = ("en", "it", "es")
GAMES = 900
"""Random games in the long test; in every one some hints are asked for."""


@dataclass(frozen=True)
class Asked:
    """A hint, and the player's own flips before it."""

    board: Board
    flips: tuple[Position, ...]
    hint: Hint

    @cached_property
    def target(self) -> int:
        """How often the target was turned up."""
        return self.flips.count(self.hint.target.position)

    @cached_property
    def other(self) -> int:
        """How often its mate was turned up."""
        return self.flips.count(self.board.mate(self.hint.target.position))

    @property
    def second(self) -> bool:
        """Whether the coming flip is a second card: an odd number of flips has been made."""
        return len(self.flips) % 2 == 1


def asked(board: Board, taps: Iterable[int], rule: TargetRule, action: ActionSpec, rng: Random) -> Iterator[Asked]:
    """Tap these places, as far as that is allowed, and ask for a hint now and then."""
    game, flips, mentaliser = Concentration(board), list[Position](), Mentaliser(rule, rng)
    for tap in taps:
        if game.over:
            return
        if rng.random() < 1 / 12:
            target = mentaliser.target(game)
            hint = Hint.coming(action, target, game)
            yield Asked(board, tuple(flips), hint)
        try:
            flips.append(game.flip(board.position(tap)).position)
        except IllegalFlip:
            continue
        game.turn_back()


def restless(rng: Random, taps: int = 60) -> Iterator[int]:
    """Taps of a visitor who likes a few places better than the rest, so that some cards are seen often."""
    favourites = rng.sample(range(24), 6)
    return (rng.choice(favourites) if rng.random() < 0.5 else rng.randrange(24) for _ in range(taps))


# The table of the design, once more

CELLS: dict[tuple[bool, str], Callable[[int, int], bool]] = {
    (False, "nothing-known"): lambda o, t: (o, t) == (0, 0),
    (False, "one-seen-once"): lambda o, t: {o, t} == {0, 1},
    (False, "both-seen-once"): lambda o, t: (o, t) == (1, 1),
    (False, "often-and-never"): lambda o, t: max(o, t) >= 2 and min(o, t) == 0,
    (False, "often-and-once"): lambda o, t: max(o, t) >= 2 and min(o, t) == 1,
    (False, "both-often"): lambda o, t: o >= 2 and t >= 2,
    (True, "first-sight"): lambda o, t: (o, t) == (1, 0),
    (True, "both-seen-once"): lambda o, t: (o, t) == (1, 1),
    (True, "often-and-never"): lambda o, t: o >= 2 and t == 0,
    (True, "often-and-once"): lambda o, t: o >= 2 and t == 1,
    (True, "open-once-mate-often"): lambda o, t: o == 1 and t >= 2,
    (True, "both-often"): lambda o, t: o >= 2 and t >= 2,
}


def cell(asked: Asked) -> tuple[bool, str]:
    """Return the one cell of the table that these counts belong to."""
    found = [key for key, holds in CELLS.items() if key[0] == asked.second and holds(asked.other, asked.target)]
    assert len(found) == 1
    return found[0]


def check_reason(reason: str, language: str, asked: Asked) -> None:
    """Check that the list of flips bears out the reason, and that it names no place."""
    card = FlipInMove.SECOND if asked.second else FlipInMove.FIRST
    assert not [*false_claims(reason, language, card, asked.other, asked.target)], reason
    assert not re.search(r"\d", reason)


def check_place(sentence: str, language: str, asked: Asked) -> None:
    """Check that the sentence's figures are the target's row and column, if the action gives them away."""
    target, action = asked.hint.target.position, asked.hint.action
    expected: dict[str, str | int] = {}
    if action in (ActionSpec.SUG_ROW, ActionSpec.SUG_CARD):
        expected["row"] = target.row + 1
    if action in (ActionSpec.SUG_COL, ActionSpec.SUG_CARD):
        expected["column"] = target.column + 1
    assert not [*false_places(sentence, language, expected)], sentence


@cache
def words(language: str) -> dict[str, str]:
    """Every word by which a sentence may name a picture, and the picture."""
    cards = ((name, CATALOGUES[language].card(name)) for name in ANIMALS)
    forms = ("card", "card-plurale", "card-plural")
    return {word: name for name, card in cards for form, word in card.items() if form in forms}


def check_names(sentence: str, language: str, asked: Asked) -> None:
    """Only the target's picture is named, and only if the player has seen it on one of the two cards."""
    named = {words(language)[word] for word in re.findall(r"\w+", sentence) if word in words(language)}
    assert named <= {asked.hint.name}, sentence
    assert not named or asked.other + asked.target > 0, sentence


def check(asked: Asked, language: str) -> None:
    """Everything about one hint, whichever way it is said."""
    assert (asked.hint.card is FlipInMove.SECOND) is asked.second
    assert (asked.hint.target.mate_seen, asked.hint.target.seen) == (asked.other, asked.target)
    assert asked.hint.target.reason.value == cell(asked)[1]
    assert asked.hint.name == asked.board.card(asked.hint.target.position)
    catalogue, wording = CATALOGUES[language], Wording(CATALOGUES[language], Random(0))
    reasons = catalogue.wordings(reasoning(asked.hint), **catalogue.card(asked.hint.name))
    places = PlainSentences(wording).all_wordings(asked.hint)
    for reason in (*reasons, *ReminderSentences(wording).all_wordings(asked.hint)):
        check_reason(reason, language, asked)
        check_names(reason, language, asked)
    for where in places:
        check_place(where, language, asked)
        check_names(where, language, asked)
    assert ReasonedSentences(wording).sentence(asked.hint) in {f"{why} {where}" for why in reasons for where in places}


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("rule", TargetRule)
@given(st.integers(0, 2**32), st.lists(st.integers(0, 23), max_size=40), st.sampled_from(HELP))
def test_every_hint_of_any_game_is_true(
    rule: TargetRule, language: str, seed: int, taps: list[int], action: ActionSpec
) -> None:
    board = Board.deal(4, 6, ANIMALS, Random(seed))
    for one in asked(board, [*taps, 0], rule, action, Random(seed)):
        check(one, language)


def test_hundreds_of_random_games_get_true_hints_only() -> None:
    hints = Counter[tuple[bool, str]]()
    combinations = list(product(TargetRule, HELP, LANGUAGES))
    for seed in range(GAMES):
        rule, action, language = combinations[seed % len(combinations)]
        rng = Random(seed)
        for one in asked(Board.deal(4, 6, ANIMALS, rng), restless(rng), rule, action, rng):
            check(one, language)
            hints[cell(one)] += 1
    assert set(hints) == set(CELLS)
    assert min(hints.values()) >= 9, hints
    assert hints.total() >= 3 * GAMES


# Ordinary play: what is reached, and where


def reached(rule: TargetRule, gate: Gate, games: int = 150) -> Counter[tuple[bool, str]]:
    """How often every cell of the table comes up while players without much of a memory play to the end."""
    counts = Counter[tuple[bool, str]]()
    for seed in range(games):
        rng = Random(seed)
        game = Concentration(Board.deal(4, 6, ANIMALS, rng))
        assistant = Assistant(always(ActionSpec.SUG_ROW, gate), Mentaliser(rule, rng))
        while not game.over:
            hint = assistant.decide(game).hint
            if hint is not None:
                counts[hint.card is FlipInMove.SECOND, hint.target.reason.value] += 1
            remembers = game.first_card is not None and rng.random() < 0.3
            game.flip(game.board.mate(game.first_card) if remembers and game.first_card else rng.choice(game.closed))
            game.turn_back()
    return counts


@pytest.mark.parametrize("rule", [TargetRule.MOST_FLIPPED, TargetRule.RANDOM])
def test_every_cell_of_the_table_is_reached_in_play(rule: TargetRule) -> None:
    assert set(reached(rule, NO_GATE)) == set(CELLS)


def test_behind_the_gate_the_most_flipped_card_has_always_been_seen() -> None:
    """Before a first card may be helped, two moves have failed; their four cards are closed and known."""
    unreached = set(CELLS) - set(reached(TargetRule.MOST_FLIPPED, Gate()))
    assert unreached == {(False, "nothing-known")}


def test_behind_the_gate_a_random_card_can_be_any() -> None:
    assert set(reached(TargetRule.RANDOM, Gate())) == set(CELLS)
