// Paragraphs to be read, in a calm column.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Column {
    id: paragraphs

    required property list<string> texts
    property real size: Theme.reading

    spacing: 0.7 * Theme.gap
    Repeater {
        model: paragraphs.texts
        PlainText {
            required property string modelData
            width: paragraphs.width
            text: modelData
            font.pixelSize: paragraphs.size
            lineHeight: 1.08
            wrapMode: Text.Wrap
            color: Theme.ink
        }
    }
}
