"""What visitors type, on a keyboard or on the screen, is shown, recorded, replayed and exported as they typed it."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontMetricsF, QGuiApplication
from PySide6.QtQuick import QQuickItem
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.experiment import events as happened
from kiosk.experiment.items import Answer, Integer, ShortText
from kiosk.experiment.outcomes import Stage
from kiosk.experiment.replay import replay_events
from kiosk.export.columns import ExportOption
from kiosk.export.dataset import export_dataset
from kiosk.export.layouts import PsychDs
from kiosk.places import ASSETS
from kiosk.store.queries import open_repository
from kiosk.ui.app import App
from kiosk.ui.replay import Replay
from kiosk.ui.simulated_visitor import UiDriver
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from tests.export.conftest import rows_of
from tests.ui.conftest import Booth
from tests.ui.headless import HALF, headless

EXACTLY = (
    "a\N{NO-BREAK SPACE}b",
    "mot\N{IDEOGRAPHIC SPACE}mot",
    "\N{WOMAN}\N{ZERO WIDTH JOINER}\N{GIRL}",
    "می\N{ZERO WIDTH NON-JOINER}خواهم",
    "zu\N{SOFT HYPHEN}sammen",
    "  e\N{COMBINING ACUTE ACCENT} ",
)

Given = list[tuple[str, Answer | None]]


def text(name: str = "remark", longest: int = 120) -> ShortText:
    """Return an item that is answered by a few words."""
    return ShortText(id=name, kind="text", text={"en": "Remarks?"}, longest=longest)


def whole_number(lowest: int, highest: int) -> Integer:
    """Return an item that is answered by a whole number."""
    return Integer(id="n", kind="integer", text={"en": "How many?"}, lowest=lowest, highest=highest, required=True)


@pytest.fixture
def booth(resting_booth: Booth) -> Booth:
    """Return the booth of all these tests: only the last ones here begin a session, each in a booth of its own."""
    return resting_booth


@pytest.fixture
def given(booth: Booth) -> Iterator[Given]:
    """Return what the form reports, which is shown as the study would show it."""
    answers: Given = []

    def take(item: str, value: Answer | None) -> None:
        answers.append((item, value))
        booth.app.screens.form.show_answer(item, value)

    listening = booth.app.screens.form.answered.connect(take)
    yield answers
    booth.app.screens.form.answered.disconnect(listening)


def contents(booth: Booth, name: str) -> str:
    """Return what stands in a field."""
    return str(booth.item(name).property("text"))


def says(item: QQuickItem, words: str) -> bool:
    """Whether these words are to be seen within an item."""
    return item.isVisible() and (
        item.property("text") == words or any(says(child, words) for child in item.childItems())
    )


# Texts


@pytest.mark.parametrize("typed", EXACTLY)
def test_a_text_is_answered_exactly_as_it_was_typed(booth: Booth, given: Given, typed: str) -> None:
    booth.ask(text())
    booth.click("text-remark")
    UiDriver(booth.app.window).type(typed)
    booth.click("continue")
    assert given == [("remark", typed)]
    assert contents(booth, "text-remark") == typed


@pytest.mark.parametrize("pasted", ["one\ntwo", "one\ttwo", "one\x07", "\n", "one\n"])
def test_a_control_character_is_refused_in_words_until_it_is_gone(booth: Booth, given: Given, pasted: str) -> None:
    booth.ask(text())
    refusal = booth.app.screens.kiosk.property("words")["form-refused"]
    booth.click("text-remark")
    assert not says(booth.item("item-remark"), refusal)
    QGuiApplication.clipboard().setText(pasted)
    booth.press(Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
    assert says(booth.item("item-remark"), refusal)
    booth.click("continue")
    assert given == []
    assert booth.app.screens.form.property("missing") == ["remark"]
    booth.click("text-remark")
    booth.press(Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    UiDriver(booth.app.window).type("one")
    assert not says(booth.item("item-remark"), refusal)
    booth.click("continue")
    assert given == [("remark", "one")]


def test_blanks_alone_are_no_answer(booth: Booth, given: Given) -> None:
    booth.ask(text().model_copy(update={"required": True}))
    booth.click("text-remark")
    UiDriver(booth.app.window).type(" \N{NO-BREAK SPACE} ")
    booth.click("continue")
    assert given == []


def test_a_field_takes_as_many_characters_as_it_says_however_many_places_each_needs(booth: Booth, given: Given) -> None:
    booth.ask(text(longest=4))
    booth.click("text-remark")
    UiDriver(booth.app.window).type("😀😀😀😀😀x")
    assert contents(booth, "text-remark") == "😀😀😀😀"
    booth.press(Qt.Key.Key_Home)
    UiDriver(booth.app.window).type("y")
    assert contents(booth, "text-remark") == "😀😀😀😀"
    booth.click("continue")
    assert given == [("remark", "😀😀😀😀")]


def test_what_is_pasted_is_cut_where_the_field_is_full(booth: Booth) -> None:
    booth.ask(text(longest=4))
    booth.click("text-remark")
    UiDriver(booth.app.window).type("ab")
    booth.press(Qt.Key.Key_Left)
    QGuiApplication.clipboard().setText("😀😀😀")
    booth.press(Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
    assert contents(booth, "text-remark") == "a😀😀b"


@pytest.mark.parametrize("last", ["é", "e\N{COMBINING ACUTE ACCENT}", "😀", "\N{WOMAN}\N{ZERO WIDTH JOINER}\N{GIRL}"])
def test_the_delete_key_on_the_screen_takes_what_looks_like_one_character(booth: Booth, last: str) -> None:
    booth.ask(text())
    booth.click("text-remark")
    UiDriver(booth.app.window).type(f"so {last}")
    booth.click("key-delete")
    assert contents(booth, "text-remark") == "so "


# Numbers


def enter_by_key(booth: Booth, number: int) -> None:
    """Type a number on a keyboard."""
    booth.click("number-n")
    UiDriver(booth.app.window).type(str(number))
    booth.press(Qt.Key.Key_Return)


def enter_on_screen(booth: Booth, number: int) -> None:
    """Type a number with the keys on the screen."""
    booth.click("number-n")
    for key in str(number):
        booth.click(f"key-{key}")
    booth.click("key-done")


@pytest.mark.parametrize("enter", [enter_by_key, enter_on_screen])
@pytest.mark.parametrize(
    ("ends", "number"),
    [((-10, 5), -10), ((-10, 5), -3), ((-10, 5), 5), ((-20, -10), -15), ((-1_000_000, 1), -999_999), ((0, 12), 12)],
)
def test_every_number_that_is_allowed_can_be_typed(
    booth: Booth, given: Given, enter: Callable[[Booth, int], None], ends: tuple[int, int], number: int
) -> None:
    booth.ask(whole_number(*ends))
    enter(booth, number)
    assert given == [("n", number)]
    assert contents(booth, "number-n") == str(number)


def test_a_numbers_keys_come_and_go_without_a_binding_loop_where_letters_have_long_rows(
    qtbot: QtBot, qtlog: Any, tmp_path: Path
) -> None:
    study_in(tmp_path, NUMBER.replace("-10", "0").replace("-2", "120"))
    shutil.copytree(ASSETS / "sentences" / "en", tmp_path / "en")
    (tmp_path / "en" / "keys.ftl").write_text("keyboard-rows =\n    qwertzuiopü\n    asdfghjklöä\n", "utf-8")
    study = (tmp_path / "study.toml").read_text("utf-8")
    (tmp_path / "study.toml").write_text(study.replace('["en"]', '["./en"]'), "utf-8")
    with at_work(Settings.read(tmp_path / "study.toml"), tmp_path / "data", qtbot) as booth:
        booth.click("start-en")
        assert max(map(len, booth.app.screens.form.property("keys")["letters"])) > 10
        enter_on_screen(booth, 5)
        booth.click("number-n")
    assert [record.message for record in qtlog.records if "Binding loop" in record.message] == []


def test_the_buttons_step_from_nothing_and_through_zero(booth: Booth, given: Given) -> None:
    booth.ask(whole_number(-2, 2))
    for _ in range(5):
        booth.click("more-n")
    for _ in range(2):
        booth.click("less-n")
    assert [value for _, value in given] == [-2, -1, 0, 1, 2, 1, 0]
    booth.ask(whole_number(-10, 5))
    booth.click("less-n")
    assert given[-1] == ("n", 5)


def test_the_arrows_of_the_keyboard_step_as_the_buttons_do(booth: Booth, given: Given) -> None:
    booth.ask(whole_number(-10, 5))
    booth.click("number-n")
    for key in (Qt.Key.Key_Up, Qt.Key.Key_Up, Qt.Key.Key_Down):
        booth.press(key)
    assert [value for _, value in given] == [-10, -9, -10]


def test_the_minus_key_on_the_screen_turns_a_number_round_and_back(booth: Booth, given: Given) -> None:
    booth.ask(whole_number(-10, 5))
    booth.click("number-n")
    for key, shown in (("3", "3"), ("-", "-3"), ("-", "3"), ("-", "-3")):
        booth.click(f"key-{key}")
        assert contents(booth, "number-n") == shown
    booth.click("key-done")
    assert given == [("n", -3)]


def test_there_is_a_minus_key_only_where_a_number_may_be_negative(booth: Booth) -> None:
    for lowest, there in ((-1, True), (0, False)):
        booth.ask(whole_number(lowest, 5))
        booth.click("number-n")
        assert booth.sees("key--") is there


@pytest.mark.parametrize("typed", ["-", "7", "-11", "--3", "3-"])
def test_what_is_no_number_that_is_allowed_is_not_answered(booth: Booth, given: Given, typed: str) -> None:
    booth.ask(whole_number(-10, -5))
    booth.click("number-n")
    UiDriver(booth.app.window).type(typed)
    booth.click("continue")
    assert ("n", -3) not in given
    assert booth.app.screens.form.property("missing") == ["n"]


@pytest.mark.parametrize(("typed", "number"), [("٣", 3), ("३", 3), ("\N{MINUS SIGN}3", -3), ("-٣", -3)])
def test_digits_and_signs_of_other_scripts_are_taken(booth: Booth, given: Given, typed: str, number: int) -> None:
    booth.ask(whole_number(-10, 5))
    booth.click("number-n")
    UiDriver(booth.app.window).type(typed)
    assert contents(booth, "number-n") == typed
    booth.click("continue")
    assert given == [("n", number)]


@pytest.mark.parametrize("ends", [(-999_999_999, 5), (0, 999_999_999), (0, 9)])
def test_the_field_is_as_wide_as_its_longest_number(booth: Booth, ends: tuple[int, int]) -> None:
    booth.ask(whole_number(*ends))
    number = max(map(str, ends), key=len)
    booth.click("number-n")
    UiDriver(booth.app.window).type(number)
    field = booth.item("number-n")
    assert contents(booth, "number-n") == number
    needed = QFontMetricsF(field.property("font")).horizontalAdvance(number)
    assert field.width() >= needed + float(field.property("leftPadding")) + float(field.property("rightPadding"))


# To the record, and out of it again

FORM = """
id = "about-you"
version = "1"
note = "Made for a test."
per_page = 8
"""


def study_in(folder: Path, items: str) -> Settings:
    """Return a study that asks these items first."""
    (folder / "form.toml").write_text(FORM + items, "utf-8")
    study = 'languages = ["en"]\nabout_you = "form.toml"\nstages = ["about_you", "game", "thanks"]\n'
    (folder / "study.toml").write_text(
        study + "[randomisation]\ntarget_n = {}\n[game]\nrows = 1\ncolumns = 2\n", "utf-8"
    )
    return Settings.read(folder / "study.toml")


TEXTS = "".join(f'[[items]]\nid = "t{at}"\nkind = "text"\ntext.en = "Remarks?"\n' for at in range(len(EXACTLY)))
NUMBER = '[[items]]\nid = "n"\nkind = "integer"\nlowest = -10\nhighest = -2\nrequired = true\ntext.en = "How many?"\n'
RATED = (
    '[[items]]\nid = "line"\nkind = "slider"\nlowest = -50\nhighest = 50\nrequired = true\n'
    'text.en = "How much?"\nleft.en = "little"\nright.en = "much"\n'
)


@contextmanager
def at_work(settings: Settings, data: Path, qtbot: QtBot) -> Iterator[Booth]:
    """Provide a booth with this study, which is closed at the end."""
    with headless(settings, data, mode=HALF) as app:
        qtbot.waitUntil(lambda: app.window.isExposed() and app.window.isActive())
        yield Booth(app, data)


def test_what_was_typed_is_recorded_replayed_and_exported_exactly(qtbot: QtBot, tmp_path: Path) -> None:
    data = tmp_path / "data"
    with at_work(study_in(tmp_path, TEXTS + NUMBER), data, qtbot) as booth:
        booth.click("start-en")
        for at, typed in enumerate(EXACTLY):
            booth.app.screens.form.draft(f"t{at}", typed)
        booth.app.screens.form.draft("n", "-3")
        booth.app.screens.form.proceed()
        assert booth.app.runner.stage is Stage.GAME
    expected: dict[str, Answer | None] = {f"t{at}": typed for at, typed in enumerate(EXACTLY)} | {"n": -3}
    with open_repository(data) as stored:
        (session,) = stored.sessions()
        events, plan, seed = stored.events(session.id), stored.plan(session.id), stored.seed(session.id)
    assert {e.item: e.value for e in events if isinstance(e, happened.ResponseGiven)} == expected
    export_dataset(
        data, tmp_path / "out", PsychDs, frozenset({ExportOption.TEXTS, ExportOption.REHEARSALS, ExportOption.UNSHARED})
    )
    rows = {row["item"]: row["value"] for row in rows_of(tmp_path / "out", "answers")}
    assert {item: rows[item] for item in expected} == {item: str(value) for item, value in expected.items()}
    steps = replay_events(plan, seed, events)
    with Replay(RunMode(WindowMode.NOWHERE, ClockMode.WALL, 32), plan, steps, "Session 1") as replay:
        last = max(at for at, step in enumerate(steps) if isinstance(step.event, happened.ResponseGiven))
        replay.player.go_to(last + 1)
        seen = Booth(replay_app(replay), data)
        fields = {item: f"{'number' if item == 'n' else 'text'}-{item}" for item in expected}
        assert {item: contents(seen, field) for item, field in fields.items()} == {
            item: str(value) for item, value in expected.items()
        }


def replay_app(replay: Replay) -> App:
    """Return the replay, where a test looks for the window and the screens of a kiosk."""
    return replay  # type: ignore[return-value]  # both have a window and screens, and no more is asked of them


def test_simulated_visitors_answer_what_can_only_be_negative(qtbot: QtBot, tmp_path: Path) -> None:
    seeds = range(4)
    with at_work(study_in(tmp_path, NUMBER + RATED), tmp_path / "data", qtbot) as booth:
        for seed in seeds:
            booth.rehearse(seed)
        with open_repository(booth.data) as stored:
            answers = [
                {e.item: e.value for e in stored.events(session.id) if isinstance(e, happened.ResponseGiven)}
                for session in stored.sessions()
            ]
    assert len(answers) == len(seeds)
    for given in answers:
        assert isinstance(given["n"], int)
        assert isinstance(given["line"], int)
        assert -10 <= given["n"] <= -2
        assert -50 <= given["line"] <= 50
