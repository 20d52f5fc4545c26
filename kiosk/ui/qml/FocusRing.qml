// The keyboard's place: a ring outside of a control, which no colour of the control can hide.
import QtQuick
import QtQuick.Templates as T
import "."

Rectangle {
    property T.Control around: null
    property real reach: 9 * Theme.unit

    anchors.fill: parent
    anchors.margins: -reach
    visible: around !== null && (around.visualFocus
                                 || around.activeFocus && around.focusReason === Qt.OtherFocusReason && Theme.byKeyboard)
    radius: height / 2
    color: "transparent"
    border.color: Theme.ink
    border.width: 4 * Theme.unit
}
