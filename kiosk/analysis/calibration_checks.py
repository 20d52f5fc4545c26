"""Check a calibration: whether studies simulated from it look like the data, and its posteriors hold the truth."""

from __future__ import annotations

import html
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from scipy.special import expit
from scipy.stats import binom, chisquare

from kiosk import UserInputError
from kiosk.analysis.calibrate import (
    AGE_CONVENTION,
    GRID,
    STEP,
    Calibration,
    CredibleInterval,
    PlayedStudy,
    posterior,
    theta_of,
)
from kiosk.analysis.memory_likelihood import Array, PlayedGame, move_likelihood
from kiosk.analysis.page import svg_of
from kiosk.analysis.policy_figures import STYLE
from kiosk.analysis.simulated_study import follows_hint
from kiosk.assistance.mentaliser import TargetRule
from kiosk.assistance.policy import ACTIONS, ActionSpec, QTable
from kiosk.experiment.condition import Condition, target_rule
from kiosk.training.simulation import RecordedGame, record_games
from kiosk.training.vectorised_game import CARDS, COLUMNS

STUDIES = 100
"""Simulated studies of the predictive check."""
RANKED = 100
"""Simulated people of the rank histogram."""
BINS = 10
AGES = ((0, 1), (2, 3), (4, 7), (8, 15), (16, 255))
"""Classes of the age of an open card's mate, in flips, for the memory curve."""
ONE_SIDED = 0.025

Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class PredictedStatistic:
    """One number of the data beside its distribution over simulated studies; p is twice the smaller tail."""

    name: str
    observed: float
    simulated: float
    low: float
    high: float
    p: float


@dataclass(frozen=True, slots=True)
class RankCheck:
    """How many simulated people have their true forgetting in each tenth of their posterior; flat if it is right."""

    counts: tuple[int, ...]
    p: float


@dataclass(frozen=True, slots=True)
class CalibrationChecks:
    """What the two checks found; ``predicted`` is empty for boards that the simulation does not know."""

    predicted: tuple[PredictedStatistic, ...]
    ranks: RankCheck | None
    flips: dict[str, tuple[list[int], list[int]]]
    """Flips a game, observed and simulated, by condition."""

    def to_json(self) -> dict[str, Any]:
        """All numbers."""
        rows = [{name: getattr(row, name) for name in row.__slots__} for row in self.predicted]
        ranks = {"counts": list(self.ranks.counts), "p": self.ranks.p} if self.ranks else None
        return {"predictive_check": rows, "rank_histogram": ranks}


@dataclass(frozen=True, slots=True)
class _Cell:
    """The sessions of one condition and table, and how to simulate them."""

    condition: Condition
    policy: QTable
    rule: TargetRule
    games: tuple[PlayedGame, ...]


def check_calibration(
    study: PlayedStudy,
    calibration: Calibration,
    seed: int = 1,
    progress: Progress = lambda _done, _of: None,
    studies: int = STUDIES,
) -> CalibrationChecks:
    """Simulate studies and people from the calibration, under the tables and conditions of the data."""
    if any(session.game.columns != COLUMNS or len(session.game.mates) != CARDS for session in study.sessions):
        return CalibrationChecks((), None, {})
    cells = _cells(study)
    player = calibration.player
    predicted: list[PredictedStatistic] = []
    flips: dict[str, tuple[list[int], list[int]]] = {}
    curves: list[tuple[list[_Facts], list[_Facts]]] = []
    for number, cell in enumerate(cells):
        seen = [_Facts.of(game) for game in cell.games]
        drawn = record_games(cell.policy, player, cell.rule, studies * len(cell.games), seed + number)
        simulated = [_Facts.of(_as_played(game)) for game in drawn]
        predicted += _predicted(cell.condition.name, seen, simulated, _MEASURES)
        flips[cell.condition.name] = ([each.flips for each in seen], [each.flips for each in simulated])
        curves.append((seen, simulated))
        progress(number + 1, len(cells) + 1)
    predicted += _memory_curve(curves, studies)
    ranks = _ranks(cells, calibration, seed)
    progress(len(cells) + 1, len(cells) + 1)
    return CalibrationChecks(tuple(predicted), ranks, flips)


def _cells(study: PlayedStudy) -> list[_Cell]:
    sizes = Counter((session.condition, session.policy_sha256) for session in study.sessions)
    return [
        _cell(study, condition, sha256) for condition, sha256 in sorted(sizes, key=lambda key: (key[0].name, key[1]))
    ]


def _cell(study: PlayedStudy, condition: Condition, sha256: str) -> _Cell:
    games = tuple(each.game for each in study.sessions if each.condition == condition and each.policy_sha256 == sha256)
    rule = target_rule(study.conditions[condition.name], study.rule)
    if rule is None:
        return _Cell(condition, QTable.blank(), TargetRule.RANDOM, games)
    if sha256 not in study.policies:
        raise UserInputError(f"the data set lacks the policy {sha256[:12]} under which sessions were played")
    return _Cell(condition, study.policies[sha256], rule, games)


def _as_played(game: RecordedGame) -> PlayedGame:
    return PlayedGame(game.mates, COLUMNS, game.flips)


@dataclass(frozen=True, slots=True)
class _Facts:
    """What is compared of one game."""

    flips: int
    complete: bool
    levels: float
    hints: int
    followed: int
    seen: tuple[int, ...]
    """Second cards without a hint whose mate had been seen, by the mate's age."""
    matched: tuple[int, ...]

    @classmethod
    def of(cls, game: PlayedGame) -> _Facts:
        """Count in one game."""
        hinted = [flip for flip in game.flips if flip[1] != int(ActionSpec.NO_HELP)]
        levels = sum(ACTIONS[action].level for _, action, _ in hinted)
        followed = sum(follows_hint(*flip, game.columns) for flip in hinted)
        seen, matched, found = [0] * len(AGES), [0] * len(AGES), 0
        last: dict[int, int] = {}
        for at, (place, action, _) in enumerate(game.flips):
            if at % 2:
                first = game.flips[at - 1][0]
                mate = game.mates[first]
                hit = mate == place
                found += hit
                if action == int(ActionSpec.NO_HELP) and mate in last:
                    age = next(n for n, (_, top) in enumerate(AGES) if at - 1 - last[mate] <= top or n == len(AGES) - 1)
                    seen[age] += 1
                    matched[age] += hit
            last[place] = at + 1
        complete = 2 * found == len(game.mates)
        return cls(len(game.flips), complete, levels, len(hinted), followed, tuple(seen), tuple(matched))


def _mean_flips(games: Sequence[_Facts]) -> float:
    return float(np.mean([float(game.flips) for game in games if game.complete] or [np.nan]))


def _sd_flips(games: Sequence[_Facts]) -> float:
    complete = [game.flips for game in games if game.complete]
    return float(np.std(complete, ddof=1)) if len(complete) > 1 else np.nan


def _assistance(games: Sequence[_Facts]) -> float:
    return float(np.mean([game.levels / game.flips for game in games]))


def _followed(games: Sequence[_Facts]) -> float:
    hints = sum(game.hints for game in games)
    return sum(game.followed for game in games) / hints if hints else np.nan


_MEASURES: dict[str, Callable[[Sequence[_Facts]], float]] = {
    "flips, mean": _mean_flips,
    "flips, SD": _sd_flips,
    "assistance per flip": _assistance,
    "hints followed": _followed,
}


def _predicted(
    label: str,
    seen: Sequence[_Facts],
    simulated: Sequence[_Facts],
    measures: dict[str, Callable[[Sequence[_Facts]], float]],
) -> Iterator[PredictedStatistic]:
    size = len(seen)
    parts = [simulated[at : at + size] for at in range(0, len(simulated), size)]
    for name, measure in measures.items():
        row = _statistic(f"{label}: {name}", measure(seen), [measure(part) for part in parts])
        if row is not None:
            yield row


def _statistic(name: str, observed: float, values: list[float]) -> PredictedStatistic | None:
    """Place an observed number among simulated ones; None where either does not exist."""
    drawn = np.array([value for value in values if not np.isnan(value)])
    if np.isnan(observed) or not len(drawn):
        return None
    low, high = np.quantile(drawn, [ONE_SIDED, 1 - ONE_SIDED])
    tail = min((drawn <= observed).sum(), (drawn >= observed).sum())
    p = min(1.0, 2 * (tail + 1) / (len(drawn) + 1))
    return PredictedStatistic(name, float(observed), float(drawn.mean()), float(low), float(high), float(p))


def _memory_curve(curves: Sequence[tuple[list[_Facts], list[_Facts]]], studies: int) -> Iterator[PredictedStatistic]:
    """Return how often the mate of an open card is found without a hint.

    It goes by how long ago the mate was seen, over all conditions.
    """
    for age, (low, high) in enumerate(AGES):

        def share(games: Sequence[_Facts], age: int = age) -> float:
            seen = sum(game.seen[age] for game in games)
            return sum(game.matched[age] for game in games) / seen if seen else np.nan

        observed = share([game for seen, _ in curves for game in seen])
        parts = []
        for study in range(studies):
            drawn = [simulated[study * len(seen) : (study + 1) * len(seen)] for seen, simulated in curves]
            parts.append(share([game for part in drawn for game in part]))
        ages = f"{low} to {high}" if age < len(AGES) - 1 else f"{low} or more"
        row = _statistic(f"all: mate found, seen {ages} flips before", observed, parts)
        if row is not None:
            yield row


def _ranks(cells: Sequence[_Cell], calibration: Calibration, seed: int) -> RankCheck:
    """Simulate people, work out each one's posterior, and see where in it the truth lies."""
    player = calibration.player
    total = sum(len(cell.games) for cell in cells)
    games = [
        game
        for number, cell in enumerate(cells)
        for game in record_games(
            cell.policy, player, cell.rule, max(1, round(RANKED * len(cell.games) / total)), seed + 1000 + number
        )
    ]
    moves = move_likelihood([_as_played(game) for game in games], expit(GRID))
    weights = posterior(moves, theta_of(player))
    truth = np.log([game.forgetting / (1 - game.forgetting) for game in games])
    # A whole cell of the grid below the truth counts in full, the one in which it lies in part.
    edges = np.append(GRID - STEP / 2, GRID[-1] + STEP / 2)
    cumulated = np.concatenate([np.zeros((len(games), 1)), np.cumsum(weights, axis=1)], axis=1)
    ranks = np.array([np.interp(at, edges, row) for at, row in zip(truth, cumulated, strict=True)])
    counts = np.histogram(ranks, BINS, (0, 1))[0]
    return RankCheck(tuple(int(count) for count in counts), float(chisquare(counts).pvalue))


# The page


def calibration_page(name: str, calibration: Calibration, checks: CalibrationChecks) -> str:
    """One HTML page without outside requests: the estimates, the people, and both checks."""
    parts = [
        f"<h1>Calibration of {html.escape(name)}</h1>",
        f"<p>{len(calibration.people)} games. The player remembers by age: {html.escape(AGE_CONVENTION)}.</p>",
        *(f"<p><strong>Warning:</strong> {html.escape(warning)}.</p>" for warning in calibration.warnings),
        "<h2>The population</h2>",
        _table(("", "estimate", "95 % interval"), _estimates(calibration)),
        "<h2>The people</h2>",
        _figure(
            _people(calibration),
            "people",
            "Forgetting of each person with its 95 % interval, and the population behind.",
        ),
        *_checks(checks),
    ]
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>Calibration of {html.escape(name)}</title><style>{_CSS}</style></head>\n"
        f"<body><main>{''.join(parts)}</main></body></html>\n"
    )


_CSS = (
    "body{font:16px/1.5 sans-serif;margin:0 auto;max-width:50rem;padding:1rem}table{border-collapse:collapse}"
    "th,td{padding:.2rem .8rem .2rem 0;text-align:left;border-bottom:1px solid #ccc}figure{margin:1rem 0}"
    "svg{max-width:100%;height:auto}"
)


def _estimates(calibration: Calibration) -> Iterator[tuple[str, ...]]:
    mean = calibration.mean
    middle = CredibleInterval(*(float(expit(value)) for value in (mean.value, mean.low, mean.high)))
    rows = {
        "forgetting, mean of the logit": mean,
        "forgetting, median per flip": middle,
        "spread (SD of the logit)": calibration.spread,
        "following": calibration.following,
        "lapse": calibration.lapse,
    }
    for name, interval in rows.items():
        if interval is not None:
            yield name, f"{interval.value:.3f}", f"{interval.low:.3f} to {interval.high:.3f}"


def _checks(checks: CalibrationChecks) -> Iterator[str]:
    if checks.ranks is None:
        yield "<h2>Checks</h2><p>The boards are not 4 x 6, so no games were simulated.</p>"
        return
    yield "<h2>Posterior predictive check</h2>"
    yield "<p>Each number of the data beside its distribution over studies that were simulated from the estimates.</p>"
    rows = (
        (row.name, f"{row.observed:.3f}", f"{row.simulated:.3f}", f"{row.low:.3f} to {row.high:.3f}", f"{row.p:.2f}")
        for row in checks.predicted
    )
    yield _table(("", "data", "simulated", "95 % of studies", "p"), rows)
    yield _figure(_distributions(checks), "flips", "Flips a game: data (filled) and simulated (line).")
    yield "<h2>Rank histogram</h2>"
    yield (
        "<p>People were drawn from the population and simulated. Where the true forgetting of each lies in its "
        f"posterior is uniform if the posterior is right (chi-square p = {checks.ranks.p:.2f}).</p>"
    )
    yield _figure(
        _rank_histogram(checks.ranks), "ranks", "People by the tenth of their posterior that holds the truth."
    )


def _table(head: Sequence[str], rows: Iterator[tuple[str, ...]]) -> str:
    heads = "".join(f'<th scope="col">{html.escape(cell)}</th>' for cell in head)
    body = "".join(
        f'<tr><th scope="row">{html.escape(first)}</th>'
        + "".join(f"<td>{html.escape(cell)}</td>" for cell in rest)
        + "</tr>"
        for first, *rest in rows
    )
    return f"<table><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table>"


def _figure(figure: Figure, name: str, caption: str) -> str:
    picture = svg_of(figure, name).replace("<svg ", f'<svg role="img" aria-label="{html.escape(caption)}" ', 1)
    return f"<figure>{picture}<figcaption>{html.escape(caption)}</figcaption></figure>"


def _people(calibration: Calibration) -> Figure:
    people = sorted(calibration.people, key=lambda person: person.forgetting.value)
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 0.8 + 0.09 * len(people)), layout="constrained")
        axes = figure.subplots()
        low, high = (float(expit(calibration.mean.value + side * 1.96 * calibration.spread.value)) for side in (-1, 1))
        axes.axvspan(low, high, color="#dde7f0", label="95 % of the population")
        axes.axvline(float(expit(calibration.mean.value)), color="#6fa3cc")
        values = [person.forgetting.value for person in people]
        sides = [
            [person.forgetting.value - person.forgetting.low for person in people],
            [person.forgetting.high - person.forgetting.value for person in people],
        ]
        axes.errorbar(
            values, range(len(people)), xerr=np.abs(sides), fmt="o", markersize=3, linewidth=1, color="#1f5a8c"
        )
        axes.set_yticks([])
        axes.set_xlabel("forgetting d per flip")
    return figure


def _distributions(checks: CalibrationChecks) -> Figure:
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 2.2 * len(checks.flips)), layout="constrained")
        edges = np.arange(20, max(max(drawn) for _, drawn in checks.flips.values()) + 8, 8)
        for axes, (condition, (seen, drawn)) in zip(
            figure.subplots(len(checks.flips), 1, squeeze=False)[:, 0], checks.flips.items(), strict=True
        ):
            axes.hist(seen, edges, weights=[100 / len(seen)] * len(seen), color="#bcd4e6")
            axes.hist(drawn, edges, weights=[100 / len(drawn)] * len(drawn), histtype="step", color="#1f5a8c")
            axes.set_title(condition, fontsize=9)
            axes.set_ylabel("games, %")
        axes.set_xlabel("flips a game")
    return figure


def _rank_histogram(ranks: RankCheck) -> Figure:
    counts: Array = np.array(ranks.counts, dtype=float)
    total = int(counts.sum())
    low, high = binom.interval(0.99, total, 1 / BINS)
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 2.6), layout="constrained")
        axes = figure.subplots()
        axes.axhspan(low, high, color="#eeeeee")
        axes.axhline(total / BINS, color="#999999", linewidth=1)
        axes.bar((np.arange(BINS) + 0.5) / BINS, counts, width=0.9 / BINS, color="#6fa3cc")
        axes.set_xlabel("rank of the true forgetting in its posterior; grey: 99 % of counts if uniform")
        axes.set_ylabel("people")
    return figure
