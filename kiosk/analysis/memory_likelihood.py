"""The likelihood of whole games under the memory player: exact, by quadrature over what the player may recall.

At the start of a move the player recalls each closed card it has seen with chance (1 - d)^age. The age of a card is the
number of flips since it was last turned up: the card of the last flip has age 0 and is recalled for certain. A first
card is any card of a recalled pair, where there is one, else any card that is not recalled; a second card is the mate,
if recalled, else any card that is not. A player who follows a hint chooses by the same rule within the hinted line; one
who lapses takes any closed card. Recall is drawn anew for every move, so the moves of a game are independent given its
history.

The sum over all sets of recalled cards needs E[1 / n] for numbers n of cards left to choose from. It is taken with
1 / n = integral of z^(n - 1) over 0..1: under the integral the pairs are independent, and the integrand is a
polynomial, for which Gauss-Legendre quadrature is exact.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kiosk.assistance.policy import ACTIONS, ActionSpec

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

LAPSE, FREE, FOLLOW = range(3)
"""How a card came to be chosen: by a lapse, from memory, or along the hint."""
WAYS = 3
NO_FLIP = -1
CHUNK = 400
"""Moves that are worked on at a time, so that memory stays small."""


@dataclass(frozen=True, slots=True)
class PlayedGame:
    """A game flip by flip.

    It has the mate of every place, and of each flip its place, its action and the hinted place.

    Places are numbered row by row from 0. Flips without a hint have the action ``no_help``; their target is unused.
    """

    mates: tuple[int, ...]
    columns: int
    flips: tuple[tuple[int, int, int], ...]


@dataclass(slots=True)
class _Moves:
    """Moves with the same number of pairs left; cards are in the order of their pairs, two by two."""

    game: list[int]
    ages: list[list[int]]
    chosen: list[tuple[int, int]]
    lines: list[tuple[list[bool], list[bool]]]
    hinted: list[tuple[bool, bool]]


@dataclass(frozen=True, slots=True)
class MoveLikelihood:
    """The likelihood of every move, by the way in which its two cards were chosen and by forgetting.

    ``terms`` has the shape moves x ways x ways x grid; ``hinted`` moves x 2; ``game`` numbers the game of each move,
    and ``complete`` says whether the move has a second card.
    """

    terms: Array
    hinted: Mask
    complete: Mask
    game: NDArray[np.int64]

    def games(self, following: float, lapse: float) -> Array:
        """Return the log-likelihood of each game for each forgetting of the grid, shape games x grid."""
        ways = np.empty((len(self.game), 2, WAYS))
        for card in range(2):
            follows = np.where(self.hinted[:, card], following, 0.0)
            ways[:, card, LAPSE] = lapse
            ways[:, card, FREE] = (1 - lapse) * (1 - follows)
            ways[:, card, FOLLOW] = (1 - lapse) * follows
        ways[~self.complete, 1] = (1.0, 0.0, 0.0)
        weights = ways[:, 0, :, None] * ways[:, 1, None, :]
        each = np.matmul(weights.reshape(len(ways), 1, -1), self.terms.reshape(len(ways), WAYS * WAYS, -1))[:, 0]
        logs = np.log(np.maximum(each, np.finfo(float).tiny))
        starts = np.flatnonzero(np.diff(self.game, prepend=-1))
        by_game: Array = np.add.reduceat(logs, starts, axis=0)
        return by_game


def move_likelihood(games: Sequence[PlayedGame], forgetting: Array) -> MoveLikelihood:
    """Work out the likelihood of every move of some games at each value of ``forgetting``."""
    groups: dict[int, _Moves] = defaultdict(lambda: _Moves([], [], [], [], []))
    for number, game in enumerate(games):
        _collect(groups, number, game)
    parts = [_group(left, moves, forgetting) for left, moves in sorted(groups.items())]
    order = np.argsort(np.concatenate([part.game for part in parts]), kind="stable")
    return MoveLikelihood(
        np.concatenate([part.terms for part in parts])[order],
        np.concatenate([part.hinted for part in parts])[order],
        np.concatenate([part.complete for part in parts])[order],
        np.concatenate([part.game for part in parts])[order],
    )


def _collect(groups: dict[int, _Moves], number: int, game: PlayedGame) -> None:
    """Sort the moves of a game by the number of pairs that were left."""
    last: dict[int, int] = {}
    found: set[int] = set()
    for at in range(0, len(game.flips), 2):
        move = game.flips[at : at + 2]
        closed = [card for one in range(len(game.mates)) if one < game.mates[one] for card in (one, game.mates[one])]
        closed = [card for card in closed if card not in found]
        chosen = [closed.index(flip[0]) for flip in move]
        hinted = [flip[1] != int(ActionSpec.NO_HELP) for flip in move]
        lines = [
            [hint and _in_line(card, flip, game.columns) for card in closed]
            for flip, hint in zip(move, hinted, strict=True)
        ]
        if len(move) == 1:
            chosen, lines, hinted = [*chosen, NO_FLIP], [*lines, [False] * len(closed)], [*hinted, False]
        moves = groups[len(closed) // 2]
        moves.game.append(number)
        moves.ages.append([at - last[card] if card in last else -1 for card in closed])
        moves.chosen.append((chosen[0], chosen[1]))
        moves.lines.append((lines[0], lines[1]))
        moves.hinted.append((hinted[0], hinted[1]))
        last |= {flip[0]: at + turn for turn, flip in enumerate(move, 1)}
        if chosen[1] != NO_FLIP and game.mates[move[0][0]] == move[1][0]:
            found |= {move[0][0], move[1][0]}


def _in_line(card: int, flip: tuple[int, int, int], columns: int) -> bool:
    _, action, target = flip
    match ACTIONS[action]:
        case ActionSpec.SUG_COL:
            return card % columns == target % columns
        case ActionSpec.SUG_ROW:
            return card // columns == target // columns
        case ActionSpec.SUG_CARD:
            return card == target
    return False


def _group(left: int, moves: _Moves, forgetting: Array) -> MoveLikelihood:
    """Return the terms of all moves with ``left`` pairs left."""
    chosen = np.array(moves.chosen)
    hinted = np.array(moves.hinted)
    lines = np.array(moves.lines)
    ages = np.array(moves.ages)
    terms = np.zeros((len(chosen), WAYS, WAYS, len(forgetting)))
    for start in range(0, len(chosen), CHUNK):
        part = slice(start, start + CHUNK)
        _fill(terms[part], _Group(left, ages[part], chosen[part], forgetting), lines[part], hinted[part])
    return MoveLikelihood(terms, hinted, chosen[:, 1] != NO_FLIP, np.array(moves.game))


def _fill(terms: Array, group: _Group, lines: Mask, hinted: Mask) -> None:
    """Put in the expectation for each pair of ways.

    Where a move has no second card, its first way stands for all.
    """
    cards = 2 * group.left
    every = np.arange(len(terms))
    whole, second = group.complete, group.complete
    free = np.ones((len(terms), cards), dtype=np.bool_)
    rest = free.copy()
    rest[every, group.first] = False
    one_lines, two_lines = lines[:, 0], lines[:, 1] & rest
    hint1, hint2 = hinted[:, 0], hinted[:, 1]
    terms[:, LAPSE, LAPSE] = np.where(whole, 1 / (cards * max(cards - 1, 1)), 1 / cards)[:, None]
    for way, sets, rows in ((FREE, free, np.ones_like(hint1)), (FOLLOW, one_lines, hint1)):
        terms[rows, way, LAPSE] = group.pick(rows).first_only(sets[rows])
        terms[whole & rows, way, LAPSE] /= max(cards - 1, 1)
    for way, sets, rows in ((FREE, rest, second), (FOLLOW, two_lines, second & hint2)):
        terms[rows, LAPSE, way] = group.pick(rows).second_only(sets[rows]) / cards
    terms[second, FREE, FREE] = group.pick(second).both(free[second], rest[second], linked=True)
    for ways, one, two, rows in (
        ((FREE, FOLLOW), free, two_lines, second & hint2),
        ((FOLLOW, FREE), one_lines, rest, second & hint1),
        ((FOLLOW, FOLLOW), one_lines, two_lines, second & hint1 & hint2),
    ):
        terms[rows, *ways] = group.pick(rows).both(one[rows], two[rows])


class _Group:
    """Moves with the same number of pairs left, and the expectations over what their players recalled."""

    def __init__(self, left: int, ages: NDArray[np.int64], chosen: NDArray[np.int64], forgetting: Array) -> None:
        self.left, self.ages, self.chosen, self.forgetting = left, ages, chosen, forgetting
        self.first = chosen[:, 0]
        self.second = chosen[:, 1]
        self.complete = self.second != NO_FLIP
        self.mate = self.first ^ 1
        kept = np.power(1 - forgetting, np.maximum(ages, 0)[:, :, None])
        recalled: Array = np.where(ages[:, :, None] >= 0, kept, 0.0)
        every = np.arange(len(ages))
        self.recalls_first: Array = recalled[every, self.first]
        self.recalls_mate: Array = recalled[every, self.mate]
        # The pair of the first card is worked out case by case, so it has no part in the product over the others.
        self.others = recalled
        self.others[every, self.first] = self.others[every, self.mate] = 0.0
        self.is_other = np.ones(ages.shape, dtype=np.bool_)
        self.is_other[every, self.first] = self.is_other[every, self.mate] = False
        self.matched: Mask = (self.second == self.mate)[:, None]

    def pick(self, rows: Mask) -> _Group:
        """Return some of the moves."""
        return self if rows.all() else _Group(self.left, self.ages[rows], self.chosen[rows], self.forgetting)

    def _member(self, sets: Mask, card: NDArray[np.int64]) -> Array:
        member: Array = sets[np.arange(len(card)), card].astype(float)[:, None]
        return member

    def first_only(self, sets: Mask) -> Array:
        """Return the chance of the first card, where it is chosen from the set."""
        one, mate = self._member(sets, self.first), self._member(sets, self.mate)
        nodes, weights = _nodes(self.left)
        lost, kept = 1 - self.recalls_first, self.recalls_mate
        without = self._product(sets, None, nodes, None, masked=False)
        either = (1 - kept) * _sum(without, weights * nodes**mate) + kept * _sum(without, weights)
        return one * (lost * either + self._first_recalled(sets, None, second=None) + self._pair_recalled(sets))

    def second_only(self, sets: Mask) -> Array:
        """Return the chance of the second card, where it is chosen from the set, whatever the first was chosen by."""
        nodes, weights = _nodes(self.left)
        there, mate = self._member(sets, self.second), self._member(sets, self.mate)
        product = self._product(None, sets, None, nodes, masked=True)
        guessed = there * _sum(product, weights * nodes ** (mate - 1))
        return self.recalls_mate * self.matched + (1 - self.recalls_mate) * guessed

    def both(self, one: Mask, two: Mask, *, linked: bool = False) -> Array:
        """Return the chance of both cards, chosen from the two sets.

        ``linked`` if the second is all that the first leaves.
        """
        lost, kept = 1 - self.recalls_first, self.recalls_mate
        in_one, mate_in_one = self._member(one, self.first), self._member(one, self.mate)
        in_two, mate_in_two = self._member(two, self.second), self._member(two, self.mate)
        z1, w1 = _nodes(self.left)
        known = self._product(one, None, z1, None, masked=False)
        value = lost * kept * self.matched * _sum(known, w1)
        if linked:
            # 1 / (n + 2) of the first and 1 / (n + 1) of the second, with n of the other pairs' cards not recalled.
            product = self._product(one, None, z1, None, masked=True)
            guessed = _sum(product, w1 * (1 - z1) * np.ones_like(mate_in_one))
        else:
            n2, v2 = _nodes(_half(two))
            z1, w1 = _nodes(_half(one))
            grid1, grid2 = np.repeat(z1, len(n2)), np.tile(n2, len(z1))
            product = self._product(one, two, grid1, grid2, masked=True)
            weights = np.repeat(w1, len(n2)) * np.tile(v2, len(z1))
            guessed = _sum(product, weights * grid1**mate_in_one * grid2 ** (mate_in_two - 1))
        value = value + lost * (1 - kept) * in_two * guessed
        value = value + self._first_recalled(one, two, second=in_two) + self.matched * self._pair_recalled(one)
        return in_one * value

    def _first_recalled(self, one: Mask, two: Mask | None, *, second: Array | None) -> Array:
        """Return the chance that the first card is recalled without its mate and chosen all the same.

        It is so as the whole line is recalled.
        """
        size = one.sum(axis=1)[:, None]
        possible = 1 - self._member(one, self.mate)
        if not possible.any():
            return np.zeros_like(self.recalls_first)
        share: Array = possible * self.recalls_first * (1 - self.recalls_mate) / np.maximum(size, 1)
        if two is None or second is None:
            return share * self._product(one, None, np.zeros(1), None, masked=False)[:, 0]
        nodes, weights = _nodes(_half(two))
        product = self._product(one, two, np.zeros_like(nodes), nodes, masked=True)
        mate = self._member(two, self.mate)
        return share * second * _sum(product, weights * nodes ** (mate - 1))

    def _pair_recalled(self, one: Mask) -> Array:
        """Return the chance that the pair is recalled, and chosen among all recalled pairs in the set."""
        nodes, weights = _nodes(self.left)
        both = self.others[:, 0::2] * self.others[:, 1::2]
        here = (one & self.is_other).astype(int)
        number = here[:, 0::2] + here[:, 1::2]
        product = np.ones((len(both), len(nodes), both.shape[2]))
        for pair in range(self.left):
            chance = both[:, pair, None, :]
            product *= 1 - chance + chance * (nodes[None, :] ** number[:, pair, None])[:, :, None]
        mate = self._member(one, self.mate)
        return self.recalls_first * self.recalls_mate * _sum(product, weights * nodes**mate)

    def _product(
        self, one: Mask | None, two: Mask | None, z1: Array | None, z2: Array | None, *, masked: bool
    ) -> Array:
        """Return the product over the other pairs at each node, shape moves x nodes x grid.

        A card of set ``one`` that is not recalled counts z1, one of ``two`` z2; no pair with a card in ``one`` is
        recalled whole; ``masked``: nor is the second card recalled.
        """
        moves = len(self.ages)
        nodes = len(z1) if z1 is not None else len(z2) if z2 is not None else 0
        product = np.ones((moves, nodes, self.others.shape[2]))
        powers = np.ones((moves, 2 * self.left, nodes))
        for sets, z in ((one, z1), (two, z2)):
            if sets is not None and z is not None:
                powers *= np.where((sets & self.is_other)[:, :, None], z[None, None, :], 1.0)
        recalled = self.others.copy()
        unseen = 1 - recalled
        if masked:
            rows = np.flatnonzero(self.complete & ~self.matched[:, 0])
            recalled[rows, self.second[rows]] = 0.0
        for a in range(0, 2 * self.left, 2):
            lost = [unseen[:, card, None, :] * powers[:, card, :, None] for card in (a, a + 1)]
            kept = [recalled[:, card, None, :] for card in (a, a + 1)]
            factor = (lost[0] + kept[0]) * (lost[1] + kept[1])
            if one is not None:
                touched = (one[:, a] | one[:, a + 1])[:, None, None]
                factor -= np.where(touched, kept[0] * kept[1], 0.0)
            product *= factor
        return product


def _half(sets: Mask) -> int:
    """Half the largest number of cards in a set, rounded up: what the quadrature must be exact for."""
    return int(sets.sum(axis=1).max(initial=1) + 1) // 2


@cache
def _nodes(half: int) -> tuple[Array, Array]:
    """Nodes and weights on 0..1 that integrate every polynomial of degree 2 ``half`` - 1 exactly."""
    nodes, weights = np.polynomial.legendre.leggauss(half)
    return (nodes + 1) / 2, weights / 2


def _sum(product: Array, weights: Any) -> Array:
    """Return the quadrature: a weighted sum over the nodes, shape moves x grid."""
    weights = np.broadcast_to(weights, product.shape[:2])
    total: Array = np.einsum("mqg,mq->mg", product, weights)
    return total
