// Says that a list is empty.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PlainText {
    required property string words

    width: parent?.width ?? implicitWidth
    text: words
    wrapMode: Text.Wrap
    font.pixelSize: Theme.dense
    color: Theme.faintInk
}
