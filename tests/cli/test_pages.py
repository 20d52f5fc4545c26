"""Every command of the pages runs as it is printed; tests/cli/test_readme.py follows the tutorials and what to type."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

import numpy as np
import pytest

from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import Stage
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.robots.clips import Clip
from kiosk.study.wording_drafts import Candidate, Draft, State
from kiosk.training.simulated_players import PEOPLE_FORMAT
from tests.cli.test_readme import DECK, LEFT_AT_ONCE, ONE_LAYOUT, rows
from tests.experiment.driver import Driver, at_random
from tests.export.visitors import store, visitor
from tests.forked import ANALYSES, CHECKED, LEAST_SPOKEN, PLAYED, PROGRAM, LoadedProgram
from tests.patience import PATIENCE_S
from tests.robots.furhat_fake import FurhatFake
from tests.samples import ANIMALS, WITH_PIN, plan
from tests.store.visitors import new_code
from tests.test_docs import PAGES, typed_commands

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the commands are run in a Unix shell's way")

HAS_SSH = shutil.which("ssh-keygen") is not None
FOLLOWED_ELSEWHERE = {"first-study.md", "fair-day.md", "what-to-type.md"}

NOT_RUN = {
    "backup --to stick*": "needs a stick: tests/cli/test_backup.py",
    "run --supervise *": "stays until it is stopped: tests/cli/test_supervise.py",
    "open-day *": "stays until it is stopped: tests/cli/test_open_day.py",
    "robot --pretend": "stays until Ctrl+C: tests/cli/test_robot.py",
    "check --watch": "stays until Ctrl+C: tests/cli/test_check.py",
    "browse --open": "stays until Ctrl+C, and opens a browser",
    "watch --broker *": "needs a broker: tests/test_remote.py",
    "study wording draft *": "needs a server with a language model: tests/study/test_wording_drafts.py",
    "plan power * --scheduler *": "needs a cluster: tests/analysis/test_plan.py",
    "train --action encourage *": "needs a package that the page has you write: tests/plugins",
    "study check my-study/study.toml --pages": "goes through a whole study; study.toml is smaller",
    "voice render": "renders every sentence for minutes; it is run with --study and --language",
    "voice play *": "needs a sound device: tests/robots/test_sound_device.py",
    "plan look *": "needs participants under a frozen plan: tests/analysis/test_plan.py",
    "policy evidence *": "trains tables for minutes, however few games it plays: tests/training/test_simulation.py",
}
"""Commands that are only parsed, and why."""

OTHER_PROGRAMS = {
    "pip": "changes the environment, and needs the network",
    "cyclonedx-py": "has to be installed first",
    "python3": "installs what is missing, or builds: tests/packaging",
    "sudo": "needs root",
    "dask": "needs several machines: tests/analysis/test_plan.py",
}
"""Programs besides ``recollect`` that blocks of the pages call, and why they are not run."""

LESS = {
    "train *": ("--episodes", "200"),
    "simulate *": ("--games", "50"),
    "policy card *": ("--games", "200"),
    "rehearse * --shots *": ("--study", "smallest.toml", *ONE_LAYOUT),
    "rehearse *": ("--study", "smallest.toml", "--sessions", "1"),
    "replay * --frames *": ("--speed", "32"),
    "replay * --film *": ("--speed", "32"),
    "plan power *": ("--studies", "10", "--n", "6", "--workers", "1"),
    "plan freeze plan.toml": ("--data", "new-data"),
    "voice import *": ("--study", "study.toml", "--language", "en"),
    "check --say": ("--study", "study.toml"),
    "check --study study.toml*": ("--study", "smallest.toml"),
}
"""What makes long work short; nothing else of a command is changed, but for what is yours to fill in."""

IN_ONE_LANGUAGE = ("study dossier *", "study check * --pages")
"""Commands that go through every language of a study in a window of its own."""

MADE_BEFORE = (
    "plan new plan.toml",
    "train --out table.json",
    "voice render --study study.toml --language en --out voices/anna",
)
"""What the examples of a command take from another one."""

NAMED = ("data-set", "study", "simulated", "both", "DIR", "booth-1", "booth-2", "recordings", "voices")
"""Folders with most of the files of a desk; a command reads them only if it names them."""

SMALLEST_WINDOW = """
import kiosk.cli.page_walk
from kiosk.cli.main import main
kiosk.cli.page_walk.SIZES = kiosk.cli.page_walk.SIZES[:1]
main()
"""
"""The program, which goes through pages in one window for each language; tests/ui/test_walked_pages.py has others."""

WITHOUT_A_WINDOW = {"--headless", "--film", "--frames"}

RUN_ONCE = ("check --study study.toml", "study set-pin")
"""Commands of many pages that change nothing and do the same everywhere."""

CODES = {
    "check *": {0, 1},
    "robot --study *": {2},
    "status*": {2},
    "study diff *": {0, 1},
    # Of the voice that the tests render, most sentences are missing.
    "voice missing *": {1},
    # One short session is too few for a report; tests/analysis has whole ones.
    "report beyond *": {2},
}
"""Exit codes of commands that look for something which the tests or their machine do not have."""

SMALLEST = """
languages = ["en"]
stages = ["introduction", "game", "result"]
[game]
rows = 2
columns = 2
"""
STUDY = f"""
languages = ["en", "it"]
stages = ["introduction", "game", "result"]
[game]
rows = 2
columns = 2
deck = "./cards"
{WITH_PIN}
"""
TAKEN = {
    "en": "You have met one { $card } card once, and the other not yet.",
    "it": "Hai visto una volta una carta con { $card-il }, l'altra non ancora.",
}
"""What a model drafted for a hint, and a person took."""
ITEMS = "id,kind,text_en,points,lowest_en,highest_en\nT1,likert,I trust it.,5,not at all,very much\n"
RATE = 16_000
AGE_KEY = "age1ql3z7hjy54pw3hyww5ayyfg7zqgvc7w3j2elw8zmrj2kg5sfn9aqmcac8p"
PEOPLE = {"format": PEOPLE_FORMAT, "forgetting_mean": -1.4, "forgetting_spread": 0.5, "follow": 0.9, "lapse": 0.0}


@dataclass(frozen=True)
class Block:
    """The commands of a page, or of one command's examples on the page with all of them."""

    name: str
    commands: tuple[str, ...]

    @property
    def written(self) -> set[str]:
        """What its commands make anew, so that it must not be there before."""
        return set(re.findall(r"(?:--out|--write|study new|plan new) (\S+)", "\n".join(self.commands)))

    @property
    def unread(self) -> set[str]:
        """Folders that none of its commands names, so that they need not be there."""
        return set(NAMED) - {word.partition("/")[0] for command in self.commands for word in shlex.split(command)[1:]}


def blocks() -> Iterator[Block]:
    """Yield what is to be run, by page; an example of a command that stands on another page is run there."""
    texts = {page.relative_to(ROOT).as_posix(): page.read_text("utf-8") for page in PAGES}
    every = texts.pop("docs/reference/commands.md")
    elsewhere = {command for text in texts.values() for command in typed_commands(text)}
    elsewhere |= {row.removeprefix("recollect ") for row in rows()}
    yield from (
        Block(name, tuple(typed))
        for name, text in texts.items()
        if name.split("/")[-1] not in FOLLOWED_ELSEWHERE and (typed := typed_commands(text))
    )
    for part in every.split("\n## ")[1:]:
        examples = [each for each in typed_commands(part.partition("For example:")[2]) if each not in elsewhere]
        if examples:
            yield Block(part.split("\n")[0], tuple(examples))


BLOCKS = list(blocks())


def why_not(command: str) -> str:
    """Return the pattern of a command that is not run, or nothing."""
    return next((pattern for pattern in NOT_RUN if fnmatch(command, pattern)), "")


@dataclass(frozen=True)
class Desk:
    """What a person has before they open a page: stored sessions, a study, tables, data sets, recordings."""

    folder: Path
    home: Path
    code: str

    @property
    def environment(self) -> dict[str, str]:
        """What their shell has."""
        return os.environ | {
            "HOME": str(self.home),
            "XDG_DATA_HOME": str(self.home / "share"),
            "XDG_RUNTIME_DIR": str(self.home),
            "QT_QPA_PLATFORM": "offscreen",
            "PYTHONPATH": str(ROOT),
        }


def a_visit(seed: int) -> Driver:
    """Return a session on the smallest board, which is soon replayed; after some seeds it has few flips."""
    driver = Driver(plan(stages=("introduction", "game", "result"), game={"rows": 2, "columns": 2}), seed)
    driver.to(Stage.GAME)
    choose = at_random(seed)
    while driver.stage is Stage.GAME:
        driver.wait_until_open()
        if driver.view.closed:
            driver.tap(choose(driver.view))
    driver.to(Stage.OVER)
    return driver


@pytest.fixture(scope="module")
def loaded() -> Iterator[LoadedProgram]:
    """Provide the program, loaded once for all pages."""
    with LoadedProgram(*ANALYSES, first=PLAYED) as program:
        yield program


@pytest.fixture(scope="module")
def desk(loaded: LoadedProgram, tmp_path_factory: pytest.TempPathFactory) -> Desk:
    """Return the folder that each page gets a copy of."""
    folder = tmp_path_factory.mktemp("desk")
    home = tmp_path_factory.mktemp("home")
    stored = home / "share" / "recollect"
    two = (Condition.TOM, Condition.NOTOM)
    people = [(visitor(seed, two[seed % 2]), seed) for seed in range(2, 12)]
    store(stored, [(a_visit(14), 1), *people, (a_visit(6), 12)])
    code = new_code(stored, 2)
    for name in ("both", "DIR"):
        shutil.copytree(stored, folder / name)
    for name, site in (("booth-1", "ROME"), ("booth-2", "PISA")):
        store(folder / name, [(a_visit(6), 3)], site=site)
    export_dataset(stored, folder / "data-set", PsychDs)
    for name in ("study", "simulated"):
        shutil.copytree(folder / "data-set", folder / name)
    _write_studies(folder)
    _make_key(home, folder / "signers.txt")
    (folder / "items.csv").write_text(ITEMS, "utf-8")
    (folder / "people.json").write_text(json.dumps(PEOPLE), "utf-8")
    case = {"board": [*ANIMALS, *ANIMALS], "flips": [0, 1, 0, 2], "last_action": "no_help"}
    case |= {"condition": "tom", "policy": "default", "language": "en"}
    (folder / "case.json").write_text(json.dumps(case), "utf-8")
    for number in range(1, 4):
        tone = 0.1 * np.sin(2 * np.pi * 300 * np.arange(RATE // 2) / RATE)
        (folder / "recordings").mkdir(exist_ok=True)
        Clip.of(tone, RATE).write(folder / "recordings" / f"{number:03}.wav")
    made = Desk(folder, home, code)
    for command in MADE_BEFORE:
        assert typed(command, made, loaded).returncode == 0, command
    smaller(folder / "plan.toml")
    return made


def _make_key(home: Path, signers: Path) -> None:
    """Make a person's key, and the list of those who may sign, where SSH is installed."""
    if not HAS_SSH:
        return
    key = home / ".ssh" / "id_ed25519"
    key.parent.mkdir()
    subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", str(key)], check=True, timeout=PATIENCE_S)  # noqa: S607
    signers.write_text(f"pi@lab.example {key.with_suffix('.pub').read_text('utf-8')}", "utf-8")


def _write_studies(folder: Path) -> None:
    """Write the study files that pages name, with a deck and a wording of their own."""
    for name in (".", "my-study"):
        (folder / name / "cards").mkdir(parents=True)
        (folder / name / "study.toml").write_text(STUDY, "utf-8")
        (folder / name / "pilot.toml").write_text(STUDY, "utf-8")
        for card in DECK:
            shutil.copy(ROOT / "assets" / "cards" / "animals" / f"{card}.svg", folder / name / "cards")
        for language, text in TAKEN.items():
            drafted = {"reason-first-one-seen-once": [Candidate(text, state=State.TAKEN)]}
            Draft(language, "warm", "tiny", "2026-05-01", drafted).write(folder / name / "wording")
    (folder / "questionnaires").mkdir()
    (folder / "smallest.toml").write_text(SMALLEST, "utf-8")


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: block.name)
def test_every_command_of_a_page_works_as_it_is_printed(
    block: Block, desk: Desk, loaded: LoadedProgram, tmp_path: Path
) -> None:
    here = tmp_path / "here"
    away = block.written | block.unread
    shutil.copytree(desk.folder, here, ignore=lambda _, names: away & set(names))
    shutil.copytree(desk.home, tmp_path / "home")
    at_work = Desk(here, tmp_path / "home", desk.code)
    for command in block.commands:
        if why_not(command) or command in RUN_ONCE or (not HAS_SSH and "sign" in command and "wording" not in command):
            continue
        done = typed(command, at_work, loaded)
        code, expected = done.returncode, next((CODES[each] for each in CODES if fnmatch(command, each)), {0})
        assert (code in expected, "Traceback" in done.stderr) == (True, False), (command, code, done.stderr)
        if command.startswith("plan new"):
            smaller(here / "plan.toml")


@pytest.mark.parametrize("command", RUN_ONCE)
def test_what_many_pages_have_you_type_works(command: str, desk: Desk, loaded: LoadedProgram) -> None:
    assert sum(command in block.commands for block in BLOCKS) > 1
    done = typed(command, desk, loaded)
    assert (done.returncode in {0, 1}, "Traceback" in done.stderr) == (True, False), done.stderr


def typed(command: str, desk: Desk, loaded: LoadedProgram) -> subprocess.CompletedProcess[str]:
    """Run a command of a page with what is yours to fill in, and short work."""
    given = {"7KQ2M-XR4T4": desk.code, "FILE": "items.csv", "age1...": AGE_KEY}
    if any(fnmatch(command, pattern) for pattern in IN_ONE_LANGUAGE):
        given["study.toml"] = "smallest.toml"
    words = [given.get(word, word).replace("~", str(desk.home)) for word in shlex.split(command)]
    less = next((more for pattern, more in LESS.items() if fnmatch(command, pattern)), ())
    yes = ("--yes",) if words[0] == "withdraw" else ()
    if "--host" not in words:
        return loaded.run([*words, *less, *yes], desk.folder, desk.environment, "258013\n258013\n", less_of(words))
    with FurhatFake(character_ms=2) as robot:
        words[words.index("--host") + 1] = "127.0.0.1"
        return loaded.run([*words, "--port", str(robot.port)], desk.folder, desk.environment)


def less_of(words: list[str]) -> str:
    """Return the program that a command is run with."""
    match words:
        case ["run" | "replay", *_] | ["study", "preview", *_] if WITHOUT_A_WINDOW.isdisjoint(words):
            return LEFT_AT_ONCE
        case ["check", *_]:
            return CHECKED
        case ["voice", "render", *_]:
            return LEAST_SPOKEN
        case ["study", "check", *_] if "--pages" in words:
            return SMALLEST_WINDOW
        case _:
            return PROGRAM


def smaller(file: Path) -> None:
    """Make a plan of few participants of it."""
    file.write_text(re.sub(r"^n_per_arm = \d+", "n_per_arm = 6", file.read_text("utf-8"), flags=re.M), "utf-8")


def test_every_command_that_is_not_run_is_on_a_page() -> None:
    commands = {command for block in BLOCKS for command in block.commands}
    assert {why_not(command) for command in commands} - {""} == set(NOT_RUN)


def test_every_program_that_is_not_run_is_on_a_page() -> None:
    lines = "\n".join(page.read_text("utf-8") for page in PAGES)
    assert [name for name in OTHER_PROGRAMS if not re.search(rf"^(    )?{name} ", lines, flags=re.M)] == []


def test_the_lines_for_pandas_read_the_data_set(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pandas")
    monkeypatch.chdir(desk.folder)
    exec(lines_of("analyse.md", "python"), {})  # noqa: S102 - a page's own lines


@pytest.mark.skipif(shutil.which("Rscript") is None, reason="there is no R here")
def test_the_lines_for_r_read_the_data_set(desk: Desk) -> None:
    command = ["Rscript", "-e", lines_of("analyse.md", "r")]
    done = subprocess.run(command, cwd=desk.folder, capture_output=True, text=True, check=False, timeout=PATIENCE_S)
    assert (done.returncode, "notom" in done.stdout) == (0, True), done.stderr


def lines_of(page: str, language: str) -> str:
    """Return the lines of a how-to in a language of programs."""
    return (ROOT / "docs" / "how-to" / page).read_text("utf-8").split(f"```{language}\n")[1].split("```")[0]
