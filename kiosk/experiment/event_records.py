"""Write events as JSON values and read them again, as the database keeps them.

Events in the form in which they are nearly always written are read several times as fast as in general.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields as fields_of
from enum import Enum
from functools import cache
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Any, TypeVar, get_args, get_type_hints

from kiosk import UserInputError
from kiosk.assistance.policy import ActionSpec, GateDecision, MoveOutcome, Phase, find_action
from kiosk.experiment.events import Event
from kiosk.experiment.items import NOT_APPLICABLE, NotApplicable, Response
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.game import Position

if TYPE_CHECKING:
    from cattrs import Converter

_T = TypeVar("_T")

_NOT_APPLICABLE_RECORD = {NOT_APPLICABLE.value: True}
"""What stands for an item that does not apply: neither a number nor a text, so nothing reads it as an answer."""


def _response(value: object, _: object) -> Response | None:
    """Return a response as it was written; raises ValueError for anything else."""
    if value == _NOT_APPLICABLE_RECORD:
        return NOT_APPLICABLE
    match value:
        case bool():
            raise ValueError(f"{value} is no answer")
        case None | int() | str():
            return value
        case list() | tuple() if all(isinstance(option, str) for option in value):
            return tuple(value)
    raise ValueError(f"{value!r} is no answer")


def _action(name: str) -> ActionSpec:
    """Return the action of a record."""
    try:
        return find_action(name)
    except UserInputError as error:
        raise ValueError(str(error)) from error


@cache
def _converter(*, explaining: bool = False) -> Converter:
    """Return a converter to and from JSON values in which every closed set goes by name.

    One that explains what is wrong in a record takes three times as long.
    """
    from cattrs import Converter  # noqa: PLC0415 - the start screen reads and writes no event

    converter = Converter(forbid_extra_keys=True, detailed_validation=explaining)
    converter.register_structure_hook(Response | None, _response)
    converter.register_unstructure_hook(NotApplicable, lambda _: dict(_NOT_APPLICABLE_RECORD))
    converter.register_unstructure_hook(EmbodimentName, str)
    converter.register_structure_hook(EmbodimentName, lambda text, _: EmbodimentName.from_text(text))
    converter.register_unstructure_hook(ActionSpec, lambda action: action.label)
    converter.register_structure_hook(ActionSpec, lambda name, _: _action(name))
    for closed_set in (Phase, MoveOutcome, GateDecision):
        # Their values count rows and columns of a table, or explain; in the records they go by name.
        converter.register_unstructure_hook(closed_set, lambda member: member.name.lower())
        converter.register_structure_hook(closed_set, lambda name, enum: enum[name.upper()])
    return converter


@cache
def event_kinds() -> Mapping[str, type[Event]]:
    """Return every class of event that has none below it, by its name."""
    found: dict[str, type[Event]] = {}
    above: list[type[Event]] = [Event]
    while above:
        below = above.pop().__subclasses__()
        above += below
        found |= {kind.__name__: kind for kind in below if not kind.__subclasses__()}
    return found


def to_record(event: Event) -> dict[str, Any]:
    """Return an event as JSON values: its class under ``type``, its fields under their names."""
    # The converter makes what writes a kind of event when the first one comes, as no session has them all.
    record: dict[str, Any] = _converter().get_unstructure_hook(type(event))(event)
    record["type"] = type(event).__name__
    return record


def from_record(record: Mapping[str, Any]) -> Event:
    """Return the event that ``to_record`` wrote; raises ValueError, saying where, for anything else."""
    fields = dict(record)
    return _read(fields.pop("type", ""), fields)


def from_fields(kind: str, at_ms: int, fields: Mapping[str, Any]) -> Event:
    """Return the event of a kind with these fields beside its time; raises ValueError as ``from_record`` does."""
    return _read(kind, {"at_ms": at_ms, **fields})


def _read(name: str, fields: dict[str, Any]) -> Event:
    kind, read = _kind_to_read(name)
    try:
        if read is not None:
            return read(fields)
    except Exception:  # noqa: BLE001, S110 - what is not written as ever may be right, and is read in general
        pass
    try:
        event: Event = _converter().get_structure_hook(kind)(fields, kind)
    except Exception:  # noqa: BLE001 - anything can be wrong in a record; the other converter finds out what
        event = _explained(fields, kind)
    return event


_PLAIN = frozenset({int, str, bool, float, NoneType})
"""What JSON and Python write alike."""


class _NotPlainError(ValueError):
    """Values that are not in the form that is read here; they may be right all the same."""


def _plain_reader(
    kind: type[_T], converters: Mapping[Any, Callable[[Any], Any]], general: Callable[[Any], Callable[[Any, Any], Any]]
) -> Callable[[dict[str, Any]], _T] | None:
    """Return what makes an object of a dictionary, which it keeps; None for an unfit class.

    The dictionary has to hold every field in the declared order, each of exactly its kind, and _NotPlainError is raised
    for any other. ``converters`` read fields that are not plain by their annotation; ``general`` finds what reads all
    others. Both raise what they like.
    """
    if hasattr(kind, "__post_init__") or not hasattr(kind, "__dict__") or "__slots__" in vars(kind):
        return None
    hints = get_type_hints(kind)
    annotations = {field.name: hints[field.name] for field in fields_of(kind)}  # type: ignore[arg-type]  # a dataclass
    names = list(annotations)
    plain = [_plain_types(annotation) for annotation in annotations.values()]
    others = [
        (name, converters.get(annotation) or _field_reader(annotation, general))
        for (name, annotation), types in zip(annotations.items(), plain, strict=True)
        if types is None
    ]
    known: set[tuple[object, ...]] = set()

    def read(values: dict[str, Any]) -> _T:
        form = (*values, *map(type, values.values()))
        if form not in known:
            types = tuple(map(type, values.values()))
            if list(values) != names:
                raise _NotPlainError(names)
            if not all(allowed is None or found in allowed for found, allowed in zip(types, plain, strict=True)):
                raise _NotPlainError(types)
            known.add(form)
        if others:
            values.update([(name, convert(values[name])) for name, convert in others])
        made = object.__new__(kind)
        # A frozen class sets every field by a call of its own, which is most of what making an object costs.
        object.__setattr__(made, "__dict__", values)
        return made

    return read


def _plain_types(annotation: Any) -> frozenset[type] | None:
    """Return the types that a field may have as they are; None if its values have to be converted."""
    types = frozenset(get_args(annotation)) if isinstance(annotation, UnionType) else frozenset({annotation})
    return types if types <= _PLAIN else None


def _field_reader(annotation: Any, general: Callable[[Any], Callable[[Any, Any], Any]]) -> Callable[[Any], Any]:
    """Return what reads a field of a closed set, and of anything else the general way."""
    *types, last = get_args(annotation) if isinstance(annotation, UnionType) else (annotation,)
    if isinstance(last, type) and last is NoneType and len(types) == 1:
        one, empty = types[0], {None: None}
    else:
        one, empty = annotation, {}
    if isinstance(one, type) and issubclass(one, Enum):
        return {**empty, **{member.value: member for member in one}}.__getitem__
    structure = general(annotation)
    return lambda value: structure(value, annotation)


def _read_position(place: dict[str, int]) -> Position:
    """Return a place on the board; raises what it likes for anything but two whole numbers."""
    row, column = place["row"], place["column"]
    if len(place) != len(Position.__slots__) or type(row) is not int or type(column) is not int:
        raise _NotPlainError(place)
    return Position(row, column)


def _read_texts(values: list[str]) -> tuple[str, ...]:
    """Return a list of texts as a tuple; raises _NotPlainError for anything else."""
    if type(values) is not list or not all(type(value) is str for value in values):
        raise _NotPlainError(values)
    return tuple(values)


def _by_name(closed_set: type[Enum]) -> Callable[[str], Enum]:
    """Return what finds a member of a closed set by its name in small letters."""
    return {member.name.lower(): member for member in closed_set}.__getitem__


@cache
def _kind_to_read(name: str) -> tuple[type[Event], Callable[[dict[str, Any]], Event] | None]:
    """Return a kind and what reads it fast, if anything does; raises ValueError if there is none of that name."""
    kind = event_kinds().get(name)
    if kind is None:
        raise ValueError(f"event: there is no event {name!r}")
    return kind, _plain_reader(kind, _CONVERTERS, _converter().get_structure_hook)


_TRACE = tuple[tuple[int, float, float], ...]


def _trace(places: list[Any]) -> tuple[tuple[int, float, float], ...]:
    read: tuple[tuple[int, float, float], ...] = _converter().structure(places, _TRACE) if places else ()
    return read


_CONVERTERS: Mapping[Any, Callable[[Any], Any]] = {
    Position: _read_position,
    ActionSpec: _action,
    EmbodimentName: EmbodimentName.from_text,
    Response | None: lambda value: _response(value, None),
    tuple[str, ...]: _read_texts,
    _TRACE: _trace,
    **{closed_set: _by_name(closed_set) for closed_set in (Phase, MoveOutcome, GateDecision)},
}
"""How the fields are read that are not written as they are."""


def _explained(fields: dict[str, Any], kind: type[Event]) -> Event:
    """Read an event once more; raises ValueError, saying what is wrong with it."""
    from cattrs import BaseValidationError, transform_error  # noqa: PLC0415 - as above

    try:
        return _converter(explaining=True).structure(fields, kind)
    except (BaseValidationError, KeyError) as error:
        raise ValueError("; ".join(transform_error(error, path="event"))) from error
