"""The command ``recollect explain``: one decision of the assistant laid open, for a person or for a program."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import click

from kiosk import BadInput
from kiosk.assistant.explain import Explanation
from kiosk.assistant.hint import Hint
from kiosk.assistant.mdp import Action, Outcome
from kiosk.cli.explaining import case, reasons
from kiosk.cli.options import json_option, sittings_data_option
from kiosk.game import Board
from kiosk.store import moments
from kiosk.store.reading import archive

_OUTCOMES = {
    Outcome.F_CORRECT: "a first card is coming, and the last move did not fail",
    Outcome.F_WRONG: "a first card is coming, and the last move was no match",
    Outcome.S_CORRECT: "a second card is coming, and the last move did not fail",
    Outcome.S_WRONG: "a second card is coming, and the last move was no match",
}
_LABEL = 11


@click.command()
@click.argument("case_or_sitting", required=False, metavar="CASE.json|SITTING")
@click.option("--flip", type=click.IntRange(min=1), help="Explain the decision before this flip of a stored sitting.")
@sittings_data_option
@json_option
@click.option("--table", is_flag=True, help="Print the table of all reasons that docs/mentaliser.md shows.")
def explain(case_or_sitting: str | None, flip: int | None, data: Path, *, as_json: bool, table: bool) -> None:
    """Explain one decision: of a moment in a case file, or, with --flip, of a stored sitting."""
    if table:
        click.echo(reasons.table(), nl=False)
        return
    if case_or_sitting is None:
        raise click.UsageError("say what to explain: a case file, or a sitting and --flip")
    if flip is None and case_or_sitting.isdecimal():
        raise click.UsageError("a stored sitting needs --flip")
    explanation = _of_case(Path(case_or_sitting)) if flip is None else _of_sitting(case_or_sitting, flip, data)
    click.echo(json.dumps(explanation.to_json()) if as_json else "\n".join(_lines(explanation)))


def _of_case(path: Path) -> Explanation:
    described = case.read(path)
    try:
        return described.moment().explained()
    except (BadInput, ValueError) as refusal:
        raise BadInput(f"the case {path}: {refusal}") from refusal


def _of_sitting(number: str, flip: int, data: Path) -> Explanation:
    if not number.isdecimal():
        raise BadInput(f"a stored sitting goes by its number, not by {number!r}")
    with archive(data) as stored:
        return moments.explained(stored, int(number), flip)


def _lines(explanation: Explanation) -> Iterator[str]:
    """The explanation for a person: each step on its line."""
    decision = explanation.decision
    state, verdict = decision.state, decision.verdict
    yield _line("state", f"{state.label}, row {state.index} of the table")
    yield _line("", f"{state.game.name.lower()} of the game; {_OUTCOMES[state.outcome]}")
    yield _line("gate", "open: the table is asked" if verdict.is_open else f"closed: {verdict.value}")
    yield _line("q", "   ".join(f"{a.label} {value:g}" for a, value in zip(Action, decision.q, strict=True)))
    yield _line(
        "action", decision.action.label + (", by the case and not by the table" if explanation.overridden else "")
    )
    yield _line("targets", _places(explanation))
    if decision.hint is not None:
        yield from _pointing(decision.hint, explanation.board)
    if explanation.said:
        yield _line("said", explanation.said)
    for number, sentence in enumerate(explanation.sentences):
        yield _line("" if number else "sentences", sentence)


def _pointing(hint: Hint, board: Board) -> Iterator[str]:
    target = hint.target
    place = f"row {target.position.row + 1}, column {target.position.column + 1}"
    yield _line("target", f"{place} (location {board.location(target.position)}): {hint.name}")
    yield _line("counts", f"turned up: the target {_times(target.seen)}, the other {_times(target.mate_seen)}")
    yield _line("reason", target.reason.value)


def _places(explanation: Explanation) -> str:
    locations = [str(explanation.board.location(position)) for position in explanation.candidates]
    if not locations:
        return "none: nobody helps"
    return f"location {locations[0]}" if len(locations) == 1 else f"any of the locations {' '.join(locations)}"


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def _line(label: str, text: str) -> str:
    return f"{label:<{_LABEL}}{text}"
