"""A data folder, and a session to write into it."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from kiosk.experiment.outcomes import SessionKind
from kiosk.store import codes
from kiosk.store.recorder import Provenance
from tests.experiment.driver import Driver, with_memory
from tests.patience import Program, serving
from tests.samples import mixed, plan
from tests.store.visitors import CHEAP

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module", autouse=True)
def cheap_codes() -> Iterator[None]:
    """Let a code cost next to nothing: these tests give many, and none is to hold against an attack."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(codes, "_COST", CHEAP)
        yield


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Where the data go; it does not exist yet."""
    return tmp_path / "data"


@pytest.fixture
def provenance() -> Provenance:
    """Return what a session follows."""
    return Provenance(
        plan=plan(policy=mixed(4)), seed=4, embodiment="avatar", code_commit="abc123", kind=SessionKind.SIMULATED
    )


@pytest.fixture
def played(provenance: Provenance) -> Driver:
    """Return a whole session that follows it."""
    driver = Driver(provenance.plan, provenance.seed)
    driver.whole_session(with_memory(4))
    return driver


@pytest.fixture(scope="module")
def writer() -> Iterator[Program]:
    """Provide a program that has sessions written by processes that do not stop."""
    with serving(
        [sys.executable, "-m", "tests.store.writer"],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as program:
        yield program
