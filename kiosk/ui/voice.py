"""The voice as the interface sees it: sentences in, three signals out.

It may be missing, hang or die at any moment.

The speech engine runs in a process of its own (kiosk/robots/tts_worker.py) that is never waited for.
A sentence that does not start in time ends the process, which is started again for the next one.
"""

from __future__ import annotations

import json
import logging
from collections.abc import Mapping
from itertools import count
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, QProcess, QTimer, Signal

from kiosk import program
from kiosk.config import VoiceConfig as VoiceSettings
from kiosk.robots import voice_options
from kiosk.robots.embodiment import Health
from kiosk.ui.event_loop import Clock, TimerWait

START_DEADLINE_MS = 2_000
"""A sentence that has not begun after this time never will: rendering takes 9 to 44 ms, starting the process 300."""

END_GRACE_MS = 1_500
"""How much longer than its own length a sentence may take."""

READY_DEADLINE_MS = 800
"""The same once the process has said that it is ready; with a new start within a second of a sentence that hangs."""

MAX_FAILURES = 3
"""After so many failures in a row the voice is not tried again until ``restore``."""

QUIT_MS = 500

_log = logging.getLogger(__name__)


class Voice(QObject):
    """What every voice reports: each sentence starts and then finishes, or fails."""

    started = Signal(int, list)
    """The sentence's number, and its loudness (0 to 1) at each step of 40 ms."""
    spoken_by: Mapping[str, Any] = {}
    """What speaks the sentence under way: engine, engine_version, voice, pack, device and volume."""
    pack: tuple[str, str] = ("", "")
    """The language, and the hash of the pack of clips that speaks it; empty without one."""
    shapes: tuple[str, ...] = ()
    """The shapes of its mouth at each step of 40 ms."""
    finished = Signal(int)
    failed = Signal(int, str)
    health_changed = Signal(bool, str)
    """Whether sentences are heard from now on, and ``health``'s words for it."""

    def set_language(self, language: str) -> None:
        """Speak this language from the next sentence on."""

    def set_volume(self, volume: float) -> None:
        """Set the volume, from 0 to 1, from the next sentence on."""

    def say(self, number: int, sentence: str) -> None:
        """Begin to say a sentence, in place of any other."""
        raise NotImplementedError

    def stop(self) -> None:
        """Be silent; the sentence under way is not reported any more."""
        raise NotImplementedError

    def play(self, sound: Path) -> None:
        """Play a short sound, unless a sentence is under way."""

    def restore(self) -> None:
        """Try again whatever was given up."""

    @property
    def health(self) -> Health:
        """Whether sentences are heard, in words for the experimenter."""
        return Health(is_ok=True, message="off in this study", is_used=False)

    def close(self) -> None:
        """Be silent for good."""


class NoVoice(Voice):
    """A voice that is switched off: every sentence is left to be read."""

    def say(self, number: int, sentence: str) -> None:  # noqa: ARG002 - it says nothing
        """Report that nothing will be heard."""
        self.failed.emit(number, "the voice is switched off")

    def stop(self) -> None:
        """Nothing is to be heard anyway."""


class SilentVoice(Voice):
    """A voice without sound that takes its time as a real one does; the same time for the same sentence."""

    MS_PER_CHARACTER = 68
    """espeak-ng at 150 words a minute needs about this long for a character of these sentences."""

    def __init__(self, clock: Clock, parent: QObject | None = None) -> None:
        """Take the time from this clock."""
        super().__init__(parent)
        self._clock = clock
        self._wait: TimerWait | None = None

    @property
    def health(self) -> Health:
        """Say that it is simulated: the study may have its voice on."""
        return Health(is_ok=True, message="simulated", is_used=False)

    def say(self, number: int, sentence: str) -> None:
        """Begin to be silent about a sentence."""
        self.stop()
        self._wait = self._clock.after(self.MS_PER_CHARACTER * len(sentence), lambda: self.finished.emit(number))
        self.started.emit(number, [])

    def stop(self) -> None:
        """Forget the sentence."""
        if self._wait is not None:
            self._wait.cancel()


class EngineVoice(Voice):
    """The speech engine in its process."""

    def __init__(  # noqa: PLR0913, PLR0917 - what differs between the booth and a test
        self,
        settings: VoiceSettings,
        language: str,
        command: tuple[str, ...] | None = None,
        start_deadline_ms: int = START_DEADLINE_MS,
        end_grace_ms: int = END_GRACE_MS,
        parent: QObject | None = None,
    ) -> None:
        """Start the process; ``command`` and other deadlines stand in for its own in tests."""
        super().__init__(parent)
        self._settings = settings
        self._other = command
        self._start_deadline_ms = start_deadline_ms
        self._end_grace_ms = end_grace_ms
        self._language = language
        self._health = Health(is_ok=True, message="the voice is starting")
        self._ready = False
        self._name: object = None
        self._saying: int | None = None
        # Every session counts its sentences from 1; what comes late of the last one must not be taken for this one's.
        self._requests = count(1)
        self._request = 0
        self._failures = 0
        self._deadline = QTimer(self)
        self._deadline.setSingleShot(True)
        self._deadline.timeout.connect(self._overdue)
        self._process: QProcess | None = None
        self._start()

    def set_language(self, language: str) -> None:
        """End the process that speaks another language, and start one that speaks this one."""
        if language != self._language:
            self._language = language
            self._start_anew()

    def set_volume(self, volume: float) -> None:
        """Set the volume at once; a process that is started later begins with it."""
        self._settings = self._settings.model_copy(update={"volume": volume})
        self._send({"volume": volume})

    def _start_anew(self) -> None:
        self._failures = 0
        process = self._let_go_of_process()
        if process is not None:
            # It puts its own things away when the kiosk is gone.
            process.closeWriteChannel()
            QTimer.singleShot(QUIT_MS, process, process.kill)
        self._start()

    def say(self, number: int, sentence: str) -> None:
        """Send a sentence to the engine."""
        self.stop()
        if self._failures >= MAX_FAILURES:
            self.failed.emit(number, "there is no voice")
            return
        if self._process is None:
            self._start()
        self._saying = number
        most = READY_DEADLINE_MS if self._ready else self._start_deadline_ms
        self._deadline.start(min(most, self._start_deadline_ms))
        self._request = next(self._requests)
        self._send({"say": self._request, "text": sentence})

    def stop(self) -> None:
        """Tell the engine to be silent."""
        self._deadline.stop()
        if self._saying is not None and self._process is not None:
            self._send({"stop": True})
        self._saying = None

    def play(self, sound: Path) -> None:
        """Have the engine's process play a short sound; without one there is none."""
        if self._ready:
            self._send({"play": str(sound)})

    def restore(self) -> None:
        """Try the engine again, however often it has failed."""
        self._failures = 0

    @property
    def health(self) -> Health:
        """What the engine said of itself, or why it is gone; at volume 0 nothing is heard of it either."""
        if self._health.is_ok and self._settings.volume == 0:
            return Health(is_ok=False, message="sentences are only shown: the volume is 0")
        return self._health

    def _take_health(self, health: Health) -> None:
        was_ok, self._health = self._health.is_ok, health
        if not health.is_ok:
            _log.warning("%s", health.message)
        if health.is_ok is not was_ok:
            self.health_changed.emit(health.is_ok, health.message)

    def close(self) -> None:
        """End the process, and those that were let go and have not ended."""
        self._saying = None
        self._process = None
        processes = [
            each for each in self.findChildren(QProcess) if each.state() is not QProcess.ProcessState.NotRunning
        ]
        for process in processes:
            process.blockSignals(True)  # noqa: FBT003 - Qt's signature
            process.closeWriteChannel()
        for process in processes:
            if not process.waitForFinished(QUIT_MS):
                process.kill()
                process.waitForFinished(QUIT_MS)

    def _start(self) -> None:
        process = QProcess(self)
        process.setProcessChannelMode(QProcess.ProcessChannelMode.SeparateChannels)
        process.setStandardErrorFile(QProcess.nullDevice())
        process.readyReadStandardOutput.connect(self._read)
        process.finished.connect(self._lost)
        process.errorOccurred.connect(self._lost)
        self._process = process
        manner = voice_options(self._settings, self._language)
        command = (*self._other, manner) if self._other else program("_voice", manner)
        process.start(command[0], list(command[1:]))

    def _send(self, command: dict[str, Any]) -> None:
        if self._process is not None:
            self._process.write(json.dumps(command).encode() + b"\n")

    def _read(self) -> None:
        while self._process is not None and self._process.canReadLine():
            line = bytes(self._process.readLine().data())
            try:
                event = json.loads(line)
                kind = event["event"]
            except (ValueError, KeyError, TypeError):
                _log.warning("the voice sent an unknown message: %r", line[:100])
                continue
            self._heard(kind, event)

    def _heard(self, kind: str, event: dict[str, Any]) -> None:
        if kind == "ready":
            self._ready = True
            self._name = event.get("voice")
            self.pack = (self._language, str(event.get("by", {}).get("pack", "")))
            self._notice_device(event)
        if kind == "device":
            self._notice_device(event)
        if kind == "unavailable":
            self._failures = MAX_FAILURES
            self._take_health(Health(is_ok=False, message=f"sentences are only shown: {event.get('why')}"))
            self._give_up(str(event.get("why")))
        if event.get("id") != self._request or self._saying is None:
            return
        match kind:
            case "started":
                self._deadline.start(int(event["duration_ms"]) + self._end_grace_ms)
                by = event.get("by")
                self.spoken_by = {**by, "volume": self._settings.volume} if by else {}
                self.shapes = tuple(event.get("shapes", ()))
                self.started.emit(self._saying, event["loudness"])
            case "finished":
                self._failures = 0
                self._done()
            case "failed":
                self._give_up(str(event.get("why")))

    def _notice_device(self, event: dict[str, Any]) -> None:
        """Note that the sound device was found, lost or found again."""
        device, why = str(event.get("device", "")), str(event.get("why", ""))
        self._take_health(_found(self._language, self._name, device, why))

    def _done(self) -> None:
        number, self._saying = self._saying, None
        self._deadline.stop()
        if number is not None:
            self.finished.emit(number)

    def _overdue(self) -> None:
        """End an engine that hangs, and start another."""
        _log.warning("the voice hangs and is ended")
        self._drop_process()
        self._give_up("the voice did not answer in time")

    def _lost(self) -> None:
        if self.sender() is not self._process:
            return
        _log.warning("the voice is gone")
        self._drop_process()
        self._give_up("the voice is gone")

    def _let_go_of_process(self) -> QProcess | None:
        """Hear no more of it; until it has ended it stays a child of this object."""
        process, self._process = self._process, None
        self._ready = False
        if process is not None:
            # Not after a time: Qt would wait for a process that it is to delete and that still runs.
            process.finished.connect(process.deleteLater)
            if process.state() is QProcess.ProcessState.NotRunning:
                process.deleteLater()
        return process

    def _drop_process(self) -> None:
        process = self._let_go_of_process()
        if process is not None:
            process.kill()
        self._failures += 1
        if self._failures < MAX_FAILURES:
            self._start()
        else:
            words = "sentences are only shown: the voice failed again and again"
            self._take_health(Health(is_ok=False, message=words))

    def _give_up(self, why: str) -> None:
        number, self._saying = self._saying, None
        self._deadline.stop()
        if number is not None:
            self.failed.emit(number, why)


def _found(language: str, voice: object, device: str, why: str) -> Health:
    """Return what an engine that is ready can do."""
    if voice is None:
        return Health(is_ok=False, message=f"sentences are only shown: no installed voice speaks {language!r}")
    if not device:
        return Health(is_ok=False, message=f"sentences are only shown: {why}")
    return Health(is_ok=True, message=f"the voice {voice} speaks")
