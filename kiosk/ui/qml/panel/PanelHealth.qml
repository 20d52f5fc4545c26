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
    readonly property var words: panel.words
    readonly property var lines: panel.health.lines

    readonly property real packed: deep(size, width) * Math.ceil(letters.height)

    // How wide it is if no line of it wraps: its mark, its name, what it says, and the steps between them.
    function natural(size: real): real {
        return 2 * inset + 1.25 * size + reach(lines, size) + widest(lines.map(line => line.message), plain, size) + 22 * Theme.unit + 2
    }
    function column(width: real): real {
        return double ? Math.floor((width - 2 * inset - gutter) / 2) : Math.floor(width - 2 * inset)
    }
    // How many lines of text stand below each other on a card so wide.
    function deep(size: real, width: real): int {
        const columns = double ? 2 : 1
        const needs = lines.map((line, at) => {
            const room = Math.max(1, column(width) - 1.25 * size - namedIn(at, size, width) - 20 * Theme.unit)
            const whole = widest([line.message], plain, size)
            return whole <= room ? 1 : Math.ceil(1.1 * whole / room)
        })
        return needs.reduce((sum, _, at) => sum + (at % columns === 0 ? Math.max(1, ...needs.slice(at, at + columns)) : 0), 0)
    }
    // How far the names reach of the column that this line stands in.
    function namedIn(at: int, size: real, width: real): real {
        return Math.min(0.4 * column(width), reach(double ? lines.filter((_, other) => other % 2 === at % 2) : lines, size))
    }
    // Letters are drawn in whole pixels.
    function widest(texts: var, measure: FontMetrics, size: real): real {
        return Math.ceil(Math.max(0, ...texts.map(text => measure.advanceWidth(text) * Math.round(size) / 100)))
    }
    // As far as the longest name, and a step.
    function reach(named: var, size: real): real {
        return widest(named.map(line => line.name), bold, size) + 14 * Theme.unit
    }
    FontMetrics {
        id: bold
        font { pixelSize: 100; bold: true }
    }
    FontMetrics {
        id: plain
        font.pixelSize: 100
    }
    FontMetrics {
        id: letters
        font.pixelSize: health.size
    }

    title: words["console-health"]
    visible: lines.length > 0

    Grid {
        id: table
        width: parent.width
        columns: health.double ? 2 : 1
        columnSpacing: health.gutter
        rowSpacing: health.apart
        Repeater {
            model: health.lines
            delegate: PanelLine {
                required property var modelData
                required property int index
                width: health.column(health.width)
                line: modelData
                words: health.words
                size: health.size
                named: health.namedIn(index, health.size, health.width)
            }
        }
    }
}
