// A text that is as wide as it needs to be and no wider than its place; then it goes on in another line.
import QtQuick
import "."

PlainText {
    required property real room

    width: Math.min(implicitWidth, room)
    wrapMode: Text.Wrap
    horizontalAlignment: Text.AlignHCenter
}
