"""The command `explain`: why the assistant did what it did."""

from __future__ import annotations

import json
import reprlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Annotated, Literal

import click
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic_core import ErrorDetails

from kiosk import UserInputError
from kiosk.assistance.assistant import Explanation, game_after
from kiosk.assistance.memory_model import MemoryEstimate
from kiosk.assistance.mentaliser import Hint, HintReason, Mentaliser, TargetRule
from kiosk.assistance.policy import ActionSpec, FlipInMove, MoveOutcome, QTable, find_action, said_once
from kiosk.assistance.wording import ReasonedSentences, Wording
from kiosk.cli.options import json_option, read_catalogue, sessions_data_option, shipped_languages
from kiosk.config import AssistanceConfig, Game
from kiosk.experiment.condition import Condition
from kiosk.experiment.replay import DecisionContext
from kiosk.game import Board, Position
from kiosk.store import queries
from kiosk.store.queries import open_repository

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
        return DecisionCase.model_validate(json.loads(path.read_bytes(), object_pairs_hook=said_once))
    except OSError as error:
        raise UserInputError(f"the case {path} cannot be read: {error.strerror}") from error
    except ValidationError as error:
        raise UserInputError(f"the case {path}: {_sentence(error.errors()[0])}") from error
    except (ValueError, RecursionError) as error:
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
    hint = Hint(ActionSpec.SUG_ROW, FlipInMove.coming(game), target, BOARD.card(target.position))
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


@click.command()
@click.argument("case_or_session", required=False, metavar="CASE.json|SESSION")
@click.option("--flip", type=click.IntRange(min=1), help="Explain the decision before this flip of a stored session.")
@sessions_data_option
@json_option
@click.option("--table", is_flag=True, help="Print the table of all reasons that docs/explanation/mentaliser.md shows.")
def explain_command(case_or_session: str | None, flip: int | None, data: Path, *, as_json: bool, table: bool) -> None:
    """Explain one decision of a stored session or a case file.

    Name the flip of a session with --flip.
    """
    if table:
        click.echo(reasons_table(), nl=False)
        return
    if case_or_session is None:
        raise click.UsageError("say what to explain: a case file, or a session and --flip")
    if flip is None and case_or_session.isdecimal():
        raise click.UsageError("a stored session needs --flip")
    explanation = _of_case(Path(case_or_session)) if flip is None else _of_session(case_or_session, flip, data)
    click.echo(json.dumps(explanation.to_json()) if as_json else "\n".join(_lines(explanation)))


def _of_case(path: Path) -> Explanation:
    described = read_case(path)
    try:
        return described.moment().explained()
    except (UserInputError, ValueError) as refusal:
        raise UserInputError(f"the case {path}: {refusal}") from refusal


def _of_session(number: str, flip: int, data: Path) -> Explanation:
    if not number.isdecimal():
        raise UserInputError(f"a stored session goes by its number, not by {number!r}")
    with open_repository(data) as stored:
        return queries.explain_stored_decision(stored, int(number), flip)


def _lines(explanation: Explanation) -> Iterator[str]:
    """Yield the explanation for a person: each step on its line."""
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
        yield _line("timing", explanation.rules.timing.told(decision.memory))
    yield _line(
        "action", decision.action.label + (", by the case and not by the table" if explanation.overridden else "")
    )
    if decision.is_randomised:
        yield _line("chance", f"drawn with probability {decision.probability:.4g}; else {decision.greedy.label}")
    yield _line("targets", _places(explanation))
    if decision.hint is not None:
        yield from _pointing(decision.hint, explanation.board)
    if explanation.spoken:
        yield _line("said", explanation.spoken)
    for number, sentence in enumerate(explanation.sentences):
        yield _line("" if number else "sentences", sentence)


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
