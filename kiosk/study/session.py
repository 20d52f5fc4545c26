"""One sitting: ``handle(event) -> commands``, and nothing else.

It validates, then changes; what it concluded stands first among its commands, to be written before anything is shown.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import count
from random import Random

from kiosk import BadInput
from kiosk.assistant.adaptation import assistant_with
from kiosk.assistant.mentaliser import TargetRule
from kiosk.assistant.qtable import QTable
from kiosk.assistant.wording import Catalogue, Wording
from kiosk.game import Board
from kiosk.settings import Settings
from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Command, Mood, Script
from kiosk.study.condition import Condition, help_in
from kiosk.study.events import BodyName, Stage, Status, Timer, WorldEvent
from kiosk.study.after.measures import Measures, measure
from kiosk.study.play import Guide, Play
from kiosk.study.declared.questionnaire import Questionnaire
from kiosk.study.stages import UnexpectedEvent, check_expected, next_stage

FEW_MOVES = 25
SOME_MOVES = 30
"""Below FEW_MOVES and below SOME_MOVES the assistant praises; the study's two limits."""


@dataclass(frozen=True)
class Plan:
    """Everything that a sitting follows, except chance and what happens in it."""

    settings: Settings
    condition: Condition
    policy: QTable
    catalogue: Catalogue
    questionnaire: Questionnaire
    deck: tuple[str, ...]


class Session:
    """One sitting, from the visitor's first tap to its end."""

    def __init__(self, plan: Plan, seed: int) -> None:
        """Follow ``plan``; the same seed and the same events give the same commands.

        Raises BadInput if the deck has too few cards for the board.
        """
        self.stage = Stage.ATTRACT
        self._plan = plan
        self._timing = plan.settings.timing
        self._log: list[happened.SessionEvent] = []
        self._waiting: set[Timer] = set()
        self._asked_still_there = False
        self._robot_lost = False
        self._unsaid: do.Speak | None = None
        self._item = 0
        self._utterances = count(1)
        # One stream of chance for each purpose: two conditions with the same seed play the same board.
        deal, targets, words = (Random(f"{seed}/{purpose}") for purpose in ("deal", "targets", "words"))
        self._wording = Wording(plan.catalogue, words)
        self._play = self._prepare_play(deal, targets)

    def handle(self, event: WorldEvent) -> tuple[Command, ...]:
        """What one event leads to: records first; raises UnexpectedEvent, and changes nothing, if it has no place."""
        self._check(event)
        script = Script(event.at_ms)
        self._notice_presence(event, script)
        self._react(event, script)
        for step in (event, *script.notes):
            self._go_on_after(step, script)
        self._log.extend(script.notes)
        self._keep_track(script)
        return script.commands

    @property
    def measures(self) -> Measures:
        """The measures of the game so far."""
        return measure(self._log)

    def _prepare_play(self, deal: Random, targets: Random) -> Play:
        plan, game = self._plan, self._plan.settings.game
        try:
            board = Board.deal(game.rows, game.columns, plan.deck, deal)
        except ValueError as error:
            raise BadInput(f"no game can be dealt from the deck {game.deck!r}: {error}") from error
        rule = TargetRule(plan.settings.assistance.target_rule)
        given = help_in(plan.condition, rule, self._wording, targets)
        step = plan.settings.assistance.step
        guide = Guide(assistant_with(plan.policy, given.mentaliser, step), given.sentences) if given else None
        return Play(board, guide, self._timing, self._utterances)

    def _check(self, event: WorldEvent) -> None:
        check_expected(self.stage, event)
        match event:
            case happened.TimerEnded(timer=timer) if timer not in self._waiting:
                raise UnexpectedEvent(self.stage, event)
            case happened.StillHereTapped() if not self._asked_still_there:
                raise UnexpectedEvent(self.stage, event)
            case happened.RobotLost() if self._robot_lost:
                raise UnexpectedEvent(self.stage, event)
            case happened.AnswerGiven(item=item, value=value):
                asked = self._plan.questionnaire.items[self._item]
                if item != asked.id or not 1 <= value <= asked.points:
                    raise UnexpectedEvent(self.stage, event)

    def _react(self, event: WorldEvent, script: Script) -> None:
        """What the event leads to within its stage."""
        match event:
            case happened.CardTapped(position=position):
                self._play.card_tapped(position, script)
            case happened.AnswerGiven(value=value):
                script.do(do.ShowAnswer(value))
            case happened.ContinueTapped() if self.stage is Stage.QUESTIONS:
                self._next_question(script)
            case happened.TimerEnded(timer=timer):
                self._waiting.discard(timer)
                self._wait_ended(timer, script)
            case happened.RobotLost(why=why):
                self._go_on_without_robot(why, script)
            case happened.SpeechStarted() | happened.SpeechFinished() | happened.SpeechFailed():
                self._hear(event, script)

    def _hear(self, event: WorldEvent, script: Script) -> None:
        """What a body reports of a sentence."""
        match event:
            case happened.SpeechStarted(utterance=utterance):
                self._play.speech_started(utterance, script)
            case happened.SpeechFinished(utterance=utterance):
                self._said(utterance)
                self._play.speech_finished(utterance, script)
            case happened.SpeechFailed(utterance=utterance):
                self._said(utterance)
                self._play.speech_failed(utterance, script)

    def _go_on_without_robot(self, why: str, script: Script) -> None:
        """Have the avatar help; it says at once what the robot had not said to its end."""
        self._robot_lost = True
        script.note(happened.BodyChanged(at_ms=script.at_ms, body=BodyName.AVATAR, why=why))
        script.do(do.ChangeBody(BodyName.AVATAR))
        if self._unsaid is not None:
            script.do(self._unsaid)

    def _said(self, utterance: int) -> None:
        if self._unsaid is not None and self._unsaid.utterance == utterance:
            self._unsaid = None

    def _wait_ended(self, timer: Timer, script: Script) -> None:
        match timer:
            case Timer.IDLE:
                self._asked_still_there = True
                script.do(do.AskStillThere(), do.StartTimer(Timer.STILL_THERE, self._timing.still_there))
            case Timer.STILL_THERE:
                script.note(happened.VisitorLeft(at_ms=script.at_ms))
            case _:
                self._play.timer_ended(timer, script)

    def _notice_presence(self, event: WorldEvent, script: Script) -> None:
        """Start the idle time anew whenever somebody shows that they are there."""
        if not event.by_visitor:
            return
        self._stop_asking(script)
        self._start_idle(self.stage, script)

    def _stop_asking(self, script: Script) -> None:
        """Ask no longer whether somebody is there."""
        if self._asked_still_there:
            self._asked_still_there = False
            script.do(do.HideStillThere(), do.StopTimer(Timer.STILL_THERE))

    def _start_idle(self, stage: Stage, script: Script) -> None:
        after = self._timing.idle_game if stage is Stage.GAME else self._timing.idle
        script.do(do.StartTimer(Timer.IDLE, after))

    def _go_on_after(self, event: happened.Event, script: Script) -> None:
        """Enter the next stage, if this event leads to one."""
        stage = next_stage(self.stage, event)
        if stage is self.stage:
            return
        running = {*self._waiting, *(c.timer for c in script.deeds if isinstance(c, do.StartTimer))}
        script.do(do.StopSpeaking(), do.ClearBubble())
        script.do(*(do.StopTimer(timer) for timer in Timer if timer in running))
        self._stop_asking(script)
        self.stage = stage
        script.note(happened.StageEntered(at_ms=script.at_ms, stage=stage))
        if stage is Stage.OVER:
            self._end(_ENDINGS[type(event)], script)
        else:
            self._start_idle(stage, script)
            self._entrances[stage](script)

    @property
    def _entrances(self) -> dict[Stage, Callable[[Script], None]]:
        return {
            Stage.INTRODUCTION: self._introduce,
            Stage.GAME: self._play.begin,
            Stage.RESULT: self._show_result,
            Stage.QUESTIONS: self._first_question,
        }

    def _introduce(self, script: Script) -> None:
        script.do(do.ShowIntroduction())
        self._speak(self._wording.say("introduction-speech"), script)

    def _show_result(self, script: Script) -> None:
        measures = measure([*self._log, *script.notes])
        script.do(
            do.ShowResult(measures.pairs, measures.moves, measures.completion_ms),
            do.Express(Mood.HAPPY),
        )
        self._speak(self._wording.say(_remark(measures.moves), moves=measures.moves), script)

    def _first_question(self, script: Script) -> None:
        script.do(do.Express(Mood.LISTENING))
        self._ask(script)

    def _next_question(self, script: Script) -> None:
        self._item += 1
        if self._item < len(self._plan.questionnaire.items):
            self._ask(script)
        else:
            script.note(happened.QuestionsFinished(at_ms=script.at_ms))

    def _ask(self, script: Script) -> None:
        questionnaire = self._plan.questionnaire
        item = questionnaire.items[self._item]
        script.do(do.ShowQuestion(questionnaire.id, item.id, item.points, self._item + 1, len(questionnaire.items)))

    def _speak(self, sentence: str, script: Script) -> None:
        number = next(self._utterances)
        script.note(happened.SentenceRequested(at_ms=script.at_ms, utterance=number, sentence=sentence))
        script.do(do.Speak(number, sentence))

    def _end(self, status: Status, script: Script) -> None:
        script.note(happened.SittingEnded(at_ms=script.at_ms, status=status))
        script.do(do.Express(Mood.IDLE), do.EndSitting(status))

    def _keep_track(self, script: Script) -> None:
        """Remember which waits are running, so that the end of any other can be refused, and what is being said."""
        for command in script.deeds:
            if isinstance(command, do.StartTimer):
                self._waiting.add(command.timer)
            elif isinstance(command, do.StopTimer):
                self._waiting.discard(command.timer)
            elif isinstance(command, do.Speak):
                self._unsaid = command
            elif isinstance(command, do.StopSpeaking):
                self._unsaid = None


_ENDINGS = {
    happened.QuestionsFinished: Status.COMPLETED,
    happened.VisitorLeft: Status.ABANDONED,
    happened.KioskClosed: Status.INTERRUPTED,
}


def _remark(moves: int) -> str:
    """The message for the end of a game of so many moves."""
    if moves < FEW_MOVES:
        return "result-speech-few"
    return "result-speech-some" if moves < SOME_MOVES else "result-speech-many"
