"""What a close look finds on a window: its texts, its controls, and what a screen reader gets of them.

Colours are compared as WCAG 2.2 does it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, QPointF, QRect, QRectF, QSizeF, Qt
from PySide6.QtGui import QAccessible, QAccessibleInterface, QColor, QImage
from PySide6.QtQml import QQmlComponent, QQmlEngine, QQmlProperty, qmlContext
from PySide6.QtQuick import QQuickItem, QQuickWindow
from shiboken6 import Shiboken

from kiosk.ui.window import QML

HANDLERS = ("QQuickTapHandler", "QQuickDragHandler")
LINEAR_FROM = 0.04045
RED, GREEN, BLUE = 0.2126, 0.7152, 0.0722
FLARE = 0.05
"""The light that every screen throws back."""
LEAST_CHANGE = 3.0
"""The contrast of what has to be seen and is no text."""
EXPERIMENTERS = ("PanelLayer", "ReplayBar")
"""What only an experimenter reads."""

Light = NDArray[np.float64]
"""Relative luminance, 0 to 1: (height, width) of a picture."""


def items(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every item that is to be seen, from the outermost to the innermost."""
    left = [item]
    while left:
        found = left.pop()
        if found.isVisible() and found.opacity() > 0:
            yield found
            left += reversed(found.childItems())


def texts(item: QQuickItem) -> Iterator[QQuickItem]:
    """Every text that is to be seen, with something to read."""
    return (found for found in items(item) if is_text(found))


def is_text(item: QQuickItem) -> bool:
    """Whether it is a text with something to read."""
    return item.inherits("QQuickText") and bool(str(item.property("text")).strip())


def of_kind(item: QQuickItem, kind: str) -> list[QQuickItem]:
    """Return the visible items of an item that are this component of ours."""
    return [found for found in items(item) if found.metaObject().className().partition("_QML")[0] == kind]


def lies_in(item: QQuickItem, *kinds: str) -> bool:
    """Whether an item is, or is part of, one of our own components of these names."""
    above: QQuickItem | None = item
    while above is not None:
        if above.metaObject().className().partition("_QML")[0] in kinds:
            return True
        above = above.parentItem()
    return False


def is_ignored(item: QQuickItem) -> bool:
    """Whether an item says that those who cannot see it miss nothing."""
    context = qmlContext(item)
    return context is not None and bool(QQmlProperty.read(item, "Accessible.ignored", context))


def is_control(item: QQuickItem) -> bool:
    """Whether it can be clicked, or reached by keyboard, to some end."""
    if is_ignored(item) or item.inherits("QQuickScrollBar"):
        return False
    if item.property("activeFocusOnTab") or item.inherits("QQuickAbstractButton") or item.inherits("QQuickMouseArea"):
        return True
    # To touch the ground of a form is to have done with typing, which every other key and control is as well. Its
    # children are asked for last, as Qt for Python makes an object for each of them; an item with a handler among them
    # takes buttons of a mouse.
    return (
        item.acceptedMouseButtons() != Qt.MouseButton.NoButton
        and item.objectName() != "ground"
        and any(child.inherits(kind) for child in item.children() for kind in HANDLERS)
    )


def place(item: QQuickItem) -> QRect:
    """Where an item is in its window."""
    return QRectF(item.mapToScene(QPointF(0, 0)), QSizeF(item.width(), item.height())).toAlignedRect()


def painted(text: QQuickItem) -> QRect:
    """Where a text's letters are in the window, as far as they are not scrolled away."""
    width, height = float(text.property("contentWidth")), float(text.property("contentHeight"))
    letters = text.mapRectToScene(text.boundingRect())
    centre = letters.center()
    shown = QRectF(centre.x() - width / 2, centre.y() - height / 2, width, height)
    above: QQuickItem | None = text.parentItem()
    while above is not None:
        if above.clip():
            shown = shown.intersected(above.mapRectToScene(QRectF(0, 0, above.width(), above.height())))
        above = above.parentItem()
    return shown.toAlignedRect()


def described(item: QQuickItem) -> tuple[QAccessible.Role, str]:
    """Return the role and the name of an item for screen readers."""
    told = QAccessible.queryAccessibleInterface(item)
    if not isinstance(told, QAccessibleInterface):
        return QAccessible.Role.NoRole, ""
    return told.role(), told.text(QAccessible.Text.Name).strip()


def announced(window: QQuickWindow) -> set[int]:
    """Every item that such a program comes to, going down from the window."""
    found: set[int] = set()

    def walk(told: QAccessibleInterface) -> None:
        found.add(identity(told.object()))
        for number in range(told.childCount()):
            child = told.child(number)
            if child is not None:
                walk(child)

    whole = QAccessible.queryAccessibleInterface(window)
    assert isinstance(whole, QAccessibleInterface)
    walk(whole)
    return found


def identity(thing: QObject) -> int:
    """Return what tells one of Qt's objects from all others, however often Python is given it."""
    return int(Shiboken.getCppPointer(thing)[0])


def controls(shown: Iterable[QQuickItem]) -> set[int]:
    """Return which items are controls; each is looked at closely, so it is done once for a screen."""
    return {identity(item) for item in shown if is_control(item)}


def untold(window: QQuickWindow, shown: Iterable[QQuickItem], controlling: set[int]) -> list[str]:
    """Return what a person who cannot see the window would miss: controls without a role or name, and texts."""
    reached = announced(window)
    return [
        f"{item.objectName() or item.metaObject().className()} {item.property('text') or ''}"
        for item in shown
        if not _is_told(item, reached, controlling)
    ]


def _is_told(item: QQuickItem, reached: set[int], controlling: set[int]) -> bool:
    if identity(item) in controlling:
        role, name = described(item)
        return (
            role not in (QAccessible.Role.NoRole, QAccessible.Role.Client) and bool(name) and identity(item) in reached
        )
    if not is_text(item) or is_ignored(item):
        return True
    return (bool(described(item)[1]) and identity(item) in reached) or _is_in_a_named_control(
        item, reached & controlling
    )


def _is_in_a_named_control(item: QQuickItem, named: set[int]) -> bool:
    """Whether what it says is part of a control's own name."""
    above: QQuickItem | None = item.parentItem()
    while above is not None:
        if identity(above) in named and described(above)[1]:
            return True
        above = above.parentItem()
    return False


def luminance(color: QColor) -> float:
    """Relative luminance, 0 to 1."""
    return float(_light(np.array([[color.redF(), color.greenF(), color.blueF()]]))[0])


def contrast(one: QColor, other: QColor) -> float:
    """Return the contrast of two colours, 1 to 21."""
    darker, lighter = sorted((luminance(one), luminance(other)))
    return (lighter + FLARE) / (darker + FLARE)


def strongest_change(before: QImage, after: QImage, where: QRect | None = None) -> float:
    """Return the greatest contrast between a pixel and the same one later, in a place.

    It is one of light alone, whatever the hue.
    """
    one, other = (FLARE + LINEAR[_pixels(picture, where)] @ SHARES for picture in (before, after))
    return float(np.max(np.maximum(one, other) / np.minimum(one, other)))


def background(picture: QImage, where: QRect) -> QColor:
    """Return the colour that fills most of a place."""
    pixels = _pixels(picture, where).reshape(-1, 3).astype(np.uint32)
    codes, counts = np.unique(pixels @ np.array([1 << 16, 1 << 8, 1], dtype=np.uint32), return_counts=True)
    return QColor.fromRgb(int(codes[np.argmax(counts)]))


def appearance(button: QQuickItem, picture: QImage) -> tuple[QSizeF, object, QColor, QColor]:
    """Return how a button looks, whatever it says: its size, its font, and the colours of its ground and its words."""
    words = next(each for each in texts(button) if each.property("text") == button.property("words"))
    size = QSizeF(button.width(), button.height())
    return size, button.property("font"), background(picture, place(button)), words.property("color")


def _pixels(picture: QImage, where: QRect | None) -> NDArray[np.uint8]:
    """Return the red, green and blue of a place in a picture, 0 to 255: (height, width, 3)."""
    inside = (where or picture.rect()).intersected(picture.rect())
    if inside.isEmpty():
        return np.empty((0, 0, 3), np.uint8)
    # The whole picture would be converted for each text that stands in it.
    plain = picture.copy(inside).convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(plain.constBits(), np.uint8).reshape(plain.height(), plain.bytesPerLine())
    return rows[:, : 3 * plain.width()].reshape(plain.height(), plain.width(), 3).copy()


def _light(colour: NDArray[np.float64]) -> Light:
    """Return the relative luminance of colours whose last axis is red, green and blue, 0 to 1."""
    found: Light = _linear(colour) @ SHARES
    return found


def _linear(colour: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how much light each part of a colour gives, 0 to 1."""
    return np.where(colour <= LINEAR_FROM, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)


SHARES = np.array([RED, GREEN, BLUE])
LINEAR = _linear(np.arange(256) / 255)
"""The same for each value of a pixel: a power takes long, and a picture has two million pixels."""


def colours(palette: str) -> dict[str, QColor]:
    """Return what the theme says in this palette."""
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
        *("paper", "white", "shelf", "sand", "edge", "ink", "faintInk"),
        *("sea", "shy", "slot", "touchable", "resting", "lightSea", "amber", "deepAmber", "leaf", "done", "held"),
    )
    found = {name: theme.property(name) for name in names}
    made.deleteLater()
    return found
