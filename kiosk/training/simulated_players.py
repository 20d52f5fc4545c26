"""The simulated players: what each remembers, which card it turns up, and how it follows a hint.

A player is a frozen description; ``numbers`` turns it into the plain numbers that the rules below play with.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from random import Random
from statistics import NormalDist
from typing import Any, ClassVar, Protocol, Self

from kiosk import UserInputError
from kiosk.errors import check_between, one_of
from kiosk.files import parse_json
from kiosk.training.vectorised_game import (
    CARDS,
    COLUMNS,
    FIRST,
    FLIPS,
    FOUND,
    LAST,
    LAST_MATCH,
    LISTED,
    MATE,
    NO_HELP,
    NOWHERE,
    PAIRS,
    PAIRS_FOUND,
    RECALL,
    SUG_CARD,
    SUG_COL,
    Floats,
    Ints,
    below,
    closed,
    compiled_rule,
    pick,
    unit,
)

CHANCE, MEMORY, TEXT = range(3)

# A player's whole numbers: its kind, and for each number of pairs left the flips after which a sure match may come.
KIND, TOTAL, WAKES = 0, 1, 2
NEVER = 1_000_000
# A player's other numbers: chance to follow a hint, range of forgetting, then how much is kept at each age, the chance
# of a lapse, and, if the player is drawn from a population, the forgetting of each of its people.
FOLLOW, LOW, HIGH, KEPT = range(4)
LONGEST = 256
"""Ages, in flips or moves, beyond which nothing more is forgotten; by then nothing is left to forget."""
LAPSE = KEPT + LONGEST
PEOPLE = LAPSE + 1
POPULATION = 500
"""People by whom a population is represented: the middles of as many equal parts of its distribution."""
LARGEST_LOGIT = 20.0
ENDLESS_FROM = 0.05
"""With all flips counted, a player of the paper's text who forgets this much or more may never finish."""


class SimulatedPlayer(Protocol):
    """A simulated player."""

    name: ClassVar[str]

    @property
    def follow(self) -> float:
        """The chance to follow a hint."""
        ...

    def parameters(self) -> dict[str, Any]:
        """Return what a policy file says about this player."""
        ...

    def numbers(self) -> tuple[Ints, Floats]:
        """Return the numbers that the rules play with."""
        ...


@dataclass(frozen=True, slots=True)
class ChancePlayer:
    """Reproduces the paper's figure: names at random, and now and then a sure match.

    ``threshold``: the second card may be a sure match (by the toss of a coin) once the chance to have seen its mate,
    1 - (1 - 1/(2L - 1))^k with L pairs left and k flips since the last match, is above it.
    """

    name: ClassVar[str] = "chance"
    threshold: float = 0.5
    follow: float = 1.0

    def __post_init__(self) -> None:
        """Refuse what is not a chance."""
        check_between("threshold", self.threshold, 0, 1)
        check_between("follow", self.follow, 0, 1)

    def parameters(self) -> dict[str, Any]:
        """Return what a policy file says about this player."""
        return {"name": self.name, "threshold": self.threshold, "follow": self.follow}

    def numbers(self) -> tuple[Ints, Floats]:
        """Return the numbers that the rules play with."""
        wakes = [NEVER] + [self._wakes(left) for left in range(1, PAIRS + 1)]
        return [CHANCE, 0, *wakes], [self.follow, 0.0, 0.0, *[0.0] * (LONGEST + 1)]

    def _wakes(self, left: int) -> int:
        unseen, flips = 1.0, 0
        while 1 - unseen <= self.threshold:
            unseen *= 1 - 1 / (2 * left - 1)
            flips += 1
            if flips == NEVER // 100:
                return NEVER
        return flips


@dataclass(frozen=True, slots=True)
class MemoryPlayer:
    """Remembers each card seen with chance (1 - d)^age, age in flips.

    It takes a recalled pair, else looks at a new card.

    ``forgetting``: d, or the range from which it is drawn anew for every game. ``lapse``: the chance to turn up any
    closed card, whatever is recalled or hinted.
    """

    name: ClassVar[str] = "memory"
    forgetting: tuple[float, float] = (0.2, 0.2)
    follow: float = 1.0
    lapse: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is not a chance, or a range from high to low."""
        given: object = self.forgetting
        if not isinstance(given, tuple) or len(given) != len(("low", "high")):
            raise UserInputError(f"forgetting must be a range of two numbers, such as (0.1, 0.45), not {given!r}")
        check_between("forgetting", self.forgetting[0], 0, 1)
        check_between("forgetting", self.forgetting[1], self.forgetting[0], 1)
        check_between("follow", self.follow, 0, 1)
        check_between("lapse", self.lapse, 0, 1)

    def parameters(self) -> dict[str, Any]:
        """Return what a policy file says about this player."""
        low, high = self.forgetting
        # Without lapses there is no word of them, so that the hashes of tables that know none stay as they are.
        lapses = {"lapse": self.lapse} if self.lapse else {}
        return {"name": self.name, "forgetting": low if low == high else [low, high], "follow": self.follow, **lapses}

    def numbers(self) -> tuple[Ints, Floats]:
        """Return the numbers that the rules play with."""
        kept = [0.0] * LONGEST
        return [MEMORY, 0, *[NEVER] * (PAIRS + 1)], [self.follow, *self.forgetting, *kept, self.lapse]


PEOPLE_FORMAT = "recollect-people-1"


@dataclass(frozen=True, slots=True)
class PopulationPlayer:
    """A memory player drawn anew for every game from a population, such as ``recollect calibrate`` finds.

    The logit of the forgetting d is normal with mean ``forgetting_mean`` and SD ``forgetting_spread``; ``follow`` and
    ``lapse`` are those of a memory player, and the same for all.
    """

    name: ClassVar[str] = "people"
    forgetting_mean: float = -1.4
    forgetting_spread: float = 0.5
    follow: float = 0.9
    lapse: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is not a distribution or a chance."""
        check_between("forgetting_mean", self.forgetting_mean, -LARGEST_LOGIT, LARGEST_LOGIT)
        check_between("forgetting_spread", self.forgetting_spread, 0, LARGEST_LOGIT)
        check_between("follow", self.follow, 0, 1)
        check_between("lapse", self.lapse, 0, 1)

    @classmethod
    def load(cls, path: Path) -> Self:
        """Read the file that ``recollect calibrate --out`` writes; raises UserInputError with one sentence."""
        try:
            document = parse_json(path.read_text("utf-8"))
        except OSError as error:
            raise UserInputError(f"the file of people {path} cannot be read: {error.strerror}") from error
        except ValueError as error:
            raise UserInputError(f"the file of people {path} is not JSON: {error}") from error
        if not isinstance(document, dict) or document.get("format") != PEOPLE_FORMAT:
            raise UserInputError(f"{path} is not a file of people: recollect calibrate --out writes one")
        given = {name: document.get(name) for name in cls.__slots__}
        missing = [name for name, value in given.items() if value is None]
        if missing:
            raise UserInputError(f"the file of people {path} lacks {missing[0]!r}")
        try:
            return cls(**given)  # type: ignore[arg-type]  # what is not a number is refused on the next line
        except UserInputError as error:
            raise UserInputError(f"the file of people {path} cannot be used: {error}") from error

    def draw(self, rng: Random) -> float:
        """Return the forgetting of one person of the population, drawn with ``rng``."""
        return _inverse_logit(rng.gauss(self.forgetting_mean, self.forgetting_spread))

    def parameters(self) -> dict[str, Any]:
        """Return what a policy file says about this player."""
        own = {"forgetting_mean": self.forgetting_mean, "forgetting_spread": self.forgetting_spread}
        return {"name": self.name, **own, "follow": self.follow, "lapse": self.lapse}

    def numbers(self) -> tuple[Ints, Floats]:
        """Return the numbers that the rules play with."""
        normal = NormalDist()
        middles = [normal.inv_cdf((number + 0.5) / POPULATION) for number in range(POPULATION)]
        people = [_inverse_logit(self.forgetting_mean + self.forgetting_spread * middle) for middle in middles]
        odds = [self.follow, 0.0, 0.0, *[0.0] * LONGEST, self.lapse, *people]
        return [MEMORY, 0, *[NEVER] * (PAIRS + 1)], odds


def _inverse_logit(logit: float) -> float:
    return 1 / (1 + math.exp(-logit))


class Counting(Enum):
    """What the paper's text calls NF."""

    SINCE_MATCH = "since_match"
    """Moves since the last match, this one included: the reading under which its games look like its figure."""
    TOTAL = "total"
    """All flips of the game: the literal reading, under which the chance of a match fades away."""


@dataclass(frozen=True, slots=True)
class TextPlayer:
    """The player as the paper's text has it: the chance of a match is a formula.

    With L pairs left and NF as ``counting`` says, a second card matches with chance 1 / L if its mate was never seen,
    else (1 - d)^NF NF / L, at least 1 / L and at most 1. The first card is one seen or one unseen, half and half.
    """

    name: ClassVar[str] = "text"
    forgetting: float = 0.12
    counting: Counting = Counting.SINCE_MATCH
    follow: float = 1.0

    def __post_init__(self) -> None:
        """Refuse what is not a chance, and the reading under which games do not end."""
        check_between("forgetting", self.forgetting, 0, 1)
        check_between("follow", self.follow, 0, 1)
        one_of("counting", self.counting, Counting)
        if self.counting is Counting.TOTAL and self.forgetting >= ENDLESS_FROM:
            raise UserInputError(
                f"the text player with forgetting {self.forgetting:g} and all flips counted never finishes a game: "
                f"use a forgetting below {ENDLESS_FROM:g}, or count the moves since the last match"
            )

    def parameters(self) -> dict[str, Any]:
        """Return what a policy file says about this player."""
        own = {"forgetting": self.forgetting, "counting": self.counting.value}
        return {"name": self.name, **own, "follow": self.follow}

    def numbers(self) -> tuple[Ints, Floats]:
        """Return the numbers that the rules play with."""
        total = int(self.counting is Counting.TOTAL)
        return [TEXT, total, *[NEVER] * (PAIRS + 1)], [self.follow, *[self.forgetting] * 2, *[0.0] * (LONGEST + 1)]


@compiled_rule
def prepare(game: Ints, odds: Floats) -> None:
    """Before a game: draw how forgetful the player is, and lay out what is kept after how many flips."""
    keeps = 1.0 - odds[LOW]
    people = len(odds) - PEOPLE
    if people > 0:
        keeps = 1.0 - odds[PEOPLE + below(game, people)]
    elif odds[HIGH] > odds[LOW]:
        keeps -= (odds[HIGH] - odds[LOW]) * unit(game)
    elif odds[KEPT] > 0.0:
        return
    kept = 1.0
    for age in range(LONGEST):
        odds[KEPT + age] = kept
        kept *= keeps


@compiled_rule
def remember(game: Ints, odds: Floats) -> None:
    """Before a move: for every card seen, once, whether it is recalled."""
    for place in range(CARDS):
        game[RECALL + place] = 0
        if game[FOUND + place] == 0 and game[LAST + place] > 0:
            age = min(game[FLIPS] - game[LAST + place], LONGEST - 1)
            game[RECALL + place] = 1 if unit(game) < odds[KEPT + age] else 0


@compiled_rule
def in_line(action: int, target: int, place: int) -> bool:
    """Whether a place lies where the help points: in the column or row, or anywhere without help."""
    if action == NO_HELP:
        return True
    if action == SUG_COL:
        return place % COLUMNS == target % COLUMNS
    return place // COLUMNS == target // COLUMNS


@compiled_rule
def list_line(game: Ints, action: int, target: int, ruled_out: int) -> int:
    """List the closed cards of the line whose recall is below ``ruled_out``; their number."""
    number = 0
    for place in range(CARDS):
        game[LISTED + number] = place
        hit = closed(game, place) and game[RECALL + place] < ruled_out and in_line(action, target, place)
        number += 1 if hit else 0
    return number


@compiled_rule
def list_not_recalled(game: Ints) -> int:
    """List the closed cards that are new, or as good as new; their number."""
    number = 0
    for place in range(CARDS):
        game[LISTED + number] = place
        number += 1 if closed(game, place) and game[RECALL + place] == 0 else 0
    return number


@compiled_rule
def list_wrong(game: Ints) -> int:
    """List every closed card but the mate of the open one; their number."""
    number = 0
    for place in range(CARDS):
        game[LISTED + number] = place
        number += 1 if closed(game, place) and game[FIRST] != game[MATE + place] else 0
    return number


@compiled_rule
def recalled(game: Ints, lead: int, target: int) -> int:
    """Return the card, where the help points, that the memory player knows to be right.

    It may also be one of a known pair; else it is NOWHERE.
    """
    if game[FIRST] != NOWHERE:
        mate = game[MATE + game[FIRST]]
        return mate if game[RECALL + mate] == 1 and in_line(lead, target, mate) else NOWHERE
    for place in range(CARDS):
        if game[RECALL + place] == 1 and game[RECALL + game[MATE + place]] == 1 and in_line(lead, target, place):
            return place
    return NOWHERE


@compiled_rule
def lucky(game: Ints, player: Ints) -> bool:
    """Whether the chance player has a sure match this time."""
    wakes = player[WAKES + PAIRS - game[PAIRS_FOUND]]
    return game[FLIPS] - game[LAST_MATCH] >= wakes and below(game, 2) == 0


@compiled_rule
def text_match(game: Ints, player: Ints, odds: Floats) -> bool:
    """Whether the second card of a ``TextPlayer`` is a match."""
    left = PAIRS - game[PAIRS_FOUND]
    since = game[FLIPS] if player[TOTAL] == 1 else (game[FLIPS] - game[LAST_MATCH]) // 2 + 1
    chance = odds[KEPT + min(since, LONGEST - 1)] * since / left
    if game[LAST + game[MATE + game[FIRST]]] == 0:
        chance = 1.0 / left
    elif player[TOTAL] == 0:
        chance = max(chance, 1.0 / left)
    return unit(game) < chance


@compiled_rule
def surely(game: Ints, player: Ints, odds: Floats, lead: int, target: int) -> int:
    """Return the card that the player takes for certain; NOWHERE without one.

    The lead is a line, or no help.
    """
    if player[KIND] == MEMORY:
        return recalled(game, lead, target)
    if game[FIRST] == NOWHERE:
        return NOWHERE
    knows = lucky(game, player) if player[KIND] == CHANCE else text_match(game, player, odds)
    return game[MATE + game[FIRST]] if knows else NOWHERE


@compiled_rule
def list_half(game: Ints) -> int:
    """Toss a coin and list the closed cards seen before, or those never seen.

    All are listed if there are none.
    """
    seen = below(game, 2)
    number = 0
    for place in range(CARDS):
        game[LISTED + number] = place
        fits = closed(game, place) and (1 if game[LAST + place] > 0 else 0) == seen
        number += 1 if fits else 0
    return number if number > 0 else list_wrong(game)


@compiled_rule
def guess(game: Ints, player: Ints) -> int:
    """Return the card that a player tries for want of a better one."""
    if player[KIND] == MEMORY:
        return pick(game, list_not_recalled(game))
    if player[KIND] == TEXT and game[FIRST] == NOWHERE:
        return pick(game, list_half(game))
    # The chance player draws a name, so the mate comes up once in as many times as there are pairs left.
    if game[FIRST] != NOWHERE and player[KIND] == CHANCE and below(game, PAIRS - game[PAIRS_FOUND]) == 0:
        return game[MATE + game[FIRST]]
    number = list_wrong(game)
    return pick(game, number) if number > 0 else game[MATE + game[FIRST]]


@compiled_rule
def choose(game: Ints, player: Ints, odds: Floats, action: int, target: int) -> int:
    """Return the card that the player turns up next, after a hint (or none) at ``target``.

    In a line that is pointed at, a player takes the card that is sure, or any that may be right for all it recalls.
    """
    if player[KIND] == MEMORY and game[FIRST] == NOWHERE:
        remember(game, odds)
    if odds[LAPSE] > 0.0 and unit(game) < odds[LAPSE]:
        return pick(game, list_line(game, NO_HELP, NOWHERE, 2))
    follows = action != NO_HELP and (odds[FOLLOW] >= 1.0 or unit(game) < odds[FOLLOW])
    if follows and action == SUG_CARD:
        return target
    lead = action if follows else NO_HELP
    sure = surely(game, player, odds, lead, target)
    if sure != NOWHERE:
        return sure
    if not follows:
        return guess(game, player)
    number = list_line(game, lead, target, 1)
    return pick(game, number if number > 0 else list_line(game, lead, target, 2))
