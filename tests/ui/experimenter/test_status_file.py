"""status.json is written at each change and every few seconds, as a whole, and tells nothing of a condition."""

from __future__ import annotations

import json
from dataclasses import replace
from datetime import datetime, timedelta
from pathlib import Path

import pytest

from kiosk.experiment.booth_status import CLOSED, FILE, BoothStatus, DayCounts, EndedSession, PartStatus, utc
from kiosk.experiment.outcomes import SessionKind, Stage
from kiosk.store.snapshot import read_day
from kiosk.ui.event_loop import InlineExecutor, VirtualClock
from kiosk.ui.experimenter.status_file import StatusFile, write_status
from tests.samples import STATUS
from tests.ui.experimenter.conftest import MakeDesk

DAY = (DayCounts(begun=3, completed=1, ended_early=1, last_hour=1), (EndedSession(utc(0), "aborted", "game"),))


class Writing:
    """A status file on virtual time; ``versions`` are the files that there have been."""

    def __init__(self, folder: Path) -> None:
        self.clock = VirtualClock()
        self.file = folder / FILE
        self.status = STATUS
        self.days = 0
        self.made = StatusFile(folder, self._now, self._read_day, self.clock, InlineExecutor())
        self.made.begin()

    def _now(self) -> BoothStatus:
        return replace(self.status, at=utc(self.clock.now_ms()))

    def _read_day(self) -> tuple[DayCounts, tuple[EndedSession, ...]]:
        self.days += 1
        return DAY

    def wait(self, seconds: int) -> None:
        """Let time pass."""
        until = self.clock.now_ms() + seconds * 1000
        while self.clock.now_ms() < until:
            self.clock.jump()

    def read(self) -> BoothStatus:
        """Return the file as it is now."""
        return BoothStatus.from_json(self.file.read_text("utf-8"))


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    assert write_status(tmp_path / FILE, STATUS) == ""
    assert BoothStatus.from_json((tmp_path / FILE).read_text("utf-8")) == STATUS
    assert [file.name for file in tmp_path.iterdir()] == [FILE]
    assert (tmp_path / FILE).stat().st_mode & 0o077 == 0


def test_it_is_written_every_five_seconds_without_a_change(tmp_path: Path) -> None:
    writing = Writing(tmp_path)
    assert writing.read().at == utc(0)
    writing.wait(4)
    assert writing.read().at == utc(1000)  # the day's sessions had been read by then
    writing.wait(3)
    assert writing.read().at == utc(6000)


def test_a_change_is_written_within_a_second(tmp_path: Path) -> None:
    writing = Writing(tmp_path)
    writing.wait(2)
    writing.status = replace(STATUS, parts=(PartStatus("voice", ok=False, message="lost"),))
    writing.wait(1)
    assert [part.message for part in writing.read().failing] == ["lost"]


def test_the_day_is_read_again_when_the_stage_changes_and_not_otherwise(tmp_path: Path) -> None:
    writing = Writing(tmp_path)
    writing.wait(20)
    assert writing.days == 1
    writing.status = replace(STATUS, stage="game")
    writing.wait(2)
    assert (writing.days, writing.read().today, writing.read().ended) == (2, *DAY)


def test_the_last_file_says_that_the_kiosk_is_closed(tmp_path: Path) -> None:
    writing = Writing(tmp_path)
    writing.made.close()
    assert writing.read().stage == CLOSED


def test_a_folder_that_takes_nothing_is_logged_once(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / FILE).mkdir()
    (tmp_path / FILE / "in the way").touch()
    Writing(tmp_path).wait(30)
    (line,) = caplog.messages
    assert "status.json cannot be written" in line
    assert [file.name for file in tmp_path.iterdir()] == [FILE]


@pytest.mark.parametrize(
    "text", ["", "7", "[]", "{}", '{"format": "other"}', "\x00", '{"format": "recollect-status-1"}']
)
def test_another_file_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="it is not of the format recollect-status-1"):
        BoothStatus.from_json(text)


def test_a_booth_tells_its_stage_and_parts_and_nothing_of_the_condition(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["game"])
    assigner.go_to(Stage.GAME)
    assigner.app.experimenter.status_file.begin()
    file = assigner.data / FILE
    told = BoothStatus.from_json(file.read_text("utf-8"))
    assert (told.stage, told.kind, told.supervised) == ("game", "simulated", False)
    assert {part.name for part in told.parts} == {"robot", "voice", "disk", "database", "clock", "screen"}
    words = json.dumps(json.loads(file.read_text("utf-8")))
    assert not any(word in words for word in ("tom", "condition", "code"))


def test_the_sessions_of_today_are_counted_and_those_of_yesterday_are_not(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["game"])
    assigner.go_to(Stage.GAME)
    now = datetime.now().astimezone()
    counts, ended = read_day(assigner.data, now, kind=SessionKind.SIMULATED)
    assert (replace(counts, since=None), ended) == (DayCounts(begun=1), ())
    assert read_day(assigner.data, now + timedelta(days=1), kind=SessionKind.SIMULATED)[0] == DayCounts()
    assigner.app.runner.close()
    counts, ended = read_day(assigner.data, now, kind=SessionKind.SIMULATED)
    assert replace(counts, since=None) == DayCounts(begun=1, ended_early=1)
    assert [each.stage for each in ended] == ["game"]


def test_what_is_written_is_published_each_time_and_the_close_as_well(tmp_path: Path) -> None:
    writing = Writing(tmp_path)
    published: list[BoothStatus] = []
    writing.made.observers.append(published.append)
    writing.wait(12)
    writing.made.close()
    assert len(published) >= 3
    assert [each.stage for each in published] == ["attract"] * (len(published) - 1) + [CLOSED]
