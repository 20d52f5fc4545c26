// How the points stand where a study compares two things: the first leads to the second and the third, which are cards
// beside each other, and those after them are plain lines.
import QtQuick
import ".."

QtObject {
    id: pairs

    required property DebriefShape page

    readonly property var rows: [page.points.slice(0, 1), page.points.slice(1, 3), ...page.points.slice(3).map(point => [point])]
    // How large the letters on the cards are, and the code below them at most: as large as there is room for; 0 where
    // there is none.
    readonly property var found: page.points.length < 3 || !page.drawn ? undefined
        : trials.find(([letters, code]) => fits(Theme.size(letters), code * Theme.unit))
    readonly property real size: found === undefined ? 0 : Theme.size(found[0])
    readonly property real mostCode: found === undefined ? 0 : found[1] * Theme.unit
    readonly property var trials: [40, 38, 36, 35, 34, 33, 32]
        .reduce((trials, letters) => [...trials, [letters, 300], [letters, 270], [letters, 240]], [])
    readonly property real height: stacked(size)
    // What is added to what is between rows, of the room that is left.
    readonly property real further: Math.max(0, Math.min(0.6 * Theme.gap,
        (page.room - needed(size, mostCode)) / 2 / Math.max(1, rows.length)))

    // The texts on the card to take home: its heading, what is said about the code, and the code.
    readonly property real heading: Theme.size(40)
    readonly property real note: Theme.size(32)
    readonly property real letters: Theme.size(page.upright ? 72 : 92)
    readonly property real pad: 0.9 * Theme.gap

    // A drawing is as high as two lines and a little more. Above the words where a card is narrow.
    readonly property real badge: 2.75
    readonly property bool above: page.upright
    // How much is around what a card says.
    readonly property real inset: (above ? 1 : 0.9) * Theme.gap
    readonly property real insetAcross: Theme.gap

    // How far a row is below the one before it: what is plain is close to the cards that it is about.
    function step(at: int): real {
        return at === 0 ? 0 : (at === 1 || at === 2 ? 0.9 : 0.6) * Theme.gap
    }
    // How large a plain point is. The first one, which leads, is larger than the cards, where it has room in one line.
    function plainSize(text: string, at: int, size: real): real {
        return (at === 0 ? [1.2, 1.15, 1.1, 1.05] : []).map(share => share * size).find(tried => runsOn(text, tried)) ?? size
    }
    // Whether heading and text of a plain point have room in one line.
    function runsOn(text: string, size: real): bool {
        const [lead, rest] = [...text.split("\n"), ""], words = page.widths
        return text.split("\n").length < 3 && words.bold(lead, size) + words.plain(rest, size) + 0.45 * size <= 0.995 * page.column
    }
    // Whether points and card have room in these sizes. On a card, no point has more than two lines and two more.
    function fits(size: real, code: real): bool {
        return rows.every((row, at) => lines(row, at, size) <= 4)
            && needed(size, code) <= page.room
    }
    function needed(size: real, code: real): real {
        return 1.02 * stacked(size) + Theme.gap + page.cardHeight(code, pad, heading, note, letters)
    }
    // How many lines the point of a row has that has most of them.
    function lines(row: var, at: int, size: real): int {
        if (row.length === 1) {
            const plain = plainSize(row[0].text, at, size)
            return runsOn(row[0].text, plain) ? 1 : page.pointLines(row[0].text, plain, page.column)
        }
        const width = (page.column - Theme.gap) / 2 - 2 * insetAcross - (above ? 0 : badge * size + Theme.gap)
        // Small letters are set on whole pixels, which makes them wider.
        return Math.max(...row.map(point => page.pointLines(point.text, size, (Theme.unit < 0.9 ? 0.95 : 0.98) * width)))
    }
    // How high all rows are with letters of this size.
    function stacked(size: real): real {
        return size === 0 ? 0 : rows.reduce((sum, row, at) => {
            const text = page.pointHeight(lines(row, at, size), row.length === 1 ? plainSize(row[0].text, at, size) : size)
            return sum + step(at) + (row.length === 1 ? text : 2 * inset
                + (above ? badge * size + 0.5 * Theme.gap + text : Math.max(badge * size, text)))
        }, 0)
    }
}
