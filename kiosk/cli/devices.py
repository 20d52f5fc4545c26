"""The commands that try a robot, and make and play voice packs."""

from __future__ import annotations

import json
import queue
import sys
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from dataclasses import asdict, dataclass
from functools import partial
from itertools import chain, product
from pathlib import Path
from time import monotonic

import click

from kiosk import UserInputError
from kiosk.cli.composition import read_settings
from kiosk.cli.options import json_option, progress_bar, study_option
from kiosk.cli.terminal import tell_line
from kiosk.config import VOICE_ENGINES, RobotConfig, Settings, is_path
from kiosk.experiment.effects import Mood
from kiosk.experiment.page_stages import result_speech
from kiosk.experiment.session_config import SessionConfig
from kiosk.game import CARDS_IN_A_PAIR
from kiosk.robots.driver import Capability, InspectableRobot, RobotDriver, RobotError, Utterance, chosen_voice, mismatch
from kiosk.robots.embodiment import BoardPoint
from kiosk.robots.furhat_rules import Request
from kiosk.robots.registry import create_robot
from kiosk.robots.sound_device import Player, create_player
from kiosk.robots.tts_engines import SpeechEngine, create_engine
from kiosk.robots.tts_worker import SpeechSource
from kiosk.robots.voice_packs import PackLabel, VoicePack, cache_folder, import_recordings, recording_name, render_pack
from kiosk.study.loader import read_study
from kiosk.units import MS_PER_SECOND

FAILED = 1
"""The exit code when a step failed."""

_LISTEN_S = 0.5
"""How long a pretended robot waits for a request before it looks whether it is to end."""


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
@click.option("--pretend", is_flag=True, help="Be a Furhat without a robot, on this machine, until Ctrl+C.")
@json_option
def robot_command(
    host: str | None,
    port: int | None,
    language: str | None,
    sentence: str | None,
    study: Path | None,
    kind: str | None,
    *,
    pretend: bool,
    as_json: bool,
) -> None:
    """Try a robot step by step and show what it can do."""
    if pretend:
        others = (host, kind, language, sentence, study)
        if as_json or any(each is not None for each in others):
            raise UserInputError("--pretend goes with --port alone")
        _pretend(port)
        return
    settings = read_settings(study, "localhost" if host is None and not (study or kind) else host, port)
    language = language or settings.language_codes[0]
    asked = settings.robot.model_copy(update={"kind": kind} if kind else {})
    device = _robot(settings, asked, language)
    if device is None:
        raise UserInputError("the study file names no robot; name one with --host or --kind")
    steps = []
    for step in _tried(device, language, sentence):
        steps.append(step)
        if not as_json:
            tell_line(f"{'OK' if step.worked else 'FAIL':5}{step.step:22}{step.ms:6} ms  {step.found}")
    worked = all(step.worked for step in steps)
    if as_json:
        click.echo(
            json.dumps({"robot": asked.host, "kind": asked.kind, "works": worked, "steps": [*map(asdict, steps)]})
        )
    sys.exit(0 if worked else FAILED)


def _pretend(port: int | None) -> None:
    """Serve a pretended Furhat until it is interrupted, and print what it is asked."""
    from kiosk.robots.furhat import Furhat  # noqa: PLC0415 - for this option alone
    from kiosk.robots.furhat_pretended import PretendedFurhat  # noqa: PLC0415

    port = port or Furhat.default_port
    heard: queue.SimpleQueue[Request] = queue.SimpleQueue()
    try:
        robot = PretendedFurhat(port=port, heard=heard.put)
    except OSError as error:
        raise UserInputError(f"no Furhat can be pretended at port {port}: {error.strerror}") from error
    with robot, suppress(KeyboardInterrupt):
        click.echo(
            f"A pretended Furhat listens at localhost, port {robot.port}. It takes as long to speak as a robot. "
            "Ctrl+C ends it."
        )
        while True:
            with suppress(queue.Empty):
                # Ctrl+C just before a wait without an end would not be heard, and on Windows during one neither.
                request = heard.get(timeout=_LISTEN_S)
                words = ", ".join(f"{name}={value}" for name, value in request.parameters.items())
                tell_line(f"{request.path.removeprefix('/furhat/'):12}{words}")


def greet(settings: Settings, language: str, sentence: str) -> RobotTrial | None:
    """Have the robot of a study file say a sentence to its end; None if the file names no robot."""
    device = _robot(settings, settings.robot, language)
    if device is None:
        return None
    tried = _try("ready to speak", lambda: _ready(device))
    if tried.worked:
        tried = _try("says the sentence", partial(_say, device, sentence))
        device.close()
    return tried


def _robot(settings: Settings, robot: RobotConfig, language: str) -> RobotDriver | None:
    device = create_robot(robot, language)
    if device is not None and robot.pack:
        from kiosk.robots.voice_packs import PackClips  # noqa: PLC0415 - for few studies, and it loads the sound

        device.clips = PackClips(settings.voice_from_here)
    return device


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
    voice = chosen_voice(robot.voices(), language, robot.settings.voice)
    return mismatch(voice, language) or f"{voice.name} ({voice.language})"


def _try(name: str, do: Callable[[], str | None]) -> RobotTrial:
    begun = monotonic()
    try:
        worked, found = True, do() or "done"
    except RobotError as failure:
        worked, found = False, str(failure)
    return RobotTrial(name, worked, found, round((monotonic() - begun) * MS_PER_SECOND))


MOST_MOVES = 60
"""Results are rendered up to so many moves; what lies beyond is left to the engine."""

FAULTY = 1
"""The exit code when a pack lacks a text or has a fault."""

_TEND_S = 0.1

language_option = click.option("--language", help="The language; by default every language of the study.")
one_language_option = click.option("--language", default="en", show_default=True, help="The language.")


@click.group("voice")
def voice_group() -> None:
    """Make voice packs and look at them.

    They come from an engine or from a person's recordings.
    """


def spoken_texts(plan: SessionConfig) -> tuple[str, ...]:
    """List every text that a study can have spoken in a language: parts of hints, greetings, remarks and thanks."""
    catalogue, game = plan.catalogue, plan.settings.game
    pairs = game.rows * game.columns // CARDS_IN_A_PAIR
    count = {"cards": CARDS_IN_A_PAIR * pairs, "pairs": pairs}
    speeches = {
        "introduction-speech": count,
        "introduction-speech-alone": count,
        "practice-speech": {},
        "thanks-speech": {},
    }
    moves = range(pairs, max(MOST_MOVES, 2 * pairs) + 1)
    return tuple(
        dict.fromkeys(
            chain(
                _hint_texts(plan),
                *(catalogue.wordings(message, **variables) for message, variables in speeches.items()),
                *(catalogue.wordings(result_speech(number, pairs), moves=number) for number in moves),
            )
        )
    )


def _hint_texts(plan: SessionConfig) -> Iterator[str]:
    """Yield the parts of hints: a reason for each card, and each place."""
    catalogue, game, practice = plan.catalogue, plan.settings.game, plan.settings.practice
    decks, most_rows, most_columns = plan.deck, game.rows, game.columns
    if practice.hints:
        decks = (*plan.deck, *plan.practice_deck)
        most_rows, most_columns = max(game.rows, practice.rows), max(game.columns, practice.columns)
    for message in sorted(catalogue.messages):
        if message.startswith("reason-"):
            for card in decks:
                yield from catalogue.wordings(message, **catalogue.card(card))
        elif message.startswith("point-"):
            rows = (1,) if message.endswith("-column") else range(1, most_rows + 1)
            columns = (1,) if message.endswith("-row") else range(1, most_columns + 1)
            for row, column in product(rows, columns):
                yield from catalogue.wordings(message, row=row, column=column)


def _plans(study: Path | None, language: str | None) -> tuple[SessionConfig, ...]:
    plans = read_study(read_settings(study)).plans
    if language is None:
        return plans
    found = tuple(plan for plan in plans if plan.language == language)
    if not found:
        there = ", ".join(plan.language for plan in plans)
        raise UserInputError(f"the study has no language {language!r}; it has {there}")
    return found


def _plan(study: Path | None, language: str) -> SessionConfig:
    return _plans(study, language)[0]


def _engine(language: str, rate: int, name: str) -> SpeechEngine:
    try:
        return create_engine(language, rate, name)
    except Exception as error:  # engines raise whatever they like when a library is missing
        raise UserInputError(f"the engine {name or 'of the system'} cannot be started: {error}") from error


@voice_group.command("render")
@study_option
@language_option
@click.option(
    "--engine", "name", type=click.Choice(VOICE_ENGINES), help="By default the study's, or the best there is."
)
@click.option("--out", type=click.Path(path_type=Path), help="The pack's folder; by default one in the cache.")
@json_option
def render_command(
    study: Path | None, language: str | None, name: str | None, out: Path | None, *, as_json: bool
) -> None:
    """Render every sentence of a study once.

    The kiosk then only plays them. Clips that exist are kept.
    """
    plans = _plans(study, language)
    if out is not None and len(plans) > 1:
        raise UserInputError("a pack has one language: name it with --language")
    told = {}
    for plan in plans:
        voice = plan.settings.voice
        named = name or voice.speakers.get(plan.language, "")
        if is_path(named):
            continue
        engine = _engine(plan.language, voice.rate, named)
        folder = out or cache_folder(plan.language, engine.name, voice.rate)
        texts = spoken_texts(plan)
        with progress_bar(f"voice {plan.language}", len(texts), hidden=as_json) as tell:
            pack = render_pack(engine, plan.language, texts, folder, tell)
        told[plan.language] = {"folder": str(folder), "clips": len(pack.clips), "sha256": pack.sha256}
        if not as_json:
            tell_line(f"{plan.language}: {pack.described} in {folder}")
    if as_json:
        click.echo(json.dumps(told))


@voice_group.command("script")
@study_option
@one_language_option
@json_option
def script_command(study: Path | None, language: str, *, as_json: bool) -> None:
    """Print the texts that a person reads aloud for a pack.

    Name each recording by the number of its line.
    """
    plan = _plan(study, language)
    lines = {recording_name(number): text for number, text in enumerate(spoken_texts(plan), 1)}
    if as_json:
        click.echo(json.dumps({"language": language, "lines": lines}))
        return
    click.echo(f"Read each line as one calm sentence; store it under its name as a WAV file ({language}).\n")
    for name, text in lines.items():
        tell_line(f"{name}  {text}")


@voice_group.command("import")
@click.argument("recordings", type=click.Path(path_type=Path, exists=True, file_okay=False))
@click.option("--out", type=click.Path(path_type=Path), required=True, help="The pack's folder.")
@click.option("--speaker", required=True, help="Who spoke: a name for the record, best a pseudonym.")
@click.option("--licence", default="all rights reserved", show_default=True, help="How the recordings may be used.")
@study_option
@one_language_option
@json_option
def import_command(
    recordings: Path, out: Path, speaker: str, licence: str, study: Path | None, language: str, *, as_json: bool
) -> None:
    """Make a pack from a person's RECORDINGS.

    'voice script' numbers their names. They are trimmed and levelled.
    """
    texts = spoken_texts(_plan(study, language))
    pack = import_recordings(recordings, out, texts, PackLabel.of_person(language, speaker, licence))
    missing = len(pack.missing(texts))
    if as_json:
        made = {"folder": str(out), "clips": len(pack.clips), "missing": missing, "sha256": pack.sha256}
        click.echo(json.dumps(made))
        return
    tell_line(f"{pack.described} in {out}; {missing} texts are missing" if missing else f"{pack.described} in {out}")


@voice_group.command("missing")
@click.argument("folder", type=click.Path(path_type=Path))
@study_option
@json_option
@click.pass_context
def missing_command(context: click.Context, folder: Path, study: Path | None, *, as_json: bool) -> None:
    """Print every text that the pack in FOLDER lacks.

    The exit code is 1 if there is any.
    """
    pack = VoicePack.read(folder)
    missing = pack.missing(spoken_texts(_plan(study, pack.language)))
    if as_json:
        click.echo(json.dumps({"language": pack.language, "missing": [*missing]}))
    else:
        for text in missing:
            click.echo(text)
    context.exit(FAULTY if missing else 0)


@voice_group.command("check")
@click.argument("folder", type=click.Path(path_type=Path))
@json_option
@click.pass_context
def check_pack_command(context: click.Context, folder: Path, *, as_json: bool) -> None:
    """Check every clip of the pack in FOLDER.

    Each must be there, unchanged, neither silent nor clipped, and as loud as the others. The exit code is 1 if one
    is not.
    """
    pack = VoicePack.read(folder)
    faults = tuple(pack.faults())
    if as_json:
        click.echo(json.dumps({"pack": pack.described, "sha256": pack.sha256, "faults": [*faults]}))
    else:
        for fault in faults:
            click.echo(fault)
        click.echo(f"{pack.described}, licence {pack.licence}, sha256 {pack.sha256}: {len(faults) or 'no'} faults")
    context.exit(FAULTY if faults else 0)


@voice_group.command("play")
@click.argument("text")
@study_option
@one_language_option
@json_option
def play_command(text: str, study: Path | None, language: str, *, as_json: bool) -> None:
    """Say TEXT on the study's sound device, as the kiosk would."""
    voice = read_settings(study).voice_from_here
    events: queue.Queue[dict[str, object] | None] = queue.Queue()
    source = SpeechSource(language, voice.rate, voice.speakers.get(language, ""))
    if source.voice is None:
        raise UserInputError(f"no installed voice speaks {language!r}")
    clip, by = source.clip(text)
    with closing(create_player(events.put, source.rate, voice.device, voice.volume)) as player:
        player.play(1, clip)
        while (event := _next(player, events)).get("event") not in {"finished", "broken"}:
            pass
    if event["event"] == "broken":
        raise UserInputError(f"nothing is heard: {event['why']}")
    if as_json:
        click.echo(json.dumps({"voice": by["voice"], "engine": by["engine"], "duration_ms": clip.duration_ms}))
        return
    click.echo(f"{by['voice']} of {by['engine']} said it in {clip.duration_ms / 1000:.1f} s")


def _next(player: Player, events: queue.Queue[dict[str, object] | None]) -> dict[str, object]:
    """Return what the player posts next; nothing if it posts nothing for a moment."""
    try:
        return events.get(timeout=_TEND_S) or {}
    except queue.Empty:
        player.tend()
        return {}
