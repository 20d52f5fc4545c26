"""Write events as JSON values and read them again, as the database keeps them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

from kiosk import UserInputError
from kiosk.assistance.policy import ActionSpec, GateDecision, MoveOutcome, Phase, find_action
from kiosk.experiment.embodiment_name import EmbodimentName
from kiosk.experiment.events import Event
from kiosk.experiment.items import NOT_APPLICABLE, NotApplicable, Response
from kiosk.experiment.plain_reading import by_name, plain_reader, read_position, read_texts
from kiosk.game import Position

if TYPE_CHECKING:
    from cattrs import Converter

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


@cache
def _kind_to_read(name: str) -> tuple[type[Event], Callable[[dict[str, Any]], Event] | None]:
    """Return a kind and what reads it fast, if anything does; raises ValueError if there is none of that name."""
    kind = event_kinds().get(name)
    if kind is None:
        raise ValueError(f"event: there is no event {name!r}")
    return kind, plain_reader(kind, _CONVERTERS, _converter().get_structure_hook)


_TRACE = tuple[tuple[int, float, float], ...]


def _trace(places: list[Any]) -> tuple[tuple[int, float, float], ...]:
    read: tuple[tuple[int, float, float], ...] = _converter().structure(places, _TRACE) if places else ()
    return read


_CONVERTERS: Mapping[Any, Callable[[Any], Any]] = {
    Position: read_position,
    ActionSpec: _action,
    EmbodimentName: EmbodimentName.from_text,
    Response | None: lambda value: _response(value, None),
    tuple[str, ...]: read_texts,
    _TRACE: _trace,
    **{closed_set: by_name(closed_set) for closed_set in (Phase, MoveOutcome, GateDecision)},
}
"""How the fields are read that are not written as they are."""


def _explained(fields: dict[str, Any], kind: type[Event]) -> Event:
    """Read an event once more; raises ValueError, saying what is wrong with it."""
    from cattrs import BaseValidationError, transform_error  # noqa: PLC0415 - as above

    try:
        return _converter(explaining=True).structure(fields, kind)
    except (BaseValidationError, KeyError) as error:
        raise ValueError("; ".join(transform_error(error, path="event"))) from error
