"""Every way to lose the kiosk, in every stage: ``python -m tests.ui.revival [--stages attract,game]``.

On a virtual screen with a window manager the supervisor runs the kiosk, a visitor plays up to the stage, and the fault
strikes. Prints the seconds until the kiosk shows attract again, as one line (or with --json one object) per fault, with
what the visitor saw meanwhile and what the database says of the session; ends with 1 if anything took longer than
TEN seconds or is not as it must be. Needs Xvfb, openbox and ImageMagick's import; takes some minutes.
"""

from __future__ import annotations

import argparse
import json
import os
import queue
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import click

from kiosk import config
from kiosk.experiment.outcomes import Status
from kiosk.experiment.transitions import BEFORE_DECIDING
from kiosk.store.queries import open_repository
from kiosk.ui.session_runner import ERROR_SCREEN_MS
from tests.patience import PATIENCE_S, Program, limited, started
from tests.samples import WITH_PIN

STAGES = ("attract", *(stage for stage in config.STAGES))
WAYS = {"about_you": ("form",), "questions": ("result", "form")}
"""The screens that tell that a stage has come, where they are not called like it."""
BEFORE_ANYTHING_IS_KEPT = {"attract", *(stage.value for stage in BEFORE_DECIDING)}
LONGEST_S = 10.0
UNTIL_STAGE_S = 240.0
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
mismatch_shown_ms = 100
finish_ms = 100
"""
"""No one has to follow what happens, so that a session takes half a minute."""
STOPPED_S = 60.0
"""How long a stopped kiosk would stay stopped."""


def _to_group(signal_number: signal.Signals) -> Callable[[int], None]:
    return lambda kiosk: os.kill(kiosk, signal_number)


FAULTS: dict[str, Callable[[int], None]] = {
    "killed": _to_group(signal.SIGKILL),
    "stopped": _to_group(signal.SIGSTOP),
    "aborted": _to_group(signal.SIGABRT),
    "endless loop": _to_group(signal.SIGUSR2),
    "exception": _to_group(signal.SIGUSR1),
}
"""What strikes the process of the kiosk."""
MENDED_INSIDE = {"exception"}
"""What the kiosk itself answers with its own error screen, without being started again."""
CALM_S = ERROR_SCREEN_MS / 1000 + 1


@dataclass(frozen=True)
class Revival:
    """What came of one fault."""

    stage: str
    fault: str
    back_s: float
    """From the fault until attract is shown again."""
    seen: str
    """What the supervisor saw."""
    session: str
    """What the database says of the session, after the next start."""
    left_behind: int
    """Processes and temporary folders that should be gone."""

    def faults(self) -> list[str]:
        """Whatever must not be; nothing, if all is well."""
        wrong = {
            "it took too long": self.back_s > (CALM_S if self.fault in MENDED_INSIDE else LONGEST_S),
            "the session is not as it should be": self.session
            != ("none" if self.stage in BEFORE_ANYTHING_IS_KEPT else Status.INTERRUPTED.value),
            "something was left behind": bool(self.left_behind),
        }
        return [what for what, holds in wrong.items() if holds]


@contextmanager
def screen() -> Iterator[dict[str, str]]:
    """Provide a virtual screen with a window manager; yields the environment for it."""
    reads, writes = os.pipe()
    geometry = ("-screen", "0", "1920x1080x24", "-nolisten", "tcp")
    with ending(_found("Xvfb"), "-displayfd", str(writes), *geometry, pass_fds=[writes]) as server:
        os.close(writes)
        with os.fdopen(reads) as number, limited(server):
            environment = os.environ | {"DISPLAY": f":{number.readline().strip()}", "QT_QPA_PLATFORM": "xcb"}
        with ending(_found("openbox"), env=environment):
            yield environment


@contextmanager
def ending(*command: str, **options: Any) -> Iterator[Program]:
    """Provide a program that runs meanwhile and is ended then."""
    with started(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL, **options) as process:
        try:
            yield process
        finally:
            process.terminate()


class Kept:
    """A supervisor at work; what it tells comes with the time at which it was told."""

    def __init__(self, stage: str, folder: Path, environment: dict[str, str]) -> None:
        command = [sys.executable, "-m", "tests.ui.kept_kiosk", stage, str(folder / "marker")]
        self.data = folder / "data"
        study = folder / "study.toml"
        study.write_text(STUDY + WITH_PIN)
        self.process = subprocess.Popen(
            [*command, "run", "--supervise", "--json", "--data", str(self.data), "--study", str(study)],
            env=environment | {"TMPDIR": str(folder)},
            stdout=subprocess.PIPE,
            text=True,
        )
        self._told: queue.SimpleQueue[tuple[float, dict[str, Any]]] = queue.SimpleQueue()
        threading.Thread(target=self._read, daemon=True).start()
        self.seen: list[str] = []

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._told.put((time.monotonic(), json.loads(line)))

    def wait_for(self, screen: str, within_s: float) -> float:
        """When the kiosk showed this screen next; raises queue.Empty if it did not in time."""
        until = time.monotonic() + within_s
        while True:
            at, told = self._told.get(timeout=max(0.0, until - time.monotonic()))
            if told["what"] in {"died", "hung", "ready"}:
                self.seen.append(f"{told['what']} {told['detail']}".strip())
            if told["what"] == "shows" and told["detail"] == screen:
                return at

    def kiosk(self) -> int:
        """Return the process of the kiosk."""
        own = Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children").read_text().split()
        return next(int(child) for child in own if b"\0open\0" in Path(f"/proc/{child}/cmdline").read_bytes())

    def end(self) -> None:
        """Ask the supervisor to end, and see that it does."""
        self.process.terminate()
        self.process.wait(20)


@contextmanager
def kept_in(folder: Path, stage: str, environment: dict[str, str]) -> Iterator[Kept]:
    """Provide a supervisor that is ended whatever happens."""
    kept = Kept(stage, folder, environment)
    try:
        yield kept
    finally:
        kept.end()


def revive(stage: str, fault: str, environment: dict[str, str], shots: Path | None) -> Revival:
    """One supervisor, one visitor, one fault."""
    with tempfile.TemporaryDirectory(prefix="revival-") as place, kept_in(Path(place), stage, environment) as kept:
        folder = Path(place)
        for shown in WAYS.get(stage, (stage,)):
            kept.wait_for(shown, UNTIL_STAGE_S)
        kept.seen.clear()
        struck = kept.kiosk()
        at = time.monotonic()
        FAULTS[fault](struck)
        if shots is not None:
            threading.Timer(0.2, _photograph, [shots / f"{stage}-{fault}.png", environment]).start()
        try:
            back = kept.wait_for("attract", STOPPED_S) - at
        except queue.Empty:
            back = float("inf")
        left = int(fault not in MENDED_INSIDE and Path(f"/proc/{struck}").exists())
        kept.end()
        left += len([*folder.glob("recollect-*")])
        return Revival(stage, fault, round(back, 2), ", ".join(kept.seen), _status(kept.data), left)


def _status(data: Path) -> str:
    with open_repository(data) as stored:
        sessions = stored.sessions()
    status = sessions[-1].status if sessions else None
    return status.value if status else "none"


def _photograph(file: Path, environment: dict[str, str]) -> None:
    subprocess.run([_found("import"), "-window", "root", str(file)], env=environment, check=True, timeout=PATIENCE_S)


def _found(program: str) -> str:
    found = shutil.which(program)
    if found is None:
        sys.exit(f"{program} is missing")
    return found


def main() -> int:
    """Strike in every stage in every way, and tell."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--stages", default=",".join(STAGES))
    parser.add_argument("--faults", default=",".join(FAULTS))
    parser.add_argument("--shots", type=Path, help="save what was to be seen 0.2 s after each fault")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    if arguments.shots is not None:
        arguments.shots.mkdir(parents=True, exist_ok=True)
    bad = 0
    with screen() as environment:
        for stage in arguments.stages.split(","):
            for fault in arguments.faults.split(","):
                revival = revive(stage, fault, environment, arguments.shots)
                bad += bool(revival.faults())
                click.echo(json.dumps(asdict(revival)) if arguments.json else _line(revival))
    return int(bad > 0)


def _line(revival: Revival) -> str:
    wrong = f"  BUT {', '.join(revival.faults())}" if revival.faults() else ""
    return (
        f"{revival.stage:<13}{revival.fault:<13}{revival.back_s:6.2f} s  {revival.seen or 'error screen':<32}"
        f"session: {revival.session}{wrong}"
    )


if __name__ == "__main__":
    sys.exit(main())
