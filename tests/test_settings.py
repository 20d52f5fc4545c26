"""The study file says what it sets, and what it cannot set is refused by name."""

from __future__ import annotations

import inspect
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from pydantic import BaseModel, ValidationError

from kiosk import UserInputError, config, places
from kiosk.cli.composition import read_settings
from kiosk.config import ASSETS, POLICIES, Game, Keys, Settings, Timing, host_fault, policy_path
from kiosk.errors import validation_messages


def written(folder: Path, content: str | bytes) -> Path:
    """Return a study file of this content."""
    file = folder / "study.toml"
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    return file


def refusal(file: Path) -> str:
    """Return the sentence with which a study file is refused."""
    with pytest.raises(UserInputError) as refused:
        Settings.read(file)
    assert str(refused.value).startswith(f"the study file {file}")
    return str(refused.value)


def test_an_empty_study_file_sets_what_the_study_set(tmp_path: Path) -> None:
    read = Settings.read(written(tmp_path, ""))
    assert read.model_dump() == Settings().model_dump()
    assert (read.game.rows, read.game.columns, read.randomisation.target_n) == (4, 6, {"tom": 28, "notom": 28})
    assert (read.assistance.target_rule, read.timing.highlight_delay_ms) == ("most_flipped", 3500)


def test_a_study_file_sets_what_it_names_and_nothing_else(tmp_path: Path) -> None:
    read = Settings.read(written(tmp_path, 'languages = ["it"]\n[game]\nrows = 2\n[voice]\nvolume = 0\n'))
    expected = Settings(languages=("it",), game=Game(rows=2), voice=config.VoiceConfig(volume=0))
    assert read.model_dump() == expected.model_dump()


def test_settings_cannot_be_changed() -> None:
    with pytest.raises(ValidationError, match="frozen"):
        Settings().game.rows = 2


def test_a_study_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    assert "cannot be read: " in refusal(tmp_path / "none.toml")


def test_a_folder_is_refused(tmp_path: Path) -> None:
    assert "cannot be read: " in refusal(tmp_path)


@pytest.mark.parametrize("content", ["title = en", "[game", "[game]\nrows = 4\nrows = 5"])
def test_a_file_that_is_not_toml_is_refused(tmp_path: Path, content: str) -> None:
    assert "is not TOML: " in refusal(written(tmp_path, content))


def test_a_file_in_another_encoding_is_refused(tmp_path: Path) -> None:
    assert refusal(written(tmp_path, b"title = '\xff'")).endswith("is not UTF-8; save it with that encoding")


def test_what_cannot_be_set_is_refused_by_name_and_all_of_it(tmp_path: Path) -> None:
    file = written(tmp_path, "colour = 1\n[game]\nrows = 0\n[timing]\nhighlight_delay_ms = -1")
    with pytest.raises(UserInputError) as refused:
        Settings.read(file)
    assert [sentence.removeprefix(f"the study file {file}: ") for sentence in refused.value.sentences] == [
        "game.rows must be from 1 to 12, but it is 0 (line 3)",
        "timing.highlight_delay_ms must be from 0 to 60000 ms, but it is -1 (line 5)",
        f"there is no key 'colour'; there are {', '.join(Settings.model_fields)} (line 1)",
    ]


@pytest.mark.parametrize(("content", "given"), [("'4'", "'4'"), ("true", "true"), ("4.0", "4.0"), ("[4]", "[4]")])
def test_a_number_is_written_as_a_number(tmp_path: Path, content: str, given: str) -> None:
    said = refusal(written(tmp_path, f"[game]\nrows = {content}"))
    assert said.endswith(f"game.rows must be a whole number, but it is {given} (line 2)")


def test_what_a_file_names_by_a_path_lies_beside_it(tmp_path: Path) -> None:
    read = Settings.read(written(tmp_path, ""))
    assert read.resolve_asset("cards", "animals") == ASSETS / "cards" / "animals"
    assert read.resolve_asset("cards", "toys") == tmp_path / "toys"
    assert Settings().resolve_asset("cards", "toys") == Path("toys")


@pytest.mark.parametrize("shortcut", ["", "F1", "Shift+F12", "Ctrl+P", "Shift+Ctrl+Alt+Space"])
def test_an_experimenters_key_is_a_shortcut_a_function_key_or_none(shortcut: str) -> None:
    assert Keys(panel=shortcut).panel == shortcut


@pytest.mark.parametrize("shortcut", ["P", "Shift+P", "Ctrl", "Ctrl+", "ctrl+P", "Ctrl P", "F0"])
def test_what_a_visitor_may_type_is_no_experimenters_key(shortcut: str) -> None:
    with pytest.raises(ValidationError, match="is no shortcut"):
        Keys(panel=shortcut)


def test_keys_that_are_switched_off_do_not_stand_twice() -> None:
    assert Keys(panel="", condition="").embodiment == Keys().embodiment


def sections() -> list[type[BaseModel]]:
    """Every part of the study file, and the whole."""
    found = [kind for _, kind in inspect.getmembers(config, inspect.isclass) if issubclass(kind, BaseModel)]
    return [kind for kind in found if kind.__module__.startswith("kiosk.config.") and not kind.__name__.startswith("_")]


@pytest.mark.parametrize("section", sections(), ids=lambda section: str(section.__name__))
def test_every_setting_has_its_sentence(section: type[BaseModel]) -> None:
    for name, field in section.model_fields.items():
        described = field.description or (isinstance(field.default, BaseModel) and type(field.default).__doc__)
        assert described, f"{section.__name__}.{name} has no sentence"
        assert str(described).strip().endswith((".", "?"))


def test_settings_are_told_apart_by_their_hash() -> None:
    assert Settings().sha256 == Settings(languages=("en", "it", "es")).sha256
    assert len({Settings().sha256, Settings(languages=("it",)).sha256, Settings(game=Game(rows=2)).sha256}) == 3
    assert len(Settings().sha256) == 64


def test_settings_come_back_from_what_is_kept_of_them() -> None:
    kept = Settings(languages=("it",), timing=Timing(mood_ms=1))
    assert Settings.model_validate_json(kept.model_dump_json()) == kept


@pytest.mark.parametrize(("length", "time"), [(0, 1500), (27, 1500), (28, 1540), (100, 5500)])
def test_a_sentence_is_shown_for_as_long_as_it_takes_to_read(length: int, time: int) -> None:
    assert Timing().reading_time("x" * length) == time


@pytest.mark.parametrize(("length", "time"), [(0, 4000), (30, 4000), (31, 4030), (100, 13_000)])
def test_a_spoken_sentence_holds_the_game_for_no_longer_than_its_length_allows(length: int, time: int) -> None:
    assert Timing().speech_time("x" * length) == time


def test_the_assets_are_found() -> None:
    assert (ASSETS / "sentences" / "en").is_dir()
    assert ASSETS.name == "assets"
    assert POLICIES.name == "policies"


def test_a_policy_goes_by_its_name_or_by_its_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(places, "POLICIES", tmp_path)
    (tmp_path / "own.json").write_text("{}")
    assert policy_path("own") == tmp_path / "own.json"
    assert policy_path("other") == Path("other")
    assert policy_path(str(tmp_path / "own.json")) == tmp_path / "own.json"


def _numbers(model: type[BaseModel], path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], object]]:
    """Every key of a study file that takes numbers, with its default."""
    for key, field in model.model_fields.items():
        if isinstance(field.default, BaseModel):
            yield from _numbers(type(field.default), (*path, key))
        elif re.search(r"\b(int|float)\b", str(field.annotation)):
            yield (*path, key), field.default


@pytest.mark.parametrize("place", [place for place, _ in _numbers(Settings)], ids=".".join)
def test_every_number_has_bounds_and_a_sentence_that_names_them(place: tuple[str, ...]) -> None:
    default = dict(_numbers(Settings))[place]
    for number in (10**30, -(10**30), float("inf"), float("-inf"), float("nan")):
        value: object = number
        if isinstance(default, tuple):
            value = [number] * len(default)
        elif isinstance(default, dict):
            value = dict.fromkeys(default, number)
        given: dict[str, object] = {place[-1]: value}
        if len(place) > 1:
            given = {place[0]: given}
        with pytest.raises(ValidationError) as error:
            Settings.model_validate(given)
        for sentence in validation_messages(error.value, given, Settings):
            assert sentence.startswith(".".join(place)), number
            assert re.search(r"must be (a whole number|from \S+ to \S+)", sentence), (number, sentence)


@pytest.mark.parametrize("hours", ["10-18", "18:00-10:00", "10:00-25:00", "10:00+01:00-18:00", "ten to six"])
def test_opening_hours_that_are_none_are_refused_with_the_form_they_have(tmp_path: Path, hours: str) -> None:
    told = refusal(written(tmp_path, f'[experimenter]\nopening_hours = "{hours}"'))
    assert f"experimenter.opening_hours: '{hours}' is not of the form '10:00-18:00'" in told


@pytest.mark.parametrize("host", ["localhost", "robot.local.", "192.168.0.20", "::1", "fe80::1%eth0", "röbot.example"])
def test_a_robots_host_is_a_name_or_an_address(host: str) -> None:
    assert host_fault(host) is None


@pytest.mark.parametrize(
    ("host", "advice"),
    [
        ("", "write the robot's name or address"),
        (" ", "write the robot's name or address"),
        ("http://robot:54321/x", "is a web address; write 'robot', and 54321 as the port"),
        ("https://anna:secret@robot.local/", "is a web address; write 'robot.local' alone"),
        ("ws://[fe80::1]:9000/v1", "is a web address; write 'fe80::1', and 9000 as the port"),
        ("furhat@robot", "is a user and a host; write 'robot' alone"),
        ("robot:54321", "is a host and a port; write 'robot', and 54321 as the port"),
        ("[::1]", "is no host; write '::1' alone"),
        ("a robot", "is no host; write the robot's name or address"),
        ("x" * 64, "is no host; write the robot's name or address"),
    ],
)
def test_what_is_no_host_of_a_robot_is_refused_with_what_to_write(host: str, advice: str, tmp_path: Path) -> None:
    assert advice in (host_fault(host) or "")
    with pytest.raises(UserInputError, match="the robot's host: "):
        read_settings(None, host)
    file = tmp_path / "study.toml"
    file.write_text(f"[robot]\nhost = {json.dumps(host)}\n", "utf-8")
    with pytest.raises(UserInputError, match=r"robot\.host"):
        Settings.read(file)


def test_opening_hours_may_have_spaces_and_may_be_left_out(tmp_path: Path) -> None:
    for hours in ("", "09:30-17:00", "09:30 - 17:00"):
        read = Settings.read(written(tmp_path, f'[experimenter]\nopening_hours = "{hours}"'))
        assert read.experimenter.opening_hours == hours
