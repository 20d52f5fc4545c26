// One field of a table; numbers stand to the right.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PlainText {
    required property string words
    property bool heading: false
    property string column: ""      // its heading, for those who hear one field after another
    property bool number: false
    property bool strong: false
    property real size: Theme.dense
    property real headSize: size

    text: words
    font { pixelSize: heading ? headSize : size; bold: strong }
    color: heading ? Theme.faintInk : Theme.ink
    horizontalAlignment: number ? Text.AlignRight : Text.AlignLeft
    wrapMode: Text.Wrap
    Accessible.role: heading ? Accessible.ColumnHeader : Accessible.StaticText
    Accessible.name: column === "" ? words : `${column}: ${words || "0"}`
}
