"""What is read before the game: cards that tell the page at a glance, and drawings that stand even."""

from __future__ import annotations

from itertools import pairwise

import pytest
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QFontMetricsF
from PySide6.QtQuick import QQuickItem

from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS
from kiosk.experiment.information import Information, Page
from kiosk.ui.simulated_visitor import lay_out
from tests.samples import CATALOGUES, ENGLISH
from tests.ui.conftest import Booth
from tests.ui.headless import let_go_of_pages, resize
from tests.ui.looking import items, lies_in, place, texts

GERMAN = ASSETS / "templates" / "two-languages"
WORDS = CATALOGUES | {"de": Catalogue(GERMAN / "de"), "ar": ENGLISH}
LANGUAGES = ("en", "it", "es", "de")
SIZES = [(1920, 1080), (1080, 1920)]


@pytest.fixture
def booth(resting_booth: Booth) -> Booth:
    """Return the booth that all tests of this module share."""
    return resting_booth


def shown(booth: Booth, screen: str, size: tuple[int, int], language: str = "en") -> QQuickItem:
    """Show a page in a window of this size; return what holds all of it."""
    window, screens = booth.app.window, booth.app.screens
    resize(window, screens, *size)
    screens.set_language(WORDS[language])
    screens.kiosk.begin((language,), language, booth.app.assigner.study.settings.consent)
    screens.kiosk.offer_back(offered=screen != "about")
    folder = GERMAN / "information" if language == "de" else ASSETS / "consent" / "study"
    screens.about.show(Information.of(folder, "en" if language == "ar" else language).about)
    screens.age.ask(18)
    screens.kiosk.show(screen)
    let_go_of_pages(window)
    booth.settle()
    lay_out(window)
    ground: QQuickItem = window.contentItem()
    return ground


def shown_instead(booth: Booth, size: tuple[int, int], page: Page) -> QQuickItem:
    """Show this page in the place of the shipped first one; return what holds all of it."""
    ground = shown(booth, "about", size)
    booth.app.screens.about.show(page)
    booth.settle()
    lay_out(booth.app.window)
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


def steps_of(ground: QQuickItem) -> list[QQuickItem]:
    """Return the cards of the steps of a visit that are to be seen, in their order."""
    return [item for item in items(ground) if item.objectName() == "step"]


def paths_of(ground: QQuickItem) -> list[QRectF]:
    """Return where what joins the steps of a visit is to be seen, in their order."""
    return [edges(item) for item in items(ground) if item.objectName() == "path"]


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
def test_each_step_of_the_first_page_is_a_card_with_a_drawing_and_a_heading_over_smaller_words(
    booth: Booth, size: tuple[int, int], language: str
) -> None:
    steps = steps_of(shown(booth, "about", size, language))
    assert len(steps) == 3
    looks, sides, places = set(), set(), set()
    for step in steps:
        (drawing,) = those(step, "StepDrawing")
        heading, words = texts(step)
        assert heading.property("font").bold()
        assert not words.property("font").bold()
        assert heading.property("lineCount") <= (2 if size == SIZES[0] else 1)
        assert words.property("lineCount") <= (4 if size == SIZES[0] else 2)
        looks.add((pixels(heading), pixels(words)))
        sides.add((round(step.width()), round(step.height()), round(drawing.width())))
        places.add(tuple(round(each) for each in (edges(drawing).center() - edges(step).topLeft()).toTuple()))
        for text in (heading, words):
            assert edges(step).adjusted(16, 16, -16, -16).contains(edges(text))
            assert not edges(text).intersects(edges(drawing))
    ((of_headings, of_words),), ((*_, side),) = looks, sides
    assert of_headings >= (38 if language in {"en", "it"} else 36)
    assert 33 <= of_words < of_headings
    assert side >= (176 if size == SIZES[0] else 160)
    assert len(places) == 1


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
def test_what_is_studied_stands_between_the_title_and_the_steps(
    booth: Booth, size: tuple[int, int], language: str
) -> None:
    ground = shown(booth, "about", size, language)
    (visit,) = those(ground, "VisitSteps")
    heading, words = list(texts(visit))[:2]
    title, first = booth.item("page-title"), steps_of(ground)[0]
    assert edges(title).bottom() <= edges(heading).top() < edges(words).top()
    assert edges(words).left() == pytest.approx(edges(heading).left(), abs=1)
    assert 24 <= edges(first).top() - edges(words).bottom() <= 60
    assert words.property("lineCount") <= 2
    assert pixels(title) > pixels(words) >= pixels(heading)


@pytest.mark.parametrize("language", ["en", "ar"])
@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
def test_an_arrow_leads_from_each_step_to_the_next(booth: Booth, size: tuple[int, int], language: str) -> None:
    ground = shown(booth, "about", size, language)
    steps = steps_of(ground)
    paths = paths_of(ground)
    assert len(paths) == len(steps) - 1
    for path, (step, following) in zip(paths, pairwise(steps), strict=True):
        one, other = edges(step), edges(following)
        (drawing,) = those(step, "StepDrawing")
        if size == SIZES[1]:
            between = (one.bottom() + other.top()) / 2
            assert path.center().y() == pytest.approx(between, abs=1)
            assert path.center().x() == pytest.approx(edges(drawing).center().x(), abs=1)
        else:
            between = (one.right() + other.left() if language == "en" else one.left() + other.right()) / 2
            assert path.center().x() == pytest.approx(between, abs=1)
            assert path.center().y() == pytest.approx(edges(drawing).center().y(), abs=1)


def test_on_a_wide_screen_the_steps_end_where_the_cards_of_the_next_page_do(booth: Booth) -> None:
    ends = {edges(step).bottom() for step in steps_of(shown(booth, "about", SIZES[0]))}
    (end,) = ends
    shown(booth, "age", SIZES[0])
    assert end == pytest.approx(edges(booth.item("age-yes")).bottom(), abs=4)


@pytest.mark.parametrize("language", LANGUAGES)
def test_on_an_upright_screen_what_a_visit_takes_ends_well_above_the_way_on(booth: Booth, language: str) -> None:
    ground = shown(booth, "about", SIZES[1], language)
    *_, words = texts(those(ground, "VisitSteps")[0])
    assert edges(steps_of(ground)[-1]).bottom() < edges(words).top()
    assert edges(booth.item("continue")).top() - edges(words).bottom() >= 40
    assert not booth.sees("more")


@pytest.mark.parametrize("language", LANGUAGES)
def test_beside_a_robot_the_first_page_says_below_the_steps_what_a_visit_takes(booth: Booth, language: str) -> None:
    booth.app.screens.avatar.appear(present=False)
    try:
        ground = shown(booth, "about", SIZES[0], language)
        last = booth.app.screens.about.property("lines")[-1]["text"].split("\n")
        said = [str(text.property("text")) for text in texts(ground)]
        assert [text for text in said if text in last or text == "\n".join(last)]
        assert not booth.sees("more")
    finally:
        booth.app.screens.avatar.appear(present=True)


@pytest.mark.parametrize("count", range(1, 9))
@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
@pytest.mark.parametrize("long", [False, True], ids=["short", "long"])
def test_a_first_page_of_any_number_of_paragraphs_says_all_of_them(
    booth: Booth, size: tuple[int, int], count: int, *, long: bool
) -> None:
    paragraphs = [f"Heading {at}\n{'What is said there. ' * (12 if long else 1)}".strip() for at in range(count)]
    page = Page.model_validate({"title": "Here", "paragraphs": paragraphs, "signs": ["cards"] * count})
    ground = shown_instead(booth, size, page)
    said = " ".join(str(text.property("text")) for text in texts(ground))
    # On a wide page, the helper says the last one if it is short.
    for at in range(count):
        assert said.count(f"Heading {at}") == 1 or (at == count - 1 and size == SIZES[0] and not long)
    assert not steps_of(ground) or (not booth.sees("more") and len(steps_of(ground)) <= 4)


def test_a_list_of_many_steps_has_a_path_between_their_drawings(booth: Booth) -> None:
    paragraphs = [f"Heading {at}\nWhat is said there." for at in range(6)]
    page = Page.model_validate({"title": "Here", "paragraphs": paragraphs, "signs": ["cards"] * 6})
    ground = shown_instead(booth, SIZES[0], page)
    discs = [edges(row.childItems()[0]) for row in those(ground, "SignedLine")]
    # The first line says what is studied.
    assert len(discs) == 5
    paths = sorted(paths_of(ground), key=QRectF.top)
    assert len(paths) == 3
    for path, (above, below) in zip(paths, pairwise(discs[1:]), strict=True):
        assert path.center().x() == pytest.approx(above.center().x(), abs=1)
        assert path.top() == pytest.approx(above.bottom(), abs=1)
        assert path.bottom() == pytest.approx(below.top(), abs=1)


@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
def test_a_grown_up_and_a_smaller_child_are_portraits_in_the_middle_of_even_cards(
    booth: Booth, size: tuple[int, int]
) -> None:
    shown(booth, "age", size)
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
    booth: Booth, size: tuple[int, int], language: str
) -> None:
    scenes = those(shown(booth, "introduction", size, language), "Scene")
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
    booth: Booth, size: tuple[int, int], language: str, *, helped: bool
) -> None:
    booth.app.screens.avatar.appear(present=False)
    booth.app.screens.introduction.show(helped=helped)
    try:
        scenes = those(shown(booth, "introduction", size, language), "Scene")
        assert len(scenes) == (3 if helped else 2)
        for scene in scenes:
            assert sum(text.property("lineCount") for text in texts(scene)) <= 3
    finally:
        booth.app.screens.introduction.clear()
        booth.app.screens.avatar.appear(present=True)


@pytest.mark.parametrize("size", SIZES, ids=["wide", "upright"])
def test_the_arrow_of_a_rule_stands_clear_of_the_edge(booth: Booth, size: tuple[int, int]) -> None:
    scene = those(shown(booth, "introduction", size), "Scene")[-1]
    (arrow,) = those(scene, "Arrow")
    assert edges(arrow).top() - edges(scene).top() >= 18
