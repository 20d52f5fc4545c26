// What a visitor sees while the kiosk is started again: calm, in every language, with nothing to press.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Window
import "."

Window {
    id: root

    required property var lines
    required property url icon

    color: Theme.paper
    title: "Recollect"
    // Only its process ends it.
    onClosing: close => close.accepted = false

    Binding { target: Theme; property: "unit"; value: Math.min(root.width / 1920, root.height / 1080) }

    Column {
        anchors.centerIn: parent
        spacing: 1.5 * Theme.gap
        Image {
            anchors.horizontalCenter: parent.horizontalCenter
            source: root.icon
            sourceSize { width: 160 * Theme.unit; height: 160 * Theme.unit }
        }
        Repeater {
            model: root.lines
            PlainText {
                required property string modelData
                anchors.horizontalCenter: parent?.horizontalCenter
                width: Math.min(implicitWidth, root.width - 4 * Theme.gap)
                text: modelData
                font.pixelSize: Theme.heading
                horizontalAlignment: Text.AlignHCenter
                wrapMode: Text.Wrap
                color: Theme.ink
            }
        }
    }
}
