"""Lists of the panel: the day in numbers, names of conditions, and shortcuts."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest

from kiosk.config import Settings
from kiosk.experiment.booth_status import DayCounts, utc
from kiosk.experiment.condition import Condition
from kiosk.experiment.experimenter import Action, shortcuts
from kiosk.experiment.outcomes import Disposition, NotRecordedReason
from kiosk.store.participants import CountCell, EnrolmentCounts
from kiosk.ui.experimenter.panel_rows import neutral_names, shortcut_rows, today_rows
from tests.samples import CATALOGUES

MINUTE = 60_000
BEGAN = datetime(2027, 3, 1, 9, tzinfo=UTC)
EN = CATALOGUES["en"]


def day_at(hours: float, done: int, quota: int, completed: int) -> dict[str, str]:
    """Return the line below the target, and the others, so many hours after the first visitor of the day."""
    fates = {**dict.fromkeys(Disposition, 0), Disposition.CONSUMED: done}
    counts = EnrolmentCounts({Condition.TOM: CountCell(quota, fates, 0)}, dict.fromkeys(NotRecordedReason, 0))
    day = DayCounts(completed + 2, completed, 1, 2, utc(round(BEGAN.timestamp() * 1000)))
    rows = today_rows(day, counts, ("game", 4 * MINUTE), BEGAN + timedelta(hours=hours), EN)
    return {tile["name"]: f"{tile['value']}: {tile['line']}" for tile in rows["tiles"]}


def test_the_day_is_told_in_numbers_with_a_forecast_at_its_own_pace() -> None:
    assert day_at(3, done=20, quota=30, completed=6) == {
        "visitors": "8: 1 ended early",
        "completed": "6: 2 in the last hour",
        "target": "20 / 30: " + EN.text("console-today-forecast", hours="5"),
        "stage": "Game: begun 4 min ago",
    }


@pytest.mark.parametrize(
    ("hours", "done", "completed", "words"),
    [
        (0.4, 20, 6, "too few today to tell how long it takes"),
        (3, 20, 2, "too few today to tell how long it takes"),
        (3, 29, 9, EN.text("console-today-forecast", hours="<1")),
        (3, 30, 9, ""),
        (3, 31, 9, ""),
    ],
)
def test_a_forecast_needs_a_pace_and_something_that_is_missing(
    hours: float, done: int, completed: int, words: str
) -> None:
    assert day_at(hours, done, 30, completed)["target"] == f"{done} / 30: {words}"


def test_without_a_target_its_games_are_none_rather_than_0() -> None:
    assert day_at(3, done=0, quota=0, completed=6)["target"] == "-: "


def test_conditions_have_letters_in_the_order_of_the_design() -> None:
    name = neutral_names((None, Condition.NOTOM, Condition.TOM), EN.text)
    assert [name(each) for each in (Condition.TOM, Condition.NOTOM, None)] == ["A", "B", "automatic"]


def test_shortcuts_say_once_what_is_held_down_for_all_of_them() -> None:
    shown = shortcut_rows(shortcuts(Settings().shortcuts), EN)
    assert shown["title"] == "Shortcuts: Ctrl+Shift and …"
    assert {"keys": "E", "words": "end the session"} in shown["rows"]
    own = shortcut_rows({Action.PANEL: "F9", Action.QUIT: "Ctrl+Q"}, EN)
    assert own["title"] == "Shortcuts"
    assert [row["keys"] for row in own["rows"]] == ["F9", "Ctrl+Q"]
