"""Consent and age: nothing is decided for the visitor, and both answers are as easy as each other."""

from __future__ import annotations

import tomllib
from itertools import pairwise
from pathlib import Path

import pytest
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtQml import QQmlProperty
from PySide6.QtQuick import QQuickItem, QQuickWindow
from pytestqt.qtbot import QtBot

from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS, Settings
from kiosk.experiment.information import ConsentPage, Purpose
from kiosk.ui.simulated_visitor import UiDriver, lay_out
from tests.samples import CATALOGUES, ENGLISH, with_needed_boxes
from tests.ui.conftest import Booth
from tests.ui.looking import appearance, lies_in, painted, place, texts

PAGE = ConsentPage(
    title="Before you begin",
    paragraphs=("We record your moves.",),
    purposes=(
        Purpose(id="take_part", text="I take part."),
        Purpose(id="store", text="You may store it."),
        Purpose(id="share", text="You may share it.", required=False),
    ),
)
REQUIRED = frozenset({"take_part", "store"})
SHORT = PAGE.model_copy(update={"points": ("No name.",), "signs": ("no_name",)})
MIXED = SHORT.model_copy(update={"purposes": PAGE.purposes[::-1]})
"""A page on which no heading can stand over all that are needed."""

WORDS = CATALOGUES | {"de": Catalogue(ASSETS / "templates" / "two-languages" / "de")}

SHEETS = [
    *(f"consent/study/{language}.toml" for language in ("en", "it", "es")),
    "templates/two-languages/information/de.toml",
]
"""The consent of the shipped sheets."""

STRICT = [f"{sheet} with boxes" for sheet in SHEETS]
"""The same where two boxes have to be ticked to take part."""

Done = list[object]


@pytest.fixture
def booth(restored_booth: Booth) -> Booth:
    """Return the booth that all tests of this module share."""
    return restored_booth


@pytest.fixture
def done(booth: Booth) -> Done:
    """Return what is done on the consent page, which is shown."""
    did: Done = []
    consent = booth.app.screens.consent
    consent.ticked.connect(lambda purpose, ticked: did.append((purpose, ticked)))
    consent.agreed.connect(lambda: did.append("agreed"))
    consent.declined.connect(lambda: did.append("declined"))
    consent.show(PAGE)
    booth.app.screens.kiosk.show("consent")
    booth.settle()
    return did


def language_of(sheet: str) -> str:
    """Return the language of a sheet."""
    return Path(sheet.partition(" ")[0]).stem


def read_sheet(sheet: str) -> ConsentPage:
    """Return the consent of a sheet, one of ``SHEETS`` or ``STRICT``."""
    file, _, strict = sheet.partition(" ")
    page = ConsentPage.model_validate(tomllib.loads((ASSETS / file).read_text(encoding="utf-8"))["consent"])
    return with_needed_boxes(page) if strict else page


def says(item: QQuickItem, text: str) -> bool:
    """Whether a text is to be seen in an item."""
    return item.isVisible() and (item.property("text") == text or any(says(child, text) for child in item.childItems()))


@pytest.mark.usefixtures("done")
@pytest.mark.parametrize("page", [SHORT, MIXED, PAGE], ids=["grouped", "mixed", "long"])
def test_nothing_is_ticked_beforehand_and_the_required_boxes_say_so(booth: Booth, page: ConsentPage) -> None:
    booth.app.screens.consent.show(page)
    booth.settle()
    assert booth.sees("consent-needed") == (page is SHORT)
    for purpose in page.purposes:
        box, note = booth.item(f"purpose-{purpose.id}"), "needed" if purpose.required else "optional"
        if page is SHORT and not purpose.required:
            note = "Optional"
        assert not box.property("on")
        # Where a heading stands over the boxes, it says so for those that are needed.
        assert says(box, note) == (page is not SHORT or not purpose.required)
        told = QAccessible.queryAccessibleInterface(box)
        assert isinstance(told, QAccessibleInterface)
        assert told.text(QAccessible.Text.Description) == note


@pytest.mark.parametrize("language", ["en", "ar"])
@pytest.mark.parametrize("size", [(1920, 1080), (1080, 1920)], ids=["wide", "upright"])
def test_the_boxes_that_are_needed_stand_below_a_heading_and_the_others_say_that_they_are_not(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], language: str
) -> None:
    window = show_short(booth, qtbot, language, size)
    lay_out(window)
    heading, first, second, other = (
        place(booth.item(name)) for name in ("consent-needed", "purpose-take_part", "purpose-store", "purpose-share")
    )
    for above, below in pairwise((heading, first, second, other)):
        assert above.bottom() <= below.top()
    (tag,) = tags(booth, "share")
    words = next(text for text in texts(booth.item("purpose-share")) if text.property("text") == "You may share it.")
    assert tag.property("text") == "Optional"
    assert painted(tag).bottom() <= painted(words).top()
    assert tags(booth, "take_part") == tags(booth, "store") == []
    assert first.left() == second.left() == other.left()
    assert first.width() == second.width() == other.width()
    marks = {
        round(place(booth.item(f"purpose-{purpose.id}").childItems()[-1].childItems()[0]).left())
        for purpose in SHORT.purposes
    }
    assert len(marks) == 1


def tags(booth: Booth, purpose: str) -> list[QQuickItem]:
    """Return what a box says of itself over its words."""
    return [text for text in texts(booth.item(f"purpose-{purpose}")) if text.objectName() == "tag"]


@pytest.mark.usefixtures("done")
@pytest.mark.parametrize(
    ("required", "heading", "line"),
    [
        ((True, True, False), "To take part, tick these 2", "Tick the first 2 boxes."),
        ((True, False, False), "To take part, tick this box", "Tick the first box."),
        ((True, True, True), "To take part, tick the 3 boxes", "Tick the 3 boxes."),
        ((True,), "To take part, tick the box", "Tick the box."),
        ((False,), None, "Your data are stored."),
    ],
)
def test_the_heading_and_the_agreement_say_which_boxes_are_to_be_ticked(
    booth: Booth, required: tuple[bool, ...], heading: str | None, line: str
) -> None:
    purposes = tuple(
        Purpose(id=f"purpose_{at}", text="You may.", required=needed) for at, needed in enumerate(required)
    )
    booth.app.screens.consent.show(SHORT.model_copy(update={"purposes": purposes}))
    booth.settle()
    assert booth.sees("consent-needed") == (heading is not None)
    tagged = [len(tags(booth, purpose.id)) for purpose in purposes]
    assert tagged == [not needed for needed in required]
    if heading is not None:
        assert says(booth.item("consent-needed"), heading)
    assert under(booth, "agree").property("text") == line


@pytest.mark.parametrize("scale", [1.0, 1.15, 1.3])
@pytest.mark.parametrize("sheet", [*SHEETS, *STRICT])
@pytest.mark.parametrize("size", [(1920, 1080), (1080, 1920)], ids=["wide", "upright"])
def test_the_button_for_all_of_the_text_stands_clear_of_every_word(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], sheet: str, scale: float
) -> None:
    window = show_sheet(booth, qtbot, sheet, size, scale)
    lay_out(window)
    button = place(booth.item("read-more"))
    others = [each for each in texts(window.contentItem()) if not lies_in(each, "BigButton")]
    assert not [str(each.property("text")) for each in others if painted(each).intersects(button)]
    points = [place(each) for each in texts(window.contentItem()) if lies_in(each, "SignedLine")]
    # It is about all of the points, and ends what is read. Large letters need that room: it is at the title then.
    if scale > 1.15:
        assert button.bottom() <= min(point.top() for point in points)
    else:
        assert max(point.bottom() for point in points) < button.top()
        assert button.bottom() < place(booth.item("purpose-share")).top()
    booth.click("read-more")
    lay_out(window)
    paragraphs = [painted(each) for each in texts(window.contentItem()) if lies_in(each, "Paragraphs")]
    if scale > 1.15:
        assert place(booth.item("read-more")) == button
    else:
        assert max(each.bottom() for each in paragraphs) < place(booth.item("read-more")).top()


@pytest.mark.usefixtures("done")
def test_a_ticked_box_says_that_it_is_agreed_to_and_moves_nothing(booth: Booth) -> None:
    box = booth.item("purpose-take_part")
    height = box.height()
    booth.app.screens.consent.show_ticks(frozenset({"take_part"}))
    assert says(box, "agreed")
    assert not says(box, "needed")
    assert box.height() == height


@pytest.mark.usefixtures("done")
def test_what_is_scrolled_away_is_not_drawn_over_the_title(booth: Booth) -> None:
    booth.app.window.setProperty("textSize", 1.5)
    booth.app.screens.consent.show(PAGE.model_copy(update={"paragraphs": PAGE.paragraphs * 40}))
    booth.settle()
    title = booth.item("page-title")
    strip = title.mapRectToScene(QRectF(0, 0, title.width(), title.height())).toRect()
    unscrolled = booth.app.window.grabWindow().copy(strip)
    booth.click("more")
    booth.click("more")
    assert booth.app.window.grabWindow().copy(strip) == unscrolled


def test_a_tap_reports_a_tick_and_shows_none_before_it_counts(booth: Booth, done: Done) -> None:
    booth.click("purpose-store")
    assert done == [("store", True)]
    assert not booth.item("purpose-store").property("on")
    booth.app.screens.consent.show_ticks(frozenset({"store"}))
    assert booth.item("purpose-store").property("on")
    booth.click("purpose-store")
    assert done[-1] == ("store", False)


def test_a_double_click_is_one_tick(booth: Booth, done: Done) -> None:
    UiDriver(booth.app.window).double_click("purpose-store")
    assert done == [("store", True)]


def under(booth: Booth, name: str) -> QQuickItem:
    """Return the line below the words of an answer."""
    (line,) = (text for text in texts(booth.item(name)) if text.objectName() == "under")
    return line


def test_each_answer_says_what_follows_and_the_heading_which_boxes_are_to_be_ticked(booth: Booth, done: Done) -> None:
    booth.app.screens.consent.show(SHORT)
    heads = ["To take part, tick these 2", "All set. Now choose below."]
    for ticks in (frozenset({"share"}), REQUIRED - {"store"}, REQUIRED):
        head = heads[ticks >= REQUIRED]
        booth.app.screens.consent.show_ticks(ticks)
        lay_out(booth.app.window)
        shown = [text.property("text") for text in texts(booth.app.window.contentItem())]
        assert [text for text in shown if text in heads] == [head]
        agrees = "Your data are stored." if ticks >= REQUIRED else "Tick the first 2 boxes."
        for name, follows in (("agree", agrees), ("decline", "Nothing about you is stored.")):
            assert under(booth, name).property("text") == follows
            told = QAccessible.queryAccessibleInterface(booth.item(name))
            assert isinstance(told, QAccessibleInterface)
            assert told.text(QAccessible.Text.Description) == follows
    booth.app.screens.consent.show_ticks(frozenset())
    booth.click("agree")
    assert done == ["agreed"]


@pytest.mark.usefixtures("done")
def test_the_answer_that_needs_boxes_shows_them_until_all_are_ticked(booth: Booth) -> None:
    booth.app.screens.consent.show(SHORT)
    booth.settle()
    for ticks in (frozenset[str](), frozenset({"share"}), REQUIRED - {"store"}, REQUIRED):
        booth.app.screens.consent.show_ticks(ticks)
        lay_out(booth.app.window)
        boxes = boxes_in(booth.item("agree"))
        filled = [box.property("color").alpha() > 0 for box in boxes]
        done = len(ticks & REQUIRED)
        assert filled == ([] if done == len(REQUIRED) else [at < done for at in range(len(REQUIRED))])
        assert all(place(box).right() < painted(under(booth, "agree")).left() for box in boxes)
        assert boxes_in(booth.item("decline")) == []


def boxes_in(button: QQuickItem) -> list[QQuickItem]:
    """Return the boxes that are drawn in an answer."""
    return [box for row in button.childItems() for box in row.childItems() if box.objectName() == "box"]


@pytest.mark.usefixtures("done")
def test_what_is_to_be_ticked_has_a_strong_edge_until_it_is(booth: Booth) -> None:
    booth.app.screens.consent.show(SHORT)
    for ticks in (frozenset({"share"}), REQUIRED - {"store"}, REQUIRED, frozenset[str]()):
        booth.app.screens.consent.show_ticks(ticks)
        lay_out(booth.app.window)
        edges = {
            purpose.id: QQmlProperty.read(booth.item(f"purpose-{purpose.id}").property("background"), "border.width")
            for purpose in SHORT.purposes
        }
        # The others all have the same, ticked or not: none of them looks unfinished.
        assert {name for name, width in edges.items() if width > min(edges.values())} == REQUIRED - ticks
        assert min(edges.values()) > 0
        assert len(set(edges.values())) <= 2


def show_sheet(booth: Booth, qtbot: QtBot, sheet: str, size: tuple[int, int], scale: float) -> QQuickWindow:
    """Show a shipped sheet with its way back, in a window of this size and letters of this scale."""
    booth.app.window.setProperty("textSize", scale)
    window = show_short(booth, qtbot, language_of(sheet), size)
    booth.app.screens.consent.show(read_sheet(sheet))
    booth.app.screens.kiosk.offer_back(offered=True)
    booth.settle()
    return window


def show_short(booth: Booth, qtbot: QtBot, language: str, size: tuple[int, int]) -> QQuickWindow:
    """Show a short page in this language in a window of this size."""
    window = booth.app.window
    # A page that stands there would be laid out in both sizes, and once for each of the steps that follow.
    booth.app.screens.kiosk.show("")
    window.resize(*size)
    qtbot.waitUntil(lambda: window.contentItem().width() == size[0])
    booth.app.screens.set_language(WORDS.get(language, ENGLISH))
    booth.app.screens.kiosk.begin((language,), language, Settings().consent)
    booth.app.screens.consent.show(SHORT)
    booth.app.screens.kiosk.show("consent")
    booth.settle()
    return window


@pytest.mark.parametrize("scale", [1.0, 1.3, 1.5])
@pytest.mark.parametrize("language", ["en", "es", "it", "de", "ar"])
@pytest.mark.parametrize("size", [(1920, 1080), (1080, 1920)], ids=["wide", "upright"])
def test_what_follows_from_either_answer_has_the_same_letters_at_the_same_height_within_it(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], language: str, scale: float
) -> None:
    booth.app.window.setProperty("textSize", scale)
    window = show_short(booth, qtbot, language, size)
    booth.app.screens.kiosk.offer_back(offered=True)
    for ticks in (frozenset[str](), REQUIRED - {"store"}, REQUIRED):
        booth.app.screens.consent.show_ticks(ticks)
        lay_out(window)
        lines = [under(booth, name) for name in ("decline", "agree")]
        assert lines[0].property("font") == lines[1].property("font")
        assert lines[0].property("font").pixelSize() >= 24
        tops = [
            place(line).top() - place(booth.item(name)).top()
            for line, name in zip(lines, ("decline", "agree"), strict=True)
        ]
        assert tops[0] == tops[1]
        for line, name in zip(lines, ("decline", "agree"), strict=True):
            answer, letters = place(booth.item(name)), painted(line)
            # They keep clear of the round ends.
            assert letters.left() - answer.left() >= 22
            assert answer.right() - letters.right() >= 22
            assert letters.bottom() <= answer.bottom() - 8


@pytest.mark.parametrize("language", ["en", "es", "it", "de", "ar"])
@pytest.mark.parametrize("size", [(1920, 1080), (1080, 1920)], ids=["wide", "upright"])
def test_both_answers_have_room_around_their_words_and_are_clear_of_the_boxes(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], language: str
) -> None:
    window = show_short(booth, qtbot, language, size)
    booth.app.screens.kiosk.offer_back(offered=True)
    lay_out(window)
    decline, agree = (booth.item(name) for name in ("decline", "agree"))
    both = place(decline).united(place(agree))
    assert both.top() - place(booth.item("purpose-share")).bottom() >= 46
    assert min(place(booth.item(f"purpose-{purpose.id}")).height() for purpose in SHORT.purposes) >= 100
    # As much is free at both ends of either.
    for answer in (decline, agree):
        (words,) = (text for text in texts(answer) if text.objectName() != "under")
        assert painted(words).left() - place(answer).left() >= 46
        assert place(answer).right() - painted(words).right() >= 46
    if size[0] > size[1]:
        back = place(booth.item("back"))
        assert max(back.left() - both.right(), both.left() - back.right()) >= 46
        # With what follows below their words, they reach a little below the row.
        assert 1080 - both.bottom() == pytest.approx(40, abs=5)
    else:
        # The refusal is not hit on the way back.
        assert place(booth.item("back")).top() - both.bottom() >= 40
        lowest = max(place(text).bottom() for text in texts(window.contentItem()) if lies_in(text, "SignedLine"))
        assert place(booth.item("consent-needed")).top() - lowest >= 36


def test_what_is_missing_is_said_in_words_until_it_is_ticked(booth: Booth, done: Done) -> None:
    words = "Please tick this box if you want to take part."
    booth.app.screens.consent.show_missing(("store",))
    assert says(booth.item("purpose-store"), words)
    assert not says(booth.item("purpose-take_part"), words)
    booth.press(Qt.Key.Key_Return)
    assert done == [("store", True)]
    booth.app.screens.consent.show_ticks(frozenset({"store"}))
    assert not says(booth.item("purpose-store"), words)


@pytest.mark.usefixtures("done")
def test_of_several_boxes_of_a_card_that_are_missed_the_first_says_so_in_words(booth: Booth) -> None:
    booth.app.screens.consent.show(SHORT)
    booth.settle()
    words = "Please tick this box if you want to take part."
    boxes = [booth.item(f"purpose-{name}") for name in ("take_part", "store")]
    booth.app.screens.consent.show_missing(("take_part", "store"))
    assert [says(box, words) for box in boxes] == [True, False]
    # The others have the edge, and tell it to those who cannot see that.
    for box in boxes:
        told = QAccessible.queryAccessibleInterface(box)
        assert isinstance(told, QAccessibleInterface)
        assert told.text(QAccessible.Text.Description) == words
    booth.app.screens.consent.show_ticks(frozenset({"take_part"}))
    assert [says(box, words) for box in boxes] == [False, True]


@pytest.mark.usefixtures("done")
@pytest.mark.parametrize("scale", [1.0, 1.15])
@pytest.mark.parametrize("sheet", STRICT)
@pytest.mark.parametrize("size", [(1920, 1080), (1080, 1920)], ids=["wide", "upright"])
def test_words_about_missed_boxes_push_nothing_out_of_view(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], sheet: str, scale: float
) -> None:
    window = show_sheet(booth, qtbot, sheet, size, scale)
    booth.app.screens.consent.show_missing(tuple(read_sheet(sheet).required))
    lay_out(window)
    assert not booth.sees("more")
    assert place(booth.item("purpose-share")).bottom() < place(booth.item("decline")).top()


@pytest.mark.parametrize("shown", [{}, {"textSize": 1.3}, {"textSize": 1.5}, {"highContrast": True}], ids=str)
@pytest.mark.parametrize("size", [(960, 540), (540, 960)], ids=["wide", "upright"])
def test_to_decline_looks_like_to_agree_and_neither_changes_as_boxes_are_ticked(
    booth: Booth, qtbot: QtBot, done: Done, size: tuple[int, int], shown: dict[str, object]
) -> None:
    window = booth.app.window
    for name, value in shown.items():
        window.setProperty(name, value)
    booth.app.screens.kiosk.offer_back(offered=True)
    window.resize(*size)
    qtbot.waitUntil(lambda: window.contentItem().width() == size[0])

    def looks() -> list[tuple[object, ...]]:
        return [appearance(booth.item(name), window.grabWindow()) for name in ("decline", "agree", "back")]

    before = looks()
    decline, agree, back = before
    assert decline == agree
    # Neither looks like the way back, which is an outline, at any time.
    assert decline[2] != back[2]
    for ticks in (REQUIRED - {"store"} | {"share"}, REQUIRED):
        booth.app.screens.consent.show_ticks(ticks)
        assert looks() == before
    booth.click("decline")
    assert done == ["declined"]


@pytest.mark.usefixtures("done")
@pytest.mark.parametrize("scale", [1.0, 1.3, 1.5])
@pytest.mark.parametrize("language", ["en", "es", "it", "de", "ar"])
def test_on_an_upright_screen_both_answers_share_the_width_and_back_stands_where_it_always_does(
    booth: Booth, qtbot: QtBot, language: str, scale: float
) -> None:
    kiosk, window = booth.app.screens.kiosk, booth.app.window
    booth.app.screens.set_language(WORDS.get(language, ENGLISH))
    kiosk.begin((language,), language, Settings().consent)
    kiosk.offer_back(offered=True)
    window.setProperty("textSize", scale)
    window.resize(1080, 1920)
    qtbot.waitUntil(lambda: window.contentItem().width() == 1080)
    lay_out(window)
    decline, agree, back = (place(booth.item(name)) for name in ("decline", "agree", "back"))
    assert decline.size() == agree.size()
    assert back.top() > max(decline.bottom(), agree.bottom())
    first, last = (agree, decline) if language == "ar" else (decline, agree)
    if scale == 1:
        assert decline.top() == agree.top()
        assert last.left() - first.right() == pytest.approx(32, abs=2)
    else:
        # Large words may need the whole width for each.
        assert decline.top() == agree.top() or decline.bottom() < agree.top()
    # Together they have the edges of the page.
    both = decline.united(agree)
    assert both.left() == pytest.approx(48, abs=2)
    assert both.right() == pytest.approx(1080 - 48, abs=2)
    booth.app.screens.age.ask(18)
    kiosk.show("age")
    booth.settle()
    lay_out(window)
    if scale == 1:
        assert place(booth.item("back")).center().y() == pytest.approx(back.center().y(), abs=1)


@pytest.mark.parametrize("sheet", [*SHEETS, *STRICT])
@pytest.mark.parametrize("size", [(1920, 1080), (1080, 1920)], ids=["wide", "upright"])
def test_larger_texts_make_no_letters_of_a_box_smaller_and_keep_the_card(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], sheet: str
) -> None:
    language = language_of(sheet)
    window = show_short(booth, qtbot, language, size)
    booth.app.screens.consent.show(read_sheet(sheet))
    booth.app.screens.kiosk.offer_back(offered=True)
    letters = []
    for scale in (1.0, 1.15, 1.3):
        window.setProperty("textSize", scale)
        booth.settle()
        assert booth.sees("tag")
        assert booth.sees("consent-needed") == (sheet in STRICT)
        assert not booth.sees("more")
        (pixels,) = {
            text.property("font").pixelSize()
            for text in texts(window.contentItem())
            if lies_in(text, "TickBox") and text.objectName() != "tag"
        }
        letters.append(pixels)
    # Letters are set on whole pixels.
    assert all(after >= before - 1 for before, after in pairwise(letters)), letters


@pytest.mark.usefixtures("done")
@pytest.mark.parametrize("scale", [1.0, 1.15])
@pytest.mark.parametrize("sheet", [*SHEETS, *STRICT])
def test_on_an_upright_screen_points_and_boxes_are_all_seen_at_once(
    booth: Booth, qtbot: QtBot, sheet: str, scale: float
) -> None:
    window = booth.app.window
    window.setProperty("textSize", scale)
    window.resize(1080, 1920)
    qtbot.waitUntil(lambda: window.contentItem().width() == 1080)
    booth.app.screens.consent.show(read_sheet(sheet))
    booth.settle()
    assert booth.sees("purpose-share")
    assert not booth.sees("more")
    # Larger texts do not cost the boxes what says which of them are needed.
    assert booth.sees("tag")
    assert booth.sees("consent-needed") == (sheet in STRICT)
    if scale == 1:
        shown = list(texts(window.contentItem()))
        point, box = (
            max(text.property("font").pixelSize() for text in shown if lies_in(text, kind))
            for kind in ("SignedLine", "TickBox")
        )
        # What is agreed to and what is read beforehand can be read from where one stands. Points may spare a line.
        assert box >= 36
        assert box - 7 <= point <= box
        if sheet == SHEETS[0]:
            assert point >= box - 2
        lines = [text.property("lineCount") for text in shown if lies_in(text, "SignedLine") and text.property("text")]
        assert lines.count(1) >= 2
        # Both begin at one edge.
        begin = {
            round(place(text).left())
            for text in shown
            if lies_in(text, "SignedLine", "TickBox") and text.property("text") and text.isVisible()
        }
        assert max(begin) - min(begin) <= 1


def test_a_keyboard_alone_decides(booth: Booth, done: Done) -> None:
    booth.press(Qt.Key.Key_Space)
    assert done == []
    booth.press(Qt.Key.Key_Tab)
    booth.press(Qt.Key.Key_Space)
    for _ in range(4):
        booth.press(Qt.Key.Key_Tab)
    booth.press(Qt.Key.Key_Return)
    assert done == [("take_part", True), "declined"]


def test_in_short_the_page_says_its_points_and_all_of_it_on_request(booth: Booth, done: Done) -> None:
    window = booth.app.window
    booth.app.screens.consent.show(SHORT)
    booth.settle()
    assert says(window.contentItem(), "No name.")
    assert not says(window.contentItem(), "We record your moves.")
    booth.press(Qt.Key.Key_Tab)
    booth.press(Qt.Key.Key_Return)
    assert says(window.contentItem(), "We record your moves.")
    assert not says(window.contentItem(), "No name.")
    booth.click("read-more")
    assert says(window.contentItem(), "No name.")
    assert done == []


@pytest.mark.usefixtures("done")
def test_what_one_visitor_opened_is_closed_for_the_next(booth: Booth) -> None:
    booth.app.screens.consent.show(PAGE.model_copy(update={"points": ("No name.",)}))
    booth.click("read-more")
    booth.app.screens.kiosk.show("attract")
    booth.app.screens.kiosk.show("consent")
    booth.settle()
    assert says(booth.app.window.contentItem(), "No name.")


@pytest.mark.usefixtures("done")
def test_a_page_without_points_shows_all_of_it_at_once(booth: Booth) -> None:
    assert says(booth.app.window.contentItem(), "We record your moves.")
    assert not booth.sees("read-more")


def test_both_answers_about_the_age_look_the_same(booth: Booth) -> None:
    told: list[bool] = []
    booth.app.screens.age.answered.connect(told.append)
    booth.app.screens.age.ask(18)
    booth.app.screens.kiosk.show("age")
    yes, no = booth.item("age-yes"), booth.item("age-no")
    assert (yes.width(), yes.height(), yes.property("quiet")) == (no.width(), no.height(), no.property("quiet"))
    assert says(yes, "I am 18 or older")
    assert says(no, "I am younger than 18")
    booth.click("age-no")
    booth.click("age-yes")
    assert told == [False, True]
