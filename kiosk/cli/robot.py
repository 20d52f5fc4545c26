"""The command that tries a robot step by step and says what it found."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from time import monotonic

import click

from kiosk import UserInputError
from kiosk.cli.composition import read_settings
from kiosk.cli.options import json_option
from kiosk.experiment.effects import Mood
from kiosk.robots.embodiment import (
    BoardPoint,
    Capability,
    InspectableRobot,
    RobotDriver,
    RobotError,
    Utterance,
    chosen_voice,
)
from kiosk.robots.registry import create_robot
from kiosk.units import MS_PER_SECOND

FAILED = 1
"""The exit code when a step failed."""


@dataclass(frozen=True)
class RobotTrial:
    """One thing that was tried: what came of it, and how long it took."""

    step: str
    worked: bool
    found: str
    ms: int


@click.command()
@click.option("--host", help="The robot's name or address; localhost unless the study file says otherwise.")
@click.option("--port", type=click.IntRange(1, 65535), help="Its port; the one that its driver names otherwise.")
@click.option("--kind", help="Its driver, by name; the study file's, or else the first one that there is.")
@click.option("--language", help="The language that it is to speak; the study's unless told otherwise.")
@click.option("--say", "sentence", help="A sentence for it to say.")
@click.option("--study", type=click.Path(path_type=Path), help="The study file (TOML), for its axes and deadlines.")
@json_option
def robot_command(
    host: str | None,
    port: int | None,
    language: str | None,
    sentence: str | None,
    study: Path | None,
    kind: str | None,
    *,
    as_json: bool,
) -> None:
    """Try a robot step by step, and say what it has and what it does."""
    settings = read_settings(study, host or (None if study or kind else "localhost"), port)
    language = language or settings.language_codes[0]
    asked = settings.robot.model_copy(update={"kind": kind} if kind else {})
    device = create_robot(asked, language)
    if device is None:
        raise UserInputError("the study file names no robot; name one with --host or --kind")
    if asked.pack:
        from kiosk.robots.voice_packs import PackClips  # noqa: PLC0415 - for few studies, and it loads the sound

        device.clips = PackClips(settings.voice_from_here)
    steps = []
    for step in _tried(device, language, sentence):
        steps.append(step)
        if not as_json:
            click.echo(f"{'OK' if step.worked else 'FAIL':5}{step.step:22}{step.ms:6} ms  {step.found}")
    worked = all(step.worked for step in steps)
    if as_json:
        click.echo(
            json.dumps({"robot": asked.host, "kind": asked.kind, "works": worked, "steps": [*map(asdict, steps)]})
        )
    sys.exit(0 if worked else FAILED)


def _tried(robot: RobotDriver, language: str, sentence: str | None) -> Iterator[RobotTrial]:
    """Try one thing after another; a robot that is not there is asked nothing further."""
    if isinstance(robot, InspectableRobot):
        yield from _inspected(robot, language)
    ready = _try("ready to speak", lambda: _ready(robot))
    yield ready
    if not ready.worked:
        return
    if Capability.GAZE in robot.capabilities:
        yield _try("looks at the visitor", partial(robot.look_at, None))
        yield _try("looks at the board", partial(robot.look_at, BoardPoint(0.5, 0.5)))
    for mood in Mood:
        if mood is not Mood.IDLE and Capability.GESTURES in robot.capabilities:
            yield _try(f"looks {mood.value}", partial(robot.express, mood))
    if sentence is not None:
        yield _try("says the sentence", partial(_say, robot, sentence))
        yield _try("can be silenced", robot.stop_speech)
    robot.close()


def _inspected(robot: InspectableRobot, language: str) -> Iterator[RobotTrial]:
    """Yield what a robot tells about itself; nothing more if it is not there."""
    reached = _try("is it there", lambda: _reach(robot))
    yield reached
    if reached.worked:
        yield _try("its voices", lambda: ", ".join(f"{voice.name} ({voice.language})" for voice in robot.voices()))
        yield _try(f"a voice for {language}", lambda: _voice(robot, language))
        yield _try("its gestures", lambda: ", ".join(robot.gestures()))
        yield _try("people it sees", lambda: str(robot.users()))


def _say(robot: RobotDriver, sentence: str) -> str:
    """Have a sentence said; returns whose voice it was, where a clip was to be played."""
    reasons: list[str] = []
    robot.on_own_voice = reasons.append
    robot.say(Utterance(sentence, lambda: None, robot.longest_text))
    if robot.clips is None:
        return "done"
    if robot.spoken_by:
        return f"it played the clip of {robot.spoken_by['voice']}"
    return f"with its own voice: {reasons[0] if reasons else 'no pack can say it'}"


def _ready(robot: RobotDriver) -> str:
    found = robot.connect()
    return f"speaks as {found.voice.name}" if found.voice else "it answers"


def _reach(robot: InspectableRobot) -> str:
    robot.resolve()
    robot.health_check()
    return "it answers"


def _voice(robot: InspectableRobot, language: str) -> str:
    voice = chosen_voice(robot.voices(), language)
    return f"{voice.name} ({voice.language})"


def _try(name: str, do: Callable[[], str | None]) -> RobotTrial:
    begun = monotonic()
    try:
        worked, found = True, do() or "done"
    except RobotError as failure:
        worked, found = False, str(failure)
    return RobotTrial(name, worked, found, round((monotonic() - begun) * MS_PER_SECOND))
