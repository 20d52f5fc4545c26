"""No column without a description, and no cell that is not as its column is described."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path

import pytest

from kiosk.experiment.events import SessionEvent, WorldEvent
from kiosk.experiment.outcomes import Status
from kiosk.experiment.projections import Measures
from kiosk.export.codebook import as_written, variables
from kiosk.export.columns import SEPARATOR, Column, ColumnKind, ExportOption, TableShape, Variable, enum_levels
from kiosk.export.person import MEASURED, MEASURES
from kiosk.export.records import StudyMaterials
from kiosk.export.tables import all_tables
from tests.export.visitors import study_plan

Read = Callable[[str], list[dict[str, str]]]

EVERYTHING = frozenset(ExportOption)
STUDY = StudyMaterials((study_plan(),))


def shapes(extras: frozenset[ExportOption] = frozenset()) -> tuple[TableShape, ...]:
    return all_tables(STUDY, extras).shapes


def declared() -> list[tuple[str, Variable]]:
    return [(shape.name, variable) for shape in shapes(EVERYTHING) for variable in shape.variables]


def test_every_column_says_what_it_is() -> None:
    for table, variable in declared():
        assert len(variable.description.split()) > 1, (table, variable.name)
        assert variable.description.endswith("."), (table, variable.name)
        assert variable.empty == variable.empty.strip(" ."), (table, variable.name)
        assert (variable.unit == "ms") == variable.name.endswith("_ms"), (table, variable.name)
        assert len({level.name for level in variable.levels}) == len(variable.levels), (table, variable.name)


@pytest.mark.parametrize("description", ["", "a word", "no full stop"])
def test_a_column_without_a_description_cannot_be_made(description: str) -> None:
    with pytest.raises(ValueError, match="needs a description"):
        Column(Variable("flips", description), str)


def test_a_column_of_two_tables_says_the_same_in_both() -> None:
    assert len(variables(shapes(EVERYTHING))) == len({name for shape in shapes(EVERYTHING) for name in shape.names})
    other = TableShape("other", "Others.", (), (Variable("flip", "Something else."),))
    with pytest.raises(ValueError, match="'flip' means two things"):
        variables((*shapes(), other))


def test_no_name_stands_twice_in_a_table() -> None:
    for shape in shapes(EVERYTHING):
        assert len(set(shape.names)) == len(shape.names)
        assert set(shape.key) <= set(shape.names)


def test_every_measure_has_a_column() -> None:
    assert len(MEASURES) == len(fields(Measures)) + 2
    assert set(MEASURED) | {"per_match_ms", "per_match_with_speech_ms"} == {column.variable.name for column in MEASURES}


def test_levels_are_those_of_the_closed_set_and_no_others() -> None:
    assert [level.name for level in enum_levels(Status)] == [status.value for status in Status]
    with pytest.raises(ValueError, match="there is no"):
        enum_levels(Status, help="there is no such end")


def test_the_rows_of_every_table_are_told_apart_by_its_key(read: Read) -> None:
    for shape in shapes():
        rows = read(shape.name)
        assert len({tuple(row[name] for name in shape.key) for row in rows}) == len(rows)
        # Nothing deviated.
        assert bool(rows) is (shape.name != "deviations")


@pytest.mark.parametrize("shape", shapes(), ids=lambda shape: shape.name)
def test_every_cell_is_as_its_column_is_described(shape: TableShape, read: Read) -> None:
    for row in read(shape.name):
        assert tuple(row) == shape.names
        for variable in shape.variables:
            assert fits(row[variable.name], variable), (variable, row[variable.name])


def fits(cell: str, variable: Variable) -> bool:
    """Whether a cell may stand in this column."""
    if not cell:
        return bool(variable.empty)
    names = {level.name for level in variable.levels}
    match variable.kind:
        case ColumnKind.WHOLE | ColumnKind.NUMBER:
            number = int(cell) if variable.kind is ColumnKind.WHOLE else float(cell)
            least, most = (number if end is None else end for end in (variable.least, variable.most))
            return least <= number <= most
        case ColumnKind.TRUTH:
            return cell in {"true", "false"}
        case ColumnKind.JSON:
            return isinstance(json.loads(cell), dict)
        case ColumnKind.NAMES:
            return not names or set(cell.split(SEPARATOR)) <= names
        case ColumnKind.TEXT:
            return not names or cell in names


def test_the_codebook_tells_every_column_and_every_kind_of_event(exported: Path) -> None:
    page = (exported / "documentation" / "codebook.md").read_text("utf-8")
    for shape in shapes():
        section = page.split(f"## {shape.name}\n")[1].split("\n## ")[0]
        assert [line.split("`")[1] for line in section.splitlines() if line.startswith("| `")] == list(shape.names)
    kinds = page.split("## Kinds of events")[1]
    for base in (WorldEvent, SessionEvent):
        assert all(f"| `{kind.__name__}` |" in kinds for kind in base.__subclasses__())


def test_the_readme_names_every_file_that_there_is(exported: Path) -> None:
    page = (exported / "README.md").read_text("utf-8")
    assert all(f"({path.relative_to(exported).as_posix()})" in page for path in exported.glob("data/*.csv"))


def test_a_studys_own_names_give_way_to_the_columns_that_are_there_already() -> None:
    about_you = STUDY.plans[0].about_you
    clash = about_you.model_copy(update={"items": (about_you.items[0].model_copy(update={"id": "condition"}),)})
    study = StudyMaterials((STUDY.plans[0].__class__(**(vars(STUDY.plans[0]) | {"about_you": clash})),))
    names = all_tables(study, frozenset()).shapes[0].names
    assert "about_you_condition" in names
    assert names.count("condition") == 1


def test_no_word_of_a_study_is_markup_for_a_reader_of_the_codebook() -> None:
    written = as_written("Is A <b>bold</b> & 3 < 4? ![x](http://127.0.0.1/x.png)")
    assert written == "Is A &lt;b>bold&lt;/b> &amp; 3 &lt; 4? !\\[x](http://127.0.0.1/x.png)"
