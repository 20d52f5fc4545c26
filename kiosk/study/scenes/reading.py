"""The scenes in which a visitor reads or listens, and goes on."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.after.measures import Measures, measure
from kiosk.study.commands import Mood, Script
from kiosk.study.declared.information import Page
from kiosk.study.events import Event, Timer, WorldEvent
from kiosk.study.scenes.scene import Scene, Speaker

FEW_MOVES = 25
SOME_MOVES = 30
"""Below FEW_MOVES and below SOME_MOVES the assistant praises; the study's two limits, for its twelve pairs."""

STUDY_PAIRS = 12


class About(Scene):
    """What the study is about."""

    def __init__(self, page: Page) -> None:
        """Show this page."""
        self._page = page

    @property
    def characters(self) -> int:
        """How long the page is."""
        return self._page.characters

    def enter(self, script: Script) -> None:
        """Show it."""
        script.do(do.ShowAbout(self._page))


class Introduction(Scene):
    """The assistant greets, and says what is to be done."""

    def __init__(self, speaker: Speaker, pairs: int, *, helped: bool) -> None:
        """Introduce a game of so many pairs, in which somebody helps or nobody does."""
        self._speaker = speaker
        self._pairs = pairs
        self._helped = helped

    def enter(self, script: Script) -> None:
        """Show the rules and say them."""
        script.do(do.ShowIntroduction(helped=self._helped))
        speech = "introduction-speech" if self._helped else "introduction-speech-alone"
        self._speaker.say(speech, script, cards=2 * self._pairs, pairs=self._pairs)


class Result(Scene):
    """What the visitor achieved."""

    mood = Mood.HAPPY

    def __init__(self, speaker: Speaker, log: Callable[[Script], Sequence[Event]]) -> None:
        """``log`` tells everything that was concluded, with what the script at hand adds."""
        self._speaker = speaker
        self._log = log

    def enter(self, script: Script) -> None:
        """Show the figures and remark on them."""
        measures = measure(self._log(script))
        script.do(do.ShowResult(measures.pairs, measures.moves, measures.completion_ms))
        self._speaker.say(_remark(measures), script, moves=measures.moves)


class Debrief(Scene):
    """What the study was about, and how to withdraw."""

    def __init__(self, page: Page) -> None:
        """Show this page."""
        self._page = page

    @property
    def characters(self) -> int:
        """How long the page is."""
        return self._page.characters

    def enter(self, script: Script) -> None:
        """Show it."""
        script.do(do.ShowDebrief(self._page))


class Thanks(Scene):
    """The end, for a moment, or until it is tapped away."""

    mood = Mood.HAPPY

    def __init__(self, speaker: Speaker, stay_ms: int) -> None:
        """Stay so long."""
        self._speaker = speaker
        self._stay_ms = stay_ms

    def enter(self, script: Script) -> None:
        """Thank the visitor."""
        script.do(do.ShowThanks(), do.StartTimer(Timer.THANKS, self._stay_ms))
        self._speaker.say("thanks-speech", script)

    def react(self, event: WorldEvent, script: Script) -> None:
        """Leave when the time is over."""
        match event:
            case happened.TimerEnded(timer=Timer.THANKS):
                script.note(happened.Thanked(at_ms=script.at_ms))


def _remark(measures: Measures) -> str:
    """The message for the end of a game; the study's limits hold for its own board, others in proportion."""
    moves = measures.moves * STUDY_PAIRS / max(1, measures.pairs)
    if moves < FEW_MOVES:
        return "result-speech-few"
    return "result-speech-some" if moves < SOME_MOVES else "result-speech-many"
