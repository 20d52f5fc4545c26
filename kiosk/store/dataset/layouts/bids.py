"""Names like those of BIDS, for behaviour without recordings of the brain: a folder for each participant."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from kiosk import BadInput, __version__
from kiosk.store.dataset import codebook, prose
from kiosk.store.dataset.column import Kind, Shape, Table, Variable, distinct
from kiosk.store.dataset.files import TsvFile, write_json, write_text
from kiosk.store.dataset.layouts.layout import TASK, Contents, Layout
from kiosk.store.dataset.stored.kept import Kept
from kiosk.store.dataset.tables.flow import Flow
from kiosk.store.dataset.tables.personal import item_variable, told_items
from kiosk.store.dataset.tables.shared import AT, BOARD, FLIP, PARTICIPANT
from kiosk.study.declared.labels import fold_name, is_reserved
from kiosk.units import MS_PER_SECOND

BIDS_VERSION = "1.10.0"

_JOINED = ("flips", "decisions", "hints")
"""The tables that are one table here: of a flip, what was decided before it, and the hint for it."""

_TOOL = "MeasurementToolMetadata"
"""What BIDS calls the description of a questionnaire, beside those of its columns."""

_WHEN = {"events": AT}
"""Where the time of a row is told in seconds instead."""

_ONSET = Variable("onset", "When it happened, from the sitting's first event.", Kind.NUMBER, "s")
_DURATION = Variable("duration", "How long it lasted; events have no length.", Kind.NUMBER, "s", empty="always")


class Bids(Layout):
    """participants.tsv, sub-*/beh/*_beh.tsv and *_events.tsv, phenotype/*.tsv, and a JSON file beside each kind."""

    def __init__(self, root: Path, contents: Contents) -> None:
        """Begin the tables of all participants."""
        super().__init__(root, contents)
        tables = contents.tables
        self._people = tables.named("participants")
        self._answers = tables.named("answers")
        self._events = tables.named("events")
        self._joined = tuple(tables.named(name) for name in _JOINED)
        self._participants = TsvFile(root / "participants.tsv", self._people.shape.names)
        (root / "phenotype").mkdir()
        self._files = distinct_files(contents.study.forms)
        self._tools = {name: self._tool(name) for name in contents.study.forms}
        self._labels: set[str] = set()

    def add(self, kept: Kept) -> None:
        """Write a participant's own files, and their rows in the tables of all."""
        label = self._label(kept)
        self._participants.write([label, *row[1:]] for row in self._people.cells(kept))
        folder = self.root / label / "beh"
        folder.mkdir(parents=True)
        _write(folder / f"{label}_task-{TASK}_beh.tsv", _joined(self._joined), self._flips(kept))
        _write(folder / f"{label}_task-{TASK}_events.tsv", self._event_variables(), self._happened(kept))
        self._fill_in(kept, label)

    def finish(self, flows: tuple[Flow, ...]) -> None:  # noqa: ARG002 - BIDS has no place for the flow
        """Write what describes the tables."""
        root, task = self.root, prose.BIDS_TASK | {"TaskName": TASK}
        write_json(root / "participants.json", _described(self._people.shape.variables))
        write_json(root / f"task-{TASK}_beh.json", task | _described(_joined(self._joined)))
        write_json(root / f"task-{TASK}_events.json", task | _described(self._event_variables()))
        for name, tool in self._tools.items():
            forms = self.contents.study.forms[name]
            versions = ", ".join(form.label for form in forms)
            told = {"Description": f"{name}, version {versions}. {' '.join(forms[0].questionnaire.note.split())}"}
            described = {_TOOL: told} | _described([PARTICIPANT, *tool.items.values()])
            write_json(root / "phenotype" / f"{self._files[name]}.json", described)
        write_json(root / "dataset_description.json", self._description())
        write_text(root / "README.md", prose.bids_readme(self.contents.study, self.contents.extras))
        write_text(root / "CHANGES", prose.BIDS_CHANGES)

    def close(self) -> None:
        """Let go of all files."""
        self._participants.close()
        for tool in self._tools.values():
            tool.file.close()

    def _event_variables(self) -> list[Variable]:
        return [_ONSET, _DURATION, *_without(self._events.shape)]

    def _description(self) -> dict[str, Any]:
        study = self.contents.study
        return {
            "Name": study.title,
            "BIDSVersion": BIDS_VERSION,
            "DatasetType": "raw",
            "Keywords": list(prose.KEYWORDS),
            "GeneratedBy": [{"Name": "Recollect", "Version": __version__}],
        }

    def _label(self, kept: Kept) -> str:
        """What a participant's folder is called; raises BadInput if that of another is the same for some systems."""
        label = label_of(kept)
        if fold_name(label) in self._labels:
            raise BadInput(f"two participants would have the folder {label!r} where capitals do not count")
        self._labels.add(fold_name(label))
        return label

    def _tool(self, name: str) -> _Tool:
        """Begin a questionnaire's table: a row for each participant, a column for each item of any version."""
        study = self.contents.study
        asked = told_items(study.items(name), self.contents.extras)
        columns = distinct(asked, (PARTICIPANT.name, _TOOL))
        items = {item: item_variable(columns[item], asked_as, study) for item, asked_as in asked.items()}
        path = self.root / "phenotype" / f"{self._files[name]}.tsv"
        return _Tool(items, TsvFile(path, [PARTICIPANT.name, *(item.name for item in items.values())]))

    def _flips(self, kept: Kept) -> Iterator[list[str]]:
        """The flips, each with what stands of it in the other tables that are joined."""
        names = [variable.name for variable in _joined(self._joined)]
        others = [
            {(row[BOARD.name], row[FLIP.name]): row for row in _named_cells(table, kept)} for table in self._joined[1:]
        ]
        for flip in _named_cells(self._joined[0], kept):
            row = dict(flip)
            for other in others:
                row = other.get((flip[BOARD.name], flip[FLIP.name]), {}) | row
            yield [row.get(name, "") for name in names]

    def _happened(self, kept: Kept) -> Iterator[list[str]]:
        """The events, with the time in seconds in front, as BIDS has it."""
        names = [variable.name for variable in _without(self._events.shape)]
        for event in _named_cells(self._events, kept):
            yield [repr(int(event[AT.name]) / MS_PER_SECOND), "", *(event[name] for name in names)]

    def _fill_in(self, kept: Kept, label: str) -> None:
        """Write the answers of one participant, a row in each questionnaire that they could be asked."""
        answers: dict[str, dict[str, str]] = {}
        for row, cells in zip(self._answers.rows(kept), _named_cells(self._answers, kept), strict=True):
            answers.setdefault(row.questionnaire.id, {})[row.item.id] = cells["value"]
        for name, given in answers.items():
            tool = self._tools[name]
            tool.file.write([[label, *(given.get(item, "") for item in tool.items)]])


@dataclass(frozen=True)
class _Tool:
    """A questionnaire's columns by its items, and its file."""

    items: Mapping[str, Variable]
    file: TsvFile


def label_of(kept: Kept) -> str:
    """A participant as BIDS calls them: letters and digits alone. No site has small letters, so no two are alike."""
    return f"sub-{kept.name.replace('-', 'n')}"


def _write(path: Path, variables: Iterable[Variable], rows: Iterable[Sequence[str]]) -> None:
    with closing(TsvFile(path, [variable.name for variable in variables])) as file:
        file.write(rows)


def _named_cells(table: Table[Kept, Any], kept: Kept) -> Iterator[dict[str, str]]:
    for row in table.cells(kept):
        yield dict(zip(table.shape.names, row, strict=True))


def _without(shape: Shape) -> list[Variable]:
    """What a table says besides whose it is, and of events when they were."""
    return [variable for variable in shape.variables if variable not in {PARTICIPANT, _WHEN.get(shape.name)}]


def _joined(tables: Iterable[Table[Kept, Any]]) -> list[Variable]:
    return codebook.variables(Shape(table.name, "", (), tuple(_without(table.shape))) for table in tables)


def _described(variables: Iterable[Variable]) -> dict[str, Any]:
    """Columns as BIDS has them told; levels stand only where a cell is one of them and nothing else."""
    told: dict[str, Any] = {}
    for variable in variables:
        levels = {level.name: level.meaning or level.name for level in variable.levels}
        one = variable.kind is Kind.TEXT
        several = f" Any of: {', '.join(levels)}." if levels and not one else ""
        told[variable.name] = {"Description": codebook.in_full(variable) + several}
        told[variable.name] |= {"Units": variable.unit} if variable.unit else {}
        told[variable.name] |= {"Levels": levels} if levels and one else {}
    return told


def distinct_files(questionnaires: Iterable[str]) -> dict[str, str]:
    """A name for the file of each questionnaire: letters, digits and underscores, and no two alike for any system."""
    plain = {each: each.replace("-", "_") for each in questionnaires}
    allowed = {each: f"questionnaire_{name}" if is_reserved(name) else name for each, name in plain.items()}
    taken: list[str] = []
    for each, name in allowed.items():
        allowed[each] = distinct([name], taken)[name]
        taken.append(allowed[each])
    return allowed
