"""A model of what this player remembers: how likely each card is recalled, and which card is turned up next.

The player is taken for a memory player (``kiosk.training.simulated_players``) of unknown forgetting d. Before a move,
each card seen is recalled with chance (1 - d)^age, age in flips. One of the recalled pairs is taken, else a card that
is not recalled. As a second card, a mate that is recalled is taken. The model keeps a weight for each d of a grid and
for each habit of reading, and multiplies it, after every flip, by how likely that flip was.

The sums over all sets of recalled cards are exact. They need E[1/M] for a number M of cards, which is the integral of
E[t^(M-1)] over t from 0 to 1. Pairs are recalled independently, so E[t^M] is a product over pairs, and a polynomial
in t, for which Gauss-Legendre quadrature is exact.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING

from kiosk.assistance.policy import ActionSpec
from kiosk.game import CARDS_IN_A_PAIR, Concentration
from kiosk.lazy_dataclass import dataclass

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

FORGETTING = tuple(round(0.02 * 1.28**step, 4) for step in range(16))
"""The grid of d, from 0.02 to 0.81."""
MEAN_LOGIT, SPREAD_LOGIT = -1.4, 1.0
"""What is expected before the first flip: a normal logit of d, wider than that of a simulated population."""
READING = (True, False)
"""Of several recalled pairs, a player takes the first in reading order, or any; both are as likely before a game."""
LAPSE = 0.02
"""The share of flips that are taken to be of any closed card, so that no single flip rules a d out."""


@dataclass(frozen=True, slots=True)
class MemoryEstimate:
    """What the model held before a flip, rounded as it is recorded.

    ``recall`` is the chance in percent that the card on each place is recalled, row by row; ``match_recalled`` the
    chance that a pair is recalled, or the mate of the open card; ``completes`` the chance that the coming flip
    completes a pair without help, None before a first card; ``last_flip`` what the chance of the flip before was.
    """

    forgetting: float
    match_recalled: float
    completes: float | None
    last_flip: float | None
    recall: tuple[int, ...]


DECIMALS = 4


@dataclass(frozen=True, slots=True)
class MemoryTiming:
    """Help by what the player remembers: where a match is recalled with a lower chance than a threshold.

    ``first`` is the threshold for a recalled pair before a first card, ``second`` that for the mate of the open card.
    Below ``card``, a mate that was seen is pointed to itself; 0 never does so. All hold from ``flips`` on, so that help
    goes to long games.
    """

    first: float
    second: float
    card: float = 0.0
    flips: int = 0

    def threshold(self, memory: MemoryEstimate) -> float:
        """Return the threshold for the coming card, which is a second one if a flip can complete a pair."""
        return self.first if memory.completes is None else self.second

    def action(self, memory: MemoryEstimate, flips: int) -> ActionSpec:
        """Return the help after so many flips: a column below the threshold, or the card itself, else none."""
        if flips < self.flips:
            return ActionSpec.NO_HELP
        if self._names(memory):
            return ActionSpec.SUG_CARD
        return ActionSpec.SUG_COL if memory.match_recalled < self.threshold(memory) else ActionSpec.NO_HELP

    def _names(self, memory: MemoryEstimate) -> bool:
        """Whether the mate of the open card was seen, and is as good as forgotten."""
        return memory.completes is not None and 0 < memory.match_recalled < self.card

    def told(self, memory: MemoryEstimate, flips: int) -> str:
        """Say what the decision after so many flips follows from."""
        if flips < self.flips:
            return f"{flips} flips were made; the model gives no help before {self.flips}"
        what = "a pair is" if memory.completes is None else "the mate of the open card is"
        if self._names(memory):
            chance = f"{memory.match_recalled:.4f}, below {self.card:g}"
            return f"the mate of the open card was seen, and is recalled with the chance {chance}"
        threshold = self.threshold(memory)
        side = "below" if memory.match_recalled < threshold else "not below"
        return f"{what} recalled with the chance {memory.match_recalled:.4f}, {side} {threshold:g}"


class MemoryModel:
    """What a player remembers in one game; places count from 0, row by row."""

    def __init__(self, mates: Sequence[int]) -> None:
        """Begin a game; ``mates`` holds, for every place, the place of the other card of its pair."""
        import numpy as np  # noqa: PLC0415 - most studies have no model, and start without numpy

        self._np = np
        self._mates = tuple(mates)
        self._pairs = np.array([(one, other) for one, other in enumerate(self._mates) if one < other])
        self._pair_of = {int(place): number for number, pair in enumerate(self._pairs) for place in pair}
        self._keeps = 1 - np.array(FORGETTING * len(READING))
        self._in_order = np.repeat(READING, len(FORGETTING))[:, None]
        self._weights = np.array([_prior(forgetting) for forgetting in FORGETTING] * len(READING))
        self._weights /= self._weights.sum()
        self._last = np.zeros(len(self._mates))
        self._found = np.zeros(len(self._pairs), dtype=bool)
        self._flips = 0
        self._first: int | None = None
        self._first_was_hinted = False
        self._nodes, self._shares = _quadrature(len(self._pairs))
        self._expected: Array | None = None
        self._mate_recalled: Array | None = None
        self._last_flip: float | None = None

    @classmethod
    def of(cls, game: Concentration) -> MemoryModel:
        """Return the model of a player who has not yet flipped a card of this game's board."""
        board = game.board
        return cls([board.location(board.mate(place)) for place in board])

    def follow(self, game: Concentration, *, hinted: bool) -> None:
        """Record the flip of ``game`` that was made since; ``hinted`` says whether it had help."""
        if game.flips > self._flips:
            place = next(place for place in game.board if game.history.last(place) == game.flips)
            self.flip(game.board.location(place), hinted=hinted)

    def estimate(self) -> MemoryEstimate:
        """Return what is held before the coming flip."""
        completes = None if self._first is None else round(self.next_card()[self._mates[self._first]], DECIMALS)
        return MemoryEstimate(
            forgetting=round(self.forgetting, DECIMALS),
            match_recalled=round(self.chance_to_match(), DECIMALS),
            completes=completes,
            last_flip=None if self._last_flip is None else round(self._last_flip, DECIMALS),
            recall=tuple(round(100 * chance) for chance in self.recall()),
        )

    @property
    def forgetting(self) -> float:
        """The mean of d, over what is thought of the player now."""
        return float(self._weights @ (1 - self._keeps))

    def recall(self) -> tuple[float, ...]:
        """Return, for every place, the chance that its card is recalled now; 0 for cards that are found or unseen."""
        chances = self._weights @ self._recalled()
        chances[self._pairs[self._found].ravel()] = 0
        return tuple(min(1.0, float(chance)) for chance in chances)

    def next_card(self) -> tuple[float, ...]:
        """Return, for every place, the chance that it is turned up next without help; they add up to 1."""
        return tuple(float(chance) for chance in self._weights @ self._expect())

    def chance_to_match(self) -> float:
        """Return the chance that a pair is recalled; with one card open, that its mate is."""
        if self._first is None:
            both = self._recalled()[:, self._pairs].prod(axis=2)[:, ~self._found]
            return min(1.0, float(self._weights @ (1 - (1 - both).prod(axis=1))))
        self._expect()
        assert self._mate_recalled is not None  # noqa: S101 - set where a second card is expected
        return min(1.0, float(self._weights @ self._mate_recalled))

    def flip(self, place: int, *, hinted: bool = False) -> None:
        """Record a flip; one made after a hint says little about memory, and leaves the weights alone."""
        likely = self._weights * self._expect()[:, place]
        self._last_flip = float(likely.sum())
        if not hinted:
            self._weights = likely / self._last_flip
        self._flips += 1
        if self._first is None:
            self._first, self._first_was_hinted = place, hinted
        else:
            self._found[self._pair_of[place]] |= self._mates[place] == self._first
            self._last[[self._first, place]] = (self._flips - 1, self._flips)
            self._first = None
        self._expected = None

    def _recalled(self) -> Array:
        """Return the chance of every card, for each player of the grid, to have been recalled before this move."""
        before = self._flips - (self._first is not None)
        chances: Array = self._np.where(self._last > 0, self._keeps[:, None] ** (before - self._last), 0.0)
        return chances

    def _expect(self) -> Array:
        """Return, for each player of the grid, the chance of every place to be turned up next."""
        if self._expected is None:
            chances = self._first_cards() if self._first is None else self._second_cards(self._first)
            closed = self._np.ones(len(self._mates))
            closed[self._pairs[self._found].ravel()] = 0
            if self._first is not None:
                closed[self._first] = 0
            self._expected = (1 - LAPSE) * chances + LAPSE * closed / closed.sum()
        return self._expected

    def _first_cards(self) -> Array:
        """Return the chances of first cards: of a recalled pair, or alone where no pair is recalled."""
        np, t = self._np, self._nodes
        alone, both = self._by_pair()
        others = _others(self._not_recalled(alone))
        chances: Array = np.zeros((len(self._keeps), len(self._mates)))
        for side in range(CARDS_IN_A_PAIR):
            new = others * (alone[..., 0, None] * t + alone[..., 1 + side, None])
            chances[:, self._pairs[~self._found][:, side]] = self._from_pairs(both, side) + new @ self._shares
        return chances

    def _from_pairs(self, both: Array, side: int) -> Array:
        """Return the chance that the card on this side of each pair is taken first because its pair is recalled."""
        np = self._np
        taken = 1 - both[..., None] + both[..., None] * self._nodes
        any_pair = both * (_others(taken) @ self._shares) / CARDS_IN_A_PAIR
        none_before = np.concatenate([np.ones((len(both), 1)), (1 - both).cumprod(axis=1)[:, :-1]], axis=1)
        in_order = both * none_before * (1 - side)
        chances: Array = np.where(self._in_order, in_order, any_pair)
        return chances

    def _second_cards(self, first: int) -> Array:
        """Return the chances of second cards: the mate where it is recalled, else a card that is not recalled.

        The player's own first card says what is recalled: a pair, or no pair, and then one of M cards was taken, and
        the second is one of the M - 1 others. A hinted first card says nothing.
        """
        np, t = self._np, self._nodes
        alone, both = self._by_pair()
        left = np.flatnonzero(~self._found)
        at = int(np.flatnonzero(left == self._pair_of[first])[0])
        counted = self._not_recalled(alone)
        if self._first_was_hinted:
            counted = counted + both[..., None]
        others = _others(counted)[:, at]
        if self._first_was_hinted:
            self._mate_recalled = self._recalled()[:, self._mates[first]]
            weighed, whole = others, np.ones(len(self._keeps))
        else:
            self._mate_recalled = self._mate_after_own_first(first, others, alone[:, at], both, at)
            weighed, whole = others * (1 - t), (others * t) @ self._shares
        guessed = (1 - self._mate_recalled) / whole
        chances: Array = np.zeros((len(self._keeps), len(self._mates)))
        chances[:, self._mates[first]] = self._mate_recalled + guessed * (weighed @ self._shares)
        elsewhere = np.arange(len(left)) != at
        without = weighed[:, None] / counted[:, elsewhere]
        for side in range(CARDS_IN_A_PAIR):
            new = without * (alone[:, elsewhere, 0, None] * t**2 + alone[:, elsewhere, 1 + side, None] * t)
            chances[:, self._pairs[left[elsewhere], side]] = guessed[:, None] * (new @ self._shares)
        return chances

    def _mate_after_own_first(self, first: int, others: Array, alone: Array, both: Array, at: int) -> Array:
        """Return the chance that the mate is recalled, given that the player chose this first card."""
        side = int(self._pairs[self._pair_of[first]][1] == first)
        recalled = self._recalled()[:, self._mates[first]]
        by_lapse = LAPSE / (CARDS_IN_A_PAIR * both.shape[1])
        mate_only = alone[:, 1 + side] * (others @ self._shares)
        known = (1 - LAPSE) * (self._from_pairs(both, side)[:, at] + mate_only) + by_lapse * recalled
        neither = (1 - LAPSE) * alone[:, 0] * ((others * self._nodes) @ self._shares) + by_lapse * (1 - recalled)
        chance: Array = known / (known + neither)
        return chance

    def _by_pair(self) -> tuple[Array, Array]:
        """Return, for each pair left, the chances to recall neither card, only the second or the first; and both."""
        recalled = self._recalled()[:, self._pairs[~self._found]]
        one, other = recalled[..., 0], recalled[..., 1]
        alone = self._np.stack([(1 - one) * (1 - other), (1 - one) * other, one * (1 - other)], axis=2)
        return alone, one * other

    def _not_recalled(self, alone: Array) -> Array:
        """Return the mean of t to the number of forgotten cards, for each pair left and node t."""
        t = self._nodes
        mean: Array = alone[..., 0, None] * t**2 + (alone[..., 1, None] + alone[..., 2, None]) * t
        return mean


def _prior(forgetting: float) -> float:
    logit = math.log(forgetting / (1 - forgetting))
    return math.exp(-0.5 * ((logit - MEAN_LOGIT) / SPREAD_LOGIT) ** 2)


def _others(factors: Array) -> Array:
    """Return, for every pair (the second axis), the product over all others."""
    product: Array = factors.prod(axis=1, keepdims=True) / factors
    return product


@cache
def _quadrature(pairs: int) -> tuple[Array, Array]:
    """Return Gauss's nodes and shares on [0, 1], exact for a polynomial in the number of all cards."""
    import numpy as np  # noqa: PLC0415 - as above

    nodes, shares = np.polynomial.legendre.leggauss(pairs + 1)
    return (nodes + 1) / 2, shares / 2
