// A point that stands beside another as a card, or alone in its row: then it is plain, and in one line where that has room.
// Several plain ones are one paragraph.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Rectangle {
    id: card

    // There is none for a moment, while a page with fewer comes.
    required property var points
    readonly property var point: points[0] ?? ({text: "", sign: ""})
    required property PageFrame frame
    required property DebriefShape page
    required property PointPairs pairs
    // Which row it stands in.
    required property int row
    required property bool plain
    // A card that the visitor knows, and what cards look like.
    required property url picture
    required property url cardBack
    required property url cardShadow
    // How high what the row says is, and what this one says.
    required property real tall
    readonly property real said: runsOn ? line.height : flows ? flow.height
        : plain ? words.height
        : pairs.above ? pairs.side + 0.5 * Theme.gap + words.height : Math.max(pairs.side, words.height)

    // A plain one that does not lead is a paragraph, if it is no line.
    readonly property bool flows: plain && row > 0 && !pairs.split && !pairs.runOn(pairs.size, pairs.ticketed)
    readonly property real size: !plain ? pairs.size : signed ? pairs.noteSize : flows ? pairs.body : pairs.plainSize(point.text, row, pairs.size)
    // Two plain ones beside each other have a small drawing each on a wide page.
    readonly property bool signed: plain && row > 0 && pairs.split
    readonly property bool runsOn: plain && !flows && !signed && pairs.runsOn(point.text, size)
    readonly property real inset: plain ? 0 : Theme.gap

    height: plain ? tall : tall + 2 * inset
    radius: Theme.radius
    color: plain ? "transparent" : Theme.white
    border { color: Theme.edge; width: plain ? 0 : 3 * Theme.unit }
    Loader {
        active: !card.plain
        x: card.pairs.above ? (card.width - width) / 2 : Theme.across(card.inset, width, card.width)
        y: card.pairs.above ? card.inset : (card.height - height) / 2
        width: card.pairs.above ? card.width - 2 * card.inset : card.pairs.side
        height: card.pairs.side
        sourceComponent: PointDrawing {
            side: card.pairs.side
            fanned: card.pairs.above
            sign: card.point.sign
            ofCards: card.pairs.ofCards
            picture: card.picture
            back: card.cardBack
            shadow: card.cardShadow
        }
    }
    SignedLine {
        id: words
        readonly property real indent: card.plain ? 0 : card.pairs.above ? card.pairs.narrowed(true) : card.pairs.side + Theme.gap
        visible: !card.runsOn && !card.flows
        x: Theme.across(card.inset + indent, width, card.width)
        y: card.inset + (card.plain ? 0 : card.pairs.above ? card.pairs.side + 0.5 * Theme.gap
            : (card.height - 2 * card.inset - card.tall) / 2 + Math.max(0, (card.pairs.side - height) / 2))
        width: card.width - indent - 2 * card.inset - (card.pairs.above ? indent : 0)
        text: card.point.text
        sign: card.signed && card.pairs.badged ? card.point.sign : ""
        badge: card.pairs.noteBadge * size
        lastLine: card.signed ? 0.6 : inMiddle ? 0.75 : 0.4
        leadSize: card.size
        size: card.pairs.bodyOf(card.size)
        leading: card.page.leading
        strong: card.page.isHeading(text)
        // Below its drawing, in the middle as that is.
        inMiddle: !card.plain && card.pairs.above
    }
    Balanced {
        id: flow
        visible: card.flows
        width: parent.width
        text: card.points.map(point => card.frame.sentences(point.text).join(" ")).join(" ")
        font.pixelSize: card.size
        horizontalAlignment: Text.AlignLeft
    }
    // A whole point, which is found by it in the preview, about where it stands.
    component Whole: Item {
        required property string text
        width: card.width
    }
    Repeater {
        model: card.flows ? card.points.length : 0
        Whole {
            required property int index
            text: card.points[index]?.text ?? ""
            y: index * height
            height: flow.height / Math.max(1, card.points.length)
        }
    }
    Whole {
        id: line
        readonly property var parts: card.frame.sentences(text)
        visible: card.runsOn
        text: card.point.text
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
