"""The experimenter's side, put together: card, keyboard, deeds, upkeep and panel of one kiosk."""

from __future__ import annotations

import time
from collections.abc import Callable
from datetime import datetime
from functools import partial
from pathlib import Path

from PySide6.QtQuick import QQuickWindow

from kiosk import BadInput
from kiosk.store.cut_off import read_cut_off
from kiosk.store.glance import Glance, glance, last_written_ms, wrong_pins
from kiosk.study.booth.chords import chords
from kiosk.study.events import BodyName
from kiosk.study.session_kind import SessionKind
from kiosk.ui.panel.asking import Asking
from kiosk.ui.panel.deeds import Booth, Deeds, Writing
from kiosk.ui.panel.health import Clocks, State
from kiosk.ui.panel.keyboard import Keyboard
from kiosk.ui.panel.lock import Lock
from kiosk.ui.panel.panel import Panel
from kiosk.ui.panel.upkeep import Care, Upkeep
from kiosk.ui.work import Work
from kiosk.units import MS_PER_SECOND


def wall_ms() -> int:
    """The wall's clock, in ms since 1970."""
    return time.time_ns() // 1_000_000


class Experimenter:
    """The experimenter at one booth."""

    def __init__(
        self, booth: Booth, window: QQuickWindow, work: Work, slow: Work, now_ms: Callable[[], int] = wall_ms
    ) -> None:
        """``work`` does what takes milliseconds, ``slow`` what takes seconds; ``now_ms`` is the wall's clock."""
        study = booth.desk.study
        settings = study.settings
        catalogue = study.plans[0].catalogue
        screen = booth.screens.experimenter
        card, note, panel = screen.parts
        folder = booth.recorder.folder
        self._booth = booth
        self._window = window
        self._now_ms = now_ms
        self._began_ms, self._run_from_ms = now_ms(), booth.clock.now_ms()
        self._written_ms = last_written_ms(folder)
        self._kind = booth.desk.kind
        self._write = Writing(booth.recorder, booth.clock)
        self._lock = Lock(settings.experimenter.pin, wrong_pins(folder), now_ms, work, self._write.keep)
        self._asking = Asking(card, self._lock, booth.clock, catalogue)
        self.upkeep = Upkeep(
            Care.of(folder, settings.experimenter.backups),
            settings.experimenter.backup_every,
            booth.clock,
            now_ms,
            slow,
            self._write.keep,
            lambda: self.deeds.resting,
            booth.conductor.shut,
        )
        self.deeds = Deeds(booth, self._asking, note, self._write, self.upkeep, catalogue)
        look = partial(_look, folder, simulated=self._kind)
        self.panel = Panel(
            panel,
            booth,
            self.deeds,
            self._asking,
            self.upkeep,
            self._write,
            catalogue,
            self._state,
            lambda then: work(look, then),
        )
        self._keyboard = Keyboard(window, self._asking, self.panel.stir, screen)
        self._asking.changed = self.panel.changed = self._stand_by
        screen.listen_for({deed.value: chord for deed, chord in chords(settings.keys).items()})
        screen.pressed.connect(self.deeds.press)

    def close(self) -> None:
        """Listen no more, and write down what is left to be."""
        self._keyboard.stand(False)  # noqa: FBT003 - it is what is set
        self._write.close()

    def _stand_by(self) -> None:
        self._keyboard.stand(self._asking.asks or self.panel.is_open)

    def _state(self) -> State:
        """How everything is now."""
        booth = self._booth
        robot = next((health for name, health in booth.bodies.health.items() if name is not BodyName.AVATAR), None)
        width, height = self._window.width(), self._window.height()
        held = booth.window_health()
        return State(
            robot=robot,
            voice=booth.voice.health,
            quiet=booth.bodies.is_quiet,
            room=self.upkeep.room,
            copied=self.upkeep.copied,
            trouble=self._write.trouble,
            clocks=Clocks(self._now_ms(), self._began_ms, booth.clock.now_ms() - self._run_from_ms, self._written_ms),
            has_pin=self._lock.has_pin,
            screen="; ".join((f"{width} x {height}", *(health.words for health in held))),
            screen_well=all(health.well for health in held),
        )


def read_for(work: Work, folder: Path) -> Callable[..., None]:
    """How a sitting that was cut off is read, elsewhere."""
    return lambda number, then: work(partial(read_cut_off, folder, number), then)


def _look(folder: Path, *, simulated: SessionKind) -> Glance | str:
    """The records since this morning, or why they cannot be read."""
    today = datetime.now().astimezone().replace(hour=0, minute=0, second=0, microsecond=0)
    try:
        return glance(folder, int(today.timestamp() * MS_PER_SECOND), simulated=simulated)
    except BadInput as failure:
        return str(failure)
