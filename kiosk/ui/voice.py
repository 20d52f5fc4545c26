"""The voice as the interface sees it: sentences in, three signals out. It may be missing, hang or die at any moment.

The speech engine runs in a process of its own (kiosk/robot/speech.py) and is spoken to without ever being waited for.
A sentence that does not start in time ends the process, which is started again for the next one.
"""

from __future__ import annotations

import json
import logging
import sys
from typing import Any

from PySide6.QtCore import QObject, QProcess, QTimer, Signal

from kiosk.settings import Voice as VoiceSettings
from kiosk.ui.clock import Clock, Wait

START_DEADLINE_MS = 2_000
"""A sentence that has not begun after this time never will: rendering takes 9 to 44 ms, starting the process 300."""

END_GRACE_MS = 1_500
"""How much longer than its own length a sentence may take."""

MAX_FAILURES = 3
"""After so many failures in a row the voice is not tried again until ``restore``."""

QUIT_MS = 500

_log = logging.getLogger(__name__)


class Voice(QObject):
    """What every voice reports: each sentence starts and then finishes, or fails."""

    started = Signal(int, list)
    """The sentence's number, and its loudness (0 to 1) at each step of 40 ms."""
    finished = Signal(int)
    failed = Signal(int, str)

    def say(self, number: int, sentence: str) -> None:
        """Begin to say a sentence, in place of any other."""
        raise NotImplementedError

    def stop(self) -> None:
        """Be silent; the sentence under way is not reported any more."""
        raise NotImplementedError

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
        self._wait: Wait | None = None

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

    def __init__(
        self,
        settings: VoiceSettings,
        language: str,
        command: tuple[str, ...] | None = None,
        parent: QObject | None = None,
    ) -> None:
        """Start the process; ``command`` stands in for it in tests."""
        super().__init__(parent)
        worker = (sys.executable, "-m", "kiosk.robot.speech", language, str(settings.rate), str(settings.volume))
        self._command = command or worker
        self._saying: int | None = None
        self._failures = 0
        self._deadline = QTimer(self)
        self._deadline.setSingleShot(True)
        self._deadline.timeout.connect(self._overdue)
        self._process: QProcess | None = None
        self._start()

    def say(self, number: int, sentence: str) -> None:
        """Send a sentence to the engine."""
        self.stop()
        if self._process is None and self._failures < MAX_FAILURES:
            self._start()
        if self._process is None:
            self.failed.emit(number, "there is no voice")
            return
        self._saying = number
        self._deadline.start(START_DEADLINE_MS)
        self._send({"say": number, "text": sentence})

    def stop(self) -> None:
        """Tell the engine to be silent."""
        self._deadline.stop()
        if self._saying is not None and self._process is not None:
            self._send({"stop": True})
        self._saying = None

    def restore(self) -> None:
        """Try the engine again, however often it has failed."""
        self._failures = 0

    def close(self) -> None:
        """End the process."""
        self._saying = None
        process, self._process = self._process, None
        if process is not None:
            process.disconnect(self)
            process.closeWriteChannel()
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
        process.start(self._command[0], list(self._command[1:]))

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
                _log.warning("the voice sent what nobody understands: %r", line[:100])
                continue
            self._heard(kind, event)

    def _heard(self, kind: str, event: dict[str, Any]) -> None:
        if kind == "unavailable":
            _log.warning("there is no voice: %s", event.get("why"))
            self._failures = MAX_FAILURES
            self._give_up(str(event.get("why")))
        if event.get("id") != self._saying or self._saying is None:
            return
        match kind:
            case "started":
                self._deadline.start(int(event["duration_ms"]) + END_GRACE_MS)
                self.started.emit(self._saying, event["loudness"])
            case "finished":
                self._failures = 0
                self._done()
            case "failed":
                self._give_up(str(event.get("why")))

    def _done(self) -> None:
        number, self._saying = self._saying, None
        self._deadline.stop()
        if number is not None:
            self.finished.emit(number)

    def _overdue(self) -> None:
        """The engine hangs: end it; the next sentence starts another."""
        _log.warning("the voice hangs and is ended")
        self._drop_process()
        self._give_up("the voice did not answer in time")

    def _lost(self) -> None:
        if self.sender() is not self._process:
            return
        _log.warning("the voice is gone")
        self._drop_process()
        self._give_up("the voice is gone")

    def _drop_process(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.disconnect(self)
            process.finished.connect(process.deleteLater)
            process.kill()
        self._failures += 1

    def _give_up(self, why: str) -> None:
        number, self._saying = self._saying, None
        self._deadline.stop()
        if number is not None:
            self.failed.emit(number, why)
