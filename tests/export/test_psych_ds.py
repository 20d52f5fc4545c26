"""The data set is as Psych-DS wants it, without an error or a warning; and what is not so would be seen."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from kiosk.experiment.condition import CONDITIONS
from tests.export.psych_ds import issues
from tests.patience import PATIENCE_S

TABLE = "data/task-concentration_description-flips_data.csv"
VALIDATOR = Path(__file__).parents[2] / "build" / "node_modules" / "psychds-validator" / "cli.js"
"""Where ``npm install --prefix build psychds-validator`` puts it."""


def test_nothing_is_missing_wrong_or_recommended_otherwise(exported: Path) -> None:
    assert issues(exported) == []


def test_the_description_lists_every_column_of_every_table_once(exported: Path) -> None:
    described = json.loads((exported / "dataset_description.json").read_text("utf-8"))
    names = [variable["name"] for variable in described["variableMeasured"]]
    heads = [path.read_text("utf-8").splitlines()[0].split(",") for path in exported.glob("data/*.csv")]
    assert len(heads) == 11
    assert sorted(set(names)) == sorted(names)
    assert set(names) == {name for head in heads for name in head}


def test_the_validator_itself_finds_nothing(exported: Path) -> None:
    node = shutil.which("node")
    if node is None or not VALIDATOR.is_file():
        pytest.skip("the Psych-DS validator is not installed in build/node_modules, or there is no node")
    command = [node, str(VALIDATOR), "--json", "--showWarnings", str(exported)]
    told = json.loads(subprocess.run(command, capture_output=True, text=True, check=True, timeout=PATIENCE_S).stdout)
    assert told["valid"] is True, told["issues"]
    assert [issue["key"] for issue in told["issues"] if issue["severity"] != "ignore"] == []


def gone(place: str) -> Callable[[Path], None]:
    def take_away(root: Path) -> None:
        path = root / place
        shutil.rmtree(path) if path.is_dir() else path.unlink()

    return take_away


def changed(place: str, change: Callable[[str], str]) -> Callable[[Path], None]:
    def write(root: Path) -> None:
        path = root / place
        path.write_bytes(change(path.read_bytes().decode("utf-8")).encode("utf-8"))

    return write


def described(**keys: object) -> Callable[[Path], None]:
    """Return the description with other keys; None takes one away. The sidecars of the tables say the same."""

    def write(root: Path) -> None:
        for path in (root / "dataset_description.json", *root.glob("data/*_data.json")):
            content = {key.replace("at_", "@"): value for key, value in keys.items()}
            told = json.loads(path.read_text("utf-8")) | content
            path.write_text(json.dumps({key: value for key, value in told.items() if value is not None}), "utf-8")

    return write


def moved(place: str, to: str) -> Callable[[Path], None]:
    def move(root: Path) -> None:
        (root / place).rename(root / to)

    return move


FAULTS = {
    "MISSING_DATASET_DESCRIPTION": gone("dataset_description.json"),
    "MISSING_DATA_DIRECTORY": gone("data"),
    "MISSING_DATAFILE": gone("data"),
    "MISSING_README_DOC": gone("README.md"),
    "MISSING_CHANGES_DOC": gone("CHANGES.md"),
    "MISSING_PSYCHDSIGNORE": gone(".psychdsignore"),
    "MISSING_RESULTS_DIRECTORY": gone("results"),
    "MISSING_DIRECTORY_METADATA": gone("data/file_metadata.json"),
    "FILENAME_KEYWORD_FORMATTING_ERROR": moved(TABLE, "data/flips_of_all_data.csv"),
    "FILENAME_UNOFFICIAL_KEYWORD_WARNING": moved(TABLE, "data/table-flips_data.csv"),
    "FILE_NOT_CHECKED": moved(TABLE, "data/flips.csv"),
    "FILE_EMPTY": changed(TABLE, lambda _: ""),
    "CSV_HEADER_MISSING": changed(TABLE, lambda _: ""),
    "CSV_HEADER_LENGTH_MISMATCH": changed(TABLE, lambda text: text + "1,2\r\n"),
    "CSV_FORMATTING_ERROR": changed(TABLE, lambda text: text + '"a"b,c\r\n'),
    "CSV_COLUMN_MISSING_FROM_METADATA": changed(TABLE, lambda text: text.replace("matched", "paired", 1)),
    "INVALID_JSON_FORMATTING": changed("dataset_description.json", lambda text: text[:-3]),
    "INVALID_JSONLD_FORMATTING": described(at_context=None),
    "MISSING_DATASET_TYPE": described(at_type=None),
    "INCORRECT_DATASET_TYPE": described(at_type="Event"),
    "JSON_KEY_REQUIRED": described(description=None),
    "INVALID_SCHEMAORG_PROPERTY": described(colour="red"),
    "OBJECT_TYPE_MISSING": described(variableMeasured=[{"name": "flip"}]),
    "INVALID_OBJECT_TYPE": described(variableMeasured=[{"@type": "Person", "name": "flip"}]),
    "UNKNOWN_NAMESPACE": described(**{"own:colour": "red"}),
}


@pytest.mark.parametrize("code", FAULTS)
def test_each_fault_would_be_seen(code: str, exported: Path, tmp_path: Path) -> None:
    root = tmp_path / "data-set"
    shutil.copytree(exported, root)
    FAULTS[code](root)
    assert code in {issue.split()[0] for issue in issues(root)}


def test_the_example_of_the_data_set_runs(exported: Path) -> None:
    command = [sys.executable, str(exported / "analysis" / "example.py")]
    lines = subprocess.run(command, capture_output=True, text=True, check=True, timeout=PATIENCE_S).stdout.splitlines()
    assert [line.split()[0] for line in lines] == sorted(condition.name for condition in CONDITIONS)


def test_the_example_of_the_page_runs_and_says_the_same(exported: Path, tmp_path: Path) -> None:
    page = (Path(__file__).parents[2] / "docs" / "reference" / "data-set.md").read_text("utf-8")
    example = page.split("<!-- example -->\n```python\n")[1].split("```\n<!-- /example -->")[0]
    assert len(example.replace("\n\n", "\n").splitlines()) <= 11
    (tmp_path / "my-study").symlink_to(exported)
    outputs = [
        subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True, timeout=PATIENCE_S).stdout
        for command in ([sys.executable, "-c", example], [sys.executable, str(exported / "analysis" / "example.py")])
    ]
    assert outputs[0] == outputs[1] != ""


def test_the_page_names_every_table_that_there_is(exported: Path) -> None:
    page = (Path(__file__).parents[2] / "docs" / "reference" / "data-set.md").read_text("utf-8")
    tables = {path.name.split("description-")[1].removesuffix("_data.csv") for path in exported.glob("data/*.csv")}
    listed = page.split("## What is in it")[1].split("## ")[0]
    assert {line.split("`")[1] for line in listed.splitlines() if line.startswith("| `")} == tables
