"""Ask the experimenter for the PIN and a reason."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from math import ceil
from typing import Any, Protocol

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QWindow

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.experimenter import MOST, AuditEvent, Authorisation, DeviationReason, WrongPins, pin_matches
from kiosk.experiment.typed_input import can_be_kept
from kiosk.ui.event_loop import Clock, Executor, TimerWait
from kiosk.ui.experimenter.view_model import AuthorisationStep, CardScreen
from kiosk.ui.input import without_last
from kiosk.units import MS_PER_SECOND

Write = Callable[[AuditEvent, Mapping[str, Any]], object]
"""Writes down what happened at the booth, whether the disk takes it or not."""


class PinResult(Protocol):
    """Called with whether a PIN was the right one."""

    def __call__(self, *, right: bool) -> None:
        """Take the answer."""
        ...


class PinVerifier:
    """One booth's lock; without a PIN it is open.

    An attempt counts from the moment it is taken, and there is one at a time: whatever is typed while one is checked,
    or before the next try is allowed, is refused unseen. So no burst gets more tries than the waits allow.
    """

    def __init__(self, line: str, wrong: int, now_ms: Callable[[], int], work: Executor, write: Write) -> None:
        """Lock with the PIN as the study file keeps it, after so many wrong ones in a row.

        ``now_ms`` never goes back and is no clock that can be set. A wait that was under way when the kiosk was closed
        begins anew, so that neither setting the clock nor a restart ends it.
        """
        self._line = line
        self._wrong = WrongPins(wrong, now_ms())
        self._now_ms = now_ms
        self._work = work
        self._write = write
        self._checks = False

    @property
    def has_pin(self) -> bool:
        """Whether anything is asked for at all."""
        return bool(self._line)

    @property
    def checks(self) -> bool:
        """Whether an attempt is being checked, so that no other may be made."""
        return self._checks

    @property
    def left_ms(self) -> int:
        """How long no try is allowed after a wrong PIN, in ms; 0 while it is not known yet."""
        return 0 if self._checks else self._wrong.left_ms(self._now_ms())

    def check_pin(self, pin: str, told: PinResult) -> None:
        """Tell, soon, whether this is the PIN; while no try is allowed, it is not even looked at."""
        if self._checks or self.left_ms:
            told(right=False)
            return
        self._checks = True
        self._wrong = WrongPins(self._wrong.times + 1, self._now_ms())
        # Written down first, so that an attempt counts even if the kiosk is killed before the answer.
        self._write(AuditEvent.PIN_ATTEMPTED, {})
        self._work(partial(self._try, pin), partial(self._checked, told))

    def _try(self, pin: str) -> bool | Exception:
        try:
            return pin_matches(pin, self._line)
        except Exception as fault:  # noqa: BLE001 - it is raised below, once the lock can be tried again
            return fault

    def _checked(self, told: PinResult, found: bool | Exception) -> None:  # noqa: FBT001 - it is what was found out
        self._checks = False
        if found is True:
            self._wrong = WrongPins()
            self._write(AuditEvent.PIN_ACCEPTED, {})
        else:
            # The wait is as long as it is said to be, however long the check took.
            self._wrong = WrongPins(self._wrong.times, self._now_ms())
            self._write(AuditEvent.PIN_REFUSED, {"in_a_row": self._wrong.times, "wait_ms": self._wrong.wait_ms})
        told(right=found is True)
        if isinstance(found, Exception):
            raise found


AWAY_MS = 10_000
"""Without a key for so long, the card goes away."""

LONGEST_REASON = 80
"""Characters of a reason in the experimenter's own words."""

DOT = "●"

Then = Callable[[str], None]
"""Called with the reason; empty if none was asked for."""


class AuthorisationFlow:
    """One question at a time; a new one takes the place of the last."""

    def __init__(self, card: CardScreen, lock: PinVerifier, clock: Clock, catalogue: Catalogue) -> None:
        """Ask on this card, in the words of the catalogue."""
        self.unlocked = False
        """Whether the PIN was given for longer than one action, as for the panel."""
        self.by_touch = False
        """Whether the experimenter is at the booth without a keyboard, so that the card has keys of its own."""
        self.changed: Callable[[], None] = lambda: None
        """Called when the card comes or goes."""
        self._card = card
        self._lock = lock
        self._clock = clock
        self._text = catalogue.text
        self._then: Then | None = None
        self._asks = Authorisation.NOTHING
        self._typed = ""
        self._question = 0
        self._away: TimerWait | None = None
        self._tick: TimerWait | None = None
        card.typed.connect(self.type)
        card.erased.connect(self.erase)
        card.entered.connect(self.enter)
        card.cancelled.connect(self.cancel)

    @property
    def asks(self) -> bool:
        """Whether the card is up."""
        return self._card.asks_for is not AuthorisationStep.NOTHING

    def ask(self, asks: Authorisation, then: Then) -> None:
        """Ask for what is wanted, then go on with ``then``; at once if nothing is."""
        self.cancel()
        self._asks, self._then = asks, then
        if asks is Authorisation.NOTHING:
            self._done("")
        elif self.unlocked or not self._lock.has_pin:
            self._go_on()
        else:
            self._ask_pin()

    def cancel(self) -> None:
        """Ask no more."""
        self._then = None
        # What is still being checked belongs to a question that was given up.
        self._question += 1
        self._show(AuthorisationStep.NOTHING)

    def type(self, text: str) -> None:
        """Handle a typed digit or letter."""
        match self._card.asks_for:
            case AuthorisationStep.PIN if self._lock.checks:
                # What is typed before the answer is no attempt, not even a part of the next one.
                self._wait_for_answer()
            case AuthorisationStep.PIN if text.isdecimal() and text.isascii() and len(self._typed) < MOST:
                self._show_typed(self._typed + text)
            case AuthorisationStep.REASON if text in _digits():
                self._choose(list(DeviationReason)[int(text) - 1])
            case AuthorisationStep.WORDS if can_be_kept(text) and len(self._typed + text) <= LONGEST_REASON:
                self._show_typed(self._typed + text)
            case _:
                self._wait_for_answer()

    def erase(self) -> None:
        """Take back the last character."""
        self._show_typed(without_last(self._typed))

    def enter(self) -> None:
        """Submit what was typed."""
        step, typed = self._card.asks_for, self._typed
        if step is AuthorisationStep.PIN and typed and not self._lock.checks:
            question = self._question
            self._show_typed("")
            self._lock.check_pin(typed, partial(self._checked, question))
        elif step is AuthorisationStep.WORDS and typed.strip():
            self._done(DeviationReason.OTHER.in_own_words(typed))

    def _checked(self, question: int, *, right: bool) -> None:
        if right and question == self._question:
            self._go_on()
        elif self._card.asks_for is AuthorisationStep.PIN:
            # Also where another question has come meanwhile: it has to wait as well.
            self._ask_pin()

    def _ask_pin(self) -> None:
        """Ask for the PIN, or say how long that has to wait."""
        left_ms = self._lock.left_ms
        if not left_ms:
            self._show(AuthorisationStep.PIN)
            return
        self._show(AuthorisationStep.WAIT, self._text("console-wait", seconds=ceil(left_ms / MS_PER_SECOND)))
        self._tick = self._clock.after(left_ms % MS_PER_SECOND or MS_PER_SECOND, self._ask_pin_anew)

    def _ask_pin_anew(self) -> None:
        away, self._away = self._away, None
        self._ask_pin()
        # A second less to wait is no sign of anybody.
        if self._away is not None:
            self._away.cancel()
        self._away = away

    def _go_on(self) -> None:
        """Go on after a right PIN, or without one."""
        if self._asks is Authorisation.PIN_AND_REASON:
            self._show(AuthorisationStep.REASON)
        else:
            self._done("")

    def _choose(self, reason: DeviationReason) -> None:
        if reason is DeviationReason.OTHER and not self.by_touch:
            self._show(AuthorisationStep.WORDS)
        else:
            self._done(reason.value)

    def _done(self, reason: str) -> None:
        then = self._then
        self.cancel()
        if then is not None:
            then(reason)

    def _show_typed(self, typed: str) -> None:
        step = self._card.asks_for
        if step in (AuthorisationStep.PIN, AuthorisationStep.WORDS):
            self._show(step, typed=typed)

    def _show(self, step: AuthorisationStep, line: str = "", typed: str = "") -> None:
        was_up, self._typed = self.asks, typed
        if self._tick is not None:
            self._tick.cancel()
            self._tick = None
        if step is AuthorisationStep.NOTHING:
            self._card.hide()
        else:
            reasons = tuple(self._text(f"console-reason-{each.name.lower()}") for each in DeviationReason)
            self._card.show(
                step,
                self._text(
                    "console-pin" if step in (AuthorisationStep.PIN, AuthorisationStep.WAIT) else "console-reason"
                ),
                line or ("" if self.by_touch else self._text(f"console-{step.value}-line")),
                DOT * len(typed) if step is AuthorisationStep.PIN else typed,
                reasons if step is AuthorisationStep.REASON else (),
                by_touch=self.by_touch,
            )
        self._wait_for_answer()
        if was_up is not self.asks:
            self.changed()

    def _wait_for_answer(self) -> None:
        if self._away is not None:
            self._away.cancel()
            self._away = None
        if self.asks:
            self._away = self._clock.after(AWAY_MS, self.cancel)


def _digits() -> tuple[str, ...]:
    return tuple(str(number) for number, _ in enumerate(DeviationReason, 1))


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
    """Filters the input of the window while the card asks for something or the panel is open."""

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
