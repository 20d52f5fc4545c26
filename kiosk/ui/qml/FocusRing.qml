// The keyboard's place: a ring outside of a control, which no colour of the control can hide. It is there for as long as
// a person works by keyboard, on a screen that has only just come too.
import QtQuick
import QtQuick.Templates as T
import "."

Rectangle {
    id: ring

    property T.Control around: null
    property real reach: 9 * Theme.unit

    anchors.fill: parent
    anchors.margins: -reach
    visible: around !== null && around.activeFocus && Theme.byKeyboard
    radius: height / 2
    color: "transparent"
    border.color: Theme.ink
    border.width: 4 * Theme.unit

    Connections {
        target: ring.around
        function onVisualFocusChanged() {
            if (ring.around.visualFocus)
                Theme.byKeyboard = true
        }
    }
}
