"""What the set-up decides about the machine that it runs on."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from types import ModuleType

import pytest

from tests.packaging.scripts import load

ROOT = Path(__file__).parents[2]


@pytest.fixture
def bootstrap() -> ModuleType:
    """Return the file that sets everything up."""
    return load("bootstrap")


def test_files_of_tests_are_in_memory_for_one_run(
    bootstrap: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bootstrap, "MEMORY", tmp_path)
    monkeypatch.setattr(bootstrap, "has_room", lambda _: True)
    with bootstrap.files_in_memory({"HOME": "there"}) as environment:
        folder = Path(environment["PYTEST_DEBUG_TEMPROOT"])
        assert (folder.parent, folder.is_dir(), environment["HOME"]) == (tmp_path, True, "there")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("why", ["there is no such folder", "there is too little memory"])
def test_without_room_in_memory_they_are_on_the_disk(
    bootstrap: ModuleType, why: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    missing = why == "there is no such folder"
    monkeypatch.setattr(bootstrap, "MEMORY", tmp_path / "missing" if missing else tmp_path)
    monkeypatch.setattr(bootstrap, "ENOUGH", 0 if missing else 2**60)
    with bootstrap.files_in_memory({"HOME": "there"}) as environment:
        assert environment == {"HOME": "there"}


@pytest.mark.parametrize("fails", [False, True])
def test_built_pages_end_with_how_to_open_them(
    bootstrap: ModuleType, monkeypatch: pytest.MonkeyPatch, *, fails: bool
) -> None:
    said: list[str] = []
    monkeypatch.setattr(bootstrap, "development", lambda: nullcontext({}))
    monkeypatch.setattr(bootstrap, "run", lambda command, *_: int(fails and command[0] == "mkdocs"))
    monkeypatch.setattr(bootstrap, "say", said.append)
    assert bootstrap.docs([]) == int(fails)
    assert said == ([] if fails else ["The pages are built. `recollect docs` opens them."])
