// One field of a table.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PlainText {
    required property string words
    property bool heading: false
    property string column: ""      // its heading, for those who hear one field after another
    property bool strong: false
    property real size: Theme.dense

    text: words
    font { pixelSize: size; bold: strong }
    color: heading ? Theme.faintInk : Theme.ink
    horizontalAlignment: Text.AlignLeft
    wrapMode: Text.Wrap
    Accessible.role: heading ? Accessible.ColumnHeader : Accessible.StaticText
    Accessible.name: column === "" ? words : `${column}: ${words || "0"}`
}
