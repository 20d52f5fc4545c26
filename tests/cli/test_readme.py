"""After the README's first command, every row of docs/reference/what-to-type.md works as it is printed."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from unittest.mock import patch

import pytest

from kiosk.experiment.events import SessionStarted
from kiosk.experiment.outcomes import SessionKind
from kiosk.sd_notify import NotifySocketListener
from kiosk.store.recorder import Provenance, Recorder
from tests.forked import CHECKED, LEAST_SPOKEN, PROGRAM, LoadedProgram
from tests.packaging.scripts import load
from tests.patience import started
from tests.samples import WITH_PIN, plan
from tests.store.visitors import new_code
from tests.store.visitors import rows as rows_of

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the commands are run in a Unix shell's way")

SMALL = """
languages = ["en"]
stages = ["introduction", "game", "result"]
[game]
rows = 2
columns = 5
"""
"""The smallest board that takes as many flips as the page asks about."""
LESS = {
    "train": ("--episodes", "200"),
    "simulate": ("--games", "50"),
    "rehearse": ("--study", "smallest.toml"),
}
"""What makes long work short; nothing else of a row is changed, but for what stands in capitals."""
LESS_OF_A_REPLAY = ("--speed", "32")
"""The same for a replay that is looked at later."""
ONE_LAYOUT = ("--layout", "wide")
"""The same for the pictures of a rehearsal; tests/test_story.py has those of both layouts."""

TRIED_BY_ROWS = {"rehearse", "replay", "check", "run", "report", "status"}
"""Commands of a tutorial that take long or need a kiosk; the rows try all but the report."""

DECK = ("owl", "frog")
SPOKEN = """
languages = ["en"]
stages = ["introduction", "game", "result"]
[game]
rows = 2
columns = 2
deck = "cards"
"""
"""A study with a deck of two cards, of which there is less to be said than of the shipped ones."""

LEFT_AT_ONCE = """
import sys
from PySide6.QtCore import QTimer
from kiosk.cli.main import main
from kiosk.ui.event_loop import EventLoop
run = EventLoop.run
def leave(loop):
    QTimer.singleShot(0, loop.quit)
    run(loop)
EventLoop.run = leave
main()
"""
"""The program, with a person who leaves every window as soon as it opens."""


def rows() -> list[str]:
    """Every command of the page on what to type."""
    table = (
        (ROOT / "docs" / "reference" / "what-to-type.md").read_text("utf-8").split("| command |")[1].split("\n\n")[0]
    )
    cells = [line.split(" | ")[0] for line in table.splitlines() if line.startswith("| `")]
    return [command for cell in cells for command in re.findall(r"`([^`]+)`", cell)]


@dataclass
class Newcomer:
    """A person with a fresh checkout and no screen, who has typed the first command."""

    home: Path
    loaded: LoadedProgram

    @property
    def environment(self) -> dict[str, str]:
        """What their shell has."""
        return os.environ | {
            "XDG_DATA_HOME": str(self.home / "share"),
            "XDG_RUNTIME_DIR": str(self.home),
            "QT_QPA_PLATFORM": "offscreen",
            "PYTHONPATH": str(ROOT),
        }

    def run(self, arguments: Sequence[str], program: str = PROGRAM) -> subprocess.CompletedProcess[str]:
        """Run the program in their home."""
        return self.loaded.run(arguments, self.home, self.environment, "258013\n258013\n", program)


def play(newcomer: Newcomer, kind: SessionKind) -> None:
    """Begin a session in their data folder."""
    with Recorder(newcomer.home / "share" / "recollect") as recorder:
        recorder.begin(Provenance(plan(), 2, "avatar", "a test", kind=kind), [SessionStarted(at_ms=0)])


def bootstrap() -> ModuleType:
    """Return the file that the first command runs."""
    return load("bootstrap")


@pytest.fixture(scope="module")
def loaded() -> Iterator[LoadedProgram]:
    """Provide the program, loaded once for all rows."""
    with LoadedProgram() as program:
        yield program


@pytest.fixture(scope="module")
def begun(tmp_path_factory: pytest.TempPathFactory, loaded: LoadedProgram) -> Path:
    """Return a home in which ``bootstrap.py start`` has been run; it is installed already."""
    newcomer = Newcomer(tmp_path_factory.mktemp("home"), loaded)
    start = bootstrap()
    said: list[str] = []

    def run(command: Sequence[str], environment: Mapping[str, str]) -> int:
        del environment
        shorter = ("--study", "spoken.toml", "--out", "pack") if command[1] == "voice" else ()
        done = newcomer.run([*command[1:], *shorter], LEAST_SPOKEN if shorter else PROGRAM)
        assert done.stderr == ""
        return done.returncode

    with (
        patch.object(start, "ROOT", newcomer.home / "checkout"),
        patch.object(start, "has_screen", lambda _: False),
        patch.object(start, "install_debian_packages", lambda *_: None),
        patch.object(start, "install_python_packages", lambda **_: None),
        patch.object(start, "run", run),
        patch.object(start, "say", said.append),
    ):
        (newcomer.home / "small.toml").write_text(SMALL)
        (newcomer.home / "spoken.toml").write_text(SPOKEN)
        (newcomer.home / "cards").mkdir()
        for card in DECK:
            shutil.copy(ROOT / "assets" / "cards" / "animals" / f"{card}.svg", newcomer.home / "cards")
        assert start.start(["--study", "small.toml", *ONE_LAYOUT]) == 0
    assert said[-1].splitlines()[2].startswith("  source .venv/bin/activate")
    assert "recollect study new my-study" in said[-1], "it ends with what to do next"
    assert list((newcomer.home / "checkout" / "rehearsals" / "first").glob("*.png"))
    assert list((newcomer.home / "pack").iterdir())
    return newcomer.home


@pytest.fixture
def newcomer(begun: Path, tmp_path: Path, loaded: LoadedProgram) -> Newcomer:
    """Return the same home for every row, so that none depends on what another one did."""
    shutil.copytree(begun / "share", tmp_path / "share")
    (tmp_path / "smallest.toml").write_text(SMALL.replace("5", "2"))
    return Newcomer(tmp_path, loaded)


@pytest.mark.parametrize("row", rows())
def test_every_row_works_as_it_is_printed(row: str, newcomer: Newcomer) -> None:
    typed, _, into = row.partition(" > ")
    name, *arguments = shlex.split(typed)
    assert name == "recollect"
    command = arguments[0] if arguments else ""
    if "study.toml" in row and not into:
        (newcomer.home / "study.toml").write_text(WITH_PIN)
    if "--supervise" in arguments:
        assert is_kept_up(newcomer, arguments)
        return
    has_a_window = command in {"", "replay"}
    how = LEFT_AT_ONCE if has_a_window else CHECKED if command == "check" else PROGRAM
    less = LESS_OF_A_REPLAY if {"--film", "--headless"} & set(arguments) and command == "replay" else ()
    less = (*LESS.get(command, less), *(ONE_LAYOUT if "--shots" in arguments else ()))
    done = newcomer.run([*filled_in(newcomer, arguments), *less], how)
    assert "Traceback" not in done.stderr
    if command == "status":
        # No kiosk runs here: either none ever has, or one that was left.
        assert (done.returncode, "no kiosk has run" in done.stderr) in {(2, True), (3, False)}
        return
    assert done.stdout.strip()
    match command:
        case "robot":
            assert (done.returncode, done.stdout.startswith("FAIL is it there")) == (1, True)
        case "check":
            # It depends on the machine that the tests run on.
            assert done.returncode in {0, 1}
        case _:
            assert done.returncode == 0, done.stderr
    if command in {"sessions", "events", "replay", "explain", "export", "backup", "verify", "withdraw"}:
        assert f"the rehearsals in {newcomer.home / 'share' / 'recollect' / 'rehearsals'}" in done.stderr


def filled_in(newcomer: Newcomer, arguments: Sequence[str]) -> list[str]:
    """Return a row with something for all that stands in capitals, and a day of a booth that is over soon."""
    rehearsals = newcomer.home / "share" / "recollect" / "rehearsals"
    given = {"H": "127.0.0.1", "ALL": "all", "200": "2", "A": str(rehearsals), "B": str(newcomer.home / "other")}
    if "CODE" in arguments:
        ((session,),) = rows_of(rehearsals, "SELECT max(session) FROM participant")
        given["CODE"] = new_code(rehearsals, session)
        # There is no one to ask here.
        arguments = [*arguments, "--yes"]
    if "B" in arguments:
        with Recorder(Path(given["B"]), "B") as recorder:
            recorder.begin(
                Provenance(plan(), 2, "avatar", "a test", kind=SessionKind.SIMULATED), [SessionStarted(at_ms=0)]
            )
    return [given.get(argument, argument) for argument in arguments]


def is_kept_up(newcomer: Newcomer, arguments: Sequence[str]) -> bool:
    """Whether a supervisor brings a kiosk up, and ends with it."""
    listener = NotifySocketListener(newcomer.home)
    command = [sys.executable, "-m", "kiosk", *arguments]
    environment = newcomer.environment | listener.environment
    with started(command, cwd=newcomer.home, env=environment) as supervisor:
        while "READY" not in listener.hear(60):
            assert supervisor.poll() is None
        supervisor.terminate()
    listener.close()
    return supervisor.returncode == 0


@pytest.mark.parametrize(
    ("tutorial", "commands", "made"),
    [
        (
            "first-study.md",
            "study study study sessions events explain export study",
            ("my-study/study.toml", "cards.png", "data-set/documentation/codebook.md"),
        ),
        (
            "fair-day.md",
            "study study sessions day verify backup export",
            ("fair-study/study.toml", "today.html", "copies", "fair-data/README.md"),
        ),
    ],
)
def test_a_tutorial_can_be_followed(newcomer: Newcomer, tutorial: str, commands: str, made: tuple[str, ...]) -> None:
    page = (ROOT / "docs" / "tutorials" / tutorial).read_text("utf-8")
    if "--data rehearsals" in page:
        # It shows the same to those who have played a trial before.
        play(newcomer, SessionKind.TRIAL)
    followed = []
    for line, text in re.findall(r"^    recollect (.*)\n((?:(?!    recollect ).*\n?)*)", page, flags=re.M):
        arguments = shlex.split(line)
        if arguments[0] == "rehearse" and "--data" in arguments:
            rehearsed = newcomer.home / arguments[arguments.index("--data") + 1]
            shutil.copytree(newcomer.home / "share" / "recollect" / "rehearsals", rehearsed, dirs_exist_ok=True)
        if arguments[0] in TRIED_BY_ROWS:
            continue
        done = newcomer.run(arguments)
        assert (done.returncode, "Traceback" in done.stderr) == (0, False), (arguments, done.stderr)
        assert [seen for seen in re.findall(r"You see `([^`]+)`", text) if seen not in done.stdout] == []
        followed.append(arguments[0])
    assert followed == commands.split()
    assert [place for place in made if not (newcomer.home / place).exists()] == []


def test_what_was_not_rehearsed_yet_is_not_there(tmp_path: Path, loaded: LoadedProgram) -> None:
    done = Newcomer(tmp_path, loaded).run(["sessions"])
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"recollect: there is no database in {tmp_path / 'share' / 'recollect'}\n"


def test_what_people_did_goes_before_rehearsals(newcomer: Newcomer) -> None:
    # A kiosk that was opened and left has a database without participants.
    assert newcomer.run([], LEFT_AT_ONCE).returncode == 0
    assert "about the rehearsals" in newcomer.run(["sessions"]).stderr
    assert newcomer.run(["verify"]).stderr == ""
    play(newcomer, SessionKind.TRIAL)
    rehearsals = newcomer.home / "share" / "recollect" / "rehearsals"
    done = newcomer.run(["sessions", "--json"])
    assert "Only trials are stored" in done.stderr
    assert f"--data {rehearsals}\n" in done.stderr
    assert done.stdout.count('"session": 1,') == 1
    assert newcomer.run(["sessions", "--data", str(rehearsals)]).stderr == ""
    play(newcomer, SessionKind.STUDY)
    done = newcomer.run(["sessions", "--json"])
    assert (done.stderr, done.stdout.count('"session": 2,')) == ("", 1)
