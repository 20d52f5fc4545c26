"""The experimenter's console: shortcuts, panel and maintenance, put together."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import asdict, replace
from datetime import datetime
from functools import partial
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QWindow
from PySide6.QtQuick import QQuickWindow

from kiosk import UserInputError, __version__
from kiosk.assistance.wording import Catalogue
from kiosk.experiment.alarms import Alarm, BoothSigns
from kiosk.experiment.booth_status import BoothStatus, DayCounts, utc
from kiosk.experiment.events import EmbodimentName, PauseEnded
from kiosk.experiment.experimenter import Action, ActionEffect, AuditEvent, permission, shortcuts
from kiosk.experiment.outcomes import SessionKind, Stage
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
from kiosk.ui.event_loop import Executor, TimerWait
from kiosk.ui.experimenter.actions import AUTOMATIC, LOUDNESS, ActionController, AuditLog, Services
from kiosk.ui.experimenter.alarms import AlarmBell, alarm_rows, alarm_status
from kiosk.ui.experimenter.authorisation import AuthorisationFlow, PinVerifier
from kiosk.ui.experimenter.maintenance import MaintenanceScheduler, MaintenanceTasks
from kiosk.ui.experimenter.status import (
    Clocks,
    Day,
    HealthInputs,
    HealthLine,
    NameCondition,
    StatusFile,
    booth_lines,
    condition_name,
    health_lines,
    health_parts,
    is_pack_changed,
    neutral_names,
    session_rows,
    shortcut_rows,
    today_rows,
    was_cut_off,
)
from kiosk.ui.experimenter.view_model import PanelScreen, Row
from kiosk.ui.renderer import SoundEffect
from kiosk.units import MS_PER_SECOND

_KEYS = (QEvent.Type.KeyPress, QEvent.Type.KeyRelease, QEvent.Type.ShortcutOverride)
_SIGNS_OF_LIFE = (
    QEvent.Type.KeyPress,
    QEvent.Type.MouseButtonPress,
    QEvent.Type.MouseMove,
    QEvent.Type.Wheel,
    QEvent.Type.TouchBegin,
)
_SHORTCUT = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier | Qt.KeyboardModifier.MetaModifier


class InputCapture(QObject):
    """Stands before the window as long as the experimenter is at something, and not a moment longer."""

    def __init__(
        self, window: QWindow, asking: AuthorisationFlow, stirred: Callable[[], None], parent: QObject
    ) -> None:
        """Call ``stirred`` at every sign of the experimenter's hand."""
        super().__init__(parent)
        self._window = window
        self._asking = asking
        self._stirred = stirred
        self._stands = False

    def set_enabled(self, stands: bool) -> None:  # noqa: FBT001 - it is what is set
        """Look at what comes to the window, or at nothing."""
        if stands is self._stands:
            return
        self._stands = stands
        if stands:
            self._window.installEventFilter(self)
        else:
            self._window.removeEventFilter(self)

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Take what is meant for the card; whether it was taken."""
        if event.type() in _SIGNS_OF_LIFE:
            self._stirred()
        if not self._asking.asks or event.type() not in _KEYS or not isinstance(event, QKeyEvent):
            return False
        if event.modifiers() & _SHORTCUT:
            return False
        # A key that is held down counts once, but for the one that deletes.
        once = not event.isAutoRepeat() or event.key() == Qt.Key.Key_Backspace
        if event.type() == QEvent.Type.KeyPress and once:
            self._take(event)
        event.accept()
        return True

    def _take(self, key: QKeyEvent) -> None:
        match key.key():
            case Qt.Key.Key_Escape:
                self._asking.cancel()
            case Qt.Key.Key_Backspace:
                self._asking.erase()
            case Qt.Key.Key_Return | Qt.Key.Key_Enter:
                self._asking.enter()
            case _ if key.text():
                self._asking.type(key.text())


LOOK_MS = 1_000
RECORDS_EVERY = 10
"""Among so many looks there is one at the records: while the panel is open, they change by its own actions alone."""

CLOSE_MS = 60_000
"""Without a hand on it for so long, the panel closes."""


class Panel:
    """The panel at work."""

    def __init__(  # noqa: PLR0913, PLR0917 - all that it shows
        self,
        screen: PanelScreen,
        booth: Services,
        actions: ActionController,
        asking: AuthorisationFlow,
        upkeep: MaintenanceScheduler,
        write: AuditLog,
        catalogue: Catalogue,
        state: Callable[[], HealthInputs],
        look: Callable[[Callable[[DashboardSnapshot | str], None]], None],
        stage: Callable[[], tuple[str, int]],
        now_ms: Callable[[], int],
    ) -> None:
        """``state`` tells how everything is now; ``look`` reads the records, and hands over what it found, soon.

        ``stage`` tells the stage, and since when; ``now_ms`` is the wall's clock.
        """
        self.changed: Callable[[], None] = lambda: None
        """Called when the panel comes or goes."""
        self.seen: Callable[[], None] = lambda: None
        """Called when the experimenter looks at it."""
        self._screen = screen
        self._booth = booth
        self._actions = actions
        self._asking = asking
        self._upkeep = upkeep
        self._write = write
        self._catalogue = catalogue
        self._state = state
        self._look = look
        self._stage = stage
        self._now_ms = now_ms
        self._named = False
        self._seen: DashboardSnapshot | None = None
        self._looking = False
        self._looks = 0
        self._unread = ""
        self._packs: frozenset[tuple[str, str]] = frozenset()
        self._stirred_at = 0
        self._tick: TimerWait | None = None
        self._worded = False
        """Whether its texts are set: that waits for the first time, as a start has none to spare."""
        screen.wished.connect(self._wish)
        actions.toggle_panel = self.toggle
        actions.changed = self._refresh
        upkeep.changed = self._refresh

    @property
    def is_open(self) -> bool:
        """Whether it is to be seen."""
        return self._screen.is_open

    def toggle(self) -> None:
        """Close it, or ask for the PIN and open it."""
        if self.is_open:
            self.close()
        else:
            self._asking.ask(permission(Action.PANEL, self._actions.stage).asks, lambda _: self._open())

    def close(self) -> None:
        """Leave it; from now on the PIN is asked for again."""
        if self._tick is not None:
            self._tick.cancel()
            self._tick = None
        self._asking.unlocked = False
        self._named = False
        self._asking.cancel()
        self._screen.open(False)  # noqa: FBT003 - it is what is set
        self._booth.screens.kiosk.step_back(False)  # noqa: FBT003 - it is what is set
        self._actions.panel_closed()
        self.changed()

    def stir(self) -> None:
        """Note that the experimenter is at the panel."""
        self._stirred_at = self._booth.clock.now_ms()

    def show_alarms(self, alarms: tuple[Alarm, ...]) -> None:
        """Show these alarms."""
        self._screen.show_alarms(alarm_rows(alarms, self._catalogue))

    def write_words(self) -> None:
        """Give the panel and the card's keys their fixed texts, once."""
        if not self._worded:
            self._worded = True
            told, keys = self._catalogue, self._booth.assigner.study.settings.shortcuts
            self._screen.set_language({name: told.text(name) for name in WORDS})
            self._screen.list_shortcuts(shortcut_rows(shortcuts(keys), told))

    def _open(self) -> None:
        self.write_words()
        self._write.record(AuditEvent.PANEL_OPENED, {"stage": self._actions.stage.value})
        self._asking.unlocked = True
        self._actions.panel_opened()
        self.stir()
        self._looks = 0
        self._booth.screens.kiosk.step_back(True)  # noqa: FBT003 - it is what is set
        # All that it shows is there before it comes.
        self._screen.show_choices(self._choices())
        self._show_records()
        self._screen.open(True)  # noqa: FBT003 - it is what is set
        self._see()
        self.seen()
        self.changed()

    def _wish(self, action: str, choice: str) -> None:
        if action == Action.PANEL.value:
            self.close()
        elif action == "names":
            self._named = not self._named
            self._screen.show_choices(self._choices())
            self._show_records()
        else:
            self._actions.request(action, choice)

    def _see(self) -> None:
        """Look at everything, and once more in a second."""
        if self._booth.clock.now_ms() - self._stirred_at >= CLOSE_MS:
            self.close()
            return
        if self._looks % RECORDS_EVERY == 0:
            self._refresh()
        else:
            self._show_health()
        self._looks += 1
        self._tick = self._booth.clock.after(LOOK_MS, self._see)

    def _refresh(self) -> None:
        """Look at everything, the records too."""
        if not self.is_open:
            return
        self._show_health()
        if not self._looking:
            self._looking = True
            self._look(self._have_looked)

    def _show_health(self) -> None:
        changed = is_pack_changed(self._booth.voice.pack, self._packs)
        state = replace(self._state(), pack_changed=changed)
        found = health_lines(state, self._catalogue)
        more = booth_lines(state, self._booth.assigner.study, self._catalogue)
        if self._unread:
            found = (*found, HealthLine(self._catalogue.text("console-database"), self._unread, is_ok=False))
        to_do = [line for line in (*found, *more) if not line.is_ok or line.is_due]
        self._screen.show_health(
            {
                # What is well but due stands last.
                "matters": [asdict(line) for line in sorted(to_do, key=lambda line: line.is_due)],
                "lines": [asdict(line) for line in found if line not in to_do],
                "more": [asdict(line) for line in more],
            }
        )
        self._show_today()
        self._screen.show_choices(self._choices())

    def _have_looked(self, seen: DashboardSnapshot | str) -> None:
        self._looking = False
        self._unread = seen if isinstance(seen, str) else ""
        if isinstance(seen, DashboardSnapshot):
            self._packs, self._seen = seen.packs, seen
            self._show_records()
            self._show_today()

    def _show_records(self) -> None:
        if self._seen is not None:
            rows = session_rows(self._seen, self._catalogue, self._name, played=self._under_way)
            self._screen.show_records(rows)

    def _show_today(self) -> None:
        now_ms = self._now_ms()
        stage, since_ms = self._stage()
        if self._seen is not None:
            now = datetime.fromtimestamp(now_ms / MS_PER_SECOND).astimezone()
            self._screen.show_today(
                today_rows(self._seen.today, self._seen.counts, (stage, now_ms - since_ms), now, self._catalogue)
            )

    @property
    def _name(self) -> NameCondition:
        """What conditions are called now: by letters, or by their names once that was asked for."""
        told = self._catalogue.text
        if self._named:
            return lambda condition: condition_name(condition, told)
        counted = self._seen.counts.cells if self._seen else ()
        return neutral_names((*self._actions.condition_choices, *counted), told)

    @property
    def _under_way(self) -> bool:
        return self._actions.stage not in (Stage.ATTRACT, Stage.OVER)

    def _session_words(self, *, stays_paused: bool) -> str:
        """Return whether a session is under way, and until when it is paused."""
        if not self._under_way:
            return self._catalogue.text("console-session-none")
        return self._catalogue.text("console-session-stays" if stays_paused else "console-session-paused")

    def _choices(self) -> Row:
        """Return what can be chosen, and what is chosen now."""
        booth, actions, told = self._booth, self._actions, self._catalogue.text
        under_way = self._under_way
        stays_paused = booth.runner.accepts(PauseEnded(at_ms=booth.runner.now_ms())) and not actions.paused_by_panel
        embodiments = booth.embodiments
        robot = next((str(name) for name in embodiments.health if name != EmbodimentName.AVATAR), "")
        return {
            "session": self._session_words(stays_paused=stays_paused),
            "underWay": under_way,
            "conditions": [
                {"value": each.name if each else AUTOMATIC, "label": self._name(each)}
                for each in actions.condition_choices
            ],
            "named": self._named,
            "condition": booth.assigner.chosen.name
            if booth.assigner.chosen and not booth.assigner.is_followed
            else AUTOMATIC,
            "embodiments": [
                {"value": robot, "label": told("console-robot")},
                {"value": str(EmbodimentName.AVATAR), "label": told("console-avatar")},
            ]
            if embodiments.has_robot
            else [],
            "embodiment": str(EmbodimentName.AVATAR) if embodiments.prefers_avatar else robot,
            "languages": [
                {"value": plan.language, "label": plan.catalogue.text("language-name")}
                for plan in booth.assigner.study.plans
            ],
            "language": booth.screens.attract.resting.language,
            "volumes": [{"value": str(volume), "label": f"{volume:.0%}"} for volume in LOUDNESS],
            "volume": str(min(LOUDNESS, key=lambda volume: abs(volume - actions.volume))),
            # Before the thanks it would do what ending the session does, which stands apart.
            "canBeNext": actions.stage in (Stage.THANKS, Stage.OVER)
            and permission(Action.NEXT, actions.stage).effect is not ActionEffect.REFUSED,
            "muted": embodiments.is_muted,
            "staysPaused": stays_paused,
            "breaks": [
                {"value": str(minutes), "label": told("console-break-minutes", minutes=minutes)}
                for minutes in actions.break_choices()
            ],
            "break": str(actions.break_minutes) if booth.screens.kiosk.back_at else "",
            "onBreak": booth.runner.is_on_break,
            "backup": copy_words(self._upkeep, self._catalogue),
        }


def copy_words(upkeep: MaintenanceScheduler, catalogue: Catalogue) -> str:
    """Return what becomes of a copy that was asked for; an empty text if none was."""
    if upkeep.busy:
        return catalogue.text("console-backup-busy")
    return catalogue.text("console-backup-waits") if upkeep.waits else ""


WORDS = (
    "console-title",
    "console-today",
    "console-next-page",
    "console-booth",
    "console-names-show",
    "console-names-hide",
    "console-test-the-voice",
    "console-close",
    "console-cancel",
    "console-key-delete",
    "console-key-enter",
    "console-alarms",
    "console-health",
    "console-shortcuts",
    "console-mark-well",
    "console-mark-idle",
    "console-mark-ill",
    "console-counts",
    "console-counts-unlisted",
    "console-counts-done",
    "console-counts-begun",
    "console-counts-dropped",
    "console-counts-overridden",
    "console-counts-beyond",
    "console-counts-withdrawn",
    "console-sessions",
    "console-sessions-none",
    "console-sessions-number",
    "console-sessions-begun",
    "console-sessions-condition",
    "console-sessions-stage",
    "console-sessions-status",
    "console-deviations",
    "console-deviations-none",
    "console-next-session",
    "console-condition",
    "console-embodiment",
    "console-language",
    "console-volume",
    "console-actions",
    "console-repeat",
    "console-mute",
    "console-heard",
    "console-stay-paused",
    "console-switch-on",
    "console-switch-off",
    "console-break",
    "console-break-end",
    "console-abort",
    "console-abort-then",
    "console-next",
    "console-resume",
    "console-backup",
    "console-quit",
    "console-keys",
)
"""Every message that the panel shows as it stands."""


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
