// The alarms: those that hold carry a mark, then those that have passed.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

PanelSection {
    id: alarms

    required property PanelScreen panel

    title: panel.words["console-alarms"]

    Repeater {
        model: alarms.panel.alarms
        delegate: Row {
            id: row
            required property var modelData
            width: parent.width
            spacing: 10 * Theme.unit
            PanelMark { id: mark; well: !row.modelData.holds; size: alarms.size }
            PlainText {
                id: when
                text: row.modelData.when
                font.pixelSize: alarms.size
                color: Theme.faintInk
            }
            PlainText {
                objectName: "alarm-words"
                width: row.width - mark.width - when.width - 2 * row.spacing
                text: row.modelData.words
                font { pixelSize: alarms.size; bold: row.modelData.holds }
                color: row.modelData.holds ? Theme.ink : Theme.faintInk
                wrapMode: Text.Wrap
            }
        }
    }
}
