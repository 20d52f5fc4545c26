"""What somebody who looks closely finds on a window: its texts, its controls, and every screen of a whole sitting."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from PySide6.QtCore import QPointF, QRect, QRectF, QSizeF
from PySide6.QtGui import QColor, QImage
from PySide6.QtQml import QQmlComponent, QQmlEngine, QQmlProperty, qmlContext
from PySide6.QtQuick import QQuickItem

from kiosk.ui.app import App
from kiosk.ui.rehearsing.hand import Stuck, lay_out
from kiosk.ui.rehearsing.rehearsal import Rehearsal
from kiosk.ui.window import QML

HANDLERS = {"QQuickTapHandler", "QQuickDragHandler"}
LINEAR_FROM = 0.04045


def items(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every visible item, from the outermost to the innermost."""
    if item.isVisible():
        yield item
        for child in item.childItems():
            yield from items(child)


def texts(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every visible text with something to read."""
    return (found for found in items(item) if is_a(found, "QQuickText") and found.property("text"))


def is_a(item: QQuickItem, kind: str) -> bool:
    """Whether an item is of a kind of Qt's, or of one made from it."""
    meta = item.metaObject()
    while meta is not None:
        if meta.className() == kind:
            return True
        meta = meta.superClass()
    return False


def is_ignored(item: QQuickItem) -> bool:
    """Whether an item says that those who cannot see it miss nothing."""
    context = qmlContext(item)
    return context is not None and bool(QQmlProperty.read(item, "Accessible.ignored", context))


def is_control(item: QQuickItem) -> bool:
    """Whether it can be clicked, or reached by keyboard."""
    handled = any(child.metaObject().className() in HANDLERS for child in item.children())
    return bool(item.property("activeFocusOnTab")) or handled or is_a(item, "QQuickMouseArea")


def place(item: QQuickItem) -> QRect:
    """Where an item is in its window."""
    return QRectF(item.mapToScene(QPointF(0, 0)), QSizeF(item.width(), item.height())).toAlignedRect()


def painted(text: QQuickItem) -> QRect:
    """Where a text's letters are in the window."""
    return text.mapRectToScene(text.boundingRect()).toAlignedRect()


def opacity(item: QQuickItem | None) -> float:
    """How much of an item is to be seen, with all that it lies in."""
    return 1.0 if item is None else item.opacity() * opacity(item.parentItem())


def luminance(color: QColor) -> float:
    """Relative luminance, 0 to 1 (WCAG 2.2)."""
    linear = [
        value / 12.92 if value <= LINEAR_FROM else ((value + 0.055) / 1.055) ** 2.4
        for value in (color.redF(), color.greenF(), color.blueF())
    ]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: QColor, other: QColor) -> float:
    """The contrast of two colours, 1 to 21 (WCAG 2.2)."""
    darker, lighter = sorted((luminance(one), luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)


def background(picture: QImage, where: QRect) -> QColor:
    """The colour that fills most of a place."""
    inside = where.intersected(picture.rect())
    counted: dict[int, int] = {}
    for y in range(inside.top(), inside.bottom() + 1, 2):
        for x in range(inside.left(), inside.right() + 1, 2):
            pixel = picture.pixel(x, y)
            counted[pixel] = counted.get(pixel, 0) + 1
    return QColor(max(counted, key=lambda pixel: counted[pixel]))


def colours(palette: str) -> dict[str, QColor]:
    """What the theme says in this palette."""
    engine = QQmlEngine()
    component = QQmlComponent(engine)
    high = "true" if palette == "high" else "false"
    made_so = f"property var theme: Theme; Component.onCompleted: Theme.highContrast = {high}"
    source = f'import QtQuick; import "."; QtObject {{ {made_so} }}'
    component.setData(source.encode(), QML.as_uri())
    made = component.create()
    assert made is not None, component.errorString()
    theme = made.property("theme")
    names = (
        "paper",
        "white",
        "sand",
        "edge",
        "ink",
        "faintInk",
        "sea",
        "lightSea",
        "amber",
        "deepAmber",
        "done",
        "held",
    )
    found = {name: theme.property(name) for name in names}
    made.deleteLater()
    return found


class Tour(Rehearsal):
    """A whole sitting in which every new screen is looked at before anything is clicked on it."""

    def __init__(self, app: App, seed: int, look: Callable[[str], None]) -> None:
        """``look`` is called with the name of every screen, once for each thing that is clicked on it."""
        super().__init__(app, seed)
        self._look = look
        self._seen: set[tuple[str, str]] = set()

    def _click(self, name: str) -> None:
        shown = self._app.screens.kiosk.shown
        if (shown, name.rstrip("0123456789")) not in self._seen:
            self._seen.add((shown, name.rstrip("0123456789")))
            lay_out(self._app.window)
            try:
                self._look(shown)
            except Exception as fault:
                # It would be taken for a fault of the kiosk's, and the sitting would never end.
                raise Stuck(f"{shown} could not be looked at: {fault}") from fault
        super()._click(name)


def tour(app: App, look: Callable[[str], None]) -> None:
    """Look at every screen of a sitting, and at the calm words that lie over them."""
    Tour(app, 1, look).run()
    app.screens.avatar.say("Something that is said.")
    for asks, shown in ((True, "attract"), (False, "pause")):
        app.screens.kiosk.show(shown)
        app.screens.kiosk.ask_still_there(asks=asks)
        app.screens.kiosk.settle()
        lay_out(app.window)
        look("still there" if asks else shown)
