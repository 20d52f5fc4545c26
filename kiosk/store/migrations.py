"""Lay out the database, in steps from version to version, and keep what is recorded from being changed."""

from __future__ import annotations

import hashlib

from kiosk.lazy_dataclass import dataclass
from kiosk.store.summaries import STATEMENTS as SUMMARIES


@dataclass(frozen=True)
class Migration:
    """One step: statements that bring a database of the step before to this one."""

    number: int
    name: str
    statements: tuple[str, ...]

    @property
    def sha256(self) -> str:
        """The hash of its statements, for the receipt."""
        return hashlib.sha256("\n".join(self.statements).encode()).hexdigest()


_TABLES = (
    """
    CREATE TABLE migration (
        number INTEGER PRIMARY KEY,
        name TEXT NOT NULL,
        sha256 TEXT NOT NULL,
        applied_at TEXT NOT NULL
    ) STRICT
    """,
    # The files that a session follows are kept once, under their hash, so that it can be replayed without them.
    """
    CREATE TABLE source (
        sha256 TEXT PRIMARY KEY,
        content TEXT NOT NULL
    ) STRICT, WITHOUT ROWID
    """,
    # The slots of a list are fixed before its first visitor; a later list of a site continues its earlier one.
    """
    CREATE TABLE allocation_list (
        id INTEGER PRIMARY KEY AUTOINCREMENT,
        site TEXT NOT NULL,
        kind INTEGER NOT NULL CHECK (kind IN (0, 1, 2)),
        seed INTEGER NOT NULL,
        block_size INTEGER NOT NULL,
        quotas TEXT NOT NULL CHECK (json_valid(quotas)),
        slots TEXT NOT NULL CHECK (json_valid(slots)),
        fixed_at TEXT NOT NULL
    ) STRICT
    """,
    """
    CREATE TABLE session (
        id INTEGER PRIMARY KEY AUTOINCREMENT,
        started_at TEXT NOT NULL,
        seed INTEGER NOT NULL,
        condition TEXT NOT NULL,
        embodiment TEXT NOT NULL,
        language TEXT NOT NULL,
        kind INTEGER NOT NULL CHECK (kind IN (0, 1, 2)),
        version TEXT NOT NULL,
        code_commit TEXT NOT NULL,
        deck TEXT NOT NULL,
        policy_sha256 TEXT NOT NULL,
        study_sha256 TEXT NOT NULL DEFAULT '',
        settings_sha256 TEXT NOT NULL REFERENCES source (sha256),
        policy_source TEXT NOT NULL REFERENCES source (sha256),
        questionnaire_source TEXT NOT NULL REFERENCES source (sha256),
        sentences_source TEXT NOT NULL REFERENCES source (sha256),
        site TEXT NOT NULL DEFAULT '',
        allocation_list INTEGER REFERENCES allocation_list (id),
        allocation_slot INTEGER CHECK ((allocation_slot IS NULL) = (allocation_list IS NULL)),
        allocation_source TEXT CHECK (
            allocation_source IN ('list', 'override', 'beyond', 'returning')
            AND (allocation_source IS 'list') = (allocation_slot IS NOT NULL)
        ),
        information_source TEXT NOT NULL REFERENCES source (sha256),
        about_you_source TEXT NOT NULL REFERENCES source (sha256),
        practice_deck TEXT NOT NULL,
        translations TEXT NOT NULL DEFAULT '{}' CHECK (json_valid(translations))
    ) STRICT
    """,
    # at_ms counts from the start of the session; wall_ms is the time of day at which it was written, ms since 1970.
    # Each hash is chained to the one before it, as the module chain says.
    """
    CREATE TABLE event (
        session INTEGER NOT NULL REFERENCES session (id),
        seq INTEGER NOT NULL,
        at_ms INTEGER NOT NULL,
        origin TEXT NOT NULL CHECK (origin IN ('world', 'session', 'recovery')),
        type TEXT NOT NULL,
        payload TEXT NOT NULL CHECK (json_valid(payload)),
        wall_ms INTEGER,
        hash BLOB NOT NULL CHECK (length(hash) = 32),
        PRIMARY KEY (session, seq)
    ) STRICT, WITHOUT ROWID
    """,
    # Where the events of each session end, so that a lost end is found.
    """
    CREATE TABLE head (
        session INTEGER PRIMARY KEY REFERENCES session (id),
        events INTEGER NOT NULL,
        hash BLOB NOT NULL CHECK (length(hash) = 32)
    ) STRICT
    """,
    # Every session that begins asks who finished a game.
    "CREATE INDEX game_finished ON event (session) WHERE type = 'GameFinished'",
    # Each kind of session has numbers of its own, so that a rehearsal uses up no participant's number. Someone who
    # comes back keeps the number, and the visit counts from 1.
    """
    CREATE TABLE participant (
        session INTEGER PRIMARY KEY REFERENCES session (id),
        site TEXT NOT NULL,
        kind INTEGER NOT NULL CHECK (kind IN (0, 1, 2)),
        number INTEGER NOT NULL,
        visit INTEGER NOT NULL DEFAULT 1 CHECK (visit >= 1),
        UNIQUE (site, kind, number, visit)
    ) STRICT
    """,
    # What codes are hashed with: made with the database. A merged one has the key of each part.
    "CREATE TABLE code_key (key BLOB PRIMARY KEY CHECK (length(key) = 32)) STRICT, WITHOUT ROWID",
    "INSERT INTO code_key VALUES (randomblob(32))",
    # The codes themselves are only on the visitors' screens and paper. A session that is gone on with has several.
    """
    CREATE TABLE withdrawal_code (
        hash BLOB PRIMARY KEY CHECK (length(hash) = 32),
        session INTEGER NOT NULL REFERENCES session (id)
    ) STRICT, WITHOUT ROWID
    """,
    # Visitors who are not stored are only counted: a time would tell them apart.
    """
    CREATE TABLE visit (
        id INTEGER PRIMARY KEY AUTOINCREMENT,
        why TEXT NOT NULL CHECK (why IN ('declined', 'under_age', 'left')),
        kind INTEGER NOT NULL CHECK (kind IN (0, 1, 2))
    ) STRICT
    """,
    # What stays of a session that was withdrawn, so that counts still add up.
    """
    CREATE TABLE tombstone (
        session INTEGER PRIMARY KEY,
        site TEXT NOT NULL,
        number INTEGER NOT NULL,
        kind INTEGER NOT NULL CHECK (kind IN (0, 1, 2)),
        condition TEXT NOT NULL,
        allocation_list INTEGER REFERENCES allocation_list (id),
        allocation_slot INTEGER,
        allocation_source TEXT,
        status TEXT NOT NULL,
        game_completed INTEGER NOT NULL CHECK (game_completed IN (0, 1)),
        withdrawn_at TEXT NOT NULL,
        visit INTEGER NOT NULL DEFAULT 1 CHECK (visit >= 1),
        UNIQUE (site, kind, number, visit)
    ) STRICT
    """,
    # What experimenters did outside sessions.
    """
    CREATE TABLE audit_event (
        id INTEGER PRIMARY KEY AUTOINCREMENT,
        wall_ms INTEGER NOT NULL,
        type TEXT NOT NULL,
        payload TEXT NOT NULL CHECK (json_valid(payload))
    ) STRICT
    """,
    # The hashes stay, so that an older copy that still has the person can be found.
    """
    CREATE TABLE withdrawn_code (
        hash BLOB PRIMARY KEY CHECK (length(hash) = 32),
        session INTEGER NOT NULL REFERENCES tombstone (session)
    ) STRICT, WITHOUT ROWID
    """,
    # A row comes with its tombstone and goes once no file of the folder holds the participant's data.
    "CREATE TABLE unfinished_withdrawal (session INTEGER PRIMARY KEY REFERENCES tombstone (session)) STRICT",
)

_TWICE = {
    "migration": "number, name, sha256, applied_at",
    "allocation_list": "site, kind, seed, block_size, quotas, slots, fixed_at",
    "code_key": "key",
    "withdrawal_code": "session",
    "withdrawn_code": "session",
    "visit": "why, kind",
    "tombstone": (
        "site, number, kind, condition, allocation_list, allocation_slot, allocation_source, status, game_completed,"
        " withdrawn_at, visit"
    ),
    "audit_event": "wall_ms, type, payload",
    "session_tally": "sessions",
}
"""What no hash covers stands in an index as well: SQLite compares the two, so that verify finds a changed bit."""

_INDEXES = tuple(f"CREATE INDEX {table}_twice ON {table} ({columns})" for table, columns in _TWICE.items())

_NEVER_CHANGED = {
    "source": ("update", "delete"),
    "migration": ("update", "delete"),
    "allocation_list": ("update", "delete"),
    "visit": ("update", "delete"),
    "tombstone": ("update", "delete"),
    "audit_event": ("update", "delete"),
    "code_key": ("update",),
    "withdrawn_code": ("update", "delete"),
    "withdrawal_code": ("update",),
    "session": ("update",),
    "event": ("update",),
    "participant": ("update",),
}
"""The statements that no row of a table takes."""

_SAME_VISIT = "(site = NEW.site AND kind = NEW.kind AND number = NEW.number AND visit = NEW.visit)"

_IN_ITS_WAY = {
    "event": "session = NEW.session AND seq = NEW.seq",
    "session": "id = NEW.id",
    "source": "sha256 = NEW.sha256 AND content IS NOT NEW.content",
    "migration": "number = NEW.number",
    "allocation_list": "id = NEW.id",
    "visit": "id = NEW.id",
    "audit_event": "id = NEW.id",
    "withdrawal_code": "hash = NEW.hash",
    "withdrawn_code": "hash = NEW.hash",
    "participant": f"session = NEW.session OR {_SAME_VISIT}",
    "tombstone": f"session = NEW.session OR {_SAME_VISIT}",
}
"""Which row a new one would replace: INSERT OR REPLACE deletes it without asking the triggers on delete."""

_GONE_WHEN_WITHDRAWN = {
    "event": "session",
    "session": "id",
    "participant": "session",
    "withdrawal_code": "session",
    "head": "session",
}
"""Tables whose rows may be deleted once there is a tombstone of their session, which this column names."""

_TRIGGERS = (
    *(
        f"""
        CREATE TRIGGER {table}_is_never_{change}d BEFORE {change} ON {table}
        BEGIN SELECT RAISE(ABORT, 'what is recorded is never changed'); END
        """
        for table, changes in _NEVER_CHANGED.items()
        for change in changes
    ),
    *(
        f"""
        CREATE TRIGGER {table}_is_never_replaced BEFORE INSERT ON {table}
        WHEN EXISTS (SELECT 1 FROM {table} WHERE {in_its_way})
        BEGIN SELECT RAISE(ABORT, 'what is recorded is never changed'); END
        """  # noqa: S608 - the names are ours
        for table, in_its_way in _IN_ITS_WAY.items()
    ),
    *(
        f"""
        CREATE TRIGGER {table}_is_deleted_only_when_withdrawn BEFORE delete ON {table}
        WHEN NOT EXISTS (SELECT 1 FROM tombstone WHERE session = OLD.{column})
        BEGIN SELECT RAISE(ABORT, 'what is recorded is never changed'); END
        """  # noqa: S608 - the names are ours
        for table, column in _GONE_WHEN_WITHDRAWN.items()
    ),
    """
    CREATE TRIGGER event_moves_the_head AFTER INSERT ON event
    BEGIN
        INSERT INTO head VALUES (NEW.session, NEW.seq, NEW.hash)
        ON CONFLICT DO UPDATE SET events = NEW.seq, hash = NEW.hash WHERE NEW.seq > events;
    END
    """,
    """
    CREATE TRIGGER head_never_goes_back BEFORE update ON head
    WHEN NEW.session <> OLD.session OR NEW.events <= OLD.events
    BEGIN SELECT RAISE(ABORT, 'what is recorded is never changed'); END
    """,
    """
    CREATE TRIGGER session_that_was_withdrawn_stays_so BEFORE INSERT ON session
    WHEN EXISTS (SELECT 1 FROM tombstone WHERE session = NEW.id)
    BEGIN SELECT RAISE(ABORT, 'what was withdrawn does not come back'); END
    """,
)

MIGRATIONS: tuple[Migration, ...] = (Migration(6, "the tables of 0.2", (*_TABLES, *_TRIGGERS, *SUMMARIES, *_INDEXES)),)
"""Every step so far, the first one creates the database; a step that was released never changes.

Earlier steps were never released, and their databases are not read.
"""

SCHEMA = MIGRATIONS[-1].number
"""The newest step this program knows."""
