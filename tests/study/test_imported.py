"""Another instrument comes in from a spreadsheet as it stands there, or every bad cell is named."""

from __future__ import annotations

import csv
import io
import tomllib
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk import StorageError, UserInputError
from kiosk.config import ASSETS
from kiosk.experiment.items import Likert, Single
from kiosk.experiment.questionnaire import ITEM_KINDS, ItemOrder, Questionnaire
from kiosk.study.csv_import import PLAIN, WORDED, Heading, as_toml, read_items, write_questionnaire
from tests.study.bad_tables import HEAD, LIKERT, TABLES, rows

HEADING = Heading(id="q", version="1", note="ours", per_page=4, order=ItemOrder.SHUFFLED)
SHIPPED = sorted((ASSETS / "questionnaires").glob("*.toml"))


def read(folder: Path, table: str | bytes) -> Questionnaire:
    """Return the questionnaire of a table."""
    file = folder / "table.csv"
    file.write_bytes(table if isinstance(table, bytes) else table.encode())
    return read_items(file, HEADING)


@pytest.mark.parametrize(("table", "says"), TABLES.values(), ids=TABLES.keys())
def test_every_bad_cell_is_named(table: str | bytes, says: tuple[str, ...], tmp_path: Path) -> None:
    with pytest.raises(UserInputError) as refused:
        read(tmp_path, table)
    places = {"{table}": f"the table {tmp_path / 'table.csv'}", "{kinds}": ", ".join(ITEM_KINDS)}
    for name, place in places.items():
        says = tuple(sentence.replace(name, place) for sentence in says)
    assert refused.value.sentences == says


def test_a_table_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="cannot be read: "):
        read_items(tmp_path / "none.csv", HEADING)


def test_what_spreadsheets_do_to_a_table_does_no_harm(tmp_path: Path) -> None:
    plain = read(tmp_path, rows(LIKERT))
    for table in (
        rows(LIKERT).replace(",", ";"),
        rows(LIKERT).replace("\n", "\r\n"),
        "\ufeff" + rows(LIKERT),
        rows("", f" {LIKERT} ".replace(",", " , "), ",,,,,,,,,,,,,"),
        rows(LIKERT + ",,,"),
        rows(LIKERT + ",,", head=HEAD + ",,"),
        rows(LIKERT.rstrip(",")),
        rows(LIKERT.replace("How?", '"How?"')),
    ):
        assert read(tmp_path, table) == plain


def test_a_delimiter_within_quotes_is_text(tmp_path: Path) -> None:
    table = rows(LIKERT.replace("How?", '"One, two; ""three""\nand four"'))
    assert read(tmp_path, table).items[0].text == {"en": 'One, two; "three"\nand four'}


@pytest.mark.parametrize("word", ["yes", "TRUE", "VERO", "x", "1", "ja", "WAHR", "oui", "Vrai", "sí", "sim"])
def test_yes_is_written_as_spreadsheets_write_it(word: str, tmp_path: Path) -> None:
    (item,) = read(tmp_path, rows(LIKERT.replace(",S,,", f",S,{word},"))).items
    assert isinstance(item, Likert)
    assert item.reverse


@pytest.mark.parametrize("word", ["no", "False", "FALSO", "0", "", "nein", "FALSCH", "faux", "não"])
def test_no_is_written_as_spreadsheets_write_it(word: str, tmp_path: Path) -> None:
    (item,) = read(tmp_path, rows(LIKERT.replace(",S,,", f",S,{word},"))).items
    assert isinstance(item, Likert)
    assert not item.reverse


@pytest.mark.parametrize("line", ["sep=;", "sep=;;;;"])
def test_a_first_line_that_tells_the_separator_is_no_row(line: str, tmp_path: Path) -> None:
    table = f"{line}\n{rows(LIKERT).replace(',', ';')}"
    assert read(tmp_path, table) == read(tmp_path, rows(LIKERT))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_a_table_is_read_in_every_form_that_spreadsheets_save(separator: str, encoding: str, tmp_path: Path) -> None:
    table = rows(LIKERT).replace(",", separator)
    assert read(tmp_path, table.encode(encoding)) == read(tmp_path, rows(LIKERT))


def test_capital_letters_in_columns_and_kinds_make_no_difference(tmp_path: Path) -> None:
    titled = rows(LIKERT.replace("likert", "Likert"), head=HEAD.title())
    assert read(tmp_path, titled) == read(tmp_path, rows(LIKERT))


@pytest.mark.parametrize("code", ["pt_BR", "pt-BR", "pt-br", "PT_br"])
def test_a_language_is_known_however_its_code_is_written(code: str, tmp_path: Path) -> None:
    (item,) = read(tmp_path, rows(LIKERT, head=HEAD.replace("_en", f"_{code}"))).items
    assert item.text == {"pt-BR": "How?"}


def test_options_may_be_numbered_as_survey_programs_number_them(tmp_path: Path) -> None:
    (item,) = read(tmp_path, "id,kind,text_en,options_en\nsex,single,You are,1=male;2=female;10=another\n").items
    assert isinstance(item, Single)
    assert item.ids == ("1", "2", "10")


@pytest.mark.parametrize("number", ["01", "1.5", "-1", "12345", "1e3"])
def test_what_only_looks_like_a_whole_number_is_no_option(number: str, tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match=f"column options_en: '{number}' is no name"):
        read(tmp_path, f"id,kind,text_en,options_en\nsex,single,You are,{number}=male;2=female\n")


def test_one_language_in_two_columns_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="the column 'text_pt-BR' is there twice"):
        read(tmp_path, "id,kind,text_pt_BR,text_pt-br\none,text,Oi?,Oi?\n")


# Round trips


def cells(questionnaire: Questionnaire, delimiter: str) -> str:
    """Return the table that a questionnaire is read from."""
    languages = list(questionnaire.items[0].text)
    columns = [*PLAIN, *(f"{stem}_{language}" for stem in WORDED for language in languages)]
    out = io.StringIO()
    writer = csv.writer(out, delimiter=delimiter)
    writer.writerow(columns)
    for item in questionnaire.items:
        found = {
            key: value for name, value in item.model_dump(mode="json").items() for key, value in _cells(name, value)
        }
        writer.writerow([found.get(column, "") for column in columns])
    return out.getvalue()


def _cells(name: str, value: Any) -> list[tuple[str, str]]:
    """Return the cells of one key of an item, by their columns."""
    match value:
        case None:
            return []
        case bool():
            return [(name, "yes" if value else "no")]
        case dict():
            return [(f"{name}_{language}", words) for language, words in value.items()]
        case list():
            languages = value[0]["text"]
            return [
                (f"{name}_{language}", ";".join(f"{option['id']}={option['text'][language]}" for option in value))
                for language in languages
            ]
    return [(name, str(value))]


@pytest.mark.parametrize("file", SHIPPED, ids=lambda file: str(file.stem))
@pytest.mark.parametrize("delimiter", [",", ";"])
def test_a_shipped_questionnaire_comes_back_from_its_table(file: Path, delimiter: str, tmp_path: Path) -> None:
    questionnaire = Questionnaire.read(file)
    assert read(tmp_path, cells(questionnaire, delimiter)).items == questionnaire.items


NAMES = st.from_regex("[A-Za-z][A-Za-z0-9_-]{0,8}", fullmatch=True)
TEXTS = (
    st.text(st.characters(exclude_categories=["Cs", "Cc"], include_characters="\n"), min_size=1)
    .map(str.strip)
    .filter(bool)
)
WORDS_OF_OPTIONS = TEXTS.filter(lambda text: ";" not in text)


def words(texts: st.SearchStrategy[str] = TEXTS) -> st.SearchStrategy[dict[str, str]]:
    """Return a text in two languages."""
    return st.fixed_dictionaries({"en": texts, "it": texts})


RATING = {"required": st.booleans(), "reverse": st.booleans()}
ENDS = {"lowest": words(), "highest": words()}
SIDES = {"left": words(), "right": words()}
NUMBERS = {"lowest": st.integers(-999, 0), "highest": st.integers(1, 999)}
POINTS = {"points": st.integers(2, 11)}
OPTIONS = {
    "required": st.booleans(),
    "options": st.lists(
        st.fixed_dictionaries({"id": NAMES, "text": words(WORDS_OF_OPTIONS)}),
        min_size=2,
        max_size=4,
        unique_by=lambda option: str(option["id"]),
    ),
}
KEYS: Mapping[str, Mapping[str, st.SearchStrategy[Any]]] = {
    "likert": RATING | POINTS | ENDS,
    "differential": RATING | POINTS | SIDES,
    "slider": RATING | NUMBERS | SIDES,
    "pictures": RATING | POINTS | ENDS | {"pictures": NAMES},
    "single": OPTIONS,
    "multiple": OPTIONS,
    "integer": {"required": st.booleans(), **NUMBERS},
    "text": {"required": st.booleans(), "longest": st.integers(1, 500)},
    "page": {},
}


def items() -> st.SearchStrategy[dict[str, Any]]:
    """Any item, as a file gives it."""
    kinds = (
        st.fixed_dictionaries({"id": NAMES, "kind": st.just(kind), "text": words(), **keys})
        for kind, keys in KEYS.items()
    )
    return st.one_of(*kinds)


QUESTIONNAIRES = st.fixed_dictionaries(
    {
        "id": NAMES,
        "version": TEXTS,
        "note": TEXTS,
        "per_page": st.integers(1, 8),
        "order": st.sampled_from([order.value for order in ItemOrder]),
        "items": st.lists(items(), min_size=1, max_size=6, unique_by=lambda item: str(item["id"])),
    }
).map(Questionnaire.model_validate)


@given(QUESTIONNAIRES, st.sampled_from(",;"))
def test_any_questionnaire_comes_back_from_its_table_and_from_its_file(asked: Questionnaire, delimiter: str) -> None:
    heading = Heading(asked.id, asked.version, asked.note, asked.per_page, asked.order)
    with TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "table.csv").write_bytes(cells(asked, delimiter).encode())
        read_back = read_items(folder / "table.csv", heading)
        assert read_back == asked
        write_questionnaire(read_back, folder / "q.toml")
        assert Questionnaire.read(folder / "q.toml") == asked


# Writing


@pytest.mark.parametrize("file", SHIPPED, ids=lambda file: str(file.stem))
def test_a_shipped_questionnaire_comes_back_from_what_is_written(file: Path) -> None:
    questionnaire = Questionnaire.read(file)
    assert Questionnaire.model_validate(tomllib.loads(as_toml(questionnaire))) == questionnaire


def test_a_file_that_is_there_is_kept(tmp_path: Path) -> None:
    out = tmp_path / "q.toml"
    out.write_text("mine", "utf-8")
    with pytest.raises(UserInputError, match="is there already; choose another name"):
        write_questionnaire(Questionnaire.read(SHIPPED[0]), out)
    assert out.read_text("utf-8") == "mine"


def test_nothing_is_left_of_a_file_that_could_not_be_finished(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(self: Path, target: Path) -> Path:
        raise OSError(28, "No space left on device", str(self), None, str(target))

    monkeypatch.setattr(Path, "replace", fail)
    with pytest.raises(StorageError, match="cannot be written: disk full"):
        write_questionnaire(Questionnaire.read(SHIPPED[0]), tmp_path / "q.toml")
    assert list(tmp_path.iterdir()) == []
