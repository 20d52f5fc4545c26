"""``recollect voice``, which the kiosk starts: a build has no ``python -m``, so every process of ours is a command."""

from __future__ import annotations

import click

from kiosk.robot.speech import main


@click.command(hidden=True)
@click.argument("language")
@click.argument("rate", type=int)
@click.argument("volume", type=float)
def voice(language: str, rate: int, volume: float) -> None:
    """Be the voice, in a process of its own; the kiosk starts it."""
    main(language, rate, volume)
