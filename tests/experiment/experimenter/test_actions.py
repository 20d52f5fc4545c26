"""The one table of what the experimenter may do: it is whole, it keeps its promises, and the manual shows it."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk.config import KNOWN_CONDITIONS, Keys
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import (
    AbortRequested,
    NextParticipantRequested,
    PauseRequested,
    RepeatRequested,
    WorldEvent,
)
from kiosk.experiment.experimenter import (
    TABLE,
    Action,
    ActionEffect,
    Authorisation,
    actions_markdown,
    condition_cycle,
    permission,
)
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.transitions import TABLE as STAGES

MANUAL = Path(__file__).parents[3] / "docs" / "how-to" / "experimenter.md"

CHANGES_THE_STUDY = (Action.CONDITION, Action.EMBODIMENT, Action.LANGUAGE)


def test_every_action_has_a_rule_in_every_stage() -> None:
    assert set(TABLE) == set(Action)
    assert all(set(stages) == set(Stage) for stages in TABLE.values())


@pytest.mark.parametrize("stage", Stage)
def test_nobody_leaves_or_sees_the_panel_without_the_pin(stage: Stage) -> None:
    assert Authorisation.NOTHING not in {permission(Action.PANEL, stage).asks, permission(Action.QUIT, stage).asks}


def test_every_key_of_the_study_file_is_a_action() -> None:
    assert set(Keys.model_fields) <= {action.value for action in Action}


@pytest.mark.parametrize("stage", Stage)
@pytest.mark.parametrize("action", CHANGES_THE_STUDY)
def test_what_changes_a_running_study_asks_for_the_pin_and_a_reason(action: Action, stage: Stage) -> None:
    assert permission(action, stage).asks is Authorisation.PIN_AND_REASON


@pytest.mark.parametrize("stage", [stage for stage in Stage if stage not in (Stage.ATTRACT, Stage.OVER)])
@pytest.mark.parametrize("action", CHANGES_THE_STUDY)
def test_a_session_that_is_under_way_keeps_its_condition_its_body_and_its_language(
    action: Action, stage: Stage
) -> None:
    assert permission(action, stage).effect is ActionEffect.NEXT_SESSION


@pytest.mark.parametrize("stage", Stage)
def test_a_visitor_who_is_sent_away_is_sent_away_with_a_reason(stage: Stage) -> None:
    for action in (Action.ABORT, Action.QUIT):
        held = permission(action, stage)
        under_way = stage not in (Stage.ATTRACT, Stage.OVER)
        assert (held.asks is Authorisation.PIN_AND_REASON) is under_way


@pytest.mark.parametrize(
    ("action", "event"),
    [(Action.REPEAT, RepeatRequested), (Action.PAUSE, PauseRequested), (Action.ABORT, AbortRequested)],
)
def test_what_is_done_at_once_is_what_the_session_has_a_place_for(action: Action, event: type[WorldEvent]) -> None:
    for stage in Stage:
        assert permission(action, stage).effect is ActionEffect.REFUSED or event in STAGES[stage]


def test_thanks_are_the_one_stage_that_the_next_visitor_need_not_wait_for() -> None:
    assert [stage for stage in Stage if NextParticipantRequested in STAGES[stage]] == [Stage.THANKS]
    assert permission(Action.NEXT, Stage.THANKS).asks is Authorisation.NOTHING


def test_the_conditions_come_in_turn_the_lists_first_then_those_with_a_quota_then_the_others() -> None:
    turn = condition_cycle(["notom", "random_explained"], [*KNOWN_CONDITIONS, "remind"])
    assert turn[:3] == (None, Condition.NOTOM, Condition.RANDOM_EXPLAINED)
    assert sorted(condition.name for condition in turn if condition) == sorted([*KNOWN_CONDITIONS, "remind"])


def test_the_manual_shows_the_table_as_it_is() -> None:
    manual = MANUAL.read_text("utf-8")
    shown = manual.partition("<!-- actions -->\n")[2].partition("<!-- /actions -->")[0]
    assert shown == actions_markdown()
