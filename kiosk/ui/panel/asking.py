"""Asks the experimenter for the PIN and for a reason, one after the other, and goes away when nobody answers.

The sitting goes on meanwhile as if nothing were.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import ceil

from kiosk.assistant.wording import Catalogue
from kiosk.study.booth.deeds import Asks, Reason
from kiosk.study.booth.pin import MOST
from kiosk.study.declared.typed_input import can_be_kept
from kiosk.ui.characters import without_last
from kiosk.ui.clock import Clock, Wait
from kiosk.ui.panel.card import CardScreen, Step
from kiosk.ui.panel.lock import Lock
from kiosk.units import MS_PER_SECOND

AWAY_MS = 10_000
"""Without a key for so long, the card goes away."""

LONGEST_REASON = 80
"""Characters of a reason in the experimenter's own words."""

DOT = "●"

Then = Callable[[str], None]
"""Is told the reason; empty if none was asked for."""


class Asking:
    """One question at a time; a new one takes the place of the last."""

    def __init__(self, card: CardScreen, lock: Lock, clock: Clock, catalogue: Catalogue) -> None:
        """Ask on this card, in the words of the catalogue."""
        self.unlocked = False
        """Whether the PIN was given for longer than one deed, as for the panel."""
        self.changed: Callable[[], None] = lambda: None
        """Is told when the card comes or goes."""
        self._card = card
        self._lock = lock
        self._clock = clock
        self._text = catalogue.text
        self._then: Then | None = None
        self._asks = Asks.NOTHING
        self._typed = ""
        self._question = 0
        self._away: Wait | None = None
        self._tick: Wait | None = None
        card.typed.connect(self.type)
        card.cancelled.connect(self.cancel)

    @property
    def asks(self) -> bool:
        """Whether the card is up."""
        return self._card.asks_for is not Step.NOTHING

    def ask(self, asks: Asks, then: Then) -> None:
        """Ask for what is wanted, then go on with ``then``; at once if nothing is."""
        self.cancel()
        self._asks, self._then = asks, then
        if asks is Asks.NOTHING:
            self._done("")
        elif self.unlocked or not self._lock.has_pin:
            self._go_on()
        else:
            self._ask_pin()

    def cancel(self) -> None:
        """Ask no more."""
        self._then = None
        # What is still being checked belongs to a question that nobody waits for.
        self._question += 1
        self._show(Step.NOTHING)

    def type(self, text: str) -> None:
        """A digit, or a letter, was typed."""
        match self._card.asks_for:
            case Step.PIN if self._lock.checks:
                # What is typed before the answer is no attempt, not even a part of the next one.
                self._wait_for_answer()
            case Step.PIN if text.isdecimal() and text.isascii() and len(self._typed) < MOST:
                self._show_typed(self._typed + text)
            case Step.REASON if text in _digits():
                self._choose(list(Reason)[int(text) - 1])
            case Step.WORDS if can_be_kept(text) and len(self._typed + text) <= LONGEST_REASON:
                self._show_typed(self._typed + text)
            case _:
                self._wait_for_answer()

    def erase(self) -> None:
        """The last character is taken back."""
        self._show_typed(without_last(self._typed))

    def enter(self) -> None:
        """What was typed is what is meant."""
        step, typed = self._card.asks_for, self._typed
        if step is Step.PIN and typed and not self._lock.checks:
            question = self._question
            self._show_typed("")
            self._lock.check(typed, partial(self._checked, question))
        elif step is Step.WORDS and typed.strip():
            self._done(Reason.OTHER.in_own_words(typed))

    def _checked(self, question: int, *, right: bool) -> None:
        if right and question == self._question:
            self._go_on()
        elif self._card.asks_for is Step.PIN:
            # Also where another question has come meanwhile: it has to wait as well.
            self._ask_pin()

    def _ask_pin(self) -> None:
        """Ask for the PIN, or say how long that has to wait."""
        left_ms = self._lock.left_ms
        if not left_ms:
            self._show(Step.PIN)
            return
        self._show(Step.WAIT, self._text("desk-wait", seconds=ceil(left_ms / MS_PER_SECOND)))
        self._tick = self._clock.after(left_ms % MS_PER_SECOND or MS_PER_SECOND, self._ask_pin_anew)

    def _ask_pin_anew(self) -> None:
        away, self._away = self._away, None
        self._ask_pin()
        # A second less to wait is no sign of anybody.
        if self._away is not None:
            self._away.cancel()
        self._away = away

    def _go_on(self) -> None:
        """The PIN was right, or not needed."""
        if self._asks is Asks.PIN_AND_REASON:
            self._show(Step.REASON)
        else:
            self._done("")

    def _choose(self, reason: Reason) -> None:
        if reason is Reason.OTHER:
            self._show(Step.WORDS)
        else:
            self._done(reason.value)

    def _done(self, reason: str) -> None:
        then = self._then
        self.cancel()
        if then is not None:
            then(reason)

    def _show_typed(self, typed: str) -> None:
        step = self._card.asks_for
        if step in (Step.PIN, Step.WORDS):
            self._show(step, typed=typed)

    def _show(self, step: Step, line: str = "", typed: str = "") -> None:
        was_up, self._typed = self.asks, typed
        if self._tick is not None:
            self._tick.cancel()
            self._tick = None
        if step is Step.NOTHING:
            self._card.hide()
        else:
            reasons = tuple(self._text(f"desk-reason-{each.name.lower()}") for each in Reason)
            self._card.show(
                step,
                self._text("desk-pin" if step in (Step.PIN, Step.WAIT) else "desk-reason"),
                line or self._text(f"desk-{step.value}-line"),
                DOT * len(typed) if step is Step.PIN else typed,
                reasons if step is Step.REASON else (),
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
    return tuple(str(number) for number, _ in enumerate(Reason, 1))
