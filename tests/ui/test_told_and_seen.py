"""What is chosen, missed or marked reaches screen readers, and is seen without colour."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from PySide6.QtGui import QAccessible, QAccessibleInterface

from kiosk.config import ASSETS, Settings
from kiosk.experiment.items import Answer
from kiosk.ui.simulated_visitor import lay_out
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.looking import LEAST_CHANGE, is_control, painted, place, strongest_change, texts
from tests.ui.reaching import Keyboard
from tests.ui.touring import ASKED, whole_study

pytestmark = pytest.mark.usefixtures("spoken")

Role = QAccessible.Role


@pytest.fixture
def booth(resting_booth: Booth) -> Booth:
    """Return one booth for all tests that show a page; what is said to visitors in a session has booths of its own."""
    return resting_booth


def told(booth: Booth, name: str) -> QAccessibleInterface:
    """Return what a program that reads the screen knows of an item."""
    found = QAccessible.queryAccessibleInterface(booth.item(name))
    assert isinstance(found, QAccessibleInterface)
    return found


def act(control: QAccessibleInterface, name: str) -> None:
    """Do what a program that reads the screen does when its user says so."""
    control.actionInterface().doAction(name)


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
    booth.ask(item)
    assert not told(booth, choice.chosen).state().checked
    before = booth.app.window.grabWindow()
    booth.app.screens.form.show_answer(item.id, choice.answer)
    for name, is_chosen in ((choice.chosen, True), (choice.other, False)):
        assert told(booth, name).role() is choice.role
        assert bool(told(booth, name).state().checkable)
        assert bool(told(booth, name).state().checked) is is_chosen
        assert item.text["en"] in told(booth, name).text(QAccessible.Text.Name)
    chosen = place(booth.item(choice.chosen))
    assert strongest_change(before, booth.app.window.grabWindow(), chosen) >= LEAST_CHANGE


@pytest.mark.parametrize("action", ["Press", "Toggle"])
@pytest.mark.parametrize("kind", CHOICES)
def test_what_reads_the_screen_chooses_as_well_and_the_state_is_the_answer_s(
    booth: Booth, action: str, kind: str
) -> None:
    given: list[object] = []
    booth.app.screens.form.answered.connect(lambda _, value: given.append(value))
    item, choice = ASKED[kind], CHOICES[kind]
    booth.ask(item)
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
    booth.ask(ASKED["slider"])
    slider = told(booth, "slider-effort")
    assert slider.role() is QAccessible.Role.Slider
    assert slider.text(QAccessible.Text.Description) == "Nothing is chosen yet"
    before = booth.app.window.grabWindow()
    booth.app.screens.form.show_answer("effort", 20)
    assert slider.text(QAccessible.Text.Description) == "20"
    assert slider.valueInterface().currentValue() == 20
    assert strongest_change(before, booth.app.window.grabWindow(), place(booth.item("handle-effort"))) >= LEAST_CHANGE
    act(slider, "Increase")
    assert given == [21]


def test_boxes_of_consent_tell_whether_they_are_ticked_and_what_lacks(make_booth: MakeBooth) -> None:
    # The sheets of this template have boxes that are needed.
    sheets = {"text": str(ASSETS / "templates" / "children" / "information")}
    settings = whole_study().model_copy(update={"consent": Settings.model_validate({"consent": sheets}).consent})
    booth = make_booth(settings=settings)
    for name in ("start-en", "continue", "age-yes"):
        booth.click(name)
    first = booth.app.screens.consent.offered[0]
    box = told(booth, f"purpose-{first}")
    assert (box.role(), bool(box.state().checked)) == (QAccessible.Role.CheckBox, False)
    before = booth.app.window.grabWindow()
    booth.click("agree")
    assert box.text(QAccessible.Text.Description) == "Please tick this box if you want to take part."
    assert (
        strongest_change(before, booth.app.window.grabWindow(), place(booth.item(f"purpose-{first}"))) >= LEAST_CHANGE
    )
    before = booth.app.window.grabWindow()
    booth.click(f"purpose-{first}")
    assert box.state().checked
    assert (
        strongest_change(before, booth.app.window.grabWindow(), place(booth.item(f"purpose-{first}"))) >= LEAST_CHANGE
    )


@pytest.mark.parametrize("kind", sorted(ASKED))
def test_what_is_missed_is_seen_without_colour_and_has_the_keyboard(booth: Booth, kind: str) -> None:
    booth.ask(ASKED[kind])
    before = booth.app.window.grabWindow()
    booth.app.screens.form.show_missing((ASKED[kind].id,))
    lay_out(booth.app.window)
    (words,) = [
        text
        for text in texts(booth.item(f"item-{ASKED[kind].id}"))
        if text.property("text") in {"Please answer this one first.", "You left this one out. You may leave it."}
    ]
    assert strongest_change(before, booth.app.window.grabWindow(), painted(words)) >= LEAST_CHANGE
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
    booth.app.screens.board.highlight(row, column)
    assert strongest_change(before, booth.app.window.grabWindow(), where) >= LEAST_CHANGE
