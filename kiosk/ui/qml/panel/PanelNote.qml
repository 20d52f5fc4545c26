// A note at the screen's edge, for a moment: a few words, or dots of which one is filled.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: edge

    required property NoteScreen note

    objectName: "experimenter-note"
    Accessible.role: Accessible.AlertMessage
    // The dots say nothing of the study, and so neither does their name.
    Accessible.name: note.text || `${note.chosen + 1} / ${note.dots}`
    visible: note.text !== "" || note.dots > 0
    width: content.width + 2 * Theme.gap
    height: content.height + Theme.gap
    radius: Math.min(height / 2, 0.7 * Theme.dense + 0.5 * Theme.gap)
    color: Theme.white
    border { color: Theme.sea; width: 2 * Theme.unit }

    Row {
        id: content
        anchors.centerIn: parent
        spacing: 12 * Theme.unit
        PlainText {
            width: Math.min(implicitWidth, edge.parent.width - 4 * Theme.gap)
            visible: edge.note.text !== ""
            wrapMode: Text.Wrap
            text: edge.note.text
            Accessible.ignored: true
            font.pixelSize: Theme.dense
            color: Theme.ink
        }
        Repeater {
            model: edge.note.dots
            delegate: Rectangle {
                id: dot
                required property int index
                width: 16 * Theme.unit
                height: width
                radius: width / 2
                color: dot.index === edge.note.chosen ? Theme.sea : "transparent"
                border { color: Theme.sea; width: 2 * Theme.unit }
            }
        }
    }
}
