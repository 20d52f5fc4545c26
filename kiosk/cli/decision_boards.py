"""The board at a decision, drawn as text and as a picture."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from textwrap import wrap
from typing import Any

from kiosk.assistance.assistant import Explanation
from kiosk.config import ASSETS, pictures_in
from kiosk.game import Concentration, Position


@dataclass(frozen=True)
class Moment:
    """The game before a flip (from 1), and the decision about it; ``differs`` says why there is none."""

    flip: int
    game: Concentration
    explanation: Explanation | None
    differs: str = ""

    def to_json(self) -> dict[str, Any]:
        """Return it as JSON values; cards go by their locations, from 0."""
        board, opened = self.game.board, self.game.first_card
        told = {} if self.explanation is None else self.explanation.to_json()
        return {
            "flip": self.flip,
            "open": None if opened is None else board.location(opened),
            "found": sorted(map(board.location, self.game.found)),
            "turned": {board.location(place): n for place in board if (n := self.game.history.count(place))},
            **told,
            **({"differs": self.differs} if self.differs else {}),
        }


LEGEND = "\N{MIDDLE DOT} never turned   name turned before   [name] open   (name) found   >name< where the hint points"


def board_lines(moment: Moment) -> Iterator[str]:
    """Draw the board as text, a row a line."""
    game, target = moment.game, _target(moment)
    width = max(map(len, game.board.cards)) + 2
    for row in range(game.board.rows):
        places = (Position(row, column) for column in range(game.board.columns))
        yield "  " + " ".join(_cell(game, place, target).ljust(width) for place in places).rstrip()


def _cell(game: Concentration, place: Position, target: Position | None) -> str:
    card, seen = game.board.card(place), game.history.count(place) > 0
    if place in game.found:
        return f"({card})"
    if place == game.first_card:
        return f"[{card}]"
    if place == target:
        return f">{card}<" if seen else ">\N{MIDDLE DOT}<"
    return f" {card}" if seen else " \N{MIDDLE DOT}"


def _target(moment: Moment) -> Position | None:
    hint = moment.explanation.decision.hint if moment.explanation else None
    return hint.target.position if hint else None


_SIDE, _GAP, _HEAD, _CAPTION_LINES, _CAPTION = 46, 4, 26, 3, 18
_ACROSS = 3
"""How many boards are drawn side by side."""


def board_picture(moments: Sequence[Moment]) -> str:
    """Return an SVG of the board at each moment, with its flip, action and sentence."""
    board = moments[0].game.board
    width = board.columns * (_SIDE + _GAP) + 24
    height = board.rows * (_SIDE + _GAP) + _HEAD + _CAPTION_LINES * _CAPTION + 24
    across = min(_ACROSS, len(moments))
    down = -(-len(moments) // across)
    pictures = _card_pictures(frozenset(board.cards))
    images = (
        f'<image id="{card}" width="{_SIDE - 8}" height="{_SIDE - 8}" href="{picture}"/>'
        for card, picture in pictures.items()
    )
    tiles = (
        f'<g transform="translate({number % across * width + 12} {number // across * height + 12})">'
        f"{''.join(_tile(moment, frozenset(pictures), width))}</g>"
        for number, moment in enumerate(moments)
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{across * width}" height="{down * height}"'
        ' font-family="sans-serif" font-size="13">\n<rect width="100%" height="100%" fill="#fff"/>\n'
        f"<defs>{''.join(images)}</defs>\n" + "\n".join(tiles) + "\n</svg>\n"
    )


def _tile(moment: Moment, pictured: frozenset[str], width: int) -> Iterator[str]:
    game, target, explanation = moment.game, _target(moment), moment.explanation
    action = explanation.decision.action.label if explanation else "comes out otherwise today"
    yield f'<text y="14" font-weight="bold">flip {moment.flip}: {escape(action)}</text>'
    for place in game.board:
        x, y = place.column * (_SIDE + _GAP), place.row * (_SIDE + _GAP) + _HEAD
        card, found, opened = game.board.card(place), place in game.found, place == game.first_card
        fill = "#dff0e4" if found else "#fff7d6" if opened else "#eceff2"
        edge = ("#c05500", 4) if place == target else ("#1f5f6b", 2) if opened else ("#b8c0c8", 1)
        yield (
            f'<g transform="translate({x} {y})"><rect width="{_SIDE}" height="{_SIDE}" rx="6" fill="{fill}"'
            f' stroke="{edge[0]}" stroke-width="{edge[1]}"/>'
        )
        if game.history.count(place):
            shade = 1 if opened else 0.75 if found else 0.4
            if card in pictured:
                yield f'<use href="#{card}" x="4" y="4" opacity="{shade}"/>'
            else:
                middle = f'x="{_SIDE / 2}" y="{_SIDE / 2 + 4}" text-anchor="middle" font-size="10"'
                yield f"<text {middle}>{escape(card)}</text>"
        yield "</g>"
    below = game.board.rows * (_SIDE + _GAP) + _HEAD
    said = _caption(explanation) if explanation else moment.differs
    for number, line in enumerate(
        wrap(said, width // 7, max_lines=_CAPTION_LINES, placeholder=" \N{HORIZONTAL ELLIPSIS}")
    ):
        yield f'<text y="{below + 16 + number * _CAPTION}">{escape(line)}</text>'


def _caption(explanation: Explanation) -> str:
    """Return what was said, or why nothing was."""
    verdict = explanation.decision.gate_decision
    return explanation.spoken or ("the table came to no help" if verdict.is_open else verdict.value)


def _card_pictures(cards: frozenset[str]) -> dict[str, str]:
    """Return the pictures of the shipped decks that these cards have, as data addresses."""
    shipped = {
        card: file
        for deck in sorted((ASSETS / "cards").iterdir())
        for card, file in pictures_in(deck).items()
        if card in cards and file.suffix == ".svg"
    }
    return {
        card: f"data:image/svg+xml;base64,{b64encode(file.read_bytes()).decode()}" for card, file in shipped.items()
    }
