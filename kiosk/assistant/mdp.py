"""The names of the Markov decision process that the learning layer solves: its actions and its 48 states.

A decision is taken before every flip. State = game phase x last assistance x last outcome, 3 x 4 x 4 = 48
(Andriella, Falcone, Rossi, "Enhancing Robot Assistive Behaviour with Reinforcement Learning and Theory of Mind").
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, IntEnum
from typing import Self

from kiosk.game import Concentration


class Action(IntEnum):
    """How much to help with the coming flip; the number is the column of the Q-table."""

    NO_HELP = 0
    SUG_COL = 1
    SUG_ROW = 2
    SUG_CARD = 3

    @property
    def label(self) -> str:
        """The name used in policy files and records."""
        return self.name.lower()

    @property
    def level(self) -> float:
        """How much assistance this is, for the measure "assistance per flip": none 0, column .5, row 1, card 2."""
        return _LEVELS[self]


_LEVELS = {Action.NO_HELP: 0.0, Action.SUG_COL: 0.5, Action.SUG_ROW: 1.0, Action.SUG_CARD: 2.0}


class Phase(IntEnum):
    """How far the game is, in thirds of its pairs; with 12 pairs: 0-3, 4-7 and 8-11 found."""

    BEGINNING = 0
    MIDDLE = 1
    END = 2

    @classmethod
    def of(cls, pairs_found: int, pairs: int) -> Phase:
        """The phase of a game in which ``pairs_found`` of ``pairs`` are found."""
        return cls(min(pairs_found * len(cls) // pairs, cls.END))


class Outcome(IntEnum):
    """Whether the coming flip is a first or a second card, and whether the last completed move was a match."""

    F_CORRECT = 0
    F_WRONG = 1
    S_CORRECT = 2
    S_WRONG = 3

    @classmethod
    def of(cls, card: Card, *, last_move_matched: bool | None) -> Outcome:
        """The outcome before a flip; before any move is completed nothing has gone wrong, so it counts as correct."""
        if card is Card.FIRST:
            return cls.F_WRONG if last_move_matched is False else cls.F_CORRECT
        return cls.S_WRONG if last_move_matched is False else cls.S_CORRECT


class Card(Enum):
    """Which card of the move the coming flip turns up."""

    FIRST = "first"
    SECOND = "second"

    @classmethod
    def coming(cls, game: Concentration) -> Card:
        """The card of the move that the next flip of ``game`` turns up."""
        return cls.FIRST if game.first_card is None else cls.SECOND


@dataclass(frozen=True, slots=True)
class State:
    """What the learning layer sees before a flip."""

    game: Phase
    last: Action
    outcome: Outcome

    @property
    def index(self) -> int:
        """The row of the Q-table, 0-47."""
        return (self.game * len(Action) + self.last) * len(Outcome) + self.outcome

    @property
    def label(self) -> str:
        """The name used in policy files: ``beginning/no_help/f_correct``."""
        return "/".join(part.name.lower() for part in (self.game, self.last, self.outcome))

    @classmethod
    def at(cls, index: int) -> Self:
        """The state with this index."""
        rest, outcome = divmod(index, len(Outcome))
        game, last = divmod(rest, len(Action))
        return cls(Phase(game), Action(last), Outcome(outcome))

    @classmethod
    def of(cls, game: Concentration, last: Action) -> Self:
        """The state before the next flip of ``game``, when the previous decision was ``last``."""
        phase = Phase.of(game.pairs_found, game.board.pairs)
        return cls(phase, last, Outcome.of(Card.coming(game), last_move_matched=game.last_move_matched))


STATES: tuple[State, ...] = tuple(State.at(index) for index in range(len(Phase) * len(Action) * len(Outcome)))
"""All 48 states, in the order of the Q-table's rows."""
