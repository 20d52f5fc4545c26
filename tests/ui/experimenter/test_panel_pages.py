"""The panel's pages on a busy day: no word is broken, no number wraps, and rows stand equally far apart.

All have large letters, and need no scrolling during a session. The first tells the state largest.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from itertools import pairwise, product
from typing import Any

import pytest
from PySide6.QtCore import QCoreApplication, QPointF, QRectF, Qt
from PySide6.QtGui import QAccessible, QFont, QFontMetricsF, QGuiApplication
from PySide6.QtQml import QQmlProperty
from PySide6.QtQuick import QQuickItem
from PySide6.QtTest import QTest

from kiosk.config import Settings
from kiosk.experiment.experimenter import shortcuts
from kiosk.study.loader import read_study
from kiosk.ui.experimenter.health import HealthLine
from kiosk.ui.experimenter.panel import WORDS
from kiosk.ui.experimenter.panel_rows import shortcut_rows
from kiosk.ui.experimenter.view_model import Row
from kiosk.ui.simulated_visitor import find_item, lay_out
from kiosk.ui.window import Window
from tests.samples import CATALOGUES
from tests.ui.headless import free, open_window
from tests.ui.looking import background, items, lies_in, of_kind, painted, place, texts

WIDE, UPRIGHT = (1920, 1080), (1080, 1920)
ROUNDED = 3
"""So many pixels are lost where lengths are rounded."""
LAYOUTS = [WIDE, UPRIGHT, (1280, 800), (1366, 768)]


def in_turn(*lists: Sequence[object]) -> list[tuple[object, ...]]:
    """Combine these values; each combination is in one language, and the languages take turns.

    The last of them change least often: they are sizes, and a window of a new size is laid out anew.
    """
    languages = sorted(CATALOGUES)
    places = sorted(product(*(range(len(values)) for values in lists)), key=lambda place: place[-1])
    return [
        (*(values[place] for values, place in zip(lists, each, strict=True)), languages[sum(each) % len(languages)])
        for each in places
    ]


@pytest.fixture(scope="module")
def window(qapp: QGuiApplication) -> Iterator[Window]:  # noqa: ARG001 - Qt is to be there
    """Open a window with no kiosk behind it, and no page of a visitor, which would be laid out in each size."""
    with open_window(read_study(Settings())) as opened:
        opened.screens.kiosk.show("")
        yield opened


def show(
    window: Window, language: str, size: tuple[int, int], text_size: float = 1.0, page: int = 0, **parts: Row
) -> None:
    """Show a page of the panel on a busy day, with other ``parts`` where they are given."""
    panel = window.screens.experimenter.parts[2]
    panel.open(is_open=False)
    free()
    window.shown.setProperty("textSize", text_size)
    window.shown.resize(*size)
    # An open panel would be laid out and painted in the size before, too.
    QCoreApplication.processEvents()
    told = CATALOGUES[language].text
    panel.set_language({name: told(name) for name in WORDS})
    shown = busy_day(language) | parts
    panel.show_health(shown["health"])
    panel.show_today(shown["today"])
    panel.show_records(shown["records"])
    panel.show_choices(shown["choices"])
    panel.open(is_open=True)
    turn_to(window, page)
    QCoreApplication.processEvents()
    lay_out(window.shown)
    assert (window.shown.contentItem().width(), window.shown.contentItem().height()) == size


def turn_to(window: Window, page: int) -> None:
    """Show this page of the panel, from 0."""
    view = find_item(window.shown.contentItem(), "panel")
    assert view is not None
    view.setProperty("page", page)


def busy_day(language: str) -> dict[str, Any]:
    """Return what the panel shows: two warnings, four checks, a list with a target, and a session under way."""
    told = CATALOGUES[language].text
    pin = HealthLine(
        "PIN",
        told("console-pin-none"),
        is_ok=False,
        remedy=told("console-pin-remedy"),
        command="recollect study set-pin",
        button=told("console-pin-how"),
    )
    supervisor = HealthLine(
        told("console-supervisor"),
        told("console-supervisor-none"),
        is_ok=False,
        remedy=told("console-supervisor-remedy"),
        command="recollect run --supervise",
        button=told("console-supervisor-how"),
    )
    checks = (
        HealthLine(told("console-robot"), told("console-robot-absent"), is_used=False),
        HealthLine(told("console-voice"), "simulated", is_used=False),
        HealthLine(told("console-disk"), told("console-disk-free", free="75.4 GiB")),
        HealthLine(told("console-clock"), told("console-clock-well")),
    )
    tiles = (
        ("stage", told("console-stage-game"), told("console-today-minutes", minutes=3)),
        ("visitors", "14", told("console-today-early", early=2)),
        ("completed", "11", told("console-today-hour", done=3)),
        ("target", "23 / 60", told("console-today-forecast", hours="6")),
    )
    session: Row = {"when": "09:51", "condition": told("console-hidden"), "reason": "", "robot": ""}
    under_way: Row = {"stage": told("console-stage-game"), "status": told("console-status-running")}
    stopped: Row = {"stage": told("console-stage-about-you"), "status": told("console-status-stopped")}
    return {
        "health": {
            "matters": [asdict(pin), asdict(supervisor)],
            "lines": [asdict(line) for line in checks],
            "more": [],
        },
        "today": {
            "clock": "09:52",
            "tiles": [
                {"name": name, "title": told(f"console-today-{name}"), "value": value, "line": line}
                for name, value, line in tiles
            ],
        },
        "records": {
            "listed": True,
            "cells": [
                {"name": name, "listed": True, "done": "12 / 30", "share": 0.4, "counts": ["1", "0", "2", "0"]}
                for name in ("A", "B")
            ],
            "visits": told("console-visits", declined=2, under_age=1, left=3),
            "sessions": [
                session | under_way | {"participant": "24", "odd": False, "under_way": True},
                session
                | stopped
                | {"participant": "23", "odd": True, "under_way": False, "reason": told("console-reason-technical")},
            ],
            "deviations": [],
            "more": "",
            "resumable": [],
        },
        "choices": {
            **{name: [] for name in ("conditions", "embodiments", "languages", "volumes")},
            **dict.fromkeys(("condition", "embodiment", "language", "volume", "break", "backup"), ""),
            **dict.fromkeys(("canBeNext", "muted", "named", "staysPaused", "onBreak"), False),
            "underWay": True,
            "back": told("console-back", stage="game"),
            "breaks": [{"value": "5", "label": told("console-break-minutes", minutes=5)}],
        },
    }


def words_of(item: QQuickItem) -> str:
    """Return what a text says."""
    return str(item.property("text"))


def is_broken(text: QQuickItem) -> bool:
    """Whether a word of it needs more room than the text has."""
    font = text.property("font")
    assert isinstance(font, QFont)
    letters = QFontMetricsF(font)
    return any(letters.horizontalAdvance(word) > text.width() + 1 for word in words_of(text).split(" "))


@pytest.mark.parametrize("language", sorted(CATALOGUES))
@pytest.mark.parametrize("text_size", [1.0, 1.15, 1.3])
@pytest.mark.parametrize("size", LAYOUTS)
def test_no_word_of_a_table_is_broken(window: Window, language: str, text_size: float, size: tuple[int, int]) -> None:
    show(window, language, size, text_size, page=1)
    cells = [text for text in texts(window.shown.contentItem()) if lies_in(text, "PanelCell")]
    assert len(cells) >= 6 + 5 + 2 * 6 + 2 * 5 - 1
    assert [words_of(cell) for cell in cells if is_broken(cell)] == []


@pytest.mark.parametrize("language", sorted(CATALOGUES))
@pytest.mark.parametrize("size", LAYOUTS)
def test_the_numbers_of_the_day_stay_in_one_line(window: Window, language: str, size: tuple[int, int]) -> None:
    show(window, language, size)
    found = [find_item(window.shown.contentItem(), f"today-{name}") for name in ("visitors", "completed", "target")]
    values = {words_of(text): text.property("lineCount") for tile in found if tile for text in texts(tile)}
    assert {value: values.get(value) for value in ("14", "11", "23 / 60")} == {"14": 1, "11": 1, "23 / 60": 1}


def test_columns_stand_equally_far_apart_and_fill_the_card(window: Window) -> None:
    unlisted = busy_day("en")["records"]
    unlisted = unlisted | {
        "listed": False,
        "cells": [cell | {"listed": False, "done": "1"} for cell in unlisted["cells"]],
    }
    unlisted["sessions"] = unlisted["sessions"][:1]
    show(window, "en", UPRIGHT, page=1, records=unlisted)
    columns: dict[int, float] = {}
    for cell in of_kind(window.shown.contentItem(), "PanelCell"):
        start = round(cell.mapToScene(QPointF()).x())
        columns[start] = max(columns.get(start, 0), cell.property("contentWidth"))
    (table,) = of_kind(window.shown.contentItem(), "PanelSessions")
    edge = table.mapToScene(QPointF()).x() + table.width() - table.property("inset")
    # Not the first, which in one table alone begins behind a mark.
    starts = sorted(columns)[2:]
    assert len(starts) == 4
    steps = [after - before - columns[before] for before, after in pairwise(starts)]
    assert max(steps) - min(steps) <= ROUNDED
    assert edge - starts[-1] - columns[starts[-1]] == pytest.approx(0, abs=2 * ROUNDED)


@pytest.mark.parametrize("size", [WIDE, UPRIGHT])
def test_the_panel_stays_as_it_is_while_the_visitors_language_is_written_from_right_to_left(
    window: Window, size: tuple[int, int]
) -> None:
    places = []
    for language in ("ar", "en"):
        window.screens.kiosk.begin((language,), language, Settings().consent)
        assert window.screens.kiosk.property("mirrored") is (language == "ar")
        show(window, "en", size)
        (panel,) = of_kind(window.shown.contentItem(), "PanelView")
        places.append([(each.mapToScene(QPointF()), each.width()) for each in items(panel)])
    assert places[0] == places[1]


@pytest.mark.parametrize(("size", "language"), in_turn(LAYOUTS))
def test_the_way_back_is_filled_alone_has_the_keyboard_and_stands_with_the_state(
    window: Window, language: str, size: tuple[int, int]
) -> None:
    show(window, language, size, health=with_the_copy(language))
    root = window.shown.contentItem()
    back = find_item(root, "panel-back")
    assert back is not None
    assert back.property("activeFocus")
    assert not [item for item in of_kind(root, "FocusRing") if lies_in(item, "PanelView")]
    (today,) = of_kind(root, "PanelToday")
    buttons = [item for item in items(today) if item.property("solid") is not None]
    assert [item.objectName() for item in buttons if item.property("solid")] == ["panel-back"]
    assert lies_in(back, "PanelNow")
    assert words_of(sole(texts(back))) == CATALOGUES[language].text("console-back", stage="game")
    QTest.keyClick(window.shown, Qt.Key.Key_Tab)
    QTest.keyClick(window.shown, Qt.Key.Key_Backtab)
    assert back.property("activeFocus")
    sole(item for item in of_kind(root, "FocusRing") if lies_in(item, "PanelView"))


def sole(found: Iterable[QQuickItem]) -> QQuickItem:
    """Return the one item that was found."""
    (item,) = found
    return item


@pytest.mark.parametrize("main", ["action-next", "break-end"])
@pytest.mark.parametrize("size", [WIDE, UPRIGHT])
def test_what_is_pressed_next_is_filled_in_place_of_the_way_back(
    window: Window, size: tuple[int, int], main: str
) -> None:
    choices = calm_day("en")["choices"] | {"canBeNext": main == "action-next", "onBreak": main == "break-end"}
    show(window, "en", size, choices=choices)
    (now,) = of_kind(window.shown.contentItem(), "PanelNow")
    solid = {item.objectName(): item.property("solid") for item in items(now) if item.property("solid") is not None}
    assert solid == {main: True, "panel-back": False}


def calm_day(language: str) -> dict[str, Any]:
    """Return what the panel shows of a day without a list, a target or a visitor, on which all is well."""
    busy = busy_day(language)
    cell = {"name": "A", "listed": False, "done": "1", "share": 0, "counts": ["0", "0", "0", "0"]}
    return {
        "health": busy["health"] | {"matters": []},
        "today": busy["today"] | {"tiles": busy["today"]["tiles"][:3]},
        "records": busy["records"] | {"listed": False, "cells": [cell], "sessions": busy["records"]["sessions"][:1]},
        "choices": busy["choices"]
        | {"underWay": False, "back": CATALOGUES[language].text("console-back", stage="attract")},
    }


@pytest.mark.parametrize(("text_size", "size", "language"), in_turn([1.0, 1.3], [*LAYOUTS, (800, 1280)]))
def test_names_of_pages_are_large_and_clear_of_the_clock(
    window: Window, language: str, text_size: float, size: tuple[int, int]
) -> None:
    show(window, language, size, text_size)
    root = window.shown.contentItem()
    tabs = [find_item(root, name) for name in ("panel-today", "panel-sessions", "panel-next")]
    clock, title = find_item(root, "today-clock"), CATALOGUES[language].text("console-title")
    assert clock is not None
    for tab in tabs:
        assert tab is not None
        assert tab.mapToScene(QPointF(tab.width(), 0)).x() < clock.mapToScene(QPointF()).x()
        if size[0] > size[1] and text_size == 1:
            assert tab.property("font").pixelSize() >= int(34 * size[0] / 1920)
            assert [text for text in texts(root) if words_of(text) == title and text.isVisible()]


def test_a_single_row_is_not_spread_over_a_broad_card(window: Window) -> None:
    widths = []
    for many in (1, 3):
        calm, busy = calm_day("en"), busy_day("en")
        sessions = busy["records"]["sessions"][:1] * many
        show(window, "en", WIDE, page=1, **calm | {"records": calm["records"] | {"sessions": sessions}})
        (table,) = of_kind(window.shown.contentItem(), "PanelSessions")
        cells = [item for item in of_kind(table, "PanelCell") if item.isVisible()]
        widths.append(max(cell.mapToItem(table, QPointF()).x() + cell.property("implicitWidth") for cell in cells))
        assert widths[0] <= table.property("inset") + 1000 + ROUNDED
    assert widths[1] > widths[0] + 100


@pytest.mark.parametrize("language", sorted(CATALOGUES))
@pytest.mark.parametrize("matters", [0, 1, 2])
def test_an_upright_page_with_the_next_visitor_to_call_needs_no_scrolling(
    window: Window, language: str, matters: int
) -> None:
    busy = busy_day(language)
    health = busy["health"] | {"matters": busy["health"]["matters"][:matters]}
    choices = busy["choices"] | {
        "underWay": False,
        "back": CATALOGUES[language].text("console-back", stage="attract"),
        "canBeNext": True,
    }
    show(window, language, UPRIGHT, health=health, choices=choices)
    (today,) = of_kind(window.shown.contentItem(), "PanelToday")
    assert today.height() <= today.property("seen")


@pytest.mark.parametrize(("size", "language"), in_turn(LAYOUTS))
def test_a_page_with_a_session_to_go_on_with_needs_no_scrolling(
    window: Window, language: str, size: tuple[int, int]
) -> None:
    busy = busy_day(language)
    cut_off = {"number": "7", "label": f"21 · 09:31 · {CATALOGUES[language].text('console-stage-game')}"}
    records = busy["records"] | {"resumable": [cut_off]}
    show(window, language, size, **calm_day(language) | {"records": records})
    assert find_item(window.shown.contentItem(), "resume-7") is not None
    (today,) = of_kind(window.shown.contentItem(), "PanelToday")
    assert today.height() <= today.property("seen")


@pytest.mark.parametrize(("matters", "size", "language"), in_turn([0, 1, 2], LAYOUTS))
def test_a_page_with_an_alarm_needs_no_scrolling(
    window: Window, language: str, size: tuple[int, int], matters: int
) -> None:
    panel = window.screens.experimenter.parts[2]
    panel.show_alarms(
        [{"when": "09:40", "words": CATALOGUES[language].text("console-alarm-robot-lost"), "holds": True}]
    )
    health = with_the_copy(language)
    show(window, language, size, health=health | {"matters": health["matters"][:matters]})
    (today,) = of_kind(window.shown.contentItem(), "PanelToday")
    assert of_kind(today, "PanelAlarms")
    fits = today.height() <= today.property("seen")
    panel.show_alarms([])
    assert fits


def level(item: QQuickItem) -> float:
    """Return how far below the top of the window it begins."""
    return item.mapToScene(QPointF()).y()


def third_page(language: str, *, robot: bool, deviations: int) -> dict[str, Any]:
    """Return what the last two pages show of a study with two conditions and three languages."""
    busy, told = busy_day(language), CATALOGUES[language].text

    def labelled(*labels: str) -> list[dict[str, str]]:
        return [{"value": label, "label": label} for label in labels]

    lines = (
        HealthLine(told("console-policy"), "tom-2 · 3f2a91c0"),
        HealthLine(told("console-study"), "A memory game · 5a0c1b22"),
        HealthLine(told("console-screen"), "1920 x 1080, 60 Hz, 100 %"),
        HealthLine(told("console-remote"), told("console-remote-there")),
    )
    noted = {
        "when": "09:12",
        "words": told("console-note-session-aborted", what=told("console-stage-game")),
        "reason": told("console-reason-technical"),
    }
    return {
        "health": busy["health"] | {"more": [asdict(line) for line in lines]},
        "choices": busy["choices"]
        | {
            "conditions": labelled(told("console-automatic"), "A", "B"),
            "embodiments": labelled(told("console-robot"), told("console-avatar")) if robot else [],
            "languages": labelled("English", "Español", "Italiano"),
            "volumes": labelled("20 %", "40 %", "60 %", "80 %", "100 %"),
            "volume": "80 %",
        },
        "records": busy["records"]
        | {
            "deviations": [noted] * deviations,
            "more": told("console-deviations-more", number=3) if deviations > 4 else "",
        },
    }


def at_rest(language: str) -> dict[str, Any]:
    """Return what can be chosen between visitors: then the commands to type are offered."""
    back = CATALOGUES[language].text("console-back", stage="attract")
    return dict(busy_day(language)["choices"] | {"underWay": False, "back": back})


COPY_MISSING = "console-backup-none"


def with_the_copy(language: str) -> dict[str, Any]:
    """Return the health of a busy day on which a copy is to be made, too."""
    told, health = CATALOGUES[language].text, busy_day(language)["health"]
    name, remedy, button = told("console-database"), told("console-backup-none-remedy"), told("console-backup")
    copy = HealthLine(name, told(COPY_MISSING), remedy=remedy, action="backup", button=button, is_due=True)
    return dict(health | {"matters": [*health["matters"], asdict(copy)]})


def asking(window: Window) -> list[QQuickItem]:
    """Return the buttons that show a command, from above."""
    found = [item for item in items(window.shown.contentItem()) if item.objectName().startswith("how-recollect ")]
    return sorted((item for item in found if item.isVisible()), key=level)


def press(button: QQuickItem) -> None:
    """Press a button, and wait until what it changes is laid out."""
    button.metaObject().invokeMethod(button, "click")
    QCoreApplication.processEvents()


def turn_answers(window: Window) -> None:
    """Press each button that shows a command."""
    for button in asking(window):
        press(button)
    lay_out(window.shown)


def letters_of(text: QQuickItem) -> int:
    """Return how large a text is written, in pixels."""
    font = text.property("font")
    assert isinstance(font, QFont)
    return font.pixelSize()


def unit_of(size: tuple[int, int]) -> float:
    """Return how many pixels of a window are one of a screen of 1080 lines."""
    return min(min(size) / 1080, max(size) / 1920)


@pytest.mark.parametrize(("listed", "size", "language"), in_turn([False, True], LAYOUTS))
def test_the_pause_is_the_largest_and_no_word_of_the_first_page_is_small(
    window: Window, language: str, size: tuple[int, int], *, listed: bool
) -> None:
    day = busy_day(language) if listed else calm_day(language)
    show(window, language, size, **day | {"health": with_the_copy(language), "choices": busy_day(language)["choices"]})
    (today,) = of_kind(window.shown.contentItem(), "PanelToday")
    state, *others = sorted(texts(today), key=letters_of, reverse=True)
    assert words_of(state) == CATALOGUES[language].text("console-paused")
    assert letters_of(state) >= int(100 * unit_of(size))
    assert letters_of(others[0]) < 0.75 * letters_of(state)
    (now,) = of_kind(today, "PanelNow")
    assert words_of(list(texts(now))[1]) == CATALOGUES[language].text("console-stage-game"), "the stage comes second"
    assert letters_of(others[-1]) >= int(27 * unit_of(size))


@pytest.mark.parametrize("size", LAYOUTS)
def test_the_state_comes_first_then_what_is_not_well_then_the_actions(window: Window, size: tuple[int, int]) -> None:
    show(window, "en", size, health=with_the_copy("en"))
    now, notice, actions, checks = (
        of_kind(window.shown.contentItem(), f"Panel{name}")[0] for name in ("Now", "Notice", "Actions", "Health")
    )
    assert level(now) < level(notice) < level(checks)
    assert level(now) + now.height() < level(actions)
    if size[0] < size[1]:
        assert level(notice) < level(actions) < level(checks)
    else:
        assert level(notice) == level(actions)
        assert notice.mapToScene(QPointF()).x() < actions.mapToScene(QPointF()).x()


@pytest.mark.parametrize(("size", "language"), in_turn(LAYOUTS))
def test_the_button_that_answers_a_matter_stands_there_alone_and_all_answers_have_one_shape(
    window: Window, language: str, size: tuple[int, int]
) -> None:
    show(window, language, size, health=with_the_copy(language), choices=at_rest(language))
    found = [item for item in items(window.shown.contentItem()) if item.objectName() == "action-backup"]
    assert [lies_in(item, "PanelNotice") for item in found] == [True]
    assert found[0].height() >= 72 * unit_of(size)
    (notice,) = of_kind(window.shown.contentItem(), "PanelNotice")
    answers = [found[0], *asking(window)]
    assert len(answers) == 3
    shapes = {(round(item.mapToScene(QPointF()).x()), round(item.width()), round(item.height())) for item in answers}
    assert len(shapes) == 1
    tops = [level(item) for item in answers]
    assert tops == sorted(tops), "what is done here stands first"
    # They end where the rows do, and are as wide as the longest words ask for.
    end = notice.mapToScene(QPointF(notice.width() - notice.property("inset"), 0)).x()
    assert found[0].mapToScene(QPointF(found[0].width(), 0)).x() == pytest.approx(end, abs=1)
    needed = max(item.property("implicitWidth") for item in answers)
    assert needed <= found[0].width() <= 1.04 * needed
    # Nothing is cut off, wrapped or covered, with the commands or without them.
    for _ in range(2):
        for text in texts(notice):
            for answer in answers:
                if not lies_in(text, "PanelButton"):
                    across = text.mapToScene(QPointF(text.property("contentWidth"), 0)).x()
                    clear = level(text) + text.height() <= level(answer) or level(text) >= level(answer)
                    assert clear or across <= answer.mapToScene(QPointF()).x()
        turn_answers(window)
        commands = [text for text in texts(notice) if words_of(text).startswith("recollect ")]
        assert len(commands) in {0, 2}
        assert [words_of(text) for text in commands if text.property("lineCount") > 1] == []
        assert [level(item) for item in answers] == pytest.approx(tops, abs=1), "what is shown moves nothing"


@pytest.mark.parametrize("language", sorted(CATALOGUES))
def test_a_command_is_shown_and_said_when_it_is_asked_for_until_its_button_is_pressed_again(
    window: Window, language: str
) -> None:
    show(window, language, WIDE, choices=at_rest(language))
    told, (pin, supervisor) = CATALOGUES[language].text, asking(window)
    how, other, remedy = told("console-pin-how"), told("console-supervisor-how"), told("console-pin-remedy")
    matter, command = f"PIN: {told('console-pin-none')}", "recollect study set-pin"
    for shown in (False, True, False):
        seen = [words_of(text) for text in texts(pin.parentItem()) if text.isVisible() and words_of(text)]
        assert sorted(seen) == sorted([matter, command if shown else remedy, how])
        said = QAccessible.queryAccessibleInterface(pin).text(QAccessible.Text.Name)
        assert said == (command if shown else f"{how} {matter}")
        assert [words_of(text) for text in texts(supervisor) if words_of(text)] == [other]
        press(pin)
    # It is hidden for the one who opens the panel next.
    show(window, language, WIDE, choices=at_rest(language))
    (notice,) = of_kind(window.shown.contentItem(), "PanelNotice")
    assert command not in {words_of(text) for text in texts(notice)}


def test_a_command_stays_shown_and_held_by_the_keyboard_when_something_else_goes_wrong(window: Window) -> None:
    show(window, "en", WIDE, choices=at_rest("en"))
    pin = asking(window)[0]
    pin.forceActiveFocus()
    press(pin)
    health = with_the_copy("en")
    fault = asdict(HealthLine("Robot", "does not answer", is_ok=False, remedy="Look"))
    window.screens.experimenter.parts[2].show_health(health | {"matters": [*health["matters"], fault]})
    QCoreApplication.processEvents()
    lay_out(window.shown)
    held = window.shown.activeFocusItem()
    assert held is not None
    assert held.objectName() == "how-recollect study set-pin"
    (notice,) = of_kind(window.shown.contentItem(), "PanelNotice")
    assert "recollect study set-pin" in [words_of(text) for text in texts(notice)]


@pytest.mark.parametrize("size", [WIDE, UPRIGHT])
def test_a_command_to_type_elsewhere_is_as_dark_as_what_to_do_and_in_letters_of_one_width(
    window: Window, size: tuple[int, int]
) -> None:
    show(window, "en", size, choices=at_rest("en"))
    (notice,) = of_kind(window.shown.contentItem(), "PanelNotice")
    press(asking(window)[0])
    lay_out(window.shown)
    shown = {words_of(text): text for text in texts(notice)}
    remedy, command = shown["Start the kiosk with one"], shown["recollect study set-pin"]
    assert command.property("color") == remedy.property("color")
    letters = QFontMetricsF(command.property("font"))
    assert letters.horizontalAdvance("i") == letters.horizontalAdvance("m")
    picture = window.shown.grabWindow()
    assert background(picture, place(command)) == background(picture, place(remedy))


@pytest.mark.parametrize("size", [WIDE, UPRIGHT])
def test_all_that_can_be_pressed_in_the_cards_looks_alike_and_what_ends_a_session_has_another_colour(
    window: Window, size: tuple[int, int]
) -> None:
    show(window, "en", size, health=with_the_copy("en"), choices=busy_day("en")["choices"])
    shown = {item.objectName(): item for item in items(window.shown.contentItem()) if item.isVisible()}
    picture = window.shown.grabWindow()

    def look(name: str) -> tuple[float, str, str]:
        ground = shown[name].property("background")
        edge = QQmlProperty.read(ground, "border.width"), QQmlProperty.read(ground, "border.color").name()
        return (*edge, background(picture, place(shown[name])).name())

    shown_only = [item.objectName() for item in asking(window)]
    (alike,) = {look(name) for name in ("action-again", "action-mute", "break-5", "action-backup", *shown_only)}
    width, colour, ground = look("action-end")
    assert alike[0] > 0
    assert (width, ground) == (alike[0], alike[2]), "what ends a session weighs no more than the rest"
    assert colour != alike[1]


@pytest.mark.parametrize("stays", [False, True])
@pytest.mark.parametrize("size", [WIDE, UPRIGHT])
def test_a_session_that_is_to_stay_paused_has_a_way_out_that_says_so(
    window: Window, size: tuple[int, int], *, stays: bool
) -> None:
    show(window, "en", size, choices=busy_day("en")["choices"] | {"staysPaused": stays})
    (now,) = of_kind(window.shown.contentItem(), "PanelNow")
    ways = [item for item in items(now) if item.property("solid") is not None]
    solid = {item.objectName(): item.property("solid") for item in ways}
    assert solid == ({"action-pause": True, "panel-back": False} if stays else {"panel-back": True})
    assert ways[0].property("activeFocus")
    assert words_of(sole(texts(ways[0]))) == ("Close, stay paused" if stays else "Back to the game")


@pytest.mark.parametrize(("size", "language"), in_turn(LAYOUTS))
def test_words_of_buttons_stand_in_their_middle_behind_their_sign(
    window: Window, language: str, size: tuple[int, int]
) -> None:
    show(window, language, size, health=with_the_copy(language))
    (today,) = of_kind(window.shown.contentItem(), "PanelToday")
    begins = ("action-", "how-", "break-", "panel-back")
    buttons = [item for item in items(today) if item.objectName().startswith(begins)]
    assert len(buttons) >= 6
    for button in buttons:
        text = sole(texts(button))
        shown = QRectF(painted(text))
        for drawing in of_kind(button, "Drawing"):
            shown = shown.united(drawing.mapRectToScene(drawing.boundingRect()))
        middle = button.mapToScene(QPointF(button.width() / 2, 0)).x()
        assert shown.center().x() == pytest.approx(middle, abs=12 * unit_of(size)), words_of(text)


@pytest.mark.parametrize("size", LAYOUTS)
def test_eight_matters_stand_below_each_other_and_their_answers_in_one_column(
    window: Window, size: tuple[int, int]
) -> None:
    health = with_the_copy("en")
    fault = asdict(
        HealthLine("Robot", "the robot at 192.168.1.20 does not answer: refused", is_ok=False, remedy="Look")
    )
    health["matters"] = [*[fault] * 5, *health["matters"]]
    show(window, "en", size, health=health, choices=at_rest("en"))
    (notice,) = of_kind(window.shown.contentItem(), "PanelNotice")
    marks = [level(mark) for mark in of_kind(notice, "PanelMark")]
    assert len(marks) == 8
    assert marks == sorted(marks)
    assert [words_of(text) for text in texts(notice) if is_broken(text)] == []
    bottom = level(notice) + notice.height()
    assert all(level(text) + text.height() <= bottom for text in texts(notice))


@pytest.mark.parametrize(("matters", "listed", "size", "language"), in_turn([0, 2, 3], [False, True], LAYOUTS))
def test_the_first_page_needs_no_scrolling_while_a_visitor_plays(
    window: Window, language: str, size: tuple[int, int], matters: int, *, listed: bool
) -> None:
    day = busy_day(language) if listed else calm_day(language)
    health = with_the_copy(language)
    shown = health | {"matters": health["matters"][:matters]}
    show(window, language, size, **day | {"health": shown, "choices": busy_day(language)["choices"]})
    (today,) = of_kind(window.shown.contentItem(), "PanelToday")
    assert today.height() <= today.property("seen")


@pytest.mark.parametrize(("copies", "under_way", "size", "language"), in_turn([False, True], [False, True], LAYOUTS))
def test_actions_are_of_one_height_in_rows_with_a_name_and_the_last_ends_the_session(
    window: Window, language: str, size: tuple[int, int], *, copies: bool, under_way: bool
) -> None:
    busy, told = busy_day(language), CATALOGUES[language].text
    health = with_the_copy(language) if copies else busy["health"]
    breaks = [
        {"value": str(each), "label": told("console-break-minutes", minutes=each)}
        for each in ((5, 10, 15) if under_way else (5, 10, 15, 30))
    ]
    show(window, language, size, health=health, choices=busy["choices"] | {"underWay": under_way, "breaks": breaks})
    (actions,) = of_kind(window.shown.contentItem(), "PanelActions")
    found = [item for item in items(actions) if item.objectName().startswith(("action-", "test-voice"))]
    first, silence, *others = found
    names = [*([] if copies else ["action-backup"]), *(["action-end"] if under_way else [])]
    assert [item.objectName() for item in others] == names
    # What is done all day stands side by side.
    assert level(first) == level(silence)
    assert (first.width(), first.height()) == (silence.width(), silence.height())
    assert [words_of(text) for text in texts(actions) if is_broken(text)] == []
    # The lengths of a break have one row without gaps, and all rows begin and end at one place.
    answers = [item for item in items(actions) if item.objectName().startswith("break-")]
    assert len(answers) == len(breaks)
    for one, other in pairwise(answers):
        end = one.mapToScene(QPointF(one.width(), 0)).x()
        assert other.mapToScene(QPointF()).x() == pytest.approx(end, abs=2 * unit_of(size) + 1)
    assert len({item.height() for item in [*found, *answers]}) == 1
    rows: dict[float, list[QRectF]] = {}
    for item in [*found, *answers]:
        rows.setdefault(level(item), []).append(item.mapRectToScene(item.boundingRect()))
    assert len(rows) == 2 + len(names)
    card, inset = actions.mapRectToScene(actions.boundingRect()), actions.property("inset")
    begin = min(rect.left() for rect in rows[level(first)])
    for row in rows.values():
        assert min(rect.left() for rect in row) == pytest.approx(begin, abs=1)
        assert max(rect.right() for rect in row) == pytest.approx(card.right() - inset, abs=2)
    # Their names stand before them, at the edge that the other cards have, in the order of the rows.
    words = [
        "console-sound",
        *([] if copies else ["console-data"]),
        "console-pause-row" if under_way else "console-break-row",
    ]
    words += ["console-session"] if under_way else []
    pressed = [text for item in [*found, *answers] for text in texts(item)]
    heading = told("console-actions")
    labels = [text for text in texts(actions) if text not in pressed and words_of(text) != heading]
    assert [words_of(label) for label in labels] == [told(word) for word in words]
    for label, top in zip(labels, sorted(rows), strict=True):
        assert label.mapToScene(QPointF()).x() == pytest.approx(card.left() + inset, abs=1)
        assert label.mapToScene(QPointF(label.property("contentWidth"), 0)).x() < begin
        assert level(label) + label.height() / 2 == pytest.approx(top + first.height() / 2, abs=1)
    # What ends a session is the last, apart from all else by a line.
    steps = [after - before for before, after in pairwise(sorted(rows))]
    assert max(steps) - min(steps) <= 1
    assert min(steps) >= first.height() + int(19 * unit_of(size))


@pytest.mark.parametrize(("matters", "size", "language"), in_turn([0, 1, 2, 3], [WIDE, (1280, 800), (1366, 768)]))
def test_the_card_beside_the_actions_ends_level_with_theirs(
    window: Window, language: str, size: tuple[int, int], matters: int
) -> None:
    health = with_the_copy(language)
    show(window, language, size, health=health | {"matters": health["matters"][:matters]})
    root = window.shown.contentItem()
    (checks,), (actions,), (today,) = (of_kind(root, f"Panel{name}") for name in ("Health", "Actions", "Today"))
    # With several matters the day stands below them and the actions, as wide as both.
    below = checks.width() == pytest.approx(today.width(), abs=1)
    assert not below or matters > 1
    beside = sole(of_kind(root, "PanelNotice")) if below else checks
    assert level(beside) + beside.height() == pytest.approx(level(actions) + actions.height(), abs=ROUNDED)
    assert level(checks) + checks.height() <= level(today) + today.property("seen")


# Italian has a remedy that may need two lines, and its row is higher then.
@pytest.mark.parametrize("language", ["en", "es"])
def test_three_matters_stand_in_line_with_three_rows_of_actions(window: Window, language: str) -> None:
    show(window, language, WIDE, health=with_the_copy(language), choices=busy_day(language)["choices"])
    root = window.shown.contentItem()

    def middle(name: str) -> float:
        item = find_item(root, name)
        assert item is not None
        return level(item) + item.height() / 2

    answers = ["action-backup", *(item.objectName() for item in asking(window))]
    for answer, action in zip(answers, ["action-mute", "break-5", "action-end"], strict=True):
        assert middle(answer) == pytest.approx(middle(action), abs=ROUNDED)
    # Both cards have a heading, at one height.
    headings = [
        text
        for text in texts(root)
        if words_of(text) in {*map(CATALOGUES[language].text, ("console-to-do", "console-actions"))}
    ]
    assert len(headings) == 2
    assert level(headings[0]) == level(headings[1]) < middle("action-mute")


@pytest.mark.parametrize(("size", "language"), in_turn([WIDE, (1280, 800), (1366, 768)]))
def test_two_numbers_and_four_checks_stand_in_one_row_equally_far_apart(
    window: Window, language: str, size: tuple[int, int]
) -> None:
    busy = busy_day(language)
    today = busy["today"] | {"tiles": [tile | {"line": ""} for tile in busy["today"]["tiles"][:3]]}
    show(window, language, size, health=with_the_copy(language), today=today, choices=at_rest(language))
    (checks,) = of_kind(window.shown.contentItem(), "PanelHealth")
    facts = of_kind(checks, "PanelFact")
    assert len(facts) == 6
    assert not of_kind(checks, "PanelTile")
    starts = [fact.mapToScene(QPointF()).x() for fact in facts]
    steps = [after - before for before, after in pairwise(starts[2:])]
    assert max(steps) - min(steps) <= 1
    # The names have one line and letters of one size; below them the numbers are larger, on one line with the rest.
    lines = [list(texts(fact)) for fact in facts]
    assert len({(level(name), letters_of(name)) for name, _ in lines}) == 1
    bases = [level(value) + value.baselineOffset() for _, value in lines]
    assert max(bases) - min(bases) <= 1
    sizes = [letters_of(value) for _, value in lines]
    assert len(set(sizes[:2])) == len(set(sizes[2:])) == 1
    assert sizes[0] > sizes[2]
    for name, value in lines[2:]:
        assert value.mapToScene(QPointF()).x() == name.mapToScene(QPointF()).x()
    assert [words_of(text) for text in texts(checks) if is_broken(text)] == []


@pytest.mark.parametrize(("size", "language"), in_turn(LAYOUTS))
def test_checks_stand_in_two_columns_equally_far_apart(window: Window, language: str, size: tuple[int, int]) -> None:
    lines = busy_day(language)["health"]["lines"] * 2
    show(window, language, size, health={"matters": [], "lines": lines[:6], "more": []})
    (checks,) = of_kind(window.shown.contentItem(), "PanelHealth")
    # The first one stands before the heading.
    marks = of_kind(checks, "PanelMark")[1:]
    assert len({round(mark.mapToScene(QPointF()).x()) for mark in marks}) == 2
    rows = sorted({round(level(mark)) for mark in marks})
    steps = [after - before for before, after in pairwise(rows)]
    assert steps[0] == pytest.approx(steps[1], abs=ROUNDED)


@pytest.mark.parametrize("holds", [False, True])
def test_all_is_well_is_said_while_there_is_no_notice_and_no_alarm_holds(window: Window, *, holds: bool) -> None:
    panel = window.screens.experimenter.parts[2]
    panel.show_alarms([{"when": "09:40", "words": "The voice fails", "holds": holds}])
    for health in (busy_day("en")["health"], calm_day("en")["health"]):
        show(window, "en", WIDE, health=health)
        said = [words_of(text) for text in texts(window.shown.contentItem())]
        assert ("All is well" in said) is (not health["matters"] and not holds)
    panel.show_alarms([])


@pytest.mark.parametrize("page", [1, 2])
def test_what_is_not_well_marks_the_first_page_on_the_others(window: Window, page: int) -> None:
    for health, marked in ((busy_day("en")["health"], True), (calm_day("en")["health"], False)):
        show(window, "en", WIDE, page=page, health=health)
        tab = find_item(window.shown.contentItem(), "panel-today")
        assert tab is not None
        assert bool(of_kind(tab, "PanelMark")) is marked
        turn_to(window, 0)
        assert not of_kind(tab, "PanelMark")


@pytest.mark.parametrize(
    ("many", "listed", "size", "language"), in_turn([(1, 0), (1, 5), (4, 2), (4, 5)], [False, True], LAYOUTS)
)
def test_the_page_of_sessions_needs_no_scrolling(
    window: Window, language: str, size: tuple[int, int], many: tuple[int, int], *, listed: bool
) -> None:
    sessions, deviations = many
    day = busy_day(language) if listed else calm_day(language)
    noted = third_page(language, robot=False, deviations=deviations)["records"]
    first, second = busy_day(language)["records"]["sessions"]
    records = day["records"] | {
        "sessions": [first, *[second] * (sessions - 1)],
        "deviations": noted["deviations"],
        "more": noted["more"],
    }
    show(window, language, size, page=1, **day | {"records": records})
    (page,) = of_kind(window.shown.contentItem(), "PanelRecords")
    assert page.height() <= page.property("seen")
    assert min(map(letters_of, texts(page))) >= int((21 if size[0] > size[1] else 26) * unit_of(size))


@pytest.mark.parametrize(("robot", "size", "language"), in_turn([False, True], [*LAYOUTS, (800, 1280)]))
def test_the_page_of_settings_has_large_letters_and_needs_no_scrolling(
    window: Window, language: str, size: tuple[int, int], *, robot: bool
) -> None:
    told = CATALOGUES[language]
    window.screens.experimenter.parts[2].list_shortcuts(shortcut_rows(shortcuts(Settings().shortcuts), told))
    show(window, language, size, page=2, **third_page(language, robot=robot, deviations=0))
    (page,) = of_kind(window.shown.contentItem(), "PanelNext")
    assert page.height() <= page.property("seen")
    assert min(map(letters_of, texts(page))) >= int((26 if robot else 28) * unit_of(size))
