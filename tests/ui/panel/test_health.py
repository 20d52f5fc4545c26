"""Health in words: every thing that can fail has a line, and one line tells which of them does."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from kiosk.robot.body import Health
from kiosk.settings import Settings
from kiosk.store.care.disk import Room
from kiosk.study.declared.checked.whole import read_study
from kiosk.ui.panel.health import Clocks, Line, State, lines, summary
from kiosk.ui.panel.upkeep import Copied
from tests.samples import CATALOGUES

STUDY = read_study(Settings())
NOW = 1_800_000_000_000
MINUTE, HOUR = 60_000, 3_600_000
WELL = State(
    robot=None,
    voice=Health(well=True, words="the voice speaks"),
    quiet=False,
    room=Room(4000),
    copied=Copied(NOW - 12 * MINUTE, Path("recollect-1.db")),
    trouble="",
    clocks=Clocks(NOW, NOW - HOUR, HOUR, NOW - 2 * HOUR),
    has_pin=True,
    screen="1920 x 1080",
    screen_well=True,
)


def told(state: State) -> dict[str, Line]:
    """Every line by its name."""
    return {line.name: line for line in lines(state, STUDY, CATALOGUES["en"])}


@pytest.mark.parametrize("language", CATALOGUES)
def test_all_is_well_in_one_line_of_every_language(language: str) -> None:
    found = lines(WELL, STUDY, CATALOGUES[language])
    assert len(found) == 9
    assert summary(found, CATALOGUES[language]) == Line("", CATALOGUES[language].text("desk-all-well"))


@pytest.mark.parametrize(
    ("state", "name", "words"),
    [
        (replace(WELL, robot=Health(well=False, words="it is gone")), "Robot", "it is gone"),
        (replace(WELL, voice=Health(well=False, words="no voice")), "Voice", "no voice"),
        (replace(WELL, quiet=True), "Voice", "silent on purpose"),
        (replace(WELL, room=Room(300)), "Disk", "only 300 MiB free: make room this evening"),
        (replace(WELL, room=Room(3)), "Disk", "only 3 MiB free: nobody can begin"),
        (replace(WELL, room=None), "Disk", "nobody can tell how much is free"),
        (replace(WELL, copied=Copied(NOW, None, "no room")), "Database", "the last copy failed: no room"),
        (replace(WELL, trouble="it could not be written"), "Database", "it could not be written"),
        (
            replace(WELL, clocks=Clocks(NOW, NOW, 0, NOW + 2 * HOUR)),
            "Clock",
            "2 h behind what was written last: set it",
        ),
        (
            replace(WELL, clocks=Clocks(NOW, NOW - HOUR, HOUR + 300_000, 0)),
            "Clock",
            "was set by -300 s since the start",
        ),
        (
            replace(WELL, has_pin=False),
            "PIN",
            "none is set: every sitting is a trial, and anybody who knows the keys can do everything",
        ),
        (replace(WELL, screen="the desktop gets some keys", screen_well=False), "Screen", "the desktop gets some keys"),
    ],
)
def test_what_is_not_well_is_told_and_named_in_the_one_line(state: State, name: str, words: str) -> None:
    assert told(state)[name] == Line(name, words, well=False)
    assert summary(lines(state, STUDY, CATALOGUES["en"]), CATALOGUES["en"]) == Line("", f"{name}: {words}", well=False)


@pytest.mark.parametrize(
    ("minutes", "words"),
    [(0, "just now"), (59, "59 min ago"), (60, "1 h ago"), (23 * 60, "23 h ago"), (24 * 60, "1 day ago")],
)
def test_the_last_copy_is_told_in_the_size_that_matters(minutes: int, words: str) -> None:
    copied = Copied(NOW - minutes * MINUTE, Path("recollect-1.db"))
    assert told(replace(WELL, copied=copied))["Database"].words == f"written to; last copy {words}"


def test_without_a_copy_yet_nothing_is_wrong() -> None:
    assert told(replace(WELL, copied=None))["Database"].well
