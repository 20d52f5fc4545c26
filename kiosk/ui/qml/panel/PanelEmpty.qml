// Says that a list is empty.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PlainText {
    required property string words

    text: words
    font.pixelSize: Theme.dense
    color: Theme.faintInk
}
