"""Questionnaires: page by page, nothing chosen beforehand, no answer needed but what is required."""

from __future__ import annotations

from dataclasses import replace
from itertools import groupby
from math import ceil
from unicodedata import category

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.config import Game
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import Mood
from kiosk.experiment.items import (
    NOT_APPLICABLE,
    Answer,
    Differential,
    Integer,
    Multiple,
    Pictures,
    ShortText,
    Single,
    Slider,
    TextPage,
)
from kiosk.experiment.outcomes import Stage, Status
from kiosk.experiment.projections import item_responses
from kiosk.experiment.questionnaire import KINDS, Item, ItemOrder
from kiosk.experiment.session_state import SessionState
from kiosk.experiment.transitions import InvalidTransition
from tests.experiment.driver import Driver, driven_to, some_answer, with_memory
from tests.samples import ABOUT_YOU, likert, options, plan, questionnaire


def test_the_questions_come_one_by_one() -> None:
    driver = Driver(plan(), 2)
    driver.to_the_game()
    driver.play(with_memory(2))
    driver.go_on()
    assert driver.view.mood is Mood.LISTENING
    for number, item in enumerate(("enjoyed", "helped", "understood"), 1):
        assert driver.view.page == do.ShowItems((likert(item),), number=number, of=3, rates=True)
        assert driver.noted(happened.QuestionnairePageShown)[-1] == happened.QuestionnairePageShown(
            at_ms=driver.now, questionnaire="closing", items=(item,)
        )
        assert driver.view.answers == {}
        assert driver.answer(5).effects[-1] == do.ShowAnswer(item, 5)
        driver.answer(number)
        assert driver.view.answers == {item: number}
        driver.go_on()
    assert driver.view.ended is Status.COMPLETED
    answers = [(event.item, event.value) for event in driver.world if isinstance(event, happened.ResponseGiven)]
    assert answers == [
        ("enjoyed", 5),
        ("enjoyed", 1),
        ("helped", 5),
        ("helped", 2),
        ("understood", 5),
        ("understood", 3),
    ]


def test_a_question_may_be_passed_over() -> None:
    driver = Driver(plan(), 2)
    driver.to_the_game()
    driver.play(with_memory(2))
    for _ in range(4):
        assert driver.view.ended is None
        driver.go_on()
    assert driver.view.ended is Status.COMPLETED


def test_that_an_item_does_not_apply_is_a_response_where_the_item_allows_it() -> None:
    asked = questionnaire("asked", likert("a", required=True, not_applicable=True), likert("b"), per_page=2)
    driver = Driver(replace(plan(stages=("questions", "game"), game=Game(rows=2, columns=2)), questionnaires=(asked,)))
    driver.start()
    with pytest.raises(InvalidTransition):
        driver.answer(NOT_APPLICABLE, "b")
    driver.answer(4, "b")
    driver.go_on()
    assert driver.view.missing == ("a",)
    assert driver.answer(NOT_APPLICABLE, "a").effects[-1] == do.ShowAnswer("a", NOT_APPLICABLE)
    driver.go_on()
    assert driver.stage is Stage.GAME
    first, second = item_responses(SessionState.from_events(driver.events), [asked])
    assert (first.value, first.does_not_apply, first.changes) == (None, True, 0)
    assert (second.value, second.does_not_apply) == (4, False)


def test_an_item_that_is_asked_for_once_is_pointed_out_and_may_then_be_left() -> None:
    asked = questionnaire(
        "asked",
        *(likert(name).model_copy(update={"required": how}) for name, how in (("a", "once"), ("b", False))),
        per_page=2,
    )
    driver = Driver(replace(plan(stages=("questions", "game"), game=Game(rows=2, columns=2)), questionnaires=(asked,)))
    driver.start()
    driver.go_on()
    assert driver.view.missing == ("a",)
    assert driver.noted(happened.SkippedItemsShown)[-1].items == ("a",)
    driver.go_on()
    assert driver.stage is Stage.GAME
    assert len(driver.noted(happened.SkippedItemsShown)) == 1


def test_what_has_to_be_answered_is_pointed_out_each_time() -> None:
    asked = questionnaire("asked", likert("a").model_copy(update={"required": True}))
    driver = Driver(replace(plan(stages=("questions", "game"), game=Game(rows=2, columns=2)), questionnaires=(asked,)))
    driver.start()
    for count in (1, 2):
        driver.go_on()
        assert driver.view.missing == ("a",)
        assert len(driver.noted(happened.SkippedItemsShown)) == count
    assert driver.stage is Stage.QUESTIONS


# Kinds of items


WORDS = {"en": "word"}
GALLERY: tuple[Item, ...] = (
    likert("likert", points=7),
    Differential(id="differential", kind="differential", text=WORDS, points=3, left=WORDS, right=WORDS),
    Pictures(id="pictures", kind="pictures", text=WORDS, lowest=WORDS, highest=WORDS),
    Slider(id="slider", kind="slider", text=WORDS, lowest=-5, highest=20, left=WORDS, right=WORDS),
    Single(id="single", kind="single", text=WORDS, options=options("a", "b", "c")),
    Multiple(id="multiple", kind="multiple", text=WORDS, options=options("a", "b", "c")),
    Integer(id="integer", kind="integer", text=WORDS, lowest=18, highest=120),
    ShortText(id="text", kind="text", text=WORDS, longest=6),
)
"""An item of every kind that is answered."""

ENDS = {"likert": (1, 7), "differential": (1, 3), "pictures": (1, 5), "slider": (-5, 20), "integer": (18, 120)}

PAGE = TextPage(id="page", kind="page", text=WORDS)

ANYTHING = st.one_of(
    st.integers(),
    st.integers(-6, 21),
    st.sampled_from(["a", "b", "c", "d", "", "tab\t", "line\n", "too long", "\u200b", "été"]),
    st.text(max_size=7),
    st.lists(st.sampled_from(["a", "b", "c", "d"]), max_size=4).map(tuple),
    st.booleans(),
)


def fits(item: Item, value: Answer) -> bool:
    """Return what an item's declaration says of a value, in other words than its own."""
    match item.kind:
        case "likert" | "differential" | "pictures" | "slider" | "integer":
            return type(value) is int and ENDS[item.kind][0] <= value <= ENDS[item.kind][1]
        case "single":
            return value in ("a", "b", "c")
        case "multiple":
            return type(value) is tuple and sorted(set(value) & {"a", "b", "c"}) == sorted(value)
        case "text":
            return type(value) is str and len(value) <= 6 and not any(category(each) in {"Cc", "Cs"} for each in value)
    return False


def asking(*items: Item, seed: int = 5, **more: object) -> Driver:
    """Return a session that has come to a questionnaire of these items."""
    asked = questionnaire("asked", *items, **more)
    small = plan(stages=("game", "questions"), game=Game(rows=1, columns=2))
    return driven_to(Stage.QUESTIONS, replace(small, questionnaires=(asked,)), seed)


def test_there_is_an_item_of_every_kind() -> None:
    assert {item.kind for item in (*GALLERY, PAGE)} == set(KINDS)


@pytest.mark.parametrize("item", GALLERY, ids=lambda item: str(item.kind))
@given(value=ANYTHING)
def test_an_item_takes_the_answers_that_it_can_have_and_no_others(item: Item, value: Answer) -> None:
    driver = asking(item)
    if fits(item, value):
        driver.answer(value, item.id)
        assert driver.view.answers == {item.id: value}
    else:
        with pytest.raises(InvalidTransition):
            driver.answer(value, item.id)
        assert driver.view.answers == {}


@given(value=st.none() | ANYTHING)
def test_a_text_page_takes_no_answer_and_is_gone_past(value: Answer | None) -> None:
    driver = asking(PAGE)
    with pytest.raises(InvalidTransition):
        driver.answer(value, "page")
    driver.go_on()
    assert driver.stage is Stage.OVER


@pytest.mark.parametrize("item", GALLERY, ids=lambda item: str(item.kind))
def test_an_answer_can_be_changed_and_taken_back(item: Item) -> None:
    driver = asking(item)
    driver.answer(some_answer(item), item.id)
    driver.answer(some_answer(item), item.id)
    assert driver.view.answers == {item.id: some_answer(item)}
    assert driver.answer(None, item.id).effects[-1] == do.ShowAnswer(item.id, None)
    assert driver.view.answers == {}
    driver.answer(None, item.id)
    driver.go_on()
    assert driver.stage is Stage.OVER


# What is required


@pytest.mark.parametrize("item", GALLERY, ids=lambda item: str(item.kind))
def test_a_required_item_holds_its_page_and_is_named(item: Item) -> None:
    driver = asking(item.model_copy(update={"required": True}), PAGE)
    for _ in range(2):
        assert driver.go_on().effects[-1] == do.ShowValidationErrors((item.id,))
    driver.answer(some_answer(item), item.id)
    driver.answer(None, item.id)
    assert driver.go_on().effects[-1] == do.ShowValidationErrors((item.id,))
    driver.answer(some_answer(item), item.id)
    driver.go_on()
    assert driver.view.page == do.ShowItems((PAGE,), 2, 2, rates=True)


@pytest.mark.parametrize(("name", "nothing"), [("text", ""), ("multiple", ())])
def test_an_answer_that_says_nothing_is_none(name: str, nothing: Answer) -> None:
    item = next(item for item in GALLERY if item.id == name)
    driver = asking(item.model_copy(update={"required": True}))
    driver.answer(nothing, name)
    assert driver.go_on().effects[-1] == do.ShowValidationErrors((name,))
    assert driver.stage is Stage.QUESTIONS


def test_only_what_is_missing_is_named_in_the_order_of_the_page() -> None:
    one, two, three, four = (likert(name, required=name != "three") for name in ("one", "two", "three", "four"))
    driver = asking(one, two, three, four, per_page=4)
    driver.answer(2, "two")
    assert driver.go_on().effects[-1] == do.ShowValidationErrors(("one", "four"))
    driver.answer(1, "one")
    assert driver.go_on().effects[-1] == do.ShowValidationErrors(("four",))
    driver.answer(4, "four")
    driver.go_on()
    assert driver.stage is Stage.OVER


def test_what_is_missing_on_one_page_is_not_asked_for_on_another() -> None:
    driver = asking(likert("one", required=True), likert("two"))
    driver.answer(3, "one")
    driver.go_on()
    driver.go_on()
    assert driver.stage is Stage.OVER


# Pages


@given(
    kinds=st.lists(st.booleans(), min_size=1, max_size=9),
    per_page=st.integers(1, 8),
    order=st.sampled_from(ItemOrder),
    seed=st.integers(0, 1000),
)
def test_items_are_shared_out_evenly_over_as_few_pages_as_hold_them_and_a_text_stands_alone(
    kinds: list[bool], per_page: int, order: ItemOrder, seed: int
) -> None:
    items = [
        PAGE.model_copy(update={"id": f"page{index}"}) if text else likert(f"item{index}")
        for index, text in enumerate(kinds)
    ]
    driver = asking(*items, seed=seed, per_page=per_page, order=order)
    shown: list[tuple[str, ...]] = []
    numbers = []
    while driver.stage is Stage.QUESTIONS:
        assert driver.view.page is not None
        shown.append(tuple(item.id for item in driver.view.page.items))
        numbers.append((driver.view.page.number, driver.view.page.of))
        driver.go_on()
    assert [event.items for event in driver.noted(happened.QuestionnairePageShown)] == shown
    assert {event.questionnaire for event in driver.noted(happened.QuestionnairePageShown)} == {"asked"}
    assert numbers == [(number, len(shown)) for number in range(1, len(shown) + 1)]
    flat = [name for page in shown for name in page]
    assert sorted(flat) == sorted(item.id for item in items)
    assert [name if name.startswith("page") else "" for name in flat] == [
        item.id if isinstance(item, TextPage) else "" for item in items
    ]
    if order is ItemOrder.FIXED:
        assert flat == [item.id for item in items]
    for alone, pages in groupby(shown, key=lambda page: page[0].startswith("page")):
        sizes = [len(page) for page in pages]
        if alone:
            assert set(sizes) == {1}
        else:
            assert sizes == sorted(sizes, reverse=True)
            assert sizes[0] - sizes[-1] <= 1
            assert len(sizes) == ceil(sum(sizes) / per_page)


def shuffled(seed: int) -> list[str]:
    """Return the order in which nine items come, with a text in their middle."""
    items: list[Item] = [*(likert(f"a{n}") for n in range(4)), PAGE, *(likert(f"b{n}") for n in range(4))]
    driver = asking(*items, seed=seed, order=ItemOrder.SHUFFLED)
    driver.to(Stage.OVER)
    return [name for event in driver.noted(happened.QuestionnairePageShown) for name in event.items]


def test_a_shuffled_order_is_the_seed_s() -> None:
    orders = [tuple(shuffled(seed)) for seed in range(8)]
    assert orders == [tuple(shuffled(seed)) for seed in range(8)]
    assert len(set(orders)) == 8
    assert {order[4] for order in orders} == {"page"}


@pytest.mark.parametrize("item", ["enjoyed", "two", "page", "One", ""])
def test_only_what_is_on_the_page_can_be_answered(item: str) -> None:
    driver = asking(likert("one"), likert("two"))
    with pytest.raises(InvalidTransition):
        driver.answer(3, item)
    driver.go_on()
    with pytest.raises(InvalidTransition):
        driver.answer(3, "one")


def test_items_of_one_page_are_answered_in_any_order() -> None:
    driver = asking(likert("one"), likert("two"), likert("three"), per_page=3)
    for name, value in (("three", 3), ("one", 1), ("two", 2), ("one", 5)):
        driver.answer(value, name)
    assert driver.view.answers == {"one": 5, "two": 2, "three": 3}


def test_questionnaires_come_one_after_another_and_share_no_page() -> None:
    first = questionnaire("first", likert("same"), likert("other"), per_page=8)
    second = questionnaire("second", likert("same"), per_page=8)
    small = plan(stages=("game", "questions"), game=Game(rows=1, columns=2))
    driver = driven_to(Stage.QUESTIONS, replace(small, questionnaires=(first, second)))
    driver.answer(4, "same")
    driver.go_on()
    assert driver.view.answers == {}
    assert driver.stage is Stage.QUESTIONS
    driver.answer(2, "same")
    driver.go_on()
    shown = [(event.questionnaire, event.items) for event in driver.noted(happened.QuestionnairePageShown)]
    assert shown == [("first", ("same", "other")), ("second", ("same",))]
    assert len(driver.noted(happened.QuestionnairesCompleted)) == 1


def test_pages_that_ask_on_one_scale_know_of_each_other() -> None:
    seven = [likert(name, points=7) for name in "efgh"]
    four, two = tuple(likert(name) for name in "abcd"), tuple(likert(name) for name in "xy")
    first = questionnaire("first", *four, *seven, per_page=4)
    second = questionnaire("second", *two, per_page=4)
    third = questionnaire("third", likert("alone"), per_page=4)
    small = plan(stages=("game", "questions"), game=Game(rows=1, columns=2))
    driver = driven_to(Stage.QUESTIONS, replace(small, questionnaires=(first, second, third)))
    alike = []
    while driver.stage is Stage.QUESTIONS:
        assert driver.view.page is not None
        alike.append(driver.view.page.alike)
        for item in driver.view.page.items:
            driver.answer(2, item.id)
        driver.go_on()
    # A rating alone on its page has a layout of its own.
    assert alike == [(four, two), (tuple(seven),), (four, two), ()]


def test_each_page_has_the_title_of_its_questionnaire() -> None:
    driver = asking(PAGE, likert("one"), likert("two"), title={"en": "How far?", "it": "Quanto?"})
    titles = []
    while driver.stage is Stage.QUESTIONS:
        assert driver.view.page is not None
        titles.append(driver.view.page.title)
        driver.go_on()
    assert titles == [{"en": "How far?", "it": "Quanto?"}] * 3


def test_the_questions_about_the_visitor_are_asked_in_the_same_way() -> None:
    driver = driven_to(Stage.ABOUT_YOU)
    assert driver.view.page == do.ShowItems(ABOUT_YOU.items[:2], 1, 2)
    assert driver.go_on().effects[-1] == do.ShowValidationErrors(("age",))
    driver.answer(31, "age")
    driver.go_on()
    assert driver.view.page == do.ShowItems(ABOUT_YOU.items[2:], 2, 2)
    driver.answer(("es", "en"), "languages")
    driver.go_on()
    assert driver.stage is Stage.INTRODUCTION
