"""What a Furhat's Remote API takes, strictly: a verb, a path and parameters that it does not list are refused.

From the maker's documentation, as far as it goes. Nothing here was tried with a real robot.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

GESTURES = {
    **dict.fromkeys(("Blink", "CloseEyes", "OpenEyes"), 0.4),
    **dict.fromkeys(("BrowFrown", "BrowRaise"), 1.0),
    **dict.fromkeys(("ExpressAnger", "ExpressDisgust", "ExpressFear", "ExpressSad", "GazeAway"), 3.0),
    **dict.fromkeys(("BigSmile", "Oh", "Surprise"), 0.96),
    **dict.fromkeys(("Nod", "Thoughtful"), 1.6),
    "Roll": 2.0,
    "Shake": 1.2,
    "Smile": 1.04,
    "Wink": 0.67,
}
VOICES = {"Matthew": "en-US", "Amy": "en-GB", "Lucia": "es-ES", "Bianca": "it-IT", "Astrid": "sv-SE"}

LONGEST = 1000
MOST_DEGREES = 50
"""How far neck and eyes turn to each side."""
METRES = 3
"""A place has three coordinates."""


class Refused(Exception):
    """The request is not one that a Furhat takes."""

    def __init__(self, code: int, message: str) -> None:
        """Keep the code of the answer, and its message."""
        super().__init__(message)
        self.code = code


@dataclass(frozen=True)
class Request:
    """A request as it came; ``at`` in seconds of the monotonic clock."""

    at: float
    verb: str
    path: str
    parameters: Mapping[str, str]
    body: Any = None


def _need(holds: object, message: str) -> None:
    if not holds:
        raise Refused(400, message)


def _flag(request: Request, *names: str) -> None:
    for name in names:
        _need(request.parameters.get(name, "true") in {"true", "false"}, f"{name} is no truth value")


def _whole(request: Request, *names: str, most: int) -> None:
    for name in names:
        given = request.parameters.get(name, "0")
        _need(given.isdecimal() and int(given) <= most, f"{name} is out of range")


def _say(request: Request) -> None:
    given = request.parameters
    _need(("text" in given) != ("url" in given), "either text or url")
    _flag(request, "blocking", "lipsync", "abort")
    _need("lipsync" not in given or "url" in given, "lipsync goes with url alone")
    text = given.get("text", "x")
    _need(text.strip() and len(text) < LONGEST and not set("<&") & set(text), "the text cannot be said")


def _gesture(request: Request) -> None:
    _flag(request, "blocking")
    _need(("name" in request.parameters) != (request.body is not None), "either a name or a body")
    if request.body is None:
        _need(request.parameters["name"] in GESTURES, "there is no such gesture")
    else:
        _definition(request.body)


def _definition(body: Any) -> None:
    _need(isinstance(body, dict) and set(body) == {"name", "frames", "class"}, "no gesture definition")
    _need(body["class"] == "furhatos.gestures.Gesture" and isinstance(body["name"], str), "no gesture definition")
    _need(isinstance(body["frames"], list) and body["frames"], "no frames")
    for frame in body["frames"]:
        _need(set(frame) <= {"time", "persist", "params"} and frame["time"] == sorted(frame["time"]), "no frame")
        for name, value in frame["params"].items():
            wide = name.startswith(("NECK_", "GAZE_"))
            _need(
                name == "reset" or (abs(value) <= MOST_DEGREES if wide else 0 <= value <= 1), f"{name} is out of range"
            )


def _attend(request: Request) -> None:
    given = request.parameters
    _need(len(given) == 1, "one of user, userid, location")
    _need(given.get("user", "CLOSEST") in {"CLOSEST", "OTHER", "RANDOM"}, "no such user")
    if "location" in given:
        metres = given["location"].split(",")
        _need(len(metres) == METRES and all(math.isfinite(float(value)) for value in metres), "no location")


def _voice(request: Request) -> None:
    _need(request.parameters.get("name") in VOICES, "there is no such voice")


def _visibility(request: Request) -> None:
    _need("visible" in request.parameters, "visible is missing")
    _flag(request, "visible")


@dataclass(frozen=True)
class _Rule:
    verb: str
    parameters: frozenset[str]
    check: Callable[[Request], None] = lambda _: None


RULES: Mapping[str, _Rule] = {
    "/furhat": _Rule("GET", frozenset()),
    "/furhat/gestures": _Rule("GET", frozenset()),
    "/furhat/voices": _Rule("GET", frozenset()),
    "/furhat/users": _Rule("GET", frozenset()),
    "/furhat/say": _Rule("POST", frozenset({"text", "url", "blocking", "lipsync", "abort"}), _say),
    "/furhat/say/stop": _Rule("POST", frozenset()),
    "/furhat/gesture": _Rule("POST", frozenset({"name", "blocking"}), _gesture),
    "/furhat/attend": _Rule("POST", frozenset({"user", "userid", "location"}), _attend),
    "/furhat/voice": _Rule("POST", frozenset({"name"}), _voice),
    "/furhat/led": _Rule(
        "POST", frozenset({"red", "green", "blue"}), lambda given: _whole(given, "red", "green", "blue", most=255)
    ),
    "/furhat/face": _Rule("POST", frozenset({"mask", "character"})),
    "/furhat/visibility": _Rule("POST", frozenset({"visible", "duration"}), _visibility),
}


def check(request: Request) -> None:
    """Raise Refused unless this is exactly what the API takes."""
    rule = RULES.get(request.path)
    if rule is None:
        raise Refused(404, "there is no such path")
    if rule.verb != request.verb:
        raise Refused(405, "this path does not take this verb")
    for name in request.parameters:
        _need(name in rule.parameters, f"there is no parameter {name}")
    _need(request.body is None or request.path == "/furhat/gesture", "this path takes no body")
    try:
        rule.check(request)
    except (TypeError, ValueError, KeyError) as error:
        raise Refused(400, f"cannot be read: {error}") from error
