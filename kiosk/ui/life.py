"""What moves without being commanded: the avatar's blinks and glances, and the cards that draw people in."""

from __future__ import annotations

from random import Random

from kiosk.ui.avatar import AvatarScreen
from kiosk.ui.clock import Clock
from kiosk.ui.screens import AttractScreen

BLINK_MS = 120
BLINK_EVERY_MS = (2_500, 6_000)
TURN_EVERY_MS = 1_800


class IdleLife:
    """Keeps the screen alive while nobody does anything."""

    def __init__(self, avatar: AvatarScreen, attract: AttractScreen, clock: Clock, rng: Random) -> None:
        """Begin at once, and never end."""
        self._avatar = avatar
        self._attract = attract
        self._clock = clock
        self._rng = rng
        self._wait_for_blink()
        self._clock.after(TURN_EVERY_MS, self._turn_card)

    def _wait_for_blink(self) -> None:
        self._avatar.blink(shut=False)
        self._clock.after(self._rng.randint(*BLINK_EVERY_MS), self._blink)

    def _blink(self) -> None:
        self._avatar.blink(shut=True)
        self._clock.after(BLINK_MS, self._wait_for_blink)

    def _turn_card(self) -> None:
        self._attract.turn()
        self._clock.after(TURN_EVERY_MS, self._turn_card)
