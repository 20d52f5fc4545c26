"""Health in words: every thing that can fail has a line, and one line tells which of them does."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from kiosk.assistance.wording import Catalogue
from kiosk.config import Settings
from kiosk.experiment.experimenter import DEVIATIONS, Action
from kiosk.robots.embodiment import Health
from kiosk.store.maintenance import FreeSpace
from kiosk.study.loader import read_study
from kiosk.ui.experimenter.health import Clocks, HealthInputs, HealthLine, booth_lines, health_lines, is_pack_changed
from kiosk.ui.experimenter.maintenance import BackupOutcome
from kiosk.ui.voice import NoVoice
from tests.samples import CATALOGUES

STUDY = read_study(Settings())
CHANGED = "another voice pack than in earlier sessions"
FAULT = Health(is_ok=False, message="it is gone")
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
    supervised=True,
)


def every_line(state: HealthInputs, catalogue: Catalogue) -> tuple[HealthLine, ...]:
    """Return the lines of both pages."""
    return (*health_lines(state, catalogue), *booth_lines(state, STUDY, catalogue))


def told(state: HealthInputs) -> dict[str, HealthLine]:
    """Every line by its name."""
    return {line.name: line for line in every_line(state, CATALOGUES["en"])}


@pytest.mark.parametrize("language", CATALOGUES)
def test_all_is_well_in_every_language(language: str) -> None:
    found = every_line(WELL, CATALOGUES[language])
    assert len(found) == 10
    assert all(line.is_ok and not line.is_due for line in found)


def test_a_pack_is_changed_if_another_one_spoke_the_same_language() -> None:
    earlier = {("en", "a"), ("it", "b")}
    assert not is_pack_changed(("en", "a"), earlier)
    assert not is_pack_changed(("es", "c"), earlier)
    assert not is_pack_changed(("en", ""), earlier)
    assert is_pack_changed(("en", "b"), earlier)
    assert is_pack_changed(("en", "a"), {*earlier, ("en", "b")})


@pytest.mark.parametrize("language", CATALOGUES)
def test_every_deviation_has_a_line_in_every_language(language: str) -> None:
    for noted in DEVIATIONS:
        name = noted.name.lower().replace("_", "-")
        assert "game" in CATALOGUES[language].text(f"console-note-{name}", what="game")


@pytest.mark.parametrize(
    ("state", "name", "words"),
    [
        (replace(WELL, robot=FAULT), "Robot", "it is gone"),
        (replace(WELL, voice=Health(is_ok=False, message="no voice")), "Voice", "no voice"),
        (replace(WELL, muted=True), "Voice", "silent on purpose"),
        (
            replace(WELL, pack_changed=True),
            "Voice",
            "another voice pack than in earlier sessions",
        ),
        (replace(WELL, free_space=FreeSpace(300)), "Disk", "only 300 MiB free"),
        (replace(WELL, free_space=FreeSpace(3)), "Disk", "only 3 MiB free: no session can begin"),
        (replace(WELL, free_space=None), "Disk", "how much is free cannot be seen"),
        (replace(WELL, last_backup=BackupOutcome(NOW, None, "no room")), "Database", "the last copy failed: no room"),
        (replace(WELL, audit_error="it could not be written"), "Database", "it could not be written"),
        (
            replace(WELL, clocks=Clocks(NOW, NOW, 0, NOW + 2 * HOUR)),
            "Clock",
            "2 h behind what was written last",
        ),
        (
            replace(WELL, clocks=Clocks(NOW, NOW - HOUR, HOUR + 300_000, 0)),
            "Clock",
            "was set by -300 s since the start",
        ),
        (replace(WELL, has_pin=False), "PIN", "not set"),
        (replace(WELL, supervised=False), "Supervisor", "not running"),
        (replace(WELL, screen="the desktop gets some keys", screen_well=False), "Screen", "the desktop gets some keys"),
    ],
)
def test_what_is_not_well_is_told_and_named_in_one_line(state: HealthInputs, name: str, words: str) -> None:
    assert replace(told(state)[name], remedy="", command="", action="", button="") == HealthLine(
        name, words, is_ok=False
    )
    assert [line.name for line in every_line(state, CATALOGUES["en"]) if not line.is_ok] == [name]


@pytest.mark.parametrize(
    ("minutes", "words"),
    [(0, "just now"), (59, "59 min ago"), (60, "1 h ago"), (23 * 60, "23 h ago"), (24 * 60, "1 day ago")],
)
def test_the_last_copy_is_told_in_the_size_that_matters(minutes: int, words: str) -> None:
    copied = BackupOutcome(NOW - minutes * MINUTE, Path("recollect-1.db"))
    assert told(replace(WELL, last_backup=copied))["Database"].message == f"last copy {words}"


@pytest.mark.parametrize(
    ("state", "name", "remedy", "command"),
    [
        (replace(WELL, has_pin=False), "PIN", "Set one before you open", "recollect study set-pin"),
        (replace(WELL, supervised=False), "Supervisor", "Start the kiosk with one", "recollect run --supervise"),
        (replace(WELL, muted=True), "Voice", "Visitors can only read what the helper says", ""),
        (replace(WELL, voice=FAULT), "Voice", "Check the loudspeaker and the sound settings", ""),
        (replace(WELL, robot=FAULT), "Robot", "Check its power and the network; the avatar helps meanwhile", ""),
        (replace(WELL, pack_changed=True), "Voice", "See in which sessions", "recollect verify"),
        (replace(WELL, free_space=None), "Disk", "Check that the data folder can be read", ""),
        (replace(WELL, free_space=FreeSpace(300)), "Disk", "Make room this evening", ""),
        (replace(WELL, free_space=FreeSpace(3)), "Disk", "Make room now", ""),
        (replace(WELL, clocks=Clocks(NOW, NOW, 0, NOW + 2 * HOUR)), "Clock", "Set the clock", ""),
        (replace(WELL, clocks=Clocks(NOW, NOW - HOUR, 0, 0)), "Clock", "Check that the time is right", ""),
        (replace(WELL, last_backup=None), "Database", "A copy protects the data", ""),
        (replace(WELL, last_backup=BackupOutcome(NOW, None, "no room")), "Database", "Mend that, then try again", ""),
        (replace(WELL, audit_error="read-only"), "Database", "Check the disk and its permissions", ""),
        (replace(WELL, remote="refused"), "From afar", "Check the network and the broker", ""),
    ],
)
def test_what_is_missing_comes_with_what_to_do_about_it(
    state: HealthInputs, name: str, remedy: str, command: str
) -> None:
    assert (told(state)[name].remedy, told(state)[name].command) == (remedy, command)
    well = told(replace(WELL, remote=""))[name]
    assert not well.remedy + well.command


@pytest.mark.parametrize("language", CATALOGUES)
def test_each_command_has_a_button_that_says_what_it_shows(language: str) -> None:
    states = (replace(WELL, has_pin=False), replace(WELL, supervised=False), replace(WELL, pack_changed=True))
    lines = [line for state in states for line in health_lines(state, CATALOGUES[language]) if line.command]
    assert [line.button for line in lines] == [
        CATALOGUES[language].text(f"console-{name}-how") for name in ("pin", "supervisor", "voice-changed")
    ]
    assert len({line.button for line in lines}) == len(lines)


def test_the_pin_is_asked_for_before_the_supervisor_that_needs_it() -> None:
    names = list(told(replace(WELL, has_pin=False, supervised=False)))
    assert names.index("PIN") < names.index("Supervisor")


@pytest.mark.parametrize(
    ("state", "name"),
    [
        (replace(WELL, robot=None), "Robot"),
        (replace(WELL, voice=NoVoice().health), "Voice"),
    ],
)
def test_what_is_not_in_use_is_no_fault_and_not_in_order_either(state: HealthInputs, name: str) -> None:
    unused = {line.name for line in told(state).values() if not line.is_used}
    assert name in unused
    assert told(state)[name].is_ok
    assert "Clock" not in unused


def test_a_copy_that_was_never_made_is_no_fault_but_is_to_be_made() -> None:
    database = told(replace(WELL, last_backup=None))["Database"]
    assert (database.button, database.action) == ("Make a copy", Action.BACKUP.value)
    assert (database.is_ok, database.is_due, database.message) == (True, True, "no copy yet")
    assert not told(WELL)["Database"].is_due
    assert not told(replace(WELL, last_backup=None, copy="after this session"))["Database"].is_due


@pytest.mark.parametrize(
    ("state", "message", "action"),
    [
        (replace(WELL, muted=True), "console-heard", Action.MUTE),
        (replace(WELL, last_backup=None), "console-backup", Action.BACKUP),
        (replace(WELL, last_backup=BackupOutcome(NOW, None, "the disk is full")), "console-backup", Action.BACKUP),
    ],
)
@pytest.mark.parametrize("language", CATALOGUES)
def test_what_an_action_answers_has_its_name_and_the_words_of_its_button(
    language: str, state: HealthInputs, message: str, action: Action
) -> None:
    catalogue = CATALOGUES[language]
    lines = [line for line in health_lines(state, catalogue) if line.action]
    assert [(line.button, line.action) for line in lines] == [(catalogue.text(message), action.value)]
