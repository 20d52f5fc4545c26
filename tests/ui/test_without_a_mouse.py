"""Everything works with a keyboard alone or touch alone, and the focus is visible."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAccessible
from PySide6.QtQuick import QQuickItem, QQuickWindow
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.experiment.events import ResponseGiven
from kiosk.experiment.experimenter import AuditEvent, DeviationReason
from kiosk.experiment.outcomes import SessionKind, Stage, Status
from kiosk.store.queries import open_repository
from kiosk.store.snapshot import read_snapshot
from kiosk.ui.app import App
from kiosk.ui.rehearsal import MakeHand, Rehearsal
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.looking import (
    EXPERIMENTERS,
    LEAST_CHANGE,
    described,
    identity,
    is_control,
    items,
    lies_in,
    place,
    strongest_change,
)
from tests.ui.reaching import MOST_STOPS, Finger, Keyboard, touch_screen
from tests.ui.touring import ASKED, open_panel, tour, whole_study

pytestmark = pytest.mark.usefixtures("spoken")


def sit(app: App, hand: MakeHand, seed: int) -> None:
    """Let a visitor with this hand go through a whole session."""
    Rehearsal(app, seed, hand=hand).run()


def answered(booth: Booth) -> tuple[Status | None, int, set[str]]:
    """How the session ended, how many pairs were found, and which items have an answer."""
    with open_repository(booth.data) as stored:
        (session,) = stored.sessions()
        given = {event.item for event in stored.events(session.id) if isinstance(event, ResponseGiven)}
    return session.status, session.pairs, given


@pytest.mark.parametrize("hand", [Keyboard, Finger])
def test_the_whole_study_with_every_kind_of_item_is_done_by_keyboard_alone_and_by_touch_alone(
    make_booth: MakeBooth, hand: MakeHand
) -> None:
    booth = make_booth(settings=whole_study())
    # This visitor skips the practice; that of the study as it comes practises.
    sit(booth.app, hand, 2)
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
    for name in ("start-en", "continue", "age-yes", "read-more"):
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
    booth.ask(ASKED["text"])
    hand(booth.app.window).click("text-remark")
    assert booth.item("text-remark").hasActiveFocus()
    assert booth.sees("key-done") is (hand is Finger)


def test_a_new_page_lets_no_key_of_the_last_one_answer_or_skip_it(booth: Booth) -> None:
    done: list[object] = []
    booth.app.screens.form.answered.connect(lambda *given: done.append(given))
    booth.app.screens.form.continued.connect(lambda: done.append("continued"))
    booth.ask(ASKED["likert"], ASKED["single"])
    for key in (Qt.Key.Key_Return, Qt.Key.Key_Space):
        booth.press(key)
    assert done == []
    for key in (Qt.Key.Key_Tab, Qt.Key.Key_Return):
        booth.press(key)
    assert done == [("enjoyed", 1)]


def test_the_panel_is_worked_by_keyboard_alone(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=whole_study())
    booth.click("start-en")
    keyboard = open_panel(booth.app)
    assert booth.app.experimenter.panel.is_open
    keyboard.click("panel-next")
    keyboard.click("condition-notom")
    keyboard.type("5in their own words")
    keyboard.press(Qt.Key.Key_Return)
    for name in ("volume-0.2", "panel-today", "action-mute"):
        keyboard.click(name)
    keyboard.click("action-end")
    keyboard.type("1")
    booth.wait_until(lambda: booth.app.runner.stage is not Stage.ABOUT)
    if booth.app.experimenter.panel.is_open:
        keyboard.press(Qt.Key.Key_Escape)
    assert not booth.app.experimenter.panel.is_open
    noted = {
        each.kind: each.payload["reason"]
        for each in read_snapshot(booth.data, datetime.now().astimezone(), kind=SessionKind.SIMULATED).deviations
        if each.payload.get("reason")
    }
    assert noted == {
        AuditEvent.CONDITION_CHOSEN: DeviationReason.OTHER.in_own_words("in their own words"),
        AuditEvent.SESSION_ABORTED: DeviationReason.TECHNICAL.value,
    }


def test_page_up_and_down_home_and_end_move_a_slider_far(booth: Booth) -> None:
    form, given = booth.app.screens.form, list[object]()

    def take(item: str, value: object) -> None:
        given.append(value)
        form.show_answer(item, value)  # type: ignore[arg-type] # a slider's is a number

    form.answered.connect(take)
    booth.ask(ASKED["slider"])
    for key in ("Tab", "Space", "PageUp", "PageDown", "PageDown", "End", "PageUp", "Home", "Right"):
        booth.press(Qt.Key[f"Key_{key}"])
    assert given == [50, 60, 50, 40, 100, 100, 0, 1]


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
        or lies_in(control, *EXPERIMENTERS[1:])
    )


def rings_unseen(window: QQuickWindow, groups: set[str]) -> set[str]:
    """Go around with Tab; return where that is not to be seen, and add to the groups what was come to."""
    unseen = set[str]()
    # Without a pointer there is no ring; then the keyboard is used.
    QTest.mouseClick(window, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, QPoint(1, 1))
    before = window.grabWindow()
    for held in stops(window):
        after = window.grabWindow()
        where = place(held).adjusted(-6, -6, 6, 6)
        if strongest_change(before, after, where) < LEAST_CHANGE:
            unseen.add(held.objectName())
        groups.add(held.objectName().rpartition("-")[0] if _is_one_of_several(held) else held.objectName())
        before = after
    return unseen


def test_every_control_is_reached_by_keyboard_and_shows_it_in_all_colours(make_booth: MakeBooth) -> None:
    app = make_booth(settings=whole_study()).app
    unseen: set[tuple[str, str, str]] = set()
    unreached: dict[str, set[str]] = {}

    def go_around(moment: str) -> None:
        if (
            moment in {"pause", "still there"}
            or "card:" in moment
            or moment.startswith("note")
            or moment.endswith("keys")
        ):
            # There is nothing to be reached; or any key, Tab too, answers; or the keys go elsewhere; or Tab puts away
            # what stands there.
            return
        window, groups = app.window, set[str]()
        for palette in ("high", "normal"):
            window.setProperty("highContrast", palette == "high")
            unseen.update((moment, palette, name) for name in rings_unseen(window, groups))
        missed = {
            control.objectName() or control.metaObject().className()
            for control in items(window.contentItem())
            if control.objectName() not in groups
            and control.objectName().rpartition("-")[0] not in groups
            and control.isEnabled()
            and is_control(control)
            and not has_keys_of_its_own(control)
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
    assert strongest_change(before, booth.app.window.grabWindow(), where) >= LEAST_CHANGE


def test_whoever_came_by_keyboard_sees_on_the_next_screen_where_it_is(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=whole_study())
    assert not ringed(booth, f"start-{booth.app.screens.resting.language}")
    booth.press(Qt.Key.Key_Tab)
    booth.press(Qt.Key.Key_Return)
    booth.settle()
    assert booth.screen == "about"
    assert ringed(booth, "continue")
    booth.click("continue")
    booth.click("age-yes")
    booth.settle()
    assert booth.screen == "consent"
    assert not any(ringed(booth, f"purpose-{purpose}") for purpose in booth.app.screens.consent.offered)


def ringed(booth: Booth, name: str) -> bool:
    """Whether there is a ring around a control."""
    return any(item.metaObject().className().startswith("FocusRing") for item in items(booth.item(name)))
