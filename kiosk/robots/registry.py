"""The robots that a study file can name, and the checks of robot, sound and voice."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from typing import Any

from pydantic import ValidationError

from kiosk import UserInputError
from kiosk.config import NO_ROBOT, Settings, VoiceConfig
from kiosk.config import RobotConfig as RobotSettings
from kiosk.errors import validation_messages
from kiosk.extensions import Extension, ExtensionGroup, find
from kiosk.preflight import CheckResult
from kiosk.robots.driver import Capability, InspectableRobot, RobotDriver, RobotError, chosen_voice, mismatch
from kiosk.robots.embodiment import Health
from kiosk.units import MS_PER_SECOND


def load_driver(extension: Extension) -> type[RobotDriver]:
    """Import a driver.

    Raises UserInputError if it is none, or does not go by the name that it is registered by.
    """
    driver = extension.load()
    if not isinstance(driver, type) or not issubclass(driver, RobotDriver):
        raise extension.broken(f"{extension.entry.value} is no class derived from kiosk.robots.driver.RobotDriver")
    if getattr(driver, "name", None) != extension.name:
        raise extension.broken(f"its class must have name = {extension.name!r}")
    if missing := sorted(driver.__abstractmethods__):
        raise extension.broken(f"its class lacks {', '.join(missing)}")
    return driver


def create_robot(settings: RobotSettings, language: str) -> RobotDriver | None:
    """Return the robot of these settings, not yet looked for; None if the avatar is to be alone.

    Raises UserInputError for a robot that is not installed or is broken, and for options that it does not take.
    """
    if settings.kind == NO_ROBOT:
        return None
    extension = find(ExtensionGroup.ROBOTS, settings.kind)
    driver = load_driver(extension)
    if settings.pack and Capability.CLIPS not in driver.capabilities:
        raise UserInputError(f"robot.pack: the driver {settings.kind} cannot have its robot play a voice pack's clips")
    try:
        driver.options.model_validate(settings.options)
    except ValidationError as error:
        sentences = validation_messages(error, settings.options, driver.options)
        raise UserInputError(*(f"robot.options: {sentence}" for sentence in sentences)) from error
    try:
        return driver(settings, language)
    except UserInputError:
        raise
    except Exception as error:
        raise extension.broken(f"{type(error).__name__}: {error}") from error


def check_robot(settings: Settings) -> None:
    """Raise UserInputError if the robot of a study file cannot be used; it is not looked for."""
    try:
        create_robot(settings.robot, settings.language_codes[0])
    except UserInputError as refusal:
        raise UserInputError(*(f"{settings.name}: {sentence}" for sentence in refusal.sentences)) from refusal


SOUND = "sound"

_UNHEARD = "sentences are shown, and nothing is heard"
_LOUDSPEAKER = "plug in a loudspeaker, choose it in the system's settings or as voice.device, and play a sound on it"


def sound_check(command: Sequence[str], *, busy: bool, told: Health | None = None) -> Iterator[CheckResult]:
    """Have the voice's process play silence; not while a kiosk is ``busy``, which may need the card itself.

    ``told`` is what that kiosk says of its voice.
    """
    if busy and told is not None and not told.is_ok:
        yield CheckResult.warning(SOUND, f"the kiosk that is open here says: {told.message}", _LOUDSPEAKER)
        return
    if busy:
        words = f": {told.message}" if told else " once its panel is open"
        yield CheckResult.ok(SOUND, f"not tried while a kiosk is open here, which tells{words}")
        return
    try:
        probed = dict(_events(_run(command))).get("probed", {"why": "the sound's process died"})
    except subprocess.TimeoutExpired:
        probed = {"why": "the sound device hangs"}
    except OSError as error:
        probed = {"why": f"the sound's process cannot be started: {error.strerror}"}
    device, why = probed.get("device"), probed.get("why")
    if device:
        yield CheckResult.ok(SOUND, f"{device} plays")
    else:
        yield CheckResult.warning(SOUND, f"{_UNHEARD}: {why}", _LOUDSPEAKER)


WITHIN_S = 12.0
"""The process takes half a second to start; on a machine that does much else, many times that."""

SLOW_MS = 800
"""The kiosk waits this long for a sentence to begin before it takes the engine for hung."""

_SHOWN = "sentences are only shown"


def voice_check(command: Sequence[str], language: str, sentence: str) -> Iterator[CheckResult]:
    """Have the voice's process, started by this command, render a sentence of a language."""
    what = f"voice: {language}"
    try:
        told = _run(command, {"render": sentence}, {"quit": True})
    except subprocess.TimeoutExpired:
        remedy = "start the machine again, and see that espeak-ng speaks"
        yield CheckResult.warning(what, f"{_SHOWN}: the speech engine hangs", remedy)
        return
    except OSError as error:
        words = f"{_SHOWN}: the voice cannot be started: {error.strerror}"
        yield CheckResult.warning(what, words, "install Recollect anew")
        return
    yield _told(what, language, dict(_events(told)))


def say_check(command: Sequence[str], language: str, sentence: str) -> CheckResult:
    """Have the voice's process, started by this command, say a sentence on the sound device, to its end."""
    what = f"said: {language}"
    try:
        events = dict(_events(_run(command, {"say": 1, "text": sentence}, {"finish": True})))
    except subprocess.TimeoutExpired:
        events = {"failed": {"why": "it was not said to its end in time"}}
    except OSError as error:
        events = {"failed": {"why": f"the voice cannot be started: {error.strerror}"}}
    if "finished" in events:
        by, seconds = events["started"]["by"], events["started"]["duration_ms"] / MS_PER_SECOND
        words = f"{by['voice']} of {by['engine']} said a sentence of {seconds:.1f} s on {by['device']}"
        return CheckResult.ok(what, words)
    why = events.get("failed", events.get("unavailable", {})).get("why", "the voice's process died")
    return CheckResult.warning(what, f"nothing was heard: {why}", "see what is said of the sound and the voice")


def _run(command: Sequence[str], *lines: dict[str, object]) -> str:
    """Return what the process says to these commands; what it leaves when it has to be ended goes as well."""
    with tempfile.TemporaryDirectory(prefix="recollect-check-") as folder:
        done = subprocess.run(  # noqa: S603 - our own program
            command,
            input="".join(f"{json.dumps(line)}\n" for line in lines),
            capture_output=True,
            encoding="utf-8",
            timeout=WITHIN_S,
            env=os.environ | dict.fromkeys(("TMPDIR", "TEMP", "TMP"), folder),
            check=False,
        )
    return done.stdout


def _events(lines: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield what the process told, by name; what is none of its lines is left out."""
    for line in lines.splitlines():
        try:
            event = json.loads(line)
            yield str(event["event"]), event
        except (ValueError, KeyError, TypeError):
            continue


def _told(what: str, language: str, events: dict[str, dict[str, Any]]) -> CheckResult:
    if "unavailable" in events:
        why = events["unavailable"].get("why")
        return CheckResult.warning(what, f"{_SHOWN}: {why}", "install espeak-ng (Debian), then try again")
    if "ready" not in events:
        return CheckResult.warning(what, f"{_SHOWN}: the voice's process died", "install espeak-ng and Recollect anew")
    speaker = events["ready"].get("voice")
    if speaker is None:
        words = f"{_SHOWN}: no installed voice speaks {language!r}"
        plain, region, _ = language.partition("-")
        wider = f", or write {plain!r}, which takes any region" if region else ""
        remedy = f"install a voice for {language!r}{wider}, or take it out of the languages"
        return CheckResult.warning(what, words, remedy)
    if "rendered" not in events:
        why = events.get("failed", {}).get("why", "the voice's process died")
        return CheckResult.warning(what, f"{_SHOWN}: {why}", "install espeak-ng anew")
    took_ms = int(events["rendered"]["took_ms"])
    words = f"{events['ready'].get('spoken') or speaker} has a sentence ready in {took_ms} ms"
    if took_ms > SLOW_MS:
        return CheckResult.warning(what, words, "end other programs: the kiosk takes a slower voice for one that hangs")
    return CheckResult.ok(what, words)


ROBOT = "robot"

_CALLS = 4
_MARGIN_S = 2.0
_AVATAR = "until then the avatar helps"
_SEE = "'recollect robot' tries it step by step"


def within_s(settings: RobotSettings) -> float:
    """How long asking may take at most: as long as all its own deadlines."""
    return _CALLS * (settings.connect_deadline_ms + settings.answer_deadline_ms) / MS_PER_SECOND + _MARGIN_S


def robot_check(settings: RobotSettings, languages: Sequence[str], *, busy: bool) -> Iterator[CheckResult]:
    """Look for the robot of a study file, and for a voice for every language.

    While a kiosk is ``busy``, a robot that cannot be asked without being changed is left alone.
    """
    try:
        device = create_robot(settings, languages[0])
    except UserInputError as refusal:
        yield CheckResult.error(ROBOT, str(refusal), f"install it anew, or set robot.kind to {NO_ROBOT!r}")
        return
    if device is None:
        yield CheckResult.ok(ROBOT, "none in the study file: the avatar helps")
    elif isinstance(device, InspectableRobot):
        yield from _inspected(device, settings, languages)
    elif busy:
        yield CheckResult.ok(ROBOT, "not tried while a kiosk is open here; its panel tells how the robot is")
    else:
        yield _any(device)


def pack_check(settings: VoiceConfig, languages: Sequence[str]) -> Iterator[CheckResult]:
    """Look for the pack of each language that a robot is to play clips of."""
    from kiosk.robots.voice_packs import find_pack  # noqa: PLC0415 - it loads numpy, which opening the kiosk does not need

    for language in languages:
        what = f"{ROBOT}: clips: {language}"
        try:
            pack = find_pack(settings, language)
        except UserInputError as refusal:
            yield CheckResult.error(what, str(refusal), "correct voice.speakers in the study file")
            continue
        if pack is None:
            remedy = f"'recollect voice render --language {language}' makes it"
            yield CheckResult.warning(what, "there is no voice pack: the robot speaks with its own voice", remedy)
        else:
            yield CheckResult.ok(what, f"it plays {pack.described}")


def _inspected(robot: InspectableRobot, settings: RobotSettings, languages: Sequence[str]) -> Iterator[CheckResult]:
    """Yield a robot that tells what it has."""
    try:
        robot.resolve()
        robot.health_check()
        gestures = robot.gestures()
        voices = robot.voices()
    except RobotError as failure:
        yield _lost(failure)
        return
    yield CheckResult.ok(ROBOT, f"it answers, with {len(voices)} voices and {len(gestures)} gestures")
    for language in languages:
        what = f"{ROBOT}: {language}"
        try:
            voice = chosen_voice(voices, language, settings.voice)
        except RobotError as failure:
            remedy = f"install a voice for {language!r} in the robot's own pages; {_AVATAR}"
            yield CheckResult.warning(what, str(failure), remedy)
        else:
            wrong = mismatch(voice, language)
            if wrong:
                yield CheckResult.warning(what, wrong, "take robot.voice out of the study file, or name another voice")
            else:
                yield CheckResult.ok(what, f"{voice.name} ({voice.language})")


def _any(device: RobotDriver) -> CheckResult:
    """Return a robot that tells nothing of its voices."""
    try:
        device.connect()
    except RobotError as failure:
        return _lost(failure)
    finally:
        device.close()
    return CheckResult.ok(ROBOT, "it answers; it does not tell its voices")


def _lost(failure: RobotError) -> CheckResult:
    return CheckResult.warning(ROBOT, str(failure), f"switch it on and see to its address; {_AVATAR}; {_SEE}")
