"""A monkey in front of the kiosk as booths run it: ``python -m tests.ui.monkey [--minutes 30]``.

On a virtual screen with a window manager the supervisor runs the kiosk, and the monkey makes 50 inputs a second:
clicks, fingers, keys, the shortcuts that leave other programs and those of the experimenter, the right PIN among them.
Half of its presses go to places that led on before, so it comes through every stage. The robot fails in one way
after another, and the kiosk is killed at random moments, but not in the middle of the run, where the memory is
weighed. Some of the kills hit the supervisor. Prints what was seen and ends with 1 if anything was as it must not be.
Needs Xvfb and openbox.
"""

from __future__ import annotations

import csv
import json
import os
import queue
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from random import Random
from tempfile import mkdtemp
from time import monotonic, sleep
from typing import Any

import click
import psutil

from kiosk import UserInputError
from kiosk.cli.opening import LEFTOVER_S
from kiosk.experiment.experimenter import hash_pin
from kiosk.store.queries import open_repository
from kiosk.store.verify import verify
from tests.robots.furhat_fake import Mode
from tests.ui.exits.desktops import Desktop, x_server
from tests.ui.exits.hands import Devices
from tests.ui.fault_matrix import Robot
from tests.ui.monkey.kiosk import ANSWERS
from tests.ui.monkey.paws import Monkey
from tests.ui.monkey.verdict import BY_ITSELF, Seen, Weighed, slope_mib_per_hour, troubles

INPUTS_PER_S = 50
LOOK_S = 0.5
KILL_S = (15, 120)
"""A kill comes so long after the one before."""
ORPHAN_S = 2 * LEFTOVER_S
"""How long a kiosk may take to notice that its supervisor is gone, and to end, on a machine that is busy."""
SUPERVISORS = 0.2
"""How many of the kills hit the supervisor instead; it is started again at once, while the kiosk it had is to end."""
CALM = (0.35, 0.7)
"""The part of the run in which no kiosk is killed."""
ROBOT_S = (3, 25)
LONGEST_HELP_S = 90.0
"""A kiosk that is wedged for so long is killed, so that the rest of the run is still worth something."""
PIN = "482917"

STUDY = """
[game]
rows = 2
columns = 4
[practice]
rows = 2
columns = 2
[voice]
rate = 300
[timing]
mismatch_shown_ms = 300
finish_ms = 300
thanks_ms = 3000
[idle_ms]
pause = 20000
still_there = 10000
"""


@dataclass(frozen=True)
class Told:
    """What the supervisor told, and when."""

    at: float
    what: dict[str, Any]


class Booth:
    """A supervisor with its kiosk; started again where the kiosk was left, as a desktop would."""

    def __init__(self, folder: Path, environment: dict[str, str], robot: Robot) -> None:
        self.data = folder / "data"
        self.errors = folder / "errors"
        study = folder / "study.toml"
        study.write_text(f'{STUDY}[experimenter]\npin_hash = "{hash_pin(PIN, bytes(range(16)))}"\n')
        self._command = [sys.executable, "-m", "tests.ui.monkey.kiosk", str(folder)]
        self._command += ["run", "--supervise", "--json", "--data", str(self.data), "--study", str(study)]
        self._command += ["--robot-host", "127.0.0.1", "--robot-port", str(robot.port)]
        self._environment = environment
        self.told: queue.SimpleQueue[Told] = queue.SimpleQueue()
        self.process = self._start()

    def see_to(self) -> bool:
        """Start it again if it has ended; returns whether it had."""
        if self.process.poll() is None:
            return False
        self.process = self._start()
        return True

    def kiosks(self) -> list[psutil.Process]:
        """Return the processes of kiosks that run on this data, also those that a supervisor left behind."""
        found = []
        for process in psutil.process_iter():
            with suppress(psutil.Error):
                words = process.cmdline()
                if "--unattended" in words and str(self.data) in words and process.status() != psutil.STATUS_ZOMBIE:
                    found.append((process, process.ppid()))
        # A program that a kiosk starts has the kiosk's own command line for a moment.
        numbers = {process.pid for process, _ in found}
        return [process for process, parent in found if parent not in numbers]

    def end(self) -> None:
        """Ask the supervisor to end, and see that it does."""
        self.process.terminate()
        self.process.wait(30)

    def _start(self) -> subprocess.Popen[str]:
        with self.errors.open("a") as errors:
            process = subprocess.Popen(
                self._command, env=self._environment, stdout=subprocess.PIPE, stderr=errors, text=True
            )
        threading.Thread(target=self._read, args=[process], daemon=True).start()
        return process

    def _read(self, process: subprocess.Popen[str]) -> None:
        assert process.stdout is not None
        for line in process.stdout:
            self.told.put(Told(monotonic(), json.loads(line)))
        self.told.put(Told(monotonic(), {"what": "gone", "detail": ""}))


class Watcher:
    """Takes note of all that is seen."""

    def __init__(self, booth: Booth, folder: Path, calm: tuple[float, float]) -> None:
        self.calm = calm
        self.seen = Seen()
        self.shown = ""
        self.booth = booth
        self._answers = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK)
        self._answers.bind(str(folder / ANSWERS))
        self._began = monotonic()
        self._up = False
        self._stage = ""
        self._orphaned_at = -ORPHAN_S
        self._lost_at: float | None = monotonic()
        self._answered_at = monotonic()

    def look(self, monkey: Monkey) -> None:
        """Take in what has come meanwhile."""
        with suppress(BlockingIOError):
            while True:
                event, stage = self._answers.recv(256).decode().rsplit(" ", 1)
                self.seen.answers[event] += 1
                if stage != self._stage:
                    self._stage = stage
                    self.seen.stages[stage] += 1
                if event not in BY_ITSELF:
                    self._answered()
                monkey.learn(self.shown, event)
        with suppress(queue.Empty):
            while True:
                self._hear(self.booth.told.get_nowait())

    def weigh(self) -> None:
        """Count and weigh the processes."""
        kiosks = self.booth.kiosks()
        if monotonic() - self._orphaned_at > ORPHAN_S:
            self.seen.most_kiosks = max(self.seen.most_kiosks, len(kiosks))
        for of, process in (("kiosk", kiosks[:1]), ("supervisor", [psutil.Process(self.booth.process.pid)])):
            with suppress(psutil.Error):
                for each in process:
                    mib = each.memory_info().rss / 2**20
                    self.seen.weights[of].append(Weighed(monotonic() - self._began, each.pid, mib))

    def lose_supervisor(self) -> None:
        """Kill the supervisor, and expect its kiosk to go by itself."""
        self.booth.process.kill()
        self.seen.supervisors_killed += 1
        self._orphaned_at = monotonic()

    def silent_s(self) -> float:
        """Return for how long a kiosk that is up has answered nothing, and remember the longest."""
        silent = monotonic() - self._answered_at if self._up else 0.0
        self.seen.longest_silence_s = max(self.seen.longest_silence_s, silent)
        return silent

    def away_s(self) -> float:
        """Return for how long no kiosk has been up."""
        return 0.0 if self._lost_at is None else monotonic() - self._lost_at

    def close(self) -> None:
        """Hear no more."""
        self._answers.close()

    def _answered(self) -> None:
        self.silent_s()
        self._answered_at = monotonic()

    def _hear(self, told: Told) -> None:
        kind, detail = told.what["what"], told.what["detail"]
        match kind:
            case "ready":
                if self._lost_at is not None:
                    self.seen.longest_away_s = max(self.seen.longest_away_s, told.at - self._lost_at)
                self._up, self._lost_at = True, None
                self._answered_at = told.at
            case "shows":
                self.shown = detail
                self.seen.screens[detail] += 1
                self._answered()
            case "died" | "hung" | "swelled" | "left" | "refused" | "gone":
                self.seen.ends[f"{kind} {detail}".strip()] += kind != "gone"
                self._up = False
                self._lost_at = self._lost_at or told.at


def watch(minutes: float, seed: int, folder: Path, *, kills: bool = True) -> Seen:
    """Let the monkey loose; returns what was seen."""
    robot = Robot("--mode", "well", "--seed", str(seed))
    try:
        with x_server(Desktop.SHIPPED) as environment, booth_in(folder, environment, robot) as booth:
            watcher = Watcher(booth, folder, CALM if kills else (0, 1))
            with closing(watcher), closing(Monkey(Devices(environment["DISPLAY"]), folder, PIN, seed)) as monkey:
                _play(minutes * 60, Random(seed), watcher, monkey, robot)
            booth.end()
    finally:
        robot.close()
    seen = watcher.seen
    seen.inputs = monkey.inputs
    for file in (booth.errors, *booth.data.glob("recollect.log*")):
        seen.in_log += troubles(file.read_text(errors="replace"))
    seen.flaws = [f"{each.where}: {each.what}" for each in verify(booth.data)]
    return seen


def _play(for_s: float, chance: Random, watcher: Watcher, monkey: Monkey, robot: Robot) -> None:
    booth = watcher.booth
    began = monotonic()
    look_at = robot_at = 0.0
    kill_at = chance.uniform(*KILL_S)
    acted = 0
    while (now := monotonic() - began) < for_s:
        watcher.look(monkey)
        if now >= look_at:
            look_at = now + LOOK_S
            watcher.weigh()
            watcher.seen.left += booth.see_to()
            _help(watcher, now)
        if now >= robot_at:
            robot_at = now + chance.uniform(*ROBOT_S)
            mode = chance.choice([*Mode, Mode.WELL, Mode.WELL])
            robot.fall_into(mode)
            watcher.seen.robot[mode.name.lower()] += 1
        if now >= kill_at:
            kill_at = now + chance.uniform(*KILL_S)
            if not watcher.calm[0] <= now / for_s <= watcher.calm[1]:
                if chance.random() < SUPERVISORS:
                    watcher.lose_supervisor()
                else:
                    watcher.seen.kills += _kill(booth)
        # A machine that is too slow does not have it all made up for at once.
        acted = max(acted, int((now - 1) * INPUTS_PER_S))
        if acted < now * INPUTS_PER_S:
            monkey.act(watcher.shown)
            acted += 1
        else:
            sleep(1 / INPUTS_PER_S / 4)


def _kill(booth: Booth) -> bool:
    for kiosk in booth.kiosks():
        with suppress(ProcessLookupError):
            os.kill(kiosk.pid, signal.SIGKILL)
            return True
    return False


def _help(watcher: Watcher, now: float) -> None:
    """Note a wedge, and end it."""
    if max(watcher.silent_s(), watcher.away_s()) > LONGEST_HELP_S:
        watcher.seen.stuck.append(f"after {now:.0f} s it was wedged at {watcher.shown!r} and had to be killed")
        if not _kill(watcher.booth):
            watcher.booth.process.kill()


@contextmanager
def booth_in(folder: Path, environment: dict[str, str], robot: Robot) -> Iterator[Booth]:
    """Provide a booth that is ended whatever happens."""
    booth = Booth(folder, environment, robot)
    try:
        yield booth
    finally:
        if booth.process.poll() is None:
            booth.end()


def lines(seen: Seen, data: Path) -> Iterator[str]:
    """Yield what was seen, for people."""
    with suppress(UserInputError), open_repository(data) as stored:
        statuses = [str(each.status.value if each.status else None) for each in stored.sessions()]
        yield "sessions: " + _counts({each: statuses.count(each) for each in sorted({*statuses})})
    yield f"inputs: {sum(seen.inputs.values())} ({_counts(seen.inputs)})"
    yield f"stages: {_counts(seen.stages)}"
    yield f"screens: {_counts(seen.screens)}"
    yield f"handled: {_counts(seen.answers)}"
    yield f"robot: {_counts(seen.robot)}"
    yield f"kills: {seen.kills}, and of supervisors {seen.supervisors_killed}; ends: {_counts(seen.ends)}"
    yield f"supervisors started again: {seen.left}"
    yield f"longest without an answer {seen.longest_silence_s:.1f} s, longest away {seen.longest_away_s:.1f} s"
    yield f"most kiosks at once: {seen.most_kiosks}"
    for of, weighed in seen.weights.items():
        slope = slope_mib_per_hour(weighed)
        told = "it did not last" if slope is None else f"{slope:+.1f} MiB an hour"
        yield f"{of}: {told}, at most {max(each.mib for each in weighed):.0f} MiB, {len(weighed)} looks"
    faults = list(seen.faults())
    yield f"{len(faults)} faults"
    yield from (f"  {fault}" for fault in faults)


def _counts(counter: dict[str, int]) -> str:
    return ", ".join(f"{what} {number}" for what, number in sorted(counter.items(), key=lambda each: -each[1]))


@click.command()
@click.option("--minutes", default=30.0, show_default=True)
@click.option("--seed", default=1, show_default=True)
@click.option("--kills/--no-kills", default=True, show_default=True, help="Whether the kiosk is killed at times.")
def command(minutes: float, seed: int, *, kills: bool) -> None:
    """Let a monkey loose on the kiosk, and print what came of it."""
    if Desktop.SHIPPED.missing:
        sys.exit(f"{', '.join(Desktop.SHIPPED.missing)} is missing")
    folder = Path(mkdtemp(prefix="monkey-"))
    seen = watch(minutes, seed, folder, kills=kills)
    for line in lines(seen, folder / "data"):
        click.echo(line)
    with (folder / "memory.csv").open("w") as file:
        rows = [(of, each.process, each.at_s, each.mib) for of in seen.weights for each in seen.weights[of]]
        csv.writer(file).writerows([("of", "process", "at_s", "mib"), *rows])
    click.echo(f"all of it is in {folder}")
    sys.exit(any(seen.faults()))


if __name__ == "__main__":
    command()
