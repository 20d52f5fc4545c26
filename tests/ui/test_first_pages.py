"""What is read before the game: headings that tell the page at a glance, and drawings that stand even."""

from __future__ import annotations

from itertools import pairwise

import pytest
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QFontMetricsF
from PySide6.QtQuick import QQuickItem
from pytestqt.qtbot import QtBot

from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS
from kiosk.experiment.information import Information
from kiosk.ui.simulated_visitor import lay_out
from tests.samples import CATALOGUES, ENGLISH
from tests.ui.conftest import Booth
from tests.ui.looking import items, lies_in, place, texts

GERMAN = ASSETS / "templates" / "two-languages"
WORDS = CATALOGUES | {"de": Catalogue(GERMAN / "de"), "ar": ENGLISH}
LANGUAGES = ("en", "it", "es", "de")
SIZES = [(1920, 1080), (1080, 1920)]


@pytest.fixture
def booth(resting_booth: Booth) -> Booth:
    """Return the booth that all tests of this module share."""
    return resting_booth


def shown(booth: Booth, qtbot: QtBot, screen: str, size: tuple[int, int], language: str = "en") -> QQuickItem:
    """Show a page in a window of this size; return what holds all of it."""
    window, screens = booth.app.window, booth.app.screens
    screens.set_language(WORDS[language])
    screens.kiosk.begin((language,), language, booth.app.assigner.study.settings.consent)
    screens.kiosk.offer_back(offered=screen != "about")
    folder = GERMAN / "information" if language == "de" else ASSETS / "consent" / "study"
    screens.about.show(Information.of(folder, "en" if language == "ar" else language).about)
    screens.age.ask(18)
    screens.kiosk.show(screen)
    window.resize(*size)
    qtbot.waitUntil(lambda: window.contentItem().width() == size[0])
    booth.settle()
    lay_out(window)
    ground: QQuickItem = window.contentItem()
    return ground


def those(ground: QQuickItem, kind: str) -> list[QQuickItem]:
    """Return the outermost items of one of our own components that are to be seen, in their order."""
    found = [item for item in items(ground) if item.metaObject().className().partition("_QML")[0] == kind]
    return [item for item in found if item.parentItem() is None or not lies_in(item.parentItem(), kind)]


def edges(item: QQuickItem) -> QRectF:
    """Where an item is in the window, also if it is turned or scaled."""
    return item.mapRectToScene(QRectF(0, 0, item.width(), item.height()))


def pixels(text: QQuickItem) -> int:
    """How large the letters of a text are."""
    return int(text.property("font").pixelSize())


def capitals_top(text: QQuickItem) -> float:
    """Where the capitals of a text's first line begin in the window."""
    letters = QFontMetricsF(text.property("font"))
    return edges(text).top() + letters.ascent() - letters.capHeight()


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
def test_each_row_of_the_first_page_is_a_bold_heading_over_smaller_plain_words(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], language: str
) -> None:
    rows = those(shown(booth, qtbot, "about", size, language), "SignedLine")
    # On a wide page the helper says the last one.
    assert len(rows) == (4 if size[0] > size[1] else 5)
    looks = set()
    for row in rows:
        heading, words = texts(row)
        assert heading.property("font").bold()
        assert not words.property("font").bold()
        assert heading.property("lineCount") == 1
        looks.add((pixels(heading), pixels(words)))
    ((of_headings, of_words),) = looks
    assert of_headings >= 48
    assert of_words >= (42 if language == "en" else 38)
    # The drawings are even, and each heading stands at the same place beside its own.
    tops = [edges(row.childItems()[0]).top() for row in rows]
    (step,) = {round(below - above) for above, below in pairwise(tops)}
    assert step > 0
    capitals = [capitals_top(next(texts(row))) - top for row, top in zip(rows, tops, strict=True)]
    assert max(capitals) - min(capitals) <= 1
    assert all(8 <= each <= 20 for each in capitals)
    # What one row says stays clear of the heading of the next.
    for (_, words), (heading, _) in pairwise([list(texts(row)) for row in rows]):
        assert capitals_top(heading) - edges(words).bottom() >= 32


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_first_row_of_the_first_page_stands_well_below_its_title(booth: Booth, qtbot: QtBot, language: str) -> None:
    rows = those(shown(booth, qtbot, "about", SIZES[0], language), "SignedLine")
    title = booth.item("page-title")
    baseline = edges(title).top() + QFontMetricsF(title.property("font")).ascent()
    assert 66 <= capitals_top(next(texts(rows[0]))) - baseline <= 80


def test_on_a_wide_screen_the_rows_of_the_first_page_end_where_the_cards_of_the_next_do(
    booth: Booth, qtbot: QtBot
) -> None:
    last = those(shown(booth, qtbot, "about", SIZES[0]), "SignedLine")[-1]
    (drawing, *_) = last.childItems()
    end = edges(drawing).bottom()
    shown(booth, qtbot, "age", SIZES[0])
    assert end == pytest.approx(edges(booth.item("age-yes")).bottom(), abs=4)


def test_on_an_upright_screen_the_rows_of_the_first_page_end_well_above_the_way_on(booth: Booth, qtbot: QtBot) -> None:
    last = those(shown(booth, qtbot, "about", SIZES[1]), "SignedLine")[-1]
    (drawing, *_) = last.childItems()
    assert edges(booth.item("continue")).top() - edges(drawing).bottom() >= 79
    assert not booth.sees("more")


@pytest.mark.parametrize("language", ["en", "ar"])
@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
def test_a_path_joins_the_drawings_of_all_that_happens_one_after_the_other(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], language: str
) -> None:
    ground = shown(booth, qtbot, "about", size, language)
    rows = those(ground, "SignedLine")
    discs = [edges(row.childItems()[0]) for row in rows]
    # The first line says what is studied, and the last one of an upright page what all of it takes.
    steps = discs[1:] if size[0] > size[1] else discs[1:-1]
    assert len(steps) == 3
    paths = sorted((edges(item) for item in items(ground) if item.objectName() == "path"), key=QRectF.top)
    assert len(paths) == len(steps) - 1
    for path, (above, below) in zip(paths, pairwise(steps), strict=True):
        assert path.center().x() == pytest.approx(above.center().x(), abs=1)
        assert path.top() == pytest.approx(above.bottom(), abs=1)
        assert path.bottom() == pytest.approx(below.top(), abs=1)


@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
def test_a_grown_up_and_a_smaller_child_are_portraits_in_the_middle_of_even_cards(
    booth: Booth, qtbot: QtBot, size: tuple[int, int]
) -> None:
    shown(booth, qtbot, "age", size)
    picture = booth.app.window.grabWindow()
    crowns = []
    for name in ("age-yes", "age-no"):
        card = booth.item(name)
        (person,) = those(card, "Person")
        disc = person.parentItem()
        assert disc is not None
        assert (edges(person).center() - edges(disc).center()).manhattanLength() <= 2
        crowns.append(float(person.property("crown")))
        # The clothes reach down to the rim, and not over it.
        rim = person.scale() * float(person.property("rim"))
        middle = edges(disc).center()
        colours = {
            inside: picture.pixelColor(QPointF(middle.x(), middle.y() + rim + inside).toPoint()) for inside in (-4, 4)
        }
        clothes = picture.pixelColor(QPointF(middle.x(), middle.y() + 0.8 * rim).toPoint())
        assert colours[-4] == clothes
        assert colours[4] == picture.pixelColor(QPointF(middle.x(), middle.y() - rim - 4).toPoint()) != clothes
        meaning = list(texts(card))[-1]
        baseline = edges(meaning).bottom() - QFontMetricsF(meaning.property("font")).descent()
        above, below = edges(disc).top() - edges(card).top(), edges(card).bottom() - baseline
        assert above == pytest.approx(below, abs=6)
    grown_up, child = crowns
    # On a disc that is 284 high.
    assert child >= grown_up + 25


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
def test_each_rule_has_three_lines_at_most_and_all_of_them_the_same_letters(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], language: str
) -> None:
    scenes = those(shown(booth, qtbot, "introduction", size, language), "Scene")
    assert len(scenes) == 3
    looks, tops = set(), set()
    for scene in scenes:
        heading, words = texts(scene)
        assert heading.property("font").bold()
        assert not words.property("font").bold()
        assert heading.property("lineCount") + words.property("lineCount") <= 3
        looks.add((pixels(heading), pixels(words)))
        tops.add(place(heading).top())
    ((of_headings, of_words),) = looks
    assert of_headings >= of_words >= 32
    assert len(tops) == (1 if size[0] > size[1] else 3)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
@pytest.mark.parametrize("helped", [True, False], ids=["helped", "alone"])
def test_rules_beside_a_robot_have_three_lines_at_most(
    booth: Booth, qtbot: QtBot, size: tuple[int, int], language: str, *, helped: bool
) -> None:
    booth.app.screens.avatar.appear(present=False)
    booth.app.screens.introduction.show(helped=helped)
    try:
        scenes = those(shown(booth, qtbot, "introduction", size, language), "Scene")
        assert len(scenes) == (3 if helped else 2)
        for scene in scenes:
            assert sum(text.property("lineCount") for text in texts(scene)) <= 3
    finally:
        booth.app.screens.introduction.clear()
        booth.app.screens.avatar.appear(present=True)


@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
def test_the_arrow_of_a_rule_stands_clear_of_the_edge(booth: Booth, qtbot: QtBot, size: tuple[int, int]) -> None:
    scene = those(shown(booth, qtbot, "introduction", size), "Scene")[-1]
    (arrow,) = those(scene, "Arrow")
    assert edges(arrow).top() - edges(scene).top() >= 18
