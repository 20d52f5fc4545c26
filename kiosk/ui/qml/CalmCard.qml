// A calm word over everything: a title, a line, and perhaps one button.
import QtQuick
import "."

FocusScope {
    id: calm

    required property string title
    required property string line
    property string button: ""
    signal confirmed()

    // Whatever lies below cannot be reached, and steps back.
    Rectangle {
        anchors.fill: parent
        color: Theme.paper
        opacity: 0.85
        MouseArea { anchors.fill: parent; hoverEnabled: true; preventStealing: true; Accessible.ignored: true }
    }

    Rectangle {
        anchors.centerIn: parent
        width: Math.min(parent.width - 4 * Theme.gap, 900 * Theme.unit)
        height: content.height + 5 * Theme.gap
        radius: Theme.radius
        color: Theme.white
        border { color: Theme.sea; width: 4 * Theme.unit }
        Column {
            id: content
            anchors.centerIn: parent
            width: parent.width - 4 * Theme.gap
            spacing: 1.5 * Theme.gap
            PlainText {
                width: parent.width
                text: calm.title
                font { pixelSize: Theme.heading; bold: true }
                color: Theme.ink
                Accessible.role: Accessible.AlertMessage
                Accessible.name: text
                horizontalAlignment: Text.AlignHCenter
                wrapMode: Text.Wrap
            }
            PlainText {
                width: parent.width
                text: calm.line
                font.pixelSize: Theme.body
                color: Theme.faintInk
                horizontalAlignment: Text.AlignHCenter
                wrapMode: Text.Wrap
            }
            BigButton {
                objectName: "still-here"
                most: content.width
                anchors.horizontalCenter: parent.horizontalCenter
                visible: calm.button !== ""
                words: calm.button
                focus: true
                onClicked: calm.confirmed()
            }
        }
    }
}
