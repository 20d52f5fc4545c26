"""How long a decision takes, from the state to the sentence."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest

from kiosk.assistance.assistant import Assistant
from kiosk.assistance.hint_sentences import Wording
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ActionSpec
from kiosk.experiment.condition import Condition, help_in
from kiosk.game import Board, Concentration
from tests.bench.percentiles import tell_percentiles
from tests.samples import ANIMALS, ENGLISH, always


@pytest.mark.parametrize("condition", [Condition.TOM, Condition.NOTOM], ids=lambda condition: str(condition.name))
def test_decision(benchmark: Any, condition: Condition) -> None:
    """State, gate, table, mentaliser and wording, before a first card in the middle of a game."""
    game = Concentration(Board.deal(4, 6, ANIMALS, Random(1)))
    chance = Random(2)
    for _ in range(40):
        game.flip(chance.choice(game.closed))
        game.turn_back()
    given = help_in(condition.known, TargetRule.MOST_FLIPPED, Wording(ENGLISH, Random(3)), Random(4))
    assert given is not None
    assistant = Assistant(always(ActionSpec.SUG_CARD), given.mentaliser)
    sentences = given.sentences

    def decide() -> str:
        hint = assistant.decide(game).hint
        return sentences.sentence(hint) if hint else ""

    assert benchmark.pedantic(decide, rounds=3000, warmup_rounds=100)
    tell_percentiles(benchmark)
