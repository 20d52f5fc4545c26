// How large everything on the debrief is. What is tried, best first:
//
// 1. Two points stand beside each other on cards (paired).
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
    readonly property bool paired: pairs.size > 0
    readonly property bool signed: paired || page.drawn && fits(Theme.small, Theme.small, 0.5)
    readonly property bool halved: !signed && !page.upright && page.points.length > 1

    // How large the points are, and how large the code is at most: it takes the height that is left.
    readonly property real text: paired ? pairs.body : signed ? Theme.size(trial)
        : (halved ? [36, 34, 32, 30].map(Theme.size).find(fitsInTwo) : undefined) ?? (tight ? Theme.small : Theme.reading)
    readonly property int trial: (page.upright ? [38, 36, 34, 32, 30, 29] : [32, 30, 29])
        .find(text => fits(Theme.size(text), note, apart)) ?? 26
    readonly property real leastCode: (paired ? 235 : page.upright ? 270 : 230) * Theme.unit
    readonly property real mostCode: paired ? pairs.mostCode : 300 * Theme.unit

    // How large the texts on the card are: they are read at home, in a photograph.
    readonly property real heading: paired ? pairs.body : Theme.body
    readonly property real note: paired ? pairs.body : [Theme.body, Theme.reading].find(
        size => fits(Theme.size(32), size, page.upright ? 0.5 : 0.4)) ?? Theme.small
    // The code is named in dark letters on a page of three sizes.
    readonly property real caption: paired ? pairs.body : Theme.reading
    readonly property real letters: paired ? pairs.letters : Theme.size(signed ? 72 : 64)
    // How far points below each other are apart, in gaps.
    readonly property real apart: (page.upright ? [1] : [1.1, 0.9, 0.7])
        .find(apart => fits(Theme.size(32), note, apart, page.upright ? 0 : 52)) ?? (!page.upright && note > Theme.small ? 0.4 : 0.5)
    readonly property real spacing: (signed ? apart : tight ? 0.6 : 1) * Theme.gap + further
    // What is added to that where an upright page has room for it.
    readonly property real further: {
        const free = signed && page.upright ? 0.92 * page.room - height(text, note, apart) : 0
        return Math.max(0, Math.min(Theme.gap, free / Math.max(1, page.points.length)))
    }
    // How far what stands on the card is from its edges.
    readonly property real pad: paired ? pairs.pad : 0.75 * Theme.gap

    // Whether points and card have room in these sizes, and so many units more.
    function fits(text: real, note: real, apart: real, more = 0): bool {
        return height(text, note, apart) + more * Theme.unit <= (page.upright ? 0.93 : Theme.unit < 0.9 ? 0.96 : 1) * page.room
    }
    // How high both are about then below each other, with the distances between them.
    function height(text: real, note: real, apart: real): real {
        return listHeight(text) + (page.points.length + 1) * apart * Theme.gap
            + page.cardHeight(leastCode, 0.75 * Theme.gap, Theme.body, note, Theme.size(72))
    }
    // Whether both fit where the points stand in two columns without drawings.
    function fitsInTwo(text: real): bool {
        const width = 0.96 * (page.column / 2 - Theme.gap)
        const high = points => points.reduce((sum, point) => sum + page.pointLines(point.text, text, width) * 1.08 * page.lineHeight(text), 0)
            + Math.max(0, points.length - 1) * (tight ? 0.6 : 1) * Theme.gap
        return Math.max(high(page.points.slice(0, page.half)), high(page.points.slice(page.half))) + Theme.gap
            + page.cardHeight(leastCode, 0.75 * Theme.gap, Theme.body, note, Theme.size(64)) <= 0.97 * page.room
    }
    // How high the points are below each other.
    function listHeight(text: real): real {
        // Small letters are set on whole pixels, which makes them wider.
        const width = (page.column - 2.5 * text - Theme.gap) * (Theme.unit < 0.9 ? 0.95 : 0.98)
        const pointHeight = point => page.pointHeight(page.pointLines(point.text, text, width), text)
        return page.points.reduce((sum, point) => sum + Math.max(2.5 * text, pointHeight(point)), 0)
    }
}
