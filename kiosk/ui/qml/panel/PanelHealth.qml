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

    readonly property real longest: reach(lines, bold.font)
    // How wide it is if no line of it wraps: its mark, its name, what it says, and the steps between them.
    readonly property real natural: 2 * inset + 1.25 * size + longest + widest(lines.map(line => line.message), plain, plain.font) + 22 * Theme.unit + 2
    // How many lines of text stand below each other.
    readonly property int deep: {
        const needs = lines.map((line, at) => {
            const room = Math.max(1, table.column - 1.25 * size - namedIn(at) - 20 * Theme.unit)
            const whole = widest([line.message], plain, plain.font)
            return whole <= room ? 1 : Math.ceil(1.1 * whole / room)
        })
        return needs.reduce((sum, _, at) => sum + (at % table.columns === 0 ? Math.max(1, ...needs.slice(at, at + table.columns)) : 0), 0)
    }
    readonly property real packed: deep * Math.ceil(plain.height)
    // How far the names reach of the column that this line stands in.
    function namedIn(at: int): real {
        return Math.min(0.4 * table.column, double ? reach(lines.filter((_, other) => other % 2 === at % 2), bold.font) : longest)
    }
    // What is measured depends on the font, which is named for that reason alone.
    function widest(texts: var, letters: FontMetrics, _font: font): real {
        return Math.ceil(Math.max(0, ...texts.map(text => letters.advanceWidth(text))))
    }
    // As far as the longest name, and a step.
    function reach(named: var, font: font): real {
        return widest(named.map(line => line.name), bold, font) + 14 * Theme.unit
    }
    FontMetrics {
        id: bold
        font { pixelSize: health.size; bold: true }
    }
    FontMetrics {
        id: plain
        font.pixelSize: health.size
    }

    title: words["console-health"]
    visible: lines.length > 0

    Grid {
        id: table
        readonly property real column: Math.floor((parent.width - (columns - 1) * columnSpacing) / columns)
        width: parent.width
        columns: health.double ? 2 : 1
        columnSpacing: health.gutter
        rowSpacing: health.apart
        Repeater {
            model: health.lines
            delegate: PanelLine {
                required property var modelData
                required property int index
                width: table.column
                line: modelData
                words: health.words
                size: health.size
                named: health.namedIn(index)
            }
        }
    }
}
