// That all is well, or a line for each thing that is not.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Rectangle {
    id: notice

    required property var health
    readonly property real size: Theme.dense * (Theme.upright ? 1 : 1.12)

    height: sentence.height + Theme.gap
    radius: Theme.radius
    color: health.well ? Theme.sea : Theme.amber

    // A matter's further lines stand below its words, and not below its mark.
    Column {
        id: sentence
        objectName: "panel-summary"
        anchors { left: parent.left; right: parent.right; margins: 0.8 * Theme.gap; verticalCenter: parent.verticalCenter }
        Repeater {
            model: notice.health.summary.split("\n")
            delegate: Row {
                id: matter
                required property string modelData
                width: sentence.width
                spacing: 10 * Theme.unit
                readonly property color front: notice.health.well ? Theme.white : Theme.ink
                PlainText {
                    visible: notice.health.well
                    text: "✓"
                    width: sign.width
                    font { pixelSize: notice.size; bold: true }
                    color: matter.front
                    Accessible.ignored: true
                }
                PanelMark {
                    id: sign
                    visible: !notice.health.well
                    well: false
                    size: notice.size
                    tone: matter.front
                }
                PlainText {
                    width: matter.width - sign.width - matter.spacing
                    text: matter.modelData
                    font { pixelSize: notice.size; bold: true }
                    color: matter.front
                    wrapMode: Text.Wrap
                }
            }
        }
    }
}
