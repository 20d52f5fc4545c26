"""The PIN is stored as a hash, compared in constant time, and a wrong one costs time."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from kiosk import UserInputError
from kiosk.config import ExperimenterConfig
from kiosk.experiment.experimenter import LONGEST_WAIT_MS, SALT_BYTES, WrongPins, hash_pin, pin_matches

SALT = bytes(range(SALT_BYTES))
LINE = hash_pin("2580", SALT)


def test_the_right_pin_matches_and_no_other() -> None:
    assert pin_matches("2580", LINE)
    assert not any(pin_matches(wrong, LINE) for wrong in ("2581", "25800", "", "0852"))


def test_the_study_file_takes_the_line_as_it_is_printed_and_nothing_else() -> None:
    assert ExperimenterConfig(pin_hash=LINE).pin_hash == LINE
    for other in ("2580", LINE[:-1], LINE.upper(), LINE.replace("scrypt", "plain")):
        with pytest.raises(ValidationError):
            ExperimenterConfig(pin_hash=other)


def test_two_booths_with_the_same_pin_do_not_keep_the_same_line() -> None:
    assert hash_pin("2580", bytes(SALT_BYTES)) != LINE
    assert "2580" not in LINE


@pytest.mark.parametrize("pin", ["", "123", "1234567890123", "12a4", "\uff11\uff12\uff13\uff14", "12 34", "1234\n"])
def test_a_pin_is_some_digits(pin: str) -> None:
    with pytest.raises(UserInputError, match="4 to 12 digits"):
        hash_pin(pin, SALT)


def test_each_wrong_one_makes_everybody_wait_twice_as_long_up_to_a_minute() -> None:
    waits = [WrongPins(times).wait_ms for times in range(9)]
    assert waits == [0, 1000, 2000, 4000, 8000, 16_000, 32_000, 60_000, 60_000]
    assert WrongPins(10**9).wait_ms == LONGEST_WAIT_MS


def test_a_wait_goes_by_and_a_clock_that_was_set_back_makes_it_no_longer() -> None:
    wrong = WrongPins(3, last_ms=100_000)
    assert [wrong.left_ms(now) for now in (100_000, 101_500, 104_000, 200_000)] == [4000, 2500, 0, 0]
    assert wrong.left_ms(5) == 4000
