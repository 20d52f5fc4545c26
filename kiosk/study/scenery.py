"""Builds the scenes of one sitting from its plan and its seed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import count
from random import Random

from kiosk import BadInput
from kiosk.assistant.adaptation import assistant_with
from kiosk.assistant.mentaliser import TargetRule
from kiosk.assistant.wording import Wording
from kiosk.game import Board
from kiosk.settings import Game, Practice
from kiosk.study.commands import Script
from kiosk.study.condition import Condition, help_in
from kiosk.study.events import Event, Stage
from kiosk.study.plan import Plan
from kiosk.study.scenes.asking import Asking
from kiosk.study.scenes.deciding import AgeGate, Consent
from kiosk.study.scenes.play import Guide, Play, PracticePlay, Table
from kiosk.study.scenes.reading import About, Debrief, Introduction, Result, Thanks
from kiosk.study.scenes.scene import Scene, Speaker


class Scenery:
    """The scenes of a sitting, all of them made before it begins, so that what cannot be made is refused at once."""

    def __init__(self, plan: Plan, seed: int, log: Callable[[Script], Sequence[Event]]) -> None:
        """One stream of chance for each purpose: two conditions with the same seed play the same board."""
        self._plan, self._seed = plan, seed
        self._wording, self._numbers = Wording(plan.catalogue, Random(f"{seed}/words")), count(1)
        self.speaker = Speaker(self._wording, self._numbers)
        settings = plan.settings
        makers: dict[Stage, Callable[[], Scene]] = {
            Stage.ABOUT: lambda: About(plan.information.about),
            Stage.CONSENT: lambda: Consent(plan.information, plan.language),
            Stage.AGE: lambda: AgeGate(settings.consent.adult),
            Stage.ABOUT_YOU: lambda: Asking((plan.about_you,), Random(f"{seed}/about_you"), plan.language),
            Stage.PRACTICE: lambda: self._practice(plan, Random(f"{seed}/practice")),
            Stage.RESULT: lambda: Result(self.speaker, log),
            Stage.QUESTIONS: lambda: Asking(plan.questionnaires, Random(f"{seed}/questions"), plan.language),
            Stage.DEBRIEF: lambda: Debrief(plan.information.debrief),
            Stage.THANKS: lambda: Thanks(self.speaker, settings.timing.thanks),
        }
        # All at once, so that what cannot be made is refused before a visitor sits there; but only what the study has.
        self._scenes: dict[Stage, Scene] = {stage: makers[stage]() for stage in plan.course.stages if stage in makers}
        self._play_in(plan.condition)

    def play_by_chance(self) -> None:
        """Have the game in any condition of the study: whoever is not stored shall tell nobody who comes next."""
        listed = sorted(self._plan.settings.allocation.quotas) or [self._plan.condition.value]
        self._play_in(Condition(Random(f"{self._seed}/unstored").choice(listed)))

    def _play_in(self, condition: Condition) -> None:
        game = _game(replace(self._plan, condition=condition), self._seed, self._wording, self._numbers)
        pairs = game.game.board.pairs
        self._scenes[Stage.GAME] = game
        self._scenes[Stage.INTRODUCTION] = Introduction(self.speaker, pairs, helped=game.helped)

    def of(self, stage: Stage) -> Scene:
        """The scene of a stage; before the first and after the last one nothing is to be seen of a sitting."""
        return self._scenes.get(stage, _NOTHING)

    def _practice(self, plan: Plan, chance: Random) -> PracticePlay:
        practice = plan.settings.practice
        table = Table(_deal(practice, plan.practice_deck, chance), practice.deck, practice=True)
        return PracticePlay(table, plan.settings.timing, self.speaker, practice.longest)


_NOTHING = Scene()


def _game(plan: Plan, seed: int, wording: Wording, numbers: Iterator[int]) -> Play:
    settings = plan.settings
    deal, targets = (Random(f"{seed}/{purpose}") for purpose in ("deal", "targets"))
    rule = TargetRule(settings.assistance.target_rule)
    given = help_in(plan.condition, rule, wording, targets)
    assistant = assistant_with(plan.policy, given.mentaliser, settings.assistance.step) if given else None
    guide = Guide(assistant, given.sentences) if given and assistant else None
    return Play(Table(_deal(settings.game, plan.deck, deal), settings.game.deck), guide, settings.timing, numbers)


def _deal(game: Game | Practice, cards: tuple[str, ...], chance: Random) -> Board:
    try:
        return Board.deal(game.rows, game.columns, cards, chance)
    except ValueError as error:
        raise BadInput(f"no game can be dealt from the deck {game.deck!r}: {error}") from error
