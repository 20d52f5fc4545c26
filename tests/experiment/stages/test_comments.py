"""The helper comments on moves where a condition says so, and the layers decide as they would without."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from kiosk.assistance.claims import CLAIM_PHRASES, false_comments
from kiosk.assistance.comments import COMMENTS
from kiosk.assistance.policy import ENCOURAGEMENT, PRAISE, ActionSpec, Gate, check_actions
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition
from kiosk.experiment.events import RemarkTrigger
from kiosk.experiment.projections import measure
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.store.queries import DecisionExplainer, open_repository
from tests.experiment.driver import Driver, forgetful, replay
from tests.export.conftest import rows_of
from tests.export.visitors import store
from tests.samples import CATALOGUES, ENGLISH, mixed, plan

SEED = 5
OWN = Condition("own")


@cache
def played(declared: str, **settings: Any) -> Driver:
    """Return a game played to its end in a condition that is declared so, in JSON; tests only read it."""
    chosen = plan(OWN, mixed(SEED, Gate()), conditions={"own": json.loads(declared)}, **settings)
    driver = Driver(chosen, SEED)
    driver.to_the_game()
    driver.play(forgetful(SEED))
    return driver


ALWAYS = '{"praise": 1, "encourage": 1}'
SOMETIMES = '{"praise": 0.5, "encourage": 0.3}'
ALONE = '{"target_rule": "none", "praise": 1}'


def test_every_move_whose_next_card_gets_no_help_has_its_comment() -> None:
    driver = played(ALWAYS)
    matched = {flip.number: flip.matched for flip in driver.noted(happened.CardFlipped)}
    unhelped = [
        then.flip
        for then in driver.noted(happened.AssistanceDecided)
        if then.action is ActionSpec.NO_HELP and then.flip > 1 and then.flip % 2
    ]
    remarks = {each.flip: each for each in driver.noted(happened.RemarkGiven)}
    assert list(remarks) == unhelped
    for flip, remark in remarks.items():
        assert remark.action is (PRAISE if matched[flip - 1] else ENCOURAGEMENT)
        assert (remark.trigger, remark.probability) == (RemarkTrigger.COMMENT, 1)
        assert remark.sentence in ENGLISH.wordings(remark.action.message)


@pytest.mark.parametrize("declared", [ALWAYS, SOMETIMES])
def test_the_layers_decide_and_point_as_they_would_without_a_comment(declared: str) -> None:
    silent, talking = played("{}"), played(declared)
    for kind in (happened.AssistanceDecided, happened.HintGiven, happened.CardFlipped):
        without, beside = (
            [{**vars(each), "at_ms": 0, "utterance": 0} for each in driver.noted(kind)] for driver in (silent, talking)
        )
        assert without == beside
    remarks, hints = talking.noted(happened.RemarkGiven), talking.noted(happened.HintGiven)
    assert not {each.flip for each in remarks} & {each.flip for each in hints}
    assert measure(talking.events).assistance_per_flip == measure(silent.events).assistance_per_flip


def test_where_nobody_helps_comments_may_still_come() -> None:
    driver = played(ALONE)
    assert {each.action for each in driver.noted(happened.RemarkGiven)} == {PRAISE}
    # The last pair ends the game.
    assert len(driver.noted(happened.RemarkGiven)) == measure(driver.events).pairs - 1


@pytest.mark.parametrize("declared", [SOMETIMES, ALONE])
def test_comments_come_out_again_in_a_replay_an_explanation_and_the_data_set(tmp_path: Path, declared: str) -> None:
    driver = played(declared)
    assert replay(driver.plan, SEED, driver.world) == [step.outcome for step in driver.steps]
    remarks = {each.flip: each for each in driver.noted(happened.RemarkGiven)}
    store(tmp_path / "data", [(driver, SEED)])
    with open_repository(tmp_path / "data") as sessions:
        explainer = DecisionExplainer(sessions, 1)
        told = {each: explainer.explain(each).to_json() for each in explainer.flips}
    assert {flip for flip, each in told.items() if "comment" in each} == set(remarks)
    for flip, remark in remarks.items():
        assert told[flip]["comment"] == {"action": remark.action.label, "probability": remark.probability}
        assert (told[flip]["action"], told[flip]["said"]) == ("no_help", remark.sentence)
    export_dataset(tmp_path / "data", tmp_path / "out", PsychDs)
    rows = {int(row["flip"]): (row["remark"], row["remark_trigger"]) for row in rows_of(tmp_path / "out", "remarks")}
    assert rows == {flip: (remark.action.label, "comment") for flip, remark in remarks.items()}


@pytest.mark.parametrize("language", list(CLAIM_PHRASES))
@pytest.mark.parametrize("comment", COMMENTS, ids=lambda each: each.label)
def test_a_comment_claims_no_more_than_how_the_move_ended(comment: ActionSpec, language: str) -> None:
    said = CATALOGUES[language].wordings(comment.message)
    assert len(said) >= 3
    assert not [fault for each in said for fault in false_comments(each, language, matched=comment is PRAISE)]


@pytest.mark.parametrize(
    ("sentence", "matched"),
    [("A pair!", False), ("No pair.", True), ("You have seen it once.", True), ("Try row 3.", False)],
)
def test_a_comment_that_claims_more_is_found_out(sentence: str, *, matched: bool) -> None:
    assert list(false_comments(sentence, "en", matched=matched))


def test_a_table_may_encourage_but_not_praise() -> None:
    assert check_actions([ActionSpec.NO_HELP, ENCOURAGEMENT])
    with pytest.raises(ValueError, match="'praise' comes after a pair was found"):
        check_actions([ActionSpec.NO_HELP, PRAISE])
