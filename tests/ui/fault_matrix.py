"""Every fault at every moment, each in a session of its own: ``python -m tests.ui.fault_matrix [--seeds 2]``.

The robot is a process of its own and the deadlines are the study's. Prints one line per session, and ends with 1 if
anything was as it must not be. Takes some minutes.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import AbstractContextManager
from pathlib import Path
from random import Random

import click

from kiosk.cli.composition import read_settings
from kiosk.store.queries import open_repository
from kiosk.ui.app import App
from tests.patience import Program, limited
from tests.robots.furhat_fake import FAULTS
from tests.robots.furhat_fake import Mode as Fault
from tests.ui.headless import headless
from tests.ui.sabotage import Moment, Result, Sabotage, replayed, result_of

CLICKS = 60
"""A session has about so many clicks."""


class Robot:
    """A fake robot in a process of its own."""

    def __init__(self, *arguments: str) -> None:
        self._process = Program(
            [sys.executable, "-m", "tests.robots.furhat_fake", "--character-ms", "1", *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        with limited(self._process):
            self.port = int(self._process.stdout.readline())

    def fall_into(self, mode: Fault) -> None:
        """Have it answer so from now on."""
        self._process.stdin.write(f"{mode.name}\n")
        self._process.stdin.flush()

    def close(self) -> None:
        """End the process."""
        with limited(self._process):
            self._process.communicate()


def kiosk_with_robot(port: int, data: Path) -> AbstractContextManager[App]:
    """Return a kiosk without a screen, with the robot on this port."""
    return headless(read_settings(None, "127.0.0.1", port), data)


def session(app: App, data: Path, robot: Robot, fault: Fault, at: int | Moment) -> Result:
    """One session with one fault."""
    rehearsal = Sabotage(app, 1, lambda: robot.fall_into(fault), at)
    rehearsal.run()
    with open_repository(data) as stored:
        result = result_of(stored, rehearsal)
        assert replayed(stored, result.session.id) == result.events
    return result


def planned(seeds: int) -> Iterator[tuple[Fault, int | Moment]]:
    """Every fault in every stage and at random moments; and a robot that is well."""
    yield Fault.WELL, 1
    for fault in FAULTS:
        yield from ((fault, moment) for moment in Moment)
        yield from ((fault, Random(f"{fault.name}/{seed}").randint(1, CLICKS)) for seed in range(seeds))


def line(fault: Fault, at: int | Moment, result: Result) -> str:
    """Return a session in one line."""
    counted = result.utterances
    return (
        f"{fault.value:27} {at.value if isinstance(at, Moment) else f'click {at}':19} "
        f"{result.session.status.value if result.session.status else 'running'}, changes {result.embodiment_changes}, "
        f"requested {counted.requested:2}, finished {counted.finished:2}, failed {counted.failed}, "
        f"shown only {counted.shown_only}, longest gap {result.longest_gap_ms:5.1f} ms: {result.faults() or 'well'}"
    )


def main() -> int:
    """Play them all."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeds", type=int, default=2, help="random moments for each fault")
    seeds = parser.parse_args().seeds
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for number, (fault, at) in enumerate(planned(seeds)):
            robot, data = Robot(), Path(folder) / str(number)
            with kiosk_with_robot(robot.port, data) as app:
                results.append(session(app, data, robot, fault, at))
            robot.close()
            click.echo(line(fault, at, results[-1]))
    wrong = sum(bool(result.faults()) for result in results)
    gaps = sorted(result.longest_gap_ms for result in results)
    click.echo(
        f"{len(results)} sessions, {wrong} with something wrong; longest gap of the event loop:"
        f" median {gaps[len(gaps) // 2]:.1f} ms, worst {gaps[-1]:.1f} ms"
    )
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
