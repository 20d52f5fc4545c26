// The alarms: those that hold carry a mark, then those that have passed.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

PanelSection {
    id: alarms

    required property PanelScreen panel

    title: panel.words["console-alarms"]

    // What is not well need not be an alarm: then the line at the top stands over an empty list.
    PanelEmpty {
        words: alarms.panel.words[alarms.panel.health.well ? "console-alarms-none" : "console-alarms-none-but-notice"]
        visible: alarms.panel.alarms.length === 0
    }
    Repeater {
        model: alarms.panel.alarms
        delegate: Row {
            id: row
            required property var modelData
            width: parent.width
            spacing: 10 * Theme.unit
            PanelMark { id: mark; well: !row.modelData.holds }
            PlainText {
                id: when
                text: row.modelData.when
                font.pixelSize: Theme.dense
                color: Theme.faintInk
            }
            PlainText {
                objectName: "alarm-words"
                width: row.width - mark.width - when.width - 2 * row.spacing
                text: row.modelData.words
                font.pixelSize: Theme.dense
                color: row.modelData.holds ? Theme.deepAmber : Theme.faintInk
                wrapMode: Text.Wrap
            }
        }
    }
}
