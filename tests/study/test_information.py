"""Information for visitors says the same in every language, or is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from kiosk import UserInputError
from kiosk.config import ASSETS
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
        ('["May we?"]', '["May we?"]\npoints = ["A."]', "have different points: en: 0, 0, 0; it: 0, 1, 0"),
        ('["A game."]', '["A game."]\nsigns = ["cards"]', "have different signs: en: none; it: cards"),
    ],
)
def test_sheets_that_ask_for_different_things_are_refused(old: str, new: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(UserInputError) as refused:
        check_alike({"en": sheet(tmp_path, "en"), "it": sheet(tmp_path, "it", old, new)}, tmp_path)
    assert str(refused.value) == f"the information sheets in {tmp_path} {said}"


def test_each_point_has_a_drawing_of_its_own_and_each_paragraph_where_there_are_no_points(tmp_path: Path) -> None:
    both = sheet(tmp_path, "en", '["May we?"]', '["May we?"]\npoints = ["A.", "B."]\nsigns = ["lock", "play"]')
    assert both.consent.lines == (("A.", "lock"), ("B.", "play"))
    assert both.about.lines == (("A game.", ""),)
    drawn = sheet(tmp_path, "it", '["A game."]', '["A game."]\nsigns = ["cards"]')
    assert drawn.about.lines == (("A game.", "cards"),)


@pytest.mark.parametrize(
    ("signs", "said"),
    [
        ('["cards", "clock"]', "there are 2 signs for 1 paragraphs; each needs one"),
        ('["unicorn"]', "unicorn"),
    ],
)
def test_a_wrong_number_of_drawings_and_an_unknown_one_are_refused(signs: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match=said):
        sheet(tmp_path, "en", '["A game."]', f'["A game."]\nsigns = {signs}')


def test_the_hash_of_a_sheet_without_points_and_drawings_is_that_of_its_texts(tmp_path: Path) -> None:
    plain = sheet(tmp_path, "en")
    assert plain.sha256 == "14c5336a1ccd5834632d9246edb81cf1174144e7f52363c77596ee955ea2c28a"
    assert sheet(tmp_path, "it", '["A game."]', '["A game."]\nsigns = ["cards"]').sha256 != plain.sha256


@pytest.mark.parametrize("folder", sorted(map(str, ASSETS.glob("templates/*/information"))))
def test_the_sheets_of_every_template_say_the_most_important_in_short_points_first(folder: str) -> None:
    for file in sorted(Path(folder).glob("*.toml")):
        sheet = Information.read(file)
        assert len(sheet.consent.points) == len(sheet.consent.signs) in {3, 4}
        assert max(map(len, sheet.consent.points)) < 90
        assert len(sheet.about.signs) == len(sheet.about.paragraphs)
