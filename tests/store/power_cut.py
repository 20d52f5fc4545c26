"""The power is cut while a booth writes: whatever was acknowledged is there, and the next start goes on.

``python -m tests.store.power_cut --cuts 1000`` (on Linux, as root) prints the counts. A writer does what a booth and
the people who look after it do, on an ext4 file system whose disk remembers the order of its writes and flushes. Then
the disk is put together as it may be after a cut at some point: with all that had been flushed, and any part of the
rest, torn between sectors. The file system mends itself as after a start of the machine, and Recollect is opened.
"""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

import click
from rich.progress import track

from kiosk.experiment.events import Event, SessionEnded, SessionStarted, SpeechFailed
from kiosk.experiment.experimenter import AuditEvent
from kiosk.experiment.outcomes import NotRecordedReason, SessionKind, Status
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.store.database import FILE, open_copy, open_for_reading
from kiosk.store.drives import carry
from kiosk.store.maintenance import back_up, list_backups
from kiosk.store.merge import merge
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.verify import Verification, verify
from kiosk.store.withdrawal import withdraw
from tests.patience import PATIENCE_S
from tests.samples import plan
from tests.store.recorded_disk import Entry, Kind, after_a_cut, make_image, mounted, read_log, recorded_disk

ROOT = Path(__file__).parents[2]
DISK_MIB = 48
KEPT = 1000
"""More copies than are made: none is deleted."""
BEGUN = (SessionStarted(at_ms=0),)
END = SessionEnded(at_ms=9, status=Status.COMPLETED)
KIND = SessionKind.SIMULATED
WITHDRAWAL = {Verification.FINISHED, Verification.WITHDRAWN, Verification.COPIES}
"""What ``verify`` may find after a cut within a withdrawal: that it is not finished."""


# What writes


class Writer:
    """A booth, and the people who look after it."""

    def __init__(self, disk: Path, acknowledged: Path, seed: int) -> None:
        """Write on a disk, and acknowledge into a file."""
        self._disk, self._data = disk, disk / "data"
        self._chance = Random(seed)
        self._seed = seed
        self._told = os.open(acknowledged, os.O_WRONLY)
        self._made = 0
        self._sessions: list[int] = []

    def work(self, rounds: int) -> None:
        """Open the booth so often, and look after the data in between."""
        cares: tuple[Callable[[], None], ...] = (
            *(self._back_up, self._carry, self._export, self._merge, self._withdraw),
        )
        for number in range(rounds):
            self._open_booth()
            cares[number % len(cares)]()
        os.close(self._told)

    def _tell(self, what: str, **more: Any) -> None:
        os.write(self._told, json.dumps({"what": what} | more).encode())

    def _open_booth(self) -> None:
        with Recorder(self._data) as recorder:
            for _ in range(self._chance.randint(1, 4)):
                self._one_visitor(recorder)

    def _one_visitor(self, recorder: Recorder) -> None:
        self._seed += 1
        provenance = Provenance(plan(), self._seed, "avatar", "abc123", kind=KIND)
        session = recorder.begin(provenance, BEGUN).session
        self._tell("events", session=session, events=1)
        said = self._chance.randint(1, 12)
        for events in range(2, 2 + said):
            recorder.append([self._words()])
            self._tell("events", session=session, events=events)
        if self._chance.random() < 0.2:
            self._tell("withdrawing", session=session)
            recorder.append_and_withdraw([SessionEnded(at_ms=9, status=Status.WITHDRAWN)])
            self._tell("withdrawn", session=session)
            return
        self._sessions.append(session)
        if self._chance.random() < 0.7:
            recorder.append([END])
            self._tell("events", session=session, events=said + 2)
        recorder.count_visit(NotRecordedReason.DECLINED, kind=KIND)
        self._tell("visit")
        recorder.add_audit_event(AuditEvent.CONDITION_CHOSEN.value, {"condition": "automatic", "reason": "a test"})
        self._tell("audit event")

    def _words(self) -> Event:
        return SpeechFailed(at_ms=1, utterance=1, why=self._chance.randbytes(self._chance.randint(50, 3000)).hex())

    def _back_up(self) -> None:
        back_up(self._data, self._data / "backups", keep=3)
        self._tell("copy")

    def _carry(self) -> None:
        copy = carry(self._data, self._disk / "stick", KEPT)
        self._tell("file", file=str(copy.file.relative_to(self._disk)), sha256=copy.sha256)

    def _export(self) -> None:
        out = self._place("data-set")
        export_dataset(self._data, out, PsychDs, frozenset(ExportOption))
        self._tell_files(out)

    def _merge(self) -> None:
        out = self._place("merged")
        merge([self._data], out)
        self._tell_files(out)

    def _withdraw(self) -> None:
        session = self._sessions.pop(self._chance.randrange(len(self._sessions)))
        self._tell("withdrawing", session=session)
        withdraw(self._data, session)
        self._tell("withdrawn", session=session)

    def _place(self, name: str) -> Path:
        self._made += 1
        return self._disk / f"{name}-{self._made}"

    def _tell_files(self, folder: Path) -> None:
        for file in sorted(each for each in folder.rglob("*") if each.is_file()):
            self._tell("file", file=str(file.relative_to(self._disk)), sha256=_sha256(file))


def _sha256(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


# What was acknowledged before a cut


@dataclass
class Promised:
    """What must be there."""

    events: dict[int, int] = field(default_factory=dict)
    """How many of each session."""
    withdrawing: set[int] = field(default_factory=set)
    withdrawn: set[int] = field(default_factory=set)
    visits: int = 0
    audit_events: int = 0
    copies: int = 0
    files: dict[str, str] = field(default_factory=dict)

    def hear(self, told: dict[str, Any]) -> None:
        """Take in one more acknowledgement."""
        match told:
            case {"what": "events", "session": session, "events": events}:
                self.events[session] = events
            case {"what": "withdrawing", "session": session}:
                self.withdrawing.add(session)
                # From here on they may be there or not.
                self.events.pop(session, None)
            case {"what": "withdrawn", "session": session}:
                self.withdrawn.add(session)
            case {"what": "visit"}:
                self.visits += 1
            case {"what": "audit event"}:
                self.audit_events += 1
            case {"what": "copy"}:
                self.copies += 1
            case {"what": "file", "file": file, "sha256": sha256}:
                self.files[file] = sha256


def faults(disk: Path, promised: Promised, tally: Counter[str]) -> Iterator[str]:
    """Yield what is wrong with a disk after a cut, and after the next start."""
    data = disk / "data"
    yield from _missing_files(disk, promised)
    if (data / FILE).exists() and (data / FILE).stat().st_size:
        under_way = promised.withdrawing - promised.withdrawn
        for flaw in verify(data):
            tally["withdrawals that verify called unfinished"] += flaw.check in WITHDRAWAL
            if not (flaw.check in WITHDRAWAL and (under_way or promised.withdrawn)):
                yield f"verify: {flaw.where}: {flaw.what}"
        yield from _missing_rows(data, promised)
    elif promised.events or promised.withdrawn:
        yield "there is no database"
    with Recorder(data) as recorder:
        tally["sessions that were cut off"] += len(recorder.recovered)
        for session in recorder.recovered[:1]:
            recorder.resume(session)
            recorder.append([END])
            tally["sessions that were gone on with"] += 1
        again = recorder.begin(Provenance(plan(), 0, "avatar", "abc123", kind=KIND), BEGUN).session
    yield from (f"verify after the start: {flaw.where}: {flaw.what}" for flaw in verify(data))
    yield from (f"after the start, {fault}" for fault in _missing_rows(data, promised))
    if again in promised.events or again in promised.withdrawn:
        yield f"the number {again} of a session was given out again"


def _missing_files(disk: Path, promised: Promised) -> Iterator[str]:
    for name, sha256 in promised.files.items():
        if not (disk / name).is_file():
            yield f"{name} is missing"
        elif _sha256(disk / name) != sha256:
            yield f"{name} is not what was written ({(disk / name).stat().st_size} bytes)"
    # A withdrawal replaces all copies by a fresh one, so that there is always one.
    copies = list_backups(disk / "data" / "backups")
    if promised.copies and not copies:
        yield "no copy is there"
    for file in copies:
        with closing(open_copy(file)) as copy:
            if copy.execute("PRAGMA integrity_check").fetchone()[0] != "ok":
                yield f"the copy {file.name} is not whole"


def _missing_rows(data: Path, promised: Promised) -> Iterator[str]:
    with closing(open_for_reading(data)) as connection:
        there = dict(connection.execute("SELECT session, count(*) FROM event GROUP BY session").fetchall())
        visits, audit_events = connection.execute(
            "SELECT (SELECT count(*) FROM visit), (SELECT count(*) FROM audit_event)"
        ).fetchone()
    for session, events in promised.events.items():
        if there.get(session, 0) < events:
            yield f"session {session}: of {events} acknowledged events {there.get(session, 0)} are there"
    yield from (f"session {session} was withdrawn and is back" for session in promised.withdrawn & there.keys())
    if visits < promised.visits or audit_events < promised.audit_events:
        yield f"of {promised.visits} visits and {promised.audit_events} notes {visits} and {audit_events} are there"


# The cuts


@dataclass
class Tally:
    """What came of it."""

    cuts: int = 0
    acknowledged: int = 0
    writes: int = 0
    flushes: int = 0
    faults: list[str] = field(default_factory=list)
    more: Counter[str] = field(default_factory=Counter)

    def __str__(self) -> str:
        """Return the counts in a line, and a line for every fault."""
        more = "".join(f", {number} {what}" for what, number in sorted(self.more.items()))
        line = (
            f"{self.cuts} cuts of {self.writes} writes and {self.flushes} flushes, "
            f"{self.acknowledged} acknowledgements{more}, {len(self.faults)} faults"
        )
        return "\n".join((line, *(f"  {fault}" for fault in self.faults)))


def record(folder: Path, rounds: int, seed: int) -> tuple[bytes, list[Entry]]:
    """Have a writer write; returns the empty disk and its log. Raises CalledProcessError where nothing is mounted."""
    image, log = folder / "image", folder / "log"
    make_image(image, DISK_MIB)
    with recorded_disk(image, folder, log) as (disk, acknowledged):
        order = json.dumps([str(disk), str(acknowledged), seed, rounds])
        command = [sys.executable, "-c", "from tests.store.power_cut import write; write()", order]
        subprocess.run(command, cwd=ROOT, check=True, timeout=PATIENCE_S)
    return image.read_bytes(), read_log(log)


def write() -> None:
    """Do what the first argument says, as a process of its own."""
    disk, acknowledged, seed, rounds = json.loads(sys.argv[1])
    Writer(Path(disk), Path(acknowledged), seed).work(rounds)


def cut_power(times: int, rounds: int, seed: int, folder: Path) -> Tally:
    """Cut the power at so many points of so many rounds of work."""
    chance, tally = Random(seed), Tally()
    empty, log = record(folder, rounds, seed)
    tally.writes = sum(entry.kind is Kind.WRITE for entry in log)
    tally.flushes = sum(entry.kind is Kind.FLUSH for entry in log)
    tally.acknowledged = sum(entry.kind is Kind.ACKNOWLEDGED for entry in log)
    disk, place = Disk(empty, log), folder / "after"
    points = cut_points(log, times, chance)
    for number, point in track(list(enumerate(points)), description="cuts", disable=not sys.stderr.isatty()):
        disk.go_on_to(point)
        # A new file each time: the loop device of the last one may still be there, and would show what it remembers.
        after = folder / f"after-{number}"
        after.write_bytes(after_a_cut(disk.flushed, disk.unflushed, chance))
        tally.cuts += 1
        with mounted(after, place):
            tally.faults += [f"cut {number} at {point}: {fault}" for fault in _looked_at(place, disk.promised, tally)]
        after.unlink()
    return tally


def cut_points(log: Sequence[Entry], times: int, chance: Random) -> list[int]:
    """Return after how many entries of a log the power is cut, in order.

    Half of the cuts come right after an acknowledgement, where most can be missing.
    """
    acknowledged = [number for number, entry in enumerate(log, 1) if entry.kind is Kind.ACKNOWLEDGED]
    end = acknowledged[-1]
    return sorted(
        chance.choice(acknowledged) if chance.random() < 0.5 else chance.randint(1, end) for _ in range(times)
    )


class Disk:
    """A disk as it was at a point of its log, and what had been acknowledged by then."""

    def __init__(self, empty: bytes, log: Sequence[Entry]) -> None:
        """Begin with an empty disk."""
        self.flushed = bytearray(empty)
        self.unflushed: list[Entry] = []
        self.promised = Promised()
        self._log, self._done = log, 0

    def go_on_to(self, point: int) -> None:
        """Take in the log up to a later point."""
        for entry in self._log[self._done : point]:
            match entry.kind:
                case Kind.WRITE:
                    self.unflushed.append(entry)
                case Kind.FLUSH:
                    for each in self.unflushed:
                        self.flushed[each.at : each.at + len(each.data)] = each.data
                    self.unflushed = []
                case Kind.ACKNOWLEDGED:
                    self.promised.hear(json.loads(entry.data))
        self._done = point


def _looked_at(place: Path, promised: Promised, tally: Tally) -> list[str]:
    found: list[str] = []
    try:
        found.extend(faults(place, promised, tally.more))
    except Exception as fault:  # noqa: BLE001 - whatever it is, it is a fault
        found.append(f"{type(fault).__name__}: {fault}")
    return found


@click.command()
@click.option("--cuts", default=1000, show_default=True, help="How many cuts.")
@click.option("--rounds", default=20, show_default=True, help="How often the booth is opened.")
@click.option("--seed", default=1, show_default=True)
def command(cuts: int, rounds: int, seed: int) -> None:
    """Cut the power so often, and print what came of it."""
    with TemporaryDirectory() as folder:
        tally = cut_power(cuts, rounds, seed, Path(folder))
    click.echo(tally)
    sys.exit(bool(tally.faults))


if __name__ == "__main__":
    command()
