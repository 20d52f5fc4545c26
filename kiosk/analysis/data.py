"""Read an exported data set (the Psych-DS layout of ``recollect export``) as tables of typed columns."""

from __future__ import annotations

import csv
import hashlib
import io
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from kiosk import UserInputError, why
from kiosk.experiment.condition import Condition, in_design_order
from kiosk.export.codebook import CODEBOOK_VERSION
from kiosk.export.layouts import PLANS, file_of, plan_file
from kiosk.files import parse_json

Floats = npt.NDArray[np.float64]
Truths = npt.NDArray[np.bool_]

DESCRIPTION = "dataset_description.json"
_TRUTHS = {"true": 1.0, "false": 0.0, "": np.nan}

COLUMNS: Mapping[str, tuple[str, ...]] = {
    "participants": (
        *(
            "participant_id",
            "condition",
            "allocation_source",
            "status",
            "last_stage",
            "game_completed",
            "resumed",
            "pauses",
        ),
        *("flips", "moves", "pairs", "hints", "completion_with_speech_ms", "completion_ms", "per_match_ms"),
        *("assistance_per_flip", "followed_rate", "first_followed_rate", "first_led_to_match_rate"),
    ),
    "flips": ("participant_id", "stage", "flip", "move_card", "matched", "hinted", "followed", "decision_ms"),
    "hints": ("participant_id", "move_card", "action", "followed", "move_matched"),
    "answers": ("participant_id", "questionnaire", "item", "scored", "scale"),
    "scores": ("participant_id", "questionnaire", "scale", "sum", "mean", "items", "answered"),
    "flow": ("quantity", "group", "count"),
}
"""The tables of a report, and the columns that each must have."""

OPTIONAL = {
    "participants": ("site", "simulated", "trial", "visit"),
    "flow": ("simulated", "trial"),
    "hints": ("cue",),
    "scores": ("version", "items_not_applicable", "items_not_shown"),
}
"""Columns that some data sets have."""

DECIDED, PREDICTED = ("participant_id", "flip", "move_card"), ("completes_predicted",)
"""The columns of the decisions by which a model of memory is compared with what came."""
DRAWN = ("participant_id", "flip", "move_card", "action", "action_probability", "randomised")
"""The columns of the decisions that a study which explores is analysed by."""


@dataclass(frozen=True)
class ExportTable:
    """One table; every column is a list of cells as they stand in the file, all of the same length."""

    path: Path
    columns: Mapping[str, Sequence[str]]

    def __len__(self) -> int:
        """How many rows there are."""
        return len(next(iter(self.columns.values())))

    def text(self, column: str) -> Sequence[str]:
        """Return the cells of a column; a column that this data set does not have is empty."""
        return self.columns.get(column) or [""] * len(self)

    def numbers(self, column: str) -> Floats:
        """Return a column as numbers; truths are 1 and 0, empty cells NaN.

        Raises UserInputError, naming file, column and row, for a cell that is neither.
        """
        cells = self.text(column)
        try:
            values = np.array([_TRUTHS[cell] if cell in _TRUTHS else float(cell) for cell in cells])
        except ValueError:
            row = next(number for number, cell in enumerate(cells) if not _is_number(cell))
            raise UserInputError(
                f"{self.path}, row {row + 2}: {column} must be a number, but it is {cells[row]!r}"
            ) from None
        if np.isinf(values).any():
            raise UserInputError(f"{self.path}, row {int(np.isinf(values).argmax()) + 2}: {column} is infinite")
        return values

    def truths(self, column: str) -> Truths:
        """Return a column of ``true`` and ``false``; empty cells are false."""
        return np.array([cell == "true" for cell in self.text(column)], dtype=np.bool_)

    def where(self, rows: Truths) -> ExportTable:
        """Return the rows that are marked, in a table of their own."""
        kept = np.flatnonzero(rows).tolist()
        return ExportTable(self.path, {name: [cells[row] for row in kept] for name, cells in self.columns.items()})


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return cell in _TRUTHS
    return True


@dataclass(frozen=True)
class FrozenRecord:
    """A plan that was frozen where the data were recorded; ``looks`` are the participants an arm at each look."""

    sha256: str
    before_first_session: bool
    looks: tuple[int, ...]
    file: Path


@dataclass(frozen=True)
class ExportedStudy:
    """A data set: its title, its tables, and a hash of the files that were read."""

    folder: Path
    title: str
    tables: Mapping[str, ExportTable]
    sha256: str
    plans: tuple[FrozenRecord, ...] = ()
    decisions: ExportTable | None = None
    """The decisions of a study in which some were drawn at random."""
    modelled: ExportTable | None = None
    """The decisions of a study with a model of memory, with what it predicted."""
    remarks: ExportTable | None = None
    """Praise, encouragement and other remarks, in a study that has some."""

    @property
    def participants(self) -> ExportTable:
        """One row for every session."""
        return self.tables["participants"]

    @property
    def conditions(self) -> tuple[str, ...]:
        """The conditions that occur, in the design's order, unknown names last."""
        return in_order(self.participants.text("condition"))


def in_order(conditions: Sequence[str]) -> tuple[str, ...]:
    """Return the different conditions in the order of the design, unknown names last."""
    return tuple(condition.name for condition in in_design_order(map(Condition, conditions)))


def load_study(folder: Path) -> ExportedStudy:
    """Read a data set.

    Raises UserInputError for a folder that is none, one of another codebook version, and one that lacks a table.
    """
    described = _description(folder)
    digest = hashlib.sha256()
    tables = {}
    for name, columns in COLUMNS.items():
        tables[name] = load_table(folder, name, columns, OPTIONAL.get(name, ()), digest)
    plans = _frozen_plans(folder, digest)
    decisions = _drawn_decisions(folder, digest)
    modelled, remarks = _modelled_decisions(folder, digest), _remarks(folder, digest)
    name = str(described.get("name", ""))
    return ExportedStudy(folder, name, tables, digest.hexdigest(), plans, decisions, modelled, remarks)


def _drawn_decisions(folder: Path, digest: Any) -> ExportTable | None:
    """Return the decisions, if chance had a part in some; simulated data sets have no such table."""
    if not (folder / file_of("decisions")).exists():
        return None
    drawn = load_table(folder, "decisions", DRAWN).truths("randomised").any()
    return load_table(folder, "decisions", DRAWN, digest=digest) if drawn else None


def _modelled_decisions(folder: Path, digest: Any) -> ExportTable | None:
    """Return the decisions, if a model of memory made predictions."""
    if not (folder / file_of("decisions")).exists():
        return None
    (predicted,) = PREDICTED
    if predicted not in load_table(folder, "decisions", DECIDED, PREDICTED).columns:
        return None
    return load_table(folder, "decisions", (*DECIDED, *PREDICTED), digest=digest)


def _remarks(folder: Path, digest: Any) -> ExportTable | None:
    """Return the remarks, if the study has some."""
    if not (folder / file_of("remarks")).exists():
        return None
    return load_table(folder, "remarks", ("participant_id", "remark"), digest=digest)


def _frozen_plans(folder: Path, digest: Any) -> tuple[FrozenRecord, ...]:
    """Return the plans that the data set carries, oldest first.

    A file that is not what its hash says is refused.
    """
    path = folder / PLANS
    if not path.exists():
        return ()
    try:
        content = path.read_bytes()
        rows = parse_json(content)
        plans = tuple(
            FrozenRecord(
                str(row["sha256"]),
                row["before_first_session"] is True,
                tuple(int(look) for look in row["looks"]),
                path.with_name(plan_file(str(row["sha256"]))),
            )
            for row in rows
        )
    except OSError as error:
        raise UserInputError(f"{path} cannot be read: {why(error)}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise UserInputError(f"{path} is not a list of frozen plans; export the data again") from error
    digest.update(content)
    for plan in plans:
        if not plan.file.is_file() or hashlib.sha256(plan.file.read_bytes()).hexdigest() != plan.sha256:
            raise UserInputError(f"{plan.file} is not the plan that was frozen; export the data again")
    return plans


def load_table(
    folder: Path, name: str, columns: Sequence[str], optional: Sequence[str] = (), digest: Any = None
) -> ExportTable:
    """Read some columns of one table; ``digest`` is updated with the bytes of the file."""
    path = folder / file_of(name)
    try:
        content = path.read_bytes()
    except FileNotFoundError as error:
        raise UserInputError(f"{folder} lacks the table {name} ({file_of(name)}); export the data again") from error
    except OSError as error:
        raise UserInputError(f"{path} cannot be read: {why(error)}") from error
    if digest is not None:
        digest.update(content)
    try:
        rows = csv.reader(io.StringIO(content.decode("utf-8"), newline=""), strict=True)
        return ExportTable(path, _columns(path, rows, columns, optional))
    except (UnicodeDecodeError, csv.Error) as error:
        raise UserInputError(f"{path} is not a table of this program: {error}") from error


def _columns(
    path: Path, rows: Iterator[list[str]], wanted: Sequence[str], optional: Sequence[str]
) -> dict[str, Sequence[str]]:
    header = next(rows, [])
    missing = [column for column in wanted if column not in header]
    if missing:
        raise UserInputError(f"{path} lacks the columns {', '.join(missing)}; export the data with this version")
    kept = [column for column in header if column in wanted or column in optional]
    places = [header.index(column) for column in kept]
    cells: list[list[str]] = [[] for _ in kept]
    for number, row in enumerate(rows, 2):
        if len(row) != len(header):
            raise UserInputError(f"{path}, row {number}: there are {len(row)} cells, but {len(header)} columns")
        for column, place in zip(cells, places, strict=True):
            column.append(row[place])
    return dict(zip(kept, cells, strict=True))


def _description(folder: Path) -> dict[str, Any]:
    """Return what the data set says of itself."""
    if (folder / "participants.tsv").exists():
        raise UserInputError(f"{folder} has the names of BIDS; export the data without --bids for a report")
    path = folder / DESCRIPTION
    try:
        described = parse_json(path.read_text("utf-8"))
    except FileNotFoundError as error:
        what = "is no folder" if not folder.is_dir() else f"is no exported data set; it has no {DESCRIPTION}"
        raise UserInputError(f"{folder} {what}") from error
    except NotADirectoryError as error:
        raise UserInputError(f"{folder} is a file; a report needs the folder of an exported data set") from error
    except OSError as error:
        raise UserInputError(f"{path} cannot be read: {why(error)}") from error
    except ValueError as error:
        raise UserInputError(f"{path} is not JSON in UTF-8: {error}") from error
    if not isinstance(described, dict) or not re.search("Recollect", str(described.get("description", ""))):
        raise UserInputError(f"{folder} is no data set of Recollect; {DESCRIPTION} does not name it")
    version = described.get("schemaVersion", "none")
    if version != CODEBOOK_VERSION:
        raise UserInputError(
            f"{folder} has the codebook version {version}, but this program reads {CODEBOOK_VERSION}; "
            "export the data with this version"
        )
    return described


@dataclass(frozen=True)
class ScaleItems:
    """The scored answers to a scale: a row per participant, a column per item, NaN for no answer."""

    name: str
    items: tuple[str, ...]
    participants: tuple[str, ...]
    scored: Floats


def scale_items(study: ExportedStudy, participants: Sequence[str]) -> tuple[ScaleItems, ...]:
    """All scales of the questionnaires, with the answers of these participants, in the order of their first item."""
    table = study.tables["answers"]
    scored = table.numbers("scored")
    wanted = {name: row for row, name in enumerate(participants)}
    named = scale_names(table)
    found: dict[tuple[str, str], dict[str, Floats]] = {}
    keys = zip(table.text("questionnaire"), table.text("scale"), table.text("item"), strict=True)
    for (questionnaire, scale, item), who, score in zip(keys, table.text("participant_id"), scored, strict=True):
        if not scale:
            continue
        answers = found.setdefault((questionnaire, scale), {}).setdefault(item, np.full(len(wanted), np.nan))
        if who in wanted:
            answers[wanted[who]] = score
    scales = []
    for key, items in found.items():
        names = tuple(sorted(items, key=_natural))
        matrix = np.column_stack([items[name] for name in names]) if wanted else np.empty((0, len(names)))
        scales.append(ScaleItems(named[key], names, tuple(participants), matrix))
    return tuple(sorted(scales, key=lambda scale: list(named.values()).index(scale.name)))


def scale_names(table: ExportTable) -> dict[tuple[str, str], str]:
    """Return what each scale is called: its own name, after its questionnaire's where two have the same."""
    keys = dict.fromkeys(key for key in zip(table.text("questionnaire"), table.text("scale"), strict=True) if key[1])
    alone = Counter(scale for _, scale in keys)
    return {key: key[1] if alone[key[1]] == 1 else ".".join(key) for key in keys}


def scale_remarks(study: ExportedStudy, participants: Sequence[str]) -> tuple[str, ...]:
    """Return sentences for scales that were asked in several versions, or whose items did not all apply or appear."""
    table = study.tables["scores"]
    named = scale_names(table)
    wanted = set(participants)
    versions: dict[str, set[str]] = {}
    exempt: Counter[str] = Counter()
    hidden: Counter[str] = Counter()
    keys = zip(table.text("questionnaire"), table.text("scale"), strict=True)
    told = zip(keys, table.text("participant_id"), table.text("version"), strict=True)
    counts = zip(table.numbers("items_not_applicable"), table.numbers("items_not_shown"), strict=True)
    for (key, who, version), (not_applicable, not_shown) in zip(told, counts, strict=True):
        if who in wanted:
            versions.setdefault(named[key], set()).add(version)
            exempt[named[key]] += 0 if np.isnan(not_applicable) else int(not_applicable)
            hidden[named[key]] += 0 if np.isnan(not_shown) else int(not_shown)
    remarks = [
        f"{name} was asked in {len(found)} versions of its questionnaire ({', '.join(sorted(found))}). The codebook of "
        "the data set says what differs; sums of versions that differ are not to be compared."
        for name, found in versions.items()
        if len(found) > 1
    ]
    remarks += [
        f"Of the responses to items of {name}, {count} said that the item does not apply. They are in no sum, so "
        f"{name} has fewer people."
        for name, count in exempt.items()
        if count
    ]
    remarks += [
        f"Of the items of {name}, {count} were hidden by their condition, counted over all people. They are in no sum, "
        f"so {name} has fewer people."
        for name, count in hidden.items()
        if count
    ]
    return tuple(remarks)


def _natural(name: str) -> tuple[tuple[str, int], ...]:
    """Sort SOC2 before SOC10."""
    parts = ["", *re.split(r"(\d+)", name)]
    return tuple((text, int(number) if number.isdigit() else -1) for text, number in pairwise(parts))
