"""Consent and age: nothing is ticked beforehand, and only what was ticked is agreed to."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.config import ConsentConfig
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.information import Purpose
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.transitions import InvalidTransition
from tests.experiment.driver import Driver, driven_to
from tests.samples import INFORMATION, whole

PURPOSES = tuple(purpose.id for purpose in INFORMATION.consent.purposes)
THREE = INFORMATION.model_copy(
    update={
        "consent": INFORMATION.consent.model_copy(
            update={
                "purposes": (
                    Purpose(id="take_part", text="take part"),
                    Purpose(id="share", text="share it", required=False),
                    Purpose(id="store", text="store it"),
                )
            }
        )
    }
)


def asked_for_more() -> Driver:
    """Return a session that asks for three purposes, of which two are required."""
    return driven_to(Stage.CONSENT, replace(whole(), information=THREE))


def test_what_the_study_is_about_comes_first() -> None:
    driver = driven_to(Stage.ABOUT)
    assert do.ShowAbout(INFORMATION.about) in driver.effects


def test_no_purpose_is_ticked_beforehand() -> None:
    driver = driven_to(Stage.CONSENT)
    assert driver.view.consent == do.ShowConsent(INFORMATION.consent)
    assert driver.view.ticks == frozenset()


def test_consent_cannot_be_given_without_what_is_required() -> None:
    driver = driven_to(Stage.CONSENT)
    assert driver.agree().effects[-1] == do.ShowValidationErrors(("store",))
    driver.tick("share")
    assert driver.view.missing == ()
    assert driver.agree().effects[-1] == do.ShowValidationErrors(("store",))
    assert driver.noted(happened.ConsentGiven) == []
    assert driver.view.screen == "consent"
    driver.tick("store")
    driver.agree()
    assert driver.stage is Stage.ABOUT_YOU


def test_everything_that_is_missing_is_named_in_the_order_of_the_sheet() -> None:
    driver = asked_for_more()
    assert driver.agree().effects[-1] == do.ShowValidationErrors(("take_part", "store"))
    driver.tick("store")
    assert driver.agree().effects[-1] == do.ShowValidationErrors(("take_part",))


def test_a_tick_can_be_taken_back() -> None:
    driver = driven_to(Stage.CONSENT)
    driver.tick("store", "share")
    assert driver.view.ticks == {"store", "share"}
    driver.tick("store", ticked=False)
    assert driver.view.ticks == {"share"}
    assert driver.agree().effects[-1] == do.ShowValidationErrors(("store",))
    driver.tick("store", "store")
    driver.tick("share", ticked=False)
    driver.tick("share", ticked=False)
    driver.agree()
    assert driver.noted(happened.ConsentGiven)[0].purposes == ("store",)


@pytest.mark.parametrize(("ticked", "purposes"), [(("share", "store"), ("store", "share")), (("store",), ("store",))])
def test_what_is_agreed_to_is_recorded_with_the_text_that_was_shown(
    ticked: tuple[str, ...], purposes: tuple[str, ...]
) -> None:
    driver = driven_to(Stage.CONSENT)
    driver.tick(*ticked)
    driver.agree()
    assert driver.noted(happened.ConsentGiven) == [
        happened.ConsentGiven(
            at_ms=driver.now, version="7", sha256=INFORMATION.sha256, language="en", purposes=purposes
        )
    ]


@given(st.lists(st.tuples(st.sampled_from(PURPOSES), st.booleans())))
def test_what_counts_is_the_last_word_on_each_purpose(said: list[tuple[str, bool]]) -> None:
    driver = driven_to(Stage.CONSENT)
    for purpose, ticked in said:
        driver.tick(purpose, ticked=ticked)
    last = dict(said)
    assert driver.view.ticks == {purpose for purpose in PURPOSES if last.get(purpose)}
    driver.agree()
    assert (driver.stage is Stage.ABOUT_YOU) is last.get("store", False)


@pytest.mark.parametrize("purpose", ["", "Store", "stor", "take_part"])
def test_a_purpose_that_is_not_offered_cannot_be_ticked(purpose: str) -> None:
    driver = driven_to(Stage.CONSENT)
    with pytest.raises(InvalidTransition):
        driver.tick(purpose)
    assert driver.view.ticks == frozenset()


def test_declining_needs_no_tick_and_takes_no_heed_of_any() -> None:
    driver = driven_to(Stage.CONSENT)
    driver.tick("store", "share")
    driver.decline()
    assert driver.stage is Stage.INTRODUCTION
    assert driver.noted(happened.ConsentGiven) == []


@pytest.mark.parametrize("adult", [16, 18, 21])
def test_the_age_that_is_asked_for_is_the_study_s(adult: int) -> None:
    driver = driven_to(Stage.AGE, whole(consent=ConsentConfig(adult=adult)))
    assert (driver.view.screen, driver.view.adult) == ("age", adult)
    driver.say_age()
    assert driver.stage is Stage.CONSENT
