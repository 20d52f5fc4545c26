"""What the documents say is what the program does."""

from __future__ import annotations

import re
from pathlib import Path

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


def test_the_diagram_of_the_stages_is_drawn_from_the_table() -> None:
    page = (ROOT / "docs" / "how-it-works.md").read_text("utf-8")
    assert f"<!-- stages -->\n```mermaid\n{diagram()}```\n<!-- /stages -->" in page


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_link_of_a_page_leads_somewhere(page: Path) -> None:
    targets = re.findall(r"\]\(([^)#:]+)\)", page.read_text("utf-8"))
    assert [target for target in targets if not (page.parent / target).exists()] == []


def test_every_command_in_the_readme_exists() -> None:
    named = set(re.findall(r"`recollect ([a-z]+)", (ROOT / "README.md").read_text("utf-8")))
    assert named - set(recollect.commands) - set(recollect.list_commands(None)) == set()  # type: ignore[arg-type]
