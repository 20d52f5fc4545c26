"""A stored session, played again: what stands on the screen is what stood there, forwards, back and at any speed."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest
from click.testing import CliRunner
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.cli.main import recollect
from kiosk.experiment import events as happened
from kiosk.experiment.effects import RevealCard
from kiosk.experiment.events import CardFlipped
from kiosk.experiment.outcomes import SessionKind, Stage
from kiosk.experiment.replay import ReplayStep, first_difference, replay_events
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.ui.film import Captions
from kiosk.ui.replay import Replay
from kiosk.ui.replay_controls import MemoryDrawing
from kiosk.ui.screens.avatar import PATIENCE_MS
from kiosk.ui.simulated_visitor import lay_out
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from tests.experiment.driver import Driver, with_memory
from tests.samples import whole
from tests.ui.headless import HALF

SEED = 5


@pytest.fixture(scope="module")
def played() -> Driver:
    """Return a whole session, of which everything is known."""
    driver = Driver(whole(game={"rows": 2, "columns": 2}), SEED)
    driver.whole_session(with_memory(3))
    return driver


@pytest.fixture
def folder(played: Driver, tmp_path: Path) -> Path:
    """Return the data folder in which it is stored."""
    with Recorder(tmp_path / "data") as recorder:
        recorder.begin(Provenance(played.plan, SEED, "avatar", "a test", kind=SessionKind.SIMULATED), played.events)
    return tmp_path / "data"


@pytest.fixture
def steps(played: Driver) -> tuple[ReplayStep, ...]:
    """Its steps."""
    return replay_events(played.plan, SEED, played.events)


@pytest.fixture
def replay(played: Driver, steps: tuple[ReplayStep, ...], qtbot: QtBot) -> Iterator[Replay]:
    """Provide the replay, standing before the first step."""
    with Replay(
        RunMode(WindowMode.NOWHERE, ClockMode.WALL, 32, size=HALF.size), played.plan, steps, "Session 1"
    ) as replay:
        qtbot.waitUntil(lambda: replay.window.isExposed() and replay.window.isActive())
        yield replay


def seen(replay: Replay) -> tuple[object, ...]:
    """Return what stands on the screens."""
    screens = replay.screens
    return (screens.kiosk.shown, screens.board.unmatched, screens.board.closed, screens.avatar.bubble)


def test_every_step_leads_to_what_was_recorded(steps: tuple[ReplayStep, ...], played: Driver) -> None:
    assert [step.event for step in steps] == played.world
    assert all(step.agrees for step in steps)
    assert first_difference(steps, played.events) is None


def test_a_record_that_was_tampered_with_is_told_by_its_place(played: Driver) -> None:
    at = next(i for i, event in enumerate(played.events) if isinstance(event, happened.CardFlipped))
    flipped = played.events[at]
    assert isinstance(flipped, happened.CardFlipped)
    forged = happened.CardFlipped(**{**vars(flipped), "card": "a card that never was"})
    events = [*played.events[:at], forged, *played.events[at + 1 :]]
    assert first_difference(replay_events(played.plan, SEED, events), events) == at


def test_an_event_that_has_no_place_today_ends_the_replay_there(played: Driver) -> None:
    events = [*played.events[:4], happened.SessionStarted(at_ms=10), *played.events[4:]]
    assert first_difference(replay_events(played.plan, SEED, events), events) == 5


def test_the_screens_go_through_every_stage(replay: Replay) -> None:
    shown = []
    while not replay.player.over:
        replay.player.step()
        shown.append(replay.screens.kiosk.shown)
    assert list(dict.fromkeys(shown)) == [
        *("about", "age", "consent", "form", "introduction", "practice", "game", "result"),
        *("debrief", "thanks"),
    ]


def test_a_step_back_shows_what_stood_there_before(replay: Replay, steps: tuple[ReplayStep, ...]) -> None:
    flip = next(i for i, step in enumerate(steps) if any(isinstance(c, RevealCard) for c in step.outcome.effects))
    replay.player.go_to(flip)
    before = seen(replay)
    replay.player.step()
    assert seen(replay) != before
    replay.player.go_to(flip)
    assert seen(replay) == before


def test_it_shows_what_is_remembered_forwards_and_back(
    replay: Replay, steps: tuple[ReplayStep, ...], played: Driver
) -> None:
    flips = [i for i, step in enumerate(steps, 1) if any(isinstance(e, CardFlipped) for e in step.outcome.events)]
    captions = Captions(played.plan.catalogue, memory=True)
    replay.show_memory()
    for step in steps[: flips[3]]:
        captions.follow(step)
    replay.player.go_to(flips[3])
    drawing = replay.window.findChild(MemoryDrawing)
    assert drawing is not None
    assert drawing.memory is not None
    assert any(drawing.memory.chances)
    assert drawing.memory == captions.remembered
    replay.player.go_to(flips[0] - 1)
    assert drawing.memory is not None
    assert not any(drawing.memory.chances)
    replay.player.go_to(0)
    assert drawing.memory is None


def test_the_avatar_does_not_search_for_words_that_were_found_then(replay: Replay, qtbot: QtBot) -> None:
    replay.player.go_to(1 + next(i for i, step in enumerate(replay.player.steps) if step.stage is Stage.PRACTICE))
    assert replay.screens.avatar.property("bubble")
    qtbot.wait(2 * PATIENCE_MS)
    assert replay.screens.avatar.property("mood") == "idle"


def test_it_plays_by_itself_to_the_end_and_stays_there(replay: Replay, qtbot: QtBot) -> None:
    replay.player.run()
    qtbot.waitUntil(lambda: replay.player.over, timeout=60_000)
    assert not replay.player.runs
    assert replay.screens.kiosk.shown == "thanks"


def test_it_is_driven_by_keys(replay: Replay) -> None:
    def press(key: Qt.Key) -> None:
        QTest.keyClick(replay.window, key)

    lay_out(replay.window)
    press(Qt.Key.Key_Right)
    press(Qt.Key.Key_Right)
    assert replay.player.played == 2
    press(Qt.Key.Key_Left)
    assert replay.player.played == 1
    press(Qt.Key.Key_End)
    assert replay.player.over
    press(Qt.Key.Key_Home)
    assert replay.player.played == 0
    press(Qt.Key.Key_Down)
    assert replay.player.speed == 16
    press(Qt.Key.Key_Space)
    assert replay.player.runs
    press(Qt.Key.Key_Space)
    assert not replay.player.runs


def test_nobody_who_watches_can_play_or_see_the_code(replay: Replay) -> None:
    replay.player.go_to(len(replay.player.steps))
    assert replay.screens.debrief.property("code") == "· · ·"
    replay.player.go_to(0)
    before = seen(replay)
    replay.screens.attract.started.emit("en")
    assert seen(replay) == before


@pytest.mark.usefixtures("qapp")
def test_without_a_screen_it_saves_pictures(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kiosk.cli.replay.RunMode", partial(RunMode, size=HALF.size))
    frames = tmp_path / "frames"
    result = CliRunner().invoke(
        recollect, ["replay", "1", "--data", str(folder), "--headless", "--frames", str(frames), "--json"]
    )
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout.splitlines()[-1])
    assert told["differs_at"] is None
    pictures = sorted(frames.iterdir())
    assert len(pictures) == told["pictures"] > 30
    assert any("-consent-" in picture.name for picture in pictures)


def test_a_session_that_is_not_there_is_refused_in_words(folder: Path) -> None:
    result = CliRunner().invoke(recollect, ["replay", "7", "--data", str(folder), "--headless"])
    assert str(result.exception) == "there is no session 7"


def test_the_end_that_was_put_to_a_session_after_a_crash_is_no_part_of_its_story(
    played: Driver, tmp_path: Path
) -> None:
    cut = played.events[: len(played.events) // 2]
    with Recorder(tmp_path) as recorder:
        recorder.begin(Provenance(played.plan, SEED, "avatar", "a test", kind=SessionKind.SIMULATED), cut)
    with Recorder(tmp_path), open_repository(tmp_path) as stored:
        assert stored.story(1) == cut
        assert stored.events(1)[:-1] == cut
