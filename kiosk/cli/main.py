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

DISK_FAILED, BAD_INPUT = 1, 2
"""Exit codes: the disk did not take something, so that the same command may succeed later; the input cannot be used."""

_COMMANDS = {
    "run": (
        "kiosk.cli.run:run_command",
        "Open the kiosk for visitors; Ctrl+Shift+Q leaves it.",
    ),
    "rehearse": (
        "kiosk.cli.rehearse:rehearse",
        "Let a simulated visitor go through a session at the real window, or many of them through a day.",
    ),
    "check": (
        "kiosk.cli.check:check_command",
        "Try everything that a booth needs; exit code 1 if no session can be held.",
    ),
    "study": (
        "kiosk.cli.study:study",
        "Set up a study: check its file, write one to begin with, bring in a questionnaire, choose a PIN.",
    ),
    "robot": (
        "kiosk.cli.devices:robot_command",
        "Try a robot step by step, and say what it has and what it does.",
    ),
    "voice": (
        "kiosk.cli.devices:voice_group",
        "Make voice packs from an engine or from a person's recordings, and look at them.",
    ),
    "status": (
        "kiosk.cli.sessions:status_command",
        "Show how the booth is now: stage, today's sessions, robot, voice, disk, backup.",
    ),
    "sessions": (
        "kiosk.cli.sessions:sessions_command",
        "List the stored sessions: when, in which condition, how and where they ended.",
    ),
    "day": (
        "kiosk.cli.day:day_command",
        "Write one page about a day: time lines, dropouts, faults, and what to look at tomorrow.",
    ),
    "events": (
        "kiosk.cli.sessions:events_command",
        "List what happened in a SESSION, in the order in which it was written.",
    ),
    "replay": (
        "kiosk.cli.run:replay_command",
        "Play a stored SESSION again: Space stops it, the arrows step and change its speed, Escape leaves.",
    ),
    "explain": (
        "kiosk.cli.explain:explain_command",
        "Explain one decision: of a moment in a case file, or, with --flip, of a stored session.",
    ),
    "backup": (
        "kiosk.cli.data:backup_command",
        "Copy the database, also while a kiosk is writing; the copy is checked, and the oldest ones are removed.",
    ),
    "browse": (
        "kiosk.cli.data:browse_command",
        "Look into a verified copy of the database with Datasette, read only, until Ctrl+C.",
    ),
    "verify": (
        "kiosk.cli.data:verify_command",
        "Check the database row by row; exit code 1 if anything is wrong.",
    ),
    "withdraw": (
        "kiosk.cli.data:withdraw_command",
        "Delete all that is stored of the participant who has this CODE; only a count stays.",
    ),
    "merge": (
        "kiosk.cli.data:merge_command",
        "Bring the data folders A, B and so on together in a new one; they stay as they are.",
    ),
    "export": (
        "kiosk.cli.data:export_command",
        "Write a data set for publishing: every table with a codebook, as Psych-DS asks for.",
    ),
    "report": (
        "kiosk.cli.analysis:report_command",
        "Analyse an exported data set: who took part, every test, figures, and tables for a paper.",
    ),
    "calibrate": (
        "kiosk.cli.analysis:calibrate_command",
        "Estimate forgetting, following and lapses of the people in an exported DATASET.",
    ),
    "plan": (
        "kiosk.cli.analysis:plan_group",
        "Plan a study before its first participant; see docs/plan.md.",
    ),
    "train": (
        "kiosk.cli.learning:train_command",
        "Learn a table and freeze it.",
    ),
    "simulate": (
        "kiosk.cli.learning:simulate_command",
        "Play many games with a simulated player under a frozen table, and measure them as the study does.",
    ),
    "policy": (
        "kiosk.cli.learning:policy_group",
        "Look at policy files.",
    ),
}
"""Each command by its name: where it is, and the first sentence of its help, which loads none of them."""
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
        place = _COMMANDS[cmd_name][0] if cmd_name in _COMMANDS else _WORKERS.get(cmd_name)
        if place is None:
            return None
        module, name = place.split(":")
        command: click.Command = getattr(import_module(module), name)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002 - click's
        """Write the list of commands as click does, from the table instead of the commands."""
        room = formatter.width - 6 - max(map(len, _COMMANDS))
        rows = [
            (name, click.Command(name, help=told).get_short_help_str(room)) for name, (_, told) in _COMMANDS.items()
        ]
        with formatter.section("Commands"):
            formatter.write_dl(rows)


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
        from kiosk.ui.qt_platform import missing_library  # noqa: PLC0415 - most commands never need it

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
