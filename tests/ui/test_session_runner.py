"""Recorded, then shown, then spoken; and what a visitor sees when something of that fails."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from threading import Thread
from typing import TypeVar

import pytest
from PySide6.QtCore import Qt

from kiosk import StorageError
from kiosk.config import Settings
from kiosk.experiment import events as happened
from kiosk.experiment.events import Event
from kiosk.experiment.outcomes import Stage, Status
from kiosk.game import Position
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.ui.recording import DiskWriter
from kiosk.ui.session_runner import ERROR_SCREEN_MS
from tests.patience import PATIENCE_S
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.headless import TINY, short
from tests.ui.visiting import PAIR, go_on_to_the_end, go_to

T = TypeVar("T")

QUICK = short(idle_ms={"game": 3_000, "still_there": 1_000})


def refuse(self: Recorder, events: Sequence[Event]) -> None:  # noqa: ARG001 - the recorder's signature
    """Stand in for a recorder whose disk is full."""
    raise StorageError("what happened could not be written: the disk is full")


def refuse_to_begin(self: Recorder, session: Provenance, events: Sequence[Event]) -> None:  # noqa: ARG001 - as above
    """Stand in for a recorder that cannot store a session."""
    raise StorageError("the session could not be stored: the disk is full")


def test_a_tap_that_cannot_be_recorded_is_not_shown(
    booth: Booth, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    booth.click("start-en")
    assert booth.screen == "introduction"
    monkeypatch.setattr(Recorder, "append", refuse)
    booth.click("continue")
    assert booth.screen == "pause"
    assert booth.app.screens.board.closed == ()
    assert "the disk is full" in caplog.text
    caplog.clear()


def test_after_a_failure_of_the_disk_the_kiosk_goes_on_by_itself(
    make_booth: MakeBooth, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    booth = make_booth(settings=TINY)
    booth.click("start-en")
    with monkeypatch.context() as patch:
        patch.setattr(Recorder, "append", refuse)
        booth.click("continue")
    assert booth.screen == "pause"
    booth.wait_until(lambda: booth.screen == "attract")
    booth.rehearse(seed=1)
    with open_repository(booth.data) as stored:
        assert [session.status for session in stored.sessions()] == [Status.INTERRUPTED, Status.COMPLETED]
    caplog.clear()


def test_a_fault_of_ours_shows_a_calm_screen_and_goes_into_the_log(
    booth: Booth, caplog: pytest.LogCaptureFixture
) -> None:
    booth.start_game()
    booth.app.fault(RuntimeError, RuntimeError("a fault"), None)
    assert booth.screen == "pause"
    assert "a fault" in caplog.text
    caplog.clear()


def test_markers_name_every_event_that_is_stored_and_none_before_consent(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=Settings.model_validate({"questionnaires": ["trust"], **PAIR}))
    sent: list[Event] = []
    participants = set[str]()

    def note(participant: str, events: Iterable[Event]) -> None:
        with open_repository(booth.data) as stored:
            assert len(stored.sessions()) == 1
        participants.add(participant)
        sent.extend(events)

    booth.app.runner.on_recorded = note
    go_to(booth.app, Stage.THANKS)
    go_on_to_the_end(booth.app)
    with open_repository(booth.data) as stored:
        every = list(stored.events(1))
    assert sent == every[-len(sent) :]
    first = next(index for index, event in enumerate(every) if isinstance(event, happened.ConsentGiven))
    assert len(sent) >= len(every) - first - 1
    assert participants == {"1"}


def flip_until(booth: Booth, reason: str) -> None:
    """Flip closed cards until taps do not count, for this reason, which is a property of the board."""
    board = booth.app.screens.board
    cards = iter(range(24))
    while not board.property(reason):
        if board.accepts_taps:
            booth.click(f"card-{next(cards)}")
        else:
            booth.jump()


@pytest.mark.parametrize("reason", ["speaking", "missed"])
def test_a_tap_that_does_not_count_is_recorded_and_the_screen_says_why(booth: Booth, reason: str) -> None:
    booth.start_game()
    flip_until(booth, reason)
    shown = booth.app.screens.board.closed
    booth.click("card-23")
    assert booth.app.screens.board.closed == shown
    with open_repository(booth.data) as stored:
        (ignored,) = (event for event in stored.events(1) if isinstance(event, happened.CardSelectionRejected))
    assert ignored.position == Position(3, 5)


def test_a_visitor_who_walks_away_is_asked_and_then_the_kiosk_is_ready_again(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=QUICK)
    booth.start_game()
    booth.click("card-3")
    booth.wait_until(lambda: booth.sees("still-here"))
    booth.wait_until(lambda: booth.screen == "attract")
    with open_repository(booth.data) as stored:
        assert stored.sessions()[0].status is Status.ABANDONED
    assert not booth.sees("still-here")


def test_a_visitor_who_is_still_there_goes_on_where_the_game_was(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=QUICK)
    booth.start_game()
    booth.click("card-3")
    booth.wait_until(lambda: booth.sees("still-here"))
    booth.press(Qt.Key.Key_Return)
    assert not booth.sees("still-here")
    assert booth.screen == "game"
    assert len(booth.app.screens.board.closed) == 23
    booth.press(Qt.Key.Key_Return)
    assert len(booth.app.screens.board.closed) == 22


def test_leaving_the_kiosk_in_the_middle_of_a_session_is_recorded(booth: Booth) -> None:
    booth.start_game()
    booth.app.runner.close()
    with open_repository(booth.data) as stored:
        assert stored.sessions()[0].status is Status.INTERRUPTED
        assert any(isinstance(event, happened.ApplicationClosed) for event in stored.events(1))


def test_a_word_from_the_last_session_changes_nothing_in_the_next(booth: Booth) -> None:
    booth.app.runner.speech_finished(4)
    assert booth.screen == "attract"
    booth.click("start-en")
    with open_repository(booth.data) as stored:
        assert isinstance(stored.events(1)[0], happened.SessionStarted)


def test_nothing_of_one_visitor_is_left_for_the_next(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=TINY)
    booth.rehearse(seed=1)
    booth.start_game()
    board = booth.app.screens.board
    assert len(board.closed) == 6
    assert board.unmatched == {}
    assert board.highlighted == (None, None)
    assert str(board.property("progress")) == "0 of 3 pairs"
    assert str(board.property("moves")) == "0 moves"


def test_a_session_whose_first_event_cannot_be_recorded_has_not_begun(
    booth: Booth, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    begun: list[str] = []
    booth.app.runner.on_session_started = lambda: begun.append(booth.screen)
    with monkeypatch.context() as patch:
        patch.setattr(Recorder, "begin", refuse_to_begin)
        booth.click("start-en")
    assert booth.screen == "pause"
    assert begun == []
    caplog.clear()
    booth.wait_until(lambda: booth.screen == "attract")
    booth.click("start-en")
    assert begun == ["introduction"]


def test_a_second_failure_has_a_calm_screen_as_long_as_the_first(booth: Booth) -> None:
    clock, runner = booth.app.clock, booth.app.runner
    runner.pause()
    clock.after(ERROR_SCREEN_MS - 1, runner.pause)
    booth.wait_until(lambda: booth.screen == "attract")
    assert clock.now_ms() == ERROR_SCREEN_MS - 1 + ERROR_SCREEN_MS


class SlowDisk:
    """Has writes wait until they are let go, and does them on a thread of its own."""

    def __init__(self) -> None:
        self._held: list[tuple[Callable[[], None], Callable[[], None]]] = []

    def __call__(self, job: Callable[[], T], then: Callable[[T], None]) -> None:
        """Keep a write."""
        done: list[T] = []
        self._held.append((lambda: done.append(job()), lambda: then(done[0])))

    def begin(self) -> Thread:
        """Let the writes that wait reach the disk, in their order, without a word."""
        jobs = [job for job, _ in self._held]
        thread = Thread(target=lambda: [job() for job in jobs], daemon=True)
        thread.start()
        return thread

    def let_go(self) -> None:
        """Let them reach the disk, and tell of it."""
        self.begin().join(PATIENCE_S)
        held, self._held = self._held, []
        for _, tell in held:
            tell()


@pytest.fixture
def slow_disk(booth: Booth) -> SlowDisk:
    """Return the disk of a booth that is in the game; its next write waits."""
    booth.start_game()
    booth.settle()
    disk = SlowDisk()
    booth.app.runner.writer = DiskWriter(disk)
    return disk


def stored_flips(booth: Booth) -> list[Position]:
    """Return which cards are stored as tapped."""
    with open_repository(booth.data) as stored:
        return [event.position for event in stored.events(1) if isinstance(event, happened.CardSelected)]


def test_a_card_is_turned_once_the_disk_has_the_tap_and_the_next_tap_after_it(
    booth: Booth, slow_disk: SlowDisk
) -> None:
    board = booth.app.screens.board
    for name in ("card-3", "card-4"):
        booth.click(name)
    assert (len(board.closed), stored_flips(booth)) == (24, [])
    slow_disk.let_go()
    assert (len(board.closed), stored_flips(booth)) == (23, [Position(0, 3)])
    slow_disk.let_go()
    assert (len(board.closed), stored_flips(booth)) == (22, [Position(0, 3), Position(0, 4)])


def test_what_a_slow_disk_does_not_take_is_not_shown(
    booth: Booth, slow_disk: SlowDisk, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    booth.click("card-3")
    monkeypatch.setattr(Recorder, "append", refuse)
    slow_disk.let_go()
    assert booth.screen == "pause"
    assert "the disk is full" in caplog.text
    caplog.clear()


def test_a_write_that_ends_after_its_session_was_dropped_changes_nothing(
    booth: Booth, slow_disk: SlowDisk, caplog: pytest.LogCaptureFixture
) -> None:
    booth.click("card-3")
    booth.app.fault(RuntimeError, RuntimeError("a fault"), None)
    slow_disk.let_go()
    assert (booth.screen, stored_flips(booth)) == ("pause", [Position(0, 3)])
    caplog.clear()


def test_closing_waits_for_the_write_under_way_and_loses_nothing(booth: Booth, slow_disk: SlowDisk) -> None:
    booth.click("card-3")
    booth.click("card-4")
    disk = slow_disk.begin()
    booth.app.runner.close()
    disk.join(PATIENCE_S)
    assert stored_flips(booth) == [Position(0, 3), Position(0, 4)]
    with open_repository(booth.data) as stored:
        assert stored.sessions()[0].status is Status.INTERRUPTED


@pytest.mark.parametrize("closed", [False, True], ids=["the loop goes on", "the kiosk is closed meanwhile"])
def test_a_page_is_filled_in_one_step_and_shown_in_the_next(booth: Booth, closed: bool) -> None:  # noqa: FBT001 - a parameter
    steps: list[Callable[[], None]] = []
    shown: list[tuple[str, ...]] = []
    app = booth.app
    app.runner.on_event = lambda event, *_: shown.append((type(event).__name__, booth.screen))
    app.runner.later = steps.append
    app.runner.start("en")
    # The code of the new visitor is drawn in a step of its own, before the page is filled.
    assert app.screens.debrief.shown_code
    steps.pop()()
    assert (booth.screen, bool(app.screens.introduction.helped), shown) == ("attract", True, [])
    # What happens meanwhile waits, and a tap on the page before is none on this one.
    app.runner.dispatch(happened.ContinuePressed(at_ms=0))
    assert len(steps) == 1
    if closed:
        app.runner.close()
    else:
        steps[0]()
    names = ("SessionStarted", "SpeechStarted", *(["ApplicationClosed"] if closed else []))
    assert shown == [(name, "introduction") for name in names]


def test_a_page_has_its_way_back_from_the_moment_it_is_shown(make_booth: MakeBooth) -> None:
    app = make_booth(settings=Settings.model_validate({"questionnaires": ["trust"], **PAIR})).app
    kiosk = app.screens.kiosk
    begun: list[tuple[str, bool]] = []
    kiosk.screen_changed.connect(lambda: begun.append((kiosk.shown, kiosk.property("goesBack"))))
    settled = []
    for stage in (Stage.ABOUT, Stage.AGE, Stage.CONSENT, Stage.INTRODUCTION, Stage.THANKS):
        go_to(app, stage)
        settled.append((kiosk.shown, kiosk.property("goesBack")))
        assert begun[-1] == settled[-1]
    assert {goes_back for _, goes_back in settled} == {True, False}


@pytest.mark.parametrize("dropped", [False, True], ids=["the session ends", "the session is dropped meanwhile"])
def test_each_page_is_cleared_in_a_step_of_its_own_and_the_start_screen_comes_in_the_last(
    make_booth: MakeBooth, *, dropped: bool
) -> None:
    booth = make_booth(settings=TINY)
    steps: list[Callable[[], None]] = []
    runner = booth.app.runner
    runner.later = lambda step: steps.append(step) if runner.stage is Stage.OVER else step()
    booth.rehearse(seed=1)
    board = booth.app.screens.board
    while board.rowCount():
        (step,) = steps
        steps.clear()
        assert booth.screen == "form"
        step()
    assert booth.screen == "form"
    if dropped:
        booth.app.runner.pause()
    while steps:
        steps.pop()()
    assert booth.screen == ("pause" if dropped else "attract")
