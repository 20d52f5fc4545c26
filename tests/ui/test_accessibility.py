"""Every screen is accessible, the experimenter's too.

What the hands and the ears of visitors need besides is in ``test_without_a_mouse`` and ``test_told_and_seen``.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest
from PySide6.QtCore import QObject
from PySide6.QtGui import QAccessible
from PySide6.QtQuick import QQuickWindow
from pytestqt.qtbot import QtBot

from kiosk.config import Settings
from kiosk.study.loader import read_study
from kiosk.ui.replay import Replay
from kiosk.ui.simulated_visitor import lay_out
from kiosk.ui.window import ClockMode, RunMode, WindowMode
from tests.ui.conftest import MakeBooth
from tests.ui.headless import headless
from tests.ui.looking import LEAST_CHANGE, colours, contrast, described, items, place, texts
from tests.ui.sights import Sight, look
from tests.ui.test_told_and_seen import told
from tests.ui.touring import open_panel, tour, whole_study

pytestmark = pytest.mark.usefixtures("spoken")

LEAST_CONTRAST = {"normal": 4.5, "high": 7.0}
LEAST_PIXELS = 24
LEAST_PIXELS_FOR_EXPERIMENTERS = 20
KINDS = {"page", "likert", "differential", "slider", "pictures", "single", "multiple", "integer", "text"}


@dataclass(frozen=True)
class Style:
    """One of the ways in which the screens can look."""

    language: str
    palette: str
    board: str
    text_size: float

    @property
    def settings(self) -> Settings:
        """The whole study, looking so."""
        return whole_study(self.language, contrast=self.palette, board_side=self.board, text_size=self.text_size)


@dataclass(frozen=True)
class Toured:
    """A tour in one style."""

    style: Style
    sights: tuple[Sight, ...]


STYLES = [Style("en", "normal", "left", 1.0), Style("it", "high", "right", 1.3), Style("es", "normal", "right", 0.5)]


@pytest.fixture(scope="module", params=STYLES, ids=lambda style: f"{style.language}-{style.palette}-{style.board}")
def toured(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Toured:
    """Everything there is to be seen, in one of the styles: all of them together have every setting and language."""
    request.getfixturevalue("spoken")
    style: Style = request.param
    sights: list[Sight] = []
    with headless(style.settings, tmp_path_factory.mktemp("tour")) as app:
        app.window.resize(1920, 1080)
        tour(app, lambda moment: sights.append(look(app.window, moment, style.board)))
    return Toured(style, tuple(sights))


def test_the_tour_comes_to_every_screen_and_every_kind_of_item(toured: Toured) -> None:
    moments = {sight.moment for sight in toured.sights}
    screens = {"attract", "about", "consent", "consent, missing", "age", "introduction", "practice", "game"}
    screens |= {"result", "debrief", "thanks", "still there", "pause", "panel", "note", "card: pin", "card: wait"}
    assert moments >= screens
    told = " ".join(moment for moment in moments if moment.startswith("form:"))
    assert {kind for kind in KINDS if kind in told} == KINDS
    assert "missing" in told
    assert "keys" in told


def test_every_control_has_a_role_and_a_name_and_every_text_is_told(toured: Toured) -> None:
    assert {sight.moment: sight.untold for sight in toured.sights if sight.untold} == {}


def test_every_text_stands_out_from_what_it_is_written_on(toured: Toured) -> None:
    least = LEAST_CONTRAST[toured.style.palette]
    assert all(sight.written for sight in toured.sights)
    faint = {
        (s.moment, each.words, each.contrast) for s in toured.sights for each in s.written if each.contrast < least
    }
    assert faint == set()


def test_no_text_is_smaller_than_24_pixels_of_1080_lines_and_none_of_the_experimenter_s_than_20(toured: Toured) -> None:
    small = {
        (sight.moment, each.words, each.pixels)
        for sight in toured.sights
        for each in sight.written
        if each.pixels < (LEAST_PIXELS_FOR_EXPERIMENTERS if each.for_experimenters else LEAST_PIXELS)
    }
    assert small == set()


def test_no_bar_that_scrolls_lies_on_a_text(toured: Toured) -> None:
    assert {sight.moment: sight.covered for sight in toured.sights if sight.covered} == {}


def test_every_screen_is_on_the_side_that_was_chosen_and_the_assistant_on_the_other(toured: Toured) -> None:
    # A form that rates the assistant has the window to itself.
    beside = [sight for sight in toured.sights if not sight.moment.startswith("form")]
    assert {sight.moment: sight.strayed for sight in beside if sight.strayed} == {}


@pytest.mark.parametrize(
    ("palette", "text", "paper"),
    [
        (p, *pair)
        for p in LEAST_CONTRAST
        for pair in [
            ("white", "lightSea"),
            ("ink", "sand"),
            ("ink", "touchable"),
            ("ink", "resting"),
            ("faintInk", "touchable"),
            ("faintInk", "resting"),
            ("sea", "touchable"),
            ("deepAmber", "touchable"),
            ("white", "sea"),
            ("sea", "paper"),
            ("faintInk", "shelf"),
        ]
    ],
)
def test_what_is_under_the_mouse_or_switched_on_or_off_stands_out_as_well(palette: str, text: str, paper: str) -> None:
    theme = colours(palette)
    assert contrast(theme[text], theme[paper]) >= LEAST_CONTRAST[palette]


@pytest.mark.parametrize("palette", LEAST_CONTRAST)
def test_the_edge_of_a_quiet_button_is_paler_than_its_words_and_is_seen_all_the_same(palette: str) -> None:
    theme = colours(palette)
    assert LEAST_CHANGE <= contrast(theme["shy"], theme["paper"]) <= contrast(theme["sea"], theme["paper"])


def test_high_contrast_knows_no_pale_tint_and_nothing_that_steps_back() -> None:
    theme = colours("high")
    # What is neither written on nor the paper itself stands out from the paper.
    for name in ("ink", "faintInk", "sea", "shy", "slot", "lightSea", "deepAmber", "edge"):
        assert contrast(theme[name], theme["paper"]) >= LEAST_CONTRAST["high"], name
    assert theme["done"] == theme["held"] == 1


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1080, 1920)])
def test_what_is_said_covers_no_button(make_booth: MakeBooth, qtbot: QtBot, side: str, width: int, height: int) -> None:
    booth = make_booth(settings=whole_study(board_side=side))
    window = booth.app.window
    window.resize(width, height)
    qtbot.waitUntil(lambda: window.contentItem().width() == width)
    booth.app.screens.avatar.say("Hello!")
    lay_out(window)
    (bubble,) = [text for text in texts(window.contentItem()) if text.property("text") == "Hello!"]
    said = place(bubble)
    assert said.left() >= 0
    assert said.right() < width
    for language in booth.app.screens.attract.property("ways"):
        assert not said.intersects(place(booth.item(f"start-{language['language']}")))


@pytest.mark.parametrize(("side", "left", "right"), [("left", -1.0, -0.5), ("right", 0.5, 1.0)])
def test_the_avatar_looks_where_the_board_is(make_booth: MakeBooth, side: str, left: float, right: float) -> None:
    app = make_booth(settings=whole_study(board_side=side)).app
    body = app.embodiments.current
    assert body is not None
    app.screens.board.deal(4, 6, 12, "animals")
    for column, where in ((0, left), (5, right)):
        body.look_at(app.screens.board.place(None, column))
        assert app.screens.avatar.property("gazeX") == pytest.approx(where, abs=0.05)


@pytest.mark.parametrize("language", ["en", "it", "es"])
@pytest.mark.parametrize("palette", ["normal", "high"])
def test_the_bar_of_a_replay_is_told_and_read_as_well(qtbot: QtBot, palette: str, language: str) -> None:
    settings = whole_study(contrast=palette)
    plan = next(plan for plan in read_study(settings).plans if plan.language == language)
    with Replay(RunMode(WindowMode.NOWHERE), plan, (), "Session 1") as replay:
        qtbot.waitUntil(replay.window.isExposed)
        lay_out(replay.window)
        sight = look(replay.window, "replay", "left")
        (line,) = [item for item in items(replay.window.contentItem()) if item.objectName() == "replay-line"]
        assert described(line) == (QAccessible.Role.Slider, plan.catalogue.text("replay-line"))
    assert sight.untold == ()
    in_the_bar = [each for each in sight.written if each.for_experimenters]
    assert len(in_the_bar) > 3
    assert min(each.contrast for each in in_the_bar) >= LEAST_CONTRAST[palette]
    assert min(each.pixels for each in in_the_bar) >= LEAST_PIXELS_FOR_EXPERIMENTERS


def test_the_panel_tells_which_choice_holds(make_booth: MakeBooth) -> None:
    booth = make_booth(settings=whole_study())
    booth.click("start-en")
    keyboard = open_panel(booth.app)
    keyboard.click("panel-next")
    keyboard.click("volume-0.4")
    assert told(booth, "volume-0.4").role() is QAccessible.Role.RadioButton
    assert [bool(told(booth, f"volume-{each}").state().checked) for each in ("0.2", "0.4", "0.6")] == [
        False,
        True,
        False,
    ]


def longest_move(window: QQuickWindow) -> int:
    """How long whatever moves longest in a window takes, in ms."""
    moves = [found for found in window.findChildren(QObject) if found.inherits("QQuickPropertyAnimation")]
    assert moves
    return max(int(found.property("duration")) for found in moves)


@pytest.mark.parametrize(("motion", "moves"), [(False, False), (True, True)])
def test_without_motion_nothing_moves(tmp_path: Path, *, motion: bool, moves: bool) -> None:
    with headless(whole_study(motion=motion), tmp_path, mode=RunMode(WindowMode.NOWHERE, ClockMode.WALL)) as app:
        lay_out(app.window)
        assert (longest_move(app.window) > 0) is moves
        before = app.window.grabWindow()
        # A voice is heard; the face is seen.
        app.screens.avatar.open_mouth(1.0)
        assert (app.window.grabWindow() != before) is moves
        # No visitor is there, and nothing goes on by itself.
        assert hasattr(app, "_life") is moves
