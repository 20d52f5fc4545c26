"""Keep one row about each session, and counts by outcome, so that no query grows.

Triggers of the database write both, in the transaction that records the session itself. Nothing else of the record
depends on them: they say again what the events say, and ``verify`` compares the two.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from typing import Any

_TABLES = (
    # status is null while the session is under way. duration_ms and ended_ms are its end's at_ms and wall_ms.
    """
    CREATE TABLE session_summary (
        session INTEGER PRIMARY KEY REFERENCES session (id),
        status TEXT,
        game_completed INTEGER NOT NULL DEFAULT 0 CHECK (game_completed IN (0, 1)),
        stage TEXT,
        flips INTEGER,
        pairs INTEGER,
        hints INTEGER,
        duration_ms INTEGER,
        ended_ms INTEGER
    ) STRICT
    """,
    "CREATE INDEX session_under_way ON session_summary (session) WHERE status IS NULL",
    """
    CREATE TABLE session_tally (
        kind INTEGER NOT NULL,
        site TEXT NOT NULL,
        condition TEXT NOT NULL,
        allocation_source TEXT NOT NULL,
        game_completed INTEGER NOT NULL,
        ended INTEGER NOT NULL,
        sessions INTEGER NOT NULL,
        PRIMARY KEY (kind, site, condition, allocation_source, game_completed, ended)
    ) STRICT, WITHOUT ROWID
    """,
    # For the newest sessions of a kind: it holds their numbers, in order.
    "CREATE INDEX session_kind ON session (kind)",
    "CREATE INDEX session_began ON session (kind, started_at)",
    "CREATE INDEX session_slot ON session (site, kind, allocation_slot) WHERE allocation_source = 'list'",
)

NUMBERS = ("status", "game_completed", "stage", "flips", "pairs", "hints", "duration_ms", "ended_ms")
"""The columns of a summary that follow from the events."""


def _numbers(session: str) -> str:
    """Return the query of the numbers of a session that has ended, which this SQL expression names.

    The flips, pairs and hints are those on the last board that was dealt in the stage of the game.
    """
    # Not by values that a user gives: the expression is ours.
    return f"""
        SELECT
            (SELECT json_extract(payload, '$.status') FROM event WHERE session = {session} ORDER BY seq DESC LIMIT 1),
            EXISTS (SELECT 1 FROM event WHERE session = {session} AND type = 'GameFinished'),
            (SELECT json_extract(payload, '$.stage') FROM event WHERE session = {session} AND type = 'StageEntered'
                AND json_extract(payload, '$.stage') <> 'over' ORDER BY seq DESC LIMIT 1),
            count(*) FILTER (WHERE type = 'CardFlipped'),
            count(*) FILTER (WHERE type = 'CardFlipped' AND json_extract(payload, '$.matched')),
            count(*) FILTER (WHERE type = 'HintGiven'),
            (SELECT at_ms FROM event WHERE session = {session} ORDER BY seq DESC LIMIT 1),
            (SELECT wall_ms FROM event WHERE session = {session} ORDER BY seq DESC LIMIT 1)
        FROM event WHERE session = {session} AND seq > (
            SELECT max(seq) FROM event AS board WHERE session = {session} AND type = 'BoardDealt' AND 'game' = (
                SELECT json_extract(payload, '$.stage') FROM event AS entered WHERE entered.session = {session}
                AND entered.seq < board.seq AND entered.type = 'StageEntered' ORDER BY entered.seq DESC LIMIT 1
            )
        )
    """  # noqa: S608


_ENDED = "(SELECT type FROM event WHERE event.session = {session} ORDER BY seq DESC LIMIT 1) = 'SessionEnded'"
_SET = f"UPDATE session_summary SET ({', '.join(NUMBERS)}) = "  # noqa: S608 - the names are ours
_TALLY_KEY = "kind, site, condition, coalesce(allocation_source, '')"


def _count(row: str, by: int) -> str:
    """Return the statement that adds to the count of the sessions that are as a row of the summary says."""
    return f"""
        INSERT INTO session_tally
        SELECT {_TALLY_KEY}, {row}.game_completed, {row}.status IS NOT NULL, {by} FROM session WHERE id = {row}.session
        ON CONFLICT DO UPDATE SET sessions = sessions + {by};
    """  # noqa: S608 - the names are ours


_TRIGGERS = (
    f"""
    CREATE TRIGGER session_summary_is_counted AFTER INSERT ON session_summary
    BEGIN {_count("NEW", 1)} END
    """,
    f"""
    CREATE TRIGGER session_summary_is_counted_anew
    AFTER UPDATE ON session_summary
    WHEN OLD.game_completed <> NEW.game_completed OR (OLD.status IS NULL) <> (NEW.status IS NULL)
    BEGIN {_count("OLD", -1)} {_count("NEW", 1)} END
    """,
    f"""
    CREATE TRIGGER session_summary_is_counted_no_more BEFORE DELETE ON session_summary
    BEGIN {_count("OLD", -1)} END
    """,
    """
    CREATE TRIGGER session_summary_goes_with_its_session BEFORE DELETE ON session
    BEGIN DELETE FROM session_summary WHERE session = OLD.id; END
    """,
    """
    CREATE TRIGGER session_summary_begins AFTER INSERT ON session
    BEGIN INSERT INTO session_summary (session) VALUES (NEW.id); END
    """,
    """
    CREATE TRIGGER session_summary_of_a_game AFTER INSERT ON event WHEN NEW.type = 'GameFinished'
    BEGIN UPDATE session_summary SET game_completed = 1 WHERE session = NEW.session; END
    """,
    f"""
    CREATE TRIGGER session_summary_of_an_end AFTER INSERT ON event WHEN NEW.type = 'SessionEnded'
    BEGIN {_SET} ({_numbers("NEW.session")}) WHERE session = NEW.session; END
    """,
    """
    CREATE TRIGGER session_summary_of_a_resumption AFTER INSERT ON event WHEN NEW.type = 'SessionResumed'
    BEGIN UPDATE session_summary SET status = NULL WHERE session = NEW.session; END
    """,
)

_FILL = (
    "UPDATE session_summary SET game_completed ="
    " EXISTS (SELECT 1 FROM event WHERE event.session = session_summary.session AND type = 'GameFinished')",
    f"{_SET} ({_numbers('session_summary.session')}) WHERE {_ENDED.format(session='session_summary.session')}",
)

STATEMENTS = (*_TABLES, *_TRIGGERS)
"""What makes the summaries and their triggers."""


def fill_summaries(connection: sqlite3.Connection) -> None:
    """Write the summary of every session from its events, for events that came without the triggers."""
    for statement in _FILL:
        connection.execute(statement)


def go_on(connection: sqlite3.Connection, session: int) -> None:
    """Note that a session that had ended is under way again; the caller writes its next event."""
    connection.execute("UPDATE session_summary SET status = NULL WHERE session = ?", (session,))


def numbers_so_far(connection: sqlite3.Connection, session: int) -> dict[str, Any]:
    """Return the numbers of a session that is under way, by the columns of its summary; it has no status."""
    row = connection.execute(_numbers(":session"), {"session": session}).fetchone()
    return dict(zip(NUMBERS, row, strict=True)) | {"status": None, "ended_ms": None}


def wrong_summaries(connection: sqlite3.Connection) -> Iterator[tuple[int, str]]:
    """Yield each session of which the summary does not say what the events say, and how it differs."""
    columns = ", ".join(NUMBERS)
    rows = connection.execute(
        f"""
        SELECT session.id, {columns}, {_ENDED.format(session="session.id")} FROM session
        LEFT JOIN session_summary ON session_summary.session = session.id
        """  # noqa: S608 - the names are ours
    ).fetchall()
    for session, *kept, ended in rows:
        if not ended:
            if kept[0] is not None:
                yield session, "is said to have ended, and has not"
            continue
        numbers = connection.execute(_numbers(":session"), {"session": session}).fetchone()
        wrong = [name for name, there, true in zip(NUMBERS, kept, numbers, strict=True) if there != true]
        if wrong:
            yield session, f"is not what its events say: {', '.join(wrong)}"


def wrong_tally(connection: sqlite3.Connection) -> bool:
    """Tell whether the counts of sessions by outcome are other than the summaries say."""
    counted = f"""
        SELECT {_TALLY_KEY}, game_completed, status IS NOT NULL, count(*)
        FROM session JOIN session_summary ON session_summary.session = session.id GROUP BY 1, 2, 3, 4, 5, 6
    """  # noqa: S608 - the names are ours
    kept = "SELECT * FROM session_tally WHERE sessions <> 0"
    return set(connection.execute(counted)) != set(connection.execute(kept))
