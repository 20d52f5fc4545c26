"""The learning layer at work: a frozen Q-table, read from a policy file and never changed.

A policy file is JSON that a person can read: the gate the table was trained behind, how it was made, one line of
values per state, and a sha256 over all of that. Whatever is wrong with a file is said in one sentence.
"""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Self

from kiosk import BadInput
from kiosk.assistant.gate import Gate
from kiosk.assistant.mdp import STATES, Action, State
from kiosk.settings import policy_path

FORMAT = "recollect-policy-1"
NONE = "none"
"""The name of no policy at all."""
DECIMALS = 6
"""Values are frozen to this many decimals: readable, and the same to the last digit on every machine."""

_ACTIONS = [action.label for action in Action]
_KEYS = {"format", "name", "gate", "training", "actions", "values", "sha256"}
_LARGEST = sys.float_info.max


class PolicyError(BadInput):
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
