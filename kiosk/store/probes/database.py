"""Whether the database is one that can be gone on with, what it holds, and whether there is a copy of it."""

from __future__ import annotations

import sqlite3
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing
from datetime import datetime, timedelta
from pathlib import Path

from kiosk import DISK_FULL, BadInput
from kiosk.findings import Finding
from kiosk.settings import Allocation
from kiosk.store.care.backup import backups
from kiosk.store.care.withdraw import is_unfinished
from kiosk.store.connecting import primary_code, reason
from kiosk.store.database import FILE, Foreign, Newer, open_as_it_is, open_for_reading
from kiosk.store.migrations import SCHEMA
from kiosk.store.people.lists import Lists, PlaceList
from kiosk.store.people.participants import checked_site
from kiosk.store.probes.clock import newest
from kiosk.study.allocation import ratio_in_words
from kiosk.study.condition import Condition
from kiosk.study.session_kind import SessionKind

DATABASE, SITTINGS, COPY, LIST = "database", "sittings", "backup", "places"

OLD = timedelta(days=1)
"""A copy that is older than a day's sittings leaves a day to be lost."""


def database(folder: Path, *, busy: bool) -> Iterator[Finding]:
    """The file itself; ``busy`` tells whether a kiosk is open on the folder."""
    if not (folder / FILE).exists():
        yield Finding.good(DATABASE, "none yet; it is made when the kiosk opens")
        return
    try:
        with closing(open_as_it_is(folder)) as connection:
            schema = connection.execute("PRAGMA user_version").fetchone()[0]
            answer = connection.execute("PRAGMA quick_check(1)").fetchone()[0]
            unfinished = schema == SCHEMA and is_unfinished(connection)
    except BadInput as refusal:
        yield Finding.bad(DATABASE, str(refusal), _remedy(refusal, folder))
        return
    except sqlite3.Error as error:
        yield Finding.bad(DATABASE, reason(error, folder), _remedy(error, folder))
        return
    if answer != "ok":
        yield Finding.bad(DATABASE, f"it is damaged: {answer}", _REPLACE)
    elif busy:
        remedy = "nothing, if that is this booth's kiosk; else leave it, for a second one is refused"
        yield Finding.warning(DATABASE, "it is whole; a Recollect is open on it", remedy)
    elif unfinished:
        remedy = "open the kiosk, or give 'recollect withdraw' with the same code again"
        yield Finding.warning(DATABASE, "it is whole; a withdrawal was cut off and is not finished", remedy)
    else:
        newer = "" if schema == SCHEMA else f"; it is brought from schema {schema} to {SCHEMA} when the kiosk opens"
        yield Finding.good(DATABASE, f"it is whole{newer}")


_REPLACE = "copy the whole folder elsewhere first, then put the newest copy of 'backups' in its place"


def _remedy(failure: BadInput | sqlite3.Error, folder: Path) -> str:
    """Say what helps; only a file that is damaged, or no Recollect's, is ever to be replaced or left."""
    if isinstance(failure, Foreign):
        return "no Recollect made this file: give the kiosk a folder of its own with --data"
    if isinstance(failure, Newer):
        return "use the Recollect that wrote it; what is stored is intact"
    cause = failure.__cause__ if isinstance(failure, BadInput) else failure
    if isinstance(cause, sqlite3.Error | OSError) and reason(cause, folder) == DISK_FULL:
        return "make room on the disk; what is stored is intact"
    if cause is not None and primary_code(cause) == sqlite3.SQLITE_CORRUPT:
        return _REPLACE
    return "see that the disk is there, that this user may read it, and that no other program holds it"


def sittings(folder: Path, *, busy: bool) -> Iterator[Finding]:
    """What is stored of people, and what was cut off."""

    def look(connection: sqlite3.Connection) -> Iterator[Finding]:
        stored, cut_off = connection.execute(
            """
            SELECT count(*), coalesce(sum(last.type <> 'SittingEnded' OR last.body LIKE '%"interrupted"%'), 0)
            FROM sitting JOIN event AS last ON last.sitting = sitting.id
            AND last.seq = (SELECT max(seq) FROM event WHERE event.sitting = sitting.id)
            WHERE NOT sitting.simulated
            """
        ).fetchone()
        less = "cut off or under way" if busy else "cut off"
        yield Finding.good(SITTINGS, f"{stored} of people, {cut_off} of them {less}")

    return _reading(folder, look)


def copy(folder: Path, into: Path, now: datetime) -> Iterator[Finding]:
    """How old the newest copy is."""
    written = newest(folder)
    if written is None:
        yield Finding.good(COPY, "nothing is written yet")
        return
    made = max((file.stat().st_mtime for file in backups(into)), default=None) if into.is_dir() else None
    if made is None:
        yield Finding.warning(COPY, f"there is no copy in {into}", "recollect backup")
        return
    at = datetime.fromtimestamp(made, now.tzinfo)
    words = f"the newest copy is of {at:%Y-%m-%d %H:%M}"
    if now - at > OLD and written > at:
        yield Finding.warning(COPY, f"{words}, and more was written since", "recollect backup")
    else:
        yield Finding.good(COPY, words)


_AS_FIXED = "put quotas, block and seed back as they are fixed; another study needs a data folder of its own"


def allocation(
    folder: Path, site: str, declared: Allocation, kind: SessionKind = SessionKind.STUDY
) -> Iterator[Finding]:
    """Whether the list that is fixed for this kind of sittings is the study file's, and how much of it is left."""
    if not declared.quotas:
        yield Finding.good(LIST, "no quotas in the study file: every visitor gets the same condition")
        return
    quotas = {Condition.named(name): quota for name, quota in declared.quotas.items()}

    def look(connection: sqlite3.Connection) -> Iterator[Finding]:
        lists = Lists(connection, checked_site(site), simulated=kind)
        try:
            lists.check(quotas, declared.block, declared.seed)
        except BadInput as refusal:
            yield Finding.bad(
                LIST,
                str(refusal),
                "put quotas, block and seed back as they are fixed; another study needs a data folder of its own",
            )
            return
        yield _left(lists.latest(), lists.consumed(), quotas)

    if not (folder / FILE).exists():
        yield Finding.good(LIST, f"{ratio_in_words(quotas)}; fixed when the kiosk opens")
    else:
        yield from _reading(folder, look)


def _left(stored: PlaceList | None, consumed: set[int], quotas: Mapping[Condition, int]) -> Finding:
    places = () if stored is None else stored.places
    taken = Counter(place.condition for place in places if place.number in consumed)
    done = ", ".join(f"{condition.value} {taken[condition]} of {quota}" for condition, quota in quotas.items())
    if len(consumed) >= sum(quotas.values()):
        return Finding.warning(LIST, f"used up: {done}", "raise the quotas in their ratio, or end the study")
    return Finding.good(LIST, done if places else f"{done}; fixed when the kiosk opens")


_Look = Callable[[sqlite3.Connection], Iterator[Finding]]


def _reading(folder: Path, look: _Look) -> Iterator[Finding]:
    """What is found in the database; nothing where there is none, and the file's own finding says it if it is bad."""
    try:
        with closing(open_for_reading(folder)) as connection:
            yield from look(connection)
    except (BadInput, sqlite3.Error):
        return
