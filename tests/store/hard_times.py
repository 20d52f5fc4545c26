"""Kills inside checkpoints, full disks, and opens beside a writer: nothing is refused, and nothing is lost.

``python -m tests.store.hard_times`` prints the counts of all three; ``--kills``, ``--disks`` and ``--opens`` say how
many. The kills need Linux; the disks are small file systems in memory, which only root may mount.

A kill is aimed: the writer limits the size of its files to a page that the checkpoint is going to write, so the system
kills it there, with the pages before it written and the others not.
"""

from __future__ import annotations

import json
import os
import resource
import signal
import sqlite3
import subprocess
import sys
import threading
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass, field
from datetime import datetime
from itertools import count
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

import click
from rich.progress import track

from kiosk import DISK_FULL, StorageError, program
from kiosk.experiment.events import Event, SessionStarted, SpeechFailed
from kiosk.experiment.outcomes import SessionKind
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.preflight import Severity
from kiosk.store.checks import database_check
from kiosk.store.database import FILE, open_for_reading
from kiosk.store.maintenance import back_up
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Provenance, Recorder
from kiosk.store.snapshot import read_snapshot
from kiosk.store.verify import verify
from tests.patience import PATIENCE_S, Program, end_all, limited, serving, started
from tests.samples import plan
from tests.store.visitors import COMPLETED

ROOT = Path(__file__).parents[2]
PAGE = 4096
WAL_HEADER, FRAME_HEADER = 32, 24
FOLDERS_OF = 10
"""So many kills in a row strike one data folder."""

DISK_MIB = 3
BEGUN = (SessionStarted(at_ms=0),)
ENDED = "ended"


# What a writer does, in a process of its own


def work() -> None:
    """Fork a writer for every line that comes, and say how each one ended."""
    for line in sys.stdin:
        order = json.loads(line)
        writer = os.fork()
        if writer == 0:
            _ACTIONS[order.pop("action")](**order)
            os._exit(0)
        _, status = os.waitpid(writer, 0)
        say(ENDED, signal=os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0)


def say(what: str, **more: Any) -> None:
    """Report it at once."""
    sys.stdout.write(json.dumps({"what": what} | more) + "\n")
    sys.stdout.flush()


def words(chance: Random) -> Event:
    """Something that takes room."""
    return SpeechFailed(at_ms=1, utterance=1, why=chance.randbytes(chance.randint(50, 3000)).hex())


def begin(recorder: Recorder, seed: int) -> int:
    """Begin a session and acknowledge it."""
    session = recorder.begin(Provenance(plan(), seed, "avatar", "abc123", kind=SessionKind.SIMULATED), BEGUN).session
    say("written", session=session, events=len(BEGUN))
    return session


def append(recorder: Recorder, session: int, chance: Random, written: int) -> int:
    """Go on with it, acknowledge that, and return how many events it has."""
    recorder.append([words(chance)])
    say("written", session=session, events=written + 1)
    return written + 1


def die_in_a_checkpoint(folder: str, seed: int) -> None:
    """Write a session, and be killed by the system at some page of the checkpoint that closing makes."""
    chance = Random(seed)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with Recorder(Path(folder)) as recorder:
        session, written = begin(recorder, seed), len(BEGUN)
        for _ in range(chance.randint(1, 30)):
            written = append(recorder, session, chance, written)
        # The first page comes first, so that anything later is in the middle.
        page = chance.choice(logged_pages(Path(folder, f"{FILE}-wal"))[1:])
        # Python ignores this signal by default.
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_FSIZE, ((page - 1) * PAGE, resource.RLIM_INFINITY))


def logged_pages(log: Path) -> list[int]:
    """Return the numbers of the pages in a write-ahead log, in the order of a checkpoint."""
    content = log.read_bytes()
    starts = range(WAL_HEADER, len(content), FRAME_HEADER + PAGE)
    return sorted({int.from_bytes(content[start : start + 4]) for start in starts})


def fill_the_disk(folder: str, seed: int, *, killed: bool) -> None:
    """Write until the disk takes no more, and be killed there or close."""
    chance = Random(seed)
    with Recorder(Path(folder)) as recorder:
        session, written = begin(recorder, seed), len(BEGUN)
        try:
            while True:
                written = append(recorder, session, chance, written)
        except StorageError as failure:
            say("failed", words=str(failure))
        if killed:
            os.kill(os.getpid(), signal.SIGKILL)


def write_and_checkpoint(folder: str, seed: int) -> None:
    """Write without end: with a checkpoint after every few events, and a recorder that comes and goes."""
    chance = Random(seed)
    for number in count(seed):
        with Recorder(Path(folder)) as recorder:
            session, written = begin(recorder, number), len(BEGUN)
            for _ in range(chance.randint(1, 20)):
                written = append(recorder, session, chance, written)
                if chance.random() < 0.5:
                    kind = chance.choice(("PASSIVE", "FULL", "RESTART", "TRUNCATE"))
                    recorder._connection.execute(f"PRAGMA wal_checkpoint({kind})")
            recorder.append(COMPLETED[1:])


_ACTIONS: dict[str, Callable[..., None]] = {
    "die": die_in_a_checkpoint,
    "fill": fill_the_disk,
    "write": write_and_checkpoint,
}


# What is looked at from outside


@dataclass
class Tally:
    """What came of it."""

    times: int = 0
    acknowledged: int = 0
    faults: list[str] = field(default_factory=list)
    more: Counter[str] = field(default_factory=Counter)

    def __str__(self) -> str:
        """Return the counts in a line, and a line for every fault."""
        more = "".join(f", {number} {what}" for what, number in sorted(self.more.items()))
        line = f"{self.times} times, {self.acknowledged} acknowledged events{more}, {len(self.faults)} faults"
        return "\n".join((line, *(f"  {fault}" for fault in self.faults)))


class Worker:
    """The process that has everything loaded and forks."""

    def __init__(self, process: Program) -> None:
        """Talk to this process."""
        self._process = process

    def order(self, action: str, **more: Any) -> None:
        """Have a writer forked."""
        self._process.stdin.write(json.dumps({"action": action} | more) + "\n")
        self._process.stdin.flush()

    def end(self) -> None:
        """End it with all that it has forked; nothing more is heard."""
        end_all(self._process)

    def hear(self) -> Iterator[dict[str, Any]]:
        """Yield what the writer reports, up to its end."""
        while True:
            with limited(self._process):
                line = self._process.stdout.readline()
            if not line:
                return
            report = json.loads(line)
            yield report
            if report["what"] == ENDED:
                return


@contextmanager
def worker() -> Iterator[Worker]:
    """Start it, and end it with all that it has forked."""
    command = [sys.executable, "-c", "from tests.store.hard_times import work; work()"]
    with serving(command, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        yield Worker(process)


def kills(times: int, seed: int, place: Path) -> Tally:
    """Kill a writer inside a checkpoint, again and again."""
    tally = Tally()
    with worker() as writers:
        for number in track(range(times), description="kills", disable=not sys.stderr.isatty()):
            folder = place / f"data-{number // FOLDERS_OF}"
            writers.order("die", folder=str(folder), seed=seed + number)
            reports = list(writers.hear())
            written = {report["session"]: report["events"] for report in reports if report["what"] == "written"}
            tally.times += 1
            tally.acknowledged += sum(written.values())
            tally.more["killed inside"] += reports[-1]["signal"] == signal.SIGXFSZ
            tally.more["that only the log makes whole"] += not whole_without_log(folder)
            tally.faults += [f"kill {number}: {fault}" for fault in faults(folder, written, place / f"out-{number}")]
    return tally


def whole_without_log(folder: Path) -> bool:
    """Return whether the database would do if its log were ignored."""
    connection = sqlite3.connect(f"{(folder / FILE).as_uri()}?mode=ro&immutable=1", uri=True)
    try:
        answer: str = connection.execute("PRAGMA quick_check(1)").fetchone()[0]
    except sqlite3.DatabaseError:
        return False
    finally:
        connection.close()
    return answer == "ok"


def faults(folder: Path, written: dict[int, int], out: Path) -> Iterator[str]:
    """Return what is wrong with a data folder after its writer's end, and with what a new one makes of it."""
    looks: dict[str, Callable[[], object]] = {
        "verify": lambda: refuse_any(verify(folder)),
        "sessions": lambda: compare(folder, written),
        "glance": lambda: read_snapshot(folder, datetime.now().astimezone(), kind=SessionKind.SIMULATED),
        "check": lambda: refuse_any(
            [each for each in database_check(folder, busy=False) if each.severity is Severity.ERROR]
        ),
        "backup": lambda: back_up(folder, out / "copies"),
        "export": lambda: export_dataset(folder, out / "data-set", PsychDs, frozenset(ExportOption)),
        "open": lambda: Recorder(folder).__exit__(None, None, None),
        "verify again": lambda: refuse_any(verify(folder)),
        "sessions again": lambda: compare(folder, written),
    }
    for name, look in looks.items():
        try:
            look()
        except Exception as fault:  # noqa: BLE001 - whatever it is, it is a fault
            yield f"{name}: {type(fault).__name__}: {fault}"


def refuse_any(found: list[Any]) -> None:
    """Raise AssertionError if anything was found."""
    assert not found, found


def compare(folder: Path, written: dict[int, int]) -> None:
    """Raise AssertionError if an event is not there that was acknowledged."""
    with open_repository(folder) as stored:
        for session, events in written.items():
            there = len(stored.events(session))
            assert there >= events, f"of {events} acknowledged events {there} are there"


def opens(times: int, seed: int, place: Path) -> Tally:
    """Open a database again and again for reading while a writer makes one checkpoint after another."""
    tally, folder = Tally(), place / "data"
    Recorder(folder).__exit__(None, None, None)
    last: dict[str, Any] = {}
    heard = threading.Event()
    with worker() as writers:
        writers.order("write", folder=str(folder), seed=seed)

        def hear() -> None:
            for report in writers.hear():
                last.update(report if "events" in report else {})
                tally.acknowledged += "events" in report
                heard.set()

        # A pipe that is full would hold up the writer.
        listener = threading.Thread(target=hear, daemon=True)
        listener.start()
        assert heard.wait(PATIENCE_S), "the writer wrote nothing"
        for number in track(range(times), description="opens", disable=not sys.stderr.isatty()):
            tally.times += 1
            tally.faults += [f"open {number}: {fault}" for fault in wrong_with_an_open(folder, dict(last))]
        writers.end()
        listener.join(PATIENCE_S)
    return tally


def wrong_with_an_open(folder: Path, last: dict[str, Any]) -> Iterator[str]:
    """Return the false alarm, if there is one, or that events are missing."""
    try:
        with closing(open_for_reading(folder)) as connection:
            query = "SELECT count(*) FROM event WHERE session = ?"
            there = connection.execute(query, (last["session"],)).fetchone()[0]
    except Exception as fault:  # noqa: BLE001 - whatever it is, it is a false alarm
        yield f"{type(fault).__name__}: {fault}"
    else:
        if there < last["events"]:
            yield f"of {last['events']} acknowledged events {there} are there"


# Full disks


@contextmanager
def small_disk(place: Path) -> Iterator[Path]:
    """Provide a file system of some MiB; raises CalledProcessError for those who may not mount one."""
    place.mkdir()
    subprocess.run(
        ["mount", "-t", "tmpfs", "-o", f"size={DISK_MIB}m,mode=700", "tmpfs", place],  # noqa: S607 - the system's own
        check=True,
        capture_output=True,
        timeout=PATIENCE_S,
    )
    try:
        yield place
    finally:
        subprocess.run(["umount", "-l", place], check=True, timeout=PATIENCE_S)  # noqa: S607 - the system's own


def full_disks(times: int, seed: int, place: Path, *, commands: bool = True) -> Tally:
    """Let a disk run full under a writer, look at what every command says, make room, and go on."""
    tally = Tally()
    with worker() as writers:
        for number in track(range(times), description="full disks", disable=not sys.stderr.isatty()):
            with small_disk(place / f"disk-{number}") as disk:
                tally.times += 1
                found = list(full_disk(writers, disk, seed + number, tally, commands=commands))
            tally.faults += [f"disk {number}: {fault}" for fault in found]
    return tally


def full_disk(writers: Worker, disk: Path, seed: int, tally: Tally, *, commands: bool) -> Iterator[str]:
    """Return what goes wrong with one full disk, and after there is room again."""
    chance, folder, out = Random(seed), disk / "data", disk.with_name(f"out-{disk.name}")
    ballast = disk / "ballast"
    with Recorder(folder) as recorder:
        participant = recorder.begin(
            Provenance(plan(), seed, "avatar", "abc123", kind=SessionKind.SIMULATED), COMPLETED
        )
    back_up(folder, folder / "backups")
    # What is removed later must leave room for a checkpoint of all that the writer has logged.
    ballast.write_bytes(bytes(chance.randrange(DISK_MIB << 19, (DISK_MIB + 1) << 19)))
    writers.order("fill", folder=str(folder), seed=seed, killed=bool(seed % 2))
    reports = list(writers.hear())
    written = {report["session"]: report["events"] for report in reports if report["what"] == "written"}
    tally.acknowledged += sum(written.values())
    tally.more["times that a full disk was named"] += sum(DISK_FULL in each.get("words", "") for each in reports)
    yield from (f"the writer said {each['words']}" for each in reports if DISK_FULL not in each.get("words", DISK_FULL))
    fill(disk / "the-last-bytes")
    for remedy in (each.remedy for each in database_check(folder, busy=False)):
        if "--data" in remedy or "backups" in remedy:
            yield f"the remedy is {remedy}"
    for fault in faults(folder, written, out):
        tally.more["times that a full disk was named"] += DISK_FULL in fault
        if DISK_FULL not in fault:
            yield f"while it was full, {fault}"
    if commands:
        yield from (f"while it was full, {fault}" for fault in said_by_commands(folder, disk, participant.code, tally))
    (disk / "the-last-bytes").unlink()
    ballast.unlink()
    yield from (f"after there was room, {fault}" for fault in faults(folder, written, out / "after"))


def fill(file: Path) -> None:
    """Take all the room that is left."""
    with suppress(OSError), file.open("wb", buffering=0) as taken:
        while True:
            taken.write(bytes(512))


def said_by_commands(folder: Path, disk: Path, code: str, tally: Tally) -> Iterator[str]:
    """Return which commands neither do their work on a full disk nor say that it is full."""
    data = ("--data", str(folder))
    for command in (
        ("sessions", *data),
        ("verify", *data),
        ("events", "1", *data),
        ("backup", *data),
        ("backup", *data, "--to", str(disk / "copies")),
        ("export", *data, "--with-rehearsals", "--with-unshared", "--out", str(disk / "data-set")),
        ("merge", str(folder), "--out", str(disk / "merged")),
        ("withdraw", code, "--yes", *data),
        ("rehearse", "--headless", *data),
        ("run", "--window", *data),
    ):
        done = run(command)
        tally.more["commands that named a full disk"] += DISK_FULL in done.stderr
        if not (done.returncode == 0 or (done.returncode == 1 and DISK_FULL in done.stderr)):
            yield f"{command[0]} ended with {done.returncode} and said {done.stderr.strip()!r}"


def run(command: tuple[str, ...]) -> subprocess.CompletedProcess[str]:
    """Run a command; a kiosk that opens all the same is closed as the system closes it."""
    environment = os.environ | {"QT_QPA_PLATFORM": "offscreen"}
    with started(
        program(*command), env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        try:
            out, err = process.communicate(timeout=10 if command[0] == "run" else 60)
        except subprocess.TimeoutExpired:
            process.terminate()
            out, err = process.communicate()
        return subprocess.CompletedProcess(command, process.returncode, out, err)


@click.command()
@click.option("--kills", "killed", default=200, show_default=True, help="How many kills inside checkpoints.")
@click.option("--disks", default=20, show_default=True, help="How many full disks.")
@click.option("--opens", "opened", default=20_000, show_default=True, help="How many opens beside a writer.")
@click.option("--seed", default=1, show_default=True)
def command(killed: int, disks: int, opened: int, seed: int) -> None:
    """Do all of it, and print what came of it."""
    wrong = False
    for name, times, what in (("kills", killed, kills), ("full disks", disks, full_disks), ("opens", opened, opens)):
        with TemporaryDirectory() as place:
            tally = what(times, seed, Path(place))
        click.echo(f"{name}: {tally}")
        wrong = wrong or bool(tally.faults)
    sys.exit(wrong)


if __name__ == "__main__":
    command()
