"""Information for visitors says the same in every language, or is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.experiment.information import Information, check_alike

SHEET = """
version = "1"
[about]
title = "About"
paragraphs = ["A game."]
[consent]
title = "Consent"
paragraphs = ["May we?"]
purposes = [{ id = "store", text = "Yes." }, { id = "share", text = "Yes.", required = false }]
[debrief]
title = "Debrief"
paragraphs = ["That was it."]
"""


def sheet(folder: Path, language: str, old: str = "", new: str = "") -> Information:
    """Return a sheet with something replaced."""
    (folder / f"{language}.toml").write_text(SHEET.replace(old, new), "utf-8")
    return Information.of(folder, language)


def test_without_what_is_required_there_is_no_consent(tmp_path: Path) -> None:
    assert sheet(tmp_path, "en").consent.required == {"store"}


def test_a_change_of_wording_is_told_by_the_hash(tmp_path: Path) -> None:
    assert sheet(tmp_path, "en").sha256 != sheet(tmp_path, "it", "A game.", "Un gioco.").sha256


def test_a_language_without_a_sheet_is_named(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="there is no information sheet for the language 'fr' in "):
        Information.of(tmp_path, "fr")


def test_sheets_that_differ_only_in_words_are_alike(tmp_path: Path) -> None:
    check_alike({"en": sheet(tmp_path, "en"), "it": sheet(tmp_path, "it", "Yes.", "Sì.")}, tmp_path)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('version = "1"', 'version = "2"', "have different versions: en: 1; it: 2"),
        ('"share"', '"publish"', "have different purposes: en: store, share (optional); it: store, publish (optional)"),
        (", required = false", "", "have different purposes: en: store, share (optional); it: store, share"),
    ],
)
def test_sheets_that_ask_for_different_things_are_refused(old: str, new: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(UserInputError) as refused:
        check_alike({"en": sheet(tmp_path, "en"), "it": sheet(tmp_path, "it", old, new)}, tmp_path)
    assert str(refused.value) == f"the information sheets in {tmp_path} {said}"
