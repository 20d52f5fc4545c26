// What a visitor carries away from a calm card: a code, framed as the card of the debriefing is, below what to do with it.
import QtQuick
import "."

Rectangle {
    id: frame

    required property string code
    required property string title
    required property bool large
    required property bool roomy
    readonly property real inset: (roomy ? 1 : 0.6) * Theme.gap

    height: content.height + 2 * inset
    radius: Theme.radius
    color: Theme.white
    border { color: Theme.amber; width: 4 * Theme.unit }
    Column {
        id: content
        anchors.centerIn: parent
        width: parent.width - 3 * Theme.gap
        PlainText {
            width: parent.width
            text: frame.title
            font.pixelSize: Theme.size(frame.roomy ? 44 : frame.large ? 36 : 32)
            wrapMode: Text.Wrap
            horizontalAlignment: Text.AlignHCenter
        }
        PlainText {
            objectName: "noted"
            width: parent.width
            text: frame.code
            font {
                pixelSize: frame.roomy ? Theme.size(100) : frame.large ? Theme.size(84) : Theme.figure
                bold: true
                letterSpacing: 4 * Theme.unit
            }
            fontSizeMode: Text.HorizontalFit
            minimumPixelSize: Theme.body
            color: Theme.sea
            horizontalAlignment: Text.AlignHCenter
        }
    }
}
