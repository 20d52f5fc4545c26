// One thing that was not as planned today: when, what, and why.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Row {
    id: row

    required property var deviation
    property real size: Theme.dense

    spacing: 10 * Theme.unit
    PlainText {
        id: when
        text: row.deviation.when
        font.pixelSize: row.size
        color: Theme.faintInk
    }
    PlainText {
        width: row.width - when.width - row.spacing
        text: row.deviation.words + (row.deviation.reason === "" ? "" : " · " + row.deviation.reason)
        font.pixelSize: row.size
        color: Theme.ink
        wrapMode: Text.Wrap
    }
}
