"""What a test waits for has an end: a program that is not done in time is ended, and its test fails in words."""

from __future__ import annotations

import subprocess
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any

import psutil
import pytest

PATIENCE_S = 300.0
"""Seconds; nothing takes as long, on a busy machine neither, unless it never ends."""


class Program(subprocess.Popen[Any]):
    """A program that a test talks to, through the pipes that it was started with."""

    stdin: IO[Any]
    stdout: IO[Any]
    stderr: IO[Any]


@contextmanager
def started(command: Sequence[str | Path], *, within_s: float = PATIENCE_S, **options: Any) -> Iterator[Program]:
    """Start a program and wait for its end; it is ended if that does not come, or if the test fails.

    ``options`` are those of ``subprocess.Popen``, whose own ``with`` waits without a limit.
    """
    program = Program(command, **options)
    with limited(program, within_s), program:
        try:
            yield program
        except BaseException:
            end_all(program)
            raise


@contextmanager
def serving(command: Sequence[str | Path], **options: Any) -> Iterator[Program]:
    """Start a program that is to answer until this is over, and then end it; put ``limited`` around each answer."""
    with Program(command, **options) as program:
        try:
            yield program
        finally:
            end_all(program)


@contextmanager
def limited(program: subprocess.Popen[Any], within_s: float = PATIENCE_S) -> Iterator[None]:
    """Fail if what is asked of a program in here is not done in time, and end the program.

    Its output ends with it, and so does every wait for a line.
    """
    is_late = threading.Event()

    def end() -> None:
        is_late.set()
        end_all(program)

    timer = threading.Timer(within_s, end)
    timer.daemon = True
    timer.start()
    try:
        yield
    except (Exception, pytest.fail.Exception) as failure:
        if is_late.is_set():
            raise AssertionError(_late(program, within_s)) from failure
        raise
    finally:
        timer.cancel()
    assert not is_late.is_set(), _late(program, within_s)


def _late(program: subprocess.Popen[Any], within_s: float) -> str:
    command = program.args if isinstance(program.args, str) else " ".join(map(str, program.args))  # type: ignore[arg-type]
    return f"this was not done within {within_s:g} s, so it was ended: {command[:500]}"


def end_all(program: subprocess.Popen[Any]) -> None:
    """End a program at once, and all that it has started and that may hold its output."""
    children = []
    with suppress(psutil.NoSuchProcess):
        children = psutil.Process(program.pid).children(recursive=True)
    # First, so that it starts none in their place and tells nothing of their end.
    program.kill()
    for child in children:
        with suppress(psutil.NoSuchProcess):
            child.kill()
