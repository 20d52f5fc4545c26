"""The shape of the database, as numbered steps that are applied once each and leave a receipt; none is ever edited."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass


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


MIGRATIONS: tuple[Migration, ...] = (
    Migration(
        1,
        "sittings and their events",
        (
            """
            CREATE TABLE migration (
                number INTEGER PRIMARY KEY,
                name TEXT NOT NULL,
                sha256 TEXT NOT NULL,
                applied_at TEXT NOT NULL
            ) STRICT
            """,
            # Whatever a sitting followed is kept once under its hash, so that it can be replayed without the files.
            """
            CREATE TABLE source (
                sha256 TEXT PRIMARY KEY,
                content TEXT NOT NULL
            ) STRICT, WITHOUT ROWID
            """,
            """
            CREATE TABLE sitting (
                id INTEGER PRIMARY KEY AUTOINCREMENT,
                started_at TEXT NOT NULL,
                seed INTEGER NOT NULL,
                condition TEXT NOT NULL,
                body TEXT NOT NULL,
                language TEXT NOT NULL,
                simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)),
                version TEXT NOT NULL,
                code_commit TEXT NOT NULL,
                deck TEXT NOT NULL,
                policy_sha256 TEXT NOT NULL,
                settings_sha256 TEXT NOT NULL REFERENCES source (sha256),
                policy_source TEXT NOT NULL REFERENCES source (sha256),
                questionnaire_source TEXT NOT NULL REFERENCES source (sha256),
                sentences_source TEXT NOT NULL REFERENCES source (sha256)
            ) STRICT
            """,
            """
            CREATE TABLE event (
                sitting INTEGER NOT NULL REFERENCES sitting (id),
                seq INTEGER NOT NULL,
                at_ms INTEGER NOT NULL,
                origin TEXT NOT NULL CHECK (origin IN ('world', 'session', 'recovery')),
                type TEXT NOT NULL,
                body TEXT NOT NULL CHECK (json_valid(body)),
                PRIMARY KEY (sitting, seq)
            ) STRICT, WITHOUT ROWID
            """,
            *(
                f"""
                CREATE TRIGGER {table}_is_never_{deed}d BEFORE {deed} ON {table}
                BEGIN SELECT RAISE(ABORT, 'what is recorded is never changed'); END
                """
                for table in ("event", "sitting", "source", "migration")
                for deed in ("update", "delete")
            ),
            # INSERT OR REPLACE deletes the row in its way without asking the triggers above.
            *(
                f"""
                CREATE TRIGGER {table}_is_never_replaced BEFORE INSERT ON {table}
                WHEN EXISTS (SELECT 1 FROM {table} WHERE {in_its_way})
                BEGIN SELECT RAISE(ABORT, 'what is recorded is never changed'); END
                """  # noqa: S608 - the names are ours
                for table, in_its_way in (
                    ("event", "sitting = NEW.sitting AND seq = NEW.seq"),
                    ("sitting", "id = NEW.id"),
                    ("source", "sha256 = NEW.sha256 AND content IS NOT NEW.content"),
                    ("migration", "number = NEW.number"),
                )
            ),
        ),
    ),
    Migration(
        2,
        "participants, places, and what becomes of them",
        (
            # A list of places is fixed before the first visitor; a later row of a site goes on from its earlier one.
            """
            CREATE TABLE allocation (
                id INTEGER PRIMARY KEY AUTOINCREMENT,
                site TEXT NOT NULL,
                simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)),
                seed INTEGER NOT NULL,
                block INTEGER NOT NULL,
                quotas TEXT NOT NULL CHECK (json_valid(quotas)),
                places TEXT NOT NULL CHECK (json_valid(places)),
                fixed_at TEXT NOT NULL
            ) STRICT
            """,
            "ALTER TABLE sitting ADD COLUMN site TEXT NOT NULL DEFAULT ''",
            "ALTER TABLE sitting ADD COLUMN list INTEGER REFERENCES allocation (id)",
            "ALTER TABLE sitting ADD COLUMN place INTEGER CHECK ((place IS NULL) = (list IS NULL))",
            """
            ALTER TABLE sitting ADD COLUMN allotted TEXT
            CHECK (allotted IN ('list', 'override', 'beyond') AND (allotted IS 'list') = (place IS NOT NULL))
            """,
            "ALTER TABLE sitting ADD COLUMN information_source TEXT REFERENCES source (sha256)",
            "ALTER TABLE sitting ADD COLUMN about_you_source TEXT REFERENCES source (sha256)",
            "ALTER TABLE sitting ADD COLUMN practice_deck TEXT",
            # The wall's clock when it was written, ms since 1970; at_ms goes on counting from the sitting's start.
            "ALTER TABLE event ADD COLUMN wall_ms INTEGER",
            # Who finished a game is asked before every sitting.
            "CREATE INDEX game_finished ON event (sitting) WHERE type = 'GameFinished'",
            # Rehearsals count for themselves, so that none uses up a real number or place.
            """
            CREATE TABLE participant (
                sitting INTEGER PRIMARY KEY REFERENCES sitting (id),
                site TEXT NOT NULL,
                simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)),
                number INTEGER NOT NULL,
                code TEXT NOT NULL UNIQUE,
                UNIQUE (site, simulated, number)
            ) STRICT
            """,
            # People who played without being stored: no time, nothing that could tell them apart.
            """
            CREATE TABLE visit (
                id INTEGER PRIMARY KEY AUTOINCREMENT,
                why TEXT NOT NULL CHECK (why IN ('declined', 'under_age', 'left')),
                simulated INTEGER NOT NULL CHECK (simulated IN (0, 1))
            ) STRICT
            """,
            # What stays of a sitting that was withdrawn, so that counts still add up.
            """
            CREATE TABLE tombstone (
                sitting INTEGER PRIMARY KEY,
                site TEXT NOT NULL,
                number INTEGER NOT NULL,
                simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)),
                condition TEXT NOT NULL,
                list INTEGER REFERENCES allocation (id),
                place INTEGER,
                allotted TEXT,
                status TEXT NOT NULL,
                game_completed INTEGER NOT NULL CHECK (game_completed IN (0, 1)),
                withdrawn_at TEXT NOT NULL,
                UNIQUE (site, simulated, number)
            ) STRICT
            """,
            # What experimenters did outside sittings.
            """
            CREATE TABLE booth_event (
                id INTEGER PRIMARY KEY AUTOINCREMENT,
                wall_ms INTEGER NOT NULL,
                type TEXT NOT NULL,
                body TEXT NOT NULL CHECK (json_valid(body))
            ) STRICT
            """,
            *(
                f"""
                CREATE TRIGGER {table}_is_never_{deed}d BEFORE {deed} ON {table}
                BEGIN SELECT RAISE(ABORT, 'what is recorded is never changed'); END
                """
                for table, deeds in (
                    ("allocation", ("update", "delete")),
                    ("visit", ("update", "delete")),
                    ("tombstone", ("update", "delete")),
                    ("booth_event", ("update", "delete")),
                    ("participant", ("update",)),
                )
                for deed in deeds
            ),
            *(
                f"""
                CREATE TRIGGER {table}_is_never_replaced BEFORE INSERT ON {table}
                WHEN EXISTS (SELECT 1 FROM {table} WHERE {in_its_way})
                BEGIN SELECT RAISE(ABORT, 'what is recorded is never changed'); END
                """  # noqa: S608 - the names are ours
                for table, in_its_way in (
                    ("allocation", "id = NEW.id"),
                    ("visit", "id = NEW.id"),
                    ("booth_event", "id = NEW.id"),
                    (
                        "participant",
                        "sitting = NEW.sitting OR code = NEW.code"
                        " OR (site = NEW.site AND simulated = NEW.simulated AND number = NEW.number)",
                    ),
                    (
                        "tombstone",
                        "sitting = NEW.sitting"
                        " OR (site = NEW.site AND simulated = NEW.simulated AND number = NEW.number)",
                    ),
                )
            ),
            # Where there is a tombstone, and nowhere else, a sitting may go, and it does not come back.
            "DROP TRIGGER event_is_never_deleted",
            "DROP TRIGGER sitting_is_never_deleted",
            *(
                f"""
                CREATE TRIGGER {table}_is_deleted_only_when_withdrawn BEFORE delete ON {table}
                WHEN NOT EXISTS (SELECT 1 FROM tombstone WHERE sitting = OLD.{sitting})
                BEGIN SELECT RAISE(ABORT, 'what is recorded is never changed'); END
                """  # noqa: S608 - the names are ours
                for table, sitting in (("event", "sitting"), ("sitting", "id"), ("participant", "sitting"))
            ),
            """
            CREATE TRIGGER sitting_that_was_withdrawn_stays_so BEFORE INSERT ON sitting
            WHEN EXISTS (SELECT 1 FROM tombstone WHERE sitting = NEW.id)
            BEGIN SELECT RAISE(ABORT, 'what was withdrawn does not come back'); END
            """,
        ),
    ),
    Migration(
        3,
        "withdrawals that are not finished",
        (
            # A row comes with its tombstone, and goes when no file of the folder holds the participant any more.
            # The hash tells whether the code that is given again is theirs; the code itself has gone.
            """
            CREATE TABLE unfinished_withdrawal (
                sitting INTEGER PRIMARY KEY REFERENCES tombstone (sitting),
                code_sha256 TEXT NOT NULL
            ) STRICT
            """,
        ),
    ),
    Migration(
        4,
        "trials, which count for themselves as rehearsals do",
        (
            # SQLite has no statement for a wider CHECK. Nothing that is stored changes with it, so the text may be
            # edited, as its documentation of ALTER TABLE describes; making these tables anew would cost numbers that
            # were given out to those who withdrew.
            "PRAGMA writable_schema = ON",
            """
            UPDATE sqlite_schema SET sql = replace(sql, 'simulated IN (0, 1)', 'simulated IN (0, 1, 2)')
            WHERE type = 'table' AND name IN ('sitting', 'participant', 'visit', 'allocation', 'tombstone')
            """,
            "PRAGMA writable_schema = RESET",
        ),
    ),
)

SCHEMA = MIGRATIONS[-1].number
"""The newest step this program knows."""
