"""Try every way to leave the kiosk on every desktop that is installed, and say what came of each.

The exit code is 1 if the kiosk was left, and 0 if it held or came back by itself.
"""

from __future__ import annotations

import json
import sys
from contextlib import closing
from dataclasses import asdict, dataclass
from enum import Enum
from time import monotonic, sleep

import click
from rich.console import Console
from rich.progress import track
from rich.table import Table

from tests.ui.exits.attempts import ATTEMPTS, Attempt
from tests.ui.exits.desktops import Desktop, kiosk_on
from tests.ui.exits.hands import Hands

WATCHED_S = 0.8
"""How long the kiosk is watched after each attempt."""
BACK_S = 3.0
"""How long it may take to come back, before it counts as left."""
CARDS = 24


class Outcome(Enum):
    """What came of an attempt."""

    HELD = "held"
    CAME_BACK = "came back"
    LEFT = "left"


@dataclass(frozen=True)
class Result:
    """What came of one attempt on one desktop."""

    desktop: str
    attempt: str
    by: str
    outcome: str
    away_ms: int
    lacked: str


def watch(hands: Hands, attempt: Attempt, card: int) -> tuple[Outcome, int, str]:
    """Try it; the outcome, how long the kiosk was away, and what it lacked meanwhile."""
    attempt.do(hands)
    began = back = monotonic()
    lacked = ""
    while monotonic() < max(began + WATCHED_S, min(back + WATCHED_S, began + BACK_S)):
        standing = hands.look()
        if not standing.holds:
            lacked, back = lacked or standing.lacks, monotonic()
        sleep(0.01)
    standing = hands.wait(0)
    away_ms = round((back - began) * 1000)
    if not standing.holds:
        return Outcome.LEFT, away_ms, standing.lacks
    if not hands.answers(card):
        return Outcome.LEFT, away_ms, "does not answer a click"
    return (Outcome.CAME_BACK if lacked else Outcome.HELD), away_ms, lacked


def try_all(desktop: Desktop, only: str) -> list[Result]:
    """Try everything on one desktop, with a new kiosk whenever it was left."""
    waiting = [attempt for attempt in ATTEMPTS if only in attempt.name]
    shown = iter(track(range(len(waiting)), desktop.value, console=Console(stderr=True)))
    results: list[Result] = []
    while waiting:
        with kiosk_on(desktop) as kiosk, closing(Hands(kiosk)) as hands:
            standing = hands.wait(10)
            assert standing.holds, f"on {desktop.value} the kiosk stands badly from the start: {standing.lacks}"
            left = False
            while waiting and not left:
                attempt = waiting.pop(0)
                next(shown)
                outcome, away_ms, lacked = watch(hands, attempt, len(results) % CARDS)
                results.append(Result(desktop.value, attempt.name, attempt.by.value, outcome.value, away_ms, lacked))
                hands.tidy()
                left = outcome is Outcome.LEFT
    return results


def table(results: list[Result]) -> Table:
    """All results for a person."""
    shown = Table("desktop", "attempt", "by", "outcome", "away, ms", "what was missing meanwhile")
    for result in results:
        away = str(result.away_ms) if result.lacked else ""
        shown.add_row(result.desktop, result.attempt, result.by, result.outcome, away, result.lacked)
    return shown


@click.command()
@click.option("--on", "chosen", type=click.Choice([desktop.name.lower() for desktop in Desktop]), multiple=True)
@click.option("--only", default="", help="Only attempts whose name has this in it.")
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON.")
def main(chosen: tuple[str, ...], only: str, *, as_json: bool) -> None:
    """Try to leave the kiosk in every known way; exit code 1 if one leads out."""
    results: list[Result] = []
    for desktop in Desktop:
        if chosen and desktop.name.lower() not in chosen:
            continue
        if desktop.missing:
            click.echo(f"{desktop.value} is not tried: {', '.join(desktop.missing)} is not installed", err=True)
            continue
        results += try_all(desktop, only)
    left = [result for result in results if result.outcome == Outcome.LEFT.value]
    if as_json:
        click.echo(json.dumps([asdict(result) for result in results], indent=1))
    else:
        Console(width=140).print(table(results))
        away = max((result.away_ms for result in results if result.lacked), default=0)
        click.echo(f"{len(results)} attempts, {len(left)} left; the longest way back took {away} ms.")
    sys.exit(1 if left else 0)


if __name__ == "__main__":
    main()
