"""The page of a day: what it counts, what it says to look at, and that it tells nothing of conditions and answers."""

from __future__ import annotations

import json
from dataclasses import replace
from datetime import UTC, date, datetime, timedelta, tzinfo
from html.parser import HTMLParser
from pathlib import Path
from typing import Self
from zoneinfo import ZoneInfo

import pytest
from click.testing import CliRunner

from kiosk.cli.day import day_page
from kiosk.cli.main import recollect
from kiosk.experiment.experimenter import AuditEvent
from kiosk.experiment.outcomes import SessionKind, Stage, Status
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.store.copies import CopyKind, note_copy
from kiosk.store.day_report import DayNote, DayReport, DaySession, Happening, StageSpan, quantile, read_day_report
from kiosk.store.drives import carry
from kiosk.store.maintenance import FOLDER, back_up
from kiosk.store.recorder import Recorder
from tests.export.conftest import rows_of
from tests.export.visitors import store, visitor, visitors

DAY = date(2026, 5, 1)
BEGAN = datetime(2026, 5, 1, 9, tzinfo=UTC)
PEOPLE = frozenset({SessionKind.STUDY})


def session(number: int, **different: object) -> DaySession:
    """Return a session of ten minutes that went well."""
    usual = DaySession(
        number=number,
        name=f"P{number:04}",
        kind=SessionKind.STUDY,
        began=BEGAN + timedelta(minutes=15 * number),
        ended=BEGAN + timedelta(minutes=15 * number + 10),
        status=Status.COMPLETED,
        spans=(StageSpan(Stage.ABOUT, 0, 60_000), StageSpan(Stage.GAME, 60_000, 600_000)),
        faults=(),
        changes=(Happening(BEGAN, "helped by avatar"),),
        latencies_ms=(20, 30),
        sentences=20,
        shown_only=0,
        robot_lost=False,
    )
    return replace(usual, **different)  # type: ignore[arg-type]  # fields by name


def note(kind: AuditEvent, **payload: object) -> DayNote:
    """Return an audit event."""
    return DayNote(BEGAN, kind, payload)


COPY = note(AuditEvent.BACKUP_MADE, file="recollect-1.db")
WELL = DayReport(DAY, tuple(session(number) for number in range(1, 6)), (COPY,))


def with_sessions(*changed: DaySession) -> DayReport:
    """Return a day that is well but for these sessions, which take the places of the first."""
    return replace(WELL, sessions=(*changed, *WELL.sessions[len(changed) :]))


def test_a_day_that_went_well_says_that_there_is_nothing_to_look_at() -> None:
    assert WELL.cautions() == []
    assert "Nothing." in day_page(WELL)


@pytest.mark.parametrize(
    ("report", "words"),
    [
        (with_sessions(session(1, status=Status.INTERRUPTED)), "Session 1 was cut off in game"),
        (with_sessions(session(1, status=None)), "Session 1 has no end"),
        (
            with_sessions(*(session(number, status=Status.ABANDONED) for number in (1, 2, 3))),
            "3 sessions in a row ended early, in game",
        ),
        (
            with_sessions(session(1, spans=(StageSpan(Stage.GAME, 0, 1_300_000),))),
            "Session 1 took more than twice as long",
        ),
        (with_sessions(session(1, robot_lost=True), session(2, robot_lost=True)), "robot was lost in sessions 1, 2"),
        (with_sessions(session(1, shown_only=9)), "9 of 100 sentences were not heard"),
        (with_sessions(session(1, latencies_ms=(900, 950))), "One sentence in 20 began later than"),
        (replace(WELL, notes=(COPY, note(AuditEvent.VOICE_CHANGED, is_heard=False))), "The voice was lost at 09:00"),
        (replace(WELL, notes=()), "No copy was made"),
        (replace(WELL, notes=(COPY, note(AuditEvent.BACKUP_FAILED, why="full"))), "The last copy failed"),
        (replace(WELL, notes=(COPY, note(AuditEvent.DISK_SPACE_CHANGED, level="warn", free_mib=300))), "300 MiB"),
        (replace(WELL, notes=(COPY, *[note(AuditEvent.PIN_REFUSED)] * 3)), "A wrong PIN was typed 3 times"),
    ],
)
def test_what_went_wrong_is_to_be_looked_at_tomorrow(report: DayReport, words: str) -> None:
    (caution,) = report.cautions()
    assert words in caution
    assert words in day_page(report).replace("&#x27;", "'")


@pytest.mark.parametrize(
    "report",
    [
        with_sessions(*(session(number, status=Status.ABANDONED) for number in (1, 2))),
        with_sessions(session(1, shown_only=5)),
        replace(WELL, notes=(COPY, *(note(AuditEvent.VOICE_CHANGED, is_heard=heard) for heard in (False, True)))),
        replace(WELL, notes=(note(AuditEvent.BACKUP_FAILED, why="busy"), COPY)),
        DayReport(DAY, (), ()),
    ],
)
def test_what_was_mended_or_rare_is_not(report: DayReport) -> None:
    assert report.cautions() == []


def test_a_share_of_ordered_numbers_lies_below_its_quantile() -> None:
    assert quantile(list(range(1, 101)), 0.95) == 96
    assert quantile([7], 0.95) == 7
    assert quantile([], 0.95) is None


class Tags(HTMLParser):
    """Sees whether every tag that is opened is closed."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.links: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.links += [str(value) for name, value in attrs if name in {"src", "href"}]
        if tag != "meta":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with five people who came today, and two notes of the booth."""
    place = tmp_path_factory.mktemp("booth") / "data"
    store(place, visitors(5))
    with Recorder(place) as recorder:
        recorder.add_audit_event(AuditEvent.BACKUP_MADE.value, {"file": "recollect-1.db"}, None)
        recorder.add_audit_event(AuditEvent.CONDITION_CHOSEN.value, {"condition": "tom", "reason": "a secret"}, None)
    return place


def test_the_stored_sessions_of_a_day_are_read_and_no_other_days(data: Path) -> None:
    today = datetime.now().astimezone().date()
    report = read_day_report(data, today, PEOPLE)
    assert [session.number for session in report.sessions] == [1, 2, 3, 4, 5]
    assert all(session.spans[0].begin_ms == 0 for session in report.sessions)
    for each in report.sessions:
        assert [span.end_ms for span in each.spans[:-1]] == [span.begin_ms for span in each.spans[1:]]
    assert sum(map(len, report.stage_durations_ms().values())) == sum(len(each.spans) for each in report.sessions)
    assert [each.kind for each in report.notes] == [AuditEvent.BACKUP_MADE, AuditEvent.CONDITION_CHOSEN]
    yesterday = read_day_report(data, today - timedelta(days=1), PEOPLE)
    assert (yesterday.sessions, yesterday.notes) == ((), ())


def test_a_copy_that_a_command_made_is_one_of_the_day(tmp_path: Path) -> None:
    data, today = tmp_path / "data", datetime.now().astimezone().date()
    store(data, visitors(1))
    assert [caution for caution in read_day_report(data, today, PEOPLE).cautions() if "copy" in caution]
    note_copy(data, CopyKind.BACKUP, carry(data, tmp_path / "stick", keep=1).file)
    own = back_up(data, data / FOLDER)
    report = read_day_report(data, today, PEOPLE)
    assert not [caution for caution in report.cautions() if "copy" in caution]
    assert len(report.noted(AuditEvent.BACKUP_MADE)) == 2
    # The kiosk notes its own, and each is listed once.
    with Recorder(data) as recorder:
        recorder.add_audit_event(AuditEvent.BACKUP_MADE.value, {"file": own.name}, None)
    assert len(read_day_report(data, today, PEOPLE).noted(AuditEvent.BACKUP_MADE)) == 2


@pytest.mark.parametrize(
    ("began", "wall"),
    [
        ("2026-03-29T00:58:00.000+00:00", ("01:58 +0100", "03:0")),
        ("2026-10-25T00:58:00.000+00:00", ("02:58 +0200", "02:0")),
    ],
)
def test_a_session_over_a_change_of_the_clock_has_the_right_times_lengths_and_day(
    began: str, wall: tuple[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Clock(datetime):
        @classmethod
        def now(cls, tz: tzinfo | None = None) -> Self:
            return cls.fromisoformat(began).astimezone(tz)

    driver = visitor(1)
    took = timedelta(milliseconds=driver.events[-1].at_ms - driver.events[0].at_ms)
    assert timedelta(minutes=2) < took < timedelta(minutes=12)
    monkeypatch.setattr("kiosk.store.recorder.datetime", Clock)
    monkeypatch.setattr("kiosk.store.rows.now_ms", lambda: int(Clock.now(UTC).timestamp() * 1000))
    store(tmp_path / "data", [(driver, 1)])
    day = datetime.fromisoformat(began).date()
    (session,) = read_day_report(tmp_path / "data", day, PEOPLE, ZoneInfo("Europe/Rome")).sessions
    assert f"{session.began:%H:%M %z}" == wall[0]
    assert f"{session.ended:%H:%M}".startswith(wall[1])
    assert session.ended.astimezone(UTC) - session.began.astimezone(UTC) == took
    assert session.duration_ms == took // timedelta(milliseconds=1)
    assert all(session.began.astimezone(UTC) <= each.at.astimezone(UTC) for each in session.changes)
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs, frozenset({ExportOption.DATES}))
    (row,) = rows_of(tmp_path / "out", "participants")
    assert row["started_at"] == began
    assert int(row["duration_ms"]) == session.duration_ms


def test_the_page_is_whole_asks_for_nothing_and_tells_no_condition_code_or_answer(data: Path, tmp_path: Path) -> None:
    page = tmp_path / "day.html"
    done = CliRunner().invoke(recollect, ["day", "--data", str(data), "--out", str(page)])
    assert done.exit_code == 0, done.output
    text = page.read_text("utf-8")
    seen = Tags()
    seen.feed(text)
    assert (seen.open, seen.links) == ([], [])
    body = text.partition("<body>")[2]
    assert "P0003" in body
    for hidden in ("a secret", "no_tom", ": tom", "random"):
        assert hidden not in body


def test_programs_are_told_the_same(data: Path, tmp_path: Path) -> None:
    page = tmp_path / "day.html"
    command = ["day", "--data", str(data), "--out", str(page), "--date", "2001-01-01", "--json"]
    done = CliRunner().invoke(recollect, command)
    told = {"page": str(page), "date": "2001-01-01", "sessions": 0, "completed": 0, "cautions": []}
    assert json.loads(done.stdout) == told
    assert "No sentence was heard." in page.read_text("utf-8")


def test_what_people_wrote_is_shown_as_text() -> None:
    lost = Happening(BEGAN, "robot lost: <script>alert(1)</script>")
    page = day_page(with_sessions(session(1, faults=(lost,))))
    assert "<script>" not in page
    assert "&lt;script&gt;" in page
