"""A robot as an embodiment: its driver's calls wait in threads, and no call of the interface does."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Mapping
from functools import partial

from kiosk.experiment.effects import Mood
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.robots.driver import Capabilities, Capability, RobotDriver, RobotError, Utterance
from kiosk.robots.embodiment import BoardPoint, Health, RobotListener

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


class AsyncRobotAdapter:
    """One robot, found or lost; lost until ``connect`` has found it."""

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
