"""Another program holds the database: the experimenter's actions and notes wait for it, and the panel goes on."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing

import pytest
from PySide6.QtCore import Qt

from kiosk.experiment.events import ContinuePressed, PresenceConfirmed, UserActivity
from kiosk.experiment.experimenter import Action
from kiosk.experiment.outcomes import Stage, Status
from kiosk.store.database import FILE
from kiosk.store.queries import open_repository
from kiosk.store.snapshot import wrong_pins
from kiosk.ui.experimenter.view_model import AuthorisationStep
from kiosk.ui.recording import LONGEST_MS, TOLD_AFTER_MS
from tests.ui.experimenter.conftest import Desk, MakeDesk, Witness


@pytest.fixture
def assigner(make_assigner: MakeDesk) -> Desk:
    """Return a booth whose sessions begin with the introduction."""
    return make_assigner(stages=["introduction", "practice", "game"])


@pytest.fixture
def other(assigner: Desk) -> Iterator[sqlite3.Connection]:
    """Another program's connection to the database of the assigner."""
    with closing(sqlite3.connect(assigner.data / FILE, isolation_level=None)) as connection:
        yield connection


def wait_ms(assigner: Desk, ms: int) -> None:
    """Let so much time pass."""
    over: list[bool] = []
    assigner.app.clock.after(ms, lambda: over.append(True))
    assigner.wait_until(lambda: bool(over))


def kinds(assigner: Desk) -> list[str]:
    """Return what is written down of the booth, by its kinds."""
    return [kind for kind, _ in assigner.notes]


def test_a_session_that_is_ended_meanwhile_ends_when_that_is_written(assigner: Desk, other: sqlite3.Connection) -> None:
    assigner.go_to(Stage.INTRODUCTION)
    other.execute("BEGIN IMMEDIATE")
    assigner.do(Action.ABORT)
    wait_ms(assigner, TOLD_AFTER_MS + 100)
    assert assigner.noted == "One moment: another program holds the database"
    assert assigner.stage is Stage.INTRODUCTION
    other.execute("ROLLBACK")
    assigner.wait_until(lambda: assigner.stage is Stage.ATTRACT)
    assert kinds(assigner) == ["PinAttempted", "PinAccepted", "SessionAborted"]
    with open_repository(assigner.data) as stored:
        assert [session.status for session in stored.sessions()] == [Status.STOPPED]


def test_a_action_that_was_outrun_meanwhile_is_not_done(assigner: Desk, other: sqlite3.Connection) -> None:
    assigner.go_to(Stage.INTRODUCTION)
    other.execute("BEGIN IMMEDIATE")
    assigner.do(Action.ABORT)
    assigner.do(Action.ABORT)
    other.execute("ROLLBACK")
    assigner.wait_until(lambda: assigner.stage is Stage.ATTRACT and assigner.noted == "Not now")
    assert kinds(assigner).count("SessionAborted") == 1


def test_a_action_that_can_never_be_written_is_not_done_and_said(
    assigner: Desk, other: sqlite3.Connection, caplog: pytest.LogCaptureFixture
) -> None:
    other.execute("BEGIN IMMEDIATE")
    assigner.do(Action.CONDITION)
    wait_ms(assigner, LONGEST_MS + 100)
    assert assigner.noted == "It could not be written down, so nothing was changed"
    assert assigner.app.assigner.chosen is None
    other.execute("ROLLBACK")
    caplog.clear()


def test_the_panel_opens_and_closes_meanwhile_and_both_are_known_afterwards(
    assigner: Desk, other: sqlite3.Connection
) -> None:
    assigner.go_to(Stage.INTRODUCTION)
    other.execute("BEGIN IMMEDIATE")
    assigner.open_panel()
    wait_ms(assigner, 2 * TOLD_AFTER_MS)
    assigner.shortcut(Action.PANEL)
    assert not assigner.panel.is_open
    other.execute("ROLLBACK")
    assigner.wait_until(lambda: kinds(assigner) == ["PinAttempted", "PinAccepted", "PanelOpened"])
    assigner.app.runner.close()
    with open_repository(assigner.data) as stored:
        told = [type(event).__name__ for event in stored.events(1)]
    assert told.index("PauseRequested") < told.index("PauseEnded")


def test_a_wrong_pin_is_waited_for_at_once_and_written_down_as_soon_as_it_can_be(
    assigner: Desk, other: sqlite3.Connection
) -> None:
    other.execute("BEGIN IMMEDIATE")
    assigner.shortcut(Action.PANEL)
    assigner.type("1111")
    assigner.enter()
    assert assigner.card.asks_for is AuthorisationStep.WAIT
    assert wrong_pins(assigner.data) == 0
    other.execute("ROLLBACK")
    assigner.wait_until(lambda: wrong_pins(assigner.data) == 1)


def test_leaving_waits_for_nobody_but_what_is_left_is_written_while_it_closes(
    assigner: Desk, other: sqlite3.Connection
) -> None:
    other.execute("BEGIN IMMEDIATE")
    assigner.do(Action.CONDITION)
    assigner.do(Action.QUIT)
    assert kinds(assigner) == []
    other.execute("ROLLBACK")
    assigner.close()
    assert kinds(assigner) == [*["PinAttempted", "PinAccepted"] * 2, "ApplicationQuit"]


def test_activity_told_meanwhile_does_not_shorten_the_idle_time_of_the_next_stage(
    assigner: Desk, other: sqlite3.Connection
) -> None:
    assigner.go_to(Stage.INTRODUCTION)
    idle, witness = assigner.app.assigner.study.settings.idle_ms.introduction, Witness(assigner.app)
    wait_ms(assigner, idle - 15_000)
    assigner.press(Qt.Key.Key_Down)
    wait_ms(assigner, 15_000 - 50)
    other.execute("BEGIN IMMEDIATE")
    assigner.app.runner.dispatch(ContinuePressed(at_ms=assigner.app.runner.now_ms()))
    wait_ms(assigner, 100)
    assert assigner.screen == "introduction"
    other.execute("ROLLBACK")
    assigner.wait_until(lambda: assigner.screen == "practice")
    assert not witness.saw(UserActivity)


def test_a_key_is_no_answer_while_the_visitor_is_asked_for_a_moment(assigner: Desk, other: sqlite3.Connection) -> None:
    kiosk = assigner.app.screens.kiosk
    assigner.go_to(Stage.INTRODUCTION)
    assigner.wait_until(lambda: bool(kiosk.property("asksStillThere")))
    told: list[object] = []
    kiosk.confirmed.connect(lambda: told.append(PresenceConfirmed))
    other.execute("BEGIN IMMEDIATE")
    assigner.press(Qt.Key.Key_Down)
    wait_ms(assigner, TOLD_AFTER_MS + 500)
    assert kiosk.property("waits")
    assigner.press(Qt.Key.Key_Down)
    other.execute("ROLLBACK")
    assigner.wait_until(lambda: not kiosk.property("waits"))
    assert not kiosk.property("asksStillThere")
    assert told == [PresenceConfirmed]
