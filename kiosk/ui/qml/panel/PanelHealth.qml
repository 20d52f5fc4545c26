// The day in numbers, and how everything is that is well; the notice tells the rest. Quieter than all else.
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
    // Whether it has all of a wide page: the checks stand beside two numbers then, or below more of them in one row or two.
    property bool abreast: false
    readonly property bool paired: abreast && day.visible && day.shown.length < 3
    readonly property int columns: Theme.textSize > 1.15 || lines.length < 2 ? 1 : !abreast || paired ? 2 : lines.length > 4 ? 3 : lines.length
    readonly property int rows: Math.ceil(lines.length / columns)
    readonly property real gutter: Math.round(1.6 * Theme.gap)
    readonly property real room: width - 2 * inset
    readonly property real numbered: paired ? Math.floor(0.34 * room) : room

    // How high it may be: what it has left is shared among its rows, as long as they still stand together.
    property real most: 0
    readonly property real spare: Math.max(0, Math.min(limit, (most - bare(size)) / (rows + (allWell ? 1.5 : 1))))
    readonly property real limit: 3 * Theme.gap
    readonly property real step: 10 * Theme.unit
    function column(width: real): real {
        return Math.floor((width - 2 * inset - (paired ? numbered + gutter : 0) - (columns - 1) * gutter) / columns)
    }
    // How wide the names are: all alike, except in a single row, where what they leave is for the words behind.
    function naming(size: real, alone: var): real {
        return Math.min(0.55 * column(width), 1.02 * Math.max(0, ...(rows > 1 ? lines : [alone]).map(line => wordWidths.bold(line.name, day.share * size))) + 0.3 * size)
    }
    // How high each row is where nothing is left.
    function row(at: int, size: real): real {
        const each = lines.slice(at * columns, (at + 1) * columns).map(line => wordWidths.plainLines(line.message, day.share * size, column(width) - 1.25 * day.share * size - naming(size, line) - 2 * step))
        return Math.max(1, ...each) * Math.ceil(1.4 * day.share * size)
    }
    function bare(size: real): real {
        const numbers = day.deep(size, numbered)
        let sum = (allWell ? Math.ceil(1.4 * 1.2 * size) + step : 0) + (rows - 1) * step
        for (let at = 0; at < rows; at++)
            sum += row(at, size)
        return Math.ceil(edges + (paired ? Math.max(numbers, sum) : numbers > 0 ? numbers + 2 * parting + 2 * Theme.unit + sum : sum))
    }
    readonly property real parting: 0.5 * Theme.gap
    WordWidths {
        id: wordWidths
    }

    title: ""
    Accessible.role: Accessible.Grouping
    Accessible.name: words["console-health"]
    // Its marks stand below those of the notice.
    inset: Math.round(1.4 * Theme.gap)
    visible: lines.length > 0
    least: Theme.upright && spare === limit ? 0 : most
    apart: 0

    Grid {
        columns: health.paired ? 2 : 1
        columnSpacing: health.gutter
        topPadding: health.paired ? health.spare : 0
        verticalItemAlignment: Grid.AlignVCenter
        PanelDay {
            id: day
            width: health.numbered
            panel: health.panel
            size: health.size
        }
        Item {
            visible: day.visible && !health.paired
            width: health.room
            height: 2 * health.parting + 2 * Theme.unit + health.spare
            Rectangle {
                y: Math.floor((parent.height - height) / 2)
                width: parent.width
                height: 2 * Theme.unit
                color: Theme.edge
            }
        }
        Row {
            visible: health.allWell
            bottomPadding: health.step + 0.5 * health.spare
            PanelMark {
                width: 1.7 * health.size
                well: true
                grown: 1.3
                size: 1.2 * health.size
            }
            PlainText {
                text: health.words["console-all-well"]
                font { pixelSize: 1.2 * health.size; bold: true }
            }
        }
        Grid {
            columns: health.columns
            columnSpacing: health.gutter
            rowSpacing: health.step + health.spare
            Repeater {
                model: health.lines
                delegate: PanelLine {
                    required property var modelData
                    line: modelData
                    words: health.words
                    width: health.column(health.width)
                    size: day.share * health.size
                    named: health.naming(health.size, modelData)
                }
            }
        }
    }
}
