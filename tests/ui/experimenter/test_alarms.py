"""Alarms at a booth: heard between sessions, shown without words, read in the panel, kept in status.json."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.experiment.alarms import AlarmKind
from kiosk.experiment.booth_status import CLOSED, FILE
from kiosk.experiment.experimenter import Action
from kiosk.experiment.outcomes import Stage
from kiosk.store.maintenance import FreeSpace
from kiosk.ui.experimenter.alarms import alarm_words
from kiosk.ui.experimenter.health import DRIFT_MS
from kiosk.ui.renderer import SoundEffect
from kiosk.ui.simulated_visitor import find_item
from kiosk.ui.window import RunMode, WindowMode
from tests.samples import CATALOGUES
from tests.ui.experimenter.conftest import LINE, Desk, MakeDesk
from tests.ui.headless import headless

FULL = FreeSpace(free_mib=100, hour_mib=101)
ROOM = FreeSpace(free_mib=101, hour_mib=101)


@pytest.fixture
def heard(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Provide the names of the sounds that are played."""
    played: list[str] = []
    monkeypatch.setattr("kiosk.ui.voice.Voice.play", lambda _self, sound: played.append(sound.stem))
    return played


def fill_disk(desk: Desk, room: FreeSpace = FULL) -> None:
    desk.app.experimenter.upkeep.free_space = room


def alarms(desk: Desk) -> list[dict[str, Any]]:
    """Return what the panel shows of them."""
    shown: list[dict[str, Any]] = desk.panel.property("alarms")
    return shown


def is_marked(desk: Desk) -> bool:
    mark = find_item(desk.app.window.contentItem(), "alarm-mark")
    return mark is not None


def test_an_alarm_sounds_once_is_marked_without_words_and_read_in_the_panel(assigner: Desk, heard: list[str]) -> None:
    fill_disk(assigner)
    assigner.app.experimenter.alarms.begin()
    assert heard == [SoundEffect.ALARM.value]
    assert is_marked(assigner)
    assigner.open_panel()
    assert [(row["words"], row["holds"]) for row in alarms(assigner)] == [
        (alarm_words(AlarmKind.DISK_LOW, CATALOGUES["en"]), True)
    ]
    shown = find_item(assigner.app.window.contentItem(), "alarm-words")
    assert shown is not None
    assert shown.property("text") == alarm_words(AlarmKind.DISK_LOW, CATALOGUES["en"])
    assigner.shortcut(Action.PANEL)
    assert not is_marked(assigner)
    fill_disk(assigner, ROOM)
    assigner.wait_until(lambda: not alarms(assigner)[0]["holds"])
    assert heard == [SoundEffect.ALARM.value]


def test_during_a_session_the_sound_waits_for_its_end_and_the_mark_does_not(
    make_assigner: MakeDesk, heard: list[str]
) -> None:
    assigner = make_assigner(stages=["practice", "game"])
    assigner.go_to(Stage.PRACTICE)
    heard.clear()
    fill_disk(assigner)
    assigner.app.experimenter.alarms.begin()
    assert is_marked(assigner)
    assert heard == []
    assigner.do(Action.ABORT)
    assigner.wait_until(lambda: SoundEffect.ALARM.value in heard)
    assert assigner.app.experimenter.actions.resting


def test_time_that_passes_faster_is_no_clock_that_was_set(qtbot: QtBot, tmp_path: Path) -> None:
    with headless(Settings(), tmp_path, mode=RunMode(WindowMode.NOWHERE, speed=1000)) as app:
        qtbot.waitUntil(lambda: app.clock.now_ms() - app.started_ms > 2 * DRIFT_MS)
        app.experimenter.alarms.see()
        assert AlarmKind.CLOCK_CHANGED not in [alarm.kind for alarm in app.experimenter.alarms.alarms]


@pytest.mark.parametrize(("setting", "expected"), [("always", [SoundEffect.ALARM.value]), ("never", [])])
def test_a_study_decides_when_alarms_sound(
    make_assigner: MakeDesk, heard: list[str], setting: str, expected: list[str]
) -> None:

    desk = make_assigner(experimenter={"pin_hash": LINE, "alarm_sound": setting}, stages=["practice", "game"])
    desk.go_to(Stage.PRACTICE)
    heard.clear()
    fill_disk(desk)
    desk.app.experimenter.alarms.begin()
    assert heard == expected
    assert is_marked(desk)


def test_a_booth_that_was_silenced_calls_without_a_sound(assigner: Desk, heard: list[str]) -> None:
    assigner.do(Action.MUTE)
    heard.clear()
    fill_disk(assigner)
    assigner.app.experimenter.alarms.begin()
    assert heard == []
    assert is_marked(assigner)


@pytest.mark.parametrize(("stage", "expected"), [("game", [AlarmKind.RESTARTED.value]), (CLOSED, [])])
def test_a_kiosk_that_follows_one_that_failed_says_so_and_puts_it_into_the_status(
    make_assigner: MakeDesk, tmp_path: Path, stage: str, expected: list[str]
) -> None:
    first = make_assigner()
    first.app.experimenter.status_file.begin()
    file = first.data / FILE
    written = json.loads(file.read_text("utf-8"))
    first.close()
    folder = tmp_path / "again"
    folder.mkdir()
    (folder / FILE).write_text(json.dumps(written | {"stage": stage}), "utf-8")
    second = make_assigner(data=folder)
    second.app.experimenter.alarms.begin()
    second.app.experimenter.status_file.begin()
    now = json.loads((folder / FILE).read_text("utf-8"))
    assert [alarm["kind"] for alarm in now["alarms"]] == expected


@pytest.mark.parametrize("language", CATALOGUES)
@pytest.mark.parametrize("kind", AlarmKind)
def test_every_alarm_has_words_in_every_language(kind: AlarmKind, language: str) -> None:
    assert alarm_words(kind, CATALOGUES[language])
