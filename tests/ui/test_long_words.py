"""Words with no place to break stay readable and cover nothing: compounds, addresses, and scripts without spaces."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from fluent.syntax import FluentParser, FluentSerializer, ast
from fluent.syntax.visitor import Transformer
from PySide6.QtGui import QGuiApplication

from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS, Settings
from kiosk.experiment.information import Information
from kiosk.experiment.session_config import StudyConfig
from kiosk.study.loader import read_study
from kiosk.ui.simulated_visitor import lay_out
from kiosk.ui.window import Window
from tests.ui.headless import open_window
from tests.ui.settling import pages
from tests.ui.test_every_language_fits import SIZES, assert_all_can_be_read, moments, resize, show_alone

PAGES = [page for page in pages() if page.name.endswith("no place to break") and page.name[0] in "a135"]


class _Joined(Transformer):
    """Takes the spaces out of every text of a language."""

    def visit_TextElement(self, node: ast.TextElement) -> ast.TextElement:  # noqa: N802 - fluent.syntax's name
        node.value = joined(node.value)
        return node


def joined(text: str) -> str:
    """Return a text without a space."""
    return text.replace(" ", "")


def rejoined(value: Any) -> Any:
    """Return what is declared, without a space in any text of it."""
    match value:
        case str():
            return joined(value)
        case dict():
            return {key: item if key in ("id", "version", "signs") else rejoined(item) for key, item in value.items()}
        case list() | tuple():
            return [rejoined(item) for item in value]
    return value


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> StudyConfig:
    """Return a study in a language whose sentences are single words."""
    whole = read_study(Settings(languages=("en",)))
    (plan,) = whole.plans
    folder = tmp_path_factory.mktemp("joined") / "en"
    folder.mkdir()
    for file in (ASSETS / "sentences" / "en").glob("*.ftl"):
        resource = _Joined().visit(FluentParser().parse(file.read_text("utf-8")))
        (folder / file.name).write_text(FluentSerializer().serialize(resource), "utf-8")
    sheet = Information.model_validate(rejoined(plan.information.model_dump()))
    screen = plan.settings.screen.model_copy(update={"text_size": 1.3})
    settings = plan.settings.model_copy(update={"screen": screen})
    there = replace(plan, catalogue=Catalogue(folder), information=sheet, settings=settings)
    return replace(whole, plans=(there,))


@pytest.fixture(scope="module")
def window(study: StudyConfig, qapp: QGuiApplication) -> Iterator[Window]:  # noqa: ARG001 - Qt is to be there before
    """Its window, with texts as large as they can be."""
    with open_window(study) as opened:
        yield opened


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_long_words_are_broken_and_cover_nothing(window: Window, width: int, height: int) -> None:
    resize(window, width, height)
    window.screens.avatar.say("w" * 100)
    for page in PAGES:
        page.fill(window.screens)
        show_alone(window, page.screen)
        lay_out(window.shown)
        assert_all_can_be_read(window.shown, page.name)


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_a_language_without_spaces_is_readable_on_every_screen(
    window: Window, study: StudyConfig, width: int, height: int
) -> None:
    resize(window, width, height)
    for moment, screen, fill in moments(window.screens, study):
        fill()
        show_alone(window, screen)
        lay_out(window.shown)
        assert_all_can_be_read(window.shown, moment)
