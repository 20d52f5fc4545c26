"""A page of items: every kind is answered by mouse and by keyboard, nothing typed is lost, and what lacks is said."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import QDeadlineTimer, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QGuiApplication
from PySide6.QtQuick import QQuickItem
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.assistance.keyboards import key_rows
from kiosk.config import ASSETS
from kiosk.experiment.events import TextSize
from kiosk.experiment.items import NOT_APPLICABLE, Response
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.ui.screens.questionnaire import kept_together
from kiosk.ui.simulated_visitor import UiDriver, find_item, item_centre, lay_out
from tests.samples import CATALOGUES
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.looking import appearance, contrast, items, place, texts
from tests.ui.reaching import Finger

ITEMS: dict[str, Item] = {
    item.kind: item for item in Questionnaire.read(ASSETS / "questionnaires" / "gallery.toml").items
}
TAB, RIGHT, RETURN, SPACE = Qt.Key.Key_Tab, Qt.Key.Key_Right, Qt.Key.Key_Return, Qt.Key.Key_Space

Given = list[tuple[str, object]]


@pytest.fixture
def booth(resting_booth: Booth) -> Booth:
    """Return the booth of all these tests, which begin no session."""
    return resting_booth


@pytest.fixture
def given(booth: Booth) -> Iterator[Given]:
    """Return what the form reports, which is shown as the study would show it."""
    answers: Given = []

    def take(item: str, value: Response | None) -> None:
        answers.append((item, value))
        booth.app.screens.form.show_answer(item, value)

    form = booth.app.screens.form
    listening = form.answered.connect(take), form.continued.connect(lambda: answers.append(("", "continued")))
    yield answers
    form.answered.disconnect(listening[0])
    form.continued.disconnect(listening[1])


def exempt(booth: Booth) -> list[str]:
    """Return the items that are shown as not applying."""
    return list(booth.app.screens.form.property("exempt"))


def ask(booth: Booth, *items: Item) -> None:
    """Show a page of these items."""
    booth.app.screens.form.show(items, 1, 1)
    booth.app.screens.kiosk.show("form")
    booth.settle()


def required(kind: str) -> Item:
    """Return an item of this kind that has to be answered."""
    return ITEMS[kind].model_copy(update={"required": True})


def press(booth: Booth, *keys: Qt.Key) -> None:
    """Press these keys, one after another."""
    for key in keys:
        booth.press(key)


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("when I would be unsure", "when I~would be unsure"),
        ("lui e i suoi", "lui e~i~suoi"),
        ("the helper's hints", "the helper's hints"),
        ("you and I", "you and I"),
    ],
)
def test_a_word_of_one_letter_stays_with_the_next_word(text: str, kept: str) -> None:
    assert kept_together(text) == kept.replace("~", "\N{NO-BREAK SPACE}")


def shown(booth: Booth, name: str, text: str) -> bool:
    """Whether a text is to be seen within an item."""

    def within(item: QQuickItem) -> bool:
        said = str(item.property("text") or "").replace("\N{NO-BREAK SPACE}", " ")
        return item.isVisible() and (said == text or any(within(child) for child in item.childItems()))

    return within(booth.item(name))


@pytest.mark.parametrize(
    ("kind", "name", "value"),
    [
        ("likert", "answer-enjoyed-6", 6),
        ("differential", "answer-clear-1", 1),
        ("pictures", "answer-mood-4", 4),
        ("single", "option-plays-monthly", "monthly"),
        ("integer", "more-alone", 0),
        ("integer", "less-alone", 12),
    ],
)
def test_one_click_answers(booth: Booth, given: Given, kind: str, name: str, value: object) -> None:
    ask(booth, ITEMS[kind])
    booth.click(name)
    assert given == [(ITEMS[kind].id, value)]


@pytest.mark.parametrize("kind", [kind for kind in ITEMS if kind != "page"])
def test_that_an_item_does_not_apply_is_said_and_taken_back_with_a_button(
    booth: Booth, given: Given, kind: str
) -> None:
    item = ITEMS[kind].model_copy(update={"not_applicable": True})
    ask(booth, item, ITEMS["likert"].model_copy(update={"id": "other"}))
    assert not booth.sees("not-applicable-other")
    booth.click(f"not-applicable-{item.id}")
    assert exempt(booth) == [item.id]
    assert item.id not in booth.app.screens.form.property("answers")
    booth.app.screens.form.proceed()
    booth.click(f"not-applicable-{item.id}")
    assert exempt(booth) == []
    assert given == [(item.id, NOT_APPLICABLE), ("", "continued"), (item.id, None)]


def test_an_answer_takes_back_that_the_item_does_not_apply_and_the_other_way_round(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["integer"].model_copy(update={"not_applicable": True}))
    booth.click("more-alone")
    booth.click("not-applicable-alone")
    assert booth.item("number-alone").property("text") == ""
    booth.click("more-alone")
    booth.app.screens.form.proceed()
    assert given == [("alone", 0), ("alone", NOT_APPLICABLE), ("alone", 0), ("", "continued")]
    assert exempt(booth) == []


def test_hidden_items_take_no_room_no_digit_and_no_text(booth: Booth, given: Given) -> None:
    form, likert, text = booth.app.screens.form, ITEMS["likert"], ITEMS["text"]
    ask(booth, likert, text, likert.model_copy(update={"id": "third"}))
    booth.click(f"text-{text.id}")
    UiDriver(booth.app.window).type("abc")
    height = booth.item(f"item-{likert.id}").parentItem().height()
    form.hide((text.id, likert.id))
    booth.settle()
    assert [item.id for item in form.shown] == ["third"]
    assert not booth.sees(f"item-{text.id}")
    assert booth.item("item-third").parentItem().height() < height
    booth.app.window.contentItem().forceActiveFocus()
    press(booth, Qt.Key.Key_3)
    form.proceed()
    assert given[-2:] == [("third", 3), ("", "continued")]
    form.hide(())
    booth.settle()
    assert booth.item(f"text-{text.id}").property("text") == ""
    assert booth.sees(f"item-{likert.id}")


def test_items_that_come_by_what_was_typed_last_are_seen_before_the_page_goes(booth: Booth, given: Given) -> None:
    form, text, second = booth.app.screens.form, ITEMS["text"], ITEMS["likert"]
    form.show((text, second), 1, 1, (second.id,))
    booth.app.screens.kiosk.show("form")
    hiding = form.answered.connect(lambda item, _: form.hide(()) if item == text.id else None)
    booth.settle()
    booth.click(f"text-{text.id}")
    UiDriver(booth.app.window).type("abc")
    form.proceed()
    booth.settle()
    assert given == [(text.id, "abc")]
    assert booth.sees(f"item-{second.id}")
    form.proceed()
    assert given[-1] == ("", "continued")
    form.answered.disconnect(hiding)


def test_a_digit_answers_the_next_item_after_one_that_does_not_apply(booth: Booth, given: Given) -> None:
    likert = ITEMS["likert"].model_copy(update={"not_applicable": True})
    ask(booth, likert, likert.model_copy(update={"id": "second"}))
    booth.click("not-applicable-enjoyed")
    booth.app.window.contentItem().forceActiveFocus()
    press(booth, Qt.Key.Key_3)
    assert given[-1][1] == 3


def test_a_slider_asks_for_a_touch_and_has_no_handle_until_it_is_put_somewhere(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["slider"])
    (item,) = booth.app.screens.form.property("items")
    assert item["shown"] == f"{item['text']} Touch the line."
    assert not booth.sees("handle-effort")
    UiDriver(booth.app.window).click("slider-effort", across=0.8)
    assert booth.sees("handle-effort")
    ((item, value),) = given
    assert item == "effort"
    assert isinstance(value, int)
    assert 75 <= value <= 85


def test_a_slider_s_first_key_puts_it_in_the_middle_and_the_next_move_it(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["slider"])
    press(booth, TAB, RIGHT, RIGHT, Qt.Key.Key_Left, Qt.Key.Key_Left)
    assert [value for _, value in given] == [50, 51, 50, 49]


def test_several_options_are_added_and_taken_away_and_none_is_no_answer(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["multiple"])
    for option in ("names", "place", "names", "place"):
        booth.click(f"option-used-{option}")
    assert [value for _, value in given] == [("names",), ("place", "names"), ("place",), None]


def test_a_double_click_is_one_tick(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["multiple"])
    UiDriver(booth.app.window).double_click("option-used-place")
    assert given == [("used", ("place",))]


@pytest.mark.parametrize(
    ("kind", "value"),
    [("likert", 3), ("differential", 3), ("pictures", 3), ("single", "monthly"), ("multiple", ("story",))],
)
def test_arrows_move_and_a_key_chooses(booth: Booth, given: Given, kind: str, value: object) -> None:
    ask(booth, ITEMS[kind])
    press(booth, TAB, RIGHT, RIGHT, SPACE)
    assert given == [(ITEMS[kind].id, value)]


def test_the_keyboard_stops_once_at_each_scale_and_then_at_the_way_on(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["likert"], ITEMS["differential"], ITEMS["single"])
    press(booth, TAB, RETURN, TAB, RETURN, TAB, RETURN, TAB, RETURN)
    assert [item for item, _ in given] == ["enjoyed", "clear", "plays", ""]


def test_a_number_is_typed_with_the_keys_on_the_screen(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["integer"])
    for name in ("number-alone", "key-1", "key-3", "key-delete", "key-1", "key-done"):
        booth.click(name)
    assert given == [("alone", 11)]
    assert not booth.sees("key-1")


def test_a_number_that_cannot_be_is_not_sent_and_has_to_be_mended(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["integer"])
    booth.click("number-alone")
    UiDriver(booth.app.window).type("99")
    booth.click("continue")
    assert given == []
    assert booth.app.screens.form.property("missing") == ["alone"]
    assert booth.app.screens.form.property("wrong") == ["alone"]
    assert shown(booth, "item-alone", "Please type a whole number from 0 to 12.")
    booth.click("number-alone")
    UiDriver(booth.app.window).type("9")
    booth.click("continue")
    assert given == [("alone", 9), ("", "continued")]


def test_a_number_field_takes_no_more_digits_than_its_highest_number_has(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["integer"])
    booth.click("number-alone")
    UiDriver(booth.app.window).type("123456")
    assert booth.item("number-alone").property("text") == "12"
    booth.click("continue")
    assert given == [("alone", 12), ("", "continued")]


@pytest.mark.parametrize("text", ["9" * 5_000, "0" * 5_000, "013"])
def test_more_digits_than_that_are_no_answer_however_they_came(booth: Booth, given: Given, text: str) -> None:
    ask(booth, ITEMS["integer"])
    form = booth.app.screens.form
    form.draft("alone", text)
    form.finish("alone")
    form.proceed()
    assert given == []
    assert form.property("missing") == ["alone"]


def test_what_is_typed_is_sent_once_and_not_letter_by_letter(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["text"])
    booth.click("text-remark")
    UiDriver(booth.app.window).type("Perché no? ¡Qué bien!")
    assert given == []
    press(booth, RETURN)
    assert given == [("remark", "Perché no? ¡Qué bien!")]


def test_whoever_types_is_told_to_be_there_every_few_letters_and_not_what(booth: Booth, given: Given) -> None:
    told: list[int] = []
    counting = booth.app.screens.form.typed.connect(lambda: told.append(len(given)))
    ask(booth, ITEMS["text"])
    booth.click(f"text-{ITEMS['text'].id}")
    UiDriver(booth.app.window).type("twelve words")
    assert told == [0, 0]
    booth.app.screens.form.typed.disconnect(counting)


def test_what_is_typed_is_not_lost_when_the_visitor_goes_on_at_once(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["text"])
    booth.click("text-remark")
    UiDriver(booth.app.window).type("nice")
    booth.click("continue")
    assert given == [("remark", "nice"), ("", "continued")]


def test_a_text_is_typed_with_the_keys_on_the_screen_in_capitals_too(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["text"])
    booth.click("text-remark")
    for key in ("shift", "q", "u", "é", "space", "ñ", "o", "delete", "done"):
        booth.click(f"key-{key}")
    assert given == [("remark", "Qué ñ")]


def test_a_question_over_the_screen_does_not_take_a_half_typed_text_for_an_answer(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["text"])
    booth.click("text-remark")
    UiDriver(booth.app.window).type("half a")
    kiosk = booth.app.screens.kiosk
    kiosk.ask_still_there(asks=True)
    assert given == []
    kiosk.ask_still_there(asks=False)
    booth.settle()
    UiDriver(booth.app.window).type(" text")
    booth.click("continue")
    assert given == [("remark", "half a text"), ("", "continued")]


def test_a_text_that_was_refused_is_sent_again_with_the_way_on(booth: Booth) -> None:
    form, given = booth.app.screens.form, list[tuple[str, object]]()
    ask(booth, ITEMS["text"])
    listening = form.answered.connect(lambda item, value: given.append((item, value)))
    form.draft("remark", "once more")
    form.finish("remark")
    form.proceed()
    assert given == [("remark", "once more")] * 2
    form.answered.disconnect(listening)


@pytest.mark.usefixtures("given")
def test_the_way_on_says_whether_something_is_left_out(booth: Booth) -> None:
    ask(booth, ITEMS["differential"], required("likert"))
    assert booth.item("continue").property("words") == "Next"
    booth.app.screens.form.show_missing((ITEMS["differential"].id,))
    assert booth.item("continue").property("words") == "Go on without it"
    booth.app.screens.form.show_missing((ITEMS["differential"].id, ITEMS["likert"].id))
    assert booth.item("continue").property("words") == "Next"
    booth.app.screens.form.show((ITEMS["page"],), 1, 2)
    assert booth.item("continue").property("words") == "Next"


@pytest.mark.usefixtures("given")
def test_the_way_on_waits_until_what_is_asked_is_answered_or_typed(booth: Booth) -> None:
    asked = ITEMS["integer"].model_copy(update={"required": "once"})
    ask(booth, asked, ITEMS["likert"].model_copy(update={"required": False}), ITEMS["page"])
    assert booth.item("continue").property("waits")
    booth.app.screens.form.draft(asked.id, "7")
    assert not booth.item("continue").property("waits")
    booth.app.screens.form.draft(asked.id, "")
    assert booth.item("continue").property("waits")
    booth.app.screens.form.show_missing((asked.id,))
    assert not booth.item("continue").property("waits")


def test_the_edge_of_the_question_that_comes_next_is_marked(booth: Booth) -> None:
    form = booth.app.screens.form
    number, free = required("integer"), ITEMS["likert"].model_copy(update={"required": False})
    asked = (number, free, required("pictures"), required("differential"))

    def marked() -> list[str]:
        edges = [(item.id, find_item(booth.app.window.contentItem(), f"due-{item.id}")) for item in asked]
        return [name for name, edge in edges if edge is not None and edge.opacity() == 1]

    ask(booth, *asked)
    assert marked() == [number.id]
    # While the keys on the screen type into it, no other is: they point at this one.
    booth.click(f"number-{number.id}")
    form.draft(number.id, "7")
    assert booth.sees("key-1")
    assert marked() == [number.id]
    booth.click("key-done")
    form.show_answer(number.id, 7)
    # What may be left out is not waited for.
    assert marked() == [asked[2].id]
    form.show_answer(asked[3].id, 2)
    assert marked() == [asked[2].id]
    # What is missing has an edge of another colour.
    form.show_missing((asked[2].id,))
    assert marked() == []
    form.show_answer(asked[2].id, 1)
    assert marked() == []
    # One question alone needs no mark, unless it is a rating, which has a card.
    ask(booth, number)
    assert marked() == []
    ask(booth, asked[2])
    assert marked() == [asked[2].id]


def test_what_is_missing_is_said_in_words_and_brought_into_view(booth: Booth) -> None:
    many = [required("likert").model_copy(update={"id": f"item{number}"}) for number in range(8)]
    ask(booth, *many)
    booth.app.screens.form.show_missing(("item7",))
    assert shown(booth, "item-item7", "Please answer this one first.")
    assert not shown(booth, "item-item6", "Please answer this one first.")
    place = booth.item("answer-item7-1").mapToScene(booth.item("answer-item7-1").boundingRect().bottomLeft())
    assert place.y() < booth.item("continue").mapToScene(booth.item("continue").boundingRect().topLeft()).y()
    press(booth, RETURN)
    booth.app.screens.form.show_answer("item7", 1)
    assert not shown(booth, "item-item7", "Please answer this one first.")


def test_a_long_page_scrolls_by_key_and_by_its_sign(booth: Booth) -> None:
    ask(booth, *(ITEMS["likert"].model_copy(update={"id": f"item{number}"}) for number in range(8)))
    assert booth.item("more").isEnabled()
    first = booth.item("item-item0")
    before = first.mapToScene(first.boundingRect().topLeft()).y()
    press(booth, Qt.Key.Key_PageDown)
    booth.item("item-item0")
    assert first.mapToScene(first.boundingRect().topLeft()).y() < before
    press(booth, Qt.Key.Key_PageUp)
    booth.click("more")
    assert first.mapToScene(first.boundingRect().topLeft()).y() < before


def test_a_page_in_another_language_is_in_that_language(booth: Booth) -> None:
    booth.app.screens.set_language(CATALOGUES["it"])
    ask(booth, ITEMS["differential"])
    assert shown(booth, "item-clear", ITEMS["differential"].text["it"])
    assert find_item(booth.app.window.contentItem(), "continue") is not None
    assert booth.item("continue").property("words") == "Avanti"
    assert booth.item("page-title").property("text") == "Alcune domande"


def test_the_title_of_a_questionnaire_stands_above_its_pages_in_the_visitor_s_language(booth: Booth) -> None:
    form = booth.app.screens.form
    form.show((ITEMS["page"],), 1, 2, (), {"en": "How far do you agree?", "it": "Quanto sei d'accordo?"})
    booth.app.screens.kiosk.show("form")
    booth.settle()
    assert shown(booth, "page-title", "How far do you agree?")
    booth.app.screens.set_language(CATALOGUES["it"])
    assert shown(booth, "page-title", "Quanto sei d'accordo?")
    form.show((ITEMS["page"],), 2, 2)
    assert shown(booth, "page-title", "Alcune domande")


def test_plus_and_minus_run_while_they_are_held_and_answer_once_when_let_go(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["integer"])
    window, field = booth.app.window, booth.item("number-alone")
    place = item_centre(booth.item("more-alone"))
    QTest.mousePress(window, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, place)
    deadline = QDeadlineTimer(5_000)
    while field.property("text") in {"", "0", "1"} and not deadline.hasExpired():
        QGuiApplication.processEvents()
    assert given == []
    QTest.mouseRelease(window, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, place)
    assert given == [("alone", int(field.property("text")))]
    assert int(field.property("text")) >= 2


def test_a_number_that_is_clicked_is_selected_and_the_next_digit_takes_its_place(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["integer"])
    booth.app.screens.form.show_answer("alone", 12)
    booth.click("number-alone")
    booth.click("key-7")
    booth.click("key-done")
    assert given == [("alone", 7)]


def test_a_number_can_be_typed_before_its_field_has_the_keyboard(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["integer"], ITEMS["single"])
    press(booth, Qt.Key.Key_1, Qt.Key.Key_2)
    assert booth.item("number-alone").property("activeFocus")
    press(booth, RETURN)
    assert given == [("alone", 12)]
    # What stands there already is typed over only in its field.
    press(booth, Qt.Key.Key_Tab, Qt.Key.Key_7)
    assert booth.item("number-alone").property("text") == "12"


def test_a_digit_begins_no_number_before_another_question_is_answered(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["single"], ITEMS["integer"])
    press(booth, Qt.Key.Key_4)
    assert booth.item("number-alone").property("text") == ""
    assert given == []


def test_the_keys_on_the_screen_come_for_a_touch_and_not_for_a_mouse(booth: Booth) -> None:
    ask(booth, ITEMS["integer"])
    place = item_centre(booth.item("number-alone"))
    QTest.mouseClick(booth.app.window, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, place)
    assert not booth.sees("key-1")
    booth.click("number-alone")
    assert booth.sees("key-1")
    assert item_centre(booth.item("number-alone")) == place


def about_you(booth: Booth, qtbot: QtBot, width: int, height: int) -> list[list[QQuickItem]]:
    """Show the questions about the visitor in a window of this size; returns the options of both that have some."""
    window = booth.app.window
    window.resize(width, height)
    qtbot.waitUntil(lambda: window.contentItem().width() == width)
    ask(booth, *Questionnaire.read(ASSETS / "questionnaires" / "about-you.toml").items)
    named = {"gender": ("woman", "man", "another", "not_said"), "robots": ("none", "stories", "fairs", "owns", "works")}
    return [[booth.item(f"option-{item}-{name}") for name in names] for item, names in named.items()]


@pytest.mark.parametrize("language", ["en", "es", "it"])
@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1280, 800), (1366, 768), (1080, 1920)])
def test_the_options_of_all_questions_stand_in_the_same_two_columns(
    make_booth: MakeBooth, qtbot: QtBot, width: int, height: int, language: str
) -> None:
    booth = make_booth()
    booth.app.screens.set_language(CATALOGUES[language])
    asked = about_you(booth, qtbot, width, height)
    assert not booth.sees("more")
    columns = [(option.x(), option.width()) for option in asked[0][:2]]
    assert columns[0][1] == columns[1][1]
    for options in asked:
        # The last of an odd number is as wide as the others.
        assert [(option.x(), option.width()) for option in options] == (columns * 3)[: len(options)]
        for left, right in zip(options[::2], options[1::2], strict=False):
            assert (left.y(), left.height()) == (right.y(), right.height())
        assert max(option.height() for option in options) < 1.6 * min(option.height() for option in options)


@pytest.mark.parametrize(("width", "height", "apart"), [(1920, 1080, 20), (1080, 1920, 24)])
def test_options_and_questions_are_far_apart_where_the_page_has_room(
    make_booth: MakeBooth, qtbot: QtBot, width: int, height: int, apart: int
) -> None:
    booth = make_booth()
    _, options = about_you(booth, qtbot, width, height)
    lay_out(booth.app.window)
    first, second, below = options[:3]
    assert second.x() - first.x() - first.width() == apart
    assert below.y() - first.y() - first.height() == apart
    upper, lower = booth.item("item-gender"), booth.item("item-robots")
    between = lower.mapToScene(QPointF(0, 0)).y() - upper.mapToScene(QPointF(0, upper.height())).y()
    assert between >= 27.5
    assert not booth.sees("more")


@pytest.mark.parametrize("language", ["en", "es", "it"])
@pytest.mark.parametrize("size", [TextSize.NORMAL, TextSize.LARGEST])
def test_an_upright_page_s_options_are_as_high_as_the_highest_of_their_question(
    make_booth: MakeBooth, qtbot: QtBot, language: str, size: TextSize
) -> None:
    booth = make_booth()
    booth.app.screens.set_language(CATALOGUES[language])
    booth.app.screens.kiosk.set_text_size(size)
    asked = about_you(booth, qtbot, 1080, 1920)
    lay_out(booth.app.window)
    # One of them has two lines.
    assert max(text.property("lineCount") for option in asked[1] for text in texts(option)) == 2
    assert [len({option.height() for option in options}) for options in asked] == [1, 1]
    assert not booth.sees("more")


@pytest.mark.parametrize("language", ["en", "es", "it"])
def test_options_are_lower_where_that_keeps_all_that_is_missing_in_sight(
    make_booth: MakeBooth, qtbot: QtBot, language: str
) -> None:
    booth = make_booth()
    booth.app.screens.set_language(CATALOGUES[language])
    (usual, *_), _ = about_you(booth, qtbot, 1280, 800)
    before = usual.height()
    booth.app.screens.form.show_missing(("age", "gender", "robots"))
    lay_out(booth.app.window)
    assert not booth.sees("more")
    assert 68 * 2 / 3 <= usual.height() < before


def test_what_a_finger_meets_on_an_upright_page_is_as_high_as_the_way_on(make_booth: MakeBooth, qtbot: QtBot) -> None:
    booth = make_booth()
    asked = about_you(booth, qtbot, 1080, 1920)
    found = [*asked[0], *asked[1], booth.item("number-age")]
    assert {round(each.height()) for each in found} == {round(booth.item("continue").height())} == {112}
    assert asked[0][2].y() - asked[0][0].y() == 136
    # An option of many words has a second line for them.
    assert max(text.property("lineCount") for text in texts(asked[1][3])) == 2


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
def test_options_whose_words_have_no_room_beside_each_other_stand_below_each_other(
    make_booth: MakeBooth, qtbot: QtBot, width: int, height: int
) -> None:
    booth = make_booth()
    window = booth.app.window
    window.resize(width, height)
    qtbot.waitUntil(lambda: window.contentItem().width() == width)
    single = Questionnaire.read(ASSETS / "questionnaires" / "about-you.toml").items[2]
    shown = single.model_dump()
    shown["options"][1]["text"] = {"en": "Donaudampfschifffahrtselektrizitätenhauptbetriebswerkbeamtengesellschaft"}
    ask(booth, ITEMS["integer"], type(single).model_validate(shown))
    options = [booth.item(f"option-robots-{name}") for name in ("none", "stories", "fairs", "owns", "works")]
    assert {option.x() for option in options} == {0}
    assert len({option.width() for option in options}) == 1
    words = next(iter(texts(options[1])))
    assert words.property("contentWidth") <= words.width() + 1
    assert words.mapToItem(options[1], QPointF(words.width(), 0)).x() <= options[1].width()


def test_the_keys_beside_a_wide_page_keep_their_distance_from_the_helper(make_booth: MakeBooth, qtbot: QtBot) -> None:
    booth = make_booth()
    about_you(booth, qtbot, 1920, 1080)
    booth.click("number-age")
    key = place(booth.item("key-done"))
    ears = [
        place(item)
        for item in items(booth.app.window.contentItem())
        if item.metaObject().className().startswith("AvatarEar")
    ]
    assert len(ears) == 2
    # The last row of keys is 20 px from the edge around all of them.
    assert min(ear.top() for ear in ears) - key.bottom() - 20 >= 60


@pytest.mark.parametrize("right", [False, True])
@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1280, 800), (1366, 768), (1080, 1920), (540, 960)])
def test_the_tail_of_a_number_s_keys_joins_their_edge_to_that_of_the_question(
    make_booth: MakeBooth, qtbot: QtBot, width: int, height: int, *, right: bool
) -> None:
    booth = make_booth()
    window = booth.app.window
    window.setProperty("boardOnRight", right)
    about_you(booth, qtbot, width, height)
    booth.click("number-age")
    lay_out(window)
    tail = booth.item("keys-tail")
    assert tail.isVisible()
    (keys,) = [
        item for item in items(window.contentItem()) if item.metaObject().className().startswith("ScreenKeyboard")
    ]
    tip, card, around = (
        item.mapRectToScene(QRectF(0, 0, item.width(), item.height())) for item in (tail, booth.item("card-age"), keys)
    )
    if height > width:
        gap = tip.top() - card.bottom()
        line = [QPointF(at, around.top() + 6) for at in range(round(around.left()) + 40, round(around.right()) - 40)]
        mouth = [QPointF(tip.center().x(), around.top() + at) for at in range(1, 8)]
    else:
        gap = max(tip.left() - card.right(), card.left() - tip.right())
        edge, inwards = (around.left(), 1) if tip.left() < around.left() else (around.right(), -1)
        line = [QPointF(edge + 6 * inwards, at) for at in range(round(around.top()) + 40, round(around.bottom()) - 40)]
        mouth = [QPointF(edge + at * inwards, tip.center().y()) for at in range(1, 8)]
    assert gap == pytest.approx(0, abs=1)
    # Inside of the keys' edge nothing is left of the tail's, and that edge is open where the tail leaves it.
    picture, ratio = window.grabWindow(), window.devicePixelRatio()
    colors = {picture.pixelColor((point * ratio).toPoint()).name() for point in [*line, *mouth]}
    assert colors == {QColor(keys.property("color")).name()}


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1280, 800), (1366, 768)])
def test_the_edge_of_the_bubble_beside_a_page_is_open_where_its_tail_leaves_it(
    make_booth: MakeBooth, qtbot: QtBot, width: int, height: int
) -> None:
    booth = make_booth()
    window = booth.app.window
    booth.app.screens.avatar.say("Take your time.", "")
    about_you(booth, qtbot, width, height)
    lay_out(window)
    tails = [
        place(item)
        for item in items(window.contentItem())
        if item.metaObject().className().startswith("SpeechTail") and item.isVisible()
    ]
    assert tails
    picture = window.grabWindow()
    for tail in tails:
        half = tail.height() // 2
        down = [picture.pixelColor(tail.center().x(), tail.top() + at).name() for at in range(-6, half)]
        assert len(set(down)) == 1
        # Its own line is there.
        assert picture.pixelColor(tail.center().x(), tail.bottom() - 3).name() != down[0]


@pytest.mark.parametrize("answered", [False, True])
def test_the_way_on_below_an_upright_page_s_keys_can_be_read_and_is_not_filled(
    make_booth: MakeBooth, qtbot: QtBot, *, answered: bool
) -> None:
    booth = make_booth()
    about_you(booth, qtbot, 1080, 1920)
    if answered:
        for item, value in (("age", 30), ("gender", "woman"), ("robots", "none")):
            booth.app.screens.form.show_answer(item, value)
    way = booth.item("continue")
    assert way.property("quiet") is not answered
    booth.click("number-age")
    assert booth.sees("key-1")
    lay_out(booth.app.window)
    *_, ground, letters = appearance(way, booth.app.window.grabWindow())
    assert contrast(letters, ground) >= 4.5
    assert way.property("quiet")
    assert way.parentItem().opacity() == 1
    booth.click("key-done")
    assert way.property("quiet") is not answered


def test_an_upright_page_s_keys_stand_below_their_question_over_all_others_until_they_are_done_with(
    make_booth: MakeBooth, qtbot: QtBot
) -> None:
    booth = make_booth()
    window = booth.app.window
    window.resize(1080, 1920)
    qtbot.waitUntil(lambda: window.contentItem().width() == 1080)
    ask(booth, *Questionnaire.read(ASSETS / "questionnaires" / "about-you.toml").items)
    booth.click("number-age")
    below = booth.item("item-age").mapToScene(QPointF(0, booth.item("item-age").height())).y()
    assert 0 < booth.item("key-1").mapToScene(QPointF(0, 0)).y() - below < 100
    # In the order of a telephone, as large as the questions that they cover: none of these is cut.
    keys = [[booth.item(f"key-{key}") for key in row] for row in ("123", "456", "789", ("delete", "0", "done"))]
    places = [[key.mapToScene(QPointF(0, 0)).toTuple() for key in row] for row in keys]
    assert len({tuple(left for left, _ in row) for row in places}) == 1
    assert all(len({top for _, top in row}) == 1 for row in places)
    foot = booth.item("item-robots").mapToScene(QPointF(0, booth.item("item-robots").height())).y()
    assert 0 < foot - keys[-1][-1].mapToScene(QPointF(0, keys[-1][-1].height())).y() < 40
    # Questions that they may cover step back until the keys go.
    others = [booth.item(name) for name in ("item-gender", "item-robots")]
    assert booth.item("item-age").opacity() == 1 > max(other.opacity() for other in others)
    # Nothing can be stepped before there is a number, nor while the keys enter it: the field stays as wide.
    field = booth.item("number-age")
    end, wide = field.mapToScene(QPointF(field.width(), 0)), field.width()
    for key in ("", "2"):
        if key:
            booth.click(f"key-{key}")
        assert field.property("text") == key
        assert not booth.sees("less-age")
        assert not booth.sees("more-age")
        assert field.width() == wide
        assert field.mapToScene(QPointF(field.width(), 0)) == end
    booth.click("key-done")
    assert not booth.sees("key-1")
    assert booth.sees("less-age")
    assert booth.sees("more-age")
    assert field.mapToScene(QPointF(field.width(), 0)).x() == end.x()
    assert min(other.opacity() for other in others) == 1


def test_the_way_on_says_how_many_answers_it_waits_for(booth: Booth) -> None:
    ask(booth, required("likert"), required("pictures"))
    assert booth.item("form-waiting").property("text") == "2 answers to go"
    booth.app.screens.form.show_answer(ITEMS["likert"].id, 3)
    assert booth.item("form-waiting").property("text") == "One answer to go"
    booth.app.screens.form.show_answer(ITEMS["pictures"].id, 1)
    assert not booth.sees("form-waiting")


def test_one_press_of_a_digit_answers_each_scale_in_turn(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["likert"], ITEMS["differential"], ITEMS["pictures"])
    press(booth, Qt.Key.Key_3, Qt.Key.Key_1, Qt.Key.Key_5, RETURN)
    answered = [(ITEMS[kind].id, value) for kind, value in (("likert", 3), ("differential", 1), ("pictures", 5))]
    assert given == [*answered, ("", "continued")]


def test_a_digit_that_the_scale_does_not_have_answers_nothing(booth: Booth, given: Given) -> None:
    ask(booth, ITEMS["pictures"])
    press(booth, Qt.Key.Key_9)
    assert given == []


@pytest.mark.parametrize("text", ["jörg.weiß@example.org", "Ångström", "C++ & 5 €", "ñandú; 50 %"])
def test_mail_addresses_accents_and_signs_are_typed_with_the_keys_on_the_screen(
    booth: Booth, given: Given, text: str
) -> None:
    ask(booth, ITEMS["text"])
    booth.click("text-remark")
    finger = Finger(booth.app.window)
    finger.type(text)
    finger.click("key-done")
    assert given == [("remark", text)]


@pytest.mark.parametrize(("language", "letters"), [("el", "αθήνα"), ("uk", "київ"), ("de", "größe"), ("nb", "ærfugl")])
def test_a_language_has_its_own_letters_on_the_first_layer(language: str, letters: str) -> None:
    rows = key_rows(language)
    assert set(letters) <= set("".join(rows.letters))
    assert rows.missing([letters]) == ()


def test_letters_without_a_key_are_found_and_own_rows_bring_them() -> None:
    assert key_rows("en").missing(["Ελλάδα"]) == tuple("άαδελ")
    assert key_rows("xx", ["άαδελ"]).missing(["Ελλάδα"]) == ()
