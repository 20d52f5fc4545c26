"""Another program holds the database: the kiosk goes on drawing, loses nothing, and shows nothing unstored."""

from __future__ import annotations

import sqlite3
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from functools import partial
from pathlib import Path

import pytest
from PySide6.QtCore import QTimer
from pytestqt.qtbot import QtBot

from kiosk.config import ASSETS
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import Event, WorldEvent
from kiosk.experiment.items import Multiple
from kiosk.experiment.outcomes import Stage, Status
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.game import Position
from kiosk.store.database import FILE
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Recorder
from kiosk.ui.recording import LONGEST_MS, TOLD_AFTER_MS
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.simulated_visitor import lay_out
from kiosk.ui.window import RunMode, WindowMode
from tests.patience import started
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.headless import BRIEF, TINY, headless, short

GALLERY = Questionnaire.read(ASSETS / "questionnaires" / "gallery.toml")
HELD_MS = 30_000
HOLDER = """
import sqlite3, sys
held = sqlite3.connect(sys.argv[1], isolation_level=None)
held.execute("BEGIN IMMEDIATE")
print("held", flush=True)
sys.stdin.read()
held.execute("ROLLBACK")
"""


@pytest.fixture
def booth(make_booth: MakeBooth) -> Booth:
    """Return a booth with half the cards."""
    return make_booth(settings=BRIEF)


class Other:
    """Another program's connection to the database."""

    def __init__(self, data: Path) -> None:
        self._connection = sqlite3.connect(data / FILE, isolation_level=None)

    def hold(self) -> None:
        """Keep all others from writing."""
        self._connection.execute("BEGIN IMMEDIATE")

    def let_go(self) -> None:
        """Let others write."""
        self._connection.execute("ROLLBACK")

    def close(self) -> None:
        """Let go, and leave the database alone."""
        self._connection.close()


@pytest.fixture
def other_of() -> Iterator[Callable[[Booth], Other]]:
    """Open the database of a booth as another program does."""
    with ExitStack() as opened:
        yield lambda booth: opened.enter_context(closing(Other(booth.data)))


@pytest.fixture
def other(booth: Booth, other_of: Callable[[Booth], Other]) -> Other:
    """Another program at the database of the booth."""
    return other_of(booth)


def wait_ms(booth: Booth, ms: int, *, draws: bool = False) -> int:
    """Let so much time pass, and draw the window meanwhile; returns in how many steps it passed."""
    over: list[bool] = []
    booth.app.clock.after(ms, lambda: over.append(True))
    turns = 0
    while not over:
        booth.jump()
        if draws:
            lay_out(booth.app.window)
        turns += 1
    return turns


def flips(booth: Booth) -> list[happened.CardSelected]:
    """Return the cards that are stored as tapped."""
    return [event for event in events(booth) if isinstance(event, happened.CardSelected)]


def events(booth: Booth, session: int = 1) -> list[Event]:
    """Everything that is stored of a session."""
    with open_repository(booth.data) as stored:
        return stored.events(session)


def statuses(booth: Booth) -> list[Status | None]:
    """How the stored sessions ended."""
    with open_repository(booth.data) as stored:
        return [session.status for session in stored.sessions()]


def test_a_database_that_is_held_for_half_a_minute_costs_no_session_and_shows_nothing_that_is_not_stored(
    booth: Booth, other: Other
) -> None:
    booth.start_game()
    booth.settle()
    other.hold()
    tapped_at = booth.app.clock.now_ms()
    booth.click("card-3")
    assert wait_ms(booth, HELD_MS, draws=True) > 100
    assert len(booth.app.screens.board.closed) == 12
    assert flips(booth) == []
    other.let_go()
    booth.wait_until(lambda: len(booth.app.screens.board.closed) == 11)
    [flip] = flips(booth)
    assert flip.position == Position(0, 3)
    assert flip.at_ms <= tapped_at
    booth.app.runner.close()
    assert [event.at_ms for event in events(booth)] == sorted(event.at_ms for event in events(booth))
    assert statuses(booth) == [Status.INTERRUPTED]


def test_what_is_tapped_meanwhile_counts_in_its_order_and_with_its_time(booth: Booth, other: Other) -> None:
    booth.start_game()
    booth.settle()
    other.hold()
    for card in (3, 4):
        booth.click(f"card-{card}")
        wait_ms(booth, 200)
    other.let_go()
    booth.wait_until(lambda: len(booth.app.screens.board.closed) <= 10)
    first, second = flips(booth)
    assert (first.position, second.position) == (Position(0, 3), Position(1, 0))
    assert second.at_ms - first.at_ms == 200


def test_a_visitor_who_has_to_wait_long_is_asked_for_a_moment_and_then_goes_on(booth: Booth, other: Other) -> None:
    booth.click("start-en")
    booth.settle()
    other.hold()
    booth.click("continue")
    wait_ms(booth, TOLD_AFTER_MS - 100)
    assert not booth.sees("wait")
    wait_ms(booth, 200)
    assert booth.sees("wait")
    assert booth.item("wait").property("title") == "One moment, please"
    assert not booth.app.screens.kiosk.takes_input or booth.app.screens.kiosk.covered
    other.let_go()
    booth.wait_until(lambda: booth.screen == "game")
    assert not booth.sees("wait")
    booth.click("card-3")
    assert len(booth.app.screens.board.closed) == 11


def go_to(booth: Booth, screen: str) -> None:
    """Have a visitor come to this screen and no further."""

    class Visitor(Rehearsal):
        def _do_what_comes_next(self) -> None:
            if self._app.screens.kiosk.shown == screen:
                self._app.quit()
            else:
                super()._do_what_comes_next()

    Visitor(booth.app, 1).run()
    assert booth.screen == screen


def test_a_tap_that_was_meant_for_the_page_before_skips_no_page(
    make_booth: MakeBooth, other_of: Callable[[Booth], Other]
) -> None:
    booth = make_booth(settings=short(questionnaires=["gallery"], game={"rows": 2, "columns": 3}))
    other = other_of(booth)
    go_to(booth, "result")
    other.hold()
    for _ in range(3):
        booth.click("continue")
        wait_ms(booth, 100)
    assert booth.screen == "result"
    other.let_go()
    booth.wait_until(lambda: booth.screen == "form")
    [page] = booth.app.screens.form.shown
    assert page.kind == "page"


def test_a_new_session_begins_when_the_database_is_free_and_at_the_time_of_the_tap(booth: Booth, other: Other) -> None:
    booth.settle()
    other.hold()
    booth.click("start-en")
    wait_ms(booth, HELD_MS)
    assert booth.screen == "attract"
    assert statuses(booth) == []
    other.let_go()
    booth.wait_until(lambda: booth.screen == "introduction")
    assert isinstance(events(booth)[0], happened.SessionStarted)
    with closing(sqlite3.connect(booth.data / FILE)) as database:
        assert database.execute("SELECT count(*), count(DISTINCT seq) FROM event").fetchone() == (
            (len(events(booth)),) * 2
        )


def test_a_database_that_stays_held_is_a_failure_of_the_disk_in_the_end(
    make_booth: MakeBooth, other_of: Callable[[Booth], Other], caplog: pytest.LogCaptureFixture
) -> None:
    booth = make_booth(settings=TINY)
    other = other_of(booth)
    booth.start_game()
    booth.settle()
    other.hold()
    booth.click("card-3")
    wait_ms(booth, LONGEST_MS + 100)
    assert booth.screen == "pause"
    assert not booth.sees("wait")
    assert "another program holds the database" in caplog.text
    other.let_go()
    booth.wait_until(lambda: booth.screen == "attract")
    booth.rehearse(seed=1)
    assert statuses(booth) == [Status.INTERRUPTED, Status.COMPLETED]
    caplog.clear()


def test_closing_waits_a_little_and_writes_what_is_left_in_its_order(booth: Booth, other: Other) -> None:
    booth.start_game()
    booth.settle()
    other.hold()
    booth.click("card-3")
    other.let_go()
    booth.app.runner.close()
    world = [type(event) for event in events(booth) if isinstance(event, WorldEvent)]
    assert world[-2:] == [happened.CardSelected, happened.ApplicationClosed]


def test_closing_while_the_database_stays_held_leaves_a_session_that_was_interrupted(
    booth: Booth, other: Other, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr("kiosk.ui.session_runner.CLOSING_WAIT_MS", 1)
    booth.start_game()
    booth.settle()
    other.hold()
    booth.click("card-3")
    booth.app.runner.close()
    assert "could not be written: another program holds the database" in caplog.text
    other.let_go()
    wait_ms(booth, 1_000)
    assert flips(booth) == []
    caplog.clear()


def test_a_fault_meanwhile_shows_the_calm_screen_and_leaves_nothing_for_the_next_visitor(
    make_booth: MakeBooth, other_of: Callable[[Booth], Other], caplog: pytest.LogCaptureFixture
) -> None:
    booth = make_booth(settings=TINY)
    other = other_of(booth)
    booth.start_game()
    booth.settle()
    other.hold()
    booth.click("card-3")
    wait_ms(booth, 2 * TOLD_AFTER_MS)
    booth.app.fault(RuntimeError, RuntimeError("a fault"), None)
    assert booth.screen == "pause"
    assert not booth.sees("wait")
    other.let_go()
    booth.wait_until(lambda: booth.screen == "attract")
    booth.rehearse(seed=1)
    assert statuses(booth) == [Status.INTERRUPTED, Status.COMPLETED]
    assert flips(booth) == []
    caplog.clear()


def test_a_timer_that_ran_out_while_the_tap_that_stops_it_was_waiting_does_not_count(
    make_booth: MakeBooth, other_of: Callable[[Booth], Other]
) -> None:
    booth = make_booth(settings=short(idle_ms={"game": 3_000, "still_there": 1_000}, game={"rows": 3, "columns": 4}))
    other = other_of(booth)
    booth.start_game()
    booth.settle()
    wait_ms(booth, 2_000)
    other.hold()
    booth.click("card-3")
    wait_ms(booth, 2_500)
    other.let_go()
    booth.wait_until(lambda: len(booth.app.screens.board.closed) == 11)
    assert not booth.sees("still-there")
    assert not any(isinstance(event, happened.TimerExpired) for event in events(booth))


def test_options_that_are_ticked_before_the_first_is_stored_are_all_kept(booth: Booth) -> None:
    [item] = (item for item in GALLERY.items if isinstance(item, Multiple))
    booth.ask(item)
    given: list[object] = []
    booth.app.screens.form.answered.connect(lambda _item, value: given.append(value))
    first, second = item.ids[:2]
    booth.click(f"option-{item.id}-{first}")
    booth.click(f"option-{item.id}-{second}")
    assert given == [(first,), (first, second)]


def test_a_rehearsal_on_virtual_time_stands_still_meanwhile_so_that_its_record_is_the_same(
    make_booth: MakeBooth, other_of: Callable[[Booth], Other]
) -> None:
    plain, disturbed = (make_booth(settings=TINY, opened=partial(Recorder, wait_ms=10)) for _ in range(2))
    plain.rehearse(seed=1)
    other, held = other_of(disturbed), list[WorldEvent]()
    rehearsal = Rehearsal(disturbed.app, 1)
    watch = disturbed.app.runner.on_event
    assert watch is not None

    def watch_and_hold(event: WorldEvent, outcome: Outcome, stage: Stage) -> None:
        watch(event, outcome, stage)
        if isinstance(event, happened.CardSelected) and not held:
            held.append(event)
            other.hold()
            QTimer.singleShot(100, other.let_go)

    disturbed.app.runner.on_event = watch_and_hold
    rehearsal.run()
    assert held
    assert events(disturbed) == events(plain)


def test_the_interface_goes_on_while_another_process_holds_the_database(qtbot: QtBot, tmp_path: Path) -> None:
    with headless(short(), tmp_path, mode=RunMode(WindowMode.NOWHERE)) as app:
        qtbot.waitUntil(lambda: app.window.isExposed() and app.window.isActive())
        app.runner.start("en")
        qtbot.waitUntil(lambda: app.screens.kiosk.shown == "introduction")
        command = [sys.executable, "-c", HOLDER, str(tmp_path / FILE)]
        with started(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as holder:
            assert holder.stdout.readline() == "held\n"
            ticks: list[int] = []
            ticking = QTimer()
            ticking.timeout.connect(lambda: ticks.append(1))
            ticking.start(5)
            app.runner.dispatch(happened.ContinuePressed(at_ms=app.runner.now_ms()))
            qtbot.waitUntil(lambda: app.screens.kiosk.covered)
            assert len(ticks) > 20
            assert app.screens.kiosk.shown == "introduction"
            holder.stdin.close()
            qtbot.waitUntil(lambda: app.screens.kiosk.shown == "game")
        assert app.runner.stage is Stage.GAME
