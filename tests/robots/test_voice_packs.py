"""Voice packs: parts that are joined, what is wrong with a clip, a person's recordings, and one loudness for all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kiosk import UserInputError
from kiosk.cli.devices import spoken_texts
from kiosk.config import ASSETS, Settings, VoiceConfig
from kiosk.robots import tts_worker
from kiosk.robots.clips import TARGET_LUFS, Clip, joined, levelled, loudness_lufs, mouth_shapes, trimmed
from kiosk.robots.tts_worker import SpeechSource
from kiosk.robots.voice_packs import (
    MANIFEST,
    PAUSE_MS,
    PackClips,
    PackLabel,
    VoicePack,
    find_pack,
    import_recordings,
    key_of,
    loudness_fault,
    render_pack,
    sound_fault,
)
from kiosk.study.loader import read_study

RATE = 16_000
REASON, PLACE = "You have seen both owl cards, each of them once.", "Try the card in row 2, column 3."

BY_A_PERSON = PackLabel.of_person("en", "A", "own")


def tone(seconds: float = 0.5, level: float = 0.1, hertz: float = 300) -> Clip:
    """Return a tone."""
    return Clip.of(level * np.sin(2 * np.pi * hertz * np.arange(int(RATE * seconds)) / RATE), RATE)


class Engine:
    """An engine whose sentences are tones with silence around them, as long as the text."""

    name, version, licence, rate, voice, spoken = "tones", "1.0", "MIT", RATE, "tone", "Tone"
    voices: Sequence[Mapping[str, Any]] = ()

    def __init__(self) -> None:
        self.rendered: list[str] = []

    def render(self, text: str) -> Clip:
        """Render a sentence."""
        self.rendered.append(text)
        silence = Clip(np.zeros(RATE // 5, np.int16), RATE)
        return joined([silence, tone(len(text) / 40), silence])


@pytest.fixture
def pack(tmp_path: Path) -> VoicePack:
    """Return a pack of a reason and a place."""
    return render_pack(Engine(), "en", [REASON, PLACE], tmp_path / "pack", lambda _: None)


def test_loudness_is_that_of_the_standards_reference_signal() -> None:
    rate = 48_000
    full = Clip.of(np.sin(2 * np.pi * 997 * np.arange(3 * rate) / rate), rate)
    assert loudness_lufs(full) == pytest.approx(-3.01, abs=0.05)
    assert loudness_lufs(Clip.of(full.values / 10, rate)) == pytest.approx(-23.01, abs=0.05)
    assert loudness_lufs(Clip(np.zeros(rate, np.int16), rate)) == -np.inf


@pytest.mark.parametrize("sound", sorted((ASSETS / "sounds").glob("*.wav")), ids=lambda file: file.stem)
def test_every_sound_of_the_board_is_as_loud_as_the_voice(sound: Path) -> None:
    assert loudness_lufs(levelled(Clip.read(sound))) == pytest.approx(TARGET_LUFS, abs=0.1)


@pytest.mark.parametrize("level", [0.01, 0.1, 0.5])
@pytest.mark.parametrize("seconds", [0.1, 2])
def test_clips_of_any_level_and_length_become_equally_loud(level: float, seconds: float) -> None:
    assert loudness_lufs(levelled(tone(seconds, level))) == pytest.approx(TARGET_LUFS, abs=0.1)


def test_silence_is_cut_off_both_ends_and_the_ends_fade() -> None:
    silence = Clip(np.zeros(RATE, np.int16), RATE)
    cut = trimmed(joined([silence, tone(0.5, 0.5), silence]))
    assert 500 <= cut.duration_ms <= 560
    assert (cut.samples[0], cut.samples[-1]) == (0, 0)


def test_the_mouth_is_closed_in_silence_round_for_low_sounds_and_at_its_teeth_for_high_ones() -> None:
    silence = Clip(np.zeros(RATE // 5, np.int16), RATE)
    shapes = mouth_shapes(joined([silence, tone(0.2, 0.5, 300), tone(0.2, 0.5, 6000)]))
    assert [shapes[2], shapes[7], shapes[12]] == ["closed", "round", "teeth"]


def test_a_sentence_is_said_by_its_parts_with_a_pause_and_without_a_click(
    pack: VoicePack, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tts_worker, "create_engine", lambda *_: Engine())
    source = SpeechSource("en", 150, str(pack.folder))
    whole, by = source.clip(f"{REASON} {PLACE}")
    parts = [Clip.read(pack.path(key_of("en", text))) for text in (REASON, PLACE)]
    assert whole.duration_ms == pytest.approx(sum(part.duration_ms for part in parts) + PAUSE_MS, abs=2)
    between = whole.values[len(parts[0].samples) - 1 : len(parts[0].samples) + RATE * PAUSE_MS // 1000 + 1]
    assert np.abs(between).max() < 0.001
    assert by == {"engine": "tones", "engine_version": "1.0", "voice": "tone", "pack": pack.sha256}


def test_what_a_pack_lacks_is_rendered_and_told_apart(pack: VoicePack, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tts_worker, "create_engine", lambda *_: Engine())
    _, by = SpeechSource("en", 150, str(pack.folder)).clip("Something else.")
    assert by["pack"] == ""
    assert pack.missing([REASON, f"{REASON} {PLACE}", "Something else."]) == ("Something else.",)


def test_an_engine_that_is_too_slow_to_speak_live_speaks_only_from_its_pack(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    class Slow(Engine):
        name = "slow"

    def engines(_language: str, _rate: int, _name: str = "", *, is_live: bool = False) -> Engine:
        return Engine() if is_live else Slow()

    monkeypatch.setattr(tts_worker, "create_engine", engines)
    monkeypatch.setattr(tts_worker, "cache_folder", lambda _language, name, _rate: tmp_path / name)
    assert SpeechSource("en", 150).clip(REASON)[1]["engine"] == "tones"
    render_pack(Slow(), "en", [REASON], tmp_path / "slow", lambda _: None)
    assert SpeechSource("en", 150).spoken_by["engine"] == "slow"


def test_a_clip_that_was_changed_is_not_played_as_if_it_were_of_its_pack(
    pack: VoicePack, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tts_worker, "create_engine", lambda *_: Engine())
    source = SpeechSource("en", 150, str(pack.folder))
    assert source.clip(REASON)[1]["pack"] == source.spoken_by["pack"] == pack.sha256
    tone(1, 0.02).write(pack.path(key_of("en", REASON)))
    clip, by = source.clip(REASON)
    assert by["pack"] == ""
    assert clip.samples.tolist() == levelled(trimmed(Engine().render(REASON))).samples.tolist()


def test_a_pack_is_rendered_once_and_its_hash_depends_on_its_clips(pack: VoicePack) -> None:
    engine = Engine()
    more = render_pack(engine, "en", [REASON, PLACE, "Goodbye!"], pack.folder, lambda _: None)
    assert engine.rendered == ["Goodbye!"]
    assert len(more.clips) == 3
    assert more.sha256 != pack.sha256
    assert render_pack(engine, "en", [REASON], pack.folder, lambda _: None).sha256 == more.sha256


def test_clips_that_were_changed_or_lost_are_found(pack: VoicePack) -> None:
    assert list(pack.faults()) == []
    (reason, place) = (pack.path(key_of("en", text)) for text in (REASON, PLACE))
    tone(1, 0.02).write(reason)
    place.unlink()
    faults = list(pack.faults())
    assert len(faults) == 2
    assert "was changed since the pack was made" in faults[0]
    assert "cannot be read" in faults[1]
    assert pack.find(PLACE) is None


def test_a_sound_is_silent_or_clipped_or_louder_or_softer_than_all_others() -> None:
    silent, clipped = Clip(np.zeros(RATE, np.int16), RATE), Clip.of(5 * tone(1, 0.5).values, RATE)
    well, soft, loud = levelled(tone(1)), tone(1, 0.01), tone(1, 0.9)
    assert [sound_fault(each) for each in (silent, well, soft, loud)] == ["is silent", None, None, None]
    assert "is clipped" in str(sound_fault(clipped))
    assert loudness_fault(well) is None
    assert str(loudness_fault(soft)).endswith("LU softer than it should be")
    assert str(loudness_fault(loud)).endswith("LU louder than it should be")


@pytest.mark.parametrize("content", [None, "{}", "[]", '{"spoken_by": 1}', "not JSON", "[" * 100_000])
def test_a_folder_that_is_no_pack_is_refused_by_name(tmp_path: Path, content: str | None) -> None:
    if content is not None:
        (tmp_path / MANIFEST).write_text(content)
    with pytest.raises(UserInputError, match=str(tmp_path)):
        VoicePack.read(tmp_path)


def test_a_persons_recordings_become_a_pack_of_one_loudness(tmp_path: Path) -> None:
    tone(1, 0.02).write(tmp_path / "001.wav")
    tone(1, 0.6).write(tmp_path / "002.wav")
    made = import_recordings(tmp_path, tmp_path / "pack", [REASON, PLACE, "Not recorded."], BY_A_PERSON)
    assert list(made.faults()) == []
    assert made.spoken_by == {"engine": "person", "engine_version": "", "voice": "A"}
    assert made.missing([REASON, PLACE, "Not recorded."]) == ("Not recorded.",)


def test_recordings_that_are_silent_clipped_or_none_are_refused_and_nothing_is_written(tmp_path: Path) -> None:
    Clip(np.zeros(RATE, np.int16), RATE).write(tmp_path / "001.wav")
    Clip.of(5 * tone(1, 0.5).values, RATE).write(tmp_path / "002.wav")
    (tmp_path / "003.wav").write_text("none")
    with pytest.raises(UserInputError) as refusal:
        import_recordings(tmp_path, tmp_path / "pack", ["One.", "Two.", "Three."], BY_A_PERSON)
    assert [sentence.split(".wav ")[1].split(":")[0] for sentence in refusal.value.sentences] == [
        "is silent",
        "is clipped",
        "is no WAV file",
    ]
    assert not (tmp_path / "pack").exists()


@pytest.mark.parametrize("language", ["en", "it", "es"])
def test_everything_that_a_study_can_say_is_listed_once(language: str) -> None:
    plan = next(plan for plan in read_study(Settings()).plans if plan.language == language)
    texts = spoken_texts(plan)
    assert len(set(texts)) == len(texts)
    catalogue = plan.catalogue
    assert set(catalogue.wordings("reason-first-both-often", **catalogue.card("owl"))) <= set(texts)
    assert set(catalogue.wordings("point-first-card", row=4, column=6)) <= set(texts)
    assert set(catalogue.wordings("result-speech-some", moves=27)) <= set(texts)
    assert set(catalogue.wordings("introduction-speech", cards=24, pairs=12)) <= set(texts)


@pytest.mark.parametrize(
    ("speakers", "words"),
    [({"fr": "pico"}, "'fr' is none of the languages"), ({"en": "nobody"}, "'nobody' is no engine")],
)
def test_a_speaker_that_cannot_be_is_refused(speakers: dict[str, str], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Settings.model_validate({"voice": {"speakers": speakers}})


def test_a_robot_is_given_the_very_clip_that_the_avatar_plays(pack: VoicePack, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tts_worker, "create_engine", lambda *_, **__: Engine())
    settings = VoiceConfig(speakers={"en": str(pack.folder)})
    clips = PackClips(settings)
    avatars, by = SpeechSource("en", 150, str(pack.folder)).clip(f"{REASON} {PLACE}")
    robots = clips("en", f"{REASON} {PLACE}")
    assert robots is not None
    assert Clip.from_bytes(robots.wav).samples.tolist() == avatars.samples.tolist()
    assert (robots.duration_ms, robots.spoken_by) == (avatars.duration_ms, by)
    assert clips("en", "What no pack says.") is None


def test_without_a_pack_a_robot_is_given_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("platformdirs.user_cache_dir", lambda *_, **__: str(tmp_path))
    assert find_pack(VoiceConfig(), "en") is None
    assert PackClips(VoiceConfig(speakers={"en": str(tmp_path / "nowhere")}))("en", REASON) is None
