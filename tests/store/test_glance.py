"""What the experimenter sees at a glance is what is stored, also while somebody writes."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk import BadInput
from kiosk.store.glance import LAST, glance, last_written_ms, wrong_pins
from kiosk.store.recorder import Provenance, Recorder
from kiosk.study import events as happened
from kiosk.study.booth.notes import Note
from kiosk.study.events import BodyName, Event, Stage, Status
from tests.samples import whole

ENDED = happened.SittingEnded(at_ms=9, status=Status.ABANDONED)


def stages(*entered: Stage) -> list[Event]:
    """A sitting that came through these stages."""
    return [happened.StageEntered(at_ms=1, stage=stage) for stage in entered]


def begin(recorder: Recorder, *events: Event) -> None:
    """Record a sitting with these events."""
    recorder.begin(Provenance(whole(), 1, BodyName.AVATAR.value, "a test", simulated=False), events)


def test_the_last_sittings_come_first_with_where_and_how_they_ended(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        begin(recorder, *stages(Stage.ABOUT_YOU, Stage.GAME, Stage.OVER), ENDED)
        begin(recorder, *stages(Stage.GAME), happened.RobotLost(at_ms=2, why="gone"))
        seen = glance(tmp_path, 0, simulated=False).sittings
    assert [(sitting.participant, sitting.stage, sitting.status, sitting.robot_lost) for sitting in seen] == [
        ("2", Stage.GAME, None, True),
        ("1", Stage.GAME, Status.ABANDONED, False),
    ]


def test_only_so_many_sittings_are_shown(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        for _ in range(LAST + 2):
            begin(recorder, *stages(Stage.GAME), ENDED)
        assert len(glance(tmp_path, 0, simulated=False).sittings) == LAST


@pytest.mark.parametrize(
    ("stage", "status", "resumable"),
    [
        (Stage.QUESTIONS, Status.INTERRUPTED, True),
        (Stage.GAME, Status.INTERRUPTED, False),
        (Stage.QUESTIONS, Status.ABANDONED, False),
        (Stage.QUESTIONS, Status.STOPPED, False),
    ],
)
def test_what_was_cut_off_elsewhere_than_in_the_game_can_go_on(
    tmp_path: Path,
    stage: Stage,
    status: Status,
    resumable: bool,  # noqa: FBT001 - it is what is looked for
) -> None:
    with Recorder(tmp_path) as recorder:
        begin(recorder, *stages(stage), happened.SittingEnded(at_ms=9, status=status))
        assert bool(glance(tmp_path, 0, simulated=False).resumable) is resumable


def test_rehearsals_and_people_are_looked_at_apart(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        begin(recorder, *stages(Stage.GAME), ENDED)
        assert glance(tmp_path, 0, simulated=True).sittings == ()


def test_deviations_are_those_since_a_moment_without_routine(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        recorder.note(Note.PANEL_OPENED.value, {})
        recorder.note(Note.BODY_CHOSEN.value, {"body": "avatar", "reason": "test run"})
        recorder.note("SomethingOfALaterVersion", {})
        (noted,) = glance(tmp_path, 0, simulated=False).deviations
        assert (noted.note, noted.body["body"]) == (Note.BODY_CHOSEN, "avatar")
        assert glance(tmp_path, noted.wall_ms + 1, simulated=False).deviations == ()
        assert last_written_ms(tmp_path) >= noted.wall_ms


def test_wrong_pins_are_counted_since_the_last_right_one(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        assert wrong_pins(tmp_path).wait_ms == 0
        for note in (Note.PIN_REFUSED, Note.PIN_ACCEPTED, Note.PIN_REFUSED, Note.PIN_REFUSED, Note.PANEL_OPENED):
            recorder.note(note.value, {})
        assert wrong_pins(tmp_path).times == 2


def test_a_folder_without_a_database_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="there is no database"):
        glance(tmp_path, 0, simulated=False)
