"""What the next sitting follows: the experimenter's choice holds for one sitting, and a later one for the one after."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from kiosk import StoreFailed
from kiosk.settings import Settings
from kiosk.store.recorder import Recorder
from kiosk.study.allocation import Allotted, Place
from kiosk.study.condition import Condition
from kiosk.study.declared.checked.whole import read_study
from kiosk.ui.desk import Desk, Origin

LISTED = Settings.model_validate(
    {"languages": ["en"], "questionnaires": ["trust"], "allocation": {"quotas": {"tom": 2, "notom": 2}, "block": 2}}
)
ORIGIN = Origin("a test", simulated=True, seed=lambda: 1)


@pytest.fixture
def recorder(tmp_path: Path) -> Iterator[Recorder]:
    with Recorder(tmp_path) as recorder:
        yield recorder


@pytest.fixture
def desk(recorder: Recorder) -> Desk:
    return Desk(read_study(LISTED), recorder, ORIGIN)


def test_a_choice_holds_for_the_next_sitting_and_no_longer(desk: Desk) -> None:
    desk.choose(Condition.NO_ASSISTANCE, "a test")
    sitting = desk.next_sitting("en")
    assert (sitting.plan.condition, sitting.allotted) == (Condition.NO_ASSISTANCE, Allotted.OVERRIDE)
    desk.kept(sitting)
    assert desk.chosen is None
    assert desk.next_sitting("en").allotted is Allotted.LIST


def test_a_choice_outlasts_a_sitting_that_is_not_kept(desk: Desk) -> None:
    desk.choose(Condition.NO_ASSISTANCE, "a test")
    desk.next_sitting("en")
    assert desk.next_sitting("en").plan.condition is Condition.NO_ASSISTANCE


@pytest.mark.parametrize("later", [Condition.TOM, Condition.NO_ASSISTANCE], ids=lambda condition: condition.value)
def test_what_is_chosen_while_somebody_decides_holds_for_the_sitting_after_theirs(desk: Desk, later: Condition) -> None:
    desk.choose(Condition.NO_ASSISTANCE, "a test")
    sitting = desk.next_sitting("en")
    desk.choose(later, "another one")
    desk.kept(sitting)
    assert desk.chosen is later


def test_a_list_that_the_disk_does_not_take_is_the_disk_s_failure_and_not_the_study_s(tmp_path: Path) -> None:
    class Full(Recorder):
        def fix_list(self, *_: object, **__: object) -> tuple[Place, ...]:
            raise StoreFailed("the disk is full")

    with Full(tmp_path) as recorder, pytest.raises(StoreFailed, match="the disk is full"):
        Desk(read_study(LISTED), recorder, ORIGIN)
