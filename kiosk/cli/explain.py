"""The command `explain`: why the assistant did what it did, and how the board lay."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import click

from kiosk import UserInputError
from kiosk.assistance.assistant import Explanation, game_after
from kiosk.assistance.hesitation import Wait
from kiosk.assistance.memory_model import MemoryEstimate
from kiosk.assistance.mentaliser import Hint
from kiosk.assistance.policy import PRAISE, MoveOutcome
from kiosk.cli.decision_boards import LEGEND, Moment, board_lines, board_picture
from kiosk.cli.decision_cases import read_case, reasons_table
from kiosk.cli.options import json_option, sessions_data_option
from kiosk.cli.terminal import one_line, tell_caution, tell_line
from kiosk.files import write_file
from kiosk.game import Board
from kiosk.store.queries import DecisionExplainer, open_repository
from kiosk.units import MS_PER_SECOND

DIFFERS = 1
"""The exit code if a decision comes out otherwise today than it was recorded."""


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
    yield from board_lines(moment)
    yield ""
    yield LEGEND


def _all(moments: Sequence[Moment]) -> Iterator[str]:
    yield LEGEND
    for moment in moments:
        move, which = divmod(moment.flip - 1, 2)
        yield ""
        yield f"flip {moment.flip} (move {move + 1}, {'second' if which else 'first'} card)"
        yield from board_lines(moment)
        if moment.explanation is None:
            yield _line("differs", moment.differs)
        else:
            yield from _lines(moment.explanation, brief=True)


_OUTCOMES = {
    MoveOutcome.F_CORRECT: "a first card is coming, and the last move did not fail",
    MoveOutcome.F_WRONG: "a first card is coming, and the last move was no match",
    MoveOutcome.S_CORRECT: "a second card is coming, and the last move did not fail",
    MoveOutcome.S_WRONG: "a second card is coming, and the last move was no match",
}
_LABEL = 11


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
