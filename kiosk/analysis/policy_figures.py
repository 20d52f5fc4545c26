"""Figures of the learning layer: what a table does, and how long simulated games last.

They are the bytes of a picture.
"""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import matplotlib as mpl
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from kiosk.assistance.policy import ActionSpec, MoveOutcome, Phase, QTable, State

COLOURS = ("#f2f0eb", "#bcd4e6", "#6fa3cc", "#1f5a8c")
"""No help, column, row, card: light to dark, as the help grows."""
SIGNS = {
    ActionSpec.NO_HELP: "none",
    ActionSpec.SUG_COL: "column",
    ActionSpec.SUG_ROW: "row",
    ActionSpec.SUG_CARD: "card",
}
HEADS = {
    MoveOutcome.F_CORRECT: "first card,\nafter a match",
    MoveOutcome.F_WRONG: "first card,\nafter a miss",
    MoveOutcome.S_CORRECT: "second card,\nafter a match",
    MoveOutcome.S_WRONG: "second card,\nafter a miss",
}
GAMES_COLOURS = ("#b0552f", "#1f5a8c", "#5f8f4e")
# Text stays text, without formulas between dollar signs, and nothing in the file depends on the clock or on chance.
STYLE: dict[Any, Any] = {"svg.fonttype": "none", "svg.hashsalt": "recollect", "text.parse_math": False, "font.size": 9}


class FigureSample(Protocol):
    """Moves of many games under a label, and the paper's mean and SD beside them."""

    @property
    def label(self) -> str:
        """What was played."""
        ...

    @property
    def moves(self) -> Sequence[float]:
        """Moves of every game."""
        ...

    @property
    def paper(self) -> tuple[float, float]:
        """The paper's mean and SD."""
        ...


def sign(action: ActionSpec) -> str:
    """Return what an action is called in a figure."""
    return SIGNS.get(action, action.label)


def _colours(number: int) -> list[str]:
    """Return a colour for each action; those of packages share one."""
    return [*COLOURS, *["#cc79a7"] * (number - len(COLOURS))]


def heat_map(policy: QTable, visits: Mapping[State, int], ending: str) -> bytes:
    """Return the greedy action in each of the 48 states.

    There is a row per phase and last assistance, a column per outcome.

    States never met in training (``visits`` says so; an empty mapping means unknown) carry a dot. ``ending`` is
    "png" or "svg".
    """
    rows = [(phase, last) for phase in Phase for last in policy.actions]
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 6.4), layout="constrained")
        axes = figure.subplots()
        grid = [[policy.actions.index(policy.action(State(*row, outcome))) for outcome in MoveOutcome] for row in rows]
        axes.imshow(
            grid,
            cmap=ListedColormap(_colours(len(policy.actions))),
            vmin=0,
            vmax=len(policy.actions) - 1,
            aspect="auto",
        )
        for y, row in enumerate(rows):
            for outcome in MoveOutcome:
                _cell(axes, y, State(*row, outcome), policy, visits)
        axes.set_xticks(range(len(MoveOutcome)), [HEADS[outcome] for outcome in MoveOutcome])
        axes.set_yticks(range(len(rows)), [f"{phase.name.lower()}, last {sign(last)}" for phase, last in rows])
        axes.tick_params(length=0, top=True, labeltop=True, bottom=False, labelbottom=False)
        for line in range(len(policy.actions), len(rows), len(policy.actions)):
            axes.axhline(line - 0.5, color="black", linewidth=1)
        axes.set_xlabel(f"What the table {policy.name!r} does; a dot: never met in training")
        return _rendered(figure, ending)


def _cell(axes: Any, y: int, state: State, policy: QTable, visits: Mapping[State, int]) -> None:
    if visits and state not in visits:
        axes.text(state.outcome, y, "·", ha="center", va="center", color="#777777")
        return
    action = policy.action(state)
    ink = "white" if action is ActionSpec.SUG_CARD else "black"
    axes.text(state.outcome, y, sign(action), ha="center", va="center", color=ink)


def distributions(samples: Sequence[FigureSample], ending: str) -> bytes:
    """Draw moves a game as histograms, one over the other.

    Above them are our mean and SD (full) beside the paper's.
    """
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.2, 4.2), layout="constrained")
        marks, axes = figure.subplots(2, 1, sharex=True, height_ratios=(1, 3))
        top = max(max(sample.moves) for sample in samples)
        edges = [float(edge) for edge in range(10, int(top) + 3, 1)]
        for number, (sample, colour) in enumerate(zip(samples, GAMES_COLOURS, strict=True)):
            shares = [100 / len(sample.moves)] * len(sample.moves)
            axes.hist(sample.moves, edges, weights=shares, color=colour, alpha=0.6, label=sample.label)
            _compared(marks, -number, sample, colour)
        marks.set_yticks([])
        marks.set_ylim(-len(samples) + 0.4, 0.7)
        marks.set_title("mean and SD: ours full, the paper's hollow", fontsize=9)
        axes.set_xlabel("moves a game (a move is two flips)")
        axes.set_ylabel("games, %")
        axes.legend(frameon=False)
        return _rendered(figure, ending)


def _compared(axes: Any, y: float, sample: FigureSample, colour: str) -> None:
    mean = sum(sample.moves) / len(sample.moves)
    sd = (sum((moves - mean) ** 2 for moves in sample.moves) / (len(sample.moves) - 1)) ** 0.5
    axes.errorbar([mean], [y + 0.15], xerr=[sd], fmt="o", color=colour, capsize=3)
    axes.errorbar([sample.paper[0]], [y - 0.2], xerr=[sample.paper[1]], fmt="o", color=colour, mfc="white", capsize=3)


def _rendered(figure: Figure, ending: str) -> bytes:
    picture = io.BytesIO()
    figure.savefig(picture, format=ending, dpi=150, metadata={"Date": None} if ending == "svg" else {})
    return picture.getvalue()
