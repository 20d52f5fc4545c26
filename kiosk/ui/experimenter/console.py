"""The experimenter at one booth: shortcuts, card, panel, alarms and maintenance, put together."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from datetime import datetime
from functools import partial
from pathlib import Path

from PySide6.QtQuick import QQuickWindow

from kiosk import UserInputError, __version__
from kiosk.experiment.alarms import BoothSigns
from kiosk.experiment.booth_status import BoothStatus, DayCounts, utc
from kiosk.experiment.events import PauseEnded
from kiosk.experiment.experimenter import AuditEvent, shortcuts
from kiosk.experiment.outcomes import EmbodimentName, SessionKind
from kiosk.sd_notify import BEAT_WITHIN
from kiosk.store.snapshot import (
    DashboardSnapshot,
    last_written_ms,
    open_break,
    read_day,
    read_interrupted_session,
    read_snapshot,
    wrong_pins,
)
from kiosk.ui.event_loop import Executor
from kiosk.ui.experimenter.actions import ActionController, Services
from kiosk.ui.experimenter.alarms import AlarmBell, alarm_status
from kiosk.ui.experimenter.audit_log import AuditLog
from kiosk.ui.experimenter.authorisation import AuthorisationFlow, InputCapture, PinVerifier
from kiosk.ui.experimenter.health import Clocks, HealthInputs, health_parts
from kiosk.ui.experimenter.maintenance import MaintenanceScheduler, MaintenanceTasks
from kiosk.ui.experimenter.panel import Panel, copy_words
from kiosk.ui.experimenter.status_file import Day, StatusFile, was_cut_off
from kiosk.ui.renderer import SoundEffect
from kiosk.units import MS_PER_SECOND


def wall_ms() -> int:
    """Return the wall's clock, in ms since 1970."""
    return time.time_ns() // 1_000_000


class ExperimenterConsole:
    """The experimenter at one booth."""

    def __init__(
        self, booth: Services, window: QQuickWindow, work: Executor, slow: Executor, now_ms: Callable[[], int] = wall_ms
    ) -> None:
        """``work`` does what takes milliseconds, ``slow`` what takes seconds; ``now_ms`` is the wall's clock."""
        self.remote_trouble: Callable[[], str | None] = lambda: None
        """Tells why the status is not published; empty if it is, None if that is switched off."""
        study = booth.assigner.study
        settings = study.settings
        catalogue = study.plans[0].catalogue
        screen = booth.screens.experimenter
        card, note, panel = screen.parts
        folder = booth.recorder.folder
        self._booth = booth
        self._catalogue = catalogue
        self._window = window
        self._now_ms = now_ms
        self._began_ms, self._run_from_ms = now_ms(), booth.clock.now_ms()
        self._written_ms = last_written_ms(folder)
        self._kind = booth.assigner.kind
        self._write = AuditLog(booth.recorder, booth.clock)
        self._lock = PinVerifier(
            settings.experimenter.pin_hash, wrong_pins(folder), booth.clock.now_ms, work, self._write.record
        )
        self._asking = AuthorisationFlow(card, self._lock, booth.clock, catalogue)
        self.upkeep = MaintenanceScheduler(
            MaintenanceTasks.of(folder, settings.experimenter.backups, settings.experimenter.backup_every),
            settings.experimenter.backup_every,
            booth.clock,
            now_ms,
            slow,
            self._write.record,
            lambda: self.actions.resting,
            booth.runner.set_closed,
        )
        self.actions = ActionController(booth, self._asking, note, self._write, self.upkeep, catalogue)
        look = partial(_look, folder, now_ms, kind=self._kind)
        self.panel = Panel(
            panel,
            booth,
            self.actions,
            self._asking,
            self.upkeep,
            self._write,
            catalogue,
            self._state,
            lambda then: work(look, then),
            self._stage_now,
            now_ms,
        )
        self._keyboard = InputCapture(window, self._asking, self.panel.stir, screen)
        self._asking.changed = self.panel.changed = self._stand_by
        self._stage_since = ("", now_ms())
        self._backup_ms = now_ms()
        self._cut_off = was_cut_off(folder)
        self._alone_from_ms = booth.clock.now_ms()
        self.alarms = AlarmBell(
            settings.experimenter,
            self._signs,
            lambda: self.actions.resting,
            self._sound_alarm,
            booth.clock,
            now_ms,
        )
        self.panel.seen = self.alarms.see
        self.alarms.changed = self._alarms_changed
        self.status_file = StatusFile(
            folder,
            self._booth_status,
            lambda: _read_day(folder, now_ms, kind=self._kind),
            booth.clock,
            work,
        )
        screen.listen_for(
            {action.value: shortcut for action, shortcut in shortcuts(settings.shortcuts).items()},
            corner=settings.experimenter.hold_corner,
        )
        screen.pressed.connect(self._pressed)
        screen.held.connect(self._held)
        booth.voice.health_changed.connect(self._voice_changed)
        booth.embodiments.on_own_voice = self._robot_uses_own_voice
        booth.embodiments.on_other_voice = self._robot_has_other_voice
        left = open_break(folder, now_ms())
        if left is not None:
            self.actions.resume_break(left)

    def close(self) -> None:
        """Listen no more, and write down what is left to be."""
        self.alarms.close()
        self.status_file.close()
        self._keyboard.set_enabled(False)
        self._write.close()

    def _pressed(self, action: str) -> None:
        self._asking.by_touch = False
        self.actions.press(action)

    def _held(self) -> None:
        """Ask for the PIN with keys on the screen, unless something is asked for or shown already."""
        if not self.panel.is_open and not self._asking.asks:
            self._asking.by_touch = True
            self.panel.write_words()
            self.panel.toggle()

    def _voice_changed(self, is_heard: bool, message: str) -> None:  # noqa: FBT001 - Qt's way to tell
        """Write down that sentences are not heard any more, or are again."""
        self._write.record(AuditEvent.VOICE_CHANGED, {"is_heard": is_heard, "message": message})

    def _robot_uses_own_voice(self, why: str) -> None:
        """Write down that the robot does not sound like the avatar any more."""
        self._write.record(AuditEvent.VOICE_CHANGED, {"is_heard": True, "message": f"the robot's own: {why}"})

    def _robot_has_other_voice(self, why: str) -> None:
        """Write down that the robot's voice is not the one that the study means."""
        self._write.record(AuditEvent.VOICE_CHANGED, {"is_heard": True, "message": f"the robot: {why}"})

    def _stand_by(self) -> None:
        self._keyboard.set_enabled(self._asking.asks or self.panel.is_open)

    def _sound_alarm(self) -> None:
        if not self._booth.embodiments.is_silent:
            self._booth.voice.play(SoundEffect.ALARM.file)

    def _alarms_changed(self) -> None:
        """Show a mark without words on the visitor's screen, and the words in the panel."""
        self._booth.screens.experimenter.call(calls=self.alarms.calls)
        self.panel.show_alarms(self.alarms.alarms)

    def _signs(self) -> BoothSigns:
        """Return what alarms follow from."""
        booth, state = self._booth, self._state()
        run_ms = booth.clock.now_ms()
        if not self.actions.resting:
            self._alone_from_ms = run_ms
        if state.last_backup and state.last_backup.file:
            self._backup_ms = state.last_backup.at_ms
        return BoothSigns(
            now=datetime.fromtimestamp(self._now_ms() / MS_PER_SECOND).astimezone(),
            robot_well=state.robot is None or state.robot.is_ok,
            voice_well=state.voice.is_ok or state.muted,
            disk_free_mib=state.free_space.free_mib if state.free_space else None,
            disk_hour_mib=state.free_space.hour_mib if state.free_space else 0,
            clock_jump_ms=state.clocks.wrong_ms,
            since_backup_ms=self._now_ms() - self._backup_ms,
            ended=[ended.status for ended in self.status_file.day[1]],
            restarted=self._cut_off,
            alone_ms=run_ms - self._alone_from_ms,
        )

    def _booth_status(self) -> BoothStatus:
        """Return what status.json says, but for the day's sessions."""
        study = self._booth.assigner.study
        state = self._state()
        stage, since_ms = self._stage_now()
        backup = state.last_backup
        return BoothStatus(
            at=utc(self._now_ms()),
            started_at=utc(self._began_ms),
            version=__version__,
            pid=os.getpid(),
            site=self._booth.recorder.site,
            study=study.settings.title,
            study_sha256=study.sha256,
            kind=self._kind.name.lower(),
            stage=stage,
            stage_since=utc(since_ms),
            paused=self._booth.runner.accepts(PauseEnded(at_ms=self._booth.runner.now_ms())),
            supervised=state.supervised,
            today=DayCounts(),
            ended=(),
            parts=tuple(health_parts(state, self._catalogue)),
            disk_free_mib=state.free_space.free_mib if state.free_space else None,
            last_backup_at=utc(backup.at_ms) if backup and backup.file else None,
            alarms=alarm_status(self.alarms.alarms),
        )

    def _stage_now(self) -> tuple[str, int]:
        """Return the stage, and since when it has been seen, in ms since 1970."""
        stage = self.actions.stage.value
        if stage != self._stage_since[0]:
            self._stage_since = (stage, self._now_ms())
        return self._stage_since

    def _state(self) -> HealthInputs:
        """How everything is now."""
        booth = self._booth
        robot = next(
            (health for name, health in booth.embodiments.health.items() if name != EmbodimentName.AVATAR), None
        )
        width, height = self._window.width(), self._window.height()
        held = booth.window_health()
        return HealthInputs(
            robot=robot,
            voice=booth.voice.health,
            muted=booth.embodiments.is_muted,
            free_space=self.upkeep.free_space,
            last_backup=self.upkeep.last_backup,
            copy=copy_words(self.upkeep, self._catalogue),
            audit_error=self._write.error,
            clocks=Clocks(self._now_ms(), self._began_ms, booth.clock.now_ms() - self._run_from_ms, self._written_ms),
            has_pin=self._lock.has_pin,
            screen="; ".join((f"{width} x {height}", *(health.message for health in held))),
            screen_well=all(health.is_ok for health in held),
            supervised=BEAT_WITHIN in os.environ,
            remote=self.remote_trouble(),
        )


def read_for(work: Executor, folder: Path) -> Callable[..., None]:
    """How a session that was cut off is read, elsewhere."""
    return lambda number, then: work(partial(read_interrupted_session, folder, number), then)


def _read_day(folder: Path, now_ms: Callable[[], int], *, kind: SessionKind) -> Day:
    """Return the sessions of today; none if they cannot be read, which the console says elsewhere."""
    try:
        return read_day(folder, datetime.fromtimestamp(now_ms() / MS_PER_SECOND).astimezone(), kind=kind)
    except UserInputError:
        return DayCounts(), ()


def _look(folder: Path, now_ms: Callable[[], int], *, kind: SessionKind) -> DashboardSnapshot | str:
    """Return the records since this morning, or why they cannot be read."""
    try:
        return read_snapshot(folder, datetime.fromtimestamp(now_ms() / MS_PER_SECOND).astimezone(), kind=kind)
    except UserInputError as failure:
        return str(failure)
