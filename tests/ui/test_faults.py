"""A whole session while the robot fails: it ends, nothing is lost, every sentence is heard or shown.

A handful of the matrix; all of it is printed by ``python -m tests.ui.fault_matrix``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random

import pytest
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.experiment import events as happened
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.robots.driver import SpokenClip
from kiosk.robots.voice_packs import PackClips
from kiosk.store.database import open_for_reading
from kiosk.store.queries import open_repository
from tests.robots.furhat_fake import FAULTS, FurhatFake, Mode
from tests.robots.realtime_fake import Mode as Broken
from tests.robots.realtime_fake import RealtimeFake
from tests.samples import SHORT
from tests.ui.conftest import Booth, MakeBooth
from tests.ui.headless import short
from tests.ui.sabotage import Moment, Result, Sabotage, after_loss, replayed, result_of

BROKEN = tuple(mode for mode in Broken if mode not in {Broken.WELL, Broken.NAMELESS})
CLICKS = 14
"""The helper still speaks after so many."""
DEADLINES = ("connect_deadline_ms", "answer_deadline_ms", "speech_deadline_min_ms")
QUICK = dict.fromkeys(DEADLINES, 2_000)
"""Short, but longer than the collector holds up every thread of a process that has run thousands of tests."""
QUICKER = dict.fromkeys(DEADLINES, 700)
"""For a robot that is to be lost by a deadline: the test waits for it to pass, and it may pass a little early."""
WITHOUT_ANSWER = (Mode.HANG, Mode.SLOW, Mode.TRICKLE, Broken.HANG, Broken.GARBAGE)

WITHOUT_QUESTIONS = SHORT[:3]
"""Stages of sessions in which the robot is lost before the questions: of their own fault, there is a test."""


def quick(robot: dict[str, object], **more: object) -> Settings:
    """Return a study with this robot, and a game of a third of the cards that still takes a hint."""
    return short(robot=robot, game={"rows": 2, "columns": 4}, **more)


@pytest.fixture
def fake() -> Iterator[FurhatFake]:
    """Provide a robot that speaks fast."""
    with FurhatFake(character_ms=0.2) as robot:
        yield robot


@pytest.fixture
def booth(fake: FurhatFake, make_booth: MakeBooth) -> Booth:
    """Return a kiosk with this robot."""
    return make_booth(settings=quick(furhat(fake, **QUICK)))


def furhat(fake: FurhatFake, **more: object) -> dict[str, object]:
    """Return the section of a study file for this robot."""
    return {"kind": "furhat", "host": "127.0.0.1", "port": fake.port, "speech_deadline_ms_per_char": 1, **more}


def sabotaged(booth: Booth, fake: FurhatFake, mode: Mode, at: int | Moment) -> Result:
    """Return a session in which the robot falls into this mode; it must be whole, and replay as it was."""
    rehearsal = Sabotage(booth.app, 1, lambda: setattr(fake, "mode", mode), at)
    rehearsal.run()
    with open_repository(booth.data) as stored:
        result = result_of(stored, rehearsal)
        assert replayed(stored, result.session.id) == result.events
    assert result.faults() == []
    return result


def helps(booth: Booth, name: EmbodimentName) -> bool:
    """Whether this body helps now."""
    return booth.app.embodiments.current is not None and booth.app.embodiments.current.name == name


def wait_for(qtbot: QtBot, booth: Booth, holds: Callable[[], bool]) -> None:
    """Let time pass, and land what comes from the robot, until something is so."""

    def passing() -> bool:
        booth.jump()
        return holds()

    qtbot.waitUntil(passing, timeout=10_000)


def test_a_robot_that_is_well_says_everything(booth: Booth, fake: FurhatFake) -> None:
    result = sabotaged(booth, fake, Mode.WELL, 1)
    assert result.embodiment_changes == 0
    assert result.utterances.finished == result.utterances.requested
    assert fake.refusals == []
    assert len(fake.sentences) == result.utterances.requested


def test_a_robot_plays_the_avatars_pack_until_it_cannot_fetch_it_and_the_record_says_what_spoke(
    fake: FurhatFake, make_booth: MakeBooth, monkeypatch: pytest.MonkeyPatch
) -> None:
    by = {"engine": "pico", "engine_version": "0.1", "voice": "en-US", "pack": "f00d"}
    monkeypatch.setattr(PackClips, "__call__", lambda *_: SpokenClip(b"RIFF", 10, by))
    robot = {"kind": "furhat", "host": "127.0.0.1", "port": fake.port, "pack": True, **QUICK}
    booth = make_booth(settings=quick(robot))
    rehearsal = Sabotage(booth.app, 1, lambda: setattr(fake, "fetches", False), 5)
    rehearsal.run()
    with open_repository(booth.data) as stored:
        result = result_of(stored, rehearsal)
    assert result.embodiment_changes == 0
    assert result.utterances.finished == result.utterances.requested
    spoken = [event.pack for event in result.events if isinstance(event, happened.SpeechStarted)]
    assert spoken == ["f00d"] * len(fake.played) + [""] * len(fake.sentences)
    assert fake.played
    assert fake.sentences
    connection = open_for_reading(booth.data)
    notes = connection.execute("SELECT payload FROM audit_event WHERE type = 'VoiceChanged'").fetchall()
    connection.close()
    assert len(notes) == 1
    assert "the robot's own: it did not fetch the clip" in notes[0][0]


@pytest.mark.parametrize("mode", FAULTS, ids=lambda mode: mode.name.lower())
def test_any_fault_at_any_moment_costs_nobody_anything(fake: FurhatFake, mode: Mode, make_booth: MakeBooth) -> None:
    robot = furhat(fake, **(QUICKER if mode in WITHOUT_ANSWER else QUICK))
    booth = make_booth(settings=quick(robot, stages=WITHOUT_QUESTIONS))
    at = Random(f"{mode.name}/1").randint(1, CLICKS)
    result = sabotaged(booth, fake, mode, at)
    assert result.embodiment_changes == 1
    changed = next(event for event in result.events if isinstance(event, happened.EmbodimentChanged))
    assert changed.embodiment == EmbodimentName.AVATAR
    assert changed.why.startswith("the robot ")


@pytest.mark.parametrize("moment", Moment, ids=lambda moment: moment.name.lower())
def test_a_fault_in_any_stage_costs_nobody_anything(booth: Booth, fake: FurhatFake, moment: Moment) -> None:
    result = sabotaged(booth, fake, Mode.RESET, moment)
    assert result.embodiment_changes == 1


@pytest.mark.parametrize("mode", BROKEN, ids=lambda mode: mode.name.lower())
def test_over_the_other_interface_it_costs_nobody_anything_either(make_booth: MakeBooth, mode: Broken) -> None:
    with RealtimeFake() as fake:
        robot = {
            "kind": "furhat-realtime",
            "host": "127.0.0.1",
            "port": fake.port,
            "speech_deadline_ms_per_char": 1,
            **(QUICKER if mode in WITHOUT_ANSWER else QUICK),
        }
        booth = make_booth(settings=quick(robot, stages=WITHOUT_QUESTIONS))
        rehearsal = Sabotage(booth.app, 1, lambda: setattr(fake, "mode", mode), Moment.MIDDLE)
        rehearsal.run()
        with open_repository(booth.data) as stored:
            result = result_of(stored, rehearsal)
        booth.app.embodiments.close()
    assert result.faults() == []
    assert result.embodiment_changes == 1
    assert fake.refusals == []


def test_the_avatar_says_the_same_sentence_in_the_same_moment(fake: FurhatFake, make_booth: MakeBooth) -> None:
    # Half of the shipped game: it takes two hints.
    booth = make_booth(settings=short(robot=furhat(fake, **QUICK), game={"rows": 3, "columns": 4}))
    fake.arm(Mode.SERVER_ERROR, path="/furhat/say", after=2)
    rehearsal = Sabotage(booth.app, 1, lambda: None, 1)
    rehearsal.run()
    with open_repository(booth.data) as stored:
        events = result_of(stored, rehearsal).events
    hint = [event for event in events if isinstance(event, happened.HintGiven)][1]
    started = next(event for event in after_loss(events) if isinstance(event, happened.SpeechStarted))
    lost = next(event for event in events if isinstance(event, happened.RobotDisconnected))
    assert started.utterance == hint.utterance
    assert started.at_ms - lost.at_ms < 100


def test_a_robot_that_comes_back_helps_the_next_visitor(qtbot: QtBot, booth: Booth, fake: FurhatFake) -> None:
    sabotaged(booth, fake, Mode.RESET, Moment.GAME)
    fake.restart()
    wait_for(qtbot, booth, lambda: helps(booth, EmbodimentName.robot("furhat")))
    result = sabotaged(booth, fake, Mode.WELL, 1)
    assert result.embodiment_changes == 0
    assert fake.voice == "Matthew"


def test_a_robot_that_is_lost_between_sessions_leaves_them_to_the_avatar(
    qtbot: QtBot, booth: Booth, fake: FurhatFake
) -> None:
    wait_for(qtbot, booth, lambda: helps(booth, EmbodimentName.robot("furhat")))
    fake.mode = Mode.REFUSE
    wait_for(qtbot, booth, lambda: helps(booth, EmbodimentName.AVATAR))
    booth.rehearse(seed=1)
    with open_repository(booth.data) as stored:
        assert stored.sessions()[0].embodiment == "avatar"
        assert stored.sessions()[0].pairs == 4
