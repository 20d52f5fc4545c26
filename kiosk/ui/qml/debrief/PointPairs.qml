// How the points stand where a study compares two things: the first leads to the second and the third, which are cards
// beside each other, and those after them are plain lines.
import QtQuick
import ".."

QtObject {
    id: pairs

    required property DebriefShape page

    readonly property var two: page.points.slice(1, 3)
    readonly property var rest: page.points.slice(3)
    // Each of these is a row where all have room in one line; if not, they are one paragraph.
    readonly property var rows: [page.points.slice(0, 1), two, ...(rest.length === 0 ? [] : runOn(size) ? rest.map(point => [point]) : [rest])]
    // How large the headings on the cards are, how wide the drawings, and how large the code below them at most: the first
    // that has room. Headings of two lines come first, then a large code, large drawings and large letters.
    readonly property var found: page.points.length < 3 || !page.drawn ? undefined
        : trials.find(trial => fits(Theme.size(trial.letters), trial.side * Theme.unit, trial.code * Theme.unit, trial.lines))
    readonly property real size: found === undefined ? 0 : Theme.size(found.letters)
    readonly property real side: found === undefined ? 0 : found.side * Theme.unit
    readonly property real mostCode: found === undefined ? 0 : found.code * Theme.unit
    readonly property var trials: page.upright
        ? [...tried(3, [260, 220, 190], [44]), ...tried(3, [260, 220], [42, 40]), ...tried(3, [260, 200, 160, 120], [38, 36, 34, 32])]
        : [...tried(2, [188, 168, 150], [42, 40, 38]), ...tried(3, [188, 150], [42, 40, 38]), ...tried(3, [150, 120], [36, 34, 32])]
    function tried(lines: int, sides: var, sizes: var): var {
        const all = []
        for (const code of [290, 240])
            for (const side of sides)
                for (const letters of sizes)
                    all.push({letters, side, code, lines})
        return all
    }
    // All else that is read is as large as each other, and smaller.
    readonly property real body: bodyOf(size)
    function bodyOf(size: real): real {
        return Math.min(Theme.size(36), size)
    }
    // All parts of the page are as far apart as each other, also from the title and the way on: this is added to a gap.
    // By what their heights have become, as what was reckoned with is a little more.
    required property real taken
    readonly property real further: {
        const between = rest.length > 0 ? 3 : 2, closer = 0.2 * Theme.gap * Math.max(0, rows.length - 3)
        return Math.max(0, Math.min(2.2 * Theme.gap, (page.room - taken - closer - between * Theme.gap) / (between + 2)))
    }

    readonly property real letters: Theme.size(page.upright ? 72 : 64)
    readonly property real pad: Theme.gap

    // The drawing on a card is above the words where a card is narrow.
    readonly property bool above: page.upright
    // Two cards that are about what was seen and about chance show cards of the game.
    readonly property bool ofCards: two.some(point => ["seen", "chance"].includes(point.sign))
    // How far a row is below the one before it. Plain lines follow each other closely.
    function step(at: int, further: real): real {
        return at === 0 ? 0 : at > 2 ? 0.2 * Theme.gap : Theme.gap + further
    }
    // How large a plain point is, so that it has room in one line if possible. The first one, which leads, is as large as
    // the headings.
    function plainSize(text: string, at: int, size: real): real {
        const body = bodyOf(size)
        return (at === 0 ? [size, 0.95 * size, 0.9 * size, 0.86 * size, body] : [body, 0.95 * body]).find(tried => runsOn(text, tried)) ?? body
    }
    // Whether all plain points below the cards have room in one line each.
    function runOn(size: real): bool {
        return rest.every(point => runsOn(point.text, plainSize(point.text, 2, size)))
    }
    // Whether heading and text of a plain point have room in one line.
    function runsOn(text: string, size: real): bool {
        const [lead, rest] = [...text.split("\n"), ""], words = page.widths
        return text.split("\n").length < 3 && words.bold(lead, size) + words.plain(rest, size) + 0.45 * size <= 0.995 * page.column
    }
    // Whether points and card have room in these sizes, with headings of so many lines at most. No text on a card has more
    // than two.
    function fits(size: real, side: real, code: real, lines: int): bool {
        return two.every(point => headLines(point, size, side) <= lines && bodyLines(point, size, side) <= 2)
            && 1.02 * stacked(size, side) + Theme.gap + page.cardHeight(code, pad, 0, bodyOf(size), letters) <= page.room
    }
    // How wide the words of a card are. Small letters are set on whole pixels, which makes them wider.
    function wordsWidth(side: real): real {
        return (Theme.unit < 0.9 ? 0.95 : 0.98) * ((page.column - Theme.gap) / 2 - 2 * Theme.gap - (above ? 0 : side + Theme.gap))
    }
    function headLines(point: var, size: real, side: real): int {
        return point.text.includes("\n") ? page.widths.lines(point.text.split("\n")[0], size, wordsWidth(side)) : 0
    }
    function bodyLines(point: var, size: real, side: real): int {
        return page.pointLines("\n" + point.text.slice(point.text.indexOf("\n") + 1), bodyOf(size), wordsWidth(side))
    }
    // How high all rows are with headings of this size and drawings of this side.
    function stacked(size: real, side: real): real {
        return leadHeight(page.points[0].text, size) + Theme.gap + cardsHeight(two, size, side) + (rest.length > 0 ? Theme.gap + restHeight(size) : 0)
    }
    function cardsHeight(cards: var, size: real, side: real): real {
        const said = Math.max(...cards.map(point => page.pointHeight(headLines(point, size, side), size) + page.pointHeight(bodyLines(point, size, side), bodyOf(size))))
        return 2 * Theme.gap + (above ? side + 0.5 * Theme.gap + said : Math.max(side, said))
    }
    function leadHeight(text: string, size: real): real {
        const plain = plainSize(text, 0, size)
        return (runsOn(text, plain) ? 1 : page.pointLines(text, plain, page.column)) * page.lineHeight(plain)
    }
    function restHeight(size: real): real {
        if (runOn(size))
            return rest.reduce((sum, point) => sum + page.lineHeight(plainSize(point.text, 2, size)) + 0.2 * Theme.gap, -0.2 * Theme.gap)
        const whole = rest.map(point => point.text.replace(/\n/g, ". ")).join(" ")
        return page.cardLines([whole], bodyOf(size), 0.95 * page.column) * page.lineHeight(bodyOf(size))
    }
}
