"""An event of every kind that comes from outside."""

from __future__ import annotations

from kiosk.experiment import events as happened
from kiosk.experiment.events import Timer, WorldEvent
from kiosk.experiment.outcomes import EmbodimentName
from kiosk.game import Position

EXAMPLES: dict[type[WorldEvent], WorldEvent] = {
    type(event): event
    for event in (
        happened.SessionStarted(at_ms=9),
        happened.ContinuePressed(at_ms=9),
        happened.BackPressed(at_ms=9),
        happened.StopPressed(at_ms=9),
        happened.RepeatPressed(at_ms=9),
        happened.LanguageSelected(at_ms=9, language="it"),
        happened.TextSizeSelected(at_ms=9, size=happened.TextSize.LARGE),
        happened.SoundSelected(at_ms=9, on=False),
        happened.ConsentPurposeToggled(at_ms=9, purpose="share", ticked=True),
        happened.ConsentSubmitted(at_ms=9),
        happened.ConsentDeclined(at_ms=9),
        happened.AgeConfirmed(at_ms=9, adult=True),
        happened.PracticeSkipped(at_ms=9),
        happened.CardSelected(at_ms=9, position=Position(0, 0)),
        happened.ResponseGiven(at_ms=9, item="enjoyed", value=1),
        happened.TypingActivity(at_ms=9),
        happened.UserActivity(at_ms=9, ago_ms=3),
        happened.PresenceConfirmed(at_ms=9),
        happened.TimerExpired(at_ms=9, timer=Timer.IDLE),
        happened.SpeechStarted(at_ms=9, utterance=1),
        happened.SpeechFinished(at_ms=9, utterance=1),
        happened.SpeechFailed(at_ms=9, utterance=1, why="no sound"),
        happened.RobotDisconnected(at_ms=9, why="the plug"),
        happened.RepeatRequested(at_ms=9),
        happened.PauseRequested(at_ms=9),
        happened.PauseEnded(at_ms=9),
        happened.AbortRequested(at_ms=9, reason="the fair is closing"),
        happened.NextParticipantRequested(at_ms=9),
        happened.MuteChanged(at_ms=9, muted=True),
        happened.SessionResumed(at_ms=9, embodiment=EmbodimentName.AVATAR),
        happened.ApplicationClosed(at_ms=9),
    )
}
