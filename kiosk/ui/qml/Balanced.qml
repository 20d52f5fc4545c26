// A text of which no paragraph ends with a single word on a line: its lines are made a little shorter than their place
// until they are even.
import QtQuick
import "."

PlainText {
    id: balanced

    // How long the last line is to be at least, as a share of the longest.
    property real least: horizontalAlignment === Text.AlignHCenter ? 0.75 : 0.4
    // Qt does not always tell that the alignment in effect changes when a page becomes mirrored.
    readonly property bool fromLeft: LayoutMirroring.enabled ? horizontalAlignment === Text.AlignRight : effectiveHorizontalAlignment !== Text.AlignRight
    readonly property real slack: width > 0 && wrapMode !== Text.NoWrap ? spare(text, width, letters.font) : 0

    wrapMode: Text.Wrap
    leftPadding: effectiveHorizontalAlignment === Text.AlignHCenter ? slack / 2 : fromLeft ? 0 : slack
    rightPadding: effectiveHorizontalAlignment === Text.AlignHCenter ? slack / 2 : fromLeft ? slack : 0

    FontMetrics {
        id: letters
        font: balanced.font
    }

    // How much narrower the lines can be without one more, so that the last is long enough, or as long as it gets. What
    // is measured depends on the font, which is named for that reason alone.
    function spare(text: string, room: real, _font: font): real {
        const paragraphs = text.split("\n")
        const count = text.split(" ").length
        if (count < 3 || count > 60 || paragraphs.every(each => letters.advanceWidth(each) <= room))
            return 0
        const gap = letters.advanceWidth(" ")
        const parts = paragraphs.map(each => each.split(" ").map(word => letters.advanceWidth(word)))
        const widest = Math.max(...parts.map(sizes => Math.max(...sizes)))
        let most = 0, best = 0, narrow = room
        for (let tried = room; tried >= widest;) {
            let lines = 0, shortest = Infinity, longest = 0
            for (const sizes of parts) {
                const before = lines
                let last = 0
                for (const size of sizes) {
                    if (last > 0 && last + gap + size > tried) {
                        longest = Math.max(longest, last)
                        lines++
                        last = size
                    } else
                        last += (last > 0 ? gap : 0) + size
                }
                longest = Math.max(longest, last)
                // A paragraph of one line ends where it ends.
                if (lines++ > before)
                    shortest = Math.min(shortest, last)
            }
            most = most || lines
            if (lines > most)
                break
            if (shortest / longest > best) {
                best = shortest / longest
                narrow = tried === room ? room : longest
            }
            if (best >= least)
                break
            tried = longest - 0.5
        }
        // Letters are set by fractions of pixels, which the sum of the words lacks.
        return narrow === room ? 0 : Math.max(0, room - narrow - 2)
    }
}
