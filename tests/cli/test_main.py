"""How the command line ends where something cannot be done: in one sentence, with a code that tells why."""

from __future__ import annotations

import errno
import os
import shlex
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from kiosk import StorageError, UserInputError
from kiosk.cli import main
from kiosk.cli.guide import GUIDES, Guide, as_epilog, every_command
from tests.patience import PATIENCE_S

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.parametrize(
    ("failure", "code", "said"),
    [
        (UserInputError("one", "two"), 2, "recollect: one\nrecollect: two\n"),
        (
            StorageError("it cannot be used: disk full"),
            1,
            "recollect: it cannot be used: disk full\n",
        ),
        (
            OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "a.txt"),
            1,
            "recollect: a.txt cannot be written: disk full\n",
        ),
        (OSError(errno.EDQUOT, os.strerror(errno.EDQUOT)), 1, "recollect: disk full\n"),
    ],
    ids=lambda each: type(each).__name__,
)
def test_a_refusal_and_a_full_disk_end_with_a_sentence_and_their_own_codes(
    failure: Exception, code: int, said: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail() -> None:
        raise failure

    monkeypatch.setattr(main, "recollect", fail)
    with pytest.raises(SystemExit) as end:
        main.main()
    assert end.value.code == code
    assert capsys.readouterr().err == said


def test_a_fault_of_ours_is_not_called_a_full_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail() -> None:
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))

    monkeypatch.setattr(main, "recollect", fail)
    with pytest.raises(PermissionError):
        main.main()


def test_the_help_lists_each_command_by_the_first_sentence_of_its_own_help() -> None:
    context = click.Context(main.recollect)
    for name in main.recollect.list_commands(context):
        command = main.recollect.get_command(context, name)
        assert command is not None
        assert main._COMMANDS[name][1] == command.get_short_help_str(200)


@cache
def commands() -> dict[str, click.Command]:
    """Return every command by its name; loading them all takes a second, so it waits for the first test."""
    return dict(every_command(main.recollect))


MISSING_GUIDE = "add an example and a page for it to GUIDES in kiosk/cli/guide.py"
PLAIN_WIDTH = 80


def groups(group: click.Group, path: str = "recollect") -> Iterator[tuple[str, click.Group]]:
    """Yield a group and all groups in it, with what is typed for each."""
    yield path, group
    context = click.Context(group)
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        if isinstance(command, click.Group):
            yield from groups(command, f"{path} {name}")


def test_no_line_of_a_list_of_commands_is_cut() -> None:
    for path, group in groups(main.recollect):
        lines = group.get_help(click.Context(group, info_name=path, terminal_width=PLAIN_WIDTH)).splitlines()[1:]
        cut = [line for line in lines if line.endswith("...") or len(line) > PLAIN_WIDTH]
        assert cut == [], f"shorten the first sentence of the docstring, for {path} --help"


def test_every_command_has_an_example_and_a_page() -> None:
    assert set(commands()) - set(GUIDES) == set(), MISSING_GUIDE
    assert set(GUIDES) - set(commands()) == set(), "a guide is about a command that is not there"
    assert [name for name, guide in GUIDES.items() if not guide.examples] == []
    assert [guide.page for guide in GUIDES.values() if not (DOCS / guide.page).exists()] == []


@pytest.mark.parametrize(("name", "guide"), GUIDES.items(), ids=GUIDES)
def test_the_examples_of_a_command_are_commands_that_it_takes(
    name: str, guide: Guide, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("recordings").mkdir()
    for example in guide.examples:
        words = shlex.split(example)
        depth = len(name.split())
        assert " ".join(words[:depth]) == name
        commands()[name].make_context(name, words[depth:])
    assert commands()[name].epilog == as_epilog(guide)


def test_a_command_prints_json_or_the_reference_says_why_not() -> None:
    for name, command in commands().items():
        takes_json = any("--json" in parameter.opts for parameter in command.params)
        remedy = "add json_option, or why_no_json in kiosk/cli/guide.py"
        assert takes_json != bool(GUIDES[name].why_no_json), f"{name}: {remedy}"


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("sesions", "there is no command 'sesions'; did you mean 'sessions'?"),
        ("set-pin", "there is no command 'set-pin'; did you mean 'study set-pin'?"),
        ("set-pni", "there is no command 'set-pni'; did you mean 'study set-pin'?"),
        ("xyzzy", "there is no command 'xyzzy'; 'recollect --help' lists all commands"),
    ],
)
def test_a_mistyped_command_gets_a_suggestion(typed: str, said: str) -> None:
    done = CliRunner().invoke(main.recollect, [typed])
    assert (done.exit_code, done.output.splitlines()[-1]) == (2, f"Error: {said}")


def test_options_without_a_command_are_those_of_run() -> None:
    done = CliRunner().invoke(main.recollect, ["--study", "none.toml"])
    assert isinstance(done.exception, UserInputError)
    assert "none.toml cannot be read" in str(done.exception)
    assert CliRunner().invoke(main.recollect, ["--version"]).output.startswith("recollect, version")


def test_the_help_loads_no_command_and_no_large_library() -> None:
    program = (
        "import sys; from kiosk.cli.main import recollect\n"
        "recollect(['--help'], standalone_mode=False)\n"
        "print(*sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=PATIENCE_S
    )
    loaded = set(done.stdout.splitlines()[-1].split())
    assert {name for name in loaded if name.startswith("kiosk")} == {
        "kiosk",
        "kiosk.cli",
        "kiosk.cli.main",
        "kiosk.cli.terminal",
    }
    assert not loaded & {"pydantic", "numpy", "PySide6", "rich", "cattrs"}


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder of built pages, which the program takes for its own."""
    folder = tmp_path / "site"
    for page in ("index.html", "how-to/booth.html", "reference/glossary.html", "assets/404.html"):
        (folder / page).parent.mkdir(parents=True, exist_ok=True)
        (folder / page).touch()
    monkeypatch.setattr("kiosk.cli.guide.beside_or_inside", lambda name: tmp_path / name)
    return folder


@pytest.mark.parametrize(
    ("words", "page"),
    [
        ((), "index.html"),
        (("booth",), "how-to/booth.html"),
        (("check",), "how-to/booth.html"),
        (("glossary",), "reference/glossary.html"),
    ],
)
def test_docs_opens_the_page_about_a_command_or_a_subject(
    words: tuple[str, ...], page: str, site: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened = list[str]()

    def opens(address: str) -> bool:
        opened.append(address)
        return True

    monkeypatch.setattr("webbrowser.open", opens)
    told = CliRunner().invoke(commands()["docs"], words)
    assert opened == [(site / page).as_uri()]
    assert told.output == f"{site / page}\n"


def test_docs_says_which_page_may_be_meant(site: Path) -> None:
    assert site.exists()
    refused = CliRunner().invoke(commands()["docs"], ["glosary"]).exception
    assert str(refused) == "there is no page about 'glosary'; did you mean 'glossary'?"


def test_docs_names_the_text_where_no_pages_were_built(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kiosk.cli.guide.beside_or_inside", lambda name: {"site": tmp_path, "docs": DOCS}[name])
    told = CliRunner().invoke(commands()["docs"], ["mentaliser"])
    assert told.output.splitlines()[0] == str(DOCS / "explanation" / "mentaliser.md")
