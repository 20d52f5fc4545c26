"""A questionnaire is data: what may be answered, how it counts, and how it is worded follow from its file."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from kiosk import UserInputError
from kiosk.config import ASSETS
from kiosk.experiment.items import Answer, Likert, Rating, Slider, TextPage, in_language
from kiosk.experiment.questionnaire import KINDS, TITLE, Questionnaire, differences
from tests.samples import without_line

GALLERY = Questionnaire.read(ASSETS / "questionnaires" / "gallery.toml")
FINE = """
id = "q"
version = "2"
note = "ours"
[likert]
points = 7
lowest.en = "little"
highest.en = "much"
[[items]]
id = "one"
kind = "likert"
scale = "S"
text.en = "How?"
[[items]]
id = "two"
kind = "likert"
points = 5
reverse = true
text.en = "And now?"
"""


def written(folder: Path, content: str) -> Path:
    """Return a questionnaire file of this content."""
    file = folder / "q.toml"
    file.write_text(content, "utf-8")
    return file


def item(name: str) -> Any:
    """Return an item of the gallery."""
    return next(item for item in GALLERY.items if item.id == name)


def test_items_come_in_their_order_and_share_what_their_kind_has(tmp_path: Path) -> None:
    one, two = Questionnaire.read(written(tmp_path, FINE)).items
    assert isinstance(one, Likert)
    assert isinstance(two, Likert)
    assert (one.id, one.points, one.lowest, one.required) == ("one", 7, {"en": "little"}, False)
    assert (two.id, two.points, two.highest) == ("two", 5, {"en": "much"})


def test_what_a_kind_shares_is_part_of_its_items(tmp_path: Path) -> None:
    read = Questionnaire.read(written(tmp_path, FINE))
    assert Questionnaire.model_validate_json(read.model_dump_json()) == read
    other = Questionnaire.read(written(tmp_path, FINE.replace('"much"', '"a lot"')))
    assert other.sha256 != read.sha256


def test_a_questionnaire_cannot_be_changed(tmp_path: Path) -> None:
    questionnaire = Questionnaire.read(written(tmp_path, FINE))
    with pytest.raises(ValidationError, match="frozen"):
        questionnaire.version = "3"


def test_the_gallery_shows_every_kind_once() -> None:
    assert sorted(item.kind for item in GALLERY.items) == sorted(KINDS)


@pytest.mark.parametrize(
    ("name", "good", "bad"),
    [
        ("enjoyed", (1, 7), (0, 8, True, "4", (4,), ())),
        ("clear", (1, 7), (0, 8, "clear")),
        ("effort", (0, 100), (-1, 101, False, "50")),
        ("mood", (1, 5), (0, 6)),
        ("plays", ("never", "weekly"), ("daily", "", 1, ("never",))),
        ("used", ((), ("place",), ("hints", "place")), ("place", ("place", "place"), ("eyes",), 1)),
        ("alone", (0, 12), (-1, 13, True, "12")),
        ("remark", ("", "Thanks", "x" * 120), ("x" * 121, "two\nlines", 5)),
        ("welcome", (), (1, "", ())),
    ],
)
def test_an_item_takes_what_can_be_an_answer_to_it(
    name: str, good: tuple[Answer, ...], bad: tuple[Answer, ...]
) -> None:
    assert [answer for answer in good if not item(name).accepts(answer)] == []
    assert [answer for answer in bad if item(name).accepts(answer)] == []


def test_a_reversed_item_counts_turned_round(tmp_path: Path) -> None:
    one, two = Questionnaire.read(written(tmp_path, FINE)).items
    assert isinstance(one, Rating)
    assert isinstance(two, Rating)
    assert [one.scored(answer) for answer in (1, 7)] == [1, 7]
    assert [two.scored(answer) for answer in (1, 2, 5)] == [5, 4, 1]
    slider = Slider(
        id="s", kind="slider", text={"en": "?"}, left={"en": "l"}, right={"en": "r"}, lowest=-10, reverse=True
    )
    assert slider.scored(-10) == 100


def test_text_pages_are_no_questions() -> None:
    assert [item.id for item in GALLERY.items if isinstance(item, TextPage)] == ["welcome"]
    assert len(GALLERY.questions) == len(GALLERY.items) - 1


def test_scales_keep_their_items_in_order(tmp_path: Path) -> None:
    read = Questionnaire.read(
        written(tmp_path, FINE.replace("reverse = true", 'scale = "S"\npoints = 7').replace("points = 5\n", ""))
    )
    assert {name: [item.id for item in items] for name, items in read.scales.items()} == {"S": ["one", "two"]}


def test_a_word_that_is_missing_in_a_language_is_found_in_all_that_is_worded() -> None:
    assert GALLERY.unworded("en") == ()
    assert GALLERY.unworded("de") == (TITLE, *(item.id for item in GALLERY.items))
    for name, key in (("enjoyed", "lowest"), ("clear", "right"), ("effort", "left"), ("mood", "highest")):
        given = tomllib.loads((ASSETS / "questionnaires" / "gallery.toml").read_text("utf-8"))
        next(item for item in given["items"] if item["id"] == name)[key].pop("es")
        assert Questionnaire.model_validate(given).unworded("es") == (name,)
    assert GALLERY.model_copy(update={"title": {"en": "How?"}}).unworded("es") == (TITLE,)


def test_a_questionnaire_without_a_title_has_the_hash_that_it_always_had() -> None:
    assert '"title"' in GALLERY.model_dump_json()
    assert '"title"' not in GALLERY.model_copy(update={"title": None}).model_dump_json()


@pytest.mark.parametrize(
    ("one", "other", "differs"),
    [
        (None, None, False),
        (None, {"en": "How?"}, True),
        ({"en": "How?"}, {"en": "Why?"}, True),
        ({"en": "How?"}, {"en": "How?", "it": "Come?"}, False),
    ],
)
def test_another_title_is_another_content_and_a_translation_of_it_is_none(
    one: dict[str, str] | None, other: dict[str, str] | None, *, differs: bool
) -> None:
    both = [GALLERY.model_copy(update={"title": title}) for title in (one, other)]
    assert differences(*both) == ([TITLE] if differs else [])


def test_a_text_falls_back_to_its_first_language() -> None:
    assert in_language({"it": "sì", "en": "yes"}, "en") == "yes"
    assert in_language({"it": "sì", "en": "yes"}, "de") == "sì"


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('version = "2"', "version = 2", "version must be text in quotes, but it is 2"),
        ("points = 7", "points = 12", "likert.points must be from 2 to 11, but it is 12"),
        ("points = 5", "points = 1", "item 2 (two): points must be from 2 to 11, but it is 1"),
        ('scale = "S"', "scale = 3", "item 1 (one): scale must be text in quotes, but it is 3"),
        ('id = "two"', 'id = "one"', "items: the item 'one' stands twice"),
        (
            'id = "two"',
            'id = "2"',
            "item 2 (2): id: '2' is no name; a name begins with a letter and has letters, digits, _ and - only",
        ),
        (
            "reverse = true",
            'scale = "S"',
            "items: those of the scale 'S' have different ends, so they cannot be summed",
        ),
        (
            'kind = "likert"\npoints = 5\nreverse = true',
            'kind = "integer"\nscale = "S"',
            "items: 'two' is no rating, so it cannot belong to the scale 'S'",
        ),
        (
            'kind = "likert"\npoints = 5\nreverse = true',
            'kind = "integer"\nlowest = 9\nhighest = 9',
            "item 2 (two): its lowest 9 must be below its highest 9",
        ),
        (
            'kind = "likert"\npoints = 5\nreverse = true',
            'kind = "single"\noptions = [{ id = "a", text.en = "A" }]',
            "item 2 (two): options must have at least 2 entries, but it has 1",
        ),
        (
            "[likert]",
            f"title.en = '{'m' * 121}'\n[likert]",
            "title.en must have at most 120 characters",
        ),
        ("[likert]", "title = 'How?'\n[likert]", "title: 'How?' stands in no language; write { en = 'How?' }"),
        ("[likert]", "title = {}\n[likert]", "title must have at least 1 entry, but it has 0"),
        (
            "[likert]",
            "[likret]",
            "there is no key 'likret'; there are id, version, note, title, per_page, order, least_answered, visits, "
            "items",
        ),
    ],
)
def test_what_is_wrong_is_named(old: str, new: str, said: str, tmp_path: Path) -> None:
    assert old in FINE
    file = written(tmp_path, FINE.replace(old, new))
    with pytest.raises(UserInputError) as refused:
        Questionnaire.read(file)
    assert f"the questionnaire {file}: {said}" in map(without_line, refused.value.sentences)
