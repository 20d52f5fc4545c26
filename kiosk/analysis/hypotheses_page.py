"""The hypotheses on the page of a report: their table, sentences in APA form, looks and sensitivity."""

from __future__ import annotations

import math
from collections.abc import Iterator

from kiosk.analysis.compare import Line
from kiosk.analysis.hypotheses import HypothesisResult, SensitivityResult
from kiosk.analysis.page import NOTHING, Block, ReportTable, factor, interval, number, p_value
from kiosk.analysis.report import Report
from kiosk.analysis.report_figures import effects_figure
from kiosk.analysis.sample import Measure


def hypotheses_blocks(report: Report) -> Iterator[Block]:
    """Yield the tests of the plan's hypotheses, and the looks that it declares."""
    if report.plan.question:
        yield report.plan.question
    yield hypotheses_table(report)
    yield effects_figure(report)
    yield from (sentence(report, each) for each in report.hypotheses)
    if report.plan.sequential is not None:
        yield _looks_table(report)


def hypotheses_table(report: Report) -> ReportTable:
    """Return the hypotheses with their tests, the table of a paper."""
    first, second = report.pair
    rows = []
    for each in report.hypotheses:
        known = measure_of(report, each.measure)
        spread = [number(g * known.scale, known.digits) for g in _means_and_sds(report, each)]
        rows.append(
            (
                f"{each.id}: {_SIGNS[each.direction].format(first, second)}",
                known.title,
                f"{spread[0]} ({spread[1]})",
                f"{spread[2]} ({spread[3]})",
                statistic_of(each.line),
                p_value(each.p),
                p_value(each.corrected),
                f"{number(each.hedges_g.estimate)} {interval(each.hedges_g.low, each.hedges_g.high)}",
                factor(each.bayes),
                each.verdict,
            )
        )
    head = ("hypothesis", "measure", f"{first}: M (SD)", f"{second}: M (SD)", "test", "p", _corrected_head(report))
    level = report.hypotheses[0].level
    note = (
        f"One-sided p where a hypothesis has a direction; the verdict compares the corrected p with {level:.4g}. "
        "g: Hedges' g with its 95 % interval. BF10: Bayes factor for a difference (JZS, r = .707)."
    )
    return ReportTable(
        "hypotheses-table", "The hypotheses of the plan.", (*head, "g [95 %]", "BF10", "verdict"), tuple(rows), note
    )


_SIGNS = {"less": "{} < {}", "greater": "{} > {}", "two-sided": "{} and {} differ"}


def _corrected_head(report: Report) -> str:
    return {"holm": "p, Holm", "bh": "p, BH", "none": "p, uncorrected"}[report.plan.correction]


def measure_of(report: Report, name: str) -> Measure:
    """Return a measure by its name, also one that the sample does not know."""
    return next((each for each in report.sample.measures if each.name == name), Measure(name, name))


def _means_and_sds(report: Report, each: HypothesisResult) -> list[float]:
    if each.measure not in {compared.measure for compared in report.comparisons}:
        return [math.nan] * 4
    compared = report.comparison(each.measure)
    return [compared.mean[0], compared.sd[0], compared.mean[1], compared.sd[1]]


def statistic_of(line: Line) -> str:
    """Return the statistic of a test with its degrees of freedom."""
    if math.isnan(line.statistic):
        return NOTHING
    if line.symbol == "U":
        return f"U = {number(line.statistic, 1)}"
    df = number(line.df, 0 if float(line.df).is_integer() else 1)
    return f"{line.symbol}({df}) = {number(line.statistic)}"


def sentence(report: Report, each: HypothesisResult) -> str:
    """Return a hypothesis in a sentence, as APA asks for it."""
    known = measure_of(report, each.measure)
    if math.isnan(each.line.p):
        return f"{each.id}. {known.label} could not be tested ({each.line.note or 'no values'})."
    first, second = report.pair
    means = [number(value * known.scale, known.digits) for value in _means_and_sds(report, each)]
    unit = f" {known.unit}" if known.unit == "s" else ""
    p = [text if text.startswith("<") else f"= {text}" for text in (p_value(each.p), p_value(each.corrected))]
    corrected = f" (corrected p {p[1]})" if report.plan.correction != "none" else ""
    side = "" if each.direction == "two-sided" else "one-sided "
    verdict = "supports" if each.verdict == "supported" else "does not support"
    return (
        f"{each.id}. {known.label}: M = {means[0]}{unit} (SD = {means[1]}) in {first} and M = {means[2]}{unit} "
        f"(SD = {means[3]}) in {second}, {statistic_of(each.line)}, {side}p {p[0]}{corrected}, g = "
        f"{number(each.hedges_g.estimate)}, 95 % CI {interval(each.hedges_g.low, each.hedges_g.high)}. "
        f"This {verdict} the hypothesis."
    )


def _looks_table(report: Report) -> ReportTable:
    rows = tuple(
        (
            f"{each.per_arm} an arm",
            each.hypothesis,
            p_value(each.p),
            _level(each.level),
            factor(each.bayes),
            "stop" if each.crossed else "go on",
        )
        for each in report.looks
    )
    sequential = report.plan.sequential
    how = sequential.spending if sequential is not None else ""
    taken = ", ".join(str(n) for plan in report.sample.study.plans for n in plan.looks) or "none"
    note = f"Two-sided p, corrected within each family, of the first people of each arm. Looks recorded: {taken}."
    head = ("look", "hypothesis", "p", "level", "BF10", "rule")
    return ReportTable("looks-table", f"The declared looks that were reached ({how}).", head, rows, note)


def _level(level: float) -> str:
    return NOTHING if math.isnan(level) else f"{level:.5f}".removeprefix("0")


def sensitivity_blocks(report: Report) -> Iterator[Block]:
    """Yield the hypotheses in the other ways that the plan declares."""
    yield "The same hypotheses, analysed in the other ways that the plan declares."
    for each in report.sensitivity:
        yield _sensitivity_table(report, each)


def _sensitivity_table(report: Report, result: SensitivityResult) -> ReportTable:
    row = next(row for row in report.plan.sensitivity if row.name == result.name)
    rows = tuple(
        (
            each.id,
            f"{each.n[0]} + {each.n[1]}",
            f"{each.excluded[0]} + {each.excluded[1]}",
            statistic_of(each.line),
            p_value(each.p),
            p_value(each.corrected),
            f"{number(each.hedges_g.estimate)} {interval(each.hedges_g.low, each.hedges_g.high)}",
            each.verdict,
        )
        for each in result.results
    )
    side = "one-sided" if row.one_sided else "two-sided"
    head = ("hypothesis", "n", "left out", "test", "p", "p, corrected", "g [95 %]", "verdict")
    caption = f"{result.name}: {row.test}, {side}, exclusions {row.exclusions}, correction {row.correction}."
    note = (
        "Leaving out values beyond 2 SD takes away the very people whom a condition fails."
        if "2sd" in row.exclusions
        else ""
    )
    name = "".join(letter if letter.isalnum() else "-" for letter in result.name.lower())
    return ReportTable(f"sensitivity-{name}", caption, head, rows, note)
