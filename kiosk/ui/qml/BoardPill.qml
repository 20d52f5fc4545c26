// A line under the cards: which card comes next, or with three dots what the board waits for.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Rectangle {
    id: pill

    required property string text
    required property real textSize
    // Whether the visitor is to do something, and not to wait.
    required property bool asks
    required property bool upright
    // How much room there is for it.
    required property real most

    objectName: "pill"
    width: line.width + (asks ? 2.6 * Theme.gap : dots.width + 2.8 * Theme.gap)
    height: line.height + (upright ? 20 : 6) * Theme.unit
    radius: height / 2
    color: Theme.sand
    opacity: visible ? 1 : 0
    Behavior on opacity { NumberAnimation { duration: Theme.motion } }

    Row {
        id: dots
        anchors { left: parent.left; leftMargin: Theme.gap; verticalCenter: parent.verticalCenter }
        visible: !pill.asks
        spacing: 6 * Theme.unit
        Repeater {
            model: 3
            Rectangle {
                width: 9 * Theme.unit
                height: width
                radius: width / 2
                color: Theme.ink
            }
        }
    }
    PlainText {
        id: line
        anchors { right: parent.right; rightMargin: (pill.asks ? 1.3 : 1.2) * Theme.gap; verticalCenter: parent.verticalCenter }
        width: Math.min(implicitWidth, pill.most - dots.width - 5 * Theme.gap)
        wrapMode: width < implicitWidth ? Text.Wrap : Text.NoWrap
        text: pill.text
        // What to do is bold everywhere.
        font { pixelSize: pill.textSize; bold: pill.asks }
        color: Theme.ink
        Accessible.role: pill.asks ? Accessible.StaticText : Accessible.AlertMessage
        Accessible.name: text
    }
}
