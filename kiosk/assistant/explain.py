"""A decision laid open, step by step: what was seen, what was allowed, what was chosen, and what could be said.

It only looks: the game, the table and the mentaliser are as they were, and no chance is spent.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Protocol

from kiosk import BadInput
from kiosk.assistant.assistant import Decision
from kiosk.assistant.hint import Hint
from kiosk.assistant.mdp import Action
from kiosk.assistant.mentaliser import Mentaliser
from kiosk.game import Board, Concentration, IllegalFlip, Position


class Speaker(Protocol):
    """Whoever knows all that can be said with a hint."""

    def every(self, hint: Hint) -> tuple[str, ...]:
        """All the sentences that there are for one hint."""
        ...


@dataclass(frozen=True)
class Explanation:
    """One decision with everything around it.

    ``candidates`` are all cards the target rule could choose before this flip; they do not depend on the action, so
    they are there when no help is given as well. They are empty where nobody helps. ``said`` is the sentence that
    was said, where the moment is one that has been.
    """

    board: Board
    decision: Decision
    candidates: tuple[Position, ...]
    sentences: tuple[str, ...]
    overridden: bool = False
    said: str | None = None

    def to_json(self) -> dict[str, Any]:
        """The explanation as JSON values: locations from 0 row by row, rows and columns from 1.

        Without a hint ``target``, ``counts`` and ``reason`` are null. ``overridden`` is there only when the action
        was not left to gate and table, ``said`` only when it is known.
        """
        decision = self.decision
        return {
            "state": {part: getattr(decision.state, part).name.lower() for part in ("game", "last", "outcome")}
            | {"index": decision.state.index},
            "gate": {"open": decision.verdict.is_open, "reason": decision.verdict.value},
            "q": {action.label: value for action, value in zip(Action, decision.q, strict=True)},
            "action": decision.action.label,
            **({"overridden": True} if self.overridden else {}),
            **self._pointing(decision.hint),
            "targets": [self.board.location(position) for position in self.candidates],
            "sentences": list(self.sentences),
            **({"said": self.said} if self.said else {}),
        }

    def _pointing(self, hint: Hint | None) -> dict[str, Any]:
        if hint is None:
            return {"target": None, "counts": None, "reason": None}
        position = hint.target.position
        return {
            "target": {
                "location": self.board.location(position),
                "row": position.row + 1,
                "column": position.column + 1,
                "card": hint.name,
            },
            "counts": {"target": hint.target.seen, "other": hint.target.mate_seen},
            "reason": hint.target.reason.value,
        }


def explain(
    game: Concentration,
    decision: Decision,
    mentaliser: Mentaliser | None,
    speaker: Speaker | None,
    *,
    overridden: bool = False,
) -> Explanation:
    """Lay open a decision about the coming flip of ``game``; without a mentaliser and a speaker nobody helps."""
    candidates = mentaliser.candidates(game) if mentaliser else ()
    sentences = speaker.every(decision.hint) if speaker and decision.hint else ()
    return Explanation(game.board, decision, candidates, sentences, overridden)


def replayed(board: Board, flips: Iterable[Position]) -> Concentration:
    """The game after these flips, ready for the next one: unmatched cards have turned back.

    Raises BadInput, naming the flip by its number, if the rules do not allow it or nothing is left to flip.
    """
    game = Concentration(board)
    for number, position in enumerate(flips, 1):
        try:
            game.flip(position)
        except IllegalFlip as refusal:
            raise BadInput(f"flip {number} (location {board.location(position)}): {refusal}") from refusal
        game.turn_back()
    if game.over:
        raise BadInput(f"the game is finished after {game.flips} flips, so there is no next flip to help with")
    return game
