"""A code comes by chance, is copied without a slip, and is stored as a keyed hash alone."""

from __future__ import annotations

import math
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kiosk import UserInputError
from kiosk.experiment.outcomes import SessionKind
from kiosk.store.codes import ALPHABET, CHANCE_CHARACTERS, checked_code, hash_code, make_code, session_with_code
from kiosk.store.database import open_for_reading
from kiosk.store.maintenance import back_up
from kiosk.store.recorder import Provenance, Recorder
from tests.store.visitors import BEGUN, COMPLETED, rows

CODE = "ROME-7KQ2M-XR4T4"
CHARACTERS = "7KQ2MXR4T4"
PLACES = st.integers(0, CHANCE_CHARACTERS)


def test_a_code_has_no_look_alikes_and_more_than_forty_bits() -> None:
    assert not set("01OIL") & set(ALPHABET)
    assert len(set(ALPHABET)) == 31
    assert math.log2(len(ALPHABET) ** CHANCE_CHARACTERS) > 44


@pytest.mark.parametrize("site", ["", "MI", "BCN2"])
def test_a_code_is_two_groups_behind_its_site(site: str) -> None:
    code = make_code(site)
    *before, one, other = code.split("-")
    assert before == ([site] if site else [])
    assert (len(one), len(other)) == (5, 5)
    assert checked_code(code) == one + other
    assert set(one + other) <= set(ALPHABET)


@pytest.mark.parametrize(
    "written",
    [
        *(
            CODE,
            CODE.lower(),
            "rome 7kq2m xr4t4",
            " ROME - 7KQ2M - XR4T4 ",
            "ROME-7KQ2MXR4T4",
            "ROME\u20137KQ2M\u2013XR4T4",
        ),
        *("7KQ2M-XR4T4", "7KQ2MXR4T4", "7KQ 2MX R4T 4", "7 K Q 2 M X R 4 T 4"),
    ],
)
def test_a_code_is_accepted_as_people_write_it(written: str) -> None:
    assert checked_code(written) == CHARACTERS


@given(PLACES, st.sampled_from(ALPHABET))
def test_one_wrong_character_is_told(at: int, wrong: str) -> None:
    mistyped = CHARACTERS[:at] + wrong + CHARACTERS[at + 1 :]
    if mistyped != CHARACTERS:
        with pytest.raises(UserInputError, match=f"the code '{mistyped}' is mistyped"):
            checked_code(mistyped)


@given(PLACES, PLACES)
def test_two_characters_in_each_other_s_place_are_told(one: int, other: int) -> None:
    characters = list(CHARACTERS)
    characters[one], characters[other] = characters[other], characters[one]
    if (mistyped := "".join(characters)) != CHARACTERS:
        with pytest.raises(UserInputError, match="is mistyped"):
            checked_code(mistyped)


@pytest.mark.parametrize(
    "text", ["", "AB", "ABCDEFGHJ8K", "ABCDE0GHJK", "MI-", "ABC-", "ABCDEFGHJ\u00c9", "-", "ROME", "ROME7KQ2MXR4T4"]
)
def test_what_is_no_code_at_all_is_told(text: str) -> None:
    with pytest.raises(UserInputError, match="is no participant's code: after the site it has 10 letters and digits"):
        checked_code(text)


def test_a_code_does_not_follow_from_the_seed(tmp_path: Path, provenance: Provenance) -> None:
    codes = set()
    for name in ("once", "again"):
        with Recorder(tmp_path / name) as recorder:
            codes |= {recorder.begin(provenance, BEGUN).code for _ in range(2)}
    assert len(codes) == 4


def test_no_file_of_the_folder_holds_a_code(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder, "MI") as recorder:
        code = recorder.begin(provenance, COMPLETED).code
        back_up(folder, folder / "backups")
        files = [file.read_bytes() for file in folder.rglob("*") if file.is_file()]
    assert len(files) > 4
    for spelt in (code, code.rpartition("MI-")[2], checked_code(code)):
        assert not any(spelt.encode() in content for content in files)


def test_a_code_leads_to_its_session_and_another_to_none(folder: Path, provenance: Provenance) -> None:
    with Recorder(folder, "MI") as recorder:
        codes = [recorder.begin(provenance, COMPLETED).code for _ in range(2)]
    with closing(open_for_reading(folder)) as connection:
        assert [session_with_code(connection, code) for code in (*codes, CODE)] == [1, 2, None]


def test_databases_hash_one_code_each_in_their_own_way(tmp_path: Path) -> None:
    hashes = set()
    for name in ("one", "other"):
        with Recorder(tmp_path / name):
            ((key,),) = rows(tmp_path / name, "SELECT key FROM code_key")
            hashes.add(hash_code(CODE, key))
    assert len(hashes) == 2


def test_a_session_that_is_gone_on_with_has_a_new_code_and_the_old_one_stays_valid(
    folder: Path, provenance: Provenance
) -> None:
    with Recorder(folder) as recorder:
        old = recorder.begin(replace(provenance, kind=SessionKind.STUDY), BEGUN).code
    with Recorder(folder) as recorder:
        new = recorder.resume(1).code
    assert new != old
    with closing(open_for_reading(folder)) as connection:
        assert [session_with_code(connection, code) for code in (old, new)] == [1, 1]
