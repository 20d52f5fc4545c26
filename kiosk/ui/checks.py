"""Preflight checks of the screens and of drawing a frame."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from queue import Empty, Queue
from threading import Thread
from time import monotonic, perf_counter
from typing import IO, TYPE_CHECKING

from kiosk import program
from kiosk.preflight import CheckResult, Severity
from kiosk.ui.qt_platform import numbered_screens, obstacle
from kiosk.units import MS_PER_SECOND

if TYPE_CHECKING:
    from PySide6.QtGui import QScreen

    from kiosk.experiment.session_config import StudyConfig
    from kiosk.ui.window import Window

# Qt is loaded by the checks themselves: where the system lacks a library that it needs, that is what is found.
# ruff: noqa: PLC0415

DISPLAY, DESKTOP, LIT = "screen", "desktop", "kept lit"

LEAST_HIGH, LEAST_WIDE = 720, 1280
"""The smallest screen, lying or standing, that every page is tried on."""

_TICK_MS = 20
_PLUG_IN = "plug one in, and run this in the booth's own session"


def screens_check(number: int) -> Iterator[CheckResult]:
    """Everything about the screen of a number and what surrounds it."""
    from PySide6.QtGui import QGuiApplication

    found = obstacle()
    if found is not None:
        yield CheckResult.error(DISPLAY, found.words, _PLUG_IN if found.of_the_screen else found.remedy)
        return
    application = QGuiApplication.instance() or QGuiApplication(["recollect"])
    yield covered_screen_check(numbered_screens(), number)
    yield CheckResult.ok(DESKTOP, f"{QGuiApplication.platformName()}, {_window_manager()}")
    yield _lit()
    del application


def covered_screen_check(there: list[QScreen], number: int) -> CheckResult:
    """Return the screen that the kiosk will cover."""
    if number >= len(there):
        words = f"there is no screen {number}, so the kiosk covers the primary one; there are {len(there)}"
        return CheckResult.warning(DISPLAY, words, "plug it in, or change screen.number in the study file")
    size, ratio = there[number].size(), there[number].devicePixelRatio()
    words = f"{size.width()} x {size.height()}, {ratio:g} device pixels each, {len(there)} in all"
    if min(size.width(), size.height()) < LEAST_HIGH or max(size.width(), size.height()) < LEAST_WIDE:
        remedy = f"use one of at least {LEAST_WIDE} x {LEAST_HIGH}: texts may not fit on it"
        return CheckResult.warning(DISPLAY, words, remedy)
    return CheckResult.ok(DISPLAY, words)


def _window_manager() -> str:
    from PySide6.QtGui import QGuiApplication

    if QGuiApplication.platformName() != "xcb":
        return "which places the windows itself"
    from kiosk.ui.x11 import window_manager  # only where there is an X server

    name = window_manager()
    return f"windows are placed by {name}" if name else "no window manager runs, so the kiosk places its windows"


def _lit() -> CheckResult:
    """Ask all that can hold off the screen saver, wait for an answer, and take it back."""
    from PySide6.QtCore import QEventLoop

    from kiosk.ui.keep_awake import ANSWER_MS, all_inhibitors
    from kiosk.ui.kiosk_window import KeepAwake

    awake = KeepAwake(all_inhibitors())
    end = monotonic() + ANSWER_MS / MS_PER_SECOND
    loop = QEventLoop()
    while not awake.health.is_ok and monotonic() < end:
        loop.processEvents(QEventLoop.ProcessEventsFlag.AllEvents, _TICK_MS)
    health = awake.health
    awake.release()
    if health.is_ok:
        return CheckResult.ok(LIT, health.message)
    return CheckResult.warning(LIT, health.message, "switch screen saver and sleep off in the system's settings")


WHAT = "drawing"

WIDTH, HEIGHT = 1920, 1080
FRAMES = 8
_FADED = 0.99
SLOW_MS = 50.0
"""A screen that fades draws all of itself again and again; at less than 20 a second that is seen as steps."""


def frame_check(study: StudyConfig) -> Iterator[CheckResult]:
    """Open the kiosk's window off the screen, and draw its first page several times."""
    from PySide6.QtCore import QEventLoop

    from kiosk.ui.window import ClockMode, RunMode, Window, WindowMode

    found = obstacle()
    if found is not None and not found.of_the_screen:
        yield CheckResult.error(WHAT, found.words, found.remedy)
        return
    window = Window(study, RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL))
    try:
        window.shown.setWidth(WIDTH)
        window.shown.setHeight(HEIGHT)
        window.show()
        QEventLoop().processEvents()
        times = sorted(_drawn_ms(window, opacity) for opacity in (_FADED, 1.0) * (FRAMES // 2))
    finally:
        window.close()
    yield frame_result(times[len(times) // 2])


def frame_result(usual_ms: float) -> CheckResult:
    """Return what it means that a frame takes so long."""
    words = f"a whole frame of {WIDTH} x {HEIGHT} takes {usual_ms:.0f} ms without a graphics card"
    if usual_ms > SLOW_MS:
        return CheckResult.warning(WHAT, words, "end other programs, or set screen.motion to false")
    return CheckResult.ok(WHAT, words)


def _drawn_ms(window: Window, opacity: float) -> float:
    """Change everything a little: what has not changed is not drawn again."""
    window.shown.contentItem().setOpacity(opacity)
    begun = perf_counter()
    window.shown.grabWindow()
    return (perf_counter() - begun) * 1000


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
    for at, said, why in answers(command, [str(file) for file in files], within_s):
        if why or said:
            yield f"the picture {files[at]} cannot be drawn: {why or said}"


def found_in_pictures(study: StudyConfig) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Draw the pictures that do not come with the program; returns what is wrong and what may not be meant.

    Raises CannotDraw if none can be drawn on this machine.
    """
    if not study.own_pictures:
        return (), ()
    try:
        from kiosk.ui.cards import card_warnings, draw_cards
    except ImportError as error:
        raise CannotDraw(str(error)) from error
    cards = draw_cards(study.own_cards).values()
    others = [file for file in study.own_pictures if file not in study.own_cards]
    faults = [f"the picture {each.file} cannot be drawn: {each.fault}" for each in cards if each.fault]
    return (*faults, *undrawn(program("_display", "pictures"), others)), tuple(card_warnings(cards))


def answers(command: Sequence[str], jobs: Sequence[str], within_s: float) -> Iterator[tuple[int, str | None, str]]:
    """Yield what a process answers to each of the jobs, by its number, or None and why not.

    A job that is not done in time, or that ends the process, is left out; the process is started anew for the others.
    Raises CannotDraw if it does not even start.
    """
    done = 0
    while done < len(jobs):
        child = _Child(command, jobs[done:])
        try:
            if child.says(READY_S) != _READY:
                raise CannotDraw(child.last_words())
            while done < len(jobs) and (said := child.says(within_s)) is not None:
                done += 1
                yield done - 1, said, ""
        finally:
            child.end()
        if done < len(jobs):
            done += 1
            yield done - 1, None, "it ends the program" if child.died else f"it is not done within {within_s:g} s"


class _Child:
    """The process, and what it says line by line; ``died`` says that it ended before it was asked to."""

    def __init__(self, command: Sequence[str], jobs: Sequence[str]) -> None:
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
        self._jobs = json.dumps(list(jobs))
        # The jobs too: writing more than a pipe takes waits until the process reads, which may be never.
        ends = (
            (self._listen, self._child.stdout),
            (self._note, self._child.stderr),
            (self._ask, self._child.stdin),
        )
        self._threads = [Thread(target=use, args=(stream,), daemon=True) for use, stream in ends]
        for each in self._threads:
            each.start()

    def _ask(self, stream: IO[str]) -> None:
        with suppress(OSError), stream:
            stream.write(self._jobs)

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
        for each in self._threads:
            each.join()


def draw_files(source: IO[str], out: IO[str], *, cards: bool = False) -> None:
    """Be the process: draw one file after another, or one card after another, and say what came of each."""
    _limit_memory()
    from PySide6.QtGui import QGuiApplication  # not before memory is limited

    draw: Callable[[str], str] = _why_not
    if cards:
        from kiosk.ui.cards import draw_card

        draw = draw_card
    application = QGuiApplication.instance() or QGuiApplication(["recollect"])
    print(_READY, file=out, flush=True)
    for job in json.load(source):
        print(draw(str(job)), file=out, flush=True)
    del application


def _why_not(file: str) -> str:
    """Say why a file cannot be drawn; nothing if it can."""
    from PySide6.QtCore import QSize
    from PySide6.QtGui import QImage, QImageReader

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
        import resource

        with suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))


def run_check_process(what: str, command: Sequence[str], within_s: float, remedy: str) -> Iterator[CheckResult]:
    """Yield what the process of this command found; ``remedy`` is for when it comes to nothing."""
    try:
        done = subprocess.run(  # noqa: S603 - our own program
            command, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", timeout=within_s, check=False
        )
    except subprocess.TimeoutExpired:
        late = f"end other programs, if the machine is busy; otherwise {remedy}"
        yield CheckResult.error(what, f"no answer within {within_s:g} s", late)
        return
    if done.returncode == 0:
        yield from from_json(done.stdout)
        return
    yield CheckResult.error(what, _said(done.stderr) or f"it ended with {done.returncode}", remedy)


def _said(stderr: str) -> str:
    """Return the line that says most: the first, but the last of a traceback.

    The others follow from the first.
    """
    lines = [line.strip() for line in stderr.splitlines() if line.strip()]
    if not lines:
        return ""
    return lines[-1] if lines[0].startswith("Traceback ") else lines[0]


def to_json(results: Iterable[CheckResult]) -> str:
    """Return results as the process prints them."""
    return json.dumps([asdict(each) | {"severity": each.severity.value} for each in results])


def from_json(text: str) -> Iterator[CheckResult]:
    """Read what ``to_json`` wrote."""
    return (CheckResult(**each | {"severity": Severity(each["severity"])}) for each in json.loads(text))
