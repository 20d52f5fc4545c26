"""Two hundred simulated participants and their data set, made once for all tests of this folder."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

import pytest

from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import Bids, PsychDs
from tests.export.visitors import store, visitors
from tests.store.conftest import folder, played, provenance, writer

__all__ = ["folder", "played", "provenance", "writer"]

MANY = 200
FEW = 12

Read = Callable[[str], list[dict[str, str]]]


def rows_of(folder: Path, table: str) -> list[dict[str, str]]:
    """The rows of a table, read as anybody would."""
    path = folder / "data" / f"task-concentration_description-{table}_data.csv"
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="session")
def many(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The data folder of many participants."""
    folder = tmp_path_factory.mktemp("many") / "data"
    store(folder, visitors(MANY))
    return folder


@pytest.fixture(scope="session")
def exported(many: Path) -> Path:
    """Their data set; it is only to be read."""
    out = many.parent / "data-set"
    export_dataset(many, out, PsychDs)
    return out


@pytest.fixture(scope="session")
def read(exported: Path) -> Read:
    """The rows of a table of it, by its name."""
    return lambda table: rows_of(exported, table)


@pytest.fixture(scope="session")
def few(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The data folder of a few participants."""
    folder = tmp_path_factory.mktemp("few") / "data"
    store(folder, visitors(FEW))
    return folder


@pytest.fixture(scope="session")
def small(few: Path) -> Path:
    """Their data set; it is only to be read."""
    out = few.parent / "data-set"
    export_dataset(few, out, PsychDs)
    return out


@pytest.fixture(scope="session")
def bids(few: Path) -> Path:
    """Their data set with names like those of BIDS; it is only to be read."""
    out = few.parent / "bids"
    export_dataset(few, out, Bids)
    return out
