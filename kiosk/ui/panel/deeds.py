"""Does what the experimenter asks for, if the table of deeds lets it: asked for, then written down, then done."""

from __future__ import annotations

import logging
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from kiosk import BadInput, StoreFailed
from kiosk.assistant.wording import Catalogue
from kiosk.robot.bodies import Bodies
from kiosk.robot.body import Health
from kiosk.store.cut_off import CutOff, Unreadable
from kiosk.store.recorder import Recorder, StoreBusy
from kiosk.study import events as happened
from kiosk.study.booth.deeds import Deed, Effect, Reason, in_turn, rule
from kiosk.study.booth.notes import Note
from kiosk.study.condition import Condition
from kiosk.study.events import BodyName, Stage
from kiosk.study.stages import UnexpectedEvent
from kiosk.ui.clock import Clock, Wait
from kiosk.ui.conductor import Conductor
from kiosk.ui.desk import Desk
from kiosk.ui.panel.asking import Asking
from kiosk.ui.panel.card import NoteScreen
from kiosk.ui.panel.upkeep import Upkeep
from kiosk.ui.screens.every import Screens
from kiosk.ui.voice import Voice
from kiosk.ui.waiting import BusyWait

NOTE_MS = 2_000
"""How long a note stays; as long the condition's chord goes on without asking anew."""

KEPT_RETRY_MS = 100
"""How long until a note of what has happened is tried again."""
CLOSING_WAIT_MS = 500
"""How long closing waits for the last notes, after it has waited for the session."""
NS_PER_MS = 1_000_000

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Booth:
    """Everything that deeds are done to."""

    conductor: Conductor
    desk: Desk
    bodies: Bodies
    voice: Voice
    recorder: Recorder
    screens: Screens
    clock: Clock
    read_cut_off: Callable[[int, Callable[[CutOff | Unreadable], None]], None]
    """Reads a sitting that was cut off, and hands it over soon."""
    window_health: Callable[[], tuple[Health, ...]]
    leave: Callable[[], None]


class Writing:
    """Writes down what happens at the booth, and remembers in words what the disk did not take."""

    def __init__(self, recorder: Recorder, clock: Clock) -> None:
        """What another program keeps from being written is tried again on this clock."""
        self.trouble = ""
        """Why the last thing could not be written; empty if it could."""
        self._recorder = recorder
        self._clock = clock
        self._kept: deque[tuple[Note, Mapping[str, Any], int]] = deque()
        self._again: Wait | None = None

    def __call__(self, note: Note, body: Mapping[str, Any]) -> bool:
        """Write it down before it is done; whether the disk took it. Raises StoreBusy, and can be called again."""
        while self._kept:
            self._write(*self._kept[0])
            self._kept.popleft()
        return self._write(note, body, None)

    def keep(self, note: Note, body: Mapping[str, Any]) -> None:
        """Write down what has happened already: now, or as soon as another program lets go of the database."""
        self._kept.append((note, body, time.time_ns() // NS_PER_MS))
        if self._again is None:
            self._write_kept()

    def close(self) -> None:
        """Write down what is left, or tell the log that it cannot be."""
        if self._again is not None:
            self._again.cancel()
            self._again = None
        with self._recorder.waiting(CLOSING_WAIT_MS):
            self._write_kept()
        if self._again is not None:
            _log.error("the last notes could not be written: another program holds the database")
            self._again.cancel()

    def _write_kept(self) -> None:
        self._again = None
        while self._kept:
            try:
                self._write(*self._kept[0])
            except StoreBusy:
                self._again = self._clock.after(KEPT_RETRY_MS, self._write_kept)
                return
            self._kept.popleft()

    def _write(self, note: Note, body: Mapping[str, Any], wall_ms: int | None) -> bool:
        try:
            self._recorder.note(note.value, body, wall_ms)
        except StoreBusy as busy:
            self.trouble = str(busy)
            raise
        except StoreFailed as failure:
            _log.error("%s", failure)
            self.trouble = str(failure)
            return False
        self.trouble = ""
        return True


class Deeds:
    """The experimenter's hand."""

    def __init__(  # noqa: PLR0913, PLR0917 - whom it has to do with
        self, booth: Booth, asking: Asking, note: NoteScreen, write: Writing, upkeep: Upkeep, catalogue: Catalogue
    ) -> None:
        """Nothing is done yet; ``panel`` is told to open or close by ``toggle_panel``."""
        self.toggle_panel: Callable[[], None] = lambda: None
        self.changed: Callable[[], None] = lambda: None
        """Is told when what can be chosen looks different."""
        self.volume = booth.desk.study.settings.voice.volume
        self.paused_by_panel = False
        """Whether the sitting goes on when the panel is closed."""
        self._booth = booth
        self._asking = asking
        self._note = note
        self._write = write
        self._upkeep = upkeep
        self._text = catalogue.text
        self._turn = in_turn(booth.desk.study.settings.allocation.quotas)
        self._acts: deque[Callable[[], None]] = deque()
        self._acting = False
        self._busy = BusyWait(booth.clock, booth.recorder.wait_ms, self._tell_busy)
        self._turning_for: str | None = None
        self._note_away: Wait | None = None
        booth.conductor.begun = self._begun
        booth.conductor.rested = self._rested

    @property
    def stage(self) -> Stage:
        """The stage that the booth is in; over while the calm screen is up."""
        conductor = self._booth.conductor
        return Stage.OVER if conductor.gives_way else conductor.stage

    @property
    def turn(self) -> tuple[Condition | None, ...]:
        """What can be chosen as the next condition, the list's (None) first."""
        return self._turn

    def press(self, name: str) -> None:
        """A chord was pressed."""
        deed = Deed(name)
        if deed is Deed.CONDITION and self._turning_for is not None:
            self._choose_next_in_turn(self._turning_for)
        elif deed is Deed.PANEL:
            self.toggle_panel()
        else:
            self.wish(name, "")

    def wish(self, name: str, choice: str) -> None:
        """Something is to be done; without a choice the next one in turn."""
        deed = Deed(name)
        held = rule(deed, self.stage)
        if held.effect is Effect.REFUSED:
            self.tell("desk-not-now")
        else:
            self._asking.ask(held.asks, partial(self._do, deed, choice))

    def tell(self, message: str, **variables: str | int) -> None:
        """Show a few words at the screen's edge for a moment."""
        self._note.tell(self._text(message, **variables))
        self._keep_note()

    def _do(self, deed: Deed, choice: str, reason: str) -> None:
        act = partial(self._do_now, deed, choice, reason)
        if deed is Deed.LEAVE:
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
        except StoreFailed as failure:
            self._not_written(failure)
            return False
        self._acts.appendleft(act)
        return True

    def _tell_busy(self, waits: bool) -> None:  # noqa: FBT001 - it is what is shown
        if waits:
            self.tell("desk-busy")

    def _do_now(self, deed: Deed, choice: str, reason: str) -> None:
        # Since it was asked for, the sitting has gone on.
        if rule(deed, self.stage).effect is Effect.REFUSED:
            self.tell("desk-not-now")
            return
        {
            Deed.CONDITION: self._condition,
            Deed.BODY: self._body,
            Deed.AGAIN: self._again,
            Deed.QUIET: self._quiet,
            Deed.PAUSE: self._pause,
            Deed.END: self._end,
            Deed.NEXT: self._next,
            Deed.RESUME: self._resume,
            Deed.LANGUAGE: self._language,
            Deed.VOLUME: self._set_volume,
            Deed.BACKUP: self._backup,
            Deed.LEAVE: self._leave,
        }[deed](choice, reason)
        self.changed()

    # What holds from the next sitting on

    def _condition(self, choice: str, reason: str) -> None:
        if not choice:
            self._choose_next_in_turn(reason)
        else:
            self._choose(None if choice == AUTOMATIC else Condition(choice), reason)

    def _choose_next_in_turn(self, reason: str) -> None:
        at = self._turn.index(self._booth.desk.chosen)
        self._choose(self._turn[(at + 1) % len(self._turn)], reason)
        self._turning_for = reason

    def _choose(self, condition: Condition | None, reason: str) -> None:
        try:
            self._booth.desk.choose(condition, reason)
        except StoreBusy:
            raise
        except StoreFailed as failure:
            self._not_written(failure)
            return
        # Never a name: the participant may be looking.
        self._note.point(self._turn.index(condition), len(self._turn))
        self._keep_note()
        self.changed()

    def _body(self, choice: str, reason: str) -> None:
        bodies = self._booth.bodies
        if not bodies.has_robot:
            self.tell("desk-robot-none")
            return
        robot = next(name for name in bodies.health if name is not BodyName.AVATAR)
        to_avatar = choice == BodyName.AVATAR.value if choice else not bodies.prefers_avatar
        name = BodyName.AVATAR if to_avatar else robot
        if self._written(Note.BODY_CHOSEN, {"body": name.value, "reason": reason}):
            bodies.prefer(name)
            self.tell("desk-next-avatar" if to_avatar else "desk-next-robot")

    def _language(self, choice: str, reason: str) -> None:
        if self._written(Note.LANGUAGE_CHOSEN, {"language": choice, "reason": reason}):
            screens = self._booth.screens
            screens.attract.rest_in(choice)
            if self.resting:
                screens.clear()
            self.tell("desk-done")

    def _set_volume(self, choice: str, _reason: str) -> None:
        volume = float(choice)
        if self._written(Note.VOLUME_CHANGED, {"volume": volume}):
            self.volume = volume
            if self.resting:
                self._booth.voice.turn(volume)

    # What holds at once

    def _again(self, _choice: str, _reason: str) -> None:
        self._tell_sitting(happened.RepeatAsked)

    def _quiet(self, _choice: str, _reason: str) -> None:
        bodies = self._booth.bodies
        quiet = not bodies.is_quiet
        if not self._written(Note.SOUND_CHANGED, {"quiet": quiet}):
            return
        self._booth.conductor.tell(happened.SoundChanged, quiet=quiet)
        if quiet:
            bodies.be_quiet()
        else:
            bodies.be_heard()
        self.tell("desk-quiet-on" if quiet else "desk-quiet-off")

    def _pause(self, _choice: str, _reason: str) -> None:
        conductor = self._booth.conductor
        if conductor.accepts(happened.PauseAsked):
            conductor.tell(happened.PauseAsked)
        elif self._panel_is_open:
            # It stays as it is as long as the panel is open; what changes is what comes after.
            self.paused_by_panel = not self.paused_by_panel
        else:
            self._tell_sitting(happened.PauseEnded)

    def _end(self, _choice: str, reason: str) -> None:
        # What was typed of a visitor stands with their sitting alone, and goes with it, or was never to be kept.
        kind = Reason.without_words(reason)
        if self._written(Note.SITTING_STOPPED, {"stage": self.stage.value, "reason": kind}):
            self._booth.conductor.tell(happened.EndAsked, reason=reason)

    def _next(self, _choice: str, reason: str) -> None:
        match self.stage:
            case Stage.OVER:
                self._booth.conductor.go_on()
            case Stage.THANKS:
                self._booth.conductor.tell(happened.NextAsked)
            case _:
                self._end("", reason)

    def _resume(self, choice: str, reason: str) -> None:
        self._booth.read_cut_off(int(choice), partial(self._go_on_with, reason))

    def _go_on_with(self, reason: str, found: CutOff | Unreadable) -> None:
        self._in_turn(partial(self._go_on_now, reason, found))

    def _go_on_now(self, reason: str, found: CutOff | Unreadable) -> None:
        if isinstance(found, Unreadable):
            self.tell("desk-cannot-resume", why=found.why)
            return
        if rule(Deed.RESUME, self.stage).effect is Effect.REFUSED:
            self.tell("desk-not-now")
            return
        noted = partial(self._written, Note.SITTING_RESUMED, {"sitting": found.number, "reason": reason})
        try:
            self._booth.conductor.resume(found.sitting, found.number, found.past, noted)
        except StoreBusy:
            raise
        except (BadInput, UnexpectedEvent, StoreFailed) as failure:
            self.tell("desk-cannot-resume", why=str(failure))
        else:
            self._hold_for_panel()
        self.changed()

    def _backup(self, _choice: str, _reason: str) -> None:
        self._upkeep.back_up()

    def _leave(self, _choice: str, reason: str) -> None:
        # A disk that takes nothing keeps nobody here.
        self._write.keep(Note.KIOSK_LEFT, {"stage": self.stage.value, "reason": reason})
        self._booth.leave()

    # The panel

    def panel_opened(self) -> None:
        """Stop the sitting that is under way, for as long as the panel is open."""
        self._panel_is_open = True
        self.paused_by_panel = False
        self._hold_for_panel()

    def panel_closed(self) -> None:
        """Let the sitting go on, unless it was stopped before or is to stay so."""
        self._panel_is_open = False
        paused, self.paused_by_panel = self.paused_by_panel, False
        if paused and self._booth.conductor.accepts(happened.PauseEnded):
            self._booth.conductor.tell(happened.PauseEnded)

    _panel_is_open = False

    def _hold_for_panel(self) -> None:
        conductor = self._booth.conductor
        if self._panel_is_open and conductor.accepts(happened.PauseAsked):
            self.paused_by_panel = True
            conductor.tell(happened.PauseAsked)

    @property
    def resting(self) -> bool:
        """Whether no sitting is under way."""
        return self.stage in (Stage.ATTRACT, Stage.OVER)

    def _begun(self) -> None:
        """A sitting that begins in silence says so."""
        if self._booth.bodies.is_quiet:
            self._booth.conductor.tell(happened.SoundChanged, quiet=True)
        self.changed()

    def _rested(self) -> None:
        """Do what has waited for the end of a sitting."""
        self.paused_by_panel = False
        self._booth.voice.turn(self.volume)
        self._upkeep.rested()
        self.changed()

    def _tell_sitting(self, kind: type[happened.WorldEvent]) -> None:
        conductor = self._booth.conductor
        if conductor.accepts(kind):
            conductor.tell(kind)
        else:
            self.tell("desk-not-now")

    def _written(self, note: Note, body: Mapping[str, Any]) -> bool:
        """Write it down before it is done; what cannot be written is not done."""
        if self._write(note, body):
            return True
        self.tell("desk-not-written")
        return False

    def _not_written(self, failure: StoreFailed) -> None:
        _log.error("%s", failure)
        self._write.trouble = str(failure)
        self.tell("desk-not-written")

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
