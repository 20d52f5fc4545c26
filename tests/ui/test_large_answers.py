"""One choice on its page, or two plain questions: answers are large, even, and leave no hole."""

from __future__ import annotations

from itertools import pairwise

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtQuick import QQuickItem
from pytestqt.qtbot import QtBot

from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS
from kiosk.experiment.events import TextSize
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.ui.simulated_visitor import lay_out
from tests.samples import CATALOGUES, ENGLISH
from tests.ui.conftest import Booth
from tests.ui.looking import appearance, items, painted, place, texts

GERMAN = ASSETS / "templates" / "two-languages"
WORDS = CATALOGUES | {"de": Catalogue(GERMAN / "de"), "ar": ENGLISH}
WIDE, UPRIGHT = (1920, 1080), (1080, 1920)
SIZES = [WIDE, UPRIGHT, (1280, 800), (1366, 768)]
ANSWERS = (
    *("yes", "now and then", "never", "often", "at work", "at home"),
    *("with friends", "in a shop", "somewhere else", "I prefer not to say", "sometimes", "daily"),
)
AGE, GENDER, ROBOTS = Questionnaire.read(ASSETS / "questionnaires" / "about-you.toml").items


@pytest.fixture
def booth(resting_booth: Booth) -> Booth:
    """Return the booth that all tests of this module share."""
    return resting_booth


def ask(
    booth: Booth,
    qtbot: QtBot,
    size: tuple[int, int],
    *asked: Item,
    language: str = "en",
    letters: TextSize | None = None,
) -> list[list[QQuickItem]]:
    """Show these questions in a window of this size; returns the options of each that has some."""
    window, screens = booth.app.window, booth.app.screens
    # A page that stands there would be laid out in both sizes, and once for each of the steps that follow.
    screens.kiosk.show("")
    window.resize(*size)
    qtbot.waitUntil(lambda: window.contentItem().width() == size[0])
    screens.set_language(WORDS[language])
    screens.kiosk.begin((language,), language, booth.app.assigner.study.settings.consent)
    screens.kiosk.set_text_size(letters or TextSize.NORMAL)
    screens.form.show(asked, 1, 1)
    screens.kiosk.show("form")
    booth.settle()
    lay_out(window)
    choices = [item for item in asked if item.kind == "single"]
    return [[booth.item(f"option-{item.id}-{option.id}") for option in item.options] for item in choices]


def choice(*answers: str) -> Item:
    """Return the question about robots with these answers."""
    options = [{"id": f"option{number}", "text": {"en": answer}} for number, answer in enumerate(answers)]
    return type(ROBOTS).model_validate(ROBOTS.model_dump() | {"options": options})


def edges(item: QQuickItem) -> QRectF:
    """Where an item is in the window."""
    return item.mapRectToScene(QRectF(0, 0, item.width(), item.height()))


def rows(options: list[QQuickItem]) -> list[list[QRectF]]:
    """Return where options are, row by row."""
    tops = sorted({round(edges(option).top()) for option in options})
    return [[edges(option) for option in options if round(edges(option).top()) == top] for top in tops]


def are_even(options: list[QQuickItem]) -> bool:
    """Whether options are as large as each other and stand in a grid."""
    sizes = {(round(option.width()), round(option.height())) for option in options}
    lefts = {round(edge.left()) for edge in (edges(option) for option in options)}
    return len(sizes) == 1 and len(lefts) == max(map(len, rows(options)))


@pytest.mark.parametrize("language", ["en", "es", "it", "de", "ar"])
@pytest.mark.parametrize("size", [WIDE, UPRIGHT], ids=["wide", "upright"])
def test_the_shipped_questions_about_the_visitor_have_large_answers_without_a_hole(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], language: str
) -> None:
    for asked in ((AGE, GENDER), (ROBOTS,)):
        (options,) = ask(booth, qtbot, size, *asked, language=language)
        assert are_even(options)
        assert len({len(row) for row in rows(options)}) == 1
        assert min(option.height() for option in options) >= (96 if size == WIDE else 112)
        assert min(text.property("font").pixelSize() for option in options for text in texts(option)) >= 38
        # Where each has a row, they are nearly as large as the question, and never larger.
        question = next(text for text in texts(booth.item(f"item-{asked[-1].id}")) if text.property("font").bold())
        said, letters = (text.property("font").pixelSize() for text in (question, next(texts(options[0]))))
        assert letters <= said
        assert len(rows(options)) < len(options) or letters >= (44 if language == "de" else 46)
        assert max(text.property("lineCount") for option in options for text in texts(option)) == 1
        # They take the page, and leave the way on some air.
        free = edges(booth.item("continue")).top() - max(edges(option).bottom() for option in options)
        assert 24 <= free <= 140
        assert not booth.sees("more")


@pytest.mark.parametrize("letters", [TextSize.NORMAL, TextSize.LARGEST])
@pytest.mark.parametrize("size", SIZES)
def test_a_choice_of_few_or_many_answers_fits_its_page_in_even_rows(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], letters: TextSize
) -> None:
    for count in range(2, len(ANSWERS) + 1):
        (options,) = ask(booth, qtbot, size, choice(*ANSWERS[:count]), letters=letters)
        assert are_even(options), count
        if letters == TextSize.NORMAL:
            assert not booth.sees("more"), count
            # A page of few answers has them below each other.
            assert count > 6 or all(len(row) == 1 for row in rows(options))
        # They take the width of the page.
        width = max(edges(option).right() for option in options) - min(edges(option).left() for option in options)
        assert width >= edges(booth.item("item-robots")).width() - 4, count
        for above, below in pairwise(rows(options)):
            assert below[0].top() - above[0].bottom() >= 8


@pytest.mark.parametrize("size", [WIDE, UPRIGHT], ids=["wide", "upright"])
def test_a_word_that_has_no_room_beside_others_has_a_row(booth: Booth, qtbot: QtBot, size: tuple[int, int]) -> None:
    long = "Donaudampfschifffahrtselektrizitätenhauptbetriebswerk"
    for asked in ((choice(*ANSWERS[:6], long),), (AGE, choice("yes", "no", long))):
        (options,) = ask(booth, qtbot, size, *asked)
        assert are_even(options)
        for option in options:
            (words,) = texts(option)
            assert words.property("contentWidth") <= words.width() + 1
            assert edges(words).right() <= edges(option).right()


def test_what_is_missing_is_said_without_scrolling(booth: Booth, qtbot: QtBot) -> None:
    for size in SIZES:
        for asked in ((AGE, GENDER), (ROBOTS,)):
            (options,) = ask(booth, qtbot, size, *asked)
            before = options[0].height()
            booth.app.screens.form.show_missing(tuple(item.id for item in asked))
            lay_out(booth.app.window)
            assert not booth.sees("more")
            assert 0.6 * before <= options[0].height() <= before


@pytest.mark.parametrize("language", ["en", "ar"])
@pytest.mark.parametrize("size", [WIDE, UPRIGHT], ids=["wide", "upright"])
def test_a_field_for_a_number_looks_like_a_field_and_not_like_an_answer(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], language: str
) -> None:
    (options,) = ask(booth, qtbot, size, AGE, GENDER, language=language)
    field = booth.item("number-age")
    picture = booth.app.window.grabWindow()
    *_, ground, _ = appearance(options[0], picture)
    middle = place(field).center()
    inside = picture.pixelColor(middle.x(), place(field).top() + 12)
    assert inside != ground
    (hint,) = [text for text in texts(field) if text.property("text")]
    (keys,) = (item for item in items(field) if item.objectName() == "keys-sign")
    # The words are at the edge where reading begins, and the sign of the keys is at the other.
    box, words, sign = edges(field), edges(hint), edges(keys)
    before, after = words.left() - box.left(), box.right() - sign.right()
    if language == "ar":
        before, after = box.right() - words.right(), sign.left() - box.left()
    assert before == 36
    # The letters begin there, too.
    drawn = [
        x
        for x in range(round(words.left()), round(words.right()))
        if any(picture.pixelColor(x, y) != inside for y in range(middle.y() - 20, middle.y() + 20))
    ]
    assert (drawn[0] - words.left() if language == "en" else words.right() - drawn[-1]) <= 8
    assert after == pytest.approx(box.bottom() - sign.bottom(), abs=1)
    assert not sign.intersects(words)
    booth.app.screens.form.draft("age", "30")
    field.setProperty("text", "30")
    lay_out(booth.app.window)
    assert not keys.isVisible()
    field.setProperty("text", "")


@pytest.mark.parametrize("language", ["en", "es", "ar"])
def test_on_an_upright_page_a_number_has_a_field_beside_its_question_and_answers_have_rows(
    booth: Booth, qtbot: QtBot, language: str
) -> None:
    (options,) = ask(booth, qtbot, UPRIGHT, AGE, GENDER, language=language)
    field, bar = edges(booth.item("number-age")), edges(options[0])
    assert [len(row) for row in rows(options)] == [1] * len(options)
    # It takes half of the page's width, at the end, and is as high as an answer.
    ends = (field.left(), bar.left()) if language == "ar" else (field.right(), bar.right())
    assert ends[0] == pytest.approx(ends[1], abs=3)
    assert 0.44 * bar.width() <= field.width() <= 0.5 * bar.width()
    assert field.height() == pytest.approx(bar.height(), abs=1)
    question = next(text for text in texts(booth.item("item-age")) if text.property("font").bold())
    assert not painted(question).intersects(field.toAlignedRect())
    assert field.top() <= painted(question).center().y() <= field.bottom()
    # Answers and the field have edges: questions have no card with one more.
    assert [booth.item(f"card-{name}").property("color").alpha() for name in ("age", "gender")] == [0, 0]
    assert [booth.item(f"due-{name}").opacity() for name in ("age", "gender")] == [0, 0]
    # Once it has a number, plus and minus stand beside it, in the same width.
    booth.item("number-age").setProperty("text", "30")
    lay_out(booth.app.window)
    less, typed = edges(booth.item("less-age")), edges(booth.item("number-age"))
    assert not less.intersects(typed)
    spread = typed.united(less)
    assert (spread.left(), spread.right()) == pytest.approx((field.left(), field.right()), abs=1)
    # Its digits are larger than the words of answers, which are large themselves.
    letters, words = (item.property("font").pixelSize() for item in (booth.item("number-age"), next(texts(options[0]))))
    assert letters >= 1.3 * words
    assert words >= 46
    booth.item("number-age").setProperty("text", "")


def test_more_short_answers_of_an_upright_page_are_tiles_in_two_columns_below_a_field_as_wide(
    booth: Booth, qtbot: QtBot
) -> None:
    (options,) = ask(booth, qtbot, UPRIGHT, AGE, choice(*ANSWERS[:8]))
    assert [len(row) for row in rows(options)] == [2] * 4
    assert are_even(options)
    field, tile = edges(booth.item("number-age")), edges(options[1])
    assert (field.left(), field.right()) == pytest.approx((tile.left(), tile.right()), abs=4)
    assert field.height() == pytest.approx(tile.height(), abs=1)
    assert not booth.sees("more")
