"""Read frozen dataclasses from JSON values as they are nearly always written, several times as fast as in general."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields
from enum import Enum
from types import NoneType, UnionType
from typing import Any, TypeVar, get_args, get_type_hints

from kiosk.game import Position

_T = TypeVar("_T")

PLAIN = frozenset({int, str, bool, float, NoneType})
"""What JSON and Python write alike."""


class NotPlainError(ValueError):
    """Values that are not in the form that is read here; they may be right all the same."""


def plain_reader(
    kind: type[_T], converters: Mapping[Any, Callable[[Any], Any]], general: Callable[[Any], Callable[[Any, Any], Any]]
) -> Callable[[dict[str, Any]], _T] | None:
    """Return what makes an object of a dictionary, which it keeps; None for an unfit class.

    The dictionary has to hold every field in the declared order, each of exactly its kind, and NotPlainError is raised
    for any other. ``converters`` read fields that are not plain by their annotation; ``general`` finds what reads all
    others. Both raise what they like.
    """
    if hasattr(kind, "__post_init__") or not hasattr(kind, "__dict__") or "__slots__" in vars(kind):
        return None
    hints = get_type_hints(kind)
    annotations = {field.name: hints[field.name] for field in fields(kind)}  # type: ignore[arg-type]  # a dataclass
    names = list(annotations)
    plain = [_plain_types(annotation) for annotation in annotations.values()]
    others = [
        (name, converters.get(annotation) or _converter(annotation, general))
        for (name, annotation), types in zip(annotations.items(), plain, strict=True)
        if types is None
    ]
    known: set[tuple[object, ...]] = set()

    def read(values: dict[str, Any]) -> _T:
        form = (*values, *map(type, values.values()))
        if form not in known:
            types = tuple(map(type, values.values()))
            if list(values) != names:
                raise NotPlainError(names)
            if not all(allowed is None or found in allowed for found, allowed in zip(types, plain, strict=True)):
                raise NotPlainError(types)
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
    return types if types <= PLAIN else None


def _converter(annotation: Any, general: Callable[[Any], Callable[[Any, Any], Any]]) -> Callable[[Any], Any]:
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


def read_position(place: dict[str, int]) -> Position:
    """Return a place on the board; raises what it likes for anything but two whole numbers."""
    row, column = place["row"], place["column"]
    if len(place) != len(Position.__slots__) or type(row) is not int or type(column) is not int:
        raise NotPlainError(place)
    return Position(row, column)


def read_texts(values: list[str]) -> tuple[str, ...]:
    """Return a list of texts as a tuple; raises NotPlainError for anything else."""
    if type(values) is not list or not all(type(value) is str for value in values):
        raise NotPlainError(values)
    return tuple(values)


def by_name(closed_set: type[Enum]) -> Callable[[str], Enum]:
    """Return what finds a member of a closed set by its name in small letters."""
    return {member.name.lower(): member for member in closed_set}.__getitem__
