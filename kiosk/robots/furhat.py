"""The Furhat over its Remote API: requests, gestures, voices and coordinates."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from threading import Timer
from types import MappingProxyType
from typing import Any, ClassVar

from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.effects import Mood
from kiosk.files import parse_json
from kiosk.robots.clip_server import ClipServer
from kiosk.robots.driver import (
    Capabilities,
    Capability,
    FailureKind,
    InspectableRobot,
    RobotError,
    RobotVoice,
    SpokenClip,
    Utterance,
    chosen_voice,
    mismatch,
)
from kiosk.robots.embodiment import BoardPoint
from kiosk.robots.http_client import Call, HttpClient
from kiosk.units import MS_PER_SECOND

WISHES: Mapping[Mood, tuple[str, ...]] = MappingProxyType(
    {
        Mood.IDLE: (),
        Mood.HAPPY: ("BigSmile", "Smile"),
        Mood.CONFUSED: ("BrowFrown", "Thoughtful"),
        Mood.SAD: ("ExpressSad",),
        Mood.THINKING: ("Thoughtful", "GazeAway"),
        Mood.LISTENING: ("Nod", "BrowRaise"),
    }
)
"""Built-in gestures for a mood, the best first; they end by themselves, so that idle needs none."""

CONFUSED: Mapping[str, Any] = MappingProxyType(
    {
        "name": "RecollectConfused",
        "frames": [
            {
                "time": [0.4, 1.6],
                "persist": False,
                "params": {
                    "BROW_UP_LEFT": 0.8,
                    "BROW_DOWN_RIGHT": 0.7,
                    "EYE_SQUINT_RIGHT": 0.4,
                    "MOUTH_RIGHT": 0.4,
                    "NECK_ROLL": 10,
                },
            },
            {"time": [2.2], "params": {"reset": True}},
        ],
        "class": "furhatos.gestures.Gesture",
    }
)
"""Nothing built in looks confused: one brow up, one down, the head to one side. Our own."""


def gesture(mood: Mood, offered: Collection[str]) -> str | None:
    """Return the best gesture for a mood among those that the robot offers, if there is any."""
    return next((wish for wish in WISHES[mood] if wish in offered), None)


MIDDLE = 0.5


def to_robot_location(place: BoardPoint, settings: RobotSettings) -> tuple[float, float, float]:
    """Return a place on the board as x, y, z in metres, by the axes that the study file names."""
    sideways, up, forward = settings.board_middle
    width, height = settings.board_size
    seen = (sideways + (place.across - MIDDLE) * width, up + (MIDDLE - place.down) * height, forward)
    by_axis = {
        axis[-1]: -metres if axis[0] == "-" else metres
        for axis, metres in zip(settings.axes.split(), seen, strict=True)
    }
    return by_axis.get("x", 0.0), by_axis.get("y", 0.0), by_axis.get("z", 0.0)


_CLIP_GRACE_MS = 3_500
"""How much longer than its clip a sentence may take: fetching it, and the answer."""


def _cancel_unless_fetched(served: ClipServer, call: Call) -> None:
    if not served.is_fetched:
        call.cancel()


OK = 200
GREETING = b"hello"
"""A part of what its server says when it is up: "hello world"."""


class Furhat(InspectableRobot):
    """A Furhat, or the virtual one of its maker's kit, that serves the Remote API."""

    name: ClassVar[str] = "furhat"
    default_port: ClassVar[int] = 54321
    capabilities: ClassVar[frozenset[Capability]] = frozenset(Capability)

    def __init__(self, settings: RobotSettings, language: str) -> None:
        """Nothing is sent yet; ``language`` is what it is to speak, as a code such as 'en' or 'pt-BR'."""
        super().__init__(settings, language)
        self._settings = settings
        self._language = language
        self._http = HttpClient(settings.host, settings.port or self.default_port, settings.connect_deadline_ms)
        self._fetches = True
        self._gestures: tuple[str, ...] = ()
        self._voices: tuple[RobotVoice, ...] = ()

    def connect(self) -> Capabilities:
        """Look for it, see what it offers, and give it a voice of the language; raises RobotError."""
        self.resolve()
        self.health_check()
        self._fetches = True
        self._gestures = self.gestures()
        self._voices = self.voices()
        voice = chosen_voice(self._voices, self._language, self._settings.voice)
        self._speak(voice, self._language)
        return Capabilities(self._voices, self._gestures, voice)

    def set_language(self, language: str) -> None:
        """Give it a voice of another language; raises RobotError if it has none, and keeps to the one before."""
        if language == self._language:
            return
        if self._voices:
            self._speak(chosen_voice(self._voices, language, self._settings.voice), language)
        # Only now: a robot that lacks one visitor's language must still be found for the next one's.
        self._language = language

    def resolve(self) -> None:
        """Look its name up, for all calls that follow; raises RobotError."""
        self._http.resolve()

    def health_check(self) -> None:
        """See whether its server is up; raises RobotError."""
        code, content = self._request("GET", "/furhat")
        if code != OK:
            raise RobotError(FailureKind.ERROR, "GET /furhat", f"code {code}")
        if GREETING not in content.lower():
            raise RobotError(FailureKind.GARBAGE, "GET /furhat", _shown(content))

    def gestures(self) -> tuple[str, ...]:
        """Return the names of the gestures that it offers; raises RobotError."""
        return tuple(str(entry["name"]) for entry in self._list("/furhat/gestures"))

    def voices(self) -> tuple[RobotVoice, ...]:
        """Return the voices that it offers; raises RobotError."""
        return tuple(
            RobotVoice(str(entry["name"]), str(entry.get("language") or "")) for entry in self._list("/furhat/voices")
        )

    def users(self) -> int:
        """How many people it sees; raises RobotError."""
        return len(self._list("/furhat/users", named=False))

    def speak_with(self, voice: RobotVoice) -> None:
        """Give it a voice; it forgets that when it starts again. Raises RobotError."""
        self._ask("/furhat/voice", {"name": voice.name})

    def _speak(self, voice: RobotVoice, language: str) -> None:
        self.speak_with(voice)
        why = mismatch(voice, language)
        if why:
            self.on_other_voice(why)

    def say(self, saying: Utterance) -> None:
        """Say a sentence to its end, in place of any other; raises RobotError.

        With a source of clips the robot plays one. If it cannot fetch that, it says the text with its own voice, and so
        all that follow until it is connected anew.
        """
        self.spoken_by = {}
        clip = self.clips(self._language, saying.sentence) if self.clips and self._fetches else None
        if clip is not None:
            why = self._not_played(saying, clip)
            if not why:
                return
            self._fetches = False
            self.spoken_by = {}
            self.on_own_voice(why)
        call = Call(self._settings.speech_time(saying.text) / MS_PER_SECOND, saying.started)
        saying.on_cancel(call.cancel)
        parameters = {"text": saying.text, "blocking": "true", "abort": "true"}
        _check("POST /furhat/say", *self._http.request(call, "POST", "/furhat/say", parameters))

    def _not_played(self, saying: Utterance, clip: SpokenClip) -> str:
        """Have the robot fetch a clip and play it; returns why it did not, and nothing if it did.

        Raises RobotError for a robot that breaks off or is gone.
        """
        settings = self._settings
        call = Call(max(settings.speech_time(saying.text), clip.duration_ms + _CLIP_GRACE_MS) / MS_PER_SECOND)
        saying.on_cancel(call.cancel)
        self.spoken_by = {**clip.spoken_by, "device": self.name}
        try:
            with ClipServer(clip.wav, self._http.address, settings.pack_port or 0, saying.started) as served:
                parameters = {"url": served.url, "lipsync": "true", "blocking": "true", "abort": "true"}
                within = Timer(settings.answer_deadline_ms / MS_PER_SECOND, _cancel_unless_fetched, (served, call))
                within.start()
                try:
                    _check("POST /furhat/say", *self._http.request(call, "POST", "/furhat/say", parameters))
                except RobotError as failure:
                    is_refused = failure.kind not in {FailureKind.UNREACHABLE, FailureKind.DROPPED}
                    if served.is_fetched or saying.is_cancelled or not is_refused:
                        raise
                    return f"it did not fetch the clip ({failure})"
                finally:
                    within.cancel()
                return "" if served.is_fetched else "it did not fetch the clip, though it said that it played it"
        except OSError as error:
            return f"the clip cannot be served: {error.strerror or error}"

    def stop_speech(self) -> None:
        """Ask it to be silent; it may say yes and speak on. Raises RobotError."""
        self._ask("/furhat/say/stop", {})

    def express(self, mood: Mood) -> None:
        """Make the gesture for a mood, if there is one; raises RobotError."""
        if not self._settings.gestures or mood is Mood.IDLE:
            return
        if mood is Mood.CONFUSED:
            self._ask("/furhat/gesture", {"blocking": "false"}, CONFUSED)
            return
        name = gesture(mood, self._gestures)
        if name is not None:
            self._ask("/furhat/gesture", {"name": name, "blocking": "false"})

    def look_at(self, place: BoardPoint | None) -> None:
        """Look at a place on the board, or at the closest person; raises RobotError.

        It may answer that no person is there to look at: that is no failure.
        """
        if not self._settings.gaze:
            return
        try:
            self._ask("/furhat/attend", {"user": "CLOSEST"} if place is None else {"location": self._location(place)})
        except RobotError as failure:
            if failure.kind is not FailureKind.DECLINED:
                raise

    def close(self) -> None:
        """Nothing is kept open between calls."""

    def _location(self, place: BoardPoint) -> str:
        return ",".join(f"{metres:.2f}" for metres in to_robot_location(place, self._settings))

    def _request(
        self,
        verb: str,
        path: str,
        parameters: Mapping[str, str] | None = None,
        body: Mapping[str, Any] | None = None,
    ) -> tuple[int, bytes]:
        call = Call(self._settings.answer_deadline_ms / MS_PER_SECOND)
        return self._http.request(call, verb, path, parameters, body)

    def _ask(self, path: str, parameters: Mapping[str, str], body: Mapping[str, Any] | None = None) -> None:
        """Have something done, and see that it says so."""
        _check(f"POST {path}", *self._request("POST", path, parameters, body))

    def _list(self, path: str, *, named: bool = True) -> list[dict[str, Any]]:
        """Return what it lists; entries without a name are left out, as they cannot be asked for."""
        code, content = self._request("GET", path)
        listed = _json(content)
        if code != OK:
            raise RobotError(FailureKind.ERROR, f"GET {path}", f"code {code}")
        if not isinstance(listed, list):
            raise RobotError(FailureKind.GARBAGE, f"GET {path}", _shown(content))
        entries = [entry for entry in listed if isinstance(entry, dict)]
        return [entry for entry in entries if not named or isinstance(entry.get("name"), str)]


def _check(doing: str, code: int, content: bytes) -> None:
    """See that a Status says yes: ``success`` is true, and nothing else counts as true."""
    status = _json(content)
    success, message = (status.get("success"), status.get("message")) if isinstance(status, dict) else (None, None)
    if code == OK and success is True:
        return
    if success is False:
        raise RobotError(FailureKind.DECLINED, doing, str(message or f"code {code}"))
    if code != OK:
        raise RobotError(FailureKind.ERROR, doing, f"code {code}")
    raise RobotError(FailureKind.GARBAGE, doing, _shown(content))


def _json(content: bytes) -> object:
    """Return what a body says; None if it is not JSON."""
    try:
        return parse_json(content)
    except ValueError:
        return None


def _shown(content: bytes) -> str:
    return content[:80].decode(errors="replace")
