// A line to be read, with a drawing at its beginning if it has one.
import QtQuick
import "."

Item {
    id: line

    // Where it has two lines, the first is a heading.
    required property string text
    readonly property string lead: text.includes("\n") ? text.slice(0, text.indexOf("\n")) : ""
    // The name of a drawing; without one the text has all of the width.
    property string sign: ""
    readonly property bool signed: sign !== ""
    property bool strong: false
    // Whether the words stand in the middle of their width.
    property bool inMiddle: false
    property real size: Theme.body
    property real leadSize: size
    property real leading: 1.08
    // How long the last line below the heading is at least, as a share of the longest.
    property real lastLine: inMiddle ? 0.75 : 0.4

    // How wide the drawing is, and the colour of its ground.
    property real badge: 2.5 * size
    property alias ground: mark.color
    // How far the words are from the drawing.
    property real apart: (centred ? 1.5 : 1) * Theme.gap
    // Whether the drawing stands in the middle of the lines, and not at the first of them. Beside a large drawing, a
    // heading stands at one place whatever follows it, so that all headings below each other are as far apart as the
    // drawings: its capitals begin a little below the top of the drawing.
    property bool centred: false
    readonly property bool headed: centred && signed && lead !== ""
    // How far the lines are then below the top of the drawing: they have air above their capitals.
    readonly property real sunk: headed ? 0.1 * badge - capitals.ascent + 0.72 * leadSize : 0

    // How high it is at least, so that lines beside each other begin together.
    property real least: 0

    height: Math.max(words.y + words.height, signed ? mark.height : 0, least)

    FontMetrics {
        id: capitals
        font { pixelSize: line.leadSize; bold: true }
    }
    Sign {
        id: mark
        visible: line.signed
        x: Theme.across(0, width, line.width)
        y: line.headed ? 0 : line.centred ? (line.height - height) / 2 : Math.max(0, (Math.min(words.height, 2.7 * line.size) - height) / 2)
        width: line.badge
        sign: line.sign
        thick: line.centred ? 1.7 : 2
        reach: line.centred ? 31 : 35
    }
    Column {
        id: words
        readonly property real indent: line.signed ? mark.width + line.apart : 0
        x: Theme.across(indent, width, line.width)
        y: line.headed ? line.sunk : !line.signed ? 0 : Math.max(0, (mark.height - height) / 2)
        width: line.width - indent
        Balanced {
            width: parent.width
            visible: text !== ""
            text: line.lead
            horizontalAlignment: line.inMiddle ? Text.AlignHCenter : Text.AlignLeft
            font { pixelSize: line.leadSize; bold: true }
            lineHeight: line.leading
        }
        Balanced {
            width: parent.width
            // A number stays with what it counts.
            text: (line.lead === "" ? line.text : line.text.slice(line.lead.length + 1)).replace(/(\d) /g, "$1\u00a0")
            horizontalAlignment: line.inMiddle ? Text.AlignHCenter : Text.AlignLeft
            font { pixelSize: line.size; bold: line.strong }
            least: line.lastLine
            lineHeight: line.leading
        }
    }
}
