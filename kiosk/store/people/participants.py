"""Who sat there: a number within the site, and a code that the visitor keeps, so that no name is needed anywhere."""

from __future__ import annotations

import re
import sqlite3
from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

from kiosk import BadInput
from kiosk.study.declared.labels import read_as

ALPHABET = "23456789ABCDEFGHJKMNPQRSTUVWXYZ"
"""Letters and digits without 0 and O, 1, I and L. 31 of them, a prime: so the check character tells every slip."""

CHANCE_CHARACTERS = 6
"""With the check character 7: short enough to be copied by hand. 31^6 is 887 million, so that among the thousand
people of a large study a code that is made up belongs to nobody (1 in a million), and two hardly ever fall together
(1 in 2000 studies), which is seen and mended when it happens."""

_DIGITS_OF_A_YEAR = 4
_SITE = re.compile(r"[A-Z0-9]{0,8}", re.ASCII)


@dataclass(frozen=True)
class Participant:
    """The person of one sitting; ``number`` counts from 1 within a site, for people and for rehearsals apart."""

    sitting: int
    site: str
    number: int
    code: str

    @property
    def name(self) -> str:
        """The number with its site, as it stands in lists."""
        return participant_name(self.site, self.number)


def participant_name(site: str, number: int) -> str:
    """A participant's number with the site, if it has one."""
    return f"{site}-{number}" if site else str(number)


def checked_site(site: str) -> str:
    """The name of a site as it may stand in numbers, codes and tables; raises BadInput for any other."""
    if not _SITE.fullmatch(site):
        raise BadInput(f"a site is named by up to 8 capital letters and digits, not {site!r}")
    for label in (site, *([participant_name(site, 1)] if site and not _is_long_number(site) else [])):
        misread = read_as(label)
        if misread:
            raise BadInput(
                f"{label!r} is taken for {misread} by programs that read tables, so {site!r} cannot name a site; "
                "choose another name, such as ROME"
            )
    return site


def _is_long_number(site: str) -> bool:
    """Whether a site is a number that with another one behind it is neither a date nor anything else."""
    return site.isdigit() and len(site) > _DIGITS_OF_A_YEAR


def checked_code(text: str) -> str:
    """The code that was typed, in its own spelling; raises BadInput if it was mistyped."""
    code = "".join(text.split()).upper()
    characters = code.rpartition("-")[2]
    if len(characters) != CHANCE_CHARACTERS + 1 or set(characters) - set(ALPHABET):
        raise BadInput(
            f"{text!r} is no participant's code: after the site it has {CHANCE_CHARACTERS + 1} letters and digits, "
            "and never 0, O, 1, I or L"
        )
    if _check(characters[:-1]) != characters[-1]:
        raise BadInput(f"the code {text!r} is mistyped: its last character does not fit the others")
    return code


def enrol(connection: sqlite3.Connection, sitting: int) -> Participant:
    """Give a sitting's person the next number of the site, and a code, within the transaction that is open."""
    site, simulated, seed = connection.execute(
        "SELECT site, simulated, seed FROM sitting WHERE id = ?", (sitting,)
    ).fetchone()
    participant = Participant(sitting, site, _next_number(connection, site, simulated), _code(connection, site, seed))
    connection.execute(
        "INSERT INTO participant (sitting, site, simulated, number, code) VALUES (?, ?, ?, ?, ?)",
        (sitting, site, simulated, participant.number, participant.code),
    )
    return participant


def participant_of(connection: sqlite3.Connection, sitting: int) -> Participant | None:
    """The person of a sitting; None if it was recorded before people were numbered, or is not there."""
    row = connection.execute(
        "SELECT sitting, site, number, code FROM participant WHERE sitting = ?", (sitting,)
    ).fetchone()
    return Participant(*row) if row else None


def codes(site: str, seed: int) -> Iterator[str]:
    """The codes that a sitting's seed leads to, best first."""
    chance = Random(f"{seed}/code")
    while True:
        characters = "".join(chance.choices(ALPHABET, k=CHANCE_CHARACTERS))
        yield (f"{site}-" if site else "") + characters + _check(characters)


def _code(connection: sqlite3.Connection, site: str, seed: int) -> str:
    return next(code for code in codes(site, seed) if not _taken(connection, code))


def _taken(connection: sqlite3.Connection, code: str) -> bool:
    return connection.execute("SELECT 1 FROM participant WHERE code = ?", (code,)).fetchone() is not None


def _next_number(connection: sqlite3.Connection, site: str, simulated: int) -> int:
    """One more than the highest ever given, whether or not its sitting was withdrawn."""
    number: int = connection.execute(
        """
        SELECT 1 + coalesce(max(number), 0) FROM (
            SELECT site, simulated, number FROM participant UNION ALL SELECT site, simulated, number FROM tombstone
        ) WHERE site = ? AND simulated = ?
        """,
        (site, simulated),
    ).fetchone()[0]
    return number


def _check(characters: str) -> str:
    """The character that makes one wrong character, or two in each other's place, come out wrong.

    A weighted sum modulo the alphabet's size, as in ISBN-10.
    """
    total = sum(weight * ALPHABET.index(character) for weight, character in enumerate(characters, 1))
    return ALPHABET[total % len(ALPHABET)]
