// How a page lays out one choice, or two plain questions: large, and so that they take the height that there is.
import QtQuick
import ".."

QtObject {
    id: roomy

    required property PageShape page
    required property WordWidths widths

    readonly property bool sole: page.alone
    // Whether questions stand on the page itself: options and fields have edges of their own, and a card would be one more.
    readonly property bool open: sole || page.upright
    readonly property real inner: open ? page.column : page.inner
    // How large the questions are: as large as leaves each in as few lines as small letters do, and clearly smaller than the
    // title. One that is alone may have two lines on an upright page, and so may one beside the field of its number.
    readonly property real asking: (sole ? [54, 52, 50, 48, 46, 44] : page.upright ? [54, 52, 50, 48, 46, 44, 42, 40, 38] : [44, 42, 40, 38]).map(Theme.size)
        .find(size => page.items.every(item => linesAt(item, size) <= fewest(item))) ?? Theme.size(38)
    function fewest(item: var): int {
        return Math.max(sole && page.upright || beside(item) ? 2 : 1, linesAt(item, Theme.size(38)))
    }
    function linesAt(item: var, size: real): int {
        return widths.lines(item.text, size, beside(item) ? inner - fieldWidth : inner)
    }
    // How far below the line of pages they begin where they have no card.
    readonly property real begin: !open ? 0 : (page.upright ? 28 : 14) * Theme.unit
    function sunk(tall: real): real {
        return !open ? 0 : Math.max(begin, Math.min((sole ? 72 : 96) * Theme.unit, (page.free - tall) / 3))
    }
    // How large options are, how high and how far apart; how far the content of a card is from its edges and a question from
    // its options; and in how many columns options stand. Null where all of that has no room.
    readonly property var found: page.brief ? search() : null

    // Options of two questions on an upright page stand below each other where they can be high, and else, if their words are
    // short, as large tiles in two columns. Otherwise options stand below each other where a page has the height for that, or
    // else in as many columns as leave no hole in the last row, or else in columns that may leave one.
    readonly property bool tiled: page.upright && !sole
    readonly property var ways: [...(tiled ? ["high", "tiles"] : []), ...(sole || page.upright ? ["list"] : []), "even", "two", "three"]
    readonly property var steps: [...(tiled ? [[148, 22, 48, 38], [136, 22, 44, 34], [126, 22, 40, 32], [116, 22, 40, 30]] : []), [112, 28, 40, 26], [104, 24, 36, 24], [100, 22, 32, 22], [96, 20, 30, 20], [92, 20, 26, 18], [88, 18, 24, 16], [84, 16, 20, 14], [78, 14, 18, 12], [72, 14, 16, 10]]
    function search(): var {
        // Answers are no larger than their question.
        const large = (page.upright ? [50, 48, 46, 44, 42, 40, 38, 36] : sole ? [48, 46, 44, 42, 40, 38, 36] : [40, 38, 36]).filter(size => Theme.size(size) <= asking)
        for (const sizes of [large, [34, 32, 30]])
            for (const way of ways)
                for (const [height, gutter, margin, spacing] of steps)
                    for (const letters of sizes) {
                        const tried = {way, size: Theme.size(letters), height: height * Theme.unit, gutter: gutter * Theme.unit,
                            margin: margin * Theme.unit, spacing: (spacing + (sole ? 8 : 0)) * Theme.unit}
                        const spare = height < 84 && way === "list" || (height < 104 || height > 136) && way === "high" || way === "tiles" && !tiles(tried) ? -1 : room - taken(tried)
                        if (spare >= 0)
                            return widened(tried, spare)
                    }
        return null
    }
    // Small letters are set on whole pixels, which makes them higher.
    readonly property real room: page.free - begin - (Theme.unit < 0.9 ? 22 : 6) * Theme.unit

    // The same with what the page has left: options become a little higher, and the margins of cards wider.
    function widened(layout: var, spare: real): var {
        const cards = page.seen().length
        const rows = page.seen().reduce((sum, item) => sum + (item.kind !== "integer" ? rowsOf(item, layout) : inline(item) && !open ? 0 : 1), 0)
        const higher = Math.floor(Math.min((sole && rows < 4 ? 36 : layout.way === "tiles" ? 36 : layout.way === "high" ? 10 : page.upright ? 26 : 14) * Theme.unit, (layout.way === "tiles" ? 0.4 : 0.55) * spare / Math.max(1, rows)))
        const left = spare - rows * higher
        if (sole) {
            // Columns keep their width, by which they were chosen.
            const further = layout.way !== "list" ? 0 : Math.floor(Math.min((page.upright ? 10 : 4) * Theme.unit, 0.6 * left / Math.max(1, rows)))
            return Object.assign(layout, {height: layout.height + higher, gutter: layout.gutter + further})
        }
        // Without cards, what is left parts the questions.
        if (open)
            return Object.assign(layout, {height: layout.height + higher, apart: apart(layout) + Math.floor(Math.min(112 * Theme.unit, 0.4 * left))})
        const wider = Math.floor(Math.min(16 * Theme.unit, left / Math.max(1, 4 * cards)))
        return Object.assign(layout, {height: layout.height + higher, margin: layout.margin + wider, spacing: layout.spacing + Math.floor(wider / 2)})
    }
    // How high the page is then. Words that something is missing are part of it.
    function taken(layout: var): real {
        const seen = page.seen()
        return seen.reduce((sum, item) => {
            const said = linesAt(item, asking) * widths.leading * asking
            const missed = page.form.missing.includes(item.id) ? widths.leading * Theme.small + layout.spacing : 0
            const answers = item.kind === "integer" ? layout.height : rowsOf(item, layout) * (highest(item, layout) + layout.gutter) - layout.gutter
            const asked = said + missed + (item.kind !== "integer" || rangeFits(item) ? 0 : widths.leading * Theme.size(open ? 36 : 32))
            const inside = inline(item) ? Math.max(answers, asked) : asked + layout.spacing + answers
            return sum + inside + (open ? 0 : 2 * layout.margin)
        }, (seen.length - 1) * apart(layout))
    }
    // How far questions are from each other, at least.
    function apart(layout: var): real {
        return layout.apart ?? (open && !sole ? 64 * Theme.unit : layout.gutter + 6 * Theme.unit)
    }
    // How much width the field of a number takes beside its question, with what is between them. On an upright page it is as
    // wide as a tile, and in the same column.
    readonly property real columnWidth: Math.floor((inner - between) / 2)
    readonly property real between: 22 * Theme.unit
    readonly property real fieldWidth: page.upright ? columnWidth + between : 500 * Theme.unit
    // Whether a number stands beside its question, or below it in a field as wide as the page, as a long one does on an
    // upright page. And whether what it may be stands in the question's line.
    function beside(item: var): bool {
        return page.upright && item.kind === "integer" && item.widest.length <= 3
            && widths.lines(item.text, Theme.size(38), inner - fieldWidth) <= 2
    }
    function below(item: var): bool {
        return page.upright && item.kind === "integer" && !beside(item)
    }
    function inline(item: var): bool {
        return beside(item) || item.kind === "integer" && !page.upright && widths.bold(item.text, asking) + fieldWidth + Theme.gap <= inner
    }
    function rangeFits(item: var): bool {
        return widths.bold(item.text, asking) + widths.slack * widths.plain(item.range, Theme.size(open ? 36 : 32)) + 2.25 * Theme.gap <= inner - (below(item) ? 0 : fieldWidth)
    }

    // How large the ring before an option's words is, and all that is beside the words. Tiles have less width for that.
    readonly property bool tight: found !== null && found.way === "tiles"
    readonly property real ring: (tight ? 42 : 46) * Theme.unit
    readonly property real beforeRing: (tight ? 20 : 28) * Theme.unit
    readonly property real afterRing: (tight ? 14 : 20) * Theme.unit
    readonly property real afterWords: (tight ? 12 : 24) * Theme.unit
    function around(layout: var): real {
        return (layout.way === "tiles" ? 90 : 120) * Theme.unit
    }

    function columnsOf(item: var, layout: var): int {
        const all = item.options.length
        const fits = (columns, most) => columns <= all && item.options.every(option => linesOf(option, columns, layout) <= most)
        switch (layout.way) {
        case "tiles":
            return 2
        case "high":
        case "list":
            return 1
        case "even":
            return [3, 2].find(columns => all % columns === 0 && fits(columns, 1)) ?? 1
        case "two":
            return fits(2, 2) ? 2 : 1
        default:
            return fits(3, 2) ? 3 : fits(2, 2) ? 2 : 1
        }
    }
    // Whether all have room in two columns with one line each, and none is alone in its row.
    function tiles(layout: var): bool {
        return page.items.every(item => item.kind === "integer" || item.options.length % 2 === 0 && mostLines(item, layout) === 1)
            && layout.size >= Theme.size(38) && layout.height >= 126 * Theme.unit
    }
    function rowsOf(item: var, layout: var): int {
        return item.kind === "integer" ? 0 : Math.ceil(item.options.length / columnsOf(item, layout))
    }
    // A little less than there is: a row that is wider by the last digit of a sum would lose its last option.
    function tileWidth(columns: int, layout: var): real {
        return Math.floor((inner - (columns - 1) * layout.gutter) / columns - 0.01)
    }
    // How many lines an option has there; many if a word of it has no room beside others.
    function linesOf(option: var, columns: int, layout: var): int {
        const wide = tileWidth(columns, layout) - around(layout)
        return widths.slack * widths.plain(option.text, layout.size) <= wide ? 1
            : columns > 1 && option.text.split(" ").some(word => widths.plain(word, layout.size) > 0.98 * wide) ? 9
            : widths.plainLines(option.text, layout.size, wide)
    }
    function mostLines(item: var, layout: var): int {
        const columns = columnsOf(item, layout)
        return Math.max(...item.options.map(option => linesOf(option, columns, layout)))
    }
    // How high each option of a question is: as high as the one with the most lines.
    function highest(item: var, layout: var): real {
        const lines = mostLines(item, layout)
        return Math.ceil(lines > 1 ? Math.max(layout.height, textHeight(lines, layout.size)) : layout.height)
    }
    function textHeight(lines: int, size: real): real {
        return lines * Math.ceil(widths.leading * size) + 16 * Theme.unit
    }
    // How wide the options of a question are, row by row, and how many lines each row has.
    function rows(item: var): var {
        const columns = columnsOf(item, found), wide = tileWidth(columns, found), lines = mostLines(item, found)
        return Array.from({length: rowsOf(item, found)}, (_, row) => ({lines,
            widths: item.options.slice(row * columns, (row + 1) * columns).map(() => wide)}))
    }
}
