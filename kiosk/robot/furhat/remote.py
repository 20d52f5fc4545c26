"""Furhat over its Remote API (HTTP), strictly read: what is not understood has failed.

Each call is a connection of its own, so nothing is left half open; a call that speaks lasts as long as the speech.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, ClassVar

from kiosk.language_codes import distance
from kiosk.robot.body import Place
from kiosk.robot.device import Fault, Found, RobotFailed, RobotVoice, Saying
from kiosk.robot.furhat.gestures import CONFUSED, gesture
from kiosk.robot.furhat.space import location
from kiosk.robot.furhat.wire import Call, Http
from kiosk.settings import Robot as RobotSettings
from kiosk.study.commands import Mood
from kiosk.study.events import BodyName
from kiosk.units import MS_PER_SECOND

PORT = 54321
OK = 200
GREETING = b"hello"
"""A part of what its server says when it is up: "hello world"."""


class Furhat:
    """A Furhat, or the virtual one of its maker's kit, that serves the Remote API."""

    name: ClassVar[BodyName] = BodyName.FURHAT

    def __init__(self, settings: RobotSettings, language: str) -> None:
        """Nothing is sent yet; ``language`` is what it is to speak, as a code such as 'en' or 'pt-BR'."""
        self._settings = settings
        self._language = language
        self._http = Http(settings.host, settings.port or PORT, settings.connect_deadline)
        self._gestures: tuple[str, ...] = ()
        self._voices: tuple[RobotVoice, ...] = ()

    def connect(self) -> Found:
        """Look for it, see what it offers, and give it a voice of the language; raises RobotFailed."""
        self.resolve()
        self.probe()
        self._gestures = self.gestures()
        self._voices = self.voices()
        voice = chosen_voice(self._voices, self._language, self._settings.voice)
        self.speak_with(voice)
        return Found(self._voices, self._gestures, voice)

    def speak(self, language: str) -> None:
        """Give it a voice of another language; raises RobotFailed if it has none, and keeps to the one before."""
        if language == self._language:
            return
        if self._voices:
            self.speak_with(chosen_voice(self._voices, language, self._settings.voice))
        # Only now: a robot that lacks one visitor's language must still be found for the next one's.
        self._language = language

    def resolve(self) -> None:
        """Look its name up, for all calls that follow; raises RobotFailed."""
        self._http.resolve()

    def probe(self) -> None:
        """See whether its server is up; raises RobotFailed."""
        code, content = self._request("GET", "/furhat")
        if code != OK:
            raise RobotFailed(Fault.ERROR, "GET /furhat", f"code {code}")
        if GREETING not in content.lower():
            raise RobotFailed(Fault.GARBAGE, "GET /furhat", _shown(content))

    def gestures(self) -> tuple[str, ...]:
        """The names of the gestures that it offers; raises RobotFailed."""
        return tuple(str(entry["name"]) for entry in self._list("/furhat/gestures"))

    def voices(self) -> tuple[RobotVoice, ...]:
        """The voices that it offers; raises RobotFailed."""
        return tuple(
            RobotVoice(str(entry["name"]), str(entry.get("language") or "")) for entry in self._list("/furhat/voices")
        )

    def users(self) -> int:
        """How many people it sees; raises RobotFailed."""
        return len(self._list("/furhat/users", named=False))

    def speak_with(self, voice: RobotVoice) -> None:
        """Give it a voice; it forgets that when it starts again. Raises RobotFailed."""
        self._ask("/furhat/voice", {"name": voice.name})

    def say(self, saying: Saying) -> None:
        """Say a sentence to its end, in place of any other; raises RobotFailed."""
        call = Call(self._settings.speech_time(saying.text) / MS_PER_SECOND, saying.started)
        saying.on_cut(call.cut)
        parameters = {"text": saying.text, "blocking": "true", "abort": "true"}
        _check("POST /furhat/say", *self._http.request(call, "POST", "/furhat/say", parameters))

    def hush(self) -> None:
        """Ask it to be silent; it may say yes and speak on. Raises RobotFailed."""
        self._ask("/furhat/say/stop", {})

    def express(self, mood: Mood) -> None:
        """Make the gesture for a mood, if there is one; raises RobotFailed."""
        if not self._settings.gestures or mood is Mood.IDLE:
            return
        if mood is Mood.CONFUSED:
            self._ask("/furhat/gesture", {"blocking": "false"}, CONFUSED)
            return
        name = gesture(mood, self._gestures)
        if name is not None:
            self._ask("/furhat/gesture", {"name": name, "blocking": "false"})

    def attend(self, place: Place | None) -> None:
        """Look at a place on the board, or at whoever is closest; raises RobotFailed.

        It may well say that there is nobody to look at: that is no failure.
        """
        if not self._settings.attend:
            return
        try:
            self._ask("/furhat/attend", {"user": "CLOSEST"} if place is None else {"location": self._location(place)})
        except RobotFailed as failure:
            if failure.fault is not Fault.DECLINED:
                raise

    def close(self) -> None:
        """Nothing is kept open between calls."""

    def _location(self, place: Place) -> str:
        return ",".join(f"{metres:.2f}" for metres in location(place, self._settings))

    def _request(
        self,
        verb: str,
        path: str,
        parameters: Mapping[str, str] | None = None,
        body: Mapping[str, Any] | None = None,
    ) -> tuple[int, bytes]:
        call = Call(self._settings.answer_deadline / MS_PER_SECOND)
        return self._http.request(call, verb, path, parameters, body)

    def _ask(self, path: str, parameters: Mapping[str, str], body: Mapping[str, Any] | None = None) -> None:
        """Have something done, and see that it says so."""
        _check(f"POST {path}", *self._request("POST", path, parameters, body))

    def _list(self, path: str, *, named: bool = True) -> list[dict[str, Any]]:
        """What it lists; entries without a name are left out, for nobody could ask for them."""
        code, content = self._request("GET", path)
        listed = _json(content)
        if code != OK:
            raise RobotFailed(Fault.ERROR, f"GET {path}", f"code {code}")
        if not isinstance(listed, list):
            raise RobotFailed(Fault.GARBAGE, f"GET {path}", _shown(content))
        entries = [entry for entry in listed if isinstance(entry, dict)]
        return [entry for entry in entries if not named or isinstance(entry.get("name"), str)]


def chosen_voice(voices: tuple[RobotVoice, ...], language: str, wished: str = "") -> RobotVoice:
    """The wished voice, or the first of those that are nearest to the language; raises RobotFailed without one."""
    if wished:
        matching = [(0, voice) for voice in voices if voice.name == wished]
    else:
        far = ((distance(language, voice.language), voice) for voice in voices)
        matching = [(each, voice) for each, voice in far if each is not None]
    if matching:
        return min(matching, key=lambda each: each[0])[1]
    offered = ", ".join(sorted({voice.language for voice in voices})) or "none"
    raise RobotFailed(Fault.NO_VOICE, wished or language, f"it has {offered}")


def _check(doing: str, code: int, content: bytes) -> None:
    """See that a Status says yes: ``success`` is true, and nothing else counts as true."""
    status = _json(content)
    success, message = (status.get("success"), status.get("message")) if isinstance(status, dict) else (None, None)
    if code == OK and success is True:
        return
    if success is False:
        raise RobotFailed(Fault.DECLINED, doing, str(message or f"code {code}"))
    if code != OK:
        raise RobotFailed(Fault.ERROR, doing, f"code {code}")
    raise RobotFailed(Fault.GARBAGE, doing, _shown(content))


def _json(content: bytes) -> object:
    """What a body says; None if it is not JSON."""
    try:
        return json.loads(content)
    except (ValueError, RecursionError):
        return None


def _shown(content: bytes) -> str:
    return content[:80].decode(errors="replace")
