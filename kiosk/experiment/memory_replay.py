"""Follow a replay with the memory model: how likely each card is remembered after every step."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from kiosk.assistance.memory_model import MemoryModel
from kiosk.experiment import events as happened
from kiosk.experiment.events import Event
from kiosk.experiment.outcomes import Stage
from kiosk.game import Board, Concentration
from kiosk.lazy_dataclass import dataclass

if TYPE_CHECKING:
    from kiosk.experiment.replay import ReplayStep


@dataclass(frozen=True)
class BoardMemory:
    """A board, and the chance of the card on each place to be recalled, row by row."""

    board: Board
    chances: tuple[float, ...]


class MemoryFollower:
    """Holds what the memory model says after the steps so far. It needs the flips only, whatever the help followed."""

    def __init__(self) -> None:
        self._board: Board | None = None
        self._model: MemoryModel | None = None
        self._hinted: set[int] = set()

    def follow(self, step: ReplayStep) -> None:
        """Take note of what a step led to."""
        for event in step.outcome.events:
            self._note(event)
        if step.stage not in {Stage.PRACTICE, Stage.GAME}:
            self._board = self._model = None

    @property
    def now(self) -> BoardMemory | None:
        """What is remembered now; None while there is no board."""
        if self._board is None or self._model is None:
            return None
        return BoardMemory(self._board, self._model.recall())

    def _note(self, event: Event) -> None:
        match event:
            case happened.BoardDealt():
                self._board = Board(event.rows, event.columns, event.cards)
                self._model = MemoryModel.of(Concentration(self._board))
                self._hinted.clear()
            case happened.HintGiven():
                self._hinted.add(event.flip)
            case happened.CardFlipped() if self._board is not None and self._model is not None:
                self._model.flip(self._board.location(event.position), hinted=event.number in self._hinted)


def has_board(steps: Iterable[ReplayStep]) -> bool:
    """Whether a board was dealt in these steps, so that there is something to remember."""
    return any(isinstance(event, happened.BoardDealt) for step in steps for event in step.outcome.events)


def memory_after_steps(steps: Iterable[ReplayStep]) -> tuple[BoardMemory | None, ...]:
    """Return what is remembered after each step, None where there is no board."""
    follower, memories = MemoryFollower(), []
    for step in steps:
        follower.follow(step)
        memories.append(follower.now)
    return tuple(memories)
