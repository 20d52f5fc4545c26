"""Conditions of items: what they say, and what is refused."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.config import Game
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.items import NOT_APPLICABLE, Integer, Multiple, Response, ShortText, Single, TextPage
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.projections import item_responses, scale_scores
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.experiment.relevance import hidden_items, holds, read_condition
from kiosk.experiment.session_state import SessionState
from kiosk.experiment.transitions import InvalidTransition
from kiosk.study.csv_import import Heading, as_toml, read_items
from tests.experiment.driver import Driver
from tests.samples import likert, options, plan, questionnaire

WORDS = {"en": "word"}
PLAYS = Single(id="plays", kind="single", text=WORDS, options=options("daily", "never"), not_applicable=True)
GAMES = Multiple(id="games", kind="multiple", text=WORDS, options=options("memory", "chess", "go"))
AGE = Integer(id="age", kind="integer", text=WORDS, lowest=0, highest=120)
NAME = ShortText(id="name", kind="text", text=WORDS)
EARLIER: tuple[Item, ...] = (PLAYS, GAMES, AGE, NAME)


def shown_if(condition: str, name: str = "last", **more: object) -> Item:
    """Return a rating that is shown on a condition."""
    return likert(name).model_copy(update={"relevant": condition, **more})


@pytest.mark.parametrize(
    ("condition", "given", "shown"),
    [
        ("plays = 'daily'", {"plays": "daily"}, True),
        ("plays = 'daily'", {}, False),
        ("plays != 'daily'", {}, True),
        ('plays != "daily"', {"plays": "daily"}, False),
        ("age >= 18 and age < 65", {"age": 18}, True),
        ("age >= 18 and age < 65", {"age": 65}, False),
        ("age < 18", {}, False),
        ("not age >= 18", {}, True),
        ("selected(games, 'go')", {"games": ("chess", "go")}, True),
        ("not selected(games, 'go')", {"games": ("chess",)}, True),
        ("selected(plays, 'daily')", {"plays": "daily"}, True),
        ("answered(name)", {"name": ""}, False),
        ("answered(name)", {"name": "x"}, True),
        ("answered(plays)", {"plays": NOT_APPLICABLE}, False),
        ("plays = 'never' or plays = 'daily' and age = 3", {"plays": "never"}, True),
        ("(plays = 'never' or plays = 'daily') and age = 3", {"plays": "never"}, False),
    ],
)
def test_a_condition_holds_for_answers(condition: str, given: Mapping[str, Response], shown: bool) -> None:  # noqa: FBT001
    assert holds(read_condition(condition), given) is shown
    assert hidden_items((*EARLIER, shown_if(condition)), given) == (() if shown else ("last",))


def test_what_depends_on_a_hidden_item_is_hidden_too() -> None:
    items = (PLAYS, shown_if("plays = 'daily'", "often"), shown_if("often > 2", "why"))
    assert hidden_items(items, {"plays": "daily", "often": 4}) == ()
    assert hidden_items(items, {"plays": "never", "often": 4}) == ("often", "why")


@pytest.mark.parametrize(
    ("condition", "fault"),
    [
        ("plays = daily", "a number or a word in quotes must stand where 'daily' stands"),
        ("plays = ", "must stand where 'it ends' stands"),
        ("plays = 'daily' age = 3", "after the condition stands 'age'"),
        ("(age = 3", "it lacks ')'"),
        ("age = 3.5", "is not understood"),
        ("and age = 3", "where 'and' stands"),
        ("(" * 60 + "age = 3" + ")" * 60, "too deep"),
        ("pays = 'daily'", "there is no item 'pays'"),
        ("later = 3", "the item 'later' does not come before this one"),
        ("last = 3", "the item 'last' does not come before this one"),
        ("intro = 3", "is a page to read"),
        ("plays = 'weekly'", "has no option 'weekly', but daily, never"),
        ("selected(games, 'ludo')", "has no option 'ludo'"),
        ("selected(age, '3')", "has no options"),
        ("games = 'go'", "write selected(games, 'go')"),
        ("age = 'old'", "is a number, not 'old'"),
        ("plays > 'daily'", "compared by = or != only"),
        ("age > 120", "would never be shown"),
        ("age > 20 and age < 10", "would never be shown"),
        ("plays = 'daily' and plays = 'never'", "would never be shown"),
        ("not answered(must)", "would never be shown"),
        ("child = 3 and age > 18", "would never be shown"),
    ],
)
def test_a_condition_that_cannot_be_is_refused_in_one_sentence(tmp_path: Path, condition: str, fault: str) -> None:
    page = TextPage(id="intro", kind="page", text=WORDS)
    child = likert("child").model_copy(update={"relevant": "age < 18"})
    must = likert("must").model_copy(update={"required": True})
    file = tmp_path / "asked.toml"
    good = questionnaire("asked", page, *EARLIER, must, child, likert("last"), likert("later"))
    text = as_toml(good).replace('id = "last"', f'id = "last"\nrelevant = """{condition}"""')
    file.write_text(text, "utf-8")
    with pytest.raises(UserInputError) as error:
        Questionnaire.read(file)
    (sentence,) = error.value.sentences
    line = text.splitlines().index(f'relevant = """{condition}"""') + 1
    assert fault in sentence
    assert str(file) in sentence
    assert "(last)" in sentence
    assert sentence.endswith(f"(line {line})")


def test_a_shuffled_questionnaire_has_no_conditions() -> None:
    with pytest.raises(ValueError, match="the items are shuffled"):
        Questionnaire.model_validate(
            questionnaire("asked", PLAYS, likert("last")).model_dump()
            | {"order": "shuffled", "items": [PLAYS, shown_if("plays = 'daily'")]}
        )


def test_the_hash_of_a_questionnaire_without_conditions_does_not_change_by_there_being_any() -> None:
    plain = questionnaire("asked", PLAYS, likert("last"))
    assert "relevant" not in plain.model_dump_json()
    assert plain.sha256 != questionnaire("asked", PLAYS, shown_if("plays = 'daily'")).sha256


def test_a_table_has_a_column_for_conditions(tmp_path: Path) -> None:
    file = tmp_path / "items.csv"
    head = "id;kind;relevant;text_en;options_en;lowest_en;highest_en\nplays;single;;Plays?;yes=yes;no=no\n"
    head = 'id;kind;relevant;text_en;options_en\nplays;single;;Plays?;"yes=yes;no=no"\n'
    file.write_text(head + "which;text;plays = 'yes';Which?;\n", "utf-8")
    read = read_items(file, Heading("asked", "1", "ours"))
    assert [item.relevant for item in read.items] == ["", "plays = 'yes'"]
    file.write_text(head + "which;text;plays = 'ja';Which?;\n", "utf-8")
    with pytest.raises(UserInputError, match=r"row 3, column relevant: the item 'plays' has no option 'ja'"):
        read_items(file, Heading("asked", "1", "ours"))


# In a session


def asking(*items: Item, per_page: int = 1) -> tuple[Driver, Questionnaire]:
    """Begin a session that asks these items first."""
    asked = questionnaire("asked", *items, per_page=per_page)
    driver = Driver(replace(plan(stages=("questions", "game"), game=Game(rows=2, columns=2)), questionnaires=(asked,)))
    driver.start()
    return driver, asked


def test_an_item_of_the_same_page_is_shown_and_hidden_at_once_and_loses_its_answer() -> None:
    driver, asked = asking(PLAYS, shown_if("plays = 'daily'", "often", required=True, scale="S"), per_page=2)
    with pytest.raises(InvalidTransition):
        driver.answer(3, "often")
    assert driver.answer("daily", "plays").effects[-1] == do.HideItems(())
    driver.go_on()
    assert driver.view.missing == ("often",)
    driver.answer(3, "often")
    assert driver.answer("never", "plays").effects[-1] == do.HideItems(("often",))
    changes = [(event.hidden, event.withdrawn) for event in driver.noted(happened.HiddenItemsChanged)]
    assert changes == [(("often",), ()), ((), ()), (("often",), ("often",))]
    driver.go_on()
    assert driver.stage is Stage.GAME
    responses = item_responses(SessionState.from_events(driver.events), [asked])
    assert [(each.item, each.value, each.hidden) for each in responses] == [
        ("plays", "never", False),
        ("often", None, True),
    ]
    (score,) = scale_scores(responses, [asked])
    assert (score.items, score.answered, score.hidden, score.mean) == (1, 0, 1, None)


def test_a_page_of_hidden_items_is_passed_in_both_directions() -> None:
    driver, asked = asking(PLAYS, shown_if("plays = 'daily'", "often"), likert("end"))
    driver.answer("never", "plays")
    driver.go_on()
    assert [event.items for event in driver.noted(happened.QuestionnairePageShown)] == [("plays",), ("end",)]
    driver.send(happened.BackPressed(at_ms=driver.now))
    assert driver.noted(happened.QuestionnairePageShown)[-1].items == ("plays",)
    driver.answer("daily", "plays")
    driver.go_on()
    assert driver.noted(happened.QuestionnairePageShown)[-1].items == ("often",)
    assert not any(each.hidden for each in item_responses(SessionState.from_events(driver.events), [asked]))


def test_pages_at_the_end_that_are_hidden_end_the_questionnaire() -> None:
    driver, asked = asking(PLAYS, shown_if("plays = 'daily'", "often"))
    driver.go_on()
    assert driver.stage is Stage.GAME
    responses = item_responses(SessionState.from_events(driver.events), [asked])
    assert [each.hidden for each in responses] == [False, True]


def test_an_item_of_a_page_that_never_came_is_not_said_to_be_hidden() -> None:
    driver, asked = asking(PLAYS, likert("between"), shown_if("plays = 'daily'", "often"))
    driver.go_on()
    assert driver.noted(happened.QuestionnairePageShown)[-1].items == ("between",)
    assert not any(each.hidden for each in item_responses(SessionState.from_events(driver.events), [asked]))
