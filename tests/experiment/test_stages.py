"""The course of a session is a table: what a stage does not list is refused, and then nothing has changed."""

from __future__ import annotations

from itertools import permutations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk import UserInputError
from kiosk.config import STAGES, Game
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.events import Timer, WorldEvent
from kiosk.experiment.outcomes import Stage, Status
from kiosk.experiment.transitions import (
    BEFORE_DECIDING,
    TABLE,
    InvalidTransition,
    StageOrder,
    Transition,
    diagram,
    transition,
)
from tests.experiment.driver import Driver, Step, driven_to
from tests.experiment.examples import EXAMPLES
from tests.samples import plan

UNDERWAY = list(Stage)[1:-1]

ANYWHERE = {
    *("TimerExpired", "SpeechStarted", "SpeechFinished", "SpeechFailed", "RobotDisconnected"),
    *("UserActivity", "PauseRequested", "MuteChanged", "AbortRequested", "ApplicationClosed"),
    *("StopPressed", "LanguageSelected", "TextSizeSelected", "SoundSelected"),
}
KEPT = {"SessionResumed"}
"""What needs a record that can be gone on with; a game is never gone on with."""

EXPECTED = {
    Stage.ATTRACT: {"SessionStarted"},
    Stage.ABOUT: {"ContinuePressed"} | ANYWHERE,
    Stage.CONSENT: {"ConsentPurposeToggled", "ConsentSubmitted", "ConsentDeclined", "BackPressed"} | ANYWHERE,
    Stage.AGE: {"AgeConfirmed", "BackPressed"} | ANYWHERE,
    Stage.ABOUT_YOU: {"ContinuePressed", "TypingActivity"} | ANYWHERE | KEPT,
    Stage.INTRODUCTION: {"ContinuePressed", "BackPressed"} | ANYWHERE | KEPT,
    Stage.PRACTICE: {"CardSelected", "PracticeSkipped"} | ANYWHERE | KEPT,
    Stage.GAME: {"CardSelected"} | ANYWHERE,
    Stage.RESULT: {"ContinuePressed"} | ANYWHERE | KEPT,
    Stage.QUESTIONS: {"ContinuePressed", "ResponseGiven", "TypingActivity"} | ANYWHERE | KEPT,
    Stage.DEBRIEF: {"ContinuePressed"} | ANYWHERE | KEPT,
    Stage.THANKS: {"ContinuePressed", "NextParticipantRequested", "BackPressed"} | ANYWHERE | KEPT,
    Stage.OVER: set[str](),
}
"""What each stage takes as it begins: no one was asked whether they are still there, and nothing is paused."""


def finished(driver: Driver) -> list[Step]:
    """Every step of this session, from here on to its end."""
    driver.to(Stage.OVER)
    return driver.steps


def test_there_is_an_example_of_every_event_from_outside() -> None:
    assert set(EXAMPLES) == set(WorldEvent.__subclasses__())


@pytest.mark.parametrize("stage", Stage)
def test_a_stage_takes_what_it_has_a_place_for_and_refuses_the_rest(stage: Stage) -> None:
    refusing = driven_to(stage)
    for kind, event in EXAMPLES.items():
        if kind.__name__ in EXPECTED[stage]:
            driven_to(stage).send(event)
            continue
        with pytest.raises(InvalidTransition) as refused:
            refusing.send(event)
        assert str(refused.value) == f"{kind.__name__} has no place in the stage {stage.value}"
        assert (refused.value.stage, refused.value.event) == (stage, event)
        assert refusing.stage is stage
    # After all refusals together the session goes on as one that had none.
    assert finished(refusing) == finished(driven_to(stage))


@pytest.mark.parametrize("stage", UNDERWAY)
def test_being_still_there_has_a_place_only_when_it_was_asked(stage: Stage) -> None:
    driver = driven_to(stage)
    driver.send(happened.TimerExpired(at_ms=driver.now, timer=Timer.IDLE))
    assert driver.view.still_there
    driver.send(happened.PresenceConfirmed(at_ms=driver.now))
    with pytest.raises(InvalidTransition):
        driver.send(happened.PresenceConfirmed(at_ms=driver.now))


@pytest.mark.parametrize("stage", UNDERWAY)
def test_a_wait_ends_only_if_it_was_asked_for(stage: Stage) -> None:
    refusing = driven_to(stage)
    for timer in Timer:
        event = happened.TimerExpired(at_ms=refusing.now, timer=timer)
        if timer in refusing.running:
            driven_to(stage).send(event)
            continue
        with pytest.raises(InvalidTransition):
            refusing.send(event)
    assert finished(refusing) == finished(driven_to(stage))


def test_a_wait_ends_only_once() -> None:
    driver = driven_to(Stage.GAME)
    driver.send(happened.TimerExpired(at_ms=driver.now, timer=Timer.IDLE))
    with pytest.raises(InvalidTransition):
        driver.send(happened.TimerExpired(at_ms=driver.now, timer=Timer.IDLE))


@pytest.mark.parametrize(("item", "value"), [("helped", 1), ("enjoyed", 0), ("enjoyed", 6), ("enjoyed", -1), ("", 1)])
def test_an_answer_fits_the_question_that_is_asked(item: str, value: int) -> None:
    driver, twin = driven_to(Stage.QUESTIONS), driven_to(Stage.QUESTIONS)
    with pytest.raises(InvalidTransition):
        driver.answer(value, item)
    assert finished(driver) == finished(twin)


# The table


def test_no_stage_is_left_but_by_the_table() -> None:
    ways = {
        (stage.value, kind.__name__, step)
        for stage, row in TABLE.items()
        for kind, step in row.items()
        if step is not Transition.STAY
    }
    assert ways == {
        ("attract", "SessionStarted", Transition.ON),
        ("about", "ContinuePressed", Transition.ON),
        ("consent", "ConsentGiven", Transition.ON),
        ("consent", "ConsentDeclined", Transition.ON),
        ("age", "AgeConfirmed", Transition.ON),
        ("about_you", "QuestionnairesCompleted", Transition.ON),
        ("introduction", "ContinuePressed", Transition.ON),
        ("practice", "PracticeFinished", Transition.ON),
        ("game", "GameFinished", Transition.ON),
        ("result", "ContinuePressed", Transition.ON),
        ("questions", "QuestionnairesCompleted", Transition.ON),
        ("debrief", "ContinuePressed", Transition.ON),
        ("thanks", "ContinuePressed", Transition.ON),
        ("thanks", "NextParticipantRequested", Transition.ON),
        ("thanks", "ThanksTimedOut", Transition.ON),
        *((stage.value, "IdleTimedOut", Transition.OVER) for stage in UNDERWAY),
        *((stage, "BackPressed", Transition.BACK) for stage in ("age", "consent", "introduction", "thanks")),
        *((stage.value, "AbortRequested", Transition.OVER) for stage in UNDERWAY),
        *((stage.value, "StopPressed", Transition.OVER) for stage in UNDERWAY),
        *((stage.value, "ApplicationClosed", Transition.OVER) for stage in UNDERWAY),
    }


def test_the_table_has_a_row_for_every_stage_and_cannot_be_changed() -> None:
    assert set(TABLE) == set(Stage)
    for row in (TABLE, *TABLE.values()):
        with pytest.raises(TypeError):
            row[Stage.OVER] = {}  # type: ignore[index]


def test_what_a_stage_does_not_list_leads_nowhere() -> None:
    assert transition(Stage.GAME, happened.BoardUnlocked(at_ms=1)) is Transition.STAY
    assert transition(Stage.GAME, happened.IdleTimedOut(at_ms=1)) is Transition.OVER
    assert transition(Stage.GAME, happened.GameFinished(at_ms=1)) is Transition.ON
    assert transition(Stage.OVER, happened.GameFinished(at_ms=1)) is Transition.STAY


def test_the_diagram_draws_where_declining_leads() -> None:
    drawn = diagram().splitlines()
    assert "    age --> consent: AgeConfirmed" in drawn
    assert "    consent --> introduction: ConsentDeclined" in drawn
    assert "    consent --> about_you: ConsentGiven" in drawn
    assert "    age --> introduction: AgeConfirmed" in drawn
    assert "    thanks --> over: ThanksTimedOut" in drawn


# The order of the stages

DECIDED = ("consent", "age")
MUST_COME_BEFORE = [
    *(("about", after) for after in (*DECIDED, "game")),
    *((decided, after) for decided in DECIDED for after in ("about_you", "introduction", "practice", "game")),
    *((decided, after) for decided in DECIDED for after in ("result", "questions", "debrief", "thanks")),
    *(("introduction", after) for after in ("practice", "game")),
    ("practice", "game"),
    *(("game", after) for after in ("result", "debrief", "thanks")),
    *((before, after) for before in ("about_you", "result", "questions") for after in ("debrief", "thanks")),
    ("debrief", "thanks"),
]
"""Every pair of stages whose order is not the study's to choose, among those that stand with a game."""


def allowed(names: tuple[str, ...]) -> bool:
    """Whether these names are a course, by nothing but the pairs."""
    before = {(one, another) for index, one in enumerate(names) for another in names[index + 1 :]}
    return "game" in names and not any((late, early) in before for early, late in MUST_COME_BEFORE)


def course(names: tuple[str, ...]) -> StageOrder | None:
    """Return the course of these names, or None if it is refused."""
    try:
        return StageOrder.of(names)
    except UserInputError:
        return None


@given(st.permutations(STAGES), st.integers(1, len(STAGES)))
def test_a_course_is_refused_for_a_pair_in_the_wrong_order_and_for_nothing_else(names: list[str], length: int) -> None:
    chosen = tuple(names[:length])
    assert (course(chosen) is not None) is allowed(chosen)


def test_of_three_stages_the_same_holds_in_every_order() -> None:
    for chosen in permutations(STAGES, 3):
        assert (course(chosen) is not None) is allowed(chosen), chosen


@pytest.mark.parametrize(
    ("names", "sentence"),
    [
        ((), "stages: without the stage 'game' there is nothing to study"),
        (("about", "thanks"), "stages: without the stage 'game' there is nothing to study"),
        (("game", "lunch"), f"stages: there is no stage 'lunch'; there are {', '.join(STAGES)}"),
        (("attract", "game"), f"stages: there is no stage 'attract'; there are {', '.join(STAGES)}"),
        (("game", "over"), f"stages: there is no stage 'over'; there are {', '.join(STAGES)}"),
        (("game", "consent"), "stages: 'consent' must come before 'game'"),
        (("introduction", "age", "game"), "stages: 'age' must come before 'introduction'"),
        (("consent", "about", "game"), "stages: 'about' must come before 'consent'"),
        (("practice", "introduction", "game"), "stages: 'introduction' must come before 'practice'"),
        (("result", "game"), "stages: 'game' must come before 'result'"),
        (("game", "debrief", "questions"), "stages: 'questions' must come before 'debrief'"),
        (("game", "thanks", "about_you"), "stages: 'about_you' must come before 'thanks'"),
    ],
)
def test_an_order_that_cannot_be_is_refused_in_words(names: tuple[str, ...], sentence: str) -> None:
    with pytest.raises(UserInputError) as refused:
        StageOrder.of(names)
    assert str(refused.value) == sentence
    with pytest.raises(UserInputError, match="stages: "):
        Driver(plan(stages=names or ("about",)))


@st.composite
def courses(draw: st.DrawFn) -> tuple[str, ...]:
    """Any stages in any order that is allowed: each put somewhere among those that are there already, if it can be."""
    chosen: tuple[str, ...] = ("game",)
    for name in draw(st.lists(st.sampled_from(STAGES), unique=True)):
        if name not in chosen:
            places = [(*chosen[:place], name, *chosen[place:]) for place in range(len(chosen) + 1)]
            chosen = draw(st.sampled_from([place for place in places if allowed(place)] or [chosen]))
    return chosen


@given(names=courses())
def test_a_course_leads_through_every_stage_once(names: tuple[str, ...]) -> None:
    entered, here = [], StageOrder.of(names).after(Stage.ATTRACT, kept=True)
    while here is not Stage.OVER:
        entered.append(here.value)
        here = StageOrder.of(names).after(here, kept=True)
    assert tuple(entered) == names


@given(names=courses())
def test_a_session_follows_any_course_to_its_end_and_is_kept_once(names: tuple[str, ...]) -> None:
    driver = Driver(plan(stages=names, game=Game(rows=2, columns=2)), 3)
    driver.to(Stage.OVER)
    entered = [event.stage for event in driver.noted(happened.StageEntered)]
    assert [stage.value for stage in entered] == [*names, "over"]
    assert driver.view.ended is Status.COMPLETED
    assert len(driver.view.kept) == 1
    first = next(stage for stage in entered if stage not in BEFORE_DECIDING)
    kept_in = next(step for step in driver.steps if step.outcome.recording == do.StartRecording())
    assert happened.StageEntered(at_ms=kept_in.event.at_ms, stage=first) in kept_in.outcome.events


@given(names=courses())
def test_what_is_not_kept_goes_on_without_what_needs_a_record(names: tuple[str, ...]) -> None:
    needs = {"consent", "age", "about_you", "questions", "debrief"}
    entered, here = [], StageOrder.of(names).after(Stage.ATTRACT, kept=False)
    while here is not Stage.OVER:
        entered.append(here.value)
        here = StageOrder.of(names).after(here, kept=False)
    assert entered == [name for name in names if name not in needs]
