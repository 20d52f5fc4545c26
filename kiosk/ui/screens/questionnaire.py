"""The questionnaire screen: its pages, items and answers."""

from __future__ import annotations

import logging
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from PySide6.QtCore import Property, QObject, QUrl, Signal, Slot
from PySide6.QtQml import QJSValue, QmlElement

from kiosk.assistance.keyboards import capital
from kiosk.assistance.wording import Catalogue
from kiosk.experiment.items import (
    NOT_APPLICABLE,
    Answer,
    Integer,
    Multiple,
    NotApplicable,
    Pictures,
    Question,
    Response,
    ShortText,
    Single,
    Slider,
    TextPage,
    in_language,
)
from kiosk.experiment.questionnaire import Item
from kiosk.experiment.typed_input import can_be_kept
from kiosk.ui.input import before, fitting

_log = logging.getLogger(__name__)

_LONE_LETTER = re.compile(r"(?<!\S)([^\W\d_]) (?=\S)")
"""A word of one letter, such as "I" or the Italian "e", and the space after it."""


def kept_together(text: str) -> str:
    """Return a text whose words of one letter stay on the line of the word after them."""
    return _LONE_LETTER.sub("\\1\N{NO-BREAK SPACE}", text)


def _sentence(text: str) -> str:
    """Return a text with a full stop, unless it ends with a mark of its own."""
    return f"{text}." if text[-1:].isalnum() else text


def item_text(item: Item, catalogue: Catalogue) -> str:
    """Return what is asked as it is broken into lines; a slider's also says what to do."""
    text = in_language(item.text, catalogue.language)
    # Words in the line, or above it, could draw touches to where they stand.
    return kept_together(f"{_sentence(text)} {catalogue.text('form-touch')}" if isinstance(item, Slider) else text)


def item_view(item: Item, catalogue: Catalogue, scale: Callable[[str], Path]) -> dict[str, Any]:
    """Return an item as QML shows it; ``scale`` tells where the pictures of a scale are."""
    shown: dict[str, Any] = {"id": item.id, "kind": item.kind, "text": in_language(item.text, catalogue.language)}
    shown["shown"] = item_text(item, catalogue)
    shown["required"] = not isinstance(item, TextPage) and item.required is True
    shown |= item.view(catalogue.language) | {
        "source": QUrl.fromLocalFile(str(item.qml)).toString() if item.qml else ""
    }
    shown["exempts"] = isinstance(item, Question) and item.not_applicable
    if isinstance(item, Pictures):
        folder = scale(item.pictures)
        files = (folder / f"{point}.svg" for point in range(1, item.points + 1))
        shown["pictures"] = [QUrl.fromLocalFile(str(file)).toString() for file in files]
    if isinstance(item, Integer):
        shown["range"] = catalogue.text("form-range", lowest=item.lowest, highest=item.highest)
        shown["wrong"] = catalogue.text("form-wrong-number", lowest=item.lowest, highest=item.highest)
    return shown


QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1


KEYSTROKES = 5
"""After so many letters typing is reported again, so that visitors who type are not asked if they are there."""


@QmlElement
class FormScreen(QObject):
    """A page of items."""

    changed = Signal()
    """The items are others, or worded otherwise."""
    turned = Signal()
    """Another page is shown."""
    marked = Signal()
    """Another answer is chosen, typed or missed; apart from ``changed``, so that the items stay the same items."""
    missed = Signal(str)
    """The first item that is missed is to be brought into view."""
    answered = Signal(str, object)
    """The visitor answered an item; None takes the answer back."""
    typed = Signal()
    """The visitor is typing; sent every few letters."""
    filled = Signal(str, str)
    """A field is to show this text: its answer came without anybody typing here, as in a replay."""
    continued = Signal()

    def __init__(self, catalogue: Catalogue, scale: Callable[[str], Path], parent: QObject | None = None) -> None:
        """``scale`` tells where the pictures of a scale are, as ``1.svg`` and so on."""
        super().__init__(parent)
        self._catalogue = catalogue
        self._scale = scale
        self._items: tuple[Item, ...] = ()
        self._views: list[dict[str, Any]] | None = None
        """What is shown of the items, once the screen has asked for it: it asks dozens of times for each page."""
        self._hidden: frozenset[str] = frozenset()
        self._shown: tuple[Item, ...] = ()
        self._number = self._of = 0
        self._title: Mapping[str, str] | None = None
        self._alike: tuple[tuple[Item, ...], ...] = ()
        self._answers: dict[str, Response] = {}
        self._given: dict[str, Response | None] = {}
        """What the visitor has answered, although it may not be shown yet."""
        self._drafts: dict[str, str] = {}
        self._missing: tuple[str, ...] = ()
        self._keystrokes = 0

    def set_language(self, catalogue: Catalogue) -> None:
        """Ask in this language; answers, and what is typed, stay."""
        if catalogue is self._catalogue:
            return
        self._catalogue, self._views = catalogue, None
        typed = dict(self._drafts)
        self.changed.emit()
        self.marked.emit()
        for item, text in typed.items():
            self.filled.emit(item, text)

    def show(  # noqa: PLR0913, PLR0917 - what a page is, and what it is laid out like
        self,
        items: tuple[Item, ...],
        number: int,
        of: int,
        hidden: tuple[str, ...] = (),
        title: Mapping[str, str] | None = None,
        alike: tuple[tuple[Item, ...], ...] = (),
    ) -> None:
        """Show a page, ``number`` ``of`` so many, but for its hidden items; nothing is answered.

        Without a ``title`` in any language, it has the one that all forms have. Pages that are ``alike`` are laid out
        as the fullest of them, so that their scales are as large and stand in the same columns.
        """
        self._items, self._number, self._of = items, number, of
        self._title, self._alike = title, alike
        self._views = None
        self._set_hidden(hidden)
        self._answers, self._given, self._drafts, self._missing = {}, {}, {}, ()
        self._keystrokes = 0
        self.changed.emit()
        self.turned.emit()
        self.marked.emit()

    def hide(self, hidden: tuple[str, ...]) -> None:
        """Hide these items of the page and no others; what was answered and typed in them is gone."""
        self._set_hidden(hidden)
        for item in hidden:
            self._answers.pop(item, None)
            self._given.pop(item, None)
        self._missing = tuple(name for name in self._missing if name not in self._hidden)
        typed = [item for item in hidden if self._drafts.pop(item, "")]
        self.marked.emit()
        for item in typed:
            self.filled.emit(item, "")
        for item in typed:
            # The emptied field reports its text like one that was typed in.
            self._drafts.pop(item, None)

    def _set_hidden(self, hidden: tuple[str, ...]) -> None:
        self._hidden = frozenset(hidden)
        self._shown = tuple(item for item in self._items if item.id not in self._hidden)

    def show_answer(self, item: str, value: Response | None) -> None:
        """Show which answer is chosen."""
        self._given[item] = value
        if value is None:
            self._answers.pop(item, None)
        else:
            self._answers[item] = value
        self._missing = tuple(name for name in self._missing if name != item)
        self.marked.emit()
        answer = None if isinstance(value, NotApplicable) else value
        if isinstance(self._item(item), Integer | ShortText) and (
            self._typed(item) != answer or (answer is None and self._drafts.get(item))
        ):
            self.filled.emit(item, "" if answer is None else str(answer))

    def show_missing(self, items: tuple[str, ...]) -> None:
        """Show which items have to be answered before the visitor can go on."""
        self._missing = items
        self.marked.emit()
        self.missed.emit(items[0])

    def clear(self) -> None:
        """Show nothing."""
        self.show((), 0, 0)

    @property
    def shown(self) -> tuple[Item, ...]:
        """The items of the page, as anybody in front of the screen can see."""
        return self._shown

    @property
    def page_items(self) -> tuple[Item, ...]:
        """All items of the page, also those that are hidden."""
        return self._items

    @property
    def given(self) -> dict[str, Response]:
        """The answers that are chosen, as anybody in front of the screen can see."""
        return dict(self._answers)

    @Property(list, notify=changed)
    def items(self) -> list[dict[str, Any]]:
        """Return what is shown of the items, in their order."""
        if self._views is None:
            self._views = [item_view(item, self._catalogue, self._scale) for item in self._items]
        return self._views

    @Property(str, notify=changed)
    def title(self) -> str:
        """Return what stands above the items."""
        return in_language(self._title, self._catalogue.language) if self._title else self._catalogue.text("form-title")

    @Property(int, notify=changed)
    def fullest(self) -> int:
        """How many items the fullest page like this one has; 0 if this is the only one."""
        return max(map(len, self._alike)) if len(self._alike) > 1 else 0

    @Property(list, notify=changed)
    def wordings(self) -> list[str]:
        """Return what is asked on this page and on all that are laid out like it."""
        pages = (self._items, *self._alike)
        return list(dict.fromkeys(item_text(item, self._catalogue) for page in pages for item in page))

    @Property(str, notify=changed)
    def progress(self) -> str:
        """Which page of how many this is."""
        if self._of < 2:  # noqa: PLR2004 - a single page needs no number
            return ""
        return self._catalogue.text("form-progress", number=self._number, all=self._of)

    @Property(int, notify=changed)
    def page(self) -> int:
        """Which page this is, from 1."""
        return self._number

    @Property(int, notify=changed)
    def pages(self) -> int:
        """How many pages the form has."""
        return self._of

    @Property("QVariantMap", notify=marked)  # type: ignore[arg-type]  # the stubs know no names of Qt's types
    def answers(self) -> dict[str, Any]:
        """Return the chosen answers, by their items."""
        given = {item: value for item, value in self._answers.items() if not isinstance(value, NotApplicable)}
        return {item: list(value) if isinstance(value, tuple) else value for item, value in given.items()}

    @Property(list, notify=marked)
    def exempt(self) -> list[str]:
        """Return the items that the visitor said do not apply."""
        return [item for item, value in self._answers.items() if isinstance(value, NotApplicable)]

    @Property(list, notify=marked)
    def hidden(self) -> list[str]:
        """Return the items of the page that are not to be seen."""
        return sorted(self._hidden)

    @Property(list, notify=marked)
    def missing(self) -> list[str]:
        """Return the items that have to be answered first, or have an answer that cannot be."""
        return list(self._missing)

    @Property(list, notify=marked)
    def wrong(self) -> list[str]:
        """Return the fields in which something stands that cannot be an answer, and was left or sent."""
        return [item for item in self._missing if item in self._drafts and self._is_wrong(item)]

    @Property("QVariantMap", notify=changed)  # type: ignore[arg-type]  # the stubs know no names of Qt's types
    def keys(self) -> dict[str, list[str]]:
        """Return the rows of the keys on the screen: letters, accents and signs."""
        rows = self._catalogue.key_rows
        return {"letters": list(rows.letters), "accents": list(rows.accents), "signs": list(rows.signs)}

    @Slot(str, result=str)
    def capital(self, letter: str) -> str:
        """Return the letter as a key types it in capitals."""
        return capital(letter, self._catalogue.language)

    @Property(list, notify=marked)
    def refused(self) -> list[str]:
        """Return the fields in which a character stands that cannot be kept."""
        return [item for item, text in self._drafts.items() if not can_be_kept(text)]

    @Property(bool, notify=marked)
    def skips(self) -> bool:
        """Whether to go on is to leave out what was pointed out."""
        left = {item.id: item.required for item in self._items if not isinstance(item, TextPage)}
        return bool(self._missing) and not any(left[name] is True or self._is_wrong(name) for name in self._missing)

    @Property(bool, notify=marked)
    def complete(self) -> bool:
        """Whether everything is answered or typed that is not free to be left out."""
        return not self._to_go()

    @Property(str, notify=marked)
    def waiting(self) -> str:
        """Return how many answers the way on waits for; empty if none."""
        number = len(self._to_go())
        return self._catalogue.text("form-to-go", number=number) if number else ""

    @Property(str, notify=marked)
    def due(self) -> str:
        """Return the first item that the way on waits for; empty if none."""
        return next(iter(self._to_go()), "")

    @Property(list, notify=changed)
    def reasons(self) -> list[str]:
        """Return all that ``waiting`` can say on this page."""
        return [self._catalogue.text("form-to-go", number=number) for number in range(1, len(self._items) + 1)]

    @Slot(str, int)
    def rate(self, item: str, value: int) -> None:
        """Choose a point of a scale."""
        self._answer(item, value)

    @Slot(str, str)
    def choose(self, item: str, option: str) -> None:
        """Choose one of several options."""
        self._answer(item, option)

    @Slot(str, str)
    def toggle(self, item: str, option: str) -> None:
        """Add one of several options, or take it away."""
        before = self._given.get(item, ())
        chosen = before if isinstance(before, tuple) else ()
        after = set(chosen) ^ {option}
        self._answer(item, tuple(known for known in self._options(item) if known in after) or None)

    @Slot(str)
    def dismiss(self, item: str) -> None:
        """Say that an item does not apply, or take that back."""
        self._answer(item, None if self._given.get(item) is NOT_APPLICABLE else NOT_APPLICABLE)

    @Slot(str, "QVariant")
    def give(self, item: str, value: object) -> None:
        """Take the answer to an item of another package: a whole number, a text or several; null takes it back.

        What the item does not take is not an answer; it is written into the log.
        """
        plain = value.toVariant() if isinstance(value, QJSValue) else value
        if isinstance(plain, float) and plain.is_integer():
            # A number of QML's has no whole kind.
            plain = int(plain)
        answer = tuple(plain) if isinstance(plain, list) else plain
        if answer is None or (isinstance(answer, int | str | tuple) and self._item(item).accepts(answer)):
            self._answer(item, answer)
        else:
            _log.warning("the item %s was given %r, which is no answer to it", item, type(plain).__name__)

    @Slot(str, str)
    def draft(self, item: str, text: str) -> None:
        """Take the text that the visitor has typed so far."""
        self._drafts[item] = text
        self.marked.emit()
        self._keystrokes += 1
        if self._keystrokes % KEYSTROKES == 0:
            self.typed.emit()

    @Slot(str, str, int, result=str)
    def step(self, item: str, text: str, by: int) -> str:
        """Return what stands in a number's field after one step up or down from this text."""
        asked = self._item(item)
        return str(asked.input.step(text, by)) if isinstance(asked, Integer) else text

    @Slot(str, str, result=str)
    def negate(self, item: str, text: str) -> str:
        """Return what stands in a number's field once its minus sign came, or went."""
        asked = self._item(item)
        return asked.input.negate(text) if isinstance(asked, Integer) else text

    @Slot(str, int, result=int)
    def before(self, text: str, place: int) -> int:
        """Where the character begins that ends at a place in a text, as Qt counts places."""
        return before(text, place)

    @Slot(str, int, int, result=int)
    def fitting(self, text: str, place: int, longest: int) -> int:
        """Return where the part before a place has to end for a text of limited length."""
        return fitting(text, place, longest)

    @Slot(str)
    def finish(self, item: str) -> None:
        """End typing, for now."""
        if item not in self._drafts:
            return
        if self._is_wrong(item):
            self._missing = tuple(dict.fromkeys((*self._missing, item)))
            self.marked.emit()
            return
        typed = self._typed(item)
        # An empty field is no reason to take back that the item does not apply.
        answer = self._answers.get(item)
        if typed != (None if isinstance(answer, NotApplicable) else answer):
            self._answer(item, typed)

    @Slot()
    def proceed(self) -> None:
        """Go on; what is typed is answered first, and what cannot be an answer has to be mended."""
        hidden = self._hidden
        self.finish_typing()
        came = [item.id for item in self._shown if item.id in hidden]
        wrong = tuple(item for item in self._drafts if self._is_wrong(item))
        if wrong:
            self.show_missing(wrong)
        elif came:
            # What was typed last brought items that the visitor has not seen yet.
            self.missed.emit(came[0])
        else:
            self.continued.emit()

    def finish_typing(self) -> None:
        """Take what is typed as answered, as far as it can be an answer."""
        for item in tuple(self._drafts):
            self.finish(item)

    def _to_go(self) -> list[str]:
        asked = [item for item in self._shown if not isinstance(item, TextPage) and item.required is not False]
        return [item.id for item in asked if item.id not in self._answers and not self._is_typed(item.id)]

    def _answer(self, item: str, value: Response | None) -> None:
        self._given[item] = value
        self.answered.emit(item, value)

    def _typed(self, name: str) -> Answer | None:
        """Return what stands in a field, as an answer, spaces and all.

        None for blanks alone, which say nothing, and for what is no number where one is asked for.
        """
        text, item = self._drafts.get(name, ""), self._item(name)
        if isinstance(item, Integer):
            return item.input.read(text.strip())
        return text if text.strip() else None

    def _is_typed(self, name: str) -> bool:
        """Whether something stands in a field that can be an answer."""
        return self._typed(name) is not None and not self._is_wrong(name)

    def _is_wrong(self, name: str) -> bool:
        """Whether something stands in a field that cannot be an answer."""
        text, typed = self._drafts.get(name, ""), self._typed(name)
        if typed is None:
            return bool(text.strip()) or not can_be_kept(text)
        return not self._item(name).accepts(typed)

    def _item(self, name: str) -> Item:
        return next(item for item in self._items if item.id == name)

    def _options(self, name: str) -> tuple[str, ...]:
        item = self._item(name)
        return item.ids if isinstance(item, Single | Multiple) else ()
