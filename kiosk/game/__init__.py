"""Concentration alone: the board, flips, pairs, and the history of what has been seen.

Nothing in this room knows that anybody helps, that there is a screen, or what time it is.
"""

from kiosk.game.board import Board, Position
from kiosk.game.concentration import Concentration, Flip, IllegalFlip, Refusal
from kiosk.game.history import History

__all__ = ["Board", "Concentration", "Flip", "History", "IllegalFlip", "Position", "Refusal"]
