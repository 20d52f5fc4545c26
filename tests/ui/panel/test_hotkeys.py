"""Every chord in every stage does, puts off or refuses what the table says, and asks for what the table says."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtGui import QGuiApplication, QKeyEvent

from kiosk.settings import Keys
from kiosk.study import events as happened
from kiosk.study.booth.deeds import Asks, Deed, Effect, rule
from kiosk.study.condition import Condition
from kiosk.study.events import BodyName, Stage
from kiosk.ui.panel.card import Step
from tests.robot.recording import RobotFake
from tests.ui.panel.conftest import TINY, Desk, MakeDesk, Witness

HOTKEYS = tuple(Deed(name) for name in Keys.model_fields)
EMPTY = (Stage.ATTRACT, Stage.OVER)


def say_something(desk: Desk) -> None:
    """Let a sentence be said to its end, if one is said in this stage."""
    if desk.stage is Stage.GAME:
        # A hint comes only to somebody who finds nothing.
        board = desk.app.screens.board
        while not desk.app.conductor.accepts(happened.RepeatAsked):
            for place in board.closed[:1]:
                desk.app.conductor.tell(happened.CardTapped, position=place)
            desk.jump()
    elif rule(Deed.AGAIN, desk.stage).effect is Effect.NOW:
        desk.wait_until(lambda: desk.app.conductor.accepts(happened.RepeatAsked))


def done(desk: Desk, deed: Deed, witness: Witness) -> bool:
    """Whether what a deed does at once, or puts off, is to be seen."""
    app, visited = desk.app, witness.stage not in EMPTY
    seen: dict[Deed, Callable[[], bool]] = {
        Deed.PANEL: lambda: desk.panel.is_open and witness.saw(happened.PauseAsked) is visited,
        Deed.CONDITION: lambda: app.desk.chosen is Condition.TOM,
        Deed.BODY: lambda: app.bodies.prefers_avatar,
        Deed.AGAIN: lambda: witness.saw(happened.RepeatAsked),
        Deed.QUIET: lambda: app.bodies.is_quiet and witness.saw(happened.SoundChanged) is visited,
        Deed.PAUSE: lambda: bool(app.screens.kiosk.property("paused")),
        Deed.END: lambda: desk.stage is Stage.ATTRACT and witness.saw(happened.EndAsked),
        Deed.NEXT: lambda: desk.stage is Stage.ATTRACT is not witness.stage,
        Deed.LEAVE: lambda: desk.notes[-1][0] == "KioskLeft",
    }
    return seen[deed]()


def undo(desk: Desk) -> None:
    """Have everything as it was before a deed, apart from the stage."""
    app = desk.app
    app.experimenter.panel.close()
    app.conductor.tell(happened.PauseEnded)
    app.bodies.be_heard()
    app.bodies.prefer(BodyName.FURHAT)
    app.desk.choose(None, "a test")
    desk.wait_for_note_to_go()


@pytest.mark.parametrize("stage", Stage, ids=lambda stage: stage.value)
def test_every_chord_in_this_stage_does_what_the_table_says(stage: Stage, make_desk: MakeDesk) -> None:
    desk = make_desk(RobotFake(), game={} if stage is Stage.GAME else TINY["game"])
    desk.wait_until(lambda: desk.app.bodies.settled)
    for deed in HOTKEYS:
        undo(desk)
        desk.go_to(stage)
        check(desk, deed, stage)


def check(desk: Desk, deed: Deed, stage: Stage) -> None:
    """Press the chord, answer what it asks, and see that what comes of it is what the table says."""
    if deed is Deed.AGAIN:
        say_something(desk)
    witness, held, where = Witness(desk.app), rule(deed, stage), f"{deed.value} in {stage.value}"
    refused = held.effect is Effect.REFUSED

    desk.chord(deed)
    assert (desk.card.asks_for is Step.PIN) is (not refused and held.asks is not Asks.NOTHING), where
    desk.unlock()
    assert (desk.card.asks_for is Step.REASON) is (held.asks is Asks.PIN_AND_REASON), where
    if desk.card.asks_for is Step.REASON:
        desk.type("3")

    assert done(desk, deed, witness) is not refused, where
    if refused:
        assert desk.noted == "Not now", where
        assert desk.stage is stage, where
        assert not witness.saw(happened.WorldEvent), where
    if held.asks is Asks.PIN_AND_REASON:
        assert desk.notes[-1][1]["reason"] == "disturbed", where
    if held.effect is Effect.NEXT_SITTING and stage not in EMPTY:
        assert desk.app.bodies.current is not None
        assert desk.app.bodies.current.name is BodyName.FURHAT, where
        assert desk.stage is stage, where


def test_what_was_put_off_holds_for_the_next_visitor(make_desk: MakeDesk) -> None:
    desk = make_desk(RobotFake())
    desk.wait_until(lambda: desk.app.bodies.settled)
    desk.go_to(Stage.INTRODUCTION)
    desk.do(Deed.BODY)
    desk.do(Deed.END)
    assert desk.app.bodies.current is not None
    assert desk.app.bodies.current.name is BodyName.AVATAR
    desk.do(Deed.CONDITION)
    assert desk.app.desk.next_sitting("en").plan.condition is Condition.TOM


def test_a_condition_chosen_before_the_visitor_has_decided_holds_for_the_one_after(make_desk: MakeDesk) -> None:
    desk = make_desk(allocation={"quotas": {"tom": 2, "notom": 2}, "block": 4})
    desk.app.desk.choose(Condition.NO_ASSISTANCE, "for this visitor")
    desk.go_to(Stage.CONSENT)
    desk.app.desk.choose(Condition.RANDOM_EXPLAINED, "for the one after")
    desk.go_to(Stage.INTRODUCTION)
    desk.do(Deed.END)
    assert desk.app.desk.next_sitting("en").plan.condition is Condition.RANDOM_EXPLAINED


def test_a_chosen_condition_holds_until_a_sitting_in_it_is_on_record(make_desk: MakeDesk) -> None:
    desk = make_desk(allocation={"quotas": {"tom": 2, "notom": 2}, "block": 4})
    desk.app.desk.choose(Condition.NO_ASSISTANCE, "a test")
    desk.go_to(Stage.CONSENT)
    desk.app.conductor.tell(happened.DeclineTapped)
    desk.do(Deed.END)
    assert desk.app.desk.chosen is Condition.NO_ASSISTANCE
    desk.go_to(Stage.INTRODUCTION)
    assert desk.app.desk.chosen is None


def test_the_condition_goes_round_while_its_dots_are_shown_and_never_tells_its_name(make_desk: MakeDesk) -> None:
    desk = make_desk(allocation={"quotas": {"tom": 2, "notom": 2}, "block": 4})
    desk.go_to(Stage.ABOUT)
    desk.do(Deed.CONDITION, reason="4")
    seen = [desk.app.desk.chosen]
    for _ in range(5):
        desk.chord(Deed.CONDITION)
        assert desk.card.asks_for is Step.NOTHING
        seen.append(desk.app.desk.chosen)
        assert desk.noted == ""
        assert desk.note.property("dots") == 6
    assert seen[:3] == [Condition.TOM, Condition.NOTOM, Condition.MENTALISED_UNEXPLAINED]
    assert seen[-1] is None
    assert [body["reason"] for kind, body in desk.notes if kind == "ConditionChosen"] == ["test run"] * 6
    desk.wait_for_note_to_go()
    desk.chord(Deed.CONDITION)
    assert desk.card.asks_for is Step.PIN


def test_a_chord_works_while_a_text_field_has_the_keyboard_and_a_pin_never_gets_into_it(desk: Desk) -> None:
    desk.go_to(Stage.ABOUT_YOU)
    typed: list[tuple[str, object]] = []
    desk.app.screens.form.answered.connect(lambda item, value: typed.append((item, value)))
    desk.click("number-age")
    desk.type("4")
    field = desk.app.window.activeFocusItem()
    desk.chord(Deed.PANEL)
    desk.type("25")
    assert desk.card.property("text") == "●●"
    desk.press(Qt.Key.Key_Escape)
    assert desk.card.asks_for is Step.NOTHING
    assert desk.app.window.activeFocusItem() is field
    assert field.property("text") == "4"
    desk.type("2")
    assert field.property("text") == "42"
    assert not [value for _, value in typed if value not in (None, 4, 42)]


def test_a_chord_that_is_held_down_is_pressed_once(desk: Desk) -> None:
    desk.chord(Deed.QUIET)
    modifiers = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    for _ in range(3):
        held = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_M, modifiers, "M", True)  # noqa: FBT003 - Qt's signature
        QGuiApplication.sendEvent(desk.app.window, held)
    assert desk.app.bodies.is_quiet


def test_chords_work_while_the_sitting_is_paused(desk: Desk) -> None:
    desk.go_to(Stage.INTRODUCTION)
    desk.do(Deed.PAUSE)
    assert desk.app.screens.kiosk.property("paused")
    desk.do(Deed.QUIET)
    assert desk.app.bodies.is_quiet
    desk.do(Deed.PAUSE)
    assert not desk.app.screens.kiosk.property("paused")
    desk.do(Deed.END)
    assert desk.stage is Stage.ATTRACT


def test_a_chord_of_the_study_file_takes_the_place_of_the_usual_one(make_desk: MakeDesk) -> None:
    desk = make_desk(keys={"quiet": "F8", "leave": ""})
    desk.press(Qt.Key.Key_M, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    assert not desk.app.bodies.is_quiet
    desk.press(Qt.Key.Key_F8)
    assert desk.app.bodies.is_quiet
    desk.press(Qt.Key.Key_Q, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    assert desk.card.asks_for is Step.NOTHING


def test_a_sitting_that_begins_in_silence_says_so_and_is_only_read(desk: Desk) -> None:
    desk.do(Deed.QUIET)
    witness = Witness(desk.app)
    desk.go_to(Stage.INTRODUCTION)
    assert [event.quiet for event in witness.events if isinstance(event, happened.SoundChanged)] == [True]
    assert witness.saw(happened.SpeechFailed)
    assert not witness.saw(happened.SpeechStarted)


def test_with_thanks_the_next_visitor_needs_no_pin_and_the_sitting_is_complete(desk: Desk) -> None:
    desk.go_to(Stage.THANKS)
    witness = Witness(desk.app)
    desk.chord(Deed.NEXT)
    assert desk.stage is Stage.ATTRACT
    assert witness.saw(happened.NextAsked)
    assert not witness.saw(happened.EndAsked)


def test_leaving_ends_the_kiosk(make_desk: MakeDesk) -> None:
    desk = make_desk(experimenter={"pin": ""})
    QTimer.singleShot(0, desk.app.window, lambda: desk.chord(Deed.LEAVE))
    # If it does not end, the test does not hang.
    QTimer.singleShot(10_000, desk.app.window, desk.app.quit)
    desk.app.run()
    assert desk.notes == [("KioskLeft", {"stage": "attract", "reason": ""})]
