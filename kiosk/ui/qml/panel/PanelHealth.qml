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
    // Whether it has all of a wide page: all stand in one row then, or the checks below the numbers.
    property bool abreast: false
    readonly property int together: day.shown.length + lines.length
    readonly property bool tiled: abreast && day.shown.length > 0 && together < 7
    readonly property int columns: Theme.textSize > 1.15 || lines.length < 2 ? 1 : !abreast ? 2 : lines.length > 4 ? 3 : lines.length
    readonly property int rows: Math.ceil(lines.length / columns)
    readonly property real gutter: Math.round(1.6 * Theme.gap)
    readonly property real room: width - 2 * inset
    readonly property real beside: Math.round(1.1 * Theme.gap)
    // A line parts the numbers from the checks, which share what those leave.
    readonly property real figures: figuresOf(factSize)
    readonly property real tile: tileOf(factSize)
    function figuresOf(size: real): real {
        return Math.ceil(1.02 * Math.max(...day.shown.map(each => Math.max(wordWidths.plain(each.title, size), 1.6 * wordWidths.bold(each.value, size)))))
    }
    function tileOf(size: real): real {
        return Math.floor((room - (together + 1) * beside - day.shown.length * figuresOf(size)) / Math.max(1, lines.length))
    }
    // A row of them is as large as goes, up to what is to be done, as long as each has one line.
    readonly property real factSize: facts(size)
    function facts(size: real): real {
        const fits = letters => lines.every(each => 1.02 * Math.max(wordWidths.plain(each.name, letters), wordWidths.plain(each.message, letters)) + 1.6 * letters <= tileOf(letters))
        return [1.12, 1.06].map(each => Math.floor(each * size)).find(fits) ?? size
    }

    // How high it may be: what it has left is shared among its rows, as long as they still stand together.
    property real most: 0
    readonly property real spare: Math.max(0, Math.min(limit, (most - bare(size)) / (tiled ? 2 : rows + (allWell ? 1.5 : 1))))
    readonly property real limit: 2 * Theme.gap
    readonly property real step: 10 * Theme.unit
    function column(width: real): real {
        return Math.floor((width - 2 * inset - (columns - 1) * gutter) / columns)
    }
    // How wide the names of its column are: what they leave is for the words behind.
    function naming(size: real, place: int): real {
        return Math.min(0.55 * column(width), 1.02 * Math.max(0, ...lines.filter((_, at) => at % columns === place % columns).map(line => wordWidths.bold(line.name, day.share * size))) + 0.3 * size)
    }
    // How high each row is where nothing is left.
    function row(at: int, size: real): real {
        const each = lines.slice(at * columns, (at + 1) * columns).map((line, place) => wordWidths.plainLines(line.message, day.share * size, column(width) - 1.25 * day.share * size - naming(size, place) - 2 * step))
        return Math.max(1, ...each) * Math.ceil(1.4 * day.share * size)
    }
    function bare(size: real): real {
        if (tiled) {
            const own = facts(size), number = figuresOf(own), check = tileOf(own) - 1.6 * own
            const told = [...day.shown.map(each => 1 + (each.line === "" ? 0 : wordWidths.plainLines(each.line, own, number))), ...lines.map(each => wordWidths.plainLines(each.message, own, check))]
            return Math.ceil(edges + (1.7 + Math.max(...told)) * Math.ceil(1.37 * own))
        }
        const numbers = day.deep(size, room)
        let sum = (allWell ? Math.ceil(1.4 * 1.2 * size) + step : 0) + (rows - 1) * step
        for (let at = 0; at < rows; at++)
            sum += row(at, size)
        return Math.ceil(edges + (numbers > 0 ? numbers + 2 * parting + 2 * Theme.unit + sum : sum))
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
    least: Theme.upright ? Math.min(most, wish + 4 * Theme.gap) : most
    centred: true
    apart: 0

    Row {
        visible: health.tiled
        topPadding: health.spare
        spacing: health.beside
        Repeater {
            model: health.tiled ? day.shown : []
            delegate: PanelFact {
                required property var modelData
                objectName: "today-" + modelData.name
                width: health.figures
                size: health.factSize
                words: health.words
                title: modelData.title
                value: modelData.value
                line: modelData.line
            }
        }
        Item {
            visible: health.lines.length > 0
            width: health.beside
            height: Math.round(2.5 * 1.37 * health.factSize)
            Rectangle {
                x: (parent.width - width) / 2
                width: 2 * Theme.unit
                height: parent.height
                color: Theme.edge
            }
        }
        Repeater {
            model: health.tiled ? health.lines : []
            delegate: PanelFact {
                required property var modelData
                width: health.tile
                size: health.factSize
                words: health.words
                title: modelData.name
                value: modelData.message
                check: modelData
            }
        }
    }
    Column {
        visible: !health.tiled
        PanelDay {
            id: day
            width: health.room
            columns: health.abreast ? health.columns : 0
            panel: health.panel
            size: health.size
        }
        Item {
            visible: day.shown.length > 0
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
                    required property int index
                    line: modelData
                    words: health.words
                    width: health.column(health.width)
                    size: day.share * health.size
                    named: health.naming(health.size, index)
                }
            }
        }
    }
}
