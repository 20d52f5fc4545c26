// One thing of the day in a row of several: what it is, with a mark if it is a check, and below that how it is. Numbers are
// larger, on the line on which all of it stands.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Column {
    id: fact

    required property string title
    required property string value
    // What more there is to tell of a number; empty for nothing.
    property string line: ""
    // The check that it is; null for a number.
    property var check: null
    required property var words
    required property real size

    Accessible.role: Accessible.Grouping
    Accessible.name: title

    readonly property real before: check === null ? 0 : mark.width + 10 * Theme.unit
    readonly property real grown: 1.6
    FontMetrics {
        id: largest
        font { pixelSize: fact.grown * fact.size; bold: true }
    }

    Item {
        width: parent.width
        height: name.height
        PanelMark {
            id: mark
            visible: fact.check !== null
            well: fact.check?.is_ok ?? true
            idle: !(fact.check?.is_used ?? true)
            grown: 1.25
            size: fact.size
            words: fact.words[!well ? "console-mark-ill" : idle ? "console-mark-idle" : "console-mark-well"] ?? ""
        }
        PlainText {
            id: name
            x: fact.before
            width: parent.width - x
            text: fact.title
            font.pixelSize: fact.size
            color: Theme.faintInk
        }
    }
    Item {
        width: parent.width
        height: told.y + told.height
        PlainText {
            id: told
            x: fact.before
            y: Math.round(largest.ascent - baselineOffset)
            width: parent.width - x
            text: fact.value
            font { pixelSize: (fact.check === null ? fact.grown : 1) * fact.size; bold: fact.check === null }
            color: Theme.ink
            wrapMode: Text.Wrap
        }
    }
    Balanced {
        width: parent.width
        visible: text !== ""
        text: fact.line
        horizontalAlignment: Text.AlignLeft
        font.pixelSize: fact.size
        color: Theme.ink
    }
}
