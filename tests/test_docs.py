"""What the documents say is what the program does."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

from kiosk.cli.main import recollect
from kiosk.experiment.transitions import diagram

ROOT = Path(__file__).parent.parent
PAGES = [
    ROOT / "README.md",
    ROOT / "CHANGELOG.md",
    *sorted((ROOT / "docs").glob("*.md")),
    *sorted(ROOT.glob("p*/*.md")),
]


def load_reference() -> ModuleType:
    """Load packaging/reference.py, which is in no package."""
    spec = importlib.util.spec_from_file_location("reference", ROOT / "packaging" / "reference.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


REFERENCE = load_reference()


def test_the_diagram_of_the_stages_is_drawn_from_the_table() -> None:
    page = (ROOT / "docs" / "how-it-works.md").read_text("utf-8")
    assert f"<!-- stages -->\n```mermaid\n{diagram()}```\n<!-- /stages -->" in page


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_link_of_a_page_leads_somewhere(page: Path) -> None:
    targets = re.findall(r"\]\(([^)#:]+)\)", page.read_text("utf-8"))
    assert [target for target in targets if not (page.parent / target).exists()] == []


@pytest.mark.parametrize("name", REFERENCE.GENERATED)
def test_a_generated_page_is_as_the_code_gives_it(name: str) -> None:
    page = (ROOT / "docs" / name).read_text("utf-8")
    assert page == REFERENCE.GENERATED[name](), "run `python packaging/reference.py` and commit what it writes"


def test_every_command_in_the_readme_exists() -> None:
    named = set(re.findall(r"`recollect ([a-z]+)", (ROOT / "README.md").read_text("utf-8")))
    assert named - set(recollect.commands) - set(recollect.list_commands(None)) == set()  # type: ignore[arg-type]
