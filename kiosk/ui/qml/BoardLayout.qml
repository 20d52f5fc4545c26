// Where the cards stand on the game's page, and the words and the tray above them or beside them. Each length is worked
// out after those that it depends on.
import QtQuick
import "."

QtObject {
    id: layout

    // The page, and the board on it.
    required property real width
    required property real height
    // Whether the screen is higher than wide: then the tray is a shelf with lines of its own above the cards.
    required property bool upright
    // How much of its lower end a long sentence may cover.
    required property real lent
    // On which side of the cards the helper speaks: -1 left, 1 right, 0 below them or nowhere.
    required property int spoken
    // Whether the height passes several values, while the helper comes or goes, or the board is made anew. The cards are
    // laid out for the last.
    required property bool resizes
    required property int rows
    required property int columns
    required property int pairs
    required property bool practises
    // What the words, the way to the game and the line under the cards take.
    required property real practiceWidth
    required property real progressWidth
    required property real skipWidth
    required property real skipHeight
    required property real pillHeight

    // Where there is far more room beside the cards than above them, the tray stands there.
    readonly property bool broad: !upright && width > 1.6 * height
    readonly property real side: broad ? Math.min(300 * Theme.unit, 0.17 * width) : 0
    // How much of a cell a card takes. The cards' pictures have a narrow margin.
    readonly property real share: upright ? 0.98 : 0.91
    readonly property real margin: (1 - 0.962 * share) / 2
    // How wide a card is that is seen in its full size.
    readonly property real card: 0.962 * share * cell
    // The room of the columns' numbers above the cards, and that of the rows' numbers beside them. Both stand close to
    // the cards, as they name them; a mark's band reaches as far as they do.
    readonly property real numbers: 66 * Theme.unit
    readonly property real gutter: (upright ? 50 : 46) * Theme.unit
    readonly property real numberSize: upright ? Theme.size(36) : Theme.body
    readonly property real near: 24 * Theme.unit - margin * cell
    readonly property real band: near + 0.72 * numberSize + 14 * Theme.unit
    // On an upright screen the cards and the numbers of their rows are together as wide as the helper's sentence, and
    // nearly as the screen: the cards are as large as that allows.
    readonly property real edge: 20 * Theme.unit
    readonly property real wide: width - 2 * edge
    readonly property real widest: (upright ? wide - gutter : width - 2 * side - gutter - 32 * Theme.unit - 2 * Theme.gap) / Math.max(1, columns)

    // The words above the cards. Upright, their line depends on no height.
    readonly property real wordsSize: upright && Theme.textSize <= 1.15 ? Theme.size(38) : Theme.body
    readonly property real wordsAt: 12 * Theme.unit
    readonly property real wordsApart: 20 * Theme.unit
    readonly property real wordsLine: (78 * Math.max(1, Theme.textSize) + 20) * Theme.unit + wordsApart
    // Where the dots begin that show how far the visit is, or the screen ends.
    readonly property real mostRight: width - (upright ? 1 : 3.5) * Theme.gap
    // The way to the game stands above the cards, with the tray; or below them, where large words leave no room there.
    readonly property real above: practiceWidth + progressWidth + skipWidth + (upright ? 0 : 240 * Theme.unit) + 5 * Theme.gap
    readonly property bool skipsBelow: !broad && above > mostRight + Theme.gap

    // The tray. On a wide screen it has two rows of larger places where the cards leave room for it.
    readonly property bool tall: height - (182 + 70) * Math.max(1, Theme.textSize) * Theme.unit - rows * widest > 70 * Theme.unit
    // On an upright screen it is a shelf.
    // It has a second line, with room for both cards of a pair side by side, or larger places, where no card gets smaller.
    readonly property real shelf: shelfOf(pairs > 12 ? 2 : 1, usualSlot)
    readonly property real usualSlot: (pairs > 6 ? 86 : 74) * Theme.unit
    readonly property bool doubled: upright && pairs > 6 && pairs <= 12 && spareBelow(shelfOf(2, usualSlot)) > 0.3 * apart
    readonly property int shelfLines: pairs > 12 || doubled ? 2 : 1
    readonly property real mostSlot: spareBelow(shelfOf(shelfLines, 86 * Theme.unit)) >= 0 ? 86 * Theme.unit : usualSlot
    readonly property real shelfSlot: slotOf(shelfLines, mostSlot)
    function slotOf(lines: int, most: real): real {
        return Math.floor(Math.min(most, wide / Math.max(1, Math.ceil(pairs / lines))))
    }
    function shelfOf(lines: int, most: real): real {
        return wordsLine + lines * slotOf(lines, most) + 8 * Theme.unit
    }
    // It stands further from the columns' numbers than the cards do, as they name the cards; but no card gets smaller
    // by it.
    readonly property real apart: upright ? 30 * Theme.unit : 0
    readonly property int lines: upright ? shelfLines : tall ? 2 : 1
    readonly property real strip: broad ? 0 : upright ? shelfOf(shelfLines, mostSlot) : (tall ? 144 : 84) * Math.max(1, 0.9 * Theme.textSize) * Theme.unit
    readonly property real trayHeight: upright ? lines * shelfSlot : strip - 8 * Theme.unit
    // The height of the words in one line, above the tray or beside it.
    readonly property real wordsHigh: upright ? wordsLine - 12 * Theme.unit - wordsApart : trayHeight

    // What stands above the cards and below them.
    readonly property real footer: pillHeight + (upright ? 16 : 14) * Theme.unit + (practises && skipsBelow ? skipHeight + Theme.gap : 0)
    readonly property real spare: spareBelow(strip)
    function spareBelow(strip: real): real {
        return Math.floor(height - lent - 20 * Theme.unit - strip - numbers - footer - rows * widest) - 1
    }
    // On an upright screen, what more there is lies below the tray: words and tray begin where those of the practice do.
    readonly property real lower: upright ? Math.max(0, Math.min(26 * Theme.unit, (spare - apart) / 5)) : 0
    // Where much is left, the cards stand in the middle between the tray and a short sentence; below a tray of two lines,
    // nearly so. A long sentence covers none.
    readonly property real lowered: Math.max(0, Math.min(16 * Theme.unit, 0.3 * lent, spare - (doubled ? 0 : 2.5 * apart)))
    readonly property real header: (broad ? 12 : 20) * Theme.unit + strip
        + Math.max(upright && Theme.textSize > 1.15 ? 18 * Theme.unit : 0, Math.min(apart + 5 * lower, spare))
        + lowered
    // How high the page has to be on an upright screen, for cells as wide as there is room for.
    readonly property real wish: 52 * Theme.unit + shelf + apart + numbers + pillHeight + rows * widest

    // The cells of the cards.
    // A whole number, or the last column might not fit into the sum of all by a rounding error.
    readonly property real fitting: Math.floor(Math.min(widest, (height - header - numbers - footer) / Math.max(1, rows)))
    property real cell: 0
    onFittingChanged: if (!resizes) fit()
    onResizesChanged: if (!resizes) fit()
    function fit() {
        // Pictures are loaded for this size: without cards there is no other.
        if (rows > 0)
            cell = fitting
    }
    // A pair that was just found has a frame of this thickness; frames of neighbours leave a clear strip between them.
    readonly property real ring: Math.min(12 * Theme.unit, 0.05 * cell)
    readonly property real framed: cell - 14 * Theme.unit
    // How far a hint's mark reaches out of its cells, so that it is seen around cards of their full size.
    readonly property real over: Math.max(0, 12 * Theme.unit - margin * cell)

    // The table, as large as all cells.
    readonly property real tableWidth: cell * columns
    readonly property real tableHeight: cell * rows
    // A little away from what is said beside them: the outermost numbers or cards are as far from the window's edge as the
    // bubble is.
    readonly property real tableX: Math.round((width - tableWidth + gutter) / 2 - 34 * Theme.unit * spoken)
    // On a wide screen, what is left of the height lies above the numbers, clear of the words and the tray.
    readonly property real dropped: upright ? 0 : Math.max(0, Math.min(24 * Theme.unit, height - header - numbers - footer - tableHeight))
    readonly property real tableY: Math.round(header + numbers + dropped)
    // Where the cards themselves begin and end.
    readonly property real cardsBegin: tableX + margin * cell
    readonly property real cardsEnd: tableX + tableWidth - margin * cell
    // On an upright screen, what stands above the cards begins with their numbers and ends with a mark's frame around them.
    readonly property real headLeft: tableX - gutter
    readonly property real headRight: tableX + tableWidth
    // The middle of the cards; upright, that of the page, as the face below it.
    readonly property real middle: upright ? width / 2 : tableX + tableWidth / 2

    // The middle of a cell, counted from the first.
    function centre(location: int): point {
        return Qt.point(tableX + (location % columns + 0.5) * cell,
                        tableY + (Math.floor(location / columns) + 0.5) * cell)
    }
    // How much a card is scaled to have this width, and at most this.
    function within(wide: real, most: real): real {
        return Math.min(most, wide / Math.max(1, card))
    }
}
