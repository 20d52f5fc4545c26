"""The figures of the learning layer are drawn from the numbers, and the same numbers give the same file."""

from __future__ import annotations

from dataclasses import replace

import pytest

pytest.importorskip("matplotlib")

from kiosk.analysis.policy_figures import distributions, heat_map
from kiosk.assistance.policy import STATES, ActionSpec
from kiosk.cli.evidence import MoveSample
from tests.samples import always, policy_that


def test_the_heat_map_names_the_action_of_every_state() -> None:
    drawn = heat_map(always(ActionSpec.SUG_ROW), {}, "svg").decode()
    assert drawn.count(">row</text>") == 48


def test_states_that_were_never_met_carry_a_dot() -> None:
    drawn = heat_map(policy_that(lambda _: ActionSpec.SUG_COL), dict.fromkeys(STATES[:10], 1), "svg").decode()
    assert drawn.count(">column</text>") == 10
    assert drawn.count(">·</text>") == 38


def test_the_same_numbers_give_the_same_file() -> None:
    table = always(ActionSpec.SUG_CARD)
    assert heat_map(table, {}, "svg") == heat_map(table, {}, "svg")
    samples = [MoveSample(label, (20.0, 21.5, 23.0), (22.0, 1.0)) for label in ("one", "two", "three")]
    assert distributions(samples, "svg") == distributions(samples, "svg")
    assert distributions(samples, "png").startswith(b"\x89PNG")
    assert all(label in distributions(samples, "svg").decode() for label in ("one", "two", "three"))


def test_a_name_between_dollar_signs_is_no_formula() -> None:
    table = replace(always(ActionSpec.SUG_CARD), name="a_$x^2$")
    assert "a_$x^2$" in heat_map(table, {}, "svg").decode()
