"""A participant is a number with the site: no name, and no two alike."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.experiment.events import SessionStarted
from kiosk.experiment.outcomes import SessionKind
from kiosk.store.database import FILE
from kiosk.store.participants import Participant, checked_site
from kiosk.store.recorder import Provenance, Recorder

START = SessionStarted(at_ms=0)


def entered(folder: Path, provenance: Provenance, *seeds: int, site: str = "") -> list[Participant]:
    """Return the people of sessions with these seeds."""
    with Recorder(folder, site) as recorder:
        return [recorder.begin(replace(provenance, seed=seed), [START]) for seed in seeds]


def test_participants_are_numbered_from_one(folder: Path, provenance: Provenance) -> None:
    people = entered(folder, provenance, 1, 2, 3)
    assert [(person.session, person.number, person.name) for person in people] == [
        (1, 1, "1"),
        (2, 2, "2"),
        (3, 3, "3"),
    ]


def test_every_site_counts_for_itself(folder: Path, provenance: Provenance) -> None:
    for site, names in (("MI", ["MI-1", "MI-2"]), ("BCN2", ["BCN2-1", "BCN2-2"]), ("MI", ["MI-3", "MI-4"])):
        assert [person.name for person in entered(folder, provenance, 1, 2, site=site)] == names


def test_a_rehearsal_or_a_trial_uses_up_no_number_of_a_person_s(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder:
        numbers = [
            recorder.begin(replace(provenance, kind=kind), [START]).number
            for kind in map(SessionKind, (1, 1, 0, 1, 0, 2, 2, 0))
        ]
    assert numbers == [1, 2, 1, 3, 2, 1, 2, 3]


def test_a_number_that_was_withdrawn_is_not_given_again(folder: Path, provenance: Provenance) -> None:
    entered(folder, provenance, 1, 2)
    with closing(sqlite3.connect(folder / FILE)) as connection, connection:
        connection.execute(
            "INSERT INTO tombstone VALUES (2, '', 2, 1, 'tom', NULL, NULL, NULL, 'completed', 1, '2026-01-31', 1)"
        )
        for table, key in (("event", "session"), ("participant", "session"), ("session", "id")):
            connection.execute(f"DELETE FROM {table} WHERE {key} = 2")  # noqa: S608 - a table of ours
    (person,) = entered(folder, provenance, 3)
    assert (person.session, person.number) == (3, 3)


def test_a_session_and_its_person_are_written_together_or_not_at_all(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder) as recorder, pytest.raises(OverflowError):
        recorder.begin(provenance, [SessionStarted(at_ms=2**63)])
    assert [person.number for person in entered(folder, provenance, 1)] == [1]


@pytest.mark.parametrize("site", ["", "A", "MI", "BCN2", "ABCDEFGH", "12345678", "NAP", "1A", "MARS1A"])
def test_a_site_is_named_by_capital_letters_and_digits(folder: Path, provenance: Provenance, site: str) -> None:
    (person,) = entered(folder, provenance, 1, site=site)
    assert person.site == checked_site(site) == site
    assert person.code.startswith(f"{site}-" if site else "")
    with closing(sqlite3.connect(folder / FILE)) as connection:
        assert connection.execute("SELECT site FROM session").fetchall() == [(site,)]


@pytest.mark.parametrize("site", ["mi", "ABCDEFGHI", "A B", "A-1", " ", "\u00c9", "\u0661", "A\n"])
def test_another_name_of_a_site_is_refused_and_nothing_is_made(folder: Path, site: str) -> None:
    with pytest.raises(UserInputError, match="a site is named by up to 8 capital letters and digits, not"):
        Recorder(folder, site)
    assert not folder.exists()


@pytest.mark.parametrize(
    ("site", "label", "misread"),
    [
        ("1E", "1E-1", "a number or a date"),
        ("1E5", "1E5", "a number or a date"),
        ("007", "007", "a number or a date"),
        ("12", "12-1", "a number or a date"),
        ("MAR", "MAR-1", "a number or a date"),
        ("MAR1", "MAR1", "a number or a date"),
        ("INF", "INF", "a number or a date"),
        ("NA", "NA", "a missing value"),
        ("NULL", "NULL", "a missing value"),
        ("TRUE", "TRUE", "true or false"),
        ("T", "T", "true or false"),
    ],
)
def test_a_site_that_tables_turn_into_something_else_is_refused(
    folder: Path, site: str, label: str, misread: str
) -> None:
    with pytest.raises(
        UserInputError, match=f"^{label!r} is taken for {misread} by programs that read tables, so {site!r} "
    ):
        Recorder(folder, site)
    assert not folder.exists()
