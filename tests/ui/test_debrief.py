"""The code to withdraw with: large, in words, and as a QR code that says what it should and can be photographed."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import unquote

import pytest
import segno
from PySide6.QtCore import QPoint, QPointF, QRectF
from PySide6.QtGui import QImage
from PySide6.QtQuick import QQuickItem
from pytestqt.qtbot import QtBot

from kiosk.config import ASSETS
from kiosk.experiment.information import Information, Page
from kiosk.game import Position
from kiosk.ui.screens.debrief import QUIET_MODULES
from kiosk.ui.simulated_visitor import lay_out
from tests.samples import CATALOGUES, ENGLISH
from tests.ui.conftest import Booth
from tests.ui.looking import described, is_text, items, lies_in, painted

PAGE = Page(title="What we study", paragraphs=("There are two versions.",))
MAIL, CODE = "study@university.test", "ROME2345-7KQ2M-XR4T4"


@pytest.fixture
def debriefed(booth: Booth) -> Booth:
    """Return a booth at the debrief."""
    booth.app.screens.debrief.show(PAGE)
    booth.app.screens.debrief.give_contact(MAIL)
    booth.app.screens.debrief.give_code(CODE)
    booth.app.screens.kiosk.show("debrief")
    booth.settle()
    return booth


def drawn(booth: Booth) -> list[list[bool]]:
    """Return the squares of the QR code as they are on the screen, its white frame included; True for a dark one."""
    item = booth.item("qr")
    squares = int(str(booth.app.screens.debrief.property("squares")))
    image: QImage = booth.app.window.grabWindow()
    place: QRectF = item.mapRectToScene(QRectF(0, 0, item.width(), item.height()))
    size = place.width() / squares

    def dark(row: int, column: int) -> bool:
        at = QPoint(round(place.x() + (column + 0.5) * size), round(place.y() + (row + 0.5) * size))
        return image.pixelColor(at).lightness() < 128

    return [[dark(row, column) for column in range(squares)] for row in range(squares)]


def wanted(booth: Booth) -> list[list[bool]]:
    """Return the squares of the QR code as they should be."""
    code = segno.make(booth.app.screens.debrief.payload, micro=False)
    return [[bool(square) for square in row] for row in code.matrix_iter(border=QUIET_MODULES)]


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (1920, 1080), (1080, 1920)])
def test_the_qr_code_on_the_screen_is_the_letter_with_its_white_frame(
    debriefed: Booth, qtbot: QtBot, width: int, height: int
) -> None:
    window = debriefed.app.window
    window.resize(width, height)
    qtbot.waitUntil(lambda: window.contentItem().width() == width)
    qtbot.waitUntil(lambda: any(map(any, drawn(debriefed))))
    assert drawn(debriefed) == wanted(debriefed)


def test_it_is_a_letter_to_the_contact_that_names_the_code(debriefed: Booth) -> None:
    payload = debriefed.app.screens.debrief.payload
    assert payload.startswith(f"mailto:{MAIL}?subject=")
    assert CODE in unquote(payload)
    assert " " not in payload


@pytest.mark.parametrize("contact", ["Dr Ada <ada@university.test>", "ada@university.test.", "ada@university.test, 5"])
def test_a_mail_address_is_found_among_the_words_of_a_contact(debriefed: Booth, contact: str) -> None:
    debriefed.app.screens.debrief.give_contact(contact)
    assert debriefed.app.screens.debrief.payload.startswith("mailto:ada@university.test?subject=")


def test_whom_to_ask_is_told_with_and_without_a_code(debriefed: Booth) -> None:
    def shown() -> set[str]:
        debriefed.settle()
        return {item.objectName() for item in items(debriefed.app.window.contentItem())} & {"questions", "qr", "code"}

    assert shown() == {"qr", "code"}
    assert MAIL in str(debriefed.app.screens.debrief.property("withdrawing"))
    debriefed.app.screens.debrief.give_code("")
    assert shown() == {"questions"}
    assert debriefed.item("questions").property("text") == f"Questions about the study: {MAIL}"
    debriefed.app.screens.debrief.give_contact("")
    assert shown() == set()


@pytest.mark.parametrize("contact", ["", "Room 12", "ada@a.test or bob@b.test"])
def test_without_a_mail_address_it_says_what_to_tell(debriefed: Booth, contact: str) -> None:
    debriefed.app.screens.debrief.give_contact(contact)
    assert debriefed.app.screens.debrief.payload == f"Please delete my data: {CODE}\n{contact}".rstrip()


def test_the_code_is_the_largest_text_of_the_page(debriefed: Booth) -> None:
    assert debriefed.item("code").property("text") == CODE
    assert debriefed.item("code").property("font").pixelSize() >= 60 / 1080 * debriefed.app.window.height()


def test_without_a_code_nothing_is_said_about_withdrawing(debriefed: Booth) -> None:
    debriefed.app.screens.debrief.give_code("")
    assert not debriefed.sees("qr")
    assert not debriefed.sees("code")


def test_the_qr_code_also_says_what_the_study_was_about(debriefed: Booth) -> None:
    debriefed.app.screens.debrief.give_summary("We study how a robot can help.")
    assert unquote(debriefed.app.screens.debrief.payload).endswith("&body=We study how a robot can help.")
    debriefed.app.screens.debrief.give_contact("")
    assert debriefed.app.screens.debrief.payload == f"Please delete my data: {CODE}\nWe study how a robot can help."


def test_the_card_says_what_a_telephone_finds_in_the_qr_code(debriefed: Booth) -> None:
    debrief = debriefed.app.screens.debrief
    assert debrief.property("scanning") == "A message to send us"
    debrief.give_contact("")
    debrief.give_summary("We study how a robot can help.")
    assert debrief.property("scanning") == "Your code and our study"
    debrief.give_summary("")
    assert debrief.property("scanning") == "Your code, to scan"
    debrief.give_code("")
    assert not debrief.property("scanning")


def test_the_result_shows_the_pairs_that_were_found_and_the_hints_only_if_there_were_any(booth: Booth) -> None:
    screens = booth.app.screens
    screens.board.deal(2, 2, 2, "animals")
    for row, card in enumerate(("cat", "owl")):
        for column in range(2):
            screens.board.reveal(Position(row, column), card)
        screens.board.mark_matched((Position(row, 0), Position(row, 1)))
    screens.kiosk.show("result")

    def seen() -> tuple[set[str], set[object]]:
        shown = [item for item in items(booth.app.window.contentItem()) if lies_in(item, "ResultView")]
        pictures = {Path(item.property("source").path()).stem for item in shown if item.inherits("QQuickImage")}
        return pictures, {item.property("text") for item in shown if item.inherits("QQuickText")}

    screens.result.show(2, 3, 9_000, 4, screens.board.found)
    pictures, words = seen()
    assert pictures == {"cat", "owl"}
    assert {"2", "3", "4", "Hints", screens.kiosk.property("words")["result-line"]} <= words
    screens.result.show(2, 3, 9_000, 0, screens.board.found)
    assert "Hints" not in seen()[1]


def test_the_thanks_show_the_pairs_that_the_visitor_found_or_else_some_cards(booth: Booth) -> None:
    screens = booth.app.screens

    def pictures() -> set[str]:
        booth.settle()
        shown = [item for item in items(booth.app.window.contentItem()) if lies_in(item, "ThanksView")]
        sources = (item.property("source") for item in shown if item.inherits("QQuickImage"))
        return {Path(source.path()).stem for source in sources if source.path()}

    screens.kiosk.show("thanks")
    assert len(pictures() - {"back", "shadow"}) > 2
    folder = ASSETS / "cards" / "animals"
    screens.result.show(2, 3, 9_000, 0, [(folder / f"{card}.svg").as_uri() for card in ("cat", "owl")])
    assert {"cat", "owl"} <= pictures()
    assert len(pictures() - {"back", "shadow", "cat", "owl"}) <= 1


def test_the_helper_says_the_last_line_where_it_stands_beside_the_page(booth: Booth) -> None:
    def said() -> set[bool]:
        texts = [item for item in items(booth.app.window.contentItem()) if item.property("text") == "It is no test."]
        return {lies_in(text, "Bubble") for text in texts}

    booth.app.screens.debrief.show(
        Page(title="What we study", paragraphs=("There are two versions.", "It is no test."))
    )
    booth.app.screens.kiosk.show("debrief")
    booth.settle()
    assert said() == {True}
    booth.app.screens.avatar.appear(present=False)
    booth.settle()
    assert said() == {False}


def found(booth: Booth, count: int) -> None:
    """Tell the result of a game with so many pairs."""
    cards = sorted((ASSETS / "cards" / "animals").glob("*.svg"))
    booth.app.screens.result.show(count, 24, 57_000, 0, [card.as_uri() for card in cards[:count]])


def bounds(item: QQuickItem) -> QRectF:
    """Return where an item is in the window."""
    return item.mapRectToScene(QRectF(0, 0, item.width(), item.height()))


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
def test_pictures_of_the_result_stand_in_the_middle_of_their_tiles_and_the_page_has_even_air(
    booth: Booth, qtbot: QtBot, width: int, height: int
) -> None:
    found(booth, 12)
    shown_at(booth, qtbot, "result", width, height)
    pictures = [item for item in items(booth.app.window.contentItem()) if lies_in(item, "ResultView")]
    pictures = [item for item in pictures if item.inherits("QQuickImage")]
    assert len(pictures) == 12
    for picture in pictures:
        tile = picture.parentItem()
        off = bounds(picture).center() - bounds(tile).center()
        assert max(abs(off.x()), abs(off.y())) <= 1
        # The frame around a picture is thin.
        assert bounds(picture).width() >= 0.9 * bounds(tile.childItems()[0]).width()
    written = texts(booth)
    unit = min(width, height) / 1080
    title, label = (written[words].property("font").pixelSize() for words in ("All pairs found!", "Pairs"))
    assert title == booth.item("page-title").property("font").pixelSize() >= 84 * unit
    assert label >= 36 * unit
    lowest, board = bounds(pictures[-1].parentItem().childItems()[0]).bottom(), written["Pairs"]
    while not board.inherits("QQuickRectangle"):
        board = board.parentItem()
    between = bounds(board).top() - lowest
    assert bounds(booth.item("continue")).top() - bounds(board).bottom() == pytest.approx(between, abs=2)


@pytest.mark.parametrize(("width", "height", "rows"), [(1920, 1080, (4, 4)), (1080, 1920, (3, 2))])
def test_pictures_beside_the_thanks_stand_in_two_rows_as_wide_as_the_page(
    booth: Booth, qtbot: QtBot, width: int, height: int, rows: tuple[int, int]
) -> None:
    found(booth, 12)
    shown_at(booth, qtbot, "thanks", width, height)
    qtbot.waitUntil(lambda: len(kinds(booth, "CardFace", "ThanksView")) == sum(rows))

    def cards() -> list[QQuickItem]:
        return kinds(booth, "CardFace", "ThanksView")

    # Cards of full rows stand below each other, and those of a fan between each other.
    assert len({round(card.x()) for card in cards()}) == (rows[0] if rows[0] == rows[1] else sum(rows))
    ways = bounds(booth.item("page-title")).united(bounds(booth.item("continue")))
    qtbot.waitUntil(lambda: abs(min(bounds(card).left() for card in cards()) - ways.left()) < 12)
    assert max(bounds(card).right() for card in cards()) == pytest.approx(ways.right(), abs=12)


@pytest.mark.parametrize(("count", "rows"), [(1, 1), (3, 1), (4, 2), (5, 2), (12, 2)])
def test_on_an_upright_page_the_thanks_stand_in_the_middle_close_above_a_fan_of_cards(
    booth: Booth, qtbot: QtBot, count: int, rows: int
) -> None:
    found(booth, count)
    shown_at(booth, qtbot, "thanks", 1080, 1920)
    qtbot.waitUntil(lambda: len(kinds(booth, "CardFace", "ThanksView")) == min(count, 5))
    qtbot.waitUntil(lambda: count == 1 or kinds(booth, "CardFace", "ThanksView")[-1].rotation() > 0)
    cards = [bounds(card) for card in kinds(booth, "CardFace", "ThanksView")]
    title, way = painted(booth.item("page-title")), bounds(booth.item("continue"))
    assert title.center().x() == pytest.approx(540, abs=2)
    # No fan is lop-sided.
    assert max(card.right() for card in cards) - 540 == pytest.approx(540 - min(card.left() for card in cards), abs=12)
    lower = [card for card in cards if card.top() > cards[0].center().y()]
    assert (1 if not lower else 2) == rows
    assert len(lower) <= len(cards) / 2
    above, below = cards[0].top() - title.bottom(), way.top() - max(card.bottom() for card in cards)
    assert above < 60
    assert below > 30
    assert booth.item("page-title").property("font").pixelSize() >= 120


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
def test_the_helper_says_goodbye_in_large_letters_with_no_sentence_broken_that_has_room(
    booth: Booth, qtbot: QtBot, width: int, height: int
) -> None:
    sentences = ("That was a pleasure.", "Have a lovely day!")
    booth.app.screens.avatar.say(" ".join(sentences))
    shown_at(booth, qtbot, "thanks", width, height)
    words = texts(booth)[("\n" if width > height else " ").join(sentences)]
    assert lies_in(words, "Bubble")
    assert words.property("lineCount") == (2 if width > height else 1)
    assert words.property("font").pixelSize() >= (40 if width > height else 48)
    # A screen reader says both sentences together.
    assert described(words)[1] == " ".join(sentences)


def faces(booth: Booth, *, behind: bool) -> list[QQuickItem]:
    """Return the cards that points are drawn with: those in front, or the slanted ones behind them."""
    shown = [item for item in items(booth.app.window.contentItem()) if lies_in(item, "PointDrawing")]
    return [item for item in shown if item.property("up") is not None and bool(item.rotation()) == behind]


SIGNS = ("compare", "seen", "chance", "questions", "helper", "clock")


def points(count: int, last: str = "It is no test\nYou can ask us.") -> Page:
    """Return a page of so many points, of which the last is this one."""
    paragraphs = (*(f"Point {number}\nThis is short." for number in range(count - 1)), last)
    return Page.model_validate({"title": "What we study", "paragraphs": paragraphs, "signs": SIGNS[:count]})


def shown_at(booth: Booth, qtbot: QtBot, screen: str, width: int, height: int) -> None:
    """Show a screen in a window of this size."""
    window = booth.app.window
    booth.app.screens.kiosk.show(screen)
    window.resize(width, height)
    qtbot.waitUntil(lambda: window.contentItem().width() == width)
    booth.settle()
    lay_out(window)


def show_debriefing(booth: Booth, qtbot: QtBot, language: str, width: int, height: int) -> None:
    """Show the debriefing of the study with a code, whose letters are wide, in a window of this size."""
    booth.app.screens.debrief.show(Information.of(ASSETS / "consent" / "study", language).debrief)
    booth.app.screens.debrief.give_code("WWWWW-WWWWW")
    shown_at(booth, qtbot, "debrief", width, height)


def texts(booth: Booth) -> dict[str, QQuickItem]:
    """Return what is written, by its text."""
    return {str(item.property("text")): item for item in items(booth.app.window.contentItem())}


def parts(booth: Booth, name: str, inside: str = "DebriefView") -> list[QRectF]:
    """Return where the parts of this kind are in the window, as they follow each other."""
    return [bounds(part) for part in kinds(booth, name, inside)]


def kinds(booth: Booth, name: str, inside: str = "DebriefView") -> list[QQuickItem]:
    """Return the parts of this kind that are seen."""
    shown = [item for item in items(booth.app.window.contentItem()) if lies_in(item, inside)]
    return [item for item in shown if item.metaObject().className().startswith(f"{name}_")]


@pytest.mark.parametrize("last", ["It is no test\nYou can ask us.", f"It is no test\nYou {'can ' * 40}ask us."])
def test_two_points_stand_on_cards_between_plain_lines_and_the_helper_says_the_fifth_if_it_is_short(
    booth: Booth, qtbot: QtBot, last: str
) -> None:
    page = points(5, last)
    booth.app.screens.debrief.show(page)
    shown_at(booth, qtbot, "debrief", 1920, 1080)
    written = texts(booth)

    # A plain one has its text in the same line; where one has no room there, all that follow are one paragraph.
    joined = "Point 3. This is short. " + last.replace("\n", ". ")
    starts = ("Point 0.", "Point 1", "Point 2", "Point 3." if len(last) < 130 else joined)

    def place(number: int) -> QPointF:
        return written[starts[number]].mapToScene(QPointF(0, 0))

    qtbot.waitUntil(lambda: place(0).x() == place(3).x() < place(1).x() < place(2).x())
    qtbot.waitUntil(lambda: place(0).y() < place(1).y() == place(2).y() < place(3).y())
    (lead, *cards) = parts(booth, "PointCard")[:3]
    assert cards[0].top() == cards[1].top() < lead.bottom() + 80
    # A click on it in the preview finds the whole point.
    assert written["Point 0."].parentItem().property("text") == page.paragraphs[0]
    assert page.paragraphs[3] in written
    said = "It is no test. You can ask us."
    assert (said in written and lies_in(written[said], "Bubble")) == (len(last) < 130)


def test_on_an_upright_page_two_points_stand_on_cards_with_their_drawings_above_the_words(
    booth: Booth, qtbot: QtBot
) -> None:
    booth.app.screens.debrief.show(points(5))
    shown_at(booth, qtbot, "debrief", 1080, 1920)
    written = texts(booth)

    def place(text: str) -> QPointF:
        return written[text].mapToScene(QPointF(0, 0))

    qtbot.waitUntil(lambda: place("Point 1").y() == place("Point 2").y() < place("Point 3").y())
    assert place("Point 0.").y() < place("Point 1").y()
    # The two that follow stand beside each other as well, below the cards and as wide as those.
    assert place("Point 3").y() == place("It is no test").y()
    _, first, second, third, fourth = parts(booth, "PointCard")
    assert (third.left(), fourth.left()) == (first.left(), second.left())
    assert (third.width(), fourth.width()) == (first.width(), second.width())
    # The words stand below the drawing, both in the middle of their card.
    drawing, card = parts(booth, "PointDrawing")[0], parts(booth, "PointCard")[1]
    assert drawing.height() >= 240
    assert drawing.center().x() == pytest.approx(card.center().x(), abs=1)
    assert painted(written["Point 1"]).center().x() == pytest.approx(card.center().x(), abs=2)
    assert place("Point 1").y() > drawing.bottom()


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
@pytest.mark.parametrize("count", range(1, 7))
def test_one_to_six_points_and_the_card_to_take_home_are_seen_without_scrolling(
    booth: Booth, qtbot: QtBot, count: int, width: int, height: int
) -> None:
    booth.app.screens.debrief.show(points(count))
    booth.app.screens.debrief.give_contact(MAIL)
    booth.app.screens.debrief.give_code(CODE)
    shown_at(booth, qtbot, "debrief", width, height)
    assert not booth.sees("more")
    code, way = bounds(booth.item("qr")), bounds(booth.item("continue"))
    assert code.bottom() < way.top() or (code.right() < way.left() and code.bottom() <= way.bottom())


@pytest.mark.parametrize(("width", "height"), [(1280, 800), (1366, 768), (1920, 1080), (1080, 1920)])
def test_no_shipped_debriefing_scrolls_in_letters_of_usual_size(
    booth: Booth, qtbot: QtBot, width: int, height: int
) -> None:
    sheets = [*(ASSETS / "consent" / "study").glob("*.toml"), *(ASSETS / "templates").glob("*/information/*.toml")]
    assert len(sheets) > 10
    booth.app.screens.debrief.give_contact("memory-study@psychology.university.test")
    booth.app.screens.debrief.give_code("WWWWWWW")
    scrolling = []
    for sheet in sheets:
        booth.app.screens.set_language(CATALOGUES.get(sheet.stem, ENGLISH))
        information = Information.of(sheet.parent, sheet.stem)
        booth.app.screens.debrief.give_summary(information.about.paragraphs[0])
        booth.app.screens.debrief.show(information.debrief)
        shown_at(booth, qtbot, "debrief", width, height)
        if booth.sees("more"):
            scrolling.append(sheet.relative_to(ASSETS))
    assert scrolling == []


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
@pytest.mark.parametrize("language", ["en", "it", "es"])
def test_the_shipped_debriefing_is_about_its_two_versions_drawn_with_cards_of_the_game(
    booth: Booth, qtbot: QtBot, language: str, width: int, height: int
) -> None:
    page = Information.of(ASSETS / "consent" / "study", language).debrief
    found(booth, 3)
    booth.app.screens.debrief.show(page)
    booth.app.screens.debrief.give_code("WWWWW-WWWWW")
    shown_at(booth, qtbot, "debrief", width, height)
    written = texts(booth)
    for version in page.paragraphs[1:3]:
        heading = written[version.split("\n")[0]]
        assert heading.property("font").pixelSize() >= 40
        assert heading.property("lineCount") <= 2
    seen, chance = faces(booth, behind=False)
    behind, others = faces(booth, behind=True)[:2], faces(booth, behind=True)[2:]
    # Among closed cards, one is picked by what was seen, and one by chance.
    assert [face.property("up") for face in (*behind, seen)] == [False, False, True]
    assert [face.property("up") for face in (*others, chance)] == [False, False, False]
    assert seen.property("picture") == booth.app.screens.result.property("pictures")[0]
    assert seen.width() == chance.width() >= 180
    for face in (*behind, *others):
        drawn_on = parts(booth, "PointCard")[1 if face in behind else 2]
        assert drawn_on.contains(bounds(face))
    assert booth.item("qr").width() >= 280
    # The page says everything itself.
    assert not any(text and lies_in(item, "Bubble") for text, item in written.items())


def test_the_points_on_a_wide_screen_have_letters_of_two_sizes(booth: Booth, qtbot: QtBot) -> None:
    show_debriefing(booth, qtbot, "en", 1920, 1080)
    shown = [item for item in items(booth.app.window.contentItem()) if lies_in(item, "DebriefPoints")]
    letters = [item for item in shown if item.inherits("QQuickText") and item.property("text")]
    assert {item.property("font").pixelSize() for item in letters} == {34, 42}


@pytest.mark.parametrize("size", [(1280, 800), (1366, 768), (1920, 1080)])
@pytest.mark.parametrize("language", ["en", "it", "es"])
@pytest.mark.parametrize("at_left", [False, True])
def test_beside_a_wide_page_the_helper_holds_a_ticket_with_the_code(
    booth: Booth, qtbot: QtBot, language: str, size: tuple[int, int], *, at_left: bool
) -> None:
    window, (width, height) = booth.app.window, size
    window.setProperty("boardOnRight", at_left)
    show_debriefing(booth, qtbot, language, width, height)
    (ticket,), way, face = parts(booth, "Ticket"), bounds(booth.item("continue")), bounds(booth.item("face"))
    # It ends with the way on, and stands beside the page.
    assert ticket.bottom() == pytest.approx(way.bottom(), abs=1)
    assert ticket.right() < bounds(booth.item("page-title")).left() if at_left else ticket.left() > way.right()
    assert QRectF(0, 0, width, height).contains(ticket)
    # The eyes are above its edge, and the mouth is behind it.
    assert face.top() + 0.55 * face.height() <= ticket.top() <= face.top() + 0.6 * face.height()
    assert face.center().x() == pytest.approx(ticket.center().x(), abs=1)
    # Its head is below the controls.
    assert face.top() + 0.15 * face.height() > 85 * min(width / 1920, height / 1080)
    told = [item for item in items(window.contentItem()) if lies_in(item, "Ticket") and is_text(item)]
    assert len(told) == 3
    assert all(ticket.contains(QRectF(painted(item))) for item in told)
    assert booth.item("qr").width() >= 0.27 * height
    assert bounds(booth.item("qr")).left() % 1 == 0 or at_left
    # The code is drawn after its page, in a later frame.
    qtbot.waitUntil(lambda: drawn(booth) == wanted(booth))
    # A question over the page finds the helper at its usual place.
    booth.app.screens.kiosk.ask("stop")
    booth.settle()
    lay_out(window)
    assert bounds(booth.item("face")).bottom() == pytest.approx(height, abs=1)
    window.setProperty("boardOnRight", False)  # noqa: FBT003 - Qt's own


def test_a_ticket_says_whom_to_write_to_and_that_its_code_is_for_another_day_as_well(
    booth: Booth, qtbot: QtBot
) -> None:
    show_debriefing(booth, qtbot, "en", 1920, 1080)
    booth.app.screens.debrief.give_contact(MAIL)
    booth.app.screens.debrief.give_code("WWWWW-WWWWW", returns=True)
    booth.settle()
    lay_out(booth.app.window)
    (ticket,) = parts(booth, "Ticket")
    told = [item for item in items(booth.app.window.contentItem()) if lies_in(item, "Ticket") and is_text(item)]
    assert [MAIL in str(item.property("text")) for item in told] == [False, False, True, False]
    assert all(ticket.contains(QRectF(painted(item))) for item in told)
    assert bounds(booth.item("qr")).bottom() <= painted(booth.item("code")).top()


@pytest.mark.parametrize("language", ["en", "it", "es"])
def test_the_two_notes_of_an_upright_page_are_alike(booth: Booth, qtbot: QtBot, language: str) -> None:
    show_debriefing(booth, qtbot, language, 1080, 1920)
    notes = kinds(booth, "PointCard")[3:]
    written = [[text for text in items(note) if is_text(text)] for note in notes]
    assert [[text.property("lineCount") for text in note] for note in written] == [[1, 2], [1, 2]]
    # They are as large as what the cards say below their headings.
    said = [text for text in items(kinds(booth, "PointCard")[1]) if is_text(text)][-1]
    assert {text.property("font").pixelSize() for note in written for text in note} == {
        said.property("font").pixelSize()
    }


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
def test_the_white_around_the_qr_code_keeps_clear_of_the_edges_of_its_strip(
    booth: Booth, qtbot: QtBot, width: int, height: int
) -> None:
    booth.app.screens.debrief.show(Information.of(ASSETS / "consent" / "study", "en").debrief)
    # So much is said about this code that it has no room beside the way on.
    booth.app.screens.debrief.give_contact("memory-study@psychology.university.test")
    booth.app.screens.debrief.give_code("WWWWW-WWWWW", returns=True)
    shown_at(booth, qtbot, "debrief", width, height)
    (strip,) = parts(booth, "TakeHomeCard")
    assert strip.bottom() < bounds(booth.item("continue")).top()
    white = bounds(booth.item("qr").childItems()[0])
    assert white.contains(bounds(booth.item("qr")))
    assert min(white.top() - strip.top(), strip.bottom() - white.bottom(), white.left() - strip.left()) >= 23.5


@pytest.mark.parametrize(("width", "height"), [(1280, 800), (1366, 768), (1920, 1080)])
@pytest.mark.parametrize("language", ["en", "it", "es"])
def test_on_a_wide_page_the_code_stands_beside_the_way_on_and_leaves_the_height_to_the_cards(
    booth: Booth, qtbot: QtBot, language: str, width: int, height: int
) -> None:
    show_debriefing(booth, qtbot, language, width, height)
    # A ticket has no room for so long a code.
    booth.app.screens.debrief.give_code("WWWWW-WWWWW-WWWWW")
    booth.settle()
    lay_out(booth.app.window)
    (strip,), way = parts(booth, "TakeHomeCard"), bounds(booth.item("continue"))
    assert strip.bottom() == pytest.approx(way.bottom(), abs=1)
    assert strip.left() == pytest.approx(bounds(booth.item("page-title")).left(), abs=1)
    assert strip.right() < way.left()
    told = [item for item in items(booth.app.window.contentItem()) if lies_in(item, "TakeHomeCard") and is_text(item)]
    assert all(strip.contains(QRectF(painted(item)).adjusted(1, 1, -1, -1)) for item in told)
    # The cards outweigh it.
    assert parts(booth, "PointCard")[1].height() > 1.3 * strip.height()
    # A telephone can tell squares of four dots apart, and the small ones of a small screen are no smaller than before.
    squares = int(str(booth.app.screens.debrief.property("squares")))
    assert booth.item("qr").width() >= squares * (4 if height >= 1080 or squares < 49 else 3)


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
def test_the_sign_on_a_card_leaves_the_upper_half_of_its_picture_free(
    booth: Booth, qtbot: QtBot, width: int, height: int
) -> None:
    show_debriefing(booth, qtbot, "en", width, height)
    signs = [sign for sign in kinds(booth, "Sign") if lies_in(sign, "PointDrawing")]
    pictures = faces(booth, behind=False)
    assert len(signs) == len(pictures) == 2
    for sign, face in zip(signs, pictures, strict=True):
        assert bounds(sign).top() > bounds(face).center().y()
        assert bounds(sign).intersects(bounds(face))


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
@pytest.mark.parametrize("language", ["en", "it", "es"])
def test_all_parts_of_the_debriefing_are_as_far_apart_as_each_other(
    booth: Booth, qtbot: QtBot, language: str, width: int, height: int
) -> None:
    show_debriefing(booth, qtbot, language, width, height)
    lead, card, _, *lines = parts(booth, "PointCard")
    title, way = bounds(booth.item("page-title")), bounds(booth.item("continue"))
    air = [lead.top() - title.bottom(), card.top() - lead.bottom(), lines[0].top() - card.bottom()]
    # On a wide page the code stands beside all of them.
    end = max(line.bottom() for line in lines)
    if width < height:
        (ticket,) = parts(booth, "TakeHomeCard")
        air.append(ticket.top() - end)
        end = ticket.bottom()
    air.append(way.top() - end)
    assert air == pytest.approx([air[1]] * len(air), abs=2)
    assert min(air) >= 24
