"""The command ``recollect``: which commands there are, and how a refusal looks.

A command's module is loaded when the command is called, so that opening the kiosk does not pay for training it.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Sequence
from importlib import import_module
from io import TextIOWrapper
from typing import Never

import click

from kiosk import DISK_FULL, StorageError, UserInputError, __version__, why
from kiosk.cli.terminal import HarmlessStream, tell_line

DISK_FAILED, BAD_INPUT = 1, 2
"""Exit codes: the disk did not take something, so that the same command may succeed later; the input cannot be used."""

_GROUPS = {
    "Prepare a study": {
        "study": ("kiosk.cli.study:study", "Set up a study: its file, cards, texts and PIN."),
        "plan": ("kiosk.cli.analysis:plan_group", "Plan a study before its first participant."),
        "voice": ("kiosk.cli.devices:voice_group", "Make voice packs and look at them."),
    },
    "Run a booth": {
        "run": ("kiosk.cli.run:run_command", "Open the kiosk for visitors."),
        "open-day": ("kiosk.cli.open_day:open_day_command", "Go through the morning checklist, then open the kiosk."),
        "check": ("kiosk.cli.status:check_command", "Try everything that a booth needs, and say what to do."),
        "rehearse": ("kiosk.cli.rehearse:rehearse", "Let simulated visitors go through sessions or a whole day."),
        "robot": ("kiosk.cli.devices:robot_command", "Try a robot step by step and show what it can do."),
        "watch": ("kiosk.cli.watch:watch_command", "Watch all booths that publish to an MQTT broker."),
        "status": ("kiosk.cli.status:status_command", "Show the state of the booth while the kiosk runs."),
    },
    "Look at sessions": {
        "sessions": ("kiosk.cli.sessions:sessions_command", "List the stored sessions and how they ended."),
        "events": ("kiosk.cli.sessions:events_command", "List what happened in a SESSION, in order."),
        "replay": ("kiosk.cli.replay:replay_command", "Play a stored SESSION on the screen again."),
        "explain": ("kiosk.cli.explain:explain_command", "Explain the decisions of a stored session, or a case."),
        "day": ("kiosk.cli.day:day_command", "Write one page about a day at the booth."),
    },
    "Keep the data": {
        "backup": ("kiosk.cli.data:backup_command", "Copy the database, also while a kiosk is writing."),
        "verify": ("kiosk.cli.data:verify_command", "Check the database row by row."),
        "browse": ("kiosk.cli.data:browse_command", "Show a copy of the database with Datasette."),
        "withdraw": ("kiosk.cli.data:withdraw_command", "Delete all that is stored of the participant with this CODE."),
        "merge": ("kiosk.cli.data:merge_command", "Merge the data folders A, B and so on."),
    },
    "Publish the results": {
        "export": ("kiosk.cli.data:export_command", "Write a data set for publishing, with a codebook."),
        "report": ("kiosk.cli.analysis:report_command", "Analyse an exported data set: tests, figures and tables."),
        "calibrate": (
            "kiosk.cli.analysis:calibrate_command",
            "Estimate how the people in a DATASET forget and follow.",
        ),
    },
    "The learning layer": {
        "train": ("kiosk.cli.learning:train_command", "Train a table and freeze it."),
        "simulate": ("kiosk.cli.learning:simulate_command", "Play games with a simulated player under a frozen table."),
        "policy": ("kiosk.cli.policy:policy_group", "Look at policy files and their evidence."),
    },
    "Read on": {
        "docs": ("kiosk.cli.guide:docs_command", "Open the documentation in the browser, without a network."),
    },
}
"""Each command by what it is for and its name: where it is, and the first sentence of its help, which loads none."""
_COMMANDS = {name: entry for group in _GROUPS.values() for name, entry in group.items()}
_WORKERS = {
    "_display": "kiosk.cli.workers:display_command",
    "_markers": "kiosk.cli.workers:markers_command",
    "_relay": "kiosk.cli.workers:relay_command",
    "_splash": "kiosk.cli.workers:splash_command",
    "_voice": "kiosk.cli.workers:voice_command",
}
"""Commands that Recollect itself starts, in processes of their own, and that no help text lists."""

_WITH_A_WINDOW = frozenset({"run", "rehearse", "replay"})


class RootGroup(click.Group):
    """The group of all commands; without a command it opens the kiosk."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take options without a command for those of ``run``, as in ``recollect --study FILE``."""
        own = {name for parameter in self.get_params(ctx) for name in parameter.opts}
        if args and args[0].startswith("-") and args[0] not in own:
            args = ["run", *args]
        return super().parse_args(ctx, args)

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """Return the commands, in the order in which the help lists them."""
        return list(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002 - click's signature
        """Load one command, with its examples and the link to its page."""
        place = _COMMANDS[cmd_name][0] if cmd_name in _COMMANDS else _WORKERS.get(cmd_name)
        if place is None:
            return None
        module, name = place.split(":")
        command: click.Command = getattr(import_module(module), name)
        if cmd_name in _COMMANDS:
            from kiosk.cli.guide import add_guide  # noqa: PLC0415 - the list of commands does without

            add_guide(cmd_name, command)
        if not gc.isenabled():
            # What was loaded stays as long as the program does.
            gc.freeze()
            gc.enable()
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find a command; a mistyped name gets a suggestion, also where it is the name of a subcommand."""
        if args and self.get_command(ctx, args[0]) is None:
            from kiosk.cli.guide import suggestion  # noqa: PLC0415 - only a mistyped name needs it

            raise click.UsageError(f"there is no command {args[0]!r}; {suggestion(args[0])}", ctx)
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002 - click's
        """Write the commands in their groups, from the table instead of the commands."""
        longest = max(map(len, _COMMANDS))
        for title, group in _GROUPS.items():
            with formatter.section(title):
                formatter.write_dl([(name.ljust(longest), told) for name, (_, told) in group.items()])


@click.group(cls=RootGroup, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="recollect")
@click.pass_context
def recollect(context: click.Context) -> None:
    """Recollect: a kiosk for studies in which a robot helps a person play Concentration.

    Without a command it opens the kiosk; its options are those of run.
    'recollect COMMAND --help' shows examples and where to read on.
    """
    if context.invoked_subcommand is None:
        context.invoke(recollect.get_command(context, "run"))  # type: ignore[arg-type]  # it is in the table


def main() -> Never:
    """Run the command line; input that cannot be used, and a disk that fails, get their sentences, one a line."""
    # Until a command is loaded, nothing becomes garbage; looking for it takes a fifth of the time to the first frame.
    gc.disable()
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
        tell_line(f"recollect: {sentence}", err=True)


def _drop_what_is_not_printed_yet() -> None:
    """Keep Python from writing it once more at the very end, where no sentence can be said."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.__stdout__.fileno() if sys.__stdout__ else 1)
    os.close(nowhere)


def _print_what_the_terminal_cannot() -> None:
    """Print characters that the terminal's encoding lacks, or that would steer it, by their numbers."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        # There may be none, or one that something else put in its place.
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
            setattr(sys, name, HarmlessStream(stream))


def _end_at_once_while_opening(arguments: Sequence[str]) -> None:
    """Let Ctrl+C end the process itself until the window's own loop takes it.

    Raised as an exception while Qt is loaded or the window is built, it would be lost in a callback, or end in a crash.
    """
    command = "run" if not arguments or arguments[0].startswith("-") else arguments[0]
    if command in _WITH_A_WINDOW and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
