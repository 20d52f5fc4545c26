"""Who of a data set is analysed: exclusion rules, the size of each arm, and everyone's measures."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from kiosk import UserInputError, why
from kiosk.analysis.data import (
    ExportedStudy,
    ExportTable,
    Floats,
    ScaleItems,
    Truths,
    in_order,
    scale_items,
    scale_names,
)
from kiosk.analysis.plan import SCALES, StudyPlan
from kiosk.analysis.statistics import LEAST
from kiosk.experiment.outcomes import AllocationSource

NOT_DRAWN = {
    AllocationSource.OVERRIDE.value: "the experimenter chose the condition",
    AllocationSource.BEYOND.value: "the list of places was used up",
}
NOT_COMPLETED = "the game was not completed"
NO_HINT = "left before the first hint"


@dataclass(frozen=True)
class Measure:
    """A number for each participant; ``scale`` turns it into the unit in which it is shown."""

    name: str
    label: str
    unit: str = ""
    scale: float = 1.0
    digits: int = 2

    @property
    def title(self) -> str:
        """The label with its unit."""
        return f"{self.label} ({self.unit})" if self.unit else self.label


MEASURES = (
    Measure("flips", "Flips", digits=1),
    Measure("completion_ms", "Time without speech", "s", 0.001, 1),
    Measure("completion_with_speech_ms", "Time with speech", "s", 0.001, 1),
    Measure("per_match_ms", "Time per match", "s", 0.001, 2),
    Measure("hints", "Hints", digits=1),
    Measure("assistance_per_flip", "Assistance per flip", digits=3),
    Measure("followed_rate", "Hints followed", digits=2),
    Measure("first_followed_rate", "First-card hints followed", digits=2),
    Measure("first_led_to_match_rate", "First-card hints that matched", digits=2),
)
"""The measures of the game; each scale of the questionnaires adds its sum."""


@dataclass(frozen=True)
class ExclusionStep:
    """A rule, and how many people of each condition it left out."""

    rule: str
    counts: Mapping[str, int]


@dataclass(frozen=True)
class Sample:
    """The people who are analysed, and how they were chosen."""

    study: ExportedStudy
    conditions: tuple[str, ...]
    exported: ExportTable
    drawn: ExportTable
    people: ExportTable
    steps: tuple[ExclusionStep, ...]
    simulated: bool
    later: int = 0
    """Sessions of people who had been there before, which are not analysed."""

    def rows(self, condition: str) -> Truths:
        """Which of the people are in a condition."""
        return np.array([name == condition for name in self.people.text("condition")], dtype=np.bool_)

    def values(self, measure: str, condition: str) -> Floats:
        """Return the known values of a measure in a condition; none of a measure that this study does not have."""
        if measure not in self.measured:
            return np.empty(0)
        found = self.measured[measure][self.rows(condition)]
        return found[~np.isnan(found)]

    @cached_property
    def measures(self) -> tuple[Measure, ...]:
        """The measures that at least one person has a value of."""
        return tuple(each for each in self._all if not np.isnan(self.measured[each.name]).all())

    @cached_property
    def _all(self) -> tuple[Measure, ...]:
        scales = [name.removesuffix("_sum") for name in self.measured if name.endswith("_sum")]
        labels = {name: f"{name}, {SCALES[name]}" if name in SCALES else name for name in scales}
        own = (Measure(f"{name}_sum", label, digits=1) for name, label in labels.items())
        return (*MEASURES, *own)

    @cached_property
    def measured(self) -> Mapping[str, Floats]:
        """The values of every measure, a number for each of the people, NaN where there is none."""
        return measure_people(self.study, self.people)

    @cached_property
    def scales(self) -> tuple[ScaleItems, ...]:
        """The answers of the people to the items of each scale."""
        return scale_items(self.study, self.people.text("participant_id"))


def measure_people(study: ExportedStudy, people: ExportTable) -> dict[str, Floats]:
    """Return the measures of some participants: those of the game, and the sum of each scale."""
    measured = {each.name: people.numbers(each.name) for each in MEASURES}
    place = {name: row for row, name in enumerate(people.text("participant_id"))}
    scores = study.tables["scores"]
    names = scale_names(scores)
    sums = scores.numbers("sum")
    for at, who in enumerate(scores.text("participant_id")):
        name = f"{names[scores.text('questionnaire')[at], scores.text('scale')[at]]}_sum"
        column = measured.setdefault(name, np.full(len(people), np.nan))
        if who in place:
            column[place[who]] = sums[at]
    return measured


def choose_sample(study: ExportedStudy, plan: StudyPlan, declared: Mapping[str, str] | None = None) -> Sample:
    """Apply the plan's population and the declared exclusions, which map participants to reasons.

    Raises UserInputError for an unknown participant, a single condition, and fewer than three people in one.
    """
    declared = declared or {}
    unknown = sorted(declared.keys() - set(study.participants.text("participant_id")))
    if unknown:
        raise UserInputError(f"{study.folder} has no participant {unknown[0]}, who is among the exclusions")
    everyone, simulated = _real(study.participants)
    exported = everyone.where(~(everyone.numbers("visit") > 1))
    steps: list[ExclusionStep] = []
    drawn = exported
    for source, reason in NOT_DRAWN.items():
        drawn = _leave_out(drawn, [each == source for each in drawn.text("allocation_source")], reason, steps)
    people = drawn
    for reason in dict.fromkeys(declared.values()):
        names = {name for name, why_out in declared.items() if why_out == reason}
        people = _leave_out(people, [who in names for who in people.text("participant_id")], reason, steps)
    if plan.population == "game-completed":
        people = _leave_out(people, list(~people.truths("game_completed")), NOT_COMPLETED, steps)
    else:
        people = _leave_out(people, [not hints > 0 for hints in people.numbers("hints")], NO_HINT, steps)
    _require_arms(study, people, plan.conditions)
    return Sample(
        study,
        in_order(people.text("condition")),
        exported,
        drawn,
        people,
        tuple(steps),
        simulated,
        len(everyone) - len(exported),
    )


def _real(participants: ExportTable) -> tuple[ExportTable, bool]:
    """Return the sessions of people, or all of them if a program played every one; and whether it did."""
    pretended = participants.truths("simulated") | participants.truths("trial")
    if pretended.all():
        return participants, bool(len(participants))
    return participants.where(~pretended), False


def _leave_out(people: ExportTable, out: Sequence[bool], rule: str, steps: list[ExclusionStep]) -> ExportTable:
    marked = np.array(out, dtype=np.bool_)
    if marked.any():
        steps.append(ExclusionStep(rule, dict(Counter(people.where(marked).text("condition")))))
    return people.where(~marked)


def _require_arms(study: ExportedStudy, people: ExportTable, conditions: Sequence[str]) -> None:
    found = Counter(people.text("condition"))
    if len(found) == 1:
        raise UserInputError(
            f"{study.folder} has people in one condition only ({next(iter(found))}); a report compares two"
        )
    for name in conditions:
        if found[name] < LEAST:
            raise UserInputError(
                f"{study.folder} has {found[name]} people to analyse in {name}; a report needs at least {LEAST} in "
                "each condition of the plan"
            )


def read_exclusions(path: Path) -> dict[str, str]:
    """Read declared exclusions: a CSV file with the columns participant_id and reason.

    Raises UserInputError for a file that cannot be read, lacks a column, or names a participant twice.
    """
    try:
        text = path.read_text("utf-8-sig")
    except OSError as error:
        raise UserInputError(f"{path} cannot be read: {why(error)}") from error
    except UnicodeDecodeError as error:
        raise UserInputError(f"{path} is not text in UTF-8: {error}") from error
    rows = csv.DictReader(io.StringIO(text, newline=""))
    if not {"participant_id", "reason"} <= set(rows.fieldnames or ()):
        raise UserInputError(f"{path} needs a first line with the columns participant_id and reason")
    found: dict[str, str] = {}
    for number, row in enumerate(rows, 2):
        who, reason = (row["participant_id"] or "").strip(), (row["reason"] or "").strip()
        if not who or not reason:
            raise UserInputError(f"{path}, row {number}: participant_id and reason must both be given")
        if who in found:
            raise UserInputError(f"{path}, row {number}: {who} is excluded twice")
        found[who] = reason
    return found
