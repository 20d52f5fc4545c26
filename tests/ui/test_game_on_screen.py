"""What a visitor sees of a game: cards that turn, pairs that go to the tray, and an answer to every tap."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import QCoreApplication, QObject, QPoint, QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QImage
from PySide6.QtQuick import QQuickItem
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.experiment import effects as do
from kiosk.experiment.effects import BoardWait, Mood
from kiosk.experiment.events import TextSize
from kiosk.game import Position
from kiosk.robots.embodiment import ASIDE, BoardPoint
from kiosk.ui.app import App
from kiosk.ui.renderer import Renderer
from kiosk.ui.screenshots import resize
from kiosk.ui.simulated_visitor import find_item, item_centre, lay_out
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from tests.ui.headless import headless, often
from tests.ui.looking import described, is_ignored, items, lies_in, painted, place

MOVING = RunMode(WindowMode.NOWHERE, ClockMode.WALL, size=(960, 540))
QUIET = {
    moves: often(Settings.model_validate({"voice": {"enabled": False}, "screen": {"motion": moves}}))
    for moves in (True, False)
}
"""Without a voice, with and without motion."""
LEFT, NO_KEY = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
CAT = (Position(1, 1), Position(2, 3))


@pytest.fixture(params=[True, False], ids=["with motion", "without motion"])
def moves(request: pytest.FixtureRequest) -> bool:
    """Whether things move."""
    return bool(request.param)


def in_a_game(app: App) -> App:
    """Return this kiosk in the middle of a game."""
    app.screens.board.deal(4, 6, 12, "animals")
    app.screens.kiosk.show("game")
    app.screens.kiosk.end_input_guard()
    lay_out(app.window)
    return app


@pytest.fixture
def app(qapp: object, tmp_path: Path, moves: bool) -> Iterator[App]:  # noqa: ARG001, FBT001 - fixtures
    """Provide a kiosk in the middle of a game, which moves or stands still."""
    with headless(QUIET[moves], tmp_path, mode=MOVING) as opened:
        yield in_a_game(opened)


@pytest.fixture(scope="module", params=["wide"])
def calm(request: pytest.FixtureRequest, qapp: object, tmp_path_factory: pytest.TempPathFactory) -> Iterator[App]:  # noqa: ARG001 - Qt is to be there
    """Provide one kiosk in this layout that stands still, for all tests that begin no session."""
    with headless(QUIET[False], tmp_path_factory.mktemp("calm"), mode=MOVING) as opened:
        if request.param == "upright":
            resize(opened.window, request.param)
        yield opened


@pytest.fixture
def still(calm: App) -> App:
    """Return that kiosk in the middle of a new game, with nothing left of the test before."""
    calm.screens.clear()
    calm.screens.avatar.appear(present=True)
    calm.screens.kiosk.pause(paused=False)
    return in_a_game(calm)


UPRIGHT = pytest.mark.parametrize("calm", ["upright"], indirect=True)
BOTH = pytest.mark.parametrize("calm", ["wide", "upright"], indirect=True)


def find(app: App, name: str) -> QQuickItem:
    """Return the visible item of this name."""
    item = find_item(app.window.contentItem(), name)
    assert item is not None, name
    return item


def parts(app: App, base: str, *kinds: str) -> list[QQuickItem]:
    """Return the visible items of one of Qt's types in components of ours."""
    return [item for item in items(app.window.contentItem()) if item.inherits(base) and lies_in(item, *kinds)]


def press(app: App, name: str) -> QPoint:
    """Put a finger on an item, and leave it there."""
    place = item_centre(find(app, name))
    QTest.mousePress(app.window, LEFT, NO_KEY, place)
    return place


def looks(app: App, name: str) -> QImage:
    """How an item looks in the next frame."""
    item = find(app, name)
    at = item.mapToScene(item.boundingRect().topLeft()).toPoint()
    return app.window.grabWindow().copy(at.x(), at.y(), int(item.width()), int(item.height()))


def in_tray(app: App) -> list[str]:
    """Return the pictures that lie in the tray, each of them once."""
    pictures = [item for item in items(app.window.contentItem()) if item.inherits("QQuickImage")]
    return list(dict.fromkeys(Path(i.property("source").path()).stem for i in pictures if lies_in(i, "Tray")))


def test_a_pair_comes_to_the_tray_and_stays_on_the_board(app: App, qtbot: QtBot) -> None:
    board = app.screens.board
    assert in_tray(app) == []
    for position in CAT:
        board.reveal(position, "cat")
    board.mark_matched(CAT)
    qtbot.waitUntil(lambda: in_tray(app) == ["cat"])
    assert set(CAT).isdisjoint(board.closed)
    for position in (Position(0, 0), Position(3, 5)):
        board.reveal(position, "owl")
    board.mark_matched((Position(0, 0), Position(3, 5)))
    qtbot.waitUntil(lambda: in_tray(app) == ["cat", "owl"])


def test_two_pairs_in_haste_both_arrive(app: App, qtbot: QtBot) -> None:
    board = app.screens.board
    for number, card in enumerate(("cat", "owl", "bear")):
        places = (Position(0, number), Position(1, number))
        for position in places:
            board.reveal(position, card)
        board.mark_matched(places)
    qtbot.waitUntil(lambda: in_tray(app) == ["cat", "owl", "bear"])


def test_a_new_board_has_an_empty_tray(app: App, qtbot: QtBot) -> None:
    board = app.screens.board
    for position in CAT:
        board.reveal(position, "cat")
    board.mark_matched(CAT)
    board.deal(4, 6, 12, "animals")
    lay_out(app.window)
    assert in_tray(app) == []
    qtbot.waitUntil(lambda: find(app, "card-0").property("up") is False)
    assert in_tray(app) == []


def come_to_rest(app: App, name: str) -> None:
    """Wait until an item looks the same in two frames, well apart."""
    last = looks(app, name)
    for _ in range(100):
        QTest.qWait(50)
        now = looks(app, name)
        if now == last:
            return
        last = now
    raise AssertionError(f"{name} never comes to rest")


@pytest.mark.parametrize("why", [*BoardWait, None])
def test_a_tap_that_does_not_count_is_answered_in_the_next_frame(app: App, why: BoardWait | None) -> None:
    board = app.screens.board
    board.reveal(Position(0, 2), "owl")
    board.lock(why)
    come_to_rest(app, "card-2")
    before = looks(app, "card-2")
    place = press(app, "card-2")
    assert looks(app, "card-2") != before
    QTest.mouseRelease(app.window, LEFT, NO_KEY, place)


# A card that moves cannot be held half way.
def test_a_turning_card_is_as_wide_as_its_shadow(still: App) -> None:
    """No slab of shadow stands where a narrow card is: half way, left and right of its edge there is only paper."""
    face = next(i for i in items(find(still, "card-8")) if i.metaObject().className().startswith("CardFace"))
    paper = still.window.grabWindow().pixelColor(3, 3)
    face.setProperty("turn", 0.5)
    picture = looks(still, "card-8")
    middle = picture.height() // 2
    for across in (0.2, 0.35, 0.65, 0.8):
        assert picture.pixelColor(int(picture.width() * across), middle) == paper, across


def test_the_last_pair_is_a_feast_only_where_things_may_move(app: App, qtbot: QtBot, moves: bool) -> None:  # noqa: FBT001 - a fixture
    board = app.screens.board
    board.deal(1, 2, 1, "animals")
    lay_out(app.window)
    for column in (0, 1):
        board.reveal(Position(0, column), "cat")
    won: list[bool] = []
    view = next(i for i in items(app.window.contentItem()) if i.metaObject().className().startswith("BoardView"))
    _when_won(view, won)
    board.mark_matched((Position(0, 0), Position(0, 1)))
    qtbot.waitUntil(lambda: bool(won))
    snippets = [i for i in items(app.window.contentItem()) if lies_in(i, "Feast")]
    assert (len(snippets) > 10) is moves


def _when_won(view: QObject, won: list[bool]) -> None:
    view.won.connect(lambda: won.append(True))  # type: ignore[attr-defined] # a signal of QML


def test_the_helper_looks_at_the_card_that_is_touched(app: App) -> None:
    face = find(app, "face")
    place = press(app, "card-0")
    assert face.property("gazeX") == -1
    assert face.property("gazeY") < 0
    QTest.mouseRelease(app.window, LEFT, NO_KEY, place)


def test_beside_a_robot_the_board_has_the_whole_width_and_the_sentence_stands_below_it(app: App, qtbot: QtBot) -> None:
    app.screens.avatar.appear(present=False)
    app.screens.avatar.say("The partner is in column 2.")
    lay_out(app.window)
    board = find(app, "board")
    middle = item_centre(board)
    assert abs(middle.x() - app.window.width() / 2) < 0.03 * app.window.width()

    def said() -> list[QQuickItem]:
        return [i for i in items(app.window.contentItem()) if i.property("text") == "The partner is in column 2."]

    qtbot.waitUntil(lambda: len(said()) == 1)
    assert item_centre(said()[0]).y() > board.mapToScene(board.boundingRect().bottomLeft()).y()


def test_cards_that_get_another_size_are_drawn_anew_for_it(app: App, qtbot: QtBot) -> None:
    view = find(app, "board").parentItem()
    before = view.property("cell")
    app.window.setProperty("prepares", True)  # noqa: FBT003 - Qt's own
    app.screens.avatar.appear(present=False)
    qtbot.waitUntil(lambda: view.property("cell") != before)
    qtbot.waitUntil(lambda: view.property("drawnCell") == view.property("cell"))


def renderer(app: App) -> Renderer:
    """Show what a session asks for, without one."""
    return Renderer(app.screens, app.clock, lambda _: None)


def test_the_helper_points_at_the_card_the_row_or_the_column_of_a_hint(app: App) -> None:
    face = find(app, "face")
    assert not face.property("points")
    for row, column in ((0, 5), (None, 2), (3, None)):
        app.screens.board.highlight(row, column)
        assert face.property("points")
        aim = face.mapToScene(face.property("aim"))
        card = find(app, f"card-{6 * (row or 0) + (4 if column is None else column)}")
        size = card.width()
        assert abs(aim.x() - item_centre(card).x()) < size
        assert abs(aim.y() - item_centre(card).y()) < size
    app.screens.board.clear_highlight()
    assert not face.property("points")


@pytest.mark.parametrize("moves", [True], indirect=True)
def test_the_helper_nods_when_the_hinted_card_is_turned_and_at_no_other(app: App) -> None:
    nods: list[str] = []
    app.screens.avatar.gestured.connect(nods.append)
    app.screens.board.highlight(None, 3)
    perform = renderer(app).perform
    perform([do.RevealCard(Position(1, 1), "cat")])
    assert nods == []
    perform([do.RevealCard(Position(2, 3), "cat")])
    assert nods == ["nod"]


@pytest.mark.parametrize("moves", [True], indirect=True)
def test_the_helper_is_glad_at_a_pair_and_thoughtful_at_a_miss_and_calm_again_soon(app: App, qtbot: QtBot) -> None:
    def mood() -> object:
        return app.screens.avatar.property("mood")

    perform = renderer(app).perform
    perform([do.RevealCard(position, "cat") for position in CAT])
    perform([do.MarkMatched(CAT)])
    assert mood() == "happy"
    perform([do.LockBoard(BoardWait.TURNING_BACK)])
    assert mood() == "thinking"
    qtbot.waitUntil(lambda: mood() == "idle")


def test_a_look_holds_the_board_without_a_word_on_the_screen(app: App) -> None:
    board = app.screens.board
    for wait, words in ((BoardWait.SPEAKING, True), (BoardWait.LOOKING, False)):
        renderer(app).perform([do.LockBoard(wait)])
        shown = find_item(app.window.contentItem(), "pill") is not None
        assert (board.accepts_taps, shown, board.property("speaking")) == (False, words, words)


@pytest.mark.parametrize("moves", [True], indirect=True)
def test_the_eyes_of_the_helper_follow_the_pointer(app: App) -> None:
    face = find(app, "face")
    QTest.mouseMove(app.window, QPoint(10, 10))
    QTest.mouseMove(app.window, QPoint(20, 20))
    assert face.property("gazeX") == -1
    QTest.mouseMove(app.window, item_centre(face) + QPoint(60, 0))
    assert 0 < face.property("gazeX") < 1


def test_the_helper_leaves_the_screen_while_it_is_rated_and_only_then(app: App, qtbot: QtBot) -> None:
    def seen() -> bool:
        return find_item(app.window.contentItem(), "face") is not None

    body, shown = Watcher(), renderer(app)
    shown.embodiments = SimpleNamespace(current=body)  # type: ignore[assignment] # all that is asked of it
    perform = shown.perform
    perform([do.ShowItems((), 1, 1)])
    assert seen()
    perform([do.ShowItems((), 1, 2, rates=True), do.ShowItems((), 2, 2, rates=True)])
    qtbot.waitUntil(lambda: not seen())
    assert body.looked == [ASIDE]
    perform([do.ShowThanks()])
    qtbot.waitUntil(seen)
    assert body.looked == [ASIDE, None]


class Watcher:
    """A body of which only is kept where it looks."""

    def __init__(self) -> None:
        self.looked: list[BoardPoint | None] = []

    def look_at(self, place: BoardPoint | None) -> None:
        """Look there."""
        self.looked.append(place)


@pytest.mark.parametrize("moves", [True], indirect=True)
def test_the_helper_has_the_name_of_the_study_file_and_may_have_none(app: App, qtbot: QtBot) -> None:
    def names() -> list[QQuickItem]:
        return [item for item in items(app.window.contentItem()) if item.property("text") == "Memo"]

    app.screens.avatar.say("Look at column 2.")
    qtbot.waitUntil(lambda: len(names()) == 1)
    app.screens.avatar.call("")
    assert names() == []


GONE = (Position(0, 0), Position(0, 1))


def test_a_hint_is_announced_only_until_it_is_read_or_seen(still: App) -> None:
    def announced() -> bool:
        return find_item(still.window.contentItem(), "pill") is not None

    board = still.screens.board
    assert not announced()
    board.lock(BoardWait.SPEAKING)
    assert announced()
    still.screens.avatar.say("Look at column 2.")
    assert not announced()
    still.screens.avatar.say("")
    board.highlight(None, 1)
    assert not announced()
    still.screens.avatar.say("Let us practise first.")
    board.lock(BoardWait.TURNING_BACK)
    assert announced()


def test_cards_that_are_no_pair_are_framed_until_they_turn_back(still: App) -> None:
    def framed() -> list[int]:
        return [n for n in range(24) if find_item(still.window.contentItem(), f"missed-{n}") is not None]

    def rimmed() -> list[int]:
        return [n for n in range(24) if find_item(find(still, f"card-{n}"), "rim") is not None]

    board = still.screens.board
    for position, card in zip(CAT, ("cat", "owl"), strict=True):
        board.reveal(position, card)
    assert framed() == []
    board.lock(BoardWait.TURNING_BACK)
    assert framed() == [board.location(position) for position in CAT]
    # A line with gaps, instead of the rim of an open card.
    assert rimmed() == []
    for n in framed():
        (line,) = (i for i in items(find(still, f"missed-{n}")) if i.inherits("QQuickShape"))
        assert abs(line.width() * line.parentItem().scale() - 0.962 * card_width(find(still, f"card-{n}"))) < 1
    board.hide(CAT)
    board.lock(None)
    assert framed() == rimmed() == []
    board.reveal(CAT[0], "cat")
    assert (framed(), rimmed()) == ([], [board.location(CAT[0])])


def test_the_first_sentence_of_a_practice_goes_with_the_first_card_and_can_be_heard_again(still: App) -> None:
    def said() -> list[str]:
        bubbles = (i for i in items(still.window.contentItem()) if lies_in(i, "Bubble"))
        return [i.property("text") for i in bubbles if i.property("text") and i.property("text") != "Memo"]

    def bold() -> bool:
        bubbles = (i for i in items(still.window.contentItem()) if lies_in(i, "Bubble"))
        return [i.property("font").bold() for i in bubbles if [i.property("text")] == said()] == [True]

    board, avatar = still.screens.board, still.screens.avatar
    board.deal(3, 4, 6, "animals", practice=True)
    still.screens.kiosk.show("practice")
    avatar.say("Let us practise first.")
    assert (said(), bold()) == (["Let us practise first."], False)
    board.reveal(Position(0, 0), "cat")
    assert (said(), bold()) == (["Now turn over a second card."], True)
    board.reveal(Position(0, 1), "cat")
    board.mark_matched(GONE)
    assert (said(), bold()) == (["A pair!"], True)
    still.screens.kiosk.sayAgain()
    assert (said(), bold()) == (["Let us practise first."], False)
    avatar.say("Look at column 2.")
    assert (said(), bold()) == (["Look at column 2."], False)


def in_bubble(app: App) -> list[QQuickItem]:
    """Return the texts in the helper's bubble from above, without its name."""
    shown = (i for i in items(app.window.contentItem()) if lies_in(i, "Bubble") and i.isVisible())
    texts = [i for i in shown if i.property("text") not in {"", "Memo", None}]
    return sorted(texts, key=lambda text: text.mapToScene(QPointF(0, 0)).y())


def letters(text: QQuickItem) -> QFont:
    """Return the font of a text."""
    font = text.property("font")
    assert isinstance(font, QFont)
    return font


@BOTH
def test_what_to_do_is_said_last_stands_first_and_is_told_once(still: App) -> None:
    def told() -> list[tuple[str, bool]]:
        return [(str(text.property("text")), letters(text).bold()) for text in in_bubble(still)]

    avatar = still.screens.avatar
    still.screens.board.deal(3, 4, 6, "animals")
    still.screens.kiosk.show("game")
    avatar.say("You have seen it. Try row 2.", "Try row 2.")
    assert told() == [("Try row\u00a02.", True), ("You have seen it.", False)]
    place, reason = in_bubble(still)
    assert letters(place).pixelSize() > 1.25 * letters(reason).pixelSize()
    assert place.mapToScene(QPointF(0, place.height())).y() <= reason.mapToScene(QPointF(0, 0)).y()
    inside = (i for i in items(still.window.contentItem()) if lies_in(i, "Bubble") and not is_ignored(i))
    assert [text for _, text in map(described, inside) if "Try" in text] == ["You have seen it. Try row 2."]
    alone = letters(place).pixelSize()
    avatar.say("Try row 2.", "Try row 2.")
    assert told() == [("Try row\u00a02.", True)]
    # With a reason or without, in every condition.
    assert letters(in_bubble(still)[0]).pixelSize() == alone
    avatar.say("你见过它。看第二行。", "看第二行。")
    assert told() == [("看第二行。", True), ("你见过它。", False)]
    avatar.say("You have seen it.")
    assert told() == [("You have seen it.", False)]


@BOTH
def test_every_sentence_that_says_what_to_do_is_bold_and_larger_than_others(still: App) -> None:
    def size() -> int:
        (text,) = in_bubble(still)
        assert letters(text).bold()
        return letters(text).pixelSize()

    board, screens = still.screens.board, still.screens
    screens.avatar.say("You can turn over any card that you like, and then another one.")
    usual = letters(in_bubble(still)[0])
    assert not usual.bold()
    screens.avatar.say("")
    board.deal(3, 4, 6, "animals")
    screens.kiosk.show("game")
    assert size() > 1.2 * usual.pixelSize()
    board.reveal(Position(0, 0), "cat")
    pill = find(still, "pill")
    assert [letters(i).bold() for i in items(pill) if i.inherits("QQuickText")] == [True]
    board.deal(3, 4, 6, "animals", practice=True)
    screens.kiosk.show("practice")
    assert size() > 1.2 * usual.pixelSize()
    board.reveal(Position(0, 0), "cat")
    assert size() > 1.2 * usual.pixelSize()


@pytest.mark.parametrize(
    ("advice", "shown"),
    [
        ("Look for its partner in row 2, column 1.", "Look for its partner in\u00a0row\u00a02, column\u00a01."),
        ("Busca la otra en la fila 2, columna 1.", "Busca la otra en\u00a0la\u00a0fila\u00a02, columna\u00a01."),
        ("Prova la carta della colonna 4, adesso.", "Prova la carta della colonna\u00a04, adesso."),
        ("It is your turn. Turn over any card.", "It is your turn.\nTurn over any card."),
        ("Try a card.", "Try a card."),
    ],
)
def test_no_line_ends_between_a_place_and_its_number(advice: str, shown: str, still: App) -> None:
    still.screens.board.deal(3, 4, 6, "animals")
    still.screens.kiosk.show("game")
    still.screens.avatar.say(advice, advice)
    assert [text.property("text") for text in in_bubble(still)] == [shown]
    # Large letters leave less room for what stays together.
    still.window.setProperty("textSize", 1.5)
    try:
        (text,) = in_bubble(still)
        assert text.property("text").split() == shown.split()
        assert not re.search(r" \d", text.property("text"))
        assert text.property("contentWidth") <= text.width()
    finally:
        still.window.setProperty("textSize", 1)


@UPRIGHT
def test_a_few_words_are_larger_than_many_in_an_upright_bubble(still: App) -> None:
    def size(sentence: str) -> tuple[int, int]:
        still.screens.avatar.say(sentence)
        bubbles = (i for i in items(still.window.contentItem()) if lies_in(i, "Bubble"))
        (words,) = (i for i in bubbles if i.property("text") == sentence)
        return words.property("font").pixelSize(), words.property("lineCount")

    few, lines = size("Turn over any card.")
    many, _ = size("You can turn over any card that you like, and then another one.")
    assert lines == 1
    assert few > 1.2 * many


def test_the_helper_says_whose_turn_it_is_until_a_card_is_turned(still: App) -> None:
    def said() -> list[str]:
        bubbles = (i for i in items(still.window.contentItem()) if lies_in(i, "Bubble"))
        return [i.property("text") for i in bubbles if i.property("text") and i.property("text") != "Memo"]

    still.screens.board.deal(3, 4, 6, "animals")
    still.screens.kiosk.show("game")
    assert said() == ["It is your turn.\nTurn over any card."]
    still.screens.board.reveal(Position(0, 0), "cat")
    assert said() == []


def test_while_one_card_is_up_and_the_helper_is_silent_the_screen_asks_for_a_second(still: App) -> None:
    def asked() -> bool:
        pill = find_item(still.window.contentItem(), "pill")
        return pill is not None and any(i.property("text") == "Now a second card" for i in items(pill))

    board, avatar = still.screens.board, still.screens.avatar
    board.deal(3, 4, 6, "animals")
    still.screens.kiosk.show("game")
    assert not asked()
    board.reveal(Position(0, 0), "cat")
    assert asked()
    avatar.say("Look at column 2.")
    assert not asked()
    avatar.clear()
    assert asked()
    board.highlight(None, 1)
    assert not asked()
    board.clear_highlight()
    board.reveal(Position(0, 1), "cat")
    assert not asked()


@BOTH
@pytest.mark.parametrize("size", [TextSize.NORMAL, TextSize.LARGEST])
def test_the_cards_keep_their_size_whatever_stands_below_them(still: App, size: TextSize) -> None:
    """Not even for a moment: each change lays all cards out anew, before the frame in which a tap is answered."""
    board, screens = still.screens.board, still.screens
    screens.kiosk.set_text_size(size)
    screens.avatar.appear(present=False)
    board.deal(4, 6, 12, "animals")
    screens.kiosk.show("game")
    lay_out(still.window)
    grid, changes, said = find(still, "board"), list[float](), set[str]()
    grid.widthChanged.connect(lambda: changes.append(grid.width()))
    grid.heightChanged.connect(lambda: changes.append(grid.height()))
    board.reveal(Position(0, 0), "cat")
    for wait in (None, BoardWait.SPEAKING, None, BoardWait.TURNING_BACK, None):
        board.lock(wait)
        lay_out(still.window)
        said |= {i.property("text") for i in items(find(still, "pill")) if i.inherits("QQuickText")}
    assert changes == []
    assert len(said) == 3
    # The room below the cards is enough for each of them.
    lowest = max(place(find(still, f"card-{n}")).bottom() for n in range(24))
    assert lowest <= place(find(still, "pill")).top()


def test_in_a_practice_the_helper_tells_how_a_move_goes_on(still: App) -> None:
    def said() -> set[str]:
        return {str(i.property("text")) for i in items(still.window.contentItem()) if i.property("text")}

    board, screens = still.screens.board, still.screens
    board.deal(3, 4, 6, "animals", practice=True)
    screens.kiosk.show("practice")
    board.reveal(Position(0, 0), "cat")
    assert "Now turn over a second card." in said()
    assert "Now a second card" not in said()
    screens.avatar.appear(present=False)
    assert "Now turn over a second card." not in said()
    assert "Now a second card" in said()
    board.lock(BoardWait.TURNING_BACK)
    assert "One moment, the cards turn back" in said()
    screens.avatar.appear(present=True)
    assert said() >= {"Not a pair.", "One moment, the cards turn back."}
    assert "One moment, the cards turn back" not in said()
    board.lock(None)
    board.reveal(Position(0, 1), "cat")
    board.mark_matched(GONE)
    assert "A pair!" in said()
    board.lock(BoardWait.SPEAKING)
    assert "A pair!" not in said()


def test_a_pair_keeps_its_size_until_another_card_is_turned(still: App) -> None:
    board = still.screens.board
    for position in GONE:
        board.reveal(position, "cat")
    board.mark_matched(GONE)
    large = [find(still, f"card-{board.location(position)}") for position in GONE]
    assert [card.property("fresh") for card in large] == [1, 1]
    for card, position in zip(large, GONE, strict=True):
        # Two frames beside each other have some of the page between them.
        assert find(still, f"found-{board.location(position)}").property("width") < 0.96 * card.property("width")
    board.reveal(Position(1, 0), "owl")
    assert [card.property("fresh") for card in large] == [0, 0]


@pytest.mark.parametrize("mark", [(0, None), (None, 0), (1, 2)], ids=["row", "column", "card"])
def test_a_hint_makes_the_frames_of_found_cards_thin(still: App, mark: tuple[int | None, int | None]) -> None:
    board = still.screens.board
    for position in GONE:
        board.reveal(position, "cat")
    board.mark_matched(GONE)
    cards = [find(still, f"card-{board.location(position)}") for position in GONE]
    frames = [find(still, f"found-{board.location(position)}") for position in GONE]

    def rims() -> set[float]:
        faces = [
            next(part for part in card.childItems() if part.metaObject().className().startswith("CardFace"))
            for card in cards
        ]
        return {
            round((frame.width() - face.width() * face.scale()) / 2) for frame, face in zip(frames, faces, strict=True)
        }

    (wide,) = rims()
    board.highlight(*mark)
    (thin,) = rims()
    assert 2 <= thin < wide
    board.clear_highlight()
    assert rims() == {wide}


@pytest.mark.parametrize("moves", [True], indirect=True)
def test_snippets_of_the_feast_never_fall_in_one_line(app: App) -> None:
    """Of those that are seen at one time, no tenth of the height has a third."""
    feast = next(i for i in items(app.window.contentItem()) if i.metaObject().className().startswith("Feast"))
    feast.begin()  # type: ignore[attr-defined] # a function of QML
    for moment in (0.3, 0.4, 0.47, 0.55):
        feast.setProperty("time", moment)
        tops = [item.y() / feast.height() for item in feast.childItems()]
        seen = [top for top in tops if 0 <= top <= 1]
        assert len(seen) > 48
        fullest = max(sum(tenth <= 10 * top < tenth + 1 for top in seen) for tenth in range(10))
        assert fullest < len(seen) / 3, moment


@UPRIGHT
def test_on_an_upright_screen_the_helper_stands_close_to_the_board(still: App) -> None:
    board, face = find(still, "board"), find(still, "face")
    bottom = board.mapToScene(board.boundingRect().bottomLeft()).y()
    top = face.mapToScene(face.boundingRect().topLeft()).y()
    assert bottom < top < bottom + 0.25 * still.window.height()


@UPRIGHT
def test_on_an_upright_screen_the_columns_numbers_stand_nearer_to_the_cards_than_to_the_tray(still: App) -> None:
    shown = list(items(still.window.contentItem()))
    tray = max(place(item).bottom() for item in shown if lies_in(item, "Tray"))
    number = painted(min((item for item in shown if item.property("text") == "1"), key=lambda item: place(item).top()))
    assert number.top() - tray > place(find(still, "card-0")).top() - number.bottom() > 0


@pytest.mark.parametrize("right", [False, True], ids=["board at the left", "board at the right"])
def test_on_a_wide_screen_cards_and_bubble_are_as_far_from_the_edges_and_further_from_each_other(
    still: App,
    right: bool,  # noqa: FBT001 - a parameter
) -> None:
    still.window.setProperty("boardOnRight", right)
    try:
        lay_out(still.window)
        said = place(parts(still, "QQuickRectangle", "Bubble")[0])
        numbers = parts(still, "QQuickText", "BoardTable")
        left = min(painted(number).left() for number in numbers)
        last = place(find(still, "card-5"))
        end = last.center().x() + card_width(find(still, "card-5")) * 0.962 / 2
    finally:
        still.window.setProperty("boardOnRight", False)  # noqa: FBT003 - Qt's own
    unit = still.window.height() / 1080
    width = still.window.width()
    outside, between = ((width - end), left - said.right()) if right else (left, said.left() - end)
    other = said.left() if right else width - said.right()
    assert abs(outside - other) < 8 * unit
    assert between > max(1.5 * outside, 64 * unit)


@pytest.mark.parametrize("practice", [True, False])
@BOTH
def test_the_numbers_of_rows_and_columns_stand_close_to_the_cards(still: App, practice: bool) -> None:  # noqa: FBT001 - a parameter
    if practice:
        still.screens.board.deal(3, 4, 6, "animals", practice=True)
        still.screens.kiosk.show("practice")
        lay_out(still.window)
    unit = min(still.window.width(), still.window.height()) / 1080
    card = place(find(still, "card-0")).toRectF()
    side = card_width(find(still, "card-0")) * 0.962 / 2
    numbers = parts(still, "QQuickText", "BoardTable")
    ones = [number for number in numbers if number.property("text") == "1"]
    column, row = painted(min(ones, key=lambda one: one.y())), painted(min(ones, key=lambda one: one.x()))
    assert 0 < card.center().y() - side - column.bottom() < 32 * unit
    assert 12 * unit < card.center().x() - side - row.right() < 32 * unit


@UPRIGHT
def test_on_an_upright_screen_the_tray_is_as_wide_as_the_cards_with_their_rows_numbers(still: App) -> None:
    tray = place(next(item for item in items(still.window.contentItem()) if lies_in(item, "Tray")))
    first, last = place(find(still, "card-0")), place(find(still, "card-5"))
    number = painted(
        max((i for i in items(still.window.contentItem()) if i.property("text") == "1"), key=lambda i: place(i).top())
    )
    assert abs(tray.left() - 20 * still.window.width() / 1080) < 4
    assert tray.left() <= number.left() < number.right() < first.left()
    assert last.center().x() < tray.right() <= last.right()
    assert tray.height() / 2 < 0.75 * first.height()


@UPRIGHT
def test_on_an_upright_screen_the_tray_shows_pairs_in_two_rows_and_the_cards_are_as_wide_as_there_is_room(
    still: App,
) -> None:
    tray = next(item for item in items(still.window.contentItem()) if lies_in(item, "Tray"))
    board = next(item for item in items(still.window.contentItem()) if lies_in(item, "BoardView"))
    assert (tray.property("lines"), tray.property("paired")) == (2, True)
    assert board.property("cell") == int(board.property("widest"))
    # The board stands about in the middle between the tray and what is said.
    number = painted(min((i for i in items(board) if i.property("text") == "1"), key=lambda i: place(i).top()))
    said = min(place(i).top() for i in parts(still, "QQuickRectangle", "Bubble"))
    above, below = number.top() - place(tray).bottom(), said - place(find(still, "card-23")).bottom()
    assert 0.55 * below < above < 1.15 * below


@UPRIGHT
def test_on_a_lower_upright_screen_the_tray_has_one_row_and_the_cards_keep_their_size(still: App) -> None:
    still.window.resize(800, 1280)
    QCoreApplication.processEvents()
    try:
        lay_out(still.window)
        tray = next(item for item in items(still.window.contentItem()) if lies_in(item, "Tray"))
        board = next(item for item in items(still.window.contentItem()) if lies_in(item, "BoardView"))
        assert tray.property("lines") == 1
        assert board.property("cell") == int(board.property("widest"))
    finally:
        resize(still.window, "upright")
        lay_out(still.window)


@pytest.mark.parametrize("calm", ["upright", "wide"], indirect=True)
def test_no_control_moves_when_a_sentence_can_be_heard_again(still: App) -> None:
    still.screens.kiosk.begin(["en"], "en", QUIET[False].consent)
    lay_out(still.window)
    stop = find(still, "control-stop")
    before = place(stop)
    still.screens.avatar.say("Look at column 2.")
    lay_out(still.window)
    assert find(still, "control-say-again").isVisible()
    assert place(stop) == before


@UPRIGHT
def test_the_stop_button_is_in_the_corner_and_the_others_above_it_on_an_upright_screen(still: App) -> None:
    still.screens.kiosk.begin(["en", "it"], "en", QUIET[False].consent)
    still.screens.avatar.say("Look at column 2.")
    names = ("control-say-again", "control-text-size", "control-language", "control-stop")
    places = [place(find(still, name)) for name in names]
    assert places == sorted(places, key=lambda one: one.top())
    assert len({one.left() for one in places}) == 1


def test_in_a_pause_the_helper_is_seen_with_its_eyes_shut_and_says_nothing(still: App) -> None:
    still.screens.avatar.say("Look at column 2.")
    still.screens.avatar.feel(Mood.HAPPY)
    still.screens.kiosk.pause(paused=True)
    face = find(still, "face")
    assert (face.property("blinking"), face.property("mood")) == (True, "idle")
    assert not [i for i in items(still.window.contentItem()) if lies_in(i, "Bubble") and i.property("text")]
    still.screens.kiosk.pause(paused=False)
    assert not face.property("blinking")


def find_all(app: App, pairs: int = 2) -> None:
    """Deal so many pairs in two columns, and find them one after another; no pair lies side by side."""
    board = app.screens.board
    board.deal(pairs, 2, pairs, "animals")
    lay_out(app.window)
    for row, card in enumerate(("cat", "owl", "fox")[:pairs]):
        places = (Position(row, 0), Position((row + 1) % pairs, 1))
        for position in places:
            board.reveal(position, card)
        board.mark_matched(places)


@BOTH
def test_the_last_pair_stays_forward_until_other_cards_are_dealt(still: App) -> None:
    find_all(still)
    assert [find(still, f"card-{i}").property("proud") for i in range(4)] == [0, 1, 1, 0]
    still.screens.board.deal(2, 2, 2, "animals")
    assert {find(still, f"card-{i}").property("proud") for i in range(4)} == {0}


def card_width(card: QQuickItem) -> float:
    """Return how wide a card's face is seen."""
    (face,) = (i for i in card.childItems() if i.property("rimShown") is not None)
    return face.width() * face.scale()


@BOTH
def test_at_the_end_the_last_pair_is_larger_and_the_frames_of_the_others_get_thin(still: App) -> None:
    board = still.screens.board
    find_all(still, pairs=3)
    cards = [find(still, f"card-{i}") for i in range(6)]
    last = [card for card in cards if card.property("closes")]
    others = [card for card in cards if card not in last]
    assert (len(last), len(others)) == (2, 4)
    assert min(map(card_width, last)) > 1.03 * max(map(card_width, others))
    assert min(card.z() for card in last) > max(card.z() for card in others)
    unit = min(still.window.width(), still.window.height()) / 1080
    for card in others:
        frame = find(still, f"found-{card.property('index')}")
        assert 3 * unit < (frame.width() - 0.962 * card_width(card)) / 2 < 7 * unit
        # The last pair laps no other.
        for index in (each.property("index") for each in last):
            assert not place(frame).intersects(place(find(still, f"last-{index}")))
    # Nothing is looked for any more: rows and columns have no numbers, and upright, the cards stand in the middle.
    assert parts(still, "QQuickText", "BoardTable") == []
    if still.window.height() > still.window.width():
        outer = place(cards[0]).left(), still.window.width() - place(cards[1]).right()
        assert abs(outer[0] - outer[1]) <= 2
    board.deal(3, 2, 3, "animals")
    assert len(parts(still, "QQuickText", "BoardTable")) == 3 + 2


@BOTH
@pytest.mark.parametrize("last", [(Position(0, 0), Position(0, 1)), (Position(0, 1), Position(1, 1))])
def test_a_last_pair_that_lies_side_by_side_is_not_covered_by_its_frames(
    still: App, last: tuple[Position, Position]
) -> None:
    board = still.screens.board
    board.deal(2, 2, 2, "animals")
    lay_out(still.window)
    first = tuple(at for at in (Position(i // 2, i % 2) for i in range(4)) if at not in last)
    for pair, picture in ((first, "cat"), (last, "owl")):
        for position in pair:
            board.reveal(position, picture)
        board.mark_matched((pair[0], pair[1]))
    one, other = (board.location(position) for position in last)
    card = find(still, f"card-{one}")
    reach = (find(still, f"last-{other}").width() + 0.962 * card_width(card)) / 2
    assert reach <= card.width() + 1
    assert card_width(card) > 1.02 * card_width(find(still, f"card-{board.location(first[0])}"))


@BOTH
def test_that_all_are_found_is_said_larger_than_that_a_pair_is(still: App) -> None:
    def cheer() -> int:
        (text,) = in_bubble(still)
        assert text.property("lineCount") == 1
        return letters(text).pixelSize()

    board = still.screens.board
    board.deal(3, 4, 6, "animals", practice=True)
    still.screens.kiosk.show("practice")
    for position in GONE:
        board.reveal(position, "cat")
    board.mark_matched(GONE)
    pair = cheer()
    still.screens.kiosk.show("game")
    find_all(still)
    assert cheer() > 1.2 * pair


def frames(app: App) -> list[QRect]:
    """Return what a hint's mark encloses."""
    return sorted(map(place, parts(app, "QQuickRectangle", "Mark")), key=lambda frame: (frame.top(), frame.left()))


@BOTH
def test_a_mark_makes_no_card_smaller_and_is_seen_around_it(still: App) -> None:
    card = find(still, "card-8")
    before = card_width(card)
    for row, column in ((1, 2), (1, None), (None, 2)):
        still.screens.board.highlight(row, column)
        assert card_width(card) == before
        (frame,) = frames(still)
        middle = place(card).center()
        side = 0.962 * before / 2
        around = side + 8 * min(still.window.width(), still.window.height()) / 1080
        assert frame.contains(QRectF(middle.x() - around, middle.y() - around, 2 * around, 2 * around).toRect())


@BOTH
@pytest.mark.parametrize("size", [1, 1.15, 1.5])
def test_the_band_of_a_row_or_a_column_begins_at_its_number(still: App, size: float) -> None:
    still.window.setProperty("textSize", size)
    try:
        for mark, cards in ((1, None), [6, 7, 8, 9, 10, 11]), ((None, 3), [3, 9, 15, 21]):
            still.screens.board.highlight(*mark)
            lay_out(still.window)
            (frame,) = frames(still)
            # Without the air above and below a digit.
            lines = [painted(number) for number in parts(still, "QQuickText", "BoardTable")]
            numbers = [line.adjusted(0, line.height() // 5, 0, -line.height() // 5) for line in lines]
            inside = still.window.contentItem().boundingRect().toRect()
            assert len([number for number in numbers if frame.contains(number)]) == 1
            assert len([number for number in numbers if frame.intersects(number)]) == 1
            assert inside.contains(frame)
            centres = [place(find(still, f"card-{i}")).center() for i in range(24)]
            assert [i for i, at in enumerate(centres) if frame.contains(at)] == cards
    finally:
        still.window.setProperty("textSize", 1)


@BOTH
def test_a_marked_card_has_a_frame_and_nothing_else(still: App) -> None:
    still.screens.board.highlight(1, 2)
    (frame,) = frames(still)
    assert [i for i in range(24) if frame.intersects(place(find(still, f"card-{i}")).adjusted(9, 9, -9, -9))] == [8]
    assert parts(still, "QQuickShape", "Mark") == []


@BOTH
@pytest.mark.parametrize(
    ("opened", "mark", "apart"),
    [
        (Position(0, 3), (None, 3), [3]),
        (Position(2, 3), (2, None), [15]),
        (Position(2, 3), (1, None), []),
        (Position(2, 3), (1, 3), []),
        (None, (None, 3), []),
    ],
)
def test_in_a_marked_line_the_open_card_lies_apart(
    still: App, opened: Position | None, mark: tuple[int | None, int | None], apart: list[int]
) -> None:
    board = still.screens.board
    if opened is not None:
        board.reveal(opened, "cat")
    board.highlight(*mark)
    root = still.window.contentItem()
    assert [i for i in range(24) if find_item(root, f"mat-{i}") is not None] == apart
    for i in apart:
        assert find(still, f"mat-{i}").width() > 0.962 * card_width(find(still, f"card-{i}")) + 6


@pytest.mark.parametrize("calm", ["wide", "upright"], indirect=True)
def test_what_the_helper_says_begins_with_its_name_or_stands_below_the_middle_of_it(still: App) -> None:
    def shares_middle(text: QQuickItem, name: QQuickItem) -> bool:
        return abs(painted(text).center().x() - painted(name).center().x()) < 4

    def shares_edge(text: QQuickItem, name: QQuickItem) -> bool:
        return abs(painted(text).left() - painted(name).left()) < 8

    upright = still.window.height() > still.window.width()
    board, avatar = still.screens.board, still.screens.avatar
    board.deal(3, 4, 6, "animals", practice=True)
    still.screens.kiosk.show("practice")
    seen = set()

    def look() -> None:
        lay_out(still.window)
        (name,) = (i for i in parts(still, "QQuickText", "Bubble") if i.property("text") == "Memo")
        for text in in_bubble(still):
            seen.add(text.property("text"))
            assert shares_middle(text, name) if upright else shares_edge(text, name), text.property("text")

    board.reveal(Position(0, 0), "cat")
    look()
    board.reveal(Position(0, 1), "owl")
    board.lock(BoardWait.TURNING_BACK)
    look()
    board.lock(None)
    avatar.say("This is new. Look at column 2.", "Look at column 2.")
    look()
    assert len(seen) >= 5


def test_the_time_left_to_say_that_one_is_there_is_shown_where_it_is_known(still: App) -> None:
    def shows_time() -> bool:
        return any(i.objectName() == "time-left" and i.isVisible() for i in items(still.window.contentItem()))

    kiosk = still.screens.kiosk
    kiosk.ask_still_there(asks=True, wait_ms=20_000)
    assert shows_time()
    seconds = find(still, "seconds-left")
    assert seconds.property("text") in {"20", "19"}
    unit = find(still, "seconds-unit")
    assert unit.property("text") == "seconds"
    # What is to be pressed in a hurry is wide.
    assert place(find(still, "still-here")).width() > 0.5 * place(find(still, "calm-card")).width()
    # A screen reader would speak every second.
    assert is_ignored(seconds)
    assert is_ignored(unit)
    kiosk.ask_still_there(asks=False)
    kiosk.ask_still_there(asks=True, wait_ms=900)
    assert [seconds.property("text"), unit.property("text")] == ["1", "second"]
    kiosk.ask_still_there(asks=False)
    kiosk.ask_still_there(asks=True)
    assert not shows_time()


@BOTH
def test_the_seconds_to_say_that_one_is_there_are_read_from_afar(still: App) -> None:
    still.screens.kiosk.ask_still_there(asks=True, wait_ms=20_000)
    lay_out(still.window)
    number, unit = find(still, "seconds-left"), find(still, "seconds-unit")
    disc = number.parentItem()
    assert disc is not None
    upright = still.window.height() > still.window.width()
    scale = min(still.window.height(), still.window.width()) / 1080
    assert disc.width() / scale == pytest.approx(320 if upright else 240, abs=1)
    assert number.property("font").pixelSize() / scale >= (85 if upright else 95)
    assert unit.property("font").pixelSize() / scale >= 35
    # Both together are in the middle of it: the number without the air above it, the unit without what hangs below it.
    above = painted(number).top() + QFontMetricsF(number.property("font")).ascent()
    above -= QFontMetricsF(number.property("font")).capHeight()
    below = painted(unit).top() + QFontMetricsF(unit.property("font")).ascent()
    assert (above + below) / 2 == pytest.approx(place(disc).center().y(), abs=4)


def test_going_on_stands_where_the_way_on_does_and_has_the_keyboard(still: App) -> None:
    still.screens.kiosk.ask("stop")
    lay_out(still.window)
    on, stop = find(still, "stop-no"), find(still, "stop-yes")
    assert place(on).left() > place(stop).right()
    assert on.property("focus")


def test_behind_a_question_the_helper_listens(still: App) -> None:
    still.screens.avatar.feel(Mood.HAPPY)
    face = find(still, "face")
    assert face.property("mood") == "happy"
    still.screens.kiosk.ask("stop")
    assert face.property("mood") == "listening"
    still.screens.kiosk.ask("")
    still.screens.kiosk.ask_still_there(asks=True)
    assert face.property("mood") == "listening"


def test_dots_tell_how_far_a_visit_is(still: App) -> None:
    kiosk = still.screens.kiosk
    kiosk.begin(["en"], "en", QUIET[False].consent)
    kiosk.reach("about")
    assert (kiosk.property("step"), kiosk.property("steps")) == (0, 5)
    kiosk.reach("questions")
    assert find(still, "progress").property("step") == 3
    kiosk.plan(("introduction", "game", "debrief"))
    kiosk.reach("result")
    assert (kiosk.property("step"), kiosk.property("steps")) == (1, 3)
    kiosk.clear()
    assert find_item(still.window.contentItem(), "progress") is None
