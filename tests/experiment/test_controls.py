"""What a visitor may do on every screen: stop, go back, change language, text size and sound, and hear it again."""

from __future__ import annotations

import pytest

from kiosk.assistance.policy import ActionSpec
from kiosk.experiment import effects as do
from kiosk.experiment import events as happened
from kiosk.experiment.events import TextSize, Timer
from kiosk.experiment.outcomes import EmbodimentName, Stage, Status
from kiosk.experiment.session_state import SessionState, language_before_flip
from kiosk.experiment.transitions import InvalidTransition
from tests.experiment.driver import Driver, Voice, driven_to
from tests.experiment.table import playing
from tests.samples import ITALIAN, ITALIAN_INFORMATION

UNDERWAY = list(Stage)[1:-1]


def back(driver: Driver) -> None:
    """Go back a page."""
    driver.send(happened.BackPressed(at_ms=driver.now))


def speak_italian(driver: Driver) -> None:
    """Go on in Italian."""
    driver.send(happened.LanguageSelected(at_ms=driver.now, language="it"))


@pytest.mark.parametrize("stage", UNDERWAY)
def test_a_visitor_who_stops_ends_the_session_as_withdrawn(stage: Stage) -> None:
    driver = driven_to(stage)
    driver.send(happened.StopPressed(at_ms=driver.now))
    assert (driver.stage, driver.view.ended) == (Stage.OVER, Status.WITHDRAWN)
    assert not driver.running


@pytest.mark.parametrize("stage", UNDERWAY)
def test_back_is_offered_exactly_where_it_is_taken(stage: Stage) -> None:
    driver = driven_to(stage)
    if driver.view.goes_back:
        back(driver)
        assert driver.stage in {Stage.ABOUT, Stage.CONSENT, Stage.AGE, Stage.ABOUT_YOU, Stage.DEBRIEF}
        return
    with pytest.raises(InvalidTransition):
        back(driver)


@pytest.mark.parametrize("stage", [Stage.ABOUT_YOU, Stage.PRACTICE, Stage.GAME, Stage.QUESTIONS, Stage.DEBRIEF])
def test_nobody_goes_back_over_a_consent_a_game_or_the_debriefing(stage: Stage) -> None:
    assert not driven_to(stage).view.goes_back


def test_a_consent_that_is_come_back_to_still_has_its_ticks() -> None:
    driver = driven_to(Stage.CONSENT)
    driver.tick("store")
    back(driver)
    driver.to(Stage.CONSENT)
    assert driver.view.ticks == {"store"}


def test_a_form_that_is_come_back_to_still_has_its_answers_and_records_the_changes() -> None:
    driver = driven_to(Stage.ABOUT_YOU)
    driver.to(Stage.INTRODUCTION)
    page = driver.view.page
    assert page is not None
    given = dict(driver.view.answers)
    back(driver)
    assert (driver.stage, driver.view.answers) == (Stage.ABOUT_YOU, given)
    before = SessionState.from_events(driver.events).responses
    item = page.items[0].id
    driver.answer(None, item)
    state = SessionState.from_events(driver.events)
    key = next(key for key in state.responses if key[1] == item)
    assert (state.responses[key].value, state.responses[key].changes) == (None, before[key].changes + 1)
    assert {name: value for name, value in state.responses.items() if name != key} == {
        name: value for name, value in before.items() if name != key
    }


def test_times_of_a_page_that_is_come_back_to_count_from_when_it_came_first() -> None:
    driver = driven_to(Stage.ABOUT_YOU)
    driver.to(Stage.INTRODUCTION)
    shown = driver.noted(happened.QuestionnairePageShown)[-1].at_ms
    driver.spend(5_000)
    back(driver)
    driver.spend(1_000)
    assert driver.view.page is not None
    item = driver.view.page.items[0].id
    driver.answer(None, item)
    response = next(each for each in SessionState.from_events(driver.events).responses.values() if each.item == item)
    assert response.last_ms == driver.now - shown


@pytest.mark.parametrize("stage", UNDERWAY)
def test_text_size_and_sound_change_at_once_and_nothing_else_does(stage: Stage) -> None:
    driver = driven_to(stage)
    screen, page = driver.view.screen, driver.view.page
    driver.send(happened.TextSizeSelected(at_ms=driver.now, size=TextSize.LARGEST))
    driver.send(happened.SoundSelected(at_ms=driver.now, on=False))
    assert (driver.view.text_size, driver.view.sound) == (TextSize.LARGEST, False)
    assert (driver.view.screen, driver.view.page) == (screen, page)


def test_another_language_is_shown_at_once_and_kept_to_the_end() -> None:
    driver = driven_to(Stage.ABOUT)
    speak_italian(driver)
    assert do.SetLanguage("it") in driver.effects
    assert do.ShowAbout(ITALIAN_INFORMATION.about) in driver.effects
    driver.to(Stage.THANKS)
    assert driver.view.bubble in ITALIAN.wordings("thanks-speech")


def test_a_language_that_the_study_lacks_or_speaks_already_is_refused() -> None:
    driver = driven_to(Stage.ABOUT)
    for language in ("en", "xx"):
        with pytest.raises(InvalidTransition):
            driver.send(happened.LanguageSelected(at_ms=driver.now, language=language))


def test_a_hint_is_given_again_in_the_language_that_is_changed_to() -> None:
    driver = playing(ActionSpec.SUG_ROW, Voice.IS_SILENT)
    english = driver.view.bubble
    assert english is not None
    assert driver.view.held is not None
    speak_italian(driver)
    assert driver.view.bubble != english
    driver.wait_until_open()
    assert driver.view.mark is not None
    assert language_before_flip(driver.events, 1) is None
    driver.flip(driver.view.closed[0])
    assert language_before_flip(driver.events, 2) == "it"


def test_what_a_visitor_chose_outlasts_a_cut() -> None:
    driver = driven_to(Stage.INTRODUCTION)
    speak_italian(driver)
    driver.send(happened.TextSizeSelected(at_ms=driver.now, size=TextSize.LARGE))
    outcome = driver.send(happened.SessionResumed(at_ms=driver.now, embodiment=EmbodimentName.AVATAR))
    assert {do.SetLanguage("it"), do.SetTextSize(TextSize.LARGE), do.OfferBack(offered=True)} <= {
        effect for effect in outcome.effects if isinstance(effect, do.SetLanguage | do.SetTextSize | do.OfferBack)
    }


def test_a_sentence_is_said_again_when_it_has_been_said() -> None:
    driver = playing(ActionSpec.SUG_ROW)
    with pytest.raises(InvalidTransition):
        driver.send(happened.RepeatPressed(at_ms=driver.now))
    driver.wait_until_open()
    sentence = driver.view.bubble
    driver.send(happened.RepeatPressed(at_ms=driver.now))
    assert driver.view.speaking is not None
    assert driver.view.bubble == sentence


def test_thanks_that_are_left_for_the_debriefing_wait_no_longer() -> None:
    driver = driven_to(Stage.THANKS)
    back(driver)
    assert driver.stage is Stage.DEBRIEF
    assert Timer.THANKS not in driver.running
