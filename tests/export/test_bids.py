"""A data set with names like those of BIDS, for behaviour without recordings of the brain."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from kiosk.experiment.outcomes import SessionKind
from kiosk.export.bids import Bids
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from tests.export.conftest import PARTICIPANTS, rows_of
from tests.export.visitors import store, visitor
from tests.patience import PATIENCE_S

NAMES = re.compile(
    r"README\.md|CHANGES|dataset_description\.json|participants\.(tsv|json)|task-concentration_(beh|events)\.json"
    r"|phenotype/[a-z_]+\.(tsv|json)|(?P<label>sub-[A-Za-z0-9]+)/beh/(?P=label)_task-concentration_(beh|events)\.tsv"
)


def table(path: Path) -> list[dict[str, str]]:
    head, *rows = (line.split("\t") for line in path.read_text("utf-8").splitlines())
    assert {len(row) for row in rows} <= {len(head)}
    return [dict(zip(head, row, strict=True)) for row in rows]


def columns_told(path: Path) -> set[str]:
    """Return the columns that a JSON file describes."""
    content = json.loads(path.read_text("utf-8"))
    return {name for name, told in content.items() if isinstance(told, dict) and "Description" in told}


def test_every_file_has_a_name_that_bids_knows(bids: Path) -> None:
    names = [path.relative_to(bids).as_posix() for path in bids.rglob("*") if path.is_file()]
    assert [name for name in names if not NAMES.fullmatch(name)] == []
    assert len(list(bids.glob("sub-*"))) == PARTICIPANTS


def test_every_column_of_every_table_is_described_beside_it(bids: Path) -> None:
    beside = {
        "participants.tsv": "participants.json",
        "sub-P0001/beh/sub-P0001_task-concentration_beh.tsv": "task-concentration_beh.json",
        "sub-P0001/beh/sub-P0001_task-concentration_events.tsv": "task-concentration_events.json",
        "phenotype/about_you.tsv": "phenotype/about_you.json",
        "phenotype/social_intelligence.tsv": "phenotype/social_intelligence.json",
    }
    for data, told in beside.items():
        described = columns_told(bids / told) - {"MeasurementToolMetadata"}
        assert set(table(bids / data)[0]) == described


def test_a_level_is_told_only_where_a_cell_is_one_level(bids: Path) -> None:
    people = json.loads((bids / "participants.json").read_text("utf-8"))
    assert set(people["robots"]["Levels"]) == {"none", "stories", "owns"}
    assert "Levels" not in people["languages"]
    assert "en, it, es" in people["languages"]["Description"]


def test_participants_are_those_of_the_other_form_by_another_name(bids: Path, exported: Path) -> None:
    people, others = table(bids / "participants.tsv"), rows_of(exported, "participants")
    assert [person["participant_id"] for person in people] == [f"sub-{other['participant_id']}" for other in others]
    for person, other in zip(people, others, strict=True):
        same = {name: cell or "n/a" for name, cell in other.items() if name != "participant_id"}
        assert {name: person[name] for name in same} == same


def test_a_row_of_behaviour_is_a_flip_with_its_decision_and_its_hint(bids: Path, exported: Path) -> None:
    hints = [row for row in rows_of(exported, "hints") if row["participant_id"] == "P0002"]
    flips = table(bids / "sub-P0002" / "beh" / "sub-P0002_task-concentration_beh.tsv")
    hinted = [flip for flip in flips if flip["hinted"] == "true"]
    assert [flip["sentence"] for flip in hinted] == [hint["sentence"] for hint in hints if hint["followed"]]
    assert {flip["gate"] for flip in hinted} == {"open"}
    decided = {row["flip"]: row for row in rows_of(exported, "decisions") if row["participant_id"] == "P0002"}
    game = [flip for flip in flips if flip["stage"] == "game"]
    assert [flip["phase"] for flip in game] == [decided[flip["flip"]]["phase"] for flip in game]
    assert all(flip["phase"] == "n/a" for flip in flips if flip["stage"] == "practice")


def test_events_come_with_an_onset_in_seconds(bids: Path, exported: Path) -> None:
    events = table(bids / "sub-P0001" / "beh" / "sub-P0001_task-concentration_events.tsv")
    others = [row for row in rows_of(exported, "events") if row["participant_id"] == "P0001"]
    assert list(events[0])[:2] == ["onset", "duration"]
    assert [round(1000 * float(event["onset"])) for event in events] == [int(other["at_ms"]) for other in others]
    assert [json.loads(event["fields"]) for event in events] == [json.loads(other["fields"]) for other in others]


def test_a_questionnaire_has_a_row_for_each_participant_and_a_column_for_each_item(bids: Path, exported: Path) -> None:
    answers = {
        (row["participant_id"], row["item"]): row["value"] or "n/a"
        for row in rows_of(exported, "answers")
        if row["questionnaire"] == "social-intelligence"
    }
    told = table(bids / "phenotype" / "social_intelligence.tsv")
    assert len(told) == PARTICIPANTS
    for row in told:
        of = row.pop("participant_id").removeprefix("sub-")
        assert row == {item: value for (whose, item), value in answers.items() if whose == of}


def test_a_site_and_a_rehearsal_do_not_make_two_participants_alike(tmp_path: Path) -> None:
    for site, kind in (("A", SessionKind.STUDY), ("A", SessionKind.SIMULATED)):
        store(tmp_path / "data", [(visitor(1), 1)], site=site, kind=kind)
    export_dataset(tmp_path / "data", tmp_path / "out", Bids, frozenset({ExportOption.REHEARSALS}))
    assert sorted(path.name for path in (tmp_path / "out").glob("sub-*")) == ["sub-AnP0001", "sub-Anr0001"]


def test_the_validator_itself_finds_no_error(bids: Path) -> None:
    validator = shutil.which("bids-validator-deno")
    if validator is None:
        pytest.skip("the BIDS validator (bids-validator-deno) is not installed")
    run = subprocess.run(
        [validator, str(bids), "--format", "json"], capture_output=True, text=True, check=False, timeout=PATIENCE_S
    )
    found = json.loads(run.stdout)["issues"]["issues"]
    assert [issue for issue in found if issue["severity"] == "error"] == []
