"""What moves without being commanded: the avatar's blinks and glances, and what draws people in.

Law: one act at a time, each over before the next begins, and none that is heard.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from kiosk.ui.clock import Clock
from kiosk.ui.screens.avatar import AvatarScreen
from kiosk.ui.screens.plain import AttractScreen, KioskScreen

PAUSE_MS = (1_100, 2_200)
"""Between two acts while nobody plays."""
PLAYING_PAUSE_MS = (2_500, 6_000)
"""The same while somebody does."""
BLINK_MS = 120
GLANCE_MS = 900
GLANCE_FAR = 0.3
LOOK_FAR = 0.8
"""How far it looks around while nobody plays."""
TURN_MS = 500
GREETING_MS = 6_000
READING_MS = 3_000
"""How long a title in another language is left to be read."""

Act = Callable[[], int]
"""Begins something and says how long it takes, in ms."""


class IdleLife:
    """Keeps the screen alive while nobody does anything."""

    def __init__(
        self, kiosk: KioskScreen, avatar: AvatarScreen, attract: AttractScreen, clock: Clock, rng: Random
    ) -> None:
        """Begin at once, and never end."""
        self._kiosk = kiosk
        self._avatar = avatar
        self._attract = attract
        self._clock = clock
        self._rng = rng
        self._greeting = ""
        kiosk.unsettled.connect(self._mind_visitor)
        self._pause()

    @property
    def _nobody_plays(self) -> bool:
        return self._kiosk.shown == "attract"

    def _pause(self) -> None:
        """Bring everything to rest, and go on after a while."""
        self._avatar.blink(shut=False)
        self._avatar.glance(0, 0)
        self._take_greeting_away()
        pause = PAUSE_MS if self._nobody_plays else PLAYING_PAUSE_MS
        self._clock.after(self._rng.randint(*pause), self._act)

    def _act(self) -> None:
        self._clock.after(self._choose()(), self._pause)

    def _choose(self) -> Act:
        if not self._nobody_plays:
            return self._rng.choice((self._blink, self._blink, self._glance))
        # A card turns up and back in every few acts, a greeting comes about twice a minute.
        acts = (self._turn_card, self._blink, self._glance, self._greet, self._change_language)
        return self._rng.choices(acts, weights=(9, 3, 5, 1, 2))[0]

    def _blink(self) -> int:
        self._avatar.blink(shut=True)
        return BLINK_MS

    def _glance(self) -> int:
        far = LOOK_FAR if self._nobody_plays else GLANCE_FAR
        self._avatar.glance(self._rng.uniform(-far, far), self._rng.uniform(-GLANCE_FAR, GLANCE_FAR))
        return GLANCE_MS

    def _turn_card(self) -> int:
        self._attract.turn()
        return TURN_MS

    def _greet(self) -> int:
        """Show a word to whoever passes, which is never said."""
        self._greeting = self._rng.choice(self._attract.greetings)
        self._avatar.say(self._greeting)
        return GREETING_MS

    def _change_language(self) -> int:
        self._attract.next_language()
        return READING_MS

    def _mind_visitor(self) -> None:
        """Somebody has come: what was shown to everybody goes, unless something else is said by now."""
        if not self._nobody_plays:
            self._take_greeting_away()

    def _take_greeting_away(self) -> None:
        greeting, self._greeting = self._greeting, ""
        if greeting and self._avatar.property("bubble") == greeting:
            self._avatar.say("")
