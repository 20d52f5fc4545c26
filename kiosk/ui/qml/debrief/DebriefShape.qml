// What the debrief says and how much room there is for it: everything on the page is laid out by this.
import QtQuick
import ".."

QtObject {
    id: page

    required property WordWidths widths
    // All points; those that the helper leaves to the page, where it says the last one; and those that stand on the page.
    required property var all
    required property var fewer
    required property var points
    // How many of them stand in the first of two columns, so that both are about as long.
    required property int half
    // The card to take home: its heading, what the code is called, what is said about it, and the squares of its picture.
    required property string kept
    required property string codeName
    required property list<string> notes
    required property int squares
    required property bool coded
    required property bool upright
    required property real column
    required property real room
    // How large the way on below all that is.
    required property real wayWidth
    required property real wayHeight

    readonly property bool drawn: all.length > 0 && all[0].sign !== ""
    // Beside a drawing, a heading and its text stand close, so that they are seen as one.
    readonly property real leading: 0.9
    // How far the white around the code reaches beyond its own frame, for round corners.
    readonly property real rim: 6 * Theme.unit
    // How far the texts of the card are from the code: on an upright page, there is the tear of a ticket between them.
    readonly property real besideCode: (upright ? 2.6 : 1.5) * Theme.gap
    // How much air the letters of the code have above them, as a share of their size.
    readonly property real codeAir: 0.18

    // Whether this point is a heading itself: one without a heading, among others that have one.
    function isHeading(text: string): bool {
        return !text.includes("\n") && points.some(point => point.text.includes("\n"))
    }
    // How large the code is in so much room.
    function codeSide(most: real): real {
        return Theme.sharpSide(most, squares)
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
        return texts.filter(text => text !== "").join("\n").split("\n")
            .reduce((sum, part) => sum + Math.ceil(widths.plain(part, size) / width), 0)
    }
    // How wide a strip beside the way on is, and how high with a code of this side, texts of this size, and the code in large
    // letters.
    readonly property real footWidth: column - wayWidth - Theme.gap
    readonly property real footPad: 0.4 * Theme.gap
    function footHeight(side: real, note: real, letters: real): real {
        const width = (Theme.unit < 0.9 ? 0.95 : 0.98) * (footWidth - 2 * footPad - codeSide(side) - 1.5 * Theme.gap - 2 * rim)
        const lines = [codeName, ...notes].filter(text => text !== "").reduce((sum, text) => sum + widths.plainLines(text, note, width), 0)
        const told = lines * lineHeight(note) + 0.2 * Theme.gap * notes.filter(text => text !== "").length
        return Math.max(codeSide(side) + 2 * rim, told + 1.22 * letters) + 2 * footPad
    }
    // How high the card is about, with a code of this side and so much air, texts in these sizes, and the code in large
    // letters. Without a heading, what names the code is as large as what is said about it.
    function cardHeight(side: real, pad: real, heading: real, note: real, letters: real): real {
        const width = 0.95 * (column - (coded ? codeSide(side) + besideCode + 2 * rim : 0) - pad - Theme.gap)
        const headed = heading > 0 || !coded, caption = heading > 0 ? Theme.reading : note
        const told = (headed ? cardLines([kept], 1.08 * Math.max(heading, note), width) * lineHeight(Math.max(heading, note)) : 0)
            + cardLines(notes, note, width) * lineHeight(note) + 0.2 * Theme.gap * (2 + notes.filter(text => text !== "").length)
        const named = cardLines([codeName], caption, width) * lineHeight(caption) + (1.37 - (heading > 0 ? codeAir : 0.15)) * letters
        return Math.max(coded ? codeSide(side) + 2 * rim : 0, told + (coded ? named : 0)) + 2 * pad
    }
}
