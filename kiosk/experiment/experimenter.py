"""What experimenters may do: actions, their shortcuts, the PIN and the audit events."""

from __future__ import annotations

import hashlib
import hmac
import re
from collections.abc import Iterable, Mapping
from enum import Enum
from itertools import pairwise
from types import MappingProxyType

from kiosk import UserInputError
from kiosk.config import Keys
from kiosk.experiment.condition import Condition, in_design_order
from kiosk.experiment.outcomes import Stage
from kiosk.lazy_dataclass import dataclass


class Action(Enum):
    """Something that the experimenter does, by a shortcut or in the panel."""

    PANEL = "panel"
    CONDITION = "condition"
    EMBODIMENT = "embodiment"
    REPEAT = "repeat"
    MUTE = "mute"
    PAUSE = "pause"
    BREAK = "break"
    ABORT = "abort"
    NEXT = "next"
    RESUME = "resume"
    LANGUAGE = "language"
    VOLUME = "volume"
    BACKUP = "backup"
    TEST_VOICE = "test_voice"
    QUIT = "quit"


class ActionEffect(Enum):
    """What comes of an action."""

    NOW = "now"
    NEXT_SESSION = "next session"
    """The session that is under way goes on as it was."""
    REFUSED = "refused"


class Authorisation(Enum):
    """What is asked for before it is done; a panel that is open has asked for the PIN already."""

    NOTHING = "nothing"
    PIN = "PIN"
    PIN_AND_REASON = "PIN, reason"


class DeviationReason(Enum):
    """Why the experimenter does it; ``OTHER`` goes with words of their own."""

    TECHNICAL = "technical problem"
    WISHED = "the visitor wishes it"
    DISTURBED = "disturbed"
    TEST = "test run"
    OTHER = "other"

    def in_own_words(self, typed: str) -> str:
        """Return the reason with words of the experimenter's own."""
        return f"{self.value}: {typed}"

    @staticmethod
    def without_words(reason: str) -> str:
        """Return a reason as the list has it, whatever was typed with it."""
        return next(
            (each.value for each in DeviationReason if reason.startswith(each.value)), DeviationReason.OTHER.value
        )


@dataclass(frozen=True)
class Permission:
    """What holds for an action in a stage."""

    effect: ActionEffect
    asks: Authorisation = Authorisation.NOTHING


_REFUSED = Permission(ActionEffect.REFUSED)
_SAID_AGAIN = (Stage.INTRODUCTION, Stage.PRACTICE, Stage.GAME, Stage.RESULT, Stage.THANKS)
"""Stages with speech; until a sentence was said to its end, there is nothing to say again."""


def _rules(rest: Permission, visited: Permission, **others: Permission) -> Mapping[Stage, Permission]:
    """Rules without a visitor, with one, and in the stages of these names."""
    empty = (Stage.ATTRACT, Stage.OVER)
    usual = {stage: rest if stage in empty else visited for stage in Stage}
    return MappingProxyType(usual | {Stage(name): rule for name, rule in others.items()})


def _always(rule: Permission) -> Mapping[Stage, Permission]:
    return _rules(rule, rule)


_NOW = Permission(ActionEffect.NOW)
_NOW_WITH_PIN = Permission(ActionEffect.NOW, Authorisation.PIN)
_NOW_WITH_REASON = Permission(ActionEffect.NOW, Authorisation.PIN_AND_REASON)
_LATER = Permission(ActionEffect.NEXT_SESSION)
_LATER_WITH_REASON = Permission(ActionEffect.NEXT_SESSION, Authorisation.PIN_AND_REASON)

TABLE: Mapping[Action, Mapping[Stage, Permission]] = MappingProxyType(
    {
        Action.PANEL: _always(_NOW_WITH_PIN),
        Action.CONDITION: _always(_LATER_WITH_REASON),
        Action.EMBODIMENT: _always(_LATER_WITH_REASON),
        Action.REPEAT: _rules(_REFUSED, _REFUSED, **{stage.value: _NOW for stage in _SAID_AGAIN}),
        Action.MUTE: _always(_NOW),
        Action.PAUSE: _rules(_REFUSED, _NOW),
        Action.BREAK: _always(_NOW),
        Action.ABORT: _rules(_REFUSED, _NOW_WITH_REASON),
        Action.NEXT: _rules(_REFUSED, _NOW_WITH_REASON, thanks=_NOW, over=_NOW),
        Action.RESUME: _rules(_REFUSED, _REFUSED, attract=_NOW_WITH_REASON),
        Action.LANGUAGE: _rules(_NOW_WITH_REASON, _LATER_WITH_REASON),
        Action.VOLUME: _always(_NOW),
        Action.BACKUP: _rules(_NOW, _LATER),
        Action.TEST_VOICE: _rules(_NOW, _REFUSED),
        Action.QUIT: _rules(_NOW_WITH_PIN, _NOW_WITH_REASON),
    }
)


def permission(action: Action, stage: Stage) -> Permission:
    """Return what holds for this action in this stage."""
    return TABLE[action][stage]


def condition_cycle(quotas: Iterable[str], names: Iterable[str]) -> tuple[Condition | None, ...]:
    """Return the choices that the condition's shortcut goes through.

    The first is the list's (None); then come conditions with a quota, then the others.
    """
    wanted, there = set(quotas), in_design_order(map(Condition, names))
    with_quota = (condition for condition in there if condition.name in wanted)
    return (None, *with_quota, *(condition for condition in there if condition.name not in wanted))


def actions_markdown() -> str:
    """Return the table for the manual: a row for each action; stages that are alike in everything share a column."""
    columns: dict[tuple[Permission, ...], list[str]] = {}
    for stage in Stage:
        columns.setdefault(tuple(TABLE[action][stage] for action in Action), []).append(stage.value)
    rows = [("", *(", ".join(stages) for stages in columns.values())), ("---",) * (len(columns) + 1)]
    rows += [(action.value, *(_in_words(column[at]) for column in columns)) for at, action in enumerate(Action)]
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def _in_words(held: Permission) -> str:
    return held.effect.value if held.asks is Authorisation.NOTHING else f"{held.effect.value}: {held.asks.value}"


_NAMED = ("Space", "Tab", "Esc", "Return", "Ins", "Del", "Home", "End", "PgUp", "PgDown", "Pause", "Menu")
_KEY = re.compile(rf"[A-Za-z0-9]|F([1-9]|1[0-9]|2[0-4])|{'|'.join(_NAMED)}", re.ASCII)

_TAKEN = {
    *(frozenset({"Ctrl", key}) for key in (*"ACVXYZKUE", "Del", "Ins", "Home", "End")),
    *(frozenset({"Ctrl", "Shift", key}) for key in ("Z", "Home", "End")),
    *(frozenset({"Alt", key}) for key in ("F4", "Tab")),
    frozenset({"Ctrl", "Alt", "Del"}),
}
"""What a text field or the system keeps for itself."""


def shortcuts(keys: Keys) -> dict[Action, str]:
    """Return the shortcut of every action that has one; raise UserInputError for one that can never be heard."""
    found = {Action(name): shortcut for name, shortcut in keys.model_dump().items() if shortcut}
    for action, shortcut in found.items():
        _check(action, shortcut)
    return found


def _check(action: Action, shortcut: str) -> None:
    *modifiers, key = shortcut.split("+")
    if not _KEY.fullmatch(key):
        raise UserInputError(
            f"{action.value}: {shortcut!r} has no key; it may be a letter, a digit, F1 to F24, or {', '.join(_NAMED)}"
        )
    if len(set(modifiers)) < len(modifiers):
        raise UserInputError(f"{action.value}: {shortcut!r} names a key twice")
    if frozenset((*modifiers, key.upper() if len(key) == 1 else key)) in _TAKEN:
        raise UserInputError(f"{action.value}: {shortcut!r} means something else to a text field or to the system")


class AuditEvent(Enum):
    """The kinds of booth events."""

    CONDITION_CHOSEN = "ConditionChosen"
    EMBODIMENT_CHOSEN = "EmbodimentChosen"
    LANGUAGE_CHOSEN = "LanguageChosen"
    VOLUME_CHANGED = "VolumeChanged"
    MUTE_CHANGED = "MuteChanged"
    SESSION_ABORTED = "SessionAborted"
    SESSION_RESUMED = "SessionResumed"
    PIN_ATTEMPTED = "PinAttempted"
    PIN_REFUSED = "PinRefused"
    PIN_ACCEPTED = "PinAccepted"
    PANEL_OPENED = "PanelOpened"
    BREAK_BEGAN = "BreakBegan"
    BREAK_ENDED = "BreakEnded"
    APPLICATION_QUIT = "ApplicationQuit"
    BACKUP_MADE = "BackupMade"
    BACKUP_FAILED = "BackupFailed"
    DISK_SPACE_CHANGED = "DiskSpaceChanged"
    VOICE_CHANGED = "VoiceChanged"
    WITHDRAWN_AGAIN = "WithdrawnAgain"
    WITHDRAWN_LIST_MISSING = "WithdrawnListMissing"


DEVIATIONS = frozenset(
    {
        AuditEvent.CONDITION_CHOSEN,
        AuditEvent.EMBODIMENT_CHOSEN,
        AuditEvent.LANGUAGE_CHOSEN,
        AuditEvent.VOLUME_CHANGED,
        AuditEvent.MUTE_CHANGED,
        AuditEvent.SESSION_ABORTED,
        AuditEvent.SESSION_RESUMED,
        AuditEvent.PIN_REFUSED,
        AuditEvent.APPLICATION_QUIT,
        AuditEvent.BACKUP_FAILED,
        AuditEvent.DISK_SPACE_CHANGED,
        AuditEvent.VOICE_CHANGED,
        AuditEvent.WITHDRAWN_AGAIN,
        AuditEvent.WITHDRAWN_LIST_MISSING,
    }
)
"""What a day's protocol has to tell; the rest is routine."""


LEAST, MOST = 6, 12
"""How many digits a PIN has."""

SALT_BYTES = 16
LONGEST_WAIT_MS = 60_000
_FIRST_WAIT_MS = 1_000
COST = 16
"""The power of two that scrypt is made to cost: about 200 ms and 64 MiB for each try."""

_BLOCK, _WORKERS = 8, 1

_KEY_BYTES = 32
_LEAST_DIFFERENT = 4
_PIN = re.compile(rf"[0-9]{{{LEAST},{MOST}}}", re.ASCII)


def hash_pin(pin: str, salt: bytes, cost: int = COST) -> str:
    """Return a PIN as the study file keeps it.

    Raises UserInputError if it is none, or one that people guess first. ``salt`` is 16 random bytes.
    """
    if not _PIN.fullmatch(pin):
        raise UserInputError(f"a PIN has {LEAST} to {MOST} digits and nothing else")
    if _is_guessed_first(pin):
        raise UserInputError("this PIN is too easy to guess: do not repeat or count, and use at least 4 digits")
    return f"scrypt:{cost}:{salt.hex()}:{_key(pin, salt, cost).hex()}"


def _is_guessed_first(pin: str) -> bool:
    """Return whether a PIN is one digit, one part, or one step over and over, or made of few digits."""
    steps = {(int(after) - int(before)) % 10 for before, after in pairwise(pin)}
    # A text is a shorter one repeated if it stands in its double before the end.
    return len(steps) == 1 or (pin + pin).find(pin, 1) < len(pin) or len(set(pin)) < _LEAST_DIFFERENT


def pin_matches(pin: str, line: str) -> bool:
    """Tell whether this is the PIN that the study file keeps.

    It takes about 200 ms, as long for a wrong one as for a right.
    """
    _, cost, salt, key = line.split(":")
    return hmac.compare_digest(_key(pin, bytes.fromhex(salt), int(cost)), bytes.fromhex(key))


@dataclass(frozen=True)
class WrongPins:
    """How many wrong PINs came in a row, and when the last one came, in monotonic ms."""

    times: int = 0
    last_ms: int = 0

    @property
    def wait_ms(self) -> int:
        """How long the last one makes everybody wait, in ms."""
        if not self.times:
            return 0
        # A power with a limit: the records may hold any number of them.
        return min(LONGEST_WAIT_MS, _FIRST_WAIT_MS << min(self.times - 1, LONGEST_WAIT_MS.bit_length()))

    def left_ms(self, now_ms: int) -> int:
        """How long that still is."""
        return min(self.wait_ms, max(0, self.last_ms + self.wait_ms - now_ms))


def _key(pin: str, salt: bytes, cost: int) -> bytes:
    # OpenSSL wants the memory to be allowed: 128 bytes for each block, and a little.
    memory = 128 * _BLOCK * ((1 << cost) + _WORKERS + 2)
    return hashlib.scrypt(pin.encode(), salt=salt, n=1 << cost, r=_BLOCK, p=_WORKERS, maxmem=memory, dklen=_KEY_BYTES)
