"""What a study means for a booth, in words: its file, its policy, its languages, its PIN, its keys."""

from __future__ import annotations

import shutil
from pathlib import Path

from kiosk.findings import State
from kiosk.settings import POLICIES, Experimenter, Keys, Settings
from kiosk.study.declared.checked import found
from kiosk.study.declared.checked.whole import read_study

HASHED = f"scrypt:{'0' * 32}:{'1' * 64}"


def test_every_fault_of_a_study_file_keeps_a_sitting_from_being_held() -> None:
    faults = list(found.faults(("one thing", "another")))
    assert [(each.state, each.words) for each in faults] == [(State.BAD, "one thing"), (State.BAD, "another")]


def test_a_study_is_told_with_all_its_cautions() -> None:
    told, *cautions = found.file(read_study(Settings()))
    assert (told.state, "minutes" in told.words) == (State.GOOD, True)
    assert {each.state for each in cautions} == {State.WARNING}
    assert any("ethics board" in each.words for each in cautions)


def test_a_policy_is_told_by_its_hash_and_missed_its_page() -> None:
    study = read_study(Settings())
    (told,) = found.policy(study)
    assert told.words == f"default {study.plans[0].policy.sha256[:8]}"


def test_a_policy_without_a_page_about_it_is_told_of(tmp_path: Path) -> None:
    shutil.copy(POLICIES / "default.json", tmp_path / "mine.json")
    file = tmp_path / "study.toml"
    file.write_text('[assistance]\npolicy = "mine.json"\n')
    study = read_study(Settings.read(file))
    (without,) = found.policy(study)
    assert (without.state, without.remedy) == (State.WARNING, f"write {tmp_path / 'mine.md'}")
    (tmp_path / "mine.md").touch()
    (told,) = found.policy(study)
    assert told.state is State.GOOD


def test_the_policy_that_never_helps_needs_no_page() -> None:
    (told,) = found.policy(read_study(Settings.model_validate({"assistance": {"policy": "none"}})))
    assert told.state is State.GOOD


def test_every_language_is_told() -> None:
    (told,) = found.languages(read_study(Settings(languages=("en", "it"))))
    assert [part.split()[0] for part in told.words.split(", ")] == ["en", "it"]


def test_a_study_without_a_pin_is_told_of_and_none_is_ever_repeated() -> None:
    (without,) = found.pin(Experimenter())
    (told,) = found.pin(Experimenter(pin=HASHED))
    assert [without.state, told.state] == [State.WARNING, State.GOOD]
    assert HASHED not in told.words


def test_an_experimenter_who_could_not_get_out_is_told() -> None:
    (told,) = found.keys(Keys())
    (locked,) = found.keys(Keys(leave=""))
    assert (told.state, Keys().leave in told.words) == (State.GOOD, True)
    assert (locked.state, "leave" in locked.words) == (State.WARNING, True)
