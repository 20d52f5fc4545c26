"""Lay out every page in every size, script and number of items, and count how often its size changes until it settles.

    python -m tests.ui.settling             # every page, in every text size and window
    python -m tests.ui.settling --every 24  # every page, in one window and every 24th text size
    python -m tests.ui.settling --every 61  # every page, in one window and one text size
    python -m tests.ui.settling --only "3 likert, latin"
    python -m tests.ui.settling --every 24 --also "3 likert, latin"

Qt is asked to lay out and never to paint, which takes most of the time. A page that does not settle would keep this
process busy for ever, so the process ends itself with exit code 3 and names the page on the error stream.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import product
from typing import Any

os.environ["QT_QPA_PLATFORM"] = "offscreen"
os.environ["QT_QUICK_BACKEND"] = "software"
os.environ["QSG_RENDER_LOOP"] = "basic"
os.environ["QT_NO_GUI_THREADPOOL"] = "1"
# A machine without a font for one of the scripts shows boxes, which have a size as well; Qt says so for every text.
os.environ["QT_LOGGING_RULES"] = "qt.text.font.db=false"

# Pydantic loads its parts late, which fails while PySide6 looks at every import: so it comes first.
from kiosk.experiment.information import ConsentPage, Page
from kiosk.experiment.questionnaire import KINDS, Item

# isort: split
from pydantic import TypeAdapter
from PySide6.QtCore import QCoreApplication, QEvent, QObject, QSizeF
from PySide6.QtQml import QQmlComponent, QQmlEngine
from PySide6.QtQuick import QQuickItem, QQuickRenderControl, QQuickWindow

from kiosk.config import Settings
from kiosk.study.loader import read_study
from kiosk.ui.screens.registry import ScreenSet
from kiosk.ui.window import QML, WindowMode, application

TEXT_SIZES = [size / 100 for size in range(90, 151)]
WINDOWS = [(1920, 1080), (1280, 720), (1366, 768), (1080, 1920), (3840, 2160)]
MOST_ITEMS = 5
MOST_CHANGES = 60
"""Changes of one size while a page is laid out; a page that settles takes a handful for each of its items."""


@dataclass(frozen=True)
class Script:
    """Texts of one script: a question, a short word and a long one."""

    question: str
    short: str
    long: str


SCRIPTS = {
    "latin": Script(
        "I would like to play this game with the robot again, at home or elsewhere.",
        "not at all",
        "I agree with this completely, and have always done so before",
    ),
    "arabic": Script(
        "أود أن ألعب هذه اللعبة مع الروبوت مرة أخرى في المنزل أو في أي مكان آخر مع الأصدقاء.",
        "لا أوافق",
        "أوافق على ذلك تماما وقد كنت أوافق عليه دائما من قبل أيضا",
    ),
    "hindi": Script(
        "मैं इस रोबोट के साथ यह खेल घर पर या कहीं और फिर से खेलना चाहूँगा या चाहूँगी।",
        "बिल्कुल नहीं",
        "मैं इससे पूरी तरह सहमत हूँ और पहले भी हमेशा सहमत रहा हूँ",
    ),
    "japanese": Script(
        "このゲームを家や他の場所でもう一度ロボットと一緒に遊んでみたいと思いますか。お答えください。",
        "全くそう思わない",
        "完全に同意しますし、以前からずっとそのように考えてきました。これからも同じです",
    ),
    "no place to break": Script("Rindfleischetikettierungsüberwachung" * 3, "w" * 30, "Aufgabenübertragungsgesetz" * 3),
}

SOURCE = """
import QtQuick
import Recollect
import "."

Item {
    id: root
    required property KioskScreen kiosk
    required property %(screen)s %(name)s
    property real textSize: 1
    readonly property bool wide: width >= height
    Binding {
        target: Theme
        property: "unit"
        value: Math.min(root.width / (root.wide ? 1920 : 1080), root.height / (root.wide ? 1080 : 1920))
    }
    Binding { target: Theme; property: "textSize"; value: root.textSize }
    %(view)s {
        width: root.wide ? root.width * 0.715 : root.width
        height: root.wide ? root.height : root.height * 0.64
        %(name)s: root.%(name)s
        words: root.kiosk.words
        %(more)s
    }
}
"""
"""One view, with the room and the theme that the window gives it."""

SOURCES = {
    name: SOURCE % {"name": name, "screen": f"{name.title()}Screen", "view": f"{name.title()}View", "more": more}
    for name, more in dict.fromkeys(("form", "about", "consent", "debrief"), "kiosk: root.kiosk").items()
}
SOURCES["debrief"] = SOURCES["debrief"].replace("kiosk: root.kiosk", 'kiosk: root.kiosk; labName: "A lab"')
SOURCES["about"] = (
    SOURCES["about"]
    .replace("kiosk: root.kiosk", "kiosk: root.kiosk; returning: root.returning")
    .replace("property real textSize", "required property ReturnScreen returning\n    property real textSize", 1)
)

ITEMS: TypeAdapter[Item] = TypeAdapter(Item)
Filling = Callable[[ScreenSet], None]


def item(kind: str, number: int, script: Script) -> Item:
    """Return an item of this kind with as much text as items have in questionnaires."""
    kind, _, long_ends = kind.partition(", ")
    short, long = {"en": script.short}, {"en": script.long}
    ends = {"left": short, "right": long}
    bounds = {"lowest": short, "highest": long if long_ends else short}
    own: dict[str, dict[str, Any]] = {
        "likert": {"points": 11, **bounds},
        "differential": {"points": 7, **ends},
        "pictures": {"points": 5, **bounds},
        "slider": ends,
        "page": {"text": {"en": " ".join([script.question] * 12)}},
    }
    options = [{"id": f"option{n}", "text": text} for n, text in enumerate((short, long, short, long))]
    own |= {several: {"options": options} for several in ("single", "multiple")}
    common = {"kind": kind, "id": f"item{number}", "text": {"en": script.question}}
    made: Item = ITEMS.validate_python({**common, **own.get(kind, {})})
    return made


@dataclass(frozen=True)
class Sheet:
    """A page to lay out: its name, the screen that it is on, and how that is filled."""

    name: str
    screen: str
    fill: Filling
    block: int
    """Pages of one block have the same script and number of items, and are tried in the same sizes.

    A letter of a new size takes long to draw up, so a size of its own for every page would take a quarter longer.
    """


def pages() -> Iterator[Sheet]:
    """Every page: items of one kind, of several, and texts."""
    asked = [kind for kind in KINDS if kind != "page"]
    alike = [*asked, "likert, long ends"]
    blocks = product(SCRIPTS.items(), range(1, MOST_ITEMS + 1))
    for block, ((script, texts), count) in enumerate(blocks):
        sets = {kind: (kind,) * count for kind in alike}
        sets |= {"several kinds": tuple(asked[:count]), "several other kinds": tuple(reversed(asked))[:count]}
        for name, kinds in sets.items():
            items = tuple(item(kind, number, texts) for number, kind in enumerate(kinds))
            yield Sheet(f"{count} {name}, {script}", "form", partial(_ask, items), block)
        page = Page(title=texts.short, paragraphs=tuple([texts.question * 3] * count))
        yield Sheet(f"{count} paragraphs to read, {script}", "about", partial(_tell, page), block)
        yield Sheet(f"{count} paragraphs of a debriefing, {script}", "debrief", partial(_debrief, page), block)
        purposes = [{"id": f"purpose{n}", "text": f"{texts.question} {texts.long}"} for n in range(count)]
        consent = ConsentPage.model_validate({**page.model_dump(), "purposes": purposes})
        yield Sheet(f"{count} purposes to agree to, {script}", "consent", partial(_ask_consent, consent), block)
    for block, (script, texts) in enumerate(SCRIPTS.items()):
        yield Sheet(f"a page of text, {script}", "form", partial(_ask, (item("page", 0, texts),)), block)


def _ask(items: tuple[Item, ...], screens: ScreenSet) -> None:
    screens.form.show(items, 1, 2)


def _tell(page: Page, screens: ScreenSet) -> None:
    screens.about.show(page)


def _debrief(page: Page, screens: ScreenSet) -> None:
    screens.debrief.give_code("WWWWWWW")
    screens.debrief.show(page)


def _ask_consent(page: ConsentPage, screens: ScreenSet) -> None:
    screens.consent.show(page)


class Bench:
    """One screen at a time, as the kiosk's window has it, laid out when it is asked to and never painted."""

    def __init__(self) -> None:
        self._application = application(WindowMode.NOWHERE)
        self._owner = QObject()
        self.screens = ScreenSet.of(read_study(Settings(languages=("en",))), self._owner)
        self._control = QQuickRenderControl()
        self._window = QQuickWindow(self._control)
        self._engine = QQmlEngine()
        self._shown: dict[str, QQuickItem] = {}
        self._changes, self._at = 0, ""

    def show(self, screen: str, fill: Filling, at: str, text_size: float, window: tuple[int, int]) -> None:
        """Show this page, and no other; a new one is made at this size."""
        self._changes, self._at = 0, at
        fill(self.screens)
        if screen not in self._shown:
            for other in self._shown.values():
                other.deleteLater()
            self._shown = {screen: self._made(screen, text_size, window)}
        # Without an event loop, what the page before was made of would stay and be laid out as well.
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    def lay_out(self, at: str, text_size: float, window: tuple[int, int]) -> int:
        """Lay out what is shown at this size; returns how often the column of its pane changed its own."""
        (root,) = self._shown.values()
        self._changes, self._at = 0, at
        root.setSize(QSizeF(*window))
        root.setProperty("textSize", text_size)
        self._control.polishItems()
        return self._changes

    def _made(self, screen: str, text_size: float, window: tuple[int, int]) -> QQuickItem:
        """Return a screen, with the room that it has in the kiosk's window."""
        component = QQmlComponent(self._engine)
        component.setData(SOURCES[screen].encode(), QML.as_uri())
        given: dict[str, object] = {screen: self.screens.by_name[screen], "kiosk": self.screens.kiosk}
        # Made without a size, it would be laid out once more, and write of each text that its letters have none.
        given |= {"width": window[0], "height": window[1], "textSize": text_size}
        if screen == "about":
            given["returning"] = self.screens.by_name["returning"]
        root = component.beginCreate(self._engine.rootContext())
        if not isinstance(root, QQuickItem):
            raise TypeError(component.errorString())
        component.setInitialProperties(root, given)
        (column,) = _columns(root)
        column.heightChanged.connect(self._count)
        column.widthChanged.connect(self._count)
        component.completeCreate()
        root.setParent(self._owner)
        root.setParentItem(self._window.contentItem())
        return root

    def close(self) -> None:
        """Let go of what is shown before what it shows."""
        for shown in self._shown.values():
            shown.deleteLater()
        self._engine.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    def _count(self) -> None:
        self._changes += 1
        if self._changes > MOST_CHANGES:
            sys.stderr.write(f"the page does not settle: {self._at}\n")
            sys.stderr.flush()
            os._exit(3)


def _columns(item: QQuickItem) -> Iterator[QQuickItem]:
    """Yield the columns of all panes that scroll."""
    for child in item.childItems():
        if child.inherits("QQuickFlickable"):
            yield from child.property("contentItem").childItems()
        else:
            yield from _columns(child)


def main(arguments: list[str]) -> int:
    """Lay out the pages; the last line says how often, and the most changes that one size took."""
    parser = argparse.ArgumentParser()
    parser.add_argument(
        "--every", type=int, default=0, help="lay out each page in one window only, and in every so many-th text size"
    )
    parser.add_argument("--only", default="", help="lay out only those whose name contains this")
    parser.add_argument(
        "--also", action="append", default=[], help="lay out those whose name contains this in every text size as well"
    )
    options = parser.parse_args(arguments)
    bench, every_page, laid_out, most = Bench(), list(pages()), 0, 0
    # One window after another: a change of the window lays out much that does not belong to the page.
    for place, window in enumerate(WINDOWS):
        for page in every_page:
            step = options.every or 1
            # Each script and each number of items comes into every window.
            here = (page.block + page.block // MOST_ITEMS) % len(WINDOWS) == place
            # A prime number of sizes lies between one block and the next, so that all of them come up.
            chosen = TEXT_SIZES[17 * page.block % step :: step] if here or not options.every else []
            names = {name_of(page.name, window, size): size for size in TEXT_SIZES}
            wanted = {
                told: size
                for told, size in names.items()
                if (size in chosen and options.only in told) or any(also in told for also in options.also)
            }
            if wanted:
                bench.show(page.screen, page.fill, *next(iter(wanted.items())), window)
            for told, text_size in wanted.items():
                most = max(most, bench.lay_out(told, text_size, window))
            laid_out += len(wanted)
    bench.close()
    sys.stdout.write(f"{laid_out} layouts settled; the most changes of one size were {most}\n")
    return 0


def name_of(page: str, window: tuple[int, int], text_size: float) -> str:
    """Return what a page is called in one size."""
    return f"{page}, {window[0]} x {window[1]}, text size {text_size}"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
