"""A visitor clicks through the real window, and everything that happened is in the database."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import pytest
from PySide6.QtGui import QGuiApplication

from kiosk.config import STAGES, Settings
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Outcome
from kiosk.experiment.events import WorldEvent
from kiosk.experiment.outcomes import NotRecordedReason, Stage, Status
from kiosk.experiment.session import Session
from kiosk.experiment.session_config import SessionConfig
from kiosk.experiment.session_state import SessionState
from kiosk.store.queries import open_repository
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.simulated_visitor import BehaviourKind, BehaviourProfile, UiTimeout
from tests.ui.conftest import Booth, MakeBooth, shared_booth
from tests.ui.headless import BRIEF, HALF, SMALL, TINY, headless, often, short
from tests.ui.visiting import PAIR

BARE = often(Settings.model_validate({"questionnaires": ["trust"], **PAIR}))
"""Every stage, each as short as it can be."""


@pytest.fixture(scope="module")
def bare(qapp: QGuiApplication, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Booth]:  # noqa: ARG001 - Qt is to be there
    """Provide one booth for all visitors who do not stay to the end: each leaves it at the start screen."""
    with shared_booth(BARE, tmp_path_factory.mktemp("bare")) as booth:
        yield booth


def test_a_whole_session_by_mouse_leaves_its_events_its_hints_its_answers_and_its_consent(
    make_booth: MakeBooth,
) -> None:
    booth = make_booth(settings=Settings())
    booth.rehearse(seed=1)
    with open_repository(booth.data) as stored:
        (session,) = stored.sessions()
        events, plan = stored.events(session.id), stored.plan(session.id)
    assert session.status is Status.COMPLETED
    assert session.pairs == 12
    assert session.flips == 2 * session.moves
    hints = [event for event in events if isinstance(event, happened.HintGiven)]
    assert len(hints) == session.hints > 0
    assert all(hint.sentence for hint in hints)
    stages = [event.stage.value for event in events if isinstance(event, happened.StageEntered)]
    assert stages == [*STAGES, "over"]
    (consent,) = (event for event in events if isinstance(event, happened.ConsentGiven))
    assert consent.purposes == ("share",)
    answered = {event.item for event in events if isinstance(event, happened.ResponseGiven)}
    assert answered == {item.id for asked in (plan.about_you, *plan.questionnaires) for item in asked.questions}
    assert isinstance(events[-1], happened.SessionEnded)


@pytest.mark.parametrize(
    ("manner", "why"),
    [(BehaviourKind.DECLINES, NotRecordedReason.DECLINED), (BehaviourKind.UNDER_AGE, NotRecordedReason.UNDER_AGE)],
)
def test_who_declines_or_is_too_young_plays_to_the_end_and_nothing_is_stored_of_it(
    bare: Booth, manner: BehaviourKind, why: NotRecordedReason
) -> None:
    why_not: list[NotRecordedReason] = []
    before = endings(bare)
    rehearsal = Rehearsal(bare.app, 1, visitor=BehaviourProfile(manner))
    watch = bare.app.runner.on_event
    assert watch is not None

    def look(event: WorldEvent, outcome: Outcome, stage: Stage) -> None:
        if isinstance(outcome.recording, do.DiscardRecording):
            why_not.append(outcome.recording.why)
        watch(event, outcome, stage)

    bare.app.runner.on_event = look
    rehearsal.run()
    bare.app.runner.on_event = watch
    assert why_not == [why]
    assert bare.screen == "attract"
    assert endings(bare) == before


def endings(booth: Booth) -> list[Status | None]:
    """Return how each session that is stored has ended."""
    with open_repository(booth.data) as stored:
        return [session.status for session in stored.sessions()]


@pytest.mark.parametrize("stage", ["consent", "about_you", "practice", "game", "result", "questions", "debrief"])
def test_whoever_walks_away_is_asked_and_then_the_kiosk_is_free_again(bare: Booth, stage: str) -> None:
    asked: list[bool] = []
    before, kiosk = endings(bare), bare.app.screens.kiosk

    def look() -> None:
        asked.append(bool(kiosk.property("asksStillThere")))

    kiosk.changed.connect(look)
    bare.rehearse(1, BehaviourProfile(BehaviourKind.LEAVES, Stage(stage)))
    kiosk.changed.disconnect(look)
    assert True in asked
    assert bare.screen == "attract"
    assert endings(bare) == before + ([] if stage == "consent" else [Status.ABANDONED])


def test_a_visitor_in_a_hurry_waits_while_the_practice_makes_room_for_the_game(bare: Booth) -> None:
    """For a moment, the practice is on the screen and cannot be left any more."""
    kiosk, board = bare.app.screens.kiosk, bare.app.screens.board
    rehearsal = Rehearsal(bare.app, 1, visitor=BehaviourProfile(BehaviourKind.HASTY))
    missed: list[str] = []

    def look() -> None:
        if kiosk.shown == "practice" and not board.property("practice"):
            try:
                rehearsal._go_on(kiosk.shown)
            except UiTimeout as stuck:
                missed.append(str(stuck))
            else:
                missed.append("")

    board.changed.connect(look)
    rehearsal.run()
    board.changed.disconnect(look)
    assert missed
    assert set(missed) == {""}
    assert endings(bare)[-1] is Status.COMPLETED


CONDITIONAL = """
id = "asked"
version = "1"
note = "ours"
per_page = 3
items = [
    { id = "plays", kind = "single", required = true, text.en = "Do you play?", options = [
        { id = "yes", text.en = "Yes" }, { id = "no", text.en = "No" } ] },
    { id = "which", kind = "text", required = true, relevant = "plays = 'yes'", text.en = "What?" },
    { id = "pity", kind = "page", relevant = "plays = 'no'", text.en = "A pity." },
    { id = "why", kind = "text", required = true, relevant = "not answered(which)", text.en = "Why?" },
]
"""


@pytest.mark.parametrize(("seed", "kind"), [(1, BehaviourKind.COMPLETES), (7, BehaviourKind.HASTY)])
def test_a_visitor_answers_the_items_that_come_by_their_answers(
    make_booth: MakeBooth, tmp_path: Path, seed: int, kind: BehaviourKind
) -> None:
    asked = tmp_path / "asked.toml"
    asked.write_text(CONDITIONAL, "utf-8")
    stages = ("consent", "about_you", "game")
    booth = make_booth(
        settings=SMALL.model_copy(
            update={"about_you": str(asked), "questionnaires": (), "stages": stages, "languages": ("en",)}
        )
    )
    booth.rehearse(seed, BehaviourProfile(kind))
    with open_repository(booth.data) as stored:
        assert [session.status for session in stored.sessions()] == [Status.COMPLETED]
        state = SessionState.from_events(stored.events(1))
    given = {item for (of, item), response in state.responses.items() if of == "asked" and response.value is not None}
    hidden = {item for of, item in state.hidden_items if of == "asked"}
    plays = state.responses["asked", "plays"].value
    assert given == ({"plays", "which"} if plays == "yes" else {"plays", "why"})
    assert hidden == ({"pity", "why"} if plays == "yes" else {"which"})


@dataclass(frozen=True)
class Played:
    """A session that was played to its end in a window, as it is stored."""

    plan: SessionConfig
    seed: int
    events: list[happened.Event]
    records: str


def play(data: Path) -> Played:
    """Return a session with half the cards."""
    with headless(BRIEF, data, seed=5, mode=HALF) as app:
        Rehearsal(app, 5).run()
    with open_repository(data) as stored:
        return Played(stored.plan(1), stored.seed(1), stored.events(1), json.dumps(stored.records(1)))


@pytest.fixture(scope="module")
def played(qapp: QGuiApplication, tmp_path_factory: pytest.TempPathFactory) -> Played:  # noqa: ARG001 - Qt is there
    """Return one such session, for the tests that only read it."""
    return play(tmp_path_factory.mktemp("played"))


def test_every_flip_in_the_database_is_a_card_that_was_clicked_just_before(played: Played) -> None:
    flips = 0
    for before, event in pairwise(played.events):
        if isinstance(event, happened.CardFlipped):
            assert isinstance(before, happened.CardSelected)
            assert before.position == event.position
            assert before.at_ms == event.at_ms
            flips += 1
    assert flips >= 12


def test_a_stored_session_handled_again_gives_the_same_records(played: Played) -> None:
    again = Session(played.plan, played.seed)
    replayed: list[happened.Event] = []
    for event in played.events:
        if isinstance(event, WorldEvent):
            outcome = again.handle(event)
            replayed += [event, *outcome.events]
    assert replayed == played.events


def test_the_same_seed_plays_the_same_session_to_the_millisecond(played: Played, tmp_path: Path) -> None:
    assert play(tmp_path).records == played.records


def test_without_help_a_visitor_plays_alone(make_booth: MakeBooth) -> None:
    booth = make_booth(condition="no_assistance", settings=short(game={"rows": 2, "columns": 4}))
    booth.rehearse(seed=1)
    with open_repository(booth.data) as stored:
        assert stored.sessions()[0].hints == 0


def test_one_session_after_another_is_played_in_the_same_window(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=TINY)
    for seed in (1, 2):
        booth.rehearse(seed=seed)
        assert booth.screen == "attract"
    with open_repository(booth.data) as stored:
        assert [session.status for session in stored.sessions()] == [Status.COMPLETED] * 2
