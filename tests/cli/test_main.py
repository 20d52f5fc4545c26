"""How the command line ends where something cannot be done: in one sentence, with a code that tells why."""

from __future__ import annotations

import errno
import os
import subprocess
import sys

import click
import pytest

from kiosk import StorageError, UserInputError
from kiosk.cli import main


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


def test_the_help_loads_no_command_and_no_large_library() -> None:
    program = (
        "import sys; from kiosk.cli.main import recollect\n"
        "recollect(['--help'], standalone_mode=False)\n"
        "print(*sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.splitlines()[-1].split())
    assert {name for name in loaded if name.startswith("kiosk")} == {"kiosk", "kiosk.cli", "kiosk.cli.main"}
    assert not loaded & {"pydantic", "numpy", "PySide6", "rich", "cattrs"}
