"""What the experimenter may do, as one table, deed x stage -> what comes of it and what is asked for; nothing else.

In the stage ``over`` nobody is there and nobody can begin: the calm screen is up.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType

from kiosk.study.condition import Condition
from kiosk.study.events import Stage


class Deed(Enum):
    """Something that the experimenter does, by a chord or in the panel."""

    PANEL = "panel"
    CONDITION = "condition"
    BODY = "body"
    AGAIN = "again"
    QUIET = "quiet"
    PAUSE = "pause"
    END = "end"
    NEXT = "next"
    RESUME = "resume"
    LANGUAGE = "language"
    VOLUME = "volume"
    BACKUP = "backup"
    LEAVE = "leave"


class Effect(Enum):
    """What comes of a deed."""

    NOW = "now"
    NEXT_SITTING = "next sitting"
    """The sitting that is under way goes on as it was."""
    REFUSED = "refused"


class Asks(Enum):
    """What is asked for before it is done; a panel that is open has asked for the PIN already."""

    NOTHING = "nothing"
    PIN = "PIN"
    PIN_AND_REASON = "PIN, reason"


class Reason(Enum):
    """Why the experimenter does it; ``OTHER`` goes with words of their own."""

    TECHNICAL = "technical problem"
    WISHED = "the visitor wishes it"
    DISTURBED = "disturbed"
    TEST = "test run"
    OTHER = "other"

    def in_own_words(self, typed: str) -> str:
        """The reason with words of the experimenter's own."""
        return f"{self.value}: {typed}"

    @staticmethod
    def without_words(reason: str) -> str:
        """A reason as the list has it, whatever was typed with it."""
        return next((each.value for each in Reason if reason.startswith(each.value)), Reason.OTHER.value)


@dataclass(frozen=True)
class Rule:
    """What holds for a deed in a stage."""

    effect: Effect
    asks: Asks = Asks.NOTHING


_REFUSED = Rule(Effect.REFUSED)
_SAID_AGAIN = (Stage.INTRODUCTION, Stage.PRACTICE, Stage.GAME, Stage.RESULT, Stage.THANKS)
"""Stages in which somebody speaks; until a sentence was said to its end, there is nothing to say again."""


def _rules(rest: Rule, visited: Rule, **others: Rule) -> Mapping[Stage, Rule]:
    """Rules without a visitor, with one, and in the stages of these names."""
    empty = (Stage.ATTRACT, Stage.OVER)
    usual = {stage: rest if stage in empty else visited for stage in Stage}
    return MappingProxyType(usual | {Stage(name): rule for name, rule in others.items()})


def _always(rule: Rule) -> Mapping[Stage, Rule]:
    return _rules(rule, rule)


_NOW = Rule(Effect.NOW)
_NOW_WITH_PIN = Rule(Effect.NOW, Asks.PIN)
_NOW_WITH_REASON = Rule(Effect.NOW, Asks.PIN_AND_REASON)
_LATER = Rule(Effect.NEXT_SITTING)
_LATER_WITH_REASON = Rule(Effect.NEXT_SITTING, Asks.PIN_AND_REASON)

TABLE: Mapping[Deed, Mapping[Stage, Rule]] = MappingProxyType(
    {
        Deed.PANEL: _always(_NOW_WITH_PIN),
        Deed.CONDITION: _always(_LATER_WITH_REASON),
        Deed.BODY: _always(_LATER_WITH_REASON),
        Deed.AGAIN: _rules(_REFUSED, _REFUSED, **{stage.value: _NOW for stage in _SAID_AGAIN}),
        Deed.QUIET: _always(_NOW),
        Deed.PAUSE: _rules(_REFUSED, _NOW),
        Deed.END: _rules(_REFUSED, _NOW_WITH_REASON),
        Deed.NEXT: _rules(_REFUSED, _NOW_WITH_REASON, thanks=_NOW, over=_NOW),
        Deed.RESUME: _rules(_REFUSED, _REFUSED, attract=_NOW_WITH_REASON),
        Deed.LANGUAGE: _rules(_NOW_WITH_REASON, _LATER_WITH_REASON),
        Deed.VOLUME: _rules(_NOW, _LATER),
        Deed.BACKUP: _rules(_NOW, _LATER),
        Deed.LEAVE: _rules(_NOW_WITH_PIN, _NOW_WITH_REASON),
    }
)


def rule(deed: Deed, stage: Stage) -> Rule:
    """What holds for this deed in this stage."""
    return TABLE[deed][stage]


def in_turn(quotas: Iterable[str]) -> tuple[Condition | None, ...]:
    """What the condition's chord goes through: the list's (None), conditions that have a quota, then the others."""
    wanted = set(quotas)
    with_quota = (condition for condition in Condition if condition.value in wanted)
    return (None, *with_quota, *(condition for condition in Condition if condition.value not in wanted))


def table_markdown() -> str:
    """The table for the manual: a row for each deed; stages that are alike in everything share a column."""
    columns: dict[tuple[Rule, ...], list[str]] = {}
    for stage in Stage:
        columns.setdefault(tuple(TABLE[deed][stage] for deed in Deed), []).append(stage.value)
    rows = [("", *(", ".join(stages) for stages in columns.values())), ("---",) * (len(columns) + 1)]
    rows += [(deed.value, *(_in_words(column[at]) for column in columns)) for at, deed in enumerate(Deed)]
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def _in_words(held: Rule) -> str:
    return held.effect.value if held.asks is Asks.NOTHING else f"{held.effect.value}: {held.asks.value}"
