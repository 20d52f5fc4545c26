"""The PIN that is chosen is the one that opens, and nothing but its line is printed."""

from __future__ import annotations

import json
import tomllib

import pytest
from click.testing import CliRunner, Result

from kiosk import UserInputError
from kiosk.cli.main import recollect
from kiosk.config import Settings
from kiosk.experiment.experimenter import pin_matches


def choose(*typed: str, options: tuple[str, ...] = ()) -> Result:
    """Run the command, and type these lines."""
    return CliRunner().invoke(recollect, ["study", "set-pin", *options], input="".join(f"{line}\n" for line in typed))


def test_what_is_printed_goes_into_a_study_file_as_it_is() -> None:
    told = choose("258013", "258013")
    assert told.exit_code == 0
    settings = Settings.model_validate(tomllib.loads(told.stdout))
    assert pin_matches("258013", settings.experimenter.pin_hash)
    assert "258013" not in told.output.replace(settings.experimenter.pin_hash, "")


def test_two_of_the_same_pin_have_lines_of_their_own() -> None:
    lines = {json.loads(choose("258013", "258013", options=("--json",)).stdout)["pin_hash"] for _ in range(2)}
    assert len(lines) == 2


@pytest.mark.parametrize(
    ("typed", "why"),
    [
        (("258013", "258014"), "not the same"),
        (("12", "12"), "6 to 12 digits"),
        (("123456", "123456"), "too easy to guess"),
    ],
)
def test_a_slip_and_what_is_no_pin_are_refused(typed: tuple[str, str], why: str) -> None:
    told = choose(*typed)
    assert isinstance(told.exception, UserInputError)
    assert why in str(told.exception)
    assert told.stdout == ""
