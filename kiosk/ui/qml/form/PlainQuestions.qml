// How a page lays out its plain questions: how large options are and how many of them stand in a row, and where the field
// of a number stands.
import QtQuick
import ".."

QtObject {
    id: questions

    required property PageShape page
    required property WordWidths widths
    // How one choice or two questions are laid out, where they have room to be large; null elsewhere.
    readonly property RoomyQuestions larger: RoomyQuestions {
        page: questions.page
        widths: questions.widths
    }
    readonly property var roomy: larger.found

    // How large the questions of a wide page are whose options all have the room for large letters.
    readonly property real asking: roomy !== null ? larger.asking : Theme.size(36)
    // How large and how high such options are, how far they are apart, and whether they fill their rows; null if they have
    // no room.
    readonly property var columns: !page.calm || page.upright || page.alone || roomy !== null ? null : columned()
    // How large options are. Those of an upright page are as large as leaves them as many lines as the usual size does.
    readonly property real optionSize: roomy?.size ?? columns?.size ?? (page.alone ? Theme.body : !page.airy ? Theme.reading
        : (page.easy ? [38, 36].map(Theme.size).find(size => optionLines(size) === optionLines(Theme.size(34))) : null) ?? Theme.size(34))
    readonly property var heights: [84, 82, 80, 78, 77, 76, 75, 74, 72, 70, 68].map(height => height * Theme.unit)
    // How much height can be filled. Small letters are set on whole pixels, which makes them higher.
    readonly property real sure: page.free - (Theme.unit < 0.9 ? 22 : 6) * Theme.unit
    // How high options are at least, and how far they are apart.
    readonly property real optionHeight: roomy !== null ? roomy.height : columns !== null ? lowered().height
        : (page.tight || (page.largeText && !page.large) || page.items.length > 3 ? 62 : page.airy ? 84 : 76) * Theme.unit
    readonly property real gutter: roomy !== null ? roomy.gutter : (columns !== null ? lowered().gutter : page.easy ? (Theme.textSize > 1 ? 20 : 24) : page.airy ? 18 : page.large ? 14 : page.tight || page.largeText ? 8 : 12) * Theme.unit
    // How far options in columns are apart at most and at least. Cards are a little further from each other.
    readonly property real widest: 20
    readonly property real closest: 14
    readonly property real cardGap: gutter + 8 * Theme.unit
    // How large the ring before an option's words is, and what there is before it, between both, and at the end.
    readonly property real ring: roomy !== null ? larger.ring : (page.easy ? 44 : 34) * Theme.unit
    readonly property real beforeRing: roomy !== null ? larger.beforeRing : (page.largeText && !page.large ? 14 : 20) * Theme.unit
    readonly property real afterRing: roomy !== null ? larger.afterRing : (page.largeText && !page.large ? 10 : 14) * Theme.unit
    readonly property real afterWords: roomy !== null ? larger.afterWords : (page.easy || page.alone ? 20 : 10) * Theme.unit
    readonly property real around: ring + beforeRing + afterRing + afterWords + 2 * Theme.unit
    // Whether questions have no cards, and how wide the field beside one is then with its buttons.
    readonly property bool open: roomy !== null && larger.open
    readonly property real columnWidth: open ? larger.columnWidth : 0
    // How much width options have.
    readonly property real optionsWidth: roomy !== null ? larger.inner : page.alone ? page.column : page.inner
    // In how many columns options stand at most. Those of several questions stand in the same two, where there is height for that.
    readonly property int most: !page.tight && page.items.length <= 3 && page.items.filter(item => item.options !== undefined).length > 1 ? 2 : 6
    // Whether the page lacks the height for as many rows as that takes.
    readonly property bool lean: columns?.filled ?? (page.items.length > 3
        || !page.upright && !page.alone && (page.tight || page.largeText || page.calm) && !(equalHeight() <= page.free))
    // How high the field of a number is, and how much width it takes beside its question, with its buttons.
    readonly property real fieldHeight: roomy !== null ? roomy.height : page.easy ? 112 * Theme.unit : 1.37 * Theme.body + 32 * Theme.unit
    readonly property real fieldWidth: roomy !== null ? larger.fieldWidth : (page.easy ? 492 : 470) * Theme.unit

    // Whether the field of a number stands beside its question: only a calm wide page's and an upright one's cards are
    // broad enough for both.
    function inline(item: var): bool {
        return roomy !== null ? larger.inline(item) : (page.upright || page.calm) && !page.alone && !page.largeText && item.kind === "integer" && !item.exempts
            && widths.bold(item.text, Theme.size(page.easy ? 37 : 38)) + fieldWidth <= page.inner
    }
    // Whether it stands below its question, in a field as wide as the card.
    function below(item: var): bool {
        return roomy !== null && larger.below(item)
    }
    // Whether what the number may be stands in the question's line.
    function ranged(item: var): bool {
        return item.kind === "integer" && (roomy !== null ? larger.rangeFits(item) : columns !== null && rangeFits(item))
    }
    // The largest letters with which all questions fit: in columns, or else in rows that are filled. With them, the largest
    // distances that leave options as high as they are easily hit, or else the highest options.
    function columned(): var {
        if (!page.items.every(item => item.kind === "integer" || item.kind === "single"))
            return null
        for (const filled of [false, true])
            for (const size of [34, 33, 32, 31, 30, 29].map(Theme.size)) {
                for (const gutter of [widest, 18, 16, closest]) {
                    const high = gutter === closest ? heights : heights.filter(height => height >= 70 * Theme.unit)
                    const height = high.find(height => pageHeight(size, height, gutter, filled) <= sure)
                    if (height !== undefined)
                        return {size, height, gutter, filled}
                }
            }
        return null
    }
    // The height that options have then, and their distance. Words that something is missing take some of both, where that
    // leaves all in sight.
    function lowered(): var {
        const missing = page.items.filter(item => page.form.missing.includes(item.id))
        const words = missing.reduce((sum, item) => sum + (item.kind === "integer" ? 0.25 : 1) * (widths.leading * Theme.small + 12 * Theme.unit), 0)
        for (const gutter of [columns.gutter, closest]) {
            const height = heights.find(height => height <= columns.height && pageHeight(columns.size, height, gutter, columns.filled) + words <= sure)
            if (height !== undefined)
                return {height, gutter}
        }
        return columns
    }
    // How high the page is with options in this size, so high and so far apart. Below the last card no distance is needed.
    function pageHeight(size: real, height: real, gutter: real, filled: bool): real {
        const gap = gutter * Theme.unit, further = (gutter - closest) * Theme.unit
        return page.seen().reduce((sum, item) => {
            if (item.kind === "integer")
                return sum + (rangeFits(item) ? 130 : 138) * Theme.unit + further
            const lines = Math.ceil(widths.bold(item.text, asking) / page.inner)
            const rows = filled ? filledRows(item, size, gap).map(() => 1) : rowLines(item, size, columnsOf(item, size))
            return sum + lines * widths.leading * asking + 50 * Theme.unit
                + rows.reduce((all, lines) => all + Math.max(height, lines > 1 ? textHeight(lines, size) : 0) + gap, 0)
        }, -22 * Theme.unit - further)
    }
    // How high a wide page is without large options if those of each question are as wide as each other; NaN with other
    // kinds of items.
    function equalHeight(): real {
        return page.seen().reduce((sum, item) => {
            const rows = item.kind === "integer" ? [0] : item.kind === "single" ? rowLines(item, optionSize, columnsOf(item, optionSize)) : [NaN]
            return sum + page.gap + 42 * Theme.unit + widths.lines(item.text, Theme.body, page.inner) * widths.leading * Theme.body
                + rows.reduce((all, lines) => all + gutter + (lines === 0 ? fieldHeight : lines > 1 ? textHeight(lines, optionSize) : lines * optionHeight), -gutter)
        }, 0)
    }
    // Whether the question of a number and what the number may be have room in one line, before its field.
    function rangeFits(item: var): bool {
        return widths.bold(item.text, asking) + widths.slack * widths.plain(item.range, Theme.size(32)) + 1.5 * Theme.gap
            <= page.inner - fieldWidth
    }
    // In how many columns the options of a question stand, all as wide: in as many as leave each in one line, but in two
    // rather than one if each has two lines there. The rows are as full as each other.
    function columnsOf(item: var, size: real): int {
        const all = item.options.length
        if (page.alone && all <= 6)
            return 1
        const few = [6, 5, 4, 3, 2].find(columns => columns <= Math.min(all, most) && columns === Math.ceil(all / Math.ceil(all / columns))
            && item.options.every((option, at) => optionWidth(option, size) <= wordsRoom(columns, spanOf(item, at, columns, size))))
        if (few !== undefined)
            return few
        const rows = rowLines(item, size, 2), usual = 62 * Theme.unit
        return Math.max(...rows) <= 2 && rows.reduce((sum, lines) => sum + Math.max(usual, textHeight(lines, size)), 0) < all * usual ? 2 : 1
    }
    // How many of the columns an option takes: one, so that all have one size. The last one takes what its row has left if
    // its words need that.
    function spanOf(item: var, at: int, columns: int, size: real): int {
        return at === item.options.length - 1 && optionWidth(item.options[at], size) > wordsRoom(columns, 1) ? columns - at % columns : 1
    }
    // How wide an option is that takes so many of the columns: a row that is wider by the last digit of a sum would lose its
    // last option.
    function tileWidth(columns: int, span: int, gutter: real): real {
        return span * Math.floor((optionsWidth - (columns - 1) * gutter) / columns - 0.01) + (span - 1) * gutter
    }
    // How much width words have in it.
    function wordsRoom(columns: int, span: int): real {
        return Math.floor(tileWidth(columns, span, page.upright ? gutter : widest * Theme.unit)) - around
    }
    // How many lines an option has there; many if a word of it has no room.
    function optionLinesOf(option: var, size: real, room: real): int {
        const words = option.text.split(" ")
        return optionWidth(option, size) <= room ? 1
            : words.some(word => widths.plain(word, size) > 0.98 * room) ? 9 : widths.plainLines(option.text, size, room)
    }
    // How many lines each row of options has.
    function rowLines(item: var, size: real, columns: int): var {
        const rows = []
        item.options.forEach((option, at) => {
            const row = Math.floor(at / columns)
            rows[row] = Math.max(rows[row] ?? 1, columns === 1 ? 1 : optionLinesOf(option, size, wordsRoom(columns, spanOf(item, at, columns, size))))
        })
        return rows
    }
    // How wide the options of a question are, row by row, and how many lines each row has.
    function rows(item: var): var {
        if (roomy !== null)
            return larger.rows(item)
        const size = optionSize, columns = columnsOf(item, size), equal = rowLines(item, size, columns)
        if (lean) {
            const filled = filledRows(item, size, gutter)
            if (filled.length < equal.reduce((all, lines) => all + lines, 0))
                return filled.map(widths => ({widths, lines: 1}))
        }
        const wide = item.options.map((_, at) => tileWidth(columns, spanOf(item, at, columns, size), gutter))
        return equal.map((lines, row) => ({lines, widths: wide.slice(row * columns, (row + 1) * columns)}))
    }
    // As many options in each row as have room there, as wide as each other if they can be, and else as their words need.
    // Each row ends where the others do.
    function filledRows(item: var, size: real, gutter: real): var {
        const rows = [], width = Math.floor(optionsWidth - 0.01)
        let end = Infinity
        for (const option of item.options) {
            const wish = Math.ceil(optionWidth(option, size)) + around
            if (end + gutter + wish > width) {
                rows.push([])
                end = -gutter
            }
            rows[rows.length - 1].push(Math.min(wish, width))
            end += gutter + wish
        }
        return rows.map(row => {
            const part = (width - (row.length - 1) * gutter) / row.length, even = row.every(wish => wish <= part)
            const spare = (width - row.reduce((sum, wish) => sum + wish + gutter, -gutter)) / row.length
            let at = 0
            return row.map(wish => {
                const from = at
                at += even ? part : wish + spare
                return Math.floor(at) - Math.floor(from)
            })
        })
    }
    // How many lines all rows of options of the page have in this size.
    function optionLines(size: real): int {
        return page.items.filter(item => item.options !== undefined)
            .reduce((sum, item) => sum + rowLines(item, size, columnsOf(item, size)).reduce((all, lines) => all + lines, 0), 0)
    }
    // How high an option of so many lines is at least.
    function textHeight(lines: int, size: real): real {
        return roomy !== null ? larger.textHeight(lines, size) : lines * Math.ceil(widths.leading * size) + 6 * Theme.unit
    }
    function optionWidth(option: var, size: real): real {
        return widths.slack * widths.plain(option.text, size)
    }
}
