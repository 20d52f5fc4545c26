"""The command ``recollect``: which commands there are, and how a refusal looks.

A command's module is loaded when the command is called, so that opening the kiosk does not pay for training it.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import Never

import click

from kiosk import DISK_FULL, BadInput, StoreFailed, __version__, why

DISK_FAILED, BAD_INPUT = 1, 2
"""Exit codes: the disk did not take something, so that the same command may succeed later; the input cannot be used."""

_COMMANDS = {
    "open": "kiosk.cli.booth.sitting:open_kiosk",
    "keep": "kiosk.cli.booth.keep:keep",
    "rehearse": "kiosk.cli.booth.rehearsal:rehearse",
    "check": "kiosk.cli.booth.check:check",
    "study": "kiosk.cli.study:study",
    "robot": "kiosk.cli.booth.robot:robot",
    "sittings": "kiosk.cli.records.listing:sittings",
    "events": "kiosk.cli.records.listing:events",
    "replay": "kiosk.cli.records.replay:replay",
    "explain": "kiosk.cli.explaining.explain:explain",
    "backup": "kiosk.cli.records.care:backup",
    "verify": "kiosk.cli.records.care:verify",
    "withdraw": "kiosk.cli.records.care:withdraw",
    "merge": "kiosk.cli.records.care:merge",
    "export": "kiosk.cli.records.export:export",
    "train": "kiosk.cli.learning.commands:train",
    "simulate": "kiosk.cli.learning.commands:simulate",
    "policy": "kiosk.cli.learning.commands:policy",
}
_WORKERS = {
    "display": "kiosk.cli.booth.display:display",
    "meanwhile": "kiosk.cli.booth.keep:meanwhile",
    "voice": "kiosk.cli.booth.voice:voice",
}
"""Commands that Recollect itself starts, in processes of their own, and that nobody is told of."""


class Front(click.Group):
    """The group of all commands; without a command it opens the kiosk."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """The commands, in the order in which a person meets them."""
        return list(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002 - click's signature
        """Load one command."""
        place = (_COMMANDS | _WORKERS).get(cmd_name)
        if place is None:
            return None
        module, name = place.split(":")
        command: click.Command = getattr(import_module(module), name)
        return command


@click.group(cls=Front, invoke_without_command=True, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="recollect")
@click.pass_context
def recollect(context: click.Context) -> None:
    """Recollect: a kiosk for studies in which a robot helps a person play Concentration.

    Without a command it opens the kiosk.
    """
    if context.invoked_subcommand is None:
        context.invoke(recollect.get_command(context, "open"))  # type: ignore[arg-type]  # it is in the table


def main() -> Never:
    """Run the command line; input that cannot be used, and a disk that fails, get their sentences, one a line."""
    try:
        recollect()
    except BadInput as refusal:
        _say(*refusal.sentences)
    except StoreFailed as failure:
        _say(str(failure))
        sys.exit(DISK_FAILED)
    except OSError as error:
        if why(error) != DISK_FULL:
            raise
        _say(f"{error.filename} cannot be written: {DISK_FULL}" if error.filename else DISK_FULL)
        sys.exit(DISK_FAILED)
    sys.exit(BAD_INPUT)


def _say(*sentences: str) -> None:
    for sentence in sentences:
        click.echo(f"recollect: {sentence}", err=True)
