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
)

SCHEMA = MIGRATIONS[-1].number
"""The newest step this program knows."""
