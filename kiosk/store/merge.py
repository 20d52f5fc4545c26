"""Data folders of several kiosks brought together in a new one; what is merged is copied and never changed."""

from __future__ import annotations

import os
import shlex
import sqlite3
import subprocess
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from itertools import count, product
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from kiosk import StorageError, UserInputError
from kiosk.experiment.outcomes import SessionKind
from kiosk.store.connecting import atomic_directory, reason
from kiosk.store.database import FILE, in_use, open_for_reading, open_for_writing
from kiosk.store.listing import participant_name
from kiosk.store.maintenance import Progress
from kiosk.store.participants import checked_site
from kiosk.store.remnants import clear_remnants
from kiosk.store.rows import insert
from kiosk.store.summaries import fill_summaries
from kiosk.store.tombstones import add_tombstones, sessions_of, withdrawn_hashes
from kiosk.store.verify import check_foreign

if TYPE_CHECKING:
    import sqlite_utils

Row = dict[str, Any]


_CACHE_KIB = 65_536
"""With the cache of a kiosk, which adds a few rows at a time, merging takes longer for each session than before."""


def merge(
    folders: Sequence[Path],
    out: Path,
    tell: Progress = lambda _done, _of: None,
    sites: Sequence[tuple[Path, str]] = (),
) -> int:
    """Bring data folders together in a new one, all of it or nothing; returns how many sessions it has.

    Sessions are numbered anew, in the order in which they began, whatever the order of the folders; a participant's
    number and code stay, and so does the site, unless ``sites`` gives all that a folder holds another one. Raises
    UserInputError if a folder cannot be read or is written in, if one participant or code stands in two of them, or if
    ``out`` is not empty or lies in one of them; StorageError if the disk does not take it.
    """
    asked, out = out, out.resolve()
    _check_folders(folders, out)
    for folder in folders:
        check_foreign(folder)
    given = _given_sites(folders, sites)
    with ExitStack() as opened:
        parts = [
            _Part(folder, opened.enter_context(closing(open_for_reading(folder))), given.get(folder))
            for folder in folders
        ]
        _check_at_rest(parts)
        _check_sites(parts)
        _check_apart(parts, asked)
        try:
            with atomic_directory(out) as unfinished:
                with closing(open_for_writing(unfinished)) as target:
                    target.execute(f"PRAGMA cache_size = -{_CACHE_KIB}")
                    _attach(parts, target)
                    target.execute("BEGIN IMMEDIATE")
                    with _without_triggers(target):
                        sessions = _copy(parts, target, tell)
                    target.execute("COMMIT")
                    for part in parts:
                        add_tombstones(unfinished, withdrawn_hashes(part.connection, part.folder))
                # Its pages are still to be written to the disk, so later withdrawals find them clear for little.
                clear_remnants(unfinished / FILE)
        except (OSError, sqlite3.Error) as error:
            raise StorageError(f"{out} could not be written: {reason(error, out.parent)}") from error
    return sessions


@dataclass(frozen=True)
class StudyCount:
    """How many sessions of the study ran under one hash in a data folder."""

    sha256: str
    title: str
    folder: Path
    sessions: int


def studies_in(folders: Sequence[Path]) -> list[StudyCount]:
    """Return the studies that the participants of these data folders were in, by their hashes, largest first."""
    found: list[StudyCount] = []
    for folder in folders:
        with closing(open_for_reading(folder)) as connection:
            rows = connection.execute(
                "SELECT study_sha256, json_extract(min(content), '$.title'), count(*) FROM session"
                " JOIN source ON source.sha256 = settings_sha256 WHERE kind = ? GROUP BY study_sha256",
                (int(SessionKind.STUDY),),
            )
            found += (StudyCount(sha256, title, folder, sessions) for sha256, title, sessions in rows)
    return sorted(found, key=lambda each: (-each.sessions, each.sha256, str(each.folder)))


_Shared = TypeVar("_Shared", bound=Hashable)
_Who = tuple[str, int, int]
"""A person of all folders: the site, the kind of their sessions, and their number."""


@dataclass
class _Part:
    """One of the folders, and what its sessions and lists are numbered in the new one.

    ``site`` is the one that all of its rows get; None leaves them theirs.
    """

    folder: Path
    connection: sqlite3.Connection
    site: str | None = None
    sessions: dict[int, int] = field(default_factory=dict)
    lists: dict[int, int] = field(default_factory=dict)
    attached: str = ""
    """What its database is called on the connection that writes the new one; "" if it is not there."""

    @cached_property
    def _database(self) -> sqlite_utils.Database:
        import sqlite_utils  # noqa: PLC0415 - it loads numpy and pandas where they are installed

        return sqlite_utils.Database(self.connection, recursive_triggers=False, execute_plugins=False)

    def rows(self, table: str, where: str = "", *values: int) -> Iterator[Row]:
        """Rows of a table by their columns' names."""
        for told in self._database.query(f"SELECT * FROM {table} {where}", values):  # noqa: S608 - ours
            yield told | {"site": self.site} if self.site is not None and "site" in told else told

    @property
    def sites(self) -> set[str]:
        """The sites that its rows had when they were written."""
        tables = ("session", "participant", "tombstone", "allocation_list")
        query = " UNION ".join(f"SELECT site FROM {table}" for table in tables)  # noqa: S608 - the names are ours
        return {site for (site,) in self.connection.execute(query)}

    def people(self) -> Iterator[_Who]:
        """Everybody who has a number here, those who withdrew among them."""
        for row in (*self.rows("participant"), *self.rows("tombstone")):
            yield row["site"], row["kind"], row["number"]

    def codes(self) -> Iterator[bytes]:
        """Return the hashes of all codes that are valid here."""
        return (row["hash"] for row in self.rows("withdrawal_code"))


def _check_folders(folders: Sequence[Path], out: Path) -> None:
    for number, folder in enumerate(folders):
        if any(_is_same(folder, other) for other in folders[:number]):
            raise UserInputError("a data folder is named twice; each can be merged once")
        if any(_is_same(folder, above) for above in (out, *out.parents)):
            raise UserInputError(
                f"{out} is, or lies in, the data folder {folder}, which is only read; choose a folder elsewhere for "
                "--out. Nothing was merged"
            )
    if out.exists() and (not out.is_dir() or any(out.iterdir())):
        raise UserInputError(f"{out} is not an empty folder; nothing was merged")


def _is_same(one: Path, other: Path) -> bool:
    """Whether two paths are one folder, also through links or by other capitals where those do not count."""
    try:
        return one.samefile(other)
    except OSError:
        return one.resolve() == other.resolve()


def _given_sites(folders: Sequence[Path], sites: Sequence[tuple[Path, str]]) -> Mapping[Path, str]:
    """Return the site that each folder gets, by the folder as it stands among ``folders``."""
    given: dict[Path, str] = {}
    for named, site in sites:
        folder = next((folder for folder in folders if _is_same(folder, named)), None)
        if folder is None:
            raise UserInputError(f"--site {named}={site}: {named} is not one of the folders to merge")
        if folder in given:
            raise UserInputError(f"--site names the folder {folder} twice")
        if not site:
            raise UserInputError(f"--site {named}=: the name of the site is missing, such as in {named}=ROME")
        given[folder] = checked_site(site)
    return given


def _check_at_rest(parts: Sequence[_Part]) -> None:
    for part in parts:
        if in_use(part.folder):
            raise UserInputError(f"a kiosk is writing in {part.folder}: close it first, then merge")


def _check_sites(parts: Sequence[_Part]) -> None:
    """Refuse to give one site to a folder that holds several, in which numbers stand more than once."""
    for part in parts:
        if part.site is not None and len(part.sites) > 1:
            named = ", ".join(site or "one without a name" for site in sorted(part.sites))
            raise UserInputError(
                f"{part.folder} holds the data of several sites ({named}), so --site cannot name it anew"
            )


def _check_apart(parts: Sequence[_Part], out: Path) -> None:
    """Refuse two folders that hold one participant, or one code; say how kiosks without sites can be merged."""
    _check_no_older_copies(parts)
    code = _first_shared(parts, _Part.codes)
    person = _first_shared(parts, _Part.people)
    copied = "Does one of them hold a copy of the other's data?"
    if person is not None:
        (site, _, number), one, other = person
        raise UserInputError(
            f"participant {participant_name(site, number)} is in {one.folder} and in {other.folder}; nothing was "
            f"merged. {_way_out(parts, out) if code is None else copied}"
        )
    if code is not None:
        _, one, other = code
        raise UserInputError(
            f"one participant's code is valid in {one.folder} and in {other.folder}; nothing was merged. {copied}"
        )


def _first_shared(
    parts: Sequence[_Part], of: Callable[[_Part], Iterator[_Shared]]
) -> tuple[_Shared, _Part, _Part] | None:
    """Return the first thing that two folders have, and those two."""
    found: dict[_Shared, _Part] = {}
    for part in parts:
        for thing in of(part):
            first = found.setdefault(thing, part)
            if first is not part:
                return thing, first, part
    return None


def _check_no_older_copies(parts: Sequence[_Part]) -> None:
    """Refuse a copy from before a withdrawal, which would bring the person back."""
    for part, other in product(parts, repeat=2):
        for back in sessions_of(other.connection, withdrawn_hashes(part.connection, part.folder)):
            (row,) = other.rows("participant", "WHERE session = ?", back)
            raise UserInputError(
                f"participant {participant_name(row['site'], row['number'])} withdrew in {part.folder}, but is "
                f"still in {other.folder}; nothing was merged. Delete them there as well: recollect withdraw "
                f"--session {back} --data {other.folder}"
            )


def _way_out(parts: Sequence[_Part], out: Path) -> str:
    """Return the command that merges kiosks whose participants have the same numbers, if there is one."""
    named = _named_anew(parts)
    if named is None:
        return "Kiosks whose data will be merged need a --site each"
    sites = [f"--site={folder}={site}" for folder, site in named.items()]
    command = ["recollect", "merge", *(str(part.folder) for part in parts), f"--out={out}", *sites]
    written = subprocess.list2cmdline(command) if os.name == "nt" else shlex.join(command)
    return f"If they are different kiosks, give each a site, such as ROME for KIOSK1: {written}"


def _named_anew(parts: Sequence[_Part]) -> dict[Path, str] | None:
    """Sites for the folders that share a participant with another; None if those do not tell all people apart."""
    people = {part.folder: set(part.people()) for part in parts}
    clashing = [
        part
        for part in parts
        if any(people[part.folder] & people[other.folder] for other in parts if other is not part)
    ]
    taken = {site for part in parts for site in (*part.sites, part.site)}
    free = (name for number in count(1) if (name := f"KIOSK{number}") not in taken)
    named = {part.folder: part.site for part in parts if part.site is not None}
    named |= {part.folder: next(free) for part in clashing if len(part.sites) == 1}
    return named if sum(len(part.sites) > 1 for part in clashing) <= 1 else None


_SLOW_TRIGGERS = (
    *("event_is_never_replaced", "event_moves_the_head"),
    *("session_summary_of_a_game", "session_summary_of_an_end", "session_summary_of_a_resumption"),
)
"""Triggers that are asked for each event and take most of a merge's time."""


@contextmanager
def _without_triggers(target: sqlite3.Connection) -> Iterator[None]:
    """Copy events without some triggers, which are made anew; heads and summaries are filled in at once."""
    made = [
        target.execute("SELECT sql FROM sqlite_master WHERE type = 'trigger' AND name = ?", (name,)).fetchone()[0]
        for name in _SLOW_TRIGGERS
    ]
    for name in _SLOW_TRIGGERS:
        target.execute(f"DROP TRIGGER {name}")
    yield
    # SQLite takes the hash from the row that has the greatest number.
    target.execute("INSERT INTO head SELECT session, max(seq), hash FROM event GROUP BY session")
    fill_summaries(target)
    for trigger in made:
        target.execute(trigger)


def _copy(parts: Sequence[_Part], target: sqlite3.Connection, tell: Progress) -> int:
    for part in parts:
        for row in part.rows("source"):
            target.execute("INSERT INTO source VALUES (?, ?) ON CONFLICT DO NOTHING", tuple(row.values()))
    # Its own key came with the new database, and no code was hashed with it.
    target.execute("DELETE FROM code_key")
    for part in parts:
        for row in part.rows("code_key"):
            target.execute("INSERT INTO code_key VALUES (?) ON CONFLICT DO NOTHING", tuple(row.values()))
    _copy_lists(parts, target)
    _copy_tombstones(parts, target)
    for table, keys in (("visit", ("why", "kind")), ("audit_event", ("wall_ms", "type", "payload"))):
        for _, row in _ordered(parts, table, *keys):
            insert(target, table, {name: value for name, value in row.items() if name != "id"})
    return _copy_sessions(parts, target, tell)


def _copy_lists(parts: Sequence[_Part], target: sqlite3.Connection) -> None:
    for part, row in _ordered(parts, "allocation_list", "fixed_at", "site", "kind", "id"):
        part.lists[row["id"]] = insert(target, "allocation_list", {n: value for n, value in row.items() if n != "id"})


def _copy_tombstones(parts: Sequence[_Part], target: sqlite3.Connection) -> None:
    """They stand before the sessions, so that no session that is yet to come takes their numbers."""
    ordered = _ordered(parts, "tombstone", "site", "kind", "number", "visit")
    for number, (part, row) in enumerate(ordered, 1):
        old = row["session"]
        insert(
            target, "tombstone", row | {"session": number, "allocation_list": part.lists.get(row["allocation_list"])}
        )
        for code in part.rows("withdrawn_code", "WHERE session = ?", old):
            insert(target, "withdrawn_code", code | {"session": number})
    target.execute("INSERT INTO sqlite_sequence VALUES ('session', ?)", (len(ordered),))


def _copy_sessions(parts: Sequence[_Part], target: sqlite3.Connection, tell: Progress) -> int:
    ordered = _ordered(parts, "session", "started_at", "site", "kind", "seed", "id")
    for done, (part, row) in enumerate(ordered):
        tell(done, len(ordered))
        old = row.pop("id")
        new = insert(target, "session", row | {"allocation_list": part.lists.get(row["allocation_list"])})
        _copy_events(part, target, old, new)
        for table in ("participant", "withdrawal_code"):
            for own in part.rows(table, "WHERE session = ?", old):
                insert(target, table, own | {"session": new})
    return len(ordered)


_MOST_ATTACHED = 8
"""SQLite takes ten, unless it was built otherwise."""


def _attach(parts: Sequence[_Part], target: sqlite3.Connection) -> None:
    """Have events copied within SQLite, which takes a third of the time; what is a copy in memory cannot be."""
    for number, part in enumerate(parts[:_MOST_ATTACHED]):
        (_, _, opened), *_ = part.connection.execute("PRAGMA database_list")
        file = part.folder / FILE
        if opened and _is_same(Path(opened), file):
            target.execute(f"ATTACH ? AS part{number}", (f"{file.resolve().as_uri()}?mode=ro",))
            part.attached = f"part{number}"


_COPIED = "seq, at_ms, origin, type, payload, wall_ms, hash"
"""The columns of an event but for its session."""


def _copy_events(part: _Part, target: sqlite3.Connection, old: int, new: int) -> None:
    """Copy the events of a session under its new number, all at once, as they are nearly everything there is."""
    into = f"INSERT INTO event (session, {_COPIED})"
    if part.attached:
        target.execute(f"{into} SELECT ?, {_COPIED} FROM {part.attached}.event WHERE session = ?", (new, old))  # noqa: S608 - ours
    else:
        rows = part.connection.execute(f"SELECT ?, {_COPIED} FROM event WHERE session = ?", (new, old))  # noqa: S608 - ours
        target.executemany(f"{into} VALUES (?, ?, ?, ?, ?, ?, ?, ?)", rows)


def _ordered(parts: Sequence[_Part], table: str, *keys: str) -> list[tuple[_Part, Row]]:
    """Return the rows of all folders in an order that does not depend on that of the folders."""
    rows = [(part, row) for part in parts for row in part.rows(table)]
    return sorted(rows, key=lambda each: tuple(each[1][key] for key in keys))
