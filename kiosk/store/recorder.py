"""The recorder: writes sessions, allocation lists and what happens at the booth into the database of a data folder."""

from __future__ import annotations

import hashlib
import json
import logging
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from threading import RLock
from types import TracebackType
from typing import Any, Self

from kiosk import StorageError, UserInputError, __version__
from kiosk.experiment.condition import AllocationSlot, Condition
from kiosk.experiment.events import Event
from kiosk.experiment.experimenter import AuditEvent
from kiosk.experiment.outcomes import AllocationSource, NotRecordedReason, SessionKind
from kiosk.experiment.questionnaire import QUESTIONNAIRES
from kiosk.experiment.session_config import SessionConfig, Translation
from kiosk.lazy_dataclass import dataclass
from kiosk.store.allocation import AllocationLists, check_not_given_out_again
from kiosk.store.chain import Head, HeadsFile, first_hash, last_hash
from kiosk.store.codes import keys_of, session_with_hash, shown_code
from kiosk.store.connecting import LOGS, failure, primary_code, reason
from kiosk.store.database import BUSY, FILE, lock_folder, open_for_writing
from kiosk.store.participants import Participant, ReturningVisitor, checked_site, enrol, enrol_again, returning_visitor
from kiosk.store.remnants import clear_end
from kiosk.store.rows import (
    INSERT_EVENT,
    EventRow,
    event_rows,
    insert,
    insert_audit_event,
    interrupted_at,
    mark_interrupted,
)
from kiosk.store.summaries import go_on
from kiosk.store.tombstones import FILE as LIST
from kiosk.store.tombstones import add_tombstones, is_list_there
from kiosk.store.withdrawal import bury, finish_cut_off, is_unfinished, note_intention

_log = logging.getLogger(__name__)


class StoreBusy(StorageError):
    """Another program holds the database just now; nothing was written, and the same can be tried again."""


@dataclass(frozen=True)
class Provenance:
    """All that a session followed and came from, so that it can be replayed and defended."""

    plan: SessionConfig
    seed: int
    embodiment: str
    code_commit: str
    kind: SessionKind
    slot: AllocationSlot | None = None
    """The slot that it takes in the allocation list; given if, and only if, its condition came from the list."""
    allocation_source: AllocationSource | None = None
    returning: ReturningVisitor | None = None
    """Who comes back; None for a new participant. The plan is that of their visit."""


OPENING_WAIT_MS = 5_000
"""How long opening waits for another program that holds the database."""


class Recorder:
    """Writes one data folder; a second one on the same folder is refused in words.

    Any thread may call it; one waits until another is done.
    """

    def __init__(self, folder: Path, site: str = "", *, wait_ms: int = 0) -> None:
        """Open the folder's database, and mark the sessions and finish the withdrawals that a crash cut off.

        Raises UserInputError if the folder cannot be used, and StorageError if the disk does not take it.
        ``site`` stands before the participants' numbers and codes, where data of several places will be merged. Once
        it is open, every method that writes waits ``wait_ms`` for another program that holds the database, and then
        raises StoreBusy. With 0 the caller never waits and can try again.
        """
        self.folder = folder
        self.site = checked_site(site)
        self._lock = lock_folder(folder)
        self._alone = RLock()
        """Held by the thread that uses the connection."""
        self._session = 0
        self._resumed = False
        """Whether the session had ended, and nothing has been written since."""
        self._next_seq = 1
        self._head = b""
        self._heads = HeadsFile(folder)
        self._kept_lists: dict[SessionKind, AllocationLists] = {}
        self._recorded: set[int] = set()
        try:
            self._connection, found = self._open()
        except BaseException:
            self._lock.release()
            raise
        self.wait_ms = wait_ms
        """How long each method that writes waits for another program."""
        try:
            with self.retrying(OPENING_WAIT_MS), self._transaction():
                self.recovered = mark_interrupted(self._connection)
                for note, payload in found:
                    insert_audit_event(self._connection, note.value, payload)
            self._keep_list()
        except StorageError as error:
            self._close()
            cause = error.__cause__
            if not isinstance(cause, sqlite3.Error):
                raise
            raise failure(f"the data folder {folder} cannot be written", cause, folder) from cause

    def __enter__(self) -> Self:
        """Return the recorder itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Close the database and let others write."""
        self._close()

    @contextmanager
    def retrying(self, wait_ms: int) -> Iterator[None]:
        """Wait so long for another program that holds the database, in place of the usual time."""
        self._set_wait(max(wait_ms, self.wait_ms))
        try:
            yield
        finally:
            self._set_wait(self.wait_ms)

    # The allocation list

    def create_allocation_list(
        self, quotas: Mapping[Condition, int], block: int, seed: int | None, *, kind: SessionKind
    ) -> tuple[AllocationSlot, ...]:
        """Fix the site's list before its first visitor, or find it; raised quotas make it longer.

        Without a seed one is drawn and stored. Raises UserInputError if another list is fixed or there is none, and
        StorageError if the disk does not take it. It waits for another program, as opening does.
        """
        with self.retrying(OPENING_WAIT_MS), self._transaction():
            return self._lists(kind=kind).create(quotas, block, seed)

    def next_slot(self, *, kind: SessionKind) -> AllocationSlot | None:
        """Return the first slot of the site's list without a completed game; None without one.

        It is computed from what is stored and nothing else. It only reads, so a program that writes is no hindrance.
        """
        with self._transaction("DEFERRED"):
            return self._lists(kind=kind).next_slot()

    def count_sessions_since(self, moment: datetime, *, kind: SessionKind) -> int:
        """Count the site's stored sessions of a kind that began at this moment, which has a zone, or later."""
        since = moment.astimezone(UTC).isoformat(timespec="milliseconds")
        with self._transaction("DEFERRED"):
            number: int = self._connection.execute(
                "SELECT count(*) FROM session WHERE site = ? AND kind = ? AND started_at >= ?",
                (self.site, int(kind), since),
            ).fetchone()[0]
        return number

    # Sessions

    def begin(self, provenance: Provenance, events: Sequence[Event]) -> Participant:
        """Write a session's row with its first events, in one transaction; returns who the visitor is from here on.

        A session that never got its end, because the disk failed it, is marked as interrupted on the way.
        """
        with self._alone:
            with self._transaction():
                mark_interrupted(self._connection)
                session = self._insert_session(provenance)
                rows = event_rows(session, 1, events, first_hash(self._connection, session))
                self._connection.executemany(INSERT_EVENT, rows)
                participant = enrol(self._connection, session, provenance.returning)
            self._session = session
            self._resumed = False
            self._next_seq = 1
            self._heads.begin()
            self._written(rows)
            self._recorded.add(session)
            return participant

    @property
    def sessions_recorded(self) -> int:
        """How many sessions were begun or gone on with by this recorder."""
        return len(self._recorded)

    def resume(self, number: int) -> Participant:
        """Go on with a session that was interrupted: the next events follow its last one.

        Raises UserInputError if there is no such session, or if it ended in another way.
        """
        with self._alone:
            with self._transaction():
                mark_interrupted(self._connection)
                seq = interrupted_at(self._connection, number)
                participant = enrol_again(self._connection, number)
                if participant is None:
                    raise UserInputError(
                        f"session {number} is from before people were numbered, so it cannot be gone on with"
                    )
                check_not_given_out_again(self._connection, number)
                self._head = last_hash(self._connection, number)
            self._session = number
            self._recorded.add(number)
            self._next_seq = 1 + seq
            self._resumed = True
            self._heads.begin()
            return participant

    def append(self, events: Sequence[Event]) -> None:
        """Write the session's next events, in one transaction; raises StorageError if the disk does not take them."""
        with self._alone:
            rows = event_rows(self._session, self._next_seq, events, self._head)
            with self._transaction():
                if self._resumed:
                    go_on(self._connection, self._session)
                self._connection.executemany(INSERT_EVENT, rows)
            self._resumed = False
            self._written(rows)

    def code_keys(self) -> tuple[bytes, ...]:
        """Return what codes are hashed with."""
        with self._transaction("DEFERRED"):
            return keys_of(self._connection)

    def returning_visitor(self, code: str, hashes: Sequence[bytes], kind: SessionKind) -> ReturningVisitor | None:
        """Return the participant who has the code with one of these hashes, and may come back to this site.

        None if there is none: the code is unknown, or its person withdrew or did not agree that visits are linked.
        """
        with self._transaction("DEFERRED"):
            session = session_with_hash(self._connection, hashes)
            if session is None:
                return None
            return returning_visitor(self._connection, session, shown_code(code, self.site), site=self.site, kind=kind)

    def append_and_withdraw(self, events: Sequence[Event]) -> None:
        """Write a session's last events and delete its rows, in one transaction; a tombstone stays.

        What is left of it in free pages and backups goes when the kiosk is opened next.
        """
        with self._alone:
            rows = event_rows(self._session, self._next_seq, events, self._head)
            with self._transaction():
                note_intention(self._connection, self.folder, self._session)
                self._connection.execute("PRAGMA secure_delete = ON")
                self._connection.executemany(INSERT_EVENT, rows)
                bury(self._connection, self._session)
            self._written(rows)

    # Outside sessions

    def count_visit(self, why: NotRecordedReason, *, kind: SessionKind) -> None:
        """Count a visitor who played without being stored; nothing else of them is kept, not even when."""
        with self._transaction():
            insert(self._connection, "visit", {"why": why.value, "kind": int(kind)})

    def add_audit_event(self, kind: str, payload: Mapping[str, Any], wall_ms: int | None = None) -> None:
        """Write down what an experimenter did outside a session; ``payload`` holds JSON values.

        ``wall_ms`` is when that was, in ms since 1970; by default now.
        """
        with self._transaction():
            insert_audit_event(self._connection, kind, payload, wall_ms)

    def _open(self) -> tuple[sqlite3.Connection, list[tuple[AuditEvent, dict[str, Any]]]]:
        """Open the database; returns also what the experimenter has to know of people who withdrew."""
        found: list[tuple[AuditEvent, dict[str, Any]]] = []
        connection = open_for_writing(self.folder)
        if not is_list_there(connection, self.folder):
            _log.warning("the list of people who withdrew is missing beside the database")
            found.append((AuditEvent.WITHDRAWN_LIST_MISSING, {"list": LIST}))
        if not is_unfinished(connection, self.folder):
            return connection, found
        connection.close()
        try:
            back = finish_cut_off(self.folder)
            if back:
                _log.warning("people who had withdrawn still stood in the database and were deleted: %s", back)
                found.append((AuditEvent.WITHDRAWN_AGAIN, {"people": back}))
        except (StorageError, UserInputError) as failed:
            # Visitors can come all the same; it is tried again at the next start, and ``verify`` tells of it.
            _log.error("%s", failed)
        return open_for_writing(self.folder), found

    def _keep_list(self) -> None:
        """Have a list of people who withdrew beside the database, which is empty at first."""
        try:
            gone = self._connection.execute("SELECT hash FROM withdrawn_code").fetchall()
            add_tombstones(self.folder, (code for (code,) in gone))
        except (OSError, sqlite3.Error) as error:
            _log.error("the list of people who withdrew could not be written: %s", reason(error, self.folder))

    def _lists(self, *, kind: SessionKind) -> AllocationLists:
        if kind not in self._kept_lists:
            self._kept_lists[kind] = AllocationLists(self._connection, self.site, kind=kind)
        return self._kept_lists[kind]

    def _written(self, rows: Sequence[EventRow]) -> None:
        """Go on from events that are on the disk."""
        self._next_seq += len(rows)
        if rows:
            self._head = rows[-1][-1]
            self._heads.write(Head(self._session, self._next_seq - 1, self._head))

    def _close(self) -> None:
        with self._alone:
            self._heads.close()
            self._connection.close()
        self._clear_end()
        self._lock.release()

    def _clear_end(self) -> None:
        """Clear what SQLite left between the rows of these sessions, so that a later withdrawal takes less time."""
        if (self.folder / f"{FILE}{LOGS[0]}").exists():
            # Another program has the database open, or the log could not be put into it.
            return
        try:
            clear_end(self.folder / FILE)
        except (OSError, ValueError) as error:
            _log.info("the end of the database was not cleared: %s", error)

    def _set_wait(self, wait_ms: int) -> None:
        with self._alone:
            self._connection.execute(f"PRAGMA busy_timeout = {wait_ms}")

    @contextmanager
    def _transaction(self, kind: str = "IMMEDIATE") -> Iterator[None]:
        self._alone.acquire()
        try:
            self._connection.execute(f"BEGIN {kind}")
            yield
            self._connection.execute("COMMIT")
        except sqlite3.Error as error:
            if primary_code(error) in BUSY:
                raise StoreBusy(f"another program holds the database: {error}") from error
            raise StorageError(f"what happened could not be written: {reason(error, self.folder)}") from error
        finally:
            # Whatever went wrong, nothing of it stays; a full disk has already ended the transaction by itself.
            if self._connection.in_transaction:
                self._connection.execute("ROLLBACK")
            self._alone.release()

    def _insert_session(self, provenance: Provenance) -> int:
        plan = provenance.plan
        if plan.visit != (provenance.returning.visit if provenance.returning else 1):
            raise ValueError(f"a plan of visit {plan.visit} is not one for {provenance.returning}")
        return insert(
            self._connection,
            "session",
            {
                "started_at": datetime.now(UTC).isoformat(timespec="milliseconds"),
                "seed": provenance.seed,
                "condition": plan.condition.name,
                "embodiment": provenance.embodiment,
                "language": plan.catalogue.language,
                "kind": int(provenance.kind),
                "version": __version__,
                "code_commit": provenance.code_commit,
                "site": self.site,
                **self._sources(plan),
                **self._allocation(provenance),
            },
        )

    def _sources(self, plan: SessionConfig) -> dict[str, str]:
        """Keep what the session follows; returns the columns that point there."""
        return {
            "deck": json.dumps(plan.deck),
            "policy_sha256": plan.policy.sha256,
            "study_sha256": plan.study_sha256,
            "settings_sha256": self._keep_source(plan.settings.model_dump_json()),
            "policy_source": self._keep_source(plan.policy.to_json()),
            "practice_deck": json.dumps(plan.practice_deck),
            "questionnaire_source": self._keep_source(QUESTIONNAIRES.dump_json(plan.questionnaires).decode()),
            "about_you_source": self._keep_source(plan.about_you.model_dump_json()),
            "information_source": self._keep_source(plan.information.model_dump_json()),
            "sentences_source": self._keep_source(json.dumps(plan.catalogue.sources, ensure_ascii=False)),
            "translations": json.dumps({each.catalogue.language: self._keep(each) for each in plan.translations}),
        }

    def _keep(self, translation: Translation) -> dict[str, str]:
        """Keep what can be said in a language that the visitor may go on in; returns the hashes."""
        return {
            "sentences": self._keep_source(json.dumps(translation.catalogue.sources, ensure_ascii=False)),
            "information": self._keep_source(translation.information.model_dump_json()),
        }

    def _allocation(self, provenance: Provenance) -> dict[str, str | int | None]:
        """How the session came to its condition, as columns."""
        slot, source = provenance.slot, provenance.allocation_source
        if (slot is not None) is not (source is AllocationSource.LIST):
            raise ValueError(f"a session whose condition came from {source} cannot take {slot}")
        if slot is None:
            return {"allocation_source": source.value if source else None}
        if slot.condition != provenance.plan.condition:
            raise ValueError(f"{slot} is not one for {provenance.plan.condition}")
        list_id = self._lists(kind=provenance.kind).list_with(slot)
        return {
            "allocation_source": AllocationSource.LIST.value,
            "allocation_list": list_id,
            "allocation_slot": slot.number,
        }

    def _keep_source(self, content: str) -> str:
        sha256 = hashlib.sha256(content.encode()).hexdigest()
        self._connection.execute("INSERT INTO source VALUES (?, ?) ON CONFLICT DO NOTHING", (sha256, content))
        return sha256
