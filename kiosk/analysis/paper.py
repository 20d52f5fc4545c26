"""The numbers of the paper, worked out again from the means and standard deviations that it prints.

The paper is Andriella, Falcone and Rossi, "Enhancing Robot Assistive Behaviour with Reinforcement Learning and Theory
of Mind" (arXiv 2411.07003), with 28 people in each of two independent groups.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from kiosk.analysis.page import ReportTable, Section, interval, number, p_value
from kiosk.analysis.statistics import holm, standardised, two_sided

N = 28
"""People in each group."""


@dataclass(frozen=True)
class PrintedResult:
    """Means and SDs of both groups as printed, the unit of their last digit, and what else the paper says."""

    measure: str
    means: tuple[float, float]
    sds: tuple[float, float]
    step: float
    printed: str = ""
    remark: str = ""


@dataclass(frozen=True)
class Recomputed:
    """A t test of two independent groups from means and SDs; ``low`` and ``high`` are the t that rounding allows."""

    measure: str
    t: float
    low: float
    high: float
    df: int
    p: float
    one_sided: float
    holm: float
    d: float
    d_low: float
    d_high: float


PRINTED = (
    PrintedResult("turns (flips)", (55, 58), (7, 7), 1),
    PrintedResult(
        "time", (159, 187), (29, 69), 1, remark="two-sided, p is .053; it is below .05 for a one-sided test only"
    ),
    PrintedResult("time per match", (13, 15), (2, 6), 1),
    PrintedResult(
        "assistance per flip",
        (0.27, 0.34),
        (0.07, 0.07),
        0.01,
        "t = 2.4",
        "means and SDs that round to the printed ones cannot give t = 2.4",
    ),
    PrintedResult("hints followed", (0.92, 0.86), (0.09, 0.10), 0.01),
    PrintedResult(
        "led to match",
        (0.30, 0.24),
        (0.15, 0.12),
        0.01,
        "p < .05",
        "one-sided, p is .052 from the printed numbers; what they were rounded from may lie below .05",
    ),
    PrintedResult("competence (AC)", (15, 13), (3, 3), 1),
    PrintedResult("social presence (PC)", (12, 11), (3, 3), 1),
    PrintedResult("reciprocity (RC)", (14, 12), (3, 4), 1),
    PrintedResult(
        "social intelligence (SOC)",
        (13.21, 12.14),
        (4.02, 3.33),
        0.01,
        "t = .93",
        "means and SDs that round to the printed ones cannot give t = .93 with two groups of 28",
    ),
)
"""The group with a Theory of Mind first."""


def recompute() -> tuple[Recomputed, ...]:
    """Test every measure again from what was printed, as two independent groups."""
    rows = []
    for each in PRINTED:
        t = _t(each.means[0] - each.means[1], each.sds)
        rows.append((each, t, two_sided(t, 2 * N - 2)))
    adjusted = holm([p for *_, p in rows])
    found = []
    for (each, t, p), q in zip(rows, adjusted, strict=True):
        low, high = _rounding(each)
        d = standardised(t * math.sqrt(2 / N), N, N)
        found.append(Recomputed(each.measure, t, low, high, 2 * N - 2, p, p / 2, q, d.value, d.low, d.high))
    return tuple(found)


def _t(difference: float, sds: tuple[float, float]) -> float:
    return difference / math.sqrt((sds[0] ** 2 + sds[1] ** 2) / N)


def _rounding(each: PrintedResult) -> tuple[float, float]:
    """Return the smallest and the largest t of means and SDs that round to the printed ones."""
    half = each.step / 2
    difference = each.means[0] - each.means[1]
    narrow, wide = ((each.sds[0] + side * half, each.sds[1] + side * half) for side in (-1, 1))
    ends = [_t(difference + side * each.step, sds) for side in (-1, 1) for sds in (narrow, wide)]
    return min(ends), max(ends)


def paper_json() -> list[dict[str, Any]]:
    """Return the same for programs, with what was printed."""
    return [
        asdict(found) | {"printed": each.printed, "remark": each.remark}
        for each, found in zip(PRINTED, recompute(), strict=True)
    ]


def paper_section() -> Section:
    """Return the section of a report about the paper."""
    assistance = PRINTED[3]
    spread = math.sqrt((assistance.sds[0] ** 2 + assistance.sds[1] ** 2) / N)
    rows = []
    for each, found in zip(PRINTED, recompute(), strict=True):
        scale = 0 if each.step == 1 else 2
        cells = [f"{number(m, scale)} ({number(sd, scale)})" for m, sd in zip(each.means, each.sds, strict=True)]
        statistics = [number(found.t), interval(found.low, found.high), p_value(found.p), p_value(found.holm)]
        effect = f"{number(found.d)} {interval(found.d_low, found.d_high)}"
        rows.append((each.measure, *cells, *statistics, effect, each.printed or "\N{EN DASH}"))
    head = ("measure", "ToM: M (SD)", "noToM: M (SD)", "t(54)", "t, by rounding", "p", "p, Holm", "d [95 %]", "printed")
    table = ReportTable(
        "paper-table",
        f"The paper's comparisons, recomputed from its means and SDs ({N} + {N} people, Student's t, two-sided).",
        head,
        tuple(rows),
        "t, by rounding: from the smallest to the largest t that means and SDs allow which round to the printed ones.",
    )
    remarks = [f"{each.measure}: {each.remark}." for each in PRINTED if each.remark]
    return Section(
        "paper",
        "The paper's numbers, recomputed",
        (
            "The paper prints means and standard deviations, which is enough to work its tests out again. Most "
            "numbers agree. Those that do not may come from the raw data, or from another test than the text says.",
            table,
            f"The arithmetic, for assistance: the difference of the means is {assistance.means[0]:.2f} "
            f"\N{MINUS SIGN} {assistance.means[1]:.2f} = {number(assistance.means[0] - assistance.means[1])}, its "
            f"standard error is the root of ({assistance.sds[0]:.2f}\N{SUPERSCRIPT TWO} + "
            f"{assistance.sds[1]:.2f}\N{SUPERSCRIPT TWO}) / {N}, that is {spread:.4f}, and t is their ratio.",
            f"Two independent groups of {N} have {2 * N - 2} degrees of freedom; 27 belongs to a paired test.",
            *remarks,
            "After Holm's correction over the ten measures, only assistance per flip stays below .05.",
        ),
    )
