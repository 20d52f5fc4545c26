"""The command that watches the booths of a study from afar."""

from __future__ import annotations

import json
import secrets
import time
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import click
from pydantic import ValidationError
from rich.live import Live
from rich.table import Table

from kiosk import UserInputError
from kiosk.cli.options import json_option
from kiosk.cli.terminal import console, counted
from kiosk.config import Remote
from kiosk.remote import ANYWHERE, BoothWatch, served

LOOK_S = 0.5
WIDTH = 120
"""Characters that a line may need; without a terminal no word is cut."""
ONCE_S = 7.0
"""How long a single look listens: a booth publishes every five seconds."""

TROUBLE = 1
WELL = ("well", "closed")
_MARKS = {"well": "● well", "closed": "○ closed", "trouble": "▲ trouble", "hung": "▲ hangs", "lost": "▲ lost"}


@click.command()
@click.option("--broker", required=True, metavar="ADDRESS", help="mqtts://HOST, or mqtt://HOST without TLS.")
@click.option("--topic", default=Remote().topic, show_default=True, help="What the booths' topics begin with.")
@click.option("--user", default="", help="The user's name at the broker.")
@click.option("--password-file", default="", metavar="FILE", help="A file that holds the password alone.")
@click.option("--ca", default="", metavar="FILE", help="The broker's authority; by default the system's.")
@click.option("--certificate", default="", metavar="FILE", help="A client certificate, with --key.")
@click.option("--key", default="", metavar="FILE", help="The key of the client certificate.")
@click.option("--once", is_flag=True, help="Listen for seven seconds and print the table once.")
@click.option("--web", is_flag=True, help="Serve a page to phones on the local network, until Ctrl+C.")
@click.option("--host", default=ANYWHERE, show_default=True, help="The address that the page is served at.")
@click.option("--port", type=click.IntRange(0, 65535), default=8765, show_default=True, help="The page's port.")
@json_option
@click.pass_context
def watch_command(
    context: click.Context, /, *, broker: str, once: bool, web: bool, host: str, port: int, as_json: bool, **given: str
) -> None:
    """Watch all booths that publish to an MQTT broker.

    It shows a table until Ctrl+C. Nothing can be changed from here. With --once or --json it listens for seven seconds;
    then exit code 1 says that a booth needs you. It needs the extra 'remote'.
    """
    watch = BoothWatch(_settings(broker, given))
    try:
        if web:
            _serve(watch, host, port)
        elif once or as_json or not console().is_terminal:
            rows = _listen(watch, broker)
            click.echo(json.dumps(rows)) if as_json else console(least_width=WIDTH).print(_table(rows, ""))
            context.exit(0 if rows and all(row["state"] in WELL for row in rows) else TROUBLE)
        else:
            _show(watch)
    finally:
        watch.close()


def _settings(broker: str, given: dict[str, str]) -> Remote:
    try:
        return Remote(mqtt=broker if "://" in broker else f"mqtt://{broker}", **given)
    except ValidationError as error:
        first = error.errors()[0]
        raise UserInputError(f"--{'-'.join(map(str, first['loc'])) or 'broker'}: {first['msg']}") from error


def _listen(watch: BoothWatch, broker: str) -> list[dict[str, Any]]:
    time.sleep(ONCE_S)
    if watch.trouble:
        raise UserInputError(f"the broker {broker} cannot be reached: {watch.trouble}")
    return watch.rows


def _show(watch: BoothWatch) -> None:
    with suppress(KeyboardInterrupt), Live(_table([], watch.trouble), console=console(), auto_refresh=False) as live:
        while True:
            live.update(_table(watch.rows, watch.trouble), refresh=True)
            time.sleep(LOOK_S)


def _serve(watch: BoothWatch, host: str, port: int) -> None:
    with suppress(KeyboardInterrupt), served(watch, host, port, secrets.token_urlsafe(16)) as address:
        click.echo(f"{address} shows the booths to anybody who knows this address; Ctrl+C ends it.")
        while True:
            time.sleep(LOOK_S)


def _table(rows: Sequence[dict[str, Any]], trouble: str) -> Table:
    booths = counted(len(rows), "booth") if rows else "No booth yet"
    title = f"No connection to the broker: {trouble}" if trouble else booths
    table = Table(title=title, box=None, title_justify="left")
    for heading in ("booth", "state", "stage", "min", "visitors", "completed", "last hour", "early"):
        number = heading in {"min", "visitors", "completed", "last hour", "early"}
        table.add_column(heading, no_wrap=True, justify="right" if number else "left")
    table.add_column("what is wrong", overflow="fold")
    for row in rows:
        today = row["today"]
        counts = (str(today.get(key, "")) for key in ("begun", "completed", "last_hour", "ended_early"))
        cells = (row["booth"], _MARKS.get(row["state"], "? unknown"), row["stage"], str(row["minutes"]), *counts)
        table.add_row(*cells, "; ".join(row["trouble"]))
    return table
