// What a visitor carries away from a calm card: a code, and what to do with it. In one line where both fit, or below each other.
import QtQuick
import "."

Rectangle {
    id: frame
    objectName: "ticket"

    required property string code
    required property string note
    required property bool large
    required property bool roomy
    // Whether the card is wide.
    required property bool aside
    readonly property real inset: (large ? 30 : 20) * Theme.unit
    readonly property real between: 1.6 * Theme.gap
    readonly property real room: width - 2 * inset
    // A wide code has smaller letters there.
    readonly property bool inLine: aside && named.advanceWidth + between <= 0.56 * room
    readonly property real forCode: inLine ? Math.floor(room - note.width - between) : room

    height: Math.ceil(both.height + 2 * inset)
    radius: Theme.radius
    // Quieter than the question and its answers.
    color: Theme.paper
    border { color: Theme.edge; width: 3 * Theme.unit }
    TextMetrics {
        id: named
        font: note.font
        text: frame.note
    }
    TextMetrics {
        id: coded
        font: noted.font
        text: frame.code
    }
    Grid {
        id: both
        anchors.centerIn: parent
        columns: frame.inLine ? 2 : 1
        columnSpacing: frame.between
        horizontalItemAlignment: Grid.AlignHCenter
        verticalItemAlignment: Grid.AlignVCenter
        LayoutMirroring.enabled: Theme.mirrored
        PlainText {
            id: note
            width: Math.min(Math.ceil(named.advanceWidth) + 2, frame.room)
            text: frame.note
            font { pixelSize: Theme.size(frame.roomy ? 42 : frame.large ? 40 : 30); bold: true }
            color: Theme.ink
            wrapMode: Text.Wrap
            horizontalAlignment: Text.AlignHCenter
        }
        PlainText {
            id: noted
            objectName: "noted"
            width: Math.min(Math.ceil(coded.advanceWidth) + 4, frame.forCode)
            text: frame.code
            font {
                pixelSize: Theme.size(frame.roomy ? 80 : frame.aside ? 68 : frame.large ? 58 : 48)
                bold: true
                letterSpacing: 3 * Theme.unit
            }
            fontSizeMode: Text.HorizontalFit
            minimumPixelSize: Theme.body
            color: Theme.sea
            horizontalAlignment: Text.AlignHCenter
        }
    }
}
