// How large everything on the debrief is. What is tried, best first:
//
// 1. The points stand in pairs beside the helper (paired).
// 2. They stand below each other, each with its drawing (signed).
// 3. They stand without drawings, in two columns where a wide page has more than one (halved).
import QtQuick
import ".."

QtObject {
    id: sizes

    required property DebriefShape page
    required property PointPairs pairs

    // Whether there is little height for what stands on the page.
    readonly property bool tight: page.room < 720 * Theme.unit
    readonly property bool signed: page.drawn && fits(Theme.small, Theme.small, 0.5)
    readonly property bool paired: signed && pairs.size > 0
    readonly property bool halved: !signed && !page.upright && page.points.length > 1
    // Whether the heading of the card stands over all of its width, so that the code has more room.
    readonly property bool crowned: signed && page.upright

    // How large the points are. Where they are signed, each of these sizes is tried with a code of so many units; the code
    // then grows into what is left, up to its most.
    readonly property real text: paired ? pairs.size : signed ? Theme.size(trial[0]) : tight ? Theme.small : Theme.reading
    readonly property var trial: trials.find(([text, code]) => fits(Theme.size(text), note, apart, code)) ?? [26, leastCode]
    readonly property var trials: page.upright
        ? [[38, 400], [36, 400], [34, 400], ...[38, 36, 34, 32, 30, 29].map(text => [text, leastCode])]
        : [32, 30, 29].map(text => [text, leastCode])
    readonly property real leastCode: 290
    readonly property real mostCode: paired ? pairs.mostCode : (crowned && trial[1] > leastCode ? trial[1] : 352) * Theme.unit

    // How large the texts on the card are: they are read at home, in a photograph.
    readonly property real note: [Theme.body, Theme.reading].find(
        size => fits(Theme.size(32), size, page.upright ? 0.5 : 0.4)) ?? Theme.small
    // How far points below each other are apart, in gaps.
    readonly property real apart: (page.upright ? [1] : page.accompanied ? [1.1, 0.9, 0.7] : []).find(
        apart => fits(Theme.size(32), note, apart, leastCode, page.upright ? 0 : 52))
        ?? (!page.upright && note > Theme.small ? 0.4 : 0.5)
    readonly property real spacing: (signed ? apart : tight ? 0.6 : 1) * Theme.gap + further
    // What is added to that where an upright page has room for it.
    readonly property real further: {
        const free = crowned ? 0.92 * page.room - height(text, note, apart, mostCode / Theme.unit) : 0
        return Math.max(0, Math.min(Theme.gap, free / Math.max(1, page.points.length)))
    }
    // How far what stands on the card is from its edges.
    readonly property real pad: (!signed || paired ? 0.75 : page.upright ? 1.5
        : fits(text, note, apart, leastCode, 52) ? 1.2 : note > Theme.small ? 0.5 : 0.75) * Theme.gap

    // Whether points and card have room in these sizes, and so many units more.
    function fits(text: real, note: real, apart: real, code = leastCode, more = 0): bool {
        return height(text, note, apart, code) + more * Theme.unit <= (page.upright ? 0.93 : Theme.unit < 0.9 ? 0.96 : 1) * page.room
    }
    // How high both are about then, with the distances between them.
    function height(text: real, note: real, apart: real, code: real): real {
        const points = pairs.size > 0 ? pairs.height + 2 * apart * Theme.gap
            : listHeight(text) + (page.points.length + 1) * apart * Theme.gap
        return points + (page.upright ? crownedHeight(note, code) : cardHeight(note, code))
    }
    // How high the points are below each other.
    function listHeight(text: real): real {
        // Small letters are set on whole pixels, which makes them wider.
        const width = (page.column - 2.5 * text - Theme.gap) * (Theme.unit < 0.9 ? 0.95 : 0.98)
        const pointHeight = point => page.pointHeight(page.pointLines(point.text, text, width), text)
        return page.points.reduce((sum, point) => sum + Math.max(2.5 * text, pointHeight(point)), 0)
    }
    // How high the card is: as the code, or as the texts beside it.
    function cardHeight(note: real, code: real): real {
        const small = note <= Theme.small, width = 0.95 * (page.column - code * Theme.unit - 2.5 * Theme.gap)
        return Math.max((small ? 266 : 318) * Theme.unit,
            headingHeight(width) + textsHeight(note, width) + (small ? 2.6 : 1.8) * Theme.gap)
    }
    // The same where its heading stands over both.
    function crownedHeight(note: real, code: real): real {
        const width = 0.95 * (page.column - code * Theme.unit - 4 * Theme.gap)
        return headingHeight(page.column - 4 * Theme.gap) + 0.6 * Theme.gap
            + Math.max((code + 92) * Theme.unit, textsHeight(note, width) + 4.1 * Theme.gap)
    }
    function headingHeight(width: real): real {
        return page.cardLines([page.kept], 1.08 * Theme.body, width) * page.lineHeight(Theme.body)
    }
    // How high the code in large letters and the notes on it are. On an upright page its name has a line of its own.
    function textsHeight(note: real, width: real): real {
        const texts = page.upright ? [page.codeName, ...page.notes] : page.notes
        return 1.38 * Theme.size(72) + page.cardLines(texts, note, width) * page.lineHeight(note)
    }
}
