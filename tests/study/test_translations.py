"""A study's texts are counted in every language, and come back from translators into its own files."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from kiosk import UserInputError
from kiosk.cli.main import recollect
from kiosk.config import ASSETS, Settings
from kiosk.study.checks import study_warnings
from kiosk.study.loader import read_study
from kiosk.study.translations import State, Translation, Unit, is_untranslated
from kiosk.study.translator_files import export_texts, import_texts
from tests.study.test_comparison import FORM

STUDY = """
languages = ["en"{}]
questionnaires = ["./form.toml"]
[consent]
text = "./sheets"
"""


@pytest.fixture
def study(tmp_path: Path) -> Path:
    folder = tmp_path / "lab"
    folder.mkdir()
    (folder / "form.toml").write_text(f"# Asked after the game.\n{FORM}", "utf-8")
    (folder / "sheets").mkdir()
    shutil.copy(ASSETS / "consent" / "study" / "en.toml", folder / "sheets")
    file = folder / "study.toml"
    file.write_text(STUDY.format(""), "utf-8")
    return file


def dutch(study: Path) -> Translation:
    return Translation(Settings.read(study), "nl")


def translated(unit: Unit) -> str:
    """Return a text that differs and keeps its variables."""
    return f"{unit.source} (nl)" if not unit.source.endswith("}") else f"(nl)\n{unit.source}"


def fill_all(study: Path, file: Path) -> list[str]:
    """Translate everything in a file of translators, and bring it back."""
    translation = dutch(study)
    texts = {unit.key: translated(unit) for unit in translation.units()}
    write(translation, texts, file)
    _, left = translation.fill(import_texts(file, translation))
    return left


def write(translation: Translation, texts: dict[str, str], file: Path) -> None:
    """Write a file as a translator would send it back."""
    export_texts(translation, file)
    text = file.read_text("utf-8")
    for unit in translation.units():
        said = texts[unit.key]
        if file.suffix == ".po":
            entry = f'msgctxt "{unit.key}"\n'
            start = text.index(entry)
            at = text.index("\nmsgstr ", start)
            end = text.index("\n\n", at) if "\n\n" in text[at:] else len(text)
            text = f"{text[:at]}\nmsgstr {json.dumps(said, ensure_ascii=False)}{text[end:]}"
        else:
            start = text.index(f'id="{unit.key}"')
            found = re.compile(r"<target[^>]*/>|<target.*?</target>", re.DOTALL).search(text, start)
            assert found
            at, end = found.span()
            escaped = said.replace("&", "&amp;").replace("<", "&lt;")
            text = f"{text[:at]}<target>{escaped}</target>{text[end:]}"
    file.write_text(text, "utf-8")


@pytest.mark.parametrize("name", ["nl.po", "nl.xliff"])
def test_a_new_language_comes_back_from_translators_and_can_be_run(name: str, study: Path, tmp_path: Path) -> None:
    left = fill_all(study, tmp_path / name)
    assert all("comes with Recollect" in sentence for sentence in left)
    assert {sentence.partition(":")[0] for sentence in left} == {"questionnaires/about-you.toml"}
    study.write_text(STUDY.format(', "./nl"').replace("[consent]", 'about_you = "./me.toml"\n[consent]'), "utf-8")
    about = (ASSETS / "questionnaires" / "about-you.toml").read_text("utf-8")
    (study.parent / "me.toml").write_text(about, "utf-8")
    fill_all(study, tmp_path / f"again-{name}")
    read = read_study(Settings.read(study))
    plan = read.plan("nl")
    assert plan.information.consent.title == "Will you take part? (nl)"
    assert plan.questionnaires[0].items[0].text["nl"] == "I liked it. (nl)"
    assert plan.catalogue.text("consent-required") == "needed (nl)"
    assert not any("still" in warning and "'nl'" in warning for warning in study_warnings(read))
    assert all(unit.state is State.DONE for unit in dutch(study).units())
    assert "# Asked after the game." in (study.parent / "form.toml").read_text("utf-8")


def test_the_shipped_languages_are_complete() -> None:
    for language in ("it", "es"):
        units = Translation(Settings(), language).units()
        assert len(units) > 300
        assert [unit.key for unit in units if unit.state is not State.DONE] == []


def test_what_was_filled_in_is_not_taken_for_what_a_file_said(study: Path) -> None:
    shutil.copytree(ASSETS / "sentences" / "it", study.parent / "nl")
    file = study.parent / "nl" / "screens.ftl"
    text, before = file.read_text("utf-8"), dutch(study).units()
    unit = next(unit for unit in before if unit.part == "sentences/screens.ftl")
    dutch(study).fill({unit.key: translated(unit)})
    assert file.read_text("utf-8") != text
    file.write_text(text, "utf-8")
    assert dutch(study).units() == before


def test_each_state_is_told_apart(study: Path) -> None:
    shutil.copytree(ASSETS / "sentences" / "it", study.parent / "nl")
    shutil.copy(study.parent / "sheets" / "en.toml", study.parent / "sheets" / "nl.toml")
    screens = study.parent / "nl" / "screens.ftl"
    lines = [line for line in screens.read_text("utf-8").splitlines() if not line.startswith("consent-required")]
    screens.write_text("\n".join(lines).replace("{ $seconds }", "{ $sekunden }") + "\n", "utf-8")
    states = {unit.key: unit.state for unit in dutch(study).units()}
    assert states["sentences/screens.ftl#consent-required"] is State.MISSING
    assert states["information/sheets#about.paragraphs.0"] is State.UNCHANGED
    assert states["questionnaires/form.toml#items.liked.text"] is State.MISSING
    assert states["sentences/screens.ftl#consent-optional"] is State.DONE


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("Kaart { $karte }", r"its variables must be \$card"),
        ("Kaart", r"its variables must be \$card"),
        ("Kaart { $card", "its variables must be"),
    ],
)
def test_a_text_with_other_variables_is_refused_and_nothing_is_written(text: str, why: str, study: Path) -> None:
    translation = dutch(study)
    key = next(unit.key for unit in translation.units() if "{ $card }" in unit.source)
    with pytest.raises(UserInputError, match=why):
        translation.fill({key: text, "information/sheets#about.title": "Wat dit is"})
    assert not (study.parent / "nl").exists()


def test_a_text_of_another_study_is_refused(study: Path) -> None:
    with pytest.raises(UserInputError, match=r"there is no text 'questionnaires/other\.toml#x' in this study"):
        dutch(study).fill({"questionnaires/other.toml#x": "y"})


def test_a_sheet_is_written_only_whole(study: Path) -> None:
    written, left = dutch(study).fill({"information/sheets#about.title": "Wat dit is"})
    assert written == []
    assert left == ["information/sheets: it is written once every text of it is translated"]


BOMB = '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;">]>'
BAD = {
    "entities": ("nl.xliff", f'<?xml version="1.0"?>{BOMB}<xliff>&b;</xliff>', "document type"),
    "another file": (
        "nl.xliff",
        '<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]><xliff>&a;</xliff>',
        "document type",
    ),
    "no XML": ("nl.xliff", "msgid", "is not XLIFF"),
    "another XML": ("nl.xliff", "<html/>", "is not XLIFF 1.2"),
    "no PO": ("nl.po", "<xliff/>", "is not a PO file"),
    "another language": ("nl.po", 'msgid ""\nmsgstr ""\n"Language: de\\n"\n', "is in 'de', not in 'nl'"),
    "another ending": ("nl.docx", "", "must end in .po"),
}


@pytest.mark.parametrize("bad", BAD)
def test_a_file_that_is_none_of_translators_is_refused(bad: str, study: Path, tmp_path: Path) -> None:
    name, content, why = BAD[bad]
    file = tmp_path / name
    file.write_text(content, "utf-8")
    with pytest.raises(UserInputError, match=why):
        import_texts(file, dutch(study))


def test_the_table_lists_what_is_missing(study: Path) -> None:
    said = CliRunner().invoke(recollect, ["study", "translations", str(study), "--language", "nl"])
    assert said.exit_code == 0
    assert "missing: questionnaires/form.toml#items.liked.text: 'I liked it.'" in said.output


def test_a_copy_that_is_not_translated_is_cautioned(study: Path) -> None:
    shutil.copytree(ASSETS / "sentences" / "en", study.parent / "nl")
    text = (study.parent / "sheets" / "en.toml").read_text("utf-8")
    (study.parent / "sheets" / "nl.toml").write_text(text, "utf-8")
    form = FORM.replace(
        'text.en = "I liked it."', 'text.en = "I liked this game a lot."\ntext.nl = "I liked this game a lot."'
    )
    for word in ("no", "yes"):
        form = form.replace(
            f'.en = "{word}"', f'.en = "{word}"\n{"lowest" if word == "no" else "highest"}.nl = "{word}"'
        )
    form = form.replace('text.en = "Who are you?"', 'text = { en = "Who are you?", nl = "Wie ben je?" }')
    form = form.replace('text.en = "A pupil"', 'text = { en = "A pupil", nl = "x" }')
    form = form.replace('text.en = "A teacher"', 'text = { en = "A teacher", nl = "y" }')
    form = form.replace("title.en = ", 'title.nl = "How far do you agree?"\ntitle.en = ')
    (study.parent / "form.toml").write_text(form, "utf-8")
    about = 'id = "me"\nversion = "1"\nnote = "n"\n[[items]]\nid = "p"\nkind = "page"\ntext = { en = "a", nl = "b" }\n'
    (study.parent / "me.toml").write_text(about, "utf-8")
    study.write_text(STUDY.format(', "./nl"').replace("[consent]", 'about_you = "./me.toml"\n[consent]'), "utf-8")
    warnings = study_warnings(read_study(Settings.read(study)))
    assert any("the sentences in 'nl' are still English in" in each for each in warnings)
    assert "in 'nl', items are still in 'en': the title of form, liked" in warnings
    assert "the information sheet in 'nl' has paragraphs that are still in 'en'" in warnings
    assert any("the information sheet in 'en' still has the example's text" in each for each in warnings)


def test_short_words_may_be_the_same_in_two_languages() -> None:
    assert not is_untranslated("panda", "panda")
    assert is_untranslated("You have seen both cards once.", "You have seen both cards once.")


@pytest.mark.parametrize(
    ("table", "changed"),
    [
        ("card;en\nowl;owl\ncat;cat\n", "card;en;nl\nowl;owl;uil\ncat;cat;\n"),
        ("card,nl,en,it.il\nowl,,owl,il gufo\nowl2,x,,\n", "card,nl,en,it.il\nowl,uil,owl,il gufo\nowl2,x,,\n"),
    ],
)
def test_names_of_cards_in_a_table_are_translated_in_it(table: str, changed: str, study: Path) -> None:
    shutil.copytree(ASSETS / "cards" / "animals", study.parent / "cards")
    shutil.copy(study.parent / "cards" / "owl.svg", study.parent / "cards" / "owl2.svg")
    (study.parent / "cards" / "names.csv").write_text(table, "utf-8")
    study.write_text(STUDY.format("") + '[game]\ndeck = "./cards"\n', "utf-8")
    found = {unit.key: unit for unit in dutch(study).units()}["cards/cards/names.csv#owl"]
    assert (found.source, found.target, found.state) == ("owl", "", State.MISSING)
    written, left = dutch(study).fill({found.key: "uil"})
    assert (written, left) == ([study.parent / "cards" / "names.csv"], [])
    assert (study.parent / "cards" / "names.csv").read_text("utf-8") == changed
    assert {unit.key: unit.target for unit in dutch(study).units()}[found.key] == "uil"
