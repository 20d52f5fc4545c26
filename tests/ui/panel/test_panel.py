"""The panel: one glance tells how everything is, keys alone do everything, and a sitting waits while it is open."""

from __future__ import annotations

import json
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtQuick import QQuickItem

from kiosk import BadInput, StoreFailed
from kiosk.store.care.disk import Room
from kiosk.store.reading import archive
from kiosk.store.recorder import Recorder
from kiosk.study import events as happened
from kiosk.study.booth.deeds import Deed
from kiosk.study.condition import Condition
from kiosk.study.events import Stage, Status
from kiosk.ui.clock import VirtualClock
from kiosk.ui.panel.card import Step
from kiosk.ui.panel.panel import CLOSE_MS, WORDS
from kiosk.ui.rehearsing.hand import find
from tests.samples import CATALOGUES
from tests.ui.conftest import Booth
from tests.ui.panel.conftest import Desk, MakeDesk, Witness

LISTED = {"allocation": {"quotas": {"tom": 2, "notom": 2}, "block": 4}}


def records(desk: Desk) -> dict[str, Any]:
    """What the panel tells of the records."""
    shown: dict[str, Any] = desk.panel.property("records")
    return shown


def choices(desk: Desk) -> dict[str, Any]:
    """What the panel lets one choose."""
    shown: dict[str, Any] = desk.panel.property("choices")
    return shown


def held(booth: Booth) -> str:
    """The name of what has the keyboard."""
    item: QQuickItem | None = booth.app.window.activeFocusItem()
    return item.objectName() if item is not None else ""


def tab_to(desk: Desk, name: str) -> None:
    """Go around with Tab until this has the keyboard."""
    for _ in range(60):
        if held(desk) == name:
            return
        desk.press(Qt.Key.Key_Tab)
    pytest.fail(f"Tab never came to {name}")


def test_every_language_says_everything_of_the_panel() -> None:
    for catalogue in CATALOGUES.values():
        assert [word for word in WORDS if word not in catalogue] == []


def test_a_sitting_waits_while_the_panel_is_open_and_goes_on_when_it_is_closed(desk: Desk) -> None:
    desk.go_to(Stage.PRACTICE)
    witness = Witness(desk.app)
    desk.open_panel()
    assert choices(desk)["underWay"]
    desk.press(Qt.Key.Key_Escape)
    assert not desk.panel.is_open
    assert [type(event) for event in witness.events] == [happened.PauseAsked, happened.PauseEnded]
    assert desk.stage is Stage.PRACTICE


def test_a_sitting_that_was_paused_before_stays_so(desk: Desk) -> None:
    desk.go_to(Stage.PRACTICE)
    desk.do(Deed.PAUSE)
    desk.open_panel()
    desk.chord(Deed.PANEL)
    assert desk.app.screens.kiosk.property("paused")


def test_a_sitting_can_be_left_paused_from_within_the_panel(desk: Desk) -> None:
    desk.go_to(Stage.PRACTICE)
    desk.open_panel()
    desk.click("deed-pause")
    assert choices(desk)["staysPaused"]
    desk.chord(Deed.PANEL)
    assert desk.app.screens.kiosk.property("paused")


def test_nothing_behind_the_panel_can_be_reached(desk: Desk) -> None:
    desk.open_panel()
    desk.settle()
    reached = set()
    for _ in range(40):
        reached.add(held(desk))
        desk.press(Qt.Key.Key_Tab)
    assert not [name for name in reached if name.startswith("start")]
    assert {"panel-close", "deed-leave", "condition-tom", "volume-0.8"} <= reached


def test_keys_alone_choose_the_next_condition_with_a_reason(make_desk: MakeDesk) -> None:
    desk = make_desk(**LISTED)
    desk.open_panel()
    tab_to(desk, "condition-notom")
    desk.press(Qt.Key.Key_Return)
    assert desk.card.asks_for is Step.REASON
    desk.type("4")
    assert desk.app.desk.chosen is Condition.NOTOM
    desk.wait_until(lambda: choices(desk)["condition"] == "notom")
    assert held(desk) == "condition-notom"
    desk.wait_until(lambda: bool(records(desk)["deviations"]))
    first = records(desk)["deviations"][0]
    assert (first["words"], first["reason"]) == ("next condition: no ToM", "test run")


def test_arrows_go_around_as_tab_does(desk: Desk) -> None:
    desk.open_panel()
    desk.settle()
    assert held(desk) == "panel-close"
    desk.press(Qt.Key.Key_Down)
    after = held(desk)
    desk.press(Qt.Key.Key_Up)
    assert held(desk) == "panel-close" != after


def test_the_keyboard_is_the_visitors_again_when_the_panel_is_closed(desk: Desk) -> None:
    desk.go_to(Stage.INTRODUCTION)
    desk.settle()
    before = desk.app.window.activeFocusItem()
    desk.open_panel()
    desk.press(Qt.Key.Key_Escape)
    desk.settle()
    assert desk.app.window.activeFocusItem() is before


def test_it_closes_by_itself_when_nobody_is_at_it_and_asks_for_the_pin_again(desk: Desk) -> None:
    assert isinstance(desk.app.clock, VirtualClock)
    desk.open_panel()
    opened = desk.app.clock.now_ms()
    desk.wait_until(lambda: desk.app.clock.now_ms() - opened > CLOSE_MS / 2)
    desk.press(Qt.Key.Key_Tab)
    stirred = desk.app.clock.now_ms()
    desk.wait_until(lambda: not desk.panel.is_open)
    assert CLOSE_MS <= desk.app.clock.now_ms() - stirred < CLOSE_MS + 2000
    desk.chord(Deed.PANEL)
    assert desk.card.asks_for is Step.PIN


def test_counts_stand_against_the_quotas_and_the_last_sittings_tell_how_they_ended(make_desk: MakeDesk) -> None:
    desk = make_desk(**LISTED, stages=["game", "result"])
    desk.go_to(Stage.RESULT)
    desk.app.conductor.tell(happened.ContinueTapped)
    desk.go_to(Stage.GAME)
    desk.do(Deed.END, reason="2")
    desk.open_panel()
    desk.wait_until(lambda: len(records(desk)["sittings"]) == 2)
    stopped, completed = records(desk)["sittings"]
    assert (stopped["participant"], stopped["stage"], stopped["status"], stopped["odd"]) == (
        "2",
        "game",
        "stopped",
        True,
    )
    assert (completed["participant"], completed["status"], completed["odd"]) == ("1", "completed", False)
    assert sorted(cell["done"] for cell in records(desk)["cells"]) == ["0 / 2", "1 / 2"]
    assert sum(int(cell["counts"][0] or 0) for cell in records(desk)["cells"]) == 1
    assert records(desk)["deviations"][0]["words"] == "sitting stopped in: game"


def test_the_condition_of_the_sitting_under_way_is_not_told(make_desk: MakeDesk) -> None:
    desk = make_desk(**LISTED)
    desk.go_to(Stage.GAME)
    desk.open_panel()
    desk.wait_until(lambda: bool(records(desk)["sittings"]))
    (under_way,) = records(desk)["sittings"]
    assert under_way["condition"] == "hidden"
    assert under_way["status"] == "under way"


@pytest.mark.parametrize("stage", [Stage.CONSENT, Stage.GAME])
def test_while_somebody_plays_no_condition_is_told_of_anybody(make_desk: MakeDesk, stage: Stage) -> None:
    desk = make_desk(**LISTED)
    desk.app.desk.choose(Condition.NOTOM, "test run")
    desk.go_to(stage)
    desk.open_panel()
    desk.wait_until(lambda: bool(records(desk)["deviations"]))
    assert choices(desk)["condition"] == "automatic"
    assert records(desk)["cells"] == []
    assert "ToM" not in json.dumps(records(desk))
    assert any(noted["words"] == "next condition: hidden" for noted in records(desk)["deviations"])


def test_one_line_tells_that_all_is_well_or_what_is_not(desk: Desk) -> None:
    desk.app.experimenter.upkeep.room = Room(4000)
    desk.open_panel()
    assert desk.panel.property("health")["summary"] == "All is well"
    desk.app.experimenter.upkeep.room = Room(100)
    desk.wait_until(lambda: not desk.panel.property("health")["well"])
    assert desk.panel.property("health")["summary"] == "Disk: only 100 MiB free: make room this evening"


def test_a_sitting_that_was_cut_off_goes_on_from_the_start_of_its_stage(make_desk: MakeDesk) -> None:
    desk = make_desk()
    desk.go_to(Stage.QUESTIONS)
    desk.close()
    again = make_desk(data=desk.data)
    again.open_panel()
    again.wait_until(lambda: bool(records(again)["resumable"]))
    (cut_off,) = records(again)["resumable"]
    assert "questions" in cut_off["label"]
    again.click(f"resume-{cut_off['number']}")
    assert again.card.asks_for is Step.REASON
    again.type("1")
    again.wait_until(lambda: again.stage is Stage.QUESTIONS)
    assert again.notes[-1] == ("SittingResumed", {"sitting": 1, "reason": "technical problem"})
    again.chord(Deed.PANEL)
    assert not again.app.screens.kiosk.property("paused")
    assert again.screen == "form"


def cut_off(make_desk: MakeDesk) -> Desk:
    """A booth whose panel offers to go on with a sitting."""
    desk = make_desk()
    desk.go_to(Stage.QUESTIONS)
    desk.close()
    again = make_desk(data=desk.data)
    again.open_panel()
    again.wait_until(lambda: bool(records(again)["resumable"]))
    return again


def ask_to_go_on(desk: Desk) -> None:
    """Choose that sitting, and give a reason."""
    desk.click("resume-1")
    desk.type("1")
    desk.wait_until(lambda: bool(desk.noted))


def refuse_to_resume(*_: object) -> None:
    """Stand in for a store that knows why a sitting cannot go on."""
    raise BadInput("its participant has come back since")


def test_a_sitting_that_cannot_go_on_after_all_is_no_deviation(
    make_desk: MakeDesk, monkeypatch: pytest.MonkeyPatch
) -> None:
    desk = cut_off(make_desk)
    monkeypatch.setattr(Recorder, "resume", refuse_to_resume)
    ask_to_go_on(desk)
    assert "its participant has come back since" in desk.noted
    assert desk.stage is Stage.ATTRACT
    assert "SittingResumed" not in dict(desk.notes)


def test_a_sitting_does_not_go_on_where_that_cannot_be_noted_and_can_once_it_can(
    make_desk: MakeDesk, monkeypatch: pytest.MonkeyPatch
) -> None:
    desk = cut_off(make_desk)
    with monkeypatch.context() as patch:
        patch.setattr(Recorder, "note", refuse_to_write)
        ask_to_go_on(desk)
        assert desk.noted == "It could not be written down, so nothing was changed"
        assert desk.stage is Stage.ATTRACT
    with archive(desk.data) as stored:
        assert not any(isinstance(event, happened.SittingResumed) for event in stored.events(1))
    desk.wait_for_note_to_go()
    desk.click("resume-1")
    desk.type("1")
    desk.wait_until(lambda: desk.stage is Stage.QUESTIONS)
    assert dict(desk.notes)["SittingResumed"] == {"sitting": 1, "reason": "technical problem"}


def test_a_sitting_that_was_cut_off_in_the_game_cannot_go_on(make_desk: MakeDesk) -> None:
    desk = make_desk()
    desk.go_to(Stage.GAME)
    desk.close()
    again = make_desk(data=desk.data)
    again.open_panel()
    again.wait_until(lambda: bool(records(again)["sittings"]))
    assert records(again)["sittings"][0]["status"] == Status.INTERRUPTED.value
    assert records(again)["resumable"] == []


def test_the_language_at_rest_and_the_volume_wait_for_the_end_of_the_sitting(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    turned: list[float] = []
    monkeypatch.setattr(desk.app.voice, "turn", turned.append)
    desk.go_to(Stage.ABOUT)
    desk.open_panel()
    desk.click("volume-0.4")
    desk.click("language-it")
    desk.type("1")
    assert turned == []
    assert desk.app.screens.attract.property("title") == CATALOGUES["en"].text("attract-title")
    desk.do(Deed.END)
    assert turned == [0.4]
    assert desk.app.screens.attract.property("title") == CATALOGUES["it"].text("attract-title")
    assert ("VolumeChanged", {"volume": 0.4}) in desk.notes


def test_what_the_disk_does_not_take_is_not_done_and_said(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    desk.open_panel()
    monkeypatch.setattr(Recorder, "note", refuse_to_write)
    desk.click("condition-notom")
    desk.type("1")
    assert desk.app.desk.chosen is None
    assert desk.noted == "It could not be written down, so nothing was changed"
    desk.wait_until(lambda: not desk.panel.property("health")["well"])
    assert "could not be written" in desk.panel.property("health")["summary"]


def refuse_to_write(*_: object) -> None:
    """A disk that takes nothing."""
    raise StoreFailed("what happened could not be written: disk I/O error")


def test_visitors_see_neither_panel_nor_card_while_nobody_asks_for_them(desk: Desk) -> None:
    desk.go_to(Stage.ABOUT)
    for name in ("panel", "pin-card", "experimenter-note"):
        item = find(desk.app.window.contentItem(), name)
        assert item is None or not item.isVisible()
