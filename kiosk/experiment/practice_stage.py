"""The practice: the game before the game, with sample hints or without help."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from kiosk.assistance.hint_sentences import Sentences
from kiosk.assistance.mentaliser import Hint, Mentaliser
from kiosk.assistance.policy import ActionSpec
from kiosk.config import Timing
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Help
from kiosk.experiment.effects import OutcomeBuilder
from kiosk.experiment.events import PracticeEnd, Timer, WorldEvent
from kiosk.experiment.game_stage import DealtTable, GameStage
from kiosk.experiment.page_stages import SpeechWriter
from kiosk.game import CARDS_IN_A_PAIR, Concentration
from kiosk.lazy_dataclass import dataclass

_SAMPLE_EVERY = 3
"""From one hint of a practice to the next, in flips: an odd number, so that first and second cards take turns."""


@dataclass(frozen=True)
class SampleHints:
    """One hint of each kind for a practice, so that the game brings no kind for the first time."""

    mentaliser: Mentaliser
    sentences: Sentences
    actions: tuple[ActionSpec, ...]
    utterances: Iterator[int]

    @classmethod
    def of(cls, help_: Help, actions: Iterable[ActionSpec], utterances: Iterator[int]) -> SampleHints:
        """Take the actions that differ for the visitor: where no place is named, all hints are of one kind.

        ``utterances`` numbers the sentences of the whole session.
        """
        kinds: dict[str, ActionSpec] = {}
        for action in actions:
            if action is not ActionSpec.NO_HELP:
                pointing = action.needs_target and not help_.mentaliser.locates
                kinds.setdefault("reminder" if pointing else action.name, action)
        return cls(help_.mentaliser, help_.sentences, tuple(kinds.values()), utterances)

    def due(self, game: Concentration) -> ActionSpec | None:
        """Return the action for the coming flip of ``game``, or None.

        The hints come before flips 2, 5, 8 and so on, so that first and second cards take turns; on a board with too
        few pairs for that, they come closer together.
        """
        if not self.actions:
            return None
        every = max(1, min(_SAMPLE_EVERY, CARDS_IN_A_PAIR * game.board.pairs // len(self.actions)))
        turn, early = divmod(game.flips + 1 - CARDS_IN_A_PAIR, every)
        if every == 1:
            turn, early = game.flips, 0
        return self.actions[turn] if early == 0 and 0 <= turn < len(self.actions) else None


class PracticeStage(GameStage):
    """The game before the game; it ends when done, when left, or after its time.

    It has no help, or one hint of each kind that the game can bring. No policy decides these, so no decision is
    recorded with them, and nothing is learnt.
    """

    def __init__(
        self,
        table: DealtTable,
        timing: Timing,
        speaker: SpeechWriter,
        longest_ms: int,
        samples: SampleHints | None = None,
    ) -> None:
        """End by itself after so long."""
        super().__init__(table, None, timing, samples.utterances if samples is not None else iter(()))
        self._speaker = speaker
        self._longest_ms = longest_ms
        self._samples = samples
        self._sentences = samples.sentences if samples is not None else None

    def enter(self, outcome: OutcomeBuilder) -> None:
        """Deal as before, also when it begins anew."""
        self.game = Concentration(self.game.board)
        self._given = self._trailing = None
        super().enter(outcome)
        outcome.effect(do.StartTimer(Timer.PRACTICE, self._longest_ms))
        # On a board so small that the first flip has a hint, the hint is what is said.
        if self._given is None:
            self._speaker.say("practice-speech", outcome, "practice-turn")

    def show_again(self, outcome: OutcomeBuilder) -> None:
        """Say the hint that stands, or what there is to do, in the present language."""
        if self._given is not None:
            super().show_again(outcome)
        elif self.game.flips == 0:
            self._speaker.say_again(outcome)

    def _choose_help(self, outcome: OutcomeBuilder) -> tuple[ActionSpec, Hint | None]:  # noqa: ARG002
        action = self._samples.due(self.game) if self._samples is not None else None
        if self._samples is None or action is None:
            return ActionSpec.NO_HELP, None
        if not action.needs_target:
            return action, None
        return action, Hint.coming(action, self._samples.mentaliser.target(self.game), self.game)

    def react(self, event: WorldEvent, outcome: OutcomeBuilder) -> None:
        """End early, or play."""
        match event:
            case happened.PracticeSkipped():
                self._end(PracticeEnd.LEFT, outcome)
            case happened.TimerExpired(timer=Timer.PRACTICE):
                self._end(PracticeEnd.TIME, outcome)
            case _:
                super().react(event, outcome)

    def finish(self, outcome: OutcomeBuilder) -> None:
        """Every pair was found."""
        self._end(PracticeEnd.FOUND, outcome)

    def _end(self, how: PracticeEnd, outcome: OutcomeBuilder) -> None:
        outcome.emit(happened.PracticeFinished(at_ms=outcome.at_ms, how=how))
