// What a visitor carries away from a calm card: a ticket that says what a code is for, and beside or below that the code.
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
    // Whether the code stands beside the words, behind a line of dashes.
    required property bool aside
    readonly property real inset: (roomy ? 36 : aside ? 36 : 28) * Theme.unit
    readonly property real room: width - 2 * (aside ? 1.25 * inset : inset)
    readonly property real coded: aside ? Math.floor(0.42 * room) : room
    readonly property real between: aside ? 1.6 * inset : 0.5 * inset
    // How far capitals are from the frame, above and below: a line is higher than they are.
    readonly property real high: capital(first) + below.descent

    function capital(letters: FontMetrics): real {
        return letters.ascent - 0.72 * letters.font.pixelSize
    }

    height: Math.ceil((aside ? Math.max(told.height, noted.height) : told.height + between + noted.height) + 2 * inset - (aside ? 0 : high))
    radius: Theme.radius
    color: Theme.white
    border { color: Theme.amber; width: 4 * Theme.unit }
    FontMetrics {
        id: first
        font: told.font
    }
    FontMetrics {
        id: below
        font: code.font
    }
    Balanced {
        id: told
        objectName: "noted-line"
        x: Theme.across(frame.aside ? 1.25 * frame.inset : frame.inset, width, frame.width)
        y: frame.aside ? (frame.height - height) / 2 : frame.inset - frame.capital(first)
        width: frame.aside ? frame.room - frame.coded - frame.between : frame.room
        text: frame.line
        font.pixelSize: Theme.size(frame.roomy ? 42 : frame.large ? 34 : 30)
        color: Theme.ink
        horizontalAlignment: frame.aside ? Text.AlignLeft : Text.AlignHCenter
    }
    Rectangle {
        visible: frame.aside
        x: Theme.across(frame.width - 1.25 * frame.inset - frame.coded - frame.between / 2, width, frame.width)
        y: frame.inset
        width: 3 * Theme.unit
        height: frame.height - 2 * frame.inset
        color: Theme.edge
    }
    Column {
        id: noted
        x: Theme.across(frame.width - width - (frame.aside ? 1.25 * frame.inset : frame.inset), width, frame.width)
        y: frame.aside ? (frame.height - height) / 2 : told.y + told.height + frame.between
        width: frame.coded
        PlainText {
            width: parent.width
            text: frame.title
            font.pixelSize: Theme.size(frame.roomy ? 38 : frame.large ? 32 : 28)
            color: Theme.faintInk
            wrapMode: Text.Wrap
            horizontalAlignment: Text.AlignHCenter
        }
        PlainText {
            id: code
            objectName: "noted"
            width: parent.width
            text: frame.code
            font {
                pixelSize: frame.roomy ? Theme.size(76) : Theme.size(frame.aside ? 62 : 52)
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
