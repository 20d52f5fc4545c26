"""A later visit asks less, and asks again whether visits may be linked."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

import pytest
from pydantic import ValidationError

from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.condition import Condition, condition_of_return
from kiosk.experiment.information import RETURNING, Purpose
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.questionnaire import Questionnaire
from kiosk.experiment.session import Session
from tests.samples import likert, questionnaire, whole

TOM, NOTOM, ALONE = Condition.TOM, Condition.NOTOM, Condition.NO_ASSISTANCE


@pytest.mark.parametrize(
    ("rule", "before", "expected"),
    [
        ("same", (TOM,), TOM),
        ("same", (TOM, NOTOM), TOM),
        ("next", (TOM,), NOTOM),
        ("next", (TOM, NOTOM), ALONE),
        ("next", (ALONE,), TOM),
        ("new", (TOM,), None),
        ("same", (), None),
    ],
)
def test_a_study_says_which_condition_a_participant_comes_back_to(
    rule: Literal["same", "next", "new"], before: tuple[Condition, ...], expected: Condition | None
) -> None:
    assert condition_of_return(rule, before, [ALONE, NOTOM, TOM]) == expected


def asked(*items: dict[str, Any], **more: Any) -> Questionnaire:
    """Return a questionnaire of items, each with its own keys."""
    return questionnaire("form", *(likert(f"item{at}", **item) for at, item in enumerate(items, 1)), **more)


def test_what_is_asked_once_is_not_asked_at_a_later_visit() -> None:
    form = asked({"visits": "first"}, {})
    assert form.at_visit(1) is form
    later = form.at_visit(2)
    assert later is not None
    assert [item.id for item in later.items] == ["item2"]
    assert asked({}, {}, visits="first").at_visit(3) is None
    assert asked({"visits": "first"}).at_visit(2) is None


def test_a_form_without_the_key_has_the_hash_that_it_had() -> None:
    assert "visits" not in asked({}, {}).model_dump_json()


def test_an_item_of_every_visit_cannot_depend_on_one_of_the_first() -> None:
    with pytest.raises(ValidationError, match="'item1' is asked at the first visit only, so this one must be as well"):
        asked({"visits": "first"}, {"relevant": "item1 > 2"})
    asked({"visits": "first"}, {"relevant": "item1 > 2", "visits": "first"})


def test_a_stage_in_which_nothing_is_asked_is_left_out() -> None:
    later = replace(whole(), about_you=asked({}, visits="first"), visit=2)
    assert Stage.ABOUT_YOU in replace(later, visit=1).stage_order.stages
    assert Stage.ABOUT_YOU not in later.stage_order.stages
    assert Stage.QUESTIONS in later.stage_order.stages


@pytest.mark.parametrize(("visit", "needed"), [(1, False), (2, True)])
def test_linking_is_free_at_first_and_needed_by_who_came_back(visit: int, *, needed: bool) -> None:
    plan = whole()
    link = Purpose(id=RETURNING, text="My visits may be linked.", required=False)
    page = plan.information.consent
    page = page.model_copy(update={"purposes": (*page.purposes, link)})
    sheet = plan.information.model_copy(update={"consent": page})
    session = Session(replace(plan, information=sheet, visit=visit), 1)
    session.handle(happened.SessionStarted(at_ms=0))
    while session.stage is not Stage.CONSENT:
        event: happened.WorldEvent = happened.ContinuePressed(at_ms=0)
        if session.stage is Stage.AGE:
            event = happened.AgeConfirmed(at_ms=0, adult=True)
        session.handle(event)
    for purpose in sheet.consent.required:
        session.handle(happened.ConsentPurposeToggled(at_ms=1, purpose=purpose, ticked=True))
    outcome = session.handle(happened.ConsentSubmitted(at_ms=2))
    assert (do.ShowValidationErrors((RETURNING,)) in outcome.effects) is needed
    if needed:
        session.handle(happened.ConsentPurposeToggled(at_ms=3, purpose=RETURNING, ticked=True))
        outcome = session.handle(happened.ConsentSubmitted(at_ms=4))
        given = next(event for event in outcome.events if isinstance(event, happened.ConsentGiven))
        assert (RETURNING in given.purposes, given.sha256) == (True, sheet.sha256)
