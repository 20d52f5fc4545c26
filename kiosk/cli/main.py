"""The command ``recollect``: which commands there are, and how a refusal looks.

A command's module is loaded when the command is called, so that opening the kiosk does not pay for training it.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence
from importlib import import_module
from io import TextIOWrapper
from typing import Never

import click

from kiosk import DISK_FULL, StorageError, UserInputError, __version__, why
from kiosk.ui.qt_platform import missing_library

DISK_FAILED, BAD_INPUT = 1, 2
"""Exit codes: the disk did not take something, so that the same command may succeed later; the input cannot be used."""

_COMMANDS = {
    "run": "kiosk.cli.run:run_command",
    "rehearse": "kiosk.cli.rehearse:rehearse",
    "check": "kiosk.cli.check:check_command",
    "study": "kiosk.cli.study:study",
    "robot": "kiosk.cli.robot:robot_command",
    "voice": "kiosk.cli.voice:voice_group",
    "status": "kiosk.cli.sessions:status_command",
    "sessions": "kiosk.cli.sessions:sessions_command",
    "events": "kiosk.cli.sessions:events_command",
    "replay": "kiosk.cli.sessions:replay_command",
    "explain": "kiosk.cli.explain:explain_command",
    "backup": "kiosk.cli.data:backup_command",
    "verify": "kiosk.cli.data:verify_command",
    "withdraw": "kiosk.cli.data:withdraw_command",
    "merge": "kiosk.cli.data:merge_command",
    "export": "kiosk.cli.data:export_command",
    "report": "kiosk.cli.report:report_command",
    "calibrate": "kiosk.cli.calibrate:calibrate_command",
    "plan": "kiosk.cli.plan:plan_group",
    "train": "kiosk.cli.learning:train_command",
    "simulate": "kiosk.cli.learning:simulate_command",
    "policy": "kiosk.cli.learning:policy_group",
}
_WORKERS = {
    "_display": "kiosk.cli.workers:display_command",
    "_splash": "kiosk.cli.workers:splash_command",
    "_voice": "kiosk.cli.workers:voice_command",
}
"""Commands that Recollect itself starts, in processes of their own, and that no help text lists."""

_WITH_A_WINDOW = frozenset({"run", "rehearse", "replay"})


class RootGroup(click.Group):
    """The group of all commands; without a command it opens the kiosk."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """Return the commands, in the order in which a person meets them."""
        return list(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002 - click's signature
        """Load one command."""
        place = (_COMMANDS | _WORKERS).get(cmd_name)
        if place is None:
            return None
        module, name = place.split(":")
        command: click.Command = getattr(import_module(module), name)
        return command


@click.group(cls=RootGroup, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="recollect")
@click.pass_context
def recollect(context: click.Context) -> None:
    """Recollect: a kiosk for studies in which a robot helps a person play Concentration.

    Without a command it opens the kiosk.
    """
    if context.invoked_subcommand is None:
        context.invoke(recollect.get_command(context, "run"))  # type: ignore[arg-type]  # it is in the table


def main() -> Never:
    """Run the command line; input that cannot be used, and a disk that fails, get their sentences, one a line."""
    _print_what_the_terminal_cannot()
    _end_at_once_while_opening(sys.argv[1:])
    try:
        recollect()
    except UserInputError as refusal:
        _say(*refusal.sentences)
    except StorageError as failure:
        _say(str(failure))
        sys.exit(DISK_FAILED)
    except ImportError as error:
        missing = missing_library(error)
        if missing is None:
            raise
        _say(str(missing))
    except OSError as error:
        if why(error) != DISK_FULL:
            raise
        _say(f"{error.filename} cannot be written: {DISK_FULL}" if error.filename else DISK_FULL)
        _drop_what_is_not_printed_yet()
        sys.exit(DISK_FAILED)
    sys.exit(BAD_INPUT)


def _say(*sentences: str) -> None:
    for sentence in sentences:
        click.echo(f"recollect: {sentence}", err=True)


def _drop_what_is_not_printed_yet() -> None:
    """Keep Python from writing it once more at the very end, where no sentence can be said."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.__stdout__.fileno() if sys.__stdout__ else 1)
    os.close(nowhere)


def _print_what_the_terminal_cannot() -> None:
    """Print characters that the terminal's encoding lacks by their numbers, instead of ending with a traceback."""
    for stream in (sys.stdout, sys.stderr):
        # There may be none, or one that something else put in its place.
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _end_at_once_while_opening(arguments: Sequence[str]) -> None:
    """Let Ctrl+C end the process itself until the window's own loop takes it.

    Raised as an exception while Qt is loaded or the window is built, it would be lost in a callback, or end in a crash.
    """
    command = next((argument for argument in arguments if not argument.startswith("-")), "run")
    if command in _WITH_A_WINDOW and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
