"""Commands that open the window: for visitors, or for a rehearsal."""

from __future__ import annotations

import json
from dataclasses import asdict
from math import isfinite
from pathlib import Path
from random import SystemRandom
from typing import Any

import click

from kiosk import BadInput
from kiosk.cli.options import data_option, json_option, rehearsal_data_option, study_option
from kiosk.cli.wiring import code_commit, log_into, read_settings
from kiosk.store.recorder import Recorder
from kiosk.study.after.utterances import body_changes, utterances
from kiosk.study.condition import Condition
from kiosk.study.declared.checked.whole import read_study
from kiosk.study.events import Event
from kiosk.ui.app import App
from kiosk.ui.desk import Desk, Origin
from kiosk.ui.rehearsing.hand import Stuck
from kiosk.ui.rehearsing.rehearsal import Rehearsal
from kiosk.ui.rehearsing.shots import Shots, make_folder
from kiosk.ui.window import Display, Mode, Pace, check_screen

SEED_BITS = 32
SETTLE_MS = 450
"""When a picture is taken after its moment, so that nothing moves any more."""

robot_host_option = click.option("--robot-host", help="The robot's name or address; a Furhat unless told otherwise.")
robot_port_option = click.option("--robot-port", type=click.IntRange(1, 65535), help="The robot's port.")


@click.command("open")
@data_option
@study_option
@robot_host_option
@robot_port_option
@click.option("--site", default="", help="Where this kiosk stands, if data of several will be merged: A, B, ROME.")
@click.option("--window", is_flag=True, help="Open a window instead of the full screen.")
@json_option
def open_kiosk(
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    *,
    window: bool,
    as_json: bool,
) -> None:
    """Open the kiosk for visitors; Ctrl+Shift+Q leaves it."""
    prepared = read_study(read_settings(study, robot_host, robot_port))
    chance = SystemRandom()
    origin = Origin(code_commit(), simulated=False, seed=lambda: chance.getrandbits(SEED_BITS))
    mode = Mode(Display.WINDOW if window else Display.FULL_SCREEN)
    check_screen(mode.display)
    with Recorder(data, site) as recorder:
        log_into(data)
        with App(mode, recorder, Desk(prepared, recorder, origin)) as app:
            app.run()
    told = {"data": str(data), "sittings": recorder.begun, "interrupted_before": list(recorder.recovered)}
    click.echo(json.dumps(told) if as_json else f"{recorder.begun} sittings were recorded in {data}.")


@click.command()
@click.option(
    "--seed",
    type=click.IntRange(0, 2**63 - 1),
    default=1,
    show_default=True,
    help="The same seed plays the same sitting.",
)
@click.option("--headless", is_flag=True, help="Use no screen, and play as fast as the machine allows.")
@click.option("--speed", type=click.FloatRange(0.01, 1000), help="How many times as fast as in real life.")
@click.option("--condition", help="The help that the visitor gets: tom, notom, or another cell of the design.")
@click.option("--shots", type=click.Path(path_type=Path), help="Save a picture of every moment in this folder.")
@rehearsal_data_option
@study_option
@robot_host_option
@robot_port_option
@json_option
def rehearse(
    seed: int,
    speed: float | None,
    condition: str | None,
    shots: Path | None,
    data: Path,
    study: Path | None,
    robot_host: str | None,
    robot_port: int | None,
    *,
    headless: bool,
    as_json: bool,
) -> None:
    """Let a simulated visitor play one sitting through the real window.

    A robot takes its own time: while it is at work, even a rehearsal without a screen waits as long as a visitor would.
    """
    prepared = read_study(read_settings(study, robot_host, robot_port))
    robot = prepared.settings.robot.kind != "none"
    if robot and speed not in {None, 1}:
        raise BadInput("a robot speaks at its own speed, so a rehearsal with one cannot have another")
    fixed = Condition.named(condition or prepared.settings.assistance.condition)
    origin = Origin(code_commit(), simulated=True, seed=lambda: seed, condition=fixed)
    mode = _mode(speed, headless=headless)
    check_screen(mode.display)
    if shots is not None:
        make_folder(shots)
    with Recorder(data) as recorder, App(mode, recorder, Desk(prepared, recorder, origin)) as app:
        pictures = Shots(app.window, shots, app.clock, 0 if mode.pace is Pace.VIRTUAL else SETTLE_MS) if shots else None
        rehearsal = Rehearsal(app, seed, pictures)
        try:
            rehearsal.run()
        except Stuck as stuck:
            raise click.ClickException(f"the rehearsal cannot go on: {stuck}") from stuck
    from kiosk.store.reading import archive  # noqa: PLC0415 - a tenth of a second that opening need not pay

    with archive(data) as stored:
        played = stored.sittings()[-1].to_json()
        if robot:
            played |= _with_robot(stored.events(played["sitting"]), rehearsal.pulse.longest_ms)
    if as_json:
        click.echo(json.dumps(played))
        return
    click.echo(
        "Sitting {sitting} ({condition}) {status}: {pairs} pairs in {moves} moves, {hints} hints.".format(**played)
    )
    click.echo(f"Its record is in {data}" + (f", its pictures are in {shots}." if shots else "."))


def _with_robot(events: list[Event], longest_gap_ms: float) -> dict[str, Any]:
    """What a rehearsal with a robot tells besides."""
    return {
        "longest_gap_ms": round(longest_gap_ms, 1),
        "body_changes": body_changes(events),
        "utterances": asdict(utterances(events)),
    }


def _mode(speed: float | None, *, headless: bool) -> Mode:
    """Without a screen and without a wish for a speed, nothing is waited for."""
    display = Display.NOWHERE if headless else Display.FULL_SCREEN
    if speed is not None and not isfinite(speed):
        raise BadInput(f"--speed must be a number, not {speed}")
    if headless and speed is None:
        return Mode(display, Pace.VIRTUAL)
    return Mode(display, Pace.WALL, speed or 1.0)
