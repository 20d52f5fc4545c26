"""Help for a player who hesitates: who waits longer than they usually do before turning up a card.

What is usual is the median of the player's own times in this game, for first and for second cards apart. A time runs
from when a card could be tapped until one was. Times of flips with help, and times with a pause in them, do not count.
"""

from __future__ import annotations

from statistics import median

from kiosk.assistance.policy import ActionSpec, FlipInMove, find_action
from kiosk.config import AssistanceConfig
from kiosk.lazy_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class HesitationRule:
    """When a player counts as hesitating, and what help they get.

    At most ``most`` times a game, after ``times`` the usual time and no sooner than ``least_ms``. ``flips`` own times
    make a usual time. The pointer must have rested for ``still_ms``.
    """

    most: int
    times: float
    flips: int
    least_ms: int
    still_ms: int
    action: ActionSpec

    @classmethod
    def of(cls, config: AssistanceConfig) -> HesitationRule | None:
        """Return the rule that a study file declares; None where hesitation is left alone."""
        if not config.hesitation_max:
            return None
        return cls(
            most=config.hesitation_max,
            times=config.hesitation_times,
            flips=config.hesitation_flips,
            least_ms=config.hesitation_least_ms,
            still_ms=config.hesitation_still_ms,
            action=find_action(config.hesitation_action),
        )


@dataclass(frozen=True, slots=True)
class Wait:
    """How long a player has waited for a flip, their usual time for it, and from when on they hesitate."""

    waited_ms: int
    usual_ms: int
    threshold_ms: int


class PlayerTimes:
    """A player's own times in one game, and since when they can tap a card."""

    def __init__(self, rule: HesitationRule) -> None:
        """Begin a game."""
        self.rule = rule
        self._times: dict[FlipInMove, list[int]] = {card: [] for card in FlipInMove}
        self._since: int | None = None
        self._offers = 0

    def open(self, at_ms: int) -> None:
        """Start the time of the coming flip: a card can be tapped from now on."""
        self._since = at_ms

    def spoil(self) -> None:
        """Leave the time of the coming flip out of account: it has help, or a pause in it."""
        self._since = None

    def flip(self, card: FlipInMove, at_ms: int) -> None:
        """End the time of the coming flip, as a card was turned up."""
        if self._since is not None:
            self._times[card].append(at_ms - self._since)
        self._since = None

    def usual_ms(self, card: FlipInMove) -> int | None:
        """Return the player's usual time for a first or a second card; None while there are too few."""
        times = self._times[card]
        return round(median(times)) if len(times) >= self.rule.flips else None

    def threshold_ms(self, card: FlipInMove) -> int | None:
        """Return how long the player may wait before they get help; None if they will not."""
        usual_ms = self.usual_ms(card)
        if usual_ms is None or self._offers >= self.rule.most:
            return None
        return max(self.rule.least_ms, round(self.rule.times * usual_ms))

    def wait(self, card: FlipInMove, at_ms: int) -> Wait | None:
        """Return the wait for the coming flip so far, if it is timed and can come to help."""
        usual_ms, threshold_ms = self.usual_ms(card), self.threshold_ms(card)
        if self._since is None or usual_ms is None or threshold_ms is None:
            return None
        return Wait(at_ms - self._since, usual_ms, threshold_ms)

    def has_waited(self, card: FlipInMove, at_ms: int) -> bool:
        """Whether the player has waited for the coming flip so long that they hesitate."""
        wait = self.wait(card, at_ms)
        return wait is not None and wait.waited_ms >= wait.threshold_ms

    def count_offer(self) -> None:
        """Count one offer of help; the time of the flip it is for does not count."""
        self._offers += 1
        self.spoil()
