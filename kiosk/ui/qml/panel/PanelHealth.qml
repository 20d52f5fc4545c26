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

    // What a wide screen has left is shared among the lines.
    readonly property real each: double ? 0 : Math.max(0, Math.min(76 * Theme.unit, (least - Math.max(1.4 * size, crown) - 2 * size) / (lines.length + 0.3)))
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
        rowSpacing: health.each > 0 ? 0 : (health.due || health.panel.health.matters.length > 2 ? 8 : 14) * Theme.unit + health.spread
        verticalItemAlignment: health.due ? Grid.AlignVCenter : Grid.AlignTop
        // Apart from the others, which are made anew at each change: the keyboard would be lost with it.
        Item {
            visible: health.due !== null
            width: table.column
            height: Math.max(health.each, copy.height)
            PanelButton {
                id: copy
                objectName: "health-backup"
                anchors.centerIn: parent
                width: parent.width + 24 * Theme.unit
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
                anchors.verticalCenter: parent.verticalCenter
                width: parent.width - (sign.visible ? sign.side + 0.4 * health.size : 0)
                line: health.due ?? health.none
                words: health.words
                size: health.size
                named: health.named
            }
            // The drawing of the action, where there is room for it.
            Drawing {
                id: sign
                readonly property real side: 1.45 * health.size
                visible: !health.double && Theme.textSize <= 1.15
                x: Theme.across(parent.width - (side + width) / 2, width, parent.width)
                anchors.verticalCenter: parent.verticalCenter
                scale: side / 24
                path: "M8.5 8 H20 V21 H8.5 Z M5 16 H4 V3 H15.5 V4.5"
                ink: copy.front
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
