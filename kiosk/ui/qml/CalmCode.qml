// What a visitor carries away from a calm card: a code, framed as the card of the debriefing is, below what to do with it.
import QtQuick
import "."

Rectangle {
    id: frame

    required property string code
    required property string title
    required property bool large
    required property bool roomy
    // How far capitals are from the frame, above and below: a line is higher than they are.
    readonly property real inset: (roomy ? 40 : 32) * Theme.unit

    height: Math.ceil(content.height + 2 * inset - above.ascent + 0.72 * above.font.pixelSize - below.descent)
    radius: Theme.radius
    color: Theme.white
    border { color: Theme.amber; width: 4 * Theme.unit }
    FontMetrics {
        id: above
        font: told.font
    }
    FontMetrics {
        id: below
        font: noted.font
    }
    Column {
        id: content
        anchors.horizontalCenter: parent.horizontalCenter
        y: frame.inset - above.ascent + 0.72 * above.font.pixelSize
        width: parent.width - 3 * Theme.gap
        PlainText {
            id: told
            width: parent.width
            text: frame.title
            font.pixelSize: Theme.size(frame.roomy ? 44 : frame.large ? 36 : 32)
            wrapMode: Text.Wrap
            horizontalAlignment: Text.AlignHCenter
        }
        PlainText {
            id: noted
            objectName: "noted"
            width: parent.width
            text: frame.code
            font {
                pixelSize: frame.roomy ? Theme.size(80) : Theme.size(frame.large && Theme.textSize <= 1.15 ? 68 : 56)
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
