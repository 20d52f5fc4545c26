"""The table of reasons in the docs is the one that the program makes, and holds every reason there is."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

from kiosk.assistance.mentaliser import HintReason
from kiosk.assistance.policy import FlipInMove
from kiosk.cli.decision_cases import EXAMPLES, reason_example, reasons_table
from kiosk.cli.main import main
from tests.samples import CATALOGUES

PAGE = Path(__file__).parents[2] / "docs" / "explanation" / "mentaliser.md"


def test_the_page_shows_the_table_as_it_is_today() -> None:
    shown = re.search(
        r"<!-- made by: recollect explain --table -->\n\n(.*)\n<!-- end -->", PAGE.read_text("utf-8"), re.DOTALL
    )
    assert shown is not None
    assert shown[1] == reasons_table(), (
        "write the output of `recollect explain --table` into docs/explanation/mentaliser.md"
    )


def test_the_command_prints_it(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(sys, "argv", ["recollect", "explain", "--table"])
    with pytest.raises(SystemExit):
        main()
    assert capsys.readouterr().out == reasons_table()


def test_every_reason_has_its_example_once() -> None:
    shown = [(reason_example(moves).card, reason_example(moves).reason) for moves in EXAMPLES]
    counts = [(other, target) for other in range(4) for target in range(4)]
    reasons = {(FlipInMove.FIRST, HintReason.of(FlipInMove.FIRST, other, target)) for other, target in counts}
    reasons |= {
        (FlipInMove.SECOND, HintReason.of(FlipInMove.SECOND, other, target)) for other, target in counts if other
    }
    assert len(shown) == 12
    assert set(shown) == reasons


def test_every_language_stands_in_the_table() -> None:
    head = reasons_table().splitlines()[0].strip("| ").split(" | ")
    assert head[-len(CATALOGUES) :] == ["en", "es", "it"]
    assert all(len(line.strip("| ").split(" | ")) == len(head) for line in reasons_table().splitlines())
