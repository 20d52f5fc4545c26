// One number of the day: what it counts, the number, and a line below it.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: tile

    required property string title
    required property string value
    required property string line
    // What matters more than that line, and stands in its place; the line is then behind the number.
    property string first: ""
    // How large the number is.
    property real size: Theme.dense * 1.6
    // That of one beside it, if that is larger.
    property real crown: 0
    property real lettering: Theme.dense

    implicitHeight: content.height
    Accessible.role: Accessible.Grouping
    Accessible.name: title

    FontMetrics {
        id: crowned
        font { pixelSize: Math.max(tile.size, tile.crown); bold: true }
    }
    FontMetrics {
        id: own
        font { pixelSize: tile.size; bold: true }
    }
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
            id: value
            width: parent.width
            height: tile.crown > tile.size ? Math.max(implicitHeight, Math.ceil(crowned.height)) : implicitHeight
            verticalAlignment: Text.AlignBottom
            bottomPadding: Math.max(0, crowned.descent - own.descent)
            text: tile.value
            font { pixelSize: tile.size; bold: true }
            color: Theme.ink
            wrapMode: Text.Wrap
            // Where both fit in one line, and something matters more below.
            PlainText {
                id: behind
                readonly property real gap: 0.7 * tile.lettering
                visible: tile.first !== "" && value.implicitWidth + gap + implicitWidth <= tile.width
                x: value.implicitWidth + gap
                y: value.baselineOffset - baselineOffset
                text: tile.line
                font.pixelSize: tile.lettering
                color: Theme.faintInk
            }
            // In that line too, where it has the whole card.
            PlainText {
                id: last
                visible: behind.visible && behind.x + behind.implicitWidth + 2 * behind.gap + implicitWidth <= tile.width
                x: tile.width - width
                y: value.baselineOffset - baselineOffset
                text: tile.first
                font.pixelSize: 1.22 * tile.lettering
                color: Theme.ink
            }
        }
        PlainText {
            visible: text !== "" && !last.visible
            width: parent.width
            text: tile.first
            font.pixelSize: 1.22 * tile.lettering
            color: Theme.ink
            wrapMode: Text.Wrap
        }
        PlainText {
            width: parent.width
            text: tile.line
            visible: text !== "" && !behind.visible
            font.pixelSize: tile.lettering
            color: Theme.faintInk
            wrapMode: Text.Wrap
        }
    }
}
