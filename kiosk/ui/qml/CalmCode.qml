// What a visitor carries away from a calm card: a ticket with a code, and below it what the code is for.
import QtQuick
import "."

Rectangle {
    id: frame

    required property string code
    required property string title
    // What it is for.
    required property string line
    required property bool large
    required property bool roomy
    // Whether the face is beside the card, which then has a larger title that the code may come close to.
    required property bool aside
    readonly property real inset: (large ? 36 : 28) * Theme.unit
    readonly property real room: width - 2 * inset
    readonly property real between: 0.3 * inset
    // How far capitals are from the frame, above and below: a line is higher than they are.
    readonly property real high: capital(first) + below.descent

    function capital(letters: FontMetrics): real {
        return letters.ascent - 0.72 * letters.font.pixelSize
    }

    height: Math.ceil(asked.height + code.height + between + told.height + 2 * inset - high)
    radius: Theme.radius
    // Quieter than the question and its answers.
    color: Theme.paper
    border { color: Theme.edge; width: 3 * Theme.unit }
    FontMetrics {
        id: first
        font: asked.font
    }
    FontMetrics {
        id: below
        font: told.font
    }
    Column {
        x: frame.inset
        y: frame.inset - frame.capital(first)
        width: frame.room
        PlainText {
            id: asked
            width: parent.width
            text: frame.title
            font { pixelSize: Theme.size(frame.roomy ? 42 : frame.large ? 36 : 30); bold: true }
            color: Theme.ink
            wrapMode: Text.Wrap
            horizontalAlignment: Text.AlignHCenter
        }
        PlainText {
            id: code
            objectName: "noted"
            width: parent.width
            text: frame.code
            font {
                pixelSize: Theme.size(frame.roomy ? 88 : frame.aside ? 78 : 58)
                bold: true
                letterSpacing: 3 * Theme.unit
            }
            fontSizeMode: Text.HorizontalFit
            minimumPixelSize: Theme.body
            color: Theme.sea
            horizontalAlignment: Text.AlignHCenter
        }
        Item {
            width: parent.width
            height: frame.between
        }
        Balanced {
            id: told
            objectName: "noted-line"
            width: parent.width
            text: frame.line
            font.pixelSize: Theme.size(frame.roomy ? 38 : frame.large ? 32 : 28)
            color: Theme.ink
            horizontalAlignment: Text.AlignHCenter
        }
    }
}
