"""Another program holds the database: the experimenter's deeds and notes wait for it, and the panel goes on."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing

import pytest
from PySide6.QtCore import Qt

from kiosk.store.database import FILE
from kiosk.store.glance import wrong_pins
from kiosk.store.reading import archive
from kiosk.study.booth.deeds import Deed
from kiosk.study.events import ContinueTapped, Stage, Status, StillHereTapped, UserActivity
from kiosk.ui.panel.card import Step
from kiosk.ui.waiting import LONGEST_MS, TOLD_AFTER_MS
from tests.ui.panel.conftest import Desk, Witness


@pytest.fixture
def other(desk: Desk) -> Iterator[sqlite3.Connection]:
    """Another program's connection to the database of the desk."""
    with closing(sqlite3.connect(desk.data / FILE, isolation_level=None)) as connection:
        yield connection


def wait_ms(desk: Desk, ms: int) -> None:
    """Let so much time pass."""
    over: list[bool] = []
    desk.app.clock.after(ms, lambda: over.append(True))
    desk.wait_until(lambda: bool(over))


def kinds(desk: Desk) -> list[str]:
    """What is written down of the booth, by its kinds."""
    return [kind for kind, _ in desk.notes]


def test_a_sitting_that_is_ended_meanwhile_ends_when_that_is_written(desk: Desk, other: sqlite3.Connection) -> None:
    desk.go_to(Stage.INTRODUCTION)
    other.execute("BEGIN IMMEDIATE")
    desk.do(Deed.END)
    wait_ms(desk, TOLD_AFTER_MS + 100)
    assert desk.noted == "One moment: another program holds the database"
    assert desk.stage is Stage.INTRODUCTION
    other.execute("ROLLBACK")
    desk.wait_until(lambda: desk.stage is Stage.ATTRACT)
    assert kinds(desk) == ["PinAccepted", "SittingStopped"]
    with archive(desk.data) as stored:
        assert [sitting.status for sitting in stored.sittings()] == [Status.STOPPED]


def test_a_deed_that_was_outrun_meanwhile_is_not_done(desk: Desk, other: sqlite3.Connection) -> None:
    desk.go_to(Stage.INTRODUCTION)
    other.execute("BEGIN IMMEDIATE")
    desk.do(Deed.END)
    desk.do(Deed.END)
    other.execute("ROLLBACK")
    desk.wait_until(lambda: desk.stage is Stage.ATTRACT and desk.noted == "Not now")
    assert kinds(desk).count("SittingStopped") == 1


def test_a_deed_that_can_never_be_written_is_not_done_and_said(
    desk: Desk, other: sqlite3.Connection, caplog: pytest.LogCaptureFixture
) -> None:
    other.execute("BEGIN IMMEDIATE")
    desk.do(Deed.CONDITION)
    wait_ms(desk, LONGEST_MS + 100)
    assert desk.noted == "It could not be written down, so nothing was changed"
    assert desk.app.desk.chosen is None
    other.execute("ROLLBACK")
    caplog.clear()


def test_the_panel_opens_and_closes_meanwhile_and_both_are_known_afterwards(
    desk: Desk, other: sqlite3.Connection
) -> None:
    desk.go_to(Stage.INTRODUCTION)
    other.execute("BEGIN IMMEDIATE")
    desk.open_panel()
    wait_ms(desk, 2 * TOLD_AFTER_MS)
    desk.chord(Deed.PANEL)
    assert not desk.panel.is_open
    other.execute("ROLLBACK")
    desk.wait_until(lambda: kinds(desk) == ["PinAccepted", "PanelOpened"])
    desk.app.conductor.close()
    with archive(desk.data) as stored:
        told = [type(event).__name__ for event in stored.events(1)]
    assert told.index("PauseAsked") < told.index("PauseEnded")


def test_a_wrong_pin_is_waited_for_at_once_and_written_down_as_soon_as_it_can_be(
    desk: Desk, other: sqlite3.Connection
) -> None:
    other.execute("BEGIN IMMEDIATE")
    desk.chord(Deed.PANEL)
    desk.type("1111")
    desk.enter()
    assert desk.card.asks_for is Step.WAIT
    assert wrong_pins(desk.data).times == 0
    other.execute("ROLLBACK")
    desk.wait_until(lambda: wrong_pins(desk.data).times == 1)


def test_leaving_waits_for_nobody_but_what_is_left_is_written_while_it_closes(
    desk: Desk, other: sqlite3.Connection
) -> None:
    other.execute("BEGIN IMMEDIATE")
    desk.do(Deed.CONDITION)
    desk.do(Deed.LEAVE)
    assert kinds(desk) == []
    other.execute("ROLLBACK")
    desk.close()
    assert kinds(desk) == ["PinAccepted", "PinAccepted", "KioskLeft"]


def test_activity_told_meanwhile_does_not_shorten_the_idle_time_of_the_next_stage(
    desk: Desk, other: sqlite3.Connection
) -> None:
    desk.go_to(Stage.INTRODUCTION)
    idle, witness = desk.app.desk.study.settings.idle.introduction, Witness(desk.app)
    wait_ms(desk, idle - 15_000)
    desk.press(Qt.Key.Key_Down)
    wait_ms(desk, 15_000 - 50)
    other.execute("BEGIN IMMEDIATE")
    desk.app.conductor.tell(ContinueTapped)
    wait_ms(desk, 100)
    assert desk.screen == "introduction"
    other.execute("ROLLBACK")
    desk.wait_until(lambda: desk.screen == "practice")
    assert not witness.saw(UserActivity)


def test_a_key_is_no_answer_while_the_visitor_is_asked_for_a_moment(desk: Desk, other: sqlite3.Connection) -> None:
    kiosk = desk.app.screens.kiosk
    desk.go_to(Stage.INTRODUCTION)
    desk.wait_until(lambda: bool(kiosk.property("asksStillThere")))
    told: list[object] = []
    kiosk.confirmed.connect(lambda: told.append(StillHereTapped))
    other.execute("BEGIN IMMEDIATE")
    desk.press(Qt.Key.Key_Down)
    wait_ms(desk, TOLD_AFTER_MS + 500)
    assert kiosk.property("waits")
    desk.press(Qt.Key.Key_Down)
    other.execute("ROLLBACK")
    desk.wait_until(lambda: not kiosk.property("waits"))
    assert not kiosk.property("asksStillThere")
    assert told == [StillHereTapped]
