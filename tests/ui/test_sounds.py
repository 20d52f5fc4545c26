"""Short sounds for what happens on the board; a sentence never waits for one."""

from __future__ import annotations

import wave

import numpy as np
import pytest

from kiosk.game import Position
from kiosk.settings import Settings
from kiosk.study import commands as do
from kiosk.study.commands import Wait
from kiosk.study.events import Timer
from kiosk.ui.sounds import Effect, effect
from tests.ui.conftest import MakeBooth

HERE = Position(0, 0)
TURN = do.TurnUp(HERE, "owl")


@pytest.mark.parametrize(
    ("commands", "sound"),
    [
        ((TURN, do.OpenBoard()), Effect.FLIP),
        ((TURN, do.ShowPair((HERE, HERE)), do.OpenBoard()), Effect.MATCH),
        ((TURN, do.HoldBoard(Wait.TURNING_BACK)), Effect.MISS),
        ((TURN, do.ShowPair((HERE, HERE)), do.StartTimer(Timer.FINISH, 1800)), Effect.END),
        ((TURN, do.ShowPair((HERE, HERE)), do.HoldBoard(Wait.SPEAKING), do.Speak(1, "Try row 2")), None),
        ((do.OpenBoard(),), None),
    ],
)
def test_what_happens_has_one_sound_and_none_while_somebody_speaks(
    commands: tuple[do.Command, ...], sound: Effect | None
) -> None:
    assert effect(commands) is sound


@pytest.mark.parametrize("sound", Effect)
def test_every_sound_is_there_short_and_quiet(sound: Effect) -> None:
    with wave.open(str(sound.file)) as file:
        samples = np.frombuffer(file.readframes(file.getnframes()), dtype="<i2") / 2**15
        assert file.getnframes() / file.getframerate() < 1.1
    assert 0.05 < np.abs(samples).max() <= 0.1


def test_a_game_is_heard_unless_sounds_are_off(make_booth: MakeBooth, monkeypatch: pytest.MonkeyPatch) -> None:
    heard: list[str] = []
    monkeypatch.setattr("kiosk.ui.voice.SilentVoice.play", lambda _, file: heard.append(file.stem))
    make_booth(settings=Settings.model_validate({"voice": {"sounds": False}})).rehearse(seed=1)
    assert heard == []
    make_booth().rehearse(seed=1)
    assert heard[0] == "flip"
    assert heard.count("end") == 1
    assert {"flip", "match", "miss", "end"} == set(heard)
