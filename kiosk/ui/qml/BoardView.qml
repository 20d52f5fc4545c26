// The game: the cards with their rows and columns numbered, the mark of a hint, and why a tap would not count.
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

    readonly property real header: (84 + (board.practice ? 64 * Math.max(1, Theme.textSize) : 0)) * Theme.unit
    // Beside the numbers there is room for a mark's arrow.
    readonly property real numbers: 78 * Theme.unit
    readonly property real footer: 64 * Theme.unit + (board.practice ? skip.height + Theme.gap : 0)
    // A whole number, or the last column might not fit into the sum of all by a rounding error.
    readonly property real cell: Math.floor(Math.min((width - numbers - 2 * Theme.gap) / Math.max(1, board.columns),
                                                     (height - header - numbers - footer) / Math.max(1, board.rows)))

    PlainText {
        anchors { horizontalCenter: cards.horizontalCenter; top: parent.top; topMargin: Theme.gap }
        visible: view.board.practice
        text: view.words["practice-title"]
        font { pixelSize: Theme.heading; bold: true }
        color: Theme.sea
    }
    Item {
        id: status
        anchors { left: cards.left; right: cards.right; bottom: table.top; bottomMargin: view.numbers }
        height: 60 * Theme.unit
        PlainText {
            anchors { left: parent.left; verticalCenter: parent.verticalCenter }
            text: view.board.progress
            font { pixelSize: Theme.body; bold: true }
            color: Theme.ink
        }
        PlainText {
            anchors { right: parent.right; verticalCenter: parent.verticalCenter }
            text: view.board.moves
            font.pixelSize: Theme.body
            color: Theme.faintInk
        }
    }

    PlainText {
        anchors { top: cards.bottom; horizontalCenter: cards.horizontalCenter }
        height: 64 * Theme.unit
        verticalAlignment: Text.AlignVCenter
        text: view.board.wait
        font.pixelSize: Theme.small
        color: Theme.deepAmber
        Accessible.role: Accessible.AlertMessage
        Accessible.name: text
    }

    BigButton {
        id: skip
        objectName: "skip"
        most: view.width - 2 * Theme.gap
        anchors { bottom: parent.bottom; bottomMargin: Theme.gap; horizontalCenter: cards.horizontalCenter }
        visible: view.board.practice
        quiet: true
        verticalPadding: 16 * Theme.unit
        words: view.words["practice-skip"]
        onClicked: view.board.skip()
    }

    Item {
        id: table
        x: (view.width - width - view.numbers) / 2 + view.numbers
        y: view.header + view.numbers
        width: view.cell * view.board.columns
        height: view.cell * view.board.rows

        Mark {
            anchors.fill: parent
            row: view.board.markRow
            column: view.board.markColumn
            cell: view.cell
        }
        Repeater {
            model: view.board.columns
            PlainText {
                required property int index
                x: index * view.cell
                y: -view.numbers
                width: view.cell
                text: index + 1
                font { pixelSize: Theme.body; bold: true }
                color: view.board.markColumn === index ? Theme.deepAmber : Theme.faintInk
                horizontalAlignment: Text.AlignHCenter
                // Every card's name tells its row and column.
                Accessible.ignored: true
            }
        }
        Repeater {
            model: view.board.rows
            PlainText {
                required property int index
                x: -view.numbers
                y: index * view.cell
                width: view.numbers - 30 * Theme.unit
                height: view.cell
                text: index + 1
                font { pixelSize: Theme.body; bold: true }
                color: view.board.markRow === index ? Theme.deepAmber : Theme.faintInk
                horizontalAlignment: Text.AlignHCenter
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
        // A key that is held down is one tap.
        Keys.onReturnPressed: event => { if (!event.isAutoRepeat) view.board.tap(currentIndex) }
        Keys.onEnterPressed: event => { if (!event.isAutoRepeat) view.board.tap(currentIndex) }
        Keys.onSpacePressed: event => { if (!event.isAutoRepeat) view.board.tap(currentIndex) }

        delegate: Item {
            id: place
            required property int index
            required property url picture
            required property bool up
            required property bool found
            required property string label
            readonly property int row: Math.floor(index / view.board.columns)
            readonly property int column: index % view.board.columns
            readonly property bool marked: (view.board.markRow === row || view.board.markRow < 0)
                                           && (view.board.markColumn === column || view.board.markColumn < 0)
                                           && view.board.markRow + view.board.markColumn > -2
            objectName: "card-" + index
            width: cards.cellWidth
            height: cards.cellHeight
            Accessible.role: Accessible.Button
            Accessible.name: label
            Accessible.onPressAction: view.board.tap(index)

            CardFace {
                anchors.centerIn: parent
                width: parent.width * 0.86
                height: width
                back: view.cardBack
                shadow: view.cardShadow
                picture: place.picture
                up: place.up
                // Closed cards step back while a tap would not count, unless they are meant; found ones for good.
                opacity: place.found ? Theme.done : view.board.speaking && !place.up && !place.marked ? Theme.held : 1
                Behavior on opacity { NumberAnimation { duration: Theme.motion } }
                scale: tap.pressed && view.board.open && !place.up ? 0.95 : 1
            }
            Rectangle {
                anchors.fill: parent
                anchors.margins: parent.width * 0.03
                radius: Theme.radius * 1.4
                color: "transparent"
                border { color: Theme.ink; width: 5 * Theme.unit }
                visible: cards.activeFocus && cards.currentIndex === place.index && Theme.byKeyboard
            }
            TapHandler {
                id: tap
                gesturePolicy: TapHandler.ReleaseWithinBounds
                // However long somebody presses, it is a tap: in seconds, longer than any visitor has.
                longPressThreshold: 3600
                onTapped: view.board.tap(place.index)
            }
            HoverHandler {
                cursorShape: !view.board.open ? Qt.WaitCursor : place.up ? Qt.ArrowCursor : Qt.PointingHandCursor
            }
        }
        Keys.onPressed: Theme.byKeyboard = true

        // A new board begins at its first card for those who play by keyboard.
        Connections {
            target: view.board
            function onModelReset() {
                cards.currentIndex = 0
                cards.focus = true
            }
        }
    }
}
