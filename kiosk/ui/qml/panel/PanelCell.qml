// One field of a table; numbers stand to the right.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Text {
    required property string words
    property bool heading: false
    property bool number: false

    text: words
    font.pixelSize: heading ? Theme.dense * 0.82 : Theme.dense
    color: heading ? Theme.faintInk : Theme.ink
    horizontalAlignment: number ? Text.AlignRight : Text.AlignLeft
    elide: Text.ElideRight
}
