// How everything is that is well; the notice tells the rest. In two columns where there is room for them.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

PanelSection {
    id: health

    required property PanelScreen panel
    property bool double: false
    // What lies between two columns.
    property real gutter: Theme.gap
    property real spread: 0
    readonly property var words: panel.words
    readonly property var lines: panel.health.lines

    // What a wide screen has left is shared among the lines.
    readonly property real room: double ? 0 : least - frame - 0.5 * Theme.gap
    readonly property real each: Math.max(0, Math.min(84 * Theme.unit, room / lines.length))
    readonly property real longest: widest(lines.map(line => line.name), letters.font) + 14 * Theme.unit
    readonly property real named: Math.min(0.4 * table.column, longest)
    // How wide it is if no line of it wraps: its mark, its name, what it says, and the steps between them.
    readonly property real natural: 2 * inset + 1.25 * size + longest + widest(lines.map(line => line.message), letters.font) + 20 * Theme.unit
    // What is measured depends on the font, which is named for that reason alone.
    function widest(names: var, _font: font): real {
        return Math.ceil(Math.max(0, ...names.map(name => letters.advanceWidth(name))))
    }
    FontMetrics {
        id: letters
        font { pixelSize: health.size; bold: true }
    }

    title: words["console-health"]
    visible: lines.length > 0

    Grid {
        id: table
        readonly property real column: Math.floor((parent.width - (columns - 1) * columnSpacing) / columns)
        width: parent.width
        columns: health.double ? 2 : 1
        columnSpacing: health.gutter
        rowSpacing: health.each > 0 ? 0 : (health.panel.health.matters.length > 3 ? 8 : 20) * Theme.unit + health.spread
        Repeater {
            model: health.lines
            delegate: Item {
                id: place
                required property var modelData
                width: table.column
                height: Math.max(health.each, line.height)
                PanelLine {
                    id: line
                    anchors.verticalCenter: health.double ? undefined : parent.verticalCenter
                    width: parent.width
                    line: place.modelData
                    words: health.words
                    size: health.size
                    named: health.named
                }
            }
        }
    }
}
