"""What answers come to on a scale, against numbers worked out by hand."""

from __future__ import annotations

from collections.abc import Mapping
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.experiment import events as happened
from kiosk.experiment.events import Event
from kiosk.experiment.item_responses import ItemResponse
from kiosk.experiment.items import NOT_APPLICABLE, Integer, Response, Slider, TextPage
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.projections import ScaleScore, item_responses, scale_scores
from kiosk.experiment.session_state import SessionState
from tests.samples import likert, questionnaire

REVERSED = {"SOC3", "AC2"}
SCALES = ("SOC", "AC", "PC", "RC")
SOCIAL = questionnaire(
    "social",
    *(
        likert(f"{scale}{number}", scale=scale, reverse=f"{scale}{number}" in REVERSED)
        for scale in SCALES
        for number in (1, 2, 3, 4)
    ),
)
"""The study's four scales: four items each, on 1 to 5, two of the items reversed."""

NAMES = tuple(item.id for item in SOCIAL.items)

Given = dict[str, int | None]


def scored(given_ones: Mapping[str, Response | None], items: tuple[str, ...] = NAMES) -> dict[str, ScaleScore]:
    """Return the scales of these answers, by name."""
    told = [ItemResponse("social", item, given_ones.get(item)) for item in items]
    return {score.scale: score for score in scale_scores(told, [SOCIAL])}


def test_the_scales_come_in_the_declared_order() -> None:
    assert tuple(score.scale for score in scale_scores([], [SOCIAL])) == SCALES


def test_a_scale_is_summed_with_its_reversed_item_turned_round() -> None:
    soc = scored({"SOC1": 4, "SOC2": 5, "SOC3": 2, "SOC4": 3})["SOC"]  # 4 + 5 + (6 - 2) + 3
    assert soc == ScaleScore("social", "SOC", items=4, answered=4, not_applicable=0, needed=2, total=16, mean=4.0)
    ac = scored({"AC1": 1, "AC2": 5, "AC3": 2, "AC4": 2})["AC"]  # 1 + (6 - 5) + 2 + 2
    assert ac == ScaleScore("social", "AC", items=4, answered=4, not_applicable=0, needed=2, total=6, mean=1.5)
    pc = scored({"PC1": 1, "PC2": 5, "PC3": 2, "PC4": 2})["PC"]  # none reversed
    assert pc == ScaleScore("social", "PC", items=4, answered=4, not_applicable=0, needed=2, total=10, mean=2.5)


@pytest.mark.parametrize(("answer", "counts"), [(1, 5), (2, 4), (3, 3), (4, 2), (5, 1)])
def test_a_reversed_answer_counts_as_six_less_it(answer: int, counts: int) -> None:
    assert scored({"SOC3": answer, "SOC1": answer})["SOC"].mean == (counts + answer) / 2
    assert scored({"AC2": answer, "AC1": answer})["AC"].mean == (counts + answer) / 2
    assert scored({"SOC2": answer, "SOC1": answer})["SOC"].mean == answer


def test_with_an_answer_missing_there_is_a_mean_and_no_sum() -> None:
    soc = scored({"SOC1": 4, "SOC3": 1})["SOC"]  # (4 + (6 - 1)) / 2
    assert soc == ScaleScore("social", "SOC", items=4, answered=2, not_applicable=0, needed=2, total=None, mean=4.5)


def test_without_any_answer_there_is_neither() -> None:
    assert scored({})["RC"] == ScaleScore(
        "social", "RC", items=4, answered=0, not_applicable=0, needed=2, total=None, mean=None
    )


def test_an_item_that_does_not_apply_is_in_no_sum_and_no_mean_and_is_counted() -> None:
    soc = scored({"SOC1": 4, "SOC2": NOT_APPLICABLE, "SOC3": NOT_APPLICABLE, "SOC4": 3})["SOC"]
    assert soc == ScaleScore("social", "SOC", 4, 2, not_applicable=2, needed=2, total=None, mean=3.5)


@pytest.mark.parametrize(("share", "needed"), [(0, 1), (0.5, 2), (0.51, 3), (0.75, 3), (1, 4)])
def test_a_questionnaire_says_how_many_items_a_mean_needs(share: float, needed: int) -> None:
    asked = questionnaire("asked", *(likert(name, scale="S") for name in "abcd"), least_answered=share)
    for answered in range(5):
        told = [ItemResponse("asked", name, 3) for name in "abcd"[:answered]]
        (score,) = scale_scores(told, [asked])
        assert (score.needed, score.mean is None) == (needed, answered < needed)


def test_other_ends_turn_round_about_their_own_middle() -> None:
    words = {"en": "word"}
    sliders = questionnaire(
        "sliders",
        *(
            Slider(id=name, kind="slider", text=words, left=words, right=words, scale="S", reverse=name == "b")
            for name in ("a", "b")
        ),
    )
    told = [ItemResponse("sliders", "a", 30), ItemResponse("sliders", "b", 30)]
    assert scale_scores(told, [sliders]) == (ScaleScore("sliders", "S", 2, 2, 0, 1, total=100, mean=50.0),)


def test_what_belongs_to_no_scale_does_not_matter() -> None:
    words = {"en": "word"}
    mixed = questionnaire(
        "mixed",
        likert("a", scale="S"),
        likert("b"),
        Integer(id="age", kind="integer", text=words),
        TextPage(id="p", kind="page", text=words),
    )
    told = [ItemResponse("mixed", "a", 2), ItemResponse("mixed", "b", 5), ItemResponse("mixed", "age", 30)]
    assert scale_scores(told, [mixed]) == (ScaleScore("mixed", "S", 1, 1, 0, 1, 2, 2.0),)


def test_the_same_item_of_another_questionnaire_is_not_counted() -> None:
    twin = questionnaire("twin", likert("a", scale="S"))
    other = questionnaire("other", likert("a", scale="S"))
    told = [ItemResponse("twin", "a", 1), ItemResponse("other", "a", 5)]
    assert [score.total for score in scale_scores(told, [twin, other])] == [1, 5]


@given(st.dictionaries(st.sampled_from(NAMES), st.none() | st.integers(1, 5)))
def test_sums_and_means_keep_to_their_ends_and_agree(given_ones: Given) -> None:
    for scale, score in scored(given_ones).items():
        there = [item for item in given_ones if item.startswith(scale) and given_ones[item] is not None]
        assert (score.items, score.answered) == (4, len(there))
        assert (score.total is None) is (len(there) < 4)
        assert (score.mean is None) is (len(there) < 2)
        assert score.mean is None or 1 <= score.mean <= 5
        assert score.total is None or (4 <= score.total <= 20 and score.total == 4 * (score.mean or 0))


@given(st.fixed_dictionaries(dict.fromkeys(NAMES, st.integers(1, 5))))
def test_turning_every_answer_round_turns_every_sum_round(given_ones: Given) -> None:
    turned: Given = {item: 6 - value for item, value in given_ones.items() if value is not None}
    for scale, score in scored(given_ones).items():
        assert score.total is not None
        assert scored(turned)[scale].total == 24 - score.total


@given(st.fixed_dictionaries(dict.fromkeys(NAMES, st.integers(1, 5))), st.randoms())
def test_the_order_in_which_items_were_asked_does_not_matter(given_ones: Given, chance: Random) -> None:
    names = list(NAMES)
    chance.shuffle(names)
    assert scored(given_ones, tuple(names)) == scored(given_ones)


def test_events_lead_to_scores() -> None:
    events: list[Event] = [happened.StageEntered(at_ms=0, stage=Stage.QUESTIONS)]
    for number, (item, value) in enumerate({"SOC1": 4, "SOC2": 5, "SOC3": 2, "SOC4": 3}.items()):
        events.append(happened.QuestionnairePageShown(at_ms=number, questionnaire="social", items=(item,)))
        events.append(happened.ResponseGiven(at_ms=number, item=item, value=value))
    assert scale_scores(item_responses(SessionState.from_events(events), [SOCIAL]), [SOCIAL])[0].total == 16
