"""The command that turns a PIN into the line for the study file; the PIN itself is neither shown nor kept."""

from __future__ import annotations

import json
import secrets

import click

from kiosk import BadInput
from kiosk.cli.options import json_option
from kiosk.study.booth.pin import SALT_BYTES, kept


@click.command()
@json_option
def pin(*, as_json: bool) -> None:
    """Choose the experimenter's PIN, and print the line for the study file that keeps it."""
    chosen = _ask("PIN (4 to 12 digits)")
    if _ask("The same again") != chosen:
        raise BadInput("the two PINs are not the same; nothing was changed")
    line = kept(chosen, secrets.token_bytes(SALT_BYTES))
    click.echo(json.dumps({"pin": line}) if as_json else f'[experimenter]\npin = "{line}"')


def _ask(prompt: str) -> str:
    """What was typed, unseen; what is asked goes where it is not taken for the answer."""
    answer: str = click.prompt(prompt, hide_input=True, err=True, default="", show_default=False)
    return answer
