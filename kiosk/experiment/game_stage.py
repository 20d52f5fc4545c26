"""One game with its help: what taps, finished sentences and ended waits lead to on the board.

A hint holds the board from the moment it is given until it has been heard or could be read. Its mark never comes
later than the board opens, so that no flip can be made in ignorance of it; the next flip clears it. Where the study
says that taps do not wait, the board is open all the time, and a flip ends the sentence or lets it be said to its end.
"""

from __future__ import annotations

from collections.abc import Iterator

from kiosk.assistance.assistant import Assistant, Decision
from kiosk.assistance.comments import Comment, Commentator
from kiosk.assistance.hesitation import HesitationRule
from kiosk.assistance.hint_sentences import Sentences
from kiosk.assistance.mentaliser import Hint
from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.config import Timing
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.effects import BoardWait, Mood, OutcomeBuilder
from kiosk.experiment.events import HintCue, RemarkTrigger, Timer, WorldEvent
from kiosk.experiment.hesitation_watch import HesitationWatch
from kiosk.experiment.page_stages import StageHandler
from kiosk.game import Board, Concentration, Flip, IllegalFlip, Position
from kiosk.lazy_dataclass import dataclass


@dataclass(frozen=True)
class HintGuide:
    """Who decides the help, and what is said with it."""

    assistant: Assistant
    sentences: Sentences
    hesitation: HesitationRule | None = None
    """When a player who hesitates gets help; None if they never do."""


@dataclass(frozen=True)
class MoveComments:
    """Who comments on moves, and what is said then."""

    commentator: Commentator
    sentences: Sentences


_NO_UTTERANCE = 0
"""The number of no sentence; those of a session count from 1."""


@dataclass
class _Given:
    """The hint or remark that stands: whether it still holds the board, and whether its mark is on it."""

    hint: Hint | None
    action: ActionSpec
    flip: int
    utterance: int
    sentence: str
    at_ms: int
    cue: HintCue = HintCue.WORDS
    holds: bool = True
    """Whether it is still being said, or read; cards can be tapped meanwhile if the study says so."""
    is_read: bool = False
    """Whether its voice failed, so that it is only to be read."""
    told: bool = False
    """Whether it has been heard, or could be read."""
    held_long_enough: bool = True
    """Whether the least time of a hold is over."""
    marked: bool = False

    def hint_event(self, hint: Hint) -> happened.HintGiven:
        """Return the hint as it is recorded."""
        return happened.HintGiven(
            at_ms=self.at_ms,
            flip=self.flip,
            card=hint.card,
            action=hint.action,
            target=hint.target.position,
            name=hint.name,
            seen=hint.target.seen,
            mate_seen=hint.target.mate_seen,
            reason=hint.target.reason,
            allowed=len(hint.target.candidates),
            target_probability=1 / len(hint.target.candidates),
            row=hint.row,
            column=hint.column,
            sentence=self.sentence,
            utterance=self.utterance,
            cue=self.cue,
        )


@dataclass(frozen=True)
class DealtTable:
    """A dealt board, and the deck that its cards are from."""

    board: Board
    deck: str
    practice: bool = False


class GameStage(StageHandler):
    """A game on one board, helped or not."""

    def __init__(
        self,
        table: DealtTable,
        guide: HintGuide | None,
        timing: Timing,
        utterances: Iterator[int],
        comments: MoveComments | None = None,
    ) -> None:
        """Without a guide there is no help; ``utterances`` numbers the sentences of the whole session."""
        self.game = Concentration(table.board)
        self._table = table
        self._guide = guide
        self._comments = comments
        speaker = guide or comments
        self._sentences = speaker.sentences if speaker is not None else None
        rule = guide.hesitation if guide is not None else None
        self._hesitation = HesitationWatch(rule) if rule is not None else None
        self._timing = timing
        self._utterances = utterances
        self._given: _Given | None = None
        self._trailing: int | None = None
        """The sentence of an earlier flip's hint that is still being said."""
        self._reacts = False
        """Whether the assistant's face shows what came of the last hint."""

    @property
    def helped(self) -> bool:
        """Whether there is an assistant."""
        return self._guide is not None

    def enter(self, outcome: OutcomeBuilder) -> None:
        """Show and open the board."""
        board, table = self.game.board, self._table
        outcome.emit(
            happened.BoardDealt(at_ms=outcome.at_ms, rows=board.rows, columns=board.columns, cards=board.cards)
        )
        outcome.effect(do.ShowBoard(board.rows, board.columns, board.pairs, table.deck, table.practice))
        self._help_or_open(outcome)

    def react(self, event: WorldEvent, outcome: OutcomeBuilder) -> None:
        """Follow a tap, the end of a wait, or a report of the voice."""
        self._watch_hesitation(event, outcome)
        match event:
            case happened.CardSelected(position=position):
                self._select_card(position, outcome)
            case happened.SpeechStarted(utterance=utterance) if self._is_unmarked(utterance):
                # The mark follows the voice.
                outcome.effect(do.StartTimer(Timer.MARK, self._timing.highlight_delay_ms))
            case happened.TimerExpired(timer=Timer.MARK):
                self._mark(outcome)
            case happened.SpeechFinished(utterance=utterance) if self._holding(utterance):
                self._release_board(outcome)
            case happened.SpeechFinished(utterance=utterance) | happened.SpeechFailed(utterance=utterance) if (
                utterance == self._trailing
            ):
                self._end_trailing(outcome)
            case happened.SpeechFailed(utterance=utterance):
                self._let_be_read(utterance, outcome)
            case happened.TimerExpired(timer=timer):
                self._go_on_after(timer, outcome)

    def show_again(self, outcome: OutcomeBuilder) -> None:
        """Give the hint that stands in the present language; a sentence that is being said starts anew."""
        given, sentences = self._given, self._sentences
        if given is None or sentences is None or given.cue is HintCue.GAZE:
            return
        given.sentence = sentences.remark(given.action) if given.hint is None else sentences.sentence(given.hint)
        given.utterance = next(self._utterances)
        outcome.emit(
            happened.SentenceRequested(at_ms=outcome.at_ms, utterance=given.utterance, sentence=given.sentence)
        )
        outcome.effect(do.StopSpeaking(), _speak(given, sentences))
        if given.holds and not given.told:
            outcome.effect(
                do.StopTimer(Timer.READING),
                do.StartTimer(Timer.SPEECH_DEADLINE, self._timing.speech_time(given.sentence)),
            )

    def _select_card(self, position: Position, outcome: OutcomeBuilder) -> None:
        """Flip the card if that is possible now; if not, say why and change nothing."""
        if self._given is not None and self._given.holds and self._timing.taps_wait:
            outcome.emit(happened.CardSelectionRejected(at_ms=outcome.at_ms, position=position, why=None))
            return
        try:
            flip = self.game.flip(position)
        except IllegalFlip as refusal:
            outcome.emit(happened.CardSelectionRejected(at_ms=outcome.at_ms, position=position, why=refusal.refusal))
            return
        if self._hesitation is not None:
            self._hesitation.end_wait(flip, outcome)
        given, self._given = self._given, None
        if given is not None and given.holds and not given.is_read and self._timing.tap_ends_sentence:
            outcome.emit(happened.SpeechCutShort(at_ms=outcome.at_ms, utterance=given.utterance))
        outcome.emit(
            happened.CardFlipped(
                at_ms=outcome.at_ms,
                number=flip.number,
                move=flip.move,
                position=flip.position,
                card=flip.card,
                matched=flip.matched,
            )
        )
        if given is not None:
            self._put_away(given, outcome)
        outcome.effect(do.RevealCard(flip.position, flip.card))
        if flip.matched is None:
            self._compose(outcome)
            self._help_or_open(outcome)
        else:
            self._move_completed(flip, given, outcome)

    def _compose(self, outcome: OutcomeBuilder) -> None:
        """End the face about the last move, which would be read as one about the card that was just turned."""
        if self._reacts:
            self._reacts = False
            outcome.effect(do.StopTimer(Timer.MOOD), do.SetExpression(Mood.IDLE))

    def _put_away(self, given: _Given, outcome: OutcomeBuilder) -> None:
        """Clear the hint of the flip that was just made.

        Its sentence ends too, unless the study lets it be said.
        """
        outcome.effect(do.ClearHighlight())
        if given.holds:
            outcome.effect(do.StopTimer(Timer.MARK), do.StopTimer(Timer.READING))
            if not given.is_read and not self._timing.tap_ends_sentence:
                self._trailing = given.utterance
                return
            outcome.effect(do.StopTimer(Timer.SPEECH_DEADLINE))
        # Where taps wait, only a sentence that is said again can still be under way.
        outcome.effect(do.StopSpeaking(), do.ClearBubble())

    def _end_trailing(self, outcome: OutcomeBuilder) -> None:
        if self._trailing is not None:
            self._trailing = None
            outcome.effect(do.StopTimer(Timer.SPEECH_DEADLINE), do.ClearBubble())

    def _go_on_after(self, timer: Timer, outcome: OutcomeBuilder) -> None:
        """Go on after a wait."""
        match timer:
            case Timer.TURN_BACK:
                outcome.effect(do.HideCards(self.game.turning_back))
                self.game.turn_back()
                self._help_or_open(outcome)
            case Timer.READING:
                self._release_board(outcome)
            case Timer.HOLD if self._given is not None:
                self._given.held_long_enough = True
                if self._given.told:
                    self._release_board(outcome)
            case Timer.SPEECH_DEADLINE:
                outcome.effect(do.StopSpeaking())
                self._end_trailing(outcome)
                self._release_board(outcome)
            case Timer.MOOD:
                self._reacts = False
                outcome.effect(do.SetExpression(Mood.IDLE))
            case Timer.FINISH:
                self.finish(outcome)

    def finish(self, outcome: OutcomeBuilder) -> None:
        """Every pair was found, and has been looked at."""
        outcome.emit(happened.GameFinished(at_ms=outcome.at_ms))

    def _let_be_read(self, utterance: int, outcome: OutcomeBuilder) -> None:
        """Give a hint that will not be heard what is left of its reading time.

        The time counts from when it was shown.
        """
        given = self._holding(utterance)
        if given is not None:
            given.is_read = True
            shown_ms = outcome.at_ms - given.at_ms
            outcome.effect(
                do.StopTimer(Timer.SPEECH_DEADLINE),
                do.StartTimer(Timer.MARK, max(0, self._timing.highlight_delay_silent_ms - shown_ms)),
                do.StartTimer(Timer.READING, max(0, self._timing.reading_time(given.sentence) - shown_ms)),
            )

    def _move_completed(self, flip: Flip, given: _Given | None, outcome: OutcomeBuilder) -> None:
        outcome.effect(do.ShowProgress(self.game.pairs_found, self.game.moves))
        hint = given.hint if given is not None else None
        if hint is not None:
            self._reacts = True
            outcome.effect(do.SetExpression(_reaction(hint, flip)), do.StartTimer(Timer.MOOD, self._timing.mood_ms))
        if not flip.matched:
            outcome.effect(
                do.LockBoard(BoardWait.TURNING_BACK), do.StartTimer(Timer.TURN_BACK, self._timing.mismatch_shown_ms)
            )
            return
        outcome.effect(do.MarkMatched((flip.position, self.game.board.mate(flip.position))))
        if self.game.over:
            self._let_be_looked_at(outcome)
        else:
            self._help_or_open(outcome)

    def _let_be_looked_at(self, outcome: OutcomeBuilder) -> None:
        """Let the last pair be looked at; what was learnt from this game, if anything, is put on record."""
        learnt = self._guide.assistant.finish(self.game) if self._guide else None
        if learnt is not None:
            outcome.emit(happened.PolicyUpdated(at_ms=outcome.at_ms, sha256=learnt))
        outcome.effect(do.StartTimer(Timer.FINISH, self._timing.finish_ms))

    def _help_or_open(self, outcome: OutcomeBuilder) -> None:
        """Decide about the coming flip; the board is open unless a hint holds it."""
        action, hint = self._choose_help(outcome)
        if self._sentences is not None and action is not ActionSpec.NO_HELP:
            self._give(action, hint, self._sentences, outcome)
            return
        comment = self._comments.commentator.comment(self.game) if self._comments is not None else None
        if self._comments is not None and comment is not None:
            self._give(comment.action, None, self._comments.sentences, outcome, comment)
            return
        outcome.effect(do.UnlockBoard())
        if self._hesitation is not None:
            self._hesitation.begin_wait(self.game, outcome)

    def _give(
        self,
        action: ActionSpec,
        hint: Hint | None,
        sentences: Sentences,
        outcome: OutcomeBuilder,
        comment: Comment | None = None,
    ) -> None:
        """Say a hint or a remark, and hold the board with it."""
        if hint is not None and not sentences.speaks:
            self._look(hint, outcome)
            return
        sentence = sentences.remark(action) if hint is None else sentences.sentence(hint)
        given = _Given(hint, action, self.game.flips + 1, next(self._utterances), sentence, outcome.at_ms)
        given.held_long_enough = self._timing.hold_min_ms == 0
        self._given, self._trailing = given, None
        outcome.emit(
            given.hint_event(hint)
            if hint
            else happened.RemarkGiven(
                at_ms=outcome.at_ms,
                flip=given.flip,
                card=FlipInMove.coming(self.game),
                action=action,
                sentence=sentence,
                utterance=given.utterance,
                trigger=RemarkTrigger.DECISION if comment is None else RemarkTrigger.COMMENT,
                probability=1.0 if comment is None else comment.probability,
            )
        )
        self._hold_or_open(BoardWait.SPEAKING, outcome)
        if self._timing.highlight_delay_ms == 0:
            self._mark(outcome)
        outcome.effect(
            _speak(given, sentences),
            do.StartTimer(Timer.SPEECH_DEADLINE, self._timing.speech_time(sentence)),
        )
        if not given.held_long_enough:
            outcome.effect(do.StartTimer(Timer.HOLD, self._timing.hold_min_ms))

    def _look(self, hint: Hint, outcome: OutcomeBuilder) -> None:
        """Give a hint that is a look.

        It holds the board for its own time, and then stays until the next flip.
        """
        given = _Given(hint, hint.action, self.game.flips + 1, _NO_UTTERANCE, "", outcome.at_ms, HintCue.GAZE)
        # There is no voice to wait for, and nothing to mark.
        given.is_read = given.marked = True
        self._given, self._trailing = given, None
        outcome.emit(given.hint_event(hint))
        self._hold_or_open(BoardWait.LOOKING, outcome)
        looks_ms = max(self._timing.gaze_ms, self._timing.hold_min_ms)
        outcome.effect(do.LookAt(hint.row, hint.column), do.StartTimer(Timer.READING, looks_ms))

    def _hold_or_open(self, wait: BoardWait, outcome: OutcomeBuilder) -> None:
        """Hold the board while a hint is given, or open it at once where taps do not wait."""
        if self._timing.taps_wait:
            outcome.effect(do.LockBoard(wait))
        else:
            outcome.emit(happened.BoardUnlocked(at_ms=outcome.at_ms))
            outcome.effect(do.UnlockBoard())

    def _watch_hesitation(self, event: WorldEvent, outcome: OutcomeBuilder) -> None:
        """Give a hint to a player who hesitates."""
        watch, guide = self._hesitation, self._guide
        wait = watch.wait_to_help(event, self.game, outcome) if watch is not None and self._given is None else None
        if watch is None or guide is None or wait is None:
            return
        hint = guide.assistant.offer(self.game, watch.action)
        outcome.emit(
            happened.HesitationNoticed(
                at_ms=outcome.at_ms,
                flip=self.game.flips + 1,
                card=hint.card,
                waited_ms=wait.waited_ms,
                usual_ms=wait.usual_ms,
                threshold_ms=wait.threshold_ms,
                action=hint.action,
            )
        )
        self._give(hint.action, hint, guide.sentences, outcome)

    def _choose_help(self, outcome: OutcomeBuilder) -> tuple[ActionSpec, Hint | None]:
        """Return the action for the coming flip, and its hint if it points to a card."""
        if self._guide is None:
            return ActionSpec.NO_HELP, None
        decision = self._decide(self._guide, outcome)
        return decision.action, decision.hint

    def _decide(self, guide: HintGuide, outcome: OutcomeBuilder) -> Decision:
        decision = guide.assistant.decide(self.game)
        outcome.emit(
            happened.AssistanceDecided(
                at_ms=outcome.at_ms,
                flip=self.game.flips + 1,
                card=FlipInMove.coming(self.game),
                game=decision.state.game,
                last=decision.state.last,
                outcome=decision.state.outcome,
                gate=decision.gate_decision,
                action=decision.action,
                greedy=decision.greedy,
                probability=decision.probability,
                randomised=decision.is_randomised,
            )
        )
        if decision.memory is not None:
            outcome.emit(happened.MemoryEstimated.of(decision.memory, self.game.flips + 1, outcome.at_ms))
        return decision

    def _holding(self, utterance: int) -> _Given | None:
        """Return the hint that holds the board, if this is its sentence."""
        given = self._given
        return given if given is not None and given.holds and given.utterance == utterance else None

    def _is_unmarked(self, utterance: int) -> bool:
        given = self._holding(utterance)
        return given is not None and not given.marked

    def _release_board(self, outcome: OutcomeBuilder) -> None:
        """Mark a hint that was taken in, and open the board once it was held long enough."""
        if self._given is None or not self._given.holds:
            return
        self._given.told = True
        if not self._given.held_long_enough:
            outcome.effect(*(do.StopTimer(timer) for timer in (Timer.READING, Timer.SPEECH_DEADLINE)))
            return
        self._given.holds = False
        self._mark(outcome)
        if self._timing.taps_wait:
            outcome.emit(happened.BoardUnlocked(at_ms=outcome.at_ms))
            outcome.effect(do.UnlockBoard())
        outcome.effect(*(do.StopTimer(timer) for timer in (Timer.MARK, Timer.READING, Timer.SPEECH_DEADLINE)))

    def _mark(self, outcome: OutcomeBuilder) -> None:
        given = self._given
        if given is not None and given.hint is not None and given.hint.target.is_located and not given.marked:
            given.marked = True
            outcome.emit(happened.HintHighlighted(at_ms=outcome.at_ms, flip=given.flip))
            outcome.effect(do.HighlightHint(given.hint.row, given.hint.column))


def _speak(given: _Given, sentences: Sentences) -> do.Speak:
    """Return the effect that says a hint or a remark."""
    advice = "" if given.hint is None else sentences.advice(given.hint, given.sentence)
    return do.Speak(given.utterance, given.sentence, advice)


def _reaction(hint: Hint, flip: Flip) -> Mood:
    """Return the face after a helped second flip.

    It is glad, sad when the help was followed in vain, confused when it was not followed.
    """
    if flip.matched:
        return Mood.HAPPY
    return Mood.SAD if hint.followed_by(flip.position) else Mood.CONFUSED
