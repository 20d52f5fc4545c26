// The sessions that were cut off and can go on.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

PanelSection {
    id: resume

    required property PanelScreen panel

    title: panel.words["console-resume"]
    visible: panel.records.resumable.length > 0

    Flow {
        width: parent.width
        spacing: 9 * Theme.unit
        Repeater {
            model: resume.panel.records.resumable
            delegate: PanelButton {
                required property var modelData
                objectName: "resume-" + modelData.number
                enabled: !resume.panel.choices.underWay
                words: modelData.label
                least: 76 * Theme.unit
                font.pixelSize: 0.94 * resume.size
                onClicked: resume.panel.wish("resume", modelData.number)
            }
        }
    }
}
