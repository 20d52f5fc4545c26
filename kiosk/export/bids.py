"""A data set laid out as BIDS wants it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from kiosk import UserInputError, __version__
from kiosk.experiment.labels import fold_name, is_reserved
from kiosk.export import codebook, readme_text
from kiosk.export.columns import AT, BOARD, FLIP, PARTICIPANT, ColumnKind, Table, TableShape, Variable, distinct
from kiosk.export.flow import ParticipantFlow
from kiosk.export.item_columns import EMPTY_MARKS, exported_items, item_variable
from kiosk.export.layouts import TASK, DatasetContents, Layout
from kiosk.export.new_files import TsvFile, write_json, write_text
from kiosk.store.session_records import SessionRecord
from kiosk.units import MS_PER_SECOND

BIDS_VERSION = "1.10.0"

_JOINED = ("flips", "decisions", "hints")
"""The tables that are one table here: of a flip, what was decided before it, and the hint for it."""

_TOOL = "MeasurementToolMetadata"
"""What BIDS calls the description of a questionnaire, beside those of its columns."""

_WHEN = {"events": AT}
"""Where the time of a row is given in seconds instead."""

_SESSION = Variable("session_id", "Which visit of the participant it is, from ses-1.")
_ONSET = Variable("onset", "When it happened, from the session's first event.", ColumnKind.NUMBER, "s")
_DURATION = Variable("duration", "How long it lasted; events have no length.", ColumnKind.NUMBER, "s", empty="always")


class Bids(Layout):
    """participants.tsv, sub-*/beh/*_beh.tsv and *_events.tsv, phenotype/*.tsv, and a JSON file beside each kind.

    Where visitors could come back, each visit is a session: sub-*/ses-*/beh, and a list of them in sub-*_sessions.tsv.
    """

    def __init__(self, root: Path, contents: DatasetContents) -> None:
        """Begin the tables of all participants."""
        super().__init__(root, contents)
        tables = contents.tables
        self._visits = contents.study.lets_return
        self._sessions: dict[str, list[list[str]]] = {}
        """The rows of the sessions of each participant, where there can be several."""
        self._people = tables.named("participants")
        self._answers = tables.named("answers")
        self._events = tables.named("events")
        self._joined = tuple(tables.named(name) for name in _JOINED)
        self._participants = TsvFile(root / "participants.tsv", self._people.shape.names)
        (root / "phenotype").mkdir()
        self._files = distinct_files(contents.study.forms)
        self._tools = {name: self._tool(name) for name in contents.study.forms}
        self._labels: set[str] = set()

    def add(self, kept: SessionRecord) -> None:
        """Write a participant's own files, and their rows in the tables of all."""
        label = bids_label(kept, visits=self._visits)
        session = _session_label(kept) if self._visits else ""
        self._refuse_alike(label, session)
        people = [row[1:] for row in self._people.cells(kept)]
        if label not in self._sessions:
            self._participants.write([label, *row] for row in people)
        self._sessions.setdefault(label, []).extend([session, *row] for row in people)
        folder = self.root / label / session / "beh"
        folder.mkdir(parents=True)
        name = "_".join(part for part in (label, session, f"task-{TASK}") if part)
        _write(folder / f"{name}_beh.tsv", _joined(self._joined), self._flips(kept))
        _write(folder / f"{name}_events.tsv", self._event_variables(), self._happened(kept))
        self._fill_in(kept, [label, *([session] if session else [])])

    def finish(self, flows: tuple[ParticipantFlow, ...]) -> None:  # noqa: ARG002 - BIDS has no place for the flow
        """Write what describes the tables."""
        root, task = self.root, readme_text.BIDS_TASK | {"TaskName": TASK}
        write_json(root / "participants.json", _described(self._people.shape.variables))
        self._list_sessions()
        write_json(root / f"task-{TASK}_beh.json", task | _described(_joined(self._joined)))
        write_json(root / f"task-{TASK}_events.json", task | _described(self._event_variables()))
        for name, tool in self._tools.items():
            forms = self.contents.study.forms[name]
            versions = ", ".join(form.label for form in forms)
            told = {"Description": f"{name}, version {versions}. {' '.join(forms[0].questionnaire.note.split())}"}
            described = {_TOOL: told} | _described([*self._whose, *tool.items.values()])
            write_json(root / "phenotype" / f"{self._files[name]}.json", described)
        write_json(root / "dataset_description.json", self._description())
        write_text(root / "README.md", readme_text.bids_readme(self.contents.study, self.contents.extras))
        write_text(root / "CHANGES", readme_text.BIDS_CHANGES)

    def close(self) -> None:
        """Let go of all files."""
        self._participants.close()
        for tool in self._tools.values():
            tool.file.close()

    @property
    def _whose(self) -> list[Variable]:
        """The columns that say whose answers a row of a questionnaire has."""
        return [PARTICIPANT, *([_SESSION] if self._visits else [])]

    def _list_sessions(self) -> None:
        """Write the sessions of each participant, the first visit first."""
        if not self._visits:
            return
        variables = [_SESSION, *self._people.shape.variables[1:]]
        for label, rows in self._sessions.items():
            _write(
                self.root / label / f"{label}_sessions.tsv", variables, sorted(rows, key=lambda row: int(row[0][4:]))
            )
        write_json(self.root / "sessions.json", _described(variables))

    def _event_variables(self) -> list[Variable]:
        return [_ONSET, _DURATION, *_without(self._events.shape)]

    def _description(self) -> dict[str, Any]:
        study = self.contents.study
        return {
            "Name": study.title,
            "BIDSVersion": BIDS_VERSION,
            "DatasetType": "raw",
            "Keywords": list(readme_text.KEYWORDS),
            "GeneratedBy": [{"Name": "Recollect", "Version": __version__}],
        }

    def _refuse_alike(self, label: str, session: str) -> None:
        """Raise UserInputError if some systems take a participant's folder for that of another."""
        folder = fold_name(f"{label}/{session}")
        if folder in self._labels:
            raise UserInputError(f"two participants would have the folder {label!r} where capitals do not count")
        self._labels.add(folder)

    def _tool(self, name: str) -> _Tool:
        """Begin a questionnaire's table: a row for each participant, a column for each item of any version."""
        study = self.contents.study
        extras = self.contents.extras
        asked = exported_items(study.items(name), extras)
        own = [each.name for each in self._whose]
        columns = distinct(asked, (*own, _TOOL))
        items = {
            (item, "value"): item_variable(columns[item], asked_as, study, extras) for item, asked_as in asked.items()
        }
        marked = [
            (mark, item, f"{columns[item]}_{mark.name}")
            for mark in EMPTY_MARKS
            for item, asked_as in asked.items()
            if mark.can_be(asked_as)
        ]
        others = distinct((other for *_, other in marked), (*own, _TOOL, *columns.values()))
        for mark, item, other in marked:
            items[item, mark.name] = mark.variable(others[other], columns[item])
        path = self.root / "phenotype" / f"{self._files[name]}.tsv"
        return _Tool(items, TsvFile(path, [*own, *(item.name for item in items.values())]))

    def _flips(self, kept: SessionRecord) -> Iterator[list[str]]:
        """Yield the flips, each with what stands of it in the other tables that are joined."""
        names = [variable.name for variable in _joined(self._joined)]
        others = [
            {(row[BOARD.name], row[FLIP.name]): row for row in _named_cells(table, kept)} for table in self._joined[1:]
        ]
        for flip in _named_cells(self._joined[0], kept):
            row = dict(flip)
            for other in others:
                row = other.get((flip[BOARD.name], flip[FLIP.name]), {}) | row
            yield [row.get(name, "") for name in names]

    def _happened(self, kept: SessionRecord) -> Iterator[list[str]]:
        """Yield the events, with the time in seconds in front, as BIDS has it."""
        names = [variable.name for variable in _without(self._events.shape)]
        for event in _named_cells(self._events, kept):
            yield [repr(int(event[AT.name]) / MS_PER_SECOND), "", *(event[name] for name in names)]

    def _fill_in(self, kept: SessionRecord, whose: Sequence[str]) -> None:
        """Write the answers of one participant, a row in each questionnaire that they could be asked."""
        answers: dict[str, dict[tuple[str, str], str]] = {}
        for row, cells in zip(self._answers.rows(kept), _named_cells(self._answers, kept), strict=True):
            of = answers.setdefault(row.questionnaire.id, {})
            of |= {(row.item.id, name): cells[name] for name in ("value", *(mark.name for mark in EMPTY_MARKS))}
        for name, given in answers.items():
            tool = self._tools[name]
            tool.file.write([[*whose, *(given.get(item, "") for item in tool.items)]])


@dataclass(frozen=True)
class _Tool:
    """A questionnaire's columns by its items and what of an answer they hold, and its file."""

    items: Mapping[tuple[str, str], Variable]
    file: TsvFile


def bids_label(kept: SessionRecord, *, visits: bool) -> str:
    """Return a participant as BIDS calls them: letters and digits alone.

    No site has small letters, so no two are alike. With ``visits``, it is the same at every visit.
    """
    return f"sub-{(kept.participant if visits else kept.name).replace('-', 'n')}"


def _session_label(kept: SessionRecord) -> str:
    """Return a visit as BIDS calls it."""
    return f"ses-{kept.visit}"


def _write(path: Path, variables: Iterable[Variable], rows: Iterable[Sequence[str]]) -> None:
    with closing(TsvFile(path, [variable.name for variable in variables])) as file:
        file.write(rows)


def _named_cells(table: Table[SessionRecord, Any], kept: SessionRecord) -> Iterator[dict[str, str]]:
    for row in table.cells(kept):
        yield dict(zip(table.shape.names, row, strict=True))


def _without(shape: TableShape) -> list[Variable]:
    """Return what a table says besides whose it is, and of events when they were."""
    return [variable for variable in shape.variables if variable not in {PARTICIPANT, _WHEN.get(shape.name)}]


def _joined(tables: Iterable[Table[SessionRecord, Any]]) -> list[Variable]:
    return codebook.variables(TableShape(table.name, "", (), tuple(_without(table.shape))) for table in tables)


def _described(variables: Iterable[Variable]) -> dict[str, Any]:
    """Columns as BIDS has them told; levels stand only where a cell is one of them and nothing else."""
    told: dict[str, Any] = {}
    for variable in variables:
        levels = {level.name: level.meaning or level.name for level in variable.levels}
        one = variable.kind is ColumnKind.TEXT
        several = f" Any of: {', '.join(levels)}." if levels and not one else ""
        told[variable.name] = {"Description": codebook.full_description(variable) + several}
        told[variable.name] |= {"Units": variable.unit} if variable.unit else {}
        told[variable.name] |= {"Levels": levels} if levels and one else {}
    return told


def distinct_files(questionnaires: Iterable[str]) -> dict[str, str]:
    """Return a name for the file of each questionnaire.

    It has letters, digits and underscores, and no two are alike for any system.
    """
    plain = {each: each.replace("-", "_") for each in questionnaires}
    allowed = {each: f"questionnaire_{name}" if is_reserved(name) else name for each, name in plain.items()}
    taken: list[str] = []
    for each, name in allowed.items():
        allowed[each] = distinct([name], taken)[name]
        taken.append(allowed[each])
    return allowed
