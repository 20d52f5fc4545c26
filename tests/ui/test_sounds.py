"""Short sounds for what happens on the board; a sentence never waits for one."""

from __future__ import annotations

import wave

import numpy as np
import pytest

from kiosk.config import Settings
from kiosk.experiment import effects as do
from kiosk.experiment.effects import BoardWait
from kiosk.experiment.events import Timer
from kiosk.game import Position
from kiosk.ui.renderer import SoundEffect, sound_for
from tests.ui.conftest import MakeBooth

HERE = Position(0, 0)
TURN = do.RevealCard(HERE, "owl")


@pytest.mark.parametrize(
    ("effects", "sound"),
    [
        ((TURN, do.UnlockBoard()), SoundEffect.FLIP),
        ((TURN, do.MarkMatched((HERE, HERE)), do.UnlockBoard()), SoundEffect.MATCH),
        ((TURN, do.LockBoard(BoardWait.TURNING_BACK)), SoundEffect.MISS),
        ((TURN, do.MarkMatched((HERE, HERE)), do.StartTimer(Timer.FINISH, 1800)), SoundEffect.END),
        ((TURN, do.MarkMatched((HERE, HERE)), do.LockBoard(BoardWait.SPEAKING), do.Speak(1, "Try row 2")), None),
        ((do.UnlockBoard(),), None),
    ],
)
def test_what_happens_has_one_sound_and_none_while_somebody_speaks(
    effects: tuple[do.Effect, ...], sound: SoundEffect | None
) -> None:
    assert sound_for(effects) is sound


@pytest.mark.parametrize("sound", SoundEffect)
def test_every_sound_is_there_short_and_quiet(sound: SoundEffect) -> None:
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
