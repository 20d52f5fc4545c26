"""The texts that stand in a data set for its readers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from kiosk import __version__
from kiosk.experiment.condition import in_design_order
from kiosk.experiment.information import PUBLISHING
from kiosk.export.codebook import MARKED, as_written
from kiosk.export.columns import ExportOption, TableShape
from kiosk.export.records import StudyMaterials

KEYWORDS = ("Concentration", "memory game", "human-robot interaction", "assistance", "Theory of Mind")

_NOT_HERE = (
    "The codes with which participants withdraw, which are not stored themselves, and the seeds of the sessions.",
    "People who played without being stored: only how many there were, and why.",
    "People who withdrew: only how many there were.",
    "Voices, pictures, names: they were never recorded.",
    "Of the settings, what concerns the place: the robot's address, whom to write to, keys and seeds.",
)

_LEFT_OUT = {
    ExportOption.DATES: "Dates and times of day. All times count from the first event of the session that they belong "
    "to, and the files' own dates say nothing.",
    ExportOption.TEXTS: "What people typed: short answers, an experimenter's reason for ending a session, and messages "
    "of failures. They may hold names, or tell where it was.",
    ExportOption.AGES: "Exact ages: they stand in bands of some years, in every table and event.",
    ExportOption.REHEARSALS: "Rehearsals, in which a program plays.",
    ExportOption.TRIALS: "Trials, in which a person plays at a kiosk without a PIN.",
    ExportOption.UNSHARED: f"Sessions whose visitor was asked whether their data may be published (the purpose "
    f"`{PUBLISHING}`) and did not agree; the flow says how many.",
}

_NOT_FOR_PUBLISHING = {
    ExportOption.DATES: "dates",
    ExportOption.TEXTS: "texts that people typed",
    ExportOption.AGES: "exact ages",
    ExportOption.UNSHARED: "sessions whose visitor did not agree to publishing",
}

CHANGES = """# Changes

## 1

- As it was exported.
"""

BIDS_TASK = {
    "TaskDescription": "Concentration: closed cards lie on a board, two are turned up in each move, and two that show "
    "the same picture stay open. A robot or an avatar may name a column, a row or a card before a card is turned up.",
    "Instructions": "Find all pairs. The helper may give a hint; it can be followed or not.",
    "StimulusPresentation": {"SoftwareName": "Recollect", "SoftwareVersion": __version__},
}

BIDS_CHANGES = """1.0.0
 - As it was exported.
"""

PSYCHDSIGNORE = """# Everything in this data set follows Psych-DS; nothing has to be left out of a check.
"""

RESULTS = """# Results

Nothing has been worked out here yet. What is made from the tables in `data/` belongs into this folder.
"""

MATERIALS = """# Materials

What the sessions followed, each under the first characters of its hash: questionnaires, information sheets, the tables
that chose how much to help, and settings. Of the settings, what concerns people, devices, keys and seeds is left out,
so their hash is that of more than stands here. What a program of today cannot read any more is missing.
"""

EXAMPLE = '''"""Moves by condition, of all who completed the game in a condition that was drawn; nothing but Python."""

import csv
from pathlib import Path
from statistics import fmean, stdev

data = Path(__file__).parent.parent / "data"
with (data / "task-concentration_description-participants_data.csv").open(encoding="utf-8", newline="") as file:
    drawn = [person for person in csv.DictReader(file) if person["allocation_source"] in ("list", "")]
people = [person for person in drawn if person["game_completed"] == "true"]
for condition in sorted({person["condition"] for person in people}):
    moves = [int(person["moves"]) for person in people if person["condition"] == condition]
    print(condition, len(moves), round(fmean(moves), 2), round(stdev(moves), 2) if len(moves) > 1 else "")
'''


def dataset_abstract(study: StudyMaterials, extras: frozenset[ExportOption]) -> str:
    """Return what the data set is, in a few sentences."""
    there = {plan.condition for plan in study.plans}
    conditions = ", ".join(condition.name for condition in in_design_order(there)) or "unknown"
    return (
        "Sessions of a study in which people play Concentration, the memory game, and a robot or an avatar helps: when "
        "it helps is chosen by a learnt table, where it points and what it says by the condition. Conditions: "
        f"{conditions}. Every event of every session, the flips, hints, decisions and answers that follow from them, "
        f"and the measures. Recorded and exported by Recollect {__version__}." + _warning(extras)
    )


def _warning(extras: frozenset[ExportOption]) -> str:
    held = [what for extra, what in _NOT_FOR_PUBLISHING.items() if extra in extras]
    return f" NOT FOR PUBLISHING: it holds {' and '.join(held)}." if held else ""


def dataset_readme(
    study: StudyMaterials, shapes: Iterable[TableShape], file_of: Mapping[str, str], extras: frozenset[ExportOption]
) -> str:
    """Return the page that a reader opens first."""
    tables = [f"| [{shape.name}]({file_of[shape.name]}) | {shape.about} |" for shape in shapes]
    return "\n".join(
        [
            f"# {as_written(study.title)}",
            "",
            dataset_abstract(study, extras),
            "",
            "## What is here",
            "",
            "| table | what a row is |",
            "|---|---|",
            *tables,
            "",
            _HOW_TO_READ,
            "",
            MARKED,
            "",
            "## What is not here, and why",
            "",
            *_missing(study, extras),
            "",
            _BEFORE_PUBLISHING,
            "",
        ]
    )


def bids_readme(study: StudyMaterials, extras: frozenset[ExportOption]) -> str:
    """Return the same for names like those of BIDS."""
    opening = [f"# {as_written(study.title)}", "", dataset_abstract(study, extras), "", _HOW_TO_READ_BIDS, "", MARKED]
    return "\n".join(
        [*opening, "", "## What is not here, and why", "", *_missing(study, extras), "", _BEFORE_PUBLISHING, ""]
    )


def _missing(study: StudyMaterials, extras: frozenset[ExportOption]) -> list[str]:
    left_out = (text for extra, text in _LEFT_OUT.items() if extra not in extras)
    return [f"- {text}" for text in (*_NOT_HERE, *left_out, *([_SHUFFLED] if study.shuffled else []))]


_SHUFFLED = (
    "The order in which people came: the names of participants are shuffled with a secret that stays in the data "
    "folder, the rows go by these names, and the slots and blocks of the allocation list are left out. What sessions "
    "followed (versions of the program and of questionnaires, settings) still tells before or after a change."
)


_HOW_TO_READ_BIDS = """Here is behaviour alone, without recordings of the brain. `participants.tsv` has a row for
every participant; `sub-*/beh/*_beh.tsv` a row for every card that was turned up, with the decision before it and the
hint for it; `*_events.tsv` a row for every event; `phenotype/` the answers to each questionnaire. The JSON files
describe every column. `n/a` means that there is nothing to tell. Times are in milliseconds from the first event of the
session, and `onset` in seconds. The Psych-DS form of this data set holds more: the cards as they lay, every sentence,
response times, and how many people came."""

_HOW_TO_READ = """Every column is described in [the codebook](documentation/codebook.md) and, for programs, in
`dataset_description.json` and beside each table. `participant_id` joins the tables; `board` and `flip` join flips,
hints and decisions. An empty cell means that there is nothing to tell. Times are in milliseconds from the first event
of the session. Rows and columns of the board count from 1, but from 0 within the JSON of the events. What the sessions
followed (questionnaires, information sheets, policies, settings) is in `materials/`, under the first characters of its
hash. `analysis/example.py` is a beginning."""

_BEFORE_PUBLISHING = """## Before it is published

Name its authors and choose a licence: both are yours to add to `dataset_description.json`. Look at age, gender and
contact with robots together with the site: in a small study they may tell who a person is."""
