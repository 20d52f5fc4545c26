"""The one writer: a sitting's row and its events, on the disk before anybody is shown what they lead to."""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from types import TracebackType
from typing import Self

from filelock import FileLock, Timeout

from kiosk import BadInput, __version__
from kiosk.store.database import open_for_writing
from kiosk.study.events import Event, SittingEnded, Status, WorldEvent, to_record
from kiosk.study.plan import Plan

LOCK = "recollect.lock"
LOCK_WAIT_S = 1.0


class StoreFailed(Exception):
    """The disk did not take what happened; nothing of it was written. The message is for the experimenter."""


@dataclass(frozen=True)
class Provenance:
    """All that a sitting followed and came from, so that it can be replayed and defended."""

    plan: Plan
    seed: int
    body: str
    code_commit: str
    simulated: bool


class Recorder:
    """Writes one data folder; a second one on the same folder is refused in words."""

    def __init__(self, folder: Path) -> None:
        """Open the folder's database, and mark the sittings that a crash cut off; raises BadInput if it cannot."""
        self._connection = open_for_writing(folder)
        self._lock = FileLock(folder / LOCK)
        try:
            # Whoever reads looks at the lock for a moment, and is no reason to give up.
            self._lock.acquire(timeout=LOCK_WAIT_S)
        except Timeout as error:
            self._connection.close()
            raise BadInput(f"another Recollect is writing in {folder}") from error
        self._sitting = 0
        self._next_seq = 1
        self.begun = 0
        """How many sittings were begun with this recorder."""
        try:
            with self._transaction():
                self.recovered = self._mark_interrupted()
        except StoreFailed as error:
            self._close()
            raise BadInput(f"the data folder {folder} cannot be written: {error.__cause__}") from error

    def __enter__(self) -> Self:
        """The recorder itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Close the database and let others write."""
        self._close()

    def begin(self, provenance: Provenance, events: Sequence[Event]) -> int:
        """Write a sitting's row with its first events, in one transaction; returns its number.

        A sitting that never got its end, because the disk failed it, is marked as interrupted on the way.
        """
        with self._transaction():
            self._mark_interrupted()
            self._sitting = self._insert_sitting(provenance)
            self._insert_events(self._sitting, 1, events)
        self._next_seq = 1 + len(events)
        self.begun += 1
        return self._sitting

    def append(self, events: Sequence[Event]) -> None:
        """Write the sitting's next events, in one transaction; raises StoreFailed if the disk does not take them."""
        with self._transaction():
            self._insert_events(self._sitting, self._next_seq, events)
        self._next_seq += len(events)

    def _close(self) -> None:
        self._connection.close()
        self._lock.release()

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        try:
            self._connection.execute("BEGIN IMMEDIATE")
            yield
            self._connection.execute("COMMIT")
        except sqlite3.Error as error:
            raise StoreFailed(f"what happened could not be written: {error}") from error
        finally:
            # Whatever went wrong, nothing of it stays; a full disk has already ended the transaction by itself.
            if self._connection.in_transaction:
                self._connection.execute("ROLLBACK")

    def _insert_sitting(self, provenance: Provenance) -> int:
        plan = provenance.plan
        cursor = self._connection.execute(
            """
            INSERT INTO sitting (
                started_at, seed, condition, body, language, simulated, version, code_commit, deck,
                policy_sha256, settings_sha256, policy_source, questionnaire_source, sentences_source
            ) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)
            """,
            (
                datetime.now(UTC).isoformat(timespec="milliseconds"),
                provenance.seed,
                plan.condition.value,
                provenance.body,
                plan.catalogue.language,
                int(provenance.simulated),
                __version__,
                provenance.code_commit,
                json.dumps(plan.deck),
                plan.policy.sha256,
                self._keep_source(plan.settings.model_dump_json()),
                self._keep_source(plan.policy.to_json()),
                self._keep_source(plan.questionnaire.model_dump_json()),
                self._keep_source(json.dumps(plan.catalogue.sources, ensure_ascii=False)),
            ),
        )
        return cursor.lastrowid or 0

    def _keep_source(self, content: str) -> str:
        sha256 = hashlib.sha256(content.encode()).hexdigest()
        self._connection.execute("INSERT INTO source VALUES (?, ?) ON CONFLICT DO NOTHING", (sha256, content))
        return sha256

    def _insert_events(self, sitting: int, first_seq: int, events: Sequence[Event]) -> None:
        rows = (
            (sitting, seq, event.at_ms, "world" if isinstance(event, WorldEvent) else "session", *_type_and_body(event))
            for seq, event in enumerate(events, first_seq)
        )
        self._connection.executemany("INSERT INTO event VALUES (?, ?, ?, ?, ?, ?)", rows)

    def _mark_interrupted(self) -> tuple[int, ...]:
        """End every sitting that has no end, where its last event left it; returns their numbers."""
        open_sittings = self._connection.execute(
            """
            SELECT sitting, max(seq), max(at_ms) FROM event
            GROUP BY sitting HAVING NOT max(type = 'SittingEnded') ORDER BY sitting
            """
        ).fetchall()
        for sitting, seq, at_ms in open_sittings:
            end = SittingEnded(at_ms=at_ms, status=Status.INTERRUPTED)
            self._connection.execute(
                "INSERT INTO event VALUES (?, ?, ?, 'recovery', ?, ?)", (sitting, seq + 1, at_ms, *_type_and_body(end))
            )
        return tuple(sitting for sitting, *_ in open_sittings)


def _type_and_body(event: Event) -> tuple[str, str]:
    """An event's class, and its own fields as JSON; the time and the class have columns of their own."""
    record = to_record(event)
    kind = str(record.pop("type"))
    del record["at_ms"]
    text = json.dumps(record, ensure_ascii=False, separators=(",", ":"))
    # What the system says may hold lone surrogates, which no file can; written out, they are JSON's own escapes.
    return kind, text.encode("utf-8", "backslashreplace").decode()
