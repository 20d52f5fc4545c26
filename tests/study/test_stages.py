"""The course of a sitting is a table: what a stage does not list is refused, and then nothing has changed."""

from __future__ import annotations

from itertools import permutations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk import BadInput
from kiosk.settings import STAGES, Game
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.events import Stage, Status, Timer, WorldEvent
from kiosk.study.stages import BEFORE_DECIDING, TABLE, Course, Turn, UnexpectedEvent, diagram, turn
from tests.samples import plan
from tests.study.driver import Driver, Step, driven_to, notes
from tests.study.examples import EXAMPLES

UNDERWAY = list(Stage)[1:-1]

ANYWHERE = {
    *("TimerEnded", "SpeechStarted", "SpeechFinished", "SpeechFailed", "RobotLost"),
    *("UserActivity", "PauseAsked", "SoundChanged", "EndAsked", "KioskClosed"),
}
KEPT = {"SittingResumed"}
"""What needs a record that can be gone on with; a game is never gone on with."""

EXPECTED = {
    Stage.ATTRACT: {"StartTapped"},
    Stage.ABOUT: {"ContinueTapped"} | ANYWHERE,
    Stage.CONSENT: {"PurposeTicked", "AgreeTapped", "DeclineTapped"} | ANYWHERE,
    Stage.AGE: {"AgeTapped"} | ANYWHERE,
    Stage.ABOUT_YOU: {"ContinueTapped", "Typed"} | ANYWHERE | KEPT,
    Stage.INTRODUCTION: {"ContinueTapped"} | ANYWHERE | KEPT,
    Stage.PRACTICE: {"CardTapped", "SkipTapped"} | ANYWHERE | KEPT,
    Stage.GAME: {"CardTapped"} | ANYWHERE,
    Stage.RESULT: {"ContinueTapped"} | ANYWHERE | KEPT,
    Stage.QUESTIONS: {"ContinueTapped", "AnswerGiven", "Typed"} | ANYWHERE | KEPT,
    Stage.DEBRIEF: {"ContinueTapped"} | ANYWHERE | KEPT,
    Stage.THANKS: {"ContinueTapped", "NextAsked"} | ANYWHERE | KEPT,
    Stage.OVER: set[str](),
}
"""What each stage takes as it begins: nobody was asked whether they are still there, and nothing is paused."""


def finished(driver: Driver) -> list[Step]:
    """Every step of this sitting, from here on to its end."""
    driver.to(Stage.OVER)
    return driver.steps


def test_there_is_an_example_of_every_event_from_outside() -> None:
    assert set(EXAMPLES) == set(WorldEvent.__subclasses__())


@pytest.mark.parametrize("stage", Stage)
@pytest.mark.parametrize("kind", EXAMPLES, ids=lambda kind: str(kind.__name__))
def test_a_stage_takes_what_it_has_a_place_for_and_refuses_the_rest(stage: Stage, kind: type[WorldEvent]) -> None:
    driver, twin = driven_to(stage), driven_to(stage)
    event = EXAMPLES[kind]
    if kind.__name__ in EXPECTED[stage]:
        driver.send(event)
        return
    with pytest.raises(UnexpectedEvent) as refused:
        driver.send(event)
    assert str(refused.value) == f"{kind.__name__} has no place in the stage {stage.value}"
    assert (refused.value.stage, refused.value.event) == (stage, event)
    assert driver.stage is stage
    assert finished(driver) == finished(twin)


@pytest.mark.parametrize("stage", UNDERWAY)
def test_being_still_there_has_a_place_only_when_it_was_asked(stage: Stage) -> None:
    driver = driven_to(stage)
    driver.send(happened.TimerEnded(at_ms=driver.now, timer=Timer.IDLE))
    assert driver.view.still_there
    driver.send(happened.StillHereTapped(at_ms=driver.now))
    with pytest.raises(UnexpectedEvent):
        driver.send(happened.StillHereTapped(at_ms=driver.now))


@pytest.mark.parametrize("stage", UNDERWAY)
@pytest.mark.parametrize("timer", Timer)
def test_a_wait_ends_only_if_it_was_asked_for(stage: Stage, timer: Timer) -> None:
    driver, twin = driven_to(stage), driven_to(stage)
    event = happened.TimerEnded(at_ms=driver.now, timer=timer)
    if timer in driver.running:
        driver.send(event)
        return
    with pytest.raises(UnexpectedEvent):
        driver.send(event)
    assert finished(driver) == finished(twin)


def test_a_wait_ends_only_once() -> None:
    driver = driven_to(Stage.GAME)
    driver.send(happened.TimerEnded(at_ms=driver.now, timer=Timer.IDLE))
    with pytest.raises(UnexpectedEvent):
        driver.send(happened.TimerEnded(at_ms=driver.now, timer=Timer.IDLE))


@pytest.mark.parametrize(("item", "value"), [("helped", 1), ("enjoyed", 0), ("enjoyed", 6), ("enjoyed", -1), ("", 1)])
def test_an_answer_fits_the_question_that_is_asked(item: str, value: int) -> None:
    driver, twin = driven_to(Stage.QUESTIONS), driven_to(Stage.QUESTIONS)
    with pytest.raises(UnexpectedEvent):
        driver.answer(value, item)
    assert finished(driver) == finished(twin)


# The table


def test_no_stage_is_left_but_by_the_table() -> None:
    ways = {
        (stage.value, kind.__name__, step)
        for stage, row in TABLE.items()
        for kind, step in row.items()
        if step is not Turn.STAY
    }
    assert ways == {
        ("attract", "StartTapped", Turn.ON),
        ("about", "ContinueTapped", Turn.ON),
        ("consent", "ConsentGiven", Turn.ON),
        ("consent", "DeclineTapped", Turn.ON),
        ("age", "AgeTapped", Turn.ON),
        ("about_you", "QuestionsFinished", Turn.ON),
        ("introduction", "ContinueTapped", Turn.ON),
        ("practice", "PracticeFinished", Turn.ON),
        ("game", "GameFinished", Turn.ON),
        ("result", "ContinueTapped", Turn.ON),
        ("questions", "QuestionsFinished", Turn.ON),
        ("debrief", "ContinueTapped", Turn.ON),
        ("thanks", "ContinueTapped", Turn.ON),
        ("thanks", "NextAsked", Turn.ON),
        ("thanks", "Thanked", Turn.ON),
        *((stage.value, "VisitorLeft", Turn.OVER) for stage in UNDERWAY),
        *((stage.value, "EndAsked", Turn.OVER) for stage in UNDERWAY),
        *((stage.value, "KioskClosed", Turn.OVER) for stage in UNDERWAY),
    }


def test_the_table_has_a_row_for_every_stage_and_cannot_be_changed() -> None:
    assert set(TABLE) == set(Stage)
    for row in (TABLE, *TABLE.values()):
        with pytest.raises(TypeError):
            row[Stage.OVER] = {}  # type: ignore[index]


def test_what_a_stage_does_not_list_leads_nowhere() -> None:
    assert turn(Stage.GAME, happened.BoardOpened(at_ms=1)) is Turn.STAY
    assert turn(Stage.GAME, happened.VisitorLeft(at_ms=1)) is Turn.OVER
    assert turn(Stage.GAME, happened.GameFinished(at_ms=1)) is Turn.ON
    assert turn(Stage.OVER, happened.GameFinished(at_ms=1)) is Turn.STAY


def test_the_diagram_draws_where_declining_leads() -> None:
    drawn = diagram().splitlines()
    assert "    consent --> age: ConsentGiven" in drawn
    assert "    consent --> introduction: DeclineTapped" in drawn
    assert "    age --> about_you: AgeTapped" in drawn
    assert "    age --> introduction: AgeTapped" in drawn
    assert "    thanks --> over: Thanked" in drawn


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


def course(names: tuple[str, ...]) -> Course | None:
    """The course of these names, or None if it is refused."""
    try:
        return Course.of(names)
    except BadInput:
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
    with pytest.raises(BadInput) as refused:
        Course.of(names)
    assert str(refused.value) == sentence
    with pytest.raises(BadInput, match="stages: "):
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
    entered, here = [], Course.of(names).after(Stage.ATTRACT, kept=True)
    while here is not Stage.OVER:
        entered.append(here.value)
        here = Course.of(names).after(here, kept=True)
    assert tuple(entered) == names


@given(names=courses())
def test_a_sitting_follows_any_course_to_its_end_and_is_kept_once(names: tuple[str, ...]) -> None:
    driver = Driver(plan(stages=names, game=Game(rows=2, columns=2)), 3)
    driver.to(Stage.OVER)
    entered = [event.stage for event in driver.noted(happened.StageEntered)]
    assert [stage.value for stage in entered] == [*names, "over"]
    assert driver.view.ended is Status.COMPLETED
    assert len(driver.view.kept) == 1
    first = next(stage for stage in entered if stage not in BEFORE_DECIDING)
    kept_in = next(step for step in driver.steps if do.KeepSitting() in step.commands)
    assert happened.StageEntered(at_ms=kept_in.event.at_ms, stage=first) in notes(kept_in.commands)


@given(names=courses())
def test_what_is_not_kept_goes_on_without_what_needs_a_record(names: tuple[str, ...]) -> None:
    needs = {"consent", "age", "about_you", "questions", "debrief"}
    entered, here = [], Course.of(names).after(Stage.ATTRACT, kept=False)
    while here is not Stage.OVER:
        entered.append(here.value)
        here = Course.of(names).after(here, kept=False)
    assert entered == [name for name in names if name not in needs]
