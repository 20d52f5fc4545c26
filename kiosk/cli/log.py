"""The log of a data folder: files for their owner alone that never grow large, without what a visitor typed."""

from __future__ import annotations

import logging
import os
import sys
import traceback
from copy import copy
from functools import partial
from io import TextIOWrapper
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType

from kiosk import DISK_FULL, UserInputError, why
from kiosk.files import make_folder

LOG = "recollect.log"
LOG_BYTES = 1_000_000
LOGS_KEPT = 3


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
        make_folder(folder)
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
