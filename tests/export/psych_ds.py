"""What the Psych-DS validator demands and recommends, as far as it can be told without it: every rule of its schema.

The codes are the validator's own. It runs in node, which tests cannot count on; ``test_psych_ds`` calls it where it is.
"""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

NAME = re.compile(r"([a-z]+-[a-zA-Z0-9]+)(_[a-z]+-[a-zA-Z0-9]+)*_data\.csv")
KEYWORDS = {"study", "site", "subject", "session", "task", "condition", "trial", "stimulus", "description"}
REQUIRED = ("name", "description", "variableMeasured")
FOLDERS = ("analysis", "results", "materials", "documentation")
UNCHECKED = {*FOLDERS, "products", "sourcedata", "code", "stimuli", "log"}
"""Folders that the validator leaves alone."""

CONTEXTS = {
    f"{scheme}://{www}schema.org{end}" for scheme in ("http", "https") for www in ("", "www.") for end in ("", "/")
}
THING = {"name", "description", "additionalType", "identifier", "url", "sameAs"}
SLOTS = {
    "Dataset": THING
    | {
        "variableMeasured",
        "measurementTechnique",
        "keywords",
        "inLanguage",
        "schemaVersion",
        "encodingFormat",
        "license",
        "author",
    }
    | {"citation", "funder", "creator", "datePublished", "version"},
    "PropertyValue": THING
    | {"maxValue", "measurementTechnique", "minValue", "propertyID", "unitCode", "unitText", "value", "valueReference"},
}
"""What schema.org lets these types say, as far as a data set may need it."""

OBJECTS = {"variableMeasured": {"PropertyValue"}, "valueReference": {"PropertyValue"}}
"""Which types may stand as the values of these; all others are texts and numbers."""


def issues(root: Path) -> list[str]:
    """Everything that is not as Psych-DS wants it: code, and where."""
    return [*_files(root), *_metadata(root), *_tables(root)]


def _files(root: Path) -> Iterator[str]:
    yield from (f"MISSING_{name}" for name, there in _wanted(root).items() if not there)
    for path in sorted(root.rglob("*")):
        if path.is_file():
            yield from _file(path, path.relative_to(root))


def _wanted(root: Path) -> dict[str, bool]:
    """Return what should be there, and whether it is."""
    folders = {f"{folder.upper()}_DIRECTORY": (root / folder).is_dir() for folder in ("data", *FOLDERS)}
    texts = {
        f"{stem}_DOC": any((root / f"{stem}{end}").is_file() for end in (".md", ".txt"))
        for stem in ("README", "CHANGES")
    }
    return folders | {
        **texts,
        "PSYCHDSIGNORE": (root / ".psychdsignore").is_file(),
        "DATASET_DESCRIPTION": (root / "dataset_description.json").is_file(),
        "DIRECTORY_METADATA": any(root.glob("data/**/file_metadata.json")),
        "SIDECAR_METADATA": any(root.glob("data/**/*_data.json")),
        "DATAFILE": any(NAME.fullmatch(path.name) for path in root.glob("data/**/*.csv")),
    }


def _file(path: Path, place: Path) -> Iterator[str]:
    if place.parts[0] in UNCHECKED:
        return
    if path.stat().st_size == 0:
        yield f"FILE_EMPTY {place}"
    if place.name == "dataset_description.json" and len(place.parts) > 1:
        yield f"WRONG_METADATA_LOCATION {place}"
    in_data = place.parts[0] == "data"
    if in_data and place.name.endswith("_data.csv"):
        if not NAME.fullmatch(place.name):
            yield f"FILENAME_KEYWORD_FORMATTING_ERROR {place}"
        elif {part.split("-")[0] for part in place.name.split("_")[:-1]} - KEYWORDS:
            yield f"FILENAME_UNOFFICIAL_KEYWORD_WARNING {place}"
    elif not _is_known(place, in_data=in_data):
        yield f"FILE_NOT_CHECKED {place}"


def _is_known(place: Path, *, in_data: bool) -> bool:
    if in_data:
        return place.name == "file_metadata.json" or place.name.endswith("_data.json")
    known = {"dataset_description.json", ".psychdsignore"}
    return place.name in known or place.stem in {"README", "CHANGES"}


def _metadata(root: Path) -> Iterator[str]:
    for path in (root / "dataset_description.json", *sorted((root / "data").glob("**/*.json"))):
        place = path.relative_to(root)
        try:
            content = json.loads(path.read_text("utf-8"))
        except FileNotFoundError:
            continue
        except UnicodeDecodeError:
            yield f"JSON_ENCODING_ERROR {place}"
            continue
        except ValueError:
            yield f"INVALID_JSON_FORMATTING {place}"
            continue
        if content.get("@context") not in CONTEXTS:
            yield f"INVALID_JSONLD_FORMATTING {place}"
        if "@type" not in content:
            yield f"MISSING_DATASET_TYPE {place}"
        elif content["@type"] != "Dataset":
            yield f"INCORRECT_DATASET_TYPE {place}"
        yield from (f"{issue} {place}" for issue in _node(content, "Dataset"))


def _node(node: dict[str, Any], kind: str) -> Iterator[str]:
    for key, value in node.items():
        if key.startswith("@"):
            continue
        if ":" in key:
            yield f"UNKNOWN_NAMESPACE {key}"
        elif key not in SLOTS[kind]:
            yield f"INVALID_SCHEMAORG_PROPERTY {kind}.{key}"
        for each in value if isinstance(value, list) else [value]:
            if isinstance(each, dict):
                yield from _object(each, key)


def _object(node: dict[str, Any], key: str) -> Iterator[str]:
    kind = node.get("@type")
    if kind is None:
        yield f"OBJECT_TYPE_MISSING {key}"
    elif kind not in OBJECTS.get(key, set()):
        yield f"INVALID_OBJECT_TYPE {key}"
    else:
        yield from _node(node, kind)


def _tables(root: Path) -> Iterator[str]:
    for path in sorted(root.glob("data/**/*_data.csv")):
        place = path.relative_to(root)
        try:
            rows = list(csv.reader(io.StringIO(path.read_bytes().decode("utf-8"), newline=""), strict=True))
        except UnicodeDecodeError:
            yield f"FILE_NOT_READ {place}"
            continue
        except csv.Error:
            yield f"CSV_FORMATTING_ERROR {place}"
            continue
        yield from (f"{issue} {place}" for issue in _table(rows, _compiled(root, path)))


def _compiled(root: Path, path: Path) -> dict[str, Any]:
    """Return the metadata of a table: what stands beside it goes before what stands above it."""
    found: dict[str, Any] = {}
    for file in (root / "dataset_description.json", path.with_name("file_metadata.json"), path.with_suffix(".json")):
        try:
            found |= json.loads(file.read_text("utf-8"))
        except (OSError, ValueError):
            continue
    return found


def _table(rows: list[list[str]], metadata: dict[str, Any]) -> Iterator[str]:
    missing = [key for key in REQUIRED if not metadata.get(key)]
    if missing:
        yield f"JSON_KEY_REQUIRED {missing}"
    if not rows or not rows[0]:
        yield "CSV_HEADER_MISSING"
        return
    head, *body = rows
    if len(set(head)) < len(head):
        yield "CSV_HEADER_REPEATED"
    if any(len(row) != len(head) for row in body):
        yield "CSV_HEADER_LENGTH_MISMATCH"
    if "row_id" in head and len({row[head.index("row_id")] for row in body}) < len(body):
        yield "ROWID_VALUES_NOT_UNIQUE"
    declared = {each if isinstance(each, str) else each.get("name") for each in metadata.get("variableMeasured", ())}
    if set(head) - declared:
        yield f"CSV_COLUMN_MISSING_FROM_METADATA {sorted(set(head) - declared)}"
