// How points stand beside the helper: the first leads to those after it, which stand two by two close below it, as cards in
// the order in which they are read. A last one is plain, as the first.
import QtQuick
import ".."

QtObject {
    id: pairs

    required property DebriefShape page

    readonly property var rows: page.points.reduce((rows, point, at) => {
        if (at % 2 === 1)
            rows.push([])
        rows[rows.length - 1].push(point)
        return rows
    }, [[]])
    // How large the letters are: as large as leaves room for a code that is easy to scan; 0 where there is no room. Where
    // the helper says the last two, a point may have one more line.
    readonly property real size: !page.accompanied || page.upright || page.points.length < 3 || !page.drawn ? 0
        : tried(3) || (page.lastTwoSaid ? tried(4) : 0)
    // The sizes of letters and of the card with the code that are tried.
    readonly property var trials: [
        [36, 400], [35, 400], [34, 400],
        [36, 342], [35, 342], [34, 342],
        [36, 303], [35, 303], [34, 303], [33, 303], [32, 303]
    ]
    // How high all rows are, and how large the code below them is at most.
    readonly property real height: stacked(size)
    readonly property real mostCode: (page.lastTwoSaid ? 410 : 352) * Theme.unit
    // How large a plain point is in one line: larger than the cards' texts, where all of them have the width and the page
    // has the height.
    readonly property real headingSize: {
        const plain = rows.filter(row => row.length === 1).map(row => row[0].text)
        const free = page.room - height - page.codeSide(mostCode) - 2 * page.rim - 2.7 * Theme.gap
        return [42, 41, 40].map(Theme.size).find(tried => plain.every(text => runsOn(text, tried))
            && plain.length * page.lineHeight(tried - size) <= free) ?? size
    }

    // How much is around what a card says.
    readonly property real inset: 0.75 * Theme.gap
    readonly property real insetAcross: Theme.gap
    readonly property real textWidth: (page.column - Theme.gap) / 2 - 2 * insetAcross

    // How far a row is below the one before it: plain points are close to the cards that they are about.
    function step(at: int): real {
        return at === 0 ? 0 : (at === 1 ? 0.75 : rows[at].length === 1 ? 0.6 : 1) * Theme.gap
    }
    // Whether heading and text of a plain point have room in one line.
    function runsOn(text: string, size: real): bool {
        const parts = text.split("\n"), words = page.widths
        return parts.length === 2 && words.bold(parts[0], size) + words.plain(parts[1], size) + 0.45 * size <= 0.995 * page.column
    }
    // The largest letters with which page and card fit, with so many lines in a point at most; 0 if there are none.
    function tried(most: int): real {
        const found = trials.find(([size, card]) => {
            const letters = Theme.size(size)
            return rows.every(row => lines(row, letters) <= most)
                && 1.02 * stacked(letters) + Theme.gap + card * Theme.unit <= page.room
        })
        return found === undefined ? 0 : Theme.size(found[0])
    }
    // How many lines the point of a row has that has most of them.
    function lines(row: var, size: real): int {
        if (row.length === 1)
            return runsOn(row[0].text, size) ? 1 : page.pointLines(row[0].text, size, page.column)
        const width = textWidth - 2.5 * size - Theme.gap
        return Math.max(...row.map(point => page.pointLines(point.text, size, width)))
    }
    // How high all rows are with letters of this size. A card is as high as its drawing at least.
    function stacked(size: real): real {
        return rows.reduce((sum, row, at) => {
            const text = page.pointHeight(lines(row, size), size)
            return sum + step(at) + (row.length === 1 ? text : 2 * inset + Math.max(2.5 * size, text))
        }, 0)
    }
}
