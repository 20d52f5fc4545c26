"""Questionnaires: page by page, nothing chosen beforehand, no answer needed but what is required."""

from __future__ import annotations

from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Mood
from kiosk.study.events import Status
from tests.samples import likert, plan
from tests.study.driver import Driver, with_memory


def test_the_questions_come_one_by_one() -> None:
    driver = Driver(plan(), 2)
    driver.to_the_game()
    driver.play(with_memory(2))
    driver.go_on()
    assert driver.view.mood is Mood.LISTENING
    for number, item in enumerate(("enjoyed", "helped", "understood"), 1):
        assert driver.view.page == do.ShowItems((likert(item),), number=number, of=3)
        assert driver.noted(happened.ItemsShown)[-1] == happened.ItemsShown(
            at_ms=driver.now, questionnaire="closing", items=(item,)
        )
        assert driver.view.answers == {}
        assert driver.answer(5)[-1] == do.ShowAnswer(item, 5)
        driver.answer(number)
        assert driver.view.answers == {item: number}
        driver.go_on()
    assert driver.view.ended is Status.COMPLETED
    answers = [(event.item, event.value) for event in driver.world if isinstance(event, happened.AnswerGiven)]
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
