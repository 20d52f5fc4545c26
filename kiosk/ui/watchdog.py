"""Tells whoever keeps the kiosk up that it is alive: from the interface's own event loop, so that a hang is silence.

With NOTIFY_SOCKET in the environment (systemd's or the keeper's, see kiosk/keeping/notice.py) it tells READY after the
first frame, WATCHDOG at half of WATCHDOG_USEC, STATUS with the screen that is shown, and STOPPING; without it, nothing.
WATCHDOG_PID is not looked at: under cage it is cage's, not ours.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

from PySide6.QtCore import Qt, QTimer
from PySide6.QtQuick import QQuickWindow

from kiosk.keeping.notice import BEAT_WITHIN, PIPE, SOCKET, Notifier
from kiosk.ui.screens.plain import KioskScreen

US_PER_MS = 1000


@contextmanager
def watched(window: QQuickWindow, kiosk: KioskScreen, environment: Mapping[str, str] = os.environ) -> Iterator[None]:
    """Tell that the kiosk lives, for as long as its loop runs in here."""
    if not {SOCKET, PIPE} & environment.keys():
        yield
        return
    notifier = Notifier(environment)
    beat = QTimer()
    beat.setInterval(int(environment.get(BEAT_WITHIN, 0)) // US_PER_MS // 2)
    beat.timeout.connect(lambda: notifier.tell(WATCHDOG=1))

    def tell_screen() -> None:
        notifier.tell(STATUS=kiosk.shown)

    def begin() -> None:
        notifier.tell(READY=1, STATUS=kiosk.shown)
        if beat.interval():
            beat.start()

    after_first_frame(window, begin)
    kiosk.unsettled.connect(tell_screen)
    try:
        yield
    finally:
        beat.stop()
        kiosk.unsettled.disconnect(tell_screen)
        notifier.tell(STOPPING=1)
        notifier.close()


def after_first_frame(window: QQuickWindow, call: Callable[[], object]) -> None:
    """Call back once, in this thread, when a window has been drawn; the signal itself may come from another."""
    once = Qt.ConnectionType.QueuedConnection.value | Qt.ConnectionType.SingleShotConnection.value
    window.frameSwapped.connect(call, Qt.ConnectionType(once))
    window.update()
