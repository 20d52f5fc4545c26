"""Turn validation errors of study files and forms into sentences for people."""

from __future__ import annotations

import re
import reprlib
import tomllib
from collections.abc import Collection, Iterator, Mapping, Sequence
from enum import Enum
from functools import lru_cache
from numbers import Integral, Real
from typing import Annotated, Any, TypeVar, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from kiosk import UserInputError
from kiosk.units import Unit

KIND = "kind"
"""The key by which the tables of one list are told apart."""

_MUST: Mapping[str, str] = {
    "int_type": "must be a whole number",
    "float_type": "must be a number",
    "string_type": "must be text in quotes",
    "bool_type": "must be true or false",
    "tuple_type": "must be a list in square brackets",
    "model_type": "must be a table with keys of its own",
    "model_attributes_type": "must be a table with keys of its own",
    "dict_type": "must be a table in braces",
    "finite_number": "must be a number",
    "literal_error": "must be {expected}",
    "enum": "must be {expected}",
}
"""What a value must be, by pydantic's type of error; what it is comes after it."""

_TELLS: Mapping[str, str] = {
    "string_too_short": "must not be empty",
    "string_too_long": "must have at most {max_length} characters",
    "union_tag_not_found": f"the key {KIND!r} is missing",
    "union_tag_invalid": f"{KIND} must be one of {{expected_tags}}, but it is {{tag!r}}",
    "value_error": "{error}",
}
"""What says all there is to say."""

_OUT_OF_BOUNDS = frozenset({"greater_than", "greater_than_equal", "less_than_equal", "finite_number"})

_SAID_OF_WHAT_IS_ABOVE = frozenset({"missing", "extra_forbidden"})
"""Errors about the table that lacks a key or has one too many."""


_NOT_TOML: Mapping[str, str] = {
    "Invalid value": "this is no value; text stands in quotes, and true and false are written small",
    "Cannot overwrite a value": "a key is there twice",
    "Unescaped": "a \\ has no place in a text in double quotes; write paths with /",
}
"""How tomllib's shortest messages begin, and what they mean."""


def toml_error_message(error: Exception) -> str:
    """Why a text is no TOML, and where."""
    if isinstance(error, RecursionError):
        return "brackets stand in brackets too often"
    said = str(error)
    _, bracket, place = said.rpartition(" (")
    if twice := re.match(r"Cannot declare \((.+?),?\) twice", said):
        section = ".".join(re.split("', '", twice[1].strip("'")))
        return f"the section [{section}] is there twice; put all of its keys under one of them{bracket}{place}"
    meant = next((words for begins, words in _NOT_TOML.items() if said.startswith(begins)), None)
    return f"{meant}{bracket}{place}" if meant else said


Steps = tuple[int | str, ...]
"""The way to a value: names of tables and keys, and for an entry of a list its number from 0."""

_LONGEST_VALUE = 300
_LONGEST_TEXT = 100_000
"""Lines of a value and characters of a file; where there are more, the sentences name the key and no line."""


def toml_line(text: str, key: Sequence[int | str]) -> int | None:
    """Return the line of a TOML text, counted from 1, in which a key begins.

    If the key is not there, it is the line of its table. It is None if not even its first table is there. Steps
    that the text does not have, such as pydantic's names of kinds, are passed over.
    """
    lines = toml_lines(text)
    here: Steps = ()
    for step in key:
        here = (*here, step) if (*here, step) in lines else here
    return lines.get(here)


@lru_cache(maxsize=4)
def toml_lines(text: str) -> Mapping[Steps, int]:
    """Map every key of a TOML text to the line in which it begins."""
    found: dict[Steps, int] = {}
    tables: dict[Steps, int] = {}
    here: Steps = ()
    lines, at = text.splitlines(keepends=True) if len(text) <= _LONGEST_TEXT else [], 0
    while at < len(lines):
        ends = range(at + 1, min(at + _LONGEST_VALUE, len(lines)) + 1)
        end, given = next(((end, got) for end in ends if (got := _parsed(lines[at:end])) is not None), (at, None))
        if given is None:
            return found
        if lines[at].lstrip().startswith("["):
            here = _table(given, tables)
            _note(found, here, at + 1)
        elif given:
            _note(found, here, at + 1)
            _note_all(found, here, given, at + 1)
        at = end
    return found


def _table(header: Mapping[str, Any], tables: dict[Steps, int]) -> Steps:
    """Return the way to the table that a line such as [a.b] or [[a]] begins; ``tables`` counts those of lists."""
    steps: Steps = ()
    inside: Any = header
    while inside:
        (name, inside), *_ = inside.items()
        steps = (*steps, name)
        if isinstance(inside, list):
            tables[steps] = tables.get(steps, -1) + 1
            inside = inside[0]
        if steps in tables:
            steps = (*steps, tables[steps])
    return steps


def control_characters(given: object, text: str) -> Iterator[str]:
    """Yield a sentence for every key and value that holds a character which can be neither seen nor stored."""
    waiting: list[tuple[Steps, object]] = [((), given)]
    while waiting:
        steps, value = waiting.pop()
        if isinstance(value, dict):
            for key in value:
                if unseen := control_character(key):
                    yield f"a key {_HOLDS.format(code_point(unseen))}{at_line(text, (*steps, key))}"
            waiting += [((*steps, key), each) for key, each in reversed(value.items())]
        elif isinstance(value, list):
            waiting += [((*steps, number), each) for number, each in reversed(list(enumerate(value)))]
        elif isinstance(value, str) and (unseen := control_character(value)):
            yield f"{_place(steps, given, names_kinds=False)} {_HOLDS.format(code_point(unseen))}{at_line(text, steps)}"


_HOLDS = "has the control character {}; take it out"


def control_character(text: str) -> re.Match[str] | None:
    """Find the first control character of a text that is no tab and ends no line."""
    return _CONTROL.search(text)


def code_point(found: re.Match[str]) -> str:
    """Return how Unicode numbers a character, such as U+001B."""
    return f"U+{ord(found[0]):04X}"


_CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f]")


def _note(found: dict[Steps, int], steps: Steps, line: int) -> None:
    for length in range(1, len(steps) + 1):
        found.setdefault(steps[:length], line)


def _note_all(found: dict[Steps, int], here: Steps, value: Any, line: int) -> None:
    if here:
        found.setdefault(here, line)
    if isinstance(value, dict | list):
        inside = value.items() if isinstance(value, dict) else enumerate(value)
        for step, each in inside:
            _note_all(found, (*here, step), each, line)


def _parsed(lines: Sequence[str]) -> dict[str, Any] | None:
    try:
        return tomllib.loads("".join(lines))
    except (ValueError, RecursionError):
        return None


def at_line(text: str, key: Sequence[int | str]) -> str:
    """Return words for the line of a TOML text in which a key begins; empty without it."""
    line = toml_line(text, key) if text else None
    return "" if line is None else f" (line {line})"


def validation_messages(error: ValidationError, given: Any, model: type[BaseModel], text: str = "") -> tuple[str, ...]:
    """Return a sentence for each fault that was found when ``given`` was to become a ``model``, in the file's order.

    With the TOML text of the file, each ends with the line.
    """
    found = validation_errors(error)
    said: dict[str, None] = {}
    for fault in found[:_MOST_SENTENCES]:
        sentence = _sentence(fault, given, model)
        # What is wrong between sections has no place of its own, but its sentence begins with a key.
        key = fault["loc"] or tuple(sentence.partition(":")[0].split("."))
        said[f"{sentence}{at_line(text, key)}"] = None
    more = len(found) - _MOST_SENTENCES
    return (*said, *((f"{more} more things are wrong",) if more > 0 else ()))


_MOST_SENTENCES = 100
"""A file with more faults than this is none of its kind; the sentences would take long, and tell no more."""


def validation_errors(error: ValidationError) -> tuple[ErrorDetails, ...]:
    """Return what pydantic found, but for lists that are too short only because something in them is wrong."""
    found = error.errors()
    places = {fault["loc"] for fault in found}
    return tuple(fault for fault in found if fault["type"] != "too_short" or not _holds(fault["loc"], places))


def _holds(here: tuple[int | str, ...], places: Collection[tuple[int | str, ...]]) -> bool:
    return any(len(place) > len(here) and place[: len(here)] == here for place in places)


def _sentence(fault: ErrorDetails, given: Any, model: type[BaseModel]) -> str:
    place = _place(fault["loc"][:-1] if fault["type"] in _SAID_OF_WHAT_IS_ABOVE else fault["loc"], given)
    what = error_message(fault, model)
    between = " " if what.startswith("must ") else ": "
    return f"{place}{between}{what}" if place else what


def error_message(fault: ErrorDetails, model: type[BaseModel]) -> str:
    """Return what is wrong, without where."""
    context = fault.get("ctx", {})
    match fault["type"]:
        case "missing":
            return _missing(fault)
        case "extra_forbidden":
            *table, key = fault["loc"]
            return f"there is no key {toml_value(key)}{_meant(str(key), _keys(model, table))}"
        case "too_short" | "too_long":
            return f"must have {_entries(context)}, but it has {len(fault['input'])}"
        case kind if kind in _OUT_OF_BOUNDS and (range_ := bounds(_declared(model, fault["loc"]))):
            return f"must be {range_}, but it is {toml_value(fault['input'])}"
        case kind if kind in _TELLS:
            return _TELLS[kind].format(**context)
        case kind:
            says = _MUST.get(kind, fault["msg"].removeprefix("Input ").replace("should", "must"))
            return f"{says.format(**context)}, but it is {toml_value(fault['input'])}"


def _missing(fault: ErrorDetails) -> str:
    """Return a key that is missing, or an entry of a list that has to have so many."""
    last = fault["loc"][-1]
    if isinstance(last, int):
        return f"must have at least {last + 1} entries, but it has {len(fault['input'])}"
    return f"the key {last!r} is missing"


def _entries(context: Mapping[str, Any]) -> str:
    side, bound = ("least", context["min_length"]) if "min_length" in context else ("most", context["max_length"])
    return f"at {side} {bound} {'entry' if bound == 1 else 'entries'}"


_COMPARED = 40


def _meant(key: str, keys: Sequence[str]) -> str:
    from difflib import get_close_matches  # noqa: PLC0415 - only a mistake needs it

    close = get_close_matches(key[:_COMPARED], keys, n=1)
    if close:
        return f"; did you mean {close[0]!r}?"
    return f"; there are {', '.join(keys)}" if keys else ""


def bounds(metadata: Sequence[Any]) -> str:
    """Describe the bounds of a number with its unit; empty without bounds.

    An example is "from 80 to 300 words per minute".
    """
    ends = {end: getattr(each, end) for each in metadata for end in ("ge", "gt", "le") if hasattr(each, end)}
    least, most = ends.get("ge", ends.get("gt")), ends.get("le")
    unit = "".join(f" {each.name}" for each in metadata if isinstance(each, Unit))
    if least is None and most is None:
        return ""
    if most is None:
        return f"{'at least' if 'ge' in ends else 'more than'} {least}{unit}"
    return f"at most {most}{unit}" if least is None else f"from {least} to {most}{unit}"


def _declared(model: type[BaseModel], place: Sequence[int | str]) -> list[Any]:
    """List what is declared of the value at a place, such as its bounds and its unit."""
    here: list[tuple[Any, list[Any]]] = [(model, [])]
    for step in place:
        here = [each for annotation, _ in here for each in _inside(annotation, step)]
    return next((metadata for _, metadata in here if metadata), [])


def _inside(annotation: Any, step: int | str) -> Iterator[tuple[Any, list[Any]]]:
    """Yield what stands at one step inside of a type, with what is declared of it."""
    origin, of = get_origin(annotation), get_args(annotation)
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        if step in annotation.model_fields:
            field = annotation.model_fields[str(step)]
            yield from _plain(field.annotation, field.metadata)
        elif KIND in annotation.model_fields and step in _kinds(annotation):
            yield annotation, []
    elif origin in {tuple, list} and isinstance(step, int):
        yield from _plain(of[0 if of[-1] is Ellipsis else min(step, len(of) - 1)], [])
    elif origin is dict:
        yield from _plain(of[1], [])
    else:
        yield from (found for each in of for found in _inside(each, step))


def _plain(annotation: Any, metadata: Sequence[Any]) -> Iterator[tuple[Any, list[Any]]]:
    """Yield a type without what is declared of it, and that beside it; each type of a union by itself."""
    if get_origin(annotation) is Annotated:
        inner, *more = get_args(annotation)
        flat = [each for one in more for each in (one.metadata if isinstance(one, FieldInfo) else [one])]
        yield from _plain(inner, [*metadata, *flat])
    else:
        yield annotation, list(metadata)


def shortened(digits: re.Match[str]) -> str:
    """Cut a number of very many digits short, and keep it far too large."""
    return digits[0].replace("_", "")[:_SHORT_DIGITS]


_SHORT_DIGITS, _SHOWN_DIGITS = 60, 12


class _Short(reprlib.Repr):
    """Cuts long values short; Python refuses to write whole numbers of more than 4,300 digits at all."""

    def repr_int(self, x: int, level: int) -> str:  # noqa: ARG002 - reprlib's signature
        if abs(x) < 10 ** (2 * _SHOWN_DIGITS):
            return str(x)
        return f"{(str if abs(x) < 10**_SHORT_DIGITS else hex)(x)[:_SHOWN_DIGITS]}..."


_SHORT = _Short()


def toml_value(value: object) -> str:
    """Return a value as a TOML file writes it, cut short if it is long."""
    if isinstance(value, bool):
        return str(value).lower()
    return "a table" if isinstance(value, dict) else _SHORT.repr(value)


def _place(steps: Sequence[int | str], given: Any, *, names_kinds: bool = True) -> str:
    """Return a place as the file has it: ``game.rows``, or ``item 2 (SOC2), option 1 (no): text.en``.

    ``names_kinds``: the steps are pydantic's, which name the kind of a table too.
    """
    entries: list[str] = []
    keys: list[str] = []
    here = given
    for at, step in enumerate(steps):
        if isinstance(step, int):
            here = here[step] if isinstance(here, list) and step < len(here) else None
            *above, name = keys or ["entry"]
            entries.append(".".join((*above, _entry(name, step + 1, here))))
            keys = []
        elif names_kinds and not keys and isinstance(here, dict) and here.get(KIND) == step and _is_entry(steps, at):
            # Pydantic names the kind of a table as a step; what all of a kind share stands under that name itself.
            key = steps[at + 1] if at + 1 < len(steps) else None
            if key not in here and isinstance(given.get(step), dict) and key in given[step]:
                entries, keys, here = [], [step], given[step]
        else:
            keys.append(_shown(step))
            here = here.get(step) if isinstance(here, dict) else None
    return ": ".join(part for part in (", ".join(entries), ".".join(keys)) if part)


def _shown(name: str) -> str:
    """Return a name, cut short if no file that is meant has it."""
    return name if len(name) <= _LONGEST_NAME else f"{name[:_COMPARED]}..."


_LONGEST_NAME = 80


def _is_entry(steps: Sequence[int | str], at: int) -> bool:
    return at > 0 and isinstance(steps[at - 1], int)


def _entry(name: str, number: int, entry: Any) -> str:
    named = f" ({_shown(entry['id'])})" if isinstance(entry, dict) and isinstance(entry.get("id"), str) else ""
    singular = name.removesuffix("s")
    return f"{singular} {number}{named}" if singular != name else f"{name}, number {number}{named}"


def _keys(model: type[BaseModel], place: Sequence[int | str]) -> tuple[str, ...]:
    """Return the keys of the table at a place; none if more than one table fits."""
    models: tuple[type[BaseModel], ...] = (model,)
    for step in place:
        if isinstance(step, int):
            continue
        of_kind = tuple(each for each in models if KIND in each.model_fields and step in _kinds(each))
        fields = (each.model_fields[step].annotation for each in models if step in each.model_fields)
        models = of_kind or tuple(found for field in fields for found in _models(field))
    return tuple(models[0].model_fields) if len(models) == 1 else ()


def _kinds(model: type[BaseModel]) -> tuple[Any, ...]:
    return get_args(model.model_fields[KIND].annotation)


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    """Every model in a type, however deep."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _models(part)


Member = TypeVar("Member", bound=Enum)


def check_between(name: str, value: object, low: float, high: float) -> None:
    """Refuse everything that is not a number from ``low`` to ``high``, such as NaN or a text."""
    # Python takes booleans for the numbers 0 and 1; as an argument one is a mistake of the caller's.
    number = isinstance(value, Real) and not isinstance(value, bool)
    if not number or not low <= float(value) <= high:  # type: ignore[arg-type]  # a number has a float
        shown = f"{value:g}" if number else repr(value)
        raise UserInputError(f"{name} must be a number from {low:g} to {high:g}, not {shown}")


def whole(name: str, value: object) -> int:
    """Return a whole number of any type as Python's own; refuse everything else, such as 2.0 and True."""
    if isinstance(value, Integral) and not isinstance(value, bool):
        return int(value)
    raise UserInputError(f"{name} must be a whole number, not {value!r}")


def one_of(name: str, value: object, kind: type[Member]) -> Member:
    """Return a member of ``kind``; refuse everything else, also the text that stands for a member in a file."""
    if isinstance(value, kind):
        return value
    raise UserInputError(f"{name} must be one of {', '.join(map(str, kind))}, not {value!r}")
