"""A study is checked as a whole before the first session, and every fault gets a sentence."""

from __future__ import annotations

import json
import shutil
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from kiosk.cli.main import main
from kiosk.config import ASSETS, Settings
from kiosk.experiment.questionnaire import ItemOrder, Questionnaire
from kiosk.study.loader import read_study
from kiosk.study.reference import as_page, as_study_file
from tests.cli.bad_studies import OWN, QUESTIONS, SENTENCES, SHEETS, STUDIES, TOLD, Bad, asset
from tests.samples import without_line

PAPER = ASSETS / "studies" / "paper.toml"
PAGE = Path(__file__).parents[2] / "docs" / "reference" / "study-file.md"
TABLE = "id,kind,scale,text_en,lowest_en,highest_en\none,likert,S,How?,little,much\n"


class Called(NamedTuple):
    """How a command ended, and what it said."""

    code: int
    out: str
    err: str


Recollect = Callable[..., Called]


@pytest.fixture
def recollect(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Recollect:
    """Return the command line."""

    def call(*arguments: str | Path) -> Called:
        monkeypatch.setattr(sys, "argv", ["recollect", *map(str, arguments)])
        with pytest.raises(SystemExit) as left:
            main()
        said = capsys.readouterr()
        return Called(int(left.value.code or 0), said.out, said.err)

    return call


def files(folder: Path) -> dict[Path, bytes]:
    """Everything in a folder."""
    return {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}


@pytest.mark.parametrize("bad", STUDIES.values(), ids=STUDIES.keys())
def test_a_study_that_cannot_be_run_is_refused_in_its_own_sentences(
    bad: Bad, tmp_path: Path, recollect: Recollect
) -> None:
    study = bad.write(tmp_path)
    before = files(tmp_path)
    said = recollect("study", "check", study)
    assert said.code == 2
    told = [without_line(line) for line in said.err.splitlines()]
    assert told == [f"recollect: {sentence}" for sentence in bad.sentences(study)]
    assert said.out == ""
    assert files(tmp_path) == before


def test_every_sentence_names_a_file(tmp_path: Path) -> None:
    said = [sentence for bad in STUDIES.values() for sentence in bad.sentences(tmp_path / "study.toml")]
    assert len(said) > 70
    assert [sentence for sentence in said if str(tmp_path) not in sentence and str(ASSETS) not in sentence] == []


def test_faults_are_also_told_to_programs(tmp_path: Path, recollect: Recollect) -> None:
    bad = STUDIES["everything at once"]
    study = bad.write(tmp_path)
    said = recollect("study", "check", study, "--json")
    assert said.code == 2
    assert [without_line(each) for each in json.loads(said.out)["faults"]] == bad.sentences(study)
    assert said.err == ""


@pytest.mark.parametrize("path", ["none.toml", "."])
def test_a_study_file_that_cannot_be_read_is_refused(path: str, tmp_path: Path, recollect: Recollect) -> None:
    said = recollect("study", "check", tmp_path / path)
    assert said.code == 2
    assert f"the study file {tmp_path / path} cannot be read: " in said.err


GOOD = {
    "empty": Bad("", ()),
    "saved with a mark before it": Bad("\ufefftitle = 'A study'", ()),
    "own questionnaire": Bad(OWN, (), {"own.toml": QUESTIONS}),
    "own questionnaire by its stem": Bad('about_you = "own"', (), {"own.toml": QUESTIONS}),
    "own sheets": Bad(TOLD, (), SHEETS),
    "own sentences": Bad(
        "languages = ['de']\nabout_you = 'own.toml'\nquestionnaires = ['other.toml']\n" + TOLD,
        (),
        SENTENCES
        | {"sheets/de.toml": SHEETS["sheets/en.toml"], "own.toml": QUESTIONS.replace("en =", "de =")}
        | {"other.toml": QUESTIONS.replace("en =", "de =").replace('"o', '"another-o')},
    ),
    "own policy": Bad(
        "[assistance]\npolicy = 'mine.json'",
        (),
        {"mine.json": (ASSETS.parent / "policies" / "default.json").read_text("utf-8")},
    ),
    "nobody helps": Bad(
        "[assistance]\npolicy = 'none'\ncondition = 'no_assistance'\n[randomisation]\ntarget_n = {}", ()
    ),
    "three to one": Bad("[randomisation]\ntarget_n = { tom = 30, notom = 10 }\nblock_size = 8", ()),
    "no practice": Bad("stages = ['game']\n[practice]\ndeck = 'animals'", ()),
}


@pytest.mark.parametrize("good", GOOD.values(), ids=GOOD.keys())
def test_a_study_that_can_be_run_is_told_in_short(good: Bad, tmp_path: Path, recollect: Recollect) -> None:
    said = recollect("study", "check", good.write(tmp_path), "--json")
    assert (said.code, json.loads(said.out)["faults"]) == (0, [])


@pytest.mark.parametrize("file", sorted(PAPER.parent.glob("*.toml")), ids=lambda file: str(file.stem))
def test_every_study_that_is_shipped_can_be_run(file: Path, recollect: Recollect) -> None:
    said = recollect("study", "check", file, "--json")
    assert (said.code, json.loads(said.out)["faults"]) == (0, [])


def test_the_table_says_what_the_study_is(recollect: Recollect) -> None:
    said = recollect("study", "check", PAPER)
    assert said.code == 0
    for words in ("en, it, es", "about, age, consent", "tom 28, notom 28", "trust 3", "another-game 1", "minutes 8"):
        assert words in " ".join(said.out.split())


def test_what_may_not_be_meant_is_said_and_refuses_nothing(tmp_path: Path, recollect: Recollect) -> None:
    (tmp_path / "toys").mkdir()
    for number in range(12):
        (tmp_path / "toys" / f"toy{number}.svg").write_text(asset("cards/animals/owl.svg"), "utf-8")
    study = tmp_path / "study.toml"
    study.write_text("languages = ['en']\nstages = ['game']\n[game]\ndeck = 'toys'\n", "utf-8")
    said = recollect("study", "check", study, "--json")
    assert said.code == 0
    *cautions, alike = json.loads(said.out)["cautions"]
    assert alike.endswith("toy9.svg look alike; a visitor may take them for a pair")
    assert [caution.split(":")[0] for caution in cautions] == [
        "without the stage 'consent', visitors are not asked before their session is stored",
        "without the stage 'age', visitors are not asked whether they are old enough",
        "without the stage 'debrief', visitors do not see the code with which to withdraw",
        "consent.text",
        "consent.contact is empty, so visitors are not told whom to write to",
        "the deck 'toys' has cards without a name in 'en'",
    ]


def reworded(sheet: str) -> str:
    """Return an information sheet whose paragraphs are not the example's."""
    return sheet.replace('    "', '    "Here: ')


def test_a_purpose_for_publishing_under_another_name_is_told_of(tmp_path: Path, recollect: Recollect) -> None:
    shutil.copytree(ASSETS / "consent" / "study", tmp_path / "sheets")
    for sheet in (tmp_path / "sheets").glob("*.toml"):
        sheet.write_text(reworded(sheet.read_text("utf-8")).replace('"share"', '"publish"'), "utf-8")
    study = tmp_path / "study.toml"
    study.write_text("[consent]\ntext = 'sheets'\ncontact = 'the lab'\n", "utf-8")
    assert json.loads(recollect("study", "check", study, "--json").out)["cautions"] == [
        "consent.text: no purpose is named 'share', so nothing is left out of a data set for publishing"
    ]


def test_a_condition_without_help_is_told_of_as_help_is_promised(tmp_path: Path, recollect: Recollect) -> None:
    study = tmp_path / "study.toml"
    study.write_text("[randomisation]\ntarget_n = { tom = 2, no_assistance = 2 }\n", "utf-8")
    cautions = json.loads(recollect("study", "check", study, "--json").out)["cautions"]
    assert any("the introduction promises it to everybody" in caution for caution in cautions)


def test_a_study_with_texts_and_a_contact_of_its_own_is_told_nothing_more(tmp_path: Path, recollect: Recollect) -> None:
    sheets = {name: reworded(text) for name, text in SHEETS.items()}
    study = Bad(TOLD + '\ncontact = "the lab"', (), sheets).write(tmp_path)
    said = recollect("study", "check", study)
    assert said.code == 0
    assert "caution" not in said.out


def test_where_every_name_led_is_printed_with_its_version_and_hash(tmp_path: Path, recollect: Recollect) -> None:
    study = Bad(f"{OWN}\n{TOLD}", (), SHEETS | {"own.toml": QUESTIONS}).write(tmp_path)
    sources = json.loads(recollect("study", "check", study, "--json").out)["sources"]
    asked = next(each for each in sources if each["name"] == "own.toml")
    own = Questionnaire.read(tmp_path / "own.toml")
    assert asked == {
        "key": "questionnaires",
        "name": "own.toml",
        "path": str(tmp_path / "own.toml"),
        "shipped": False,
        "version": "1",
        "sha256": own.sha256,
        "unused": None,
    }
    keys = {each["key"] for each in sources}
    assert keys >= {"languages", "consent.text (it)", "about_you", "assistance.policy", "game.deck", "practice.deck"}
    assert [each for each in sources if not Path(each["path"]).exists()] == []
    printed = recollect("study", "check", study).out
    assert f"questionnaires: 'own.toml' is own: {tmp_path / 'own.toml'}, version 1, sha256 {own.sha256[:12]}" in printed
    assert all(each["path"] in printed and each["sha256"][:12] in printed for each in sources)


def test_a_questionnaire_of_the_labs_own_is_not_taken_for_the_shipped_one(tmp_path: Path, recollect: Recollect) -> None:
    study = Bad('questionnaires = ["trust"]', (), {"trust.toml": QUESTIONS}).write(tmp_path)
    cautions = json.loads(recollect("study", "check", study, "--json").out)["cautions"]
    assert any(f"{tmp_path / 'trust.toml'} is not used; write 'trust.toml' to use it" in said for said in cautions)
    study.write_text('questionnaires = ["trust.toml"]', "utf-8")
    assert json.loads(recollect("study", "check", study, "--json").out)["items"] == {"about-you": 3, "own": 1}


def test_a_picture_that_cannot_be_drawn_is_refused(tmp_path: Path, recollect: Recollect) -> None:
    deck = {f"toys/{number}.svg": asset("cards/animals/owl.svg") for number in range(12)}
    study = Bad("[game]\ndeck = 'toys'", (), deck | {"toys/7.svg": "<svg/>"}).write(tmp_path)
    said = recollect("study", "check", study)
    assert (said.code, said.out) == (2, "")
    (sentence,) = said.err.splitlines()
    assert sentence.startswith(f"recollect: the picture {tmp_path / 'toys' / '7.svg'} cannot be drawn: ")


@pytest.mark.parametrize("tag", ["de2", "english", "d", "./de2", "de_1_2_3-"])
def test_a_language_that_is_none_is_refused_in_a_sentence(tag: str, tmp_path: Path, recollect: Recollect) -> None:
    folder = Path(tag).name
    study = Bad(f"languages = [{tag!r}]", (), {f"{folder}/a.ftl": "a = b"}).write(tmp_path)
    said = recollect("study", "check", study)
    assert said.code == 2
    assert f"languages: {folder!r} is no language code, such as 'de' or 'pt-BR'" in said.err
    assert "Traceback" not in said.err


# What is new


def test_a_new_study_is_made_and_is_right(tmp_path: Path, recollect: Recollect) -> None:
    made = recollect(
        "study", "new", tmp_path / "mine", "--template", "children", "--language", "es", "--robot", "furhat"
    )
    assert (made.code, made.err) == (0, "")
    study = tmp_path / "mine" / "study.toml"
    assert f"recollect rehearse --headless --study {study}" in made.out
    said = recollect("study", "check", study, "--json")
    assert (said.code, json.loads(said.out)["faults"]) == (0, [])
    assert json.loads(said.out)["languages"] == ["es"]
    assert tomllib.loads(study.read_text("utf-8"))["robot"]["kind"] == "furhat"


@pytest.mark.parametrize(
    ("options", "why"),
    [
        (("--template", "papre"), "there is no template 'papre'; there are "),
        (("--language", "de"), "the template 'two-languages' has it"),
        (("--robot", "nao"), "there is no robot 'nao'; there are "),
        (("--title", "x" * 600), "title must have at most 500 characters"),
    ],
)
def test_a_study_that_cannot_be_made_leaves_nothing(
    options: tuple[str, str], why: str, tmp_path: Path, recollect: Recollect
) -> None:
    said = recollect("study", "new", tmp_path / "mine", *options)
    assert (said.code, len(said.err.splitlines())) == (2, 1)
    assert why in said.err
    assert list(tmp_path.iterdir()) == []


def test_a_folder_with_something_in_it_is_left_alone(tmp_path: Path, recollect: Recollect) -> None:
    (tmp_path / "mine.txt").write_text("mine", "utf-8")
    said = recollect("study", "new", tmp_path)
    assert (said.code, "is there already and is not empty" in said.err) == (2, True)
    assert [file.name for file in tmp_path.iterdir()] == ["mine.txt"]


def test_the_cards_are_listed_drawn_and_named(tmp_path: Path, recollect: Recollect) -> None:
    shutil.copytree(ASSETS / "cards" / "animals", tmp_path / "cards")
    study = tmp_path / "study.toml"
    study.write_text("languages = ['en', 'it']\n[game]\ndeck = './cards'\n", "utf-8")
    said = recollect("study", "cards", study, "--names", "--sheet", tmp_path / "cards.png", "--json")
    told = json.loads(said.out)
    assert (said.code, told["cautions"], len(told["cards"])) == (0, [], 12)
    assert told["cards"][0]["names"] == {"en": "bear", "it": "orso"}
    assert (tmp_path / "cards.png").read_bytes().startswith(b"\x89PNG")
    table = (tmp_path / "cards" / "names.csv").read_text("utf-8").splitlines()
    assert table[:2] == [
        "card,en,it,it.del,it.genere,it.il,it.plurale,it.questo",
        "bear,bear,orso,dell'orso,m,l'orso,orsi,quest'orso",
    ]
    again = recollect("study", "cards", study, "--names")
    assert (again.code, "names.csv is there already" in again.err) == (2, True)


def test_cards_without_a_name_are_told_once_for_each_language(tmp_path: Path, recollect: Recollect) -> None:
    shutil.copytree(ASSETS / "cards" / "animals", tmp_path / "cards")
    (tmp_path / "cards" / "owl.svg").rename(tmp_path / "cards" / "IMG_1.svg")
    (tmp_path / "cards" / "cat.svg").rename(tmp_path / "cards" / "IMG_2.svg")
    study = tmp_path / "study.toml"
    study.write_text("languages = ['en', 'it']\n[game]\ndeck = './cards'\n", "utf-8")
    said = recollect("study", "cards", study)
    assert (said.code, [line for line in said.out.splitlines() if line.startswith("caution: no name")]) == (
        0,
        [f"caution: no name in '{code}', so that the file's name is said: IMG_1, IMG_2" for code in ("en", "it")],
    )


# What is printed


def test_the_documented_example_is_printed_from_the_declarations(recollect: Recollect) -> None:
    printed = recollect("study", "reference", "--toml").out
    assert printed == as_study_file(Settings())
    assert PAPER.read_text("utf-8") == printed, "write the output of `recollect study reference --toml` into it"


def test_the_documented_example_sets_every_key_to_what_it_is_without_it() -> None:
    read = Settings.read(PAPER)
    assert read.model_dump() == Settings().model_dump()
    assert read.sha256 == Settings().sha256
    assert read_study(read).languages == ("en", "it", "es")


def test_the_documented_example_names_every_key() -> None:
    given = tomllib.loads(PAPER.read_text("utf-8"))
    unset = {"randomisation": {"seed"}, "robot": {"port", "pack_port"}}
    for key, field in Settings.model_fields.items():
        assert key in given
        declared = field.default if isinstance(field.default, dict) else {}
        for name, condition in declared.items():
            assert set(given[key][name]) == set(type(condition).model_fields)
        if isinstance(given[key], dict) and not isinstance(field.default, dict):
            assert set(given[key]) == set(type(field.default).model_fields) - unset.get(key, set())


def test_settings_other_than_the_defaults_come_back_from_their_file(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(
        'title = "A \\"second\\" study"\nstages = ["game"]\n[randomisation]\ntarget_n = {}\nseed = 7', "utf-8"
    )
    settings = Settings.read(study)
    (tmp_path / "again.toml").write_text(as_study_file(settings), "utf-8")
    assert Settings.read(tmp_path / "again.toml").model_dump() == settings.model_dump()


def test_the_reference_of_every_key_is_printed_from_the_declarations(recollect: Recollect) -> None:
    printed = recollect("study", "reference").out
    assert printed == as_page(Settings)
    assert PAGE.read_text("utf-8") == printed, "write the output of `recollect study reference` into it"
    assert (
        "| `mismatch_shown_ms` | How long two unmatched cards stay open (ms). | whole number, from 1 to 3600000 "
        "| `1200` |" in printed
    )


# Bringing in


def test_a_table_becomes_a_questionnaire(tmp_path: Path, recollect: Recollect) -> None:
    (tmp_path / "table.csv").write_text(TABLE, "utf-8")
    out = tmp_path / "own.toml"
    options = ("--id", "own", "--version", "3", "--out", out, "--per-page", "4", "--shuffled")
    said = recollect("study", "import", tmp_path / "table.csv", *options)
    assert said == Called(0, f"1 item written to {out}\n", "")
    read = Questionnaire.read(out)
    assert (read.id, read.version, read.note) == ("own", "3", "Brought in from table.csv.")
    assert (read.per_page, read.order) == (4, ItemOrder.SHUFFLED)
    assert read.items[0].text == {"en": "How?"}
    assert set(files(tmp_path)) == {tmp_path / "table.csv", out}


def test_what_was_made_is_told_to_programs(tmp_path: Path, recollect: Recollect) -> None:
    (tmp_path / "table.csv").write_text(TABLE, "utf-8")
    out = tmp_path / "own.toml"
    options = ("--id", "own", "--version", "3", "--out", out, "--json")
    told = json.loads(recollect("study", "import", tmp_path / "table.csv", *options).out)
    assert told == {"out": str(out), "items": 1, "not_taken": [], "to_change": []}
    made = json.loads(recollect("study", "new", tmp_path / "mine", "--json").out)
    assert made["study"] == str(tmp_path / "mine" / "study.toml")
    written = {
        file.relative_to(tmp_path / "mine").as_posix() for file in (tmp_path / "mine").rglob("*") if file.is_file()
    }
    assert (set(made["files"]), made["packages"]) == (written, [])


@pytest.mark.parametrize(
    ("table", "out", "said"),
    [
        (TABLE.replace("likert", "stars"), "own.toml", "the table {here}/table.csv, row 2, column kind: "),
        (
            f"{TABLE}ONE,likert,S,And?,little,much\n",
            "own.toml",
            "are one name where capitals, - and _ do not count",
        ),
        (TABLE, "table.csv", "{here}/table.csv is there already; choose another name"),
        (TABLE, "none/own.toml", "{here}/none/own.toml cannot be written: "),
    ],
)
def test_a_table_that_cannot_be_brought_in_leaves_everything_as_it_was(
    table: str, out: str, said: str, tmp_path: Path, recollect: Recollect
) -> None:
    (tmp_path / "table.csv").write_text(table, "utf-8")
    before = files(tmp_path)
    options = ("--id", "own", "--version", "1", "--out", tmp_path / out)
    refused = recollect("study", "import", tmp_path / "table.csv", *options)
    assert refused.code == 2
    assert said.replace("{here}", str(tmp_path)) in refused.err
    assert files(tmp_path) == before


def test_an_item_whose_column_will_be_called_otherwise_is_told(tmp_path: Path, recollect: Recollect) -> None:
    about = QUESTIONS.replace('"one"', '"Flips"')
    said = recollect("study", "check", Bad("about_you = 'own'", (), {"own.toml": about}).write(tmp_path), "--json")
    assert said.code == 0
    told = "about_you: the item 'Flips' will be the column 'about_you_Flips', as the data set's own has that name"
    assert told in json.loads(said.out)["cautions"]
