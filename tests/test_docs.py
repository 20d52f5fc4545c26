"""What the documents say is what the program does."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
import zipfile
from pathlib import Path
from queue import SimpleQueue

import click
import pytest
import yaml

from kiosk import __version__
from kiosk.cli.guide import every_command
from kiosk.cli.main import recollect
from kiosk.config import Settings
from kiosk.experiment.transitions import diagram
from tests.packaging.scripts import load
from tests.patience import PATIENCE_S

ROOT = Path(__file__).parent.parent
PAGES = [
    *sorted(ROOT.glob("*.md")),
    ROOT / "tests" / "README.md",
    *sorted((ROOT / "docs").rglob("*.md")),
    *sorted(ROOT.glob("p*/*.md")),
]


REFERENCE, BOOTSTRAP, SITE = load("reference"), load("bootstrap"), load("site_hooks")


def test_the_diagram_of_the_stages_is_drawn_from_the_table() -> None:
    page = (ROOT / "docs" / "explanation" / "how-it-works.md").read_text("utf-8")
    assert f"<!-- stages -->\n```mermaid\n{diagram()}```\n<!-- /stages -->" in page


def test_every_link_of_a_page_leads_somewhere() -> None:
    for page in PAGES:
        links = [link.partition("#") for link in re.findall(r"\]\(([^):]+)\)", page.read_text("utf-8"))]
        targets = [(page.parent / path if path else page, anchor) for path, _, anchor in links]
        assert [str(file) for file, _ in targets if not file.exists()] == [], page
        named = {(file, anchor) for file, anchor in targets if anchor}
        assert [anchor for file, anchor in named if anchor not in anchors(file.read_text("utf-8"))] == [], page


def anchors(page: str) -> set[str]:
    """Return what a link may name on a page: its headings, in small letters and with hyphens."""
    headings = re.findall(r"^#+ (.+)$", page, flags=re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("name", REFERENCE.GENERATED)
def test_a_generated_page_is_as_the_code_gives_it(name: str) -> None:
    page = (ROOT / "docs" / name).read_text("utf-8")
    assert page == REFERENCE.GENERATED[name](), "run `python packaging/reference.py` and commit what it writes"


def typed_commands(page: str) -> list[str]:
    """Return the lines of a page's code blocks that call ``recollect``, without what follows a pipe or a comment.

    A variable of the shell is 1.
    """
    code = re.sub(r"\$[A-Za-z_]+", "1", re.sub(r"\\\n\s*", "", page))
    lines = re.findall(r"^ *(?:\$ )?recollect (.*)$", code, flags=re.M)
    return [re.split(r"\s+(?:#|\||>|&&)\s?", line)[0].strip() for line in lines]


@pytest.fixture(scope="module")
def commands() -> dict[str, click.Command]:
    """Return every command by its name."""
    return dict(every_command(recollect))


def test_every_command_block_is_a_command_that_the_program_takes(
    commands: dict[str, click.Command], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    texts = [page.read_text("utf-8") for page in PAGES if page.name != "commands.md"]
    for typed in dict.fromkeys(command for text in texts for command in typed_commands(text)):
        words = shlex.split(typed)
        depth = next((depth for depth in (3, 2, 1) if " ".join(words[:depth]) in commands), 0)
        name, arguments = (" ".join(words[:depth]), words[depth:]) if depth else ("run", words)
        if "--help" in arguments or typed in {"--help", "--version"}:
            continue
        assert refusal(commands[name], arguments) == "", typed


def refusal(command: click.Command, arguments: list[str]) -> str:
    """Return why a command does not take its arguments; that a file is not there is no reason."""
    try:
        command.make_context(command.name, arguments)
    except click.UsageError as error:
        return "" if "does not exist" in error.format_message() else error.format_message()
    return ""


def test_the_commands_of_a_page_are_found() -> None:
    page = (
        "    recollect check --say  # aloud\n    recollect study \\\n        new DIR\n    recollect events 1 | less\n"
    )
    assert typed_commands(page) == ["check --say", "study new DIR", "events 1"]


def test_every_command_by_task_exists() -> None:
    named = set(
        re.findall(r"`recollect ([a-z][a-z-]*)", (ROOT / "docs" / "reference" / "what-to-type.md").read_text("utf-8"))
    )
    assert named - set(recollect.commands) - set(recollect.list_commands(None)) == set()  # type: ignore[arg-type]


def test_the_contributor_finds_every_task_that_there_is() -> None:
    page = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    assert re.findall(r"^\| `python3 packaging/bootstrap.py (\w+)` \|", page, flags=re.M) == [
        *("start", "check", "fast", "test", "docs", "lock", "packages")
    ]
    assert set(re.findall(r"bootstrap\.py (\w+)", page)) == set(BOOTSTRAP.JOBS)


def test_ci_runs_tasks_that_there_are_on_three_systems_and_every_python() -> None:
    jobs = yaml.safe_load((ROOT / ".github" / "workflows" / "tests.yml").read_text("utf-8"))["jobs"]
    runs = [step["run"] for job in jobs.values() for step in job["steps"] if "run" in step]
    tasks = {task for line in runs for task in re.findall(r"bootstrap\.py (\w+)", line)}
    assert tasks == {"packages", "docs", "fast", "test"}
    matrix = jobs["fast"]["strategy"]["matrix"]
    assert [system.partition("-")[0] for system in matrix["system"]] == ["ubuntu", "windows", "macos"]
    assert matrix["python"] == ["3.11", "3.12", "3.13", "3.14"]


def test_a_commit_is_checked_as_a_change_is() -> None:
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text("utf-8"))["repos"][0]["hooks"]
    entries = [hook["entry"].removesuffix(" --force-exclude") for hook in hooks]
    checks = [" ".join(each).removesuffix(" .").replace(" --check", "") for each in BOOTSTRAP.CHECKS]
    assert entries == checks


def test_the_program_is_cited_by_its_version() -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert (citation["version"], citation["license"]) == (__version__, "MIT")


def test_a_step_that_works_in_silence_says_that_it_is_at_work(monkeypatch: pytest.MonkeyPatch) -> None:
    said: SimpleQueue[str] = SimpleQueue()
    monkeypatch.setattr(BOOTSTRAP, "PROGRESS_S", 0.01)
    monkeypatch.setattr(BOOTSTRAP, "say", said.put)
    with BOOTSTRAP.still_at_work():
        assert said.get(timeout=10) == "  still at work after 0 s"


def test_the_index_lists_every_page_once() -> None:
    docs = ROOT / "docs"
    listed = [
        page for section in SITE.navigation((docs / "README.md").read_text("utf-8"))[1:] for page in pages(section)
    ]
    written = [page.relative_to(docs).as_posix() for page in docs.glob("*/*.md")]
    assert sorted(listed) == sorted(written), "list each page once in docs/README.md"


def pages(section: dict[str, list[dict[str, str]]]) -> list[str]:
    """Return the files of a section of the navigation."""
    return [file for entries in section.values() for entry in entries for file in entry.values()]


def test_every_test_that_holds_a_promise_exists() -> None:
    page = (ROOT / "docs" / "explanation" / "promises.md").read_text("utf-8")
    named = re.findall(r"(tests/[\w/]+\.py)::(\w+)", page)
    rows = re.findall(r"^\| (?!promise|who|---|\[).+\|$", page, flags=re.M)
    assert [row for row in rows if "::test_" not in row] == []
    assert named
    gone = [(file, name) for file, name in named if f"\ndef {name}(" not in (ROOT / file).read_text("utf-8")]
    assert gone == []


def test_a_link_that_leaves_the_pages_is_only_text_in_the_site() -> None:
    written = "[a](../../kiosk/game.py#x) [b](../reference/b.md#c) [d](#e) ![f](../f.png) [g](https://example.org)"
    assert SITE.inside_only(written, "how-to/page.md") == written.replace("[a](../../kiosk/game.py#x)", "a")


def test_the_pages_make_a_site_without_a_broken_link_and_without_a_network(tmp_path: Path) -> None:
    pytest.importorskip("mkdocs")
    settings = ROOT / "packaging" / "mkdocs.yml"
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "-f", str(settings), "-d", str(tmp_path)]
    built = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=PATIENCE_S)
    assert (built.returncode, built.stdout) == (0, ""), built.stderr
    for page in tmp_path.rglob("*.html"):
        loaded = re.findall(r"<(?:script|link|img)[^>]*(?:src|href)=\"?(https?:[^\" >]*)", page.read_text("utf-8"))
        assert loaded == []


def test_the_messages_of_check_are_read_from_the_calls_that_make_them() -> None:
    source = """
ROOM, FREE_MIB = "disk", 500
def room(free, failure):
    words = f"{free} MiB are free"
    yield CheckResult.warning(ROOM, words, f"make room, to {FREE_MIB} MiB")
    yield CheckResult.error(ROOM, str(failure), "see that the disk is there")
    yield CheckResult.error(ROOM, failure.words, failure.remedy)
    yield CheckResult.ok(ROOM, words)
"""
    assert list(REFERENCE.check_messages(source)) == [
        ("WARN", "disk", "… MiB are free", "make room, to 500 MiB"),
        ("FAIL", "disk", "…", "see that the disk is there"),
    ]


def test_the_card_for_the_table_has_every_shortcut() -> None:
    page = (ROOT / "docs" / "reference" / "checklists.md").read_text("utf-8")
    pressed = re.findall(r"^\| .+ \| (Ctrl\+\S+) \|$", page.partition("## The card for the table")[2], flags=re.M)
    assert sorted(pressed) == sorted(Settings().shortcuts.model_dump().values())


def test_the_sample_data_set_has_the_columns_that_an_export_has_today() -> None:
    sample = ROOT / "docs" / "sample" / "memory-at-the-fair.zip"
    tables = re.split(r"^## ", REFERENCE.GENERATED["reference/columns.md"](), flags=re.M)[1:]
    declared = {
        part.split("\n", 1)[0]: {
            name for name in re.findall(r"^\| `(\w+)` \|", part, flags=re.M) if not name.endswith(("_sum", "_mean"))
        }
        for part in tables
    }
    with zipfile.ZipFile(sample) as archive:
        there = {
            name: set(archive.read(file).decode("utf-8").splitlines()[0].split(","))
            for file in archive.namelist()
            for name in declared
            if file.endswith(f"_description-{name}_data.csv")
        }
    assert there.keys() == declared.keys()
    lacking = {name: columns - there[name] for name, columns in declared.items() if columns - there[name]}
    assert lacking == {}, "run `python packaging/make_sample.py` and commit what it writes"
