// The game: the cards with their rows and columns numbered, the mark of a hint, and the tray of the pairs found so far.
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
    // Whether the screen is higher than wide: then the tray is a shelf with lines of its own above the cards.
    property bool upright: false
    // Whether pictures are loaded in the time between frames; without a wall's clock there is none.
    property bool prepares: false
    // Whether a sentence of the assistant stands on the screen.
    property bool said: false
    // Whether the assistant's bubble tells how the move goes on.
    property bool told: false
    // Where the face begins that stands below the cards, in this item; 0 where none does.
    property real faceAt: 0
    // Asked of the board once, and not by every card.
    readonly property int rows: board.rows
    readonly property int columns: board.columns
    readonly property int pairs: board.pairs
    readonly property bool practises: board.practice
    readonly property bool open: board.open
    readonly property bool speaking: board.speaking
    readonly property bool missed: board.missed
    readonly property int markRow: board.markRow
    readonly property int markColumn: board.markColumn
    // How much of a cell a card takes.
    readonly property real share: upright ? 0.98 : 0.91
    // On an upright screen, what stands above the cards begins with their numbers and ends with a mark's frame around them.
    // The cards' pictures have a narrow margin.
    readonly property real margin: (1 - 0.962 * share) / 2
    readonly property real headLeft: table.x - gutter
    readonly property real headRight: table.x + table.width
    // On an upright screen, the room of the rows' numbers and their arrow beside the cards.
    readonly property real gutter: (upright ? 50 : 0) * Theme.unit

    // Columns are counted from the left in every language, on the board and in what is said.
    LayoutMirroring.enabled: false
    LayoutMirroring.childrenInherit: true
    // Where there is far more room beside the cards than above them, the tray stands there.
    readonly property bool broad: !upright && width > 1.6 * height
    readonly property real side: broad ? Math.min(300 * Theme.unit, 0.17 * width) : 0
    // Where the cards leave room for it, the tray has two rows of larger places.
    readonly property bool tall: height - (182 + 70) * Math.max(1, Theme.textSize) * Theme.unit - rows * widest > 70 * Theme.unit
    readonly property int shelfLines: pairs > 12 ? 2 : 1
    // On an upright screen, two rows leave room for the two cards of a pair beside each other, as one row does in the
    // practice. No card gets smaller by them.
    readonly property bool doubles: upright && pairs > 7 && shelfLines === 1 && remains + lowered > doubled + 1.5 * apart
    readonly property real doubled: 2 * doubleSlot - shelfSlot
    readonly property real doubleSlot: Math.floor(Math.min(82 * Theme.unit, 0.475 * wide / Math.max(1, Math.ceil(pairs / 2))))
    // What an upright screen has left with the fewest rows, below an announcement of one line.
    readonly property real remains: height - lent - 20 * Theme.unit - shelf - numbers - 90 * Math.max(1, Theme.textSize) * Theme.unit - rows * widest
    // Below two rows the cards stand lower, so that they are as far from the tray as from a short sentence. A long one
    // covers no card.
    readonly property real lowered: Math.min(24 * Theme.unit, 0.45 * lent)
    readonly property int lines: upright ? (doubles ? 2 : shelfLines) : tall ? 2 : 1
    // On an upright screen: the line of words above the tray, and a place of the tray. They depend on no height.
    readonly property real wordsLine: (78 * Math.max(1, Theme.textSize) + 20) * Theme.unit + wordsApart
    readonly property real wordsApart: 20 * Theme.unit
    readonly property real shelfSlot: Math.floor(Math.min((pairs > 6 ? 80 : 74) * Theme.unit, wide / Math.max(1, Math.ceil(pairs / shelfLines))))
    readonly property real shelf: wordsLine + shelfLines * shelfSlot + 8 * Theme.unit
    readonly property real usualStrip: upright ? shelf + (doubles ? doubled : 0) : (tall ? 144 : 84) * Math.max(1, 0.9 * Theme.textSize) * Theme.unit
    readonly property real strip: broad ? 0 : usualStrip
    // The shelf stands further from the columns' numbers than the cards do, as they name the cards; but no card gets
    // smaller by it.
    readonly property real apart: upright ? 30 * Theme.unit : 0
    // How much of its lower end a long sentence may cover.
    property real lent: 0
    readonly property real spare: Math.floor(height - lent - 20 * Theme.unit - strip - numbers - footer - rows * widest) - 1
    // On an upright screen, what more there is lies below the tray: words and tray begin where those of the practice do.
    readonly property real lower: upright ? Math.max(0, Math.min(24 * Theme.unit, (spare - apart) / 5)) : 0
    readonly property real header: (broad ? 12 : 20) * Theme.unit + strip
        + Math.max(upright && Theme.textSize > 1.15 ? 18 * Theme.unit : 0, Math.min(apart + 5 * lower, spare))
        + (doubles ? lowered : 0)
    // A pair that was just found has a frame of this thickness; frames of neighbours leave a clear strip between them.
    readonly property real ring: Math.min(12 * Theme.unit, 0.05 * cell)
    readonly property real framed: cell - 14 * Theme.unit
    // Where the cards themselves begin and end.
    readonly property real cardsBegin: table.x + margin * cell
    readonly property real cardsEnd: table.x + table.width - margin * cell
    readonly property real wordsSize: upright && Theme.textSize <= 1.15 ? Theme.size(38) : Theme.body
    // Where the words about the game stand: above the tray, or beside it in the same line.
    readonly property real wordsAt: 12 * Theme.unit
    readonly property real wordsHigh: upright ? wordsLine - 12 * Theme.unit - wordsApart : tray.height
    // The way to the game stands above the cards, with the tray; or below them, where large words leave no room there.
    readonly property real above: practice.width + (broad ? progress.implicitWidth : progress.width) + skip.implicitWidth + (upright ? 0 : 240 * Theme.unit) + 5 * Theme.gap
    readonly property bool skipsBelow: !broad && above > mostRight + Theme.gap
    // Where the dots begin that show how far the visit is, or the screen ends.
    readonly property real mostRight: width - (upright ? 1 : 3.5) * Theme.gap
    // Beside the numbers there is room for a mark's arrow.
    readonly property real numbers: (upright ? 66 : 78) * Theme.unit
    // On an upright screen the cards and the numbers of their rows are together as wide as the helper's sentence, and
    // nearly as the screen: the cards are as large as that allows.
    readonly property real edge: 20 * Theme.unit
    readonly property real wide: width - 2 * edge
    readonly property real widestUpright: (wide - gutter) / Math.max(1, columns)
    readonly property real footer: pill.height + (upright ? 16 : 22) * Theme.unit + (practises && skipsBelow ? skip.height + Theme.gap : 0)
    // How high this item has to be on an upright screen, for cells as wide as there is room for.
    readonly property real widest: upright ? widestUpright : (width - 2 * side - numbers - 2 * Theme.gap) / Math.max(1, columns)
    readonly property real wish: 52 * Theme.unit + shelf + apart + numbers + pill.height
        + rows * widestUpright
    // Where the cards end, and what stands below them.
    readonly property real foot: practises && skipsBelow ? skip.y + skip.height : pill.visible ? pill.y + pill.height : cards.y + cards.height
    // A whole number, or the last column might not fit into the sum of all by a rounding error.
    readonly property real fitting: Math.floor(Math.min(widest, (height - header - numbers - footer) / Math.max(1, rows)))
    // While the helper comes or goes, that passes several values. Cards and tray are laid out for the last of them.
    property bool resizes: false
    property real cell: 0
    onFittingChanged: if (!resizes) fit()
    onResizesChanged: if (!resizes) fit()
    function fit() {
        cell = fitting
    }
    // The cell that the pictures are drawn for. Cards in sight that get another size are drawn anew a little later, in a
    // step of its own; until then they are scaled.
    property real drawnCell: 0
    readonly property real drawn: Math.floor(drawnCell * share)
    onCellChanged: if (prepares && visible && cards.count > 0) redraw.restart(); else drawAtOnce()
    Component.onCompleted: {
        fit()
        drawAtOnce()
    }
    function drawAtOnce() {
        redraw.stop()
        drawnCell = cell
    }
    SequentialAnimation {
        id: redraw
        PauseAnimation { duration: 60 }
        ScriptAction { script: view.drawnCell = view.cell }
    }
    // What was last touched or turned, in this item; the assistant looks at it.
    property point touched: Qt.point(width / 2, height / 2)
    signal touchedSomething()
    // The middle of what a hint marks, in this item; from below, the end of a row where its number stands.
    readonly property bool marks: board.markRow >= 0 || board.markColumn >= 0
    readonly property point marked: Qt.point(
        table.x + (board.markColumn >= 0 ? (board.markColumn + 0.5) * cell : upright ? -0.5 * numbers : table.width * 0.75),
        table.y + (board.markRow < 0 ? 0 : (board.markRow + 0.5) * cell))
    // Whether a card turns, or a pair is on its way to the tray: what else moves on the screen had better wait.
    readonly property bool moves: turning > 0 || joy.under
    property int turning: 0
    // Where the last pair lies, once all are found.
    property list<int> last: []
    // Where the pair lies that was just found, until another card is turned over.
    property list<int> latest: []
    // The middle of the cards; upright, that of the page, as the face below it.
    readonly property real middle: upright ? width / 2 : table.x + table.width / 2
    // Every pair was found, and is in the tray.
    signal won()
    // The first pair was found.
    signal firstFound()
    // How far the joy about that has run over the cards, from the first to the last.
    property real wave: 0
    NumberAnimation { id: sweep; target: view; property: "wave"; from: 0; to: 1; duration: 5 * Theme.motion }

    // How much a card is scaled to have this width, and at most this.
    function within(wide: real, most: real): real {
        return Math.min(most, wide / Math.max(1, 0.962 * share * cell))
    }

    function centre(location: int): point {
        return Qt.point(table.x + (location % columns + 0.5) * cell,
                        table.y + (Math.floor(location / columns) + 0.5) * cell)
    }

    // Loads the pictures when the cards are dealt, in the sizes of the cards and of the tray, and not in the frame in
    // which the first one is turned or found.
    Repeater {
        model: view.board.pictures.length === 0 ? [] : [view.drawn, tray.card]
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

    Rectangle {
        id: practice
        visible: view.practises
        x: heads ? view.headLeft : !view.broad && view.above <= view.cardsEnd - view.cardsBegin ? view.cardsBegin : Theme.gap
        // Whether everything above the cards begins and ends with them.
        readonly property bool heads: view.upright && width + progress.implicitWidth + (view.skipsBelow ? 0 : skip.width + Theme.gap) + Theme.gap <= view.headRight - view.headLeft
        y: view.broad ? table.y : view.wordsAt + (view.wordsHigh - height) / 2
        width: named.width + 1.6 * Theme.gap
        height: named.height + 0.5 * Theme.gap
        radius: height / 2
        color: Theme.sand
        PlainText {
            id: named
            anchors.centerIn: parent
            width: Math.min(implicitWidth, (view.broad ? view.side - Theme.gap : view.width) - 1.6 * Theme.gap)
            horizontalAlignment: Text.AlignHCenter
            wrapMode: width < implicitWidth ? Text.Wrap : Text.NoWrap
            text: view.words["practice-title"]
            font { pixelSize: view.wordsSize; bold: true }
            color: Theme.ink
            Accessible.role: Accessible.Heading
        }
    }
    TextMetrics { id: mostPairs; font: progress.font; text: view.board.mostPairs }
    TextMetrics { id: mostMoves; font: moves.font; text: view.board.mostMoves }
    PlainText {
        id: progress
        x: !view.practises ? (view.broad ? Theme.gap : view.upright ? view.headLeft : view.cardsBegin) : view.broad ? Theme.gap : practice.x + practice.width + Theme.gap
        y: !view.broad ? view.wordsAt : view.practises ? practice.y + practice.height + 0.7 * Theme.gap : table.y
        // What stands beside the words keeps its place from the first pair to the last.
        width: view.broad ? view.side - Theme.gap : view.upright ? implicitWidth : Math.ceil(Math.max(implicitWidth, mostPairs.advanceWidth))
        height: view.broad ? implicitHeight : view.wordsHigh
        verticalAlignment: Text.AlignVCenter
        wrapMode: view.broad ? Text.Wrap : Text.NoWrap
        text: view.board.progress
        font { pixelSize: view.wordsSize; bold: true }
        color: Theme.ink
    }
    PlainText {
        id: moves
        // Nothing counts in a practice.
        visible: !view.practises
        // On a wide screen the tray comes last, so that these words do not run into what stands beside the cards.
        x: view.broad ? Theme.gap : view.upright ? view.headRight - width : progress.x + progress.width + Theme.gap
        y: view.broad ? progress.y + progress.height + 0.5 * Theme.gap : view.wordsAt
        width: view.broad ? view.side - Theme.gap : view.upright ? implicitWidth : Math.ceil(Math.max(implicitWidth, mostMoves.advanceWidth))
        height: view.broad ? implicitHeight : view.wordsHigh
        verticalAlignment: Text.AlignVCenter
        wrapMode: view.broad ? Text.Wrap : Text.NoWrap
        text: view.board.moves
        font.pixelSize: view.wordsSize
        color: Theme.faintInk
    }
    Tray {
        id: tray
        x: view.broad ? view.width - view.side : view.upright ? view.headLeft
         : view.practises ? progress.x + progress.width + Theme.gap : moves.x + moves.width + Theme.gap
        y: view.broad ? table.y : view.upright ? view.wordsAt + view.wordsLine : 12 * Theme.unit
        width: view.broad ? view.side - Theme.gap : view.upright ? view.headRight - view.headLeft : Math.max(0, end - x)
        // It ends a little before the cards, clear of what shows how far the visit is; or as far from the way to the
        // game as it begins from the words.
        readonly property real end: !view.practises ? view.cardsEnd - 2.5 * Theme.gap : (view.skipsBelow ? view.width : skip.x) - Theme.gap
        height: view.broad ? table.height : view.upright ? view.lines * (view.doubles ? view.doubleSlot : view.shelfSlot) : view.strip - 8 * Theme.unit
        places: view.pairs
        spreads: view.upright
        lines: view.broad ? Math.ceil(places / 2) : view.lines
        resizes: view.resizes
        pictures: view.board.tray
        landed: Math.max(0, view.board.tray.length - (joy.under ? 1 : 0))
        back: view.cardBack
        shadow: view.cardShadow
    }

    Rectangle {
        id: pill
        objectName: "pill"
        // What comes next, until the assistant has something to say about it.
        readonly property bool asksSecond: view.board.oneUp && view.open && !view.marks && !view.said && !view.told
        readonly property real under: cards.y + cards.height + (view.upright ? 14 : 8) * Theme.unit
        x: Math.round(Math.max(0, Math.min(view.width - width, view.middle - width / 2)))
        // Above the face, where no sentence stands there.
        y: view.speaking || view.said ? under : Math.round(Math.max(under, view.faceAt - 1.5 * height))
        // A hint that is seen or read needs no announcement any more.
        visible: asksSecond || (view.board.wait !== "" && !view.told && !(view.speaking && (view.marks || view.said)))
        opacity: visible ? 1 : 0
        Behavior on opacity { NumberAnimation { duration: Theme.motion } }
        width: waiting.width + (asksSecond ? 2.6 * Theme.gap : dots.width + 2.8 * Theme.gap)
        height: waiting.height + (view.upright ? 20 : 6) * Theme.unit
        radius: height / 2
        color: Theme.sand
        Row {
            id: dots
            anchors { left: parent.left; leftMargin: Theme.gap; verticalCenter: parent.verticalCenter }
            visible: !pill.asksSecond
            spacing: 6 * Theme.unit
            Repeater {
                model: 3
                Rectangle {
                    width: 9 * Theme.unit
                    height: width
                    radius: width / 2
                    color: Theme.ink
                }
            }
        }
        PlainText {
            id: waiting
            anchors { right: parent.right; rightMargin: (pill.asksSecond ? 1.3 : 1.2) * Theme.gap; verticalCenter: parent.verticalCenter }
            width: Math.min(implicitWidth, view.width - dots.width - 5 * Theme.gap)
            wrapMode: width < implicitWidth ? Text.Wrap : Text.NoWrap
            text: pill.asksSecond ? view.words["game-second"] : view.board.wait
            font.pixelSize: view.wordsSize
            color: Theme.ink
            Accessible.role: pill.asksSecond ? Accessible.StaticText : Accessible.AlertMessage
            Accessible.name: text
        }
    }

    BigButton {
        id: skip
        objectName: "skip"
        most: view.broad ? view.side - Theme.gap : view.width - 2 * Theme.gap
        x: view.broad ? Theme.gap : view.skipsBelow ? cards.x + (cards.width - width) / 2
         : practice.heads ? view.headRight - width
         : view.above <= table.x + table.width ? view.cardsEnd - width
         : view.mostRight - width
        y: view.broad ? table.y + table.height - height
         : view.skipsBelow ? view.height - height - Theme.gap : view.wordsAt + (view.wordsHigh - height) / 2
        visible: view.practises
        quiet: true
        horizontalPadding: (view.broad ? 20 : view.upright ? 36 : 30) * Theme.unit
        verticalPadding: 12 * Theme.unit
        words: view.words["practice-skip"]
        onClicked: view.board.skip()
    }

    Item {
        id: table
        x: Math.round((view.width - width + (view.upright ? view.gutter : view.numbers)) / 2)
        y: Math.round(view.header + view.numbers)
        width: view.cell * view.columns
        height: view.cell * view.rows

        Mark {
            anchors.fill: parent
            row: view.markRow
            column: view.markColumn
            cell: view.cell
            arrow: (view.upright ? 18 : 28) * Theme.unit
            apart: (view.upright ? 4 : 5) * Theme.unit
        }
        Repeater {
            model: view.columns
            PlainText {
                required property int index
                x: index * view.cell
                // Above a mark's arrow, also in large letters.
                y: Math.min(-view.numbers, -42 * Theme.unit - baselineOffset)
                width: view.cell
                text: index + 1
                font { pixelSize: view.upright ? Theme.size(36) : Theme.body; bold: true }
                color: view.markColumn === index ? Theme.deepAmber : Theme.faintInk
                horizontalAlignment: Text.AlignHCenter
                // Every card's name tells its row and column.
                Accessible.ignored: true
            }
        }
        Repeater {
            model: view.rows
            PlainText {
                required property int index
                x: view.upright ? -view.gutter : -view.numbers
                y: index * view.cell
                width: view.numbers - (view.upright ? 0 : 30 * Theme.unit)
                height: view.cell
                text: index + 1
                font { pixelSize: view.upright ? Theme.size(36) : Theme.body; bold: true }
                color: view.markRow === index ? Theme.deepAmber : Theme.faintInk
                horizontalAlignment: view.upright ? Text.AlignLeft : Text.AlignHCenter
                verticalAlignment: Text.AlignVCenter
                Accessible.ignored: true
            }
        }
    }

    GridView {
        id: cards
        objectName: "board"
        x: table.x
        y: table.y
        width: table.width
        height: table.height
        cellWidth: view.cell
        cellHeight: view.cell
        interactive: false
        focus: true
        activeFocusOnTab: true
        keyNavigationEnabled: true
        model: view.board
        Accessible.role: Accessible.Table
        Accessible.name: view.board.progress
        // Without cards there is nothing to tell.
        Accessible.ignored: view.pairs === 0
        // A key that is held down is one tap.
        Keys.onReturnPressed: event => { if (!event.isAutoRepeat) tapCurrent() }
        Keys.onEnterPressed: event => { if (!event.isAutoRepeat) tapCurrent() }
        Keys.onSpacePressed: event => { if (!event.isAutoRepeat) tapCurrent() }

        function tapCurrent() {
            const place = currentItem as Place
            if (place !== null)
                place.answer()
            view.board.tap(currentIndex)
        }

        component Place: Item {
            id: place
            required property int index
            required property url picture
            required property bool up
            required property bool found
            required property string label
            readonly property int row: Math.floor(index / view.columns)
            readonly property int column: index % view.columns
            readonly property bool marked: (view.markRow === row || view.markRow < 0)
                                           && (view.markColumn === column || view.markColumn < 0)
                                           && view.markRow + view.markColumn > -2
            // A hint means this very card. The mark takes a little of a card's room where cards are close together, and
            // more of this one's.
            readonly property bool meant: view.markRow === row && view.markColumn === column
            // A tap would change nothing: two cards are open, a sentence is said, or this one is up.
            readonly property bool refuses: !view.open || up
            readonly property bool missed: up && !found && view.missed
            // How far a found card has come forward, and how far it has come to rest for good.
            property real forward: 0
            property bool settles: false
            property real rest: found && (settles || !coming.running) ? 1 : 0
            // How far the joy about the last pair lifts it; the wave is over one diagonal after another.
            readonly property real cheer: view.wave === 0 || view.wave === 1 ? 0
                : Math.max(0, 1 - Math.abs(view.wave * (view.rows + view.columns + 1) - row - column - 1) / 1.6)
            Behavior on rest { NumberAnimation { duration: Theme.motion } }
            // The last pair stays a little forward, in a rim of light.
            readonly property bool closes: view.last.includes(index)
            property real proud: closes && (settles || !coming.running) ? 1 : 0
            // A pair that was just found keeps its size in its frame until the next move.
            property real fresh: view.latest.includes(index) && (settles || !coming.running) ? 1 : 0
            Behavior on fresh { NumberAnimation { duration: Theme.motion } }
            readonly property real large: Math.max(proud, fresh)
            Behavior on proud { NumberAnimation { duration: Theme.motion } }

            readonly property real turning: face.turn
            readonly property bool turns: turning > 0 && turning < 1
            onTurnsChanged: view.turning += turns ? 1 : -1

            objectName: "card-" + index
            width: GridView.view.cellWidth
            height: GridView.view.cellHeight
            z: coming.running || large > 0 ? 2 : up ? 1 : 0
            Accessible.role: Accessible.Button
            Accessible.name: label
            Accessible.onPressAction: view.board.tap(index)

            // Answers at once that it was touched: what does not count makes the card shake its head.
            function answer() {
                view.touched = view.centre(index)
                view.touchedSomething()
                if (!refuses)
                    return
                view.board.refuse()
                if (Theme.motion > 0)
                    refusal.restart()
            }
            onFoundChanged: {
                settles = false
                if (found && Theme.motion > 0)
                    coming.restart()
            }
            // The face looks at a card that has just turned.
            onUpChanged: {
                if (!up)
                    return
                view.latest = []
                view.touched = view.centre(index)
                view.touchedSomething()
            }
            onMissedChanged: if (missed && Theme.motion > 0) sigh.restart()

            // A rim of light around the last pair.
            Rectangle {
                visible: place.proud > 0
                anchors.centerIn: parent
                width: (view.framed + 5 * Theme.unit) * (1 + 0.09 * place.cheer)
                height: width
                opacity: place.proud
                radius: width * 0.12
                color: Theme.amber
            }
            Rectangle {
                objectName: "found-" + place.index
                visible: place.rest > 0
                anchors.centerIn: parent
                // By its size: corners that are drawn larger by a scale look ragged.
                width: (0.9 * parent.width * (1 - place.large) + (view.framed - 0.9 * view.ring * place.proud) * place.large) * (1 + 0.09 * place.cheer)
                height: width
                opacity: place.rest
                radius: width * 0.12
                color: Theme.leaf
            }
            Rectangle {
                visible: place.forward > 0
                anchors.centerIn: face
                width: face.width * face.scale * 1.04
                height: width
                radius: width * 0.13
                color: Theme.leaf
                opacity: place.forward
            }
            CardFace {
                id: face
                property real shift: 0
                anchors { centerIn: parent; horizontalCenterOffset: shift }
                width: Math.floor(parent.width * view.share)
                height: width
                back: view.cardBack
                shadow: view.cardShadow
                drawn: view.drawn
                picture: place.picture
                up: place.up
                shade: 1 - place.rest
                // A pair has its green frame instead, as soon as it has come forward.
                rimShown: !place.found ? 1 : coming.running && !place.settles ? Math.max(0, 1 - place.forward) : 0
                prepares: view.prepares
                // Closed cards step back while a tap would not count, unless they are meant.
                opacity: view.speaking && !place.up && !place.marked ? Theme.held : 1
                Behavior on opacity { NumberAnimation { duration: Theme.motion } }
                scale: (tap.pressed ? 0.95 : 1) * (place.marked ? view.within(view.cell - (place.meant ? 28 : 18) * Theme.unit, 1) : 1) * (1 + 0.07 * lift) * (1 - 0.14 * place.rest + (view.within(view.framed - 2 * view.ring, 1.01) - 0.86) * place.large) * (1 + 0.16 * place.forward) * (1 + 0.09 * place.cheer)
            }
            // These two are no pair; in a while they close again.
            Rectangle {
                objectName: "missed-" + place.index
                visible: place.missed && place.turning === 1
                anchors { centerIn: face; horizontalCenterOffset: face.shift }
                width: 0.962 * face.width * face.scale
                height: width
                rotation: face.rotation
                radius: width * 0.12
                color: "transparent"
                // Thicker than the rim of any open card, and not the colour of a hint.
                border { color: Theme.faintInk; width: 8 * Theme.unit }
            }
            SequentialAnimation {
                id: coming
                PauseAnimation { duration: Theme.motion * 1.5 }
                NumberAnimation { target: place; property: "forward"; to: 1; duration: Theme.motion; easing.type: Easing.OutBack }
                PauseAnimation { duration: Theme.motion }
                // Its frame stays while it goes back.
                PropertyAction { target: place; property: "settles"; value: true }
                NumberAnimation { target: place; property: "forward"; to: 0; duration: Theme.motion; easing.type: Easing.InOutQuad }
            }
            SequentialAnimation {
                id: sigh
                PauseAnimation { duration: Theme.motion * 1.6 }
                NumberAnimation { target: face; property: "rotation"; to: -3; duration: Theme.motion; easing.type: Easing.InOutSine }
                NumberAnimation { target: face; property: "rotation"; to: 3; duration: Theme.motion; easing.type: Easing.InOutSine }
                NumberAnimation { target: face; property: "rotation"; to: 0; duration: Theme.motion; easing.type: Easing.InOutSine }
            }
            SequentialAnimation {
                id: refusal
                // Seen in the very next frame.
                PropertyAction { target: face; property: "shift"; value: place.width * 0.05 }
                NumberAnimation { target: face; property: "shift"; to: -place.width * 0.04; duration: Theme.motion > 0 ? 90 : 0; easing.type: Easing.InOutSine }
                NumberAnimation { target: face; property: "shift"; to: place.width * 0.02; duration: Theme.motion > 0 ? 80 : 0; easing.type: Easing.InOutSine }
                NumberAnimation { target: face; property: "shift"; to: 0; duration: Theme.motion > 0 ? 70 : 0; easing.type: Easing.InOutSine }
            }
            // Where nothing moves, this alone answers a tap that does not count.
            Rectangle {
                objectName: "refusal-" + place.index
                visible: tap.pressed && place.refuses
                anchors.centerIn: face
                width: face.width * face.scale + 10 * Theme.unit
                height: width
                radius: width * 0.13
                color: "transparent"
                border { color: Theme.deepAmber; width: 5 * Theme.unit }
            }
            Rectangle {
                anchors.fill: parent
                anchors.margins: parent.width * (0.97 - view.share) / 2
                radius: Theme.radius * 1.4
                color: "transparent"
                border { color: Theme.ink; width: 5 * Theme.unit }
                visible: cards.activeFocus && cards.currentIndex === place.index && Theme.byKeyboard
            }
            TapHandler {
                id: tap
                gesturePolicy: TapHandler.ReleaseWithinBounds
                // However long the press, it is a tap: in seconds, longer than any visitor has.
                longPressThreshold: 3600
                onPressedChanged: if (pressed) place.answer()
                onTapped: view.board.tap(place.index)
            }
            HoverHandler {
                cursorShape: !view.open ? Qt.WaitCursor : place.up ? Qt.ArrowCursor : Qt.PointingHandCursor
            }
        }
        delegate: Place {}
        Keys.onPressed: Theme.byKeyboard = true

        Connections {
            target: view.board
            // A new board begins at its first card for those who play by keyboard.
            function onModelReset() {
                view.turning = 0
                view.last = []
                view.latest = []
                sweep.stop()
                view.wave = 0
                cards.currentIndex = 0
                cards.focus = true
                joy.cancel()
            }
            function onPairFound(first, second, picture) {
                const goal = tray.middle(view.board.tray.length - 1)
                view.latest = [first, second]
                if (view.board.tray.length === view.pairs)
                    view.last = [first, second]
                if (view.board.tray.length === 1)
                    view.firstFound()
                joy.celebrate([view.centre(first), view.centre(second)], Qt.point(tray.x + goal.x, tray.y + goal.y),
                              Math.floor(view.cell * view.share), tray.card, picture)
            }
        }
    }
    Joy {
        id: joy
        anchors.fill: parent
        onLanded: {
            if (view.board.tray.length !== view.pairs)
                return
            if (!view.practises)
                sweep.restart()
            view.won()
        }
    }
}
