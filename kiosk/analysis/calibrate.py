"""Estimate how people forget, follow hints and lapse, from the flips of an exported study.

The model is the memory player of ``kiosk.training``; its likelihood is in ``memory_likelihood``. The logit of the
forgetting is normal over people; following and lapse are the same for all. Mean, spread, following and lapse maximise
the marginal likelihood (empirical Bayes), with the integral over people taken on a grid.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize
from scipy.special import expit, logit, ndtr

from kiosk import UserInputError
from kiosk.analysis.data import load_study, load_table
from kiosk.analysis.memory_likelihood import Array, MoveLikelihood, PlayedGame, move_likelihood
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ActionSpec, QTable, find_action
from kiosk.config import KNOWN_CONDITIONS, ConditionConfig
from kiosk.experiment.condition import Condition
from kiosk.files import parse_json
from kiosk.training.simulated_players import PEOPLE_FORMAT, PopulationPlayer

LEAST_SESSIONS = 10
"""A spread over fewer people than this says nothing."""
STEP = 0.15
GRID: Array = np.arange(-5.0, 2.0 + STEP / 2, STEP)
"""The logits of forgetting at which the likelihood of a person is worked out; d from .007 to .88."""
AGE_CONVENTION = (
    "the age of a card is the number of flips since it was last turned up; the card of the last flip has age 0 and is "
    "recalled for certain, and one of age a with chance (1 - d)^a"
)
Z95 = 1.959964
HALF_CHI2 = 1.920729
"""Half the 95 % point of chi-square with one degree of freedom: how far a profile may fall within the interval."""
_BOUNDS = ((GRID[0], GRID[-1]), (np.log(0.01), np.log(3.0)), (-6.0, 7.0), (-8.0, 0.0))
_AT_BOUND = 0.5
_TABLES = {
    "participants": ("participant_id", "condition", "status", "policy_sha256"),
    "cards": ("participant_id", "board", "stage", "row", "column", "picture"),
    "flips": ("participant_id", "board", "stage", "flip", "row", "column"),
    "hints": ("participant_id", "board", "flip", "action", "target_row", "target_column"),
}


@dataclass(frozen=True, slots=True)
class PlayedSession:
    """One participant's game, and under which condition and table it was played."""

    participant: str
    condition: Condition
    policy_sha256: str
    game: PlayedGame


@dataclass(frozen=True, slots=True)
class PlayedStudy:
    """The games of a data set, and the tables and the rule of mentalised targets to simulate them."""

    sessions: tuple[PlayedSession, ...]
    policies: dict[str, QTable]
    conditions: dict[str, ConditionConfig]
    rule: TargetRule
    left_out: int


def read_games(folder: Path) -> PlayedStudy:
    """Read the games of an exported data set.

    Raises UserInputError for a folder that is none, or has too few games.

    A game that was not finished counts as far as it went. A participant without any flip in the game is left out, and
    so is one whose hints named no place, which simulated players cannot follow.
    """
    load_study(folder)
    tables = {name: load_table(folder, name, columns) for name, columns in _TABLES.items()}
    people = tables["participants"]
    boards = _boards(tables["cards"])
    flips = _rows(tables["flips"], ("row", "column"), stage="game")
    hints = _rows(tables["hints"], ("target_row", "target_column"))
    actions = dict(zip(_keys(tables["hints"]), tables["hints"].text("action"), strict=True))
    sessions = []
    rows = [people.text(name) for name in ("participant_id", "condition", "policy_sha256")]
    conditions = _conditions(folder)
    for who, condition, sha256 in zip(*rows, strict=True):
        board = boards.get(who)
        if condition not in conditions:
            raise UserInputError(f"{folder} does not say what the condition {condition!r} is")
        if board is None or not flips.get((who, board.number)) or conditions[condition].reminds:
            continue
        played = tuple(
            (board.place(cell), *_hint(board, hints, actions, (who, board.number, number)))
            for number, cell in sorted(flips[who, board.number].items())
        )
        game = PlayedGame(board.mates, board.columns, played)
        sessions.append(PlayedSession(who, Condition(condition), sha256, game))
    if len(sessions) < LEAST_SESSIONS:
        raise UserInputError(
            f"{folder} holds {len(sessions)} games; a calibration needs at least {LEAST_SESSIONS}, as it measures how "
            "people differ"
        )
    return PlayedStudy(tuple(sessions), _policies(folder), conditions, _rule(folder), len(people) - len(sessions))


@dataclass(frozen=True, slots=True)
class _Board:
    number: str
    columns: int
    mates: tuple[int, ...]

    def place(self, cell: tuple[int, int]) -> int:
        return (cell[0] - 1) * self.columns + cell[1] - 1


def _keys(table: Any) -> list[tuple[str, str, int]]:
    numbers = [int(number) for number in table.numbers("flip")]
    return list(zip(table.text("participant_id"), table.text("board"), numbers, strict=True))


def _rows(table: Any, cells: tuple[str, str], stage: str = "") -> dict[tuple[str, str], dict[int, tuple[int, int]]]:
    """Of every board, the row and column of each flip."""
    found: dict[tuple[str, str], dict[int, tuple[int, int]]] = defaultdict(dict)
    places = [[int(number) for number in table.numbers(name)] for name in cells]
    stages = table.text("stage") if stage else [""] * len(table)
    for (who, board, number), row, column, where in zip(_keys(table), *places, stages, strict=True):
        if where == stage:
            found[who, board][number] = (row, column)
    return found


def _boards(cards: Any) -> dict[str, _Board]:
    """Of every participant, the last board of the game."""
    dealt: dict[tuple[str, str], list[tuple[int, int, str]]] = defaultdict(list)
    columns = [cards.text(name) for name in ("participant_id", "board", "stage", "picture")]
    places = [[int(number) for number in cards.numbers(name)] for name in ("row", "column")]
    for who, board, stage, picture, row, column in zip(*columns, *places, strict=True):
        if stage == "game":
            dealt[who, board].append((row, column, picture))
    return {
        who: _board(who, number, each) for (who, number), each in sorted(dealt.items(), key=lambda at: int(at[0][1]))
    }


def _board(who: str, number: str, cards: list[tuple[int, int, str]]) -> _Board:
    columns = max(column for _, column, _ in cards)
    at: dict[str, list[int]] = defaultdict(list)
    for row, column, picture in cards:
        at[picture].append((row - 1) * columns + column - 1)
    strange = [picture for picture, places in at.items() if len(places) != 2]  # noqa: PLR2004 - a pair
    if strange or len(cards) != columns * max(row for row, _, _ in cards):
        raise UserInputError(f"the board {number} of {who} is not a full board of pairs; export the data again")
    mates = {one: other for pair in at.values() for one, other in (pair, pair[::-1])}
    return _Board(number, columns, tuple(mates[place] for place in range(len(cards))))


def _hint(board: _Board, hints: Any, actions: Any, key: tuple[str, str, int]) -> tuple[int, int]:
    """Return the action and the target with one flip; without a hint, none."""
    cell = hints.get(key[:2], {}).get(key[2])
    if cell is None:
        return int(ActionSpec.NO_HELP), -1
    return int(find_action(actions[key])), board.place(cell)


def _policies(folder: Path) -> dict[str, QTable]:
    tables = (QTable.load(file) for file in sorted((folder / "materials" / "policies").glob("*.json")))
    return {table.sha256: table for table in tables}


def _conditions(folder: Path) -> dict[str, ConditionConfig]:
    """Return what the conditions came to, from the study's settings as they were exported."""
    found = dict(KNOWN_CONDITIONS)
    for file in sorted((folder / "materials" / "settings").glob("*.json")):
        try:
            declared = parse_json(file.read_text("utf-8")).get("conditions", {})
            found |= {name: ConditionConfig.model_validate(each) for name, each in declared.items()}
        except (OSError, ValueError, AttributeError) as error:
            raise UserInputError(f"{file} does not say what the conditions are: {error}") from error
    return found


def _rule(folder: Path) -> TargetRule:
    """Return the rule of mentalised targets, from the study's settings as they were exported."""
    for file in sorted((folder / "materials" / "settings").glob("*.json")):
        try:
            return TargetRule(parse_json(file.read_text("utf-8"))["assistance"]["target_rule"])
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise UserInputError(f"{file} does not name the rule of targets: {error}") from error
    return TargetRule.MOST_FLIPPED


@dataclass(frozen=True, slots=True)
class CredibleInterval:
    """An estimate with its 95 % interval, and the standard error on the scale on which it was estimated."""

    value: float
    low: float
    high: float
    se: float | None = None

    def to_json(self) -> dict[str, float | None]:
        """Return the numbers as they stand in the file."""
        return {"value": self.value, "low": self.low, "high": self.high, "se": self.se}


@dataclass(frozen=True, slots=True)
class PersonEstimate:
    """One participant's forgetting: the mean and the 95 % interval of its posterior."""

    participant: str
    forgetting: CredibleInterval


@dataclass(frozen=True)
class Calibration:
    """The population that was found; ``mean`` and ``spread`` are of the logit of forgetting.

    ``following`` is None where there was no hint. ``posteriors`` has the shape people x grid.
    """

    mean: CredibleInterval
    spread: CredibleInterval
    following: CredibleInterval | None
    lapse: CredibleInterval
    log_likelihood: float
    people: tuple[PersonEstimate, ...]
    posteriors: Array

    @property
    def player(self) -> PopulationPlayer:
        """The population as a simulated player; people who were never given a hint count as following all."""
        follow = self.following.value if self.following else 1.0
        return PopulationPlayer(self.mean.value, self.spread.value, follow, self.lapse.value)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a reader should know before using the numbers."""
        found = []
        if self.spread.value < STEP:
            found.append(
                f"the spread {self.spread.value:.3f} is below the grid's step of {STEP:g}: the data do not tell these "
                "people apart, and they may all forget alike"
            )
        if not GRID[0] + 1 < self.mean.value < GRID[-1] - 1:
            found.append(f"the mean {self.mean.value:.2f} lies at the edge of the grid; this is no memory player")
        if self.following is None:
            found.append("no hint was given, so following is not estimated; simulated people follow every hint")
        return tuple(found)

    def to_json(self) -> dict[str, Any]:
        """Return the file that ``plan power``, ``simulate``, ``rehearse`` and ``train`` read as ``--people``."""
        player = self.player.parameters()
        del player["name"]
        return {
            "format": PEOPLE_FORMAT,
            "player": "memory",
            **player,
            "age": AGE_CONVENTION,
            "intervals": {
                "forgetting_mean": self.mean.to_json(),
                "forgetting_spread": self.spread.to_json(),
                "follow": self.following.to_json() if self.following else None,
                "lapse": self.lapse.to_json(),
            },
            "median_forgetting": float(expit(self.mean.value)),
            "log_likelihood": self.log_likelihood,
            "sessions": len(self.people),
            "warnings": list(self.warnings),
            "people": {person.participant: person.forgetting.to_json() for person in self.people},
        }


def calibrate(study: PlayedStudy) -> Calibration:
    """Fit the population to the games of a study."""
    return fit([session.participant for session in study.sessions], [session.game for session in study.sessions])


def fit(names: Sequence[str], games: Sequence[PlayedGame]) -> Calibration:
    """Fit the population to games; each is one person's."""
    moves = move_likelihood(games, expit(GRID))
    hinted = bool(moves.hinted.any())

    def loss(theta: Array) -> float:
        return -_marginal(moves, theta)

    start = np.array([-1.5, np.log(0.5), 2.0, -4.0])
    found = minimize(loss, start, method="L-BFGS-B", bounds=_BOUNDS, options={"ftol": 1e-10, "maxiter": 200})
    theta = np.asarray(found.x, dtype=float)
    used = [0, 1, *([2] if hinted else []), 3]
    intervals = _intervals(loss, theta, used)
    posteriors = posterior(moves, theta)
    people = tuple(PersonEstimate(name, _person(weights)) for name, weights in zip(names, posteriors, strict=True))
    mean, spread, following, lapse = (_back(number, theta, intervals) for number in range(4))
    assert mean and spread and lapse  # noqa: S101, PT018 - these three are always estimated
    return Calibration(mean, spread, following, lapse, -float(found.fun), people, posteriors)


def weights_of(mean: float, spread: float) -> Array:
    """Return the share of the population in each cell of the grid; the outermost cells go on for ever."""
    edges = np.concatenate([[-np.inf], (GRID[1:] + GRID[:-1]) / 2, [np.inf]])
    shares: Array = np.diff(ndtr((edges - mean) / spread))
    return shares


def _marginal(moves: MoveLikelihood, theta: Array) -> float:
    """Return the log-likelihood of all games, people integrated out."""
    joint = _joint(moves, theta)
    top = joint.max(axis=1, keepdims=True)
    return float((np.log(np.exp(joint - top).sum(axis=1)) + top[:, 0]).sum())


def _joint(moves: MoveLikelihood, theta: Array) -> Array:
    shares = np.maximum(weights_of(theta[0], np.exp(theta[1])), np.finfo(float).tiny)
    return moves.games(float(expit(theta[2])), float(expit(theta[3]))) + np.log(shares)


def posterior(moves: MoveLikelihood, theta: Array) -> Array:
    """Each person's posterior over the grid, shape people x grid; ``theta`` is mean, log spread and two logits."""
    joint = _joint(moves, theta)
    weights = np.exp(joint - joint.max(axis=1, keepdims=True))
    shares: Array = weights / weights.sum(axis=1, keepdims=True)
    return shares


def _intervals(
    loss: Callable[[Array], float], theta: Array, used: list[int]
) -> dict[int, tuple[float, float, float | None]]:
    """95 % intervals: normal ones from the observed information, and by the profile for what lies at its bound."""
    inner = [number for number in used if all(abs(theta[number] - end) > _AT_BOUND for end in _BOUNDS[number])]
    found: dict[int, tuple[float, float, float | None]] = {}
    covariance = np.linalg.pinv(_hessian(loss, theta, inner))
    for at, number in enumerate(inner):
        se = float(np.sqrt(max(covariance[at, at], 0.0)))
        found[number] = (theta[number] - Z95 * se, theta[number] + Z95 * se, se)
    for number in set(used) - set(inner):
        low, high = (_fall(loss, theta, number, end) for end in _BOUNDS[number])
        found[number] = (low, high, None)
    return found


def _hessian(loss: Callable[[Array], float], theta: Array, which: list[int], step: float = 0.02) -> Array:
    """Second derivatives by central differences."""
    size = len(which)
    hessian = np.zeros((size, size))
    units = np.eye(len(theta))[which] * step
    for row in range(size):
        for column in range(row + 1):
            a, b = units[row], units[column]
            corners = loss(theta + a + b) - loss(theta + a - b) - loss(theta - a + b) + loss(theta - a - b)
            hessian[row, column] = hessian[column, row] = corners / (4 * step * step)
    return hessian


def _fall(loss: Callable[[Array], float], theta: Array, number: int, end: float) -> float:
    """Where, towards one bound, the log-likelihood has fallen to the edge of the interval; else the bound."""
    best = loss(theta)

    def beyond(value: float) -> bool:
        moved = theta.copy()
        moved[number] = value
        return loss(moved) - best > HALF_CHI2

    if not beyond(end):
        return end
    near, far = float(theta[number]), end
    for _ in range(30):
        middle = (near + far) / 2
        near, far = (near, middle) if beyond(middle) else (middle, far)
    return near


def _back(
    number: int, theta: Array, intervals: dict[int, tuple[float, float, float | None]]
) -> CredibleInterval | None:
    """Return an estimate on the scale on which people read it."""
    if number not in intervals:
        return None
    turn = (float, np.exp, expit, expit)[number]
    low, high, se = intervals[number]
    return CredibleInterval(float(turn(theta[number])), float(turn(low)), float(turn(high)), se)


def _person(weights: Array) -> CredibleInterval:
    forgetting = expit(GRID)
    below = np.cumsum(weights) - weights / 2
    low, high = np.interp([0.025, 0.975], below, forgetting)
    return CredibleInterval(float(weights @ forgetting), float(low), float(high))


def theta_of(player: PopulationPlayer) -> Array:
    """Return the parameters of a population as the likelihood takes them."""
    shares = [min(max(chance, 1e-3), 1 - 1e-3) for chance in (player.follow, player.lapse)]
    return np.array([player.forgetting_mean, np.log(max(player.forgetting_spread, 0.01)), *logit(shares)])
