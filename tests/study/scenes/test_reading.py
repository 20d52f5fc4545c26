"""The stages in which a visitor reads or listens, and goes on."""

from __future__ import annotations

import pytest

from kiosk.study import commands as do
from kiosk.study import events as happened
from kiosk.study.commands import Mood
from tests.samples import ENGLISH, plan
from tests.study.driver import Driver, with_memory
from tests.study.table import a_pair, miss, playing


def test_the_result_tells_moves_pairs_and_time() -> None:
    driver = Driver(plan(), 2)
    driver.to_the_game()
    driver.play(with_memory(2))
    flips = driver.noted(happened.CardFlipped)
    assert driver.view.result == do.ShowResult(
        pairs=12, moves=len(flips) // 2, time_ms=flips[-1].at_ms - flips[0].at_ms
    )
    assert (driver.view.screen, driver.view.mood) == ("result", Mood.HAPPY)


@pytest.mark.parametrize(
    ("moves", "message"),
    [(12, "few"), (24, "few"), (25, "some"), (29, "some"), (30, "many"), (31, "many")],
)
def test_the_remark_goes_by_the_number_of_moves(moves: int, message: str) -> None:
    driver = playing()
    for _ in range(moves - 12):
        miss(driver)
    while driver.view.closed:
        for place in a_pair(driver):
            driver.flip(place)
    driver.wait_until_open()
    assert driver.session.measures.moves == moves
    assert driver.view.bubble in ENGLISH.wordings(f"result-speech-{message}", moves=moves)
