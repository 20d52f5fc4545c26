// How everything is that is well, in two columns; the notice tells the rest. Without a notice its heading says that all is well.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

PanelSection {
    id: health

    required property PanelScreen panel
    // Whether nothing at all is to be done.
    required property bool allWell
    readonly property var words: panel.words
    readonly property var lines: panel.health.lines
    readonly property int columns: Theme.textSize > 1.15 || lines.length < 2 ? 1 : 2
    readonly property int rows: Math.ceil(lines.length / columns)
    readonly property real gutter: Math.round(1.6 * Theme.gap)
    readonly property real told: 0.94 * size

    // How high it may be: what it has left is shared among its rows, as long as they still stand together.
    property real most: 0
    readonly property real spare: Math.max(0, Math.min(limit, (most - bare(size)) / Math.max(1, rows)))
    readonly property real limit: (Theme.upright ? 5 : 8) * Theme.gap
    function column(width: real): real {
        return Math.floor((width - 2 * inset - (columns - 1) * gutter) / columns)
    }
    // How high each row is where nothing is left.
    function row(at: int, size: real): real {
        const room = column(width) - 1.7 * size
        const each = lines.slice(at * columns, (at + 1) * columns).map(line => wordWidths.plainLines(line.message, 0.94 * size, room))
        return Math.ceil(1.4 * size) + Math.max(1, ...each) * Math.ceil(1.4 * 0.94 * size)
    }
    function bare(size: real): real {
        let sum = edges + (allWell ? Math.ceil(1.4 * 1.3 * size) : 0) + (rows - 1) * 10 * Theme.unit
        for (let at = 0; at < rows; at++)
            sum += row(at, size)
        return Math.ceil(sum)
    }
    WordWidths {
        id: wordWidths
    }

    title: allWell ? words["console-all-well"] : ""
    heightened: 1.3
    Accessible.role: Accessible.Grouping
    Accessible.name: words["console-health"]
    // Its marks stand below those of the notice.
    inset: Math.round(1.4 * Theme.gap)
    indent: allWell ? 1.7 * size : 0
    visible: lines.length > 0
    least: spare < limit ? most : 0
    apart: 10 * Theme.unit + spare

    PanelMark {
        parent: health
        visible: health.allWell
        x: health.inset
        y: health.above + (1.3 - 1) * 0.68 * health.size
        well: true
        grown: 1.3
        size: health.size
    }
    Grid {
        width: parent.width
        topPadding: 0.5 * health.spare
        bottomPadding: 0.5 * health.spare
        columns: health.columns
        columnSpacing: health.gutter
        rowSpacing: health.apart
        Repeater {
            model: health.lines
            delegate: Row {
                id: line
                required property var modelData
                width: health.column(health.width)
                PanelMark {
                    id: mark
                    width: 1.7 * health.size
                    idle: !line.modelData.is_used
                    well: line.modelData.is_ok
                    grown: 1.3
                    size: health.size
                    words: health.words[!well ? "console-mark-ill" : idle ? "console-mark-idle" : "console-mark-well"]
                }
                Column {
                    width: parent.width - mark.width
                    PlainText {
                        width: parent.width
                        text: line.modelData.name
                        font { pixelSize: health.size; bold: true }
                        color: Theme.ink
                        wrapMode: Text.Wrap
                    }
                    Balanced {
                        width: parent.width
                        text: line.modelData.message
                        font.pixelSize: health.told
                        color: Theme.faintInk
                        horizontalAlignment: Text.AlignLeft
                        least: 0.2
                    }
                }
            }
        }
    }
}
