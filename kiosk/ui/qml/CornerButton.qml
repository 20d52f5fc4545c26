// A round button of the corner: a drawing, and a word for those who do not see it.
import QtQuick
import QtQuick.Controls.Basic
import "."

AbstractButton {
    id: button

    required property string words
    // The lines of the drawing, on a square of 24.
    required property string drawing

    width: 68 * Theme.unit
    height: width
    focusPolicy: Qt.StrongFocus
    scale: down ? 0.92 : 1
    Accessible.name: words
    onDoubleClicked: {}
    onClicked: Theme.clicked()
    Keys.onReturnPressed: event => { if (!event.isAutoRepeat) clicked() }
    Keys.onEnterPressed: event => { if (!event.isAutoRepeat) clicked() }

    contentItem: Item {
        Drawing {
            anchors.centerIn: parent
            scale: button.width / 43
            path: button.drawing
            ink: Theme.sea
        }
    }
    background: Rectangle {
        radius: height / 2
        color: Theme.white
        border { color: button.hovered ? Theme.sea : Theme.edge; width: (button.hovered ? 3 : 2) * Theme.unit }
        FocusRing {
            around: button
            reach: 6 * Theme.unit
        }
    }
}
