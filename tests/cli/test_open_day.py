"""``recollect open-day``: one step after another, and the kiosk opens only if nothing keeps it closed."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from kiosk import UserInputError
from kiosk.cli import open_day
from kiosk.cli.devices import RobotTrial
from kiosk.cli.main import recollect
from kiosk.experiment.outcomes import SessionKind
from kiosk.preflight import WHAT, Check, CheckResult
from kiosk.store.copies import known_copies
from kiosk.store.maintenance import FOLDER, list_backups
from kiosk.store.recorder import Provenance, Recorder
from tests.samples import WITH_PIN, plan
from tests.store.visitors import COMPLETED

REMINDERS = 'reminders = ["Put out fresh information sheets", "Write the date on the list"]\n'
FINE, SO_SO, BAD = (
    CheckResult.ok("a", "fine"),
    CheckResult.warning("b", "so-so", "x"),
    CheckResult.error("c", "no", "x"),
)
ALONE = CheckResult.warning(WHAT, "nothing starts the kiosk again", "supervise it")
HEARD, UNHEARD = (
    CheckResult.ok("said: en", "a voice said it"),
    CheckResult.warning("said: en", "nothing was heard", "x"),
)

Open = Callable[..., Result]


@pytest.fixture
def booth(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Open:
    """Return the command on a booth where these things are found; ``opened`` is kept in the folder."""
    study, data = tmp_path / "study.toml", tmp_path / "data"
    study.write_text(WITH_PIN + REMINDERS)

    def call(
        *words: str,
        answers: str = "",
        found: tuple[CheckResult, ...] = (FINE,),
        said: CheckResult = HEARD,
        robot: RobotTrial | None = None,
    ) -> Result:
        def supervise(*_: Any, **__: Any) -> int:
            (tmp_path / "opened").touch()
            return 0

        monkeypatch.setattr(open_day, "all_checks", lambda _: [Check("all", lambda: found)])
        monkeypatch.setattr(open_day, "say_all", lambda _: iter([said]))
        monkeypatch.setattr(open_day, "greet", lambda *_: robot)
        monkeypatch.setattr(open_day, "supervise_kiosk", supervise)
        options = ["open-day", "--study", str(study), "--data", str(data), *words]
        return CliRunner().invoke(recollect, options, input=answers)

    return call


def steps(result: Result) -> dict[str, bool]:
    """Return what came of each step; of reminders, of the last one."""
    return {row["step"]: row["ok"] for row in map(json.loads, result.stdout.splitlines())}


def test_when_all_is_well_the_kiosk_opens(booth: Open, tmp_path: Path) -> None:
    hello = RobotTrial("says the sentence", worked=True, found="done", ms=1)
    result = booth("--yes", "--json", robot=hello)
    assert result.exit_code == 0, result.output
    told = [json.loads(line) for line in result.stdout.splitlines()]
    assert [row["step"] for row in told] == ["check", "voice", "robot", "backup", "reminder", "reminder", "kiosk"]
    assert all(row["ok"] for row in told)
    assert [row["found"] for row in told[4:6]] == ["Put out fresh information sheets", "Write the date on the list"]
    assert (tmp_path / "opened").exists()


def test_each_step_is_asked_about(booth: Open, tmp_path: Path) -> None:
    result = booth(answers="y\ny\ny\n")
    assert result.exit_code == 0, result.output
    asked = [line for line in result.stderr.splitlines() if line.endswith("[Y/n]: y")]
    assert [line.split(" [")[0] for line in asked] == [
        "a voice said it. Did you hear it?",
        "Put out fresh information sheets - done?",
        "Write the date on the list - done?",
    ]
    assert (tmp_path / "opened").exists()


@pytest.mark.parametrize(
    ("answers", "found", "last"),
    [
        ("", (FINE, BAD), "check"),
        ("n\n", (FINE, SO_SO), "check"),
        ("n\nn\n", (FINE,), "voice"),
        ("y\nn\nn\n", (FINE,), "reminder"),
    ],
)
def test_what_is_not_well_keeps_it_closed(
    booth: Open, tmp_path: Path, answers: str, found: tuple[CheckResult, ...], last: str
) -> None:
    result = booth("--json", answers=answers, found=found)
    assert (result.exit_code, [*steps(result)][-1]) == (1, last)
    assert not (tmp_path / "opened").exists()


def test_it_opens_with_what_you_agree_to(booth: Open, tmp_path: Path) -> None:
    lost = RobotTrial("ready to speak", worked=False, found="it does not answer", ms=1)
    result = booth("--json", answers="y\n" * 6, found=(FINE, SO_SO), said=UNHEARD, robot=lost)
    assert result.exit_code == 0, result.output
    assert [name for name, ok in steps(result).items() if not ok] == ["check", "voice", "robot"]
    assert (tmp_path / "opened").exists()


def test_it_is_supervised_anyway_so_that_is_no_warning(booth: Open) -> None:
    assert steps(booth("--json", "--yes", found=(FINE, ALONE)))["check"]
    assert WHAT not in booth("--yes", found=(FINE, ALONE)).output


def test_the_data_are_copied_also_to_another_place(booth: Open, tmp_path: Path) -> None:
    with Recorder(tmp_path / "data") as recorder:
        recorder.begin(Provenance(plan(), 1, "avatar", "abc123", kind=SessionKind.STUDY), COMPLETED)
    result = booth("--yes", "--json", "--to", str(tmp_path / "stick"))
    assert (result.exit_code, steps(result)["backup"], steps(result)["copy"]) == (0, True, True)
    assert len(list_backups(tmp_path / "data" / FOLDER)) == len(list_backups(tmp_path / "stick")) == 1
    # A withdrawal can name it.
    assert [copy.place for copy in known_copies(tmp_path / "data")] == list_backups(tmp_path / "stick")


def test_a_kiosk_that_is_open_already_is_left_alone(booth: Open, tmp_path: Path) -> None:
    with Recorder(tmp_path / "data"):
        result = booth("--yes")
    assert isinstance(result.exception, UserInputError)
    assert "leave it first" in str(result.exception)


def test_a_study_without_a_pin_is_refused_at_once(booth: Open, tmp_path: Path) -> None:
    (tmp_path / "study.toml").write_text("")
    result = booth("--yes")
    assert isinstance(result.exception, UserInputError)
    assert "no PIN is set" in str(result.exception)
    assert not (tmp_path / "opened").exists()
