"""A visitor comes back with the code of their card, and is the same participant."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from kiosk.config import ASSETS, Settings
from kiosk.experiment import events as happened
from kiosk.experiment.outcomes import Stage
from kiosk.store.codes import make_code
from kiosk.store.queries import open_repository
from kiosk.store.verify import verify
from kiosk.ui.app import App
from kiosk.ui.rehearsal import Rehearsal
from kiosk.ui.simulated_visitor import BehaviourProfile, cut_texts
from tests.ui.conftest import Booth
from tests.ui.headless import HALF, headless
from tests.ui.visiting import PAIR

LINK = '[[consent.purposes]]\nid = "return"\nrequired = false\ntext = "You may link my visits."\n\n'

Visit = Callable[..., Rehearsal]


@pytest.fixture
def study(tmp_path: Path) -> Settings:
    """Return a study that lets visitors come back, and asks about them once."""
    folder = tmp_path / "consent"
    folder.mkdir()
    for sheet in (ASSETS / "consent" / "study").glob("*.toml"):
        (folder / sheet.name).write_text(sheet.read_text("utf-8").replace("[debrief]", f"{LINK}[debrief]"), "utf-8")
    form = (ASSETS / "questionnaires" / "about-you.toml").read_text("utf-8")
    (tmp_path / "about.toml").write_text(f'visits = "first"\n{form}', "utf-8")
    given = {
        **PAIR,
        "about_you": str(tmp_path / "about.toml"),
        "consent": {"text": str(folder)},
        "questionnaires": ["trust"],
        "returning": {"enabled": True},
        "randomisation": {"target_n": {"tom": 2, "notom": 2}, "block_size": 2, "seed": 3},
    }
    return Settings.model_validate(given)


@pytest.fixture
def visit(study: Settings, tmp_path: Path) -> Visit:
    """Return what has one visitor come to a kiosk that was started anew."""

    def visit(seed: int, **more: object) -> Rehearsal:
        with headless(study, tmp_path / "data", condition=None, mode=HALF) as app:
            rehearsal = Rehearsal(app, seed, visitor=BehaviourProfile(links=True, **more))  # type: ignore[arg-type]
            rehearsal.run()
            return rehearsal

    return visit


@pytest.mark.usefixtures("qapp")
def test_two_visits_are_of_one_participant_and_take_one_slot(visit: Visit, tmp_path: Path) -> None:
    first = visit(1)
    again = visit(2, code=first.code)
    visit(3)
    assert again.code == first.code != ""
    assert verify(tmp_path / "data") == []
    with open_repository(tmp_path / "data") as stored:
        sessions = stored.sessions()
        assert [(each.participant, each.visit) for each in sessions] == [("1", 1), ("1", 2), ("2", 1)]
        assert [each.allocation_source.value for each in sessions if each.allocation_source] == [
            "list",
            "returning",
            "list",
        ]
        assert sessions[1].condition == sessions[0].condition != sessions[2].condition
        reached = [{e.stage for e in stored.events(n) if isinstance(e, happened.StageEntered)} for n in (1, 2)]
        assert [Stage.ABOUT_YOU in stages for stages in reached] == [True, False]
        assert Stage.QUESTIONS in reached[1]
        assert all(Stage.CONSENT in stages for stages in reached)


@pytest.fixture
def asked(study: Settings, tmp_path: Path, qtbot: QtBot) -> object:
    """Provide a booth on whose about page the visitor said that they were here before."""
    with headless(study, tmp_path / "data", condition=None, mode=HALF) as app:
        qtbot.waitUntil(lambda: app.window.isExposed() and app.window.isActive())
        booth = Booth(app, tmp_path / "data")
        booth.click("start-en")
        booth.click("return-offer")
        yield booth


def type_code(booth: Booth, code: str) -> None:
    """Type a code by the keys on the screen."""
    for character in code.replace("-", ""):
        booth.click(f"code-{character}")


def line(app: App) -> str:
    """Return what the card says."""
    return str(app.screens.returning.property("line"))


def test_a_mistyped_code_is_told_at_once_and_can_be_mended(asked: Booth) -> None:
    code = make_code("").replace("-", "")
    wrong = code[:-1] + ("2" if code[-1] != "2" else "3")
    type_code(asked, wrong)
    assert line(asked.app).startswith("A letter or a digit")
    assert not asked.item("return-go").isEnabled()
    asked.click("code-delete")
    type_code(asked, code[-1])
    assert asked.item("return-go").isEnabled()
    assert list(cut_texts(asked.app.window)) == []


def test_after_three_codes_that_are_not_known_the_visitor_goes_on_as_new(asked: Booth) -> None:
    for attempt in range(3):
        type_code(asked, make_code(""))
        asked.click("return-go")
        if attempt < 2:
            assert line(asked.app).startswith("This code is not known here")
    asked.click("return-on")
    asked.settle()
    assert not asked.sees("return-offer")
    asked.click("continue")
    assert asked.screen == "age"


def test_a_keyboard_types_the_code_too_and_escape_leaves_it(asked: Booth) -> None:
    asked.settle()
    for letter in "aB0c":
        asked.app.screens.returning.type(letter)
    assert asked.app.screens.returning.property("shown") == "ABC··-·····"
    asked.click("return-new")
    asked.settle()
    assert not asked.sees("return-code")
    asked.click("return-offer")
    assert asked.app.screens.returning.property("shown") == "·····-·····"


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (1080, 1920)])
def test_the_card_fits_with_large_texts_in_every_language(asked: Booth, width: int, height: int, qtbot: QtBot) -> None:
    window, languages = asked.app.window, []
    window.setProperty("textSize", 1.3)
    window.resize(width, height)
    for plan in asked.app.assigner.study.plans:
        languages.append(plan.language)
        asked.app.screens.set_language(plan.catalogue)
        asked.app.screens.returning.refuse()
        qtbot.waitUntil(lambda: window.contentItem().width() == width)
        assert list(cut_texts(window)) == [], plan.language
        for name in ("code-2", "code-delete", "return-go", "return-new"):
            item = asked.item(name)
            place = item.mapRectToScene(item.boundingRect())
            assert place.top() >= 0, plan.language
            assert place.bottom() <= height, plan.language
    assert {"en", "it", "es"} <= set(languages)
