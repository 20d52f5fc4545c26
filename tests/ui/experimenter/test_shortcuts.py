"""Every shortcut in every stage does, puts off or refuses what the table says, and asks for what the table says."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtGui import QGuiApplication, QKeyEvent

from kiosk.config import STAGES, Keys
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.experimenter import Action, ActionEffect, Authorisation, permission
from kiosk.experiment.outcomes import EmbodimentName, Stage
from kiosk.ui.experimenter.view_model import AuthorisationStep
from tests.robots.recording import RobotFake
from tests.ui.experimenter.conftest import Desk, MakeDesk, Witness
from tests.ui.visiting import PAIR

ENDING = (Action.ABORT, Action.NEXT)
HOTKEYS = tuple(sorted((Action(name) for name in Keys.model_fields), key=lambda action: action in ENDING))
"""Those that end a session come last: for the next one a visitor has to come all the way again."""
EMPTY = (Stage.ATTRACT, Stage.OVER)


def say_something(assigner: Desk) -> None:
    """Let a sentence be said to its end, if one is said in this stage."""
    app, board = assigner.app, assigner.app.screens.board

    def was_said() -> bool:
        if app.runner.accepts(happened.RepeatRequested(at_ms=app.runner.now_ms())):
            return True
        if assigner.stage is Stage.GAME and board.accepts_taps:
            # A hint comes only to a player who finds nothing.
            app.runner.dispatch(happened.CardSelected(at_ms=app.runner.now_ms(), position=board.closed[0]))
        return False

    if permission(Action.REPEAT, assigner.stage).effect is ActionEffect.NOW:
        assigner.wait_until(was_said)


def done(assigner: Desk, action: Action, witness: Witness) -> bool:
    """Whether what an action does at once, or puts off, is to be seen."""
    app, visited = assigner.app, witness.stage not in EMPTY
    seen: dict[Action, Callable[[], bool]] = {
        Action.PANEL: lambda: assigner.panel.is_open and witness.saw(happened.PauseRequested) is visited,
        Action.CONDITION: lambda: app.assigner.chosen == Condition.TOM,
        Action.EMBODIMENT: lambda: app.embodiments.prefers_avatar,
        Action.REPEAT: lambda: witness.saw(happened.RepeatRequested),
        Action.MUTE: lambda: app.embodiments.is_muted and witness.saw(happened.MuteChanged) is visited,
        Action.PAUSE: lambda: bool(app.screens.kiosk.property("paused")),
        Action.ABORT: lambda: assigner.stage is Stage.ATTRACT and witness.saw(happened.AbortRequested),
        Action.NEXT: lambda: assigner.stage is Stage.ATTRACT is not witness.stage,
        Action.VOLUME: lambda: assigner.notes[-1][0] == "VolumeChanged",
        Action.QUIT: lambda: assigner.notes[-1][0] == "ApplicationQuit",
    }
    return seen[action]()


def undo(assigner: Desk) -> None:
    """Have everything as it was before an action, apart from the stage."""
    app = assigner.app
    app.experimenter.panel.close()
    app.runner.dispatch(happened.PauseEnded(at_ms=app.runner.now_ms()))
    app.embodiments.unmute()
    app.embodiments.prefer(EmbodimentName.robot("furhat"))
    app.assigner.choose(None, "a test")
    assigner.wait_for_note_to_go()


@pytest.mark.parametrize("stage", Stage, ids=lambda stage: stage.value)
def test_every_shortcut_in_this_stage_does_what_the_table_says(stage: Stage, make_assigner: MakeDesk) -> None:
    # A visitor has to come there three times, so there is no other stage but the game.
    stages = [name for name in STAGES if name in {"game", stage.value}]
    assigner = make_assigner(RobotFake(), stages=stages, game={} if stage is Stage.GAME else PAIR["game"])
    assigner.wait_until(lambda: assigner.app.embodiments.settled)
    for action in HOTKEYS:
        undo(assigner)
        assigner.go_to(stage)
        check(assigner, action, stage)


def check(assigner: Desk, action: Action, stage: Stage) -> None:
    """Press the shortcut, answer what it asks, and see that what comes of it is what the table says."""
    if action is Action.REPEAT:
        say_something(assigner)
    witness, held, where = Witness(assigner.app), permission(action, stage), f"{action.value} in {stage.value}"
    refused = held.effect is ActionEffect.REFUSED

    assigner.shortcut(action)
    assert (assigner.card.asks_for is AuthorisationStep.PIN) is (
        not refused and held.asks is not Authorisation.NOTHING
    ), where
    assigner.unlock()
    assert (assigner.card.asks_for is AuthorisationStep.REASON) is (held.asks is Authorisation.PIN_AND_REASON), where
    if assigner.card.asks_for is AuthorisationStep.REASON:
        assigner.type("3")

    assert done(assigner, action, witness) is not refused, where
    if refused:
        assert assigner.noted == "Not now", where
        assert assigner.stage is stage, where
        assert not witness.saw(happened.WorldEvent), where
    if held.asks is Authorisation.PIN_AND_REASON:
        assert assigner.notes[-1][1]["reason"] == "disturbed", where
    if held.effect is ActionEffect.NEXT_SESSION and stage not in EMPTY:
        assert assigner.app.embodiments.current is not None
        assert assigner.app.embodiments.current.name == EmbodimentName.robot("furhat"), where
        assert assigner.stage is stage, where


def test_what_was_put_off_holds_for_the_next_visitor(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(RobotFake(), stages=["introduction", "game"])
    assigner.wait_until(lambda: assigner.app.embodiments.settled)
    assigner.go_to(Stage.INTRODUCTION)
    assigner.do(Action.EMBODIMENT)
    assigner.do(Action.ABORT)
    assert assigner.app.embodiments.current is not None
    assert assigner.app.embodiments.current.name == EmbodimentName.AVATAR
    assigner.do(Action.CONDITION)
    assert assigner.app.assigner.next_session("en").plan.condition == Condition.TOM


def test_a_condition_chosen_before_the_visitor_has_decided_holds_for_the_one_after(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(randomisation={"target_n": {"tom": 2, "notom": 2}, "block_size": 4})
    assigner.app.assigner.choose(Condition.NO_ASSISTANCE, "for this visitor")
    assigner.go_to(Stage.CONSENT)
    assigner.app.assigner.choose(Condition.RANDOM_EXPLAINED, "for the one after")
    assigner.go_to(Stage.INTRODUCTION)
    assigner.do(Action.ABORT)
    assert assigner.app.assigner.next_session("en").plan.condition == Condition.RANDOM_EXPLAINED


def test_a_chosen_condition_holds_until_a_session_in_it_is_on_record(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(randomisation={"target_n": {"tom": 2, "notom": 2}, "block_size": 4})
    assigner.app.assigner.choose(Condition.NO_ASSISTANCE, "a test")
    assigner.go_to(Stage.CONSENT)
    assigner.app.runner.dispatch(happened.ConsentDeclined(at_ms=assigner.app.runner.now_ms()))
    assigner.do(Action.ABORT)
    assert assigner.app.assigner.chosen == Condition.NO_ASSISTANCE
    assigner.go_to(Stage.INTRODUCTION)
    assert assigner.app.assigner.chosen is None


def test_the_condition_goes_round_while_its_dots_are_shown_and_never_tells_its_name(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(randomisation={"target_n": {"tom": 2, "notom": 2}, "block_size": 4})
    assigner.go_to(Stage.ABOUT)
    assigner.do(Action.CONDITION, reason="4")
    seen = [assigner.app.assigner.chosen]
    for _ in range(5):
        assigner.shortcut(Action.CONDITION)
        assert assigner.card.asks_for is AuthorisationStep.NOTHING
        seen.append(assigner.app.assigner.chosen)
        assert assigner.noted == ""
        assert assigner.note.property("dots") == 6
    assert seen[:3] == [Condition.TOM, Condition.NOTOM, Condition.MENTALISED_UNEXPLAINED]
    assert seen[-1] is None
    assert [body["reason"] for kind, body in assigner.notes if kind == "ConditionChosen"] == ["test run"] * 6
    assigner.wait_for_note_to_go()
    assigner.shortcut(Action.CONDITION)
    assert assigner.card.asks_for is AuthorisationStep.PIN


def test_a_shortcut_works_while_a_text_field_has_the_keyboard_and_a_pin_never_gets_into_it(assigner: Desk) -> None:
    assigner.go_to(Stage.ABOUT_YOU)
    typed: list[tuple[str, object]] = []
    assigner.app.screens.form.answered.connect(lambda item, value: typed.append((item, value)))
    assigner.click("number-age")
    assigner.type("4")
    field = assigner.app.window.activeFocusItem()
    assigner.shortcut(Action.PANEL)
    assigner.type("25")
    assert assigner.card.property("text") == "●●"
    assigner.press(Qt.Key.Key_Escape)
    assert assigner.card.asks_for is AuthorisationStep.NOTHING
    assert assigner.app.window.activeFocusItem() is field
    assert field.property("text") == "4"
    assigner.type("2")
    assert field.property("text") == "42"
    assert not [value for _, value in typed if value not in (None, 4, 42)]


def test_a_shortcut_that_is_held_down_is_pressed_once(assigner: Desk) -> None:
    assigner.shortcut(Action.MUTE)
    modifiers = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    for _ in range(3):
        held = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_M, modifiers, "M", True)  # noqa: FBT003 - Qt's signature
        QGuiApplication.sendEvent(assigner.app.window, held)
    assert assigner.app.embodiments.is_muted


def test_the_volume_goes_up_step_by_step_and_from_the_loudest_to_the_softest(assigner: Desk) -> None:
    told = []
    for _ in range(3):
        assigner.shortcut(Action.VOLUME)
        told.append(assigner.noted)
    assert [words.replace("\u2068", "").replace("\u2069", "") for words in told] == [
        "Volume 100 %",
        "Volume 20 %",
        "Volume 40 %",
    ]
    assert [body for kind, body in assigner.notes if kind == "VolumeChanged"] == [
        {"volume": volume} for volume in (1.0, 0.2, 0.4)
    ]


def test_shortcuts_work_while_the_session_is_paused(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["introduction", "game"])
    assigner.go_to(Stage.INTRODUCTION)
    assigner.do(Action.PAUSE)
    assert assigner.app.screens.kiosk.property("paused")
    assigner.do(Action.MUTE)
    assert assigner.app.embodiments.is_muted
    assigner.do(Action.PAUSE)
    assert not assigner.app.screens.kiosk.property("paused")
    assigner.do(Action.ABORT)
    assert assigner.stage is Stage.ATTRACT


def test_a_shortcut_of_the_study_file_takes_the_place_of_the_usual_one(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(shortcuts={"mute": "F8", "quit": ""})
    assigner.press(Qt.Key.Key_M, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    assert not assigner.app.embodiments.is_muted
    assigner.press(Qt.Key.Key_F8)
    assert assigner.app.embodiments.is_muted
    assigner.press(Qt.Key.Key_Q, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    assert assigner.card.asks_for is AuthorisationStep.NOTHING


def test_a_session_that_begins_in_silence_says_so_and_is_only_read(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["introduction", "game"])
    assigner.do(Action.MUTE)
    witness = Witness(assigner.app)
    assigner.go_to(Stage.INTRODUCTION)
    assert [event.muted for event in witness.events if isinstance(event, happened.MuteChanged)] == [True]
    assert witness.saw(happened.SpeechFailed)
    assert not witness.saw(happened.SpeechStarted)


def test_with_thanks_the_next_visitor_needs_no_pin_and_the_session_is_complete(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["game", "thanks"])
    assigner.go_to(Stage.THANKS)
    witness = Witness(assigner.app)
    assigner.shortcut(Action.NEXT)
    assert assigner.stage is Stage.ATTRACT
    assert witness.saw(happened.NextParticipantRequested)
    assert not witness.saw(happened.AbortRequested)


def test_leaving_ends_the_kiosk(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(experimenter={"pin_hash": ""})
    QTimer.singleShot(0, assigner.app.window, lambda: assigner.shortcut(Action.QUIT))
    # If it does not end, the test does not hang.
    QTimer.singleShot(10_000, assigner.app.window, assigner.app.quit)
    assigner.app.run()
    assert assigner.notes == [("ApplicationQuit", {"stage": "attract", "reason": ""})]
