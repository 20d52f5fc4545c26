"""Simulated participants and their data set, made once for all tests of this folder."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

import pytest

from kiosk.export.bids import Bids
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from tests.export.visitors import store, visitors
from tests.store.conftest import folder, played, provenance, writer

__all__ = ["folder", "played", "provenance", "writer"]

PARTICIPANTS = 24

Read = Callable[[str], list[dict[str, str]]]


def rows_of(folder: Path, table: str) -> list[dict[str, str]]:
    """Return the rows of a table, read without the codebook."""
    path = folder / "data" / f"task-concentration_description-{table}_data.csv"
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="session")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the data folder of all of them."""
    folder = tmp_path_factory.mktemp("stored") / "data"
    store(folder, visitors(PARTICIPANTS))
    return folder


@pytest.fixture(scope="session")
def exported(stored: Path) -> Path:
    """Their data set; it is only to be read."""
    out = stored.parent / "data-set"
    export_dataset(stored, out, PsychDs)
    return out


@pytest.fixture(scope="session")
def read(exported: Path) -> Read:
    """Return the rows of a table of it, by its name."""
    return lambda table: rows_of(exported, table)


@pytest.fixture(scope="session")
def bids(stored: Path) -> Path:
    """Their data set with names like those of BIDS; it is only to be read."""
    out = stored.parent / "bids"
    export_dataset(stored, out, Bids)
    return out
