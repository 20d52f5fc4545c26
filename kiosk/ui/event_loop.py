"""The Qt event loop with its clocks, worker threads and heartbeat."""

from __future__ import annotations

import gc
import heapq
import os
import signal
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from itertools import count
from queue import SimpleQueue
from threading import Lock, Thread
from time import monotonic, sleep
from types import TracebackType
from typing import Protocol, TypeVar

from PySide6.QtCore import QEventLoop, QObject, Qt, QTimer, Signal
from PySide6.QtQuick import QQuickWindow

from kiosk.sd_notify import BEAT_WITHIN, PIPE, SOCKET, Notifier, Presence
from kiosk.ui.screens.shell import KioskScreen
from kiosk.units import MS_PER_SECOND

_TICK_S = 0.0005
"""How long a virtual clock that keeps pace with the wall's gives way to what it waits for."""


class TimerWait(Protocol):
    """A wait that is under way."""

    def cancel(self) -> None:
        """Forget it; cancelling one that is over changes nothing."""
        ...


class Clock(Protocol):
    """Tells the time and waits."""

    def now_ms(self) -> int:
        """Milliseconds since some fixed moment; never goes back."""
        ...

    def after(self, ms: int, call: Callable[[], None]) -> TimerWait:
        """Call back once, on the interface's thread, when so many milliseconds have passed."""
        ...


class _TimerWait:
    def __init__(self, timer: QTimer, call: Callable[[], None]) -> None:
        self._timer: QTimer | None = timer
        # Qt for Python keeps no object alive whose method it calls, and leaves a reference to it behind when the timer
        # goes. It keeps this function, and so the wait, which deletes the timer, although the caller may forget both.
        timer.timeout.connect(lambda: self._end(call))

    def cancel(self) -> None:
        timer, self._timer = self._timer, None
        if timer is not None:
            timer.stop()
            timer.deleteLater()

    def _end(self, call: Callable[[], None]) -> None:
        self.cancel()
        call()


class WallClock:
    """Real time, ``speed`` times as fast."""

    def __init__(self, owner: QObject, speed: float = 1.0) -> None:
        """Its waits end with ``owner``."""
        self._owner = owner
        self._speed = speed

    def now_ms(self) -> int:
        """Milliseconds since some fixed moment, on a clock that cannot be set back."""
        return int(monotonic() * MS_PER_SECOND * self._speed)

    def after(self, ms: int, call: Callable[[], None]) -> TimerWait:
        """Call back once, when so many milliseconds of this clock have passed."""
        timer = QTimer(self._owner)
        timer.setSingleShot(True)
        timer.setTimerType(Qt.TimerType.PreciseTimer)
        wait = _TimerWait(timer, call)
        timer.start(round(ms / self._speed))
        return wait


class _QueuedWait:
    def __init__(self, call: Callable[[], None]) -> None:
        self.call: Callable[[], None] | None = call

    def cancel(self) -> None:
        self.call = None


class VirtualClock:
    """Time that passes only by jumping to the end of the next wait, on request."""

    def __init__(self) -> None:
        """Begin at 0."""
        self.waits_for: Callable[[], bool] = lambda: False
        """Whether something takes its own time just now, such as a robot; meanwhile this clock goes like the wall's."""
        self._now = 0
        self._waited_since: float | None = None
        self._order = count()
        self._waits: list[tuple[int, int, _QueuedWait]] = []

    def now_ms(self) -> int:
        """Milliseconds since the clock was made."""
        return self._now

    def after(self, ms: int, call: Callable[[], None]) -> TimerWait:
        """Call back once, when the clock has jumped that far; waits that end together end in the order they began."""
        wait = _QueuedWait(call)
        heapq.heappush(self._waits, (self._now + ms, next(self._order), wait))
        return wait

    def jump(self) -> None:
        """Go on to the end of the next wait, if there is one."""
        if self.waits_for():
            self._keep_pace()
            return
        self._waited_since = None
        self._forget_cancelled()
        if self._waits:
            self._end(heapq.heappop(self._waits))

    def _keep_pace(self) -> None:
        """Go on as the wall's clock does; end one wait if its time has come."""
        now = monotonic()
        if self._waited_since is None:
            self._waited_since = now - self._now / MS_PER_SECOND
        reached = int((now - self._waited_since) * MS_PER_SECOND)
        self._forget_cancelled()
        if self._waits and self._waits[0][0] <= reached:
            self._end(heapq.heappop(self._waits))
        else:
            self._now = max(self._now, reached)
            sleep(_TICK_S)

    def _forget_cancelled(self) -> None:
        while self._waits and self._waits[0][2].call is None:
            heapq.heappop(self._waits)

    def _end(self, due: tuple[int, int, _QueuedWait]) -> None:
        at, _, wait = due
        self._now = max(self._now, at)
        if wait.call is not None:
            wait.call()


_Result = TypeVar("_Result")

END_S = 2.0
"""How long closing waits for the work at hand; what takes longer ends with the program."""


class MainThreadExecutor(QObject):
    """Takes jobs from any thread, and does them in order on the thread that it was made on."""

    _landed = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self._lock = Lock()
        self._open = True
        self._landed.connect(self._do, Qt.ConnectionType.QueuedConnection)

    def __call__(self, job: Callable[[], None]) -> None:
        """Have this done on the interface's thread; not at all once it is closed."""
        with self._lock:
            if self._open:
                self._landed.emit(job)

    def close(self) -> None:
        """Do nothing more, whatever is still asked."""
        with self._lock:
            self._open = False

    def _do(self, job: Callable[[], None]) -> None:
        if self._open:
            job()


class Executor(Protocol):
    """Has something done that may take a while."""

    def __call__(self, job: Callable[[], _Result], then: Callable[[_Result], None]) -> None:
        """Do ``job`` somewhere, and then, on the interface's thread, ``then`` with its result."""
        ...


class ThreadExecutor:
    """Does one job after another on a thread of its own.

    A fault in one is raised on the interface's thread.
    """

    def __init__(self, landing: MainThreadExecutor) -> None:
        """Results come back by this way."""
        self._landing = landing
        self._jobs: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self._thread = Thread(target=self._run, name="worker", daemon=True)
        self._thread.start()

    def __call__(self, job: Callable[[], _Result], then: Callable[[_Result], None]) -> None:
        """Do ``job`` when those before it are done, and then, on the interface's thread, ``then``."""
        self._jobs.put(partial(self._do, job, then))

    def close(self) -> None:
        """Begin no further job."""
        self._jobs.put(None)
        self._thread.join(END_S)

    def _run(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()

    def _do(self, job: Callable[[], _Result], then: Callable[[_Result], None]) -> None:
        try:
            result = job()
        except Exception as fault:  # noqa: BLE001 - whatever it is, it is raised where faults are seen
            self._landing(partial(_raise, fault))
        else:
            self._landing(partial(then, result))


class InlineExecutor:
    """Does every job on the spot: where time is virtual, nothing takes any."""

    def __call__(self, job: Callable[[], _Result], then: Callable[[_Result], None]) -> None:
        """Do ``job``, then ``then``."""
        then(job())

    def close(self) -> None:
        """Nothing is under way."""


def _raise(fault: Exception) -> None:
    raise fault


US_PER_MS = 1000


UNHEARD_BEATS = 2
"""A supervisor that was there and does not get so many beats in a row is gone."""


@contextmanager
def heartbeat(
    window: QQuickWindow,
    kiosk: KioskScreen,
    environment: Mapping[str, str] = os.environ,
    alone: Callable[[], None] = lambda: None,
) -> Iterator[None]:
    """Tell that the kiosk lives, for as long as its loop runs in here.

    ``alone`` is called once if the supervisor that heard it is gone.
    """
    if not {SOCKET, PIPE} & environment.keys():
        yield
        return
    notifier = Notifier(environment)
    beat = QTimer()
    beat.setInterval(int(environment.get(BEAT_WITHIN, 0)) // US_PER_MS // 2)
    presence = Presence(UNHEARD_BEATS)

    def tell_life() -> None:
        if presence.lost(heard=notifier.tell(WATCHDOG=1)):
            beat.stop()
            alone()

    beat.timeout.connect(tell_life)

    def tell_screen() -> None:
        notifier.tell(STATUS=kiosk.shown)

    def begin() -> None:
        presence.lost(heard=notifier.tell(READY=1, STATUS=kiosk.shown))
        if beat.interval():
            beat.start()

    after_first_frame(window, begin)
    kiosk.screen_changed.connect(tell_screen)
    try:
        yield
    finally:
        beat.stop()
        kiosk.screen_changed.disconnect(tell_screen)
        notifier.tell(STOPPING=1)
        notifier.close()


def after_first_frame(window: QQuickWindow, call: Callable[[], object]) -> None:
    """Call back once, in this thread, when a window has been drawn; the signal itself may come from another."""
    once = Qt.ConnectionType.QueuedConnection.value | Qt.ConnectionType.SingleShotConnection.value
    window.frameSwapped.connect(call, Qt.ConnectionType(once))
    window.update()


HEARTBEAT_MS = 250

Fault = Callable[[type[BaseException], BaseException, TracebackType | None], None]
"""Takes a fault of ours that came up in the loop."""


class EventLoop:
    """Runs the interface; on virtual time it lets time jump whenever the interface has nothing else to do."""

    def __init__(self, clock: Clock, owner: QObject, fault: Fault, beat: Callable[[], None] = lambda: None) -> None:
        """Call ``fault`` with every uncaught exception.

        ``beat`` is called out of the loop several times a second, and when the system asks for the end.
        """
        self.stop_requested = False
        """Whether the system asked the program to end; from then on nothing runs."""
        # A loop of our own: the application's asks every window first, and the window refuses everybody.
        self._loop = QEventLoop()
        self._clock = clock
        self._fault = fault
        self._beat = beat
        # Python runs now and then, or it would never see that the system asks it to end.
        self._heart = QTimer(owner)
        self._heart.timeout.connect(self._live)
        self._heart.start(HEARTBEAT_MS)
        self._signals_before = {
            ending: signal.signal(ending, lambda *_: self._end()) for ending in (signal.SIGINT, signal.SIGTERM)
        }

    def run(self) -> None:
        """Run until ``quit``, or not at all if the system has asked for the end.

        It may have asked while all this was built.
        """
        if self.stop_requested:
            return
        before, sys.excepthook = sys.excepthook, self._fault
        ticking = QTimer()
        if isinstance(self._clock, VirtualClock):
            ticking.timeout.connect(lambda jump=self._clock.jump: jump())
            ticking.start(0)
        # A program that has set objects aside itself does not get them back from us; one that has the collector off
        # while it loads has done so, and counting them would take a moment.
        gives_back = gc.isenabled() and gc.get_freeze_count() == 0
        if not isinstance(self._clock, VirtualClock):
            # What is there now stays for the day; walking all of it for garbage would cost the screen a frame or two.
            if gc.isenabled():
                gc.collect()
            gc.freeze()
        try:
            self._loop.exec()
        finally:
            if gives_back:
                gc.unfreeze()
            ticking.stop()
            sys.excepthook = before

    def quit(self) -> None:
        """End it, from within."""
        self._loop.quit()

    def close(self) -> None:
        """Give the system's requests back to their earlier handlers."""
        for ending, handler in self._signals_before.items():
            signal.signal(ending, handler)

    def _live(self) -> None:
        self._beat()
        # A loop that was told to end just before it began has not heard of it.
        if self.stop_requested:
            self.quit()

    def _end(self) -> None:
        self.stop_requested = True
        self._beat()
        self.quit()
