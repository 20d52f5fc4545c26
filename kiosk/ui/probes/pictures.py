"""Draw pictures as the kiosk does, in a process of their own that may be ended: some never end, some end the process.

The process is handed the files as a JSON list, says that it is ready, and then says for each file why it cannot be
drawn, or that it can.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import nullcontext, suppress
from pathlib import Path
from queue import Empty, Queue
from threading import Thread
from typing import IO

READY_S = 60.0
"""A machine that does much else needs long to start a process."""

DRAWN_S = 10.0
"""A card takes a few milliseconds."""

_SIZE = 240
_MEMORY = 4 * 1024**3
_READY = "ready"


class CannotDraw(Exception):
    """Nothing can be drawn on this machine, whatever the picture."""


def undrawn(command: Sequence[str], files: Sequence[Path], within_s: float = DRAWN_S) -> Iterator[str]:
    """Yield a sentence for every file that cannot be drawn in time; ``command`` starts the process.

    Raises CannotDraw if the process does not even start.
    """
    left = list(files)
    while left:
        child = _Child(command, left)
        try:
            if child.says(READY_S) != _READY:
                raise CannotDraw(child.last_words())
            while left and (said := child.says(within_s)) is not None:
                file = left.pop(0)
                if said:
                    yield f"the picture {file} cannot be drawn: {said}"
        finally:
            child.end()
        if left:
            why = "it ends the program" if child.died else f"it is not done within {within_s:g} s"
            yield f"the picture {left.pop(0)} cannot be drawn: {why}"


class _Child:
    """The process, and what it says line by line; ``died`` says that it ended before it was asked to."""

    def __init__(self, command: Sequence[str], files: Sequence[Path]) -> None:
        self.died = False
        self._child = subprocess.Popen(  # noqa: S603 - our own program
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
            env=os.environ | {"QT_QPA_PLATFORM": "offscreen"},
        )
        self._lines: Queue[str | None] = Queue()
        self._errors: list[str] = []
        ears = ((self._listen, self._child.stdout), (self._note, self._child.stderr))
        self._ears = [Thread(target=hear, args=(stream,), daemon=True) for hear, stream in ears]
        for each in self._ears:
            each.start()
        with suppress(OSError), self._child.stdin or nullcontext() as names:
            if names is not None:
                names.write(json.dumps([str(file) for file in files]))

    def _listen(self, stream: IO[str]) -> None:
        with stream:
            for line in stream:
                self._lines.put(line.rstrip("\n"))
        self._lines.put(None)

    def _note(self, stream: IO[str]) -> None:
        with stream:
            self._errors += [line.strip() for line in stream if line.strip()]

    def says(self, within_s: float) -> str | None:
        """Return the next line; None if there is none in time, or no more."""
        try:
            line = self._lines.get(timeout=within_s)
        except Empty:
            return None
        self.died = line is None
        return line

    def last_words(self) -> str:
        """Return what it said before it ended."""
        self.end()
        return self._errors[0] if self._errors else "the process that draws does not answer"

    def end(self) -> None:
        """End it, and wait until it has."""
        self._child.kill()
        self._child.wait()
        for each in self._ears:
            each.join()


def draw(source: IO[str], out: IO[str]) -> None:
    """Be the process: draw one file after another, and say what came of each."""
    _limit_memory()
    from PySide6.QtGui import QGuiApplication  # noqa: PLC0415 - not before memory is limited

    application = QGuiApplication.instance() or QGuiApplication(["recollect"])
    print(_READY, file=out, flush=True)
    for file in json.load(source):
        print(_why_not(str(file)), file=out, flush=True)
    del application


def _why_not(file: str) -> str:
    """Say why a file cannot be drawn; nothing if it can."""
    from PySide6.QtCore import QSize  # noqa: PLC0415
    from PySide6.QtGui import QImage, QImageReader  # noqa: PLC0415

    reader = QImageReader(file, b"svg")
    reader.setScaledSize(QSize(_SIZE, _SIZE))
    image = reader.read()
    if image.isNull():
        return " ".join(reader.errorString().split()) or "it is no SVG"
    alpha = image.convertToFormat(QImage.Format.Format_Alpha8)
    return "" if any(bytes(alpha.constBits())) else "it shows nothing"


def _limit_memory() -> None:
    """Let a picture that grows without end fail; there is no such limit on Windows."""
    if sys.platform != "win32":
        import resource  # noqa: PLC0415

        with suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
