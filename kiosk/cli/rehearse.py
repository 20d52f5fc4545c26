"""The command with which simulated visitors use the real window: one, looked at closely, or a whole day of them."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, replace
from itertools import count, repeat
from math import isfinite
from pathlib import Path
from random import Random
from statistics import mean
from tempfile import TemporaryDirectory
from time import monotonic
from typing import Any

import click

from kiosk import UserInputError
from kiosk.cli.composition import code_commit, read_settings
from kiosk.cli.options import (
    json_option,
    progress_bar,
    rehearsal_data_option,
    robot_host_option,
    robot_port_option,
    study_option,
)
from kiosk.cli.terminal import counted, tell_line
from kiosk.config import NO_ROBOT, STAGES
from kiosk.experiment.events import Event
from kiosk.experiment.outcomes import SessionKind, Stage
from kiosk.experiment.projections import count_speech, waiting_shares
from kiosk.experiment.session_config import StudyConfig
from kiosk.experiment.session_state import SessionState
from kiosk.guard import guarded
from kiosk.robots.registry import check_robot
from kiosk.robots.simulated import FlakyRobot
from kiosk.store.recorder import Recorder
from kiosk.study.loader import read_study
from kiosk.training.simulated_players import PopulationPlayer
from kiosk.ui.app import App
from kiosk.ui.condition_assigner import ConditionAssigner, RunContext
from kiosk.ui.rehearsal import CoversRehearsal, Rehearsal
from kiosk.ui.rehearsed_day import ProcessUsage, day_summary, draw_visitors, rehearse_day
from kiosk.ui.screenshots import LAYOUTS, Screenshots, layout_of, make_folder, resize
from kiosk.ui.simulated_visitor import BehaviourKind, BehaviourProfile, MemoryTraits, UiTimeout
from kiosk.ui.window import ClockMode, RunMode, WindowMode, check_screen

LARGEST_SEED = 2**63 - 1
BOTH = "both"
"""Asks for the single pictures of each layout."""

SETTLE_MS = 450
"""When a picture is taken after its moment, so that nothing moves any more."""

WAIT_MS = 1_000
"""How long virtual time stands still, at each attempt to write, for another program that holds the database."""

manner_option = click.option(
    "--visitor",
    type=click.Choice([manner.value for manner in BehaviourKind]),
    default=BehaviourKind.COMPLETES.value,
    show_default=True,
    help="What kind of visitor comes.",
)
leaves_option = click.option(
    "--leaves-in",
    type=click.Choice(STAGES),
    default=Stage.GAME.value,
    show_default=True,
    help="Where a visitor who leaves walks away.",
)


@click.command()
@click.option(
    "--seed",
    type=click.IntRange(0, LARGEST_SEED),
    default=1,
    show_default=True,
    help="The same seed plays the same session.",
)
@click.option("--headless", is_flag=True, help="Use no screen, and play as fast as the machine allows.")
@click.option("--speed", type=click.FloatRange(0.01, 1000), help="How many times as fast as in real life.")
@click.option("--condition", help="The help that the visitor gets: tom, notom, or another cell of the design.")
@click.option("--language", help="The language that the visitor chooses; by default the study's first.")
@manner_option
@leaves_option
@click.option(
    "--sessions",
    type=click.IntRange(1, 100_000),
    default=1,
    show_default=True,
    help="More than one is a day at the booth: visitors of every kind, and a robot that comes and goes.",
)
@click.option(
    "--people",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Draw each visitor's memory from this file, which recollect calibrate wrote.",
)
@click.option(
    "--shots",
    type=click.Path(path_type=Path),
    help="Save a picture of every moment in this folder, and contact sheets of the session: with --headless one for "
    "each language (or that of --language) and layout, and pictures of the pause, of the questions to stop and whether "
    "you are still there, and of the panel.",
)
@click.option(
    "--layout",
    type=click.Choice((*LAYOUTS, BOTH)),
    help="With --headless --shots: save the pictures and contact sheets of this layout only; with both, save the "
    "single pictures of each layout in a folder of its own.",
)
@click.option(
    "--returning",
    is_flag=True,
    help="The visitor agrees to come back, and does so at once with the code of their card, in a second session.",
)
@rehearsal_data_option
@study_option
@robot_host_option
@robot_port_option
@json_option
def rehearse(
    seed: int,
    speed: float | None,
    condition: str | None,
    language: str | None,
    visitor: str,
    leaves_in: str,
    sessions: int,
    people: Path | None,
    shots: Path | None,
    layout: str | None,
    data: Path,
    study: Path | None,
    robot_host: str | None,
    robot_port: int | None,
    *,
    returning: bool,
    headless: bool,
    as_json: bool,
) -> None:
    """Let simulated visitors go through sessions or a whole day.

    It clicks in the real window. With --sessions many visitors go through a day. A robot takes its own time: while
    it is at work, even a rehearsal without a screen waits as long as a visitor would.
    """
    prepared = read_study(read_settings(study, robot_host, robot_port))
    check_robot(prepared.settings)
    _check(prepared, speed, language)
    _check_returning(prepared, visitor, sessions, returning=returning)
    mode = _mode(speed, headless=headless)
    check_screen(mode.display)
    memories = _memories(people, seed, HESITATES if prepared.settings.assistance.hesitation_max else 0.0)
    if _has_robot(prepared) and mode.pace is ClockMode.VIRTUAL and not as_json:
        click.echo("A robot speaks in real time, so a session with one takes minutes, also with --headless.", err=True)
    if sessions > 1:
        visitors = draw_visitors(sessions, seed, prepared.languages)
        characters = tuple(replace(visitor, memory=next(memories)) for visitor in visitors)
        _rehearse_day(prepared, mode, data, seed, characters, as_json=as_json)
        return
    folders = _make_folders(shots, layout if headless else None)
    sheets = _sheets(prepared, language, layout) if shots is not None and headless else ()
    language = language or prepared.languages[0]
    character = BehaviourProfile(BehaviourKind(visitor), Stage(leaves_in), language, next(memories), links=returning)
    # Where the visitor comes back, the list decides, and after it what the first visit was.
    listed = returning and condition is None
    fixed = None if listed else prepared.condition(condition or prepared.settings.assistance.condition)
    origin = RunContext(code_commit(), kind=SessionKind.SIMULATED, seed=lambda: seed, condition=fixed)
    with (
        guarded() as beat,
        open_recorder(data, mode) as recorder,
        App(mode, recorder, ConditionAssigner(prepared, recorder, origin), beat=beat) as app,
    ):
        pictures = _pictures(app, mode, shots, layout if headless and layout != BOTH else None, folders)
        with _stuck_in_words():
            rehearsal = _visit(app, seed, pictures, character)
        if app.stop_requested:
            raise click.Abort
        begun = recorder.sessions_recorded
    if shots is not None and pictures is not None:
        if headless and begun and character.manner is BehaviourKind.COMPLETES:
            _shoot_covers(prepared, mode, origin, character, pictures, seed)
        if layout in (None, BOTH, pictures.layout):
            pictures.sheet.save(shots / f"contact-{language}-{pictures.layout}.png")
        for other, how in set(sheets) - {(language, pictures.layout)}:
            folder = folders.get(how) if other == language else None
            _shoot_sheet(prepared, mode, origin, replace(character, language=other), how, shots, seed, folder)
    told = _last_session(data, rehearsal.pulse.longest_ms if _has_robot(prepared) else None) if begun else {"stored": 0}
    _tell(told, data, shots, as_json=as_json)


def _check_returning(study: StudyConfig, visitor: str, sessions: int, *, returning: bool) -> None:
    """Raise UserInputError if a visitor is to come back, and cannot."""
    if returning and not study.settings.returning.enabled:
        raise UserInputError("--returning needs a study that lets visitors come back: returning.enabled = true")
    if returning and (sessions > 1 or visitor != BehaviourKind.COMPLETES.value):
        raise UserInputError("--returning is about one visitor who completes; leave out --sessions and --visitor")


def _visit(app: App, seed: int, pictures: Screenshots | None, character: BehaviourProfile) -> Rehearsal:
    """Have a visitor come, and come back at once if they agree that visits are linked; returns the last visit."""
    rehearsal = Rehearsal(app, seed, pictures, character)
    rehearsal.run()
    if character.links and not app.stop_requested:
        rehearsal = Rehearsal(app, seed, pictures, replace(character, code=rehearsal.code))
        rehearsal.run()
    return rehearsal


def _make_folders(shots: Path | None, layout: str | None) -> dict[str, Path]:
    """Make the folders for the pictures; return where the single ones of each layout belong, if both are wanted."""
    if shots is None:
        return {}
    folders = {how: shots / how for how in LAYOUTS} if layout == BOTH else {}
    for folder in (shots, *folders.values()):
        make_folder(folder)
    return folders


def _pictures(
    app: App, mode: RunMode, shots: Path | None, layout: str | None, folders: Mapping[str, Path]
) -> Screenshots | None:
    """Give what takes the pictures of a session, if they are wanted, and size the window to the layout."""
    if shots is None:
        return None
    if layout is not None:
        resize(app.window, layout)
    folder = folders.get(layout_of(app.window.size()), shots)
    return Screenshots(app.window, folder, app.clock, 0 if mode.pace is ClockMode.VIRTUAL else SETTLE_MS)


def _sheets(study: StudyConfig, language: str | None, layout: str | None) -> tuple[tuple[str, str], ...]:
    """List the languages and layouts of which there is a contact sheet."""
    languages = study.languages if language is None else (language,)
    return tuple((each, how) for each in languages for how in LAYOUTS if layout in (None, BOTH, how))


def _shoot_sheet(
    study: StudyConfig,
    mode: RunMode,
    origin: RunContext,
    character: BehaviourProfile,
    layout: str,
    shots: Path,
    seed: int,
    folder: Path | None,
) -> None:
    """Rehearse the session once more in another language or layout, for its contact sheet; it is not kept.

    Its single pictures are saved in ``folder``, if there is one.
    """
    with (
        TemporaryDirectory() as unkept,
        guarded() as beat,
        open_recorder(Path(unkept), mode) as recorder,
        App(mode, recorder, ConditionAssigner(study, recorder, origin), beat=beat) as app,
    ):
        resize(app.window, layout)
        pictures = Screenshots(app.window, folder, app.clock, 0)
        with _stuck_in_words():
            Rehearsal(app, seed, pictures, character).run()
        if app.stop_requested:
            raise click.Abort
        begun = recorder.sessions_recorded
    if folder is not None and begun and character.manner is BehaviourKind.COMPLETES:
        _shoot_covers(study, mode, origin, character, pictures, seed)
    pictures.sheet.save(shots / f"contact-{character.language}-{layout}.png")


def _shoot_covers(
    study: StudyConfig,
    mode: RunMode,
    origin: RunContext,
    character: BehaviourProfile,
    before: Screenshots,
    seed: int,
) -> None:
    """Play up to the first pair once more for pictures of what may lie over a game.

    The session is not kept.
    """
    if "game" not in study.settings.stages:
        return
    with (
        TemporaryDirectory() as unkept,
        guarded() as beat,
        open_recorder(Path(unkept), mode) as recorder,
        App(mode, recorder, ConditionAssigner(study, recorder, origin), beat=beat) as app,
    ):
        resize(app.window, before.layout)
        pictures = Screenshots(app.window, before.folder, app.clock, 0, before)
        with _stuck_in_words():
            CoversRehearsal(app, seed, pictures, character).run()
        if app.stop_requested:
            raise click.Abort


HESITATES = 0.08
"""How often a visitor hesitates before a click, in a study that helps those who do."""


def _memories(people: Path | None, seed: int, hesitation: float) -> Iterator[MemoryTraits]:
    """Return the memories of the visitors to come: all alike, or drawn from a file of people."""
    if people is None:
        return repeat(MemoryTraits(hesitation=hesitation))
    population, rng = PopulationPlayer.load(people), Random(f"{seed}/people")
    return (MemoryTraits(population.draw(rng), population.follow, population.lapse, hesitation) for _ in count())


def _check(study: StudyConfig, speed: float | None, language: str | None) -> None:
    """Raise UserInputError for what no rehearsal can do."""
    if speed is not None and not isfinite(speed):
        raise UserInputError(f"--speed must be a number, not {speed}")
    if _has_robot(study) and speed not in {None, 1}:
        raise UserInputError("a robot speaks at its own speed, so a rehearsal with one cannot have another")
    if language is not None and language not in study.languages:
        raise UserInputError(f"the study has no language {language!r}; it has {', '.join(study.languages)}")


def _has_robot(study: StudyConfig) -> bool:
    return study.settings.robot.kind != NO_ROBOT


def _mode(speed: float | None, *, headless: bool) -> RunMode:
    """Without a screen and without a wish for a speed, nothing is waited for."""
    display = WindowMode.NOWHERE if headless else WindowMode.FULL_SCREEN
    if headless and speed is None:
        return RunMode(display, ClockMode.VIRTUAL)
    return RunMode(display, ClockMode.WALL, speed or 1.0)


def open_recorder(data: Path, mode: RunMode) -> Recorder:
    """Open the recorder; where time is virtual it stands still while another program holds the database."""
    return Recorder(data, wait_ms=WAIT_MS if mode.pace is ClockMode.VIRTUAL else 0)


@contextmanager
def _stuck_in_words() -> Iterator[None]:
    try:
        yield
    except UiTimeout as stuck:
        raise click.ClickException(f"the rehearsal cannot go on: {stuck}") from stuck


def _rehearse_day(
    study: StudyConfig, mode: RunMode, data: Path, seed: int, visitors: tuple[BehaviourProfile, ...], *, as_json: bool
) -> None:
    """Visitors of every kind, one after another, in one process."""
    seeds = count(seed)
    origin = RunContext(code_commit(), kind=SessionKind.SIMULATED, seed=lambda: next(seeds))
    robot = None if _has_robot(study) else FlakyRobot(seed)
    begun = monotonic()
    with (
        guarded() as beat,
        open_recorder(data, mode) as recorder,
        App(mode, recorder, ConditionAssigner(study, recorder, origin), robot, beat) as app,
    ):
        holdings: list[ProcessUsage] = []
        with _stuck_in_words(), progress_bar("sessions", len(visitors), hidden=as_json) as tell:
            for holding in rehearse_day(app, seed, visitors, data):
                holdings.append(holding)
                tell(len(holdings))
        if app.stop_requested:
            raise click.Abort
        stored = recorder.sessions_recorded
    told = (
        day_summary(visitors, holdings)
        | {"stored": stored, "seconds": round(monotonic() - begun)}
        | _ends(data, stored)
    )
    click.echo(json.dumps(told) if as_json else _in_words(told))


def _ends(data: Path, stored: int) -> dict[str, Any]:
    """How the stored sessions ended, and how often another body had to help."""
    from kiosk.store.queries import open_repository  # noqa: PLC0415 - a tenth of a second that opening need not pay

    with open_repository(data) as there:
        played = there.sessions(newest=stored)
        states = [SessionState.from_events(there.events(session.id)) for session in played]
    ends = Counter(session.status.value if session.status else "running" for session in played)
    changes = sum(len(state.embodiment_changes) for state in states)
    waits = [shares for state in states if (shares := waiting_shares(state)) is not None]
    return {
        "ends": dict(ends),
        "embodiment_changes": changes,
        "finished_games": len(waits),
        "taps_wait_for_hint": round(mean(each.hint for each in waits), 3) if waits else None,
        "taps_wait_turning_back": round(mean(each.turning_back for each in waits), 3) if waits else None,
    }


def _in_words(told: dict[str, Any]) -> str:
    lines = [
        f"{counted(told['sessions'], 'visitor')} in {told['seconds']} s, {counted(told['stored'], 'session')} stored: "
        f"{', '.join(f'{number} {end}' for end, number in told['ends'].items()) or 'none'}.",
        f"The robot was lost {counted(told['embodiment_changes'], 'time')}.",
        f"Longest gap of the event loop {told['longest_gap_ms']} ms, median of a session's {told['median_gap_ms']} ms.",
        "              after warm-up   at the end   per session",
    ]
    begun, ended, slopes = told["after_warm_up"], told["at_the_end"], told["slopes_per_session"]
    lines += [
        f"{name:15}{begun[name]:12}{ended[name]:13}{slopes[name]:14}" for name in ProcessUsage.__dataclass_fields__
    ]
    if told["finished_games"]:
        hint, turning = told["taps_wait_for_hint"], told["taps_wait_turning_back"]
        lines.append(
            f"In {counted(told['finished_games'], 'finished game')} taps waited {hint:.1%} of the time for a hint, "
            f"and {turning:.1%} for cards to turn back."
        )
    left = "Nothing is left over." if told["nothing_is_left"] else "Something is left over at the end of the day."
    return "\n".join((*lines, left))


def _last_session(data: Path, longest_gap_ms: float | None) -> dict[str, Any]:
    """Return the session that was just stored; with a robot, what became of its sentences besides."""
    from kiosk.store.queries import open_repository  # noqa: PLC0415 - a tenth of a second that opening need not pay

    with open_repository(data) as stored:
        played = stored.sessions(newest=1)[0].to_json()
        if longest_gap_ms is not None:
            played |= _with_robot(stored.events(played["session"]), longest_gap_ms)
    return played


def _with_robot(events: list[Event], longest_gap_ms: float) -> dict[str, Any]:
    state = SessionState.from_events(events)
    return {
        "longest_gap_ms": round(longest_gap_ms, 1),
        "embodiment_changes": len(state.embodiment_changes),
        "utterances": asdict(count_speech(state)),
    }


def _tell(played: dict[str, Any], data: Path, shots: Path | None, *, as_json: bool) -> None:
    if as_json:
        click.echo(json.dumps(played))
        return
    if "session" in played:
        line = "Session {session} ({condition}) {status}: {pairs} pairs in {moves} moves, {hints} hints."
        click.echo(line.format(**played))
        tell_line(f"Its record is in {data}" + (f", its pictures are in {shots}." if shots else "."))
    else:
        click.echo("The visitor did not take part, so nothing is stored but that they came.")
