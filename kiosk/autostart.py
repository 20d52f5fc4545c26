"""Check what restarts the kiosk: a running supervisor, an enabled service, or the desktop's autostart."""

from __future__ import annotations

import getpass
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path

import psutil

from kiosk.preflight import CheckResult

WHAT = "kept up"

SERVICES = (("--user", "recollect.service"), ("--system", "recollect-cage@{user}.service"))
AUTOSTART = Path(".config", "autostart")

_ANSWER_S = 1.5


def autostart_check() -> Iterator[CheckResult]:
    """Whether the kiosk is started again when it dies, and comes up with the machine."""
    reasons = [*(("a supervisor runs",) if supervisor_runs() else ()), *(f"{name} is enabled" for name in enabled())]
    if reasons:
        yield CheckResult.ok(WHAT, ", ".join(reasons))
    else:
        remedy = "open it with 'recollect run --supervise', or enable the service (packaging/README.md)"
        yield CheckResult.warning(WHAT, "nothing starts the kiosk again if it dies or hangs", remedy)


def supervisor_runs() -> bool:
    """Whether a supervisor is among the programs of this machine."""
    return any(is_supervisor(process.info["cmdline"] or ()) for process in psutil.process_iter(["cmdline"]))


def is_supervisor(command: Sequence[str]) -> bool:
    """Whether a command line is a supervisor's: ``recollect run --supervise``, or ``python -m kiosk`` with the same."""
    if "--supervise" not in command or "run" not in command:
        return False
    ours = command[command.index("run") - 1]
    return ours == "kiosk" or Path(ours).stem == "recollect"


def enabled() -> Iterator[str]:
    """Yield the services and desktop files that open the kiosk with the machine, or with its user's session."""
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
