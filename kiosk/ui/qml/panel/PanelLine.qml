// How one thing is: a mark, its name, and words.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Row {
    id: row

    required property var line
    required property var words
    property real size: Theme.dense
    // How wide its name is at most, so that the words of all lines begin at one place.
    property real named: Math.min(0.29 * width, 6.5 * size)

    spacing: 10 * Theme.unit

    PanelMark {
        id: mark
        well: row.line.is_ok
        idle: !row.line.is_used
        grown: 1.25
        size: row.size
        words: row.words[!row.line.is_ok ? "console-mark-ill" : idle ? "console-mark-idle" : "console-mark-well"]
    }
    PlainText {
        id: name
        width: row.named
        text: row.line.name
        font { pixelSize: row.size; bold: true }
        color: Theme.ink
        wrapMode: Text.Wrap
    }
    Balanced {
        width: row.width - mark.width - name.width - 2 * row.spacing
        text: row.line.message
        font { pixelSize: row.size; bold: !row.line.is_ok }
        color: row.line.is_ok ? Theme.ink : Theme.deepAmber
        horizontalAlignment: Text.AlignLeft
        least: 0.2
    }
}
