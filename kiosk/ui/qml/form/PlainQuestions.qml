// How a page lays out its plain questions: how large options are and how many of them stand in a row, and where the field
// of a number stands.
import QtQuick
import ".."

QtObject {
    id: questions

    required property PageShape page
    required property WordWidths widths

    // How large the questions of a wide page are whose options all stand in two columns, or in rows that they share.
    readonly property real asking: Theme.size(36)
    // How large and how high such options are; null if they do not stand so.
    readonly property var columns: !page.calm || page.upright || page.alone || Theme.mirrored ? null : columned()
    // How large the options of an upright page are: as large as leaves them in as many rows as the usual size does.
    readonly property real optionSize: (page.easy ? [38, 36].map(Theme.size).find(
        size => page.items.every(item => stackedRows(item, size) === stackedRows(item, usual))) : null) ?? usual
    readonly property real usual: Theme.size(34)

    // How far the columns are apart, and what an option has beside its words.
    readonly property real gutter: 16 * Theme.unit
    readonly property real around: 79 * Theme.unit
    // How much width the field of a number takes beside its question, with its buttons.
    readonly property real fieldWidth: 470 * Theme.unit

    // Whether the field of a number stands beside its question: only a calm wide page's and an upright one's cards are
    // broad enough for both.
    function inline(item: var): bool {
        return (page.upright || page.calm && !Theme.mirrored) && !page.alone && !page.largeText && item.kind === "integer" && !item.exempts
            && widths.bold(item.text, Theme.size(38)) + fieldWidth <= page.inner
    }
    // Whether what the number may be stands in the question's line.
    function ranged(item: var): bool {
        return columns !== null && item.kind === "integer" && rangeFits(item)
    }
    // How many options each row of this question has where they share rows; none where they stand in two columns.
    function shared(item: var): var {
        return columns !== null ? sharedAt(item, columns.size) : []
    }

    // The largest letters, and with them the highest options, with which all questions fit.
    function columned(): var {
        const heights = [84, 80, 78, 77, 76, 75, 74, 72, 68].map(height => height * Theme.unit)
        const sizes = [34, 33, 32, 31, 30, 29].map(Theme.size)
        for (const size of sizes.filter(size => page.items.every(item => fits(item, size)))) {
            const height = heights.find(height => pageHeight(size, height) <= page.free)
            if (height !== undefined)
                return {size, height}
        }
        return null
    }
    // Whether the options of this question have room in halves of the card, or in rows that they share.
    function fits(item: var, size: real): bool {
        const half = (page.inner - gutter) / 2 - around
        return item.kind === "integer" || item.kind === "single"
            && (sharedAt(item, size).length > 0 || item.options.every(option => optionWidth(option, size) <= half))
    }
    // How high the page is with options in this size and so high. Below the last card no distance is needed.
    function pageHeight(size: real, height: real): real {
        return page.seen().reduce((sum, item) => {
            if (item.kind === "integer")
                return sum + (rangeFits(item) ? 130 : 138) * Theme.unit
            const lines = Math.ceil(widths.bold(item.text, asking) / page.inner)
            const rows = sharedAt(item, size).length || Math.ceil(item.options.length / 2)
            return sum + lines * widths.leading * asking + 50 * Theme.unit + (height + gutter) * rows
        }, -22 * Theme.unit)
    }
    // Whether the question of a number and what the number may be have room in one line, before its field.
    function rangeFits(item: var): bool {
        return widths.bold(item.text, asking) + widths.slack * widths.plain(item.range, Theme.size(32)) + 1.5 * Theme.gap
            <= page.inner - fieldWidth
    }
    // How many options each row has if an odd number of them takes fewer rows so than in halves, which would leave a hole.
    // The first rows have one more than the last, or the other way round.
    function sharedAt(item: var, size: real): var {
        const options = item.options ?? []
        if (item.kind !== "single" || options.length % 2 === 0)
            return []
        const wide = options.map(option => optionWidth(option, size) + 84 * Theme.unit + gutter)
        for (let rows = 1; rows < options.length / 2; rows++) {
            const counts = Array.from({length: rows}, (_, row) => Math.floor(options.length / rows) + (row < options.length % rows ? 1 : 0))
            const found = [counts, counts.slice().reverse()].find(ways => {
                let end = 0
                return ways.every(count => {
                    end += count
                    return wide.slice(end - count, end).reduce((sum, each) => sum + each, 0) <= page.inner + gutter
                })
            })
            if (found !== undefined)
                return found
        }
        return []
    }
    // In how many rows an upright page's options stand, all as wide; 0 where one has no room.
    function stackedRows(item: var, size: real): int {
        if (item.kind !== "single")
            return 0
        const gap = 14 * Theme.unit, all = item.options.length
        const widest = Math.max(...item.options.map(option => optionWidth(option, size))) + 104 * Theme.unit
        const fit = Math.min(all, Math.floor((page.inner + gap) / (widest + gap)))
        return fit < 1 ? 0 : Math.ceil(all / fit)
    }
    function optionWidth(option: var, size: real): real {
        return widths.slack * widths.plain(option.text, size)
    }
}
