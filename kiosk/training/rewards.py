"""The rewards, by name: what the robot is paid for after each flip.

docs/explanation/learning.md gives the reasons and the limits.
A reward sees one flip and nothing else of the game; only the released one keeps a purse between flips.
"""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple

from kiosk.game import CARDS_IN_A_PAIR
from kiosk.training.vectorised_game import (
    FIRST,
    FLIPS,
    LAST_MATCH,
    LEAD,
    NO_HELP,
    NOWHERE,
    PAIRS_FOUND,
    PHASES,
    SUG_CARD,
    Floats,
    Ints,
    compiled_rule,
    phase,
)


class Reward(Enum):
    """What the robot is paid for."""

    RETRIEVAL = "retrieval"
    """What the player retrieves: a match, less a share for one hint, nothing when the second card was given away."""
    PAPER = "paper"
    """The paper's formulas, literally."""
    RELEASED = "released"
    """What the authors' released program was observed to pay."""


RETRIEVAL, PAPER, RELEASED = range(3)
REWARDS = (Reward.RETRIEVAL, Reward.PAPER, Reward.RELEASED)

WEIGHTS = (10.0, 0.2, 0.1, 0.025)
"""The paper's a, by action: no help, column, row, card; less help, a higher reward on a first card."""
RISES = (0.4, 0.2, 0.1, 0.3)
"""What a first-card decision adds to the released program's purse, by action."""
PURSE = 0.4
"""What lies in the released program's purse at the start."""
PAID_FROM, FIRST_PAID_FROM = 5, 10
"""The flip since the last match from which the purse is paid; the second while no pair has been found."""
COST = 5
"""The default reward's price of one hint is a share (COST - g) / (2 nf) of the match."""


class RewardFlip(NamedTuple):
    """One flip as a reward sees it; ``nf`` is the number of flips since the last match, this one included.

    ``second`` is 1 for a second card, ``before`` the help with the flip before it, ``g`` 3, 2, 1 by phase, ``early``
    1 while no pair had been found.
    """

    second: int
    before: int
    action: int
    nf: int
    g: int
    early: int


@compiled_rule
def reward_flip(game: Ints, lead: int) -> RewardFlip:
    """Return the next flip of ``game``, with a help that gives so much away."""
    second = 0 if game[FIRST] == NOWHERE else 1
    early = 1 if game[PAIRS_FOUND] == 0 else 0
    return RewardFlip(second, game[LEAD], lead, game[FLIPS] + 1 - game[LAST_MATCH], PHASES - phase(game), early)


@compiled_rule
def reward_of(reward: int, flip: RewardFlip, matched: int, purse: Floats) -> float:
    """Return what this flip is worth."""
    if reward == PAPER:
        return weighed(flip)
    if reward == RETRIEVAL:
        return retrieved(flip) if matched == 1 else 0.0
    return released(flip, matched, purse)


@compiled_rule
def hints(flip: RewardFlip) -> int:
    """How many of the two cards of a move were hinted, before its second card is flipped."""
    return (0 if flip.before == NO_HELP else 1) + (0 if flip.action == NO_HELP else 1)


@compiled_rule
def retrieved(flip: RewardFlip) -> float:
    """Return the player's own share of a match.

    It is all of it without a hint, a share of it with one, none with two.
    """
    if hints(flip) == 0:
        return 1.0
    if hints(flip) == CARDS_IN_A_PAIR or flip.action == SUG_CARD:
        return 0.0
    return 1.0 - (COST - flip.g) / (2.0 * flip.nf)


@compiled_rule
def weighed(flip: RewardFlip) -> float:
    """Return the paper's formulas for a first card and for a second with and without help.

    They are a / nf on a first card, a / (nf g) without help on a second, a nf g with help.
    """
    if flip.second == 0:
        return WEIGHTS[flip.action] / flip.nf
    if flip.action == NO_HELP:
        return WEIGHTS[flip.action] / (flip.nf * flip.g)
    return WEIGHTS[flip.action] * (flip.nf * flip.g)


@compiled_rule
def released(flip: RewardFlip, matched: int, purse: Floats) -> float:
    """Return a purse that grows on first cards and is paid out in full.

    For a match with one hint at most it is the paper's formula.

    A match, or a miss after a first-card hint, sets the purse back.
    """
    if flip.second == 0:
        if flip.nf < (FIRST_PAID_FROM if flip.early == 1 else PAID_FROM):
            return 0.0
        purse[0] += RISES[flip.action]
        return purse[0]
    if matched == 1 or flip.before != NO_HELP:
        purse[0] = PURSE
    return 0.0 if matched == 0 or hints(flip) == CARDS_IN_A_PAIR else weighed(flip)
