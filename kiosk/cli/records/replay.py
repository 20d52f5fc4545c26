"""The command that plays a stored sitting again."""

from __future__ import annotations

import json
from pathlib import Path

import click

from kiosk import BadInput
from kiosk.cli.options import json_option, sittings_data_option, study_option
from kiosk.cli.progress import progress_bar
from kiosk.keeping.guard import guarded
from kiosk.settings import Settings
from kiosk.store.reading import archive
from kiosk.study.after.replay import Step, first_difference, replayed
from kiosk.study.events import Event
from kiosk.study.plan import Plan
from kiosk.ui.rehearsing.shots import make_folder
from kiosk.ui.replaying.player import FASTEST, SLOWEST
from kiosk.ui.replaying.replay import Replay
from kiosk.ui.window import Display, Mode, Pace, check_screen


@click.command()
@click.argument("sitting", type=int)
@sittings_data_option
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
@click.option("--frames", type=click.Path(path_type=Path), help="That folder; by default sitting-N here.")
@json_option
def replay(
    sitting: int,
    data: Path,
    study: Path | None,
    speed: float,
    frames: Path | None,
    *,
    window: bool,
    headless: bool,
    as_json: bool,
) -> None:
    """Play a stored SITTING again: Space stops it, the arrows step and change its speed, Escape leaves.

    Its events are handled again, and compared with the record; --study names a study file beside whose folder the
    sitting's own pictures lie, if they do not come with Recollect.
    """
    with archive(data) as stored:
        events, plan = stored.story(sitting), stored.plan(sitting)
        seed = stored.seed(sitting)
    plan = plan if study is None else plan.lying_with(Settings.read(study))
    _check_pictures(plan)
    steps = replayed(plan, seed, events)
    frames = frames or (Path(f"sitting-{sitting}") if headless else None)
    mode = Mode(Display.WINDOW if window else Display.FULL_SCREEN, Pace.WALL, speed)
    if frames is not None:
        make_folder(frames)
        mode = Mode(Display.NOWHERE, Pace.VIRTUAL)
    check_screen(mode.display)
    with guarded() as beat, Replay(mode, plan, steps, f"Sitting {sitting}", beat) as played:
        saved = _save(played, frames, hidden=as_json) if frames is not None else None
        if saved is None:
            played.run()
    _tell(sitting, steps, events, saved, frames, as_json=as_json)


def _check_pictures(plan: Plan) -> None:
    settings = plan.settings
    for deck in (settings.game.deck, settings.practice.deck):
        if not settings.find("cards", deck).is_dir():
            raise BadInput(f"the pictures of the deck {deck!r} are not here; name the study file with --study")


def _save(played: Replay, folder: Path, *, hidden: bool) -> int:
    saved: list[Path] = []
    with progress_bar("steps", len(played.player.steps), hidden=hidden) as tell:
        for file in played.frames(folder):
            saved.append(file)
            tell(played.player.played)
    return len(saved)


def _tell(
    sitting: int,
    steps: tuple[Step, ...],
    events: list[Event],
    saved: int | None,
    frames: Path | None,
    *,
    as_json: bool,
) -> None:
    differs = first_difference(steps, events)
    if as_json:
        click.echo(json.dumps({"sitting": sitting, "steps": len(steps), "pictures": saved, "differs_at": differs}))
        return
    if saved is not None:
        click.echo(f"{saved} pictures of sitting {sitting} are in {frames}.")
    if differs is None:
        click.echo(f"Every event of sitting {sitting} leads to what was recorded.")
    else:
        click.echo(f"Event {differs} of sitting {sitting} leads to something else today than what was recorded.")
