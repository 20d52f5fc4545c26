"""Preflight checks: what a check returns, and how several of them run at once."""

from __future__ import annotations

import getpass
import shutil
import subprocess
from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import Enum
from pathlib import Path
from typing import Self

from kiosk.lazy_dataclass import dataclass


class Severity(Enum):
    """How serious a result is."""

    OK = "ok"
    WARNING = "warning"
    """A session can be held, but not as it should be."""
    ERROR = "error"
    """No session can be held."""


@dataclass(frozen=True)
class CheckResult:
    """What a check found out about one thing.

    ``remedy`` says what to do, and is empty only where all is well.
    """

    name: str
    severity: Severity
    message: str
    remedy: str = ""

    @classmethod
    def ok(cls, name: str, message: str) -> Self:
        """Report that all is well."""
        return cls(name, Severity.OK, message)

    @classmethod
    def warning(cls, name: str, message: str, remedy: str) -> Self:
        """Report something that is not as it should be, though sessions can be held."""
        return cls(name, Severity.WARNING, message, remedy)

    @classmethod
    def error(cls, name: str, message: str, remedy: str) -> Self:
        """Report something without which no session can be held."""
        return cls(name, Severity.ERROR, message, remedy)

    @property
    def is_ok(self) -> bool:
        """Whether nothing has to be done."""
        return self.severity is Severity.OK


@dataclass(frozen=True)
class Check:
    """One look at one thing; ``look`` may block, and the caller waits at most ``within_s`` seconds."""

    what: str
    look: Callable[[], Iterable[CheckResult]]
    within_s: float = 5.0
    late: Severity = Severity.WARNING
    """How a thing is that does not answer in time."""


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
    import psutil  # noqa: PLC0415 - the start screen does not wait for it

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
