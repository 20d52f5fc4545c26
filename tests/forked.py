"""A process that has loaded the program once, and runs each command of a test in a copy of itself.

Starting the program takes a second and more, nearly all of it for loading it; a copy starts at once and is a process
of its own, with its own arguments, folder, environment and files. The modules of ``kiosk.cli`` are loaded in the copy,
as they look for the user's folders while they are loaded.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Self

from tests.patience import PATIENCE_S, Program, limited

ROOT = Path(__file__).parents[1]

LOADED = (
    *("kiosk.store.queries", "kiosk.study.loader", "kiosk.export.dataset", "kiosk.ui.app", "kiosk.ui.rehearsed_day"),
    # What is loaded late, so that a kiosk opens sooner, or by few commands.
    *("kiosk.study.checks", "kiosk.robots.sound_device", "miniaudio", "click", "rich.table", "rich.live"),
)

ANALYSES = (
    *("kiosk.analysis.calibrate", "kiosk.analysis.plan", "kiosk.analysis.policy_figures", "kiosk.analysis.power"),
    *("kiosk.analysis.report_page", "kiosk.training.simulation", "matplotlib.backends.backend_svg", "scipy.stats"),
)
"""What the commands of the analysis take a second and more to load."""

PLAYED = """
from dataclasses import replace
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import QTable
from kiosk.training.learning import RECIPES, Learner, Reward
from kiosk.training.simulated_players import MemoryPlayer
from kiosk.training.simulation import record_games, simulate_games
simulate_games(QTable.named("default"), MemoryPlayer(), TargetRule.MOST_RECENT, 2, 1)
list(record_games(QTable.named("default"), MemoryPlayer(), TargetRule.MOST_RECENT, 1, 1))
Learner(replace(RECIPES[Reward.RETRIEVAL], episodes=2)).study()
"""
"""A few games, after which the compiled rules are in memory."""

LONGEST_S = 300
"""A command that is at work for longer is ended, so that its test fails and the others go on."""

SERVER = """
import atexit, gc, json, os, signal, sys, threading
from importlib import import_module
for name in sys.argv[1:]:
    import_module(name)
from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS
for folder in (ASSETS / "sentences").iterdir():
    # Its parsed files stay in memory.
    Catalogue(folder)
@FIRST@
assert "kiosk.cli" not in sys.modules
gc.freeze()
for line in iter(sys.stdin.readline, ""):
    job = json.loads(line)
    child = os.fork()
    if child:
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
        continue
    os.setsid()
    signal.alarm(job["longest_s"])
    os.chdir(job["folder"])
    os.environ.clear()
    os.environ.update(job["environment"])
    for number, name in enumerate(("in", "out", "err")):
        file = os.open(job[name], os.O_RDWR)
        os.dup2(file, number)
        os.close(file)
    sys.stdin, sys.stdout, sys.stderr = open(0), open(1, "w"), open(2, "w")
    sys.argv = ["recollect", *job["arguments"]]
    try:
        exec(job["program"])
    except SystemExit as end:
        if not isinstance(end.code, str) and sys.modules["PySide6.QtCore"].QCoreApplication.instance() is None:
            # Without a window there is nothing to be taken down but the shared memory, and that takes long.
            threading._shutdown()
            atexit._run_exitfuncs()
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(end.code or 0)
        raise
    sys.exit()
"""

PROGRAM = "from kiosk.cli.main import main\nmain()\n"

CHECKED = """
import kiosk.cli.check
from kiosk.cli.main import main
from kiosk.preflight import CheckResult
kiosk.cli.check.run_check_process = lambda what, *_: [CheckResult.ok(what, "tried once")]
main()
"""
"""The program, which does not start the processes that draw and look for screens for each form of a command."""

LEAST_SPOKEN = """
import kiosk.cli.devices
from kiosk.cli.main import main
spoken_texts = kiosk.cli.devices.spoken_texts
kiosk.cli.devices.spoken_texts = lambda plan: spoken_texts(plan)[::20]
main()
"""
"""The program, which renders every twentieth sentence of a voice only."""


class LoadedProgram:
    """The program, loaded and waiting for commands."""

    def __init__(self, *modules: str, first: str = "", python: str | Path = sys.executable) -> None:
        """Load further modules, and run what is to be done once before all commands."""
        command = [python, "-c", SERVER.replace("@FIRST@", first), *LOADED, *modules]
        self._server = Program(command, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        # It ends with its input.
        with limited(self._server):
            self._server.communicate()

    def run(
        self,
        arguments: Sequence[str],
        folder: Path,
        environment: Mapping[str, str],
        typed: str = "",
        program: str = PROGRAM,
    ) -> subprocess.CompletedProcess[str]:
        """Run a command to its end, in a folder, and return its exit code and what it said."""
        with TemporaryDirectory() as files:
            said = {name: Path(files) / name for name in ("in", "out", "err")}
            for name, file in said.items():
                file.write_text(typed if name == "in" else "", "utf-8")
            job = {name: str(file) for name, file in said.items()} | {
                "arguments": list(arguments),
                "folder": str(folder),
                "environment": dict(environment),
                "program": program,
                "longest_s": LONGEST_S,
            }
            with limited(self._server, LONGEST_S + PATIENCE_S):
                self._server.stdin.write(json.dumps(job) + "\n")
                self._server.stdin.flush()
                code = int(self._server.stdout.readline())
            return subprocess.CompletedProcess(
                list(arguments), code, said["out"].read_text("utf-8"), said["err"].read_text("utf-8")
            )
