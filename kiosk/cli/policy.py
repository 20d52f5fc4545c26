"""The commands about policy files: show, compare and measure them, and make their evidence again."""

from __future__ import annotations

from dataclasses import asdict
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from kiosk import UserInputError
from kiosk.assistance.policy import ActionSpec, QTable, State
from kiosk.cli import evidence
from kiosk.cli.learning import as_json, say
from kiosk.cli.options import progress_bar
from kiosk.files import write_file
from kiosk.training import policies


@click.group()
def policy_group() -> None:
    """Look at policy files and their evidence."""


@policy_group.command("show")
@click.argument("file")
@click.option("--figure", type=click.Path(path_type=Path, dir_okay=False), help="Draw a heat map here (.png or .svg).")
@as_json
def policy_show(file: str, figure: Path | None, json_: bool) -> None:  # noqa: FBT001 - click's flag
    """Print a table: what it does in each state.

    It also gives the values, and how often each state was met in training.
    """
    table = QTable.named(file)
    if figure is not None:
        write_file(figure, _drawn().heat_map(table, policies.visits(table), _ending(figure)))
    met = policies.visits(table)
    rows = {state.label: {"action": table.action(state).label, "visits": met.get(state, 0)} for state in table.states}
    document = {"policy": table.name, "sha256": table.sha256, "training": dict(table.training), "states": rows}
    say(document, _printed(table, met), json_=json_)


def _printed(table: QTable, met: dict[State, int]) -> str:
    made = str(table.training.get("command", "the file does not say how"))
    head = [f"{table.name}  sha256 {table.sha256}", f"made by: {made}", ""]
    head.append(
        f"{'state':<30}{'does':<10}" + "".join(f"{action.label:>10}" for action in table.actions) + f"{'visits':>10}"
    )
    return "\n".join(head + [_line(table, state, met) for state in table.states])


def _line(table: QTable, state: State, met: dict[State, int]) -> str:
    numbers = "".join(f"{value:>10.4f}" for value in table.row(state))
    action = table.action(state)
    does = "-" if met and state not in met else "" if action is ActionSpec.NO_HELP else action.label
    return f"{state.label:<30}{does:<10}{numbers}{met.get(state, 0):>10,}"


def _ending(figure: Path) -> str:
    ending = figure.suffix.removeprefix(".").lower()
    if ending not in ("png", "svg"):
        raise UserInputError(f"the figure {figure} must end in .png or .svg")
    return ending


def _drawn() -> Any:
    try:
        return import_module("kiosk.analysis.policy_figures")
    except ImportError as error:
        raise UserInputError('figures need matplotlib: pip install "recollect[analysis]"') from error


@policy_group.command("compare")
@click.argument("one")
@click.argument("other")
@as_json
def policy_compare(one: str, other: str, json_: bool) -> None:  # noqa: FBT001 - click's flag
    """Show the states in which two tables act differently.

    It compares the states that both have met in training.
    """
    tables = QTable.named(one), QTable.named(other)
    found = policies.compare_policies(*tables)
    differences = {state.label: [table.action(state).label for table in tables] for state in found.different}
    document = {"compared": len(found.compared), "agreement": found.agreement, "largest_difference": found.largest}
    text = [f"the same action in {len(found.compared) - len(found.different)} of {len(found.compared)} states"]
    text += [f"  {state:<30}{a:<10}{b}" for state, (a, b) in differences.items()]
    text.append(f"largest difference of a value: {found.largest:.4f}")
    say(document | {"different": differences}, "\n".join(text), json_=json_)


@policy_group.command("card")
@click.argument("file")
@click.option("--games", type=int, default=20_000, show_default=True, help="How many games in each line.")
@click.option("--seed", type=int, default=1, show_default=True, help="Fixes everything random.")
@as_json
def policy_card(file: str, games: int, seed: int, json_: bool) -> None:  # noqa: FBT001 - click's flag
    """Measure a table with the players of the policy card.

    It prints rows of Markdown.
    """
    table = QTable.named(file)
    rows = []
    with progress_bar("playing", len(evidence.ARMS), hidden=json_) as progress:
        for number, arm in enumerate(evidence.ARMS, 1):
            rows.append((arm, evidence.measure_arm(table, arm, games, seed)))
            progress(number)
    document = {arm.label: played.measures() for arm, played in rows}
    say(document, evidence.card_table(table, rows, games, seed), json_=json_)


@policy_group.command("evidence")
@click.option("--games", type=int, default=20_000, show_default=True, help="How many games in each arm.")
@click.option(
    "--seeds", type=click.IntRange(min=2), default=10, show_default=True, help="How many trainings of each reward."
)
@click.option("--seed", type=int, default=1, show_default=True, help="Fixes everything random in play.")
@click.option(
    "--figures", type=click.Path(path_type=Path, file_okay=False), help="Also draw the figures of the docs here."
)
@as_json
def show_evidence(games: int, seeds: int, seed: int, figures: Path | None, json_: bool) -> None:  # noqa: FBT001
    """Compute every number of the page on learning again.

    It says of each claim whether it holds.
    """
    with progress_bar("checking", evidence.STEPS, hidden=json_) as progress:
        claims = evidence.gather_claims(games, seeds, seed, progress)
    if figures is not None:
        _draw_figures(figures, games, seed)
    say(
        {"games": games, "seeds": seeds, "seed": seed, "claims": [asdict(claim) for claim in claims]},
        evidence.claims_table(claims),
        json_=json_,
    )


def _draw_figures(folder: Path, games: int, seed: int) -> None:
    drawn = _drawn()
    table = QTable.named("default")
    write_file(folder / "policy.svg", drawn.heat_map(table, policies.visits(table), "svg"))
    write_file(folder / "games.svg", drawn.distributions(evidence.figure_samples(games, seed), "svg"))
