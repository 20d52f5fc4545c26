"""A language that is written from right to left: the whole page is turned round, but the board and what is recorded."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QRectF, Qt
from PySide6.QtQml import QQmlExpression, qmlContext
from PySide6.QtQuick import QQuickItem
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS, Settings
from kiosk.experiment.items import Likert, Single, Slider
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.study.loader import read_study
from kiosk.ui.screens.questionnaire import kept_together
from kiosk.ui.simulated_visitor import find_item, lay_out
from kiosk.ui.window import ClockMode, RunMode, Window, WindowMode
from tests.ui.headless import process_until

ASKED = Questionnaire.read(ASSETS / "questionnaires" / "gallery.toml").items
RATED = next(item for item in ASKED if isinstance(item, Likert))
CHOSEN = next(item for item in ASKED if isinstance(item, Single))
SLIDER = next(item for item in ASKED if isinstance(item, Slider))
RIGHT = 2
"""What ``Text.AlignRight`` is."""
NEAR = 20
"""From an edge, in pixels."""


@pytest.fixture(scope="module")
def window(qapp: QApplication, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Window]:  # noqa: ARG001 - Qt is to be there
    """Provide a window in Arabic, which has English words here."""
    folder = tmp_path_factory.mktemp("languages") / "ar"
    shutil.copytree(ASSETS / "sentences" / "en", folder)
    whole = read_study(Settings(languages=("en",)))
    (plan,) = whole.plans
    opened = Window(
        replace(whole, plans=(replace(plan, catalogue=Catalogue(folder)),)),
        RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL),
    )
    opened.show()
    process_until(opened.shown.isExposed)
    opened.screens.kiosk.begin(("ar",), "ar", plan.settings.consent)
    opened.screens.kiosk.offer_back(offered=True)
    opened.screens.about.show(plan.information.about)
    opened.screens.consent.show(plan.information.consent)
    yield opened
    opened.close()


def show(window: Window, screen: str, *items: Item) -> None:
    """Show a screen, or a form with these items."""
    if items:
        window.screens.form.show(items, 1, 2)
    window.screens.kiosk.show(screen)
    window.screens.kiosk.end_input_guard()
    lay_out(window.shown)


def item(window: Window, name: str) -> QQuickItem:
    """Return the item of this name, which can be seen."""
    found = find_item(window.shown.contentItem(), name)
    assert found is not None, name
    return found


def place(window: Window, name: str) -> QRectF:
    """Where an item is in the window."""
    found = item(window, name)
    return found.mapRectToScene(QRectF(0, 0, found.width(), found.height()))


def parts(above: QQuickItem, kind: str) -> Iterator[QQuickItem]:
    """All visible items of a kind below one."""
    for child in above.childItems():
        if child.isVisible():
            if child.inherits(kind):
                yield child
            yield from parts(child, kind)


def written(window: Window, name: str, words: str) -> QRectF:
    """Where a text within an item is."""
    (text,) = (text for text in parts(item(window, name), "QQuickText") if text.property("text") == words)
    return text.mapRectToScene(QRectF(0, 0, text.width(), text.height()))


@pytest.mark.parametrize("screen", ["about", "consent", "introduction"])
def test_the_way_on_stands_at_the_left_and_the_way_back_at_the_right(window: Window, screen: str) -> None:
    show(window, screen)
    ahead = "agree" if screen == "consent" else "continue"
    assert place(window, ahead).right() < place(window, "back").left()


def alignment(text: QQuickItem) -> object:
    """Return to which side a text is set, after mirroring."""
    context = qmlContext(text)
    assert context is not None
    found: object = QQmlExpression(context, text, "effectiveHorizontalAlignment").evaluate()
    return found[0] if isinstance(found, tuple) else found


def shown_text(window: Window, words: str) -> QQuickItem:
    """Return what shows these words."""
    texts = parts(window.shown.contentItem(), "QQuickText")
    return next(text for text in texts if text.property("text") == words)


def test_the_words_in_the_head_of_a_table_are_at_the_ends_that_they_belong_to(window: Window) -> None:
    four = [RATED.model_copy(update={"id": f"rated{number}"}) for number in range(4)]
    show(window, "form", *four)
    for asked in four:
        first, last = (place(window, f"answer-{asked.id}-{end}") for end in asked.ends)
        assert last.right() < first.left()
        low, high = (written(window, "table-head", word["en"]) for word in (asked.lowest, asked.highest))
        assert [low.right(), high.left()] == pytest.approx([first.right(), last.left()], abs=2)


def test_title_and_purposes_of_the_consent_begin_at_the_right_whatever_their_letters(window: Window) -> None:
    show(window, "consent")
    assert place(window, "page-title").right() == pytest.approx(place(window, "back").right(), abs=1)
    for purpose in window.screens.consent.property("purposes"):
        assert alignment(shown_text(window, purpose["text"])) == RIGHT


def test_the_helpers_sentence_begins_at_the_right(window: Window) -> None:
    show(window, "attract")
    window.screens.avatar.say("Shall we play?")
    lay_out(window.shown)
    assert alignment(shown_text(window, "Shall we play?")) == RIGHT


def test_lines_that_are_made_even_are_shortened_at_the_left(window: Window) -> None:
    show(window, "consent")
    texts = parts(window.shown.contentItem(), "QQuickText")
    even = [text for text in texts if (text.property("slack") or 0) > 0 and alignment(text) == RIGHT]
    assert even
    assert [text.property("rightPadding") for text in even] == [0] * len(even)


def test_the_title_ends_before_the_controls_where_a_form_has_the_whole_width(window: Window) -> None:
    show(window, "form", *(RATED.model_copy(update={"id": f"rated{number}"}) for number in range(4)))
    window.screens.avatar.leave(away=True)
    lay_out(window.shown)
    title = item(window, "page-title")
    controls = place(window, "control-sound")
    assert item(window, "item-rated0").width() > 0.8 * window.shown.width()
    assert title.mapRectToScene(QRectF(0, 0, title.width(), title.height())).right() <= controls.left()
    progress = place(window, "form-progress")
    assert progress.right() <= place(window, "page-title").right() - title.property("contentWidth")
    window.screens.avatar.leave(away=False)


def test_what_the_way_on_waits_for_stands_between_it_and_the_back_of_the_helper(window: Window) -> None:
    window.screens.avatar.leave(away=True)
    show(window, "form", RATED, RATED.model_copy(update={"id": "rated1"}))
    told, way, back = place(window, "form-waiting"), place(window, "continue"), place(window, "turned-away")
    assert way.right() < told.left() < told.right() <= back.left() < back.right() < place(window, "back").left()
    assert abs(back.center().x() - window.shown.width() / 2) < 1
    window.screens.avatar.leave(away=False)


def test_a_question_begins_at_the_right_edge(window: Window) -> None:
    show(window, "form", RATED, CHOSEN)
    card = item(window, f"item-{RATED.id}")
    asked = kept_together(RATED.text["en"])
    question = next(text for text in parts(card, "QQuickText") if text.property("text") == asked)
    context = qmlContext(question)
    assert context is not None
    # As in other tests: the stubs know the value alone, and it comes with whether it is undefined.
    told: object = QQmlExpression(context, question, "effectiveHorizontalAlignment === Text.AlignRight").evaluate()
    assert told in (True, (True, False))


def test_marks_stand_at_the_right_of_their_words(window: Window) -> None:
    show(window, "form", CHOSEN, RATED)
    first = f"option-{CHOSEN.id}-{CHOSEN.options[0].id}"
    words = written(window, first, CHOSEN.options[0].text["en"])
    mark = next(
        part
        for part in parts(item(window, first), "QQuickRectangle")
        if part.width() == part.height() and part.width() < place(window, first).height()
    )
    assert mark.mapRectToScene(QRectF(0, 0, mark.width(), mark.height())).left() >= words.right()


def test_options_and_points_run_from_right_to_left_with_the_low_end_at_the_right(window: Window) -> None:
    show(window, "form", RATED, CHOSEN)
    points = [place(window, f"answer-{RATED.id}-{number}").center().x() for number in range(1, RATED.points + 1)]
    assert points == sorted(points, reverse=True)
    card = f"item-{RATED.id}"
    low, high = (written(window, card, ends["en"]).center().x() for ends in (RATED.lowest, RATED.highest))
    assert low > high


def test_what_is_recorded_is_the_number_on_the_point(window: Window) -> None:
    show(window, "form", RATED, CHOSEN)
    given: list[object] = []
    window.screens.form.answered.connect(lambda _, value: given.append(value))
    QTest.mouseClick(
        window.shown, Qt.MouseButton.LeftButton, pos=place(window, f"answer-{RATED.id}-1").center().toPoint()
    )
    assert given == [1]


def test_the_arrow_to_the_left_goes_to_the_left(window: Window) -> None:
    show(window, "form", RATED, CHOSEN)
    item(window, f"answer-{RATED.id}-1").forceActiveFocus()
    QTest.keyClick(window.shown, Qt.Key.Key_Left)
    assert item(window, f"answer-{RATED.id}-2").hasActiveFocus()


def test_a_slider_grows_to_the_left(window: Window) -> None:
    show(window, "form", SLIDER, CHOSEN)
    given: list[object] = []
    window.screens.form.answered.connect(lambda _, value: given.append(value))
    where = place(window, f"slider-{SLIDER.id}")
    left = QPoint(int(where.left()) + NEAR, int(where.center().y()))
    QTest.mouseClick(window.shown, Qt.MouseButton.LeftButton, pos=left)
    assert given
    assert isinstance(given[-1], int)
    assert given[-1] > sum(SLIDER.ends) / 2


def test_columns_are_counted_from_the_left_where_the_cards_are(window: Window) -> None:
    window.screens.board.deal(2, 3, 3, "animals")
    show(window, "game")
    across = [place(window, f"card-{number}").center().x() for number in range(3)]
    assert across == sorted(across)


def test_the_words_of_an_avatar_that_is_turned_away_stand_at_its_right(window: Window) -> None:
    window.screens.avatar.leave(away=True)
    try:
        show(window, "form", RATED, RATED.model_copy(update={"id": "again"}))
        words, back = (place(window, name) for name in ("turned-away-bubble", "turned-away"))
        on, leave = (place(window, name) for name in ("continue", "back"))
    finally:
        window.screens.avatar.leave(away=False)
    assert 0 <= words.left() - back.right() <= 1.8 * NEAR
    assert on.right() + NEAR < back.left()
    assert words.right() + NEAR < leave.left()
