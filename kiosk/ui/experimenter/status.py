"""The health of the booth: lines of the console, and status.json."""

from __future__ import annotations

import json
import logging
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from datetime import datetime
from functools import partial
from math import ceil
from pathlib import Path
from string import ascii_uppercase
from typing import Any

from kiosk import why
from kiosk.assistance.wording import Catalogue
from kiosk.experiment.booth_status import CLOSED, FILE, WRITE_EVERY_S, BoothStatus, DayCounts, EndedSession, PartStatus
from kiosk.experiment.condition import Condition, in_design_order
from kiosk.experiment.experimenter import Action, AuditEvent, DeviationReason
from kiosk.experiment.outcomes import Disposition, Status
from kiosk.experiment.session_config import StudyConfig
from kiosk.files import read_bytes, replace_file
from kiosk.lazy_dataclass import dataclass
from kiosk.robots.embodiment import Health
from kiosk.store.maintenance import FreeSpace, SpaceLevel
from kiosk.store.participants import CountCell, EnrolmentCounts
from kiosk.store.snapshot import DashboardSnapshot, SnapshotAuditEvent, SnapshotSession
from kiosk.ui.event_loop import Clock, Executor, TimerWait
from kiosk.ui.experimenter.maintenance import BackupOutcome
from kiosk.ui.experimenter.view_model import Row
from kiosk.units import MS_PER_HOUR, MS_PER_MINUTE, MS_PER_SECOND

SHORT_SHA = 8
DRIFT_MS = 60_000
"""So far may the wall's clock go from one that cannot be set, or stand before what was last written."""

MIB_PER_GIB = 1024


@dataclass(frozen=True)
class HealthLine:
    """How one thing is; ``name`` says what it is."""

    name: str
    message: str
    is_ok: bool = True
    remedy: str = ""
    """What the experimenter can do about it, where the message does not say so."""
    is_used: bool = True
    """False for what is not set up, or off on purpose: it is no fault, but nothing is in order there either."""
    is_due: bool = False
    """Whether the experimenter has something to do about it, though nothing is wrong."""


@dataclass(frozen=True)
class Clocks:
    """The wall's clock, in ms since 1970: now, when the program began, and when anything was last written before that.

    ``run_ms`` is how long the program has run by a clock that cannot be set.
    """

    now_ms: int
    began_ms: int
    run_ms: int
    written_ms: int

    @property
    def set_back_ms(self) -> int:
        """How far the program began before what was written already."""
        return max(0, self.written_ms - self.began_ms)

    @property
    def jump_ms(self) -> int:
        """How far the clock was set since the program began."""
        return self.now_ms - self.began_ms - self.run_ms

    @property
    def wrong_ms(self) -> int:
        """How far the clock was set, or stood behind the records at the start; 0 for mere drift."""
        for wrong_ms in (self.set_back_ms, self.jump_ms):
            if abs(wrong_ms) > DRIFT_MS:
                return wrong_ms
        return 0


@dataclass(frozen=True)
class HealthInputs:
    """Everything that the health lines are made from."""

    robot: Health | None
    """None if there is none."""
    voice: Health
    muted: bool
    free_space: FreeSpace | None
    last_backup: BackupOutcome | None
    audit_error: str
    """What the disk did not take last; empty if it took everything since."""
    clocks: Clocks
    has_pin: bool
    screen: str
    screen_well: bool
    supervised: bool = False
    remote: str | None = None
    """Why the status is not published; empty if it is, None if that is switched off."""
    copy: str = ""
    """What becomes of a copy that was asked for; empty if none was."""
    pack_changed: bool = False
    """Whether the pack of clips is not the one of earlier sessions."""


def health_lines(state: HealthInputs, catalogue: Catalogue) -> tuple[HealthLine, ...]:
    """Return what the first page tells, in the order in which a person looks."""
    translate = catalogue.text
    return (
        _robot(state, catalogue),
        _voice(state, catalogue),
        _disk(state, catalogue),
        _database(state, catalogue),
        _clock(state.clocks, catalogue),
        # Before the supervisor, which starts no study without a PIN.
        _line_of_what_is_needed(
            translate("console-pin-line-name"),
            translate("console-pin-set") if state.has_pin else "",
            translate("console-pin-none"),
            translate("console-pin-remedy"),
        ),
        _line_of_what_is_needed(
            translate("console-supervisor"),
            translate("console-supervisor-there") if state.supervised else "",
            translate("console-supervisor-none"),
            translate("console-supervisor-remedy"),
        ),
    )


def _line_of_what_is_needed(name: str, there: str, missing: str, remedy: str) -> HealthLine:
    """Say what a part is like that is ``there``, or that it is missing and what to do."""
    return HealthLine(name, there) if there else HealthLine(name, missing, is_ok=False, remedy=remedy)


def booth_lines(state: HealthInputs, study: StudyConfig, catalogue: Catalogue) -> tuple[HealthLine, ...]:
    """Return what stays as it is all day."""
    translate = catalogue.text
    return (
        HealthLine(translate("console-policy"), _policy(study)),
        HealthLine(translate("console-study"), f"{study.settings.title} · {study.sha256[:SHORT_SHA]}"),
        HealthLine(translate("console-screen"), state.screen, state.screen_well),
        *_remote(state, catalogue),
    )


def _remote(state: HealthInputs, catalogue: Catalogue) -> Iterator[HealthLine]:
    if state.remote is not None:
        words = catalogue.text("console-remote-not", why=state.remote) if state.remote else ""
        yield HealthLine(
            catalogue.text("console-remote"), words or catalogue.text("console-remote-there"), is_ok=not state.remote
        )


def health_parts(state: HealthInputs, catalogue: Catalogue) -> Iterator[PartStatus]:
    """Yield how the parts of the booth are that can fail, under names that are the same in every language."""
    lines = {
        "robot": _robot(state, catalogue),
        "voice": _voice(state, catalogue),
        "disk": _disk(state, catalogue),
        "database": _database(state, catalogue),
        "clock": _clock(state.clocks, catalogue),
        "screen": HealthLine("", state.screen, state.screen_well),
    }
    yield from (PartStatus(name, line.is_ok, line.message) for name, line in lines.items())


def _robot(state: HealthInputs, catalogue: Catalogue) -> HealthLine:
    name = catalogue.text("console-robot")
    if state.robot is None:
        return HealthLine(name, catalogue.text("console-robot-absent"), is_used=False)
    return HealthLine(name, state.robot.message, state.robot.is_ok)


def _voice(state: HealthInputs, catalogue: Catalogue) -> HealthLine:
    name = catalogue.text("console-voice")
    if state.muted:
        return HealthLine(
            name, catalogue.text("console-voice-quiet"), is_ok=False, remedy=catalogue.text("console-voice-remedy")
        )
    if state.voice.is_ok and state.pack_changed:
        return HealthLine(name, catalogue.text("console-voice-changed"), is_ok=False)
    return HealthLine(name, state.voice.message, state.voice.is_ok, is_used=state.voice.is_used)


def is_pack_changed(pack: tuple[str, str], earlier: Iterable[tuple[str, str]]) -> bool:
    """Whether the pack of a language, by its hash, is another one than any that spoke it in earlier sessions."""
    language, sha256 = pack
    return bool(sha256) and any(spoken == language and each != sha256 for spoken, each in earlier)


def _disk(state: HealthInputs, catalogue: Catalogue) -> HealthLine:
    name = catalogue.text("console-disk")
    if state.free_space is None:
        return HealthLine(name, catalogue.text("console-disk-unknown"), is_ok=False)
    free = state.free_space.free_mib
    size = f"{free / MIB_PER_GIB:.1f} GiB" if free >= MIB_PER_GIB else f"{free} MiB"
    message = {
        SpaceLevel.ENOUGH: "console-disk-free",
        SpaceLevel.WARN: "console-disk-warn",
        SpaceLevel.REFUSE: "console-disk-refuse",
    }[state.free_space.level]
    return HealthLine(name, catalogue.text(message, free=size), state.free_space.level is SpaceLevel.ENOUGH)


def _database(state: HealthInputs, catalogue: Catalogue) -> HealthLine:
    name, translate = catalogue.text("console-database"), catalogue.text
    if state.audit_error:
        return HealthLine(name, state.audit_error, is_ok=False)
    if state.last_backup is None:
        if state.copy:
            return HealthLine(name, state.copy, is_used=False)
        missing, remedy = translate("console-backup-none"), translate("console-backup-remedy")
        return HealthLine(name, missing, remedy=remedy, is_due=True)
    if state.last_backup.file is None:
        return HealthLine(name, translate("console-backup-failed", why=state.last_backup.why), is_ok=False)
    minutes = max(0, state.clocks.now_ms - state.last_backup.at_ms) // MS_PER_MINUTE
    return HealthLine(name, translate("console-backup-made", ago=ago(minutes, catalogue)))


def ago(minutes: int, catalogue: Catalogue) -> str:
    """So many minutes, in words of the size that matters."""
    if minutes < _MINUTES_PER_HOUR:
        return catalogue.text("console-minutes", minutes=minutes)
    if minutes < _MINUTES_PER_DAY:
        return catalogue.text("console-hours", hours=minutes // _MINUTES_PER_HOUR)
    return catalogue.text("console-days", days=minutes // _MINUTES_PER_DAY)


_MINUTES_PER_HOUR = 60
_MINUTES_PER_DAY = 24 * 60


def _clock(clocks: Clocks, catalogue: Catalogue) -> HealthLine:
    name = catalogue.text("console-clock")
    if clocks.set_back_ms > DRIFT_MS:
        # A clock that is wrong is wrong by hours; one that is off by less is so by at most one.
        hours = ceil(clocks.set_back_ms / MS_PER_HOUR)
        return HealthLine(name, catalogue.text("console-clock-behind", hours=hours), is_ok=False)
    if abs(clocks.jump_ms) > DRIFT_MS:
        return HealthLine(
            name, catalogue.text("console-clock-jumped", seconds=round(clocks.jump_ms / MS_PER_SECOND)), is_ok=False
        )
    return HealthLine(name, catalogue.text("console-clock-well"))


def _policy(study: StudyConfig) -> str:
    policy = study.plans[0].policy
    return f"{policy.name} · {policy.sha256[:SHORT_SHA]}"


DEVIATIONS_SHOWN = 5

Translate = Callable[..., str]


def session_rows(seen: DashboardSnapshot, catalogue: Catalogue, name: NameCondition, *, played: bool) -> Row:
    """Return every list of the panel that follows from the records.

    During a session the conditions of all sessions are hidden: from those before, the one of now could be guessed.
    """
    translate = catalogue.text
    visits = {why.value: number for why, number in seen.counts.visits.items()}
    told = (lambda _: translate("console-hidden")) if played else name
    return {
        "listed": any(cell.quota for cell in seen.counts.cells.values()),
        "cells": [_cell(name(condition), cell) for condition, cell in seen.counts.cells.items()],
        "visits": translate("console-visits", **visits),
        "sessions": [_session(session, translate, told) for session in seen.sessions],
        "deviations": [_deviation(noted, translate, told) for noted in seen.deviations[:DEVIATIONS_SHOWN]],
        "more": _more(len(seen.deviations) - DEVIATIONS_SHOWN, translate),
        "resumable": [_resumable(session, translate) for session in seen.resumable],
    }


def today_rows(
    day: DayCounts, counts: EnrolmentCounts, stage: tuple[str, int], now: datetime, catalogue: Catalogue
) -> Row:
    """Return the clock and the day in numbers; ``stage`` is the one of now, and its age in ms."""
    translate = catalogue.text
    done = sum(cell.fates[Disposition.CONSUMED] for cell in counts.cells.values())
    target = sum(cell.quota for cell in counts.cells.values())
    name, lasted_ms = stage
    numbers = (
        ("visitors", str(day.begun), translate("console-today-early", early=day.ended_early)),
        ("completed", str(day.completed), translate("console-today-hour", done=day.last_hour)),
        (
            "target",
            f"{done} / {target}" if target else str(done or "-"),
            _forecast(day, max(0, target - done), now, catalogue),
        ),
        (
            "stage",
            stage_name(name, catalogue),
            translate("console-today-minutes", minutes=lasted_ms // MS_PER_MINUTE),
        ),
    )
    return {
        "clock": f"{now:%H:%M}",
        "tiles": [
            {"name": name, "title": translate(f"console-today-{name}"), "value": value, "line": line}
            for name, value, line in numbers
        ],
    }


def stage_name(stage: str, catalogue: Catalogue) -> str:
    """Return what the console calls a stage, where it stands alone."""
    words = catalogue.text(f"console-stage-{_kebab(stage)}")
    return words[:1].upper() + words[1:]


SHORTCUTS = (
    Action.PANEL,
    Action.PAUSE,
    Action.ABORT,
    Action.NEXT,
    Action.REPEAT,
    Action.MUTE,
    Action.VOLUME,
    Action.CONDITION,
    Action.EMBODIMENT,
    Action.QUIT,
)
"""The actions with shortcuts, the most needed first."""


def shortcut_rows(keys: Mapping[Action, str], catalogue: Catalogue) -> Row:
    """Return the shortcuts as the panel shows them.

    Keys that are held down for all of them stand in the title alone.
    """
    there = [action for action in SHORTCUTS if action in keys]
    held = {keys[action].rpartition("+")[0] for action in there}
    common = held.pop() if len(held) == 1 else ""
    return {
        "title": catalogue.text("console-shortcuts-held", keys=common)
        if common
        else catalogue.text("console-shortcuts"),
        "rows": [
            {
                "keys": keys[action].rpartition("+")[2] if common else keys[action],
                "words": catalogue.text(f"console-shortcut-{action.value}"),
            }
            for action in there
        ],
    }


def _forecast(day: DayCounts, games: int, now: datetime, catalogue: Catalogue) -> str:
    if games == 0:
        return ""
    hours = day.hours_for(games, now)
    if hours is None:
        return catalogue.text("console-today-no-pace")
    return catalogue.text("console-today-forecast", hours=f"{hours:.0f}" if hours >= 1 else "<1")


NameCondition = Callable[[Condition | None], str]
"""Returns what a condition is called; None is the list's."""


def neutral_names(conditions: Iterable[Condition | None], translate: Translate) -> NameCondition:
    """Call conditions A, B, C in the order of the design, so that no name tells what they are."""
    letters = {
        condition: ascii_uppercase[at] if at < len(ascii_uppercase) else str(at + 1)
        for at, condition in enumerate(in_design_order({each for each in conditions if each is not None}))
    }
    return lambda condition: translate("console-automatic") if condition is None else letters.get(condition, "?")


_AUTOMATIC = "automatic"
"""What the record says of the list's condition."""


def condition_name(condition: Condition | None, translate: Translate) -> str:
    """Return what a condition is called in the panel; None is the list's."""
    if condition is None:
        return translate("console-automatic")
    if not condition.is_known:
        return translate("console-condition-declared", name=condition.name)
    return translate(f"console-condition-{_kebab(condition.name)}")


def _cell(name: str, cell: CountCell) -> Row:
    done, quota = cell.fates[Disposition.CONSUMED], cell.quota
    return {
        "name": name,
        "done": f"{done} / {quota}" if quota else str(cell.fates[Disposition.UNLISTED]),
        "listed": quota > 0,
        "share": min(1.0, done / quota) if quota else 0.0,
        "counts": [
            str(number)
            for number in (
                cell.fates[Disposition.DROPPED_OUT],
                cell.fates[Disposition.OVERRIDDEN],
                cell.fates[Disposition.BEYOND],
                cell.withdrawn,
            )
        ],
    }


def _session(session: SnapshotSession, translate: Translate, told: NameCondition) -> Row:
    return {
        "participant": session.participant or "-",
        "when": _time(datetime.fromisoformat(session.started_at)),
        "condition": told(session.condition),
        "stage": translate(f"console-stage-{_kebab(session.stage.value)}") if session.stage else "-",
        "status": translate(f"console-status-{session.status.value if session.status else 'running'}"),
        "reason": _reason(session.reason, translate),
        "robot": translate("console-robot-lost") if session.robot_lost else "",
        "under_way": session.status is None,
        "odd": session.robot_lost or session.status in (Status.ABANDONED, Status.INTERRUPTED, Status.STOPPED),
    }


def _resumable(session: SnapshotSession, translate: Translate) -> Row:
    stage = translate(f"console-stage-{_kebab(session.stage.value)}") if session.stage else "-"
    when = _time(datetime.fromisoformat(session.started_at))
    return {
        "number": str(session.number),
        "label": translate("console-resume-one", participant=session.participant, when=when, stage=stage),
    }


def _deviation(noted: SnapshotAuditEvent, translate: Translate, told: NameCondition) -> Row:
    when = datetime.fromtimestamp(noted.wall_ms / MS_PER_SECOND).astimezone()
    reason = str(noted.payload.get("reason") or "")
    return {
        "when": f"{when:%H:%M}",
        "words": translate(f"console-note-{_kebab_of(noted.kind)}", what=_what(noted, translate, told)),
        "reason": _reason(reason, translate),
    }


def _more(number: int, translate: Translate) -> str:
    """How many are not shown; nothing if all are."""
    return translate("console-deviations-more", number=number) if number > 0 else ""


def _what(noted: SnapshotAuditEvent, translate: Translate, told: NameCondition) -> str:
    """Return the one thing that a note is about, in words."""
    payload: dict[str, Any] = noted.payload
    match noted.kind:
        case AuditEvent.CONDITION_CHOSEN:
            name = str(payload.get("condition", _AUTOMATIC))
            return told(None if name == _AUTOMATIC else Condition(name))
        case AuditEvent.VOLUME_CHANGED:
            return f"{payload.get('volume', 0):.0%}"
        case AuditEvent.MUTE_CHANGED:
            return translate("console-mute-on" if payload.get("muted") else "console-mute-off")
        case AuditEvent.SESSION_ABORTED | AuditEvent.APPLICATION_QUIT:
            stage = str(payload.get("stage", ""))
            return translate(f"console-stage-{_kebab(stage)}") if stage else ""
        case AuditEvent.DISK_SPACE_CHANGED:
            return translate(f"console-room-{payload.get('level', 'enough')}")
    of = {
        AuditEvent.EMBODIMENT_CHOSEN: "embodiment",
        AuditEvent.LANGUAGE_CHOSEN: "language",
        AuditEvent.SESSION_RESUMED: "session",
    }
    of |= {AuditEvent.PIN_REFUSED: "in_a_row", AuditEvent.BACKUP_FAILED: "why", AuditEvent.VOICE_CHANGED: "message"}
    of |= {AuditEvent.WITHDRAWN_AGAIN: "people", AuditEvent.WITHDRAWN_LIST_MISSING: "list"}
    value = payload.get(of.get(noted.kind, ""), "")
    return value if isinstance(value, str) else json.dumps(value)


def _reason(reason: str, translate: Translate) -> str:
    """Return a reason of the list in the panel's language, one in the experimenter's words as it is."""
    for each in DeviationReason:
        if reason == each.value:
            return translate(f"console-reason-{each.name.lower()}")
    return reason.removeprefix(f"{DeviationReason.OTHER.value}: ")


def _time(when: datetime) -> str:
    """Return the time of day; with the day if that is another one."""
    local = when.astimezone()
    return f"{local:%H:%M}" if local.date() == datetime.now().astimezone().date() else f"{local:%d.%m. %H:%M}"


def _kebab(name: str) -> str:
    return name.replace("_", "-")


def _kebab_of(note: AuditEvent) -> str:
    return note.name.lower().replace("_", "-")


LOOK_MS = 1_000
"""How often it is seen whether anything has changed."""

READ_EVERY_MS = 60_000
"""How often the records are read again within a stage: the last hour goes on, and so does the day."""

Day = tuple[DayCounts, tuple[EndedSession, ...]]

_log = logging.getLogger(__name__)


class StatusFile:
    """Keeps status.json true as long as the kiosk runs.

    A disk that does not take it is no fault of a session.
    """

    def __init__(
        self,
        folder: Path,
        now: Callable[[], BoothStatus],
        read_day: Callable[[], Day],
        clock: Clock,
        work: Executor,
    ) -> None:
        """``now`` gives the status but for the day's sessions; ``read_day`` reads those, on the executor ``work``."""
        self._file = folder / FILE
        self._now = now
        self._read_day = read_day
        self._clock = clock
        self._work = work
        self._day: Day = (DayCounts(), ())
        self._stage = ""
        self._read_at = 0
        self._written: BoothStatus | None = None
        self._written_at = 0
        self._failed = False
        self._tick: TimerWait | None = None
        self.observers: list[Callable[[BoothStatus], None]] = []
        """Called with what is written, each time; they return at once."""

    def begin(self) -> None:
        """Write it now, and go on writing it."""
        self._look()

    @property
    def day(self) -> Day:
        """The sessions of today, as they were last read."""
        return self._day

    def close(self) -> None:
        """Write for the last time: the kiosk is closed."""
        if self._tick is None:
            return
        self._tick.cancel()
        self._tick = None
        closed = replace(self._status(), stage=CLOSED)
        self._publish(closed)
        self._took(write_status(self._file, closed))

    def _look(self) -> None:
        status = self._status()
        if status.stage != self._stage or self._clock.now_ms() - self._read_at >= READ_EVERY_MS:
            # Sessions begin and end with a change of stage, and the hour goes on: the records are read again.
            self._stage, self._read_at = status.stage, self._clock.now_ms()
            self._work(self._read_day, self._take_day)
        since_ms = self._clock.now_ms() - self._written_at
        if status.changed_from(self._written) or since_ms >= WRITE_EVERY_S * MS_PER_SECOND:
            self._written, self._written_at = status, self._clock.now_ms()
            self._publish(status)
            self._work(partial(write_status, self._file, status), self._took)
        self._tick = self._clock.after(LOOK_MS, self._look)

    def _publish(self, status: BoothStatus) -> None:
        for observer in self.observers:
            observer(status)

    def _status(self) -> BoothStatus:
        today, ended = self._day
        return replace(self._now(), today=today, ended=ended)

    def _take_day(self, day: Day) -> None:
        self._day = day

    def _took(self, why: str) -> None:
        if why and not self._failed:
            _log.warning("%s cannot be written: %s", self._file, why)
        self._failed = bool(why)


def was_cut_off(folder: Path) -> bool:
    """Tell from status.json whether the kiosk before ended without being left."""
    try:
        before = BoothStatus.from_json(read_bytes(folder / FILE).decode("utf-8"))
    except (OSError, ValueError):
        return False
    return before.stage != CLOSED


def write_status(file: Path, status: BoothStatus) -> str:
    """Replace the file as a whole, for its owner alone; returns why it could not be, or an empty text."""
    try:
        replace_file(file, status.to_json(), 0o600, durable=False)
    except OSError as error:
        return why(error)
    return ""
