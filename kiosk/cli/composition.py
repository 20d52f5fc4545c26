"""Compose the packages: from a study file to what a session follows."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING

from platformdirs import user_data_path

from kiosk import UserInputError

if TYPE_CHECKING:
    from kiosk.config import Settings

DATA = user_data_path("recollect", appauthor=False)
"""Where a study's data are kept unless told otherwise."""

_GIT_DEADLINE_S = 2
_BUILT_FROM = Path(__file__).parents[1] / "commit.txt"
"""In a build, the commit that it was made from."""


def read_settings(study: Path | None, robot_host: str | None = None, robot_port: int | None = None) -> Settings:
    """Read the settings of a study file or a packed study, or the study's own without one.

    A robot's host or port goes before the file's.
    """
    # The voice's process and the splash read this module and no settings.
    from kiosk.config import NO_ROBOT, Settings, host_fault  # noqa: PLC0415
    from kiosk.extensions import ExtensionGroup, registered_names  # noqa: PLC0415
    from kiosk.study.package import open_study  # noqa: PLC0415

    settings = open_study(study) if study else Settings()
    if robot_host is None and robot_port is None:
        return settings
    fault = None if robot_host is None else host_fault(robot_host)
    if fault:
        raise UserInputError(f"the robot's host: {fault}")
    robot = settings.robot
    found = {"kind": registered_names(ExtensionGroup.ROBOTS)[0] if robot.kind == NO_ROBOT else robot.kind}
    given = {"host": robot_host or robot.host, "port": robot_port or robot.port}
    return settings.model_copy(update={"robot": robot.model_copy(update=found | given)})


def check_pin(settings: Settings) -> None:
    """Raise UserInputError for a study without a PIN, which is not to be run unattended."""
    if not settings.experimenter.pin_hash:
        raise UserInputError(
            "no PIN is set, so the kiosk is not started unattended: put what 'recollect study set-pin' prints into the "
            "study file, and name the file with --study; 'recollect run' alone opens a trial without a PIN"
        )


def code_commit() -> str:
    """Return the commit that runs, with "-dirty" if it was changed since; "released" outside a checkout and a build."""
    if _BUILT_FROM.is_file():
        return _BUILT_FROM.read_text("utf-8")
    return _git("describe", "--always", "--dirty", "--abbrev=40", "--exclude=*") or "released"


def code_commit_beside() -> Callable[[], str]:
    """Begin to look for the commit on a thread; returns what waits for the answer."""
    found: list[str] = []
    asking = Thread(target=lambda: found.append(code_commit()), daemon=True)
    asking.start()

    def wait() -> str:
        asking.join()
        return found[0]

    return wait


def code_made() -> datetime:
    """When the program was made: its commit in a checkout, else its files."""
    committed = "" if _BUILT_FROM.is_file() else _git("log", "-1", "--format=%cI")
    if committed:
        return datetime.fromisoformat(committed)
    # In a build the modules are no files of their own.
    made = _BUILT_FROM if _BUILT_FROM.is_file() else Path(__file__)
    return datetime.fromtimestamp(made.stat().st_mtime, UTC)


def _git(*arguments: str) -> str:
    """Return what git says of the checkout; empty outside of one."""
    import subprocess  # noqa: PLC0415 - most commands never ask

    try:
        said = subprocess.run(  # noqa: S603 - with arguments of our own
            ["git", *arguments],  # noqa: S607 - git is on the path
            cwd=Path(__file__).parent,
            capture_output=True,
            text=True,
            timeout=_GIT_DEADLINE_S,
            check=True,
        )
    except (OSError, subprocess.SubprocessError):
        return ""
    return said.stdout.strip()
