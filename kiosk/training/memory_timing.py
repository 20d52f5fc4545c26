"""Games in which the model of the player's memory decides when to help, and the thresholds that do best.

The games are those of kiosk.training.simulation, with the same players, gate and targets; only the question whether to
help is put to kiosk.assistance.memory_model. That takes half a millisecond a flip, so there are fewer games.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from kiosk.assistance.memory_model import MemoryModel, MemoryTiming
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ACTIONS, Gate
from kiosk.errors import check_between, one_of, whole
from kiosk.training.simulated_players import SimulatedPlayer
from kiosk.training.simulation import (
    T_FOLLOWED_FIRST,
    T_LED,
    GameResults,
    GameTable,
    Progress,
    checked_games,
    lay,
    playing,
    refuse_endless,
    start,
    take,
)
from kiosk.training.vectorised_game import CARDS, FIRST, FLIPS, LAST, MATE, NO_HELP, NOWHERE, gate_plan, is_open

THRESHOLDS = (0.0, 0.1, 0.2, 0.4)
"""What is tried for each of the two cards."""
CARD_THRESHOLDS = (0.0, 0.05)
"""What is tried for naming a card that was seen."""
STARTS = (0, 24)
"""After how many flips help is tried to begin."""
LATEST_START = 1000


def checked_timing(first: float, second: float, card: float = 0.0, flips: int = 0) -> MemoryTiming:
    """Return the timing with these thresholds; raises UserInputError for what is no chance or no number of flips."""
    check_between("the threshold of first cards", first, 0, 1)
    check_between("the threshold of second cards", second, 0, 1)
    check_between("the threshold of named cards", card, 0, 1)
    check_between("the flips before there is help", flips, 0, LATEST_START)
    return MemoryTiming(first, second, card, whole("the flips before there is help", flips))


def timing_grid(
    thresholds: Sequence[float] = THRESHOLDS, cards: Sequence[float] = CARD_THRESHOLDS, starts: Sequence[int] = STARTS
) -> tuple[MemoryTiming, ...]:
    """Return every timing with these thresholds for first and second cards, and for naming a card, and these starts."""
    return tuple(checked_timing(*each) for each in product(thresholds, thresholds, cards, starts))


def _play(table: GameTable, timing: MemoryTiming) -> None:
    """Play one game; the model leaves flips with a hint out of account, followed or not."""
    start(table)
    game = table.game
    model = MemoryModel([int(mate) for mate in game[MATE : MATE + CARDS]])
    followed, led = 0, False
    while playing(game):
        action = NO_HELP
        flips = int(game[FLIPS])
        if is_open(game, table.plan) and flips >= timing.flips:
            action = ACTIONS.index(timing.action(model.estimate(), flips))
        matched = take(table, action)
        if game[FIRST] != NOWHERE:
            led = table.tally[T_FOLLOWED_FIRST] > followed
            followed = table.tally[T_FOLLOWED_FIRST]
        elif led:
            table.tally[T_LED] += matched
        model.flip(_last_place(table), hinted=action != NO_HELP)


def _last_place(table: GameTable) -> int:
    game = table.game
    return next(place for place in range(CARDS) if game[LAST + place] == game[FLIPS])


@dataclass(frozen=True, slots=True)
class TunedTiming:
    """A pair of thresholds, and what came of games with it."""

    timing: MemoryTiming
    results: GameResults


@dataclass(frozen=True, slots=True)
class TimingExperiment:
    """Games that are the same but for when the model of memory has the player helped.

    There are 2 ``games`` or more; ``seed`` fixes their boards and all that is random in them.
    """

    gate: Gate
    player: SimulatedPlayer
    target: TargetRule
    games: int
    seed: int

    def play(self, timing: MemoryTiming, progress: Progress = lambda _: None) -> GameResults:
        """Play the games, helped where ``timing`` says so.

        Raises UserInputError if there are too few games, or a game does not end.
        """
        games = checked_games(self.games)
        table = lay(self.player, gate_plan(self.gate, one_of("target", self.target, TargetRule)), self.seed)
        tallies = []
        for number in range(games):
            _play(table, timing)
            refuse_endless(int(table.game[FLIPS]))
            tallies.append(tuple(int(count) for count in table.tally))
            progress(number + 1)
        return GameResults(tuple(tallies))

    def tune(self, timings: Iterable[MemoryTiming], progress: Progress = lambda _: None) -> Iterator[TunedTiming]:
        """Play the games once with each of these timings, and yield what came of them."""
        for number, timing in enumerate(timings):
            yield TunedTiming(timing, self.play(timing, _going_on(progress, number * self.games)))


def _going_on(progress: Progress, before: int) -> Progress:
    """Return what counts on from the games that were played before."""
    return lambda played: progress(before + played)


def best_timing(tried: Sequence[TunedTiming], assistance: float, spread: float = math.inf) -> TunedTiming:
    """Return the fewest flips within an assistance per flip and an SD of the flips.

    It is the least spread if all spread more, and the least assistance if all give more.
    """
    allowed = [each for each in tried if each.results.assistance.mean <= assistance]
    if not allowed:
        return min(tried, key=lambda each: each.results.assistance.mean)
    even = [each for each in allowed if each.results.flips.sd <= spread]
    if not even:
        return min(allowed, key=lambda each: each.results.flips.sd)
    return min(even, key=lambda each: each.results.flips.mean)
