"""All the tables of a study's data set, in the order in which a reader meets them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from kiosk.store.dataset.column import Shape, Table
from kiosk.store.dataset.extras import Extra
from kiosk.store.dataset.stored.followed import Followed
from kiosk.store.dataset.stored.kept import Kept
from kiosk.store.dataset.tables.asked import SCORES, answers
from kiosk.store.dataset.tables.flow import Flow, flow
from kiosk.store.dataset.tables.hints import HINTS
from kiosk.store.dataset.tables.log import SENTENCES, events
from kiosk.store.dataset.tables.participants import participants, renamed
from kiosk.store.dataset.tables.play import CARDS, DECISIONS, FLIPS


@dataclass(frozen=True)
class Tables:
    """The tables that a sitting adds rows to, and the one of all sittings together."""

    sittings: tuple[Table[Kept, Any], ...]
    flow: Table[tuple[Flow, ...], Any]

    @property
    def shapes(self) -> tuple[Shape, ...]:
        """What every table looks like."""
        return (*(table.shape for table in self.sittings), self.flow.shape)

    def named(self, name: str) -> Table[Kept, Any]:
        """One of the tables that a sitting adds rows to."""
        return next(table for table in self.sittings if table.name == name)


def every(study: Followed, extras: frozenset[Extra]) -> Tables:
    """The tables of a study's data set."""
    others, whole = _others(extras), flow(extras)
    return Tables((participants(study, extras, _elsewhere(extras)), *others), whole)


def renamed_items(study: Followed) -> dict[str, str]:
    """The items about the visitor whose columns have another name, as it is that of a column of the program's own."""
    return renamed(study, _elsewhere(frozenset(Extra)))


def _others(extras: frozenset[Extra]) -> tuple[Table[Kept, Any], ...]:
    return FLIPS, HINTS, DECISIONS, CARDS, answers(extras), SCORES, SENTENCES, events(extras)


def _elsewhere(extras: frozenset[Extra]) -> frozenset[str]:
    """The columns of all tables but that of participants."""
    shapes = (*(table.shape for table in _others(extras)), flow(extras).shape)
    return frozenset(name for shape in shapes for name in shape.names)
