"""What the experimenter sees at a glance is what is stored, also during a write."""

from __future__ import annotations

from datetime import datetime, timedelta
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.experiment import events as happened
from kiosk.experiment.events import Event
from kiosk.experiment.experimenter import AuditEvent
from kiosk.experiment.outcomes import EmbodimentName, SessionKind, Stage, Status
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.snapshot import LAST, last_written_ms, read_snapshot, wrong_pins
from tests.samples import whole

NOW = datetime.now().astimezone()
ENDED = happened.SessionEnded(at_ms=9, status=Status.ABANDONED)


def stages(*entered: Stage) -> list[Event]:
    """Return a session that came through these stages."""
    return [happened.StageEntered(at_ms=1, stage=stage) for stage in entered]


def begin(recorder: Recorder, *events: Event) -> None:
    """Record a session with these events."""
    recorder.begin(Provenance(whole(), 1, str(EmbodimentName.AVATAR), "a test", kind=SessionKind.STUDY), events)


def test_the_last_sessions_come_first_with_where_and_how_they_ended(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        begin(recorder, *stages(Stage.ABOUT_YOU, Stage.GAME, Stage.OVER), ENDED)
        begin(recorder, *stages(Stage.GAME), happened.RobotDisconnected(at_ms=2, why="gone"))
        seen = read_snapshot(tmp_path, NOW, kind=SessionKind.STUDY).sessions
    assert [(session.participant, session.stage, session.status, session.robot_lost) for session in seen] == [
        ("2", Stage.GAME, None, True),
        ("1", Stage.GAME, Status.ABANDONED, False),
    ]


def test_a_session_that_the_experimenter_ended_tells_why(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        begin(recorder, happened.AbortRequested(at_ms=2, reason="test run"), ENDED)
        begin(recorder, *stages(Stage.GAME))
        seen = read_snapshot(tmp_path, NOW, kind=SessionKind.STUDY)
    assert [session.reason for session in seen.sessions] == ["", "test run"]
    assert (seen.today.begun, seen.today.completed, seen.today.ended_early) == (2, 0, 1)
    assert seen.today.since is not None


def test_the_packs_that_spoke_lately_are_known_by_language(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        begin(
            recorder, *(happened.SpeechStarted(at_ms=1, utterance=n, engine="x", pack=p) for n, p in enumerate("aab"))
        )
        begin(recorder, happened.SpeechStarted(at_ms=1, utterance=1), ENDED)
        assert read_snapshot(tmp_path, NOW, kind=SessionKind.STUDY).packs == {("en", "a"), ("en", "b")}
        assert read_snapshot(tmp_path, NOW, kind=SessionKind.SIMULATED).packs == frozenset()


def test_only_so_many_sessions_are_shown(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        for _ in range(LAST + 2):
            begin(recorder, *stages(Stage.GAME), ENDED)
        assert len(read_snapshot(tmp_path, NOW, kind=SessionKind.STUDY).sessions) == LAST


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
        begin(recorder, *stages(stage), happened.SessionEnded(at_ms=9, status=status))
        assert bool(read_snapshot(tmp_path, NOW, kind=SessionKind.STUDY).resumable) is resumable


def test_rehearsals_and_people_are_looked_at_apart(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        begin(recorder, *stages(Stage.GAME), ENDED)
        assert read_snapshot(tmp_path, NOW, kind=SessionKind.SIMULATED).sessions == ()


def test_deviations_are_those_of_the_day_without_routine(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        recorder.add_audit_event(AuditEvent.PANEL_OPENED.value, {})
        recorder.add_audit_event(AuditEvent.EMBODIMENT_CHOSEN.value, {"embodiment": "avatar", "reason": "test run"})
        recorder.add_audit_event("SomethingOfALaterVersion", {})
        (noted,) = read_snapshot(tmp_path, NOW, kind=SessionKind.STUDY).deviations
        assert (noted.kind, noted.payload["embodiment"]) == (AuditEvent.EMBODIMENT_CHOSEN, "avatar")
        assert read_snapshot(tmp_path, NOW + timedelta(days=1), kind=SessionKind.STUDY).deviations == ()
        assert last_written_ms(tmp_path) >= noted.wall_ms


def test_wrong_pins_are_counted_since_the_last_right_one(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        assert wrong_pins(tmp_path) == 0
        for note in (
            AuditEvent.PIN_REFUSED,
            AuditEvent.PIN_ACCEPTED,
            AuditEvent.PIN_REFUSED,
            AuditEvent.PIN_REFUSED,
            AuditEvent.PANEL_OPENED,
        ):
            recorder.add_audit_event(note.value, {})
        assert wrong_pins(tmp_path) == 2


def test_a_pin_that_was_tried_and_never_answered_counts_as_wrong(tmp_path: Path) -> None:
    with Recorder(tmp_path) as recorder:
        for note in (AuditEvent.PIN_ATTEMPTED, AuditEvent.PIN_REFUSED, AuditEvent.PIN_ATTEMPTED):
            recorder.add_audit_event(note.value, {})
        assert wrong_pins(tmp_path) == 2
        for note in (AuditEvent.PIN_ATTEMPTED, AuditEvent.PIN_ACCEPTED):
            recorder.add_audit_event(note.value, {})
        assert wrong_pins(tmp_path) == 0


def test_a_folder_without_a_database_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="there is no database"):
        read_snapshot(tmp_path, NOW, kind=SessionKind.STUDY)
