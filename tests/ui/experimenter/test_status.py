"""Health in words: every thing that can fail has a line, and one line tells which of them does."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from kiosk.config import Settings
from kiosk.experiment.experimenter import DEVIATIONS, AuditEvent
from kiosk.robots.embodiment import Health
from kiosk.store.maintenance import FreeSpace
from kiosk.study.loader import read_study
from kiosk.ui.experimenter.maintenance import BackupOutcome
from kiosk.ui.experimenter.status import (
    Clocks,
    HealthInputs,
    HealthLine,
    health_lines,
    health_summary,
    is_pack_changed,
)
from tests.samples import CATALOGUES

STUDY = read_study(Settings())
CHANGED = 'another voice pack than in earlier sessions; "recollect verify" names them'
NOW = 1_800_000_000_000
MINUTE, HOUR = 60_000, 3_600_000
WELL = HealthInputs(
    robot=None,
    voice=Health(is_ok=True, message="the voice speaks"),
    muted=False,
    free_space=FreeSpace(4000),
    last_backup=BackupOutcome(NOW - 12 * MINUTE, Path("recollect-1.db")),
    audit_error="",
    clocks=Clocks(NOW, NOW - HOUR, HOUR, NOW - 2 * HOUR),
    has_pin=True,
    screen="1920 x 1080",
    screen_well=True,
)


def told(state: HealthInputs) -> dict[str, HealthLine]:
    """Every line by its name."""
    return {line.name: line for line in health_lines(state, STUDY, CATALOGUES["en"])}


@pytest.mark.parametrize("language", CATALOGUES)
def test_all_is_well_in_one_line_of_every_language(language: str) -> None:
    found = health_lines(WELL, STUDY, CATALOGUES[language])
    assert len(found) == 9
    assert health_summary(found, CATALOGUES[language]) == HealthLine("", CATALOGUES[language].text("console-all-well"))


def test_a_pack_is_changed_if_another_one_spoke_the_same_language() -> None:
    earlier = {("en", "a"), ("it", "b")}
    assert not is_pack_changed(("en", "a"), earlier)
    assert not is_pack_changed(("es", "c"), earlier)
    assert not is_pack_changed(("en", ""), earlier)
    assert is_pack_changed(("en", "b"), earlier)
    assert is_pack_changed(("en", "a"), {*earlier, ("en", "b")})


@pytest.mark.parametrize("language", CATALOGUES)
@pytest.mark.parametrize("noted", [each for each in AuditEvent if each in DEVIATIONS])
def test_every_deviation_has_a_line_in_every_language(noted: AuditEvent, language: str) -> None:
    name = noted.name.lower().replace("_", "-")
    assert "game" in CATALOGUES[language].text(f"console-note-{name}", what="game")


@pytest.mark.parametrize(
    ("state", "name", "words"),
    [
        (replace(WELL, robot=Health(is_ok=False, message="it is gone")), "Robot", "it is gone"),
        (replace(WELL, voice=Health(is_ok=False, message="no voice")), "Voice", "no voice"),
        (replace(WELL, muted=True), "Voice", "silent on purpose"),
        (
            replace(WELL, pack_changed=True),
            "Voice",
            'another voice pack than in earlier sessions; "recollect verify" names them',
        ),
        (replace(WELL, free_space=FreeSpace(300)), "Disk", "only 300 MiB free: make room this evening"),
        (replace(WELL, free_space=FreeSpace(3)), "Disk", "only 3 MiB free: nobody can begin"),
        (replace(WELL, free_space=None), "Disk", "nobody can tell how much is free"),
        (replace(WELL, last_backup=BackupOutcome(NOW, None, "no room")), "Database", "the last copy failed: no room"),
        (replace(WELL, audit_error="it could not be written"), "Database", "it could not be written"),
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
            "none is set: every session is a trial, and anybody who knows the keys can do everything",
        ),
        (replace(WELL, screen="the desktop gets some keys", screen_well=False), "Screen", "the desktop gets some keys"),
    ],
)
def test_what_is_not_well_is_told_and_named_in_the_one_line(state: HealthInputs, name: str, words: str) -> None:
    assert told(state)[name] == HealthLine(name, words, is_ok=False)
    assert health_summary(health_lines(state, STUDY, CATALOGUES["en"]), CATALOGUES["en"]) == HealthLine(
        "", f"{name}: {words}", is_ok=False
    )


@pytest.mark.parametrize(
    ("minutes", "words"),
    [(0, "just now"), (59, "59 min ago"), (60, "1 h ago"), (23 * 60, "23 h ago"), (24 * 60, "1 day ago")],
)
def test_the_last_copy_is_told_in_the_size_that_matters(minutes: int, words: str) -> None:
    copied = BackupOutcome(NOW - minutes * MINUTE, Path("recollect-1.db"))
    assert told(replace(WELL, last_backup=copied))["Database"].message == f"written to; last copy {words}"


def test_without_a_copy_yet_nothing_is_wrong() -> None:
    assert told(replace(WELL, last_backup=None))["Database"].is_ok
