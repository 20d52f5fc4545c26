"""Short sounds for what happens on the board; a sentence never waits for one."""

from __future__ import annotations

import runpy

import numpy as np
import pytest

from kiosk.config import ASSETS
from kiosk.experiment import effects as do
from kiosk.experiment.effects import BoardWait
from kiosk.experiment.events import Timer
from kiosk.game import Position
from kiosk.robots.clips import TARGET_LUFS, Clip, loudness_lufs
from kiosk.ui.renderer import SoundEffect, sound_for
from tests.ui.conftest import MakeBooth
from tests.ui.headless import short

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


@pytest.fixture(scope="module")
def made() -> dict[str, Clip]:
    """Return the sounds as the program beside the assets makes them."""
    functions = runpy.run_path(str(ASSETS.parent / "packaging" / "make_sounds.py"))
    return {name: functions["sound"](notes) for name, notes in functions["SOUNDS"].items()}


def test_there_is_a_sound_for_everything_that_is_heard(made: dict[str, Clip]) -> None:
    assert set(made) == {sound.value for sound in SoundEffect}


@pytest.mark.parametrize("sound", SoundEffect)
def test_every_sound_is_short_as_loud_as_the_voice_warm_and_without_a_click(sound: SoundEffect) -> None:
    clip = Clip.read(sound.file)
    assert clip.duration_ms < (2_500 if sound is SoundEffect.END else 900)
    assert loudness_lufs(clip) == pytest.approx(TARGET_LUFS, abs=0.1)
    assert np.abs(clip.values).max() < 0.7
    assert (clip.samples[0], clip.samples[-1]) == (0, 0)
    assert np.abs(np.diff(clip.values)).max() < 0.2
    power = np.abs(np.fft.rfft(clip.values)) ** 2
    assert (power * np.fft.rfftfreq(len(clip.values), 1 / clip.rate)).sum() / power.sum() < 700


@pytest.mark.parametrize("sound", SoundEffect)
def test_every_sound_is_the_one_that_its_notes_make(sound: SoundEffect, made: dict[str, Clip]) -> None:
    """Within one step of a sample: machines round differently."""
    kept, anew = Clip.read(sound.file).samples.astype(int), made[sound.value].samples.astype(int)
    assert len(kept) == len(anew)
    assert np.abs(kept - anew).max() <= 1


def test_a_game_is_heard_unless_sounds_are_off(make_booth: MakeBooth, monkeypatch: pytest.MonkeyPatch) -> None:
    heard: list[str] = []
    monkeypatch.setattr("kiosk.ui.voice.SilentVoice.play", lambda _, file: heard.append(file.stem))
    make_booth(settings=short(voice={"sounds": False}, game={"rows": 1, "columns": 2})).rehearse(seed=1)
    assert heard == []
    make_booth(settings=short(game={"rows": 2, "columns": 4})).rehearse(seed=1)
    assert heard[0] == "button"
    assert heard.count("end") == 1
    assert {"button", "flip", "match", "miss", "end"} <= set(heard)


def test_a_touch_in_vain_and_a_click_are_heard(make_booth: MakeBooth, monkeypatch: pytest.MonkeyPatch) -> None:
    heard: list[str] = []
    monkeypatch.setattr("kiosk.ui.voice.SilentVoice.play", lambda _, file: heard.append(file.stem))
    booth = make_booth(settings=short())
    booth.start_game()
    booth.wait_until(lambda: bool(booth.app.screens.board.property("open")))
    booth.click("card-0")
    booth.click("card-0")
    booth.app.embodiments.mute()
    booth.app.screens.kiosk.press()
    assert heard == ["button", "button", "flip", "nudge"]
