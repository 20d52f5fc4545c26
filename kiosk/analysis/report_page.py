"""A report as a page: tables, figures, sentences in APA form, and tables for a paper."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Sequence

import numpy as np
import scipy

from kiosk import __version__
from kiosk.analysis.behaviours import BINS, MemoryCalibration
from kiosk.analysis.compare import Comparison, Line
from kiosk.analysis.data import scale_remarks
from kiosk.analysis.hypotheses_page import (
    hypotheses_blocks,
    hypotheses_table,
    measure_of,
    sensitivity_blocks,
    sentence,
    statistic_of,
)
from kiosk.analysis.page import (
    NOTHING,
    Block,
    DataSource,
    Gallery,
    ReportPage,
    ReportTable,
    Section,
    factor,
    interval,
    latex_table,
    markdown_table,
    number,
    p_value,
)
from kiosk.analysis.paper import paper_section
from kiosk.analysis.report import CONFIRMATORY, Report, describe
from kiosk.analysis.report_figures import bayes_figure, course_picture, flow_figure, reliability_picture, values_picture
from kiosk.analysis.sample import Measure

TEST_NAMES = {
    "welch": "Welch's t test",
    "student": "Student's t test",
    "mann-whitney": "Mann-Whitney U; rank-biserial r",
    "permutation": "Permutation of means",
    "equivalence": "Equivalence (TOST), 90 % interval",
    "bootstrap": "BCa bootstrap of means",
    "hedges_g": "Hedges' g",
    "cohen_d": "Cohen's d",
    "brown_forsythe": "Brown-Forsythe: equal spread",
}


def report_page(report: Report, *, with_paper: bool = False) -> ReportPage:
    """Return the whole report as a page."""
    sample, standing = report.sample, report.standing
    first, second = report.pair
    analysed = ", ".join(f"{name}: {int(sample.rows(name).sum())}" for name in sample.conditions)
    facts = [
        ("Analysed", analysed),
        ("Compared by the plan", f"{first} with {second}"),
        ("Data", f"SHA-256 {sample.study.sha256[:16]}"),
        ("Plan", f"SHA-256 {standing.sha256[:16]}" if standing.sha256 else "the template"),
    ]
    sections = [*_sections(report)]
    if with_paper:
        sections.append(paper_section())
    sections += [_paste(report), _methods(report)]
    return ReportPage(sample.study.title, standing.status, standing.reason, tuple(facts), tuple(sections))


def _sections(report: Report) -> Iterator[Section]:
    yield Section("hypotheses", "Hypotheses", tuple(hypotheses_blocks(report)))
    yield Section("participants", "Participants", tuple(_participants(report)))
    yield Section("measures", _also(report, "Measures"), tuple(_measures(report)))
    yield Section("tests", _also(report, "All tests of each measure"), tuple(_tests(report)))
    yield Section("sensitivity", "Sensitivity", tuple(sensitivity_blocks(report)))
    yield Section("bayes", _also(report, "Bayes factors"), tuple(_bayes(report)))
    if report.design:
        yield Section("design", _also(report, "The 2 x 2 design"), tuple(_design(report)))
    if report.others:
        yield Section("pairs", _also(report, "Other pairs of conditions"), tuple(_other_pairs(report)))
    if report.proximal:
        yield Section("proximal", _also(report, "What each kind of hint does"), tuple(_proximal(report)))
    if report.behaviours:
        yield Section("behaviours", _also(report, "Looks and remarks"), tuple(_behaviours(report)))
    if report.memory is not None:
        yield Section("memory", _also(report, "The model of memory"), tuple(_memory(report.memory)))
    yield Section("course", _also(report, "The course of the game"), tuple(_course(report)))
    yield Section("reliability", "Reliability of the scales", tuple(_reliability(report)))


def _also(report: Report, title: str) -> str:
    """Return the title of a part that the plan does not declare."""
    return f"{title} (exploratory)" if report.standing.status == CONFIRMATORY else title


# Participants


def _participants(report: Report) -> Iterator[Block]:
    yield flow_figure(report)
    stages = dict.fromkeys(stage for each in report.completion for stage in each.ended)
    rows = []
    for each in report.completion:
        share = f"{number(100 * each.share.value, 0)} % {interval(100 * each.share.low, 100 * each.share.high, 0)}"
        counts = (str(each.ended.get(stage, 0)) for stage in stages)
        rows.append((each.condition, str(each.allocated), str(each.completed), share, *counts))
    head = (
        "condition",
        "allocated",
        "completed",
        "share [95 %]",
        *(f"left: {stage.replace('_', ' ')}" for stage in stages),
    )
    tested = report.completion_p
    note = "Of those whose condition was drawn; shares with Wilson's interval. " + (
        f"Fisher's exact test of {report.pair[0]} and {report.pair[1]}: p = {p_value(tested.estimate)}."
        if not math.isnan(tested.estimate)
        else f"No test: {tested.note}."
    )
    yield ReportTable("completion-table", "Who completed the game, and where the others left.", head, tuple(rows), note)
    conditions = [each.condition for each in report.completion]
    steps = report.sample.steps
    if steps:
        excluded = tuple((step.rule, *(str(step.counts.get(name, 0)) for name in conditions)) for step in steps)
        yield ReportTable(
            "exclusions-table", "Exclusions, in the order in which they apply.", ("rule", *conditions), excluded
        )
    else:
        yield "No session was excluded."
    if report.sample.later:
        yield (
            "Each participant counts once, by the first visit. Sessions of later visits, which are in the data set and "
            f"not analysed here: {report.sample.later}."
        )
    if report.any_hint:
        yield _comparison_table(
            report,
            "any-hint-table",
            "All who saw a first hint, whether or not they completed the game.",
            [(each, math.nan) for each in report.any_hint],
        )
    yield (
        f"With these numbers a two-sided t test at .05 finds an effect of d = {number(report.detectable)} in 80 % of "
        "studies."
    )


# Measures and tests


def _measures(report: Report) -> Iterator[Block]:
    sample = report.sample
    known = {each.name: each for each in sample.measures}
    rows = []
    for row in describe(sample):
        measure = known[row["measure"]]
        names = ("mean", "sd", "median", "q1", "q3", "least", "most")
        values = [math.nan if row[name] is None else row[name] * measure.scale for name in names]
        mean, sd, median, q1, q3, least, most = (number(value, measure.digits) for value in values)
        cells = (mean, sd, median, f"{q1} to {q3}", f"{least} to {most}")
        rows.append((measure.title, row["condition"], str(row["n"]), *cells))
    yield Gallery(
        "values",
        "Every person's value; grey: quartiles and median; black: mean with its 95 % interval.",
        tuple(values_picture(sample, each) for each in sample.measures),
    )
    head = ("measure", "condition", "n", "M", "SD", "median", "quartiles", "range")
    note = (
        "Shares of hints exist only for people who had such hints, so n differs there. Time with speech grows with the "
        "length of the sentences; compare conditions by the time without."
    )
    yield ReportTable("descriptives-table", "Measures by condition.", head, tuple(rows), note)


def _tests(report: Report) -> Iterator[Block]:
    first, second = report.pair
    yield (
        f"Differences are {first} less {second}. All p values here are two-sided and not corrected. A row without "
        "numbers says why the data do not determine it."
    )
    for compared in report.comparisons:
        measure = measure_of(report, compared.measure)
        rows = tuple(_test_row(line, measure) for line in compared.lines if not line.name.startswith("bayes_"))
        caption = f"{measure.title}: {first} (n = {compared.n[0]}) and {second} (n = {compared.n[1]})."
        name = f"tests-{compared.measure.replace('.', '-')}"
        yield ReportTable(name, caption, ("test", "statistic", "p", "estimate", "95 % interval", "note"), rows)


_IN_THE_UNIT = ("welch", "student", "equivalence", "bootstrap")
"""Lines whose estimate is in the unit of the measure."""


def _test_row(line: Line, measure: Measure) -> tuple[str, ...]:
    scale, digits = (measure.scale, measure.digits + 1) if line.name in _IN_THE_UNIT else (1.0, 2)
    name = TEST_NAMES.get(line.name, line.name.replace("shapiro_", "Shapiro-Wilk, "))
    shown = number(line.statistic * measure.scale, measure.digits + 1) if line.name == "permutation" else _short(line)
    interval_ = interval(line.low * scale, line.high * scale, digits)
    return name, shown, p_value(line.p), number(line.estimate * scale, digits), interval_, line.note or ""


def _short(line: Line) -> str:
    if math.isnan(line.statistic) or math.isnan(line.df):
        return NOTHING if math.isnan(line.statistic) else f"{line.symbol} = {number(line.statistic)}"
    df = number(line.df, 0 if float(line.df).is_integer() else 1)
    return f"{line.symbol}({'1, ' if line.symbol == 'F' else ''}{df}) = {number(line.statistic)}"


def _bayes(report: Report) -> Iterator[Block]:
    yield bayes_figure(report)
    scales = [line.name for line in report.comparisons[0].lines if line.name.startswith("bayes_")]
    rows = tuple(
        (measure_of(report, each.measure).label, *(factor(each.line(name).estimate) for name in scales))
        for each in report.comparisons
    )
    head = ("measure", *(f"r = {name.removeprefix('bayes_')}" for name in scales))
    note = "BF10: above 1 the data speak for a difference, below 1 for none; 3 or 1/3 is little, 10 or 1/10 is much."
    yield ReportTable(
        "bayes-table", "Bayes factors for a difference of means, by the scale of the prior.", head, rows, note
    )


def _design(report: Report) -> Iterator[Block]:
    rows = []
    for each in report.design:
        label = measure_of(report, each.measure).label
        if not each.effects:
            rows.append((label, each.note, *[NOTHING] * 3))
        for effect in each.effects:
            f = f"F(1, {effect.df}) = {number(effect.f)}"
            rows.append((label, effect.name, f, p_value(effect.p), f"{effect.size:.3f}".removeprefix("0")))
    head = ("measure", "effect", "F", "p", "partial eta squared")
    note = "Sums of squares of type III; p values are not corrected."
    yield ReportTable(
        "design-table", "Target (mentalised or random) by reason (given or not).", head, tuple(rows), note
    )


def _other_pairs(report: Report) -> Iterator[Block]:
    yield _comparison_table(
        report, "pairs-table", "The measures of the hypotheses in all other pairs of conditions.", report.others
    )


def _proximal(report: Report) -> Iterator[Block]:
    rows = []
    for each in report.proximal:
        counts = (each.card, each.action, str(each.decisions), str(each.people))
        if each.note:
            rows.append((*counts, NOTHING, NOTHING, each.note))
            continue
        effect = f"{number(each.effect, 3)} {interval(each.low, each.high)}"
        rows.append((*counts, number(each.matched, 3), number(each.unhelped, 3), effect))
    head = ("card", "hint", "decisions", "people", "matched with it", "without help", "difference [95 %]")
    note = (
        "Decisions that chance had a part in, each weighed by one over the probability of its action. The interval "
        "comes from leaving out one person at a time. The effect is on the move of the hint, not on the whole game."
    )
    caption = "How much more often a move matched with each kind of hint than without help."
    yield ReportTable("proximal-table", caption, head, tuple(rows), note)


def _behaviours(report: Report) -> Iterator[Block]:
    rows = tuple(
        (each.behaviour, each.condition, str(each.times), number(each.per_person)) for each in report.behaviours
    )
    head = ("behaviour", "condition", "times", "per person")
    yield ReportTable("behaviours-table", "How often the helper looked, praised and encouraged.", head, rows, "")


def _memory(memory: MemoryCalibration) -> Iterator[Block]:
    yield reliability_picture(memory)
    rows = tuple(
        (
            f"{each.low:.1f} to {each.low + 1 / BINS:.1f}",
            str(each.cards),
            str(each.people),
            number(each.predicted, 3),
            f"{number(each.matched, 3)} {interval(each.matched_low, each.matched_high)}",
        )
        for each in memory.bins
    )
    head = ("predicted chance", "second cards", "people", "mean prediction", "matched [95 %]")
    note = (
        f"{memory.cards} second cards without a hint, of {memory.people} people. Brier score {number(memory.brier, 3)} "
        f"({number(memory.brier_of_share, 3)} for always predicting the share of matches); expected calibration error "
        f"{number(memory.calibration_error, 3)}. Intervals come from leaving out one person at a time."
    )
    caption = "What the model of memory predicted before second cards, and how many matched."
    yield ReportTable("memory-table", caption, head, rows, note)


def _comparison_table(
    report: Report, name: str, caption: str, compared: Sequence[tuple[Comparison, float]]
) -> ReportTable:
    rows = []
    corrected = any(not math.isnan(p) for _, p in compared)
    for each, p in compared:
        measure = measure_of(report, each.measure)
        welch, g = each.line("welch"), each.line("hedges_g")
        means = " / ".join(number(value * measure.scale, measure.digits) for value in each.mean)
        cells = [f"{each.groups[0]}, {each.groups[1]}", f"{each.n[0]} + {each.n[1]}", means, statistic_of(welch)]
        cells += [p_value(welch.p), *([p_value(p)] if corrected else [])]
        rows.append((measure.title, *cells, f"{number(g.estimate)} {interval(g.low, g.high)}"))
    head = ("measure", "conditions", "n", "M", "Welch", "p", *(["p, Holm"] if corrected else []), "g [95 %]")
    return ReportTable(name, caption, head, tuple(rows), "Holm within each measure." if corrected else "")


def _course(report: Report) -> Iterator[Block]:
    yield course_picture(report)
    yield (
        "Hits of single hints and moves, in logistic models with a random intercept for each person. People "
        "without hints need not be left out of a mean."
    )
    for each in report.models:
        if each.model is None:
            yield f"{each.name}: no model ({each.note})."
            continue
        rows = tuple(
            (
                c.name,
                f"{number(c.value)} ({number(c.error)})",
                interval(c.low, c.high),
                number(math.exp(c.value)),
                number(c.chi_squared),
                p_value(c.p),
            )
            for c in each.model.coefficients
        )
        head = ("term", "log odds (SE)", "95 % interval", "odds ratio", "chi-squared(1)", "p")
        note = (
            f"{each.model.trials} trials of {each.model.people} people; SD of the intercepts {number(each.model.sd)}."
        )
        note += f" {each.model.note[:1].upper()}{each.model.note[1:]}." if each.model.note else ""
        name = "".join(letter if letter.isalnum() else "-" for letter in each.name)
        yield ReportTable(f"model-{name}", f"{each.name}: {each.about}.", head, rows, note)


def _reliability(report: Report) -> Iterator[Block]:
    if not report.scales:
        yield "This data set has no answers to scored items."
        return
    rows = []
    for each in report.scales:
        if each.found is None:
            rows.append((each.name, str(len(each.items)), NOTHING, NOTHING, NOTHING, each.note))
            continue
        alpha, omega = each.found.alpha, each.found.omega
        rest = "; ".join(f"{item} {number(r)}" for item, r in zip(each.items, each.found.item_rest, strict=True))
        cells = (f"{number(alpha.value)} {interval(alpha.low, alpha.high)}", number(omega))
        rows.append((each.name, str(len(each.items)), str(each.found.n), *cells, each.found.omega_note or rest))
    head = ("scale", "items", "n", "alpha [95 %]", "omega", "item-rest correlations")
    note = "Alpha with Feldt's interval; omega of one factor by maximum likelihood. People with all items answered."
    yield ReportTable("reliability-table", "Reliability of the scales.", head, tuple(rows), note)
    yield from scale_remarks(report.sample.study, report.sample.people.text("participant_id"))


# The end


def _paste(report: Report) -> Section:
    table = hypotheses_table(report)
    blocks: list[Block] = [
        "Table 1 can be marked and pasted into a word processor as it is. For other programs it stands here as a text; "
        "a click marks all of it.",
        DataSource("Table 1 in Markdown", markdown_table(table)),
        DataSource("Table 1 in LaTeX (needs the package booktabs)", latex_table(table)),
        DataSource("The sentences of the hypotheses", "\n".join(sentence(report, each) for each in report.hypotheses)),
    ]
    return Section("paste", "For a paper", tuple(blocks))


def _methods(report: Report) -> Section:
    plan = report.plan
    versions = (
        f"Python {sys.version_info.major}.{sys.version_info.minor}, numpy {np.__version__}, scipy {scipy.__version__}"
    )
    return Section(
        "methods",
        "How it was worked out",
        (
            f"Recollect {__version__} read an exported data set and nothing else; {versions}. The same data give the "
            "same report, byte for byte: every draw starts from a fixed seed.",
            f"Population: {plan.population}. Exclusions: {plan.exclusions}. Correction: {plan.correction} within each "
            f"family. Alpha: {plan.alpha:g}. Smallest effect of interest: d = {plan.smallest_effect:g}.",
            "Rank tests are exact, with ties, up to 10,000 pairs; permutations are counted up to 50,000 splits and "
            "drawn beyond. Intervals of d and g come from the noncentral t, those of the bootstrap are BCa. Bayes "
            "factors are JZS. Mixed models use 25 nodes of adaptive Gauss-Hermite quadrature and likelihood-ratio "
            "tests. All of them are compared with R in the program's tests.",
            f"SHA-256 of the data: {report.sample.study.sha256}."
            + (f" SHA-256 of the plan: {report.standing.sha256}." if report.standing.sha256 else ""),
        ),
    )


def paper_page() -> ReportPage:
    """Return the paper's numbers alone, without a data set."""
    return ReportPage(
        "The paper's numbers, recomputed",
        "EXPLORATORY",
        "worked out from published means and standard deviations",
        (("Paper", "Andriella, Falcone and Rossi, arXiv 2411.07003"),),
        (paper_section(),),
    )
