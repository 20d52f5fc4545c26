// One line for the experimenter on a second screen: the day, the stage, what is wrong, and the board of the session, small.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Window
import Recollect
import ".."

Window {
    id: strip

    required property BoardScreen board
    property string clock: ""
    property var tiles: []
    property string words: ""
    property bool well: true
    // Pixels of one unit: the strip is 100 units high, on whatever screen.
    readonly property real unit: height / 100

    title: "Recollect"
    color: Theme.paper

    Row {
        anchors { left: parent.left; leftMargin: 24 * strip.unit; verticalCenter: parent.verticalCenter }
        width: mirror.x - anchors.leftMargin - 24 * strip.unit
        spacing: 40 * strip.unit

        PlainText {
            id: time
            anchors.verticalCenter: parent.verticalCenter
            text: strip.clock
            font { pixelSize: 48 * strip.unit; bold: true }
        }
        Repeater {
            id: numbers
            model: strip.tiles
            Column {
                id: tile
                required property var modelData
                anchors.verticalCenter: parent.verticalCenter
                PlainText {
                    text: tile.modelData.title
                    font.pixelSize: 20 * strip.unit
                    color: Theme.faintInk
                }
                PlainText {
                    text: tile.modelData.value
                    font { pixelSize: 32 * strip.unit; bold: true }
                }
            }
        }
        PlainText {
            anchors.verticalCenter: parent.verticalCenter
            width: Math.max(0, parent.width - x)
            text: strip.words
            wrapMode: Text.Wrap
            maximumLineCount: 2
            elide: Text.ElideRight
            font { pixelSize: 26 * strip.unit; bold: !strip.well }
            color: strip.well ? Theme.ink : Theme.deepAmber
        }
    }

    Grid {
        id: mirror
        objectName: "mirror"
        readonly property real cell: strip.board.rows > 0 ? 88 * strip.unit / strip.board.rows : 0
        anchors { right: parent.right; rightMargin: 24 * strip.unit; verticalCenter: parent.verticalCenter }
        columns: strip.board.columns
        Accessible.ignored: true
        Repeater {
            model: strip.board
            Rectangle {
                id: card
                required property int index
                required property url picture
                required property bool up
                required property bool found
                readonly property int row: Math.floor(index / mirror.columns)
                readonly property int column: index % mirror.columns
                readonly property bool isMarked: (strip.board.markRow >= 0 || strip.board.markColumn >= 0)
                    && (strip.board.markRow < 0 || strip.board.markRow === row)
                    && (strip.board.markColumn < 0 || strip.board.markColumn === column)
                width: mirror.cell
                height: mirror.cell
                color: up || found ? Theme.white : Theme.sea
                opacity: found ? Theme.done : 1
                border { color: isMarked ? Theme.amber : Theme.paper; width: (isMarked ? 3 : 1) * strip.unit }
                Image {
                    anchors { fill: parent; margins: 2 * strip.unit }
                    visible: card.up || card.found
                    source: visible ? card.picture : ""
                    sourceSize { width: 64; height: 64 }
                    fillMode: Image.PreserveAspectFit
                    // The visitor's window must not wait for it.
                    asynchronous: true
                }
            }
        }
    }
}
