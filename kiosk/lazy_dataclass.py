"""Dataclasses whose methods are written when one is first used.

The standard decorator compiles up to six methods for each class as the program is loaded. A kiosk loads three hundred
such classes before anyone can touch it, and uses few of them by then. Type checkers see the standard decorator.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

_T = TypeVar("_T")

if TYPE_CHECKING:
    from dataclasses import dataclass
else:
    from dataclasses import MISSING, FrozenInstanceError, field, fields, make_dataclass
    from dataclasses import dataclass as standard_dataclass

    def dataclass(cls=None, /, *, frozen=False, kw_only=False, slots=False):
        """Make a dataclass, as the standard decorator does with the same options."""
        if cls is None:
            return lambda decorated: dataclass(decorated, frozen=frozen, kw_only=kw_only, slots=slots)
        own = {"__init__", "__repr__", "__eq__", "__hash__"} & vars(cls).keys()
        if "__eq__" in own and vars(cls).get("__hash__") is None:
            # Python itself has said so, because of the other.
            own -= {"__hash__"}
        made = standard_dataclass(init=False, repr=False, eq=False, kw_only=kw_only, slots=slots)(cls)
        written = _Written(made, frozen=frozen)
        for name in {"__init__", "__repr__", "__eq__"} - own:
            setattr(made, name, _Method(written, name))
        if "__hash__" not in own:
            made.__hash__ = _Method(written, "__hash__") if frozen else None
        if frozen:
            made.__setattr__ = _refuse_to_assign
            made.__delattr__ = _refuse_to_delete
            if slots:
                made.__getstate__ = _state
                made.__setstate__ = _restore
        return made

    class _Written:
        """The methods of one class: what makes it is written at its first call, and the others at theirs."""

        def __init__(self, made, *, frozen):
            self._made = made
            self._frozen = frozen

        def write(self, name):
            """Put what the standard decorator writes for the same fields onto the class."""
            first = name == "__init__"
            namespace = {"__doc__": "Stands in."}
            if hasattr(self._made, "__post_init__"):
                namespace["__post_init__"] = None
            twin = make_dataclass(
                self._made.__qualname__,
                [(each.name, each.type, _again(each)) for each in fields(self._made)],
                namespace=namespace,
                init=first,
                repr=not first,
                eq=not first,
                unsafe_hash=self._frozen and not first,
                frozen=self._frozen and first,
            )
            for each, waiting in list(vars(self._made).items()):
                if isinstance(waiting, _Method) and (each == "__init__") == first:
                    setattr(self._made, each, vars(twin)[each])

    class _Method:
        """Stands for a method until it is looked up."""

        def __init__(self, written, name):
            self._written = written
            self._name = name

        def __get__(self, instance, owner=None):
            self._written.write(self._name)
            return vars(self._written._made)[self._name].__get__(instance, owner)

    def _again(given):
        """Return what a class says of a field, to say it once more."""
        default = {
            name: getattr(given, name) for name in ("default", "default_factory") if getattr(given, name) is not MISSING
        }
        options = ("init", "repr", "hash", "compare", "metadata", "kw_only")
        return field(**default, **{name: getattr(given, name) for name in options})

    def _refuse_to_assign(_, name, __):
        raise FrozenInstanceError(f"cannot assign to field {name!r}")

    def _refuse_to_delete(_, name):
        raise FrozenInstanceError(f"cannot delete field {name!r}")

    def _state(self):
        return [getattr(self, each.name) for each in fields(self)]

    def _restore(self, state):
        for each, value in zip(fields(self), state, strict=True):
            object.__setattr__(self, each.name, value)


def with_values(one: _T, **changes: object) -> _T:
    """Return an object with other values, as ``dataclasses.replace`` does in three times the time.

    It is for classes without slots and without ``__post_init__``.
    """
    made = object.__new__(type(one))
    object.__setattr__(made, "__dict__", {**vars(one), **changes})
    return made


__all__ = ["dataclass", "with_values"]
