"""Pictures are drawn in a process of their own: one that cannot be drawn is reported, and the rest are tried."""

from __future__ import annotations

import sys
from pathlib import Path
from time import monotonic

import pytest

from kiosk import program
from kiosk.config import ASSETS
from kiosk.ui import checks
from kiosk.ui.checks import CannotDraw, undrawn

OWL = (ASSETS / "cards" / "animals" / "owl.svg").read_text("utf-8")
SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 240 240">{}</svg>'
)
ENDLESS = SVG.format(
    "<defs><rect id='a0' width='9' height='9'/>"
    + "".join(f"<g id='a{n}'>{f'<use xlink:href={chr(34)}#a{n - 1}{chr(34)}/>' * 10}</g>" for n in range(1, 12))
    + "</defs><use xlink:href='#a11'/>"
)
"""A hundred thousand million squares."""

STUCK_S = 60


def test_every_picture_is_tried_and_those_that_cannot_be_drawn_are_told(tmp_path: Path) -> None:
    pictures = {"a": OWL, "b": "no picture", "c": ENDLESS, "d": SVG.format(""), "e": "", "f": OWL}
    for name, content in pictures.items():
        (tmp_path / f"{name}.svg").write_text(content, "utf-8")
    files = [*(tmp_path / f"{name}.svg" for name in pictures), tmp_path / "none.svg"]
    said = list(undrawn(program("_display", "pictures"), files, within_s=2))
    told = {file.stem: [each for each in said if f"{file} cannot be drawn: " in each] for file in files}
    assert {name for name, sentences in told.items() if sentences} == {"b", "c", "d", "e", "none"}
    assert all(len(sentences) <= 1 for sentences in told.values())
    assert told["c"][0].endswith("it is not done within 2 s")
    assert told["d"][0].endswith("it shows nothing")


def test_the_shipped_pictures_can_be_drawn() -> None:
    files = [*sorted((ASSETS / "cards").rglob("*.svg")), *sorted((ASSETS / "scales").rglob("*.svg"))]
    assert list(undrawn(program("_display", "pictures"), files)) == []


def test_a_picture_that_ends_the_process_is_told_and_the_next_one_is_tried(tmp_path: Path) -> None:
    code = (
        "import json, os, sys\n"
        "print('ready', flush=True)\n"
        "for file in json.load(sys.stdin):\n"
        "    os._exit(1) if 'bad' in file else print('', flush=True)\n"
    )
    files = [tmp_path / name for name in ("a.svg", "bad.svg", "c.svg", "bad2.svg")]
    said = list(undrawn((sys.executable, "-c", code), files))
    assert said == [f"the picture {file} cannot be drawn: it ends the program" for file in (files[1], files[3])]


def test_a_machine_that_cannot_draw_is_not_the_pictures_fault(tmp_path: Path) -> None:
    code = "import sys; sys.exit('libGL.so.1 is missing')"
    with pytest.raises(CannotDraw, match=r"libGL\.so\.1 is missing"):
        list(undrawn((sys.executable, "-c", code), [tmp_path / "a.svg"]))


def test_a_process_that_reads_nothing_is_not_waited_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checks, "READY_S", 0.5)
    # More than a pipe takes.
    files = [tmp_path / f"{number:0>200}.svg" for number in range(1_000)]
    began = monotonic()
    with pytest.raises(CannotDraw, match="does not answer"):
        list(undrawn((sys.executable, "-c", f"import time; time.sleep({STUCK_S})"), files))
    assert monotonic() - began < STUCK_S
