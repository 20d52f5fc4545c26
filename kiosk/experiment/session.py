"""The session as a pure state machine: an event goes in, events and effects come out."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import count
from random import Random

from kiosk import UserInputError
from kiosk.assistance.adaptation import assistant_with
from kiosk.assistance.comments import Commentator, CommentRule
from kiosk.assistance.hesitation import HesitationRule
from kiosk.assistance.hint_sentences import PlainSentences, Wording
from kiosk.assistance.mentaliser import TargetRule
from kiosk.config import Game, Idle, Practice
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition, help_in
from kiosk.experiment.effects import Effect, Mood, Outcome, OutcomeBuilder
from kiosk.experiment.events import Event, TextSize, Timer, WorldEvent
from kiosk.experiment.game_stage import DealtTable, GameStage, HintGuide, MoveComments
from kiosk.experiment.information import POINTER, RETURNING
from kiosk.experiment.outcomes import EmbodimentName, NotRecordedReason, RecordingState, Stage, Status
from kiosk.experiment.page_stages import (
    AgeStage,
    ConsentStage,
    IntroductionStage,
    ResultStage,
    SpeechWriter,
    StageHandler,
    TextStage,
    ThanksStage,
)
from kiosk.experiment.practice_stage import PracticeStage, SampleHints
from kiosk.experiment.projections import Measures, measure
from kiosk.experiment.questionnaire_stage import QuestionnaireStage
from kiosk.experiment.session_config import SessionConfig, Translation
from kiosk.experiment.transitions import BEFORE_DECIDING, InvalidTransition, Transition, check_expected, transition
from kiosk.game import Board


class IdleTimeout:
    """Knows whether the visitor was asked if they are still there, and whether the session is paused."""

    def __init__(self, idle: Idle, reading_ms: Callable[[Stage], int] = lambda _: 0) -> None:
        """Ask after these times, or once a stage's text can have been read, if that takes longer."""
        self._idle = idle
        self._reading_ms = reading_ms
        self._asked = self._paused = False

    def accepts(self, event: WorldEvent) -> bool:
        """Whether this event can happen now: while the session is paused, a visitor can do nothing."""
        match event:
            case happened.PresenceConfirmed():
                return self._asked
            case happened.UserActivity(ago_ms=ago_ms) if ago_ms < 0:
                return False
            case happened.PauseRequested():
                return not self._paused
            case happened.PauseEnded():
                return self._paused
        return not (self._paused and event.by_visitor)

    def react(self, event: WorldEvent, stage: Stage, outcome: OutcomeBuilder) -> None:
        """Ask, give up, pause, or start the idle time anew at every sign of the visitor."""
        match event:
            case happened.TimerExpired(timer=Timer.IDLE):
                self._asked = True
                wait_ms = self._idle.still_there
                outcome.effect(do.AskStillThere(wait_ms), do.StartTimer(Timer.STILL_THERE, wait_ms))
            case happened.TimerExpired(timer=Timer.STILL_THERE | Timer.PAUSE):
                outcome.emit(happened.IdleTimedOut(at_ms=outcome.at_ms))
            case happened.PauseRequested():
                self._paused = True
                self.dismiss(outcome)
                outcome.effect(do.StopTimer(Timer.IDLE), do.ShowPause())
                self.restart(stage, outcome)
            case happened.PauseEnded():
                self._paused = False
                outcome.effect(do.HidePause(), do.StopTimer(Timer.PAUSE))
                self.restart(stage, outcome)
            case happened.UserActivity(ago_ms=ago_ms):
                self.dismiss(outcome)
                self.restart(stage, outcome, ago_ms)
            case _ if event.by_visitor and stage is not Stage.ATTRACT:
                self.dismiss(outcome)
                self.restart(stage, outcome)

    def restart(self, stage: Stage, outcome: OutcomeBuilder, ago_ms: int = 0) -> None:
        """Start the idle time of a stage, so long ago.

        A pause has its own limit, or a visitor could park a booth.
        """
        if self._paused:
            outcome.effect(do.StartTimer(Timer.PAUSE, self._idle.pause))
        else:
            idle_ms = max(self._idle.of(stage.value), self._reading_ms(stage))
            outcome.effect(do.StartTimer(Timer.IDLE, max(1, idle_ms - ago_ms)))

    def resume(self, outcome: OutcomeBuilder) -> None:
        """End a pause together with the session, or after the program that it was cut off with."""
        if self._paused:
            self._paused = False
            outcome.effect(do.HidePause())

    def dismiss(self, outcome: OutcomeBuilder) -> None:
        """Ask no longer whether the visitor is there."""
        if self._asked:
            self._asked = False
            outcome.effect(do.HideStillThere(), do.StopTimer(Timer.STILL_THERE))


class SpeechState:
    """Keeps the sentence in the bubble, and whether it has been said to its end."""

    def __init__(self, speaker: SpeechWriter) -> None:
        """Sentences that are said again get their numbers from the speaker."""
        self._speaker = speaker
        self._robot_lost = False
        self._said: do.Speak | None = None
        self._unsaid: do.Speak | None = None

    def accepts(self, event: WorldEvent) -> bool:
        """Whether this event can happen now."""
        match event:
            case happened.RobotDisconnected():
                return not self._robot_lost
            case happened.RepeatRequested() | happened.RepeatPressed():
                return self._said is not None and self._unsaid is None
        return True

    def react(self, event: WorldEvent, outcome: OutcomeBuilder) -> None:
        """Say something again, have the avatar say what the robot did not, or note that it was said."""
        match event:
            case happened.RobotDisconnected(why=why):
                self._go_on_without_robot(why, outcome)
            case happened.RepeatRequested() | happened.RepeatPressed() if self._said is not None:
                self._speaker.repeat(self._said, outcome)
            case happened.SessionResumed():
                self._robot_lost = False
            case happened.SpeechFinished(utterance=utterance) | happened.SpeechFailed(utterance=utterance):
                if self._unsaid is not None and self._unsaid.utterance == utterance:
                    self._unsaid = None

    def track(self, effects: Iterable[Effect]) -> None:
        """Remember what these effects say, or silence."""
        for effect in effects:
            match effect:
                case do.Speak():
                    self._said = self._unsaid = effect
                case do.StopSpeaking():
                    self._unsaid = None
                case do.ClearBubble():
                    self._said = None

    def _go_on_without_robot(self, why: str, outcome: OutcomeBuilder) -> None:
        """Have the avatar help; it says at once what the robot had not said to its end."""
        self._robot_lost = True
        outcome.emit(happened.EmbodimentChanged(at_ms=outcome.at_ms, embodiment=EmbodimentName.AVATAR, why=why))
        outcome.effect(do.SwitchEmbodiment(EmbodimentName.AVATAR))
        if self._unsaid is not None:
            outcome.effect(self._unsaid)


class StageHandlers:
    """The handlers of a session's stages, all made before it begins, so that a faulty one is refused at once."""

    def __init__(self, plan: SessionConfig, seed: int, log: Callable[[OutcomeBuilder], Sequence[Event]]) -> None:
        """One stream of chance for each purpose: two conditions with the same seed play the same board."""
        self._plan, self._seed = plan, seed
        self.language = plan.language
        self._wording, self._numbers = Wording(plan.catalogue, Random(f"{seed}/words")), count(1)
        self._practice_wording = self._wording
        self.speaker = SpeechWriter(self._wording, self._numbers)
        settings = plan.settings
        makers: dict[Stage, Callable[[], StageHandler]] = {
            Stage.ABOUT: lambda: TextStage(plan.information, lambda sheet: sheet.about, do.ShowAbout),
            Stage.CONSENT: lambda: ConsentStage(plan.information, plan.language, back=plan.visit > 1),
            Stage.AGE: lambda: AgeStage(settings.consent.adult),
            Stage.ABOUT_YOU: lambda: QuestionnaireStage(
                plan.asked_about_you, Random(f"{seed}/about_you"), plan.language
            ),
            Stage.RESULT: lambda: ResultStage(self.speaker, log),
            Stage.QUESTIONS: lambda: QuestionnaireStage(
                plan.asked_after_game, Random(f"{seed}/questions"), plan.language, rates=True
            ),
            Stage.DEBRIEF: lambda: TextStage(plan.information, lambda sheet: sheet.debrief, do.ShowDebrief),
            Stage.THANKS: lambda: ThanksStage(self.speaker, plan.timing.thanks_ms),
        }
        # All at once, so that what cannot be made is refused before a visitor sits there; but only what the study has.
        self._handlers: dict[Stage, StageHandler] = {
            stage: makers[stage]() for stage in plan.stage_order.stages if stage in makers
        }
        self._play_in(plan.condition)

    def play_by_chance(self) -> None:
        """Play the game in a random condition of the study, so that an unstored visitor reveals no order."""
        listed = sorted(self._plan.settings.randomisation.target_n) or [self._plan.condition.name]
        self._play_in(Condition(Random(f"{self._seed}/unstored").choice(listed)))

    def _play_in(self, condition: Condition) -> None:
        plan = self._plan.in_condition(condition)
        game = _game(plan, self._seed, self._wording, self._numbers)
        pairs = game.game.board.pairs
        self._handlers[Stage.GAME] = game
        self._handlers[Stage.INTRODUCTION] = IntroductionStage(
            self.speaker, pairs, helped=game.helped, points=plan.cell.marks
        )
        if Stage.PRACTICE in plan.stage_order.stages:
            self._handlers[Stage.PRACTICE] = self._practice(plan)

    def translate(self, to: Translation) -> None:
        """Have all stages speak another language from now on."""
        self.language = to.catalogue.language
        self._wording.catalogue = self._practice_wording.catalogue = to.catalogue
        for handler in self._handlers.values():
            handler.translate(to)

    def of(self, stage: Stage) -> StageHandler:
        """Return the handler of a stage; before the first and after the last one it shows nothing."""
        return self._handlers.get(stage, _NOTHING)

    def _practice(self, plan: SessionConfig) -> PracticeStage:
        """Make the practice; its hints have streams of chance of their own, and change nothing of the game."""
        practice, seed = plan.settings.practice, self._seed
        board = _deal(practice, plan.practice_deck, Random(f"{seed}/practice"))
        samples = None
        if practice.hints:
            self._practice_wording = Wording(self._wording.catalogue, Random(f"{seed}/practice/words"))
            rule = TargetRule(plan.settings.assistance.target_rule)
            given = help_in(plan.cell, rule, self._practice_wording, Random(f"{seed}/practice/targets"))
            samples = SampleHints.of(given, plan.policy.actions, self._numbers) if given is not None else None
        table = DealtTable(board, practice.deck, practice=True)
        return PracticeStage(table, plan.timing, self.speaker, practice.max_duration_ms, samples)


_NOTHING = StageHandler()


def _game(plan: SessionConfig, seed: int, wording: Wording, numbers: Iterator[int]) -> GameStage:
    settings = plan.settings
    deal, targets, explored = (Random(f"{seed}/{purpose}") for purpose in ("deal", "targets", "explore"))
    rule = TargetRule(settings.assistance.target_rule)
    given = help_in(plan.cell, rule, wording, targets)
    assistant = assistant_with(plan.policy, given.mentaliser, settings.assistance, explored) if given else None
    hesitation = HesitationRule.of(settings.assistance)
    guide = HintGuide(assistant, given.sentences, hesitation) if given and assistant else None
    table = DealtTable(_deal(settings.game, plan.deck, deal), settings.game.deck)
    return GameStage(table, guide, plan.timing, numbers, _comments(plan, seed, wording))


def _comments(plan: SessionConfig, seed: int, wording: Wording) -> MoveComments | None:
    """Return what comments on moves, if the condition has comments.

    Chance has a stream of its own, so that no hint is another one for a comment.
    """
    rule = CommentRule.of(plan.cell)
    if rule is None:
        return None
    return MoveComments(Commentator(rule, Random(f"{seed}/comments")), PlainSentences(wording))


def _deal(game: Game | Practice, cards: tuple[str, ...], chance: Random) -> Board:
    try:
        return Board.deal(game.rows, game.columns, cards, chance)
    except ValueError as error:
        raise UserInputError(f"no game can be dealt from the deck {game.deck!r}: {error}") from error


class Session:
    """One session, from the visitor's first tap to its end."""

    def __init__(self, plan: SessionConfig, seed: int) -> None:
        """Follow ``plan``; the same seed and the same events give the same outcomes.

        Raises UserInputError if a deck has too few cards for its board, or the stages cannot come in their order.
        """
        self.stage = Stage.ATTRACT
        self.keeping = RecordingState.UNDECIDED
        self._course = plan.stage_order
        self._timing = plan.timing
        self._closed_in: Stage | None = None
        self._plan = plan
        self._offers_back = False
        self._text_size, self._sound = TextSize.NORMAL, True
        self._log: list[Event] = []
        self._measured = (0, Measures())
        self._waiting: set[Timer] = set()
        self._handlers = StageHandlers(plan, seed, lambda outcome: [*self._log, *outcome.events])
        self._presence = IdleTimeout(plan.settings.idle_ms, self._reading_ms)
        self._talk = SpeechState(self._handlers.speaker)

    def handle(self, event: WorldEvent) -> Outcome:
        """Return what one event leads to; raise InvalidTransition, and change nothing, if it has no place now."""
        self.check(event)
        outcome = OutcomeBuilder(event.at_ms)
        self._presence.react(event, self.stage, outcome)
        self._talk.react(event, outcome)
        self._react(event, outcome)
        self._handlers.of(self.stage).react(event, outcome)
        for step in (event, *outcome.events):
            self._go_on_after(step, outcome)
        self._offer_back(outcome)
        self._log += [event, *outcome.events]
        self._keep_track(outcome)
        return outcome.build()

    @property
    def measures(self) -> Measures:
        """The measures of the game so far; they are worked out once for each event."""
        if self._measured[0] != len(self._log):
            self._measured = (len(self._log), measure(self._log))
        return self._measured[1]

    def _reading_ms(self, stage: Stage) -> int:
        """How long it takes to read the longest page of a stage."""
        return self._timing.reading_ms_per_char * self._handlers.of(stage).characters

    def check(self, event: WorldEvent) -> None:
        """Raise InvalidTransition if this event has no place now."""
        check_expected(self.stage, event)
        parts = (self._presence, self._talk, self._handlers.of(self.stage))
        if not self._can_come(event) or not all(part.accepts(event) for part in parts):
            raise InvalidTransition(self.stage, event)

    def _can_come(self, event: WorldEvent) -> bool:
        match event:
            case happened.TimerExpired(timer=timer):
                return timer in self._waiting
            case happened.BackPressed():
                return self._can_go_back
            case happened.LanguageSelected(language=language):
                return language != self._handlers.language and self._plan.translation(language) is not None
            case happened.CardSelected(trace=trace) if trace:
                return self.traces_pointer
            case happened.SessionResumed():
                return self.keeping is RecordingState.KEPT and self._cut_off_in not in (Stage.GAME, Stage.OVER)
        return True

    @property
    def traces_pointer(self) -> bool:
        """Whether the way of the pointer may be recorded: the study asks for it, and the visitor agreed to it."""
        return self._plan.settings.privacy.pointer_trace and any(
            isinstance(event, happened.ConsentGiven) and POINTER in event.purposes for event in self._log
        )

    @property
    def may_return(self) -> bool:
        """Whether the visitor can come back with their code: the study lets them, and they agreed to it."""
        return self._plan.settings.returning.enabled and any(
            isinstance(event, happened.ConsentGiven) and RETURNING in event.purposes for event in self._log
        )

    def _react(self, event: WorldEvent, outcome: OutcomeBuilder) -> None:
        """Take note of the few events that concern the session as a whole."""
        match event:
            case happened.TimerExpired(timer=timer):
                self._waiting.discard(timer)
            case happened.SessionResumed():
                self._resume(outcome)
            case happened.ConsentDeclined():
                self._forget(NotRecordedReason.DECLINED, outcome)
            case happened.AgeConfirmed(adult=False):
                self._forget(NotRecordedReason.UNDER_AGE, outcome)
            case happened.LanguageSelected(language=language):
                self._translate(language, outcome)
            case happened.TextSizeSelected(size=size):
                self._text_size = size
                outcome.effect(do.SetTextSize(size))
            case happened.SoundSelected(on=on):
                self._sound = on
                outcome.effect(do.SetSound(on))

    def _translate(self, language: str, outcome: OutcomeBuilder) -> None:
        translation = self._plan.translation(language)
        if translation is not None:
            self._handlers.translate(translation)
            outcome.effect(do.SetLanguage(language))
            self._handlers.of(self.stage).show_again(outcome)

    @property
    def _can_go_back(self) -> bool:
        """Whether there is a page before that the visitor can go back to."""
        return self._handlers.of(self.stage).goes_back or self._stage_before is not None

    @property
    def _stage_before(self) -> Stage | None:
        return self._course.before(self.stage, kept=self.keeping is not RecordingState.FORGOTTEN)

    def _offer_back(self, outcome: OutcomeBuilder) -> None:
        """Let the visitor go back where that leads somewhere."""
        if self._can_go_back is not self._offers_back:
            self._offers_back = not self._offers_back
            outcome.effect(do.OfferBack(self._offers_back))

    def _resume(self, outcome: OutcomeBuilder) -> None:
        """Begin the stage anew in which the session was cut off."""
        self.stage = self._cut_off_in
        self._closed_in = None
        self._presence.resume(outcome)
        # The window has begun anew, and knows nothing of what the visitor chose.
        self._offers_back = False
        outcome.effect(do.SetLanguage(self._handlers.language))
        outcome.effect(do.SetTextSize(self._text_size), do.SetSound(self._sound))
        self._leave_stage(outcome)
        self._enter(self.stage, outcome)

    @property
    def _cut_off_in(self) -> Stage:
        """Return where the session would go on if it were resumed.

        A crash leaves it where it was, a closed kiosk ends it.
        """
        return self._closed_in or self.stage

    def _go_on_after(self, event: Event, outcome: OutcomeBuilder) -> None:
        """Enter the next stage, if this event leads to one."""
        match transition(self.stage, event):
            case Transition.ON:
                after = self._course.after(self.stage, kept=self.keeping is not RecordingState.FORGOTTEN)
                self._change_stage(after, Status.COMPLETED, outcome)
            case Transition.BACK if self._stage_before is not None:
                self._leave_stage(outcome)
                self.stage = self._stage_before
                self._enter(self.stage, outcome, back=True)
            case Transition.OVER:
                self._closed_in = self.stage if isinstance(event, happened.ApplicationClosed) else None
                self._change_stage(Stage.OVER, _ENDINGS[type(event)], outcome)

    def _change_stage(self, stage: Stage, ending: Status, outcome: OutcomeBuilder) -> None:
        self._leave_stage(outcome)
        self.stage = stage
        if stage is Stage.OVER:
            outcome.emit(happened.StageEntered(at_ms=outcome.at_ms, stage=stage))
            self._end(ending, outcome)
        else:
            self._keep_from(stage, outcome)
            self._enter(stage, outcome)

    def _leave_stage(self, outcome: OutcomeBuilder) -> None:
        """Stop all that belongs to the stage: its waits, its words, and the question over it."""
        running = {*self._waiting, *(c.timer for c in outcome.effects if isinstance(c, do.StartTimer))}
        outcome.effect(do.StopSpeaking(), do.ClearBubble())
        outcome.effect(*(do.StopTimer(timer) for timer in Timer if timer in running))
        self._presence.dismiss(outcome)

    def _enter(self, stage: Stage, outcome: OutcomeBuilder, *, back: bool = False) -> None:
        outcome.emit(happened.StageEntered(at_ms=outcome.at_ms, stage=stage))
        self._presence.restart(stage, outcome)
        handler = self._handlers.of(stage)
        outcome.effect(do.SetExpression(handler.mood))
        (handler.come_back if back else handler.enter)(outcome)

    def _keep_from(self, stage: Stage, outcome: OutcomeBuilder) -> None:
        """Record from this stage on if the visitor is past all that is decided beforehand."""
        if self.keeping is RecordingState.UNDECIDED and stage not in BEFORE_DECIDING:
            self.keeping = RecordingState.KEPT
            outcome.recording = do.StartRecording()

    def _forget(self, why: NotRecordedReason, outcome: OutcomeBuilder) -> None:
        if self.keeping is RecordingState.UNDECIDED:
            self.keeping = RecordingState.FORGOTTEN
            self._handlers.play_by_chance()
            outcome.recording = do.DiscardRecording(why)

    def _end(self, status: Status, outcome: OutcomeBuilder) -> None:
        self._forget(NotRecordedReason.LEFT, outcome)
        self._presence.resume(outcome)
        outcome.emit(happened.SessionEnded(at_ms=outcome.at_ms, status=status))
        outcome.effect(do.SetExpression(Mood.IDLE))

    def _keep_track(self, outcome: OutcomeBuilder) -> None:
        """Remember which waits are running, so that the end of any other can be refused, and what is being said."""
        self._talk.track(outcome.effects)
        for effect in outcome.effects:
            match effect:
                case do.StartTimer(timer=timer):
                    self._waiting.add(timer)
                case do.StopTimer(timer=timer):
                    self._waiting.discard(timer)


_ENDINGS = {
    happened.IdleTimedOut: Status.ABANDONED,
    happened.AbortRequested: Status.STOPPED,
    happened.StopPressed: Status.WITHDRAWN,
    happened.ApplicationClosed: Status.INTERRUPTED,
}
