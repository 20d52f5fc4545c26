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
    readonly property var none: ({ name: words["console-alarms"], message: words["console-alarms-none"], is_ok: true, is_used: true, is_due: false })
    readonly property var lines: panel.alarms.length > 0 ? panel.health.lines : [...panel.health.lines, none]

    // The first copy is to be made: its line comes first, and a press on it makes one.
    readonly property var due: lines[0]?.is_due ? lines[0] : null

    // What its words stand in by, within the frame of the button.
    readonly property real indent: due ? Math.round(10 * Theme.unit) : 0
    // The rows of an upright page are equally far apart, if it has room: the frame of the button reaches into the gaps.
    readonly property bool even: double && due !== null && panel.health.matters.length < 3

    // What a wide screen has left is shared among the lines.
    readonly property real room: double ? 0 : least - Math.max(1.4 * size, crown) - 2 * size
    // The others have a heading of their own where there is room for it: not if the words of a line take two rows.
    readonly property bool parted: due !== null && room > 2.2 * size * (lines.length + 1.4) && widest(lines.map(line => line.message), letters.font) + named + 4.2 * size < table.column
    readonly property real each: Math.max(0, Math.min(76 * Theme.unit, room / (lines.length + (parted ? 1.4 : 0.3))))
    readonly property real named: Math.min(0.4 * table.column, widest(lines.map(line => line.name), letters.font) + 14 * Theme.unit)
    // What is measured depends on the font, which is named for that reason alone.
    function widest(names: var, _font: font): real {
        return Math.ceil(Math.max(0, ...names.map(name => letters.advanceWidth(name))))
    }
    FontMetrics {
        id: letters
        font { pixelSize: health.size; bold: true }
    }

    title: panel.health.title
    visible: lines.length > 0

    Grid {
        id: table
        readonly property real column: Math.floor((parent.width - (columns - 1) * columnSpacing) / columns)
        width: parent.width
        columns: health.double ? 2 : 1
        columnSpacing: health.gutter
        topPadding: health.even ? 12 * Theme.unit : 0
        rowSpacing: health.each > 0 ? 0 : (health.even ? 22 : health.due || health.panel.health.matters.length > 2 ? 8 : 14) * Theme.unit + health.spread
        verticalItemAlignment: health.due ? Grid.AlignVCenter : Grid.AlignTop
        // Apart from the others, which are made anew at each change: the keyboard would be lost with it.
        Item {
            visible: health.due !== null
            width: table.column
            height: health.even ? first.height : Math.max(health.each, copy.height)
            PanelButton {
                id: copy
                objectName: "health-backup"
                anchors.centerIn: parent
                width: parent.width
                // By whole pixels on both sides, so that its words are level with those beside it.
                least: first.height + 2 * Math.ceil(Math.max(0.3 * health.size, 34 * Theme.unit - first.height / 2))
                enabled: health.panel.choices.backup === ""
                // The line in it says so too.
                words: ""
                Accessible.name: health.words["console-backup"]
                onClicked: health.panel.wish("backup", "")
            }
            PanelLine {
                id: first
                x: Theme.across(health.indent, width, parent.width)
                anchors.verticalCenter: parent.verticalCenter
                width: parent.width - health.indent - (sign.visible ? sign.side + health.indent + 0.4 * health.size : 4 * Theme.unit)
                line: health.due ?? health.none
                words: health.words
                size: health.size
                // The words after it begin where those of the other lines do.
                named: health.named - health.indent
            }
            // The drawing of the action, where there is room for it.
            Drawing {
                id: sign
                readonly property real side: 1.45 * health.size
                visible: !health.double && Theme.textSize <= 1.15
                x: Theme.across(parent.width - health.indent - (side + width) / 2, width, parent.width)
                anchors.verticalCenter: parent.verticalCenter
                scale: side / 24
                path: "M8.5 8 H20 V21 H8.5 Z M5 16 H4 V3 H15.5 V4.5"
                ink: copy.front
            }
        }
        Item {
            visible: health.parted
            width: table.column
            height: 57 * Theme.unit
            PlainText {
                anchors.bottom: parent.bottom
                width: parent.width
                text: health.words["console-rest-well"] ?? ""
                font { pixelSize: health.size * 1.12; bold: true }
                color: Theme.ink
            }
        }
        Repeater {
            model: health.due ? health.lines.slice(1) : health.lines
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
