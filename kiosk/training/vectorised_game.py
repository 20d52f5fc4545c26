"""The rules of ``kiosk.game`` and ``kiosk.assistance`` once more, on plain numbers, for many thousand games a second.

One text: a C compiler or numba compiles it where there is one, and Python runs it as it is otherwise, with the same
numbers for a seed. Only whole numbers, +, -, *, / and comparisons stand in it, because those give the same bits.
A test plays these rules and the packages they copy side by side and compares every step.
"""

from __future__ import annotations

import hashlib
import os
import shutil
from array import array
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

from platformdirs import user_cache_path

from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ACTIONS, ActionSpec, Gate, MoveOutcome, Phase, Precision
from kiosk.training.native import AHEAD, FROZEN, is_switched_off, library, may_be_native

Rule = TypeVar("Rule", bound=Callable[..., Any])
Ints = list[int]
"""Whole numbers: a list when run as it is, an array of 64 bits each when compiled."""
Floats = list[float]
"""Numbers: a list when run as it is, an array of 64 bits each when compiled."""

try:
    _numba: Any = import_module("numba")
except ImportError:
    _numba = None
COMPILED: bool = _numba is not None and not _numba.config.DISABLE_JIT
"""Whether numba is here to compile the rules; NUMBA_DISABLE_JIT=1 in the environment runs them as they are."""


def copy_compiled(place: Path, to: Path) -> None:
    """Copy a folder of compiled rules, whole or not at all, also beside another process that does the same."""
    to.parent.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(prefix="half-", dir=to.parent, ignore_cleanup_errors=True) as folder:
        half = Path(folder) / to.name
        shutil.copytree(place, half, copy_function=shutil.copyfile)
        for each in (half, *half.iterdir()):
            # The original may be read-only; numba refuses a folder that it cannot write in.
            each.chmod(0o755)
        try:
            half.replace(to)
        except OSError:
            if not to.is_dir():
                raise


def place_of_compiled(cache: Path, ahead: Path) -> Path | None:
    """Return a folder in ``cache`` for compiled rules, or None where there can be none.

    It is named after the rules, so it is never out of date. What the installation compiled in ``ahead`` is copied
    there, because numba writes where it reads. numba itself finds out whether it suits this processor.
    """
    place = cache / ahead.name
    with suppress(OSError):
        if ahead.is_dir() and not place.exists():
            copy_compiled(ahead, place)
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return place if os.access(place, os.W_OK) else None


def _tell_numba() -> Path | None:
    place = place_of_compiled(user_cache_path("recollect"), AHEAD)
    if place is not None:
        _numba.config.CACHE_DIR = str(place)
    return place


KEPT_IN = _tell_numba() if COMPILED else None
"""Where this process reads compiled rules and keeps those that it compiles, if anywhere."""


def compiled_rule(function: Rule) -> Rule:
    """Mark one of the rules: compiled on first use where numba is installed, and then kept compiled on disk.

    No rule divides by 0, and not looking for that (numba's error model "numpy") makes training a third faster. None
    makes or keeps an array, so no references are counted (``_nrt``), which takes an eighth of the time. C never calls
    one, and leaving out the way in for it saves a tenth of the compiling.
    """
    if not COMPILED:
        return function
    options = {"cache": KEPT_IN is not None, "error_model": "numpy", "_nrt": False, "no_cfunc_wrapper": True}
    compiled: Rule = _numba.njit(function, **options)
    return compiled


NATIVE = may_be_native()
"""Whether the long loops may run in C; see ``kiosk.training.native``."""


def is_slow() -> bool:
    """Whether nothing compiles the rules here, though that is not switched off."""
    return not COMPILED and not is_switched_off() and not FROZEN and library() is None


def ints(numbers: Ints) -> Ints:
    """Whole numbers in the form in which the rules want them here."""
    suited: Ints = _array(numbers, "int64", "q")
    return suited


def floats(numbers: Floats) -> Floats:
    """Numbers in the form in which the rules want them here."""
    suited: Floats = _array(numbers, "float64", "d")
    return suited


def _array(numbers: Any, dtype: str, code: str) -> Any:
    if COMPILED:
        return import_module("numpy").array(numbers, dtype=dtype)
    return array(code, numbers) if NATIVE else numbers


ROWS, COLUMNS = 4, 6
CARDS = ROWS * COLUMNS
PAIRS = CARDS // 2
ENDLESS = 5_000
"""Flips after which a game is given up: no player that finishes at all needs a tenth of them."""

# One game is one row of whole numbers: blocks with a number per place, then single numbers. LISTED is a list of places,
# whose length its rule returns.
MATE, FOUND, COUNT, LAST, LISTED, RECALL = (block * CARDS for block in range(6))
FLIPS, LAST_MATCH, PAIRS_FOUND, FIRST, MATCHED, HELP, RANDOM, POINTED = range(6 * CARDS, 6 * CARDS + 8)
LEAD, ACTION_COUNT = range(6 * CARDS + 8, 6 * CARDS + 10)
GAME = 6 * CARDS + 10
NOWHERE = -1

# The plan holds for many games: the gate, where a first-card hint points, and what each action gives away.
OPENING, PATIENCE, FIRST_PATIENCE, TARGET, LEAD_OF = range(5)
TARGET_RULES = (TargetRule.MOST_FLIPPED, TargetRule.MOST_RECENT, TargetRule.RANDOM)
MOST_FLIPPED, MOST_RECENT, ANYWHERE = range(3)

# What a help gives away, by the column of the usual four actions; another action gives away what one of them does.
LEADS = (Precision.NOTHING, Precision.COLUMN, Precision.ROW, Precision.CARD)
NO_HELP, SUG_COL, SUG_ROW, SUG_CARD = range(len(LEADS))
USUAL, OUTCOMES, PHASES = len(ACTIONS), len(MoveOutcome), len(Phase)
STATES = PHASES * USUAL * OUTCOMES
"""With the usual four actions."""
F_CORRECT, F_WRONG, S_CORRECT, S_WRONG = (int(outcome) for outcome in MoveOutcome)

WORD = 0xFFFF_FFFF
BITS = 32
MULTIPLIER = 2_146_999_758
UNIT = 2.0**-BITS


def gate_plan(gate: Gate, target: TargetRule, actions: tuple[ActionSpec, ...] = ACTIONS) -> Ints:
    """Return a gate, a target rule and the actions of a table as the rules read them."""
    leads = [LEADS.index(action.precision) for action in actions]
    return ints([gate.opening, gate.patience, gate.first_patience, TARGET_RULES.index(target), *leads])


def new_game(seed: int, actions: int = USUAL) -> Ints:
    """Return an empty row for games with so many actions; their random numbers follow from ``seed`` (0 or more)."""
    numbers = [0] * GAME
    numbers[ACTION_COUNT] = actions
    # The hash keeps neighbouring seeds apart, which this kind of generator by itself would not.
    scattered = int.from_bytes(hashlib.sha256(str(seed).encode()).digest()[:8], "big")
    numbers[RANDOM] = scattered % (MULTIPLIER * (WORD + 1) - 2) + 1
    return ints(numbers)


@compiled_rule
def draw_bits(game: Ints) -> int:
    """Return the next random word of 32 bits: multiply with carry, its two halves joined (period about 2^62).

    MULTIPLIER is below 2^31, so that nothing overflows 63 bits, and makes MULTIPLIER 2^32 - 1 a safe prime.
    """
    word = MULTIPLIER * (game[RANDOM] & WORD) + (game[RANDOM] >> BITS)
    game[RANDOM] = word
    return (word ^ (word >> BITS)) & WORD


@compiled_rule
def below(game: Ints, number: int) -> int:
    """Return a random whole number from 0 to ``number`` - 1."""
    return (draw_bits(game) * number) >> BITS


@compiled_rule
def unit(game: Ints) -> float:
    """Return a random number from 0 up to, not including, 1."""
    return draw_bits(game) * UNIT


@compiled_rule
def deal(game: Ints) -> None:
    """Shuffle the cards (Fisher-Yates) and start a game with all of them closed."""
    for place in range(CARDS):
        game[LISTED + place] = place
        game[FOUND + place] = game[COUNT + place] = game[LAST + place] = game[RECALL + place] = 0
    for last in range(CARDS - 1, 0, -1):
        other = below(game, last + 1)
        kept = game[LISTED + last]
        game[LISTED + last] = game[LISTED + other]
        game[LISTED + other] = kept
    for pair in range(PAIRS):
        one, other = game[LISTED + 2 * pair], game[LISTED + 2 * pair + 1]
        game[MATE + one], game[MATE + other] = other, one
    game[FLIPS] = game[LAST_MATCH] = game[PAIRS_FOUND] = 0
    game[FIRST], game[MATCHED], game[HELP], game[LEAD] = NOWHERE, 1, NO_HELP, NO_HELP
    game[POINTED] = NOWHERE


@compiled_rule
def flip(game: Ints, place: int) -> bool:
    """Turn up a closed card; True if it completes a match. Two unmatched cards are turned back at once."""
    game[FLIPS] += 1
    game[COUNT + place] += 1
    game[LAST + place] = game[FLIPS]
    first = game[FIRST]
    if first == NOWHERE:
        game[FIRST] = place
        return False
    game[FIRST] = NOWHERE
    game[MATCHED] = 1 if game[MATE + first] == place else 0
    if game[MATCHED] == 1:
        game[FOUND + first] = game[FOUND + place] = 1
        game[PAIRS_FOUND] += 1
        game[LAST_MATCH] = game[FLIPS]
    return game[MATCHED] == 1


@compiled_rule
def phase(game: Ints) -> int:
    """Return the phase of the game, 0-2; as ``Phase.of``."""
    return min(game[PAIRS_FOUND] * PHASES // PAIRS, PHASES - 1)


@compiled_rule
def state(game: Ints) -> int:
    """Return the row of the Q-table before the next flip; as ``State.of(...).index``."""
    outcome = (F_CORRECT if game[MATCHED] == 1 else F_WRONG) + (0 if game[FIRST] == NOWHERE else S_CORRECT - F_CORRECT)
    return (phase(game) * game[ACTION_COUNT] + game[HELP]) * OUTCOMES + outcome


@compiled_rule
def is_open(game: Ints, gate: Ints) -> bool:
    """Whether the gate lets the table be asked; as ``Gate.decide``."""
    if game[FLIPS] < gate[OPENING]:
        return False
    if game[FIRST] != NOWHERE:
        return True
    needed = gate[FIRST_PATIENCE] if game[PAIRS_FOUND] == 0 else gate[PATIENCE]
    return game[FLIPS] - game[LAST_MATCH] >= needed


@compiled_rule
def closed(game: Ints, place: int) -> bool:
    """Whether the card there may be flipped."""
    return game[FOUND + place] == 0 and place != game[FIRST]


@compiled_rule
def list_candidates(game: Ints, target: int) -> int:
    """List every card that a hint for the coming flip may point at; their number. As ``Mentaliser.target``."""
    if game[FIRST] != NOWHERE:
        game[LISTED] = game[MATE + game[FIRST]]
        return 1
    block = COUNT if target == MOST_FLIPPED else LAST
    most = 0
    if target != ANYWHERE:
        for place in range(CARDS):
            if game[FOUND + place] == 0 and game[block + place] > most:
                most = game[block + place]
    number = 0
    for place in range(CARDS):
        # Written in any case, and kept by counting: this is faster than a branch. Likewise in the lists of players.
        game[LISTED + number] = place
        fits = game[FOUND + place] == 0 and (most == 0 or game[block + game[MATE + place]] == most)
        number += 1 if fits else 0
    return number


@compiled_rule
def aim(game: Ints, target: int) -> int:
    """Return the place that a hint for the coming flip points at."""
    if game[FIRST] != NOWHERE:
        # There is one candidate; a number is drawn all the same, so that games are the same as ever.
        below(game, 1)
        return game[MATE + game[FIRST]]
    return pick(game, list_candidates(game, target))


@compiled_rule
def pick(game: Ints, number: int) -> int:
    """One of the ``number`` listed places, each with the same chance; NOWHERE if there is none."""
    left = below(game, number)
    return game[LISTED + left] if number > 0 else NOWHERE
