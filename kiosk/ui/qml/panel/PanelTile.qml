// One number of the day: what it counts, the number, and a line below it.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Rectangle {
    id: tile

    required property string title
    required property string value
    required property string line

    implicitHeight: content.height + 1.2 * Theme.gap
    radius: Theme.radius
    color: Theme.white
    border { color: Theme.edge; width: 2 * Theme.unit }
    Accessible.role: Accessible.Grouping
    Accessible.name: title

    Column {
        id: content
        anchors { left: parent.left; right: parent.right; top: parent.top; margins: 0.8 * Theme.gap; topMargin: 0.6 * Theme.gap }
        PlainText {
            width: parent.width
            text: tile.title
            font.pixelSize: Theme.denser
            color: Theme.faintInk
            wrapMode: Text.Wrap
        }
        PlainText {
            width: parent.width
            text: tile.value
            font { pixelSize: Theme.dense * 1.6; bold: true }
            color: Theme.ink
            wrapMode: Text.Wrap
        }
        PlainText {
            width: parent.width
            text: tile.line
            visible: text !== ""
            font.pixelSize: Theme.denser
            color: Theme.faintInk
            wrapMode: Text.Wrap
        }
    }
}
