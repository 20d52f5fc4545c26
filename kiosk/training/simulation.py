"""Whole games under a frozen table, thousands of them, and the study's measures over them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from kiosk import UserInputError
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ActionSpec, QTable
from kiosk.errors import one_of, whole
from kiosk.training.native import native_loop
from kiosk.training.simulated_players import KEPT, SimulatedPlayer, choose, prepare
from kiosk.training.vectorised_game import (
    ACTION_COUNT,
    CARDS,
    COLUMNS,
    ENDLESS,
    FIRST,
    FLIPS,
    HELP,
    LAST,
    LEAD,
    LEAD_OF,
    MATE,
    NO_HELP,
    NOWHERE,
    PAIRS,
    PAIRS_FOUND,
    POINTED,
    SUG_CARD,
    SUG_COL,
    TARGET,
    Floats,
    Ints,
    aim,
    compiled_rule,
    deal,
    flip,
    floats,
    gate_plan,
    ints,
    is_open,
    new_game,
    state,
)

# One game's tally, in whole numbers.
T_FLIPS, T_FIRST, T_SECOND, T_COL, T_ROW, T_CARD, T_FOLLOWED_FIRST, T_FOLLOWED_SECOND, T_LED = range(9)
TALLY = 9
BATCH = 500
"""Games, or episodes, between two looks at the progress bar and the keyboard."""
Z95 = 1.959964
"""Half the width of a normal 95 % interval, in standard errors."""

Progress = Callable[[int], None]
"""Told, now and then, how many games or episodes have been played so far."""


class GameTable(NamedTuple):
    """A game, all that plays it, and its tally, as the rules read them."""

    game: Ints
    plan: Ints
    player: Ints
    odds: Floats
    tally: Ints


def lay(player: SimulatedPlayer, policy_plan: Ints, seed: int) -> GameTable:
    """Return a table with a player at it; the games that follow are fixed by ``seed``."""
    seed = whole("the seed", seed)
    if seed < 0:
        raise UserInputError(f"the seed must be 0 or more, not {seed}")
    numbers, odds = player.numbers()
    return GameTable(
        new_game(seed, len(policy_plan) - LEAD_OF), policy_plan, ints(numbers), floats(odds), ints([0] * TALLY)
    )


@compiled_rule
def greedy(q: Floats, row: int, actions: int) -> int:
    """Return the action with the highest value; ties go to the lowest, as ``QTable.action``."""
    best = 0
    for action in range(1, actions):
        if q[row * actions + action] > q[row * actions + best]:
            best = action
    return best


@compiled_rule
def follows(action: int, target: int, place: int) -> bool:
    """Whether flipping ``place`` follows the hint; as ``Hint.followed_by``."""
    if action == SUG_COL:
        return place % COLUMNS == target % COLUMNS
    if action == SUG_CARD:
        return place == target
    return place // COLUMNS == target // COLUMNS


@compiled_rule
def start(table: GameTable) -> None:
    """Deal, and begin a new tally."""
    deal(table.game)
    prepare(table.game, table.odds)
    for entry in range(TALLY):
        table.tally[entry] = 0


@compiled_rule
def take(table: GameTable, action: int) -> int:
    """Give the help, let the player flip, and count; 1 if the flip completes a match."""
    game, tally = table.game, table.tally
    second = game[FIRST] != NOWHERE
    lead = table.plan[LEAD_OF + action]
    target = aim(game, table.plan[TARGET]) if lead != NO_HELP else NOWHERE
    place = choose(game, table.player, table.odds, lead, target)
    game[HELP], game[LEAD], game[POINTED] = action, lead, target
    tally[T_FLIPS] += 1
    if lead != NO_HELP:
        tally[T_SECOND if second else T_FIRST] += 1
        tally[T_COL + lead - SUG_COL] += 1
        if follows(lead, target, place):
            tally[T_FOLLOWED_SECOND if second else T_FOLLOWED_FIRST] += 1
    return 1 if flip(game, place) else 0


@compiled_rule
def playing(game: Ints) -> bool:
    """Whether the game goes on."""
    return game[PAIRS_FOUND] < PAIRS and game[FLIPS] < ENDLESS


@compiled_rule
def play(table: GameTable, q: Floats) -> None:
    """One game under the frozen table."""
    start(table)
    followed, led = 0, False
    while playing(table.game):
        action = greedy(q, state(table.game), table.game[ACTION_COUNT]) if is_open(table.game, table.plan) else NO_HELP
        matched = take(table, action)
        if table.game[FIRST] != NOWHERE:
            led = table.tally[T_FOLLOWED_FIRST] > followed
            followed = table.tally[T_FOLLOWED_FIRST]
        elif led:
            table.tally[T_LED] += matched


@native_loop
@compiled_rule
def play_all(table: GameTable, q: Floats, tallies: Ints) -> None:
    """As many games as there is room for in ``tallies``."""
    for row in range(0, len(tallies), TALLY):
        play(table, q)
        for entry in range(TALLY):
            tallies[row + entry] = table.tally[entry]


@dataclass(frozen=True, slots=True)
class Spread:
    """A mean, the standard deviation (ddof = 1), and a normal 95 % interval: mean +- 1.96 sd / sqrt(n)."""

    mean: float
    sd: float
    ci95: tuple[float, float]

    @classmethod
    def of(cls, values: list[float]) -> Spread:
        """Return the spread of at least two numbers."""
        mean = math.fsum(values) / len(values)
        sd = math.sqrt(math.fsum((value - mean) ** 2 for value in values) / (len(values) - 1))
        half = Z95 * sd / math.sqrt(len(values))
        return cls(mean, sd, (mean - half, mean + half))


@dataclass(frozen=True, slots=True)
class GameResults:
    """What came of many games: one tally a game, in the order in which they were played."""

    tallies: tuple[tuple[int, ...], ...]

    def each(self, entry: int) -> list[float]:
        """One number of every game."""
        return [float(tally[entry]) for tally in self.tallies]

    def total(self, *entries: int) -> int:
        """Return the sum of some numbers over all games."""
        return sum(tally[entry] for tally in self.tallies for entry in entries)

    @property
    def flips(self) -> Spread:
        """Flips a game."""
        return Spread.of(self.each(T_FLIPS))

    @property
    def moves(self) -> Spread:
        """Moves a game, of two flips each."""
        return Spread.of([flips / 2 for flips in self.each(T_FLIPS)])

    @property
    def assistance(self) -> Spread:
        """Assistance per flip: the levels of all hints (column .5, row 1, card 2) over the flips of a game."""
        return Spread.of([_levels(tally) / tally[T_FLIPS] for tally in self.tallies])

    @property
    def first_card_hints(self) -> Spread:
        """First-card hints a game."""
        return Spread.of(self.each(T_FIRST))

    def _shares(self, part: tuple[int, ...], whole: tuple[int, ...]) -> list[float]:
        """Return a share in each game in which there is something to share."""
        counted = ((sum(tally[n] for n in part), sum(tally[n] for n in whole)) for tally in self.tallies)
        return [some / all_ for some, all_ in counted if all_]

    def measures(self) -> dict[str, Any]:
        """All measures as ``recollect simulate --json`` names them.

        Shares of hints are means over the games that had such hints, as a study takes them over people; ``pooled``
        takes them over the hints of all games. They differ, as games with many hints are those of weak players. None
        without hints; ``games_with`` counts the games that a mean is over.
        """
        moves = self.total(T_FLIPS) / 2
        shares = {name: self._shares(part, whole) for name, (part, whole) in _SHARES.items()}
        return {
            "games": len(self.tallies),
            "moves": _plain(self.moves),
            "flips": _plain(self.flips),
            "assistance_per_flip": self.assistance.mean,
            "first_card_hints_per_game": self.first_card_hints.mean,
            "hint_rate": {"first": self.total(T_FIRST) / moves, "second": self.total(T_SECOND) / moves},
            **{name: math.fsum(each) / len(each) if each else None for name, each in shares.items()},
            "pooled": {name: _share(self.total(*part), self.total(*whole)) for name, (part, whole) in _SHARES.items()},
            "games_with": {name: len(each) for name, each in shares.items()},
            "spreads": {
                "assistance_per_flip": _plain(self.assistance),
                "first_card_hints_per_game": _plain(self.first_card_hints),
            },
        }


_SHARES = {
    "followed": ((T_FOLLOWED_FIRST, T_FOLLOWED_SECOND), (T_FIRST, T_SECOND)),
    "followed_first_card": ((T_FOLLOWED_FIRST,), (T_FIRST,)),
    "led_to_match": ((T_LED,), (T_FIRST,)),
}
"""Shares of hints by name: what is counted, and out of what."""


def _levels(tally: tuple[int, ...]) -> float:
    helps = ActionSpec.SUG_COL, ActionSpec.SUG_ROW, ActionSpec.SUG_CARD
    return sum(tally[T_COL + number] * action.level for number, action in enumerate(helps))


def _plain(spread: Spread) -> dict[str, Any]:
    return {"mean": spread.mean, "sd": spread.sd, "ci95": list(spread.ci95)}


def _share(part: int, whole: int) -> float | None:
    return part / whole if whole else None


LEAST_GAMES = 2
"""A spread needs two."""


def checked_games(games: int) -> int:
    """Return a number of games; raises UserInputError for fewer than LEAST_GAMES."""
    games = whole("the number of games", games)
    if games < LEAST_GAMES:
        raise UserInputError(f"there must be at least {LEAST_GAMES} games, not {games}")
    return games


def simulate_games(  # noqa: PLR0913, PLR0917 - an experiment is all of these
    policy: QTable,
    player: SimulatedPlayer,
    target: TargetRule,
    games: int,
    seed: int,
    progress: Progress = lambda _: None,
) -> GameResults:
    """Play ``games`` games (2 or more) of ``player`` helped by ``policy``; fixed by ``seed``.

    Raises UserInputError if there are too few games, or a game does not end.
    """
    games = checked_games(games)
    table = lay(player, gate_plan(policy.gate, one_of("target", target, TargetRule), policy.actions), seed)
    q = floats([value for row in policy.values for value in row])
    tallies: list[tuple[int, ...]] = []
    while len(tallies) < games:
        tallies.extend(_batch(table, q, min(BATCH, games - len(tallies))))
        progress(len(tallies))
    return GameResults(tuple(tallies))


RECORD = 3
"""Numbers that are recorded of a flip: the place, the action, and the place that the hint pointed at."""


@native_loop
@compiled_rule
def record(table: GameTable, q: Floats, log: Ints) -> int:
    """Play one game under the frozen table, write every flip into ``log``, and return the number of flips."""
    start(table)
    game = table.game
    while playing(game):
        action = greedy(q, state(game), game[ACTION_COUNT]) if is_open(game, table.plan) else NO_HELP
        take(table, action)
        at = (game[FLIPS] - 1) * RECORD
        for place in range(CARDS):
            if game[LAST + place] == game[FLIPS]:
                log[at] = place
        log[at + 1], log[at + 2] = action, game[POINTED]
    return game[FLIPS]


class RecordedGame(NamedTuple):
    """A simulated game flip by flip.

    It has the mate of every place, and of each flip the place, the action, and its target.

    ``forgetting`` is the d of the memory player who played it.
    """

    mates: tuple[int, ...]
    flips: tuple[tuple[int, int, int], ...]
    forgetting: float


def record_games(
    policy: QTable, player: SimulatedPlayer, target: TargetRule, games: int, seed: int
) -> Iterator[RecordedGame]:
    """Play games as ``simulate_games`` does, and yield them flip by flip; fixed by ``seed``."""
    table = lay(player, gate_plan(policy.gate, one_of("target", target, TargetRule)), seed)
    q = floats([value for row in policy.values for value in row])
    log = ints([0] * (ENDLESS * RECORD))
    for _ in range(games):
        flips = int(record(table, q, log))
        refuse_endless(flips)
        numbers = [int(number) for number in log[: flips * RECORD]]
        each = tuple((numbers[at], numbers[at + 1], numbers[at + 2]) for at in range(0, len(numbers), RECORD))
        mates = tuple(int(mate) for mate in table.game[MATE : MATE + CARDS])
        yield RecordedGame(mates, each, 1 - float(table.odds[KEPT + 1]))


def _batch(table: GameTable, q: Floats, games: int) -> Iterator[tuple[int, ...]]:
    tallies = ints([0] * (games * TALLY))
    play_all(table, q, tallies)
    numbers: list[int] = tallies.tolist() if hasattr(tallies, "tolist") else tallies
    for row in range(0, len(numbers), TALLY):
        refuse_endless(numbers[row + T_FLIPS])
        yield tuple(numbers[row : row + TALLY])


def refuse_endless(flips: int) -> None:
    """Refuse, with UserInputError, a game that was given up."""
    if flips >= ENDLESS:
        raise UserInputError(f"this player does not finish: a game was given up after {ENDLESS:,} flips")
