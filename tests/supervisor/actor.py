"""A program that acts in the kiosk's place: ``python -m tests.supervisor.actor FOLDER ACT...``.

Its first start does the first act, its second start the second, and every later one the last. It notes its starts in
the folder, by the names of its processes.
"""

from __future__ import annotations

import itertools
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from kiosk.sd_notify import Notifier

UNSEEN: dict[str, Callable[[], object]] = {
    "refuse": lambda: sys.exit(2),
    "break unseen": lambda: sys.exit(1),
    "hang unseen": signal.pause,
}
"""What an actor may do before its first frame."""


def main(folder: Path, acts: list[str]) -> None:
    """Do the act of this start."""
    start = len(list(folder.glob("start-*")))
    (folder / f"start-{start}").write_text(str(os.getpid()))
    act = acts[min(start, len(acts) - 1)]
    UNSEEN.get(act, lambda: None)()
    notifier = Notifier(os.environ)
    notifier.tell(READY=1, STATUS="attract")
    seen: dict[str, Callable[[], object]] = {
        "break": lambda: sys.exit(1),
        "be killed": lambda: os.kill(os.getpid(), signal.SIGKILL),
        "stop": lambda: os.kill(os.getpid(), signal.SIGSTOP),
        "hang": signal.pause,
        "hang with company": lambda: hang_with_company(folder),
        "stay": lambda: stay(notifier),
        "stay deaf": lambda: stay(notifier, deaf=True),
        "burn": burn,
        "swell": lambda: swell(notifier),
        "leave": lambda: None,
    }
    seen[act]()


def hang_with_company(folder: Path) -> None:
    """Start another program, leave a folder with the temporary files, and fall silent."""
    company = subprocess.Popen([sys.executable, "-c", "import signal; signal.pause()"])
    (folder / "company").write_text(str(company.pid))
    (folder / "left").write_text(tempfile.mkdtemp())
    signal.pause()


def burn() -> None:
    """Use the processor for ever, with Python's lock: no handler of Python's answers a signal any more."""
    signal.signal(signal.SIGTERM, lambda *_: None)
    sum(itertools.repeat(0))


def swell(notifier: Notifier) -> None:
    """Take 300 MiB, and go on beating."""
    taken = b"x" * (300 << 20)
    stay(notifier)
    del taken


def stay(notifier: Notifier, *, deaf: bool = False) -> None:
    """Beat until no one listens any more; a deaf one cannot be asked to end."""
    if deaf:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
    while notifier.tell(WATCHDOG=1):
        signal.sigtimedwait([signal.SIGUSR1], 0.02)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
