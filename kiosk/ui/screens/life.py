"""What moves without being commanded: the avatar's blinks and glances, and the cards that draw people in."""

from __future__ import annotations

from random import Random

from kiosk.ui.clock import Clock
from kiosk.ui.screens.avatar import AvatarScreen
from kiosk.ui.screens.plain import AttractScreen

BLINK_MS = 120
BLINK_EVERY_MS = (2_500, 6_000)
GLANCE_MS = 700
GLANCE_EVERY_MS = (4_000, 9_000)
GLANCE_FAR = 0.3
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
        self._wait_for_glance()
        self._clock.after(TURN_EVERY_MS, self._turn_card)

    def _wait_for_blink(self) -> None:
        self._avatar.blink(shut=False)
        self._clock.after(self._rng.randint(*BLINK_EVERY_MS), self._blink)

    def _blink(self) -> None:
        self._avatar.blink(shut=True)
        self._clock.after(BLINK_MS, self._wait_for_blink)

    def _wait_for_glance(self) -> None:
        self._avatar.glance(0, 0)
        self._clock.after(self._rng.randint(*GLANCE_EVERY_MS), self._glance)

    def _glance(self) -> None:
        self._avatar.glance(self._rng.uniform(-GLANCE_FAR, GLANCE_FAR), self._rng.uniform(-GLANCE_FAR, GLANCE_FAR))
        self._clock.after(GLANCE_MS, self._wait_for_glance)

    def _turn_card(self) -> None:
        self._attract.turn()
        self._clock.after(TURN_EVERY_MS, self._turn_card)
