"""The one table of what the experimenter may do: it is whole, it keeps its promises, and the manual shows it."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk.settings import Keys
from kiosk.study.booth.deeds import TABLE, Asks, Deed, Effect, in_turn, rule, table_markdown
from kiosk.study.condition import Condition
from kiosk.study.events import EndAsked, NextAsked, PauseAsked, RepeatAsked, Stage, WorldEvent
from kiosk.study.stages import TABLE as STAGES

MANUAL = Path(__file__).parents[3] / "docs" / "experimenter.md"

CHANGES_THE_STUDY = (Deed.CONDITION, Deed.BODY, Deed.LANGUAGE)


def test_every_deed_has_a_rule_in_every_stage() -> None:
    assert set(TABLE) == set(Deed)
    assert all(set(stages) == set(Stage) for stages in TABLE.values())


@pytest.mark.parametrize("stage", Stage)
def test_nobody_leaves_or_sees_the_panel_without_the_pin(stage: Stage) -> None:
    assert Asks.NOTHING not in {rule(Deed.PANEL, stage).asks, rule(Deed.LEAVE, stage).asks}


def test_every_key_of_the_study_file_is_a_deed() -> None:
    assert set(Keys.model_fields) <= {deed.value for deed in Deed}


@pytest.mark.parametrize("stage", Stage)
@pytest.mark.parametrize("deed", CHANGES_THE_STUDY)
def test_what_changes_a_running_study_asks_for_the_pin_and_a_reason(deed: Deed, stage: Stage) -> None:
    assert rule(deed, stage).asks is Asks.PIN_AND_REASON


@pytest.mark.parametrize("stage", [stage for stage in Stage if stage not in (Stage.ATTRACT, Stage.OVER)])
@pytest.mark.parametrize("deed", CHANGES_THE_STUDY)
def test_a_sitting_that_is_under_way_keeps_its_condition_its_body_and_its_language(deed: Deed, stage: Stage) -> None:
    assert rule(deed, stage).effect is Effect.NEXT_SITTING


@pytest.mark.parametrize("stage", Stage)
def test_a_visitor_who_is_sent_away_is_sent_away_with_a_reason(stage: Stage) -> None:
    for deed in (Deed.END, Deed.LEAVE):
        held = rule(deed, stage)
        under_way = stage not in (Stage.ATTRACT, Stage.OVER)
        assert (held.asks is Asks.PIN_AND_REASON) is under_way


@pytest.mark.parametrize(
    ("deed", "event"),
    [(Deed.AGAIN, RepeatAsked), (Deed.PAUSE, PauseAsked), (Deed.END, EndAsked)],
)
def test_what_is_done_at_once_is_what_the_sitting_has_a_place_for(deed: Deed, event: type[WorldEvent]) -> None:
    for stage in Stage:
        assert rule(deed, stage).effect is Effect.REFUSED or event in STAGES[stage]


def test_thanks_are_the_one_stage_that_the_next_visitor_need_not_wait_for() -> None:
    assert [stage for stage in Stage if NextAsked in STAGES[stage]] == [Stage.THANKS]
    assert rule(Deed.NEXT, Stage.THANKS).asks is Asks.NOTHING


def test_the_conditions_come_in_turn_the_lists_first_then_those_with_a_quota_then_the_others() -> None:
    turn = in_turn(["notom", "random_explained"])
    assert turn[:3] == (None, Condition.NOTOM, Condition.RANDOM_EXPLAINED)
    assert sorted(condition.value for condition in turn if condition) == sorted(each.value for each in Condition)


def test_the_manual_shows_the_table_as_it_is() -> None:
    manual = MANUAL.read_text("utf-8")
    shown = manual.partition("<!-- deeds -->\n")[2].partition("<!-- /deeds -->")[0]
    assert shown == table_markdown()
