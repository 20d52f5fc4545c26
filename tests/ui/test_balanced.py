"""A text of several lines does not end with a word alone, and takes no line more for that."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import QObject, QUrl
from PySide6.QtQml import QQmlComponent, QQmlEngine

from kiosk.ui.window import QML

SENTENCE = "One two three four five"
Draw = Callable[[str, str, float], QObject]


@pytest.fixture
def draw(qapp: object) -> Draw:  # noqa: ARG001 - fonts need the application
    """Draw a text as an element of this type, so wide."""
    engine = QQmlEngine()

    def drawn(element: str, text: str, width: float) -> QObject:
        component = QQmlComponent(engine)
        source = f'{element} {{ width: {width}; text: "{text}"; wrapMode: Text.Wrap; font.pixelSize: 40 }}'
        component.setData(f'import QtQuick\nimport "{QML.parent.as_uri()}"\n{source}'.encode(), QUrl())
        made = component.create()
        assert made is not None, component.errorString()
        # It goes with the engine.
        made.setParent(engine)
        return made

    return drawn


def test_a_word_that_would_be_alone_gets_company(draw: Draw) -> None:
    whole = float(draw("PlainText", SENTENCE, 5_000).property("contentWidth"))
    # Four words and the space behind them fit, and the last does not.
    width = whole - 10
    usual, even = draw("PlainText", SENTENCE, width), draw("Balanced", SENTENCE, width)
    assert usual.property("lineCount") == even.property("lineCount") == 2
    assert even.property("contentWidth") < usual.property("contentWidth")


def test_each_paragraph_counts(draw: Draw) -> None:
    whole = float(draw("PlainText", SENTENCE, 5_000).property("contentWidth"))
    both, width = f"{SENTENCE}\\nOne", whole - 10
    usual, even = draw("PlainText", both, width), draw("Balanced", both, width)
    assert usual.property("lineCount") == even.property("lineCount") == 3
    assert even.property("contentWidth") < usual.property("contentWidth")


@pytest.mark.parametrize("text", [SENTENCE, "One", "One two", "Indescribably incomprehensible"])
def test_a_text_that_fits_in_its_place_is_left_as_it_is(draw: Draw, text: str) -> None:
    assert draw("Balanced", text, 5_000).property("slack") == 0
