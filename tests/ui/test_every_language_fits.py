"""Every screen in every language, and in one that is 40 % longer and runs the other way: no text is cut off.

Items of questionnaires and information sheets stand in the real languages; the made-up one has the English ones, made
longer in the same way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtQuick import QQuickItem, QQuickWindow
from pytestqt.qtbot import QtBot

from kiosk.assistance.mentaliser import HintReason
from kiosk.assistance.policy import FlipInMove
from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS, Settings
from kiosk.experiment.effects import BoardWait
from kiosk.experiment.information import Information
from kiosk.experiment.items import TextPage
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.experiment.session_config import StudyConfig
from kiosk.study.loader import read_study
from kiosk.ui.screens.registry import ScreenSet
from kiosk.ui.simulated_visitor import find_item, lay_out
from kiosk.ui.window import ClockMode, RunMode, Window, WindowMode
from tests import pseudo

SIZES = [(1280, 720), (1920, 1080), (1080, 1920)]
HALF_A_PIXEL = 0.5
"""Sizes are rounded when texts are measured."""
SMALLEST = 24
"""What a text must at least measure, in pixels of a screen of 1080 lines."""

GALLERY = Questionnaire.read(ASSETS / "questionnaires" / "gallery.toml")
ASKED = {file.stem: Questionnaire.read(file) for file in (ASSETS / "questionnaires").glob("*.toml")}


@pytest.fixture(params=["en", "es", "it", pseudo.LANGUAGE])
def study(request: pytest.FixtureRequest, tmp_path: Path) -> StudyConfig:
    """Return the study in one language."""
    if request.param != pseudo.LANGUAGE:
        return read_study(Settings.model_validate({"languages": [request.param]}))
    whole = read_study(Settings(languages=("en",)))
    (plan,) = whole.plans
    catalogue = Catalogue(pseudo.write(tmp_path))
    return replace(whole, plans=(replace(plan, catalogue=catalogue, information=longer(plan.information)),))


@pytest.fixture(params=[1.0, 1.3])
def window(request: pytest.FixtureRequest, study: StudyConfig, qtbot: QtBot) -> Iterator[Window]:
    """Provide the window of that study, with its texts as large as they are usually, and as large as they can be."""
    (plan,) = study.plans
    if plan.language == pseudo.LANGUAGE and request.param > 1:
        pytest.skip("a language that is 40 % longer is test enough at its usual size")
    screen = plan.settings.screen.model_copy(update={"text_size": request.param})
    sized = replace(plan, settings=plan.settings.model_copy(update={"screen": screen}))
    opened = Window(replace(study, plans=(sized,)), RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL))
    opened.show()
    qtbot.waitUntil(opened.shown.isExposed)
    yield opened
    opened.close()


def longer(sheet: Information) -> Information:
    """Return an information sheet in the made-up language."""

    def rewritten(value: Any) -> Any:
        match value:
            case str():
                return pseudo.sentence(value)
            case dict():
                return {key: item if key in {"id", "version"} else rewritten(item) for key, item in value.items()}
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


def longest_hint(catalogue: Catalogue) -> str:
    """Return the longest that the assistant ever says with a hint."""
    card = catalogue.card("hedgehog")
    reasons = [
        wording
        for which in FlipInMove
        for reason in HintReason
        if (message := f"reason-{which.value}-{reason.value}") in catalogue
        for wording in catalogue.wordings(message, **card)
    ]
    places = catalogue.wordings("point-second-card", row=4, column=6)
    return f"{max(reasons, key=len)} {max(places, key=len)}"


def texts(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every visible text below an item."""
    if not item.isVisible() or item.opacity() == 0:
        return
    if item.inherits("QQuickText") and item.property("text"):
        yield item
    for child in item.childItems():
        yield from texts(child)


def painted(text: QQuickItem) -> QRectF:
    """Where a text's letters are in the window."""
    width, height = float(text.property("contentWidth")), float(text.property("contentHeight"))
    place = text.mapRectToScene(text.boundingRect())
    return QRectF(place.center().x() - width / 2, place.center().y() - height / 2, width, height)


def scrolls(text: QQuickItem) -> QRectF | None:
    """Return the part of the window that a text scrolls in; None if it stands still."""
    above: QQuickItem | None = text.parentItem()
    while above and not (above.inherits("QQuickFlickable") and above.property("interactive")):
        above = above.parentItem()
    return above.mapRectToScene(QRectF(0, 0, above.width(), above.height())) if above else None


def assert_all_can_be_read(shown: QQuickWindow, moment: str) -> None:
    """No text of the window is cut off, reaches out of the window or lies on another one."""
    inside = QRectF(0, 0, shown.width(), shown.height()).adjusted(*(-HALF_A_PIXEL,) * 2, *(HALF_A_PIXEL,) * 2)
    places = [(text, painted(text), scrolls(text)) for text in texts(shown.contentItem())]
    assert places, moment
    for text, place, pane in places:
        told = (moment, text.property("text"), place, pane)
        assert not text.property("truncated"), told
        if pane is None:
            assert inside.contains(place), told
        else:
            assert inside.left() <= place.left() < place.right() <= inside.right(), told
            assert inside.contains(pane), told
    for (one, there, pane), (other, here, other_pane) in combinations(places, 2):
        # Of what scrolls, only what is in sight can be covered by what stands still.
        seen = there if pane == other_pane or pane is None else there.intersected(pane)
        too = here if pane == other_pane or other_pane is None else here.intersected(other_pane)
        assert not seen.intersects(too), (moment, one.property("text"), other.property("text"))


def moments(screens: ScreenSet, study: StudyConfig) -> Iterator[tuple[str, str, Callable[[], None]]]:
    """Every screen with as much to show as it can ever have: a name for it, the screen's, and how it is filled."""
    (plan,) = study.plans
    sheet, language = plan.information, plan.language
    yield "attract", "attract", lambda: None
    yield "about", "about", lambda: screens.about.show(sheet.about)
    yield "consent", "consent", lambda: screens.consent.show(sheet.consent)
    missing = tuple(purpose.id for purpose in sheet.consent.purposes if purpose.required)
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
    for name, items in pages():
        shown = tuple(worded(item, language) for item in items)
        yield name, "form", partial(screens.form.show, shown, 10, 12)
        if not any(isinstance(item, TextPage) for item in items):
            names = tuple(item.id for item in items)
            yield f"{name}, missing", "form", partial(screens.form.show_missing, names)
    screens.debrief.give_contact("memory-study@psychology.university.test")
    screens.debrief.give_code("WWWWWWW")
    screens.debrief.give_summary(sheet.about.paragraphs[0])
    yield "debrief", "debrief", lambda: screens.debrief.show(sheet.debrief)
    yield "thanks", "thanks", lambda: None


def pages() -> Iterator[tuple[str, tuple[Item, ...]]]:
    """Pages of a form: every kind alone, kinds together, and the study's own questionnaires."""
    for item in GALLERY.items:
        yield f"one {item.kind}", (item,)
    asked = tuple(item for item in GALLERY.items if not isinstance(item, TextPage))
    yield "several kinds", asked[:4]
    yield "several other kinds", asked[4:]
    yield "about you", ASKED["about-you"].items
    yield "trust", ASKED["trust"].items
    yield "four ratings", ASKED["social-intelligence"].items[:4]
    yield "six ratings", ASKED["social-intelligence"].items[4:10]


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_no_text_is_cut_off_or_covers_another(
    window: Window, study: StudyConfig, qtbot: QtBot, width: int, height: int
) -> None:
    shown, screens = window.shown, window.screens
    shown.resize(width, height)
    qtbot.waitUntil(lambda: shown.contentItem().width() == width)
    screens.avatar.say(longest_hint(study.plans[0].catalogue))
    for moment, screen, fill in moments(screens, study):
        fill()
        screens.kiosk.show(screen)
        lay_out(shown)
        assert_all_can_be_read(shown, moment)


def test_what_is_declared_for_this_study_needs_no_scrolling(window: Window, study: StudyConfig, qtbot: QtBot) -> None:
    if study.plans[0].language == pseudo.LANGUAGE or window.shown.property("textSize") > 1:
        pytest.skip("larger or longer texts scroll")
    window.shown.resize(1280, 720)
    qtbot.waitUntil(lambda: window.shown.contentItem().width() == 1280)
    for moment, screen, fill in moments(window.screens, study):
        fill()
        window.screens.kiosk.show(screen)
        lay_out(window.shown)
        assert moment.endswith("missing") or find_item(window.shown.contentItem(), "more") is None, moment


def test_no_text_is_smaller_than_can_be_read(window: Window, study: StudyConfig, qtbot: QtBot) -> None:
    window.shown.resize(1920, 1080)
    qtbot.waitUntil(lambda: window.shown.contentItem().width() == 1920)
    for moment, screen, fill in moments(window.screens, study):
        fill()
        window.screens.kiosk.show(screen)
        lay_out(window.shown)
        for text in texts(window.shown.contentItem()):
            size = text.property("font").pixelSize()
            assert size >= SMALLEST, (moment, text.property("text"), size)


def test_words_over_everything_fit(window: Window) -> None:
    kiosk = window.screens.kiosk
    said = []
    for cover in (
        partial(kiosk.ask_still_there, asks=True),
        partial(kiosk.pause, paused=True),
        partial(kiosk.show, "pause"),
    ):
        cover()
        lay_out(window.shown)
        said.append({str(text.property("text")) for text in texts(window.shown.contentItem())})
        whole = QRectF(0, 0, window.shown.width(), window.shown.height())
        assert all(whole.contains(painted(text)) for text in texts(window.shown.contentItem()))
    words = kiosk.property("words")
    assert [words["pause-line"] in each for each in said] == [False, True, False]
    assert [words["pause-help"] in each for each in said] == [False, False, True]


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_what_is_spoken_is_never_longer_than_its_bubble(
    window: Window, study: StudyConfig, qtbot: QtBot, width: int, height: int
) -> None:
    catalogue = study.plans[0].catalogue
    window.shown.resize(width, height)
    qtbot.waitUntil(lambda: window.shown.contentItem().width() == width)
    for message in ("introduction-speech", "practice-speech", "thanks-speech"):
        given = {"cards": 24, "pairs": 12} if message.startswith("introduction") else {}
        window.screens.avatar.say(max(catalogue.wordings(message, **given), key=len))
        lay_out(window.shown)
        assert all(painted(text).top() >= 0 for text in texts(window.shown.contentItem())), message
