"""A data folder, and a sitting to write into it."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk.store.recorder import Provenance
from tests.samples import mixed, plan
from tests.study.driver import Driver, with_memory


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Where the data go; it does not exist yet."""
    return tmp_path / "data"


@pytest.fixture
def provenance() -> Provenance:
    """What a sitting follows."""
    return Provenance(plan=plan(policy=mixed(4)), seed=4, body="avatar", code_commit="abc123", simulated=True)


@pytest.fixture
def played(provenance: Provenance) -> Driver:
    """A whole sitting that follows it."""
    driver = Driver(provenance.plan, provenance.seed)
    driver.whole_sitting(with_memory(4))
    return driver
