"""Kills the kiosk in the middle of rehearsed sessions, again and again, and looks at what is left each time.

``python -m tests.ui.kills --count 1000`` prints the count. Every kill is SIGKILL at a random moment of a stage, the
stages taken in turn; what the recorder had acknowledged until then must be in the database, its integrity check clean,
and the next start must show attract and have marked the session that was cut off.

One process has everything loaded and forks a kiosk for every line it reads, which saves a second each time.
"""

from __future__ import annotations

import json
import os
import signal
import sqlite3
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import IO, Any

import click
from rich.progress import track

from kiosk.config import STAGES, Settings
from kiosk.experiment.event_records import to_record
from kiosk.experiment.events import Event
from kiosk.experiment.outcomes import SessionKind
from kiosk.experiment.transitions import BEFORE_DECIDING
from kiosk.store.database import FILE
from kiosk.store.recorder import Provenance, Recorder
from kiosk.study.loader import read_study
from kiosk.ui.app import App
from kiosk.ui.condition_assigner import ConditionAssigner, RunContext
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from tests.patience import Program, limited, serving

GONE = "gone"
SMALL = Settings.model_validate(
    {"game": {"rows": 2, "columns": 4}, "practice": {"rows": 2, "columns": 2}, "randomisation": {"seed": 1}}
)
"""All the stages of the study, but small boards: kills are to be spread over the stages, not over one long game."""

LATEST = {"consent": 5, "about_you": 8, "practice": 10, "game": 40, "questions": 20}
LATEST_ELSEWHERE = 2
"""A kill comes at most so many reports after the first one of its stage; or with the first of the next stage."""


def main() -> None:
    """Fork a kiosk for every line that comes: a folder and a seed."""
    for line in sys.stdin:
        order = json.loads(line)
        kiosk = os.fork()
        if kiosk == 0:
            play(Path(order["folder"]), order["seed"])
            os._exit(0)
        os.waitpid(kiosk, 0)
        say(GONE, {})


def play(folder: Path, seed: int) -> None:
    """Open the kiosk, say what it shows, and rehearse; every event that was written is reported afterwards."""
    with Recorder(folder) as recorder:
        origin = RunContext("a test", kind=SessionKind.SIMULATED, seed=lambda: seed)
        app = App(
            RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL),
            recorder,
            ConditionAssigner(read_study(SMALL), recorder, origin),
        )
        say("open", {"pid": os.getpid(), "screen": app.screens.kiosk.shown, "recovered": list(recorder.recovered)})
        report_what_is_written(recorder)
        rehearsal = Rehearsal(app, seed)
        witness = app.runner.on_event

        def watch(*what: Any) -> None:
            if witness is not None:
                witness(*what)
            say("at", {"stage": what[2].value})

        app.runner.on_event = watch
        rehearsal.run()


def report_what_is_written(recorder: Recorder) -> None:
    """Acknowledge what the recorder has taken, once it has."""
    begin, append = recorder.begin, recorder.append

    def begun(provenance: Provenance, events: Sequence[Event]) -> Any:
        participant = begin(provenance, events)
        say("written", {"begun": True, "events": [to_record(event) for event in events]})
        return participant

    def appended(events: Sequence[Event]) -> None:
        append(events)
        say("written", {"events": [to_record(event) for event in events]})

    recorder.begin, recorder.append = begun, appended  # type: ignore[method-assign]


def say(what: str, more: dict[str, Any]) -> None:
    """Report it at once."""
    sys.stdout.write(json.dumps({"what": what} | more) + "\n")
    sys.stdout.flush()


@dataclass
class Killing:
    """One kiosk, up to its end, and what it had acknowledged."""

    opened: dict[str, Any] = field(default_factory=dict)
    written: list[dict[str, Any]] = field(default_factory=list)
    stage: str = "attract"
    finished: bool = False


def kill_in(stage: str, after: int, reports: Iterator[dict[str, Any]]) -> Killing:
    """Let the kiosk come to a stage, take ``after`` more reports, and kill it; or let it end, if it is done before."""
    killing, left, killed, reached = Killing(), after, False, False
    for report in reports:
        match report["what"]:
            case "open":
                killing.opened = report
            case "written" if not killed or not killing.finished:
                killing.written = report["events"] if "begun" in report else killing.written + report["events"]
            case "at":
                killing.stage = report["stage"]
            case "gone":
                killing.finished = not killed
                return killing
        reached = reached or killing.stage == stage
        left -= reached
        if reached and not killed and (left <= 0 or killing.stage != stage):
            os.kill(killing.opened["pid"], signal.SIGKILL)
            killed = True
    raise RuntimeError("the process that forks is gone")


def wrong_with(folder: Path, killing: Killing) -> str:
    """Return what is not as it should be in the database after a kill; empty if all is well."""
    with closing(sqlite3.connect(folder / FILE)) as database:
        if (found := database.execute("PRAGMA integrity_check").fetchall()) != [("ok",)]:
            return f"the integrity check says {found}"
        if not killing.written:
            return ""
        rows = database.execute(
            """
            SELECT seq, at_ms, type, payload FROM event
            WHERE session = (SELECT max(session) FROM event) AND origin != 'recovery' ORDER BY seq
            """
        ).fetchall()
    if [row[0] for row in rows] != list(range(1, len(rows) + 1)):
        return "numbers are missing"
    stored = [{"type": kind, "at_ms": at_ms} | json.loads(body) for _, at_ms, kind, body in rows]
    acknowledged = [dict(record) for record in killing.written]
    if stored[: len(acknowledged)] != acknowledged:
        return f"of {len(acknowledged)} acknowledged events {len(stored)} are there, or others"
    return ""


@contextmanager
def forker() -> Iterator[Program]:
    """Provide the process that has everything loaded."""
    command = [sys.executable, "-c", "from tests.ui.kills import main; main()"]
    environment = os.environ | {"QT_QPA_PLATFORM": "offscreen", "PYTHONUNBUFFERED": "1"}
    with serving(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment, bufsize=1
    ) as process:
        yield process


def reports_of(output: IO[str]) -> Iterator[dict[str, Any]]:
    """Yield what the kiosks report, as long as they do."""
    for line in output:
        yield json.loads(line)


@dataclass
class Tally:
    """What came of all the kills."""

    kills: Counter[str] = field(default_factory=Counter)
    acknowledged: int = 0
    faults: list[str] = field(default_factory=list)


def kill_again_and_again(count: int, seed: int, folder: Path) -> Tally:
    """So many kills, in one data folder; every start is also the restart after the kill before."""
    chance, tally = Random(seed), Tally()
    cut_off: bool = False
    with forker() as process:
        reports = reports_of(process.stdout)
        for number in track(range(count + 1), description="kills", disable=not sys.stderr.isatty()):
            stage = STAGES[number % len(STAGES)]
            with limited(process):
                process.stdin.write(json.dumps({"folder": str(folder), "seed": seed + number}) + "\n")
                process.stdin.flush()
                killing = kill_in(stage, chance.randint(1, LATEST.get(stage, LATEST_ELSEWHERE)), reports)
            tally.faults += [f"kill {number} in {stage}: {fault}" for fault in faults(folder, killing, cut_off=cut_off)]
            tally.kills[killing.stage] += not killing.finished
            tally.acknowledged += len(killing.written)
            ended = bool(killing.written) and killing.written[-1]["type"] == "SessionEnded"
            cut_off = bool(killing.written) and not ended
    return tally


def faults(folder: Path, killing: Killing, *, cut_off: bool) -> Iterator[str]:
    """Yield what is wrong with a start after a kill, and with what the next kill left."""
    if killing.opened.get("screen") != "attract":
        yield f"the kiosk came back at {killing.opened.get('screen')}"
    if cut_off and not killing.opened.get("recovered"):
        yield "the session that was cut off was not marked"
    if wrong := wrong_with(folder, killing):
        yield wrong


@click.command()
@click.option("--count", default=1000, show_default=True, help="How many kills.")
@click.option("--seed", default=1, show_default=True)
def command(count: int, seed: int) -> None:
    """Kill the kiosk so often, and print what came of it."""
    undecided = ", ".join(sorted(stage.value for stage in BEFORE_DECIDING))
    with TemporaryDirectory() as folder:
        tally = kill_again_and_again(count, seed, Path(folder))
    click.echo(f"{tally.kills.total()} kills: " + ", ".join(f"{stage} {n}" for stage, n in tally.kills.items()))
    click.echo(f"{tally.acknowledged} acknowledged events (none may be in {undecided}), {len(tally.faults)} faults")
    for fault in tally.faults:
        click.echo(f"  {fault}")
    sys.exit(bool(tally.faults))


if __name__ == "__main__":
    command()
