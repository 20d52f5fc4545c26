"""The measures of a game, against numbers worked out by hand."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk.assistance.mentaliser import HintReason
from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.experiment import events as happened
from kiosk.experiment.dealt_boards import BoardHint
from kiosk.experiment.events import Event
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.projections import Measures, measure
from kiosk.game import Position
from tests.experiment.driver import Driver, Voice, at_random
from tests.samples import plan

HERE = Position(1, 2)


def flip(at_ms: int, number: int, *, matched: bool | None = None, position: Position = HERE) -> Event:
    """Flip number so-and-so."""
    return happened.CardFlipped(
        at_ms=at_ms, number=number, move=(number + 1) // 2, position=position, card="owl", matched=matched
    )


def hint(
    at_ms: int, number: int, action: ActionSpec = ActionSpec.SUG_CARD, target: Position = HERE
) -> happened.HintGiven:
    """Return a hint for flip number so-and-so."""
    return happened.HintGiven(
        at_ms=at_ms,
        flip=number,
        card=FlipInMove.SECOND if number % 2 == 0 else FlipInMove.FIRST,
        action=action,
        target=target,
        name="owl",
        seen=0,
        mate_seen=0,
        reason=HintReason.NOTHING_KNOWN,
        allowed=1,
        target_probability=1.0,
        row=None if action is ActionSpec.SUG_COL else target.row,
        column=None if action is ActionSpec.SUG_ROW else target.column,
        sentence="",
        utterance=number,
    )


def opened(at_ms: int) -> Event:
    """Open the board again."""
    return happened.BoardUnlocked(at_ms=at_ms)


def entered(stage: Stage, at_ms: int = 0) -> Event:
    """Go on to a stage."""
    return happened.StageEntered(at_ms=at_ms, stage=stage)


def paused(since: int, until: int) -> list[Event]:
    """Stop the session from then to then, as the experimenter."""
    return [happened.PauseRequested(at_ms=since), happened.PauseEnded(at_ms=until)]


DEALT = happened.BoardDealt(at_ms=0, rows=4, columns=6, cards=("owl",) * 24)


def measured(game: list[Event]) -> Measures:
    """Return the measures of a session whose game went like this."""
    return measure([entered(Stage.GAME), DEALT, *game])


def test_nothing_measures_nothing() -> None:
    nothing = measure([])
    assert measured([]) == nothing
    assert nothing == Measures()
    assert (nothing.flips, nothing.moves, nothing.pairs, nothing.hints, nothing.completion_ms) == (0, 0, 0, 0, 0)
    assert (nothing.assistance_per_flip, nothing.followed) == (None, None)
    assert (nothing.first_followed, nothing.first_led_to_match, nothing.per_match_ms) == (None, None, None)


def test_a_game_without_help() -> None:
    events = [
        flip(1000, 1),
        flip(2000, 2, matched=False),
        flip(4000, 3),
        flip(5500, 4, matched=True),
        flip(7000, 5),
        flip(9000, 6, matched=True),
    ]
    assert measured(events) == Measures(
        flips=6,
        moves=3,
        pairs=2,
        hints=0,
        completion_with_speech_ms=8000,
        completion_ms=8000,
        assistance_per_flip=0.0,
        followed=None,
        first_followed=None,
        first_led_to_match=None,
    )
    assert measured(events).per_match_ms == 4000.0


def test_a_game_with_help_of_every_kind() -> None:
    elsewhere = Position(0, 0)
    events = [
        hint(1000, 1, ActionSpec.SUG_COL),
        opened(3000),
        flip(5000, 1, position=Position(3, 2)),  # in the column: followed, and its move will match
        hint(5000, 2, ActionSpec.SUG_ROW),
        opened(6000),
        flip(7000, 2, matched=True, position=Position(1, 5)),  # in the row: followed
        hint(7000, 3, ActionSpec.SUG_CARD),
        opened(11_000),
        flip(12_000, 3, position=HERE),  # the card: followed, but its move will not match
        flip(13_000, 4, matched=False, position=elsewhere),
        hint(15_000, 5, ActionSpec.SUG_CARD),
        opened(16_000),
        flip(17_000, 5, position=Position(1, 3)),  # beside the card: not followed, though its move will match
        flip(20_000, 6, matched=True, position=elsewhere),
    ]
    measures = measured(events)
    assert (measures.flips, measures.moves, measures.pairs, measures.hints) == (6, 3, 2, 4)
    assert measures.completion_with_speech_ms == 20_000 - 5000
    assert measures.completion_ms == 15_000 - (1000 + 4000 + 1000)
    assert measures.assistance_per_flip == pytest.approx((0.5 + 1 + 2 + 2) / 6)
    assert measures.followed == pytest.approx(3 / 4)
    assert measures.first_followed == pytest.approx(2 / 3)
    assert measures.first_led_to_match == pytest.approx(1 / 3)
    assert measures.per_match_ms == pytest.approx((15_000 - 6000) / 2)
    assert measures.per_match_with_speech_ms == pytest.approx(7500.0)


def test_second_card_hints_alone_say_nothing_about_first_cards() -> None:
    measures = measured([flip(0, 1), hint(0, 2), opened(10), flip(20, 2, matched=True)])
    assert (measures.followed, measures.first_followed, measures.first_led_to_match) == (1.0, None, None)


@pytest.mark.parametrize(("one", "two", "led"), [(True, False, 0.0), (False, True, 1.0)])
def test_a_hint_leads_to_the_match_of_its_own_move(*, one: bool, two: bool, led: float) -> None:
    before = [flip(0, 1), flip(1, 2, matched=one)]
    measures = measured([*before, hint(2, 3), opened(3), flip(4, 3), flip(5, 4, matched=two)])
    assert (measures.first_followed, measures.first_led_to_match) == (1.0, led)


def test_a_hint_that_nobody_followed_led_to_nothing() -> None:
    measures = measured([hint(0, 1), opened(5), flip(9, 1, position=Position(0, 0)), flip(10, 2, matched=True)])
    assert (measures.followed, measures.first_followed, measures.first_led_to_match) == (0.0, 0.0, 0.0)


def test_a_hint_without_its_flip_counts_as_given_and_not_as_followed() -> None:
    measures = measured([flip(0, 1), flip(9, 2, matched=True), hint(9, 3)])
    assert (measures.hints, measures.followed, measures.first_led_to_match) == (1, 0.0, 0.0)
    assert measures.assistance_per_flip == pytest.approx(2 / 2)
    assert measures.completion_ms == measures.completion_with_speech_ms == 9


def test_a_followed_hint_whose_move_was_never_completed_led_to_no_match() -> None:
    measures = measured([hint(0, 1), opened(5), flip(9, 1)])
    assert (measures.flips, measures.moves, measures.first_followed, measures.first_led_to_match) == (1, 0, 1.0, 0.0)


def test_a_hint_before_any_flip_has_no_flips_to_be_shared_among() -> None:
    measures = measured([hint(0, 1)])
    assert (measures.hints, measures.assistance_per_flip, measures.followed) == (1, None, 0.0)


def test_an_unfinished_game_is_timed_to_its_last_match() -> None:
    measures = measured(
        [flip(100, 1), flip(300, 2, matched=True), hint(300, 3), opened(800), flip(900, 3), flip(999, 4, matched=False)]
    )
    assert (measures.completion_with_speech_ms, measures.completion_ms, measures.per_match_ms) == (200, 200, 200.0)


def test_without_a_match_no_time_is_completed() -> None:
    measures = measured([flip(100, 1), flip(300, 2, matched=False)])
    assert (measures.completion_with_speech_ms, measures.completion_ms, measures.per_match_ms) == (0, 0, None)


def test_a_hint_before_the_first_flip_does_not_stop_a_clock_that_has_not_begun() -> None:
    measures = measured([hint(0, 1), opened(4000), flip(5000, 1), flip(9000, 2, matched=True)])
    assert (measures.completion_with_speech_ms, measures.completion_ms) == (4000, 4000)


def test_what_happened_in_other_stages_does_not_matter() -> None:
    practice: list[Event] = [flip(10, 1), flip(20, 2, matched=True), flip(30, 3), flip(40, 4, matched=False)]
    game: list[Event] = [flip(100, 1), flip(300, 2, matched=True)]
    around: list[Event] = [
        happened.SessionStarted(at_ms=0),
        entered(Stage.PRACTICE),
        DEALT,
        *practice,
        entered(Stage.GAME, 50),
        DEALT,
        *game,
        happened.SpeechFinished(at_ms=350, utterance=1),
        entered(Stage.QUESTIONS, 400),
        happened.ResponseGiven(at_ms=400, item="enjoyed", value=5),
    ]
    assert measure(around) == measured(game)
    assert measure([entered(Stage.PRACTICE), DEALT, *practice]) == Measures()


# Pauses


GAME: list[Event] = [flip(1000, 1), hint(1000, 2), opened(3000), flip(5000, 2, matched=True)]
"""4 s from the first flip to the last match, 2 s of them held by a hint."""


@pytest.mark.parametrize(
    ("since", "until", "with_speech", "without"),
    [
        (3200, 4200, 3000, 1000),  # after the hint
        (1500, 2500, 3000, 2000),  # within the time of the hint
        (2000, 4000, 2000, 1000),  # beginning with the hint still held
        (500, 2000, 3000, 2000),  # beginning before the first flip
        (0, 900, 4000, 2000),  # all before the first flip
        (4500, 9000, 3500, 1500),  # ending after the last match
        (6000, 9000, 4000, 2000),  # all after the last match
        (0, 9000, 0, 0),  # all the game: nothing can be flipped, but a stored one is measured all the same
        (1000, 5000, 0, 0),
    ],
)
def test_no_clock_counts_a_pause(since: int, until: int, with_speech: int, without: int) -> None:
    measures = measured(sorted([*GAME, *paused(since, until)], key=lambda event: event.at_ms))
    assert (measures.completion_with_speech_ms, measures.completion_ms) == (with_speech, without)


def test_two_pauses_are_both_left_out() -> None:
    measures = measured(sorted([*GAME, *paused(1500, 2000), *paused(3500, 4500)], key=lambda event: event.at_ms))
    assert (measures.completion_with_speech_ms, measures.completion_ms) == (2500, 1000)


def test_a_pause_that_nobody_ended_lasts_to_the_last_match() -> None:
    measures = measured(sorted([*GAME, happened.PauseRequested(at_ms=4000)], key=lambda event: event.at_ms))
    assert (measures.completion_with_speech_ms, measures.completion_ms) == (3000, 1000)


def test_a_pause_from_the_practice_into_the_game_takes_nothing_from_its_clock() -> None:
    before: list[Event] = [entered(Stage.PRACTICE), happened.PauseRequested(at_ms=100), entered(Stage.GAME, 200)]
    assert measure([*before, DEALT, happened.PauseEnded(at_ms=900), *GAME]) == measured(GAME)


@given(st.lists(st.tuples(st.integers(0, 9000), st.integers(0, 9000)), max_size=4))
def test_pauses_take_as_much_from_a_clock_as_the_moments_in_which_they_lasted(spans: list[tuple[int, int]]) -> None:
    times = sorted({moment // 10 * 10 for span in spans for moment in span})
    apart = list(zip(times[::2], times[1::2], strict=False))
    events = sorted([*GAME, *(event for span in apart for event in paused(*span))], key=lambda event: event.at_ms)
    stopped = {ms for since, until in apart for ms in range(since, until, 10)}
    held = set(range(1000, 3000, 10))
    measures = measured(events)
    assert measures.completion_with_speech_ms == 10 * len(set(range(1000, 5000, 10)) - stopped)
    assert measures.completion_ms == 10 * len(set(range(1000, 5000, 10)) - stopped - held)


@pytest.mark.parametrize(
    ("action", "place", "expected"),
    [
        (ActionSpec.SUG_CARD, (1, 2), True),
        (ActionSpec.SUG_CARD, (1, 3), False),
        (ActionSpec.SUG_CARD, (0, 2), False),
        (ActionSpec.SUG_ROW, (1, 5), True),
        (ActionSpec.SUG_ROW, (0, 2), False),
        (ActionSpec.SUG_COL, (3, 2), True),
        (ActionSpec.SUG_COL, (1, 3), False),
    ],
)
def test_following_is_going_where_the_hint_pointed(
    action: ActionSpec, place: tuple[int, int], *, expected: bool
) -> None:
    flip = happened.CardFlipped(at_ms=1, number=1, move=1, position=Position(*place), card="owl", matched=None)
    assert BoardHint(hint(0, 1, action)).followed_by(flip) is expected


@pytest.mark.parametrize("voice", Voice)
def test_speech_takes_no_time_of_the_clock_without_speech(voice: Voice) -> None:
    """The same visitor in the same game needs the same time without speech, however long the body takes."""
    times = set()
    for body in (Voice.SPEAKS, voice):
        driver = Driver(plan(), 6, body)
        driver.to_the_game()
        driver.play(at_random(6))
        times.add(driver.session.measures.completion_ms)
    assert len(times) == 1
