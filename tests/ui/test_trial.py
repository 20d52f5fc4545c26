"""Without a PIN the kiosk says that it is a trial, and how it is left; with one it says nothing of it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner
from pytestqt.qtbot import QtBot

from kiosk.cli.main import recollect
from kiosk.config import Settings
from kiosk.experiment.outcomes import SessionKind
from kiosk.experiment.session_config import kind_of
from kiosk.store.queries import open_repository
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.simulated_visitor import find_item, lay_out
from tests.samples import CATALOGUES
from tests.ui.experimenter.conftest import LINE
from tests.ui.headless import HALF, headless, short
from tests.ui.looking import painted, texts

TINY = {"game": {"rows": 1, "columns": 2}, "stages": ("introduction", "game", "result")}


@pytest.mark.parametrize("language", CATALOGUES)
def test_the_first_screen_says_that_it_is_a_trial_with_the_shortcut_that_leaves_it(
    language: str, tmp_path: Path, qtbot: QtBot
) -> None:
    del qtbot
    settings = short(languages=[language], shortcuts={"quit": "Ctrl+Shift+F9"})
    with headless(settings, tmp_path, kind=SessionKind.TRIAL, mode=HALF) as app:
        line = find_item(app.window.contentItem(), "trial")
        assert line is not None
        assert line.property("text") == CATALOGUES[language].text("attract-trial", shortcut="Ctrl+Shift+F9")
        assert "Ctrl+Shift+F9" in line.property("text")


@pytest.mark.parametrize("scale", [1.0, 1.3])
@pytest.mark.parametrize(("width", "height"), [(960, 540), (683, 384), (540, 960)])
def test_that_it_is_a_trial_stands_apart_from_the_names_of_the_languages(
    width: int, height: int, scale: float, tmp_path: Path, qtbot: QtBot
) -> None:
    with headless(short(languages=["en", "it"]), tmp_path, kind=SessionKind.TRIAL, mode=HALF) as app:
        window = app.window
        window.setProperty("textSize", scale)
        window.resize(width, height)
        qtbot.waitUntil(lambda: window.contentItem().width() == width)
        lay_out(window)
        shown = {str(text.property("text")): text for text in texts(window.contentItem())}
        line = find_item(window.contentItem(), "trial")
        assert line is not None
        assert painted(line).top() - painted(shown["English"]).bottom() >= 0.9 * painted(line).height()


def test_a_kiosk_that_no_shortcut_leaves_names_none(tmp_path: Path, qtbot: QtBot) -> None:
    del qtbot
    with headless(short(shortcuts={"quit": ""}), tmp_path, kind=SessionKind.TRIAL, mode=HALF) as app:
        line = find_item(app.window.contentItem(), "trial")
        assert line is not None
        assert line.property("text") == "Trial: no PIN is set"


@pytest.mark.parametrize("kind", [SessionKind.STUDY, SessionKind.SIMULATED])
def test_what_is_no_trial_is_not_called_one(kind: SessionKind, tmp_path: Path, qtbot: QtBot) -> None:
    del qtbot
    with headless(short(), tmp_path, kind=kind, mode=HALF) as app:
        assert find_item(app.window.contentItem(), "trial") is None


def test_a_pin_makes_a_study_of_a_trial() -> None:
    assert kind_of(Settings()) is SessionKind.TRIAL
    assert kind_of(short(experimenter={"pin_hash": LINE})) is SessionKind.STUDY


def test_a_trial_takes_no_place_of_the_study_and_is_listed_as_what_it_is(tmp_path: Path, qtbot: QtBot) -> None:
    del qtbot
    settings = Settings.model_validate({**TINY, "randomisation": {"target_n": {"tom": 1}, "block_size": 1}})
    for kind in (SessionKind.TRIAL, SessionKind.STUDY):
        with headless(settings, tmp_path, kind=kind, condition=None, mode=HALF) as app:
            Rehearsal(app, 1).run()
    with open_repository(tmp_path) as stored:
        told = [(each.kind.name, each.participant, each.allocation_source) for each in stored.sessions()]
        assert [(kind, who, how.value if how else None) for kind, who, how in told] == [
            ("TRIAL", "1", "list"),
            ("STUDY", "1", "list"),
        ]
    listed = CliRunner().invoke(recollect, ["sessions", "--data", str(tmp_path)]).output
    shown = [word for line in listed.splitlines() for word in line.split() if word in {"trial", "person"}]
    assert sorted(shown[:2]) == ["person", "trial"], listed
    printed = json.loads(CliRunner().invoke(recollect, ["sessions", "--data", str(tmp_path), "--json"]).output)
    assert [(each["trial"], each["simulated"]) for each in printed] == [(True, False), (False, False)]
