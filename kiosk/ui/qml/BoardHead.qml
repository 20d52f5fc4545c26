// What stands above the cards, or beside them: how far the game is, the tray of the pairs found so far, and in the
// practice its name and the way to the game.
import QtQuick
import Recollect
import "."

Item {
    id: head

    required property BoardScreen board
    required property var words
    required property BoardLayout boardLayout
    required property url cardBack
    required property url cardShadow
    // Whether a pair is on its way to the tray.
    required property bool pairUnderWay
    readonly property bool broad: boardLayout.broad
    readonly property bool upright: boardLayout.upright
    readonly property bool practises: boardLayout.practises
    // How wide a line of words may be where they stand beside the cards.
    readonly property real aside: boardLayout.side - Theme.gap

    readonly property alias tray: tray
    // What its parts take, for the layout.
    readonly property real practiceWidth: practice.width
    readonly property real progressWidth: broad ? progress.implicitWidth : progress.width
    readonly property real skipWidth: skip.implicitWidth
    readonly property real skipHeight: skip.height
    // Where the way to the game ends.
    readonly property real skipEnd: skip.y + skip.height

    Rectangle {
        id: practice
        // Whether everything above the cards begins and ends with them.
        readonly property bool heads: head.upright && width + progress.implicitWidth
            + (head.boardLayout.skipsBelow ? 0 : skip.width + Theme.gap) + Theme.gap <= head.boardLayout.headRight - head.boardLayout.headLeft
        visible: head.practises
        x: heads ? head.boardLayout.headLeft
            : !head.broad && head.boardLayout.above <= head.boardLayout.cardsEnd - head.boardLayout.cardsBegin ? head.boardLayout.cardsBegin
            : Theme.gap
        y: head.broad ? head.boardLayout.tableY : head.boardLayout.wordsAt + (head.boardLayout.wordsHigh - height) / 2
        width: named.width + 1.6 * Theme.gap
        height: named.height + 0.5 * Theme.gap
        radius: height / 2
        color: Theme.sand
        PlainText {
            id: named
            anchors.centerIn: parent
            width: Math.min(implicitWidth, (head.broad ? head.aside : head.width) - 1.6 * Theme.gap)
            horizontalAlignment: Text.AlignHCenter
            wrapMode: width < implicitWidth ? Text.Wrap : Text.NoWrap
            text: head.words["practice-title"]
            font { pixelSize: head.boardLayout.wordsSize; bold: true }
            color: Theme.ink
            Accessible.role: Accessible.Heading
        }
    }
    TextMetrics { id: mostPairs; font: progress.font; text: head.board.mostPairs }
    TextMetrics { id: mostMoves; font: moves.font; text: head.board.mostMoves }
    PlainText {
        id: progress
        x: head.broad ? Theme.gap : head.practises ? practice.x + practice.width + Theme.gap
            : head.upright ? head.boardLayout.headLeft : head.boardLayout.cardsBegin
        y: !head.broad ? head.boardLayout.wordsAt
            : head.practises ? practice.y + practice.height + 0.7 * Theme.gap : head.boardLayout.tableY
        // What stands beside the words keeps its place from the first pair to the last.
        width: head.broad ? head.aside : head.upright ? implicitWidth : Math.ceil(Math.max(implicitWidth, mostPairs.advanceWidth))
        height: head.broad ? implicitHeight : head.boardLayout.wordsHigh
        verticalAlignment: Text.AlignVCenter
        wrapMode: head.broad ? Text.Wrap : Text.NoWrap
        text: head.board.progress
        font { pixelSize: head.boardLayout.wordsSize; bold: true }
        color: Theme.ink
    }
    PlainText {
        id: moves
        // Nothing counts in a practice.
        visible: !head.practises
        // On a wide screen the tray comes last, so that these words do not run into what stands beside the cards.
        x: head.broad ? Theme.gap : head.upright ? head.boardLayout.headRight - width : progress.x + progress.width + Theme.gap
        y: head.broad ? progress.y + progress.height + 0.5 * Theme.gap : head.boardLayout.wordsAt
        width: head.broad ? head.aside : head.upright ? implicitWidth : Math.ceil(Math.max(implicitWidth, mostMoves.advanceWidth))
        height: head.broad ? implicitHeight : head.boardLayout.wordsHigh
        verticalAlignment: Text.AlignVCenter
        wrapMode: head.broad ? Text.Wrap : Text.NoWrap
        text: head.board.moves
        font.pixelSize: head.boardLayout.wordsSize
        color: Theme.faintInk
    }
    Tray {
        id: tray
        // It ends with the cards, clear of what shows how far the visit is; or as far from the way to the game as it
        // begins from the words.
        readonly property real end: !head.practises ? Math.min(head.boardLayout.cardsEnd, head.boardLayout.mostRight)
            : (head.boardLayout.skipsBelow ? head.width : skip.x) - Theme.gap
        x: head.broad ? head.width - head.boardLayout.side : head.upright ? head.boardLayout.headLeft
            : head.practises ? progress.x + progress.width + Theme.gap : moves.x + moves.width + Theme.gap
        y: head.broad ? head.boardLayout.tableY : head.boardLayout.wordsAt + (head.upright ? head.boardLayout.wordsLine : 0)
        width: head.broad ? head.aside : head.upright ? head.boardLayout.headRight - head.boardLayout.headLeft : Math.max(0, end - x)
        height: head.broad ? head.boardLayout.tableHeight : head.boardLayout.trayHeight
        places: head.boardLayout.pairs
        spreads: head.upright
        lines: head.broad ? Math.ceil(places / 2) : head.boardLayout.lines
        resizes: head.boardLayout.resizes
        pictures: head.board.tray
        landed: Math.max(0, head.board.tray.length - (head.pairUnderWay ? 1 : 0))
        back: head.cardBack
        shadow: head.cardShadow
    }
    BigButton {
        id: skip
        objectName: "skip"
        most: head.broad ? head.aside : head.width - 2 * Theme.gap
        x: head.broad ? Theme.gap
            : head.boardLayout.skipsBelow ? head.boardLayout.tableX + (head.boardLayout.tableWidth - width) / 2
            : practice.heads ? head.boardLayout.headRight - width
            : head.boardLayout.above <= head.boardLayout.headRight ? head.boardLayout.cardsEnd - width
            : head.boardLayout.mostRight - width
        y: head.broad ? head.boardLayout.tableY + head.boardLayout.tableHeight - height
            : head.boardLayout.skipsBelow ? head.height - height - Theme.gap
            : head.boardLayout.wordsAt + (head.boardLayout.wordsHigh - height) / 2
        visible: head.practises
        quiet: true
        horizontalPadding: (head.broad ? 20 : head.upright ? 36 : 30) * Theme.unit
        verticalPadding: 12 * Theme.unit
        words: head.words["practice-skip"]
        onClicked: head.board.skip()
    }
}
