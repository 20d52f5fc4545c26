"""Commands that open the kiosk, supervised or not, and play a stored session again in its window."""

from __future__ import annotations

import json
import logging
import signal
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path
from random import SystemRandom
from typing import Any

import click

from kiosk import UserInputError, program
from kiosk.cli.composition import check_pin, code_commit, log_into, read_settings
from kiosk.cli.options import (
    data_option,
    json_option,
    progress_bar,
    robot_host_option,
    robot_port_option,
    sessions_data_option,
    site_option,
    study_option,
)
from kiosk.cli.terminal import tell_caution
from kiosk.experiment.events import Event
from kiosk.experiment.memory_replay import has_board
from kiosk.experiment.replay import ReplayStep, first_difference, replay_events
from kiosk.experiment.session_config import SessionConfig, kind_of
from kiosk.robots.registry import check_robot
from kiosk.store.database import wait_until_free
from kiosk.store.queries import open_repository
from kiosk.store.recorder import Recorder
from kiosk.study.loader import read_study
from kiosk.supervisor import REFUSED, Supervisor, SupervisorEvent, SupervisorEventKind, Timeouts, guarded
from kiosk.ui.app import App
from kiosk.ui.film import check_film, write_film
from kiosk.ui.rehearsal import make_folder
from kiosk.ui.replay import Replay
from kiosk.ui.replay_controls import FASTEST, SLOWEST
from kiosk.ui.session_runner import ConditionAssigner, RunContext
from kiosk.ui.window import ClockMode, RunMode, WindowMode, check_screen

SEED_BITS = 63
"""As many as the column holds. Boards are published: seeds, and so codes, must not be found by trying."""

LEFTOVER_S = 15.0
"""How long a supervised kiosk waits for one before it whose supervisor was lost: that one ends by itself."""


@click.command("run")
@data_option
@study_option
@robot_host_option
@robot_port_option
@site_option
@click.option("--window", is_flag=True, help="Open a window instead of the full screen.")
@click.option(
    "--supervise",
    is_flag=True,
    help="Start the kiosk again whenever it dies or hangs; the study needs a PIN ('recollect study set-pin').",
)
@click.option(
    "--silence",
    type=click.FloatRange(1, 600),
    default=Timeouts.silence,
    show_default=True,
    help="With --supervise: seconds without a sign of life after which the kiosk hangs.",
)
@click.option("--unattended", is_flag=True, hidden=True, help="Refuse a study without a PIN; the supervisor says so.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON, for programs; with --supervise a line per event.")
@click.pass_context
def run_command(
    context: click.Context,
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    silence: float,
    *,
    window: bool,
    supervise: bool,
    unattended: bool,
    as_json: bool,
) -> None:
    """Open the kiosk for visitors.

    Ctrl+Shift+Q leaves it. Without a PIN in the study file it runs a trial, which is not exported.
    """
    if supervise:
        _refuse_without_pin(study)
        context.exit(
            supervise_kiosk(data, study, site, robot_host, robot_port, window=window, silence=silence, as_json=as_json)
        )
    with guarded() as beat:
        told = _open(data, study, site, robot_host, robot_port, beat, unattended=unattended, window=window)
    click.echo(json.dumps(told) if as_json else f"{told['sessions']} sessions were recorded in {data}.")


def _open(
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    beat: Callable[[], None],
    *,
    unattended: bool,
    window: bool,
) -> dict[str, Any]:
    """Open the kiosk until it is left; returns what to report of it."""
    prepared = read_study(read_settings(study, robot_host, robot_port))
    check_robot(prepared.settings)
    if unattended:
        check_pin(prepared.settings)
    chance = SystemRandom()
    origin = RunContext(code_commit(), kind=kind_of(prepared.settings), seed=lambda: chance.getrandbits(SEED_BITS))
    mode = RunMode(WindowMode.WINDOW if window else WindowMode.FULL_SCREEN)
    check_screen(mode.display)
    if unattended:
        wait_until_free(data, LEFTOVER_S)
    with Recorder(data, site) as recorder:
        log_into(data)
        with App(mode, recorder, ConditionAssigner(prepared, recorder, origin), beat=beat) as app:
            app.run()
    return {"data": str(data), "sessions": recorder.sessions_begun, "interrupted_before": list(recorder.recovered)}


_TROUBLE = {
    SupervisorEventKind.DIED,
    SupervisorEventKind.HUNG,
    SupervisorEventKind.SWELLED,
    SupervisorEventKind.PAUSE,
    SupervisorEventKind.REFUSED,
    SupervisorEventKind.NO_MEANWHILE,
}

_log = logging.getLogger(__name__)


def supervise_kiosk(
    data: Path,
    study: Path | None,
    site: str,
    robot_host: str | None,
    robot_port: int | None,
    *,
    window: bool,
    silence: float = Timeouts.silence,
    as_json: bool,
) -> int:
    """Keep a kiosk open for visitors until it is left; returns the exit code."""
    given = {"--study": study, "--robot-host": robot_host, "--robot-port": robot_port}
    options = (str(word) for option in given.items() if option[1] is not None for word in option)
    flags = ("--unattended", "--window") if window else ("--unattended",)
    kiosk = program("run", *flags, "--data", str(data), "--site", site, *options)
    return _supervise(kiosk, data, silence, as_json=as_json)


def _supervise(kiosk: Sequence[str], data: Path, silence: float, *, as_json: bool) -> int:
    """Start the kiosk with this command, again and again, until it is left; returns the exit code."""
    log_into(data, shared=True)

    def tell(happening: SupervisorEvent) -> None:
        if as_json:
            click.echo(json.dumps(asdict(happening) | {"what": happening.what.value}))
        _write_down(happening)

    supervisor = Supervisor(kiosk, program("_splash"), tell, Timeouts(silence=silence))
    for ending in (signal.SIGINT, signal.SIGTERM):
        signal.signal(ending, lambda *_: supervisor.end())
    code = supervisor.run()
    if code == REFUSED:
        click.echo("recollect: the kiosk refused what it was given, so it is not started again", err=True)
    return code


def _refuse_without_pin(study: Path | None) -> None:
    """Raise UserInputError for a study without a PIN, before a window is shown; the kiosk reports other mistakes."""
    try:
        settings = read_settings(study)
    except UserInputError:
        return
    check_pin(settings)


def _write_down(happening: SupervisorEvent) -> None:
    """Into the log of the data folder: trouble, and that it is over."""
    if happening.what in _TROUBLE or happening.away_s is not None:
        away = "" if happening.away_s is None else f" ({happening.away_s:.1f} s)"
        detail = f": {happening.detail}" if happening.detail else ""
        _log.warning("start %d of the kiosk: %s%s%s", happening.start, happening.what.value, detail, away)


@click.command()
@click.argument("session", type=int)
@sessions_data_option
@study_option
@click.option(
    "--speed",
    type=click.FloatRange(SLOWEST, FASTEST),
    default=1.0,
    show_default=True,
    help="How many times as fast as it was.",
)
@click.option("--window", is_flag=True, help="Open a window instead of the full screen.")
@click.option("--headless", is_flag=True, help="Use no screen, and save every picture in a folder.")
@click.option("--frames", type=click.Path(path_type=Path), help="That folder; by default session-N here.")
@click.option("--film", type=click.Path(path_type=Path), help="Write a film instead: a .webm or .mp4 file.")
@click.option("--memory", is_flag=True, help="Show how likely each card is remembered, by a model.")
@json_option
def replay_command(
    session: int,
    data: Path,
    study: Path | None,
    speed: float,
    frames: Path | None,
    film: Path | None,
    *,
    memory: bool,
    window: bool,
    headless: bool,
    as_json: bool,
) -> None:
    """Play a stored SESSION on the screen again.

    Space stops it, the arrows step and change its speed, Escape leaves. Its events are handled again, and compared
    with the record; --study names a study file beside whose folder the session's own pictures lie, if they do not
    come with Recollect.
    """
    if film is not None:
        if frames is not None or window or headless:
            raise UserInputError("--film cannot be used with --window, --headless or --frames")
        check_film(film)
    events, plan, seed = _read_story(data, session)
    plan = plan if study is None else plan.with_base_dir(read_settings(study))
    _check_pictures(plan)
    steps = replay_events(plan, seed, events)
    if memory and not has_board(steps):
        raise UserInputError(f"no card was dealt in session {session}, so --memory has nothing to show")
    frames = frames or (Path(f"session-{session}") if headless else None)
    mode = RunMode(WindowMode.WINDOW if window else WindowMode.FULL_SCREEN, ClockMode.WALL, speed)
    if frames is not None:
        make_folder(frames)
    if frames is not None or film is not None:
        mode = RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL, speed if film else 1.0)
    check_screen(mode.display)
    with guarded() as beat, Replay(mode, plan, steps, f"Session {session}", beat) as played:
        if film is not None:
            said = _film(played, plan, film, memory=memory, hidden=as_json)
        else:
            said = _show(played, frames, session, memory=memory, hidden=as_json)
    _tell(session, steps, events, said, as_json=as_json)


def _read_story(data: Path, session: int) -> tuple[list[Event], SessionConfig, int]:
    """Return the events of a session, up to one that cannot be read, its plan and its seed."""
    with open_repository(data) as stored:
        for broken in stored.broken_events(session):
            tell_caution(broken, err=True)
        return stored.readable_story(session), stored.plan(session), stored.seed(session)


def _check_pictures(plan: SessionConfig) -> None:
    settings = plan.settings
    for deck in (settings.game.deck, settings.practice.deck):
        if not settings.resolve_asset("cards", deck).is_dir():
            raise UserInputError(f"the pictures of the deck {deck!r} are not here; name the study file with --study")


_Said = tuple[str, dict[str, Any]]
"""A sentence on what was written, and the same for programs."""


def _show(played: Replay, frames: Path | None, session: int, *, memory: bool, hidden: bool) -> _Said:
    """Play it in its window, or save its pictures in a folder."""
    if memory:
        played.show_memory()
    if frames is not None:
        return _save(played, frames, session, hidden=hidden)
    played.run()
    return "", {"pictures": None}


def _save(played: Replay, folder: Path, session: int, *, hidden: bool) -> _Said:
    saved: list[Path] = []
    with progress_bar("steps", len(played.player.steps), hidden=hidden) as tell:
        for file in played.frames(folder):
            saved.append(file)
            tell(played.player.played)
    return f"{len(saved)} pictures of session {session} are in {folder}.", {"pictures": len(saved)}


def _film(played: Replay, plan: SessionConfig, out: Path, *, memory: bool, hidden: bool) -> _Said:
    with progress_bar("steps", len(played.player.steps), hidden=hidden) as tell:
        seconds = write_film(played, plan.catalogue, out, memory=memory, tell=tell)
    return f"A film of {seconds:.0f} s is in {out}.", {"pictures": None, "film": str(out), "seconds": seconds}


def _tell(session: int, steps: tuple[ReplayStep, ...], events: list[Event], said: _Said, *, as_json: bool) -> None:
    sentence, written = said
    differs = first_difference(steps, events)
    if as_json:
        click.echo(json.dumps({"session": session, "steps": len(steps), **written, "differs_at": differs}))
        return
    if sentence:
        click.echo(sentence)
    if differs is None:
        click.echo(f"Every event of session {session} leads to what was recorded.")
    else:
        click.echo(f"Event {differs} of session {session} leads to something else today than what was recorded.")
