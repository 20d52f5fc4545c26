"""The figures of a report: the flow of participants, every person's values, effects, the course of the game."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from scipy import special, stats

from kiosk.analysis.behaviours import MemoryCalibration
from kiosk.analysis.data import Floats
from kiosk.analysis.page import Picture, arrow, box, boxes_svg, number, svg_of
from kiosk.analysis.policy_figures import STYLE
from kiosk.analysis.report import Report
from kiosk.analysis.sample import NOT_COMPLETED, Measure, Sample
from kiosk.analysis.statistics import ROBUSTNESS
from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import Stage
from kiosk.export.flow import FlowQuantity

COLOURS = {
    Condition.TOM.name: "#0072B2",
    Condition.NOTOM.name: "#D55E00",
    Condition.MENTALISED_UNEXPLAINED.name: "#009E73",
    Condition.RANDOM_EXPLAINED.name: "#AA4499",
    Condition.NO_ASSISTANCE.name: "#555555",
}
"""Okabe and Ito's colours, which differ also for people who do not see all of them."""
MARKERS = ("o", "s", "^", "D", "v")
MOST_POINTS = 300
"""With more people in an arm their distribution is drawn instead of a point for each."""
_STYLE = STYLE | {
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#666666",
    "axes.labelcolor": "#1c1e21",
    "xtick.color": "#444444",
    "ytick.color": "#444444",
    "axes.titlesize": 10,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
}


def colour_of(condition: str) -> str:
    """Return the colour of a condition in every figure."""
    return COLOURS.get(condition, "#333333")


def spoken(condition: str) -> str:
    """Return a condition on one or two lines of an axis."""
    return condition.replace("_", "\n")


# The flow of participants


def flow_figure(report: Report) -> Picture:
    """Return the flow of participants, after CONSORT: who came, who was allocated what, who left, who is analysed."""
    sample = report.sample
    arms = [each.condition for each in report.completion]
    width = 190 * len(arms) + 10 if len(arms) > 1 else 400
    middle, top = width / 2, 8.0
    parts: list[str] = []
    for lines in _before_allocation(sample):
        drawn, height = box((middle - 130, top, 260), lines)
        if parts:
            parts.append(arrow((middle, top - 18), (middle, top)))
        parts.append(drawn)
        top += height + 18
    centres = [5 + 190 * at + 95 for at in range(len(arms))]
    parts.append(f'<path d="M{middle:g} {top - 18:g}V{top - 4:g}" stroke="#444" fill="none"/>')
    parts.append(f'<path d="M{centres[0]:g} {top - 4:g}H{centres[-1]:g}" stroke="#444" fill="none"/>')
    columns = [_arm_boxes(report, name) for name in arms]
    top += 14
    for row, boxes in enumerate(zip(*columns, strict=True)):
        tallest = 0.0
        for name, centre, lines in zip(arms, centres, boxes, strict=True):
            drawn, height = box((centre - 88, top, 176), lines, colour_of(name))
            parts += [arrow((centre, top - 18), (centre, top)), drawn]
            tallest = max(tallest, height)
        for centre, lines in zip(centres, boxes, strict=True):
            height = 14.0 + 17 * len(lines)
            if row < len(columns[0]) - 1 and height < tallest:
                parts.append(f'<path d="M{centre:g} {top + height:g}V{top + tallest:g}" stroke="#444" fill="none"/>')
        top += tallest + 18
    alt = ". ".join(" ".join(lines) for lines in (*_before_allocation(sample), *(b for c in columns for b in c)))
    caption = "Flow of participants, from those who came to those who are analysed."
    return Picture("flow", caption, boxes_svg((width, round(top)), parts), alt, wide=True)


def _flow_counts(sample: Sample) -> dict[str, dict[str, int]]:
    """Return the counts of the table of the flow.

    It is a number for each group of each quantity, of people only if there are.
    """
    table = sample.study.tables["flow"]
    pretended = table.truths("simulated") | table.truths("trial")
    counts: dict[str, dict[str, int]] = {}
    for quantity, group, count, other in zip(
        table.text("quantity"), table.text("group"), table.numbers("count"), pretended, strict=True
    ):
        if sample.simulated or not other:
            counts.setdefault(quantity, {})[group] = counts.get(quantity, {}).get(group, 0) + int(count)
    return counts


def _before_allocation(sample: Sample) -> list[list[str]]:
    counts = _flow_counts(sample)
    not_stored = counts.get(FlowQuantity.NOT_STORED.value, {})
    withheld = {
        "withdrew": FlowQuantity.WITHDRAWN,
        "did not agree to publishing": FlowQuantity.NOT_SHARED,
        "still going on": FlowQuantity.NOT_ENDED,
    }
    missing = {text: sum(counts.get(quantity.value, {}).values()) for text, quantity in withheld.items()}
    stored = len(sample.exported) + sum(missing.values())
    boxes = [[f"Came to the kiosk (n = {stored + sum(not_stored.values())})"]]
    if not_stored:
        boxes[0] += [f"not stored, {reason.replace('_', ' ')}: {n}" for reason, n in not_stored.items()]
    if any(missing.values()):
        boxes.append([f"Sessions stored (n = {stored})", *(f"{text}: {n}" for text, n in missing.items() if n)])
    return [*boxes, [f"In this data set (n = {len(sample.exported)})"]]


def _arm_boxes(report: Report, condition: str) -> list[list[str]]:
    sample = report.sample
    completion = next(each for each in report.completion if each.condition == condition)
    here = sum(name == condition for name in sample.exported.text("condition"))
    own = [step for step in sample.steps if step.counts.get(condition) and step.rule != NOT_COMPLETED]
    lines = [text for step in own for text in textwrap.wrap(f"{step.rule}: {step.counts[condition]}", 26)]
    left = [f"{stage.replace('_', ' ')}: {n}" for stage, n in completion.ended.items()]
    analysed = int(sample.rows(condition).sum())
    return [
        [condition.replace("_", " "), f"sessions: {here}", f"allocated by chance: {completion.allocated}"],
        [f"Game not completed: {completion.allocated - completion.completed}", *left],
        [f"Excluded: {sum(step.counts[condition] for step in own)}", *lines],
        [f"Analysed: {analysed}"],
    ]


# Every person's values


def values_picture(sample: Sample, measure: Measure) -> Picture:
    """Each person's value in each condition, with the box of quartiles, the mean and its 95 % interval."""
    groups = {name: sample.values(measure.name, name) * measure.scale for name in sample.conditions}
    with mpl.rc_context(_STYLE):
        figure = Figure(figsize=(3.4, 2.9))
        axes = figure.add_axes((0.13, 0.15, 0.85, 0.74))
        for at, (name, values) in enumerate(groups.items()):
            _draw_group(axes, at, values, name)
        axes.set_xticks(range(len(groups)), [spoken(name) for name in groups], fontsize=9 if len(groups) < 4 else 7)  # noqa: PLR2004
        axes.set_xlim(-0.55, len(groups) - 0.45)
        axes.set_title(measure.title)
        axes.yaxis.grid(visible=True, color="#eceef1")
        axes.set_axisbelow(True)
    told = "; ".join(f"{name}: {_in_words(values, measure.digits)}" for name, values in groups.items())
    name = f"values-{measure.name.replace('.', '-')}"
    return Picture(name, measure.title, svg_of(figure, name), f"{measure.title}. {told}.")


def _in_words(values: Floats, digits: int) -> str:
    if not len(values):
        return "no one"
    ends = f"from {number(float(values.min()), digits)} to {number(float(values.max()), digits)}"
    return f"{len(values)} people, mean {number(float(values.mean()), digits)}, {ends}"


def _draw_group(axes: Axes, at: int, values: Floats, name: str) -> None:
    if not len(values):
        return
    colour = colour_of(name)
    if len(values) > MOST_POINTS:
        heights, edges = np.histogram(values, 40)
        width = 0.28 * np.repeat(heights / heights.max(), 2)
        axes.fill_betweenx(np.repeat(edges, 2)[1:-1], at - width, at + width, color=colour, alpha=0.3, linewidth=0)
    else:
        axes.plot(at + _spread(values), values, "o", color=colour, alpha=0.45, markersize=3.2, markeredgewidth=0)
    low, median, high = np.percentile(values, [25, 50, 75])
    axes.add_patch(mpl.patches.Rectangle((at - 0.36, low), 0.72, high - low, fill=False, edgecolor="#8a9099", lw=0.8))
    axes.hlines(median, at - 0.36, at + 0.36, color="#8a9099", linewidth=1.2)
    if len(values) > 2:  # noqa: PLR2004 - no interval from fewer
        margin = float(special.stdtrit(len(values) - 1, 0.975)) * values.std(ddof=1) / math.sqrt(len(values))
        axes.errorbar(at, values.mean(), margin, color="#111111", marker="D", markersize=4.5, capsize=4, linewidth=1.6)


def _spread(values: Floats) -> Floats:
    """Sideways places of points, so that equal and near ones stand side by side; the same for the same values."""
    order = np.argsort(values, kind="stable")
    step = (values.max() - values.min()) / 24 or 1.0
    rows = np.round((values - values.min()) / step).astype(int)
    places = np.zeros(len(values))
    for row in np.unique(rows):
        members = [at for at in order if rows[at] == row]
        centred = np.arange(len(members)) - (len(members) - 1) / 2
        places[members] = centred * min(0.05, 0.6 / max(1, len(members) - 1))
    return places


# Effects


def effects_figure(report: Report) -> Picture:
    """Hedges' g of every measure with its 95 % interval; those of the hypotheses are filled."""
    wanted = {each.measure for each in report.hypotheses}
    titles = {each.name: each.label for each in report.sample.measures}
    rows = [each for each in report.comparisons if each.line("hedges_g").known][::-1]
    with mpl.rc_context(_STYLE):
        height = 0.7 + 0.3 * max(1, len(rows))
        figure = Figure(figsize=(4.3, height))
        axes = figure.add_axes((0.47, 0.5 / height, 0.51, 1 - 0.55 / height))
        bound = report.plan.smallest_effect
        axes.axvspan(-bound, bound, color="#f0f2f5", zorder=0)
        axes.axvline(0, color="#888888", linewidth=0.9)
        for at, each in enumerate(rows):
            g = each.line("hedges_g")
            face = "#1f5a8c" if each.measure in wanted else "white"
            axes.plot([g.low, g.high], [at, at], color="#1f5a8c", linewidth=1.6)
            axes.plot(g.estimate, at, "o", markerfacecolor=face, markeredgecolor="#1f5a8c", markersize=6)
        axes.set_yticks(range(len(rows)), [titles[each.measure] for each in rows])
        axes.tick_params(axis="y", length=0)
        axes.spines["left"].set_visible(False)
        first, second = report.pair
        axes.set_xlabel(f"Hedges' g, {first} less {second}")
    told = "; ".join(
        f"{titles[each.measure]} {number(g.estimate)} from {number(g.low)} to {number(g.high)}"
        for each in rows[::-1]
        for g in (each.line("hedges_g"),)
    )
    caption = (
        f"Standardised differences with 95 % intervals. Filled: measures of the hypotheses. Grey: smaller than the "
        f"smallest effect of interest, d = {number(bound)}."
    )
    return Picture("effects", caption, svg_of(figure, "effects"), f"Hedges' g. {told}.")


def bayes_figure(report: Report) -> Picture:
    """Return the Bayes factor of each hypothesis over the prior's scale."""
    with mpl.rc_context(_STYLE):
        figure = Figure(figsize=(4.4, 2.8))
        axes = figure.add_axes((0.15, 0.17, 0.5, 0.79))
        told = []
        for at, each in enumerate(report.hypotheses):
            lines = _bayes_lines(report, each.measure)
            if not lines:
                continue
            axes.plot(ROBUSTNESS, lines, marker=MARKERS[at % len(MARKERS)], markersize=4, linewidth=1.2, label=each.id)
            told.append(f"{each.id} from {min(lines):.3g} to {max(lines):.3g}")
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 3), numticks=12))
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.axhline(1, color="#888888", linewidth=0.9)
        axes.set(xlabel="scale r of the Cauchy prior", ylabel="Bayes factor for a difference")
        if told:
            axes.legend(frameon=False, fontsize=7.5, loc="upper left", bbox_to_anchor=(1.01, 1))
    caption = "Bayes factors for a difference over none (JZS), over the scale of the prior. Below 1: for no difference."
    return Picture("bayes-factors", caption, svg_of(figure, "bayes-factors"), f"Bayes factors. {'; '.join(told)}.")


def _bayes_lines(report: Report, measure: str) -> Sequence[float]:
    if measure not in {each.measure for each in report.comparisons}:
        return ()
    found = [report.comparison(measure).line(f"bayes_{scale:.3g}").estimate for scale in ROBUSTNESS]
    return () if any(math.isnan(each) for each in found) else found


# The course of the game


def course_picture(report: Report) -> Picture:
    """Pairs found over the flips of the game: the mean of each condition with its 95 % interval."""
    sample = report.sample
    courses = _courses(sample)
    with mpl.rc_context(_STYLE):
        figure = Figure(figsize=(4.4, 2.9))
        axes = figure.add_axes((0.11, 0.16, 0.87, 0.81))
        told = []
        for name, found in courses.items():
            flips = np.arange(found.shape[1])
            mean = found.mean(axis=0)
            margin = stats.t.ppf(0.975, len(found) - 1) * found.std(axis=0, ddof=1) / math.sqrt(len(found))
            axes.fill_between(flips, mean - margin, mean + margin, color=colour_of(name), alpha=0.18, linewidth=0)
            axes.plot(flips, mean, color=colour_of(name), linewidth=1.8, label=name.replace("_", " "))
            half = int(np.argmax(mean >= mean[-1] / 2))
            told.append(f"{name}: half of the pairs after {half} flips")
        axes.set(xlabel="flips of the game", ylabel="pairs found (mean)")
        axes.legend(frameon=False, loc="upper left", fontsize=8)
    caption = "How the game goes: pairs found so far, as the mean of each condition with its 95 % interval."
    return Picture("pairs-found", caption, svg_of(figure, "pairs-found"), f"Pairs over flips. {'; '.join(told)}.")


def _courses(sample: Sample) -> Mapping[str, Floats]:
    """For each condition of three people or more, the pairs that each person had found after each number of flips."""
    table = sample.study.tables["flips"]
    place = {name: row for row, name in enumerate(sample.people.text("participant_id"))}
    owner = np.array([place.get(who, -1) for who in table.text("participant_id")])
    rows = (owner >= 0) & np.array([stage == Stage.GAME.value for stage in table.text("stage")], dtype=np.bool_)
    flip = table.numbers("flip")[rows].astype(int)
    matched = np.nan_to_num(table.numbers("matched")[rows])
    # Most games are over by then; the few longest ones would stretch the figure.
    last = int(np.percentile(flip, 99)) if len(flip) else 1
    found = np.zeros((len(place), last + 1))
    inside = flip <= last
    # Both cards of a match may be marked; a pair counts when its second card is turned up.
    second = np.array([card == "second" for card in table.text("move_card")], dtype=np.bool_)[rows]
    np.add.at(found, (owner[rows][inside], flip[inside]), (matched * second)[inside])
    found = np.cumsum(found, axis=1)
    arms = {name: found[sample.rows(name)] for name in sample.conditions}
    return {name: arm for name, arm in arms.items() if len(arm) > 2}  # noqa: PLR2004 - no interval from fewer


# The model of memory


def reliability_picture(memory: MemoryCalibration) -> Picture:
    """Return the reliability curve: the share that matched over the predicted chance, with 95 % intervals."""
    bins = memory.bins
    predicted, matched = ([getattr(each, name) for each in bins] for name in ("predicted", "matched"))
    with mpl.rc_context(_STYLE):
        figure = Figure(figsize=(3.4, 3.2))
        axes = figure.add_axes((0.15, 0.15, 0.82, 0.82))
        axes.plot((0, 1), (0, 1), color="#888888", linewidth=1, linestyle="--")
        for each in bins:
            if not math.isnan(each.matched_low):
                axes.plot((each.predicted,) * 2, (each.matched_low, each.matched_high), color="#0072B2", linewidth=1.2)
        axes.plot(predicted, matched, color="#0072B2", linewidth=1.2, marker="o", markersize=4)
        axes.set(xlabel="predicted chance of a match", ylabel="share that matched", xlim=(0, 1), ylim=(0, 1))
    caption = "Second cards without a hint: predicted and observed. On the dashed line both are the same."
    told = "; ".join(f"predicted {one:.2f}, matched {other:.2f}" for one, other in zip(predicted, matched, strict=True))
    return Picture("memory-reliability", caption, svg_of(figure, "memory-reliability"), f"{told}.")
