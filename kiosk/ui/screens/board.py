"""The board on the screen: what each card shows, where the mark is, and whether a tap would count."""

from __future__ import annotations

from enum import IntEnum
from typing import Any

from PySide6.QtCore import (
    Property,
    QAbstractListModel,
    QByteArray,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    Qt,
    QUrl,
    Signal,
    Slot,
)
from PySide6.QtQml import QmlElement

from kiosk.assistance.wording import Catalogue
from kiosk.experiment.effects import BoardWait
from kiosk.game import Position
from kiosk.lazy_dataclass import dataclass
from kiosk.robots.embodiment import BoardPoint
from kiosk.ui.cards import CardPictures

QML_IMPORT_NAME = "Recollect"
QML_IMPORT_MAJOR_VERSION = 1

_NOWHERE = -1


class Role(IntEnum):
    """What QML may ask of a card."""

    PICTURE = Qt.ItemDataRole.UserRole + 1
    UP = Qt.ItemDataRole.UserRole + 2
    FOUND = Qt.ItemDataRole.UserRole + 3
    LABEL = Qt.ItemDataRole.UserRole + 4


@dataclass
class _Face:
    """What one card shows.

    Its picture stays known after it is turned back, for as long as it takes to turn.
    """

    card: str = ""
    up: bool = False
    found: bool = False


@QmlElement
class BoardScreen(QAbstractListModel):
    """The cards row by row, and all that is shown around them."""

    changed = Signal()
    """The size of the board, or the language; apart from the next three, because every card and text follows."""
    counted = Signal()
    """A pair was found, or a move was made."""
    remade = Signal()
    """The board begins to be made anew, or is."""
    waited = Signal()
    """Taps count again, or no longer."""
    marked = Signal()
    """The mark of a hint came or went."""
    touched = Signal()
    """The first card was turned, or none of new ones."""
    turned = Signal()
    """One card is up and waits for its second, or none does any longer."""
    tapped = Signal(Position)
    """A card was tapped."""
    refused = Signal()
    """A card was touched that cannot be turned now."""
    skipped = Signal()
    """The visitor leaves the practice."""
    dealt = Signal()
    """Other cards are on the table."""
    pair_found = Signal(int, int, str, name="pairFound")
    """These two cards are a pair, with this picture."""

    def __init__(self, catalogue: Catalogue, pictures: CardPictures, parent: QObject | None = None) -> None:
        """``pictures`` has the address of every card."""
        super().__init__(parent)
        self._catalogue = catalogue
        self._pictures = pictures
        self._deck_name = ""
        self._practice = False
        self._faces: list[_Face] = []
        self._rows = self._columns = self._pairs = self._pairs_found = self._moves = 0
        self._untouched = self._one_up = self._remaking = False
        self._wait: BoardWait | None = None
        self._mark_row = self._mark_column = _NOWHERE
        self.looked_at: tuple[int | None, int | None] = (None, None)
        """The row and the column that the helper looks toward where a hint is a look; nothing of it is drawn."""
        self._tray: list[str] = []
        self._deck: list[str] = []

    def set_language(self, catalogue: Catalogue) -> None:
        """Name the cards, and tell the progress, in this language, from the next board on."""
        self._catalogue = catalogue
        self.changed.emit()
        self.counted.emit()
        self.waited.emit()

    def deal(self, rows: int, columns: int, pairs: int, deck: str, *, practice: bool = False) -> None:
        """Show so many closed cards of a deck; a practice can be left."""
        self.clear_table(rows, columns, pairs, deck, practice=practice)
        self.lay_cards()

    def clear_table(self, rows: int, columns: int, pairs: int, deck: str, *, practice: bool = False) -> None:
        """Make room for so many cards of a deck, and take away those that are there."""
        self._deck_name = deck
        # The old cards go first, and the new ones come last: none is made in the size of another board.
        self._put([])
        self._remaking = True
        self.remade.emit()
        self._rows, self._columns, self._pairs = rows, columns, pairs
        self._practice = practice
        self._tray = []
        self._deck = self._pictures.deck(deck) if rows * columns else []
        self._pairs_found = self._moves = 0
        self._wait = None
        self._untouched = rows * columns > 0
        self.touched.emit()
        self.changed.emit()
        self.counted.emit()
        self.waited.emit()
        self.clear_highlight()
        self._remaking = False
        self.remade.emit()

    def lay_cards(self) -> None:
        """Show the closed cards that there is room for."""
        self._put([_Face() for _ in range(self._rows * self._columns)])
        self.dealt.emit()

    def clear(self) -> None:
        """Show no card."""
        self.deal(0, 0, 0, "")

    def _touch(self) -> None:
        if self._untouched:
            self._untouched = False
            self.touched.emit()

    def _put(self, faces: list[_Face]) -> None:
        self.beginResetModel()
        self._faces = faces
        self.endResetModel()
        self._count_up()

    def _count_up(self) -> None:
        one_up = len(self.unmatched) == 1
        if one_up != self._one_up:
            self._one_up = one_up
            self.turned.emit()

    def reveal(self, position: Position, card: str) -> None:
        """Show one card's picture."""
        face = self._face(position)
        face.card, face.up = card, True
        self._touch()
        index = self.index(self.location(position))
        self.dataChanged.emit(index, index)
        self._count_up()

    def hide(self, positions: tuple[Position, ...]) -> None:
        """Close these cards."""
        for position in positions:
            self._face(position).up = False
            self._tell(position)
        self._count_up()

    def mark_matched(self, positions: tuple[Position, ...]) -> None:
        """Show that these cards are found."""
        for position in positions:
            self._face(position).found = True
            self._tell(position)
        self._touch()
        self._count_up()
        first, second = positions
        picture = self._picture(self._face(first).card)
        self._tray.append(picture)
        self.counted.emit()
        self.pair_found.emit(self.location(first), self.location(second), picture)

    def show_progress(self, pairs_found: int, moves: int) -> None:
        """Show how far the game is."""
        self._pairs_found, self._moves = pairs_found, moves
        self.counted.emit()

    def lock(self, wait: BoardWait | None) -> None:
        """Show why taps do not count just now, or, with None, that they do."""
        self._wait = wait
        self.waited.emit()

    def highlight(self, row: int | None, column: int | None) -> None:
        """Mark a card, a row or a column."""
        self._mark_row = _NOWHERE if row is None else row
        self._mark_column = _NOWHERE if column is None else column
        self.marked.emit()

    def clear_highlight(self) -> None:
        """Take the mark away."""
        self.looked_at = (None, None)
        self.highlight(None, None)

    @property
    def closed(self) -> tuple[Position, ...]:
        """Where closed cards lie, as anybody in front of the screen can see."""
        return tuple(self._position(i) for i, face in enumerate(self._faces) if not face.up)

    @property
    def unmatched(self) -> dict[Position, str]:
        """The pictures that are up and not found yet, as anybody in front of the screen can see."""
        return {self._position(i): face.card for i, face in enumerate(self._faces) if face.up and not face.found}

    @property
    def highlighted(self) -> tuple[int | None, int | None]:
        """The row and the column of the mark, None where it has none."""
        row, column = self._mark_row, self._mark_column
        return (None if row == _NOWHERE else row, None if column == _NOWHERE else column)

    @property
    def found(self) -> list[str]:
        """The pictures of the pairs that are found, as addresses, in the order in which they were found."""
        return list(self._tray)

    def is_marked(self, position: Position) -> bool:
        """Whether a card lies where the mark is."""
        row, column = self.highlighted
        marked = (row, column) != (None, None)
        return marked and row in (None, position.row) and column in (None, position.column)

    @property
    def accepts_taps(self) -> bool:
        """Whether a tap counts."""
        return self._wait is None

    def place(self, row: int | None, column: int | None) -> BoardPoint:
        """Where the middle of a mark lies."""
        across = 0.5 if column is None else (column + 0.5) / self._columns
        down = 0.5 if row is None else (row + 0.5) / self._rows
        return BoardPoint(across, down)

    def location(self, position: Position) -> int:
        """Return the number of a card, row by row from 0."""
        return position.row * self._columns + position.column

    def _position(self, location: int) -> Position:
        return Position(*divmod(location, self._columns))

    def _face(self, position: Position) -> _Face:
        return self._faces[self.location(position)]

    def _tell(self, position: Position) -> None:
        index = self.index(self.location(position))
        self.dataChanged.emit(index, index)

    def roleNames(self) -> dict[int, QByteArray]:  # noqa: N802 - Qt's name
        """Return the names under which QML asks."""
        return {role: QByteArray(role.name.lower().encode()) for role in Role}

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = QModelIndex()) -> int:  # noqa: ARG002, B008, N802 - Qt's signature
        """How many cards there are."""
        return len(self._faces)

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = 0) -> Any:
        """One thing about one card."""
        face = self._faces[index.row()]
        match role:
            case Role.PICTURE:
                return QUrl(self._picture(face.card)) if face.card else QUrl()
            case Role.UP:
                return face.up
            case Role.FOUND:
                return face.found
            case Role.LABEL:
                return self._label(index.row(), face)
        return None

    def _picture(self, card: str) -> str:
        """Return the address of a card's picture."""
        return self._pictures.address(self._deck_name, card)

    def _label(self, location: int, face: _Face) -> str:
        position = self._position(location)
        place = {"row": position.row + 1, "column": position.column + 1}
        if not face.up:
            return self._catalogue.text("game-closed-card", **place)
        return self._catalogue.text("game-open-card", **self._catalogue.card(face.card), **place)

    @Property(int, notify=changed)
    def rows(self) -> int:
        """Rows of the board."""
        return self._rows

    @Property(int, notify=changed)
    def columns(self) -> int:
        """Columns of the board."""
        return self._columns

    @Property(int, notify=changed)
    def pairs(self) -> int:
        """Pairs of the board."""
        return self._pairs

    @Property(list, notify=counted)
    def tray(self) -> list[str]:
        """Return the pictures of the pairs that are found, as addresses, in the order in which they were found."""
        return list(self._tray)

    @Property(list, notify=dealt)
    def pictures(self) -> list[str]:
        """Every picture of the deck, as addresses, so that none has to be loaded when its card is turned."""
        return list(self._deck)

    @Property(str, notify=counted)
    def progress(self) -> str:
        """How many pairs are found, in words; nothing without a board."""
        return "" if not self._pairs else self._catalogue.text("game-pairs", found=self._pairs_found, all=self._pairs)

    @Property(str, notify=counted)
    def moves(self) -> str:
        """How many moves were made, in words; nothing without a board."""
        return "" if not self._pairs else self._catalogue.text("game-moves", moves=self._moves)

    @Property(str, notify=changed)
    def mostPairs(self) -> str:  # noqa: N802 - QML's convention
        """Return the longest that `progress` gets, so that it takes the same room all the time."""
        return "" if not self._pairs else self._catalogue.text("game-pairs", found=self._pairs, all=self._pairs)

    @Property(str, notify=changed)
    def mostMoves(self) -> str:  # noqa: N802 - QML's convention
        """Return the longest that `moves` usually gets: a number of two digits."""
        return "" if not self._pairs else self._catalogue.text("game-moves", moves=88)

    @Property(bool, notify=changed)
    def practice(self) -> bool:
        """Whether this is a practice, and can be left."""
        return self._practice

    @Property(bool, notify=remade)
    def remaking(self) -> bool:
        """Whether rows, columns and pairs change, one after another: what they make together is not known yet."""
        return self._remaking

    @Property(bool, notify=touched)
    def untouched(self) -> bool:
        """Whether no card of these was turned yet."""
        return self._untouched

    @Property(bool, notify=turned)
    def oneUp(self) -> bool:  # noqa: N802 - QML's convention
        """Whether one card is up and waits for its second."""
        return self._one_up

    @Property(bool, notify=waited)
    def open(self) -> bool:
        """Whether a tap counts."""
        return self._wait is None

    @Property(bool, notify=waited)
    def speaking(self) -> bool:
        """Whether taps do not count because the assistant speaks."""
        return self._wait is BoardWait.SPEAKING

    @Property(bool, notify=waited)
    def missed(self) -> bool:
        """Whether two cards that are no pair wait to turn back."""
        return self._wait is BoardWait.TURNING_BACK

    @Property(int, notify=marked)
    def markRow(self) -> int:  # noqa: N802 - QML's convention
        """Return the marked row, or that of the marked card, from 0; -1 for none."""
        return self._mark_row

    @Property(int, notify=marked)
    def markColumn(self) -> int:  # noqa: N802 - QML's convention
        """Return the marked column, or that of the marked card, from 0; -1 for none."""
        return self._mark_column

    @Slot(int)
    def tap(self, location: int) -> None:
        """Report a tapped card."""
        self.tapped.emit(self._position(location))

    @Slot()
    def refuse(self) -> None:
        """Report a card that was touched in vain; it shakes its head, whatever comes of this."""
        self.refused.emit()

    @Slot()
    def skip(self) -> None:
        """Leave the practice."""
        self.skipped.emit()
