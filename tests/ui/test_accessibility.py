"""Everybody can take part: by name, by keyboard, by touch, with large and strong texts, the board on either side.

What is true of a screen is looked for on every one, the experimenter's too.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from PySide6.QtCore import QObject, QPoint, QRect, Qt
from PySide6.QtGui import QAccessible, QAccessibleInterface, QImage
from PySide6.QtQuick import QQuickItem, QQuickWindow
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.settings import ASSETS, Settings
from kiosk.store.glance import glance
from kiosk.store.reading import archive
from kiosk.study.booth.deeds import Reason
from kiosk.study.booth.notes import Note
from kiosk.study.declared.checked.whole import read_study
from kiosk.study.declared.questionnaire import Answer, Item, Page, Questionnaire
from kiosk.study.events import AnswerGiven, Stage, Status
from kiosk.ui.app import App
from kiosk.ui.rehearsing.hand import find, lay_out
from kiosk.ui.rehearsing.rehearsal import MakeHand, Rehearsal
from kiosk.ui.replaying.replay import Replay
from kiosk.ui.window import Display, Mode, Pace
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.headless import headless
from tests.ui.looking import (
    background,
    colours,
    contrast,
    described,
    identity,
    is_control,
    items,
    lies_in,
    painted,
    place,
    strongest_change,
    texts,
    untold,
)
from tests.ui.reaching import MOST_STOPS, Finger, Keyboard, touch_screen
from tests.ui.touring import CHORD, PIN, tour, whole_study

LEAST_CONTRAST = {"normal": 4.5, "high": 7.0}
LEAST_PIXELS = 24
LEAST_PIXELS_FOR_EXPERIMENTERS = 20
RING_CONTRAST = 3.0
BOARD_SHARE = 0.715
"""How much of a wide window the board and all other screens have; the assistant has the rest."""
EXPERIMENTER = ("PanelLayer", "ReplayControls")
OVER_EVERYTHING = ("CalmCard", *EXPERIMENTER)
KINDS = {"page", "likert", "differential", "slider", "pictures", "single", "multiple", "integer", "text"}
GALLERY = Questionnaire.read(ASSETS / "questionnaires" / "gallery.toml")
ASKED: dict[str, Item] = {item.kind: item for item in GALLERY.items if not isinstance(item, Page)}


@pytest.fixture(autouse=True, scope="module")
def spoken() -> Iterator[None]:
    """A program that reads the screen aloud is there."""
    before = QAccessible.isActive()
    QAccessible.setActive(True)
    yield
    QAccessible.setActive(before)


@dataclass(frozen=True)
class Written:
    """One text as it stands on a screen of 1080 lines."""

    words: str
    pixels: int
    contrast: float
    for_experimenters: bool


@dataclass(frozen=True)
class Sight:
    """What was found on one screen."""

    moment: str
    untold: tuple[str, ...]
    written: tuple[Written, ...]
    strayed: tuple[str, ...]
    """What lies on the wrong side of the window."""
    covered: tuple[str, ...]
    """Texts on which a bar lies that scrolls."""


@dataclass(frozen=True)
class Style:
    """One of the ways in which the screens can look."""

    language: str
    palette: str
    board: str
    text_size: float

    @property
    def settings(self) -> Settings:
        """The whole study, looking so."""
        return whole_study(self.language, contrast=self.palette, board=self.board, text_size=self.text_size)


@dataclass(frozen=True)
class Toured:
    """A tour in one style."""

    style: Style
    sights: tuple[Sight, ...]


STYLES = [Style("en", "normal", "left", 1.0), Style("it", "high", "right", 1.3), Style("es", "normal", "right", 0.5)]


@pytest.fixture(scope="module", params=STYLES, ids=lambda style: f"{style.language}-{style.palette}-{style.board}")
def toured(request: pytest.FixtureRequest, qapp: object, tmp_path_factory: pytest.TempPathFactory) -> Toured:  # noqa: ARG001 - Qt is to be there
    """Everything there is to be seen, in one of the styles: all of them together have every setting and language."""
    style: Style = request.param
    sights: list[Sight] = []
    with headless(style.settings, tmp_path_factory.mktemp("tour")) as app:
        app.window.resize(1920, 1080)
        tour(app, lambda moment: sights.append(look(app.window, moment, style.board)))
    return Toured(style, tuple(sights))


def look(window: QQuickWindow, moment: str, side: str) -> Sight:
    """Look closely at what stands there."""
    picture = window.grabWindow()
    shown = [text for text in texts(window.contentItem()) if _is_in_front(window, text)]
    return Sight(
        moment,
        tuple(untold(window)),
        tuple(_written(picture, text) for text in shown if not painted(text).isEmpty()),
        tuple(_name(item) for item in _laid_out(window) if _is_astray(window, item, side)),
        tuple(_name(text) for text in shown if any(bar.intersects(painted(text)) for bar in _bars(window))),
    )


def _is_in_front(window: QQuickWindow, text: QQuickItem) -> bool:
    """Whether nothing lies over a text: the rest steps back by intent."""
    over = [item for item in items(window.contentItem()) if _covers(item)]
    if any(item.objectName() == "panel" or lies_in(item, "CalmCard") for item in over):
        return lies_in(text, *OVER_EVERYTHING) and not _is_below_a_card(window, text)
    return lies_in(text, *OVER_EVERYTHING) or not any(place(item).intersects(painted(text)) for item in over)


def _covers(item: QQuickItem) -> bool:
    return item.objectName() in {"panel", "pin-card", "experimenter-note"} or (
        item.metaObject().className().startswith("CalmCard")
    )


def _is_below_a_card(window: QQuickWindow, text: QQuickItem) -> bool:
    card = find(window.contentItem(), "pin-card")
    return card is not None and not lies_in(text, "PinCard") and place(card).intersects(painted(text))


def _written(picture: QImage, text: QQuickItem) -> Written:
    color, paper = text.property("color"), background(picture, painted(text))
    return Written(
        str(text.property("text")),
        text.property("font").pixelSize(),
        round(contrast(color, paper), 2),
        lies_in(text, *EXPERIMENTER),
    )


def _laid_out(window: QQuickWindow) -> Iterator[QQuickItem]:
    """The texts and controls of a visitor's screen, and the assistant's bubble."""
    for item in items(window.contentItem()):
        if (is_control(item) or item.inherits("QQuickText")) and not lies_in(item, *OVER_EVERYTHING):
            yield item


def _bars(window: QQuickWindow) -> list[QRect]:
    return [place(item) for item in items(window.contentItem()) if item.inherits("QQuickScrollBar")]


def _is_astray(window: QQuickWindow, item: QQuickItem, side: str) -> bool:
    """Whether the middle of an item is not on its side: screens where the board is, the assistant on the other."""
    across = place(item).center().x() / window.width()
    from_the_board = across if side == "left" else 1 - across
    return (from_the_board > BOARD_SHARE) is not lies_in(item, "SidePanel")


def _name(item: QQuickItem) -> str:
    return f"{item.objectName()} {item.property('text') or ''}".strip()


def test_the_tour_comes_to_every_screen_and_every_kind_of_item(toured: Toured) -> None:
    moments = {sight.moment for sight in toured.sights}
    screens = {"attract", "about", "consent", "consent, missing", "age", "introduction", "practice", "game"}
    screens |= {"result", "debrief", "thanks", "still there", "pause", "panel", "note", "card: pin", "card: wait"}
    assert moments >= screens
    told = " ".join(moment for moment in moments if moment.startswith("form:"))
    assert {kind for kind in KINDS if kind in told} == KINDS
    assert "missing" in told
    assert "keys" in told


def test_every_control_has_a_role_and_a_name_and_every_text_is_told(toured: Toured) -> None:
    assert {sight.moment: sight.untold for sight in toured.sights if sight.untold} == {}


def test_every_text_stands_out_from_what_it_is_written_on(toured: Toured) -> None:
    least = LEAST_CONTRAST[toured.style.palette]
    assert all(sight.written for sight in toured.sights)
    faint = {
        (s.moment, each.words, each.contrast) for s in toured.sights for each in s.written if each.contrast < least
    }
    assert faint == set()


def test_no_text_is_smaller_than_24_pixels_of_1080_lines_and_none_of_the_experimenter_s_than_20(toured: Toured) -> None:
    small = {
        (sight.moment, each.words, each.pixels)
        for sight in toured.sights
        for each in sight.written
        if each.pixels < (LEAST_PIXELS_FOR_EXPERIMENTERS if each.for_experimenters else LEAST_PIXELS)
    }
    assert small == set()


def test_no_bar_that_scrolls_lies_on_a_text(toured: Toured) -> None:
    assert {sight.moment: sight.covered for sight in toured.sights if sight.covered} == {}


def test_every_screen_is_on_the_side_that_was_chosen_and_the_assistant_on_the_other(toured: Toured) -> None:
    assert {sight.moment: sight.strayed for sight in toured.sights if sight.strayed} == {}


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize(
    ("palette", "text", "paper"),
    [(p, *pair) for p in LEAST_CONTRAST for pair in [("white", "lightSea"), ("ink", "sand"), ("white", "sea")]],
)
def test_what_is_under_the_mouse_stands_out_as_well(palette: str, text: str, paper: str) -> None:
    theme = colours(palette)
    assert contrast(theme[text], theme[paper]) >= LEAST_CONTRAST[palette]


@pytest.mark.usefixtures("qapp")
def test_high_contrast_knows_no_pale_tint_and_nothing_that_steps_back() -> None:
    theme = colours("high")
    # What is neither written on nor the paper itself stands out from the paper.
    for name in ("ink", "faintInk", "sea", "lightSea", "deepAmber", "edge"):
        assert contrast(theme[name], theme["paper"]) >= LEAST_CONTRAST["high"], name
    assert theme["done"] == theme["held"] == 1


def sit(app: App, hand: MakeHand, seed: int) -> None:
    """Let a visitor with this hand go through a whole sitting."""
    Rehearsal(app, seed, hand=hand).run()


def answered(booth: Booth) -> tuple[Status | None, int, set[str]]:
    """How the sitting ended, how many pairs were found, and which items have an answer."""
    with archive(booth.data) as stored:
        (sitting,) = stored.sittings()
        given = {event.item for event in stored.events(sitting.id) if isinstance(event, AnswerGiven)}
    return sitting.status, sitting.measures.pairs, given


@pytest.mark.parametrize("hand", [Keyboard, Finger])
@pytest.mark.parametrize("seed", [1, 2])
def test_the_whole_study_with_every_kind_of_item_is_done_by_keyboard_alone_and_by_touch_alone(
    make_booth: MakeBooth, hand: MakeHand, seed: int
) -> None:
    booth = make_booth(settings=whole_study())
    sit(booth.app, hand, seed)
    asked = {item.id for item in ASKED.values()} | {"age", "gender", "robots"}
    assert answered(booth) == (Status.COMPLETED, 3, asked)


@pytest.mark.parametrize("hand", [Keyboard, Finger])
def test_the_study_as_it_comes_is_done_by_keyboard_alone_and_by_touch_alone(
    make_booth: MakeBooth, hand: MakeHand
) -> None:
    booth = make_booth(settings=Settings())
    sit(booth.app, hand, 1)
    status, pairs, given = answered(booth)
    assert (status, pairs) == (Status.COMPLETED, 12)
    assert len(given) > 20


def test_a_finger_drags_what_is_longer_than_the_screen(make_booth: MakeBooth, qtbot: QtBot) -> None:
    booth = make_booth(settings=whole_study(text_size=1.3))
    window = booth.app.window
    window.resize(1280, 720)
    qtbot.waitUntil(lambda: window.contentItem().width() == 1280)
    for name in ("start-en", "continue"):
        booth.click(name)
    booth.settle()
    last = booth.app.screens.consent.offered[0]
    before = place(booth.item(f"purpose-{last}")).y()
    start = QPoint(window.width() // 3, window.height() // 2)
    QTest.touchEvent(window, touch_screen()).press(0, start, window).commit()
    for far in range(20, 220, 20):
        # Qt tells of touches that move once for each picture that it draws.
        with qtbot.waitSignal(window.frameSwapped):
            QTest.touchEvent(window, touch_screen()).move(0, start - QPoint(0, far), window).commit()
            window.update()
    QTest.touchEvent(window, touch_screen()).release(0, start - QPoint(0, 200), window).commit()
    assert place(booth.item(f"purpose-{last}")).y() < before
    assert not booth.app.screens.consent.property("ticks")


@pytest.mark.parametrize("hand", [Keyboard, Finger])
def test_the_keys_on_the_screen_come_to_whoever_points_and_not_to_whoever_has_a_keyboard(
    booth: Booth, hand: type[Keyboard | Finger]
) -> None:
    ask(booth, ASKED["text"])
    hand(booth.app.window).click("text-remark")
    assert booth.item("text-remark").hasActiveFocus()
    assert booth.sees("key-done") is (hand is Finger)


def test_a_new_page_lets_no_key_of_the_last_one_answer_or_skip_it(booth: Booth) -> None:
    done: list[object] = []
    booth.app.screens.form.answered.connect(lambda *given: done.append(given))
    booth.app.screens.form.continued.connect(lambda: done.append("continued"))
    ask(booth, ASKED["likert"], ASKED["single"])
    for key in (Qt.Key.Key_Return, Qt.Key.Key_Space):
        booth.press(key)
    assert done == []
    for key in (Qt.Key.Key_Tab, Qt.Key.Key_Return):
        booth.press(key)
    assert done == [("enjoyed", 1)]


def open_panel(booth: Booth) -> Keyboard:
    """Open the panel with its chord and the PIN."""
    keyboard = Keyboard(booth.app.window)
    keyboard.press(Qt.Key.Key_P, CHORD)
    keyboard.type(PIN)
    keyboard.press(Qt.Key.Key_Return)
    booth.settle()
    return keyboard


def test_the_panel_is_worked_by_keyboard_alone(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=whole_study())
    booth.click("start-en")
    keyboard = open_panel(booth)
    assert booth.app.experimenter.panel.is_open
    keyboard.click("condition-notom")
    keyboard.type("1")
    for name in ("volume-0.2", "deed-quiet"):
        keyboard.click(name)
    keyboard.click("deed-end")
    keyboard.type("5in their own words")
    keyboard.press(Qt.Key.Key_Return)
    booth.wait_until(lambda: booth.app.conductor.stage is not Stage.ABOUT)
    if booth.app.experimenter.panel.is_open:
        keyboard.press(Qt.Key.Key_Escape)
    assert not booth.app.experimenter.panel.is_open
    noted = {
        each.note: each.body["reason"]
        for each in glance(booth.data, 0, simulated=True).deviations
        if each.body.get("reason")
    }
    assert noted == {Note.CONDITION_CHOSEN: Reason.TECHNICAL.value, Note.SITTING_STOPPED: "other: in their own words"}


def stops(window: QQuickWindow) -> Iterator[QQuickItem]:
    """Everything that Tab comes to, once; Tab is pressed on the way."""
    seen: set[int] = set()
    for _ in range(MOST_STOPS):
        QTest.keyClick(window, Qt.Key.Key_Tab)
        held: QQuickItem | None = window.activeFocusItem()
        if held is None or identity(held) in seen:
            return
        seen.add(identity(held))
        yield held


def has_keys_of_its_own(control: QQuickItem) -> bool:
    """Whether other keys than Tab do what it does: arrows scroll and seek, digits choose, letters are typed."""
    name = control.objectName()
    return (
        name in {"more", "board"}
        or name.startswith(("key-", "reason-", "card-"))
        or lies_in(control, *EXPERIMENTER[1:])
    )


@pytest.mark.parametrize("palette", ["normal", "high"])
def test_every_control_is_reached_by_keyboard_and_shows_it(make_booth: MakeBooth, palette: str) -> None:
    app = make_booth(settings=whole_study(contrast=palette)).app
    unseen: set[tuple[str, str]] = set()
    unreached: dict[str, set[str]] = {}

    def go_around(moment: str) -> None:
        if moment == "pause" or "card:" in moment or moment.startswith("note") or moment.endswith("keys"):
            # There is nothing to be reached; or the keys go elsewhere meanwhile; or Tab puts away what stands there.
            return
        window, groups = app.window, set[str]()
        # Whoever points at nothing has no ring, and then takes to the keyboard.
        QTest.mouseClick(window, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, QPoint(1, 1))
        before = window.grabWindow()
        for held in stops(window):
            after = window.grabWindow()
            where = place(held).adjusted(-12, -12, 12, 12)
            if strongest_change(before, after, where) < RING_CONTRAST:
                unseen.add((moment, held.objectName()))
            groups.add(held.objectName().rpartition("-")[0] if _is_one_of_several(held) else held.objectName())
            before = after
        missed = {
            control.objectName() or control.metaObject().className()
            for control in items(window.contentItem())
            if is_control(control)
            and control.isEnabled()
            and not has_keys_of_its_own(control)
            and control.objectName() not in groups
            and control.objectName().rpartition("-")[0] not in groups
        }
        if moment.startswith(("practice", "game")) and not any(name.startswith("card-") for name in groups):
            missed.add("the cards")
        if missed:
            unreached[moment] = missed

    tour(app, go_around)
    assert unseen == set()
    assert unreached == {}


def _is_one_of_several(control: QQuickItem) -> bool:
    """Whether it is one of a group in which arrows go from one to the next."""
    return described(control)[0] in {QAccessible.Role.RadioButton, QAccessible.Role.CheckBox}


def test_the_card_that_the_keyboard_is_at_has_a_ring(booth: Booth) -> None:
    booth.start_game()
    booth.settle()
    where = place(booth.item("card-1"))
    before = booth.app.window.grabWindow()
    booth.press(Qt.Key.Key_Right)
    assert strongest_change(before, booth.app.window.grabWindow(), where) >= RING_CONTRAST


def test_whoever_came_by_keyboard_sees_on_the_next_screen_where_it_is(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=whole_study())
    assert not ringed(booth, f"start-{booth.app.screens.resting.language}")
    booth.press(Qt.Key.Key_Tab)
    booth.press(Qt.Key.Key_Return)
    booth.settle()
    assert booth.screen == "about"
    assert ringed(booth, "continue")
    booth.click("continue")
    booth.settle()
    assert booth.screen == "consent"
    assert not any(ringed(booth, f"purpose-{purpose}") for purpose in booth.app.screens.consent.offered)


def ringed(booth: Booth, name: str) -> bool:
    """Whether there is a ring around a control."""
    return any(item.metaObject().className().startswith("FocusRing") for item in items(booth.item(name)))


def ask(booth: Booth, *asked: Item) -> None:
    """Show a page of these items."""
    booth.app.screens.form.show(asked, 1, 1)
    booth.app.screens.kiosk.show("form")
    booth.settle()


def told(booth: Booth, name: str) -> QAccessibleInterface:
    """What a program that reads the screen knows of an item."""
    found = QAccessible.queryAccessibleInterface(booth.item(name))
    assert isinstance(found, QAccessibleInterface)
    return found


def act(control: QAccessibleInterface, name: str) -> None:
    """Do what a program that reads the screen does when its user says so."""
    control.actionInterface().doAction(name)


Role = QAccessible.Role


@dataclass(frozen=True)
class Choice:
    """An answer to an item that is chosen from several: what is then chosen on the screen, and what is not."""

    role: QAccessible.Role
    answer: Answer
    chosen: str
    other: str


CHOICES = {
    "likert": Choice(Role.RadioButton, 3, "answer-enjoyed-3", "answer-enjoyed-4"),
    "differential": Choice(Role.RadioButton, 7, "answer-clear-7", "answer-clear-1"),
    "pictures": Choice(Role.RadioButton, 1, "answer-mood-1", "answer-mood-2"),
    "single": Choice(Role.RadioButton, "weekly", "option-plays-weekly", "option-plays-never"),
    "multiple": Choice(Role.CheckBox, ("place",), "option-used-place", "option-used-names"),
}


@pytest.mark.parametrize("kind", CHOICES)
def test_what_is_chosen_is_told_in_the_state_of_a_control_and_seen_without_colour(booth: Booth, kind: str) -> None:
    item, choice = ASKED[kind], CHOICES[kind]
    ask(booth, item)
    assert not told(booth, choice.chosen).state().checked
    before = booth.app.window.grabWindow()
    booth.app.screens.form.show_answer(item.id, choice.answer)
    for name, is_chosen in ((choice.chosen, True), (choice.other, False)):
        assert told(booth, name).role() is choice.role
        assert bool(told(booth, name).state().checkable)
        assert bool(told(booth, name).state().checked) is is_chosen
        assert item.text["en"] in told(booth, name).text(QAccessible.Text.Name)
    chosen = place(booth.item(choice.chosen))
    assert strongest_change(before, booth.app.window.grabWindow(), chosen) >= RING_CONTRAST


@pytest.mark.parametrize("action", ["Press", "Toggle"])
@pytest.mark.parametrize("kind", CHOICES)
def test_what_reads_the_screen_chooses_as_well_and_the_state_is_the_answer_s(
    booth: Booth, action: str, kind: str
) -> None:
    given: list[object] = []
    booth.app.screens.form.answered.connect(lambda _, value: given.append(value))
    item, choice = ASKED[kind], CHOICES[kind]
    ask(booth, item)
    act(told(booth, choice.chosen), action)
    assert given == [choice.answer]
    # It was given, and not taken yet.
    assert not told(booth, choice.chosen).state().checked
    booth.app.screens.form.show_answer(item.id, choice.answer)
    booth.click(choice.chosen)
    assert told(booth, choice.chosen).state().checked


def test_a_slider_tells_its_value_and_that_it_has_none_and_is_moved_by_what_reads_the_screen(booth: Booth) -> None:
    given: list[object] = []
    booth.app.screens.form.answered.connect(lambda _, value: given.append(value))
    ask(booth, ASKED["slider"])
    slider = told(booth, "slider-effort")
    assert slider.role() is QAccessible.Role.Slider
    assert slider.text(QAccessible.Text.Description) == "Nothing is chosen yet"
    before = booth.app.window.grabWindow()
    booth.app.screens.form.show_answer("effort", 20)
    assert slider.text(QAccessible.Text.Description) == "20"
    assert slider.valueInterface().currentValue() == 20
    assert strongest_change(before, booth.app.window.grabWindow(), place(booth.item("handle-effort"))) >= RING_CONTRAST
    act(slider, "Increase")
    assert given == [21]


def test_page_up_and_down_home_and_end_move_a_slider_far(booth: Booth) -> None:
    form, given = booth.app.screens.form, list[object]()

    def take(item: str, value: object) -> None:
        given.append(value)
        form.show_answer(item, value)  # type: ignore[arg-type] # a slider's is a number

    form.answered.connect(take)
    ask(booth, ASKED["slider"])
    for key in ("Tab", "Space", "PageUp", "PageDown", "PageDown", "End", "PageUp", "Home", "Right"):
        booth.press(Qt.Key[f"Key_{key}"])
    assert given == [50, 60, 50, 40, 100, 100, 0, 1]


def test_boxes_of_consent_tell_whether_they_are_ticked_and_what_lacks(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=whole_study())
    for name in ("start-en", "continue"):
        booth.click(name)
    first = booth.app.screens.consent.offered[0]
    box = told(booth, f"purpose-{first}")
    assert (box.role(), bool(box.state().checked)) == (QAccessible.Role.CheckBox, False)
    before = booth.app.window.grabWindow()
    booth.click("agree")
    assert box.text(QAccessible.Text.Description) == "Please tick this box if you want to take part."
    assert (
        strongest_change(before, booth.app.window.grabWindow(), place(booth.item(f"purpose-{first}"))) >= RING_CONTRAST
    )
    before = booth.app.window.grabWindow()
    booth.click(f"purpose-{first}")
    assert box.state().checked
    assert (
        strongest_change(before, booth.app.window.grabWindow(), place(booth.item(f"purpose-{first}"))) >= RING_CONTRAST
    )


def test_the_panel_tells_which_choice_holds(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=whole_study())
    booth.click("start-en")
    keyboard = open_panel(booth)
    keyboard.click("volume-0.4")
    assert told(booth, "volume-0.4").role() is QAccessible.Role.RadioButton
    assert [bool(told(booth, f"volume-{each}").state().checked) for each in ("0.2", "0.4", "0.6")] == [
        False,
        True,
        False,
    ]


@pytest.mark.parametrize("kind", sorted(ASKED))
def test_what_is_missed_is_seen_without_colour_and_has_the_keyboard(booth: Booth, kind: str) -> None:
    ask(booth, ASKED[kind])
    before = booth.app.window.grabWindow()
    booth.app.screens.form.show_missing((ASKED[kind].id,))
    lay_out(booth.app.window)
    (words,) = [
        text
        for text in texts(booth.item(f"item-{ASKED[kind].id}"))
        if text.property("text") == "Please answer this one first."
    ]
    assert strongest_change(before, booth.app.window.grabWindow(), painted(words)) >= RING_CONTRAST
    held = Keyboard(booth.app.window).held
    assert is_control(held)
    assert ASKED[kind].id in held.objectName()


@pytest.mark.parametrize(("row", "column"), [(1, None), (None, 2), (1, 2)])
@pytest.mark.parametrize("palette", ["normal", "high"])
def test_a_mark_is_seen_without_colour(
    make_booth: MakeBooth, palette: str, row: int | None, column: int | None
) -> None:
    booth = make_booth(settings=whole_study(contrast=palette))
    booth.app.screens.board.deal(4, 6, 12, "animals")
    booth.app.screens.kiosk.show("game")
    booth.settle()
    where = place(booth.item("card-8"))
    before = booth.app.window.grabWindow()
    booth.app.screens.board.mark(row, column)
    assert strongest_change(before, booth.app.window.grabWindow(), where) >= RING_CONTRAST


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
def test_what_is_said_covers_no_button(make_booth: MakeBooth, qtbot: QtBot, side: str, width: int, height: int) -> None:
    booth = make_booth(settings=whole_study(board=side))
    window = booth.app.window
    window.resize(width, height)
    qtbot.waitUntil(lambda: window.contentItem().width() == width)
    booth.app.screens.avatar.say("Hello!")
    lay_out(window)
    (bubble,) = [text for text in texts(window.contentItem()) if text.property("text") == "Hello!"]
    said = place(bubble)
    assert said.left() >= 0
    assert said.right() < width
    for language in booth.app.screens.attract.property("ways"):
        assert not said.intersects(place(booth.item(f"start-{language['language']}")))


@pytest.mark.parametrize(("side", "left", "right"), [("left", -1.0, -0.5), ("right", 0.5, 1.0)])
def test_the_avatar_looks_where_the_board_is(make_booth: MakeBooth, side: str, left: float, right: float) -> None:
    app = make_booth(settings=whole_study(board=side)).app
    body = app.bodies.current
    assert body is not None
    app.screens.board.deal(4, 6, 12, "animals")
    for column, where in ((0, left), (5, right)):
        body.attend(app.screens.board.place(None, column))
        assert app.screens.avatar.property("gazeX") == pytest.approx(where, abs=0.05)


@pytest.mark.parametrize("language", ["en", "it", "es"])
@pytest.mark.parametrize("palette", ["normal", "high"])
def test_the_bar_of_a_replay_is_told_and_read_as_well(qtbot: QtBot, palette: str, language: str) -> None:
    settings = whole_study(contrast=palette)
    plan = next(plan for plan in read_study(settings).plans if plan.language == language)
    with Replay(Mode(Display.NOWHERE), plan, (), "Sitting 1") as replay:
        qtbot.waitUntil(replay.window.isExposed)
        lay_out(replay.window)
        sight = look(replay.window, "replay", "left")
        (line,) = [item for item in items(replay.window.contentItem()) if item.objectName() == "replay-line"]
        assert described(line) == (QAccessible.Role.Slider, plan.catalogue.text("replay-line"))
    assert sight.untold == ()
    in_the_bar = [each for each in sight.written if each.for_experimenters]
    assert len(in_the_bar) > 3
    assert min(each.contrast for each in in_the_bar) >= LEAST_CONTRAST[palette]
    assert min(each.pixels for each in in_the_bar) >= LEAST_PIXELS_FOR_EXPERIMENTERS


def longest_move(window: QQuickWindow) -> int:
    """How long whatever moves longest in a window takes, in ms."""
    moves = [found for found in window.findChildren(QObject) if found.inherits("QQuickPropertyAnimation")]
    assert moves
    return max(int(found.property("duration")) for found in moves)


@pytest.mark.parametrize(("motion", "moves"), [(False, False), (True, True)])
def test_without_motion_nothing_moves(qapp: object, tmp_path: Path, *, motion: bool, moves: bool) -> None:  # noqa: ARG001 - Qt is to be there
    with headless(whole_study(motion=motion), tmp_path, mode=Mode(Display.NOWHERE, Pace.WALL)) as app:
        lay_out(app.window)
        assert (longest_move(app.window) > 0) is moves
        before = app.window.grabWindow()
        # A voice is heard; the face is seen.
        app.screens.avatar.open_mouth(1.0)
        assert (app.window.grabWindow() != before) is moves
        # Nobody is there, and nothing goes on by itself.
        assert hasattr(app, "_life") is moves
