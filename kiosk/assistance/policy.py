"""The learning layer: states, actions, the gate and the frozen Q-table."""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from enum import Enum, IntEnum
from pathlib import Path
from typing import Any, Self

from kiosk import UserInputError
from kiosk.config import policy_path
from kiosk.game import Concentration


class Action(IntEnum):
    """How much to help with the coming flip; the number is the column of the Q-table."""

    NO_HELP = 0
    SUG_COL = 1
    SUG_ROW = 2
    SUG_CARD = 3

    @property
    def label(self) -> str:
        """The name used in policy files and records."""
        return self.name.lower()

    @property
    def level(self) -> float:
        """How much assistance this is, for the measure "assistance per flip": none 0, column .5, row 1, card 2."""
        return _LEVELS[self]


_LEVELS = {Action.NO_HELP: 0.0, Action.SUG_COL: 0.5, Action.SUG_ROW: 1.0, Action.SUG_CARD: 2.0}


class Phase(IntEnum):
    """How far the game is, in thirds of its pairs; with 12 pairs: 0-3, 4-7 and 8-11 found."""

    BEGINNING = 0
    MIDDLE = 1
    END = 2

    @classmethod
    def of(cls, pairs_found: int, pairs: int) -> Phase:
        """The phase of a game in which ``pairs_found`` of ``pairs`` are found."""
        return cls(min(pairs_found * len(cls) // pairs, cls.END))


class MoveOutcome(IntEnum):
    """Whether the coming flip is a first or a second card, and whether the last completed move was a match."""

    F_CORRECT = 0
    F_WRONG = 1
    S_CORRECT = 2
    S_WRONG = 3

    @classmethod
    def of(cls, card: FlipInMove, *, last_move_matched: bool | None) -> MoveOutcome:
        """The outcome before a flip; before any move is completed nothing has gone wrong, so it counts as correct."""
        if card is FlipInMove.FIRST:
            return cls.F_WRONG if last_move_matched is False else cls.F_CORRECT
        return cls.S_WRONG if last_move_matched is False else cls.S_CORRECT


class FlipInMove(Enum):
    """Which card of the move the coming flip turns up."""

    FIRST = "first"
    SECOND = "second"

    @classmethod
    def coming(cls, game: Concentration) -> FlipInMove:
        """The card of the move that the next flip of ``game`` turns up."""
        return cls.FIRST if game.first_card is None else cls.SECOND


@dataclass(frozen=True, slots=True)
class State:
    """What the learning layer sees before a flip."""

    game: Phase
    last: Action
    outcome: MoveOutcome

    @property
    def index(self) -> int:
        """The row of the Q-table, 0-47."""
        return (self.game * len(Action) + self.last) * len(MoveOutcome) + self.outcome

    @property
    def label(self) -> str:
        """The name used in policy files: ``beginning/no_help/f_correct``."""
        return "/".join(part.name.lower() for part in (self.game, self.last, self.outcome))

    @classmethod
    def at(cls, index: int) -> Self:
        """The state with this index."""
        rest, outcome = divmod(index, len(MoveOutcome))
        game, last = divmod(rest, len(Action))
        return cls(Phase(game), Action(last), MoveOutcome(outcome))

    @classmethod
    def of(cls, game: Concentration, last: Action) -> Self:
        """The state before the next flip of ``game``, when the previous decision was ``last``."""
        phase = Phase.of(game.pairs_found, game.board.pairs)
        return cls(phase, last, MoveOutcome.of(FlipInMove.coming(game), last_move_matched=game.last_move_matched))


STATES: tuple[State, ...] = tuple(State.at(index) for index in range(len(Phase) * len(Action) * len(MoveOutcome)))
"""All 48 states, in the order of the Q-table's rows."""


class GateDecision(Enum):
    """What the gate says before a flip: open, or the reason why no hint is considered."""

    OPEN = "open"
    OPENING = "the first flips of a game are the player's own"
    DOING_WELL = "a first card gets no hint so soon after a match"
    STILL_EXPLORING = "a first card gets no hint so early while no pair has been found"

    @property
    def is_open(self) -> bool:
        """Whether the table may be asked."""
        return self is GateDecision.OPEN


@dataclass(frozen=True, slots=True)
class Gate:
    """Three numbers of flips; all 0 is no gate at all.

    ``opening``: flips at the start of a game that are never helped. ``patience``: flips since the last match before
    a first card may be helped. ``first_patience``: the same while no pair has been found.
    """

    opening: int = 6
    patience: int = 4
    first_patience: int = 10

    def __post_init__(self) -> None:
        """Refuse with a ValueError what is no number of flips: a number below 0, a fraction, a text."""
        for name in self.__slots__:
            flips = getattr(self, name)
            if not isinstance(flips, int) or isinstance(flips, bool):
                raise ValueError(f"gate: {name} must be a whole number of flips, not {flips!r}")
            if flips < 0:
                raise ValueError(f"gate: {name} must be 0 or more flips, not {flips}")

    def decide(self, game: Concentration) -> GateDecision:
        """Whether a hint may be considered before the next flip of ``game``."""
        if game.flips < self.opening:
            return GateDecision.OPENING
        if FlipInMove.coming(game) is FlipInMove.SECOND:
            return GateDecision.OPEN
        if game.pairs_found == 0:
            return GateDecision.OPEN if game.flips_since_match >= self.first_patience else GateDecision.STILL_EXPLORING
        return GateDecision.OPEN if game.flips_since_match >= self.patience else GateDecision.DOING_WELL


NO_GATE = Gate(opening=0, patience=0, first_patience=0)


FORMAT = "recollect-policy-1"
NONE = "none"
"""The name of no policy at all."""
DECIMALS = 6
"""Values are frozen to this many decimals: readable, and the same to the last digit on every machine."""

_ACTIONS = [action.label for action in Action]
_KEYS = {"format", "name", "gate", "training", "actions", "values", "sha256"}
_LARGEST = sys.float_info.max


class PolicyError(UserInputError):
    """A policy file that cannot be used; the message names the file and says what is wrong with it."""


@dataclass(frozen=True)
class QTable:
    """A frozen table of shape 48 x 4 (states x actions), the gate it was trained behind, and how it was made.

    ``training`` is whatever the trainer wants to be known of how the table came about; it must be JSON.
    """

    name: str
    gate: Gate
    values: tuple[tuple[float, ...], ...]
    training: Mapping[str, Any]

    @classmethod
    def freeze(cls, name: str, gate: Gate, values: Sequence[Sequence[float]], training: Mapping[str, Any]) -> Self:
        """A table as it will stand in its file: values rounded to DECIMALS."""
        # Adding 0.0 turns -0.0 into 0.0, which would otherwise hash differently.
        return cls(name, gate, tuple(tuple(round(float(v), DECIMALS) + 0.0 for v in row) for row in values), training)

    def row(self, state: State) -> tuple[float, ...]:
        """The four action values of a state."""
        return self.values[state.index]

    def action(self, state: State) -> Action:
        """The greedy action; ties go to the lowest, which helps least."""
        row = self.row(state)
        return Action(row.index(max(row)))

    @property
    def sha256(self) -> str:
        """The hash over everything in the file but the hash itself."""
        return _hash(self._document())

    @classmethod
    def blank(cls) -> Self:
        """The table that never helps, behind the usual gate."""
        return cls.freeze(NONE, Gate(), [[0.0] * len(Action) for _ in STATES], {})

    @classmethod
    def named(cls, name: str) -> Self:
        """A table by the name of a shipped one, by "none", or by its path; raises PolicyError with one sentence."""
        return cls.blank() if name == NONE else cls.load(policy_path(name))

    @classmethod
    def load(cls, path: Path) -> Self:
        """Read a policy file; raises PolicyError with one sentence about what is wrong."""
        try:
            return cls.from_json(path.read_text("utf-8"))
        except OSError as error:
            raise PolicyError(f"the policy file {path} cannot be read: {error.strerror}") from error
        except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
            raise PolicyError(f"the policy file {path} is not JSON: {error}") from error
        except ValueError as error:
            raise PolicyError(f"the policy file {path} cannot be used: {error}") from error

    @classmethod
    def from_json(cls, text: str) -> Self:
        """The table that ``to_json`` wrote; raises ValueError saying what is wrong with it."""
        return cls._of(json.loads(text, object_pairs_hook=said_once))

    def to_json(self) -> str:
        """The text of the policy file, with one line per state so that the eye can run down the columns."""
        document = self._document()
        values = document.pop("values")
        head = json.dumps(document, indent=2, ensure_ascii=False).removesuffix("\n}")
        width = max(map(len, values)) + len('"": ')
        rows = ",\n".join(f"    {f'{json.dumps(state)}: ':<{width}}{json.dumps(row)}" for state, row in values.items())
        return f'{head},\n  "values": {{\n{rows}\n  }},\n  "sha256": "{self.sha256}"\n}}\n'

    def _document(self) -> dict[str, Any]:
        return {
            "format": FORMAT,
            "name": self.name,
            "gate": asdict(self.gate),
            "training": dict(self.training),
            "actions": _ACTIONS,
            "values": {state.label: list(self.row(state)) for state in STATES},
        }

    @classmethod
    def _of(cls, document: Any) -> Self:
        if not isinstance(document, dict) or document.get("format") != FORMAT:
            raise ValueError(f'it is not of the format "{FORMAT}"')
        missing, foreign = _KEYS - document.keys(), document.keys() - _KEYS
        if missing:
            raise ValueError(f"it lacks {' and '.join(sorted(missing))}")
        if foreign:
            raise ValueError(f"it has a key that no policy has: {min(foreign)!r}")
        if document["actions"] != _ACTIONS:
            raise ValueError(f"its actions are {document['actions']}, but the assistant has {_ACTIONS}")
        if not isinstance(document["name"], str):
            raise ValueError(f"its name must be text, not {document['name']!r}")
        if not isinstance(document["training"], dict):
            raise ValueError(f"its training must say by name how it was made, not {document['training']!r}")
        table = cls(document["name"], _gate(document["gate"]), _values(document["values"]), document["training"])
        # The hash comes last: a file whose shape is wrong deserves the better sentence.
        if document["sha256"] != table.sha256:
            raise ValueError("its sha256 does not fit its content, so it was changed after it was made")
        return table


def said_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """JSON takes the last of two equal keys; a person who reads the file takes the first, so there may be no two."""
    said: dict[str, Any] = {}
    for key, value in pairs:
        if key in said:
            raise ValueError(f"it says {key!r} twice")
        said[key] = value
    return said


def _hash(document: Mapping[str, Any]) -> str:
    canonical = json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(canonical.encode()).hexdigest()


def _values(rows: Any) -> tuple[tuple[float, ...], ...]:
    if not isinstance(rows, dict):
        raise ValueError("its values are not given by state")
    names = {state.label for state in STATES}
    for name in rows:
        if name not in names:
            raise ValueError(f"it names a state that does not exist: {name!r}")
    absent = [state.label for state in STATES if state.label not in rows]
    if absent:
        raise ValueError(f"its table has {len(rows)} states, not {len(STATES)}: {absent[0]!r} is missing")
    return tuple(_row(state, rows[state.label]) for state in STATES)


def _row(state: State, row: Any) -> tuple[float, ...]:
    if not isinstance(row, list) or len(row) != len(Action):
        raise ValueError(f"state {state.label!r} must have {len(Action)} values, one per action, not {row!r}")
    for action, value in zip(Action, row, strict=True):
        if isinstance(value, bool) or not isinstance(value, int | float) or not -_LARGEST <= value <= _LARGEST:
            raise ValueError(f"the value of {action.label} in state {state.label!r} is {value!r}, not a finite number")
    return tuple(float(value) for value in row)


def _gate(numbers: Any) -> Gate:
    if not isinstance(numbers, dict) or set(numbers) != set(asdict(Gate())):
        raise ValueError(f"its gate must have the numbers {', '.join(asdict(Gate()))}")
    for name, number in numbers.items():
        if isinstance(number, bool) or not isinstance(number, int):
            raise ValueError(f"its gate's {name} must be a whole number of flips, not {number!r}")
    return Gate(**numbers)
