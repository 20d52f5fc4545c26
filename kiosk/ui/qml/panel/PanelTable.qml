// A part of the panel with a table: its columns stand evenly over the width, and none is narrower than its longest word.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelSection {
    id: table

    // Its `heads`, and its `rows`: the `cells` of each, and whether its mark says `odd` or `running`. In one property, as
    // both change together.
    required property var shown
    readonly property var heads: shown.heads
    readonly property var rows: shown.rows
    property bool marked: false
    // Of the bar before the words of a cell that tells a share.
    readonly property real bar: barred(size)
    // A table with as many columns whose columns begin at the same places.
    property PanelTable like: null
    readonly property bool alike: like !== null && like.visible && like.heads.length === heads.length

    readonly property var titles: shown.heads.map(head => ({ words: head, strong: false }))
    readonly property real step: 0.8 * size
    readonly property real whole: width - 2 * inset
    // A single row is hard to follow over a broad card, unless its words need that.
    readonly property bool single: rows.length === 1 && (!alike || like.rows.length === 1)
    readonly property real room: single ? Math.min(whole, Math.max(1000 * Theme.unit, sum(shared[0]) + (heads.length - 1) * step)) : whole
    readonly property real free: room - (heads.length - 1) * step
    // What each column needs where its cells have one line, two or three, and for its longest word.
    readonly property var own: [1, 2, 3, 99].map(most => needs(most, size))
    readonly property var shared: own.map((widths, at) => alike ? widths.map((each, column) => Math.max(each, like.own[at][column] ?? 0)) : widths)
    // Not where that breaks words of one that would stand in single lines by itself.
    readonly property var all: sum(shared[0]) <= free || sum(own[0]) > free && (!alike || sum(like.own[0]) > free) ? shared : own
    readonly property real squeeze: Math.min(1, free / sum(all[3]))
    // Smaller than the rest only where not even the longest words of all columns fit side by side.
    readonly property real written: Math.max(0.75, squeeze) * size
    readonly property real before: marked ? 1.4 * written : 0
    // Without room for single lines, cells have as few lines as go. Then all columns stand equally far apart.
    readonly property list<real> starts: {
        const most = Math.max(0, all.findIndex((widths, at) => at === 3 || sum(widths) <= free))
        const widths = all[most].slice()
        for (let fewer = 0; fewer < most; fewer++) {
            // What costs least is widened first.
            const order = widths.map((_, at) => at).sort((one, other) => all[fewer][one] - widths[one] - all[fewer][other] + widths[other])
            for (const at of order)
                if (sum(widths) - widths[at] + all[fewer][at] <= free)
                    widths[at] = all[fewer][at]
        }
        const wide = widths.map(width => squeeze * width)
        const gap = (room - sum(wide)) / Math.max(1, heads.length - 1)
        let from = 0
        return wide.map(width => {
            const here = Math.round(from)
            from += width + gap
            return here
        })
    }

    function sum(each: var): real {
        return each.reduce((total, one) => total + one, 0)
    }
    function wide(at: int): real {
        return (at === heads.length - 1 ? room : starts[at + 1] - step) - starts[at]
    }
    function long(text: string, strong: bool): real {
        return (strong ? bold : plain).advanceWidth(text)
    }
    function broken(cell: var, room: real): int {
        let lines = 1, line = ""
        for (const word of cell.words.split(" ")) {
            const longer = line === "" ? word : line + " " + word
            if (line !== "" && long(longer, cell.strong) > room) {
                lines++
                line = word
            } else
                line = longer
        }
        return lines
    }
    // How wide it is at least with so many lines.
    function narrow(cell: var, lines: int): real {
        let most = long(cell.words, cell.strong), least = Math.max(...cell.words.split(" ").map(word => long(word, cell.strong)))
        if (lines === 1 || most === least)
            return most
        if (broken(cell, least) <= lines)
            return least
        while (most - least > 4) {
            const between = (most + least) / 2
            if (broken(cell, between) <= lines)
                most = between
            else
                least = between
        }
        return most
    }
    function barred(size: real): real {
        return 2.8 * size
    }
    // Letters are drawn in whole pixels.
    function needs(lines: int, size: real): var {
        const drawn = Math.round(size)
        return titles.map((title, at) => Math.ceil(2 + 2 * Theme.unit + (marked && at === 0 ? 1.4 * size : 0) + Math.max(
            narrow(title, lines) * drawn / 100,
            ...shown.rows.map(row => (row.cells[at].share === undefined ? 0 : barred(size)) + narrow(row.cells[at], lines) * drawn / 100))))
    }
    // Whether all its cells have one line if they are written so large on a card so wide. Small letters are a little wider
    // than large ones made smaller.
    function holds(size: real, width: real): bool {
        return 1.03 * sum(needs(1, size)) + (heads.length - 1) * 0.8 * size <= width - 2 * inset
    }
    FontMetrics {
        id: bold
        font { pixelSize: 100; bold: true }
    }
    FontMetrics {
        id: plain
        font.pixelSize: 100
    }

    // A place in a row, as wide as its column with the step behind it.
    component Place: Item {
        id: place
        required property int index
        property string words: ""
        property bool heading: false
        property bool strong: false
        property var share: undefined
        readonly property real from: share === undefined ? 0 : table.bar * table.squeeze
        width: (index === table.heads.length - 1 ? table.room : table.starts[index + 1]) - table.starts[index] - (index === 0 ? table.before : 0)
        height: cell.height
        Rectangle {
            visible: place.share !== undefined
            anchors { left: parent.left; verticalCenter: parent.verticalCenter }
            width: 0.82 * place.from
            height: 12 * Theme.unit
            radius: height / 2
            color: Theme.sand
            Rectangle {
                anchors.left: parent.left
                width: parent.width * (place.share ?? 0)
                height: parent.height
                radius: height / 2
                color: Theme.sea
            }
        }
        PanelCell {
            id: cell
            anchors { left: parent.left; leftMargin: place.from }
            width: parent.width - place.from - (place.index === table.heads.length - 1 ? 0 : table.step)
            words: place.words
            heading: place.heading
            column: place.heading ? "" : table.heads[place.index] ?? ""
            strong: place.strong
            size: table.written
        }
    }

    Column {
        visible: table.rows.length > 0
        spacing: 0.4 * table.apart
        Row {
            leftPadding: table.before
            Repeater {
                model: table.heads
                delegate: Place {
                    required property string modelData
                    anchors.bottom: parent?.bottom
                    words: modelData
                    heading: true
                }
            }
        }
        Rectangle {
            width: table.whole
            height: 2 * Theme.unit
            color: Theme.edge
        }
    }
    Repeater {
        model: table.rows
        delegate: Row {
            id: row
            required property var modelData
            PanelMark {
                visible: table.marked
                width: table.before
                well: !row.modelData.odd
                running: row.modelData.running ?? false
                size: table.written
            }
            Repeater {
                model: row.modelData.cells
                delegate: Place {
                    required property var modelData
                    words: modelData.words
                    strong: modelData.strong
                    share: modelData.share
                }
            }
        }
    }
}
