"""Examples of histories, the reasons that they come to, and the table of all of them."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from kiosk.assistance.assistant import game_after
from kiosk.assistance.hint_sentences import ReasonedSentences, Wording
from kiosk.assistance.mentaliser import Hint, HintReason, Mentaliser, TargetRule
from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.cli.options import read_catalogue, shipped_languages
from kiosk.game import Board, Position

CARDS = (
    *("owl", "cat", "frog", "duck", "bear", "fish"),
    *("rabbit", "turtle", "hedgehog", "elephant", "ladybird", "butterfly"),
)
BOARD = Board(4, 6, CARDS * 2)
"""Every card's first copy lies in rows 1 and 2, its second copy in the same place in rows 3 and 4."""

EXAMPLES = (
    "",
    "owl cat",
    "owl cat, owl' frog",
    "owl cat, owl frog",
    "owl cat, owl frog, owl' duck",
    "owl cat, owl frog, owl' duck, owl' bear",
    "owl",
    "owl' cat, owl",
    "owl cat, owl",
    "owl cat, owl' frog, owl",
    "owl' cat, owl' frog, owl",
    "owl cat, owl' frog, owl' duck, owl",
)
"""Moves before a hint, by card; a dash marks its second copy. The hint is about the owls, or about new cards."""


@dataclass(frozen=True)
class ReasonExample:
    """What a history comes to: the card that is coming, the reason, and one sentence per language."""

    moves: str
    card: FlipInMove
    reason: HintReason
    target: int
    other: int
    sentences: tuple[str, ...]


def reason_example(moves: str) -> ReasonExample:
    """Play these moves and ask for a hint about a row."""
    game = game_after(BOARD, map(_place, moves.replace(",", "").split()))
    mentaliser = Mentaliser(TargetRule.MOST_FLIPPED, Random(0))
    owls = [position for position in mentaliser.candidates(game) if BOARD.card(position) == CARDS[0]]
    target = mentaliser.pointing_at(owls[-1], game)
    hint = Hint.coming(ActionSpec.SUG_ROW, target, game)
    return ReasonExample(moves, hint.card, target.reason, target.seen, target.mate_seen, _sentences(hint))


def reasons_table() -> str:
    """All examples as a table in Markdown."""
    head = ("card", "reason", "turned up: target, other", "example: moves so far", *shipped_languages())
    rows = [head, ("---",) * len(head), *(_row(reason_example(moves)) for moves in EXAMPLES)]
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def _row(shown: ReasonExample) -> tuple[str, ...]:
    moves = shown.moves or "none"
    return (shown.card.value, shown.reason.value, f"{shown.target}, {shown.other}", moves, *shown.sentences)


def _sentences(hint: Hint) -> tuple[str, ...]:
    wordings = (Wording(read_catalogue(language), Random(0)) for language in shipped_languages())
    return tuple(ReasonedSentences(wording).all_wordings(hint)[0] for wording in wordings)


def _place(card: str) -> Position:
    location = CARDS.index(card.removesuffix("'"))
    return BOARD.position(location + len(CARDS) if card.endswith("'") else location)
