"""An event that is not what was recorded is named by each command that reads it, and the rest is there all the same."""

from __future__ import annotations

import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from kiosk import UserInputError
from kiosk.cli.main import recollect
from kiosk.experiment.events import CardFlipped
from kiosk.experiment.outcomes import SessionKind
from kiosk.experiment.replay import first_difference, replay_events
from kiosk.store.chain import read_heads
from kiosk.store.database import FILE
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from tests.experiment.driver import Driver, with_memory
from tests.samples import mixed, plan

SEED = 5
SET = "UPDATE event SET {} WHERE session = 1 AND seq = ?"
BROKEN = {
    "no object": SET.format("payload = '[1]'"),
    "no JSON": SET.format("""payload = '{"'"""),
    "no text": SET.format("payload = CAST(x'fffe' AS TEXT)"),
    "no event of ours": SET.format("type = 'Unknown'"),
    "other fields": SET.format("payload = '{}'"),
}
CHANGED = SET.format("at_ms = at_ms + 1")


@pytest.fixture(scope="module")
def pristine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with one session, played to its end."""
    folder = tmp_path_factory.mktemp("pristine") / "data"
    driver = Driver(plan(policy=mixed(SEED)), SEED)
    driver.whole_session(with_memory(SEED))
    with Recorder(folder) as recorder:
        recorder.begin(Provenance(driver.plan, SEED, "avatar", "abc123", kind=SessionKind.STUDY), driver.events)
    return folder


def broken_at(pristine: Path, folder: Path, statement: str, number: int = 3) -> int:
    """Damage a flip of the game, by its number, in a copy of the folder; return the number of the event."""
    shutil.copytree(pristine, folder)
    with closing(sqlite3.connect(folder / FILE)) as connection, connection:
        triggers = connection.execute("SELECT name, sql FROM sqlite_master WHERE type = 'trigger'").fetchall()
        for name, _ in triggers:
            connection.execute(f"DROP TRIGGER {name}")
        flips = "SELECT seq FROM event WHERE type = ? ORDER BY seq DESC LIMIT 1 OFFSET ?"
        (seq,) = connection.execute(flips, (CardFlipped.__name__, number)).fetchone()
        connection.execute("PRAGMA ignore_check_constraints = ON")
        connection.execute(statement, (seq,))
        for _, text in triggers:
            connection.execute(text)
    return int(seq)


def run(*words: object) -> Result:
    """Call the command line; what it raises is its own sentence or a failure of the test."""
    return CliRunner().invoke(recollect, [*map(str, words)])


@pytest.mark.parametrize("statement", [*BROKEN.values(), CHANGED], ids=[*BROKEN, "another time"])
def test_a_broken_event_is_named_and_the_rest_is_read(pristine: Path, tmp_path: Path, statement: str) -> None:
    seq = broken_at(pristine, tmp_path / "data", statement)
    name = f"event {seq} of session 1 ("
    out = tmp_path / "out"

    listed = run("events", 1, "--data", tmp_path / "data")
    assert name in listed.stderr
    assert len(listed.stdout.splitlines()) == len(run("events", 1, "--data", pristine).stdout.splitlines())

    explained = run("explain", 1, "--data", tmp_path / "data")
    assert name in explained.stderr
    assert explained.stdout.count("\nflip ") > 10

    written = run("export", "--data", tmp_path / "data", "--out", out, "--json")
    assert [caution for caution in json.loads(written.stdout)["cautions"] if caution.startswith(name)]

    assert json.loads(run("sessions", "--data", tmp_path / "data", "--json").stdout)[0]["status"] == "completed"
    assert run("verify", "--data", tmp_path / "data").exit_code == 1


def test_a_session_is_played_again_up_to_an_event_that_cannot_be_read(pristine: Path, tmp_path: Path) -> None:
    seq = broken_at(pristine, tmp_path / "data", BROKEN["no JSON"])
    with open_repository(tmp_path / "data") as stored:
        events = stored.readable_story(1)
        assert len(events) == seq - 1
        assert first_difference(replay_events(stored.plan(1), stored.seed(1), events), events) == seq - 1


@pytest.mark.parametrize(
    "statement",
    [
        "UPDATE session_summary SET status = 'odd'",
        "UPDATE session_summary SET stage = 'odd'",
        "UPDATE session SET allocation_source = 'odd'",
    ],
)
def test_a_session_that_cannot_be_read_is_named_and_the_others_are_listed(
    pristine: Path, tmp_path: Path, statement: str
) -> None:
    broken_at(pristine, tmp_path / "data", f"{statement} WHERE ? > 0")
    listed = run("sessions", "--data", tmp_path / "data", "--json")
    assert "session 1 cannot be read: " in listed.stderr
    assert json.loads(listed.stdout) == []


def test_an_export_and_the_list_carry_the_head_of_every_session(pristine: Path, tmp_path: Path) -> None:
    (head,) = read_heads(pristine)
    assert json.loads(run("sessions", "--data", pristine, "--json").stdout)[0]["record_sha256"] == head.hash.hex()
    assert run("export", "--data", pristine, "--out", tmp_path / "out", "--json").exit_code == 0
    (participants,) = (tmp_path / "out" / "data").glob("*participants*.csv")
    assert head.hash.hex() in participants.read_text("utf-8")


def test_a_session_that_names_no_embodiment_there_is_ends_in_a_sentence(pristine: Path, tmp_path: Path) -> None:
    broken_at(pristine, tmp_path / "data", "UPDATE session SET embodiment = 'one' || char(10) || 'two' WHERE ?")
    for command in (["export", "--out", tmp_path / "out"], ["day", "--out", tmp_path / "day.html"]):
        refused = run(*command, "--data", tmp_path / "data").exception
        assert isinstance(refused, UserInputError), command
        assert str(refused).startswith(r"session 1 names the embodiment 'one\ntwo', but there is none of that name")
    assert run("sessions", "--data", tmp_path / "data").exit_code == 0
    assert run("verify", "--data", tmp_path / "data").exit_code == 1
