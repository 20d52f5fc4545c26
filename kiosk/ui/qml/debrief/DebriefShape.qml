// What the debrief says and how much room there is for it: everything on the page is laid out by this.
import QtQuick
import ".."

QtObject {
    id: page

    required property WordWidths widths
    // The points that are read on the page. The helper says the others: the last one, or the last two.
    required property var points
    required property bool lastTwoSaid
    // The card to take home: its heading, what the code is called, what is said about it, and the squares of its picture.
    required property string kept
    required property string codeName
    required property list<string> notes
    required property int squares
    required property bool upright
    // Whether the helper stands beside the page.
    required property bool accompanied
    required property real column
    required property real room

    readonly property bool drawn: points.length > 0 && points[0].sign !== ""
    // Beside a drawing, a heading and its text stand close, so that they are seen as one.
    readonly property real leading: 0.9
    // How far the white around the code reaches beyond its own frame, for round corners.
    readonly property real rim: 6 * Theme.unit

    // Whether this point is a heading itself: one without a heading, among others that have one.
    function isHeading(text: string): bool {
        return !text.includes("\n") && points.some(point => point.text.includes("\n"))
    }
    // How large the code is in so much room: whole pixels for each square, so that their edges are sharp.
    function codeSide(most: real): real {
        return Math.max(2, Math.floor(most / Math.max(1, squares))) * squares
    }
    // How high a line of letters of this size is; those of points stand closer.
    function lineHeight(size: real): real {
        return Math.ceil(widths.leading * size)
    }
    function pointHeight(lines: int, size: real): real {
        return lines * (leading + 0.06) * lineHeight(size)
    }
    // How many lines a point has in so much width. Its heading is bold. Lines that break at words are not full.
    function pointLines(text: string, size: real, width: real): int {
        return text.split("\n").reduce((sum, part, at) => {
            const share = (at === 0 ? widths.bold(part, size) : widths.plain(part, size)) / width
            return sum + Math.ceil(share > 1 ? 1.06 * share : share)
        }, 0)
    }
    // The same for what stands on the card.
    function cardLines(texts: list<string>, size: real, width: real): int {
        return texts.join("\n").split("\n").reduce((sum, part) => sum + Math.ceil(widths.plain(part, size) / width), 0)
    }
}
