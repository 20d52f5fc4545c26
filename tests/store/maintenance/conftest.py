"""A day at a booth that is stored, and copies of it to damage."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from kiosk.experiment.outcomes import SessionKind
from kiosk.store.recorder import Provenance
from kiosk.store.withdrawal import withdraw
from tests.samples import mixed, plan
from tests.store.visitors import a_day


@pytest.fixture(scope="package")
def pristine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a day at a booth, after which a participant withdrew."""
    folder = tmp_path_factory.mktemp("pristine") / "data"
    session = Provenance(plan(policy=mixed(4)), 4, "avatar", "abc123", kind=SessionKind.SIMULATED)
    people = a_day(folder, session, "MI")
    withdraw(folder, people[1].code)
    return folder


@pytest.fixture
def day(pristine: Path, folder: Path) -> Path:
    """Return a copy of that day."""
    return Path(shutil.copytree(pristine, folder))
