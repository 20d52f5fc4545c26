"""Every screen in every language, and in one that is 40 % longer and runs the other way: no text is cut off.

Items of questionnaires and information sheets stand in the real languages; the made-up one has the English ones, made
longer in the same way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial, reduce
from itertools import pairwise
from typing import Any

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPointF, QRectF
from PySide6.QtQml import qmlEngine
from PySide6.QtQuick import QQuickItem, QQuickWindow
from PySide6.QtWidgets import QApplication

from kiosk.assistance.mentaliser import HintReason
from kiosk.assistance.policy import FlipInMove
from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS, Settings
from kiosk.experiment.effects import BoardWait
from kiosk.experiment.events import TextSize
from kiosk.experiment.information import Information
from kiosk.experiment.items import Likert, Rating, TextPage
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.experiment.questionnaire_stage import pages_alike
from kiosk.experiment.session_config import SessionConfig, StudyConfig
from kiosk.study.loader import read_study
from kiosk.ui.screens.registry import ScreenSet
from kiosk.ui.simulated_visitor import UiDriver, find_item, lay_out
from kiosk.ui.window import Window
from tests import pseudo
from tests.samples import with_needed_boxes
from tests.ui.headless import let_go_of_pages, open_window

SIZES = [(1280, 720), (720, 1280)]
"""Windows of the tests with further pages and languages.

All lengths are shares of the window: in larger ones of the same shape pages stand alike, and whole pixels round less.
"""


@dataclass(frozen=True)
class Layout:
    """A window, and whether a robot stands beside it in the avatar's place.

    To Qt, a screen of 3840 x 2160 at 200 % is a window of 1920 x 1080.
    """

    width: int
    height: int
    robot: bool = False

    def __str__(self) -> str:
        """Its name in the list of tests."""
        return f"{self.width}x{self.height}{', robot' if self.robot else ''}"


LAYOUTS = (
    Layout(1920, 1080),
    Layout(1080, 1920),
    Layout(1280, 800),
    Layout(1366, 768),
    Layout(1280, 720, robot=True),
    Layout(720, 1280, robot=True),
)
SAME_SHAPE = LAYOUTS[3]
"""A window of the same shape as the first, which shows the middle size of texts in place of the largest."""
SHIPPED = ("en", "es", "it")
HALF_A_PIXEL = 0.5
"""Sizes are rounded when texts are measured."""
MARGINS = 170
"""The most that a page which scrolls leaves free above and below, in pixels of a screen of 1080 lines."""
SPEAKING = {"attract", "introduction", "practice", "game", "result", "thanks"}
"""The screens on which the helper says something."""
RATED = {"trust", "four ratings", "six ratings", "four ratings, missing", "ratings that may not apply"}
"""The pages on which the helper is rated, and turns its back."""
LATER = {
    "form": {"about you", "about you, missing", "trust", "four ratings", "six ratings", "four ratings, missing"},
    "game": {"waiting"},
    "consent": {"consent", "missing ticks"},
}
"""What of these screens is looked at in every layout: the study's forms, and the board with all that it can show."""
SMALLEST = 24
"""What a text must at least measure, in pixels of a screen of 1080 lines."""

GALLERY = Questionnaire.read(ASSETS / "questionnaires" / "gallery.toml")
ASKED = {file.stem: Questionnaire.read(file) for file in (ASSETS / "questionnaires").glob("*.toml")}


@pytest.fixture(scope="module")
def kiosk(qapp: QApplication) -> Iterator[tuple[Window, StudyConfig]]:  # noqa: ARG001 - Qt is to be there before
    """Provide one window in all shipped languages, as a visitor who can go back has it."""
    study = read_study(Settings.model_validate({"languages": SHIPPED}))
    with open_window(study) as opened:
        yield opened, study


@pytest.fixture
def whole_window(kiosk: tuple[Window, StudyConfig]) -> Iterator[tuple[Window, StudyConfig]]:
    """Provide a window of that study whose pages and cards come as they are needed."""
    with open_window(kiosk[1]) as opened:
        yield opened, kiosk[1]


@pytest.fixture(scope="module", params=["en", pseudo.LANGUAGE])
def study(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> StudyConfig:
    """Return the study in one language."""
    if request.param != pseudo.LANGUAGE:
        return read_study(Settings.model_validate({"languages": [request.param]}))
    whole = read_study(Settings(languages=("en",)))
    (plan,) = whole.plans
    catalogue = Catalogue(pseudo.write(tmp_path_factory.mktemp("longer")))
    return replace(whole, plans=(replace(plan, catalogue=catalogue, information=longer(plan.information)),))


@pytest.fixture(scope="module")
def opened(study: StudyConfig, qapp: QApplication) -> Iterator[Window]:  # noqa: ARG001 - Qt is to be there before
    """Provide one window of that study."""
    with open_window(study) as window:
        yield window


@pytest.fixture
def sizes(study: StudyConfig) -> Sequence[float]:
    """Return the sizes of its texts; a language that is 40 % longer is test enough at its usual size."""
    return (1.0,) if study.plans[0].language == pseudo.LANGUAGE else (1.0, 1.3)


def longer(sheet: Information) -> Information:
    """Return an information sheet in the made-up language."""

    def rewritten(value: Any) -> Any:
        match value:
            case str():
                return pseudo.sentence(value)
            case dict():
                return {
                    key: item if key in {"id", "version", "signs"} else rewritten(item) for key, item in value.items()
                }
            case list() | tuple():
                return [rewritten(item) for item in value]
        return value

    return Information.model_validate(rewritten(sheet.model_dump()))


def worded(item: Item, language: str) -> Item:
    """Return an item of a questionnaire, in the made-up language if it is that one."""
    if language != pseudo.LANGUAGE:
        return item

    def rewritten(value: Any) -> Any:
        match value:
            case {"en": str(english)}:
                return {language: pseudo.sentence(english)}
            case dict():
                return {key: rewritten(item) for key, item in value.items()}
            case list() | tuple():
                return [rewritten(item) for item in value]
        return value

    return type(item).model_validate(rewritten(item.model_dump()))


def longest_hint(catalogue: Catalogue) -> tuple[str, str]:
    """Return the longest that the assistant ever says with a hint, and its advice."""
    card = catalogue.card("hedgehog")
    reasons = [
        wording
        for which in FlipInMove
        for reason in HintReason
        if (message := f"reason-{which.value}-{reason.value}") in catalogue
        for wording in catalogue.wordings(message, **card)
    ]
    advice = max(catalogue.wordings("point-second-card", row=4, column=6), key=len)
    return f"{max(reasons, key=len)} {advice}", advice


def texts(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every visible text below an item."""
    yield from (found for found, _ in read(item) if found.inherits("QQuickText"))


def read(item: QQuickItem, pane: QQuickItem | None = None) -> Iterator[tuple[QQuickItem, QQuickItem | None]]:
    """Every visible text and button below an item, each with the pane that it scrolls in, if it does."""
    if not item.isVisible() or item.opacity() == 0:
        return
    if item.inherits("QQuickText"):
        if item.property("text"):
            yield item, pane
    elif item.inherits("QQuickAbstractButton"):
        yield item, pane
    elif item.inherits("QQuickFlickable") and item.property("interactive"):
        pane = item
    for child in item.childItems():
        yield from read(child, pane)


def painted(text: QQuickItem) -> QRectF:
    """Where a text's letters are in the window."""
    width, height = float(text.property("contentWidth")), float(text.property("contentHeight"))
    place = text.mapRectToScene(text.boundingRect())
    # A negative padding takes away the air above large capitals; Qt leaves it out of where the text is.
    air = min(0.0, float(text.property("topPadding")))
    return QRectF(place.center().x() - width / 2, place.center().y() - height / 2, width, height + air)


def controls(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every visible button below an item."""
    yield from (found for found, _ in read(item) if not found.inherits("QQuickText"))


def belongs(item: QQuickItem, control: QQuickItem) -> bool:
    """Whether an item is a part of a button, or the button itself."""
    above: QQuickItem | None = item
    while above is not None and above is not control:
        above = above.parentItem()
    return above is not None


def whole(item: QQuickItem) -> QRectF:
    """Where an item is in the window."""
    return item.mapRectToScene(QRectF(0, 0, item.width(), item.height()))


def assert_no_needless_scrolling(shown: QQuickWindow, more: QQuickItem, moment: str) -> None:
    """Assert that a page that scrolls leaves only its margins free above and below; ``more`` is its sign for that."""
    above, page = more.parentItem(), more
    while above is not None:
        page = above if above.inherits("QQuickFocusScope") else page
        above = above.parentItem()
    top = min(painted(text).top() for text in texts(page))
    low = max(whole(control).bottom() for control in controls(page))
    unused = (top - whole(page).top()) + (whole(page).bottom() - low)
    long, short = max(shown.width(), shown.height()), min(shown.width(), shown.height())
    unit = min(long / 1920, short / 1080)
    assert unused <= MARGINS * unit, (moment, unused / unit)


def assert_large_enough(shown: QQuickWindow, moment: str) -> None:
    """Assert that every text is large enough to be read."""
    unit = min(max(shown.width(), shown.height()) / 1920, min(shown.width(), shown.height()) / 1080)
    for text in texts(shown.contentItem()):
        size = text.property("font").pixelSize()
        assert size >= SMALLEST * unit, (moment, text.property("text"), size)


@dataclass(frozen=True)
class Part:
    """A text or a button, where it is, and what of the window it scrolls in."""

    item: QQuickItem
    place: QRectF
    pane: QRectF | None

    @property
    def seen(self) -> QRectF:
        """What of it is in sight."""
        return self.place if self.pane is None else self.place.intersected(self.pane)

    @property
    def told(self) -> tuple[str, QRectF]:
        """Its words or name, and its place."""
        return str(self.item.property("text") or self.item.objectName()), self.place


def crossings(parts: Sequence[Part]) -> Iterator[tuple[Part, Part]]:
    """Every two parts that are in sight and lie on each other."""
    # From the top down, each is compared only with those that begin above its end.
    sorted_parts = sorted(((part, part.seen) for part in parts), key=lambda both: both[1].top())
    edges = [(seen.left(), seen.right(), seen.top(), seen.bottom()) for _, seen in sorted_parts]
    for one, (left, right, _, bottom) in enumerate(edges):
        for other in range(one + 1, len(edges)):
            # Places are fractions of pixels, so parts that touch may lie on each other by a rounding error.
            if edges[other][2] > bottom - HALF_A_PIXEL:
                break
            if edges[other][0] < right and left < edges[other][1]:
                yield sorted_parts[one][0], sorted_parts[other][0]


def assert_all_can_be_read(shown: QQuickWindow, moment: str) -> list[QQuickItem]:
    """No text of the window is cut off, reaches out of the window, or lies on another one or under a button.

    Returns the texts and buttons that are to be seen: to look for them takes long.
    """
    inside = QRectF(0, 0, shown.width(), shown.height()).adjusted(*(-HALF_A_PIXEL,) * 2, *(HALF_A_PIXEL,) * 2)
    every = [(item, whole(pane) if pane is not None else None) for item, pane in read(shown.contentItem())]
    written = [Part(item, painted(item), pane) for item, pane in every if item.inherits("QQuickText")]
    assert written, moment
    for part in written:
        assert not part.item.property("truncated"), (moment, part.told)
        # Wider than its place in a button is a text that was not laid out anew with it.
        within = part.item.parentItem().inherits("QQuickButton") and part.item.objectName() != "note"
        assert not within or part.item.property("contentWidth") < part.item.width() + 2, (moment, part.told)
        if part.pane is None:
            assert inside.contains(part.place), (moment, part.told)
        else:
            assert inside.left() <= part.place.left() < part.place.right() <= inside.right(), (moment, part.told)
            assert inside.contains(part.pane), (moment, part.told)
    buttons = [
        Part(item, whole(item).adjusted(1, 1, -1, -1), pane) for item, pane in every if not item.inherits("QQuickText")
    ]
    drawings = [find_item(shown.contentItem(), name) for name in ("turned-away", "progress")]
    drawn = [Part(item, whole(item), None) for item in drawings if item is not None]
    assert all(inside.contains(part.place) for part in drawn), moment
    for one, other in crossings([*written, *buttons, *drawn]):
        apart = not belongs(one.item, other.item) and not belongs(other.item, one.item)
        assert not apart, (moment, one.told, other.told)
    return [item for item, _ in every]


def moments(screens: ScreenSet, study: StudyConfig) -> Iterator[tuple[str, str, Callable[[], None]]]:
    """Every screen with as much to show as it can ever have: a name for it, the screen's, and how it is filled."""
    (plan,) = study.plans
    sheet, language = plan.information, plan.language
    yield "attract", "attract", lambda: None
    yield "about", "about", lambda: screens.about.show(sheet.about)
    yield "consent", "consent", lambda: screens.consent.show(sheet.consent)
    asked = with_needed_boxes(sheet.consent)
    yield "consent with boxes", "consent", lambda: screens.consent.show(asked)
    missing = tuple(purpose.id for purpose in asked.purposes if purpose.required)
    yield "missing ticks", "consent", lambda: screens.consent.show_missing(missing)
    yield "age", "age", lambda: screens.age.ask(18)
    yield "introduction", "introduction", lambda: None
    yield "practice", "practice", lambda: screens.board.deal(3, 4, 6, "fruit", practice=True)
    yield "game", "game", lambda: screens.board.deal(4, 6, 12, "animals")
    yield "long", "game", lambda: screens.board.show_progress(12, 188)
    yield "waiting", "game", lambda: screens.board.lock(BoardWait.TURNING_BACK)
    folder = ASSETS / "cards" / "animals"
    found = [file.as_uri() for file in sorted(folder.glob("*.svg"))[:12]]
    yield "result", "result", lambda: screens.result.show(12, 188, 59 * 60_000 + 59_000, 188, found)
    for name, items, title in pages():
        shown = tuple(worded(item, language) for item in items)
        number = (1, 1) if name == "about you" else (10, 12)
        above = {language: pseudo.sentence(title["en"])} if title and language == pseudo.LANGUAGE else title
        yield name, "form", partial(screens.form.show, shown, *number, (), above)
        if not any(isinstance(item, TextPage) for item in items):
            names = tuple(item.id for item in items)
            yield f"{name}, missing", "form", partial(screens.form.show_missing, names)

    def debrief() -> None:
        screens.debrief.give_contact("memory-study@psychology.university.test")
        screens.debrief.give_summary(sheet.about.paragraphs[0])
        screens.debrief.give_code("WWWWWWW")
        screens.debrief.show(sheet.debrief)

    yield "debrief", "debrief", debrief
    yield "thanks", "thanks", lambda: None


def pages() -> Iterator[tuple[str, tuple[Item, ...], dict[str, str] | None]]:
    """Pages of a form with their titles: every kind alone, kinds together, and the study's own questionnaires."""
    for item in GALLERY.items:
        yield f"one {item.kind}", (item,), None
    asked = tuple(item for item in GALLERY.items if not isinstance(item, TextPage))
    yield "several kinds", asked[:4], None
    yield "several other kinds", asked[4:], None
    for name, of, among in (
        ("about you", "about-you", slice(None)),
        ("trust", "trust", slice(None)),
        ("four ratings", "social-intelligence", slice(4)),
        ("six ratings", "social-intelligence", slice(4, 10)),
        ("ratings that may not apply", "psi", slice(ASKED["psi"].per_page)),
    ):
        yield name, ASKED[of].items[among], ASKED[of].title


def is_broken(text: QQuickItem) -> bool:
    """Whether a text of one word has more than one line."""
    return text.property("lineCount") > 1 and " " not in text.property("text")


def scrolls(window: Window, layout: Layout, moment: str, language: str, size: TextSize) -> bool:
    """Look at the page that is shown in this size; returns whether it scrolls."""
    shown, told = window.shown, f"{moment}, {language}, {size.value}"
    window.screens.kiosk.set_text_size(size)
    lay_out(shown)
    seen = assert_all_can_be_read(shown, told)
    assert [str(item.property("text")) for item in seen if item.inherits("QQuickText") and is_broken(item)] == [], told
    if size is TextSize.NORMAL and (layout.width, layout.height) == (1920, 1080):
        assert_large_enough(shown, told)
    more = next((item for item in seen if item.objectName() == "more"), None)
    if more is None:
        return False
    assert_no_needless_scrolling(shown, more, told)
    # The shipped questionnaires have four ratings on a page.
    asks_more = moment.endswith(", missing") or (layout.robot and moment == "six ratings")
    may_scroll = size is not TextSize.NORMAL or asks_more
    assert may_scroll, told
    return True


@pytest.mark.parametrize("layout", LAYOUTS, ids=str)
def test_every_screen_fits_in_every_language_layout_and_text_size_and_breaks_no_word_that_fits(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    window, study = kiosk
    screens = window.screens
    sizes = [TextSize.NORMAL, TextSize.LARGE if layout == SAME_SHAPE else TextSize.LARGEST]
    resize(window, layout.width, layout.height)
    screens.avatar.appear(present=not layout.robot)
    plans = [(plan, list(moments(screens, replace(study, plans=(plan,))))) for plan in study.plans]
    # A page is made once, for all languages and sizes.
    for screen in dict.fromkeys(screen for _, screen, _ in plans[0][1]):
        for plan, there in plans:
            screens.set_language(plan.catalogue)
            screens.kiosk.begin(SHIPPED, plan.language, plan.settings.consent)
            screens.kiosk.offer_back(offered=True)
            for moment, _, fill in (each for each in there if each[1] == screen):
                if screen in LATER and moment not in LATER[screen]:
                    if screen == "game":
                        fill()
                    continue
                fill()
                screens.avatar.leave(away=moment in RATED)
                show_alone(window, screen)
                screens.avatar.say(*said(screen, plan))
                found = {scrolls(window, layout, moment, plan.language, size) for size in sizes}
                if looks_between(layout, plan.language, differ=len(found) > 1):
                    scrolls(window, layout, moment, plan.language, TextSize.LARGE)
                # The next page begins with the size that this one ends with, and the next screen with its language.
                sizes.reverse()
        plans.reverse()
    screens.avatar.leave(away=False)
    let_go(window.shown)


def looks_between(layout: Layout, language: str, *, differ: bool) -> bool:
    """Whether the middle size is looked at as well: ``differ`` if a page scrolls in one of the other sizes only.

    A page that scrolls in both or in neither is the same between them. One language of each layout shows it all the
    same; of the widest windows, the smaller one does.
    """
    return layout not in (LAYOUTS[0], SAME_SHAPE) and (
        differ or (SHIPPED.index(language) + LAYOUTS.index(layout)) % len(SHIPPED) == 0
    )


def show_alone(window: Window, screen: str) -> None:
    """Show a screen and let go of pages out of sight: each would lay its texts out as often as this one."""
    window.screens.kiosk.show(screen)
    let_go_of_pages(window.shown)


def resize(window: Window, width: int, height: int) -> None:
    """Give a window this size, and nothing to show in it."""
    show_alone(window, "")
    window.screens.avatar.clear()
    window.shown.resize(width, height)
    QCoreApplication.processEvents()
    assert window.shown.contentItem().width() == width


def let_go(window: QQuickWindow) -> None:
    """Free what was shown before: a test has no event loop in which that would happen by itself."""
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    engine = qmlEngine(window.contentItem().childItems()[0])
    assert engine is not None
    engine.collectGarbage()
    window.releaseResources()


FRAMED = ("about", "consent", "age", "introduction", "about you", "result", "debrief", "thanks")
"""Pages with a title, a way back and a way on; the age is answered by its own buttons."""


def shown_in(kiosk: tuple[Window, StudyConfig], layout: Layout, wanted: Sequence[str]) -> Iterator[str]:
    """Show these pages in English in a layout, one after the other."""
    window, study = kiosk
    plan = next(plan for plan in study.plans if plan.language == "en")
    screens = window.screens
    resize(window, layout.width, layout.height)
    screens.set_language(plan.catalogue)
    screens.kiosk.begin(SHIPPED, "en", plan.settings.consent)
    screens.kiosk.offer_back(offered=True)
    screens.kiosk.set_text_size(TextSize.NORMAL)
    screens.avatar.appear(present=not layout.robot)
    for moment, screen, fill in moments(screens, replace(study, plans=(plan,))):
        if moment in wanted:
            fill()
            show_alone(window, screen)
            lay_out(window.shown)
            yield moment


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1366, 768, robot=True)], ids=str)
def test_title_and_ways_stand_at_the_same_places_on_all_pages(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    ground = kiosk[0].shown.contentItem()
    titles, back, on = set(), set(), set()
    sizes: dict[str, set[int]] = {}
    pages_seen = []
    for moment in shown_in(kiosk, layout, FRAMED):
        pages_seen.append(moment)
        title, leave = find_item(ground, "page-title"), find_item(ground, "back")
        assert title is not None
        assert leave is not None
        size = title.property("font").pixelSize()
        sizes.setdefault("high" if moment in {"result", "thanks"} else "usual", set()).add(size)
        titles.add((round(whole(title).left()), round(whole(title).top())))
        # A page on which the helper says something is lower where the sentence stands below it.
        speaks = layout.robot and moment in SPEAKING
        back.add((round(whole(leave).left()), None if speaks else round(whole(leave).bottom())))
        go = find_item(ground, "agree" if moment == "consent" else "continue")
        if go is not None:
            # The two answers to a consent are higher, and grow both ways.
            on.add((round(whole(go).right()), None if speaks else round(whole(go).center().y())))
    assert sorted(pages_seen) == sorted(FRAMED)
    assert len(titles) == len({left for left, _ in back}) == 1
    # What is found and the thanks are the heights of a visit.
    assert {height: len(each) for height, each in sizes.items()} == {"usual": 1, "high": 1}
    assert min(sizes["high"]) > max(sizes["usual"])
    assert len({bottom for _, bottom in back} - {None}) == 1
    assert len({right for right, _ in on}) == 1
    assert len({middle for _, middle in on} - {None}) == 1


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920)], ids=str)
def test_the_way_on_is_large_on_every_page_and_the_way_back_a_little_smaller(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    ground = kiosk[0].shown.contentItem()

    def letters(name: str) -> dict[str, int]:
        button = find_item(ground, name)
        return {} if button is None else {t.objectName(): t.property("font").pixelSize() for t in texts(button)}

    looked = set()
    for moment in shown_in(kiosk, layout, FRAMED):
        assert letters("back") == {"": 36}, moment
        name = "agree" if moment == "consent" else "continue"
        go = find_item(ground, name)
        if go is None:
            continue
        looked.add(moment)
        assert go.height() >= 112, moment
        assert go.width() >= 320, moment
        assert letters(name)[""] == 42, moment
        notes = (
            letters(name).get("note", 32),
            *(text.property("font").pixelSize() for text in texts(ground) if text.objectName() == "form-waiting"),
        )
        assert min(notes) >= 32, moment
    assert looked == set(FRAMED) - {"age"}


SIXTEEN = ASKED["social-intelligence"].items
"""The items of the study that stand on pages of four."""
ALONE = ASKED["another-game"].items
"""The one that has a page of its own."""
MIXED = ASKED["trust"].items + ALONE
"""A page of three ratings of five points and one of ten, as another questionnaire may have."""


def rating_pages(
    kiosk: tuple[Window, StudyConfig], layout: Layout, asked_of: Sequence[Item] = SIXTEEN
) -> Iterator[list[tuple[int, QRectF, QRectF, QRectF]]]:
    """Show each page of four ratings; yield each item's points and the places of its card, statement and scale."""
    rated = [item for item in asked_of if isinstance(item, Likert)]
    assert len(rated) == len(asked_of)
    screens, ground = kiosk[0].screens, kiosk[0].shown.contentItem()
    assert list(shown_in(kiosk, layout, ("four ratings",))) == ["four ratings"]
    screens.avatar.leave(away=True)
    pages = [tuple(rated[first : first + 4]) for first in range(0, len(rated), 4)]
    for page in pages:
        screens.form.show(page, 1, 5, alike=pages_alike(pages, page))
        lay_out(kiosk[0].shown)
        ends = [[find_item(ground, f"answer-{item.id}-{end}") for end in item.ends] for item in page]
        scales = [reduce(QRectF.united, (whole(end) for end in both if end is not None)) for both in ends]
        # What is drawn of an item, without the distance to the one above it.
        cards = [whole(card) for item in page if (card := find_item(ground, f"card-{item.id}")) is not None]
        asked = {text.property("text").replace("\xa0", " "): painted(text) for text in texts(ground)}
        shown = [asked[item["shown"].replace("\xa0", " ")] for item in screens.form.property("items")]
        yield list(zip([item.points for item in page], cards, shown, scales, strict=True))
    screens.avatar.leave(away=False)


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920)], ids=str)
def test_cards_stand_at_the_same_places_on_all_pages_of_four_ratings(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    pages = list(rating_pages(kiosk, layout))
    assert len(pages) > 3
    assert len({tuple(round(card.y()) for _, card, _, _ in page) for page in pages}) == 1
    assert len({round(card.height()) for page in pages for _, card, _, _ in page}) == 1
    assert len({gap for page in pages for gap in gaps(page)}) == 1


def gaps(page: list[tuple[int, QRectF, QRectF, QRectF]]) -> list[int]:
    """Return how far the cards of a page of ratings are apart."""
    return [round(after.top() - card.bottom()) for (_, card, _, _), (_, after, _, _) in pairwise(page)]


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920)], ids=str)
def test_scales_of_ratings_stand_at_the_same_places_on_all_pages(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    wide = layout.width > layout.height
    places: dict[int, set[tuple[int, ...]]] = {}
    for page in rating_pages(kiosk, layout):
        for _, card, shown, scale in page:
            at = (scale.x(), scale.center().y() - card.center().y(), scale.width(), scale.height())
            # Below a statement of one line they stand higher.
            places.setdefault(0 if wide else round(shown.height() / 50), set()).add(tuple(map(round, at)))
    assert sorted(places) == ([0] if wide else [1, 2])
    assert [len(found) for found in places.values()] == [1] * len(places)


def test_ten_points_of_a_wide_page_are_as_large_as_five_and_stand_below_their_question_and_apart(
    kiosk: tuple[Window, StudyConfig],
) -> None:
    (page,) = rating_pages(kiosk, Layout(1920, 1080), MIXED)
    *fives, (points, card, shown, scale) = page
    assert points == 10
    *usual, apart = gaps(page)
    assert apart >= max(usual) + 30
    assert len({round(five.height()) for _, five, _, _ in fives}) == 1
    assert {(round(five.height()), round(five.right())) for *_, five in fives} == {
        (round(scale.height()), round(scale.right()))
    }
    assert card.top() + 12 < shown.top() < shown.bottom() + 12 < scale.top() < scale.bottom() < card.bottom() - 12
    assert abs((shown.top() - card.top()) - (card.bottom() - scale.bottom())) < 12


def test_ten_points_among_others_of_an_upright_page_are_equal_and_as_high_as_theirs(
    kiosk: tuple[Window, StudyConfig],
) -> None:
    pages = rating_pages(kiosk, Layout(1080, 1920), MIXED)
    page = next(pages)
    points, card, _, scale = page[-1]
    name = MIXED[-1].id
    ground = kiosk[0].shown.contentItem()
    fields = [item for n in range(1, points + 1) if (item := find_item(ground, f"answer-{name}-{n}")) is not None]
    places = [whole(field) for field in fields]
    assert len(places) == points == 10
    assert all(after.left() - field.right() >= 12 for field, after in pairwise(places))
    assert max(field.width() for field in places) - min(field.width() for field in places) <= 1
    assert {round(field.height()) for field in places} == {round(page[0][3].height())}
    assert abs((scale.left() - card.left()) - (card.right() - scale.right())) <= 1
    ends = [painted(text) for text in texts(ground) if text.property("text") in ("not at all", "completely")]
    assert [scale.bottom() < end.top() < card.bottom() for end in ends] == [True, True]
    # All are round in the same way, and what is chosen is filled.
    assert len({background_of(field).property("radius") for field in fields}) == 1
    kiosk[0].screens.form.show_answer(name, 7)
    fills = [background_of(field).property("color").name() for field in fields]
    assert [fills.count(fill) for fill in (fills[0], fills[6])] == [9, 1]
    # The others have the same look, each with its words for the ends below its points.
    for _, _, shown, other in page[:-1]:
        assert (other.left(), other.width(), other.height()) == pytest.approx(
            (scale.left(), scale.width(), scale.height())
        )
        assert other.top() - shown.bottom() == pytest.approx(scale.top() - page[-1][2].bottom(), abs=1)
    low = [painted(text) for text in texts(ground) if text.property("text") == "do not agree at all"]
    assert [end.top() > other.bottom() for end, (*_, other) in zip(low, page[:-1], strict=True)] == [True] * 3
    assert list(pages) == []


def background_of(button: QQuickItem) -> QQuickItem:
    """Return what is drawn behind the words of a button."""
    behind: QQuickItem = button.property("background")
    return behind


@pytest.mark.parametrize("layout", [Layout(1080, 1920), Layout(800, 1280)], ids=str)
def test_statements_of_an_upright_page_end_at_one_distance_above_their_points(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    unit = layout.height / 1920
    distances: dict[int, list[float]] = {}
    depths: dict[tuple[int, int], set[int]] = {}
    for page in rating_pages(kiosk, layout, SIXTEEN + ASKED["trust"].items):
        for _, card, shown, scale in page:
            lines = round(shown.height() / (50 * unit))
            depths.setdefault((len(page), lines), set()).add(round(scale.top() - card.top()))
            distances.setdefault(len(page), []).append(scale.top() - shown.bottom())
            # There is as much air above the letters, which begin below the top of their line, as below the points.
            above, below = shown.top() - card.top() + 15 * unit, card.bottom() - scale.bottom()
            assert min(above, below) >= 24 * unit
            assert above == pytest.approx(below, abs=6 * unit)
    # On each page, a statement of so many lines stands at one place; where fewer are asked, all is larger.
    assert sorted(depths) == [(3, 1), (4, 1), (4, 2)]
    assert [max(places) - min(places) <= 1 for places in depths.values()] == [True] * 3
    assert [max(each) - min(each) <= 1 for each in distances.values()] == [True] * 2
    assert 20 * unit <= min(distances[4]) <= min(distances[3])


def test_statements_of_one_line_and_of_two_stand_in_the_middle_of_as_high_cards(
    kiosk: tuple[Window, StudyConfig],
) -> None:
    mixed, alone = rating_pages(kiosk, Layout(1080, 1920), SIXTEEN[:4] + ASKED["trust"].items)
    assert {round(shown.height() / 50) for _, _, shown, _ in mixed} == {1, 2}
    assert {round(shown.height() / 50) for _, _, shown, _ in alone} == {1}
    assert [len({round(card.height()) for _, card, _, _ in page}) for page in (mixed, alone)] == [1, 1]
    for _, card, shown, scale in (*mixed, *alone):
        assert shown.top() - card.top() + 15 == pytest.approx(card.bottom() - scale.bottom(), abs=6)


def test_a_long_statement_of_an_upright_page_takes_distances_and_its_page_needs_no_scrolling(
    kiosk: tuple[Window, StudyConfig],
) -> None:
    said = (
        "The helper noticed what I remembered and what I had forgotten, and chose its hints for that, whatever it saw."
    )
    one, two, *others = SIXTEEN[:4]
    asked = (one, two.model_copy(update={"text": dict.fromkeys(SHIPPED, said)}), *others)
    pages = 0
    for page in rating_pages(kiosk, Layout(1080, 1920), asked):
        pages += 1
        assert find_item(kiosk[0].shown.contentItem(), "more") is None
        assert round(page[1][2].height() / 50) >= 3
        assert min(scale.top() - shown.bottom() for _, _, shown, scale in page) >= 16
        assert {round(scale.height()) for *_, scale in page} in ({112}, {100})
    assert pages == 1


@pytest.mark.parametrize("size", TextSize)
def test_statements_of_an_upright_page_are_clear_of_their_points_with_texts_of_any_size(
    kiosk: tuple[Window, StudyConfig], size: TextSize
) -> None:
    screens, ground, items = kiosk[0].screens, kiosk[0].shown.contentItem(), SIXTEEN[4:8]
    assert list(shown_in(kiosk, Layout(1080, 1920), ("four ratings",))) == ["four ratings"]
    try:
        screens.avatar.leave(away=True)
        screens.kiosk.set_text_size(size)
        screens.form.show(items, 2, 5, alike=(items, items))
        lay_out(kiosk[0].shown)
        assert find_item(ground, "more") is None
        asked = {text.property("text").replace("\xa0", " "): painted(text) for text in texts(ground)}
        shown = [asked[item["shown"].replace("\xa0", " ")] for item in screens.form.property("items")]
        points = [whole(point) for item in items if (point := find_item(ground, f"answer-{item.id}-1")) is not None]
        assert max(round(place.height() / 50) for place in shown) >= 2
        assert min(point.top() - place.bottom() for place, point in zip(shown, points, strict=True)) >= 24
    finally:
        screens.avatar.leave(away=False)
        screens.kiosk.set_text_size(TextSize.NORMAL)


def ratings_in(kiosk: tuple[Window, StudyConfig], layout: Layout, language: str) -> Window:
    """Return the window with a page of four ratings in this layout and language; the avatar has left the screen."""
    window, study = kiosk
    assert list(shown_in(kiosk, layout, ("four ratings",))) == ["four ratings"]
    window.screens.set_language(next(plan for plan in study.plans if plan.language == language).catalogue)
    window.screens.avatar.leave(away=True)
    return window


@pytest.mark.parametrize("language", SHIPPED)
def test_cards_of_an_upright_page_of_ratings_stay_as_they_are_when_they_are_pointed_out(
    kiosk: tuple[Window, StudyConfig], language: str
) -> None:
    window = ratings_in(kiosk, Layout(1080, 1920), language)
    ground = window.shown.contentItem()

    def places(items: tuple[Item, ...]) -> list[QRectF]:
        lay_out(window.shown)
        assert find_item(ground, "more") is None
        cards = [find_item(ground, f"card-{item.id}") for item in items]
        return [whole(card) for card in cards if card is not None]

    try:
        for items in (SIXTEEN[:4], SIXTEEN[4:8], ASKED["trust"].items):
            for missed in (items[:1], items):
                window.screens.form.show(items, 2, 5, alike=(SIXTEEN[:4], items))
                before = places(items)
                window.screens.form.show_missing(tuple(item.id for item in missed))
                after = places(items)
                assert len(before) == len(after) == len(items)
                for old, new in zip(before, after, strict=True):
                    assert new.getRect() == pytest.approx(old.getRect(), abs=4)
    finally:
        window.screens.avatar.leave(away=False)


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920)], ids=str)
def test_the_words_for_the_ends_stand_above_the_points_of_a_page_of_ratings_and_below_an_upright_one_s(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    ground, wide = kiosk[0].shown.contentItem(), layout.width > layout.height
    item = SIXTEEN[0]
    assert isinstance(item, Likert)
    for page in rating_pages(kiosk, layout):
        heads = [
            [painted(text) for text in texts(ground) if text.property("text") == end["en"]]
            for end in (item.lowest, item.highest)
        ]
        assert [len(places) for places in heads] == ([1, 1] if wide else [2, 2])
        (lowest, *_), (highest, *_) = heads
        (_, first, _, points), *_ = page
        # They stand in a band that ends where the first card begins.
        band = find_item(ground, "table-head")
        assert band is not None
        assert whole(band).left() == first.left()
        assert whole(band).right() == first.right()
        assert whole(band).contains(lowest)
        assert whole(band).contains(highest)
        assert 0 <= whole(band).bottom() - first.top() <= 4
        # One begins where the points do, and the other ends there.
        assert [lowest.left(), highest.right()] == pytest.approx([points.left(), points.right()], abs=2)
        assert lowest.right() + 20 < highest.left()
        # The last ones of a long sheet are far from it: the same band stands at the foot.
        foot = find_item(ground, "table-foot")
        assert (foot is None) is wide
        if foot is not None:
            last, below = page[-1][1], whole(foot)
            assert 0 <= last.bottom() - below.top() <= 4
            assert (below.left(), below.right(), below.height()) == pytest.approx(
                (last.left(), last.right(), whole(band).height()), abs=1
            )
            for (above, under), edge in zip(heads, ("left", "right"), strict=True):
                assert below.contains(under)
                assert getattr(above, edge)() == pytest.approx(getattr(under, edge)(), abs=1)
        # Each statement of a wide page has most of its card's width.
        assert not wide or points.left() > first.left() + 0.55 * first.width()


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920)], ids=str)
def test_long_words_for_the_ends_stand_above_the_points_in_several_lines(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    ground, ends = kiosk[0].shown.contentItem(), ("not at all, " * 6 + "never", "in every respect, " * 5 + "always")
    asked = tuple(
        item.model_copy(update={"lowest": dict.fromkeys(SHIPPED, ends[0]), "highest": dict.fromkeys(SHIPPED, ends[1])})
        for item in SIXTEEN[:4]
    )
    pages = 0
    for page in rating_pages(kiosk, layout, asked):
        pages += 1
        band = find_item(ground, "table-head")
        assert band is not None
        assert find_item(ground, "more") is None
        heads = [painted(text) for text in texts(ground) if text.property("text") in ends]
        assert len(heads) == 2
        assert {whole(band).contains(head) and head.height() > 75 for head in heads} == {True}
        assert not heads[0].intersects(heads[1])
        assert len({round(scale.height()) for *_, scale in page}) == 1
    assert pages == 1


def inner_part(point: QQuickItem) -> QRectF:
    """Return the part of a point that nothing but its number is drawn on."""
    return whole(point).adjusted(28, 24, -28, -24)


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920)], ids=str)
def test_all_points_of_a_page_of_ratings_have_the_same_ground(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    shown = kiosk[0].shown
    for first, _ in zip(range(0, len(SIXTEEN), 4), rating_pages(kiosk, layout), strict=True):
        points = [
            inner_part(point)
            for asked in SIXTEEN[first : first + 4]
            for number in range(1, 6)
            if (point := find_item(shown.contentItem(), f"answer-{asked.id}-{number}")) is not None
        ]
        assert len(points) == 20
        picture = shown.grabWindow()
        # Inside of what is drawn around them and between them, and above them and below.
        corners = [corner for point in points for corner in (point.topLeft(), point.topRight(), point.bottomLeft())]
        assert len({picture.pixelColor(corner.toPoint()).name() for corner in corners}) == 1
        beside = [QPointF(point.center().x(), y) for point in points for y in (point.top() - 36, point.bottom() + 36)]
        assert len({picture.pixelColor(spot.toPoint()).name() for spot in beside}) == 1


Feet = dict[int, tuple[QRectF, QRectF]]
"""Where the helper's back and the way on are, by how many ratings the page has."""


def fewer_ratings(kiosk: tuple[Window, StudyConfig], layout: Layout) -> tuple[dict[int, list[Any]], Feet]:
    """Show pages of four, three and two ratings of one study."""
    ground, wide = kiosk[0].shown.contentItem(), layout.width > layout.height
    pages: dict[int, list[Any]] = {}
    feet: Feet = {}
    for number in (3, 2):
        for page in rating_pages(kiosk, layout, SIXTEEN[:4] + ASKED["trust"].items[:number]):
            back, on, why = (find_item(ground, name) for name in ("turned-away", "continue", "why-turned-away"))
            assert back is not None
            assert on is not None
            assert why is not None
            assert not painted(why).intersects(whole(on))
            pages[len(page)], feet[len(page)] = page, (whole(back), whole(on))
            # A sheet of two needs no band at its foot.
            foot = find_item(ground, "table-foot")
            assert (foot is not None) is (not wide and len(page) > 2)
    assert sorted(pages) == [2, 3, 4]
    return pages, feet


def test_a_wide_page_with_fewer_ratings_has_higher_ones_and_keeps_the_way_on_and_the_helper_in_their_places(
    kiosk: tuple[Window, StudyConfig],
) -> None:
    pages, feet = fewer_ratings(kiosk, Layout(1920, 1080))
    for number in (2, 3):
        for before, after in zip(pages[4], pages[number], strict=False):
            assert after[1].height() > before[1].height() + 30
            # Points stand in the same columns, and are as large.
            old, new = before[3], after[3]
            assert (new.left(), new.width(), new.height()) == pytest.approx(
                (old.left(), old.width(), old.height()), abs=1
            )
        standing, below = feet[number]
        assert below.top() == pytest.approx(feet[4][1].top(), abs=1)
        assert standing.top() >= pages[number][-1][1].bottom() + 23
        assert standing.bottom() == pytest.approx(1080, abs=1)
    assert feet[3][0].getRect() == pytest.approx(feet[4][0].getRect(), abs=1)
    # Two leave more than they can use: the helper is larger then.
    assert feet[2][0].height() > 1.1 * feet[4][0].height()


def test_an_upright_page_with_fewer_ratings_has_higher_ones_and_keeps_the_way_on_and_the_helper_in_their_places(
    kiosk: tuple[Window, StudyConfig],
) -> None:
    pages, feet = fewer_ratings(kiosk, Layout(1080, 1920))
    for number in (2, 3):
        for before, after in zip(pages[4], pages[number], strict=False):
            assert after[1].height() > before[1].height() + 60
            assert after[3].height() > before[3].height(), "points are larger"
        assert len({(round(card.height()), round(points.height())) for _, card, _, points in pages[number]}) == 1
    for three, four in zip(feet[3], feet[4], strict=True):
        assert three.getRect() == pytest.approx(four.getRect(), abs=1)
    # Two leave more than they can use: the helper is larger then, and the way on follows the cards.
    assert feet[2][1].top() < feet[4][1].top() - 100
    assert feet[2][0].height() > 1.4 * feet[4][0].height()
    for number in (2, 3):
        assert feet[number][0].top() >= feet[number][1].bottom() + 23
        assert feet[number][0].bottom() == pytest.approx(1920, abs=1)


@pytest.mark.parametrize("language", SHIPPED)
def test_scales_of_a_wide_page_stay_where_they_are_when_their_questions_are_pointed_out(
    kiosk: tuple[Window, StudyConfig], language: str
) -> None:
    window = ratings_in(kiosk, Layout(1920, 1080), language)
    ground = window.shown.contentItem()

    def depths(items: tuple[Item, ...]) -> list[float]:
        lay_out(window.shown)
        points = [find_item(ground, f"answer-{item.id}-1") for item in items]
        return [whole(point).top() for point in points if point is not None]

    try:
        for first in range(0, len(SIXTEEN), 4):
            items = SIXTEEN[first : first + 4]
            window.screens.form.show(items, 2, 5)
            before = depths(items)
            window.screens.form.show_missing(tuple(item.id for item in items))
            assert depths(items) == pytest.approx(before, abs=2)
            assert find_item(ground, "more") is None
    finally:
        window.screens.avatar.leave(away=False)


@pytest.mark.parametrize("language", SHIPPED)
@pytest.mark.parametrize("size", TextSize)
def test_the_title_of_an_upright_page_of_ratings_keeps_its_line_and_the_page_needs_no_scrolling(
    kiosk: tuple[Window, StudyConfig], size: TextSize, language: str
) -> None:
    window = ratings_in(kiosk, Layout(1080, 1920), language)
    ground = window.shown.contentItem()
    try:
        window.screens.kiosk.set_text_size(size)
        window.screens.form.show(SIXTEEN[:4], 2, 5, (), ASKED["social-intelligence"].title)
        lay_out(window.shown)
        title, number = find_item(ground, "page-title"), find_item(ground, "form-progress")
        assert title is not None
        assert title.property("lineCount") == 1
        assert find_item(ground, "page-line") is not None
        # The number goes where both would have no room in one line.
        assert number is not None or size is not TextSize.NORMAL
        assert number is None or size is not TextSize.LARGEST
        assert find_item(ground, "more") is None
    finally:
        window.screens.avatar.leave(away=False)
        window.screens.kiosk.set_text_size(TextSize.NORMAL)


def test_that_an_item_does_not_apply_is_a_column_after_the_points_of_a_wide_page(
    kiosk: tuple[Window, StudyConfig],
) -> None:
    ground, asked = kiosk[0].shown.contentItem(), ASKED["psi"].items
    for first, page in zip(range(0, len(asked), 4), rating_pages(kiosk, Layout(1920, 1080), asked), strict=True):
        assert find_item(ground, "more") is None
        for item, (_, card, shown, points) in zip(asked[first : first + 4], page, strict=True):
            button = find_item(ground, f"not-applicable-{item.id}")
            assert button is not None
            assert shown.right() < points.left()
            assert points.right() + 20 <= whole(button).left() < whole(button).right() < card.right() - 20
            assert abs(whole(button).center().y() - points.center().y()) <= 1


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920)], ids=str)
def test_ten_points_alone_on_a_page_are_alike_and_large_over_its_width_below_a_large_question(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    (four,) = rating_pages(kiosk, layout, SIXTEEN[:4])
    pages = rating_pages(kiosk, layout, ALONE)
    ((_, card, shown, scale),) = next(pages)
    ground = kiosk[0].shown.contentItem()
    places = [
        whole(point) for n in range(1, 11) if (point := find_item(ground, f"answer-{ALONE[0].id}-{n}")) is not None
    ]
    assert len(places) == 10
    wide = layout.width > layout.height
    # An upright page has less room beside them than below.
    assert len({(round(place.width()), round(place.height())) for place in places}) == 1
    assert places[0].width() >= (142 if wide else 80)
    assert places[0].height() == pytest.approx(places[0].width() if wide else 220, abs=1)
    assert all(after.left() - point.right() >= 12 for point, after in pairwise(places))
    numbers = [text for text in texts(ground) if text.property("text") in {str(n) for n in range(1, 11)}]
    assert {text.property("font").pixelSize() >= 48 for text in numbers} == {True}
    assert {text.property("contentWidth") < places[0].width() - 12 for text in numbers} == {True}
    assert scale.left() - card.left() == pytest.approx(card.right() - scale.right(), abs=1)
    assert 28 <= scale.left() - card.left() <= 48
    asked = next(text for text in texts(ground) if text.property("text").replace("\xa0", " ") == ALONE[0].text["en"])
    assert asked.property("font").pixelSize() >= (60 if wide else 72)
    # The card is no higher than what is on it, with as much air above as below.
    assert card.bottom() < four[-1][1].bottom() - 100
    assert card.top() <= four[0][1].top() + 1
    assert abs(shown.center().x() - card.center().x()) <= 2
    ends = [painted(text) for text in texts(ground) if text.property("text") in ("not at all", "completely")]
    assert [end.height() > 60 for end in ends] == [True, True]
    assert abs((shown.top() - card.top()) - (card.bottom() - ends[0].bottom())) <= 16
    assert [ends[0].left(), ends[1].right()] == pytest.approx([scale.left(), scale.right()], abs=1)
    # It is the one to answer next.
    due = find_item(ground, f"due-{ALONE[0].id}")
    assert due is not None
    assert due.opacity() == 1
    assert card.top() + 30 < shown.top() < shown.bottom() + 30 < scale.top() < scale.bottom() + 30 < card.bottom()
    # Its points stay there when it is pointed out.
    kiosk[0].screens.form.show_missing((ALONE[0].id,))
    lay_out(kiosk[0].shown)
    first = find_item(ground, f"answer-{ALONE[0].id}-1")
    assert first is not None
    assert whole(first).topLeft().toTuple() == pytest.approx(scale.topLeft().toTuple(), abs=1)
    assert list(pages) == []


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920)], ids=str)
@pytest.mark.parametrize("kind", ["likert", "differential", "pictures", "slider"])
def test_a_rating_of_any_kind_alone_on_a_page_has_a_card_and_its_width(
    kiosk: tuple[Window, StudyConfig], layout: Layout, kind: str
) -> None:
    ground = kiosk[0].shown.contentItem()
    item = next(item for item in GALLERY.items if item.kind == kind)
    assert list(shown_in(kiosk, layout, (f"one {kind}",))) == [f"one {kind}"]
    card = find_item(ground, f"card-{item.id}")
    assert card is not None
    assert card.property("color").alpha() == 255
    last = item.ends[1] if isinstance(item, Rating) else 0
    names = [f"slider-{item.id}"] if kind == "slider" else [f"answer-{item.id}-1", f"answer-{item.id}-{last}"]
    ends = [whole(part) for name in names if (part := find_item(ground, name)) is not None]
    assert len(ends) == len(names)
    assert round(ends[0].left() - whole(card).left()) == round(whole(card).right() - ends[-1].right()) >= 16
    (described,) = kiosk[0].screens.form.property("items")
    words = [text for text in texts(ground) if text.property("text") in (described["left"], described["right"])]
    assert [text.property("font").pixelSize() for text in words] == [48, 48]
    line = find_item(ground, "page-line")
    assert line is not None
    assert round(whole(line).width()) == round(whole(card).width())


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920)], ids=str)
def test_a_line_of_as_many_parts_as_pages_stands_below_the_title_in_place_of_the_dots(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    ground = kiosk[0].shown.contentItem()
    for page in rating_pages(kiosk, layout):
        line, title = find_item(ground, "page-line"), find_item(ground, "page-title")
        assert line is not None
        assert title is not None
        assert line.property("pages") == 5
        assert whole(title).bottom() <= whole(line).top() < whole(line).bottom() < page[0][1].top()
        assert round(whole(line).width()) == round(page[0][1].width())
        assert find_item(ground, "form-progress") is not None
        assert find_item(ground, "progress") is None


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920), Layout(1080, 1920, robot=True)], ids=str)
def test_the_avatar_shows_its_back_at_one_place_on_the_pages_that_rate_it_and_no_robot_does(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    screens, ground = kiosk[0].screens, kiosk[0].shown.contentItem()
    places = []
    for moment in shown_in(kiosk, layout, ("about you", "trust", "four ratings")):
        screens.avatar.leave(away=moment in RATED)
        lay_out(kiosk[0].shown)
        back = find_item(ground, "turned-away")
        assert (back is not None) == (moment in RATED and not layout.robot)
        places += [] if back is None else [whole(back)]
        why = find_item(ground, "why-turned-away")
        assert (why is None) == (back is None)
        if back is None or why is None:
            continue
        # On the lower edge of the window, with one line beside it, and clear of the ways above it on an upright page.
        wide = layout.width > layout.height
        bubble = find_item(ground, "turned-away-bubble")
        assert bubble is not None
        assert whole(bubble).contains(painted(why))
        before, after = (bubble, back) if wide else (back, bubble)
        assert 0 <= whole(after).left() - whole(before).right() <= 36
        assert whole(bubble).bottom() + 8 <= layout.height
        assert abs(whole(back).bottom() - layout.height) < 1
        assert whole(back).height() >= (180 if wide else 136)
        on = find_item(ground, "continue")
        assert on is not None
        assert wide or whole(back).top() - whole(on).bottom() >= 39
        assert why.property("lineCount") == 1
        assert 34 <= why.property("font").pixelSize() <= 46
    screens.avatar.leave(away=False)
    # In the middle of a wide page, and at the edge of an upright one.
    wanted = layout.width / 2 if layout.width > layout.height else 48
    found = [place.center().x() if layout.width > layout.height else place.left() for place in places]
    assert found == pytest.approx([wanted] * (0 if layout.robot else 2), abs=1)


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1366, 768), Layout(1080, 1920)], ids=str)
@pytest.mark.parametrize("size", TextSize)
@pytest.mark.parametrize("items", [SIXTEEN[:4], ASKED["trust"].items, ALONE], ids=len)
def test_the_back_of_the_avatar_stands_clear_and_still_whatever_is_answered(
    kiosk: tuple[Window, StudyConfig], layout: Layout, size: TextSize, items: tuple[Item, ...]
) -> None:
    window, ground = kiosk[0], kiosk[0].shown.contentItem()
    assert list(shown_in(kiosk, layout, ("four ratings",))) == ["four ratings"]
    # Its words beside the way on are long: with the largest texts, they push the back from the middle.
    window.screens.set_language(next(plan for plan in kiosk[1].plans if plan.language == "es").catalogue)
    screens = window.screens
    turn = partial(screens.form.show, items, 2, 5, alike=pages_alike([SIXTEEN[:4], items], items))
    states: list[Callable[[], None]] = [
        lambda: screens.kiosk.offer_back(offered=False),
        lambda: screens.kiosk.offer_back(offered=True),
        *(partial(screens.form.show_answer, item.id, 3) for item in items),
        turn,
    ]
    if size is TextSize.NORMAL:
        states.append(partial(screens.form.show_missing, tuple(item.id for item in items)))
    places = set()
    try:
        screens.kiosk.set_text_size(size)
        screens.avatar.leave(away=True)
        turn()
        for state in states:
            state()
            lay_out(window.shown)
            assert_all_can_be_read(window.shown, f"{layout}, {size.value}")
            back, on = find_item(ground, "turned-away"), find_item(ground, "continue")
            assert back is not None
            assert on is not None
            assert find_item(ground, "more") is None
            words, upright = find_item(ground, "why-turned-away"), layout.width < layout.height
            places.add((whole(back).getRect(), None if words is None else whole(words).getRect()))
            apart = whole(back).top() - whole(on).bottom() if upright else whole(on).left() - whole(back).right()
            assert apart >= 24 * min(layout.width, layout.height) / 1080 - 1
    finally:
        screens.avatar.leave(away=False)
        screens.kiosk.set_text_size(TextSize.NORMAL)
        screens.kiosk.offer_back(offered=True)
    assert len(places) == 1


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1280, 800), Layout(1080, 1920)], ids=str)
def test_a_long_title_of_a_questionnaire_stands_clear_of_the_controls(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    window, title = kiosk[0], "How far do you agree with each of these sentences about the helper of your game?"
    assert list(shown_in(kiosk, layout, ("trust",))) == ["trust"]
    window.screens.avatar.leave(away=True)
    for items in (ASKED["trust"].items, ALONE):
        window.screens.form.show(items, 10, 12, (), {"en": title})
        for board_on_right in (True, False):
            window.shown.setProperty("boardOnRight", board_on_right)
            lay_out(window.shown)
            assert_all_can_be_read(window.shown, f"{len(items)} items")
    window.screens.avatar.leave(away=False)
    let_go(window.shown)


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1280, 800), Layout(1366, 768, robot=True)], ids=str)
def test_the_keys_of_a_number_cover_no_text_and_no_button_of_a_wide_page(
    kiosk: tuple[Window, StudyConfig], layout: Layout
) -> None:
    window = kiosk[0]
    window.shown.setProperty("screenKeys", "always")
    try:
        assert list(shown_in(kiosk, layout, ("about you",))) == ["about you"]
        window.screens.kiosk.end_input_guard()
        UiDriver(window.shown).click("number-age")
        lay_out(window.shown)
        ground = window.shown.contentItem()
        key = find_item(ground, "key-1")
        assert key is not None
        keys: QQuickItem = key
        while not keys.metaObject().className().startswith("ScreenKeyboard"):
            above = keys.parentItem()
            assert above is not None
            keys = above
        assert QRectF(0, 0, layout.width, layout.height).contains(whole(keys))
        others = [(text, painted(text)) for text in texts(ground)] + [(part, whole(part)) for part in controls(ground)]
        assert [
            str(item.property("text") or item.objectName())
            for item, place in others
            if not belongs(item, keys) and place.intersects(whole(keys))
        ] == []
    finally:
        window.shown.setProperty("screenKeys", "touch")


def test_an_option_is_high_enough_for_a_finger(kiosk: tuple[Window, StudyConfig]) -> None:
    assert list(shown_in(kiosk, Layout(1920, 1080), ("about you",))) == ["about you"]
    options = [
        item for item in controls(kiosk[0].shown.contentItem()) if item.objectName().startswith("option-gender-")
    ]
    assert len(options) > 1
    assert min(option.height() for option in options) >= 70


@pytest.mark.parametrize("layout", [Layout(1920, 1080), Layout(1080, 1920)], ids=str)
def test_start_buttons_are_as_wide_as_each_other(kiosk: tuple[Window, StudyConfig], layout: Layout) -> None:
    assert list(shown_in(kiosk, layout, ("attract",))) == ["attract"]
    starts = [item for item in controls(kiosk[0].shown.contentItem()) if item.objectName().startswith("start-")]
    assert len(starts) == len(SHIPPED)
    assert len({start.width() for start in starts}) == 1


def said(screen: str, plan: SessionConfig) -> tuple[str, str]:
    """Return the longest that is said on a screen, and its advice."""
    catalogue = plan.catalogue
    given = {"introduction": {"cards": 24, "pairs": 12}, "practice": {}, "thanks": {}}
    if screen in given:
        return max(catalogue.wordings(f"{screen}-speech", **given[screen]), key=len), ""
    if screen == "result":
        return max(catalogue.wordings("result-speech-many", moves=188), key=len), ""
    return longest_hint(catalogue) if screen == "game" else ("", "")


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_no_text_is_cut_off_or_covers_another_or_is_too_small_and_what_is_declared_here_needs_no_scrolling(
    opened: Window, study: StudyConfig, sizes: Sequence[float], width: int, height: int
) -> None:
    shown, screens = opened.shown, opened.screens
    english = study.plans[0].language == "en"
    resize(opened, width, height)
    for moment, screen, fill in moments(screens, study):
        fill()
        # English stands in all layouts as the study has it, upright ones too.
        if english and height > width and (screen not in LATER or moment in LATER[screen]):
            continue
        show_alone(opened, screen)
        screens.avatar.say(*longest_hint(study.plans[0].catalogue) if screen in SPEAKING else ("",))
        for text_size in sizes:
            shown.setProperty("textSize", text_size)
            lay_out(shown)
            told = f"{moment}, {text_size}"
            assert_all_can_be_read(shown, told)
            if width > height:
                assert_large_enough(shown, told)
            # Larger or longer texts scroll.
            if english and text_size == 1 and width > height:
                # With a sentence of the helper there is less room than the study's own screens have.
                assert moment.endswith("missing") or find_item(shown.contentItem(), "more") is None, told


def test_words_over_everything_fit(opened: Window, study: StudyConfig, sizes: Sequence[float]) -> None:
    kiosk, shown = opened.screens.kiosk, opened.shown
    for text_size in sizes:
        resize(opened, 1920, 1080)
        show_alone(opened, "attract")
        shown.setProperty("textSize", text_size)
        said = []
        for cover in (
            partial(kiosk.ask_still_there, asks=True),
            partial(kiosk.pause, paused=True),
            partial(kiosk.show, "pause"),
            partial(kiosk.come_back_at, "23:59"),
        ):
            cover()
            lay_out(shown)
            said.append({str(text.property("text")) for text in texts(shown.contentItem())})
            whole = QRectF(0, 0, shown.width(), shown.height())
            assert all(whole.contains(painted(text)) for text in texts(shown.contentItem()))
        names = ("pause-line", "pause-kept", "pause-help", "pause-then")
        line, kept, help_, then = (study.plans[0].catalogue.text(name) for name in names)
        assert [line in each for each in said] == [kept in each for each in said] == [False, True, False, False]
        assert [help_ in each for each in said] == [False, False, True, False]
        assert [then in each for each in said] == [False, False, False, True]
        assert any("23:59" in text for text in said[-1])
        kiosk.come_back_at("")
        kiosk.clear()


def show_practice(window: Window, study: StudyConfig, layout: Layout) -> None:
    """Show the practice of a session that has a code, for a card to lie over."""
    window.shown.resize(layout.width, layout.height)
    QCoreApplication.processEvents()
    assert window.shown.contentItem().width() == layout.width
    window.screens.avatar.appear(present=not layout.robot)
    window.screens.kiosk.begin(SHIPPED, "en", study.plans[0].settings.consent)
    window.screens.kiosk.give_code("WMWMW-MWMWM")
    window.screens.kiosk.show("practice")


@pytest.mark.parametrize(
    "layout",
    [Layout(1920, 1080), Layout(1080, 1920), Layout(1366, 768, robot=True), Layout(720, 1280, robot=True)],
    ids=str,
)
def test_a_card_over_everything_lies_in_the_window_with_all_that_stands_on_it(
    whole_window: tuple[Window, StudyConfig], layout: Layout
) -> None:
    window, study = whole_window
    kiosk, shown = window.screens.kiosk, window.shown
    show_practice(window, study, layout)
    covers: dict[str, tuple[Callable[[], None], Callable[[], None]]] = {
        "stop": (partial(kiosk.ask, "stop"), partial(kiosk.ask, "")),
        "still there": (
            partial(kiosk.ask_still_there, asks=True, wait_ms=20_000),
            partial(kiosk.ask_still_there, asks=False),
        ),
        "pause": (partial(kiosk.pause, paused=True), partial(kiosk.pause, paused=False)),
    }
    ground = QRectF(0, 0, layout.width, layout.height)
    for plan in study.plans:
        window.screens.set_language(plan.catalogue)
        for size in TextSize:
            kiosk.set_text_size(size)
            for name, (cover, uncover) in covers.items():
                cover()
                lay_out(shown)
                card = find_item(shown.contentItem(), "calm-card")
                assert card is not None, name
                told = f"{name}, {plan.language}, {size.value}"
                assert ground.contains(whole(card)), told
                assert all(whole(card).contains(painted(text)) for text in texts(card)), told
                assert all(whole(card).contains(whole(button)) for button in controls(card)), told
                if name != "pause":
                    # The question comes first, and nothing is larger.
                    asked, *others = sorted(texts(card), key=lambda text: whole(text).top())
                    assert asked.property("text") == plan.catalogue.text(f"{name.replace(' ', '-')}-title"), told
                    largest = asked.property("font").pixelSize()
                    assert all(largest > text.property("font").pixelSize() for text in others), told
                uncover()


def shown_words(text: QQuickItem) -> str:
    """Return what a text says, without what keeps its words together."""
    return str(text.property("text")).replace("\xa0", " ")


@pytest.mark.parametrize("layout", LAYOUTS[:4], ids=str)
def test_what_follows_from_stopping_is_read_before_it_is_pressed(
    whole_window: tuple[Window, StudyConfig], layout: Layout
) -> None:
    window, study = whole_window
    kiosk, shown = window.screens.kiosk, window.shown
    catalogue = study.plans[0].catalogue
    window.screens.set_language(catalogue)
    show_practice(window, study, layout)
    kiosk.ask("stop")
    lay_out(shown)
    ground, wide = shown.contentItem(), layout.width > layout.height
    on, stop, ticket = (find_item(ground, name) for name in ("stop-no", "stop-yes", "ticket"))
    assert on is not None
    assert stop is not None
    assert ticket is not None
    frame = whole(ticket)
    (told,) = (text for text in texts(ground) if shown_words(text) == catalogue.text("stop-line-kept"))
    assert painted(told).bottom() < frame.top() < frame.bottom() < min(whole(button).top() for button in (on, stop))
    # Beside the code or above it stands what to do with it, in smaller letters.
    note, code = texts(ticket)
    assert shown_words(note) == catalogue.text("stop-code")
    assert code.objectName() == "noted"
    assert code.property("font").pixelSize() > 1.4 * note.property("font").pixelSize()
    assert (whole(note).right() < whole(code).left()) is wide
    # Both stand in the middle of it.
    both = whole(note).united(whole(code))
    assert both.center().x() == pytest.approx(frame.center().x(), abs=2)
    assert both.center().y() == pytest.approx(frame.center().y(), abs=2)
    kiosk.ask("")


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_what_is_spoken_is_never_longer_than_its_bubble(
    opened: Window, study: StudyConfig, sizes: Sequence[float], width: int, height: int
) -> None:
    catalogue = study.plans[0].catalogue
    resize(opened, width, height)
    show_alone(opened, "attract")
    for text_size in sizes:
        opened.shown.setProperty("textSize", text_size)
        for message in ("introduction-speech", "practice-speech", "thanks-speech"):
            given = {"cards": 24, "pairs": 12} if message.startswith("introduction") else {}
            opened.screens.avatar.say(max(catalogue.wordings(message, **given), key=len))
            lay_out(opened.shown)
            assert all(painted(text).top() >= 0 for text in texts(opened.shown.contentItem())), message
