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
from kiosk.robots.embodiment import BoardPoint, RobotDriver, RobotError, Utterance
from kiosk.robots.furhat import Furhat, chosen_voice
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
@click.option("--port", type=click.IntRange(1, 65535), help="Its port; 54321, or 9000 with --realtime.")
@click.option("--realtime", is_flag=True, help="Speak the Realtime API instead of the Remote API.")
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
    *,
    realtime: bool,
    as_json: bool,
) -> None:
    """Try a Furhat step by step, and say what it has and what it does."""
    settings = read_settings(study, host or (None if study else "localhost"), port)
    language = language or settings.language_codes[0]
    asked = settings.robot.model_copy(update={"kind": "furhat-realtime"} if realtime else {})
    device = create_robot(asked, language)
    if device is None:
        raise UserInputError("the study file names no robot; name one with --host")
    steps = []
    for step in _tried(device, language, sentence):
        steps.append(step)
        if not as_json:
            click.echo(f"{'yes' if step.worked else 'NO':4}{step.step:22}{step.ms:6} ms  {step.found}")
    worked = all(step.worked for step in steps)
    if as_json:
        click.echo(
            json.dumps({"robot": asked.host, "kind": asked.kind, "works": worked, "steps": [*map(asdict, steps)]})
        )
    sys.exit(0 if worked else FAILED)


def _tried(robot: RobotDriver, language: str, sentence: str | None) -> Iterator[RobotTrial]:
    """Try one thing after another; a robot that is not there is asked nothing further."""
    if isinstance(robot, Furhat):
        yield from _looked_at(robot, language)
    ready = _try("ready to speak", lambda: _ready(robot))
    yield ready
    if not ready.worked:
        return
    yield _try("looks at the visitor", partial(robot.look_at, None))
    yield _try("looks at the board", partial(robot.look_at, BoardPoint(0.5, 0.5)))
    for mood in Mood:
        if mood is not Mood.IDLE:
            yield _try(f"looks {mood.value}", partial(robot.express, mood))
    if sentence is not None:
        yield _try("says the sentence", partial(robot.say, Utterance(sentence, lambda: None)))
        yield _try("can be silenced", robot.stop_speech)
    robot.close()


def _looked_at(furhat: Furhat, language: str) -> Iterator[RobotTrial]:
    """What a Furhat tells about itself; nothing more if it is not there."""
    reached = _try("is it there", lambda: _reach(furhat))
    yield reached
    if reached.worked:
        yield _try("its voices", lambda: ", ".join(f"{voice.name} ({voice.language})" for voice in furhat.voices()))
        yield _try(f"a voice for {language}", lambda: _voice(furhat, language))
        yield _try("its gestures", lambda: ", ".join(furhat.gestures()))
        yield _try("people it sees", lambda: str(furhat.users()))


def _ready(robot: RobotDriver) -> str:
    found = robot.connect()
    return f"speaks as {found.voice.name}" if found.voice else "it answers"


def _reach(furhat: Furhat) -> str:
    furhat.resolve()
    furhat.health_check()
    return "it answers"


def _voice(furhat: Furhat, language: str) -> str:
    voice = chosen_voice(furhat.voices(), language)
    return f"{voice.name} ({voice.language})"


def _try(name: str, do: Callable[[], str | None]) -> RobotTrial:
    begun = monotonic()
    try:
        worked, found = True, do() or "done"
    except RobotError as failure:
        worked, found = False, str(failure)
    return RobotTrial(name, worked, found, round((monotonic() - begun) * MS_PER_SECOND))
