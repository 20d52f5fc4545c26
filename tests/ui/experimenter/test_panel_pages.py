"""The panel's first page on a busy day: no word is broken, no number wraps, and rows stand equally far apart.

Both pages have large letters, and need no scrolling during a session.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict
from itertools import pairwise, product
from typing import Any

import pytest
from PySide6.QtCore import QCoreApplication, QPointF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QGuiApplication
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
from tests.ui.headless import open_window
from tests.ui.looking import items, lies_in, of_kind, texts

WIDE, UPRIGHT = (1920, 1080), (1080, 1920)
ROUNDED = 3
"""So many pixels are lost where lengths are rounded."""
NEAR = 12
"""In pixels: letters of two sizes on one line."""
LAYOUTS = [WIDE, UPRIGHT, (1280, 800), (1366, 768)]


def in_turn(*lists: Sequence[object]) -> list[tuple[object, ...]]:
    """Combine these values; each combination is in one language, and the languages take turns."""
    languages = sorted(CATALOGUES)
    places = product(*(range(len(values)) for values in lists))
    return [
        (*(values[place] for values, place in zip(lists, each, strict=True)), languages[sum(each) % len(languages)])
        for each in places
    ]


@pytest.fixture(scope="module")
def window(qapp: QGuiApplication) -> Iterator[Window]:  # noqa: ARG001 - Qt is to be there
    """Open a window with no kiosk behind it."""
    with open_window(read_study(Settings())) as opened:
        yield opened


def show(window: Window, language: str, size: tuple[int, int], text_size: float = 1.0, **parts: Row) -> None:
    """Show the panel on a busy day, with other ``parts`` where they are given."""
    panel = window.screens.experimenter.parts[2]
    panel.open(is_open=False)
    window.shown.setProperty("textSize", text_size)
    window.shown.resize(*size)
    told = CATALOGUES[language].text
    panel.set_language({name: told(name) for name in WORDS})
    shown = busy_day(language) | parts
    panel.show_health(shown["health"])
    panel.show_today(shown["today"])
    panel.show_records(shown["records"])
    panel.show_choices(shown["choices"])
    panel.open(is_open=True)
    QCoreApplication.processEvents()
    lay_out(window.shown)
    assert (window.shown.contentItem().width(), window.shown.contentItem().height()) == size


def busy_day(language: str) -> dict[str, Any]:
    """Return what the panel shows: two warnings, four checks, a list with a target, and a session under way."""
    told = CATALOGUES[language].text
    pin = HealthLine("PIN", told("console-pin-none"), is_ok=False, remedy=told("console-pin-remedy"))
    supervisor = HealthLine(
        told("console-supervisor"),
        told("console-supervisor-none"),
        is_ok=False,
        remedy=told("console-supervisor-remedy"),
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
            "session": told("console-session-paused"),
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
    show(window, language, size, text_size)
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
    show(window, "en", UPRIGHT, records=unlisted)
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
def test_checks_stand_as_close_as_the_rows_of_the_tables(window: Window, size: tuple[int, int]) -> None:
    show(window, "en", size)
    lines = of_kind(window.shown.contentItem(), "PanelLine")
    levels = sorted({round(line.mapToScene(QPointF()).y()) for line in lines})
    (counts,) = of_kind(window.shown.contentItem(), "PanelCounts")
    apart = max(counts.property("apart"), 10)
    assert len(levels) > 1
    assert [after - before - lines[0].height() for before, after in pairwise(levels)] == pytest.approx(
        [apart] * (len(levels) - 1), abs=ROUNDED
    )


def test_few_checks_stand_beside_the_counts_and_the_sessions_have_the_whole_width_below(window: Window) -> None:
    show(window, "en", WIDE)
    (checks,), (counts,), (sessions,) = (
        of_kind(window.shown.contentItem(), f"Panel{name}") for name in ("Health", "Counts", "Sessions")
    )
    assert checks.height() == counts.height()
    assert sessions.mapToScene(QPointF()).x() == checks.mapToScene(QPointF()).x()
    assert sessions.width() > checks.width() + counts.width()
    health = busy_day("en")["health"]
    show(window, "en", WIDE, health=health | {"lines": health["lines"] * 2})
    (counts,), (sessions,) = (of_kind(window.shown.contentItem(), f"Panel{name}") for name in ("Counts", "Sessions"))
    assert sessions.mapToScene(QPointF()).x() == counts.mapToScene(QPointF()).x()
    assert sessions.width() == counts.width()


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


def test_what_the_session_does_stands_beside_its_stage_where_it_has_the_whole_card(window: Window) -> None:
    tiles = busy_day("en")["today"]["tiles"]
    levels = []
    for shown in (tiles, tiles[:2]):
        show(window, "en", UPRIGHT, today={"clock": "09:52", "tiles": shown})
        stage = find_item(window.shown.contentItem(), "today-stage")
        assert stage is not None
        told = {words_of(text): text.mapToScene(QPointF()).y() for text in texts(stage)}
        levels.append(told["Paused while this is open"] - told["for 3 min"])
    # In one line where the numbers are below, and in two where one of them stands beside it.
    assert abs(levels[0]) < NEAR < levels[1]


def test_the_way_out_is_outlined_and_its_ring_lies_on_its_edge(window: Window) -> None:
    show(window, "en", WIDE)
    close = find_item(window.shown.contentItem(), "panel-close")
    assert close is not None
    assert close.property("activeFocus")
    assert not [item for item in of_kind(window.shown.contentItem(), "FocusRing") if lies_in(item, "PanelView")]
    QTest.keyClick(window.shown, Qt.Key.Key_Tab)
    QTest.keyClick(window.shown, Qt.Key.Key_Backtab)
    assert close.property("activeFocus")
    (ring,) = (item for item in of_kind(window.shown.contentItem(), "FocusRing") if lies_in(item, "PanelView"))
    assert not close.property("solid")
    assert (ring.mapToScene(QPointF()), ring.size()) == (close.mapToScene(QPointF()), close.size())


def calm_day(language: str) -> dict[str, Any]:
    """Return what the panel shows of a day without a list, a target or a visitor, on which all is well."""
    busy = busy_day(language)
    cell = {"name": "A", "listed": False, "done": "1", "share": 0, "counts": ["0", "0", "0", "0"]}
    return {
        "health": busy["health"] | {"matters": []},
        "today": busy["today"] | {"tiles": busy["today"]["tiles"][:3]},
        "records": busy["records"] | {"listed": False, "cells": [cell], "sessions": busy["records"]["sessions"][:1]},
        "choices": busy["choices"] | {"underWay": False, "session": ""},
    }


@pytest.mark.parametrize(("text_size", "size", "language"), in_turn([1.0, 1.3], [*LAYOUTS, (800, 1280)]))
def test_names_of_pages_are_large_and_clear_of_the_clock(
    window: Window, language: str, text_size: float, size: tuple[int, int]
) -> None:
    show(window, language, size, text_size)
    root = window.shown.contentItem()
    tabs = [find_item(root, name) for name in ("panel-today", "panel-next")]
    clock, title = find_item(root, "today-clock"), CATALOGUES[language].text("console-title")
    assert clock is not None
    for tab in tabs:
        assert tab is not None
        assert tab.mapToScene(QPointF(tab.width(), 0)).x() < clock.mapToScene(QPointF()).x()
        if size[0] > size[1] and text_size == 1:
            assert tab.property("font").pixelSize() == pytest.approx(34 * size[0] / 1920, abs=1)
            assert [text for text in texts(root) if words_of(text) == title and text.isVisible()]


def test_a_single_row_is_not_spread_over_a_broad_card(window: Window) -> None:
    widths = []
    for many in (1, 3):
        calm, busy = calm_day("en"), busy_day("en")
        sessions = busy["records"]["sessions"][:1] * many
        show(window, "en", WIDE, **calm | {"records": calm["records"] | {"sessions": sessions}})
        (table,) = of_kind(window.shown.contentItem(), "PanelSessions")
        cells = [item for item in of_kind(table, "PanelCell") if item.isVisible()]
        widths.append(max(cell.mapToItem(table, QPointF()).x() + cell.property("implicitWidth") for cell in cells))
        assert widths[0] <= table.property("inset") + 1000 + ROUNDED
    assert widths[1] > widths[0] + 100


@pytest.mark.parametrize("language", sorted(CATALOGUES))
@pytest.mark.parametrize("size", LAYOUTS)
def test_letters_are_large_where_the_page_has_the_room(window: Window, language: str, size: tuple[int, int]) -> None:
    show(window, language, size, **calm_day(language))
    (today,) = of_kind(window.shown.contentItem(), "PanelToday")
    unit = min(size) / 1080 if size in (WIDE, UPRIGHT) else size[0] / 1920
    drawn = {text.property("font").pixelSize() for text in texts(today) if lies_in(text, "PanelCell")}
    assert min(drawn) >= int(29 * unit)
    (stage,) = [text for text in texts(today) if words_of(text) == CATALOGUES[language].text("console-stage-game")][:1]
    assert stage.property("font").pixelSize() >= int(60 * unit)
    assert today.height() <= today.property("seen")


@pytest.mark.parametrize(("many", "size", "language"), in_turn([1, 2, 3, 4, 6], LAYOUTS))
def test_larger_letters_never_make_the_page_scroll(
    window: Window, language: str, size: tuple[int, int], many: int
) -> None:
    calm, busy = calm_day(language), busy_day(language)
    sessions = [busy["records"]["sessions"][0], *[busy["records"]["sessions"][1]] * (many - 1)]
    for parts in (calm, busy, calm | {"health": busy["health"]}, busy | {"health": calm["health"]}):
        show(window, language, size, **parts | {"records": parts["records"] | {"sessions": sessions}})
        (today,) = of_kind(window.shown.contentItem(), "PanelToday")
        if today.property("size") > today.property("usual"):
            assert today.height() <= today.property("seen")


@pytest.mark.parametrize(("text_size", "size", "language"), in_turn([1.0, 1.15], LAYOUTS))
def test_warnings_in_two_columns_have_one_line_each(
    window: Window, language: str, text_size: float, size: tuple[int, int]
) -> None:
    calm, matters = calm_day(language), busy_day(language)["health"]["matters"]
    for shown in (matters[:1], matters[1:], matters):
        show(window, language, size, text_size, **calm | {"health": calm["health"] | {"matters": shown}})
        (notice,) = of_kind(window.shown.contentItem(), "PanelNotice")
        told = [text for text in texts(notice) if text.isVisible()]
        assert len(told) == 2 * len(shown)
        if notice.property("beside"):
            assert {text.property("lineCount") for text in told} == {1}


@pytest.mark.parametrize(("listed", "size", "language"), in_turn([False, True], [*LAYOUTS, (800, 1280)]))
def test_a_session_with_three_matters_needs_no_scrolling(
    window: Window, language: str, size: tuple[int, int], *, listed: bool
) -> None:
    calm, busy, told = calm_day(language), busy_day(language), CATALOGUES[language].text
    copy = HealthLine(
        told("console-database"),
        told("console-backup-none"),
        remedy=told("console-backup"),
        action="backup",
        is_due=True,
    )
    health = busy["health"] | {"matters": [*busy["health"]["matters"], asdict(copy)]}
    day = busy if listed else calm
    show(window, language, size, **day | {"health": health, "choices": busy["choices"]})
    (today,) = of_kind(window.shown.contentItem(), "PanelToday")
    assert today.height() <= today.property("seen")
    (button,) = [item for item in items(today) if item.objectName() == "action-backup"]
    assert lies_in(button, "PanelNotice" if size[0] > size[1] else "PanelActions")


@pytest.mark.parametrize("language", sorted(CATALOGUES))
@pytest.mark.parametrize("matters", [0, 1, 2])
def test_an_upright_page_with_the_next_visitor_to_call_needs_no_scrolling(
    window: Window, language: str, matters: int
) -> None:
    busy = busy_day(language)
    health = busy["health"] | {"matters": busy["health"]["matters"][:matters]}
    choices = busy["choices"] | {"underWay": False, "session": "", "canBeNext": True}
    show(window, language, UPRIGHT, health=health, choices=choices)
    (today,) = of_kind(window.shown.contentItem(), "PanelToday")
    assert today.height() <= today.property("seen")


def level(item: QQuickItem) -> float:
    """Return how far below the top of the window it begins."""
    return item.mapToScene(QPointF()).y()


@pytest.mark.parametrize("language", sorted(CATALOGUES))
@pytest.mark.parametrize("size", LAYOUTS)
def test_each_matter_has_one_line_and_all_lines_stand_equally_far_apart(
    window: Window, language: str, size: tuple[int, int]
) -> None:
    told, health = CATALOGUES[language].text, busy_day(language)["health"]
    copy = HealthLine(told("console-database"), told("console-backup-none"), remedy=told("console-backup"))
    matters = [*health["matters"], asdict(copy) | {"action": "backup"}]
    show(window, language, size, **calm_day(language) | {"health": health | {"matters": matters}})
    (notice,) = of_kind(window.shown.contentItem(), "PanelNotice")
    assert notice.property("beside")
    said = {f"{matter['name']}: {matter['message']}" for matter in matters}
    lines = [text for text in texts(notice) if words_of(text) in said]
    assert [text.property("lineCount") for text in lines] == [1, 1, 1]
    middles = sorted(level(text) + text.height() / 2 for text in lines)
    steps = [after - before for before, after in pairwise(middles)]
    assert steps[0] == pytest.approx(steps[1], abs=ROUNDED)


@pytest.mark.parametrize("size", LAYOUTS)
def test_checks_counts_and_sessions_are_parts_of_one_sheet(window: Window, size: tuple[int, int]) -> None:
    show(window, "en", size)
    sheet = find_item(window.shown.contentItem(), "today-sheet")
    assert sheet is not None
    around = sheet.mapRectToScene(sheet.boundingRect())
    for name in ("Health", "Counts", "Sessions"):
        (part,) = of_kind(window.shown.contentItem(), f"Panel{name}")
        assert not part.property("framed")
        assert around.adjusted(-1, -1, 1, 1).contains(part.mapRectToScene(part.boundingRect()))


@pytest.mark.parametrize("language", sorted(CATALOGUES))
@pytest.mark.parametrize("under_way", [True, False])
@pytest.mark.parametrize("matters", [0, 2])
def test_no_action_of_an_upright_page_has_a_row_alone(
    window: Window, language: str, matters: int, *, under_way: bool
) -> None:
    busy = busy_day(language)
    health = busy["health"] | {"matters": busy["health"]["matters"][:matters]}
    show(window, language, UPRIGHT, health=health, choices=busy["choices"] | {"underWay": under_way})
    (actions,) = of_kind(window.shown.contentItem(), "PanelActions")
    names = ("pause", "again", "backup", "mute", "end") if under_way else ("backup", "mute")
    shown = [item for item in items(actions) if item.isVisible()]
    found = [item for item in shown if item.objectName() in {"test-voice", *(f"action-{name}" for name in names)}]
    assert len(found) == (5 if under_way else 3)
    assert {item.width() for item in found} == {actions.property("half")}
    # The break fills the sixth place.
    assert len({(round(level(item)), round(item.mapToScene(QPointF()).x())) for item in found}) == len(found)
    assert len({round(level(item)) for item in found}) == (3 if under_way else 2)


def test_the_notice_of_an_upright_page_stands_below_the_actions_unless_an_alarm_holds(window: Window) -> None:
    panel = window.screens.experimenter.parts[2]
    for size, holds in ((UPRIGHT, False), (UPRIGHT, True), (UPRIGHT, False), (WIDE, False)):
        panel.show_alarms([{"when": "09:40", "words": "The voice fails", "holds": holds}])
        show(window, "en", size)
        (notice,), (actions,) = (of_kind(window.shown.contentItem(), f"Panel{name}") for name in ("Notice", "Actions"))
        if size == WIDE:
            assert notice.mapToScene(QPointF()).x() < actions.mapToScene(QPointF()).x()
        else:
            assert (level(notice) < level(actions)) is holds
    panel.show_alarms([])


def second_page(language: str, *, robot: bool, deviations: int) -> dict[str, Any]:
    """Return what the second page shows of a study with two conditions and three languages."""
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


@pytest.mark.parametrize(
    ("deviations", "robot", "size", "language"), in_turn([2, 5], [False, True], [*LAYOUTS, (800, 1280)])
)
def test_the_second_page_has_large_letters_and_needs_no_scrolling(
    window: Window, language: str, size: tuple[int, int], *, robot: bool, deviations: int
) -> None:
    told = CATALOGUES[language]
    window.screens.experimenter.parts[2].list_shortcuts(shortcut_rows(shortcuts(Settings().shortcuts), told))
    show(window, language, size, **second_page(language, robot=robot, deviations=deviations))
    view = find_item(window.shown.contentItem(), "panel")
    assert view is not None
    view.setProperty("onToday", 0)
    lay_out(window.shown)
    (page,) = of_kind(window.shown.contentItem(), "PanelNext")
    assert page.height() <= page.property("seen")
    unit = min(min(size) / 1080, max(size) / 1920)
    drawn = {text.property("font").pixelSize() for text in texts(page)}
    assert min(drawn) >= int((26 if robot else 28) * unit)
    view.setProperty("onToday", 1)
