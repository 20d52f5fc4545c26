"""Sentences come from the catalogue, never the same twice running, and say no more than they should."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path
from random import Random

import pytest

from kiosk import UserInputError
from kiosk.assistance.comments import COMMENTS
from kiosk.assistance.hint_sentences import (
    PlainSentences,
    ReasonedSentences,
    ReminderSentences,
    Wording,
    place,
    pointing,
    reasoning,
    reminding,
)
from kiosk.assistance.mentaliser import Hint, HintReason, Target
from kiosk.assistance.policy import ActionSpec, FlipInMove
from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS
from kiosk.game import Position
from tests.samples import ANIMALS, CATALOGUES, ENGLISH

HELP = (ActionSpec.SUG_COL, ActionSpec.SUG_ROW, ActionSpec.SUG_CARD)
COUNTS = {
    FlipInMove.FIRST: [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)],
    FlipInMove.SECOND: [(1, 0), (1, 1), (2, 0), (2, 1), (1, 2), (2, 2)],
}
"""How often the other card and the target were seen: one example of each reason class."""


def hint(
    action: ActionSpec, card: FlipInMove = FlipInMove.FIRST, other: int = 0, target: int = 0, name: str = "owl"
) -> Hint:
    """Return a hint at row 3, column 6 as people count."""
    reason = HintReason.of(card, other, target)
    return Hint(action, card, Target(Position(2, 5), Position(0, 0), target, other, reason, ()), name)


EVERY_HINT = [
    hint(action, card, other, target) for action in HELP for card in FlipInMove for other, target in COUNTS[card]
]
in_every_language = pytest.mark.parametrize("language", CATALOGUES.values(), ids=CATALOGUES.keys())


def messages(language: Catalogue, file: str) -> list[str]:
    """Return the messages of one file of a catalogue, as often as they stand there."""
    return re.findall(r"^([a-z][\w-]*) *=", language.sources[file], re.MULTILINE)


def catalogue(folder: Path, **files: str) -> Catalogue:
    """Return a catalogue of a language of these files."""
    language = folder / "xx"
    language.mkdir()
    for name, content in files.items():
        (language / f"{name}.ftl").write_text(content, "utf-8")
    return Catalogue(language)


# What every language holds


@in_every_language
def test_every_hint_has_three_ways_to_be_said(language: Catalogue) -> None:
    for given in EVERY_HINT:
        where = language.wordings(pointing(given), **place(given))
        why = language.wordings(reasoning(given), **language.card("owl"))
        assert len(set(where)) >= 3, given
        assert len(set(why)) >= 3, given


@in_every_language
def test_every_message_about_hints_is_used_and_every_used_one_is_there(language: Catalogue) -> None:
    used = {message(given) for given in EVERY_HINT for message in (reasoning, reminding, pointing)}
    used |= {comment.message for comment in COMMENTS}
    assert set(messages(language, "hints.ftl")) == used


@in_every_language
def test_every_picture_of_every_deck_has_a_name_and_every_name_a_picture(language: Catalogue) -> None:
    pictures = (ASSETS / "cards").glob("*/*.svg")
    assert set(messages(language, "cards.ftl")) == {f"card-{picture.stem}" for picture in pictures}


@in_every_language
def test_every_language_holds_the_same_messages_and_each_once(language: Catalogue) -> None:
    here = [message for file in language.sources for message in messages(language, file)]
    there = [message for file in ENGLISH.sources for message in messages(ENGLISH, file)]
    assert len(here) == len(set(here))
    assert set(here) == set(there)


@in_every_language
@pytest.mark.parametrize("name", ANIMALS)
def test_every_reason_can_be_given_for_every_card(language: Catalogue, name: str) -> None:
    for given in EVERY_HINT:
        for wording in language.wordings(reasoning(given), **language.card(name)):
            assert "{" not in wording
            assert "$" not in wording


@in_every_language
def test_a_sentence_gives_away_no_more_of_the_place_than_the_action(language: Catalogue) -> None:
    for given in EVERY_HINT:
        for wording in language.wordings(pointing(given), **place(given)):
            assert ("3" in wording) is (given.row is not None), wording
            assert ("6" in wording) is (given.column is not None), wording


@in_every_language
def test_a_reason_gives_away_no_place(language: Catalogue) -> None:
    for given in EVERY_HINT:
        for wording in language.wordings(reasoning(given), **language.card("owl")):
            assert not re.search(r"\d|\brow\b|\bcolumn\b", wording)


@in_every_language
def test_a_card_nobody_has_seen_is_not_named(language: Catalogue) -> None:
    one, other = (language.wordings("reason-first-nothing-known", **language.card(name)) for name in ("owl", "frog"))
    assert one == other


@in_every_language
def test_every_other_reason_for_a_first_card_names_it(language: Catalogue) -> None:
    reasons = {reasoning(given) for given in EVERY_HINT if given.card is FlipInMove.FIRST} - {
        "reason-first-nothing-known"
    }
    for reason in reasons:
        pairs = zip(*(language.wordings(reason, **language.card(name)) for name in ("owl", "frog")), strict=True)
        assert all(one != other for one, other in pairs)


@in_every_language
@pytest.mark.parametrize(
    "message",
    [
        *("introduction-speech", "practice-speech", "thanks-speech"),
        *("result-speech-few", "result-speech-some", "result-speech-many"),
    ],
)
def test_what_the_session_says_outside_the_game_can_be_said_in_two_ways(language: Catalogue, message: str) -> None:
    assert len(set(language.wordings(message, moves=24, cards=24, pairs=12))) >= 2


@in_every_language
def test_what_is_said_about_result_and_end_is_not_what_the_page_says(language: Catalogue) -> None:
    for share in ("few", "some", "many"):
        assert not any(re.search(r"\d", said) for said in language.wordings(f"result-speech-{share}", moves=24))
    thanks = language.text("thanks-title").strip("¡!").lower()
    assert not any(thanks in said.lower() for said in language.wordings("thanks-speech"))


@in_every_language
def test_every_wording_of_the_practice_s_speech_ends_with_what_to_do(language: Catalogue) -> None:
    assert all(said.endswith(language.text("practice-turn")) for said in language.wordings("practice-speech"))


def test_places_are_told_counted_from_one() -> None:
    assert place(hint(ActionSpec.SUG_CARD)) == {"row": 3, "column": 6}
    assert place(hint(ActionSpec.SUG_ROW)) == {"row": 3}
    assert place(hint(ActionSpec.SUG_COL)) == {"column": 6}


@pytest.mark.parametrize(
    ("card", "action", "where", "why"),
    [
        (FlipInMove.FIRST, ActionSpec.SUG_COL, "point-first-column", "reason-first-nothing-known"),
        (FlipInMove.FIRST, ActionSpec.SUG_ROW, "point-first-row", "reason-first-nothing-known"),
        (FlipInMove.SECOND, ActionSpec.SUG_CARD, "point-second-card", "reason-second-first-sight"),
    ],
)
def test_a_hint_s_messages_go_by_card_precision_and_reason(
    card: FlipInMove, action: ActionSpec, where: str, why: str
) -> None:
    given = hint(action, card, other=int(card is FlipInMove.SECOND))
    assert (pointing(given), reasoning(given)) == (where, why)


# Choosing among wordings


def test_no_wording_is_said_twice_running() -> None:
    wording = Wording(ENGLISH, Random(1))
    said = [wording.say("reason-first-both-often", card="owl") for _ in range(300)]
    assert all(one != next_one for one, next_one in pairwise(said))
    assert len(set(said)) == 3


def test_no_wording_is_said_twice_running_about_another_place_either() -> None:
    wording = Wording(ENGLISH, Random(1))
    said = [wording.say("point-first-row", row=1 + number % 4) for number in range(100)]
    frames = [re.sub(r"\d", "#", sentence) for sentence in said]
    assert all(one != next_one for one, next_one in pairwise(frames))


def test_every_message_remembers_its_own_last_wording() -> None:
    wording = Wording(ENGLISH, Random(1))
    said = []
    for _ in range(100):
        said.append(wording.say("reason-first-both-often", card="owl"))
        wording.say("point-first-row", row=1)
    assert all(one != next_one for one, next_one in pairwise(said))


def test_the_first_wording_may_be_any() -> None:
    assert len({Wording(ENGLISH, Random(seed)).say("point-first-row", row=1) for seed in range(40)}) == 3


def test_the_same_chance_says_the_same() -> None:
    one, other = Wording(ENGLISH, Random(4)), Wording(ENGLISH, Random(4))
    assert [one.say("point-first-row", row=1) for _ in range(20)] == [
        other.say("point-first-row", row=1) for _ in range(20)
    ]


def test_a_message_with_one_wording_says_it_again(tmp_path: Path) -> None:
    wording = Wording(catalogue(tmp_path, hints="only =\n    .a = Again.\n"), Random(1))
    assert [wording.say("only") for _ in range(3)] == ["Again."] * 3


def test_plain_sentences_say_only_where() -> None:
    for given in EVERY_HINT:
        sentence = PlainSentences(Wording(ENGLISH, Random(1))).sentence(given)
        assert sentence in ENGLISH.wordings(pointing(given), **place(given))


def test_reasoned_sentences_say_why_and_then_where() -> None:
    for given in EVERY_HINT:
        sentence = ReasonedSentences(Wording(ENGLISH, Random(1))).sentence(given)
        assert sentence in {
            f"{why} {where}"
            for why in ENGLISH.wordings(reasoning(given), card="owl")
            for where in ENGLISH.wordings(pointing(given), **place(given))
        }


@pytest.mark.parametrize("kind", [PlainSentences, ReasonedSentences])
def test_the_advice_of_a_hint_is_where_to_look(kind: type[PlainSentences]) -> None:
    sentences = kind(Wording(ENGLISH, Random(1)))
    for given in EVERY_HINT:
        for sentence in sentences.all_wordings(given):
            advice = sentences.advice(given, sentence)
            assert sentence.endswith(advice)
            assert advice in ENGLISH.wordings(pointing(given), **place(given))


def test_a_reminder_has_no_advice() -> None:
    sentences = ReminderSentences(Wording(ENGLISH, Random(1)))
    assert {sentences.advice(given, sentences.sentence(given)) for given in EVERY_HINT} == {""}


def test_a_sentence_that_does_not_end_in_advice_has_none() -> None:
    sentences = ReasonedSentences(Wording(ENGLISH, Random(1)))
    assert sentences.advice(EVERY_HINT[0], "There it is.") == ""


# The catalogue


def test_a_message_is_filled_in(tmp_path: Path) -> None:
    assert catalogue(tmp_path, a="greet = Hello { $name }!\n").text("greet", name="you") == "Hello you!"


def test_a_filled_in_sentence_holds_no_invisible_marks() -> None:
    assert ENGLISH.wordings("point-first-card", row=1, column=2)[0].isascii()


def test_all_files_of_a_folder_are_one_catalogue(tmp_path: Path) -> None:
    both = catalogue(tmp_path, one="hello = Hello\n", two="bye = Bye\n")
    assert (both.text("hello"), both.text("bye"), both.language) == ("Hello", "Bye", "xx")
    assert both.sources == {"one.ftl": "hello = Hello\n", "two.ftl": "bye = Bye\n"}


def test_a_catalogue_knows_what_it_holds(tmp_path: Path) -> None:
    assert "hello" in catalogue(tmp_path, one="hello = Hello\n")
    assert "goodbye" not in ENGLISH


def test_wordings_are_counted_in_the_order_of_their_names(tmp_path: Path) -> None:
    both = catalogue(tmp_path, one="m =\n    .b = second\n    .a = first\n")
    assert both.wordings("m") == ("first", "second")


def test_an_unknown_message_raises() -> None:
    with pytest.raises(LookupError, match="no-such-message"):
        ENGLISH.text("no-such-message")
    with pytest.raises(LookupError, match="no-such-message"):
        Wording(ENGLISH, Random(1)).say("no-such-message")


def test_a_variable_that_is_not_given_raises() -> None:
    with pytest.raises(KeyError, match=r"en: the message game-pairs cannot be filled in: .*found"):
        ENGLISH.text("game-pairs", all=12)
    with pytest.raises(KeyError, match="point-first-row cannot be filled in"):
        Wording(ENGLISH, Random(1)).say("point-first-row", column=1)


def test_a_message_with_several_wordings_has_no_single_text() -> None:
    with pytest.raises(KeyError, match="the message point-first-row cannot be filled in: it is of another form"):
        ENGLISH.text("point-first-row", row=1)


def test_a_language_without_sentences_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match="there are no sentences for the language 'yy' in"):
        Catalogue(tmp_path / "yy")


def test_a_file_that_is_not_well_formed_is_refused_where_it_breaks(tmp_path: Path) -> None:
    with pytest.raises(UserInputError, match=r"broken\.ftl, line 3, is not well-formed near: this is no message"):
        catalogue(tmp_path, broken="fine = Fine\n\nthis is no message\n")


def test_a_file_that_is_not_text_is_refused(tmp_path: Path) -> None:
    folder = tmp_path / "xx"
    folder.mkdir()
    (folder / "odd.ftl").write_bytes(b"hello = Ol\xe9\n")
    with pytest.raises(UserInputError, match=r"the file .*odd.ftl is not UTF-8"):
        Catalogue(folder)


def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    (tmp_path / "xx" / "odd.ftl").mkdir(parents=True)
    with pytest.raises(UserInputError, match=r"the file .*odd.ftl cannot be read: "):
        Catalogue(tmp_path / "xx")


def test_a_catalogue_can_be_made_from_what_was_kept_of_it(tmp_path: Path) -> None:
    kept = Catalogue(tmp_path / "en", ENGLISH.sources)
    assert (kept.language, kept.sources) == ("en", ENGLISH.sources)
    assert kept.text("card-owl") == "owl"


def test_a_card_comes_with_every_form_its_language_has(tmp_path: Path) -> None:
    language = catalogue(tmp_path, cards="card-owl = Eule\n    .the = die Eule\ncard-bat = Maus\n    .the = die Maus\n")
    assert language.card("owl") == {"card": "Eule", "card-the": "die Eule"}


def test_a_card_without_a_name_goes_by_its_file_in_every_form(tmp_path: Path) -> None:
    language = catalogue(tmp_path, cards="card-owl = Eule\n    .the = die Eule\n")
    assert language.card("yak") == {"card": "yak", "card-the": "yak"}


@pytest.mark.parametrize("kind", [PlainSentences, ReasonedSentences])
def test_all_that_could_be_said_holds_what_is_said(kind: type[PlainSentences | ReasonedSentences]) -> None:
    for given in EVERY_HINT:
        sentences = kind(Wording(ENGLISH, Random(1)))
        assert {sentences.sentence(given) for _ in range(12)} <= set(sentences.all_wordings(given))


def test_with_or_without_reasons_the_place_is_told_in_the_same_words() -> None:
    plain, reasoned = PlainSentences(Wording(ENGLISH, Random(6))), ReasonedSentences(Wording(ENGLISH, Random(6)))
    for given in EVERY_HINT * 3:
        assert reasoned.sentence(given).endswith(plain.sentence(given))
