"""Embodiments: who speaks and looks at the player, and which one takes over when a robot fails."""

from __future__ import annotations

import logging
import threading
from abc import ABC, abstractmethod
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from functools import partial
from threading import Lock
from types import MappingProxyType
from typing import ClassVar, Protocol

from kiosk.config import ConfigModel
from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.effects import Mood
from kiosk.experiment.events import EmbodimentName, FallbackReason
from kiosk.experiment.items import can_be_kept
from kiosk.language_codes import distance


@dataclass(frozen=True)
class BoardPoint:
    """A place on the board as the visitor sees it: from 0 (left, top) to 1 (right, bottom)."""

    across: float
    down: float


ASIDE = BoardPoint(4.0, 0.5)
"""Beside the screen and beside the visitor: where a body looks that is being rated."""


@dataclass(frozen=True)
class Health:
    """Whether a body can speak, and how it is, in words for the experimenter."""

    is_ok: bool
    message: str


class SpeechListener(Protocol):
    """Hears what becomes of an utterance, started, then finished or failed; and of the body itself."""

    def speech_started(self, utterance: int) -> None:
        """Report that the first sound is out."""
        ...

    def speech_finished(self, utterance: int) -> None:
        """Report that the last sound is out."""
        ...

    def speech_failed(self, utterance: int, why: str) -> None:
        """No further sound will come; ``why`` is for the experimenter."""
        ...

    def robot_lost(self, why: str) -> None:
        """Report that the robot that was to speak cannot be counted on any more."""
        ...


class Embodiment(Protocol):
    """Something that helps with voice and face. Every method returns at once."""

    @property
    def name(self) -> EmbodimentName:
        """What the records call it."""
        ...

    @property
    def health(self) -> Health:
        """How it is."""
        ...

    def set_language(self, language: str) -> None:
        """Speak this language, a code of two letters, from the next sentence on."""
        ...

    def say(self, utterance: int, sentence: str) -> None:
        """Begin to say a sentence, in place of any other; the listener hears the rest."""
        ...

    def stop(self) -> None:
        """Be silent; nothing more is reported of the sentence."""
        ...

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        ...

    def look_at(self, place: BoardPoint | None) -> None:
        """Look at a place on the board, or, with None, at the visitor."""
        ...

    def activate(self) -> None:
        """Be the one who helps, from now on."""
        ...

    def deactivate(self) -> None:
        """Leave it to another body."""
        ...

    def reset(self) -> None:
        """Come to rest after a session: keep nothing of the last visitor."""
        ...


WHY = "voice and sounds are silent"


class MutableSpeech:
    """Stands before the body that helps, and lets no sentence through while it is shut."""

    def __init__(self, body: Embodiment, listener: SpeechListener) -> None:
        """Report every sentence that will not be heard to ``listener``."""
        self.embodiment = body
        self._listener = listener
        self._shut = False
        self._saying: int | None = None

    @property
    def muted(self) -> bool:
        """Whether no sentence is heard."""
        return self._shut

    def mute(self) -> None:
        """Let nothing be heard from now on; a sentence that is being said breaks off."""
        self._shut = True
        broken_off, self._saying = self._saying, None
        if broken_off is not None:
            self.embodiment.stop()
            self._listener.speech_failed(broken_off, WHY)

    def unmute(self) -> None:
        """Let sentences be heard again, from the next one on."""
        self._shut = False

    def said(self, utterance: int) -> None:
        """Forget a sentence that is not being said any more."""
        if self._saying == utterance:
            self._saying = None

    @property
    def name(self) -> EmbodimentName:
        """What the records call the body."""
        return self.embodiment.name

    @property
    def health(self) -> Health:
        """How the body is."""
        return self.embodiment.health

    def set_language(self, language: str) -> None:
        """Speak this language."""
        self.embodiment.set_language(language)

    def say(self, utterance: int, sentence: str) -> None:
        """Begin to say a sentence, or report at once that it will not be heard."""
        if self._shut:
            self._listener.speech_failed(utterance, WHY)
            return
        self._saying = utterance
        self.embodiment.say(utterance, sentence)

    def stop(self) -> None:
        """Be silent."""
        self._saying = None
        self.embodiment.stop()

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        self.embodiment.express(mood)

    def look_at(self, place: BoardPoint | None) -> None:
        """Look at a place on the board, or at the visitor."""
        self.embodiment.look_at(place)

    def activate(self) -> None:
        """Be the one who helps."""
        self.embodiment.activate()

    def deactivate(self) -> None:
        """Leave it to another body."""
        self._saying = None
        self.embodiment.deactivate()

    def reset(self) -> None:
        """Keep nothing of the last visitor."""
        self._saying = None
        self.embodiment.reset()


LONGEST_TEXT = 999
"""Characters that a robot takes in one request unless its driver says otherwise."""


_DIRECTIONS = frozenset("\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
"""Characters that say from which side a text is written: they are for the eye alone. Joiners change words, and stay."""


class FailureKind(Enum):
    """How a robot can fail, in words that go after its name."""

    UNREACHABLE = "cannot be reached"
    SLOW = "did not answer in time"
    DROPPED = "broke off the connection"
    ERROR = "answered with an error"
    DECLINED = "said that it did not do it"
    GARBAGE = "gave an answer that cannot be understood"
    NO_VOICE = "has no voice of the language"
    CUT = "was told to stop"


class RobotError(Exception):
    """The robot did not do what it was asked to; the message is for the experimenter."""

    def __init__(self, fault: FailureKind, doing: str, detail: str = "") -> None:
        """``doing`` is what was asked; ``detail`` is what the robot said to it."""
        super().__init__(f"the robot {fault.value} ({doing}{': ' if detail else ''}{detail[:200]})")
        self.kind = fault


@dataclass(frozen=True)
class RobotVoice:
    """A voice that a robot offers; ``language`` is a code such as en-US, or empty."""

    name: str
    language: str


@dataclass(frozen=True)
class Capabilities:
    """What a robot turned out to have."""

    voices: tuple[RobotVoice, ...]
    gestures: tuple[str, ...]
    voice: RobotVoice | None
    """The voice that it was given."""


class Utterance:
    """A sentence under way, which any thread may cut off."""

    def __init__(self, sentence: str, started: Callable[[], None], longest: int = LONGEST_TEXT) -> None:
        """Call ``started`` once, on any thread, when the robot begins or is asked to.

        No more than ``longest`` characters are said.
        """
        self.sentence = sentence
        self.text = speakable(sentence, longest)
        self.started = started
        self._lock = Lock()
        self._cut = False
        self._end: Callable[[], None] | None = None

    @property
    def is_cancelled(self) -> bool:
        """Whether its end is not waited for any more."""
        return self._cut

    def cancel(self) -> None:
        """Wait for it no longer; the call that waits raises RobotFailed."""
        with self._lock:
            self._cut = True
            if self._end is not None:
                self._end()

    def on_cancel(self, end: Callable[[], None]) -> None:
        """Have ``end`` called when it is cut, at once if it was cut before; ``end`` may not wait."""
        with self._lock:
            self._end = end
            if self._cut:
                end()


class Capability(Enum):
    """What a driver can have its robot do besides speaking; it is asked for nothing else."""

    GESTURES = "gestures"
    GAZE = "gaze"
    CLIPS = "clips"
    """It plays a sound that it fetches."""


@dataclass(frozen=True)
class SpokenClip:
    """The sound of a sentence as a WAV file, and what spoke it: engine, engine_version, voice and pack."""

    wav: bytes
    duration_ms: int
    spoken_by: Mapping[str, str]


ClipSource = Callable[[str, str], SpokenClip | None]
"""Returns the clip that says a text in a language; None if there is none."""


class RobotDriver(ABC):
    """A robot that can be reached, or not; the base class of every driver.

    Its methods run on threads of their own and may block, up to the deadlines of the settings. They raise RobotError
    for whatever the robot did not do.
    """

    name: ClassVar[str]
    """What study files and records call it: the name that it is registered by."""
    default_port: ClassVar[int | None] = None
    """The port where the study file names none."""
    options: ClassVar[type[ConfigModel]] = ConfigModel
    """The model of its own table in the study file, ``[robot.options]``."""
    capabilities: ClassVar[frozenset[Capability]] = frozenset()
    longest_text: ClassVar[int] = LONGEST_TEXT
    """Characters that it takes in one request; a longer sentence ends at the last word within."""
    clips: ClipSource | None = None
    """Where the clips come from that a driver with CLIPS has the robot play; None: it speaks with its own voice."""
    spoken_by: Mapping[str, str] = MappingProxyType({})
    """What speaks the sentence under way, if it is a clip."""
    on_own_voice: Callable[[str], None] = staticmethod(lambda _: None)
    """Called, on any thread, with the reason why the robot speaks with its own voice where it was to play a clip."""

    on_other_voice: Callable[[str], None] = staticmethod(lambda _: None)
    """Called, on any thread, with what is wrong with the voice that the robot has."""

    def __init__(self, settings: RobotSettings, language: str) -> None:
        """Nothing is sent yet; ``language`` is what it is to speak, as a code such as 'en' or 'pt-BR'."""
        self.settings = settings
        self.language = language

    @property
    def port(self) -> int | None:
        """The port that the study file names, or the driver's own."""
        return self.settings.port or self.default_port

    @abstractmethod
    def connect(self) -> Capabilities:
        """Look for it and get it ready to speak the study's language; needed again after every failure."""

    @abstractmethod
    def say(self, saying: Utterance) -> None:
        """Say a sentence to its end, in place of any other. Never tried twice."""

    def set_language(self, language: str) -> None:
        """Speak this language from now on; where nothing is connected, once it is."""
        self.language = language

    def stop_speech(self) -> None:  # noqa: B027 - a robot may have no way to be stopped
        """Ask it to be silent; whether it obeys is its own affair."""

    def express(self, mood: Mood) -> None:  # noqa: B027 - never asked without the capability
        """Show a mood, as far as it can; asked only of a driver with GESTURES."""

    def look_at(self, place: BoardPoint | None) -> None:  # noqa: B027 - never asked without the capability
        """Look at a place on the board, or at the visitor; asked only of a driver with GAZE."""

    def health_check(self) -> None:  # noqa: B027 - a robot may have no way to be asked
        """See whether it still answers."""

    def close(self) -> None:  # noqa: B027 - nothing may be open
        """Let go of whatever is open; may be called from any thread and twice."""


class InspectableRobot(RobotDriver):
    """A robot that tells what it has without being changed; so it may be asked while it helps."""

    @abstractmethod
    def resolve(self) -> None:
        """Look its name up; raises RobotError."""

    @abstractmethod
    def voices(self) -> tuple[RobotVoice, ...]:
        """Return the voices that it offers; raises RobotError."""

    @abstractmethod
    def gestures(self) -> tuple[str, ...]:
        """Return the names of the gestures that it offers; raises RobotError."""

    @abstractmethod
    def users(self) -> int:
        """How many people it sees; raises RobotError."""


def chosen_voice(voices: tuple[RobotVoice, ...], language: str, wished: str = "") -> RobotVoice:
    """Return the wished voice, or else one nearest to the language.

    Raises RobotError without one.
    """
    if wished:
        matching = [(0, voice) for voice in voices if voice.name == wished]
    else:
        far = ((distance(language, voice.language), voice) for voice in voices)
        matching = [(each, voice) for each, voice in far if each is not None]
    if matching:
        return min(matching, key=lambda each: each[0])[1]
    offered = ", ".join(sorted({voice.language for voice in voices})) or "none"
    raise RobotError(FailureKind.NO_VOICE, wished or language, f"it has {offered}")


def mismatch(voice: RobotVoice, language: str) -> str:
    """Say that a voice is made for another language; empty if it is not, or if it does not tell."""
    if not voice.language or distance(language, voice.language) is not None:
        return ""
    return f"{voice.name} is a voice of {voice.language}, not of {language}"


def speakable(sentence: str, longest: int = LONGEST_TEXT) -> str:
    """Return a sentence as a robot takes it: not too long, without markup, control and direction characters."""
    shown = (character for character in sentence if character not in _DIRECTIONS)
    plain = "".join(" " if character in "<>&" or not can_be_kept(character) else character for character in shown)
    text = " ".join(plain.split())
    return text if len(text) <= longest else text[:longest].rsplit(" ", 1)[0]


Job = Callable[[], None]

_QUIT_S = 0.5


class KeyedWorker:
    """Jobs wait under a key; a newer job of the same key takes the place of the one that waits."""

    def __init__(self, name: str, between: Job, every_s: float) -> None:
        """``between`` is done whenever no job came for ``every_s`` seconds. No job may raise."""
        self._between = between
        self._every_s = every_s
        self._jobs: OrderedDict[str, Job] = OrderedDict()
        self._changed = threading.Condition()
        self._open = True
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def submit(self, key: str, job: Job) -> bool:
        """Do this after what waits already; returns whether another job of the key will now never be done."""
        with self._changed:
            replaced = self._jobs.pop(key, None) is not None
            self._jobs[key] = job
            self._changed.notify()
        return replaced

    def clear(self) -> int:
        """Do nothing of what waits; returns how many jobs that were."""
        with self._changed:
            waiting = len(self._jobs)
            self._jobs.clear()
        return waiting

    def close(self) -> None:
        """Do nothing more once what is under way is over; wait for that, but not for long."""
        with self._changed:
            self._open = False
            self._changed.notify()
        self._thread.join(_QUIT_S)

    def _run(self) -> None:
        while True:
            with self._changed:
                if not self._jobs and self._open:
                    self._changed.wait(self._every_s)
                if not self._jobs and not self._open:
                    return
                job = self._jobs.popitem(last=False)[1] if self._jobs else self._between
            job()


Land = Callable[[Job], None]
"""Has a job done on the interface's thread, soon; may be called from any thread."""


class RobotListener(SpeechListener, Protocol):
    """A listener that hears of the robot's coming as well."""

    def robot_found(self) -> None:
        """Report that the robot can be counted on from now on."""
        ...

    def robot_uses_own_voice(self, why: str) -> None:
        """Report that the robot could not play the clips of the voice pack, and speaks with its own voice."""
        ...

    def robot_has_other_voice(self, why: str) -> None:
        """Report that the robot's voice is not of the language, or not the one of the study file."""
        ...


class AsyncRobotAdapter:
    """One robot, found or lost; lost until ``look_for`` has found it."""

    def __init__(self, robot: RobotDriver, reports: RobotListener, land: Land, look_every_ms: int) -> None:
        """While it speaks, see every ``look_every_ms`` whether it still answers."""
        self._robot = robot
        self._reports = reports
        self._land = land
        self._saying: Utterance | None = None
        robot.on_own_voice = lambda why: land(partial(self._uses_own_voice, why))
        robot.on_other_voice = lambda why: land(partial(self._has_other_voice, why))
        self._voice_name = self._other_voice = ""
        self._health = Health(is_ok=False, message="the robot has not been looked for yet")
        self._sought = False
        self._under_way = 0
        self._voice = KeyedWorker("robot-voice", lambda: None, look_every_ms / 1000)
        self._motion = KeyedWorker("robot-motion", self._look_while_speaking, look_every_ms / 1000)

    @property
    def name(self) -> EmbodimentName:
        """What the records call it."""
        return EmbodimentName.robot(self._robot.name)

    @property
    def health(self) -> Health:
        """Whether it was found, and what it was or did last."""
        return self._health

    @property
    def busy(self) -> bool:
        """Whether anything that was asked of it is not over."""
        return self._under_way > 0

    @property
    def spoken_by(self) -> Mapping[str, str]:
        """What speaks the sentence under way; empty if it is the robot's own voice, of which nothing is known."""
        return self._robot.spoken_by

    def connect(self) -> None:
        """Look for it, and get it ready to speak; ``robot_found`` or ``robot_lost`` follows."""
        self._sought = True
        self._other_voice = ""
        self._post(self._motion, "look for", lambda: self._land(partial(self._found, self._robot.connect())))

    def health_check(self) -> None:
        """See whether it is still well; ``robot_lost`` follows if not."""
        self._post(self._motion, "probe", self._robot.health_check)

    def set_language(self, language: str) -> None:
        """Speak this language; a robot without a voice for it is lost to the session."""
        self._other_voice = ""
        # Before its first sentence, on whose worker it goes; but after a search, which gives it a voice as well.
        worker = self._voice if self._health.is_ok else self._motion
        self._post(worker, "speak", partial(self._robot.set_language, language))

    def say(self, utterance: int, sentence: str) -> None:
        """Begin to say a sentence, in place of any other."""
        self._drop_sentence()
        longest = self._robot.longest_text
        saying = Utterance(sentence, lambda: self._land(lambda: self._started(saying, utterance)), longest)
        self._saying = saying
        self._post(self._voice, "say", partial(self._say, saying, utterance), saying)
        self.look_at(None)

    def stop(self) -> None:
        """Be silent."""
        if self._drop_sentence():
            self._post(self._motion, "stop_speech", self._robot.stop_speech)

    def express(self, mood: Mood) -> None:
        """Show a mood."""
        if Capability.GESTURES in self._robot.capabilities:
            self._post(self._motion, "express", partial(self._robot.express, mood))

    def look_at(self, place: BoardPoint | None) -> None:
        """Look at a place on the board, or at the visitor."""
        if Capability.GAZE in self._robot.capabilities:
            self._post(self._motion, "attend", partial(self._robot.look_at, place))

    def activate(self) -> None:
        """Look at the visitor."""
        self.look_at(None)

    def deactivate(self) -> None:
        """Be silent; a robot that is lost does not hear it anyway."""
        self._drop_sentence()

    def reset(self) -> None:
        """Keep nothing of the last visitor: no sentence is left, and gestures end by themselves."""
        self.stop()

    def close(self) -> None:
        """Let go of the robot and of both threads."""
        self._drop_sentence()
        self._robot.close()
        for worker in (self._voice, self._motion):
            worker.close()

    def _say(self, saying: Utterance, utterance: int) -> None:
        if not saying.is_cancelled:
            self._robot.say(saying)
            self._land(partial(self._finished, saying, utterance))

    def _look_while_speaking(self) -> None:
        saying = self._saying
        if saying is not None:
            self._guarded(self._robot.health_check, saying)

    def _post(self, worker: KeyedWorker, key: str, job: Job, saying: Utterance | None = None) -> None:
        """Have a worker do something that may fail; ``saying`` is the sentence that it is about."""
        self._under_way += 1

        def do() -> None:
            self._guarded(job, saying)
            self._land(self._over)

        if worker.submit(key, do):
            self._over()

    def _guarded(self, job: Job, saying: Utterance | None) -> None:
        """Do it, and let its failure land; a fault of ours lands as what it is."""
        try:
            job()
        except RobotError as failure:
            if saying is None or not saying.is_cancelled:
                self._land(partial(self._lost, str(failure)))
        except Exception as fault:  # noqa: BLE001 - it is raised where faults are seen
            self._land(partial(_raise, fault))

    def _over(self) -> None:
        self._under_way -= 1

    def _drop_sentence(self) -> bool:
        """Wait for the sentence no longer; returns whether there was one."""
        saying, self._saying = self._saying, None
        if saying is not None:
            saying.cancel()
        return saying is not None

    def _started(self, saying: Utterance, utterance: int) -> None:
        if saying is self._saying:
            self._reports.speech_started(utterance)

    def _finished(self, saying: Utterance, utterance: int) -> None:
        if saying is self._saying:
            self._saying = None
            self._reports.speech_finished(utterance)

    def _found(self, found: Capabilities) -> None:
        self._sought = False
        self._voice_name = f" and speaks as {found.voice.name}" if found.voice else ""
        self._health = Health(is_ok=True, message=self._there())
        self._reports.robot_found()

    def _there(self) -> str:
        return f"the robot is there{self._voice_name}{', but ' if self._other_voice else ''}{self._other_voice}"

    def _has_other_voice(self, why: str) -> None:
        self._other_voice = why
        if self._health.is_ok:
            self._health = Health(is_ok=True, message=self._there())
        self._reports.robot_has_other_voice(why)

    def _uses_own_voice(self, why: str) -> None:
        if self._health.is_ok:
            self._health = Health(is_ok=True, message=f"the robot is there, but speaks with its own voice: {why}")
        self._reports.robot_uses_own_voice(why)

    def _lost(self, why: str) -> None:
        """Report the first failure; later ones were asked of a robot that was lost already."""
        if not self._health.is_ok and not self._sought:
            return
        self._sought = False
        self._health = Health(is_ok=False, message=why)
        self._drop_sentence()
        self._under_way -= self._voice.clear() + self._motion.clear()
        self._reports.robot_lost(why)


def _raise(fault: Exception) -> None:
    raise fault


_log = logging.getLogger(__name__)


class TimerHandle(Protocol):
    """A wait that is under way."""

    def cancel(self) -> None:
        """Forget it."""
        ...


After = Callable[[int, Callable[[], None]], TimerHandle]
"""Calls back once, on the interface's thread, in so many milliseconds."""


class EmbodimentSelector:
    """The embodiments of one kiosk, and which of them helps now; what they report passes through here."""

    def __init__(self, listener: SpeechListener, after: After, settings: RobotSettings) -> None:
        """Without a body nothing is said; ``take`` brings the avatar, ``take_robot`` the robot."""
        self.on_own_voice: Callable[[str], None] = lambda _: None
        """Called with the reason why the robot does not play the clips that it was to play."""
        self.on_other_voice: Callable[[str], None] = lambda _: None
        """Called with what is wrong with the robot's voice."""
        self._listener = listener
        self._after = after
        self._settings = settings
        self._avatar: Embodiment | None = None
        self._robot: AsyncRobotAdapter | None = None
        self._current: Embodiment | None = None
        self._mouth: MutableSpeech | None = None
        self._muted = self._muted_by_visitor = False
        self._prefers_avatar = False
        self._in_session = False
        self._unsettled = False
        self._pause = settings.backoff_initial_ms
        self._wait: TimerHandle | None = None
        self._due = False

    @property
    def current(self) -> Embodiment | None:
        """The body that helps now."""
        return self._mouth

    @property
    def is_muted(self) -> bool:
        """Whether the experimenter lets no sentence be heard."""
        return self._muted

    @property
    def is_silent(self) -> bool:
        """Whether no sentence is heard, because the experimenter or the visitor wants it so."""
        return self._muted or self._muted_by_visitor

    @property
    def prefers_avatar(self) -> bool:
        """Whether the avatar helps even when the robot is well."""
        return self._prefers_avatar

    @property
    def has_robot(self) -> bool:
        """Whether there is a robot to choose, well or not."""
        return self._robot is not None

    @property
    def health(self) -> Mapping[EmbodimentName, Health]:
        """How every body is, in words for the experimenter."""
        return {body.name: body.health for body in (self._robot, self._avatar) if body is not None}

    @property
    def intended(self) -> EmbodimentName:
        """The body that is meant to help: the robot, if the kiosk has one."""
        return self._robot.name if self._robot is not None else EmbodimentName.AVATAR

    @property
    def fallback(self) -> tuple[FallbackReason, str] | None:
        """Why the robot does not help now, with what its driver says; None if it does, or there is none."""
        if self._robot is None or self._current is self._robot:
            return None
        if self._prefers_avatar:
            return FallbackReason.CHOSEN, ""
        return (FallbackReason.SOUGHT if self._unsettled else FallbackReason.FAILED), self._robot.health.message

    @property
    def robot_spoken_by(self) -> Mapping[str, str]:
        """What speaks the robot's sentence under way, if it is a clip of the voice pack."""
        return {} if self._robot is None else self._robot.spoken_by

    @property
    def settled(self) -> bool:
        """Whether the robot, if there is one, has been looked for."""
        return not self._unsettled

    @property
    def busy(self) -> bool:
        """Whether a robot is at something that takes its own time."""
        return self._robot is not None and self._robot.busy

    def set_avatar(self, avatar: Embodiment) -> None:
        """Have this body help whenever no robot does."""
        self._avatar = avatar
        self._enter(avatar)

    def attach_robot(self, robot: AsyncRobotAdapter) -> None:
        """Look for this robot, and have it help as soon as it is found and no session is under way."""
        self._robot = robot
        self._unsettled = True
        robot.connect()

    def prefer(self, name: EmbodimentName) -> None:
        """Have the avatar help, or the robot whenever it is well, from the next session on."""
        self._prefers_avatar = name == EmbodimentName.AVATAR
        if not self._in_session:
            self._choose()

    def mute(self) -> None:
        """Let no sentence be heard; one that is being said breaks off."""
        self._muted = True
        self._apply_mute()

    def unmute(self) -> None:
        """Let sentences be heard again, unless the visitor wants silence."""
        self._muted = False
        self._apply_mute()

    def set_sound(self, *, on: bool) -> None:
        """Let the visitor hear sentences or not; it holds to the end of the session."""
        self._muted_by_visitor = not on
        self._apply_mute()

    def set_language(self, language: str) -> None:
        """Speak this language from the next sentence on."""
        for body in (self._avatar, self._robot):
            if body is not None:
                body.set_language(language)

    def _apply_mute(self) -> None:
        if self._mouth is None or self._mouth.muted is self.is_silent:
            return
        if self.is_silent:
            self._mouth.mute()
        else:
            self._mouth.unmute()

    def begin_session(self, language: str) -> None:
        """Begin a session in this language: the body stays as it is, unless the robot is lost."""
        self._in_session = True
        self.set_language(language)

    def end_session(self) -> None:
        """No session is under way: nothing of the last one is kept, and the robot may be taken back."""
        kept = self._in_session and self._robot is not None and self._current is self._robot
        self._in_session = False
        self.set_sound(on=True)
        if kept:
            self._pause = self._settings.backoff_initial_ms
        if self._current is not None:
            self._current.reset()
        self._choose()
        if self._due:
            self._see_to_robot()

    def switch_to(self, to: EmbodimentName) -> None:
        """Have the body of this name help from now on, if there is one."""
        self._enter(next((body for body in (self._avatar, self._robot) if body is not None and body.name == to), None))

    def close(self) -> None:
        """Let go of the robot; the avatar belongs to the caller that made it."""
        self._stop_waiting()
        if self._robot is not None:
            self._robot.close()

    def speech_started(self, utterance: int) -> None:
        """Pass on that the body began to say a sentence."""
        self._listener.speech_started(utterance)

    def speech_finished(self, utterance: int) -> None:
        """Pass on that the body has said a sentence."""
        if self._mouth is not None:
            self._mouth.said(utterance)
        self._listener.speech_finished(utterance)

    def speech_failed(self, utterance: int, why: str) -> None:
        """Pass on that the body will not say a sentence."""
        if self._mouth is not None:
            self._mouth.said(utterance)
        self._listener.speech_failed(utterance, why)

    def robot_found(self) -> None:
        """Use the robot that was found, or wait for the end of the session to do so."""
        self._unsettled = False
        if not self._in_session:
            self._choose()
        self._wait_for_robot(self._settings.health_check_ms)

    def robot_uses_own_voice(self, why: str) -> None:
        """Pass on that the robot speaks with its own voice, though it was to play clips."""
        _log.warning("the robot speaks with its own voice: %s", why)
        self.on_own_voice(why)

    def robot_has_other_voice(self, why: str) -> None:
        """Pass on that the robot speaks with a voice that is not meant."""
        _log.warning("the robot has another voice than it should: %s", why)
        self.on_other_voice(why)

    def robot_lost(self, why: str) -> None:
        """Record the loss in the session that the robot was helping in, or change to the avatar."""
        _log.info("%s", why)
        self._unsettled = False
        if self._in_session and self._current is self._robot:
            self._listener.robot_lost(why)
        elif not self._in_session:
            self._choose()
        self._wait_for_robot(self._pause)
        self._pause = min(2 * self._pause, self._settings.backoff_max_ms)

    def _choose(self) -> None:
        well = self._robot is not None and self._robot.health.is_ok
        self._enter(self._robot if well and not self._prefers_avatar else self._avatar)

    def _enter(self, body: Embodiment | None) -> None:
        before, self._current = self._current, body
        if body is before:
            return
        if before is not None:
            before.deactivate()
        if body is not None:
            self._lend_mouth(body)
            body.activate()

    def _lend_mouth(self, body: Embodiment) -> None:
        """Give the one mouth to a body: whether it is shut outlasts a change of body."""
        if self._mouth is None:
            self._mouth = MutableSpeech(body, self._listener)
            self._apply_mute()
        self._mouth.embodiment = body

    def _wait_for_robot(self, ms: int) -> None:
        """Look at the robot after so long; during a session, as soon as it is over."""
        self._stop_waiting()
        self._wait = self._after(ms, self._see_to_robot)

    def _see_to_robot(self) -> None:
        """See whether the robot is still well, or back."""
        self._wait = None
        self._due = self._in_session
        if self._robot is None or self._in_session:
            return
        if self._robot.health.is_ok:
            self._robot.health_check()
            self._wait_for_robot(self._settings.health_check_ms)
        else:
            self._robot.connect()

    def _stop_waiting(self) -> None:
        wait, self._wait = self._wait, None
        if wait is not None:
            wait.cancel()
