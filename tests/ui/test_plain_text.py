"""No word of a study, a visitor or a robot is drawn as markup, fetches anything or makes a shortcut."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from socket import create_server, socket
from typing import Any

import pytest
from fluent.syntax import FluentParser, FluentSerializer, ast
from fluent.syntax.visitor import Transformer
from PySide6.QtCore import Qt, QUrl
from PySide6.QtNetwork import QNetworkAccessManager, QNetworkReply, QNetworkRequest
from PySide6.QtQml import QQmlComponent, QQmlExpression, qmlContext
from PySide6.QtQuick import QQuickItem
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from kiosk.assistance.wording import Catalogue
from kiosk.config import ASSETS, Settings
from kiosk.config import RobotConfig as RobotSettings
from kiosk.experiment.information import ConsentPage, Information
from kiosk.experiment.items import Single
from kiosk.experiment.questionnaire import Item, Questionnaire
from kiosk.experiment.session_config import StudyConfig
from kiosk.robots.adapter import AsyncRobotAdapter
from kiosk.robots.furhat import Furhat
from kiosk.robots.furhat_rules import VOICES
from kiosk.robots.selector import EmbodimentSelector
from kiosk.study.loader import read_study
from kiosk.ui.experimenter.view_model import AuthorisationStep, PanelScreen
from kiosk.ui.screens.registry import ScreenSet
from kiosk.ui.simulated_visitor import find_item, lay_out
from kiosk.ui.window import QML, ClockMode, RunMode, Window, WindowMode
from tests.robots.furhat_fake import FurhatFake
from tests.robots.recording import Interface, Reports, Waits
from tests.samples import CATALOGUES
from tests.ui.conftest import Booth
from tests.ui.looking import described

BOLD = "Is A <b>bold</b> & 3 < 4 > 2?"
PICTURE = '<img src="file:///somewhere/x.png">'
MARKUP = f"{BOLD} {PICTURE}"
PLAIN = 0
"""What ``Text.PlainText`` is."""

FILES = sorted(QML.parent.rglob("*.qml"))
DRAW_MARKUP = ("Label", "ToolTip", "TextArea", "TextEdit", "CheckBox", "RadioButton", "ItemDelegate", "MenuItem")
"""What would have to be told not to, and is not used."""
BUTTONS = ("AbstractButton", "Button", "BigButton", "PanelButton", "Choosable", "TickBox", "ScreenKey", "Step")

GALLERY = Questionnaire.read(ASSETS / "questionnaires" / "gallery.toml")


def elements(source: str) -> Iterator[tuple[str, str]]:
    """Every element of a QML file: its type, and what stands in it outside of the elements in it."""
    opened: list[tuple[str, list[str]]] = [("", [])]
    for part in re.split(r"(?<=[{}])", re.sub(r"//.*", "", source)):
        opened[-1][1].append(part[:-1])
        if part.endswith("{"):
            kind = re.search(r"\b([A-Z]\w*) $", part[:-1])
            opened.append((kind[1], []) if kind else ("", opened[-1][1]))
        elif part.endswith("}"):
            kind_of, own = opened.pop()
            if kind_of:
                yield kind_of, "".join(own)


def test_the_elements_of_a_file_are_told_apart() -> None:
    source = (
        "Item {\n  Text {\n    font { bold: true }\n    text: x\n  }\n  onX: { if (a) { g() } }\n  Row { y: 1 }\n}\n"
    )
    found = list(elements(source))
    assert [kind for kind, _ in found] == ["Text", "Row", "Item"]
    assert [[word in own for word in ("bold", "text: x", "g()", "y: 1")] for _, own in found] == [
        [True, True, False, False],
        [False, False, False, True],
        [False, False, True, False],
    ]


def test_no_screen_has_anything_that_asks_for_an_address() -> None:
    # Qt's guard does not cover this machine's own addresses, and neither does an interceptor of the engine cover these.
    asks = re.compile(
        r"XMLHttpRequest|AnimatedImage|FontLoader|MediaPlayer|WebSocket|WebEngine|openUrl|\w+://(?!visitor/)"
    )
    scripts = QML.parent.rglob("*.js")
    assert {file.name: found[0] for file in (*FILES, *scripts) if (found := asks.search(file.read_text("utf-8")))} == {}


def test_every_text_of_a_screen_is_plain() -> None:
    for file in FILES:
        source = file.read_text("utf-8")
        assert set(re.findall(r"textFormat: *(\S+)", source)) <= {"Text.PlainText", "TextEdit.PlainText"}, file
        assert "placeholderText:" not in source, file
        for kind, own in elements(source):
            # One whose content is a Text of its own draws nothing else.
            plain = "textFormat: TextEdit.PlainText" in own or "contentItem: Text " in own
            assert kind not in DRAW_MARKUP or plain, (file, own)
            assert kind != "Text" or "textFormat: Text.PlainText" in own, (file, own)
            assert kind not in BUTTONS or not re.search(r"^\s*text:", own, re.MULTILINE), (file, own)


class _Marked(Transformer):
    """Puts markup before every text of a language."""

    def visit_Pattern(self, node: ast.Pattern) -> ast.Pattern:  # noqa: N802 - fluent.syntax's name
        node.elements = [ast.TextElement(f"{MARKUP} "), *node.elements]
        return node


def marked_language(folder: Path) -> Catalogue:
    """Return the English sentences and names of cards, with markup in all of them."""
    written = folder / "en"
    written.mkdir()
    for file in (ASSETS / "sentences" / "en").glob("*.ftl"):
        resource = _Marked().visit(FluentParser().parse(file.read_text("utf-8")))
        (written / file.name).write_text(FluentSerializer().serialize(resource), "utf-8")
    return Catalogue(written)


def marked(value: Any) -> Any:
    """Return what is declared, with markup in every text of it."""
    match value:
        case {"en": str(text)}:
            return {"en": f"{MARKUP} {text}"}
        case {"id": str()}:
            names = ("id", "kind", "version", "pictures", "scale")
            return {key: item if key in names else marked(item) for key, item in value.items()}
        case dict():
            return {key: item if key in ("version", "signs") else marked(item) for key, item in value.items()}
        case list() | tuple():
            return [marked(item) for item in value]
        case str():
            return f"{MARKUP} {value}"
    return value


@pytest.fixture
def study(tmp_path: Path) -> StudyConfig:
    """Return a study with markup in every word."""
    whole = read_study(Settings(languages=("en",)))
    (plan,) = whole.plans
    sheet = Information.model_validate(marked(plan.information.model_dump()))
    return replace(whole, plans=(replace(plan, catalogue=marked_language(tmp_path), information=sheet),))


@pytest.fixture
def window(study: StudyConfig, qtbot: QtBot) -> Iterator[Window]:
    """Its window."""
    opened = Window(study, RunMode(WindowMode.NOWHERE, ClockMode.VIRTUAL))
    opened.show()
    qtbot.waitUntil(opened.shown.isExposed)
    yield opened
    opened.close()


def every(item: QQuickItem) -> Iterator[QQuickItem]:
    """All items, seen or not."""
    yield item
    for child in item.childItems():
        yield from every(child)


def text_format(item: QQuickItem) -> int:
    """How Qt draws a text."""
    context = qmlContext(item)
    assert context is not None
    told: object = QQmlExpression(context, item, "textFormat").evaluate()
    value = told[0] if isinstance(told, tuple) else told
    assert isinstance(value, int)
    return int(value)


def seen(window: Window) -> dict[str, bool]:
    """Every text that stands there, and whether it is drawn as it is written."""
    lay_out(window.shown)
    found: dict[str, bool] = {}
    for item in every(window.shown.contentItem()):
        if item.metaObject().indexOfProperty("textFormat") >= 0 and item.property("text"):
            text = str(item.property("text")).replace("\N{NO-BREAK SPACE}", " ")
            found[text] = found.get(text, True) and text_format(item) == PLAIN
    return found


def show_everything(screens: ScreenSet, study: StudyConfig) -> Iterator[str]:
    """Every screen, one after another."""
    (plan,) = study.plans
    sheet = plan.information
    screens.avatar.say(f"{MARKUP} {plan.catalogue.card('hedgehog')['card']}")
    screens.about.show(sheet.about)
    screens.consent.show(sheet.consent)
    screens.consent.show_missing((sheet.consent.purposes[0].id,))
    screens.age.ask(18)
    screens.board.deal(3, 4, 6, "fruit", practice=True)
    screens.result.show(12, 188, 60_000)
    screens.debrief.give_contact(MARKUP)
    screens.debrief.give_code("ABCD234")
    screens.debrief.show(sheet.debrief)
    for screen in ("attract", "about", "consent", "age", "introduction", "practice", "result", "debrief", "thanks"):
        screens.kiosk.show(screen)
        yield screen
    for item in GALLERY.items:
        changed: Item = type(item).model_validate(marked(item.model_dump()))
        screens.form.show((changed,), 1, 2)
        screens.kiosk.show("form")
        if item.kind != "page":
            screens.form.show_missing((item.id,))
        yield f"form: {item.kind}"
    screens.kiosk.ask_still_there(asks=True)
    yield "still there"


def test_no_text_on_any_screen_is_drawn_as_markup(window: Window, study: StudyConfig) -> None:
    for moment in show_everything(window.screens, study):
        found = seen(window)
        assert any(MARKUP in text for text in found), moment
        assert [text for text, plain in found.items() if not plain] == [], moment


def test_a_picture_in_a_text_is_asked_for_by_no_screen(
    window: Window, study: StudyConfig, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    with create_server(("127.0.0.1", 0)) as server:
        server.settimeout(0)
        picture = f'<img src="http://127.0.0.1:{server.getsockname()[1]}/{{}}.png">'
        words = {"en": picture.format("question")}
        options = [{"id": name, "text": {"en": picture.format(name)}} for name in ("one", "two")]
        item = Single.model_validate({"kind": "single", "id": "which", "text": words, "options": options})
        sheet = study.plans[0].information
        window.screens.about.show(sheet.about.model_copy(update={"title": picture.format("title")}))
        window.screens.avatar.say(picture.format("sentence"))
        monkeypatch.setitem(VOICES, picture.format("voice"), "en-GB")
        answer = health_of_a_robot_whose_voice_is(picture.format("voice"))
        line = {"name": "robot", "message": answer, "is_ok": True, "is_used": True, "is_due": False, "remedy": ""}
        panel = window.screens.experimenter.parts[2]
        fill_panel(panel)
        panel.show_health({"matters": [], "lines": [line], "more": [line]})
        window.screens.form.show((item,), 1, 1)
        for screen in ("about", "form"):
            window.screens.kiosk.show(screen)
            lay_out(window.shown)
            window.shown.grabWindow()
        panel.open(is_open=True)
        assert answer in seen(window)
        window.shown.grabWindow()
        # A text that is not plain asks at once, which shows that the others would have been heard before it.
        source = f"import QtQuick\nText {{ textFormat: Text.StyledText; text: '{picture.format('styled')}' }}"
        component = QQmlComponent(window.engine)
        component.setData(source.encode(), QUrl())
        styled = component.create()
        assert isinstance(styled, QQuickItem), component.errorString()
        styled.setParentItem(window.shown.contentItem())
        heard: dict[socket, str] = {}

        def hears_the_styled_one() -> bool:
            with suppress(BlockingIOError):
                while True:
                    connection, _ = server.accept()
                    connection.settimeout(0)
                    heard[connection] = ""
            for connection in heard:
                with suppress(BlockingIOError):
                    heard[connection] += connection.recv(1000).decode()
            return any("/styled.png" in request for request in heard.values())

        qtbot.waitUntil(hears_the_styled_one, timeout=30_000)
        assert [request.split()[1] for request in heard.values()] == ["/styled.png"]
        for connection in heard:
            connection.close()
        styled.deleteLater()


def health_of_a_robot_whose_voice_is(name: str) -> str:
    """Return what the experimenter reads about a robot whose voice has this name."""
    interface, settings = Interface(), RobotSettings(kind="furhat")
    with FurhatFake(voices={name: "en-GB"}) as fake:
        driver = Furhat(settings.model_copy(update={"host": "127.0.0.1", "port": fake.port}), "en")
        embodiments = EmbodimentSelector(Reports(), Waits().after, settings)
        robot = AsyncRobotAdapter(driver, embodiments, interface.land, look_every_ms=60_000)
        embodiments.attach_robot(robot)
        interface.settle(robot)
        message = robot.health.message
        embodiments.close()
    assert name in message
    return message


def test_qt_asks_nothing_of_another_machine(window: Window, qtbot: QtBot) -> None:
    manager = QNetworkAccessManager(window.shown)
    # An address that is kept free for examples.
    answer = manager.get(QNetworkRequest(QUrl("http://192.0.2.1/picture.png")))
    qtbot.waitUntil(answer.isFinished)
    assert answer.error() is QNetworkReply.NetworkError.ProxyNotFoundError


def test_questions_options_ends_and_hints_stand_there_as_they_were_written(window: Window, study: StudyConfig) -> None:
    for moment in show_everything(window.screens, study):
        if moment.startswith("form: "):
            item = next(item for item in GALLERY.items if moment == f"form: {item.kind}")
            wanted = {f"{MARKUP} {words['en']}" for words in item.texts()}
            # What a slider asks for stands after its question.
            begun = {text for text in wanted if any(shown.startswith(text) for shown in seen(window))}
            assert begun == wanted, moment
        elif moment in ("about", "consent", "debrief"):
            page = getattr(study.plans[0].information, moment)
            # A heading stands apart from what is below it, and is a sentence before it in what the helper says.
            read = (part for paragraph in page.paragraphs for part in paragraph.split("\n"))
            wanted = {page.title, *read, *(purpose.text for purpose in getattr(page, "purposes", ()))}
            shown = seen(window)
            assert [text for text in wanted if not any(text in each for each in shown)] == [], moment


def fill_panel(panel: PanelScreen) -> None:
    """Show markup in every part of the experimenter's panel."""
    words = dict.fromkeys(_names_of_the_panel(), MARKUP)
    option = [{"value": "one", "label": MARKUP}, {"value": "two", "label": BOLD}]
    line = {"name": MARKUP, "message": PICTURE, "is_ok": False, "is_used": True, "is_due": False, "remedy": BOLD}
    panel.set_language(words)
    panel.show_health({"matters": [line, line | {"is_due": True}], "lines": [line], "more": [line]})
    tile = {"name": "visitors", "title": MARKUP, "value": BOLD, "line": PICTURE}
    panel.show_today({"clock": MARKUP, "tiles": [tile]})
    panel.list_shortcuts({"title": MARKUP, "rows": [{"keys": BOLD, "words": MARKUP}]})
    panel.show_records(
        {
            "listed": True,
            "cells": [{"name": MARKUP, "listed": True, "done": BOLD, "share": 0.5, "counts": ["1", "2", "3", "4"]}],
            "visits": MARKUP,
            "sessions": [
                dict.fromkeys(("participant", "when", "condition", "stage", "status", "reason", "robot"), BOLD)
                | {"odd": True, "under_way": False}
            ],
            "deviations": [{"when": "12:00", "words": MARKUP, "reason": PICTURE}],
            "more": MARKUP,
            "resumable": [{"number": "1", "label": MARKUP}],
        }
    )
    chosen = dict.fromkeys(("condition", "embodiment", "language", "volume"), "one")
    lists = dict.fromkeys(("conditions", "embodiments", "languages", "volumes", "breaks"), option)
    flags = {"underWay": True, "canBeNext": True, "muted": False, "named": False, "staysPaused": False, "onBreak": True}
    panel.show_choices({**chosen, **lists, **flags, "session": MARKUP, "backup": MARKUP})


def test_no_text_of_the_panel_its_card_and_its_note_is_drawn_as_markup(window: Window) -> None:
    card, note, panel = window.screens.experimenter.parts
    fill_panel(panel)
    panel.open(is_open=True)
    note.tell(MARKUP)
    card.show(AuthorisationStep.REASON, MARKUP, MARKUP, reasons=(MARKUP, BOLD))
    found = seen(window)
    assert {MARKUP, BOLD, PICTURE, f"1   {MARKUP}", f"{MARKUP}: {MARKUP}"} <= found.keys()
    assert [text for text, plain in found.items() if not plain] == []
    card.show(AuthorisationStep.WORDS, MARKUP, MARKUP, text=MARKUP)
    assert [text for text, plain in seen(window).items() if not plain] == []


def _names_of_the_panel() -> set[str]:
    """Return the messages that the panel shows as they stand."""
    files = (QML.parent / "panel").glob("*.qml")
    return {name for file in files for name in re.findall(r'"(console-[a-z-]+)"', file.read_text("utf-8"))} | {
        f"console-counts-{name}" for name in ("dropped", "overridden", "beyond", "withdrawn")
    }


@pytest.mark.usefixtures("spoken")
def test_an_ampersand_in_an_option_is_no_shortcut_and_is_told(booth: Booth) -> None:
    options = [{"id": "one", "text": {"en": "Q&A"}}, {"id": "two", "text": {"en": BOLD}}]
    booth.ask(Single.model_validate({"kind": "single", "id": "which", "text": {"en": BOLD}, "options": options}))
    given: list[object] = []
    booth.app.screens.form.answered.connect(lambda _, value: given.append(value))
    QTest.keyClick(booth.app.window, Qt.Key.Key_A, Qt.KeyboardModifier.AltModifier)
    assert given == []
    assert described(booth.item("option-which-one"))[1] == f"{BOLD} Q&A"
    assert described(booth.item("option-which-two"))[1] == f"{BOLD} {BOLD}"
    booth.click("option-which-one")
    assert given == ["one"]


@pytest.mark.usefixtures("spoken")
def test_an_ampersand_in_the_consent_ticks_no_box(booth: Booth) -> None:
    purposes = [{"id": "one", "text": "Q&A"}, {"id": "two", "text": BOLD}]
    page = {"title": BOLD, "paragraphs": [MARKUP], "purposes": purposes}
    booth.app.screens.consent.show(ConsentPage.model_validate(page))
    booth.app.screens.kiosk.show("consent")
    booth.settle()
    ticked: list[str] = []
    booth.app.screens.consent.ticked.connect(lambda purpose, _: ticked.append(purpose))
    QTest.keyClick(booth.app.window, Qt.Key.Key_A, Qt.KeyboardModifier.AltModifier)
    assert ticked == []
    assert described(booth.item("purpose-two"))[1] == BOLD
    booth.click("purpose-one")
    assert ticked == ["one"]


@pytest.mark.usefixtures("spoken")
def test_no_letter_of_a_button_is_lost_to_those_who_cannot_see_it(window: Window, study: StudyConfig) -> None:
    window.screens.about.show(study.plans[0].information.about)
    window.screens.kiosk.show("about")
    lay_out(window.shown)
    button = find_item(window.shown.contentItem(), "continue")
    assert button is not None
    assert described(button)[1] == f"{MARKUP} {CATALOGUES['en'].text('about-continue')}"
