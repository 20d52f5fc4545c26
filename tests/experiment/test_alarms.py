"""Each of the eight alarms comes once, again only while it has not passed, and goes when it has."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime, timedelta
from typing import Any

import pytest

from kiosk.experiment.alarms import (
    AGAIN_MS,
    AGAIN_SEEN_MS,
    BACKUP_OLD_MS,
    HOLDS_MS,
    PASS_WHEN_SEEN,
    AlarmBook,
    AlarmKind,
    BoothSigns,
    OpeningHours,
    alarms_of,
)
from kiosk.experiment.outcomes import Status
from kiosk.units import MS_PER_MINUTE

NOON = datetime(2026, 5, 4, 12, 0, tzinfo=UTC)
WELL = BoothSigns(
    now=NOON,
    robot_well=True,
    voice_well=True,
    disk_free_mib=10_000,
    disk_hour_mib=200,
    clock_jump_ms=0,
    since_backup_ms=0,
    ended=(),
    restarted=False,
    alone_ms=0,
)
HOURS = OpeningHours.from_text("10:00-18:00", 30 * MS_PER_MINUTE)
EARLY, DONE = Status.ABANDONED.value, Status.COMPLETED.value
CAUSES: list[tuple[AlarmKind, dict[str, Any]]] = [
    (AlarmKind.ROBOT_LOST, {"robot_well": False}),
    (AlarmKind.VOICE_LOST, {"voice_well": False}),
    (AlarmKind.DISK_LOW, {"disk_free_mib": 199}),
    (AlarmKind.CLOCK_CHANGED, {"clock_jump_ms": -3_600_000}),
    (AlarmKind.BACKUP_OLD, {"since_backup_ms": BACKUP_OLD_MS + 1}),
    (AlarmKind.EARLY_EXITS, {"ended": (EARLY, Status.WITHDRAWN.value, EARLY, DONE)}),
    (AlarmKind.RESTARTED, {"restarted": True}),
    (AlarmKind.NO_VISITOR, {"alone_ms": 30 * MS_PER_MINUTE}),
]


def test_a_booth_that_is_well_has_no_alarm() -> None:
    assert alarms_of(WELL, HOURS) == {}


def test_every_kind_of_alarm_has_a_cause_here() -> None:
    assert {kind for kind, _ in CAUSES} == set(AlarmKind)


@pytest.mark.parametrize(("kind", "cause"), CAUSES)
def test_each_cause_leads_to_its_alarm_and_to_no_other(kind: AlarmKind, cause: dict[str, Any]) -> None:
    assert list(alarms_of(replace(WELL, **cause), HOURS)) == [kind]


@pytest.mark.parametrize(
    "harmless",
    [
        {"disk_free_mib": None},
        {"disk_free_mib": 200},
        {"since_backup_ms": BACKUP_OLD_MS},
        {"ended": (EARLY, EARLY, DONE, EARLY)},
        {"alone_ms": 30 * MS_PER_MINUTE - 1},
        {"alone_ms": 300 * MS_PER_MINUTE, "now": NOON - timedelta(hours=3)},
        {"alone_ms": 300 * MS_PER_MINUTE, "now": NOON + timedelta(hours=6)},
        # It opened at ten, 29 minutes ago, and no visitor has come since.
        {"alone_ms": 300 * MS_PER_MINUTE, "now": NOON - timedelta(minutes=91)},
    ],
)
def test_what_is_not_so_bad_leads_to_none(harmless: dict[str, Any]) -> None:
    assert alarms_of(replace(WELL, **harmless), HOURS) == {}


def test_without_opening_hours_a_booth_without_visitors_is_no_alarm() -> None:
    lonely = replace(WELL, alone_ms=40 * MS_PER_MINUTE)
    assert alarms_of(lonely, OpeningHours.from_text("", 30 * MS_PER_MINUTE)) == {}


@pytest.mark.parametrize("text", ["10:00", "18:00-10:00", "10-", "ten-six", "10:00-25:00"])
def test_hours_that_are_none_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        OpeningHours.from_text(text, 1)


@pytest.mark.parametrize(("kind", "cause"), CAUSES)
def test_an_alarm_sounds_once_and_again_only_while_it_has_not_passed(kind: AlarmKind, cause: dict[str, Any]) -> None:
    book, hold = AlarmBook(), HOLDS_MS.get(kind, 0)
    bad = alarms_of(replace(WELL, **cause), HOURS)
    assert book.update(bad, 0, 0) == (() if hold else (kind,))
    if hold:
        assert book.holding == ()
        assert book.update(bad, hold, hold) == (kind,)
    assert book.update(bad, hold + 1, 0) == ()
    assert book.update(bad, hold + AGAIN_MS - 1, 0) == ()
    assert book.update(bad, hold + AGAIN_MS, 0) == (kind,)
    assert [alarm.kind for alarm in book.holding] == [kind]
    assert book.update({}, hold + AGAIN_MS + 1, 77) == ()
    assert book.holding == ()
    assert [(alarm.kind, alarm.passed_ms) for alarm in book.passed] == [(kind, 77)]


@pytest.mark.parametrize(("kind", "cause"), CAUSES)
def test_an_alarm_that_was_seen_is_quiet_for_longer_or_has_passed(kind: AlarmKind, cause: dict[str, Any]) -> None:
    book, hold = AlarmBook(), HOLDS_MS.get(kind, 0)
    bad = alarms_of(replace(WELL, **cause), HOURS)
    book.update(bad, 0, 0)
    book.update(bad, hold, 0)
    book.see(hold, 5)
    assert book.update(bad, hold + AGAIN_MS, 0) == ()
    later = book.update(bad, hold + AGAIN_SEEN_MS, 0)
    if kind in PASS_WHEN_SEEN:
        assert (book.holding, later) == ((), ())
        assert [alarm.passed_ms for alarm in book.passed] == [5]
    else:
        assert later == (kind,)
        assert [alarm.seen for alarm in book.holding] == [True]


def test_a_robot_that_comes_back_at_once_is_no_alarm() -> None:
    book = AlarmBook()
    lost = alarms_of(replace(WELL, robot_well=False), HOURS)
    assert book.update(lost, 0, 0) == ()
    assert book.update({}, 5_000, 0) == ()
    assert book.update(lost, 16_000, 0) == ()
    assert (book.holding, book.passed) == ((), ())


def test_three_more_early_exits_are_an_alarm_of_their_own() -> None:
    book = AlarmBook()
    for left, expected in ((3, (AlarmKind.EARLY_EXITS,)), (4, ()), (5, ()), (6, (AlarmKind.EARLY_EXITS,))):
        assert book.update(alarms_of(replace(WELL, ended=(EARLY,) * left), HOURS), left, 0) == expected
        book.see(left, 0)


def test_a_clock_that_is_set_once_more_is_an_alarm_of_its_own() -> None:
    book = AlarmBook()
    for jump, expected in ((60_000_000, True), (60_000_010, False), (120_000_000, True)):
        book.see(0, 0)
        assert bool(book.update(alarms_of(replace(WELL, clock_jump_ms=jump), HOURS), 0, 0)) is expected
