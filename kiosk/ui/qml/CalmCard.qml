// A calm word over everything: a title, a line, and perhaps something to choose.
pragma ComponentBehavior: Bound
import QtQuick
import "."

FocusScope {
    id: calm

    required property string title
    property string line: ""
    // What there is to choose: the name of each, its words, and whether it is quiet. The first has the keyboard.
    property var choices: []
    signal chosen(string name)

    onVisibleChanged: if (visible && buttons.count > 0) buttons.itemAt(0).focus = true

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
                visible: text !== ""
                text: calm.line
                font.pixelSize: Theme.body
                color: Theme.faintInk
                horizontalAlignment: Text.AlignHCenter
                wrapMode: Text.Wrap
            }
            Flow {
                id: flow
                readonly property real needed: {
                    let sum = 0
                    for (let i = 0; i < buttons.count; i++)
                        sum += (buttons.itemAt(i) as BigButton)?.width ?? 0
                    return sum + (buttons.count - 1) * spacing
                }
                anchors.horizontalCenter: parent.horizontalCenter
                width: Math.min(content.width, Math.ceil(needed))
                spacing: Theme.gap
                visible: calm.choices.length > 0
                Repeater {
                    id: buttons
                    model: calm.choices
                    BigButton {
                        required property var modelData
                        objectName: modelData.name
                        most: content.width
                        words: modelData.words
                        quiet: modelData.quiet ?? false
                        onClicked: calm.chosen(modelData.name)
                    }
                }
            }
        }
    }
}
