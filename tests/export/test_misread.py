"""What people type and labs choose is read as text from the tables and can be restored."""

from __future__ import annotations

import csv
import io
import json
import math
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from random import Random

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as some

from kiosk.experiment.items import Integer, ShortText
from kiosk.experiment.outcomes import Stage
from kiosk.export.bids import Bids
from kiosk.export.columns import (
    SEPARATES_OBJECTS,
    Column,
    ColumnKind,
    ExportOption,
    Label,
    Table,
    Variable,
    format_cell,
    marked,
)
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import Layout, PsychDs
from kiosk.export.new_files import csv_lines
from tests.experiment.driver import Driver
from tests.export.conftest import rows_of
from tests.export.visitors import answer_all, store, study_plan
from tests.samples import questionnaire

FORMULAS = ("=1+1", "+1+1", "-1+1", "@SUM(A1)", "\t=1+1", '=HYPERLINK("http://example.org")', "\uff1d1+1", " =1+1")
LABELS = ("1E-0001", "1E-1", "MAR1", "007", "TRUE", "NA", "nan", "inf", "T", "3/4", "12:30", "1.10")
MARKS = ("'", "''=1", "'quoted'", '"', '"=1"', '"one quote')
HARMLESS = ("ok", "none", "3 cats", "x=1", "naïve, 日本", 'say "so"', "5", "a\u2028b")


def unmarked(cell: str) -> str:
    """Return the text of a cell, as the codebook tells its readers to have it back."""
    return cell.removeprefix("'")


def as_pandas(cell: str) -> object:
    """Return a cell as pandas' reader takes it where all of its column are like it."""
    if cell in {"", "#N/A", "N/A", "NA", "NULL", "NaN", "None", "n/a", "nan", "null", "<NA>"}:
        return None
    if cell.lower() in {"true", "false"}:
        return cell.lower() == "true"
    with suppress(ValueError):
        if "_" not in cell:
            return float(cell)
    return cell


def as_r(cell: str) -> object:
    """Return a cell as R's reader takes it."""
    return cell in {"T", "TRUE"} if cell in {"T", "F", "TRUE", "FALSE"} else as_pandas(cell)


def as_spreadsheet(cell: str) -> object:
    """Return a cell as a spreadsheet takes it: formulas, numbers, and what it sees a date or a time in."""
    begins = cell.lstrip(' \u00a0\u200b\ufeff\0"')[:1]
    if (begins and begins in "=+-@\uff1d\uff0b\uff0d\uff20\u2212") or cell[:1] in {"\t", "\r", "\n"}:
        raise AssertionError(f"{cell!r} is evaluated")
    for form in (
        "%Y-%m-%d",
        "%d/%m/%Y",
        "%m/%d/%Y",
        "%d.%m.%Y",
        "%m/%d",
        "%b%d",
        "%b-%d",
        "%d-%b",
        "%d %B",
        "%B %d",
        "%H:%M",
    ):
        with suppress(ValueError):
            return datetime.strptime(cell.strip(), form)
    plain = cell.strip().replace(",", ".")
    return cell if as_pandas(plain) == plain else as_pandas(plain)


READERS: tuple[Callable[[str], object], ...] = (as_pandas, as_r, as_spreadsheet)


def is_whole(text: str) -> bool:
    """Whether it is a number that nothing is lost of."""
    return text.isascii() and text.isdigit() and str(int(text)) == text and len(text) <= 15


@pytest.mark.parametrize("text", FORMULAS + LABELS + MARKS + HARMLESS)
def test_a_text_stays_one_in_every_reader_and_can_be_had_back(text: str) -> None:
    cell = format_cell(text)
    assert unmarked(cell) == text
    assert is_whole(text) or [reader(cell) for reader in READERS] == [cell] * len(READERS)


@pytest.mark.parametrize("text", HARMLESS)
def test_a_text_that_is_no_trouble_is_left_as_it_is(text: str) -> None:
    assert format_cell(text) == text


@pytest.mark.parametrize("text", FORMULAS + LABELS)
def test_the_imitated_readers_would_misread_what_is_not_marked(text: str) -> None:
    """Otherwise the tests above would say little."""

    def stays(reader: Callable[[str], object]) -> bool:
        try:
            return reader(text) == text
        except AssertionError:
            return False

    assert not all(stays(reader) for reader in READERS)


TROUBLE = some.text(
    some.sampled_from("=+-@'\"\t\r\n 0123456789.,:/eExX_%TFNAanifmr\uff1d\u200b"), min_size=1, max_size=8
)


@settings(derandomize=True)
@given(some.one_of(TROUBLE, some.text()))
@example("")
@example("''")
def test_any_text_is_marked_reversibly_and_none_is_evaluated(text: str) -> None:
    cell = marked(text)
    assert unmarked(cell) == text
    assert marked(text) == (cell if cell == text else f"'{text}")
    if not is_whole(text) and text:
        assert [reader(cell) for reader in READERS] == [cell] * len(READERS)


@pytest.mark.parametrize("number", [-5, -0.25, 0, 1e-7, 123456789, -math.pi])
def test_numbers_of_the_program_stay_numbers(number: float) -> None:
    assert float(format_cell(number)) == number
    assert format_cell(number)[0] in "-0123456789"


def test_a_label_of_digits_alone_stays_a_label() -> None:
    assert format_cell(Label("12")) == "'12"
    assert format_cell(Label("A1")) == "A1"
    assert format_cell("12") == "12"


# In a whole data set

ABOUT = questionnaire(
    "about-you",
    ShortText(id="remark", kind="text", text={"en": "remark?"}, longest=60),
    Integer(id="degrees", kind="integer", text={"en": "degrees?"}, lowest=-50, highest=50),
)
TYPED = tuple(text for text in FORMULAS + LABELS + MARKS + HARMLESS if text.isprintable())


@pytest.fixture(scope="module")
def typed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the data folder of people who typed all this."""
    drivers = []
    for seed, text in enumerate(TYPED, 1):
        driver = Driver(replace(study_plan(), about_you=ABOUT), seed)
        driver.to(Stage.ABOUT_YOU)
        answer_all(driver, Random(seed), {"remark": text, "degrees": -seed})
        driver.end(text)
        drivers.append((driver, seed))
    folder = tmp_path_factory.mktemp("typed") / "data"
    store(folder, drivers, site="MI")
    return folder


def tables_of(out: Path) -> list[list[list[str]]]:
    """Every cell of every table, read without the codebook."""
    commas = [path.open(encoding="utf-8", newline="") for path in sorted(out.rglob("*.csv"))]
    found = [list(csv.reader(file)) for file in commas]
    for file in commas:
        file.close()
    return found + [
        [line.split("\t") for line in path.read_text("utf-8").split("\n")[:-1]] for path in sorted(out.rglob("*.tsv"))
    ]


@pytest.mark.parametrize("layout", [PsychDs, Bids])
def test_nothing_in_a_data_set_is_evaluated(typed: Path, tmp_path: Path, layout: type[Layout]) -> None:
    export_dataset(typed, tmp_path / "out", layout, frozenset(ExportOption))
    cells = Counter(cell for _, *rows in tables_of(tmp_path / "out") for row in rows for cell in row)
    numbers = 0
    for cell, times in cells.items():
        with suppress(ValueError):
            float(cell)
            numbers += times
            continue
        as_spreadsheet(cell)
    assert numbers > 100
    assert "(') before it" in (tmp_path / "out" / "README.md").read_text("utf-8")


def test_what_was_typed_is_had_back_and_a_negative_number_is_a_number(typed: Path, tmp_path: Path) -> None:
    export_dataset(typed, tmp_path / "out", PsychDs, frozenset({ExportOption.TEXTS}))
    people = rows_of(tmp_path / "out", "participants")
    assert [unmarked(row["remark"]) for row in people] == list(TYPED)
    assert [int(row["degrees"]) for row in people] == [-seed for seed in range(1, len(TYPED) + 1)]
    values = [row["value"] for row in rows_of(tmp_path / "out", "answers") if row["item"] == "remark"]
    assert [unmarked(value) for value in values] == list(TYPED)
    reasons = [
        json.loads(row["fields"])["reason"]
        for row in rows_of(tmp_path / "out", "events")
        if row["type"] == "AbortRequested"
    ]
    assert reasons == list(TYPED)
    assert "(') before it" in (tmp_path / "out" / "documentation" / "codebook.md").read_text("utf-8")


def test_the_names_of_participants_are_names_in_every_reader(typed: Path, tmp_path: Path) -> None:
    export_dataset(typed, tmp_path / "out", PsychDs)
    for row in rows_of(tmp_path / "out", "participants"):
        assert [reader(row["participant_id"]) for reader in READERS] == [row["participant_id"]] * 3


@pytest.mark.parametrize("site", ["1E", "MAR", "007", "NA", "12", ""])
def test_they_are_also_in_what_was_recorded_at_a_site_that_is_refused_now(
    site: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("kiosk.store.recorder.checked_site", lambda given: given)
    driver = Driver(study_plan(), 1)
    driver.to(Stage.ABOUT_YOU)
    driver.end()
    store(tmp_path / "data", [(driver, 1)], site=site)
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    (person,) = rows_of(tmp_path / "out", "participants")
    for name in ("participant_id", "site"):
        assert not person[name] or [reader(person[name]) for reader in READERS] == [person[name]] * 3
    assert unmarked(person["site"]) == site


def test_a_picture_with_a_name_like_a_number_stays_a_text(tmp_path: Path) -> None:
    plan = study_plan()
    named = ("1E5", "nan", "=1", *plan.deck[3:])
    driver = Driver(replace(plan, deck=named), 1)
    driver.to(Stage.GAME)
    driver.wait_until_open()
    driver.end()
    store(tmp_path / "data", [(driver, 1)])
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    pictures = {row["picture"] for row in rows_of(tmp_path / "out", "cards") if row["stage"] == "game"}
    assert {"'1E5", "'nan", "'=1"} <= pictures
    assert {unmarked(picture) for picture in pictures} == set(named[:12])


@settings(derandomize=True)
@given(some.lists(some.tuples(TROUBLE, some.just(""), some.text()), max_size=4))
@example([("a", "b", "c,")])
@example([('"', ",", "\r\n")])
def test_lines_are_written_as_pythons_own_writer_writes_them(rows: list[tuple[str, ...]]) -> None:
    written = io.StringIO(newline="")
    csv.writer(written, lineterminator="\r\n").writerows(rows)
    assert csv_lines(list(zip(*rows, strict=True))) == written.getvalue()


@pytest.mark.parametrize(
    "value", ["plain", SEPARATES_OBJECTS, [SEPARATES_OBJECTS, "between", SEPARATES_OBJECTS], [1, None]]
)
def test_each_object_of_a_column_is_written_as_it_is_alone(value: object) -> None:
    objects: list[dict[str, object] | None] = [{"a": 1}, {"value": value}, None, {}, {"b": [{"c": "é"}]}]
    column = Column[int](Variable("v", "A value.", ColumnKind.JSON, empty="none"), lambda row: objects[row])
    table = Table[int, int]("t", "One row for each.", ("v",), (column,), range)
    assert [cell for (cell,) in table.cells(len(objects))] == list(map(format_cell, objects))
