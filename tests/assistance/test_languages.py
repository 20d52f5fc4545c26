"""Every language says everything, with every card, and says it well; a fourth language is one folder."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from itertools import pairwise, product
from pathlib import Path
from random import Random

import pytest
from fluent.syntax import FluentParser, ast
from fluent.syntax.serializer import serialize_pattern
from fluent.syntax.visitor import Visitor

from kiosk.assistance.hint_sentences import PlainSentences, ReasonedSentences, Wording, place, pointing, reasoning
from kiosk.assistance.mentaliser import Hint, HintReason, Target
from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS
from kiosk.game import Position
from tests import pseudo

SENTENCES = ASSETS / "sentences"
LANGUAGES = tuple(sorted(folder.name for folder in SENTENCES.iterdir()))
CARDS = tuple(sorted(picture.stem for picture in (ASSETS / "cards").glob("*/*.svg")))
HELP = (ActionSpec.SUG_COL, ActionSpec.SUG_ROW, ActionSpec.SUG_CARD)
COUNTS = {
    FlipInMove.FIRST: ((0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)),
    FlipInMove.SECOND: ((1, 0), (1, 1), (2, 0), (2, 1), (1, 2), (2, 2)),
}
"""How often the other card and the target were turned up: one example of each reason class."""

of_every_language = pytest.mark.parametrize("language", LANGUAGES)


@cache
def catalogue(language: str) -> Catalogue:
    """Return the catalogue of a language."""
    return Catalogue(SENTENCES / language)


def hints(name: str) -> Iterator[Hint]:
    """Yield a hint for every reason, precision and card of the move, about this picture."""
    for card, action in product(FlipInMove, HELP):
        for other, target in COUNTS[card]:
            reason = HintReason.of(card, other, target)
            yield Hint(action, card, Target(Position(2, 5), Position(0, 0), target, other, reason, ()), name)


# What there is in a catalogue


class _Uses(Visitor):
    """Collects the variables that a message uses, and the messages and terms that it refers to."""

    def __init__(self, node: ast.BaseNode) -> None:
        self.variables: set[str] = set()
        self.references: set[str] = set()
        self.visit(node)

    def visit_VariableReference(self, node: ast.VariableReference) -> None:  # noqa: N802 - fluent.syntax's name
        # A form of the card, such as $card-il, stands for the card.
        self.variables.add(re.sub(r"^card-.*", "card", node.id.name))

    def visit_MessageReference(self, node: ast.MessageReference) -> None:  # noqa: N802 - fluent.syntax's name
        self.references.add(node.id.name)


def messages(sources: dict[str, str]) -> dict[str, ast.Message]:
    """Every message of a catalogue's files."""
    return {name: message for source in sources.values() for name, message in parsed(source).items()}


@cache
def parsed(source: str) -> dict[str, ast.Message]:
    """Return the messages of a file."""
    entries = FluentParser().parse(source).body
    return {entry.id.name: entry for entry in entries if isinstance(entry, ast.Message)}


def variables(message: ast.Message) -> set[str]:
    """Return the variables that are used somewhere in a message."""
    return _Uses(message).variables


def wordings(message: ast.Message) -> int:
    """How many wordings a message has; 0 if it has one value instead, and attributes are its forms."""
    return 0 if message.value is not None else len(message.attributes)


def faults(sources: dict[str, str]) -> list[str]:
    """Return what a language's files lack or have too much of, measured against English; each names the message."""
    english, own = messages(catalogue("en").sources), messages(sources)
    found = [f"{key} is missing" for key in english.keys() - own.keys()]
    found += [f"{key} is never used" for key in own.keys() - english.keys()]
    for key in english.keys() & own.keys():
        if extra := variables(own[key]) - variables(english[key]):
            found.append(f"{key} uses a variable that does not exist: {min(extra)}")
        if unused := variables(english[key]) - variables(own[key]):
            found.append(f"{key} does not use {min(unused)}")
        if bool(wordings(own[key])) != bool(wordings(english[key])) or wordings(own[key]) < least_wordings(key):
            found.append(f"{key} has {wordings(own[key])} wordings")
        found += [f"{key} repeats a wording" for text, n in _texts(own[key]).items() if n > 1 and wordings(own[key])]
    return sorted(found)


def _texts(message: ast.Message) -> Counter[str]:
    return Counter(serialize_pattern(attribute.value) for attribute in message.attributes)


def least_wordings(key: str) -> int:
    """Return what is said often needs three wordings, what is said once in a session two."""
    if key.startswith(("reason-", "point-")):
        return 3
    return 2 if wordings(messages(catalogue("en").sources)[key]) else 0


@of_every_language
def test_every_language_has_the_messages_of_english_with_their_variables(language: str) -> None:
    assert faults(catalogue(language).sources) == []


@pytest.mark.parametrize(
    ("before", "after", "fault"),
    [
        ("attract-start = Inizia\n", "", "attract-start is missing"),
        (
            "attract-start = Inizia\n",
            "attract-start = Inizia\nattract-stop = Basta\n",
            "attract-stop is never used",
        ),
        (" su { $all }", "", "game-pairs does not use all"),
        (" su { $all }", " su { $tot }", "game-pairs uses a variable that does not exist: tot"),
        ("    .c = Io girerei una carta nella riga { $row }.\n", "", "point-first-row has 2 wordings"),
        ("Dai un'occhiata alla riga", "Prova una carta della riga", "point-first-row repeats a wording"),
    ],
)
def test_a_fault_is_told_by_the_message_s_name(before: str, after: str, fault: str) -> None:
    broken = {name: text.replace(before, after) for name, text in catalogue("it").sources.items()}
    assert fault in faults(broken)


@of_every_language
def test_every_picture_of_every_deck_has_a_name(language: str) -> None:
    named = {key.removeprefix("card-") for key in messages(catalogue(language).sources) if key.startswith("card-")}
    assert named == set(CARDS)


@of_every_language
def test_every_card_has_the_same_forms_and_no_name_twice(language: str) -> None:
    forms = {name: catalogue(language).card(name) for name in CARDS}
    assert len({frozenset(form) for form in forms.values()}) == 1
    assert all(text.strip() for form in forms.values() for text in form.values())
    assert len({form["card"] for form in forms.values()}) == len(CARDS)


def test_a_card_that_nobody_translated_goes_by_its_own_name() -> None:
    assert set(catalogue("it").card("zebra")) == set(catalogue("it").card("owl"))
    assert set(catalogue("it").card("zebra").values()) == {"zebra"}


# What is said


@of_every_language
@pytest.mark.parametrize("name", CARDS)
def test_every_sentence_of_every_hint_is_whole(language: str, name: str) -> None:
    for hint in hints(name):
        for sentence in ReasonedSentences(Wording(catalogue(language), Random(0))).all_wordings(hint):
            assert not re.search(r"[{}$]|\s\s|^\s|\s$|[<>]", sentence), sentence
            for part in re.findall(r"[^.!?]+[.!?]", sentence):
                assert re.match(r"\s?[¡¿]?[A-ZÀ-Ý]", part), sentence
            assert sentence.endswith((".", "!", "?")), sentence


@of_every_language
def test_every_hint_has_nine_ways_to_be_said_with_a_reason_and_three_without(language: str) -> None:
    wording = Wording(catalogue(language), Random(0))
    for hint in hints("owl"):
        assert len(set(ReasonedSentences(wording).all_wordings(hint))) >= 9
        assert len(set(PlainSentences(wording).all_wordings(hint))) >= 3


@of_every_language
def test_what_is_said_is_one_of_all_that_could_be_and_never_the_same_twice_running(language: str) -> None:
    for kind in (PlainSentences, ReasonedSentences):
        speaker = kind(Wording(catalogue(language), Random(3)))
        for hint in hints("butterfly"):
            said = [speaker.sentence(hint) for _ in range(20)]
            assert set(said) <= set(speaker.all_wordings(hint))
            assert all(one != following for one, following in pairwise(said))


@of_every_language
def test_a_place_can_be_told_without_a_reason_before_it(language: str) -> None:
    for hint in hints("owl"):
        for sentence in catalogue(language).wordings(pointing(hint), **place(hint)):
            assert re.search(r"\d", sentence)
            assert not re.search(r"\bit\b", sentence), "without a reason 'it' refers to nothing"


ROW_AND_COLUMN = {"en": ("row", "column"), "it": ("riga", "colonna"), "es": ("fila", "columna")}
of_every_language_that_is_read_here = pytest.mark.parametrize("language", tuple(ROW_AND_COLUMN))


@of_every_language_that_is_read_here
def test_a_card_s_place_is_told_row_first(language: str) -> None:
    row, column = ROW_AND_COLUMN[language]
    for hint in hints("owl"):
        for sentence in catalogue(language).wordings(pointing(hint), **place(hint)):
            said = (hint.row is not None, hint.column is not None)
            assert (bool(re.search(rf"\b{row} 3\b", sentence)), bool(re.search(rf"\b{column} 6\b", sentence))) == said
            assert said != (True, True) or re.search(rf"\b{row} 3, {column} 6\b", sentence)


EXAGGERATION = {
    "en": r"again and again|keep|always|every time|remember|forg[eo]t|know|old friend",
    "it": r"continu|sempre|ricord|dimentic|conosc|sai\b|spesso",
    "es": r"siempre|recuerd|olvid|conoc|sabes|a menudo|una y otra vez",
}


@of_every_language_that_is_read_here
def test_a_reason_tells_what_was_seen_and_not_what_is_remembered(language: str) -> None:
    for hint in hints("owl"):
        for sentence in catalogue(language).wordings(reasoning(hint), **catalogue(language).card("owl")):
            assert not re.search(EXAGGERATION[language], sentence, re.IGNORECASE), sentence
            assert not re.search(r"\d", sentence), sentence


NUMBERS_IN_WORDS = {"en": r"twenty|twelve", "it": r"ventiquattro|dodici", "es": r"veinticuatro|doce"}


@of_every_language_that_is_read_here
def test_nothing_supposes_a_board_of_a_certain_size(language: str) -> None:
    for said in catalogue(language).wordings("introduction-speech", cards=16, pairs=8):
        assert "16" in said
    assert not re.search(NUMBERS_IN_WORDS[language], catalogue(language).sources["screens.ftl"], re.IGNORECASE)


@of_every_language
def test_every_language_has_a_name_of_its_own(language: str) -> None:
    others = [catalogue(other).text("language-name") for other in LANGUAGES if other != language]
    assert catalogue(language).text("language-name") not in others


@of_every_language
def test_pictures_that_nobody_has_seen_are_not_named(language: str) -> None:
    said = catalogue(language).wordings("reason-first-nothing-known", **catalogue(language).card("zebra"))
    assert not any("zebra" in sentence for sentence in said)


GENDERED = {"it": r"\b(pronto|pronta|contento|contenta|benvenut[oa]|sicur[oa]|bravo|brava)\b",
            "es": r"\b(listo|lista|contento|contenta|bienvenid[oa]|seguro|segura|encantad[oa])\b",
            "en": r"\b(he|she|him|her)\b"}  # fmt: skip


@of_every_language_that_is_read_here
def test_nothing_supposes_a_woman_or_a_man(language: str) -> None:
    for name, source in catalogue(language).sources.items():
        assert not re.search(GENDERED[language], source, re.IGNORECASE), name


# A fourth language


@pytest.fixture
def fourth(tmp_path: Path) -> Catalogue:
    """Return the catalogue of the pseudo-language."""
    return Catalogue(pseudo.write(tmp_path))


def test_a_fourth_language_is_one_folder(fourth: Catalogue) -> None:
    assert faults(fourth.sources) == []
    assert fourth.language == pseudo.LANGUAGE


def test_every_message_of_the_fourth_language_is_filled_in(fourth: Catalogue) -> None:
    for key, message in messages(fourth.sources).items():
        given: dict[str, str | int] = dict.fromkeys(variables(message), 2)
        for text in fourth.wordings(key, **given) if wordings(message) else (fourth.text(key, **given),):
            assert text.startswith(pseudo.START)
            assert text.endswith(pseudo.END)
            assert not re.search(r"[a-zA-Z{}]", text), text


def test_the_fourth_language_is_longer_than_english(fourth: Catalogue) -> None:
    for key, message in messages(fourth.sources).items():
        if not variables(message) and not wordings(message):
            assert len(fourth.text(key)) >= 1.4 * len(catalogue("en").text(key)), key


@pytest.mark.parametrize("name", CARDS)
def test_every_hint_can_be_given_in_the_fourth_language(fourth: Catalogue, name: str) -> None:
    for hint in hints(name):
        sentences = ReasonedSentences(Wording(fourth, Random(0))).all_wordings(hint)
        assert len(set(sentences)) >= 9
        assert all(("3" in said, "6" in said) == (hint.row is not None, hint.column is not None) for said in sentences)
