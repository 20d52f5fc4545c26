"""The corner: a visitor stops, goes back, and changes language, text size and sound by mouse, touch and keyboard."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.experiment.events import SoundSelected, TextSize, TextSizeSelected
from kiosk.experiment.outcomes import Status
from kiosk.experiment.replay import replay_events
from kiosk.store.queries import open_repository
from kiosk.ui.input import CHOICES_KEPT_MS
from kiosk.ui.simulated_visitor import lay_out
from tests.samples import CATALOGUES
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.headless import SMALL
from tests.ui.looking import appearance, of_kind, painted, place, texts
from tests.ui.reaching import Finger, Keyboard

CONTROLS = ("control-stop", "control-language", "control-text-size", "control-sound")


@pytest.fixture
def reading(make_booth: MakeBooth) -> Booth:
    """Return a booth whose visitor reads what it is about."""
    booth = make_booth(settings=SMALL)
    booth.click("start-en")
    booth.settle()
    return booth


def to_the_form(booth: Booth) -> None:
    """Agree, and come to the questions about the visitor."""
    while booth.screen != "form":
        match booth.screen:
            case "consent":
                for purpose in booth.app.screens.consent.offered:
                    booth.click(f"purpose-{purpose}")
                booth.click("agree")
            case "age":
                booth.click("age-yes")
            case _:
                booth.click("continue")


@pytest.fixture
def resting(make_booth: MakeBooth) -> Booth:
    """Return a booth that waits for a visitor."""
    return make_booth(settings=SMALL)


def test_text_size_and_sound_are_chosen_on_the_start_screen_and_hold_in_the_session(resting: Booth) -> None:
    assert [name for name in CONTROLS if resting.sees(name)] == ["control-text-size", "control-sound"]
    for name in ("control-text-size", "control-text-size", "control-sound"):
        resting.click(name)
    resting.click("start-en")
    resting.settle()
    kiosk = resting.app.screens.kiosk
    assert (kiosk.property("textStep"), kiosk.property("sound"), resting.screen) == (2, False, "about")
    resting.click("control-stop")
    resting.click("stop-yes")
    assert (kiosk.property("textStep"), kiosk.property("sound"), resting.screen) == (0, True, "attract")


def test_what_was_chosen_on_the_start_screen_stands_in_the_record(resting: Booth) -> None:
    resting.click("control-text-size")
    resting.click("control-sound")
    resting.click("start-en")
    to_the_form(resting)
    with open_repository(resting.data) as there:
        (session,) = there.sessions()
        events = there.events(session.id)
    assert TextSizeSelected(at_ms=0, size=TextSize.LARGE) in events
    assert SoundSelected(at_ms=0, on=False) in events


def test_what_a_passer_by_chose_is_taken_back_after_a_minute_without_a_session(resting: Booth) -> None:
    kiosk = resting.app.screens.kiosk
    resting.click("control-text-size")
    resting.click("control-sound")
    chosen_ms = resting.app.clock.now_ms()
    resting.wait_until(lambda: kiosk.property("textStep") == 0)
    assert resting.app.clock.now_ms() - chosen_ms == CHOICES_KEPT_MS
    assert (kiosk.property("textStep"), kiosk.property("sound")) == (0, True)


def test_stop_asks_once_and_then_ends_the_session(reading: Booth) -> None:
    reading.click("control-stop")
    reading.click("stop-no")
    assert reading.screen == "about"
    reading.click("control-stop")
    reading.click("stop-yes")
    assert reading.screen == "attract"
    assert not reading.sees("control-stop")


@pytest.mark.parametrize("scale", [1.0, 1.5])
@pytest.mark.parametrize("size", [(960, 540), (540, 960)], ids=["wide", "upright"])
@pytest.mark.parametrize("language", ["en", "es"])
def test_to_stop_looks_like_to_go_on(
    reading: Booth, qtbot: QtBot, language: str, size: tuple[int, int], scale: float
) -> None:
    window = reading.app.window
    reading.app.screens.set_language(CATALOGUES[language])
    window.setProperty("textSize", scale)
    window.resize(*size)
    qtbot.waitUntil(lambda: window.contentItem().width() == size[0])
    reading.click("control-stop")
    reading.settle()
    on, stop = reading.item("stop-no"), reading.item("stop-yes")
    picture = window.grabWindow()
    assert appearance(stop, picture) == appearance(on, picture)
    assert place(stop).top() == place(on).top()
    signs = [of_kind(button, "Sign") for button in (on, stop)]
    assert [len(each) for each in signs] == [1, 1]
    (first,), (second,) = signs
    assert (first.width(), first.height(), first.property("color")) == (
        second.width(),
        second.height(),
        second.property("color"),
    )
    assert first.property("sign") != second.property("sign")
    reading.press(Qt.Key.Key_Return)
    assert reading.screen == "about"


def test_answers_too_long_to_stand_beside_each_other_stand_below_and_the_way_on_is_first(reading: Booth) -> None:
    reading.click("control-stop")
    on, stop = reading.item("stop-no"), reading.item("stop-yes")
    stop.setProperty("words", "Stop at once and leave all this")
    reading.settle()
    lay_out(reading.app.window)
    assert place(stop).top() > place(on).bottom()
    assert place(stop).left() == place(on).left()
    assert stop.size() == on.size()
    for button in (on, stop):
        (sign,) = of_kind(button, "Sign")
        words = next(each for each in texts(button) if each.property("text") == button.property("words"))
        assert place(sign).right() < painted(words).left()


@pytest.mark.parametrize("kept", ["keep", "delete"])
def test_a_recorded_session_that_is_stopped_is_kept_or_deleted_as_the_study_says(
    kept: str, make_booth: MakeBooth
) -> None:
    consent = {"on_withdrawal": kept, "contact": "lab@example.org"}
    booth = make_booth(settings=Settings.model_validate({**SMALL.model_dump(), "consent": consent}))
    booth.click("start-en")
    to_the_form(booth)
    booth.click("control-stop")
    code = str(booth.app.screens.debrief.property("code"))
    if kept == "keep":
        assert booth.item("noted").property("text") == code
    else:
        assert not booth.sees("noted")
    booth.click("stop-yes")
    with open_repository(booth.data) as there:
        assert [session.status for session in there.sessions()] == ([Status.WITHDRAWN] if kept == "keep" else [])


def test_a_visitor_without_mouse_or_keyboard_stops_by_touch(reading: Booth) -> None:
    finger = Finger(reading.app.window)
    finger.click("control-stop")
    reading.settle()
    finger.click("stop-yes")
    assert reading.screen == "attract"


def test_every_control_is_reached_by_tab_and_has_a_name_for_screen_readers(reading: Booth) -> None:
    keyboard = Keyboard(reading.app.window)
    for name in CONTROLS:
        assert keyboard.go_to(name).objectName() == name
    keyboard.go_to("control-stop")
    reading.press(Qt.Key.Key_Return)
    reading.settle()
    reading.press(Qt.Key.Key_Escape)
    assert reading.screen == "about"


def test_another_language_is_shown_and_the_session_can_be_replayed(reading: Booth) -> None:
    title = str(reading.app.screens.about.property("title"))
    reading.click("control-language")
    reading.click("language-it")
    assert reading.app.screens.about.property("title") != title
    to_the_form(reading)
    with open_repository(reading.data) as there:
        plan, events = there.plan(1), there.events(1)
        steps = replay_events(plan, there.seed(1), events)
    assert plan.language == "en"
    assert all(step.agrees for step in steps)


def test_what_is_typed_and_chosen_outlasts_another_language(reading: Booth) -> None:
    to_the_form(reading)
    form = reading.app.screens.form
    reading.app.screens.form.draft(form.shown[0].id, "3")
    reading.click("control-language")
    reading.click("language-es")
    reading.settle()
    assert reading.item(f"number-{form.shown[0].id}").property("text") == "3"


def test_text_size_goes_up_in_three_steps_and_back_and_is_usual_for_the_next_visitor(reading: Booth) -> None:
    kiosk, heights = reading.app.screens.kiosk, []
    for _ in range(3):
        heights.append(float(str(kiosk.property("textScale"))))
        reading.click("control-text-size")
    assert heights == sorted(set(heights))
    assert kiosk.property("textScale") == heights[0]
    reading.click("control-text-size")
    reading.click("control-stop")
    reading.click("stop-yes")
    assert kiosk.property("textScale") == heights[0]


def test_a_visitor_who_wants_silence_has_it_to_the_end_of_the_session_alone(reading: Booth) -> None:
    reading.click("control-sound")
    assert reading.app.embodiments.is_silent
    assert not reading.app.embodiments.is_muted
    reading.click("control-stop")
    reading.click("stop-yes")
    assert not reading.app.embodiments.is_silent


def test_back_shows_the_page_before_and_what_was_ticked(reading: Booth) -> None:
    while reading.screen != "consent":
        reading.click("age-yes" if reading.screen == "age" else "continue")
    first = reading.app.screens.consent.offered[0]
    reading.click(f"purpose-{first}")
    reading.click("back")
    assert reading.screen in {"about", "age"}
    while reading.screen != "consent":
        reading.click("age-yes" if reading.screen == "age" else "continue")
    assert first in reading.app.screens.consent.property("ticks")


def test_without_a_voice_or_a_sound_card_no_button_promises_sound(resting: Booth) -> None:
    for is_heard in (False, True):
        resting.app.voice.health_changed.emit(is_heard, "")
        resting.settle()
        assert resting.sees("control-sound") is is_heard
