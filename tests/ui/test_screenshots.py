"""What a rehearsal's pictures are called."""

from __future__ import annotations

import pytest

from kiosk.experiment import effects as do
from kiosk.experiment.effects import BoardWait, Effect, Mood
from kiosk.experiment.outcomes import Stage
from kiosk.game import Position
from kiosk.ui.screenshots import moment_of

_CARD = do.RevealCard(Position(0, 0), "bee")
_MARK = do.HighlightHint(None, 2)


@pytest.mark.parametrize(
    ("effects", "name"),
    [
        ((_CARD,), "card"),
        ((_CARD, _MARK), "mark-column"),
        ((_CARD, do.SetExpression(Mood.SAD), do.LockBoard(BoardWait.TURNING_BACK)), "turning-back"),
        ((do.SetExpression(Mood.HAPPY), do.MarkMatched((Position(0, 0), Position(0, 1)))), "pair"),
        ((do.SetExpression(Mood.LISTENING), do.ShowThanks()), "thanks"),
        ((do.SetExpression(Mood.HAPPY),), "happy"),
        ((do.SetExpression(Mood.IDLE),), None),
        ((), None),
    ],
)
def test_effects_that_come_at_once_are_one_picture(effects: tuple[Effect, ...], name: str | None) -> None:
    assert moment_of(effects, Stage.GAME) == name
