"""What was typed before a question came is no answer to it."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import StringIO
from pathlib import Path

import click
import pytest

import kiosk
from kiosk.cli.main import recollect
from kiosk.cli.terminal import confirm
from kiosk.experiment.events import SessionStarted
from kiosk.experiment.outcomes import SessionKind
from kiosk.store.recorder import Provenance, Recorder
from tests.samples import plan
from tests.store.visitors import rows

QUESTION = "Delete them?"
on_unix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals of this kind")


class Keyboard(StringIO):
    """Types an answer when it sees the question."""

    def __init__(self, keys: int, answer: bytes) -> None:
        super().__init__()
        self._keys, self._answer = keys, answer

    def write(self, text: str) -> int:
        if QUESTION in text:
            os.write(self._keys, self._answer)
        return super().write(text)


@contextmanager
def terminal(monkeypatch: pytest.MonkeyPatch, before: bytes, answer: bytes) -> Iterator[None]:
    """Have a terminal where one thing was typed before the question, and another one is typed after it."""
    keys, program = os.openpty()
    try:
        os.write(keys, before)
        with os.fdopen(program, encoding="utf-8") as stdin:
            monkeypatch.setattr(sys, "stdin", stdin)
            monkeypatch.setattr(sys, "stderr", Keyboard(keys, answer))
            yield
    finally:
        os.close(keys)


@on_unix
@pytest.mark.parametrize(("before", "after", "said"), [(b"y\n", b"n\n", False), (b"n\ny\n", b"y\n", True)])
def test_an_answer_typed_before_the_question_is_not_taken(
    before: bytes, after: bytes, monkeypatch: pytest.MonkeyPatch, *, said: bool
) -> None:
    with terminal(monkeypatch, before, after):
        assert confirm(QUESTION) is said


@on_unix
def test_a_yes_typed_before_the_question_deletes_nobody(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with Recorder(tmp_path) as recorder:
        recorder.begin(Provenance(plan(), 1, "avatar", "abc123", kind=SessionKind.STUDY), [SessionStarted(at_ms=0)])
    before = rows(tmp_path, "SELECT * FROM event")
    with terminal(monkeypatch, b"y\n", b"n\n"), pytest.raises(click.Abort):
        recollect.main(["withdraw", "--session", "1", "--data", str(tmp_path)], standalone_mode=False)
    assert rows(tmp_path, "SELECT * FROM event") == before


def test_answers_from_a_pipe_are_all_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", StringIO("y\nn\n"))
    assert [confirm(QUESTION), confirm(QUESTION)] == [True, False]


def test_yes_or_no_is_asked_in_no_other_way() -> None:
    asks: Callable[[str], object] = re.compile(r"click\.(confirm|getchar|pause)\(|confirmation_option").search
    asking = [file.name for file in Path(kiosk.__file__).parent.rglob("*.py") if asks(file.read_text(encoding="utf-8"))]
    assert asking == ["terminal.py"]
