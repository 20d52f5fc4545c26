"""The command `explain`: why the assistant did what it did, and how the board lay."""

from __future__ import annotations

import json
import reprlib
import sys
from base64 import b64encode
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from random import Random
from textwrap import wrap
from typing import Annotated, Any, Literal

import click
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic_core import ErrorDetails

from kiosk import UserInputError
from kiosk.assistance.assistant import Explanation, game_after
from kiosk.assistance.hesitation import Wait
from kiosk.assistance.hint_sentences import ReasonedSentences, Wording
from kiosk.assistance.memory_model import MemoryEstimate
from kiosk.assistance.mentaliser import Hint, HintReason, Mentaliser, TargetRule
from kiosk.assistance.policy import PRAISE, ActionSpec, FlipInMove, MoveOutcome, QTable, find_action, said_once
from kiosk.cli.options import json_option, read_catalogue, sessions_data_option, shipped_languages
from kiosk.cli.terminal import one_line, tell_caution, tell_line
from kiosk.config import ASSETS, AssistanceConfig, Game, pictures_in
from kiosk.experiment.condition import Condition
from kiosk.experiment.replay import DecisionContext
from kiosk.files import parse_json, write_file
from kiosk.game import Board, Concentration, Position
from kiosk.store.queries import DecisionExplainer, open_repository
from kiosk.units import MS_PER_SECOND

SHAPE = Game()
"""The board of a case is the study's."""
CASE_CARDS = SHAPE.rows * SHAPE.columns


class DecisionCase(BaseModel):
    """The keys of a case file; those with a value here may be left out."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    board: list[Annotated[str, Field(min_length=1)]]
    flips: list[Annotated[int, Field(ge=0, lt=CASE_CARDS)]]
    last_action: str
    condition: str
    policy: str
    language: str
    action: str | None = None
    seed: int = 0
    target_rule: Literal["most_flipped", "most_recent"] = AssistanceConfig().target_rule

    def moment(self) -> DecisionContext:
        """Return what the case describes; raise UserInputError or ValueError if it cannot be."""
        board, condition = Board(SHAPE.rows, SHAPE.columns, tuple(self.board)), Condition.from_name(self.condition)
        return DecisionContext(
            board=board,
            flips=tuple(map(board.position, self.flips)),
            last=_action(self.last_action),
            condition=condition,
            cell=condition.known,
            rule=TargetRule(self.target_rule),
            policy=QTable.named(self.policy),
            catalogue=read_catalogue(self.language),
            override=None if self.action is None else _action(self.action),
            seed=self.seed,
        )


def read_case(path: Path) -> DecisionCase:
    """Read a case file (JSON); raises UserInputError with one sentence that names the key."""
    try:
        return DecisionCase.model_validate(parse_json(path.read_bytes(), object_pairs_hook=said_once))
    except OSError as error:
        raise UserInputError(f"the case {path} cannot be read: {error.strerror}") from error
    except ValidationError as error:
        raise UserInputError(f"the case {path}: {_sentence(error.errors()[0])}") from error
    except ValueError as error:
        raise UserInputError(f"the case {path} is not JSON: {error}") from error


def _action(name: str) -> ActionSpec:
    return find_action(name)


def _sentence(error: ErrorDetails) -> str:
    """Return what pydantic found wrong, as a person would say it; places in a list are counted from 1."""
    key = ", number ".join(str(part + 1) if isinstance(part, int) else part for part in error["loc"])
    match error["type"]:
        case "missing":
            return f"the key {key!r} is missing"
        case "extra_forbidden":
            return f"there is no key {key!r}"
        case _:
            what = error["msg"].removeprefix("Input ")
            return f"{key or 'it'} {what}, but it is {reprlib.repr(error['input'])}"


CARDS = (
    *("owl", "cat", "frog", "duck", "bear", "fish"),
    *("rabbit", "turtle", "hedgehog", "elephant", "ladybird", "butterfly"),
)
BOARD = Board(4, 6, CARDS * 2)
"""Every card's first copy lies in rows 1 and 2, its second copy in the same place in rows 3 and 4."""

EXAMPLES = (
    "",
    "owl cat",
    "owl cat, owl' frog",
    "owl cat, owl frog",
    "owl cat, owl frog, owl' duck",
    "owl cat, owl frog, owl' duck, owl' bear",
    "owl",
    "owl' cat, owl",
    "owl cat, owl",
    "owl cat, owl' frog, owl",
    "owl' cat, owl' frog, owl",
    "owl cat, owl' frog, owl' duck, owl",
)
"""Moves before a hint, by card; a dash marks its second copy. The hint is about the owls, or about new cards."""


@dataclass(frozen=True)
class ReasonExample:
    """What a history comes to: the card that is coming, the reason, and one sentence per language."""

    moves: str
    card: FlipInMove
    reason: HintReason
    target: int
    other: int
    sentences: tuple[str, ...]


def reason_example(moves: str) -> ReasonExample:
    """Play these moves and ask for a hint about a row."""
    game = game_after(BOARD, map(_place, moves.replace(",", "").split()))
    mentaliser = Mentaliser(TargetRule.MOST_FLIPPED, Random(0))
    owls = [position for position in mentaliser.candidates(game) if BOARD.card(position) == CARDS[0]]
    target = mentaliser.pointing_at(owls[-1], game)
    hint = Hint.coming(ActionSpec.SUG_ROW, target, game)
    return ReasonExample(moves, hint.card, target.reason, target.seen, target.mate_seen, _sentences(hint))


def reasons_table() -> str:
    """All examples as a table in Markdown."""
    head = ("card", "reason", "turned up: target, other", "example: moves so far", *shipped_languages())
    rows = [head, ("---",) * len(head), *(_row(reason_example(moves)) for moves in EXAMPLES)]
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def _row(shown: ReasonExample) -> tuple[str, ...]:
    moves = shown.moves or "none"
    return (shown.card.value, shown.reason.value, f"{shown.target}, {shown.other}", moves, *shown.sentences)


def _sentences(hint: Hint) -> tuple[str, ...]:
    wordings = (Wording(read_catalogue(language), Random(0)) for language in shipped_languages())
    return tuple(ReasonedSentences(wording).all_wordings(hint)[0] for wording in wordings)


def _place(card: str) -> Position:
    location = CARDS.index(card.removesuffix("'"))
    return BOARD.position(location + len(CARDS) if card.endswith("'") else location)


_OUTCOMES = {
    MoveOutcome.F_CORRECT: "a first card is coming, and the last move did not fail",
    MoveOutcome.F_WRONG: "a first card is coming, and the last move was no match",
    MoveOutcome.S_CORRECT: "a second card is coming, and the last move did not fail",
    MoveOutcome.S_WRONG: "a second card is coming, and the last move was no match",
}
_LABEL = 11
DIFFERS = 1
"""The exit code if a decision comes out otherwise today than it was recorded."""


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


@click.command()
@click.argument("case_or_session", required=False, metavar="CASE.json|SESSION")
@click.option("--flip", type=click.IntRange(min=1), help="Only the decision before this flip of a stored session.")
@click.option(
    "--picture", type=click.Path(path_type=Path), help="Draw the board at each decision into this file (SVG)."
)
@sessions_data_option
@json_option
@click.option("--table", is_flag=True, help="Print the table of all reasons that docs/explanation/mentaliser.md shows.")
def explain_command(
    case_or_session: str | None, flip: int | None, picture: Path | None, data: Path, *, as_json: bool, table: bool
) -> None:
    """Explain the decisions of a stored session, or a case.

    Each comes with the board as it was. Name a flip of a session with --flip for one decision and all that could have
    been said. Exit code 1 if a decision comes out otherwise today than it was recorded.
    """
    if table:
        click.echo(reasons_table(), nl=False)
        return
    if case_or_session is None:
        raise click.UsageError("say what to explain: a session, or a case file")
    if flip is None and not case_or_session.isdecimal():
        moments = [_of_case(Path(case_or_session))]
    else:
        moments = _of_session(case_or_session, flip, data)
    if picture is not None:
        write_file(picture, board_picture(moments))
    one = flip is not None or not case_or_session.isdecimal()
    if as_json:
        click.echo(json.dumps(_of_one(moments[0]) if one else _of_all(int(case_or_session), moments)))
    else:
        click.echo("\n".join(map(one_line, _one(moments[0]) if one else _all(moments))))
    if picture is not None:
        tell_line(f"The boards are drawn in {picture}.", err=True)
    if any(moment.differs for moment in moments):
        sys.exit(DIFFERS)


def _of_one(moment: Moment) -> dict[str, Any]:
    return {} if moment.explanation is None else moment.explanation.to_json()


def _of_all(session: int, moments: Sequence[Moment]) -> dict[str, Any]:
    cards = list(moments[0].game.board.cards)
    return {"session": session, "cards": cards, "decisions": [moment.to_json() for moment in moments]}


def _of_case(path: Path) -> Moment:
    described = read_case(path)
    try:
        moment = described.moment()
        game = game_after(moment.board, moment.flips)
        return Moment(game.flips + 1, game, moment.explained())
    except (UserInputError, ValueError) as refusal:
        raise UserInputError(f"the case {path}: {refusal}") from refusal


def _of_session(number: str, flip: int | None, data: Path) -> list[Moment]:
    if not number.isdecimal():
        raise UserInputError(f"a stored session goes by its number, not by {number!r}")
    with open_repository(data) as stored:
        explainer = DecisionExplainer(stored, int(number))
        if flip is not None:
            _name_broken(explainer)
            return [Moment(flip, explainer.game_before(flip), explainer.explain(flip))]
        if not explainer.flips:
            raise UserInputError(f"in session {number} nothing was decided: the game ended before its first flip")
        _name_broken(explainer)
        return [_moment(explainer, each) for each in explainer.flips]


def _name_broken(explainer: DecisionExplainer) -> None:
    for broken in explainer.broken:
        tell_caution(broken, err=True)


def _moment(explainer: DecisionExplainer, flip: int) -> Moment:
    game = explainer.game_before(flip)
    try:
        return Moment(flip, game, explainer.explain(flip))
    except UserInputError as differs:
        return Moment(flip, game, None, str(differs))


def _one(moment: Moment) -> Iterator[str]:
    if moment.explanation is not None:
        yield from _lines(moment.explanation)
        yield ""
    yield from _board_lines(moment)
    yield ""
    yield LEGEND


def _all(moments: Sequence[Moment]) -> Iterator[str]:
    yield LEGEND
    for moment in moments:
        move, which = divmod(moment.flip - 1, 2)
        yield ""
        yield f"flip {moment.flip} (move {move + 1}, {'second' if which else 'first'} card)"
        yield from _board_lines(moment)
        if moment.explanation is None:
            yield _line("differs", moment.differs)
        else:
            yield from _lines(moment.explanation, brief=True)


LEGEND = "\N{MIDDLE DOT} never turned   name turned before   [name] open   (name) found   >name< where the hint points"


def _board_lines(moment: Moment) -> Iterator[str]:
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


def _lines(explanation: Explanation, *, brief: bool = False) -> Iterator[str]:
    """Yield the explanation for a person: each step on its line; ``brief`` leaves out what could have been said."""
    decision = explanation.decision
    state, verdict = decision.state, decision.gate_decision
    yield _line("state", f"{state.label}, row {state.index_in(decision.actions)} of the table")
    yield _line("", f"{state.game.name.lower()} of the game; {_OUTCOMES[state.outcome]}")
    yield _line("gate", "open: the table is asked" if verdict.is_open else f"closed: {verdict.value}")
    if explanation.values:
        yield _line("q", "   ".join(f"{label} {value:g}" for label, value in explanation.values))
    if decision.memory is not None:
        yield from _memory(decision.memory, explanation.board)
    if explanation.rules.timing and decision.by_memory and decision.memory:
        yield _line("timing", explanation.rules.timing.told(decision.memory, decision.flips))
    yield from _taken(explanation)
    yield _line("targets", _places(explanation))
    if decision.hint is not None:
        yield from _pointing(decision.hint, explanation.board)
    if explanation.spoken:
        yield _line("said", explanation.spoken)
    elif decision.hint is not None and not explanation.sentences:
        yield _line("said", "nothing: the helper looks toward the place")
    for number, sentence in enumerate(() if brief else explanation.sentences):
        yield _line("" if number else "sentences", sentence)


def _taken(explanation: Explanation) -> Iterator[str]:
    """Yield what was done, and what besides the layers led to it."""
    decision = explanation.decision
    yield _line(
        "action", decision.action.label + (", by the case and not by the table" if explanation.overridden else "")
    )
    if explanation.comment:
        comment = explanation.comment
        after = "a pair" if comment.action is PRAISE else "a miss"
        yield _line("comment", f"{comment.action.label}, with probability {comment.probability:.4g} after {after}")
    if explanation.hesitation:
        yield _line("hesitation", _waited(explanation.hesitation))
    elif decision.is_randomised:
        yield _line("chance", f"drawn with probability {decision.probability:.4g}; else {decision.greedy.label}")


def _waited(wait: Wait) -> str:
    """Say why a hint came that had not been decided before."""
    seconds = (each / MS_PER_SECOND for each in (wait.waited_ms, wait.threshold_ms, wait.usual_ms))
    return (
        "no help was decided, but the visitor had waited for {:.1f} s; from {:.1f} s on they hesitate, as they "
        "usually take {:.1f} s".format(*seconds)
    )


def _memory(memory: MemoryEstimate, board: Board) -> Iterator[str]:
    """Yield what the visitor may remember: each card's chance in percent, row by row."""
    yield _line("memory", f"forgets {memory.forgetting:.2f} a flip; in percent, how likely each card is recalled:")
    for row in range(board.rows):
        cells = memory.recall[row * board.columns : (row + 1) * board.columns]
        yield _line("", " ".join(f"{cell:3}" for cell in cells))


def _pointing(hint: Hint, board: Board) -> Iterator[str]:
    target = hint.target
    place = f"row {target.position.row + 1}, column {target.position.column + 1}"
    told = "" if target.is_located else ", which is not said"
    yield _line("target", f"{place} (location {board.location(target.position)}): {hint.name}{told}")
    yield _line("counts", f"turned up: the target {_times(target.seen)}, the other {_times(target.mate_seen)}")
    yield _line("reason", target.reason.value)


def _places(explanation: Explanation) -> str:
    locations = [str(explanation.board.location(position)) for position in explanation.candidates]
    if not locations:
        return "none: no help is given"
    return f"location {locations[0]}" if len(locations) == 1 else f"any of the locations {' '.join(locations)}"


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def _line(label: str, text: str) -> str:
    return f"{label:<{_LABEL}}{text}"
