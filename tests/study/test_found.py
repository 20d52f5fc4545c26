"""What a study means for a booth, in words: its file, its policy, its languages, its PIN, its keys."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.assistance.policy import ACTIONS, Gate, QTable, states_with
from kiosk.config import POLICIES, ExperimenterConfig, Keys, Settings
from kiosk.preflight import Severity
from kiosk.study import checks
from kiosk.study.loader import read_study

HASHED = f"scrypt:10:{'0' * 32}:{'1' * 64}"


def test_every_fault_of_a_study_file_keeps_a_session_from_being_held() -> None:
    faults = list(checks.faults_check(("one thing", "another")))
    assert [(each.severity, each.message) for each in faults] == [
        (Severity.ERROR, "one thing"),
        (Severity.ERROR, "another"),
    ]


def test_a_study_is_told_with_all_its_cautions() -> None:
    told, *cautions = checks.study_file_check(read_study(Settings()))
    assert (told.severity, "minutes" in told.message) == (Severity.OK, True)
    assert {each.severity for each in cautions} == {Severity.WARNING}
    assert any("ethics board" in each.message for each in cautions)


def test_a_policy_is_told_by_its_hash_and_missed_its_page() -> None:
    study = read_study(Settings())
    (told,) = checks.policy_check(study)
    assert told.message == f"default {study.plans[0].policy.sha256[:8]}"


def test_a_policy_without_a_page_about_it_is_told_of(tmp_path: Path) -> None:
    shutil.copy(POLICIES / "default.json", tmp_path / "mine.json")
    file = tmp_path / "study.toml"
    file.write_text('[assistance]\npolicy = "mine.json"\n')
    study = read_study(Settings.read(file))
    (without,) = checks.policy_check(study)
    assert (without.severity, without.remedy) == (Severity.WARNING, f"write {tmp_path / 'mine.md'}")
    (tmp_path / "mine.md").touch()
    (told,) = checks.policy_check(study)
    assert told.severity is Severity.OK


def test_the_policy_that_never_helps_needs_no_page() -> None:
    (told,) = checks.policy_check(read_study(Settings.model_validate({"assistance": {"policy": "none"}})))
    assert told.severity is Severity.OK


def test_every_language_is_told() -> None:
    (told,) = checks.languages_check(read_study(Settings(languages=("en", "it"))))
    assert [part.split()[0] for part in told.message.split(", ")] == ["en", "it"]


def test_a_study_without_a_pin_is_told_of_and_none_is_ever_repeated() -> None:
    (without,) = checks.pin_check(ExperimenterConfig())
    (told,) = checks.pin_check(ExperimenterConfig(pin_hash=HASHED))
    assert [without.severity, told.severity] == [Severity.WARNING, Severity.OK]
    assert HASHED not in told.message


def test_an_experimenter_who_could_not_get_out_is_told() -> None:
    (told,) = checks.shortcuts_check(Keys())
    (locked,) = checks.shortcuts_check(Keys(quit=""))
    assert (told.severity, Keys().quit in told.message) == (Severity.OK, True)
    assert (locked.severity, "quit" in locked.message) == (Severity.WARNING, True)


@pytest.mark.parametrize(
    ("lines", "lacking"),
    [('timing = "model"', "sug_card"), ('hesitation_max = 1\nhesitation_action = "sug_card"', "sug_card")],
)
def test_a_table_lacks_no_action_that_is_taken_without_asking_it(lines: str, lacking: str, tmp_path: Path) -> None:
    actions = tuple(action for action in ACTIONS if action.label != lacking)
    table = QTable.freeze("few", Gate(), [[0.0] * len(actions) for _ in states_with(actions)], {}, actions)
    (tmp_path / "few.json").write_text(table.to_json(), "utf-8")
    file = tmp_path / "study.toml"
    file.write_text(f'[assistance]\npolicy = "few.json"\n{lines}\n', "utf-8")
    with pytest.raises(UserInputError, match=f"a table that the study names has no action {lacking}"):
        read_study(Settings.read(file))
    file.write_text('[assistance]\npolicy = "few.json"\n', "utf-8")
    assert read_study(Settings.read(file)).plans[0].policy.actions == actions
