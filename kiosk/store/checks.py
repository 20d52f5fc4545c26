"""Preflight checks of the database, the disk and the clock."""

from __future__ import annotations

import os
import shutil
import sqlite3
import stat
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing
from datetime import UTC, datetime, timedelta
from pathlib import Path

from kiosk import DISK_FULL, UserInputError
from kiosk.config import Allocation
from kiosk.experiment.condition import Condition, ratio_in_words
from kiosk.experiment.outcomes import SessionKind
from kiosk.experiment.questionnaire import QUESTIONNAIRES, Questionnaire, differences
from kiosk.experiment.session_config import SessionConfig
from kiosk.preflight import CheckResult
from kiosk.store.allocation import AllocationList, AllocationLists
from kiosk.store.connecting import primary_code, reason
from kiosk.store.copies import backups_of
from kiosk.store.database import FILE, Foreign, Newer, make_durable, open_as_it_is, open_for_reading
from kiosk.store.maintenance import REFUSE_MIB, WARN_MIB, SpaceLevel, free_space
from kiosk.store.migrations import SCHEMA
from kiosk.store.participants import checked_site
from kiosk.store.snapshot import last_written_ms
from kiosk.store.withdrawal import is_unfinished
from kiosk.units import MS_PER_SECOND

WHAT = "clock"

SLACK = timedelta(minutes=1)
"""A clock that is set by the network may go back a little."""

_REMEDY = "set the clock (Debian: timedatectl set-ntp true); sessions before that keep their wrong dates"


def clock_check(folder: Path, now: datetime, made: datetime | None) -> Iterator[CheckResult]:
    """``now`` is the wall's clock with its zone; ``made`` is when this program was."""
    shown = f"{now:%Y-%m-%d %H:%M}, {now.tzname()} ({now:%z})"
    written = newest_write(folder)
    if written is not None and now + SLACK < written:
        last = f"{written.astimezone(now.tzinfo):%Y-%m-%d %H:%M}"
        words = f"{shown} is before the last record, of {last}: it was set back"
        yield CheckResult.warning(WHAT, words, _REMEDY)
    elif made is not None and now + SLACK < made:
        yield CheckResult.warning(WHAT, f"{shown} is before this program was made, {made:%Y-%m-%d}", _REMEDY)
    else:
        yield CheckResult.ok(WHAT, shown)


def newest_write(folder: Path) -> datetime | None:
    """When anything was written last; None if nothing was, or it cannot be found out."""
    if not (folder / FILE).exists():
        return None
    try:
        written_ms = last_written_ms(folder)
    except UserInputError:
        return None
    return datetime.fromtimestamp(written_ms / MS_PER_SECOND, UTC) if written_ms else None


DATABASE, SESSIONS, COPY, LIST = "database", "sessions", "backup", "allocation list"

OLD = timedelta(days=1)
"""A copy that is older than a day's sessions leaves a day to be lost."""


def database_check(folder: Path, *, busy: bool) -> Iterator[CheckResult]:
    """Yield the file itself; ``busy`` tells whether a kiosk is open on the folder."""
    if not (folder / FILE).exists():
        yield CheckResult.ok(DATABASE, "none yet; it is made when the kiosk opens")
        return
    try:
        with closing(open_as_it_is(folder)) as connection:
            schema = connection.execute("PRAGMA user_version").fetchone()[0]
            answer = connection.execute("PRAGMA quick_check(1)").fetchone()[0]
            unfinished = schema == SCHEMA and is_unfinished(connection, folder)
    except UserInputError as refusal:
        yield CheckResult.error(DATABASE, str(refusal), _remedy(refusal, folder))
        return
    except sqlite3.Error as error:
        yield CheckResult.error(DATABASE, reason(error, folder), _remedy(error, folder))
        return
    if answer != "ok":
        yield CheckResult.error(DATABASE, f"it is damaged: {answer}", _REPLACE)
    elif busy:
        remedy = "nothing, if that is this booth's kiosk; else leave it, for a second one is refused"
        yield CheckResult.warning(DATABASE, "it is whole; a Recollect is open on it", remedy)
    elif unfinished:
        remedy = "open the kiosk, or give 'recollect withdraw' with the same code again"
        yield CheckResult.warning(DATABASE, "it is whole; a withdrawal was cut off and is not finished", remedy)
    else:
        newer = "" if schema == SCHEMA else f"; it is brought from schema {schema} to {SCHEMA} when the kiosk opens"
        yield CheckResult.ok(DATABASE, f"it is whole{newer}")


_REPLACE = "copy the whole folder elsewhere first, then put the newest copy of 'backups' in its place"


def _remedy(failure: UserInputError | sqlite3.Error, folder: Path) -> str:
    """Say what helps; only a file that is damaged, or no Recollect's, is ever to be replaced or left."""
    if isinstance(failure, Foreign):
        return "no Recollect made this file: give the kiosk a folder of its own with --data"
    if isinstance(failure, Newer):
        return "use the Recollect that wrote it; what is stored is intact"
    cause = failure.__cause__ if isinstance(failure, UserInputError) else failure
    if isinstance(cause, sqlite3.Error | OSError) and reason(cause, folder) == DISK_FULL:
        return "make room on the disk; what is stored is intact"
    if cause is not None and primary_code(cause) == sqlite3.SQLITE_CORRUPT:
        return _REPLACE
    return "see that the disk is there, that this user may read it, and that no other program holds it"


def sessions_check(folder: Path, *, busy: bool) -> Iterator[CheckResult]:
    """Yield what is stored of people, and what was cut off."""

    def look(connection: sqlite3.Connection) -> Iterator[CheckResult]:
        stored, cut_off = connection.execute(
            """
            SELECT count(*), coalesce(sum(last.type <> 'SessionEnded' OR last.payload LIKE '%"interrupted"%'), 0)
            FROM session JOIN event AS last ON last.session = session.id
            AND last.seq = (SELECT max(seq) FROM event WHERE event.session = session.id)
            WHERE session.kind = 0
            """
        ).fetchone()
        less = "cut off or under way" if busy else "cut off"
        yield CheckResult.ok(SESSIONS, f"{stored} of people, {cut_off} of them {less}")

    return _reading(folder, look)


def backup_check(folder: Path, now: datetime) -> Iterator[CheckResult]:
    """How old the newest copy is, in the data folder or elsewhere."""
    written = newest_write(folder)
    if written is None:
        yield CheckResult.ok(COPY, "nothing is written yet")
        return
    made = backups_of(folder)
    if not made:
        yield CheckResult.warning(COPY, "there is no copy", "recollect backup")
        return
    at = made[-1].at.astimezone(now.tzinfo)
    words = f"the newest copy is of {at:%Y-%m-%d %H:%M}"
    if now - at > OLD and written > at:
        yield CheckResult.warning(COPY, f"{words}, and more was written since", "recollect backup")
    else:
        yield CheckResult.ok(COPY, words)


_AS_FIXED = "put quotas, block and seed back as they are fixed; another study needs a data folder of its own"


def allocation_check(
    folder: Path, site: str, declared: Allocation, kind: SessionKind = SessionKind.STUDY
) -> Iterator[CheckResult]:
    """Check whether the fixed list for this kind of sessions is the study file's, and what is left."""
    if not declared.target_n:
        yield CheckResult.ok(LIST, "no quotas in the study file: every visitor gets the same condition")
        return
    quotas = {Condition(name): quota for name, quota in declared.target_n.items()}

    def look(connection: sqlite3.Connection) -> Iterator[CheckResult]:
        lists = AllocationLists(connection, checked_site(site), kind=kind)
        try:
            lists.check(quotas, declared.block_size, declared.seed)
        except UserInputError as refusal:
            yield CheckResult.error(LIST, str(refusal), _AS_FIXED)
            return
        yield _left(lists.latest(), lists.consumed(), quotas)

    if not (folder / FILE).exists():
        yield CheckResult.ok(LIST, f"{ratio_in_words(quotas)}; fixed when the kiosk opens")
    else:
        yield from _reading(folder, look)


def _left(stored: AllocationList | None, consumed: set[int], quotas: Mapping[Condition, int]) -> CheckResult:
    slots = () if stored is None else stored.slots
    taken = Counter(slot.condition for slot in slots if slot.number in consumed)
    done = ", ".join(f"{condition.name} {taken[condition]} of {quota}" for condition, quota in quotas.items())
    if len(consumed) >= sum(quotas.values()):
        return CheckResult.warning(LIST, f"used up: {done}", "raise the quotas in their ratio, or end the study")
    return CheckResult.ok(LIST, done if slots else f"{done}; fixed when the kiosk opens")


_Look = Callable[[sqlite3.Connection], Iterator[CheckResult]]


def _reading(folder: Path, look: _Look) -> Iterator[CheckResult]:
    """Return what is found in the database, and nothing where there is none.

    A damaged file is a finding of its own.
    """
    try:
        with closing(open_for_reading(folder)) as connection:
            yield from look(connection)
    except (UserInputError, sqlite3.Error):
        return


ROOM, FOLDER, WRITING = "disk", "data folder", "writing"

TIMES = 20
LONGEST_S = 3.0
"""A disk that takes longer for so many records has said enough."""

SLOW_MS = 16.0
"""A record is on the disk before the screen changes: in the usual case that must fit into one frame."""
STALL_MS = 250.0
"""A tap whose answer takes so long is tapped again."""

_PREFIX = ".recollect-check-"
_STALE_S = 60
_RECORD = "x" * 400
"""A tap and what comes of it take some 400 bytes."""

_OTHERS = stat.S_IRWXG | stat.S_IRWXO


def free_space_check(folder: Path) -> Iterator[CheckResult]:
    """Yield the room that is left."""
    try:
        left = free_space(folder)
    except UserInputError as failure:
        yield CheckResult.error(ROOM, str(failure), "see that the disk is there")
        return
    words = f"{left.free_mib:,} MiB are free"
    match left.level:
        case SpaceLevel.ENOUGH:
            yield CheckResult.ok(ROOM, words)
        case SpaceLevel.WARN:
            yield CheckResult.warning(
                ROOM, words, f"make room, to {WARN_MIB} MiB; below {REFUSE_MIB} no session begins"
            )
        case SpaceLevel.REFUSE:
            yield CheckResult.error(ROOM, f"{words}, and no session can begin", f"make room, to {WARN_MIB} MiB")


def access_check(folder: Path) -> Iterator[CheckResult]:
    """Who may read the data, and whether we may write there."""
    place = existing_part(folder)
    if not os.access(place, os.W_OK | os.X_OK):
        yield CheckResult.error(FOLDER, f"{place} cannot be written", "give it to the user who runs the kiosk")
    elif place != folder.absolute():
        yield CheckResult.ok(FOLDER, f"{folder} is not there yet; it is made when the kiosk opens")
    elif sys.platform != "win32" and stat.S_IMODE(folder.stat().st_mode) & _OTHERS:
        yield CheckResult.warning(FOLDER, f"others on this machine can look into {folder}", f"chmod 700 {folder}")
    else:
        yield CheckResult.ok(FOLDER, f"{folder} is this user's alone")


def write_speed_check(folder: Path, measure: Callable[[Path], Sequence[float]] | None = None) -> Iterator[CheckResult]:
    """How long a record takes to be on the disk; ``measure`` stands in for the disk in tests."""
    try:
        times = sorted((measure or written_ms)(existing_part(folder)))
    except (OSError, sqlite3.Error) as failure:
        yield CheckResult.error(
            WRITING,
            f"the disk takes no records: {reason(failure, existing_part(folder))}",
            "see that it is neither full nor read-only",
        )
        return
    usual, longest = times[len(times) // 2], times[-1]
    words = f"a record is on the disk in {usual:.1f} ms, at most {longest:.0f} ms, of {len(times)}"
    if usual > SLOW_MS or longest > STALL_MS:
        remedy = "use a disk of this machine, not a memory card or a network; end what else writes to it"
        yield CheckResult.warning(WRITING, words, remedy)
    else:
        yield CheckResult.ok(WRITING, words)


def written_ms(place: Path) -> list[float]:
    """Measure how long each of some records takes, in ms.

    It writes to a database of its own on the same disk, and removes it.
    """
    _remove_stale(place)
    times: list[float] = []
    with (
        tempfile.TemporaryDirectory(prefix=_PREFIX, dir=place) as folder,
        closing(sqlite3.connect(Path(folder) / "records.db", isolation_level=None)) as connection,
    ):
        make_durable(connection)
        connection.execute("CREATE TABLE record (body TEXT)")
        end = time.monotonic() + LONGEST_S
        while len(times) < TIMES and (not times or time.monotonic() < end):
            begun = time.perf_counter()
            connection.execute("INSERT INTO record VALUES (?)", (_RECORD,))
            times.append((time.perf_counter() - begun) * 1000)
    return times


def existing_part(folder: Path) -> Path:
    """Return the data folder, or what is there of the way to it."""
    folder = folder.absolute()
    return next(place for place in (folder, *folder.parents) if place.is_dir())


def _remove_stale(place: Path) -> None:
    """Clear what a look that was cut off has left; one that is under way is younger."""
    for left in place.glob(f"{_PREFIX}*"):
        if time.time() - left.stat().st_mtime > _STALE_S:
            shutil.rmtree(left, ignore_errors=True)


FORMS = "questionnaires"
_FORMS_REMEDY = "give it a new version; then the data set tells both apart"

_STORED = """
    SELECT content FROM source WHERE sha256 IN (
        SELECT about_you_source FROM session WHERE kind = 0
        UNION SELECT questionnaire_source FROM session WHERE kind = 0
    ) ORDER BY sha256
"""


def forms(folder: Path, plan: SessionConfig) -> Iterator[CheckResult]:
    """Find questionnaires that changed since people answered them, and have their version still."""
    stored = _stored(folder) if (folder / FILE).exists() else []
    changed = False
    for asked in (plan.about_you, *plan.questionnaires):
        older = (each for each in stored if (each.id, each.version) == (asked.id, asked.version))
        differ = dict.fromkeys(name for each in older for name in differences(asked, each))
        if differ:
            changed = True
            what = f"{asked.id!r} is still version {asked.version!r}, but visitors were asked otherwise before: "
            yield CheckResult.warning(FORMS, what + ", ".join(differ), _FORMS_REMEDY)
    if not changed:
        yield CheckResult.ok(FORMS, "nothing was changed without a new version")


def _stored(folder: Path) -> list[Questionnaire]:
    """Every questionnaire that is stored; the finding of the database says it if they cannot be read."""
    found: list[Questionnaire] = []
    try:
        with closing(open_for_reading(folder)) as connection:
            contents = [content for (content,) in connection.execute(_STORED)]
    except (UserInputError, sqlite3.Error):
        return found
    for content in contents:
        try:
            several = content.lstrip().startswith("[")
            found += QUESTIONNAIRES.validate_json(content) if several else [Questionnaire.model_validate_json(content)]
        except ValueError:
            # An older program wrote it, which asked in another form altogether.
            continue
    return found
