"""A name in a study file leads to what it says: a path to the study's own file, a bare name to what is shipped."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.config import ASSETS, POLICIES, Settings
from kiosk.experiment.session_config import Source, StudyConfig
from kiosk.study.checks import study_warnings
from kiosk.study.loader import read_study


@pytest.fixture
def lab(tmp_path: Path) -> Path:
    """Return a folder with things of the lab's own, which all have the names of shipped ones."""
    text = (ASSETS / "questionnaires" / "trust.toml").read_text("utf-8")
    (tmp_path / "trust.toml").write_text(text.replace('version = "', 'version = "lab', 1), "utf-8")
    for kind, name in (("consent", "study"), ("cards", "animals"), ("sentences", "en")):
        shutil.copytree(ASSETS / kind / name, tmp_path / name)
    sheet = tmp_path / "study" / "en.toml"
    sheet.write_text(sheet.read_text("utf-8").replace('version = "', 'version = "approved', 1), "utf-8")
    shutil.copy(ASSETS / "cards" / "animals" / "cat.svg", tmp_path / "animals" / "zebra.svg")
    (tmp_path / "animals" / "en.ftl").write_text("card-zebra = zebra\n", "utf-8")
    cards = tmp_path / "en" / "cards.ftl"
    cards.write_text(cards.read_text("utf-8").replace("card-owl = owl", "card-owl = OWL"), "utf-8")
    policy = (POLICIES / "no-help.json").read_text("utf-8")
    (tmp_path / "default.json").write_text(policy, "utf-8")
    return tmp_path


SETS = {
    "trust": 'languages = ["en"]\nquestionnaires = ["{}"]',
    "study": 'languages = ["en"]\n[consent]\ntext = "{}"',
    "animals": 'languages = ["en"]\n[game]\ndeck = "{}"',
    "en": 'languages = ["{}"]',
    "default": 'languages = ["en"]\n[assistance]\npolicy = "{}"',
}
"""What a study file says to name one of them."""
ENDINGS = {"trust": ".toml", "default": ".json"}


def read(folder: Path, name: str, written: str) -> StudyConfig:
    """Read a study that names one of them in this way."""
    file = folder / "study.toml"
    file.write_text(SETS[name].format(written), "utf-8")
    return read_study(Settings.read(file))


def source(study: StudyConfig, written: str) -> Source:
    """Return what came of a name."""
    return next(each for each in study.sources if each.name == written)


@pytest.mark.parametrize("name", SETS)
@pytest.mark.parametrize("before", ["./", ".\\\\", "../{folder}/", "{path}/"])
def test_a_path_leads_to_the_studys_own_and_never_to_what_is_shipped(before: str, name: str, lab: Path) -> None:
    written = before.format(folder=lab.name, path=lab) + name + ENDINGS.get(name, "")
    study = read(lab, name, written)
    found = source(study, written.replace("\\\\", "\\"))
    assert not found.is_shipped
    assert found.path.samefile(lab / f"{name}{ENDINGS.get(name, '')}")
    assert found.sha256 != source(read(lab, name, name), name).sha256


@pytest.mark.parametrize("name", ENDINGS)
def test_a_name_with_an_ending_is_a_path(name: str, lab: Path) -> None:
    written = name + ENDINGS[name]
    assert source(read(lab, name, written), written).path == lab / written
    (lab / written).unlink()
    with pytest.raises(UserInputError, match=f"at {lab / written}; a name with / or an ending is a path"):
        read(lab, name, written)


@pytest.mark.parametrize("name", SETS)
def test_a_bare_name_is_shipped_and_what_lies_beside_is_said(name: str, lab: Path) -> None:
    study = read(lab, name, name)
    found = source(study, name)
    assert found.is_shipped
    assert found.unused == lab / f"{name}{ENDINGS.get(name, '')}"
    (said,) = [caution for caution in study_warnings(study) if f"{found.unused} is not used" in caution]
    assert str(found.path) in said
    way = said.partition("write '")[2].partition("'")[0]
    assert not source(read(lab, name, way), way).is_shipped


@pytest.mark.parametrize("name", sorted(SETS.keys() - {"en"}))
def test_a_bare_name_that_is_only_beside_the_study_file_is_taken_from_there(name: str, lab: Path) -> None:
    own, ending = f"lab-{name}", ENDINGS.get(name, "")
    (lab / f"{name}{ending}").rename(lab / f"{own}{ending}")
    assert not source(read(lab, name, own), own).is_shipped


def test_what_was_read_is_what_the_path_names(lab: Path) -> None:
    assert read(lab, "trust", "./trust.toml").plans[0].questionnaires[0].version.startswith("lab")
    assert read(lab, "study", "./study").plans[0].information.version.startswith("approved")
    assert "zebra" in read(lab, "animals", "./animals").plans[0].deck
    assert read(lab, "en", "./en").plans[0].catalogue.text("card-owl") == "OWL"
    assert read(lab, "default", "default.json").plans[0].policy.name == "no-help"


def test_a_deck_names_its_own_cards(lab: Path) -> None:
    study = read(lab, "animals", "./animals")
    assert study.plans[0].catalogue.card("zebra") == {"card": "zebra"}
    assert not [said for said in study_warnings(study) if "without a name" in said]


def test_one_language_under_two_names_is_refused(lab: Path) -> None:
    with pytest.raises(UserInputError, match="languages: 'en' stands twice"):
        read(lab, "en", './en", "en')


@pytest.mark.parametrize("name", ["..", ".", "/", "x" * 5000, "a\\u0000b", "~", "con", "*", "./"])
def test_a_name_that_leads_nowhere_is_refused_in_a_sentence(name: str, lab: Path) -> None:
    for kind in SETS:
        with pytest.raises(UserInputError) as refused:
            read(lab, kind, name)
        assert all(len(sentence) < 12_000 for sentence in refused.value.sentences)
