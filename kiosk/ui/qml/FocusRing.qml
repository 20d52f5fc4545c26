// The keyboard's place: a ring outside of a round control, which no colour of the control can hide.
import QtQuick
import "."

Rectangle {
    anchors.fill: parent
    anchors.margins: -9 * Theme.unit
    radius: height / 2
    color: "transparent"
    border.color: Theme.ink
    border.width: 4 * Theme.unit
}
