"""A new study is a folder that runs at once, whatever template it is made from."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.assistance.wording import Catalogue
from kiosk.cli.study import check_free
from kiosk.config import Settings, shipped_names
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.session_config import StudyConfig
from kiosk.study.checks import study_warnings
from kiosk.study.loader import read_study
from kiosk.study.new import NewStudy, find_template, templates
from tests.experiment.driver import Driver, with_memory

LANGUAGES = tuple(shipped_names("sentences"))
RUNNABLE = [template for template in templates().values() if not template.packages]
"""The others are tried where their packages are installed."""


def written(folder: Path, name: str, **more: object) -> Path:
    """Write a new study, and return its file."""
    asked = {"title": "", "contact": "lab@university.test", "languages": LANGUAGES, "robot": {}} | more
    for file, content in NewStudy(find_template(name), **asked).files().items():  # type: ignore[arg-type]
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_bytes(content)
    return folder / "study.toml"


def moved(file: Path) -> Path:
    """Give the folder of a study another name, and return its file."""
    return file.parent.rename(file.parent.with_name("Étude nº 2")) / file.name


def read(file: Path) -> StudyConfig:
    """Read everything that it names."""
    return read_study(Settings.read(file))


@pytest.mark.parametrize("name", [template.name for template in RUNNABLE])
def test_a_new_study_can_be_run_to_its_end_in_every_language_and_condition(name: str, tmp_path: Path) -> None:
    languages = (*LANGUAGES, *find_template(name).own_languages)
    study = read(moved(written(tmp_path / "made", name, languages=languages)))
    assert study.languages == languages
    assert all(not source.is_shipped for source in study.sources if source.key in {"game.deck", "about_you"})
    conditions = list(study.settings.randomisation.target_n)
    for number, condition in enumerate(conditions):
        plan = study.plan(languages[-1 - number % len(languages)], study.condition(condition))
        driver = Driver(plan, seed=number)
        driver.whole_session(with_memory(2))
        assert driver.stage is Stage.OVER, condition


@pytest.mark.parametrize("name", [template.name for template in RUNNABLE])
def test_nothing_in_a_new_study_is_cautioned_but_its_texts(name: str, tmp_path: Path) -> None:
    languages = ("en", *find_template(name).own_languages)
    said = study_warnings(read(written(tmp_path, name, languages=languages)))
    assert [each for each in said if "ethics board" not in each] == []
    assert [each for each in said if "ethics board" in each] != []


def test_every_file_of_a_template_is_in_its_folder() -> None:
    for template in templates().values():
        files = NewStudy(template, "", "", (*LANGUAGES, *template.own_languages), {}).files()
        here = (file for file in template.folder.rglob("*") if file.is_file() and "__pycache__" not in file.parts)
        names = {file.relative_to(template.folder).as_posix() for file in here} - {"template.toml"}
        assert names - set(files) == set()
        assert {"study.toml", "README.md", "cards/names.csv", "texts/it.ftl", "information/es.toml"} <= set(files)


def test_a_language_may_leave_out_what_experimenters_read_but_not_begin_it(tmp_path: Path) -> None:
    file = written(tmp_path, "two-languages", languages=("de", "en"))
    german = read(file).plans[0].catalogue
    assert german.text("about-continue") == "Weiter"
    assert german.text("console-done") == Catalogue(shipped_names("sentences")["en"]).text("console-done")
    (file.parent / "de" / "experimenter.ftl").write_text("console-done = Erledigt\n", "utf-8")
    with pytest.raises(UserInputError, match="lack console-abort"):
        read(file)


def test_the_answers_stand_in_the_study_file(tmp_path: Path) -> None:
    robot = {"kind": "furhat", "options": {}}
    file = written(tmp_path, "fair", title='A "small" study', languages=("it", "en"), robot=robot)
    given = tomllib.loads(file.read_text("utf-8"))
    assert (given["title"], given["languages"]) == ('A "small" study', ["it", "en"])
    assert given["consent"]["contact"] == "lab@university.test"
    assert given["robot"]["kind"] == "furhat"
    assert given["timing"] == {"highlight_delay_ms": 0, "highlight_delay_silent_ms": 0, "taps_wait": False}


@pytest.mark.parametrize(
    ("more", "why"),
    [
        ({"languages": ("de",)}, "has no language 'de' (it has en, es, it); the template 'two-languages' has it"),
        ({"languages": ("nl",)}, "has no language 'nl' (it has en, es, it); docs/how-to/add-a-language.md says how"),
        ({"languages": ()}, "a study has at least one language"),
        ({"title": "x" * 501}, "title must have at most 500 characters"),
    ],
)
def test_answers_that_no_study_can_have_are_refused(more: dict[str, object], why: str, tmp_path: Path) -> None:
    with pytest.raises(UserInputError) as refused:
        written(tmp_path, "paper", **more)
    assert why in str(refused.value)
    assert list(tmp_path.iterdir()) == []


def test_a_template_that_is_none_is_refused_with_those_there_are() -> None:
    with pytest.raises(UserInputError, match="there is no template 'papre'; there are children, fair, no-robot"):
        find_template("papre")


def test_nothing_is_written_over(tmp_path: Path) -> None:
    check_free(tmp_path / "new")
    check_free(tmp_path)
    (tmp_path / "mine.txt").touch()
    with pytest.raises(UserInputError, match="is there already and is not empty"):
        check_free(tmp_path)
