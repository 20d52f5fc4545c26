"""The codes that visitors withdraw with: made by chance, shown once, and stored as keyed hashes alone."""

from __future__ import annotations

import hashlib
import re
import secrets
import sqlite3
from collections.abc import Sequence

from kiosk import UserInputError

ALPHABET = "23456789ABCDEFGHJKMNPQRSTUVWXYZ"
"""Letters and digits without 0 and O, 1, I and L. 31 of them, a prime: so the check character tells every slip."""

CHANCE_CHARACTERS = 9
"""31^9 is 2^44.6: with the check character ten, which are copied by hand as two groups of five."""

_GROUP = 5
_COST, _BLOCK, _WORKERS, _HASH_BYTES = 2**11, 8, 1, 32
"""About 4 ms for one code: to go through all of them would take one processor some 3000 years."""

_BREAKS = re.compile(r"[\s\-\u2010-\u2015\u2212]+")
_SITE = re.compile(r"[A-Z0-9]{1,8}", re.ASCII)


def make_code(site: str) -> str:
    """Return a new code as it is shown; the site stands before it, to tell whose kiosk it is from."""
    characters = "".join(secrets.choice(ALPHABET) for _ in range(CHANCE_CHARACTERS))
    characters += _check(characters)
    return "-".join(part for part in (site, characters[:_GROUP], characters[_GROUP:]) if part)


def checked_code(text: str) -> str:
    """Return the ten characters of a code that was typed; raises UserInputError if it was mistyped."""
    parts = [part for part in _BREAKS.split(text.upper()) if part]
    if len(parts) > 1 and len("".join(parts)) > CHANCE_CHARACTERS + 1 and _SITE.fullmatch(parts[0]):
        del parts[0]
    characters = "".join(parts)
    if len(characters) != CHANCE_CHARACTERS + 1 or set(characters) - set(ALPHABET):
        raise UserInputError(
            f"{text!r} is no participant's code: after the site it has {CHANCE_CHARACTERS + 1} letters and digits, "
            "and never 0, O, 1, I or L"
        )
    if _check(characters[:-1]) != characters[-1]:
        raise UserInputError(f"the code {text!r} is mistyped: its last character does not fit the others")
    return characters


def hash_code(code: str, key: bytes) -> bytes:
    """Return what is stored of a code."""
    return hashlib.scrypt(checked_code(code).encode(), salt=key, n=_COST, r=_BLOCK, p=_WORKERS, dklen=_HASH_BYTES)


def issue_code(connection: sqlite3.Connection, session: int, site: str) -> str:
    """Give a session's person a code, within the transaction that is open; earlier ones stay valid."""
    code = make_code(site)
    (key,) = connection.execute("SELECT key FROM code_key LIMIT 1").fetchone()
    connection.execute("INSERT INTO withdrawal_code (hash, session) VALUES (?, ?)", (hash_code(code, key), session))
    return code


def shown_code(text: str, site: str) -> str:
    """Return a code that was typed as it is shown; raises UserInputError if it was mistyped."""
    characters = checked_code(text)
    return "-".join(part for part in (site, characters[:_GROUP], characters[_GROUP:]) if part)


def keys_of(connection: sqlite3.Connection) -> tuple[bytes, ...]:
    """Return what a database hashes codes with: one key, or that of each part where folders were merged."""
    return tuple(key for (key,) in connection.execute("SELECT key FROM code_key"))


def hashes_of(text: str, keys: Sequence[bytes]) -> tuple[bytes, ...]:
    """Return what is stored of a code under each key, some 4 ms for each.

    Raises UserInputError if it was mistyped.
    """
    return tuple(hash_code(text, key) for key in keys)


def session_with_hash(connection: sqlite3.Connection, hashes: Sequence[bytes]) -> int | None:
    """Return the session whose person has the code with one of these hashes; None if no stored one has."""
    for each in hashes:
        row = connection.execute("SELECT session FROM withdrawal_code WHERE hash = ?", (each,)).fetchone()
        if row is not None:
            return int(row[0])
    return None


def session_with_code(connection: sqlite3.Connection, text: str) -> int | None:
    """Return the session whose person has this code; None if no stored one has.

    Raises UserInputError if it was mistyped.
    """
    return _session(connection, "withdrawal_code", text)


def session_withdrawn_with(connection: sqlite3.Connection, text: str) -> int | None:
    """Return the session that this code belonged to before its person withdrew; None if there is none."""
    return _session(connection, "withdrawn_code", text)


def _session(connection: sqlite3.Connection, table: str, text: str) -> int | None:
    code = checked_code(text)
    # A merged folder has the key of each part.
    for key in keys_of(connection):
        row = connection.execute(
            f"SELECT session FROM {table} WHERE hash = ?",  # noqa: S608 - ours
            (hash_code(code, key),),
        ).fetchone()
        if row is not None:
            return int(row[0])
    return None


def _check(characters: str) -> str:
    """Return the character that makes one wrong character, or two in each other's place, come out wrong.

    A weighted sum modulo the alphabet's size, as in ISBN-10.
    """
    total = sum(weight * ALPHABET.index(character) for weight, character in enumerate(characters, 1))
    return ALPHABET[total % len(ALPHABET)]
