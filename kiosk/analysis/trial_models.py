"""Logistic models of single hints and moves, with a random intercept for each person."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from kiosk.analysis.data import Floats
from kiosk.analysis.models import MixedModel, collapse, mixed_logistic
from kiosk.analysis.sample import Sample
from kiosk.analysis.statistics import NotEstimableError
from kiosk.experiment.condition import Condition
from kiosk.experiment.outcomes import Stage

CELLS = {
    Condition.TOM.name: (1, 1),
    Condition.NOTOM.name: (0, 0),
    Condition.MENTALISED_UNEXPLAINED.name: (1, 0),
    Condition.RANDOM_EXPLAINED.name: (0, 1),
}
"""The 2 x 2 design: whether the target is mentalised, and whether a reason is given."""
FACTORS = ("mentalised target", "reason given")


@dataclass(frozen=True)
class ModelResult:
    """A logistic model with a random intercept per person, or the reason why there is none."""

    name: str
    about: str
    model: MixedModel | None
    note: str = ""


@dataclass(frozen=True)
class _Trials:
    """Single hints or moves of the people: whether each was a hit, whose, and covariates."""

    hit: Floats
    person: Floats
    more: tuple[Floats, ...] = ()


def fit_models(sample: Sample, pair: tuple[str, str]) -> Iterator[ModelResult]:
    """Fit the models for a pair of conditions, and for the 2 x 2 design where it is there."""
    followed, led, matched = _hints(sample, first_only=False), _hints(sample, first_only=True), _second_cards(sample)
    about = {
        "followed": ("the flip after a hint is the hinted card, or in its row or column", followed),
        "led to match": ("a hint for a first card was followed and its move matched", led),
    }
    conditions = sample.people.text("condition")
    in_pair = np.array([{pair[0]: 1.0, pair[1]: 0.0}.get(name, np.nan) for name in conditions])
    for name, (what, trials) in about.items():
        yield _fitted(name, what, trials, [("constant", None), (f"{pair[0]} less {pair[1]}", in_pair)])
        if set(CELLS) <= set(sample.conditions):
            cells = np.array([CELLS.get(each, (np.nan, np.nan)) for each in conditions])
            one, two = cells[:, 0] - 0.5, cells[:, 1] - 0.5
            terms = [("constant", None), (FACTORS[0], one), (FACTORS[1], two), (" x ".join(FACTORS), one * two)]
            yield _fitted(f"{name}, 2 x 2", f"{what}; factors are coded -1/2 and 1/2", trials, terms)
    yield _fitted(
        "second card matches",
        "a second card completes the pair; middle and end of the game are compared with its beginning",
        matched,
        [("constant", None), (f"{pair[0]} less {pair[1]}", in_pair), ("hinted", 0), ("middle", 1), ("end", 2)],
    )


def _fitted(name: str, about: str, trials: _Trials, terms: Sequence[tuple[str, Floats | int | None]]) -> ModelResult:
    """Fit a model.

    A term is a value for each person, the number of a covariate of the trials, or the constant.
    """
    person = trials.person.astype(np.int64)
    columns = [
        np.ones(len(person)) if term is None else trials.more[term] if isinstance(term, int) else term[person]
        for _, term in terms
    ]
    design = np.column_stack(columns) if len(person) else np.empty((0, len(terms)))
    known = ~np.isnan(design).any(axis=1) & ~np.isnan(trials.hit)
    try:
        data = collapse(trials.hit[known], design[known], person[known])
        return ModelResult(name, about, mixed_logistic(data, [term for term, _ in terms]))
    except NotEstimableError as reason:
        return ModelResult(name, about, None, str(reason))


def _owners(sample: Sample, table: str) -> Floats:
    """Return the row of each trial's person among those who are analysed, NaN for others."""
    place = {name: float(row) for row, name in enumerate(sample.people.text("participant_id"))}
    return np.array([place.get(who, np.nan) for who in sample.study.tables[table].text("participant_id")])


def _hints(sample: Sample, *, first_only: bool) -> _Trials:
    hints = sample.study.tables["hints"]
    owner, followed = _owners(sample, "hints"), hints.numbers("followed")
    rows = ~np.isnan(owner) & ~np.isnan(followed)
    hit = followed
    if first_only:
        rows &= np.array([card == "first" for card in hints.text("move_card")], dtype=np.bool_)
        hit = followed * (hints.numbers("move_matched") == 1)
    return _Trials(hit[rows], owner[rows])


def _second_cards(sample: Sample) -> _Trials:
    """Return second cards of the game: matched or not, hinted or not, and their phase.

    The phase goes by the pairs that were found before.
    """
    flips = sample.study.tables["flips"]
    owner = _owners(sample, "flips")
    rows = ~np.isnan(owner)
    rows &= np.array([stage == Stage.GAME.value for stage in flips.text("stage")], dtype=np.bool_)
    rows &= np.array([card == "second" for card in flips.text("move_card")], dtype=np.bool_)
    hit = flips.numbers("matched")[rows]
    people = owner[rows]
    # Rows of a person stand together, in the order in which they happened.
    hits = np.nan_to_num(hit)
    before = np.cumsum(hits) - hits
    if len(people):
        starts = np.flatnonzero(np.r_[True, people[1:] != people[:-1]])
        before -= np.repeat(before[starts], np.diff(np.r_[starts, len(people)]))
    hinted = flips.truths("hinted")[rows].astype(np.float64)
    phase = before // 4
    return _Trials(hit, people, (hinted, (phase == 1).astype(np.float64), (phase >= 2).astype(np.float64)))  # noqa: PLR2004
