"""What is shipped for visitors to read is whole in every language, and short enough to be read."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from kiosk.config import ASSETS, Settings
from kiosk.experiment.information import Information, check_alike
from kiosk.experiment.items import Likert, Rating
from kiosk.experiment.questionnaire import ItemOrder, Questionnaire
from kiosk.study.new import templates

LANGUAGES = ("en", "it", "es")
QUESTIONNAIRES = sorted((ASSETS / "questionnaires").glob("*.toml"))
SHEETS = sorted(folder for folder in (ASSETS / "consent").iterdir() if folder.is_dir())
LONGEST_ITEM = 16
"""Words that are read in five seconds, at some 200 a minute."""


def shipped(name: str) -> Questionnaire:
    """Return a questionnaire by its name."""
    return Questionnaire.read(ASSETS / "questionnaires" / f"{name}.toml")


@pytest.mark.parametrize("file", QUESTIONNAIRES, ids=lambda file: str(file.stem))
def test_every_questionnaire_is_worded_in_every_language(file: Path) -> None:
    questionnaire = Questionnaire.read(file)
    assert questionnaire.id == file.stem
    assert [questionnaire.unworded(language) for language in LANGUAGES] == [(), (), ()]
    # A title that stands in two lines moves its page down.
    assert max(map(len, (questionnaire.title or {"en": ""}).values())) <= len("Über die Hilfe im Spiel")


@pytest.mark.parametrize("file", QUESTIONNAIRES, ids=lambda file: str(file.stem))
def test_every_item_is_read_in_five_seconds(file: Path) -> None:
    texts = [words for item in Questionnaire.read(file).items for words in item.text.values()]
    assert [text for text in texts if len(text.split()) > LONGEST_ITEM] == []


@pytest.mark.parametrize("file", QUESTIONNAIRES, ids=lambda file: str(file.stem))
def test_every_questionnaire_says_whose_wording_it_is(file: Path) -> None:
    assert "our own" in Questionnaire.read(file).note.lower()


def test_the_scales_of_the_study_are_its_four_with_its_two_reversed_items() -> None:
    questionnaire = shipped("social-intelligence")
    assert questionnaire.order is ItemOrder.SHUFFLED
    assert questionnaire.per_page == 4
    names = {scale: [item.id for item in items] for scale, items in questionnaire.scales.items()}
    assert names == {scale: [f"{scale}{number}" for number in range(1, 5)] for scale in ("SOC", "AC", "PC", "RC")}
    ratings = [item for item in questionnaire.items if isinstance(item, Rating)]
    assert [item.id for item in ratings if item.reverse] == ["SOC3", "AC2"]
    assert {item.ends for item in ratings} == {(1, 5)}
    assert "not the published items" in questionnaire.note


PUBLISHED = {
    "RC1": "can figure out what people think",
    "RC2": "knows when people are missing information",
    "RC3": "can figure out what people can see",
    "RC4": "understands others' perspectives",
    "AC1": "adapts its behavior based upon what people around it know",
    "AC2": "ignores what people are thinking",
    "AC3": "selects appropriate actions once it knows what others think",
    "AC4": "knows what to do when people are confused",
}
"""The items of two PSI scales as https://ipip.ori.org/PSIScalesandScoring.htm has them; AC2 alone is reversed there."""


def test_the_psi_items_are_word_for_word_the_published_ones_and_the_rest_is_marked_as_ours() -> None:
    questionnaire = shipped("psi")
    items = [item for item in questionnaire.items if isinstance(item, Rating)]
    assert {item.id: item.text["en"].removeprefix("The helper ").removesuffix(".") for item in items} == PUBLISHED
    assert {item.id: item.scale for item in items} == {name: name[:2] for name in PUBLISHED}
    assert [item.id for item in items if item.reverse] == ["AC2"]
    assert {(item.ends, item.not_applicable) for item in items} == {((1, 5), True)}
    assert "https://ipip.ori.org/PSIScalesandScoring.htm" in questionnaire.note
    assert "Italian and Spanish translations are our own and not validated" in " ".join(questionnaire.note.split())


def test_the_answers_about_robots_are_the_five_of_the_study() -> None:
    questionnaire = shipped("about-you")
    assert [item.id for item in questionnaire.items] == ["age", "gender", "robots"]
    robots = questionnaire.items[2]
    assert robots.kind == "single"
    assert robots.ids == ("none", "stories", "fairs", "owns", "works")
    assert [question.id for question in questionnaire.questions if question.required is True] == []


def test_the_form_about_trust_is_its_scale_and_the_rating_of_ten_points_is_asked_apart_and_last() -> None:
    trust, alone = shipped("trust"), shipped("another-game")
    assert {name: [item.id for item in items] for name, items in trust.scales.items()} == {
        "TRUST": ["TR1", "TR2", "TR3"]
    }
    assert [item.id for item in trust.items] == ["TR1", "TR2", "TR3"]
    assert [(item.id, item.points, item.scale) for item in alone.items if isinstance(item, Likert)] == [
        ("TR4", 10, None)
    ]
    assert len(alone.items) == 1
    assert alone.title != trust.title
    named = [Settings().questionnaires, *(tuple(each.study.get("questionnaires", ())) for each in templates().values())]
    asked = [names for names in named if "another-game" in names]
    assert len(asked) == 4
    assert {names[-1] for names in asked} == {"another-game"}


# Information sheets


@pytest.mark.parametrize("folder", SHEETS, ids=lambda folder: str(folder.name))
def test_information_sheets_ask_for_the_same_in_every_language(folder: Path) -> None:
    sheets = {language: Information.of(folder, language) for language in LANGUAGES}
    check_alike(sheets, folder)
    for sheet in sheets.values():
        # To take part is one answer; the boxes are for what goes beyond it.
        assert [(purpose.id, purpose.required) for purpose in sheet.consent.purposes] == [("share", False)]


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_visitor_has_time_to_read_the_information_sheet(language: str) -> None:
    sheet = Information.of(ASSETS / "consent" / "study", language)
    for page, most in ((sheet.about, 60), (sheet.consent, 150), (sheet.debrief, 110)):
        assert sum(len(paragraph.split()) for paragraph in page.paragraphs) <= most
    assert len({sheet.sha256, *(Information.of(ASSETS / "consent" / "study", each).sha256 for each in LANGUAGES)}) == 3


def test_no_text_for_visitors_names_a_condition_or_says_who_is_a_woman_or_a_man() -> None:
    files = [*QUESTIONNAIRES, *(file for folder in SHEETS for file in folder.glob("*.toml"))]
    words = re.compile(r"\b(tom|notom|theory of mind|benvenuto|benvenuta|bienvenido|bienvenida|sicuro|segura)\b", re.I)
    assert [(file.name, found[0]) for file in files if (found := words.search(file.read_text("utf-8")))] == []


# Pictures


@pytest.mark.parametrize("folder", sorted((ASSETS / "scales").iterdir()), ids=lambda folder: str(folder.name))
def test_the_pictures_of_a_scale_are_plain_and_of_one_size(folder: Path) -> None:
    pictures = sorted(folder.glob("*.svg"))
    assert [picture.stem for picture in pictures] == [str(number + 1) for number in range(len(pictures))]
    for picture in pictures:
        text = picture.read_text("utf-8")
        assert 'viewBox="0 0 240 240"' in text
        assert re.search(r"<(filter|mask|text|style|image|linearGradient|radialGradient)\b", text) is None


def test_faces_are_told_apart_without_their_colours() -> None:
    faces = [file.read_text("utf-8") for file in sorted((ASSETS / "scales" / "faces").glob("*.svg"))]
    shapes = {re.sub(r'<title>.*?</title>|(fill|stroke)="#\w+"', "", face) for face in faces}
    colours = {tuple(sorted(set(re.findall(r"#\w{6}", face)) - {"#FFFBF2"})) for face in faces}
    assert (len(shapes), len(colours)) == (5, 1)
