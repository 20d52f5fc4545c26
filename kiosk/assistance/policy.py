"""The learning layer: states, actions, the gate and the frozen Q-table."""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from enum import Enum, IntEnum
from functools import cache
from pathlib import Path
from typing import Any, ClassVar, Self

from kiosk import UserInputError
from kiosk.config import policy_path
from kiosk.extensions import Extension, ExtensionGroup, find
from kiosk.files import parse_json
from kiosk.game import Concentration
from kiosk.lazy_dataclass import dataclass


class Precision(Enum):
    """How much of a card's place is given away."""

    NOTHING = "nothing"
    COLUMN = "column"
    ROW = "row"
    CARD = "card"


@dataclass(frozen=True)
class ActionSpec:
    """One thing that the assistant can do before a flip; equal ones are the same object.

    ``message`` begins the names of the messages that say it: with ``point`` they are ``point-first-column`` and so on.
    An action that needs no target is said with the message of this name alone. ``cost`` is taken from the reward in
    training, on top of what the reward itself takes for a place that is given away.
    """

    NO_HELP: ClassVar[ActionSpec]
    SUG_COL: ClassVar[ActionSpec]
    SUG_ROW: ClassVar[ActionSpec]
    SUG_CARD: ClassVar[ActionSpec]

    name: str
    precision: Precision = Precision.NOTHING
    needs_target: bool = False
    message: str = ""
    cost: float = 0.0
    sentences: Path | None = None
    """A folder with the sentences of an action from another package, one file for each language, such as en.ftl."""

    def __post_init__(self) -> None:
        """Refuse with a ValueError what cannot be carried out."""
        if self.needs_target != (self.precision is not Precision.NOTHING):
            raise ValueError(f"{self.name}: an action needs a target if it gives a place away, and only then")
        if not 0 <= self.cost <= 1:
            raise ValueError(f"{self.name}: its cost must be from 0 to 1, not {self.cost!r}")

    @property
    def messages(self) -> tuple[str, ...]:
        """The names of the messages that say it."""
        if not self.needs_target:
            return (self.message,) if self.message else ()
        return tuple(f"{self.message}-{card.value}-{self.precision.value}" for card in FlipInMove)

    def __index__(self) -> int:
        """Return the column in a table with the usual four actions; raises ValueError for any other."""
        return ACTIONS.index(self)

    @property
    def label(self) -> str:
        """The name used in policy files and records."""
        return self.name

    @property
    def level(self) -> float:
        """How much assistance this is, for the measure "assistance per flip": none 0, column .5, row 1, card 2."""
        return _LEVELS[self.precision]


_LEVELS = {Precision.NOTHING: 0.0, Precision.COLUMN: 0.5, Precision.ROW: 1.0, Precision.CARD: 2.0}

POINT = "point"
"""What the messages begin with that say where a card lies."""

NO_HELP = ActionSpec("no_help")
SUG_COL = ActionSpec("sug_col", Precision.COLUMN, needs_target=True, message=POINT)
SUG_ROW = ActionSpec("sug_row", Precision.ROW, needs_target=True, message=POINT)
SUG_CARD = ActionSpec("sug_card", Precision.CARD, needs_target=True, message=POINT)
ACTIONS = (NO_HELP, SUG_COL, SUG_ROW, SUG_CARD)
"""The actions of a policy that says nothing else, in the order of its columns."""

ActionSpec.NO_HELP, ActionSpec.SUG_COL, ActionSpec.SUG_ROW, ActionSpec.SUG_CARD = ACTIONS

PRAISE = ActionSpec("praise", message="praise")
"""Said after a pair was found; no table has it."""
ENCOURAGEMENT = ActionSpec("encouragement", message="encouragement")
"""Said after a move that missed; a table may have it, too."""


def load_action(extension: Extension) -> ActionSpec:
    """Import an action; raises UserInputError if it is none."""
    action = extension.load()
    if not isinstance(action, ActionSpec):
        raise extension.broken(f"{extension.entry.value} is no kiosk.assistance.policy.ActionSpec")
    if action.name != extension.name:
        raise extension.broken(f"its name must be {extension.name!r}, not {action.name!r}")
    if not extension.is_built_in and not action.message:
        raise extension.broken("it has no message that it could be said with")
    if action.sentences is not None and not (action.sentences / "en.ftl").is_file():
        raise extension.broken(f"there are no sentences {action.sentences / 'en.ftl'}")
    return action


@cache
def find_action(name: str) -> ActionSpec:
    """Return the action of a name; raises UserInputError if no package has it, or the package is broken."""
    return load_action(find(ExtensionGroup.ACTIONS, name))


class Phase(IntEnum):
    """How far the game is, in thirds of its pairs; with 12 pairs: 0-3, 4-7 and 8-11 found."""

    BEGINNING = 0
    MIDDLE = 1
    END = 2

    @classmethod
    def of(cls, pairs_found: int, pairs: int) -> Phase:
        """Return the phase of a game in which ``pairs_found`` of ``pairs`` are found."""
        return cls(min(pairs_found * len(cls) // pairs, cls.END))


class MoveOutcome(IntEnum):
    """Whether the coming flip is a first or a second card, and whether the last completed move was a match."""

    F_CORRECT = 0
    F_WRONG = 1
    S_CORRECT = 2
    S_WRONG = 3

    @classmethod
    def of(cls, card: FlipInMove, *, last_move_matched: bool | None) -> MoveOutcome:
        """Return the outcome before a flip.

        Before any move is completed nothing has gone wrong, so it counts as correct.
        """
        if card is FlipInMove.FIRST:
            return cls.F_WRONG if last_move_matched is False else cls.F_CORRECT
        return cls.S_WRONG if last_move_matched is False else cls.S_CORRECT


class FlipInMove(Enum):
    """Which card of the move the coming flip turns up."""

    FIRST = "first"
    SECOND = "second"

    @classmethod
    def coming(cls, game: Concentration) -> FlipInMove:
        """Return the card of the move that the next flip of ``game`` turns up."""
        return cls.FIRST if game.first_card is None else cls.SECOND


@dataclass(frozen=True, slots=True)
class State:
    """What the learning layer sees before a flip."""

    game: Phase
    last: ActionSpec
    outcome: MoveOutcome

    @property
    def index(self) -> int:
        """The row of a Q-table with the usual four actions, 0-47."""
        return self.index_in(ACTIONS)

    def index_in(self, actions: tuple[ActionSpec, ...]) -> int:
        """Return the row of a Q-table with these actions, from 0."""
        return (self.game * len(actions) + actions.index(self.last)) * len(MoveOutcome) + self.outcome

    @property
    def label(self) -> str:
        """The name used in policy files: ``beginning/no_help/f_correct``."""
        return "/".join((self.game.name.lower(), self.last.label, self.outcome.name.lower()))

    @classmethod
    def at(cls, index: int, actions: tuple[ActionSpec, ...] = ACTIONS) -> Self:
        """Return the state with this index in a table with these actions."""
        rest, outcome = divmod(index, len(MoveOutcome))
        game, last = divmod(rest, len(actions))
        return cls(Phase(game), actions[last], MoveOutcome(outcome))

    @classmethod
    def of(cls, game: Concentration, last: ActionSpec) -> Self:
        """Return the state before the next flip of ``game``, when the previous decision was ``last``."""
        phase = Phase.of(game.pairs_found, game.board.pairs)
        return cls(phase, last, MoveOutcome.of(FlipInMove.coming(game), last_move_matched=game.last_move_matched))


@cache
def states_with(actions: tuple[ActionSpec, ...]) -> tuple[State, ...]:
    """All states of a table with these actions, in the order of its rows."""
    return tuple(State.at(index, actions) for index in range(len(Phase) * len(actions) * len(MoveOutcome)))


STATES = states_with(ACTIONS)
"""The 48 states with the usual four actions."""


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

_KEYS = {"format", "name", "gate", "training", "actions", "values", "sha256"}
_LARGEST = sys.float_info.max


class PolicyError(UserInputError):
    """A policy file that cannot be used; the message names the file and says what is wrong with it."""


@dataclass(frozen=True)
class QTable:
    """A frozen table of shape 48 x 4 (states x actions), its training gate, and how it was made.

    With n actions it has the shape 12 n x n; ``actions`` names its columns, of which the first is no help.

    ``training`` is whatever the trainer wants to be known of how the table came about; it must be JSON.
    """

    name: str
    gate: Gate
    values: tuple[tuple[float, ...], ...]
    training: Mapping[str, Any]
    actions: tuple[ActionSpec, ...] = ACTIONS

    @classmethod
    def freeze(
        cls,
        name: str,
        gate: Gate,
        values: Sequence[Sequence[float]],
        training: Mapping[str, Any],
        actions: tuple[ActionSpec, ...] = ACTIONS,
    ) -> Self:
        """Return a table as it will stand in its file: values rounded to DECIMALS."""
        # Adding 0.0 turns -0.0 into 0.0, which would otherwise hash differently.
        rounded = tuple(tuple(round(float(v), DECIMALS) + 0.0 for v in row) for row in values)
        return cls(name, gate, rounded, training, actions)

    @property
    def states(self) -> tuple[State, ...]:
        """All its states, in the order of its rows."""
        return states_with(self.actions)

    def row(self, state: State) -> tuple[float, ...]:
        """Return the values of a state, one for each action."""
        return self.values[state.index_in(self.actions)]

    def action(self, state: State) -> ActionSpec:
        """Return the greedy action; ties go to the lowest, which helps least."""
        row = self.row(state)
        return self.actions[row.index(max(row))]

    @property
    def sha256(self) -> str:
        """The hash over everything in the file but the hash itself."""
        return _hash(self._document())

    @classmethod
    def blank(cls) -> Self:
        """Return the table that never helps, behind the usual gate."""
        return cls.freeze(NONE, Gate(), [[0.0] * len(ACTIONS) for _ in STATES], {})

    @classmethod
    def named(cls, name: str) -> Self:
        """Read a table by the name of a shipped one, by "none", or by its path.

        Raises PolicyError with one sentence.
        """
        return cls.blank() if name == NONE else cls.load(policy_path(name))

    @classmethod
    def load(cls, path: Path) -> Self:
        """Read a policy file; raises PolicyError with one sentence about what is wrong."""
        try:
            return cls.from_json(path.read_text("utf-8"))
        except OSError as error:
            raise PolicyError(f"the policy file {path} cannot be read: {error.strerror}") from error
        except (UnicodeDecodeError, json.JSONDecodeError) as error:
            raise PolicyError(f"the policy file {path} is not JSON: {error}") from error
        except ValueError as error:
            raise PolicyError(f"the policy file {path} cannot be used: {error}") from error

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Return the table that ``to_json`` wrote; raises ValueError saying what is wrong with it."""
        return cls._of(parse_json(text, object_pairs_hook=said_once))

    def to_json(self) -> str:
        """Return the text of the policy file, with one line per state to read down the columns."""
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
            "actions": [action.label for action in self.actions],
            "values": {state.label: list(self.row(state)) for state in self.states},
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
        actions = _named_actions(document["actions"])
        if not isinstance(document["name"], str):
            raise ValueError(f"its name must be text, not {document['name']!r}")
        if not isinstance(document["training"], dict):
            raise ValueError(f"its training must say by name how it was made, not {document['training']!r}")
        values = _values(document["values"], actions)
        table = cls(document["name"], _gate(document["gate"]), values, document["training"], actions)
        # The hash comes last: a file whose shape is wrong deserves the better sentence.
        if document["sha256"] != table.sha256:
            raise ValueError("its sha256 does not fit its content, so it was changed after it was made")
        return table


def said_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Refuse a JSON object with two equal keys.

    JSON takes the last of two equal keys, a person who reads the file takes the first.
    """
    said: dict[str, Any] = {}
    for key, value in pairs:
        if key in said:
            raise ValueError(f"it says {key!r} twice")
        said[key] = value
    return said


def _hash(document: Mapping[str, Any]) -> str:
    canonical = json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(canonical.encode()).hexdigest()


def check_actions(actions: Sequence[ActionSpec]) -> tuple[ActionSpec, ...]:
    """Return a set of actions that a table can have; raises ValueError for any other."""
    labels = [action.label for action in actions]
    if labels[:1] != [NO_HELP.label] or len(set(labels)) < len(labels):
        raise ValueError(f"its actions are {labels}, but the first must be {NO_HELP.label!r}, and none may stand twice")
    if PRAISE in actions:
        raise ValueError(f"{PRAISE.label!r} comes after a pair was found, so a table cannot choose it before a flip")
    return tuple(actions)


def _named_actions(names: Any) -> tuple[ActionSpec, ...]:
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise ValueError(f"its actions must be a list of names, not {names!r}")
    try:
        return check_actions([find_action(name) for name in names])
    except UserInputError as error:
        raise ValueError(str(error)) from error


def _values(rows: Any, actions: tuple[ActionSpec, ...]) -> tuple[tuple[float, ...], ...]:
    if not isinstance(rows, dict):
        raise ValueError("its values are not given by state")
    states = states_with(actions)
    names = {state.label for state in states}
    for name in rows:
        if name not in names:
            raise ValueError(f"it names a state that does not exist: {name!r}")
    absent = [state.label for state in states if state.label not in rows]
    if absent:
        raise ValueError(f"its table has {len(rows)} states, not {len(states)}: {absent[0]!r} is missing")
    return tuple(_row(state, rows[state.label], actions) for state in states)


def _row(state: State, row: Any, actions: tuple[ActionSpec, ...]) -> tuple[float, ...]:
    if not isinstance(row, list) or len(row) != len(actions):
        raise ValueError(f"state {state.label!r} must have {len(actions)} values, one per action, not {row!r}")
    for action, value in zip(actions, row, strict=True):
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
