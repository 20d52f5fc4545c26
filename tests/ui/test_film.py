"""A replay becomes a film with captions and reasons, and with nothing that a visitor answered."""

from __future__ import annotations

import json
import sys
from itertools import pairwise
from pathlib import Path

import av
import pytest
from click.testing import CliRunner
from PySide6.QtQuick import QQuickWindow

from kiosk import UserInputError
from kiosk.assistance.memory_model import MemoryModel
from kiosk.assistance.policy import Gate
from kiosk.cli.main import recollect
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import SessionKind, Stage
from kiosk.experiment.replay import ReplayStep, replay_events
from kiosk.game import Board, Concentration
from kiosk.store.recorder import Provenance, Recorder
from kiosk.ui.film import LEFT_OUT_MS, PERSONAL, WIDTH, Captions, write_film
from kiosk.ui.replay import Replay
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from tests.experiment.driver import Driver, forgetful, with_memory
from tests.samples import mixed, plan, whole

SEED = 5
SPEED = 16.0


@pytest.fixture(scope="module")
def played() -> Driver:
    """Return a whole session in which hints were given."""
    driver = Driver(whole(game={"rows": 2, "columns": 6}), SEED)
    driver.whole_session(with_memory(1))
    assert any(isinstance(event, happened.HintGiven) for event in driver.events)
    return driver


@pytest.fixture(scope="module")
def steps(played: Driver) -> tuple[ReplayStep, ...]:
    """Its steps."""
    return replay_events(played.plan, SEED, played.events)


class Watched(Replay):
    """A replay that keeps which screen is shown whenever its window is looked at."""

    seen: list[str]

    @property
    def window(self) -> QQuickWindow:
        """Qt's own window."""
        self.seen.append(self.screens.kiosk.shown)
        return super().window


@pytest.mark.usefixtures("qapp")
def test_a_film_shows_all_but_what_visitors_answer(tmp_path: Path) -> None:
    played = Driver(whole(game={"rows": 2, "columns": 2}), SEED)
    played.whole_session(with_memory(3))
    steps = replay_events(played.plan, SEED, played.events)
    out = tmp_path / "out.webm"
    Watched.seen = []
    mode = RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL, SPEED)
    with Watched(mode, played.plan, steps, "Session 1") as replay:
        seconds = write_film(replay, played.plan.catalogue, out, memory=True)
    assert {"about", "introduction", "practice", "game", "result", "debrief"} <= set(Watched.seen)
    assert not {"age", "consent", "form"} & set(Watched.seen)
    stages = [Stage.ATTRACT, *(step.stage for step in steps)]
    times = [0, *(step.event.at_ms for step in steps)]
    shown = sum(
        end - begin for stage, (begin, end) in zip(stages, pairwise(times), strict=False) if stage not in PERSONAL
    )
    left_out = sum(one not in PERSONAL and other in PERSONAL for one, other in pairwise(stages))
    assert left_out > 0
    assert seconds == pytest.approx(shown / SPEED / 1000 + left_out * LEFT_OUT_MS / 1000 + 1, abs=0.2)
    with av.open(str(out)) as film:
        (stream,) = film.streams
        assert isinstance(stream, av.VideoStream)
        assert stream.width == WIDTH
        assert sum(1 for _ in film.decode(stream)) == round(10 * seconds)


def test_the_captions_say_what_was_said_and_why(played: Driver, steps: tuple[ReplayStep, ...]) -> None:
    captions = Captions(played.plan.catalogue, memory=True)
    reasons, hints = set(), 0
    for step in steps:
        captions.follow(step)
        for hint in (event for event in step.outcome.events if isinstance(event, happened.HintGiven)):
            hints += 1
            assert captions.said == hint.sentence
            place = f"row {hint.row + 1}" if hint.row is not None else f"column {(hint.column or 0) + 1}"
            assert place in captions.reason
            assert f"target {hint.seen} \N{MULTIPLICATION SIGN}" in captions.reason
        reasons.add(captions.reason.partition(":")[0])
    assert hints > 0
    assert {"", "Hint", "No hint"} <= reasons
    assert captions.remembered is None


@pytest.mark.parametrize(
    ("declared", "told"),
    [
        ({"explanation": False, "gaze_only": True}, {"Look without words"}),
        (
            {"praise": 1.0, "encourage": 1.0},
            {"Hint", "Comment: the last move was a pair.", "Comment: the last move was not a pair."},
        ),
    ],
)
def test_the_captions_tell_looks_and_comments_from_hints(declared: dict[str, float], told: set[str]) -> None:
    driver = Driver(plan(Condition("own"), mixed(SEED, Gate()), conditions={"own": declared}), SEED)
    driver.to_the_game()
    driver.play(forgetful(SEED))
    captions, reasons = Captions(driver.plan.catalogue, memory=False), set[str]()
    for step in replay_events(driver.plan, SEED, driver.events):
        captions.follow(step)
        for event in step.outcome.events:
            if isinstance(event, happened.HintGiven):
                reasons.add(captions.reason.partition(":")[0])
            elif isinstance(event, happened.RemarkGiven):
                reasons.add(captions.reason)
    assert reasons == told


def test_the_captions_show_what_the_memory_model_says(played: Driver, steps: tuple[ReplayStep, ...]) -> None:
    captions = Captions(played.plan.catalogue, memory=True)
    events: list[happened.Event] = []
    compared = remembered = 0
    for step in steps:
        captions.follow(step)
        events += step.outcome.events
        if step.stage is Stage.GAME and any(isinstance(event, happened.CardFlipped) for event in step.outcome.events):
            assert captions.remembered is not None
            assert captions.remembered.chances == pytest.approx(recalled(events))
            compared += 1
            remembered += any(captions.remembered.chances)
    assert compared > 10
    assert remembered > 5


def recalled(events: list[happened.Event]) -> tuple[float, ...]:
    """Return what a memory model of the last board says after its flips."""
    at = max(number for number, event in enumerate(events) if isinstance(event, happened.BoardDealt))
    dealt = events[at]
    assert isinstance(dealt, happened.BoardDealt)
    board = Board(dealt.rows, dealt.columns, dealt.cards)
    model = MemoryModel.of(Concentration(board))
    hinted = {event.flip for event in events[at:] if isinstance(event, happened.HintGiven)}
    for event in events[at:]:
        if isinstance(event, happened.CardFlipped):
            model.flip(board.location(event.position), hinted=event.number in hinted)
    return model.recall()


@pytest.fixture(scope="module")
def data(played: Driver, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the data folder in which a session is stored that ended soon."""
    folder = tmp_path_factory.mktemp("film") / "data"
    end = next(number for number, event in enumerate(played.events) if isinstance(event, happened.ConsentGiven))
    with Recorder(folder) as recorder:
        provenance = Provenance(played.plan, SEED, "avatar", "a test", kind=SessionKind.SIMULATED)
        recorder.begin(provenance, played.events[:end])
    return folder


@pytest.mark.usefixtures("qapp")
def test_the_command_writes_the_film(data: Path, tmp_path: Path) -> None:
    out = tmp_path / "film.mp4"
    said = CliRunner().invoke(recollect, ["replay", "1", "--data", str(data), "--film", str(out), "--json"])
    assert said.exit_code == 0, said.output
    told = json.loads(said.output)
    assert told["film"] == str(out)
    assert told["seconds"] > 0
    assert [file.name for file in tmp_path.iterdir()] == ["film.mp4"]


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--film", "film.avi"], "a film is a .webm or .mp4 file, but film.avi is neither"),
        (["--film", "nowhere/film.mp4"], "there is no folder"),
        (["--film", "film.mp4", "--window"], "--film cannot be used with --window"),
        (["--film", "film.mp4", "--memory"], "no card was dealt in session 1, so --memory has nothing to show"),
        (["--headless", "--memory"], "no card was dealt in session 1, so --memory has nothing to show"),
    ],
)
def test_a_film_that_cannot_be_is_refused_in_a_sentence(data: Path, options: list[str], sentence: str) -> None:
    said = CliRunner().invoke(recollect, ["replay", "1", "--data", str(data), *options])
    assert isinstance(said.exception, UserInputError)
    assert sentence in str(said.exception)


def test_without_pyav_a_sentence_says_how_to_get_it(data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    said = CliRunner().invoke(recollect, ["replay", "1", "--data", str(data), "--film", "film.webm"])
    assert isinstance(said.exception, UserInputError)
    assert "pip install 'recollect[film]'" in str(said.exception)
