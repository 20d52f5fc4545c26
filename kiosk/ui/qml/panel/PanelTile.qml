// One number of the day: the number, what it counts, and a line below it where there is more to tell.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: tile

    required property string title
    required property string value
    required property string line
    // How large the number is, and the words below it.
    required property real size
    required property real lettering
    required property real lower

    height: content.height
    Accessible.role: Accessible.Grouping
    Accessible.name: title

    Column {
        id: content
        width: parent.width
        PlainText {
            width: parent.width
            text: tile.value
            font { pixelSize: tile.size; bold: true }
            lineHeight: 0.95
            color: Theme.ink
            wrapMode: Text.Wrap
        }
        PlainText {
            width: parent.width
            text: tile.title
            font.pixelSize: tile.lettering
            color: Theme.ink
            wrapMode: Text.Wrap
        }
        Balanced {
            width: parent.width
            visible: text !== ""
            text: tile.line
            horizontalAlignment: Text.AlignLeft
            font.pixelSize: tile.lower
            color: Theme.ink
        }
    }
}
