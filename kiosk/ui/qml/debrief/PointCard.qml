// A point that stands beside another as a card, or alone in its row: then it is plain, and in one line where that has room.
import QtQuick
import ".."

Rectangle {
    id: card

    required property var modelData
    required property PageFrame frame
    required property DebriefShape page
    required property PointPairs pairs
    // Which row it stands in.
    required property int row
    required property bool plain
    // How high what the row says is, and what this one says.
    required property real tall
    readonly property real said: runsOn ? line.height : point.height

    readonly property real size: plain ? pairs.plainSize(modelData.text, row, pairs.size) : pairs.size
    readonly property bool runsOn: plain && pairs.runsOn(modelData.text, size)
    readonly property real inset: plain ? 0 : pairs.inset

    height: tall + 2 * inset
    radius: Theme.radius
    color: plain ? "transparent" : Theme.white
    border { color: Theme.edge; width: plain ? 0 : 3 * Theme.unit }
    SignedLine {
        id: point
        visible: !card.runsOn
        x: card.plain ? 0 : card.pairs.insetAcross
        y: card.inset
        width: card.width - 2 * x
        text: card.modelData.text
        sign: card.plain ? "" : card.modelData.sign
        badge: card.pairs.badge * size
        above: card.pairs.above
        size: card.size
        leading: card.page.leading
        strong: card.page.isHeading(text)
    }
    Item {
        id: line
        // The whole point, which is found by it in the preview.
        readonly property string text: card.modelData.text
        readonly property var parts: card.frame.sentences(text)
        visible: card.runsOn
        width: card.width
        height: heading.height
        PlainText {
            id: heading
            x: Theme.across(0, width, parent.width)
            text: line.parts[0]
            font { pixelSize: card.size; bold: true }
        }
        PlainText {
            x: Theme.across(heading.width + 0.3 * card.size, width, parent.width)
            text: line.parts[1] ?? ""
            font.pixelSize: card.size
        }
    }
}
