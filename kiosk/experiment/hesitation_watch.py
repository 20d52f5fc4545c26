"""Watch whether the player of a game hesitates: the waits of a session for that, and what puts them off."""

from __future__ import annotations

from kiosk.assistance.hesitation import HesitationRule, PlayerTimes, Wait
from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import OutcomeBuilder
from kiosk.experiment.events import Timer, WorldEvent
from kiosk.game import Concentration, Flip


class HesitationWatch:
    """Times one player's flips, and tells when they wait so long that they get help."""

    def __init__(self, rule: HesitationRule) -> None:
        """Begin a game; nothing is timed before the board opens."""
        self._rule = rule
        self._times = PlayerTimes(rule)

    @property
    def action(self) -> ActionSpec:
        """The help that a player who hesitates gets."""
        return self._rule.action

    def begin_wait(self, game: Concentration, outcome: OutcomeBuilder) -> None:
        """Time the coming flip, for which the board has just opened without help."""
        self._times.open(outcome.at_ms)
        threshold_ms = self._times.threshold_ms(FlipInMove.coming(game))
        if threshold_ms is not None:
            outcome.effect(do.StartTimer(Timer.HESITATION, threshold_ms))

    def end_wait(self, flip: Flip, outcome: OutcomeBuilder) -> None:
        """Keep how long the player took for a flip."""
        self._times.flip(FlipInMove.FIRST if flip.matched is None else FlipInMove.SECOND, outcome.at_ms)
        outcome.effect(do.StopTimer(Timer.HESITATION))

    def wait_to_help(self, event: WorldEvent, game: Concentration, outcome: OutcomeBuilder) -> Wait | None:
        """Return the wait of a player who gets help now, and count that help; None if they get none.

        A player who moves the pointer does not hesitate, and one who is away is not there.
        """
        coming = FlipInMove.coming(game)
        match event:
            case happened.TimerExpired(timer=Timer.HESITATION):
                return self._offer(coming, outcome)
            case happened.UserActivity(ago_ms=ago_ms) if self._times.has_waited(coming, outcome.at_ms):
                still_ms = self._rule.still_ms - ago_ms
                if still_ms <= 0:
                    outcome.effect(do.StopTimer(Timer.HESITATION))
                    return self._offer(coming, outcome)
                outcome.effect(do.StartTimer(Timer.HESITATION, still_ms))
            case happened.TimerExpired(timer=Timer.IDLE) | happened.PauseRequested():
                self._times.spoil()
                outcome.effect(do.StopTimer(Timer.HESITATION))
        return None

    def _offer(self, coming: FlipInMove, outcome: OutcomeBuilder) -> Wait | None:
        wait = self._times.wait(coming, outcome.at_ms)
        if wait is not None:
            self._times.count_offer()
        return wait
