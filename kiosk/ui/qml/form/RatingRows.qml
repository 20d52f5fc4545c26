// How a wide page lays out its ratings as rows, each scale beside its question. What is tried, best first:
//
// 1. All have the same scale: the words for its ends stand once, in a band above the first row, as the head of a table.
// 2. These words stand at both sides of each scale (flanked).
// 3. They stand below it (own).
// 4. They stand above the first scale of several that have the same, among others.
//
// Where not even a table fits, and on other pages, scales stand below their questions, and there are no rows.
import QtQuick
import ".."

QtObject {
    id: rows

    required property PageShape page
    required property WordWidths widths
    // What may be said beside a question that is missed.
    required property list<string> notes
    // What the button says with which a question does not apply.
    required property string exemption

    readonly property bool possible: !page.upright && !page.alone && !page.largeText
    // How much of the page's height the rows of a table leave. Hidden ones count: what depends on it stays where it is.
    readonly property real left: sheet === null ? 0 : (stack !== null ? page.free - 12 * Theme.unit : page.cleared) - sheet.head - foot - joint - page.items.length * (sheet.height + 2 * sheet.margin) - sheet.rest
    // How the rows of such a table look, all measures of them; null if they are none.
    readonly property var table: !possible || !alike() ? null : tabled()
    // How ratings by numbers look on an upright page; null if they do not fit so. They stand on a sheet as well, each scale
    // below its statement. Where not all have the same words for the ends, each has its own below it.
    readonly property var stack: page.upright && page.items.length > 1 && page.items.every(item => ["likert", "differential"].includes(item.kind)) ? stacked() : null
    // How high the band below the last part of a sheet is, which names the ends again: those of the first are far from it.
    readonly property real foot: page.seen().length >= long ? sheet?.foot ?? 0 : 0
    readonly property int long: 3
    // What the parts of either look like, which have no distance between them.
    readonly property var sheet: table ?? stack
    // How wide the line between them is.
    readonly property real joint: Math.round(3 * Theme.unit)
    // The same of flanked rows.
    readonly property var flank: !possible || table !== null || page.dense || !page.rates ? null
        : page.items.some(many) ? flanked(true) ?? flanked(false) : flanked(false)
    // How large questions are; 0 if there are no rows.
    readonly property real text: !possible ? 0 : measured?.text ?? tableText(2) ?? tableText(3) ?? 0
    // Whether every row has the words for its own ends: the eye need not look for them.
    readonly property bool own: flank !== null || table === null && text > 0 && page.rates && !page.dense && ownFit()
    readonly property var measured: table ?? flank
    // How much of a row is its question's and its scale's.
    readonly property real textWidth: measured?.textWidth ?? 0.42 * page.inner
    readonly property real scaleWidth: measured?.scaleWidth ?? 0.54 * page.inner
    // How much of the scale's width is after its points, for that button.
    readonly property real beyond: sheet?.beyond ?? 0
    // How high the second line of a question is, as a share of the first.
    readonly property real closeness: table !== null && !page.dense ? 0.92 : 1
    // How high the content of a row is, and how much of the row is above and below that.
    readonly property real height: measured?.height ?? 98 * Theme.unit + widths.leading * Theme.size(28)
    readonly property real margin: table !== null ? table.margin : flank !== null ? flank.margin - partings * parting / 2 / Math.max(1, page.seen().length) : 18 * Theme.unit
    // How much further from the row before it a row is where only one of them has many points below its question: they
    // are seen as two kinds. The margins of all rows give it, as far as they are large enough.
    readonly property int partings: page.items.filter((_, at) => parts(at)).length
    readonly property real parting: flank === null || partings === 0 ? 0
        : Math.max(0, Math.min(36 * Theme.unit, 2 * (flank.margin - 18 * Theme.unit) * page.seen().length / partings))

    // The sizes of points, of the words for their ends and of questions that a table is tried in, and in how many lines
    // these may stand.
    readonly property var tableTrials: [
        [104, 34, 42, 2], [104, 34, 40, 2], [100, 34, 38, 2], [96, 32, 36, 2], [96, 32, 34, 2], [92, 30, 32, 2], [84, 28, 32, 2], [76, 28, 32, 2], [72, 28, 29, 2], [72, 28, 29, 3]
    ]
    // The same of the sheet of an upright page.
    readonly property var stackTrials: [
        [112, 34, 42, 2], [112, 34, 40, 2], [112, 34, 38, 2], [112, 32, 36, 2], [112, 30, 34, 2],
        [100, 30, 36, 2], [100, 30, 34, 3], [100, 28, 32, 3], [84, 28, 32, 3], [72, 26, 29, 3], [64, 24, 29, 3]
    ]
    // The sizes of points, of the words for their ends and of questions that flanked rows are tried in, and in how many
    // lines these may stand.
    readonly property var trials: [
        [100, 32, 36, 2], [100, 32, 34, 2], [100, 32, 32, 2], [100, 32, 32, 3],
        [92, 30, 36, 2], [92, 30, 32, 2], [92, 30, 32, 3],
        [84, 28, 36, 2], [84, 28, 32, 2], [84, 28, 29, 2], [84, 28, 29, 3]
    ]

    // How large a question is that has a note below it that it is missed: rows of a table have the same height with it.
    function noted(item: var): real {
        if (table === null || page.dense)
            return text
        const lines = widths.lines(item.shown, text, textWidth)
        return Math.min(text, (height + 2 * margin - 10 * Theme.unit - widths.leading * Theme.small) / widths.leading / (1 + closeness * (lines - 1)))
    }
    // Where points begin in their part of an upright page's sheet: a statement of so many lines and they are in the middle of it.
    function pointsAt(lines: int): real {
        return stack.top - Math.round(Math.max(0, stack.lines - lines) * 0.92 * widths.leading * stack.text / 2)
    }
    // Whether this scale stands beside its question.
    function beside(item: var): bool {
        return own || table !== null || text > 0 && page.scales(item)
    }
    // Whether it stands below it, in its card's width, although the others are flanked.
    function crowned(item: var): bool {
        return flank !== null && flank.crowns && many(item)
    }
    // Whether the words for the ends of this item's scale are not those of the item before it.
    function heads(at: int): bool {
        const one = page.before(at), other = page.items[at] ?? null
        return one === null || other === null || !beside(one)
            || ["points", "left", "right"].some(key => one[key] !== other[key])
    }
    // How much further than usual this item is from the one before it.
    function parted(at: int): real {
        return parts(at) ? parting : 0
    }

    // Whether one of this item and that before it is crowned, and the other is not.
    function parts(at: int): bool {
        const one = page.before(at), other = page.items[at] ?? null
        return one !== null && other !== null && !page.form.hidden.includes(other.id) && crowned(one) !== crowned(other)
    }
    function many(item: var): bool {
        return page.scales(item) && item.points > 7
    }
    // Whether all items of the page are rated on the same few points with the same words for their ends.
    function alike(): bool {
        return page.items.length > 1 && same() && page.items[0].points <= 7
    }
    function same(): bool {
        const one = page.items[0]
        return page.items.every(item => item.kind === "likert" && ["points", "left", "right"].every(key => item[key] === one[key]))
    }
    // How a table looks in the first sizes in which it fits; null if it fits in none. A question has the width that the
    // points leave. What all pages ask that are laid out like this one counts.
    function tabled(): var {
        const one = page.items[0], rows = page.rows()
        for (const [pointUnits, endUnits, textUnits, most] of tableTrials) {
            const point = pointUnits * Theme.unit, end = Theme.size(endUnits), text = Theme.size(textUnits)
            const left = 1.03 * widths.plain(one.left, end), right = 1.03 * widths.plain(one.right, end)
            // Both words stand at the ends of the points, in one line unless they are long.
            const pointsWidth = Math.ceil(Math.max(1.25 * one.points * point, Math.min(left + right + Theme.gap, 0.42 * page.inner)))
            const scaleWidth = pointsWidth + exempting
            const textWidth = page.inner - scaleWidth - 2 * Theme.gap
            const lines = Math.max(0, ...page.wordings.map(asked => widths.lines(asked, text, textWidth)))
            // Even pixels: what is in the middle of a row is at the same place in all of them.
            const height = 2 * Math.ceil(Math.max(point, widths.leading * text * (page.dense ? lines : 1 + 0.92 * Math.max(1, lines - 1))) / 2)
            const head = headHeight(end, pointsWidth, page.dense ? 4 : 14)
            const margin = Math.floor(Math.min(54 * Theme.unit, ((page.cleared - head - joint) / rows - height) / 2))
            const [more, rest] = shared(rows, height / 2 + margin)
            if (lines <= most && textWidth > 0.3 * page.inner && margin >= (page.dense ? 8 : 14) * Theme.unit)
                return {point, end, beyond: exempting, scaleWidth, textWidth, text, height, margin: margin + more, head, rest}
        }
        return null
    }
    // How the sheet of an upright page looks in the first sizes in which it fits; null if it fits in none. All parts are as
    // high as that of the longest statement. A sheet that is long has a band at its foot as well, where that has room.
    function stacked(): var {
        const rows = Math.max(1, page.form.fullest, page.items.length), own = !same(), room = page.free - 12 * Theme.unit - joint
        for (const [pointUnits, endUnits, textUnits, most] of stackTrials) {
            const point = pointUnits * Theme.unit, end = Theme.size(endUnits), text = Theme.size(textUnits), spacing = 24 * Theme.unit
            const span = page.inner - exempting
            const head = own ? 0 : headHeight(end, span, 16)
            const lines = Math.max(0, ...page.wordings.map(asked => widths.lines(asked, text, page.inner)))
            // Where the points begin, and how much stands below that.
            const top = Math.ceil(widths.leading * text * (1 + 0.92 * (lines - 1)) + spacing)
            const height = top + Math.ceil(point + (own ? endsUnder + ownHeight(end, span) : 0))
            // How large the margins are that a word that an item is missed has room in, with some of the spacing.
            const noted = Math.max(20 * Theme.unit, widths.leading * Theme.small + 6 * Theme.unit - spacing)
            for (const foot of own || rows < long ? [0] : [head, 0]) {
                const margin = Math.floor(Math.min((foot > 0 ? 26 : 30) * Theme.unit, ((room - head - foot) / rows - height) / 2))
                const [more, rest] = shared(rows, height / 2 + margin)
                // So are their words and points, as far as each statement keeps its lines and the points their distance.
                const [larger, broader] = more === 0 ? [text, point] : grown(text, point, lines, span)
                const higher = Math.ceil(widths.leading * (larger - text) * (1 + 0.92 * (lines - 1)))
                const wider = Math.floor(Math.max(0, Math.min(0.4 * more, 2 * more - higher - broader + point)))
                if (lines <= most && margin >= (foot > 0 ? noted : (own ? 14 : 20) * Theme.unit))
                    return {point: broader, end, own, beyond: exempting, text: larger, spacing: spacing + wider, lines, top: top + higher + wider, height: height + higher + broader - point + wider, margin: margin + more - (higher + broader - point + wider) / 2, rest, raised: Math.max(0, Math.min(8 * Theme.unit, margin - noted)), head, foot, room: (of, other) => endRoom(of, other, end, span)}
            }
        }
        return null
    }
    // How much higher each half of a row is where a page has fewer than another one, so that the ways and the helper stand
    // where they do there; and what whole pixels leave of that.
    function shared(rows: int, half: real): var {
        const few = page.items.length, wish = (rows / few - 1) * half, more = Math.floor(Math.min(60 * Theme.unit, wish))
        return [more, more < wish - 1 ? 0 : 2 * few * (wish - more)]
    }
    // How large the words and the points of few ratings are.
    function grown(text: real, point: real, lines: int, span: real): var {
        const points = Math.max(...page.items.map(item => item.points))
        const scale = [1.25, 1.2, 1.15, 1.1, 1.05].find(each => 1.25 * points * each * point <= span
            && page.items.every(item => widths.lines(item.shown, Math.floor(each * text), page.inner) <= lines)) ?? 1
        return [Math.floor(scale * text), 2 * Math.floor(scale * point / 2)]
    }
    // How far words for the ends are below their points, and how high they are there.
    readonly property real endsUnder: 8 * Theme.unit
    function ownHeight(end: real, span: real): real {
        return widths.leading * end * Math.max(...page.items.map(item => endLines(item, end, span)))
    }
    // In how many lines both words for the ends stand in this width.
    function endLines(item: var, end: real, span: real): int {
        return Math.max(...[[item.left, item.right], [item.right, item.left]].map(([of, other]) => widths.plainLines(of, end, endRoom(of, other, end, span))))
    }
    // How much of a scale's width the button takes that says that an item does not apply.
    readonly property real exempting: page.items.some(item => item.exempts) ? Math.ceil(1.03 * widths.plain(exemption, Theme.small)) + 36 * Theme.unit + Theme.gap : 0
    // How high the band is with the words for the ends.
    function headHeight(end: real, span: real, air: real): real {
        return Math.ceil(widths.leading * end * endLines(page.items[0], end, span) + air * Theme.unit)
    }
    // How much of the width of the points the word for an end has, in their band: a short one leaves a long one the rest.
    function endRoom(of: string, other: string, end: real, span: real): real {
        const needs = text => Math.ceil(1.03 * widths.plain(text, end)) + 2, half = (span - Theme.gap) / 2
        return needs(of) <= half ? needs(of) : Math.max(half, span - Theme.gap - needs(other))
    }
    // The largest questions with which a table fits, none of them in more than so many lines.
    function tableText(most: int): var {
        return [36, 32, 29].map(Theme.size).find(size => tableFits(size, most))
    }
    // Whether the rows of a table fit with questions of this size, none in more than so many lines.
    function tableFits(size: real, most: int): bool {
        const lines = item => widths.lines(item.shown, size, textWidth)
        const words = item => Math.max(page.dense ? 1 : 2, lines(item)) * widths.leading * size
        const rowHeight = item => page.scales(item)
            ? Math.max((page.dense ? 72 : 92) * Theme.unit, words(item)) + (page.dense ? 18 : 40) * Theme.unit + page.gap
            : (page.dense || page.tight ? 170 : 210) * Theme.unit
        return page.items.every(item => !page.scales(item) || lines(item) <= most)
            && page.seen().reduce((sum, item) => sum + rowHeight(item), 60 * Theme.unit) <= page.free
    }
    // Whether rows fit with the words for their ends below each scale, in one line.
    function ownFit(): bool {
        const rowHeight = item => page.gap + 2 * margin + Math.max(height, widths.lines(item.shown, text, textWidth) * widths.leading * text)
        const end = Theme.size(28), room = scaleWidth / 2 - Theme.gap
        return page.items.every(item => widths.bold(item.left, end) <= room && widths.bold(item.right, end) <= room)
            && page.seen().reduce((sum, item) => sum + rowHeight(item), 0) <= page.free
    }
    // How flanked rows look in the first sizes in which they fit; null if they fit in none. Many points are crowned by
    // their question, or stand beside it with their words below them.
    function flanked(crowns: bool): var {
        for (const [point, end, text, most] of trials) {
            const found = tried(crowns, point * Theme.unit, Theme.size(end), Theme.size(text), most)
            if (found !== null)
                return found
        }
        return null
    }
    // How they look in these sizes; null if they do not fit so. A question has the width that a scale leaves.
    function tried(crowns: bool, point: real, end: real, text: real, most: int): var {
        const longer = page.items.filter(many), beside = crowns ? page.items.filter(item => !many(item)) : page.items
        const points = Math.max(1, ...page.items.map(item => page.scales(item) && !many(item) ? item.points : 5))
        const longest = crowns ? 0 : Math.max(0, ...longer.map(item => item.points * 1.24 * 72 * Theme.unit))
        const left = widths.column(beside.map(item => item.left), end)
        const right = widths.column(beside.map(item => item.right), end)
        const scaleWidth = Math.max(longest, left + right + 2 * Theme.gap + (points + 0.27 * (points - 1)) * point)
        const textWidth = page.inner - scaleWidth - 2 * Theme.gap
        const lines = Math.max(0, ...beside.map(item => widths.lines(item.shown, text, textWidth)))
        const pointsAndEnds = longer.length > 0 && !crowns ? 76 * Theme.unit + widths.leading * end : point
        const height = Math.max(point, pointsAndEnds, widths.leading * text * Math.max(2, lines))
        const crownedHeight = crowns ? widths.leading * text + 18 * Theme.unit + point : height
        const margin = spareMargin(height, crownedHeight)
        const fits = textWidth > 0.3 * page.inner && lines <= most && margin >= 14 * Theme.unit
            && longer.every(item => crowns ? crownFits(item, point, end, text) : reach(item, end) < scaleWidth / 2 - Theme.gap)
        return fits ? {point, end, left, right, scaleWidth, textWidth, text, height, crowns, crownedHeight, margin} : null
    }
    // How wide the longer word for an end of a scale is.
    function reach(item: var, size: real): real {
        return 1.03 * Math.max(widths.plain(item.left, size), widths.plain(item.right, size))
    }
    // Whether a question and the note that it is missed fit one line, and its points and the words for their ends another.
    function crownFits(item: var, point: real, end: real, text: real): bool {
        const note = Math.max(...notes.map(note => widths.bold(note, Theme.small)))
        const ends = widths.plain(item.left, end) + widths.plain(item.right, end)
        return 1.03 * (widths.bold(item.shown, text) + note) + 1.25 * Theme.gap <= page.inner
            && 1.03 * ends + 2 * Theme.gap + (item.points + 0.24 * (item.points - 1)) * point <= page.inner
    }
    // What the page's height leaves above and below each row, up to a limit. Rows of many points may be higher than others.
    function spareMargin(height: real, crownedHeight: real): real {
        const all = page.seen().reduce((sum, item) => sum + (many(item) ? crownedHeight : height), 0)
        return Math.min(44 * Theme.unit, ((page.free - all) / Math.max(1, page.seen().length) - page.gap) / 2)
    }
}
