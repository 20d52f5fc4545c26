"""The layouts of a data set on disk: Psych-DS and BIDS."""

from __future__ import annotations

import csv
import hashlib
import json
import os
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, TextIO

from pydantic import BaseModel

from kiosk import UserInputError, __version__, unwritable
from kiosk.config import Settings
from kiosk.experiment.labels import fold_name, is_reserved
from kiosk.experiment.session_config import SessionConfig
from kiosk.export import columns, readme_text
from kiosk.export.columns import (
    AT,
    BOARD,
    FLIP,
    PARTICIPANT,
    ColumnKind,
    ExportOption,
    Table,
    TableShape,
    Variable,
    distinct,
)
from kiosk.export.flow import ParticipantFlow
from kiosk.export.item_columns import EMPTY_MARKS, exported_items, item_variable
from kiosk.export.records import StudyMaterials
from kiosk.export.tables import DatasetTables
from kiosk.store.connecting import atomic_directory
from kiosk.store.plans import FrozenPlan
from kiosk.store.session_records import SessionRecord
from kiosk.units import MS_PER_SECOND

UNDATED = datetime(1980, 1, 2, tzinfo=UTC).timestamp()
"""What every file says of when it was changed: nothing. No archive format knows an earlier day than this one's eve."""

NOTHING = "n/a"
"""How BIDS writes an empty cell."""

_WITHIN_A_LINE = str.maketrans("\t\r\n", "   ")


class CsvFile:
    """A table as CSV (RFC 4180) in UTF-8; halves of characters, which no file can hold, stand escaped."""

    def __init__(self, path: Path, names: Sequence[str]) -> None:
        """Begin the file with a line of names."""
        # With line ends of two characters every cell that holds either of them is put in quotes.
        _check_columns(path, names)
        self._file = _new(path).open("x", encoding="utf-8", errors="backslashreplace", newline="")
        self._writer = _csv_writer(self._file)
        self._writer.writerow(names)

    def write(self, rows: Iterable[Sequence[str]]) -> None:
        """Add rows."""
        self._writer.writerows(rows)

    def append(self, text: str) -> None:
        """Add rows that are written as such a file has them."""
        self._file.write(text)

    def close(self) -> None:
        """Nothing follows."""
        self._file.close()


def _csv_writer(file: TextIO) -> Any:
    return csv.writer(file, lineterminator="\r\n")


def csv_texts(tables: DatasetTables, kept: SessionRecord) -> dict[str, str]:
    """Return the rows that one session adds to each table, as they stand in a CSV file."""
    return {table.name: csv_lines(table.written(kept)) for table in tables.sessions}


def csv_lines(written: Sequence[Sequence[str]]) -> str:
    """Return the lines of a table of at least two columns, as ``csv.writer`` would write them."""
    lines = list(map(",".join, zip(*map(_quoted, written), strict=True)))
    return "\r\n".join((*lines, "")) if lines else ""


def _quoted(cells: Sequence[str]) -> Sequence[str]:
    """Return the cells of a column as CSV has them."""
    # Most columns need no quotes, which one look at all their cells tells.
    if not _needs_quotes("".join(cells)):
        return cells
    # JSON needs them for its own quotes, which is looked at first, and here, because a call takes as long.
    return ['"' + cell.replace('"', '""') + '"' if '"' in cell or _needs_quotes(cell) else cell for cell in cells]


def _needs_quotes(text: str) -> bool:
    return '"' in text or "," in text or "\r" in text or "\n" in text


class TsvFile:
    """A table as BIDS wants it: tabs between cells, none within them, and a word for an empty one."""

    def __init__(self, path: Path, names: Sequence[str]) -> None:
        """Begin the file with a line of names."""
        _check_columns(path, names)
        self._file = _new(path).open("x", encoding="utf-8", errors="backslashreplace", newline="\n")
        self.write([names])

    def write(self, rows: Iterable[Sequence[str]]) -> None:
        """Add rows."""
        for row in rows:
            self._file.write("\t".join(cell.translate(_WITHIN_A_LINE) or NOTHING for cell in row) + "\n")

    def close(self) -> None:
        """Nothing follows."""
        self._file.close()


def write_json(path: Path, content: Any) -> None:
    """Write JSON for programs that a person may read as well."""
    write_text(path, json.dumps(content, ensure_ascii=False, indent=2) + "\n")


def write_text(path: Path, text: str) -> None:
    """Write a text into a new file, and make the folders it lies in."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with _new(path).open("x", encoding="utf-8", errors="backslashreplace", newline="\n") as file:
        file.write(text)


def _new(path: Path) -> Path:
    """Return the path, if nothing beside it has this name.

    Raises UserInputError instead of writing over what is there.
    """
    name = fold_name(path.name)
    beside = next((other.name for other in path.parent.iterdir() if fold_name(other.name) == name), None)
    if beside is not None or is_reserved(path.name):
        why = f"{beside!r} is one file with it" if beside else "Windows keeps this name for a device"
        raise UserInputError(
            f"the data set cannot have a file {path.name!r} in {path.parent.name!r}: {why} on some systems"
        )
    return path


def _check_columns(path: Path, names: Sequence[str]) -> None:
    """Raise UserInputError if two columns of a table are one for programs that do not tell capitals apart."""
    first: dict[str, str] = {}
    for name in names:
        if fold_name(name) in first:
            other = first[fold_name(name)]
            raise UserInputError(
                f"the table {path.name!r} cannot have the columns {other!r} and {name!r}, one for many programs"
            )
        first[fold_name(name)] = name


@contextmanager
def new_folder(out: Path) -> Iterator[Path]:
    """Provide a folder beside ``out`` to write in.

    It takes the place of ``out`` at the end and is gone if anything goes wrong.

    Raises UserInputError, and leaves everything as it was, if ``out`` holds something or cannot be written.
    """
    try:
        _check_free(out)
        with atomic_directory(out) as made:
            yield made
            _take_the_dates_away(made)
    except OSError as error:
        raise unwritable(f"the data set cannot be written to {out}", error) from error


def _check_free(out: Path) -> None:
    if not out.name:
        raise UserInputError(f"the data set needs a folder of its own, not {out}")
    if out.exists() and not out.is_dir():
        raise UserInputError(f"the data set needs a folder, but {out} is a file")
    if out.exists() and any(out.iterdir()):
        raise UserInputError(f"the folder {out} is not empty; a data set is written into a new one")


def _take_the_dates_away(folder: Path) -> None:
    for path in (*folder.rglob("*"), folder):
        os.utime(path, (UNDATED, UNDATED))


TASK = "concentration"


@dataclass(frozen=True)
class DatasetContents:
    """What a data set is made of, but for the sessions."""

    study: StudyMaterials
    tables: DatasetTables
    extras: frozenset[ExportOption]
    frozen: tuple[FrozenPlan, ...] = ()


class Layout(ABC):
    """Writes a data set into a folder, session by session."""

    def __init__(self, root: Path, contents: DatasetContents) -> None:
        """Begin the files that sessions are added to."""
        self.root = root
        self.contents = contents

    @abstractmethod
    def add(self, kept: SessionRecord) -> None:
        """Write what one session adds to the tables."""

    @abstractmethod
    def finish(self, flows: tuple[ParticipantFlow, ...]) -> None:
        """Write what can only be told at the end, and all that describes the tables."""

    @abstractmethod
    def close(self) -> None:
        """Let go of all files, whether or not everything was written."""


PUBLISHED = frozenset(
    {
        "title",
        "languages",
        "stages",
        "about_you",
        "questionnaires",
        "game",
        "practice",
        "assistance",
        "conditions",
        "timing",
        "idle_ms",
        "voice",
        "screen",
        "privacy",
    }
)
"""The parts of a study file that say nothing of people, devices, keys or seeds; a new part is not among them."""

_PARTLY: dict[str, bool | set[str]] = {"randomisation": {"target_n", "block_size"}, "consent": {"adult"}}
"""What else is said of other parts: who wants to analyse an allocation as it was made has to know its blocks."""

PLANS = Path("materials", "plans", "plans.json")
"""The plans that were frozen in the data folder; only a data set that has one has this file."""

_SHOWN = 12
"""Characters of a hash in a file's name."""


def write_materials(folder: Path, study: StudyMaterials) -> None:
    """Write everything once, however many sessions followed it."""
    for name, content in {material for plan in study.plans for material in _materials(plan)}:
        write_text(folder / name, content)


def plan_file(sha256: str) -> str:
    """Return what the file of a frozen plan is called."""
    return f"plan-{sha256[:_SHOWN]}.toml"


def write_plans(root: Path, plans: Sequence[FrozenPlan]) -> None:
    """Write the plans that were frozen, and what a reader must know of each; no dates."""
    if not plans:
        return
    for plan in plans:
        write_text(root / PLANS.with_name(plan_file(plan.sha256)), plan.text)
    told = [
        {"sha256": plan.sha256, "before_first_session": plan.before_first_session, "looks": list(plan.looks)}
        for plan in plans
    ]
    write_json(root / PLANS, told)


def _materials(plan: SessionConfig) -> Iterator[tuple[str, str]]:
    for questionnaire in (plan.about_you, *plan.questionnaires):
        yield _file(f"questionnaires/{questionnaire.id}", questionnaire.sha256), _pretty(questionnaire)
    yield _file(f"information/{plan.language}", plan.information.sha256), _pretty(plan.information)
    yield _file("policies/policy", plan.policy.sha256), plan.policy.to_json()
    yield _file("settings/settings", plan.settings.sha256), _published(plan.settings)
    decks = json.dumps({"game": plan.deck, "practice": plan.practice_deck}, ensure_ascii=False, indent=2) + "\n"
    yield _file("decks/decks", hashlib.sha256(decks.encode()).hexdigest()), decks


def _file(name: str, sha256: str) -> str:
    return f"{name}-{sha256[:_SHOWN]}.json"


def _pretty(content: BaseModel) -> str:
    return content.model_dump_json(indent=2) + "\n"


def _published(settings: Settings) -> str:
    told: dict[str, Any] = json.loads(settings.model_dump_json(include=_PARTLY | dict.fromkeys(PUBLISHED, True)))
    return json.dumps(told, ensure_ascii=False, indent=2) + "\n"


class PsychDs(Layout):
    """The tables as they are, one file each."""

    def __init__(self, root: Path, contents: DatasetContents) -> None:
        """Begin every table."""
        super().__init__(root, contents)
        (root / "data").mkdir()
        self._files = {shape.name: CsvFile(root / file_of(shape.name), shape.names) for shape in contents.tables.shapes}

    def add(self, kept: SessionRecord) -> None:
        """Write what one session adds to the tables."""
        self.put(csv_texts(self.contents.tables, kept))

    def put(self, texts: Mapping[str, str]) -> None:
        """Write what ``csv_texts`` made of one session."""
        for name, text in texts.items():
            self._files[name].append(text)

    def finish(self, flows: tuple[ParticipantFlow, ...]) -> None:
        """Write the flow, and all that describes the tables."""
        flow = self.contents.tables.flow
        self._files[flow.name].write(flow.cells(flows))
        shapes, root = self.contents.tables.shapes, self.root
        write_json(root / "dataset_description.json", self._described() | columns.variables_measured(shapes))
        write_json(root / "data" / "file_metadata.json", columns.CONTEXT | {"encodingFormat": "text/csv"})
        for shape in shapes:
            own = {"name": shape.name, "description": shape.about} | columns.variables_measured([shape])
            write_json((root / file_of(shape.name)).with_suffix(".json"), columns.CONTEXT | own)
        files = {shape.name: file_of(shape.name) for shape in shapes}
        write_text(root / "documentation" / "codebook.md", columns.codebook_markdown(shapes, files))
        write_text(
            root / "README.md", readme_text.dataset_readme(self.contents.study, shapes, files, self.contents.extras)
        )
        write_text(root / "CHANGES.md", readme_text.CHANGES)
        write_text(root / ".psychdsignore", readme_text.PSYCHDSIGNORE)
        write_text(root / "analysis" / "example.py", readme_text.EXAMPLE)
        write_text(root / "results" / "README.md", readme_text.RESULTS)
        write_text(root / "materials" / "README.md", readme_text.MATERIALS)
        write_materials(root / "materials", self.contents.study)
        write_plans(root, self.contents.frozen)

    def close(self) -> None:
        """Let go of all files."""
        for file in self._files.values():
            file.close()

    def _described(self) -> dict[str, object]:
        study = self.contents.study
        return columns.CONTEXT | {
            "name": study.title,
            "description": readme_text.dataset_abstract(study, self.contents.extras),
            "keywords": list(readme_text.KEYWORDS),
            "inLanguage": list(study.languages),
            "schemaVersion": columns.CODEBOOK_VERSION,
        }


def file_of(table: str) -> str:
    """Where a table is, seen from the data set's folder."""
    return f"data/task-{TASK}_description-{table}_data.csv"


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
    return columns.variables(TableShape(table.name, "", (), tuple(_without(table.shape))) for table in tables)


def _described(variables: Iterable[Variable]) -> dict[str, Any]:
    """Columns as BIDS has them told; levels stand only where a cell is one of them and nothing else."""
    told: dict[str, Any] = {}
    for variable in variables:
        levels = {level.name: level.meaning or level.name for level in variable.levels}
        one = variable.kind is ColumnKind.TEXT
        several = f" Any of: {', '.join(levels)}." if levels and not one else ""
        told[variable.name] = {"Description": columns.full_description(variable) + several}
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
