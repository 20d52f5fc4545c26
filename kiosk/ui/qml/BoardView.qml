// The game: the cards on their numbered table, and above them how far it is and the tray of the pairs found so far.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property BoardScreen board
    required property var words
    required property url cardBack
    required property url cardShadow
    // Whether pictures are loaded in the time between frames; without a wall's clock there is none.
    property bool prepares: false
    // Whether a sentence of the assistant stands on the screen.
    property bool said: false
    // Whether the assistant's bubble tells how the move goes on.
    property bool told: false
    // Where the face begins that stands below the cards, in this item; 0 where none does.
    property real faceAt: 0
    // See BoardLayout.
    property alias upright: layout.upright
    property alias lent: layout.lent
    property alias spoken: layout.spoken
    // Whether the page's height passes several values.
    property bool resizes: false

    // Where everything is, and what has just happened to the cards.
    readonly property alias boardLayout: layout
    readonly property alias cell: layout.cell
    readonly property alias widest: layout.widest
    readonly property alias turning: now.turning
    readonly property alias latest: now.latest
    readonly property alias last: now.last
    readonly property alias marks: now.marks
    // Where the cards end, and what stands below them.
    readonly property real foot: layout.practises && layout.skipsBelow ? head.skipEnd
        : pill.visible ? pill.y + pill.height : layout.tableY + layout.tableHeight
    // The middle of what a hint marks, in this item; from below, the end of a row where its number stands.
    readonly property point marked: Qt.point(
        layout.tableX + (now.markColumn >= 0 ? (now.markColumn + 0.5) * layout.cell : layout.upright ? -0.5 * layout.gutter : layout.tableWidth * 0.75),
        layout.tableY + (now.markRow < 0 ? 0 : (now.markRow + 0.5) * layout.cell))
    // Whether a card turns, or a pair is on its way to the tray: what else moves on the screen had better wait.
    readonly property bool moves: now.turning > 0 || joy.under
    // What was last touched or turned, in this item; the assistant looks at it.
    property point touched: Qt.point(width / 2, height / 2)
    signal touchedSomething()
    // Every pair was found, and is in the tray.
    signal won()
    // The first card was turned.
    signal firstTurned()
    readonly property bool untouched: board.untouched
    onUntouchedChanged: if (!untouched && board.pairs > 0) firstTurned()

    // Columns are counted from the left in every language, on the board and in what is said.
    LayoutMirroring.enabled: false
    LayoutMirroring.childrenInherit: true

    BoardLayout {
        id: layout
        width: view.width
        height: view.height
        upright: false
        lent: 0
        spoken: 0
        resizes: view.resizes || view.board.remaking
        rows: view.board.rows
        columns: view.board.columns
        pairs: view.board.pairs
        practises: view.board.practice
        practiceWidth: head.practiceWidth
        progressWidth: head.progressWidth
        skipWidth: head.skipWidth
        skipHeight: head.skipHeight
        pillHeight: pill.reserved
        onCellChanged: if (view.prepares && view.visible && cards.count > 0) redraw.restart(); else view.drawAtOnce()
    }
    BoardState {
        id: now
        board: view.board
        onTouched: location => {
            view.touched = layout.centre(location)
            view.touchedSomething()
        }
    }

    // The cell that the pictures are drawn for. Cards in sight that get another size are drawn anew a little later, in a
    // step of its own; until then they are scaled.
    property real drawnCell: 0
    readonly property real drawn: Math.floor(drawnCell * layout.share)
    Component.onCompleted: {
        layout.fit()
        drawAtOnce()
    }
    function drawAtOnce() {
        redraw.stop()
        drawnCell = layout.cell
    }
    SequentialAnimation {
        id: redraw
        PauseAnimation { duration: 60 }
        ScriptAction { script: view.drawnCell = layout.cell }
    }
    // Loads the pictures when the cards are dealt, in the sizes of the cards and of the tray, and not in the frame in
    // which the first one is turned or found.
    Repeater {
        model: view.board.pictures.length === 0 ? [] : [view.drawn, head.tray.card]
        Item {
            id: loaded
            required property int modelData
            Repeater {
                model: view.board.pictures
                Image {
                    required property string modelData
                    visible: false
                    // A card that is turned meanwhile waits for the same picture.
                    asynchronous: view.prepares
                    source: modelData
                    sourceSize: Qt.size(loaded.modelData, loaded.modelData)
                }
            }
        }
    }

    BoardHead {
        id: head
        anchors.fill: parent
        board: view.board
        words: view.words
        boardLayout: layout
        cardBack: view.cardBack
        cardShadow: view.cardShadow
        pairUnderWay: joy.under
    }
    BoardPill {
        id: pill
        // What comes next, until the assistant has something to say about it.
        asks: view.board.oneUp && now.open && !now.marks && !view.said && !view.told
        readonly property real under: layout.tableY + layout.tableHeight + (layout.upright ? 14 : 4) * Theme.unit
        x: Math.round(Math.max(0, Math.min(view.width - width, layout.middle - width / 2)))
        // Above the face, where no sentence stands there.
        y: now.speaking || view.said ? under : Math.round(Math.max(under, view.faceAt - 1.5 * height))
        // A hint that is seen or read needs no announcement any more.
        visible: asks || ((now.speaking || now.missed) && !view.told && !(now.speaking && (now.marks || view.said)))
        words: view.words
        speaking: now.speaking
        textSize: layout.wordsSize
        upright: layout.upright
        most: view.width
    }
    GridView {
        id: cards
        objectName: "board"
        // Upright, they stand in the middle once the numbers of their rows have gone.
        x: layout.tableX - (layout.upright ? now.ended * layout.gutter / 2 : 0)
        y: layout.tableY
        width: layout.tableWidth
        height: layout.tableHeight
        cellWidth: layout.cell
        cellHeight: layout.cell
        interactive: false
        focus: true
        activeFocusOnTab: true
        keyNavigationEnabled: true
        model: view.board
        Accessible.role: Accessible.Table
        Accessible.name: view.board.progress
        // Without cards there is nothing to tell.
        Accessible.ignored: layout.pairs === 0
        // A key that is held down is one tap.
        Keys.onReturnPressed: event => { if (!event.isAutoRepeat) tapCurrent() }
        Keys.onEnterPressed: event => { if (!event.isAutoRepeat) tapCurrent() }
        Keys.onSpacePressed: event => { if (!event.isAutoRepeat) tapCurrent() }
        Keys.onPressed: Theme.byKeyboard = true

        function tapCurrent() {
            const card = currentItem as BoardCard
            if (card !== null)
                card.answer()
            view.board.tap(currentIndex)
        }

        // Above the other cards, and below those that it marks.
        Mark {
            parent: cards.contentItem
            z: 1.5
            width: layout.tableWidth
            height: layout.tableHeight
            row: now.markRow
            column: now.markColumn
            cell: layout.cell
            over: layout.over
            above: layout.band
            before: layout.gutter
        }
        delegate: BoardCard {
            board: view.board
            boardLayout: layout
            boardState: now
            cardBack: view.cardBack
            cardShadow: view.cardShadow
            drawn: view.drawn
            prepares: view.prepares
            current: cards.activeFocus && cards.currentIndex === index
        }
    }
    // Above a mark's band, which encloses a number.
    BoardTable {
        boardLayout: layout
        markRow: now.markRow
        markColumn: now.markColumn
        // At the end the pictures alone are looked at.
        opacity: 1 - now.ended
    }
    Joy {
        id: joy
        anchors.fill: parent
        onLanded: {
            if (view.board.tray.length !== layout.pairs)
                return
            now.over = true
            if (!layout.practises)
                sweep.restart()
            view.won()
        }
    }
    // The joy about the last pair runs over all cards.
    NumberAnimation { id: sweep; target: now; property: "wave"; from: 0; to: 1; duration: 5 * Theme.motion }
    Connections {
        target: view.board
        // A new board begins at its first card for those who play by keyboard.
        function onModelReset() {
            sweep.stop()
            now.begin()
            cards.currentIndex = 0
            cards.focus = true
            joy.cancel()
        }
        function onPairFound(first, second, picture) {
            const found = view.board.tray.length
            const goal = head.tray.middle(found - 1)
            now.latest = [first, second]
            if (found === layout.pairs)
                now.last = [first, second]
            joy.celebrate([layout.centre(first), layout.centre(second)], Qt.point(head.tray.x + goal.x, head.tray.y + goal.y),
                          Math.floor(layout.cell * layout.share), head.tray.card, picture)
        }
    }
}
