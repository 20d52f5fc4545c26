// One number of the day: what it counts, the number, and a line below it.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: tile

    required property string title
    required property string value
    required property string line
    // How large the number is.
    property real size: Theme.dense * 1.6
    property real lettering: Theme.dense

    implicitHeight: content.height
    Accessible.role: Accessible.Grouping
    Accessible.name: title

    Column {
        id: content
        width: parent.width
        PlainText {
            width: parent.width
            text: tile.title
            font.pixelSize: tile.lettering
            color: Theme.faintInk
            wrapMode: Text.Wrap
        }
        PlainText {
            width: parent.width
            text: tile.value
            font { pixelSize: tile.size; bold: true }
            color: Theme.ink
            wrapMode: Text.Wrap
        }
        PlainText {
            width: parent.width
            text: tile.line
            visible: text !== ""
            font.pixelSize: tile.lettering
            color: Theme.faintInk
            wrapMode: Text.Wrap
        }
    }
}
