"""Does what the experimenter asks for, if the table of actions lets it: asked for, then written down, then done."""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable, Mapping
from datetime import UTC, datetime, timedelta
from functools import partial
from typing import Any

from kiosk import StorageError, UserInputError
from kiosk.assistance.wording import Catalogue
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.experimenter import Action, ActionEffect, AuditEvent, DeviationReason, condition_cycle, permission
from kiosk.experiment.outcomes import EmbodimentName, Stage
from kiosk.experiment.transitions import InvalidTransition
from kiosk.lazy_dataclass import dataclass
from kiosk.robots.embodiment import Health
from kiosk.robots.selector import EmbodimentSelector
from kiosk.store.recorder import Recorder, StoreBusy
from kiosk.store.snapshot import InterruptedSession, OpenBreak, UnreadableSession
from kiosk.ui.condition_assigner import ConditionAssigner
from kiosk.ui.event_loop import Clock, TimerWait
from kiosk.ui.experimenter.audit_log import AuditLog
from kiosk.ui.experimenter.authorisation import AuthorisationFlow
from kiosk.ui.experimenter.maintenance import MaintenanceScheduler
from kiosk.ui.experimenter.view_model import NoteScreen
from kiosk.ui.recording import BusyWait
from kiosk.ui.screens.registry import ScreenSet
from kiosk.ui.session_runner import SessionRunner
from kiosk.ui.voice import Voice
from kiosk.units import MS_PER_MINUTE, MS_PER_SECOND

NOTE_MS = 2_000
"""How long a note stays; as long the condition's shortcut goes on without asking anew."""

BREAKS = (5, 10, 15, 30)
"""How long a break can be said to last, in minutes."""
TEST_SENTENCE = 0
"""The number of a sentence that belongs to no session; those of sessions count from 1."""

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Services:
    """Everything that actions are done to."""

    runner: SessionRunner
    assigner: ConditionAssigner
    embodiments: EmbodimentSelector
    voice: Voice
    recorder: Recorder
    screens: ScreenSet
    clock: Clock
    read_cut_off: Callable[[int, Callable[[InterruptedSession | UnreadableSession], None]], None]
    """Reads a session that was cut off, and hands it over soon."""
    window_health: Callable[[], tuple[Health, ...]]
    leave: Callable[[], None]


LOUDNESS = (0.2, 0.4, 0.6, 0.8, 1.0)
"""The volumes to choose from."""


class ActionController:
    """Does the experimenter's actions: notes, choices, pauses and the end of sessions."""

    def __init__(  # noqa: PLR0913, PLR0917 - whom it has to do with
        self,
        booth: Services,
        asking: AuthorisationFlow,
        note: NoteScreen,
        write: AuditLog,
        upkeep: MaintenanceScheduler,
        catalogue: Catalogue,
    ) -> None:
        """Do nothing yet; ``toggle_panel`` opens or closes the panel."""
        self.toggle_panel: Callable[[], None] = lambda: None
        self.changed: Callable[[], None] = lambda: None
        """Called when what can be chosen looks different."""
        self.volume = booth.assigner.study.settings.voice.volume
        self.paused_by_panel = False
        """Whether the session goes on when the panel is closed."""
        self.break_minutes = 0
        """How long the break was to last that was chosen last."""
        self._booth = booth
        self._asking = asking
        self._note = note
        self._write = write
        self._upkeep = upkeep
        self._text = catalogue.text
        settings = booth.assigner.study.settings
        self._turn = condition_cycle(settings.randomisation.target_n, settings.all_conditions)
        self._acts: deque[Callable[[], None]] = deque()
        self._acting = False
        self._busy = BusyWait(booth.clock, booth.recorder.wait_ms, self._tell_busy)
        self._turning_for: str | None = None
        self._note_away: TimerWait | None = None
        booth.runner.on_session_started = self._begun
        booth.runner.on_idle = self._rested

    @property
    def stage(self) -> Stage:
        """The stage that the booth is in; over while the error screen is up."""
        runner = self._booth.runner
        return Stage.OVER if runner.is_blocked else runner.stage

    @property
    def condition_choices(self) -> tuple[Condition | None, ...]:
        """What can be chosen as the next condition, the list's (None) first."""
        return self._turn

    def press(self, name: str) -> None:
        """Handle a pressed shortcut."""
        action = Action(name)
        if action is Action.CONDITION and self._turning_for is not None:
            self._choose_next_in_turn(self._turning_for)
        elif action is Action.PANEL:
            self.toggle_panel()
        else:
            self.request(name, "")

    def request(self, name: str, choice: str) -> None:
        """Something is to be done; without a choice the next one in turn."""
        action = Action(name)
        held = permission(action, self.stage)
        if held.effect is ActionEffect.REFUSED:
            self.tell("console-not-now")
        else:
            self._asking.ask(held.asks, partial(self._do, action, choice))

    def tell(self, message: str, **variables: str | int) -> None:
        """Show a few words at the screen's edge for a moment."""
        self._note.tell(self._text(message, **variables))
        self._keep_note()

    def _do(self, action: Action, choice: str, reason: str) -> None:
        act = partial(self._do_now, action, choice, reason)
        if action is Action.QUIT:
            # Nothing that waits for the database keeps anybody here.
            act()
        else:
            self._in_turn(act)

    def _in_turn(self, act: Callable[[], None]) -> None:
        """Do something that is written down first, after what still waits for the database."""
        self._acts.append(act)
        if not self._acting and not self._busy.under_way:
            self._act()

    def _act(self) -> None:
        self._acting = True
        try:
            while self._acts:
                act = self._acts.popleft()
                try:
                    act()
                except StoreBusy as busy:
                    # It was to be written down before it is done, so nothing is done yet.
                    if self._try_again(act, busy):
                        return
                else:
                    self._busy.end()
        finally:
            self._acting = False

    def _try_again(self, act: Callable[[], None], busy: StoreBusy) -> bool:
        """Whether there is still patience."""
        try:
            self._busy.try_again(self._act, busy)
        except StorageError as failure:
            self._not_written(failure)
            return False
        self._acts.appendleft(act)
        return True

    def _tell_busy(self, waits: bool) -> None:  # noqa: FBT001 - it is what is shown
        if waits:
            self.tell("console-busy")

    def _do_now(self, action: Action, choice: str, reason: str) -> None:
        # Since it was asked for, the session has gone on.
        if permission(action, self.stage).effect is ActionEffect.REFUSED:
            self.tell("console-not-now")
            return
        {
            Action.CONDITION: self._condition,
            Action.EMBODIMENT: self._body,
            Action.REPEAT: self._again,
            Action.MUTE: self._quiet,
            Action.PAUSE: self._pause,
            Action.BREAK: self._break,
            Action.ABORT: self._end,
            Action.NEXT: self._next,
            Action.RESUME: self._resume,
            Action.LANGUAGE: self._language,
            Action.VOLUME: self._set_volume,
            Action.BACKUP: self._backup,
            Action.TEST_VOICE: self._test_voice,
            Action.QUIT: self._leave,
        }[action](choice, reason)
        self.changed()

    # What holds from the next session on

    def _condition(self, choice: str, reason: str) -> None:
        if not choice:
            self._choose_next_in_turn(reason)
        else:
            self._choose(None if choice == AUTOMATIC else Condition(choice), reason)

    def _choose_next_in_turn(self, reason: str) -> None:
        at = self._turn.index(self._booth.assigner.chosen)
        self._choose(self._turn[(at + 1) % len(self._turn)], reason)
        self._turning_for = reason

    def _choose(self, condition: Condition | None, reason: str) -> None:
        try:
            self._booth.assigner.choose(condition, reason)
        except StoreBusy:
            raise
        except StorageError as failure:
            self._not_written(failure)
            return
        # Never a name: the participant may be looking.
        self._note.point(self._turn.index(condition), len(self._turn))
        self._keep_note()
        self.changed()

    def _body(self, choice: str, reason: str) -> None:
        embodiments = self._booth.embodiments
        if not embodiments.has_robot:
            self.tell("console-robot-none")
            return
        robot = next(name for name in embodiments.health if name != EmbodimentName.AVATAR)
        to_avatar = choice == str(EmbodimentName.AVATAR) if choice else not embodiments.prefers_avatar
        name = EmbodimentName.AVATAR if to_avatar else robot
        if self._written(AuditEvent.EMBODIMENT_CHOSEN, {"embodiment": str(name), "reason": reason}):
            embodiments.prefer(name)
            self.tell("console-next-avatar" if to_avatar else "console-next-robot")

    def _language(self, choice: str, reason: str) -> None:
        if self._written(AuditEvent.LANGUAGE_CHOSEN, {"language": choice, "reason": reason}):
            screens = self._booth.screens
            screens.attract.rest_in(choice)
            if self.resting:
                screens.clear()
            self.tell("console-done")

    def _set_volume(self, choice: str, _reason: str) -> None:
        """Set the volume; without a choice one step louder, and after the loudest the softest."""
        louder = next((volume for volume in LOUDNESS if volume > self.volume), LOUDNESS[0])
        volume = float(choice) if choice else louder
        if self._written(AuditEvent.VOLUME_CHANGED, {"volume": volume}):
            self.volume = volume
            self._booth.voice.set_volume(volume)
            if not choice:
                self.tell("console-volume-is", percent=round(100 * volume))

    # What holds at once

    def _again(self, _choice: str, _reason: str) -> None:
        self._dispatch(happened.RepeatRequested(at_ms=self._booth.runner.now_ms()))

    def _quiet(self, _choice: str, _reason: str) -> None:
        embodiments = self._booth.embodiments
        muted = not embodiments.is_muted
        if not self._written(AuditEvent.MUTE_CHANGED, {"muted": muted}):
            return
        runner = self._booth.runner
        runner.dispatch(happened.MuteChanged(at_ms=runner.now_ms(), muted=muted))
        if muted:
            embodiments.mute()
        else:
            embodiments.unmute()
        self.tell("console-mute-on" if muted else "console-mute-off")

    def _pause(self, _choice: str, _reason: str) -> None:
        runner = self._booth.runner
        pause = happened.PauseRequested(at_ms=runner.now_ms())
        if runner.accepts(pause):
            runner.dispatch(pause)
        elif self._panel_is_open:
            # It stays as it is as long as the panel is open; what changes is what comes after.
            self.paused_by_panel = not self.paused_by_panel
            if self.paused_by_panel:
                self._booth.screens.kiosk.come_back_at("")
        else:
            self._dispatch(happened.PauseEnded(at_ms=runner.now_ms()))

    def _break(self, choice: str, _reason: str) -> None:
        """Show when the people at the table are back, in so many minutes; without a choice the break ends."""
        runner, minutes = self._booth.runner, int(choice or 0)
        back = (datetime.now(UTC) + timedelta(minutes=minutes)).astimezone()
        if self.resting:
            # A session records its pauses itself. Between sessions, this tells a kiosk that starts again.
            began = {"minutes": minutes, "back_ms": int(back.timestamp() * MS_PER_SECOND)}
            if not self._written(*((AuditEvent.BREAK_BEGAN, began) if choice else (AuditEvent.BREAK_ENDED, {}))):
                return
            runner.set_break(taken=bool(choice))
        else:
            # The open panel pauses the session already.
            pause = happened.PauseRequested(at_ms=runner.now_ms())
            if runner.accepts(pause):
                runner.dispatch(pause)
            self.paused_by_panel = not choice
        self._show_break(minutes, back)

    def resume_break(self, left: OpenBreak) -> None:
        """Go on with a break that was under way when the kiosk failed."""
        self._booth.runner.set_break(taken=True)
        self._show_break(left.minutes, datetime.fromtimestamp(left.back_ms / MS_PER_SECOND).astimezone())

    def _show_break(self, minutes: int, back: datetime) -> None:
        self.break_minutes = minutes
        self._booth.screens.kiosk.come_back_at(f"{back:%H:%M}" if minutes else "")

    def break_choices(self) -> tuple[int, ...]:
        """Return the lengths of a break that can be chosen now, in minutes; a session ends after its longest pause."""
        longest_ms = self._booth.assigner.study.settings.idle_ms.pause
        return tuple(each for each in BREAKS if self.resting or each * MS_PER_MINUTE <= longest_ms)

    def _end(self, _choice: str, reason: str) -> None:
        # What was typed of a visitor stands with their session alone, and goes with it, or was never to be kept.
        kind = DeviationReason.without_words(reason)
        if self._written(AuditEvent.SESSION_ABORTED, {"stage": self.stage.value, "reason": kind}):
            runner = self._booth.runner
            runner.dispatch(happened.AbortRequested(at_ms=runner.now_ms(), reason=reason))

    def _next(self, _choice: str, reason: str) -> None:
        match self.stage:
            case Stage.OVER if self._booth.runner.is_on_break:
                self._break("", reason)
            case Stage.OVER:
                self._booth.runner.go_on()
            case Stage.THANKS:
                runner = self._booth.runner
                runner.dispatch(happened.NextParticipantRequested(at_ms=runner.now_ms()))
            case _:
                self._end("", reason)

    def _resume(self, choice: str, reason: str) -> None:
        self._booth.read_cut_off(int(choice), partial(self._go_on_with, reason))

    def _go_on_with(self, reason: str, found: InterruptedSession | UnreadableSession) -> None:
        self._in_turn(partial(self._go_on_now, reason, found))

    def _go_on_now(self, reason: str, found: InterruptedSession | UnreadableSession) -> None:
        if isinstance(found, UnreadableSession):
            self.tell("console-cannot-resume", why=found.why)
            return
        if permission(Action.RESUME, self.stage).effect is ActionEffect.REFUSED:
            self.tell("console-not-now")
            return
        noted = partial(self._written, AuditEvent.SESSION_RESUMED, {"session": found.number, "reason": reason})
        try:
            self._booth.runner.resume(found.session, found.number, found.past, noted)
        except StoreBusy:
            raise
        except (UserInputError, InvalidTransition, StorageError) as failure:
            self.tell("console-cannot-resume", why=str(failure))
        else:
            self._hold_for_panel()
        self.changed()

    def _backup(self, _choice: str, _reason: str) -> None:
        self._upkeep.back_up()

    def _test_voice(self, _choice: str, _reason: str) -> None:
        voice = self._booth.voice
        voice.set_language(self._booth.assigner.study.languages[0])
        voice.say(TEST_SENTENCE, self._text("console-test-sentence"))

    def _leave(self, _choice: str, reason: str) -> None:
        # The experimenter can leave even when the disk takes nothing.
        self._write.record(AuditEvent.APPLICATION_QUIT, {"stage": self.stage.value, "reason": reason})
        self._booth.leave()

    # The panel

    def panel_opened(self) -> None:
        """Stop the session that is under way, for as long as the panel is open."""
        self._panel_is_open = True
        self.paused_by_panel = False
        self._hold_for_panel()

    def panel_closed(self) -> None:
        """Let the session go on, unless it was stopped before or is to stay so."""
        self._panel_is_open = False
        paused, self.paused_by_panel = self.paused_by_panel, False
        runner = self._booth.runner
        go_on = happened.PauseEnded(at_ms=runner.now_ms())
        if paused and runner.accepts(go_on):
            runner.dispatch(go_on)

    _panel_is_open = False

    def _hold_for_panel(self) -> None:
        runner = self._booth.runner
        pause = happened.PauseRequested(at_ms=runner.now_ms())
        if self._panel_is_open and runner.accepts(pause):
            self.paused_by_panel = True
            runner.dispatch(pause)

    @property
    def resting(self) -> bool:
        """Whether no session is under way."""
        return self.stage in (Stage.ATTRACT, Stage.OVER)

    def _begun(self) -> None:
        """Record that a session begins in silence."""
        if self._booth.embodiments.is_muted:
            runner = self._booth.runner
            runner.dispatch(happened.MuteChanged(at_ms=runner.now_ms(), muted=True))
        self.changed()

    def _rested(self) -> None:
        """Do what has waited for the end of a session."""
        self.paused_by_panel = False
        self._booth.voice.set_volume(self.volume)
        self._upkeep.on_idle()
        self.changed()

    def _dispatch(self, event: happened.WorldEvent) -> None:
        runner = self._booth.runner
        if runner.accepts(event):
            runner.dispatch(event)
        else:
            self.tell("console-not-now")

    def _written(self, note: AuditEvent, payload: Mapping[str, Any]) -> bool:
        """Write it down before it is done; what cannot be written is not done."""
        if self._write(note, payload):
            return True
        self.tell("console-not-written")
        return False

    def _not_written(self, failure: StorageError) -> None:
        _log.error("%s", failure)
        self._write.error = str(failure)
        self.tell("console-not-written")

    def _keep_note(self) -> None:
        self._turning_for = None
        if self._note_away is not None:
            self._note_away.cancel()
        self._note_away = self._booth.clock.after(NOTE_MS, self._take_note_away)

    def _take_note_away(self) -> None:
        self._turning_for = None
        self._note.hide()


AUTOMATIC = "automatic"
"""What the list's condition is called where the others go by name."""
