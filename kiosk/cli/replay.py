"""The command that plays a stored session again in the kiosk's window."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

from kiosk import UserInputError
from kiosk.cli.composition import read_settings
from kiosk.cli.options import json_option, progress_bar, sessions_data_option, study_option
from kiosk.cli.terminal import counted, tell_caution
from kiosk.experiment.events import Event
from kiosk.experiment.memory_replay import has_board
from kiosk.experiment.replay import ReplayStep, first_difference, replay_events
from kiosk.experiment.session_config import SessionConfig
from kiosk.guard import guarded
from kiosk.store.queries import open_repository
from kiosk.ui.film import check_film, write_film
from kiosk.ui.replay import Replay
from kiosk.ui.replay_controls import FASTEST, SLOWEST
from kiosk.ui.screenshots import make_folder
from kiosk.ui.window import ClockMode, RunMode, WindowMode, check_screen


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
    return f"{folder} has {counted(len(saved), 'picture')} of session {session}.", {"pictures": len(saved)}


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
