"""The PIN is stored as a hash, compared in constant time, and a wrong one costs time."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from kiosk import UserInputError
from kiosk.config import ExperimenterConfig
from kiosk.experiment.experimenter import COST, LONGEST_WAIT_MS, SALT_BYTES, WrongPins, hash_pin, pin_matches

SALT = bytes(range(SALT_BYTES))
LINE = hash_pin("258013", SALT, cost=10)


def test_the_right_pin_matches_and_no_other() -> None:
    assert pin_matches("258013", LINE)
    assert not any(pin_matches(wrong, LINE) for wrong in ("258014", "2580130", "", "310852"))


def test_the_study_file_takes_the_line_as_it_is_printed_and_nothing_else() -> None:
    assert ExperimenterConfig(pin_hash=LINE).pin_hash == LINE
    for other in (
        "258013",
        LINE[:-1],
        LINE.upper(),
        LINE.replace("scrypt", "plain"),
        LINE.replace(":10:", ":"),
        LINE.replace(":10:", ":30:"),
    ):
        with pytest.raises(ValidationError):
            ExperimenterConfig(pin_hash=other)


def test_two_booths_with_the_same_pin_do_not_keep_the_same_line() -> None:
    assert hash_pin("258013", bytes(SALT_BYTES), cost=10) != LINE
    assert "258013" not in LINE


@pytest.mark.parametrize(
    "pin", ["", "25801", "2580136974251", "25a013", "\uff12\uff15\uff18\uff10\uff11\uff13", "258 013", "258013\n"]
)
def test_a_pin_is_some_digits(pin: str) -> None:
    with pytest.raises(UserInputError, match="6 to 12 digits"):
        hash_pin(pin, SALT)


@pytest.mark.parametrize(
    "pin",
    ["111111", "123456", "567890", "987654", "121212", "258258", "12341234", "112233", "135791", "111112", "000000"],
)
def test_a_pin_that_is_guessed_first_is_refused(pin: str) -> None:
    with pytest.raises(UserInputError, match="too easy to guess"):
        hash_pin(pin, SALT, cost=10)


def test_a_pin_that_is_chosen_costs_its_full_price() -> None:
    assert hash_pin("258013", SALT).startswith(f"scrypt:{COST}:")
    assert COST >= 16


def test_each_wrong_one_makes_everybody_wait_twice_as_long_up_to_a_minute() -> None:
    waits = [WrongPins(times).wait_ms for times in range(9)]
    assert waits == [0, 1000, 2000, 4000, 8000, 16_000, 32_000, 60_000, 60_000]
    assert WrongPins(10**9).wait_ms == LONGEST_WAIT_MS


def test_a_wait_goes_by() -> None:
    wrong = WrongPins(3, last_ms=100_000)
    assert [wrong.left_ms(now) for now in (100_000, 101_500, 104_000, 200_000)] == [4000, 2500, 0, 0]
    assert wrong.left_ms(5) == 4000
