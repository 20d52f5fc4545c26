"""What was answered, when, and how often the answer was changed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.experiment import events as happened
from kiosk.experiment.events import Event
from kiosk.experiment.item_responses import ItemResponse, effective_answer
from kiosk.experiment.items import Answer, Multiple, ShortText, TextPage
from kiosk.experiment.outcomes import EmbodimentName, Stage, Status
from kiosk.experiment.projections import item_responses
from kiosk.experiment.questionnaire import ItemOrder, Questionnaire
from kiosk.experiment.session_state import SessionState
from tests.experiment.driver import driven_to
from tests.samples import ABOUT_YOU, CLOSING, likert, options, questionnaire, whole

PAGE = TextPage(id="read", kind="page", text={"en": "read"})
ONE = questionnaire("one", PAGE, likert("a"), likert("b"))
TWO = questionnaire("two", likert("a"))


def entered(at_ms: int, stage: Stage = Stage.QUESTIONS) -> Event:
    """Begin a stage."""
    return happened.StageEntered(at_ms=at_ms, stage=stage)


def shown(at_ms: int, *items: str, of: str = "one") -> Event:
    """Show a page."""
    return happened.QuestionnairePageShown(at_ms=at_ms, questionnaire=of, items=items)


def said(at_ms: int, item: str, value: Answer | None) -> Event:
    """Answer an item."""
    return happened.ResponseGiven(at_ms=at_ms, item=item, value=value)


def responses(events: Iterable[Event], questionnaires: Sequence[Questionnaire]) -> tuple[ItemResponse, ...]:
    """Return what became of every item in a session of these events."""
    return item_responses(SessionState.from_events(events), questionnaires)


def test_without_events_every_item_is_missing_in_the_declared_order() -> None:
    assert responses([], [ONE, TWO]) == (
        ItemResponse("one", "a"),
        ItemResponse("one", "b"),
        ItemResponse("two", "a"),
    )
    assert ItemResponse("one", "a") == ItemResponse("one", "a", response=None, first_ms=None, last_ms=None, changes=0)


def test_a_text_page_is_no_item_that_could_be_missing() -> None:
    assert [answered.item for answered in responses([], [ONE])] == ["a", "b"]


def test_times_count_from_when_the_page_was_shown() -> None:
    events = [entered(1000), shown(1000, "a"), said(3500, "a", 4), shown(5000, "b"), said(5200, "b", 2)]
    assert responses(events, [ONE]) == (
        ItemResponse("one", "a", 4, first_ms=2500, last_ms=2500),
        ItemResponse("one", "b", 2, first_ms=200, last_ms=200),
    )


def test_the_last_answer_counts_and_changes_are_counted() -> None:
    events = [entered(0), shown(0, "a", "b"), said(10, "a", 4), said(20, "b", 1), said(30, "a", 4), said(40, "a", 5)]
    assert responses(events, [ONE]) == (
        ItemResponse("one", "a", 5, first_ms=10, last_ms=40, changes=1),
        ItemResponse("one", "b", 1, first_ms=20, last_ms=20, changes=0),
    )


def test_an_answer_that_was_taken_back_is_missing_and_leaves_its_times() -> None:
    events = [entered(0), shown(0, "a"), said(10, "a", 4), said(30, "a", None)]
    assert responses(events, [ONE])[0] == ItemResponse("one", "a", None, first_ms=10, last_ms=30, changes=1)
    again = [*events, said(50, "a", 4)]
    assert responses(again, [ONE])[0] == ItemResponse("one", "a", 4, first_ms=10, last_ms=50, changes=2)


def test_taking_back_what_was_never_answered_is_no_change() -> None:
    events = [entered(0), shown(0, "a"), said(10, "a", None)]
    assert responses(events, [ONE])[0] == ItemResponse("one", "a", None, first_ms=10, last_ms=10, changes=0)


@pytest.mark.parametrize("nothing", ["", ()])
def test_an_answer_that_says_nothing_is_missing(nothing: Answer) -> None:
    item = (
        ShortText(id="a", kind="text", text={"en": "a"})
        if nothing == ""
        else Multiple(id="a", kind="multiple", text={"en": "a"}, options=options("x", "y"))
    )
    events = [entered(0), shown(0, "a"), said(10, "a", nothing)]
    assert responses(events, [questionnaire("one", item)]) == (ItemResponse("one", "a", None, 10, 10),)
    assert effective_answer(nothing) is None
    assert [effective_answer(value) for value in (0, "x", ("x",), None)] == [0, "x", ("x",), None]


def test_the_same_item_of_two_questionnaires_is_told_apart_by_the_page() -> None:
    events = [entered(0), shown(0, "a"), said(10, "a", 1), shown(20, "a", of="two"), said(30, "a", 5)]
    one, _, two = responses(events, [ONE, TWO])
    assert (one.value, two.value) == (1, 5)


def test_other_questionnaires_do_not_matter() -> None:
    events = [entered(0), shown(0, "a", of="old"), said(10, "a", 1)]
    assert responses(events, [ONE]) == (ItemResponse("one", "a"), ItemResponse("one", "b"))


# Resumed


def resumed(at_ms: int) -> list[Event]:
    """Begin the stage anew after a cut."""
    return [happened.SessionResumed(at_ms=at_ms, embodiment=EmbodimentName.AVATAR), entered(at_ms)]


def test_a_stage_that_was_resumed_begins_anew_and_its_earlier_answers_do_not_count() -> None:
    before = [entered(0), shown(0, "a"), said(10, "a", 1), said(15, "a", 2), shown(20, "b"), said(30, "b", 2)]
    after = [*resumed(30), shown(30, "a"), said(70, "a", 3)]
    assert responses([*before, *after], [ONE]) == (
        ItemResponse("one", "a", 3, first_ms=40, last_ms=40, changes=0),
        ItemResponse("one", "b"),
    )


def test_what_was_answered_in_another_stage_still_counts_after_a_resumption() -> None:
    about_you = [entered(0, Stage.ABOUT_YOU), shown(0, "a", of="two"), said(5, "a", 4)]
    questions = [entered(9), shown(9, "a"), said(10, "a", 1), *resumed(10), shown(10, "a")]
    assert [answered.value for answered in responses([*about_you, *questions], [TWO, ONE])] == [4, None, None]


# Paused


@pytest.mark.parametrize(
    ("pause", "after"),
    [
        ([(20, 60)], 50),  # between page and answer
        ([(0, 60)], 30),  # from the moment that the page came
        ([(10, 20), (40, 80)], 40),
        ([], 90),
    ],
)
def test_the_time_of_a_pause_is_left_out(pause: list[tuple[int, int]], after: int) -> None:
    stops: list[Event] = []
    for since, until in pause:
        stops += [happened.PauseRequested(at_ms=since), happened.PauseEnded(at_ms=until)]
    assert responses([entered(0), shown(0, "a"), *stops, said(90, "a", 1)], [ONE])[0].first_ms == after


def test_a_pause_that_began_before_the_page_is_left_out_from_the_page_on() -> None:
    pause = happened.PauseRequested(at_ms=0)
    events = [pause, entered(50), shown(50, "a"), happened.PauseEnded(at_ms=80), said(100, "a", 1)]
    assert responses(events, [ONE])[0].first_ms == 20


def test_a_pause_that_was_cut_off_is_over_with_the_resumption() -> None:
    ended = happened.SessionEnded(at_ms=20, status=Status.INTERRUPTED)
    before = [entered(0), shown(0, "a"), happened.PauseRequested(at_ms=10), ended]
    events = [*before, *resumed(20), shown(20, "a"), said(70, "a", 1)]
    assert responses(events, [ONE])[0].first_ms == 50


# Any


@given(
    st.lists(st.tuples(st.sampled_from(["a", "b"]), st.none() | st.integers(1, 5), st.integers(0, 1000)), max_size=12)
)
def test_whatever_is_answered_the_last_word_counts(given_ones: list[tuple[str, int | None, int]]) -> None:
    at, events = 0, [entered(0), shown(0, "a", "b")]
    times: dict[str, list[int]] = {"a": [], "b": []}
    values: dict[str, list[int | None]] = {"a": [], "b": []}
    for item, value, wait in given_ones:
        at += wait
        events.append(said(at, item, value))
        times[item].append(at)
        values[item].append(value)
    for answered in responses(events, [ONE]):
        mine, when = values[answered.item], times[answered.item]
        assert answered.value == (mine[-1] if mine else None)
        assert (answered.first_ms, answered.last_ms) == ((when[0], when[-1]) if when else (None, None))
        assert answered.changes == sum(one != other for one, other in pairwise(mine))


@pytest.mark.parametrize("order", ItemOrder)
@pytest.mark.parametrize("per_page", [1, 2, 8])
def test_a_session_s_own_answers_come_back_in_the_declared_order(order: ItemOrder, per_page: int) -> None:
    shuffled = CLOSING.model_copy(update={"order": order, "per_page": per_page})
    driver = driven_to(Stage.OVER)
    assert [answered.value for answered in responses(driver.events, [ABOUT_YOU, CLOSING])] == [
        *(18, "none", ("en",), "a word"),
        *(1, 1, 1),
    ]
    driver = driven_to(Stage.QUESTIONS, replace(whole(), questionnaires=(shuffled,)))
    points = {"enjoyed": 1, "helped": 2, "understood": 3}
    while driver.stage is Stage.QUESTIONS:
        assert driver.view.page is not None
        for item in driver.view.page.items:
            driver.answer(points[item.id], item.id)
        driver.go_on()
    assert [(answered.item, answered.value) for answered in responses(driver.events, [shuffled])] == list(
        points.items()
    )
    assert [answered.first_ms for answered in responses(driver.events, [shuffled])] == [0, 0, 0]
