"""An event of every kind that comes from outside."""

from __future__ import annotations

from kiosk.game import Position
from kiosk.study import events as happened
from kiosk.study.events import BodyName, Timer, WorldEvent

EXAMPLES: dict[type[WorldEvent], WorldEvent] = {
    type(event): event
    for event in (
        happened.StartTapped(at_ms=9),
        happened.ContinueTapped(at_ms=9),
        happened.PurposeTicked(at_ms=9, purpose="share", ticked=True),
        happened.AgreeTapped(at_ms=9),
        happened.DeclineTapped(at_ms=9),
        happened.AgeTapped(at_ms=9, adult=True),
        happened.SkipTapped(at_ms=9),
        happened.CardTapped(at_ms=9, position=Position(0, 0)),
        happened.AnswerGiven(at_ms=9, item="enjoyed", value=1),
        happened.Typed(at_ms=9),
        happened.UserActivity(at_ms=9, ago_ms=3),
        happened.StillHereTapped(at_ms=9),
        happened.TimerEnded(at_ms=9, timer=Timer.IDLE),
        happened.SpeechStarted(at_ms=9, utterance=1),
        happened.SpeechFinished(at_ms=9, utterance=1),
        happened.SpeechFailed(at_ms=9, utterance=1, why="no sound"),
        happened.RobotLost(at_ms=9, why="the plug"),
        happened.RepeatAsked(at_ms=9),
        happened.PauseAsked(at_ms=9),
        happened.PauseEnded(at_ms=9),
        happened.EndAsked(at_ms=9, reason="the fair is closing"),
        happened.NextAsked(at_ms=9),
        happened.SoundChanged(at_ms=9, quiet=True),
        happened.SittingResumed(at_ms=9, body=BodyName.AVATAR),
        happened.KioskClosed(at_ms=9),
    )
}
