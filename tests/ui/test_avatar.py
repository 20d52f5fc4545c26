"""The avatar: one face for every mood, eyes that find the hinted place, and a mouth that moves with the voice."""

from __future__ import annotations

from itertools import chain
from math import pi, sin
from pathlib import Path
from random import Random

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from kiosk.experiment.effects import Mood
from kiosk.robots.clips import Clip, mouth_shapes
from kiosk.robots.embodiment import BoardPoint, Health
from kiosk.ui.screens.avatar import AvatarBody, AvatarScreen
from kiosk.ui.voice import Voice
from tests.robots.recording import Reports

RATE = 22_050
AVATAR = Path(__file__).parents[2] / "kiosk" / "ui" / "qml" / "Avatar.qml"


class VoiceFake(Voice):
    """A voice that waits to be told what to report."""

    def __init__(self) -> None:
        super().__init__()
        self.asked: list[str] = []

    def say(self, number: int, sentence: str) -> None:
        self.asked.append(f"{number} {sentence}")

    def stop(self) -> None:
        self.asked.append("stop")

    def restore(self) -> None:
        self.asked.append("restore")

    @property
    def health(self) -> Health:
        return Health(is_ok=True, message="the voice is a fake")


@pytest.fixture
def face() -> AvatarScreen:
    """Return a face."""
    return AvatarScreen()


@pytest.fixture
def voice() -> VoiceFake:
    """Return a voice."""
    return VoiceFake()


@pytest.fixture
def reports() -> Reports:
    """Who listens."""
    return Reports()


@pytest.fixture
def avatar(face: AvatarScreen, voice: VoiceFake, reports: Reports) -> AvatarBody:
    """Return an avatar with this face and voice."""
    return AvatarBody(face, voice, reports)


@pytest.mark.parametrize("mood", Mood)
def test_every_mood_has_a_face_of_its_own(avatar: AvatarBody, face: AvatarScreen, mood: Mood) -> None:
    avatar.express(mood)
    assert face.property("mood") == mood.value
    assert f"{mood.value}:" in AVATAR.read_text("utf-8")


@pytest.mark.parametrize(
    ("place", "gaze"),
    [(BoardPoint(0, 0), (-1, -1)), (BoardPoint(1, 1), (-0.5, 1)), (BoardPoint(0.5, 0.5), (-0.75, 0)), (None, (0, 0))],
)
def test_it_looks_at_the_hinted_place_and_back_at_the_visitor(
    avatar: AvatarBody, face: AvatarScreen, place: BoardPoint | None, gaze: tuple[float, float]
) -> None:
    avatar.look_at(BoardPoint(0.1, 0.1))
    avatar.look_at(place)
    assert (face.property("gazeX"), face.property("gazeY")) == gaze


def test_its_eyes_wander_only_while_they_look_at_nothing(avatar: AvatarBody, face: AvatarScreen) -> None:
    face.glance(0.2, -0.1)
    assert (face.property("gazeX"), face.property("gazeY")) == (0.2, -0.1)
    avatar.look_at(BoardPoint(0.5, 0.5))
    assert (face.property("gazeX"), face.property("gazeY")) == (-0.75, 0)


def test_it_looks_thoughtful_until_it_has_found_its_words(
    qtbot: QtBot, avatar: AvatarBody, face: AvatarScreen, voice: VoiceFake
) -> None:
    avatar.say(1, "Hello")
    assert face.property("mood") == "idle"
    qtbot.waitUntil(lambda: face.property("mood") == "thinking")
    voice.started.emit(1, [])
    assert face.property("mood") == "idle"


def test_its_mouth_moves_with_the_loudness_and_closes_at_the_end(
    qtbot: QtBot, avatar: AvatarBody, face: AvatarScreen, voice: VoiceFake, reports: Reports
) -> None:
    avatar.say(1, "Hello")
    voice.started.emit(1, [0.2, 0.8, 0.4])
    qtbot.waitUntil(lambda: face.property("mouth") == 0.8)
    voice.finished.emit(1)
    assert face.property("mouth") == 0
    assert reports.heard == [("started", 1), ("finished", 1)]


def test_a_robot_takes_its_place_and_gives_it_back(avatar: AvatarBody, face: AvatarScreen) -> None:
    avatar.deactivate()
    assert not face.property("present")
    avatar.activate()
    assert face.property("present")


def test_between_visitors_it_is_silent_calm_and_ready_to_try_its_voice_again(
    avatar: AvatarBody, face: AvatarScreen, voice: VoiceFake
) -> None:
    avatar.express(Mood.SAD)
    avatar.look_at(BoardPoint(0, 0))
    avatar.reset()
    assert (face.property("mood"), face.property("gazeX")) == ("idle", 0)
    assert voice.asked == ["stop", "restore"]


def test_its_health_is_its_voices(avatar: AvatarBody) -> None:
    assert avatar.health.message == "the avatar is there; the voice is a fake"


def test_its_lips_form_the_sounds_and_move_without_them_where_the_voice_knows_none(
    qtbot: QtBot, avatar: AvatarBody, face: AvatarScreen, voice: VoiceFake
) -> None:
    formed: list[tuple[object, object]] = []
    face.spoke.connect(lambda: formed.append((face.property("mouth"), face.property("mouthShape"))))
    voice.shapes = ("round", "teeth")
    avatar.say(1, "Oohs")
    voice.started.emit(1, [0.5, 0.25, 0.75])
    qtbot.waitUntil(lambda: (0.75, "") in formed)
    assert [step for step in formed if step[0]] == [(0.5, "round"), (0.25, "teeth"), (0.75, "")]


def test_every_shape_of_the_voice_is_one_that_the_mouth_can_form() -> None:
    noise = Random(1)
    sounds = [
        [0.4 * sin(2 * pi * frequency * step / RATE) for step in range(RATE // 5)]
        for frequency in (200, 1000, 2000, 4000)
    ]
    samples = np.array([*chain.from_iterable(sounds), *(0.001 * noise.random() for _ in range(RATE // 5))])
    shapes = set(mouth_shapes(Clip.of(samples, RATE)))
    assert shapes == {"closed", "round", "open", "wide", "teeth"}
    drawn = (AVATAR.parent / "AvatarMouth.qml").read_text("utf-8")
    assert all(f"{shape}: {{ gape" in drawn for shape in shapes)


def test_what_it_feels_about_the_game_shows_only_where_the_session_shows_no_mood(
    avatar: AvatarBody, face: AvatarScreen
) -> None:
    face.feel(Mood.HAPPY)
    assert face.property("mood") == "happy"
    avatar.express(Mood.SAD)
    assert face.property("mood") == "sad"
    avatar.express(Mood.IDLE)
    face.feel(None)
    assert face.property("mood") == "idle"
