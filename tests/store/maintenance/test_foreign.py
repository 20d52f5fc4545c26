"""A database that others made or changed: each command that reads it ends in one sentence, and writes nothing."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest
from click.testing import CliRunner

from kiosk import UserInputError
from kiosk.cli.main import recollect
from kiosk.experiment.outcomes import SessionKind
from kiosk.store import connecting
from kiosk.store.database import FILE
from kiosk.store.recorder import Provenance
from kiosk.store.verify import Verification, verify
from tests.samples import mixed, plan
from tests.store.visitors import a_day

Change = Callable[[sqlite3.Connection], object]


def plainly(*statements: str) -> Change:
    """Return a change that is made of these statements."""

    def change(connection: sqlite3.Connection) -> None:
        for statement in statements:
            connection.execute(statement)

    return change


def past_triggers(*statements: str) -> Change:
    """Return a change that triggers forbid; they stand afterwards as they were made."""

    def change(connection: sqlite3.Connection) -> None:
        triggers = connection.execute("SELECT name, sql FROM sqlite_master WHERE type = 'trigger'").fetchall()
        for name, _ in triggers:
            connection.execute(f"DROP TRIGGER {name}")
        plainly(*statements, *(text for _, text in triggers))(connection)

    return change


def past_the_schema(table: str, words: str, instead: str, *statements: str) -> Change:
    """Return a change that a table forbids; its statement stands afterwards as it was made."""

    def declare(connection: sqlite3.Connection, old: str, new: str) -> None:
        connection.execute("PRAGMA writable_schema = ON")
        connection.execute("UPDATE sqlite_master SET sql = replace(sql, ?, ?) WHERE name = ?", (old, new, table))
        connection.execute("PRAGMA writable_schema = RESET")

    def change(connection: sqlite3.Connection) -> None:
        declare(connection, words, instead)
        past_triggers(*statements)(connection)
        declare(connection, instead, words)

    return change


ENDLESS = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i AS why FROM n"

OTHER_TYPE = "UPDATE sqlite_master SET sql = replace(sql, 'why TEXT', 'why ANY') WHERE name = 'visit'"

OTHER_SCHEMA: dict[str, tuple[Change, str]] = {
    "a missing table": (plainly("DROP TABLE visit"), "table visit is missing"),
    "a missing column": (
        plainly("DROP INDEX visit_twice", "ALTER TABLE visit DROP COLUMN kind"),
        "table visit is not as it was made",
    ),
    "a column more": (plainly("ALTER TABLE visit ADD COLUMN name TEXT"), "table visit is not as it was made"),
    "a column of another type": (plainly("PRAGMA writable_schema = ON", OTHER_TYPE), "table visit is not as it was"),
    "an endless view in the place of a table": (
        plainly("DROP TABLE visit", f"CREATE VIEW visit AS {ENDLESS}"),
        "visit",
    ),
    "an endless view beside the tables": (plainly(f"CREATE VIEW extra AS {ENDLESS}"), "view extra is none of ours"),
    "a trigger more": (
        plainly("CREATE TRIGGER extra AFTER INSERT ON visit BEGIN DELETE FROM audit_event; END"),
        "trigger extra is none of ours",
    ),
    "a trigger less": (plainly("DROP TRIGGER visit_is_never_deleted"), "trigger visit_is_never_deleted is missing"),
    "an index more": (plainly("CREATE INDEX extra ON visit (why)"), "index extra is none of ours"),
}

REFUSED: dict[str, tuple[Change, str]] = {
    "version 0": (plainly("PRAGMA user_version = 0"), "has the schema 0, which no released Recollect wrote"),
    "version -1": (plainly("PRAGMA user_version = -1"), "has the schema -1, which no released Recollect wrote"),
}
"""What ``verify`` refuses as well."""

_OF_99 = "SELECT 99, seq, at_ms, origin, type, payload, wall_ms, hash FROM event WHERE session = 1"
_ALIKE = (
    "(session, site, number, kind, condition, status, game_completed, withdrawn_at)"
    " SELECT 5, site, number, kind, 'TOM', 'completed', 1, '' FROM participant WHERE session = 1"
)

OTHER_CONTENT: dict[str, tuple[Change, str]] = {
    "a reason that is null": (
        past_the_schema("visit", "NOT NULL CHECK (why", "CHECK (why", "UPDATE visit SET why = NULL"),
        "NULL value in visit.why",
    ),
    "a blob in the place of a text": (
        past_the_schema("source", ") STRICT, WITHOUT", ") WITHOUT", "UPDATE source SET content = x'00ff'"),
        "non-TEXT value in source.content",
    ),
    "events of no session": (past_triggers(f"INSERT INTO event {_OF_99}"), "points at nothing in session"),
    "another seed": (past_triggers("UPDATE session SET seed = seed + 1 WHERE id = 1"), "session 1, event 1"),
    "an impossible date": (past_triggers("UPDATE session SET started_at = 'today' WHERE id = 1"), "session 1, event 1"),
    "a number that two people have": (past_triggers(f"INSERT INTO tombstone {_ALIKE}"), "stands there 2 times"),
}


@pytest.fixture(scope="module")
def pristine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a day at a booth."""
    folder = tmp_path_factory.mktemp("pristine") / "data"
    a_day(folder, Provenance(plan(policy=mixed(4)), 4, "avatar", "abc123", kind=SessionKind.SIMULATED), "MI")
    return folder


def changed(pristine: Path, folder: Path, change: Change) -> Path:
    """Return a copy of that day that was changed."""
    shutil.copytree(pristine, folder)
    with closing(sqlite3.connect(folder / FILE)) as connection, connection:
        change(connection)
    return folder


COMMANDS: dict[str, tuple[str, ...]] = {
    "merge": ("merge", "{data}", "--out", "{out}"),
    "export": ("export", "--data", "{data}", "--out", "{out}"),
    "backup": ("backup", "--data", "{data}"),
    "backup elsewhere": ("backup", "--data", "{data}", "--to", "{out}"),
}


def run(data: Path, *words: str) -> tuple[int, str]:
    """Return how a command ends on a folder, and what it says; a refusal is one sentence."""
    out = data.parent / "out"
    done = CliRunner().invoke(recollect, [word.format(data=data, out=out) for word in words])
    if isinstance(done.exception, UserInputError):
        return 2, str(done.exception)
    assert isinstance(done.exception, SystemExit | None)
    return done.exit_code, " ".join(done.output.split())


def is_refused(data: Path, words: str, *command: str) -> None:
    """Hold that a command refuses a folder in one sentence with these words, and writes nothing."""
    before = {file: file.read_bytes() for file in data.parent.rglob("*") if file.is_file()}
    code, sentence = run(data, *command)
    assert (code, len(sentence.splitlines())) == (2, 1)
    assert words in sentence
    assert {file: file.read_bytes() for file in data.parent.rglob("*") if file.is_file()} == before
    assert not (data.parent / "out").exists()


VERIFY = ("verify", "--data", "{data}")


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
@pytest.mark.parametrize("case", [*OTHER_SCHEMA.values(), *REFUSED.values()], ids=[*OTHER_SCHEMA, *REFUSED])
def test_another_schema_is_refused_by_each_command(
    pristine: Path, tmp_path: Path, case: tuple[Change, str], command: tuple[str, ...]
) -> None:
    change, words = case
    is_refused(changed(pristine, tmp_path / "data", change), words, *command)


@pytest.mark.parametrize("case", REFUSED.values(), ids=REFUSED)
def test_another_version_is_refused_by_verify_as_well(pristine: Path, tmp_path: Path, case: tuple[Change, str]) -> None:
    change, words = case
    is_refused(changed(pristine, tmp_path / "data", change), words, *VERIFY)


@pytest.mark.parametrize("case", [*OTHER_SCHEMA.values(), *OTHER_CONTENT.values()], ids=[*OTHER_SCHEMA, *OTHER_CONTENT])
def test_verify_names_it(pristine: Path, tmp_path: Path, case: tuple[Change, str]) -> None:
    change, words = case
    code, told = run(changed(pristine, tmp_path / "data", change), *VERIFY, "--json")
    assert code == 1
    assert words in told.replace('", "what": "', " ")


@pytest.mark.parametrize("case", OTHER_CONTENT.values(), ids=OTHER_CONTENT)
def test_other_content_is_not_merged_and_ends_no_command_in_a_traceback(
    pristine: Path, tmp_path: Path, case: tuple[Change, str]
) -> None:
    change, words = case
    data = changed(pristine, tmp_path / "data", change)
    is_refused(data, words, *COMMANDS["merge"])
    for name in ("export", "backup"):
        run(data, *COMMANDS[name])


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
@pytest.mark.parametrize(
    "row",
    [
        "INSERT INTO source VALUES ('', printf('%.*c', 300000, 'x'))",
        "INSERT INTO withdrawn_code VALUES (zeroblob(300000), 1)",
    ],
    ids=["text", "blob"],
)
def test_a_text_or_a_blob_beyond_the_limit_is_refused_by_each_command(
    pristine: Path, tmp_path: Path, row: str, command: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    data = changed(pristine, tmp_path / "data", past_triggers("PRAGMA ignore_check_constraints = ON", row))
    monkeypatch.setattr(connecting, "LONGEST_BYTES", 200_000)
    is_refused(data, connecting.TOO_LONG, *command)


def test_a_number_of_a_session_that_was_made_up_is_told_in_one_line(pristine: Path, tmp_path: Path) -> None:
    changes = past_triggers("UPDATE sqlite_sequence SET seq = 1000000000000000 WHERE name = 'session'")
    found = [flaw.what for flaw in verify(changed(pristine, tmp_path / "data", changes))]
    assert found == [
        "is missing, and so are all up to 1000000000000000; their numbers were given out",
        "is 1000000000000000, and the last number is 4",
    ]


def test_tables_that_are_not_ours_are_not_said_to_be_sound(pristine: Path, tmp_path: Path) -> None:
    data = changed(pristine, tmp_path / "data", OTHER_SCHEMA["an endless view in the place of a table"][0])
    assert {flaw.check for flaw in verify(data)} >= set(Verification) - {Verification.FILE}


def test_an_export_says_that_it_cannot_read_what_a_session_followed(pristine: Path, tmp_path: Path) -> None:
    data = changed(pristine, tmp_path / "data", OTHER_CONTENT["a blob in the place of a text"][0])
    code, told = run(data, *COMMANDS["export"])
    assert code == 0
    assert "caution: what session 1 followed cannot be read" in told


def test_reading_that_takes_too_many_steps_ends_in_a_sentence(
    pristine: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A file whose pages were linked by hand has tables without end."""
    data = Path(shutil.copytree(pristine, tmp_path / "data"))
    monkeypatch.setattr(connecting, "STEPS", -connecting.STEPS_PER_BYTE * (data / FILE).stat().st_size)
    monkeypatch.setattr(connecting, "_STEPS_AT_ONCE", 1)
    is_refused(data, connecting.TOO_MANY_STEPS, *COMMANDS["merge"])
