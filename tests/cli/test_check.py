"""``recollect check``: a table for people, results for programs, an exit code for scripts; nothing is left behind."""

from __future__ import annotations

import json
import os
import sys
import threading
from collections.abc import Callable, Iterable, Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from kiosk.cli import check as command
from kiosk.cli import composition
from kiosk.cli.check import BUSY, LEAST_MIB, Load, log_check, machine_check, program_check, run_checks
from kiosk.cli.composition import code_commit, code_made
from kiosk.cli.log import LOG, LOG_BYTES
from kiosk.cli.main import main
from kiosk.preflight import Check, CheckResult, Severity
from kiosk.store.recorder import Recorder
from tests.patience import PATIENCE_S

GOOD, WARNING, BAD = (
    CheckResult.ok("a", "fine"),
    CheckResult.warning("b", "so-so [1]", "mend"),
    CheckResult.error("c", "no", "mend"),
)


class Called(NamedTuple):
    """How a command ended, and what it said."""

    code: int
    out: str
    err: str


Recollect = Callable[..., Called]


@pytest.fixture
def recollect(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Recollect:
    """Return the command line, on a machine without a screen."""
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)

    def call(*arguments: str | Path) -> Called:
        monkeypatch.setattr(sys, "argv", ["recollect", "check", *map(str, arguments)])
        with pytest.raises(SystemExit) as left:
            main()
        said = capsys.readouterr()
        return Called(int(left.value.code or 0), said.out, said.err)

    return call


@pytest.fixture
def finding(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Have these be found, in place of all that is really there."""

    def find(*results: CheckResult) -> None:
        monkeypatch.setattr(command, "all_checks", lambda _: [Check("all", lambda: results)])

    return find


def untold(_: int, of: int | None = None, /) -> None:
    """Ignore the progress."""


# Everything at once


def test_all_of_a_booth_is_looked_at_and_nothing_is_left_behind(recollect: Recollect, tmp_path: Path) -> None:
    called = recollect("--data", tmp_path / "data", "--json")
    found = json.loads(called.out)
    names = {each["name"] for each in found["results"]}
    assert names >= {"study file", "languages", "policy", "PIN", "shortcuts", "screen", "drawing", "sound", "robot"}
    assert names >= {
        "voice: en",
        "voice: it",
        "voice: es",
        "disk",
        "data folder",
        "writing",
        "database",
        "allocation list",
    }
    assert names >= {"clock", "machine", "program", "log", "kept up"}
    assert {each["name"] for each in found["results"] if each["severity"] == "error"} == {"screen"}
    assert all(bool(each["remedy"]) is (each["severity"] != "ok") for each in found["results"])
    assert (called.code, found["ready"]) == (1, False)
    assert list(tmp_path.iterdir()) == []


def test_a_study_file_that_cannot_be_used_is_bad_input_and_the_rest_is_looked_at_all_the_same(
    recollect: Recollect, tmp_path: Path
) -> None:
    study = tmp_path / "study.toml"
    study.write_text('languages = ["tlh"]\n[screen]\ndisplay = -1\n')
    called = recollect("--study", study, "--data", tmp_path / "data", "--json")
    found = json.loads(called.out)
    bad = [each["message"] for each in found["results"] if each["name"] == "study file"]
    assert called.code == 2
    assert len(bad) == 1
    assert "screen.display" in bad[0]
    assert bad[0] in called.err
    assert found["ready"] is False
    assert {"disk", "drawing", "clock"} <= {each["name"] for each in found["results"]}


@pytest.mark.parametrize("arguments", [["--study", "nothing.toml"], ["--site", "r o m e"], ["--data", __file__]])
def test_what_cannot_be_used_is_refused_with_its_name(
    arguments: list[str], recollect: Recollect, finding: Callable[..., None]
) -> None:
    finding(GOOD)
    called = recollect(*arguments)
    assert called.code == 2
    assert arguments[1] in called.err


# The verdict


@pytest.mark.parametrize(
    ("results", "verdict"),
    [
        ([GOOD], (0, "warnings: none")),
        ([GOOD, WARNING, WARNING], (0, "warnings: 2")),
        ([GOOD, WARNING, BAD], (1, "No session can be held")),
    ],
)
def test_a_session_can_be_held_with_warnings_and_not_with_anything_bad(
    results: list[CheckResult],
    verdict: tuple[int, str],
    recollect: Recollect,
    finding: Callable[..., None],
    tmp_path: Path,
) -> None:
    finding(*results)
    called = recollect("--data", tmp_path / "data")
    code, words = verdict
    assert (called.code, words in called.out) == (code, True)


def test_the_table_says_what_is_and_what_to_do(
    recollect: Recollect, finding: Callable[..., None], tmp_path: Path
) -> None:
    finding(GOOD, WARNING, BAD)
    lines = recollect("--data", tmp_path / "data").out.splitlines()
    assert [line.split() for line in lines[:5]] == [
        ["FAIL", "c", "no"],
        ["->", "mend"],
        ["WARN", "b", "so-so", "[1]"],
        ["->", "mend"],
        ["OK", "a", "fine"],
    ]


def test_what_is_watched_is_told_again_only_when_it_has_changed(
    recollect: Recollect, finding: Callable[..., None], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    mended = CheckResult.ok("c", "yes")
    rounds = [(GOOD, BAD), (mended, GOOD), (mended, GOOD)]

    def wait(_: float) -> None:
        if not rounds:
            raise KeyboardInterrupt
        finding(*rounds.pop(0))

    monkeypatch.setattr(command, "_wait", wait)
    finding(GOOD, BAD)
    called = recollect("--data", tmp_path / "data", "--watch", "--json")
    first, second = map(json.loads, called.out.splitlines())
    assert (called.code, first["ready"], "changed" in first) == (0, False, False)
    assert (second["ready"], second["changed"]) == (True, ["c: FAIL -> OK"])


def test_a_booth_that_is_watched_ends_with_what_was_found_last(
    recollect: Recollect, finding: Callable[..., None], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def leave(_: float) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "_wait", leave)
    finding(BAD)
    assert recollect("--data", tmp_path / "data", "--watch").code == 1
    assert recollect("--data", tmp_path / "data", "--watch", "--say").code == 2


def test_programs_get_what_people_get(recollect: Recollect, finding: Callable[..., None], tmp_path: Path) -> None:
    finding(GOOD, BAD)
    assert json.loads(recollect("--data", tmp_path / "data", "--json").out) == {
        "ready": False,
        "results": [
            {"name": "c", "severity": "error", "message": "no", "remedy": "mend"},
            {"name": "a", "severity": "ok", "message": "fine", "remedy": ""},
        ],
    }


def test_a_kiosk_that_is_open_on_the_folder_is_known(
    recollect: Recollect, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    seen: list[bool] = []

    def probes(booth: Any) -> Iterable[Check]:
        seen.append(booth.busy)
        return []

    monkeypatch.setattr(command, "all_checks", probes)
    recollect("--data", tmp_path / "data")
    with Recorder(tmp_path / "data"):
        recollect("--data", tmp_path / "data")
    recollect("--data", tmp_path / "data")
    assert seen == [False, True, False]


# Many looks at once


def test_a_look_that_hangs_is_left_behind_and_the_others_keep_their_order() -> None:
    hang = threading.Event()

    def hanging() -> Iterator[CheckResult]:
        hang.wait(PATIENCE_S)
        yield GOOD

    probes = [
        Check("a", lambda: [GOOD]),
        Check("stuck", hanging, 0.2, Severity.ERROR),
        Check("b", lambda: [WARNING, BAD]),
    ]
    found = run_checks(probes, untold)
    hang.set()
    assert [each.name for each in found] == ["a", "stuck", "b", "c"]
    assert (found[1].severity, found[1].message) == (Severity.ERROR, "no answer within 0.2 s")


def test_looks_do_not_wait_for_each_other() -> None:
    together = threading.Barrier(3)

    def meeting() -> Iterator[CheckResult]:
        together.wait(10)
        yield GOOD

    assert run_checks([Check("a", meeting) for _ in range(3)], untold) == (GOOD,) * 3


def test_a_fault_of_ours_is_not_taken_for_one_of_the_booth() -> None:
    def faulty() -> Iterator[CheckResult]:
        raise ZeroDivisionError
        yield GOOD

    with pytest.raises(ZeroDivisionError):
        run_checks([Check("a", faulty), Check("b", lambda: [GOOD])], untold)


def test_how_far_it_is_is_told() -> None:
    told: list[int] = []
    run_checks([Check("a", lambda: [GOOD])] * 3, lambda done, _of=None, /: told.append(done))
    assert told == sorted(told)
    assert told[-1] == 3


# The machine and the program


@pytest.mark.parametrize(
    ("load", "state"),
    [
        (Load(LEAST_MIB, 2, 2 * BUSY), Severity.OK),
        (Load(LEAST_MIB - 1, 2, 0.0), Severity.WARNING),
        (Load(4096, 1, BUSY + 0.1), Severity.WARNING),
    ],
)
def test_a_machine_that_others_keep_busy_is_told_of(load: Load, state: Severity) -> None:
    (found,) = machine_check(load)
    assert found.severity is state


def test_a_program_that_was_changed_since_its_commit_is_told_of() -> None:
    (clean,) = program_check("0123456789abcdef")
    (dirty,) = program_check("0123456789abcdef-dirty")
    (released,) = program_check("released")
    assert [each.severity for each in (clean, dirty, released)] == [Severity.OK, Severity.WARNING, Severity.OK]
    assert clean.message.endswith("01234567")
    assert "released" in released.message


def test_a_program_was_made_before_it_runs_and_has_a_commit() -> None:
    assert code_made().year >= 2024
    assert code_commit()


def test_a_build_tells_when_it_was_made_although_its_modules_are_no_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    built_from = tmp_path / "commit.txt"
    built_from.write_text("abc123", "utf-8")
    monkeypatch.setattr(composition, "_BUILT_FROM", built_from)
    monkeypatch.setattr(composition, "__file__", str(tmp_path / "composition.py"))
    assert code_made() == datetime.fromtimestamp(built_from.stat().st_mtime, UTC)


def test_a_log_that_cannot_be_written_or_is_never_renewed_is_told_of(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (none,) = log_check(tmp_path / "new")
    (tmp_path / LOG).write_text("a line\n")
    (small,) = log_check(tmp_path)
    with (tmp_path / LOG).open("r+b") as file:
        file.truncate(LOG_BYTES * 20)
    (large,) = log_check(tmp_path)
    monkeypatch.setattr(os, "access", lambda *_: False)
    (closed,) = log_check(tmp_path)
    assert [each.severity for each in (none, small, large, closed)] == [
        Severity.OK,
        Severity.OK,
        Severity.WARNING,
        Severity.ERROR,
    ]
