"""Whatever people type comes out of a table as it went in."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import example, given
from hypothesis import strategies as some

from kiosk.export.columns import format_cell
from kiosk.export.new_files import NOTHING, CsvFile, TsvFile

HALVES = some.characters(categories=["Cs"])
ANYTHING = some.text(some.one_of(some.characters(exclude_categories=["Cs"]), some.sampled_from('",;\r\n\t\\ \u2028\0')))
WITH_HALVES = some.text(some.one_of(some.characters(), HALVES))


def written(rows: list[list[str]]) -> list[list[str]]:
    """Return the rows, written and read again."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "table.csv"
        file = CsvFile(path, ["first", "second"])
        file.write(rows)
        file.close()
        with path.open(encoding="utf-8", newline="") as again:
            return list(csv.reader(again))[1:]


@given(some.lists(some.lists(ANYTHING, min_size=2, max_size=2), max_size=8))
@example([["שלום", 'say "so"'], ["a\r\nb", "\n"], ["x" * 20_000, "\ufeff"], ["", ""]])
def test_any_text_survives(rows: list[list[str]]) -> None:
    assert written(rows) == rows


@given(WITH_HALVES)
@example("\ud83d and \udc80")
def test_in_json_even_halves_of_characters_survive(text: str) -> None:
    ((first, _),) = written([[format_cell({"value": text}), ""]])
    assert json.loads(first) == {"value": text}


@given(WITH_HALVES)
def test_a_half_of_a_character_breaks_no_file(text: str) -> None:
    ((first, _),) = written([[text, "next"]])
    assert first == text.encode("utf-8", "backslashreplace").decode()


@given(some.floats(allow_nan=False))
def test_a_number_is_read_back_exactly(number: float) -> None:
    assert float(format_cell(number)) == number


@pytest.mark.parametrize(
    ("cell", "text"), [(None, ""), (True, "true"), (False, "false"), (0, "0"), (("a", "b"), "a;b"), ((), "")]
)
def test_other_cells_are_plain(cell: object, text: str) -> None:
    assert format_cell(cell) == text  # type: ignore[arg-type]  # each is one of the kinds


def test_a_table_for_bids_has_no_tabs_or_lines_in_a_cell_and_a_word_for_an_empty_one(tmp_path: Path) -> None:
    file = TsvFile(tmp_path / "table.tsv", ["first", "second"])
    file.write([["a\tb\nc", ""]])
    file.close()
    assert (tmp_path / "table.tsv").read_text("utf-8") == f"first\tsecond\na b c\t{NOTHING}\n"
