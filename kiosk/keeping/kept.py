"""Whether somebody keeps the kiosk up: a keeper that runs, a service that is enabled, or a desktop that opens it."""

from __future__ import annotations

import getpass
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path

import psutil

from kiosk.findings import Finding

WHAT = "kept up"

SERVICES = (("--user", "recollect.service"), ("--system", "recollect-cage@{user}.service"))
AUTOSTART = Path(".config", "autostart")

_ANSWER_S = 1.5


def kept() -> Iterator[Finding]:
    """Whether the kiosk is started again when it dies, and comes up with the machine."""
    keepers = [*(("a keeper runs",) if keeper_runs() else ()), *(f"{name} is enabled" for name in enabled())]
    if keepers:
        yield Finding.good(WHAT, ", ".join(keepers))
    else:
        remedy = "open it with 'recollect keep', or enable the service (packaging/README.md)"
        yield Finding.warning(WHAT, "nobody starts the kiosk again if it dies or hangs", remedy)


def keeper_runs() -> bool:
    """Whether a keeper is among the programs of this machine."""
    return any(is_keeper(process.info["cmdline"] or ()) for process in psutil.process_iter(["cmdline"]))


def is_keeper(command: Sequence[str]) -> bool:
    """Whether a command line is a keeper's: ``recollect keep``, or ``python -m kiosk keep``."""
    try:
        ours = command[command.index("keep") - 1]
    except ValueError:
        return False
    return ours == "kiosk" or Path(ours).stem == "recollect"


def enabled() -> Iterator[str]:
    """The services and desktop files that open the kiosk with the machine, or with its user's session."""
    systemctl = shutil.which("systemctl")
    for manager, name in SERVICES if systemctl else ():
        service = name.format(user=getpass.getuser())
        if _answers(str(systemctl), manager, "is-enabled", "--quiet", service):
            yield service
    for file in (Path.home() / AUTOSTART).glob("recollect*.desktop"):
        yield file.name


def _answers(*command: str) -> bool:
    try:
        done = subprocess.run(  # noqa: S603 - the system's own program
            command, stdin=subprocess.DEVNULL, capture_output=True, timeout=_ANSWER_S, check=False
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0
