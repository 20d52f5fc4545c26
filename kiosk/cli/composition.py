"""Compose the packages: from a study file to what a session follows."""

from __future__ import annotations

import logging
import os
import subprocess
import sys
import traceback
from copy import copy
from datetime import UTC, datetime
from functools import partial
from io import TextIOWrapper
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

from platformdirs import user_data_path

from kiosk import DISK_FULL, UserInputError, why

if TYPE_CHECKING:
    from kiosk.config import Settings

DATA = user_data_path("recollect", appauthor=False)
"""Where a study's data are kept unless told otherwise."""

LOG = "recollect.log"
LOG_BYTES = 1_000_000
LOGS_KEPT = 3

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


class _Private(logging.FileHandler):
    """A log for its owner alone; on a full disk a line is lost and the program goes on."""

    def _open(self) -> TextIOWrapper:
        return open(
            self.baseFilename, "a", encoding="utf-8", errors="backslashreplace", opener=partial(os.open, mode=0o600)
        )

    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802 - logging's name
        """Say on the standard error what could not be written, and why."""
        failed = sys.exc_info()[1]
        words = why(failed) if isinstance(failed, OSError) else type(failed).__name__
        sys.stderr.write(f"recollect: the log {self.baseFilename} could not be written: {words}: {record.levelname}\n")


class _OwnFile(_Private, RotatingFileHandler):
    """The log of the process that keeps it: a new file is begun before one grows large."""


class _SharedFile(_Private):
    """A log that another process keeps.

    It is opened for each line, so that the other may begin a new file.
    """

    def emit(self, record: logging.LogRecord) -> None:
        try:
            super().emit(record)
            self.close()
        except OSError:
            self.handleError(record)


class _WithoutWords(logging.Formatter):
    """Formats where a fault arose and of what kind it is, without its message.

    The message may repeat what a visitor typed.

    The record plays the session, and the fault with it, again.
    """

    def format(self, record: logging.LogRecord) -> str:
        """Return a line of the log, with what follows it of a fault."""
        own = copy(record)
        # Another handler may have put it into its own words, which are kept with the record.
        own.exc_text = None
        return super().format(own)

    def formatException(  # noqa: N802 - logging's name
        self,
        ei: tuple[type[BaseException], BaseException, TracebackType | None] | tuple[None, None, None],
    ) -> str:
        """Where a fault arose, after where those did that led to it."""
        fault = ei[1]
        lines: list[str] = []
        while fault is not None:
            lines = [*traceback.format_tb(fault.__traceback__), f"{type(fault).__name__}\n", *lines]
            fault = fault.__cause__ or fault.__context__
        return "".join(lines).rstrip()


def log_into(folder: Path, *, shared: bool = False) -> None:
    """Keep a log in a data folder, in files that never grow large; it holds faults and failures, nothing personal.

    With ``shared`` only lines are added to what another process keeps. Raises UserInputError if it cannot be written.
    """
    logging.basicConfig(handlers=[log_file(folder, shared=shared)], level=logging.WARNING)


def log_file(folder: Path, *, shared: bool = False) -> logging.FileHandler:
    """Return the log of a data folder, as ``log_into`` keeps it.

    Raises UserInputError if it cannot be written there.
    """
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        handler = _handler(folder / LOG, shared=shared, later=False)
    except OSError as error:
        if why(error) != DISK_FULL:
            raise UserInputError(f"the data folder {folder} cannot be used: {error.strerror}") from error
        # No kiosk and no supervisor stays away for want of a log: it begins once there is room.
        handler = _handler(folder / LOG, shared=shared, later=True)
    handler.setFormatter(_WithoutWords("%(asctime)s %(levelname)s %(name)s: %(message)s"))
    return handler


def _handler(file: Path, *, shared: bool, later: bool) -> logging.FileHandler:
    if shared:
        return _SharedFile(file, encoding="utf-8", delay=later)
    return _OwnFile(file, maxBytes=LOG_BYTES, backupCount=LOGS_KEPT, encoding="utf-8", delay=later)


def code_commit() -> str:
    """Return the commit that runs, with "-dirty" if it was changed since; "released" outside a checkout and a build."""
    if _BUILT_FROM.is_file():
        return _BUILT_FROM.read_text("utf-8")
    return _git("describe", "--always", "--dirty", "--abbrev=40", "--exclude=*") or "released"


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
