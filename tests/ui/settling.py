"""Lay out pages of a questionnaire in every size, script and number of items, and count until they settle.

    python -m tests.ui.settling            # every combination
    python -m tests.ui.settling --every 7  # every seventh of them
    python -m tests.ui.settling --only "3 likert, latin, 1920 x 1080"

A page that does not settle would keep this process busy for ever, so it ends itself with exit code 3 and names the page
on the error stream.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

os.environ["QT_QPA_PLATFORM"] = "offscreen"
os.environ["QT_QUICK_BACKEND"] = "software"
os.environ["QSG_RENDER_LOOP"] = "basic"
os.environ["QT_LOGGING_RULES"] = "qt.text.font.db=false"

from PySide6.QtCore import QSize
from PySide6.QtGui import QGuiApplication
from PySide6.QtQuick import QQuickItem

from kiosk.study.declared.questionnaire import Item, Questionnaire
from kiosk.ui.rehearsing.hand import lay_out
from tests.ui.headless import SMALL, headless

MOST_CHANGES = 60
"""Changes of one size while a page is laid out; a page that settles takes a handful for each of its items."""

SIZES = ((1920, 1080), (1280, 720), (1366, 768), (1080, 1920), (3840, 2160))
TEXT_SIZES = tuple(round(0.9 + step / 100, 2) for step in range(61))
SCRIPTS = {
    "latin": (
        "I would like to play this game with the robot again, at home or elsewhere.",
        "not at all",
        "very much",
    ),
    "arabic": (
        "أود أن ألعب هذه اللعبة مع الروبوت مرة أخرى في البيت أو في أي مكان آخر.",
        "لا أوافق أبداً",
        "أوافق تماماً",
    ),
    "hindi": (
        "मैं यह खेल रोबोट के साथ घर पर या कहीं और फिर से खेलना चाहूँगा या चाहूँगी।",
        "बिल्कुल नहीं",
        "पूरी तरह से सहमत",
    ),
    "japanese": (
        "このゲームをロボットと一緒に家や他の場所でもう一度遊んでみたいと思います。",
        "全くそう思わない",
        "とてもそう思う",
    ),
}
KINDS = ("likert", "differential", "pictures", "slider", "single", "multiple", "integer", "text")
ALL = (*KINDS, "mixed", "likert with long ends")

Page = tuple[tuple[int, int], str, str, int, float]
"""The window, the kind of items, the script, how many items, and the text size."""


def item(kind: str, script: str, number: int) -> dict[str, Any]:
    """One item of a kind in a script, as a questionnaire file has it."""
    text, low, high = SCRIPTS[script]
    common: dict[str, Any] = {"id": f"item{number}", "kind": kind, "text": {"en": text}}
    ends = {"lowest": {"en": low}, "highest": {"en": high}}
    own: dict[str, dict[str, Any]] = {
        "likert": {"points": 11, **ends},
        "differential": {"points": 9, "left": {"en": low}, "right": {"en": high}},
        "pictures": {"points": 5, "pictures": "faces", **ends},
        "slider": {"lowest": -50, "highest": 50, "left": {"en": low}, "right": {"en": high}},
        "single": {"options": [{"id": f"o{each}", "text": {"en": text}} for each in range(4)]},
        "multiple": {"options": [{"id": f"o{each}", "text": {"en": high}} for each in range(5)]},
        "integer": {"lowest": 0, "highest": 120},
        "text": {"longest": 120},
    }
    return common | own[kind]


def page(kind: str, script: str, count: int) -> tuple[Item, ...]:
    """A page of so many items of a kind; ``mixed`` takes one kind after another."""
    kinds = [KINDS[number % len(KINDS)] if kind == "mixed" else kind.split(maxsplit=1)[0] for number in range(count)]
    items = [item(each, script, number) for number, each in enumerate(kinds)]
    if kind.endswith("long ends"):
        for each in items:
            for end in ("lowest", "highest"):
                each[end] = {"en": 4 * each[end]["en"]}
    made = Questionnaire.model_validate({"id": "settling", "version": "1", "note": "A test.", "items": items})
    return made.items


class Watcher:
    """Counts how often any size of what is shown changes, and ends the process when there is no end to it."""

    def __init__(self) -> None:
        self.page = ""
        self.most = 0
        self._changes: dict[int, int] = {}
        self._seen: set[int] = set()

    def begin(self, page: str) -> None:
        """Count from 0 for this page."""
        self.page = page
        self._changes.clear()
        self._seen.clear()

    def watch(self, item: QQuickItem) -> None:
        """Count the changes of this item and of all within it."""
        if id(item) not in self._seen:
            self._seen.add(id(item))
            number = id(item)
            item.heightChanged.connect(lambda: self._changed(number))
            item.widthChanged.connect(lambda: self._changed(number))
        for child in item.childItems():
            self.watch(child)

    def _changed(self, number: int) -> None:
        self._changes[number] = self._changes.get(number, 0) + 1
        self.most = max(self.most, self._changes[number])
        if self._changes[number] > MOST_CHANGES:
            sys.stderr.write(f"the page does not settle: {self.page}\n")
            sys.stderr.flush()
            os._exit(3)


def panes(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every pane that scrolls, whatever is in it."""
    if item.metaObject().className().startswith("ScrollPane"):
        yield item
    for child in item.childItems():
        yield from panes(child)


def name_of(page: Page) -> str:
    """What a page is called."""
    (width, height), kind, script, count, text_size = page
    return f"{count} {kind}, {script}, {width} x {height}, text size {text_size}"


def main(arguments: list[str]) -> int:
    """Lay out the pages; the last line says how many there were, and the most changes that one size took."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--every", type=int, default=1, help="lay out every so many-th combination only")
    parser.add_argument("--only", default="", help="lay out only those whose name contains this")
    options = parser.parse_args(arguments)
    application = QGuiApplication.instance() or QGuiApplication([])
    watcher, laid_out = Watcher(), 0
    every: list[Page] = list(product(SIZES, ALL, SCRIPTS, range(1, 6), TEXT_SIZES))
    wanted = [each for each in every if options.only in name_of(each)][:: options.every]
    with TemporaryDirectory() as data, headless(SMALL, Path(data)) as app:
        form = app.screens.form
        app.screens.kiosk.show("form")
        watched = list(panes(app.window.contentItem()))
        for pane in watched:
            # The pane alone: its column and bar follow from it, and what stands in it is made anew for every page.
            watcher.watch(pane)
        for each in wanted:
            size, kind, script, count, text_size = each
            watcher.begin(name_of(each))
            if app.window.size() != QSize(*size):
                app.window.resize(*size)
            app.window.setProperty("textSize", text_size)
            form.show(page(kind, script, count), 1, 2)
            lay_out(app.window)
            application.processEvents()
            laid_out += 1
    sys.stdout.write(f"{laid_out} pages settled; the most changes of one size were {watcher.most}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
