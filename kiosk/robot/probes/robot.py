"""Whether the robot is there and speaks what the study speaks; it is asked, and neither moves nor says anything."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from kiosk import BadInput
from kiosk.findings import Finding
from kiosk.robot.device import Robot, RobotFailed
from kiosk.robot.kinds import robot_of
from kiosk.settings import Robot as RobotSettings
from kiosk.units import MS_PER_SECOND

WHAT = "robot"

_CALLS = 4
_MARGIN_S = 2.0
_AVATAR = "until then the avatar helps"
_SEE = "'recollect robot' tries it step by step"


def within_s(settings: RobotSettings) -> float:
    """How long asking may take at most: as long as all its own deadlines."""
    return _CALLS * (settings.connect_deadline + settings.answer_deadline) / MS_PER_SECOND + _MARGIN_S


def robot(settings: RobotSettings, languages: Sequence[str], *, busy: bool) -> Iterator[Finding]:
    """Look for the robot of a study file, and for a voice for every language.

    While a kiosk is ``busy``, a robot that cannot be asked without being changed is left alone.
    """
    try:
        device = robot_of(settings, languages[0])
    except BadInput as refusal:
        yield Finding.bad(WHAT, str(refusal), "install it, or set robot.kind to 'none'")
        return
    if device is None:
        yield Finding.good(WHAT, "none in the study file: the avatar helps")
    elif settings.kind == "furhat":
        yield from _furhat(settings, languages)
    elif busy:
        yield Finding.good(WHAT, "not tried while a kiosk is open here; its panel tells how the robot is")
    else:
        yield _any(device)


def _furhat(settings: RobotSettings, languages: Sequence[str]) -> Iterator[Finding]:
    from kiosk.robot.furhat.remote import Furhat, chosen_voice  # noqa: PLC0415 - only where there is one

    furhat = Furhat(settings, languages[0])
    try:
        furhat.resolve()
        furhat.probe()
        gestures = furhat.gestures()
        voices = furhat.voices()
    except RobotFailed as failure:
        yield _lost(failure)
        return
    yield Finding.good(WHAT, f"it answers, with {len(voices)} voices and {len(gestures)} gestures")
    for language in languages:
        what = f"{WHAT}: {language}"
        try:
            voice = chosen_voice(voices, language, settings.voice)
        except RobotFailed as failure:
            remedy = f"install a voice for {language!r} in the robot's own pages; {_AVATAR}"
            yield Finding.warning(what, str(failure), remedy)
        else:
            yield Finding.good(what, f"{voice.name} ({voice.language})")


def _any(device: Robot) -> Finding:
    """A robot that tells nothing of its voices."""
    try:
        device.connect()
    except RobotFailed as failure:
        return _lost(failure)
    finally:
        device.close()
    return Finding.good(WHAT, "it answers; it does not tell its voices")


def _lost(failure: RobotFailed) -> Finding:
    return Finding.warning(WHAT, str(failure), f"switch it on and see to its address; {_AVATAR}; {_SEE}")
