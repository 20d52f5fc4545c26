"""What a day at a booth came to: its sessions, their faults, and what needs attention."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, date, datetime, time, timedelta, tzinfo
from pathlib import Path
from statistics import median
from typing import Any

from kiosk.experiment.events import RobotDisconnected, SpeechFailed
from kiosk.experiment.experimenter import DEVIATIONS, AuditEvent
from kiosk.experiment.outcomes import SessionKind, Stage, Status
from kiosk.experiment.projections import count_speech
from kiosk.experiment.session_state import SessionState
from kiosk.store.copies import backups_of
from kiosk.store.session_records import SessionRecord, open_records
from kiosk.units import MS_PER_SECOND

EARLY = frozenset({Status.ABANDONED, Status.STOPPED, Status.WITHDRAWN, Status.INTERRUPTED})
"""How a session ends that does not come to its end."""
IN_A_ROW = 3
"""How many early ends, one after another, are not taken for chance."""
SLOW_MS = 800
"""A sentence that begins later than this is one that visitors wait for."""
UNHEARD_SHARE = 0.05
_WRONG_PINS = 3
_LONG = 2
_P95 = 0.95


_FAULTS = {RobotDisconnected: "robot lost", SpeechFailed: "not said"}


@dataclass(frozen=True)
class StageSpan:
    """A stage of a session, in ms from its first event; pauses are in it."""

    stage: Stage
    begin_ms: int
    end_ms: int


@dataclass(frozen=True)
class Happening:
    """Something to be told of: when, in words."""

    at: datetime
    words: str


@dataclass(frozen=True)
class DaySession:
    """One session of the day; ``status`` is None while it is under way. Nothing in it tells the condition."""

    number: int
    name: str
    kind: SessionKind
    began: datetime
    ended: datetime
    """Its last event; by the zone's offset at that time, which may not be that of its beginning."""
    status: Status | None
    spans: tuple[StageSpan, ...]
    faults: tuple[Happening, ...]
    changes: tuple[Happening, ...]
    """Which body and which voice helped, at the start and after every change."""
    latencies_ms: tuple[int, ...]
    """From asking for each sentence to its first sound."""
    sentences: int
    shown_only: int
    robot_lost: bool

    @property
    def duration_ms(self) -> int:
        """From its first event to its last, pauses included."""
        return self.spans[-1].end_ms if self.spans else 0

    @property
    def last_stage(self) -> Stage | None:
        """Where it ended, or is."""
        return self.spans[-1].stage if self.spans else None

    @property
    def ended_early(self) -> bool:
        """Whether it ended before its end."""
        return self.status in EARLY


@dataclass(frozen=True)
class DayNote:
    """An audit event of the booth."""

    at: datetime
    kind: AuditEvent
    payload: dict[str, Any]

    @property
    def words(self) -> str:
        """The event and what it holds, but for what experimenters may have typed or chosen of conditions."""
        hidden = {"condition", "reason"}
        told = ", ".join(f"{key}: {value}" for key, value in self.payload.items() if key not in hidden)
        return f"{self.kind.value}{f' ({told})' if told else ''}"


@dataclass(frozen=True)
class DayReport:
    """A day by the clock of a time zone; sessions and notes in the order in which they came."""

    day: date
    sessions: tuple[DaySession, ...]
    notes: tuple[DayNote, ...]

    def noted(self, *kinds: AuditEvent) -> list[DayNote]:
        """Return the audit events of these kinds."""
        return [note for note in self.notes if note.kind in kinds]

    @property
    def deviations(self) -> list[DayNote]:
        """What was not as planned."""
        return [note for note in self.notes if note.kind in DEVIATIONS]

    @property
    def latencies_ms(self) -> list[int]:
        """Every sentence's latency, from the shortest."""
        return sorted(each for session in self.sessions for each in session.latencies_ms)

    def stage_durations_ms(self) -> dict[Stage, list[int]]:
        """How long every visit to a stage took, by stage, from the shortest; pauses included."""
        found: dict[Stage, list[int]] = {}
        for span in (span for session in self.sessions for span in session.spans):
            found.setdefault(span.stage, []).append(span.end_ms - span.begin_ms)
        return {stage: sorted(found[stage]) for stage in Stage if stage in found}

    def cautions(self) -> list[str]:
        """Say what is to be looked at before the next day, the worst first."""
        return [*self._about_sessions(), *self._about_voice(), *self._about_booth()]

    def _about_sessions(self) -> Iterator[str]:
        for session in self.sessions:
            if session.status is Status.INTERRUPTED:
                yield f"Session {session.number} was cut off in {_named(session.last_stage)}: see recollect.log."
            if session.status is None:
                yield f"Session {session.number} has no end: a kiosk is still in it, or died."
        row = _longest_row(self.sessions)
        if len(row) >= IN_A_ROW:
            stages = ", ".join(dict.fromkeys(_named(session.last_stage) for session in row))
            yield f"{len(row)} sessions in a row ended early, in {stages}: play one yourself."
        whole = [session.duration_ms for session in self.sessions if session.status is Status.COMPLETED]
        usual = median(whole) if whole else 0
        for session in self.sessions:
            if session.status is Status.COMPLETED and session.duration_ms > _LONG * usual:
                yield f"Session {session.number} took more than twice as long as usual."
        lost = [session.number for session in self.sessions if session.robot_lost]
        if lost:
            yield f"The robot was lost in {_numbers(lost)}: try it with 'recollect robot'."

    def _about_voice(self) -> Iterator[str]:
        asked = sum(session.sentences for session in self.sessions)
        shown = sum(session.shown_only for session in self.sessions)
        if asked and shown / asked > UNHEARD_SHARE:
            yield f"{shown} of {asked} sentences were not heard to their end: try 'recollect check --say'."
        late = quantile(self.latencies_ms, _P95)
        if late is not None and late > SLOW_MS:
            yield f"One sentence in 20 began later than {late:,.0f} ms: render a voice pack, or end other programs."
        voices = self.noted(AuditEvent.VOICE_CHANGED)
        if voices and not voices[-1].payload.get("is_heard"):
            yield f"The voice was lost at {voices[-1].at:%H:%M} and did not come back."

    def _about_booth(self) -> Iterator[str]:
        copies = self.noted(AuditEvent.BACKUP_MADE, AuditEvent.BACKUP_FAILED)
        if self.sessions and not any(note.kind is AuditEvent.BACKUP_MADE for note in copies):
            yield "No copy was made this day: make one with 'recollect backup --to stick'."
        elif copies and copies[-1].kind is AuditEvent.BACKUP_FAILED:
            yield f"The last copy failed at {copies[-1].at:%H:%M}."
        room = self.noted(AuditEvent.DISK_SPACE_CHANGED)
        if room and room[-1].payload.get("level") != "enough":
            yield f"The disk is short of room: {room[-1].payload.get('free_mib')} MiB were left."
        if len(self.noted(AuditEvent.PIN_REFUSED)) >= _WRONG_PINS:
            yield f"A wrong PIN was typed {len(self.noted(AuditEvent.PIN_REFUSED))} times."


def quantile(ordered: Sequence[int], share: float) -> float | None:
    """Return the value below which a share of ordered numbers lies (the nearest rank); None without any."""
    return float(ordered[min(len(ordered) - 1, int(share * len(ordered)))]) if ordered else None


def read_day_report(folder: Path, day: date, kinds: frozenset[SessionKind], zone: tzinfo | None = None) -> DayReport:
    """Read the sessions that began on a day, and what was noted of the booth.

    ``zone`` is the machine's by default. Raises UserInputError if there is nothing that can be read.
    """
    since = _midnight(day, zone)
    until = _midnight(day + timedelta(days=1), zone)
    with open_records(folder, kinds) as stored:
        sessions = tuple(_session(record, zone) for record in stored.begun_between(since, until))
        rows = stored.connection.execute(
            "SELECT wall_ms, type, payload FROM audit_event WHERE wall_ms >= ? AND wall_ms < ? ORDER BY id",
            (since.timestamp() * MS_PER_SECOND, until.timestamp() * MS_PER_SECOND),
        ).fetchall()
    known = {kind.value: kind for kind in AuditEvent}
    notes = tuple(
        DayNote(datetime.fromtimestamp(wall_ms / MS_PER_SECOND).astimezone(zone), known[kind], json.loads(payload))
        for wall_ms, kind, payload in rows
        if kind in known
    )
    by_commands = (
        DayNote(copy.at.astimezone(zone), AuditEvent.BACKUP_MADE, {"file": str(copy.file)})
        for copy in backups_of(folder)
        if since <= copy.at < until and copy.file.name not in {note.payload.get("file") for note in notes}
    )
    return DayReport(day, sessions, tuple(sorted((*notes, *by_commands), key=lambda note: note.at)))


def _midnight(day: date, zone: tzinfo | None) -> datetime:
    at = datetime.combine(day, time())
    return at.astimezone() if zone is None else at.replace(tzinfo=zone)


def _session(record: SessionRecord, zone: tzinfo | None) -> DaySession:
    state, began = record.state, datetime.fromisoformat(record.row["started_at"]).astimezone(UTC)
    first_ms = record.records[0].at_ms if record.records else 0
    last_ms = record.records[-1].at_ms if record.records else 0

    def at(at_ms: int) -> datetime:
        return (began + timedelta(milliseconds=at_ms - first_ms)).astimezone(zone)

    attempts = [attempt for said in state.sentences for attempt in said.attempts]
    counted = count_speech(state)
    return DaySession(
        number=record.id,
        name=record.name,
        kind=record.kind,
        began=at(first_ms),
        ended=at(last_ms),
        status=record.status,
        spans=tuple(_spans(state, first_ms, last_ms)),
        faults=tuple(
            Happening(
                at(event.at_ms), f"{'robot lost' if isinstance(event, RobotDisconnected) else 'voice'}: {event.why}"
            )
            for event in record.events
            if isinstance(event, RobotDisconnected | SpeechFailed)
        ),
        changes=tuple(_changes(record, state, at)),
        latencies_ms=tuple(each.started_ms - each.at_ms for each in attempts if each.started_ms is not None),
        sentences=counted.requested,
        shown_only=counted.shown_only,
        robot_lost=any(isinstance(event, RobotDisconnected) for event in record.events),
    )


def _spans(state: SessionState, first_ms: int, last_ms: int) -> Iterator[StageSpan]:
    visits = [visit for visit in state.stages if visit.stage is not Stage.OVER]
    ends = [*(visit.at_ms for visit in visits[1:]), last_ms] if visits else []
    for visit, end_ms in zip(visits, ends, strict=True):
        yield StageSpan(visit.stage, visit.at_ms - first_ms, max(visit.at_ms, end_ms) - first_ms)


def _faults(record: SessionRecord, at: Callable[[int], datetime]) -> Iterator[Happening]:
    """Yield every kind of fault once, when it came first, with how often it came."""
    found: dict[str, list[int]] = {}
    for event in record.events:
        if isinstance(event, RobotDisconnected | SpeechFailed):
            found.setdefault(f"{_FAULTS[type(event)]}: {event.why}", []).append(event.at_ms)
    for words, times_ms in found.items():
        yield Happening(at(times_ms[0]), words if len(times_ms) == 1 else f"{words} ({len(times_ms)} times)")


def _changes(record: SessionRecord, state: SessionState, at: Callable[[int], datetime]) -> Iterator[Happening]:
    """Yield the body and the voice at the start, and every other one later."""
    yield Happening(at(record.records[0].at_ms if record.records else 0), f"helped by {record.row['embodiment']}")
    before = ""
    told = [(changed.at_ms, f"helped by {changed.embodiment}: {changed.why}") for changed in state.embodiment_changes]
    for attempt in (attempt for said in state.sentences for attempt in said.attempts):
        heard = attempt.heard
        if heard is None or not heard.voice:
            continue
        voice = f"voice {heard.voice} of {heard.engine}{f', pack {heard.pack[:8]}' if heard.pack else ''}"
        if voice != before:
            told.append((heard.at_ms, voice))
            before = voice
    yield from (Happening(at(at_ms), words) for at_ms, words in sorted(told))


def _longest_row(sessions: Sequence[DaySession]) -> list[DaySession]:
    longest: list[DaySession] = []
    row: list[DaySession] = []
    for session in sessions:
        row = [*row, session] if session.ended_early else []
        longest = max(longest, row, key=len)
    return longest


def _named(stage: Stage | None) -> str:
    return stage.value.replace("_", " ") if stage else "no stage"


def _numbers(numbers: Sequence[int]) -> str:
    return f"session{'s' if len(numbers) > 1 else ''} {', '.join(map(str, numbers))}"
