"""Every message of a study's own sentences is formed before a visitor hears it, and none of them ends a session."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st

from kiosk import UserInputError
from kiosk.assistance.wording import Catalogue, Written
from kiosk.config import ASSETS, Settings
from kiosk.experiment.outcomes import Stage
from kiosk.study.checks import study_warnings
from kiosk.study.forming import is_as_shipped, unformed
from kiosk.study.loader import read_study
from tests.experiment.driver import driven_to
from tests.samples import ANIMALS, ENGLISH

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 240 240"><circle cx="120" cy="120" r="80"/></svg>'
STUDY = 'languages = ["./en"]\nstages = ["introduction", "practice", "game", "result"]\n'


@pytest.fixture
def own(tmp_path: Path) -> Path:
    """Return a study with sentences of its own."""
    shutil.copytree(ASSETS / "sentences" / "en", tmp_path / "en")
    (tmp_path / "study.toml").write_text(STUDY, "utf-8")
    return tmp_path


def change(folder: Path, file: str, old: str, new: str) -> int:
    """Replace some of a file of sentences; the line of what is new."""
    path = folder / "en" / file
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), "utf-8")
    return text[: text.index(old)].count("\n") + 1


def said(folder: Path) -> tuple[str, ...]:
    """Every sentence with which a study is refused."""
    with pytest.raises(UserInputError) as refused:
        read_study(Settings.read(folder / "study.toml"))
    return refused.value.sentences


@pytest.mark.parametrize(
    ("file", "old", "new", "why"),
    [
        (
            "hints.ftl",
            "column { $column }",
            "column { $gefunden }",
            "asks for the variable $gefunden; it is given $column",
        ),
        ("hints.ftl", "{ $card }", "{ $card-il }", "asks for the variable $card-il; it is given $card"),
        ("screens.ftl", "{ $moves }", "{ -brand }", "refers to a term -brand, which does not exist"),
        ("screens.ftl", "{ $moves }", "{ no-such }", "refers to a message no-such, which does not exist"),
        ("screens.ftl", "{ $moves }", "{ UPPER($moves) }", "calls UPPER(), which does not exist"),
        ("cards.ftl", "= owl", "= { $owl }", "asks for the variable $owl; it is given none"),
        ("screens.ftl", "{ $code }", "{ NUMBER($code) }", "cannot be said with code = code: "),
        ("screens.ftl", "{ $code }", "{ debrief-subject }", "cannot be said with code = code: "),
    ],
)
def test_a_message_that_cannot_be_formed_is_told_with_file_and_line(
    file: str, old: str, new: str, why: str, own: Path
) -> None:
    line = change(own, file, old, new)
    assert any(f"{own / 'en' / file}, line " in each and why in each for each in said(own)), said(own)
    lines = [int(match[1]) for each in said(own) if (match := re.search(r", line (\d+)", each))]
    assert line in lines or line - 1 in lines


def test_a_message_of_the_wrong_form_is_told(own: Path) -> None:
    change(own, "screens.ftl", "game-pairs = ", "game-pairs =\n    .a = ")
    change(own, "hints.ftl", "point-first-row =\n", "point-first-row = x\n")
    assert sum("must have" in each for each in said(own)) == 2


def test_a_message_with_very_many_faults_is_not_told_for_ever(own: Path) -> None:
    file = own / "en" / "hints.ftl"
    file.write_text(file.read_text("utf-8").replace("$card", "$karte"), "utf-8")
    assert 5 < len(said(own)) < 30


def test_the_shipped_sentences_can_all_be_formed() -> None:
    for folder in sorted((ASSETS / "sentences").iterdir()):
        catalogue = Catalogue(folder)
        # A study's check passes over those that it changes nothing of.
        catalogue.written = {name: replace(written, late=None) for name, written in catalogue.written.items()}
        assert list(unformed(catalogue, ENGLISH, ANIMALS, 6)) == []


@pytest.mark.parametrize(
    ("text", "alone"),
    [
        ("pairs = { $count ->\n    [one] One pair\n   *[other] { NUMBER($count) } pairs\n }\n", True),
        ('pairs = { $cards } cards { "x" }\n', True),
        ("pairs = The { $card }\n", False),
        ("pairs = { $card-il } { $count }\n", False),
        ("pairs = { -brand }\n", False),
        ("pairs = { $count ->\n   *[other] {game-title.short} }\n", False),
    ],
)
def test_a_shipped_message_is_formed_again_when_it_says_what_a_study_can_change(text: str, alone: bool) -> None:  # noqa: FBT001
    assert is_as_shipped(Written("pairs", Path("a.ftl"), text, late=text)) is alone
    assert not is_as_shipped(Written("pairs", Path("a.ftl"), text))


# At run time


def test_what_cannot_be_said_is_said_by_the_next_language(caplog: pytest.LogCaptureFixture, tmp_path: Path) -> None:
    folder = tmp_path / "xx"
    folder.mkdir()
    (folder / "a.ftl").write_text("game-pairs = { $nothing }\npoint-first-row =\n    .a = { -no }\n", "utf-8")
    broken, italian = Catalogue(folder), Catalogue(ASSETS / "sentences" / "it")
    assert broken.text("game-pairs", found=1, all=12) == ENGLISH.text("game-pairs", found=1, all=12)
    broken.followed_by([italian])
    for _ in range(2):
        assert broken.text("game-pairs", found=1, all=12) == italian.text("game-pairs", found=1, all=12)
        assert broken.wordings("point-first-row", row=2) == italian.wordings("point-first-row", row=2)
    told = [record.getMessage() for record in caplog.records]
    assert told == [f"the message {name!r} cannot be said in 'xx'" for name in ("game-pairs", "point-first-row")]


def test_a_wording_that_cannot_be_said_leaves_the_others(tmp_path: Path) -> None:
    folder = tmp_path / "xx"
    folder.mkdir()
    (folder / "a.ftl").write_text("point-first-row =\n    .a = { $no }\n    .b = Row { $row }\n", "utf-8")
    assert Catalogue(folder).wordings("point-first-row", row=2) == ("Row 2",)


@pytest.mark.parametrize("name", ["auto", "my card (1)", "ö", "42", "a.b", "{x}"])
def test_a_deck_without_names_is_played_by_its_files_names(name: str, own: Path) -> None:
    deck = own / "toys"
    deck.mkdir()
    for number in range(11):
        (deck / f"toy{number}.svg").write_text(SVG, "utf-8")
    (deck / f"{name}.svg").write_text(SVG, "utf-8")
    (own / "study.toml").write_text(STUDY + '[game]\ndeck = "toys"\n', "utf-8")
    study = read_study(Settings.read(own / "study.toml"))
    (caution,) = [each for each in study_warnings(study) if "without a name in 'en'" in each]
    assert name in caution
    assert f"Write them into the column 'en' of {deck / 'names.csv'}" in caution
    assert study.plans[0].catalogue.card(name)["card"] == name
    driven_to(Stage.RESULT, study.plans[0])


# Whatever is accepted runs

BITS = st.sampled_from(
    [
        "{ $card }",
        "{ $row }",
        "{ $column }",
        "{ $nothing }",
        "{ -no }",
        "{ NUMBER($row) }",
        "{ $card-il }",
        *("words", "two words", "{ 1 }", "2 %") * 4,
        "{ game-title }",
        '{ "" }',
        "{ $row -> [one] a *[other] { $column } }",
    ]
)
NUMBERS = st.sampled_from([2, 4, 4, 4, 8, 8, 10**30])
KEYS = (
    "game.rows",
    "game.columns",
    "timing.mood_ms",
    "timing.highlight_delay_ms",
    "allocation.block",
    "assistance.step",
)


@settings(
    max_examples=40,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(
    wordings=st.dictionaries(
        st.sampled_from(sorted(name for name in ENGLISH.messages if name.startswith(("point-", "reason-", "game-")))),
        st.lists(BITS, min_size=1, max_size=3),
        max_size=2,
    ),
    numbers=st.dictionaries(st.sampled_from(KEYS), NUMBERS, max_size=2),
    names=st.lists(st.sampled_from(["owl", "cat", "auto", "bus 7", "-", "fish"]), max_size=4, unique=True),
    seed=st.integers(0, 9),
)
def test_a_study_that_is_accepted_can_be_played(
    wordings: dict[str, list[str]], numbers: dict[str, int], names: list[str], seed: int, own: Path
) -> None:
    for file in ("hints.ftl", "screens.ftl"):
        text = (ASSETS / "sentences" / "en" / file).read_text("utf-8")
        for name, bits in wordings.items():
            several = re.search(rf"(?m)^{name} =\n(    .*\n)+", text)
            new = f"{name} =\n    .a = {' '.join(bits)}\n" if several else f"{name} = {' '.join(bits)}\n"
            text = re.sub(rf"(?m)^{name} =.*\n(    .*\n)*", new.replace("\\", "\\\\"), text)
        (own / "en" / file).write_text(text, "utf-8")
    deck = own / "deck"
    shutil.rmtree(deck, ignore_errors=True)
    deck.mkdir()
    for name in [*names, *(f"toy{number}" for number in range(12))]:
        (deck / f"{name}.svg").write_text(SVG, "utf-8")
    rows = "".join(f"{key} = {number}\n" for key, number in numbers.items())
    (own / "study.toml").write_text(f'game.deck = "deck"\n{STUDY}{rows}', "utf-8")
    try:
        study = read_study(Settings.read(own / "study.toml"))
    except UserInputError:
        event("refused")
        return
    event("played")
    plan = study.plans[0]
    driver = driven_to(Stage.RESULT, plan, seed=Random(seed).randrange(100))
    assert driver.stage is Stage.RESULT
    for message in plan.catalogue.messages:
        if message.startswith("game-open-card"):
            assert all(plan.catalogue.text(message, row=1, column=1, **plan.catalogue.card(card)) for card in plan.deck)
