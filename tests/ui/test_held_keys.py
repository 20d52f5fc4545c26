"""A key that is held down counts once, on every control of every screen; it repeats only where one types or moves."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QGuiApplication, QKeyEvent
from PySide6.QtQuick import QQuickItem, QQuickWindow
from PySide6.QtTest import QTest

from kiosk.experiment.items import Answer, ShortText
from kiosk.ui.app import App
from kiosk.ui.experimenter.view_model import AuthorisationStep
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.headless import often
from tests.ui.reaching import MOST_STOPS
from tests.ui.touring import ASKED, PIN, open_panel, tour, whole_study

WHOLE = often(whole_study())
NO_KEY = Qt.KeyboardModifier.NoModifier
ACTIVATING = (Qt.Key.Key_Space, Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Select)
TEXT = {Qt.Key.Key_Space: " ", Qt.Key.Key_Return: "\r", Qt.Key.Key_Enter: "\r"}


def send(window: QQuickWindow, act: QEvent.Type, key: Qt.Key, text: str, *, again: bool) -> None:
    """Let one event of a key come to the window."""
    QGuiApplication.sendEvent(window, QKeyEvent(act, key, NO_KEY, text, again))


def repeat(window: QQuickWindow, key: Qt.Key, text: str = "", times: int = 3) -> None:
    """Let a key that is held down repeat: as under X, each time as a release and a press, both marked."""
    for _ in range(times):
        send(window, QEvent.Type.KeyRelease, key, text, again=True)
        send(window, QEvent.Type.KeyPress, key, text, again=True)


def hold(window: QQuickWindow, key: Qt.Key, text: str = "") -> None:
    """Press a key, hold it down for a while, and let it go."""
    text = text or TEXT.get(key, "")
    send(window, QEvent.Type.KeyPress, key, text, again=False)
    repeat(window, key, text)
    send(window, QEvent.Type.KeyRelease, key, text, again=False)


def listen(app: App) -> list[object]:
    """Hear of everything that is done to any screen."""
    done: list[object] = []
    shown = app.screens
    card, _, panel = shown.experimenter.parts
    for signal in (
        shown.attract.started,
        shown.kiosk.confirmed,
        *(shown.consent.ticked, shown.consent.agreed, shown.consent.declined),
        shown.age.answered,
        *(shown.form.answered, shown.form.continued),
        *(shown.board.tapped, shown.board.skipped),
        *(shown.about.continued, shown.introduction.continued, shown.result.continued),
        *(shown.debrief.continued, shown.thanks.continued),
        *(card.typed, card.cancelled, panel.wished),
    ):
        signal.connect(lambda *what: done.append(what))
    return done


def test_a_key_that_was_held_down_before_presses_no_control_of_any_screen(make_booth: MakeBooth) -> None:
    app = make_booth(settings=WHOLE).app
    done, window = listen(app), app.window
    pressed: dict[tuple[str, str], list[object]] = {}
    tried: set[str] = set()

    def try_all(moment: str) -> None:
        seen: set[int] = set()
        for _ in range(MOST_STOPS):
            held: QQuickItem | None = window.activeFocusItem()
            # In a field a space is typed, as it should be.
            if held is not None and not held.inherits("QQuickTextInput") and "card:" not in moment:
                tried.add(held.objectName().partition("-")[0])
                before = len(done)
                for key in ACTIVATING:
                    repeat(window, key, TEXT.get(key, ""))
                if done[before:]:
                    pressed[moment, held.objectName()] = done[before:]
            if "card:" in moment or "keys" in moment or moment == "pause":
                return
            QTest.keyClick(window, Qt.Key.Key_Tab)
            reached: QQuickItem | None = window.activeFocusItem()
            if reached is None or hash(reached) in seen:
                return
            seen.add(hash(reached))

    tour(app, try_all)
    assert pressed == {}
    assert tried >= {
        *("start", "continue", "purpose", "agree", "decline", "age", "answer", "slider", "option", "less", "more"),
        *("card", "skip", "action", "condition"),
    }


@pytest.mark.parametrize("key", ACTIVATING)
def test_a_consent_tick_is_set_once(make_booth: MakeBooth, key: Qt.Key) -> None:
    booth = make_booth(settings=WHOLE)
    for name in ("start-en", "continue", "age-yes"):
        booth.click(name)
    # The first stop is the button that shows all of the text.
    booth.press(Qt.Key.Key_Tab)
    booth.press(Qt.Key.Key_Tab)
    hold(booth.app.window, key)
    assert booth.app.screens.consent.property("ticks") == [booth.app.screens.consent.offered[0]]


@pytest.mark.parametrize("key", ACTIVATING[:3])
def test_a_card_is_turned_once_and_no_second_one_by_a_key_that_stays_down(booth: Booth, key: Qt.Key) -> None:
    booth.start_game()
    booth.settle()
    hold(booth.app.window, key)
    booth.press(Qt.Key.Key_Right)
    repeat(booth.app.window, key, TEXT[key])
    assert len(booth.app.screens.board.closed) == 23


@pytest.mark.parametrize("key", ACTIVATING)
def test_an_action_of_the_panel_is_done_once(make_booth: MakeBooth, key: Qt.Key) -> None:
    booth = make_booth(settings=WHOLE)
    booth.click("start-en")
    open_panel(booth.app)
    wished: list[str] = []
    booth.app.screens.experimenter.parts[2].wished.connect(lambda action, _choice: wished.append(action))
    booth.item("action-mute").forceActiveFocus()
    hold(booth.app.window, key)
    assert wished == ["mute"]


def test_a_digit_of_the_pin_counts_once_and_backspace_goes_on(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=WHOLE)
    card = booth.app.screens.experimenter.parts[0]
    booth.press(Qt.Key.Key_P, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    assert card.asks_for is AuthorisationStep.PIN
    for digit in PIN[:3]:
        hold(booth.app.window, Qt.Key(ord(digit)), digit)
    assert card.property("text") == "●●●"
    hold(booth.app.window, Qt.Key.Key_Backspace)
    assert card.property("text") == ""


def test_keys_that_move_repeat(booth: Booth) -> None:
    booth.start_game()
    booth.settle()
    hold(booth.app.window, Qt.Key.Key_Right)
    assert booth.item("board").property("currentIndex") == 4


# From here on, the tests share a kiosk: a second one would take the panel's shortcut as well.


@pytest.fixture
def given(resting_booth: Booth) -> Iterator[list[tuple[str, Answer | None]]]:
    """Provide the answers that the form takes, each of which it then shows."""
    form, answers = resting_booth.app.screens.form, list[tuple[str, Answer | None]]()

    def take(item: str, value: Answer | None) -> None:
        answers.append((item, value))
        form.show_answer(item, value)

    form.answered.connect(take)
    yield answers
    form.answered.disconnect(take)


@pytest.mark.parametrize("key", ACTIVATING[:3])
@pytest.mark.parametrize("kind", ["likert", "differential", "pictures", "single", "multiple", "slider"])
def test_a_choice_is_made_once(
    resting_booth: Booth, given: list[tuple[str, Answer | None]], kind: str, key: Qt.Key
) -> None:
    resting_booth.ask(ASKED[kind])
    resting_booth.press(Qt.Key.Key_Tab)
    hold(resting_booth.app.window, key)
    assert len(given) == 1


@pytest.mark.parametrize("key", ACTIVATING)
def test_a_number_is_stepped_once(resting_booth: Booth, key: Qt.Key) -> None:
    resting_booth.ask(ASKED["integer"])
    resting_booth.press(Qt.Key.Key_Tab)
    resting_booth.item("more-alone").forceActiveFocus()
    hold(resting_booth.app.window, key)
    assert resting_booth.item("number-alone").property("text") == "0"


def test_letters_and_backspace_repeat_in_a_text_field_and_the_way_on_does_not(
    resting_booth: Booth, given: list[tuple[str, Answer | None]]
) -> None:
    resting_booth.ask(ShortText(id="remark", kind="text", text={"en": "Remarks?"}))
    resting_booth.click("text-remark")
    window = resting_booth.app.window
    hold(window, Qt.Key.Key_A, "a")
    hold(window, Qt.Key.Key_Space)
    assert resting_booth.item("text-remark").property("text") == "aaaa" + 4 * " "
    for _ in range(2):
        send(window, QEvent.Type.KeyPress, Qt.Key.Key_Backspace, "", again=True)
    assert resting_booth.item("text-remark").property("text") == "aaaa" + 2 * " "
    hold(window, Qt.Key.Key_Return)
    assert given == [("remark", "aaaa" + 2 * " ")]
