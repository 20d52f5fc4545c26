"""What every test has: a home for data of its own, so that no test sees what this machine's user has stored."""

from __future__ import annotations

import os
from collections.abc import Iterator
from tempfile import TemporaryDirectory

import pytest


@pytest.fixture(scope="session", autouse=True)
def data_home() -> Iterator[None]:
    """Keep the default data folder of this process, and of those that it starts, in a temporary directory."""
    with TemporaryDirectory(prefix="recollect-tests-") as home, pytest.MonkeyPatch.context() as environment:
        environment.setenv("XDG_DATA_HOME", os.fspath(home))
        yield
