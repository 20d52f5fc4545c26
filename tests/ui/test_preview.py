"""The preview shows every screen of a study, follows its files, and finds the text that was clicked on."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPointF, QUrl
from PySide6.QtQml import QQmlApplicationEngine
from PySide6.QtQuick import QQuickItem
from pytestqt.qtbot import QtBot

from kiosk.cli.study_texts import EditedStudy
from kiosk.ui.preview import QML, PreviewModel
from kiosk.ui.window import WindowMode

STUDY = """# Ours
title = "Ours"
languages = ["en", "it"]
stages = ["about", "consent", "introduction", "game", "result", "questions", "debrief", "thanks"]
questionnaires = ["trust"]

[texts.en]
about-continue = "Carry on"  # friendlier
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a study file."""
    file = tmp_path_factory.mktemp("preview") / "study.toml"
    file.write_text(STUDY)
    return file


@pytest.fixture(scope="module")
def opened(qapp: object, study: Path) -> Iterator[PreviewModel]:  # noqa: ARG001 - Qt has to be there
    """Return one preview for all tests: a window is dear."""
    model = PreviewModel(study, EditedStudy(study), WindowMode.NOWHERE)
    yield model
    model.close()


@pytest.fixture
def preview(opened: PreviewModel, study: Path) -> PreviewModel:
    """Return the preview of the study as it was at first."""
    study.write_text(STUDY)
    opened.reload()
    for what, value in (("language", "en"), ("size", "1280 x 720"), ("screen", "attract")):
        opened.pick(what, value)
    return opened


def item_with(preview: PreviewModel, words: str) -> QQuickItem:
    found = [preview.window.contentItem()]
    for item in found:
        found += item.childItems()
    return next(item for item in found if item.property("text") == words and item.isVisible())


def click(preview: PreviewModel, words: str) -> None:
    item = item_with(preview, words)
    place = item.mapToScene(QPointF(item.width() / 2, min(item.height(), 20) / 2))
    preview.press(place.x() / preview.window.width(), place.y() / preview.window.height())


def test_every_screen_is_shown_in_every_language_and_size(preview: PreviewModel) -> None:
    for language in preview.property("languages"):
        preview.pick("language", language)
        for name in preview.property("screens"):
            preview.pick("screen", name)
            assert preview.property("screen") == name
            assert preview.picture.image.width() == 1280
    first = ["attract", "about", "consent", "introduction", "game"]
    assert preview.property("screens")[:5] == first
    preview.pick("size", "720 x 1280")
    assert (preview.picture.image.width(), preview.picture.image.height()) == (720, 1280)


def test_a_screen_has_the_buttons_and_the_progress_of_a_visit(preview: PreviewModel) -> None:
    def shown(screen: str) -> set[str]:
        preview.pick("screen", screen)
        names = ("control-stop", "control-language", "back", "progress")
        found = {name: preview.window.findChildren(QQuickItem, name) for name in names}
        return {name for name, items in found.items() if any(item.isVisible() for item in items)}

    always = {"control-stop", "control-language", "progress"}
    assert shown("attract") == set()
    assert shown("about") == always
    assert shown("consent") == {*always, "back"}
    assert shown("introduction") == always


def test_a_change_is_shown_and_a_fault_keeps_the_last_good_view(
    preview: PreviewModel, study: Path, qtbot: QtBot
) -> None:
    preview.pick("screen", "about")
    study.write_text(STUDY.replace("Carry on", "Next page"))
    qtbot.waitUntil(lambda: "Next page" in texts(preview), timeout=5000)
    before = preview.picture.image
    study.write_text(STUDY.replace('"trust"', '"mistrust"'))
    qtbot.waitUntil(lambda: preview.property("fault") != "", timeout=5000)
    assert "mistrust" in preview.property("fault")
    assert preview.property("screen") == "about"
    assert preview.picture.image == before
    study.write_text(STUDY)
    qtbot.waitUntil(lambda: preview.property("fault") == "", timeout=5000)
    assert "Carry on" in texts(preview)


def texts(preview: PreviewModel) -> list[str]:
    found = [preview.window.contentItem()]
    for item in found:
        found += item.childItems()
    return [item.property("text") for item in found if item.property("text")]


def test_a_click_on_a_text_names_its_file_and_key_and_changes_it(preview: PreviewModel, study: Path) -> None:
    preview.pick("screen", "about")
    click(preview, "Carry on")
    assert preview.property("found") == f"{study}: about-continue"
    assert preview.property("editable")
    preview.write("Go { $nowhere }")
    assert "nowhere" in preview.property("fault")
    assert study.read_text() == STUDY
    click(preview, "Carry on")
    preview.write("Onwards")
    assert study.read_text() == STUDY.replace("Carry on", "Onwards")
    assert "Onwards" in texts(preview)
    assert preview.property("fault") == ""


def test_a_text_of_a_shipped_questionnaire_says_what_to_do(preview: PreviewModel) -> None:
    preview.pick("screen", "debrief")
    title = preview._study.plans[0].information.debrief.title
    click(preview, title)
    assert "comes with Recollect" in preview.property("note")
    assert not preview.property("editable")


def test_the_window_shows_the_picture_and_the_lists(preview: PreviewModel) -> None:
    engine = QQmlApplicationEngine()
    warnings: list[object] = []
    engine.warnings.connect(warnings.extend)
    engine.addImageProvider("visitor", preview.picture)
    engine.setInitialProperties({"preview": preview})
    engine.load(QUrl.fromLocalFile(str(QML)))
    (window,) = engine.rootObjects()
    assert window.property("title") == "Ours"
    assert not warnings
    window.setProperty("visible", False)  # noqa: FBT003 - Qt's way to set a property
    engine.deleteLater()
    QCoreApplication.sendPostedEvents(engine, QEvent.Type.DeferredDelete)


CONDITIONAL = """id = "own"
version = "1"
note = "Ours."

[[items]]
id = "plays"
kind = "single"
text.en = "Do you play?"
text.it = "Giochi?"
options = [{ id = "yes", text.en = "Yes", text.it = "Sì" }, { id = "no", text.en = "No", text.it = "No" }]

[[items]]
id = "often"
kind = "likert"
points = 5
relevant = "plays = 'yes'"
text.en = "How often?"
text.it = "Quanto spesso?"
lowest = { en = "never", it = "mai" }
highest = { en = "always", it = "sempre" }
"""


@pytest.mark.parametrize("per_page", [1, 2])
def test_the_viewer_answers_and_items_come_and_go_with_their_conditions(
    preview: PreviewModel, study: Path, qtbot: QtBot, per_page: int
) -> None:
    (study.parent / "own.toml").write_text(f"per_page = {per_page}\n{CONDITIONAL}")
    study.write_text(STUDY.replace('"trust"', '"./own.toml"'))
    preview.reload()
    last = f"questions {3 - per_page}"
    preview.pick("screen", last)
    assert "How often?" in texts(preview)
    preview.pick("screen", "questions 1")
    preview.answer(answers=True)
    assert not shows(preview, "How often?")
    assert (last in preview.property("screens")) is (last == "questions 1")
    qtbot.waitUntil(lambda: touched(preview, "Yes", "plays"), timeout=5000)
    preview.pick("screen", last)
    assert shows(preview, "How often?")
    preview.pick("screen", "questions 1")
    qtbot.waitUntil(lambda: touched(preview, "No", "plays"), timeout=5000)
    assert not shows(preview, "How often?")
    preview.answer(answers=False)
    preview.pick("screen", last)
    assert shows(preview, "How often?")


def shows(preview: PreviewModel, words: str) -> bool:
    found = [preview.window.contentItem()]
    for item in found:
        found += [child for child in item.childItems() if child.isVisible()]
    return any(item.property("text") == words for item in found)


def touched(preview: PreviewModel, words: str, item: str) -> bool:
    """Touch an option, which takes no input at first, and tell whether it is chosen."""
    click(preview, words)
    return preview._window.screens.form.given.get(item) == words.lower()


def test_another_size_lays_the_screen_out_anew(preview: PreviewModel) -> None:
    preview.pick("screen", "about")
    for size in ("1920 x 1080", "1280 x 720", "720 x 1280"):
        preview.pick("size", size)
        width, height = map(int, size.split(" x "))
        button = item_with(preview, "Carry on")
        place = button.mapToScene(QPointF(button.width(), button.height()))
        assert 0.5 * width < place.x() <= width
        assert 0.5 * height < place.y() <= height
