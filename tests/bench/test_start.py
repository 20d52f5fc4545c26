"""How long a start takes: until the first picture, until the start screen can be tapped, and until a command answers.

Each start is measured in turns with a reference that does only what nothing could do without.
"""

from __future__ import annotations

import compileall
import os
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from statistics import median
from textwrap import dedent
from typing import Any

import psutil
import pytest

import kiosk
from kiosk import program
from kiosk.cli.main import BAD_INPUT
from kiosk.sd_notify import NotifySocketListener
from kiosk.units import MS_PER_SECOND
from tests.bench.percentiles import tell_percentiles
from tests.patience import limited, serving

OFFSCREEN = {"QT_QPA_PLATFORM": "offscreen", "QT_QUICK_BACKEND": "software", "QSG_RENDER_LOOP": "basic"}
PACKAGE = Path(kiosk.__file__).parent
ROUNDS = 5
LONG_S = 120.0

EMPTY_WINDOW = """
    from PySide6.QtCore import QTimer
    from PySide6.QtGui import QGuiApplication
    from PySide6.QtQuick import QQuickView

    application = QGuiApplication([])
    window = QQuickView()
    window.resize(1920, 1080)
    window.frameSwapped.connect(application.quit)
    window.show()
    application.exec()
"""

FIRST_PICTURE = """
    import sys
    from kiosk.ui import startup_splash

    class Shown:
        def __init__(self, *_):
            pass

        def __enter__(self):
            picture = startup_splash.show(startup_splash.Look())
            assert picture.painted
            sys.exit()

        def __exit__(self, *_):
            pass

    startup_splash.startup_splash = Shown
    from kiosk.cli.main import main
    main()
"""
"""The kiosk's own start; it ends once the picture is on the screen."""

TAP = """
    import os
    import time
    from PySide6.QtCore import QPointF, Qt, QTimer
    from PySide6.QtTest import QTest
    from kiosk.cli import opening
    from kiosk.ui.screens.shell import KioskScreen

    def find(item, name):
        if item.objectName() == name:
            return item
        return next(filter(None, (find(child, name) for child in item.childItems())), None)

    def tap(window):
        button = find(window.contentItem(), "start-en")
        place = button.mapToScene(QPointF(button.width() / 2, button.height() / 2)).toPoint()
        wall, used = time.monotonic(), time.process_time()

        def shown():
            if pages:
                print(time.process_time() - used, time.monotonic() - wall, flush=True)
                os._exit(0)

        pages.clear()
        window.frameSwapped.connect(shown)
        QTest.mouseClick(window, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, place)

    def ready(window, call):
        def drawn():
            call()
            QTimer.singleShot(0, lambda: tap(window))

        after_first_frame(window, drawn)

    def show(kiosk, page):
        pages.append(page)
        shows(kiosk, page)

    pages = []
    shows, KioskScreen.show = KioskScreen.show, show
    after_first_frame, opening.after_first_frame = opening.after_first_frame, ready
    from kiosk.cli.main import main
    main()
"""
"""The kiosk's own start, and a tap on the start screen in the first moment in which it is taken."""

EMPTY_COMMAND = """
    import click

    @click.command()
    def main():
        click.echo("nothing")

    main()
"""

COMMANDS = ("--help", "sessions", "events 1", "status", "verify", "run --help", "check --help")


@dataclass(frozen=True)
class Cost:
    """What one start took, in seconds."""

    processor: float
    wall: float


def whole(command: list[str]) -> Cost:
    """Run a program to its end; a command that finds nothing is as good as another."""
    began = time.monotonic()
    with subprocess.Popen(command, env=os.environ | OFFSCREEN, stdout=subprocess.DEVNULL) as child, limited(child):
        _, code, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(code)
    assert child.returncode in {0, BAD_INPUT}, command
    return Cost(used.ru_utime + used.ru_stime, time.monotonic() - began)


def until_ready(folder: Path) -> Cost:
    """Open the kiosk until its start screen is drawn and its loop runs."""
    listener = NotifySocketListener(folder)
    began = time.monotonic()
    command = program("run", "--data", str(folder / "data"))
    with serving(command, env=os.environ | OFFSCREEN | listener.environment, stdout=subprocess.DEVNULL) as child:
        notice = listener.hear(LONG_S)
        used, waited = psutil.Process(child.pid).cpu_times(), time.monotonic() - began
        child.terminate()
        child.wait(LONG_S)
    listener.close()
    assert "READY" in notice
    return Cost(used.user + used.system, waited)


@pytest.fixture(scope="module", autouse=True)
def compiled() -> None:
    """Compile the modules, as the set-up does: a start that compiles those changed since is another one."""
    assert compileall.compile_dir(PACKAGE, quiet=1)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a data folder with one session."""
    folder = tmp_path_factory.mktemp("recorded")
    whole([*program("rehearse", "--headless", "--data", str(folder))])
    return folder


def python(text: str, *arguments: str) -> list[str]:
    """Return the command that runs a program."""
    return [sys.executable, "-c", dedent(text), *arguments]


def beside(benchmark: Any, start: Callable[[], Cost], reference: Callable[[], Cost]) -> None:
    """Measure starts in turns with those of a reference, and tell how many times as long they take."""
    started: list[Cost] = []
    referred: list[Cost] = []
    benchmark.pedantic(
        lambda: started.append(start()),
        setup=lambda: referred.append(reference()),
        rounds=ROUNDS,
        warmup_rounds=1,
    )
    for what in ("processor", "wall"):
        mine, others = (median(getattr(cost, what) for cost in costs[1:]) for costs in (started, referred))
        told = {"ms": round(mine * MS_PER_SECOND), "reference ms": round(others * MS_PER_SECOND)}
        benchmark.extra_info[what] = {**told, "times the reference": round(mine / others, 2)}
    print(f"\n{benchmark.name}: {benchmark.extra_info}")  # noqa: T201 - a benchmark is read on the terminal
    tell_percentiles(benchmark)


@pytest.mark.skipif(sys.platform == "win32", reason="there are no Unix sockets")
@pytest.mark.benchmark(group="start of the kiosk")
def test_start_to_first_picture(benchmark: Any, tmp_path: Path) -> None:
    """From the start of the process until the first picture is on the screen, beside an empty Qt Quick window."""
    start = python(FIRST_PICTURE, "run", "--data", str(tmp_path))
    beside(benchmark, partial(whole, start), partial(whole, python(EMPTY_WINDOW)))


@pytest.mark.skipif(sys.platform == "win32", reason="there are no Unix sockets")
@pytest.mark.benchmark(group="start of the kiosk")
def test_start_to_ready_for_a_tap(benchmark: Any, tmp_path: Path) -> None:
    """From the start of the process until the start screen is drawn and can be tapped."""
    beside(benchmark, lambda: until_ready(tmp_path), partial(whole, python(EMPTY_WINDOW)))


@pytest.mark.benchmark(group="start of the kiosk")
def test_first_tap_to_the_next_page(benchmark: Any, tmp_path: Path) -> None:
    """From a tap in the first moment in which it is taken until the next page is drawn."""
    answers: list[Cost] = []

    def tap() -> None:
        command = python(TAP, "run", "--data", str(tmp_path))
        told = subprocess.run(
            command, env=os.environ | OFFSCREEN, capture_output=True, text=True, check=True, timeout=LONG_S
        )
        answers.append(Cost(*map(float, told.stdout.split())))

    benchmark.pedantic(tap, rounds=ROUNDS, warmup_rounds=1)
    for what in ("processor", "wall"):
        benchmark.extra_info[what] = {"ms": round(median(getattr(each, what) for each in answers[1:]) * MS_PER_SECOND)}
    print(f"\n{benchmark.name}: {benchmark.extra_info}")  # noqa: T201 - a benchmark is read on the terminal


@pytest.mark.skipif(sys.platform == "win32", reason="there are no Unix sockets")
@pytest.mark.benchmark(group="commands")
@pytest.mark.parametrize("words", COMMANDS)
def test_command(benchmark: Any, recorded: Path, words: str) -> None:
    """A command on a data folder with one session, beside a click program that prints a word."""
    data = () if "--help" in words else ("--data", str(recorded))
    start = [*program(*words.split()), *data]
    beside(benchmark, partial(whole, start), partial(whole, python(EMPTY_COMMAND)))
