"""The panel: one glance tells how everything is, keys alone do everything, and a session waits while it is open."""

from __future__ import annotations

import json
from datetime import datetime, timedelta
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtQuick import QQuickItem

from kiosk import StorageError, UserInputError
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.experimenter import Action
from kiosk.experiment.outcomes import Stage, Status
from kiosk.sd_notify import BEAT_WITHIN
from kiosk.store.maintenance import FreeSpace
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Recorder
from kiosk.store.snapshot import LONGEST_BREAK_MS, OpenBreak, open_break
from kiosk.ui.event_loop import VirtualClock
from kiosk.ui.experimenter.panel import CLOSE_MS, WORDS
from kiosk.ui.experimenter.view_model import AuthorisationStep
from kiosk.ui.simulated_visitor import find_item
from kiosk.units import MS_PER_SECOND
from tests.samples import CATALOGUES
from tests.ui.conftest import Booth
from tests.ui.experimenter.conftest import Desk, MakeDesk, Witness
from tests.ui.looking import items, lies_in, of_kind

LISTED = {"randomisation": {"target_n": {"tom": 2, "notom": 2}, "block_size": 4}}


def shows(item: QQuickItem, words: str) -> bool:
    """Whether these words are to be seen in an item."""
    if not item.isVisible():
        return False
    return item.property("text") == words or any(shows(child, words) for child in item.childItems())


def records(assigner: Desk) -> dict[str, Any]:
    """Return what the panel tells of the records."""
    shown: dict[str, Any] = assigner.panel.property("records")
    return shown


def choices(assigner: Desk) -> dict[str, Any]:
    """Return what the panel lets one choose."""
    shown: dict[str, Any] = assigner.panel.property("choices")
    return shown


def held(booth: Booth) -> str:
    """Return the name of what has the keyboard."""
    item: QQuickItem | None = booth.app.window.activeFocusItem()
    return item.objectName() if item is not None else ""


def tab_to(assigner: Desk, name: str) -> None:
    """Go around with Tab until this has the keyboard."""
    for _ in range(60):
        if held(assigner) == name:
            return
        assigner.press(Qt.Key.Key_Tab)
    pytest.fail(f"Tab never came to {name}")


def test_every_language_says_everything_of_the_panel() -> None:
    for catalogue in CATALOGUES.values():
        assert [word for word in WORDS if word not in catalogue] == []


def test_a_session_waits_while_the_panel_is_open_and_goes_on_when_it_is_closed(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["practice", "game"])
    assigner.go_to(Stage.PRACTICE)
    witness = Witness(assigner.app)
    assigner.open_panel()
    assert choices(assigner)["underWay"]
    assigner.press(Qt.Key.Key_Escape)
    assert not assigner.panel.is_open
    assert [type(event) for event in witness.events] == [happened.PauseRequested, happened.PauseEnded]
    assert assigner.stage is Stage.PRACTICE


def test_a_session_that_was_paused_before_stays_so(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["practice", "game"])
    assigner.go_to(Stage.PRACTICE)
    assigner.do(Action.PAUSE)
    assigner.open_panel()
    assigner.shortcut(Action.PANEL)
    assert assigner.app.screens.kiosk.property("paused")


def test_a_session_can_be_left_paused_from_within_the_panel(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["practice", "game"])
    assigner.go_to(Stage.PRACTICE)
    assigner.open_panel()
    assert not choices(assigner)["staysPaused"]
    assert choices(assigner)["break"] == "", "none is chosen"
    assigner.click("break-5")
    assert (choices(assigner)["staysPaused"], choices(assigner)["break"]) == (True, "5")
    assigner.click("action-pause")
    assert not assigner.panel.is_open
    assert assigner.app.screens.kiosk.property("paused")
    assigner.open_panel()
    assert choices(assigner)["staysPaused"]
    assigner.click("panel-back")
    assert not assigner.panel.is_open
    assert not assigner.app.screens.kiosk.property("paused")


def times(minutes: int) -> set[str]:
    """Return what the clock may show so many minutes from now."""
    now = datetime.now().astimezone() + timedelta(minutes=minutes)
    return {f"{now + timedelta(seconds=off):%H:%M}" for off in (0, -60)}


def test_a_pause_says_when_it_goes_on_and_is_no_longer_than_the_session_allows(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["practice", "game"])
    kiosk = assigner.app.screens.kiosk
    assigner.go_to(Stage.PRACTICE)
    witness = Witness(assigner.app)
    assigner.open_panel()
    assert [each["value"] for each in choices(assigner)["breaks"]] == ["5", "10", "15"]
    assigner.click("break-10")
    assert not assigner.noted, "the break is taken; 'Not now' would deny it"
    assert choices(assigner)["break"] == "10"
    assigner.shortcut(Action.PANEL)
    assert kiosk.property("paused")
    assert kiosk.back_at in times(10)
    assert kiosk.property("pauseLine") == f"Back at {kiosk.back_at}."
    assert kiosk.property("pauseMore") == "Nothing is lost. It goes on by itself."
    assert kiosk.property("pauseEnds"), "the time is then the largest of its words"
    assigner.do(Action.PAUSE)
    assert not kiosk.property("paused")
    assert kiosk.back_at == ""
    assert [type(event) for event in witness.events] == [happened.PauseRequested, happened.PauseEnded]


def test_a_session_that_is_to_go_on_after_all_says_no_time(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["practice", "game"])
    assigner.go_to(Stage.PRACTICE)
    assigner.open_panel()
    assigner.click("break-5")
    assigner.click("panel-back")
    assert assigner.app.screens.kiosk.back_at == ""
    assert not assigner.app.screens.kiosk.property("paused")


def test_a_session_whose_longest_pause_allows_no_break_can_stay_paused_without_a_time(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["practice", "game"], idle_ms={"pause": 120_000})
    assigner.go_to(Stage.PRACTICE)
    assigner.open_panel()
    assert [each["value"] for each in choices(assigner)["breaks"]] == ["0"]
    assigner.click("break-0")
    assert (choices(assigner)["staysPaused"], choices(assigner)["break"]) == (True, "0")
    assert assigner.app.screens.kiosk.back_at == ""
    assigner.click("action-pause")
    assert not assigner.panel.is_open
    assert assigner.app.screens.kiosk.property("paused")


def test_a_pause_by_shortcut_is_chosen_in_the_panel_and_a_time_takes_its_place(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["practice", "game"])
    assigner.go_to(Stage.PRACTICE)
    assigner.do(Action.PAUSE)
    assigner.open_panel()
    assert [each["value"] for each in choices(assigner)["breaks"]] == ["5", "10", "15", "0"]
    assert choices(assigner)["break"] == "0"
    assigner.click("break-5")
    assert [each["value"] for each in choices(assigner)["breaks"]] == ["5", "10", "15"]
    assert choices(assigner)["break"] == "5"


@pytest.mark.parametrize("by_button", [True, False])
def test_a_break_between_visitors_takes_none_until_it_is_ended(assigner: Desk, *, by_button: bool) -> None:
    kiosk = assigner.app.screens.kiosk
    assigner.open_panel()
    assigner.click("break-30")
    assigner.shortcut(Action.PANEL)
    assert assigner.screen == "pause"
    assert kiosk.property("pauseLine").removeprefix("Back at ").removesuffix(".") in times(30)
    assert kiosk.property("pauseMore") == "You can play then.", "nothing of a visitor's is there to be lost"
    assigner.app.runner.start("en")
    assert assigner.screen == "pause"
    assigner.open_panel()
    # Its button stands in place of that for the next visitor, whose shortcut ends it too.
    assert not assigner.sees("action-next")
    if by_button:
        assigner.click("break-end")
    else:
        assigner.do(Action.NEXT)
    assert assigner.stage is Stage.ATTRACT
    assert kiosk.back_at == ""
    assigner.app.runner.start("en")
    assert assigner.stage is not Stage.ATTRACT


def test_a_break_between_visitors_outlives_a_failure_of_the_kiosk(make_assigner: MakeDesk) -> None:
    failing = make_assigner()
    failing.open_panel()
    failing.click("break-30")
    told = failing.app.screens.kiosk.property("pauseLine")
    ((minutes, back_ms),) = [each.values() for kind, each in failing.notes if kind == "BreakBegan"]
    assert minutes == 30
    assert f"{datetime.fromtimestamp(back_ms / MS_PER_SECOND).astimezone():%H:%M}" in told
    failing.close()
    again = make_assigner(data=failing.data)
    assert again.screen == "pause"
    assert again.app.screens.kiosk.property("pauseLine") == told
    again.open_panel()
    again.click("break-end")
    assert again.notes[-1] == ("BreakEnded", {})
    again.close()
    assert make_assigner(data=failing.data).screen == "attract"


def test_a_break_is_not_taken_up_again_by_a_kiosk_that_was_left_or_on_another_day(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        recorder.add_audit_event("BreakBegan", {"minutes": 15, "back_ms": 900_000}, wall_ms=1)
        assert open_break(tmp_path, 2) == OpenBreak(15, 900_000)
        assert open_break(tmp_path, 2 + LONGEST_BREAK_MS) is None
        recorder.add_audit_event("ApplicationQuit", {"stage": "over", "reason": ""}, wall_ms=2)
    assert open_break(tmp_path, 2) is None


def test_nothing_behind_the_panel_can_be_reached(assigner: Desk) -> None:
    assigner.open_panel()
    assigner.settle()
    reached = set()
    for _ in range(40):
        reached.add(held(assigner))
        assigner.press(Qt.Key.Key_Tab)
    assert not [name for name in reached if name.startswith("start")]
    assert {"panel-back", "panel-next", "action-mute", "test-voice"} <= reached
    # Its ways back say what they do; the cross of the other pages would be one more.
    assert not assigner.sees("panel-close")


def test_keys_alone_choose_the_next_condition_with_a_reason(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(**LISTED)
    assigner.open_panel()
    for name in ("panel-next", "names-of-choices", "condition-notom"):
        tab_to(assigner, name)
        assigner.press(Qt.Key.Key_Return)
    assert assigner.card.asks_for is AuthorisationStep.REASON
    assigner.type("4")
    assert assigner.app.assigner.chosen == Condition.NOTOM
    assigner.wait_until(lambda: choices(assigner)["condition"] == "notom")
    assert held(assigner) == "condition-notom"
    assigner.wait_until(lambda: bool(records(assigner)["deviations"]))
    first = records(assigner)["deviations"][0]
    assert (first["words"], first["reason"]) == ("next condition: no ToM", "test run")


def test_arrows_go_around_as_tab_does(assigner: Desk) -> None:
    assigner.open_panel()
    assigner.settle()
    assert held(assigner) == "panel-back"
    assigner.press(Qt.Key.Key_Down)
    after = held(assigner)
    assigner.press(Qt.Key.Key_Up)
    assert held(assigner) == "panel-back" != after


def test_the_keyboard_is_the_visitors_again_when_the_panel_is_closed(assigner: Desk) -> None:
    assigner.go_to(Stage.INTRODUCTION)
    assigner.settle()
    before = assigner.app.window.activeFocusItem()
    assigner.open_panel()
    assigner.press(Qt.Key.Key_Escape)
    assigner.settle()
    assert assigner.app.window.activeFocusItem() is before


def test_it_closes_by_itself_when_nobody_is_at_it_and_asks_for_the_pin_again(assigner: Desk) -> None:
    assert isinstance(assigner.app.clock, VirtualClock)
    assigner.open_panel()
    opened = assigner.app.clock.now_ms()
    assigner.wait_until(lambda: assigner.app.clock.now_ms() - opened > CLOSE_MS / 2)
    assigner.press(Qt.Key.Key_Tab)
    stirred = assigner.app.clock.now_ms()
    assigner.wait_until(lambda: not assigner.panel.is_open)
    assert CLOSE_MS <= assigner.app.clock.now_ms() - stirred < CLOSE_MS + 2000
    assigner.shortcut(Action.PANEL)
    assert assigner.card.asks_for is AuthorisationStep.PIN


def test_counts_stand_against_the_quotas_and_the_last_sessions_tell_how_they_ended(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(**LISTED, stages=["game", "result"])
    assigner.go_to(Stage.RESULT)
    assigner.app.runner.dispatch(happened.ContinuePressed(at_ms=assigner.app.runner.now_ms()))
    assigner.go_to(Stage.GAME)
    assigner.do(Action.ABORT, reason="2")
    assigner.open_panel()
    assigner.wait_until(lambda: len(records(assigner)["sessions"]) == 2)
    stopped, completed = records(assigner)["sessions"]
    assert (stopped["participant"], stopped["stage"], stopped["status"], stopped["odd"]) == (
        "2",
        "game",
        "stopped",
        True,
    )
    assert (completed["participant"], completed["status"], completed["odd"]) == ("1", "completed", False)
    assert sorted(cell["done"] for cell in records(assigner)["cells"]) == ["0 / 2", "1 / 2"]
    assert sum(int(cell["counts"][0] or 0) for cell in records(assigner)["cells"]) == 1
    assert records(assigner)["deviations"][0]["words"] == "session stopped in: game"
    assigner.click("panel-sessions")
    assert shows(assigner.app.window.contentItem(), "of quota")


def test_without_a_list_the_panel_counts_sessions_begun_and_has_no_quota(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["game"])
    assigner.go_to(Stage.GAME)
    assigner.open_panel()
    assigner.wait_until(lambda: bool(records(assigner)["cells"]))
    (cell,) = records(assigner)["cells"]
    assert (records(assigner)["listed"], cell["listed"], cell["done"]) == (False, False, "1")
    assigner.click("panel-sessions")
    window = assigner.app.window.contentItem()
    assert [words for words in ("begun", "of quota") if shows(window, words)] == ["begun"]


def test_the_condition_of_the_session_under_way_is_not_told(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(**LISTED, stages=["game"])
    assigner.go_to(Stage.GAME)
    assigner.open_panel()
    assigner.wait_until(lambda: bool(records(assigner)["sessions"]))
    (under_way,) = records(assigner)["sessions"]
    assert under_way["condition"] == "hidden"
    assert under_way["status"] == "under way"


@pytest.mark.parametrize("stage", [Stage.CONSENT, Stage.GAME])
def test_while_somebody_plays_no_condition_is_told_of_anybody(make_assigner: MakeDesk, stage: Stage) -> None:
    assigner = make_assigner(**LISTED, stages=["consent", "game"])
    assigner.app.assigner.choose(Condition.NOTOM, "test run")
    assigner.go_to(stage)
    assigner.open_panel()
    assigner.wait_until(lambda: bool(records(assigner)["deviations"]))
    assert choices(assigner)["condition"] == "automatic"
    assert [cell["name"] for cell in records(assigner)["cells"]] == ["A", "B"]
    assert {each["label"] for each in choices(assigner)["conditions"]} >= {"automatic", "A", "B"}
    assert "ToM" not in json.dumps(records(assigner))
    assert any(noted["words"] == "next condition: hidden" for noted in records(assigner)["deviations"])


def matters(assigner: Desk) -> list[str]:
    """Return the names of what stands in the notice, from above."""
    return [line["name"] for line in assigner.panel.property("health")["matters"]]


def test_the_notice_has_all_that_is_to_be_done_and_the_checks_only_what_is_well(
    assigner: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(BEAT_WITHIN, "30000000")
    assigner.app.experimenter.upkeep.free_space = FreeSpace(4000)
    assigner.open_panel()
    window = assigner.app.window.contentItem()
    assert matters(assigner) == ["Database"]
    assert shows(window, "Disk")
    tab_to(assigner, "action-backup")
    assigner.app.experimenter.upkeep.free_space = FreeSpace(100)
    assigner.wait_until(lambda: matters(assigner) == ["Database", "Disk"])
    # The keyboard stays on the button in the notice, which stands nowhere else.
    assert held(assigner) == "action-backup"
    (notice,) = of_kind(assigner.app.window.contentItem(), "PanelNotice")
    assert lies_in(assigner.item("action-backup"), "PanelNotice")
    assert [item.objectName() for item in items(notice) if item.objectName().startswith("action-")] == ["action-backup"]
    assert shows(window, "Disk: only 100 MiB free")
    assert not shows(window, "Disk")
    assigner.press(Qt.Key.Key_Return)
    assigner.wait_until(lambda: matters(assigner) == ["Disk"])
    assert shows(window, "Database")


def test_the_sound_goes_off_and_on_by_one_key_though_its_button_moves_to_the_notice(assigner: Desk) -> None:
    assigner.open_panel()
    tab_to(assigner, "action-mute")
    for place in ("PanelNotice", "PanelActions", "PanelNotice"):
        assigner.press(Qt.Key.Key_Return)
        assigner.wait_until(partial(holds_the_sound, assigner, place))
        assert choices(assigner)["muted"] is (place == "PanelNotice")


def holds_the_sound(assigner: Desk, place: str) -> bool:
    """Whether the keyboard is on the button of the sound, and that is to be seen in this part of the panel."""
    item: QQuickItem | None = assigner.app.window.activeFocusItem()
    return item is not None and item.objectName() == "action-mute" and item.isVisible() and lies_in(item, place)


def test_the_panel_shows_where_the_keyboard_is_once_a_key_is_pressed(assigner: Desk) -> None:
    def ringed() -> bool:
        return any(ring.isVisible() for ring in of_kind(assigner.app.window.contentItem(), "FocusRing"))

    assigner.open_panel()
    assert held(assigner) == "panel-back"
    assert not ringed()
    assigner.press(Qt.Key.Key_Tab)
    assert ringed()


def test_the_shortcuts_and_how_to_go_around_are_one_press_away(assigner: Desk) -> None:
    assigner.open_panel()
    told = [assigner.panel.property("shortcuts")["title"], CATALOGUES["en"].text("console-keys")]
    window = assigner.app.window.contentItem()
    assert [shows(window, each) for each in told] == [False, False]
    tab_to(assigner, "panel-next")
    assigner.press(Qt.Key.Key_Return)
    assert [shows(window, each) for each in told] == [True, True]
    assert held(assigner) == "panel-next"
    # The cross is the way back from the pages that have no other.
    tab_to(assigner, "panel-close")
    assigner.press(Qt.Key.Key_Return)
    assert not assigner.panel.is_open


def test_a_voice_that_is_lost_is_written_down_and_shown_among_the_days_events(assigner: Desk) -> None:
    for is_heard, message in (
        (False, "sentences are only shown: the sound device is gone"),
        (True, "the voice anna speaks"),
    ):
        assigner.app.voice.health_changed.emit(is_heard, message)
    assert [body for kind, body in assigner.notes if kind == "VoiceChanged"] == [
        {"is_heard": False, "message": "sentences are only shown: the sound device is gone"},
        {"is_heard": True, "message": "the voice anna speaks"},
    ]
    assigner.open_panel()
    assigner.wait_until(
        lambda: any("the sound device is gone" in row["words"] for row in records(assigner)["deviations"])
    )


STAGES = ["game", "questions"]


def test_a_session_that_was_cut_off_goes_on_from_the_start_of_its_stage(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=STAGES)
    assigner.go_to(Stage.QUESTIONS)
    assigner.close()
    again = make_assigner(data=assigner.data, stages=STAGES)
    again.open_panel()
    again.wait_until(lambda: bool(records(again)["resumable"]))
    (cut_off,) = records(again)["resumable"]
    assert "questions" in cut_off["label"]
    again.click(f"resume-{cut_off['number']}")
    assert again.card.asks_for is AuthorisationStep.REASON
    again.type("1")
    again.wait_until(lambda: again.stage is Stage.QUESTIONS)
    assert again.notes[-1] == ("SessionResumed", {"session": 1, "reason": "technical problem"})
    again.shortcut(Action.PANEL)
    assert not again.app.screens.kiosk.property("paused")
    assert again.screen == "form"


def cut_off(make_assigner: MakeDesk) -> Desk:
    """Return a booth whose panel offers to go on with a session."""
    assigner = make_assigner(stages=STAGES)
    assigner.go_to(Stage.QUESTIONS)
    assigner.close()
    again = make_assigner(data=assigner.data, stages=STAGES)
    again.open_panel()
    again.wait_until(lambda: bool(records(again)["resumable"]))
    return again


def ask_to_go_on(assigner: Desk) -> None:
    """Choose that session, and give a reason."""
    assigner.click("resume-1")
    assigner.type("1")
    assigner.wait_until(lambda: bool(assigner.noted))


def refuse_to_resume(*_: object) -> None:
    """Stand in for a store that knows why a session cannot go on."""
    raise UserInputError("its participant has come back since")


def test_a_session_that_cannot_go_on_after_all_is_no_deviation(
    make_assigner: MakeDesk, monkeypatch: pytest.MonkeyPatch
) -> None:
    assigner = cut_off(make_assigner)
    monkeypatch.setattr(Recorder, "resume", refuse_to_resume)
    ask_to_go_on(assigner)
    assert "its participant has come back since" in assigner.noted
    assert assigner.stage is Stage.ATTRACT
    assert "SessionResumed" not in dict(assigner.notes)


def test_a_session_does_not_go_on_where_that_cannot_be_noted_and_can_once_it_can(
    make_assigner: MakeDesk, monkeypatch: pytest.MonkeyPatch
) -> None:
    assigner = cut_off(make_assigner)
    with monkeypatch.context() as patch:
        patch.setattr(Recorder, "add_audit_event", refuse_to_write)
        ask_to_go_on(assigner)
        assert assigner.noted == "It could not be written down, so nothing was changed"
        assert assigner.stage is Stage.ATTRACT
    with open_repository(assigner.data) as stored:
        assert not any(isinstance(event, happened.SessionResumed) for event in stored.events(1))
    assigner.wait_for_note_to_go()
    assigner.click("resume-1")
    assigner.type("1")
    assigner.wait_until(lambda: assigner.stage is Stage.QUESTIONS)
    assert dict(assigner.notes)["SessionResumed"] == {"session": 1, "reason": "technical problem"}


def test_a_session_that_was_cut_off_in_the_game_cannot_go_on(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(stages=["game"])
    assigner.go_to(Stage.GAME)
    assigner.close()
    again = make_assigner(data=assigner.data, stages=["game"])
    again.open_panel()
    again.wait_until(lambda: bool(records(again)["sessions"]))
    assert records(again)["sessions"][0]["status"] == Status.INTERRUPTED.value
    assert records(again)["resumable"] == []


def test_the_volume_holds_at_once_and_the_language_at_rest_from_the_next_session_on(
    assigner: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    turned: list[float] = []
    monkeypatch.setattr(assigner.app.voice, "set_volume", turned.append)
    assigner.go_to(Stage.ABOUT)
    assigner.open_panel()
    assigner.click("panel-next")
    assigner.click("volume-0.4")
    assigner.click("language-it")
    assigner.type("1")
    assert turned == [0.4]
    assert assigner.app.screens.attract.property("title") == CATALOGUES["en"].text("attract-title")
    assigner.do(Action.ABORT)
    assert turned == [0.4, 0.4]
    assert assigner.app.screens.attract.property("title") == CATALOGUES["it"].text("attract-title")
    assert ("VolumeChanged", {"volume": 0.4}) in assigner.notes


def test_what_the_disk_does_not_take_is_not_done_and_said(assigner: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    assigner.open_panel()
    monkeypatch.setattr(Recorder, "add_audit_event", refuse_to_write)
    assigner.click("panel-next")
    assigner.click("condition-notom")
    assigner.type("1")
    assert assigner.app.assigner.chosen is None
    assert assigner.noted == "It could not be written down, so nothing was changed"
    assigner.wait_until(lambda: "could not be written" in str(assigner.panel.property("health")["matters"]))


def refuse_to_write(*_: object) -> None:
    """Refuse to write, as a full disk does."""
    raise StorageError("what happened could not be written: disk I/O error")


def test_visitors_see_neither_panel_nor_card_while_nobody_asks_for_them(assigner: Desk) -> None:
    assigner.go_to(Stage.ABOUT)
    for name in ("panel", "pin-card", "experimenter-note"):
        item = find_item(assigner.app.window.contentItem(), name)
        assert item is None or not item.isVisible()


def test_conditions_are_named_only_on_request_and_by_letters_again_at_the_next_opening(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(**LISTED, stages=["game"])
    assigner.go_to(Stage.GAME)
    assigner.open_panel()
    assigner.wait_until(lambda: bool(records(assigner)["cells"]))
    assert [cell["name"] for cell in records(assigner)["cells"]] == ["A", "B"]
    assigner.click("panel-sessions")
    assigner.click("names")
    assert [cell["name"] for cell in records(assigner)["cells"]] == ["ToM", "no ToM"]
    assert records(assigner)["sessions"][0]["condition"] == "hidden"
    assigner.shortcut(Action.PANEL)
    assigner.open_panel()
    assert [cell["name"] for cell in records(assigner)["cells"]] == ["A", "B"]


def test_the_first_page_tells_the_day_and_the_session_under_way(make_assigner: MakeDesk) -> None:
    assigner = make_assigner(**LISTED, stages=["game", "result"])
    assigner.go_to(Stage.RESULT)
    assigner.open_panel()
    assigner.wait_until(lambda: bool(assigner.panel.property("today")["tiles"]))
    tiles = {tile["name"]: tile["value"] for tile in assigner.panel.property("today")["tiles"]}
    assert tiles == {"visitors": "1", "completed": "0", "target": "1 / 4", "stage": "Result"}
    assert assigner.sees("today-visitors")


def test_a_session_that_was_ended_tells_why(make_assigner: MakeDesk) -> None:
    assigner = make_assigner()
    assigner.go_to(Stage.INTRODUCTION)
    assigner.do(Action.ABORT, reason="2")
    assigner.open_panel()
    assigner.wait_until(lambda: bool(records(assigner)["sessions"]))
    assert records(assigner)["sessions"][0]["reason"] == "the visitor wishes it"


def test_the_voice_can_be_tried_while_nobody_plays(assigner: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    monkeypatch.setattr(assigner.app.voice, "say", lambda _number, sentence: said.append(sentence))
    assigner.open_panel()
    assigner.click("test-voice")
    assert said == [CATALOGUES["en"].text("console-test-sentence")]
    assigner.shortcut(Action.PANEL)
    assigner.go_to(Stage.ABOUT)
    assigner.open_panel()
    assigner.app.experimenter.actions.request(Action.TEST_VOICE.value, "")
    assert len(said) == 1
    assert assigner.noted == "Not now"


def test_a_voice_that_is_tried_disturbs_nothing(assigner: Desk) -> None:
    finished: list[int] = []
    assigner.app.voice.finished.connect(finished.append)
    assigner.open_panel()
    assigner.click("test-voice")
    assigner.wait_until(lambda: bool(finished))
    assert not assigner.app.runner.is_blocked
    assert assigner.stage is Stage.ATTRACT
