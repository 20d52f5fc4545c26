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
    // How large the headings on the cards are, and the code below them at most: as large as there is room for; 0 where
    // there is none.
    readonly property var found: page.points.length < 3 || !page.drawn ? undefined
        : trials.find(([letters, code]) => fits(Theme.size(letters), code * Theme.unit))
    readonly property real size: found === undefined ? 0 : Theme.size(found[0])
    readonly property real mostCode: found === undefined ? 0 : found[1] * Theme.unit
    readonly property var trials: (page.upright ? [44, 42, 40, 38, 36, 34, 32] : [48, 46, 44, 42, 40, 38, 36, 34, 32])
        .reduce((trials, letters) => [...trials, [letters, 290], [letters, 240]], [])
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

    readonly property real letters: Theme.size(page.upright ? 60 : 64)
    readonly property real pad: 0.5 * Theme.gap

    // The drawing on a card is above the words where a card is narrow.
    readonly property bool above: page.upright
    readonly property real side: sideOf(size)
    function sideOf(size: real): real {
        return Math.max(120 * Theme.unit, above ? Math.min(220 * Theme.unit, 7 * size - 88 * Theme.unit) : Math.min(150 * Theme.unit, 3.4 * size))
    }
    // Two cards that are about what was seen and about chance show cards of the game.
    readonly property bool ofCards: two.some(point => ["seen", "chance"].includes(point.sign))
    // How high the words of a card have at least.
    readonly property real least: leastOf(size)
    function leastOf(size: real): real {
        return above || size < Theme.size(40) ? 0 : 216 * Theme.unit
    }

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
    // Whether points and card have room in these sizes. On a card, no heading has more than three lines, and no text more
    // than two.
    function fits(size: real, code: real): bool {
        return two.every(point => headLines(point, size) <= 3 && bodyLines(point, size) <= 2)
            && needed(size, code) <= page.room
    }
    function needed(size: real, code: real): real {
        return 1.02 * stacked(size) + Theme.gap + page.cardHeight(code, pad, 0, bodyOf(size), letters)
    }
    // How wide the words of a card are. Small letters are set on whole pixels, which makes them wider.
    function wordsWidth(size: real): real {
        return (Theme.unit < 0.9 ? 0.95 : 0.98) * ((page.column - Theme.gap) / 2 - 2 * Theme.gap - (above ? 0 : sideOf(size) + Theme.gap))
    }
    function headLines(point: var, size: real): int {
        return point.text.includes("\n") ? page.widths.lines(point.text.split("\n")[0], size, wordsWidth(size)) : 0
    }
    function bodyLines(point: var, size: real): int {
        return page.pointLines("\n" + point.text.slice(point.text.indexOf("\n") + 1), bodyOf(size), wordsWidth(size))
    }
    // How high all rows are with headings of this size.
    function stacked(size: real): real {
        return size === 0 ? 0 : leadHeight(page.points[0].text, size) + Theme.gap + cardsHeight(two, size) + (rest.length > 0 ? Theme.gap + restHeight(size) : 0)
    }
    function cardsHeight(cards: var, size: real): real {
        const said = Math.max(...cards.map(point => page.pointHeight(headLines(point, size), size) + page.pointHeight(bodyLines(point, size), bodyOf(size))))
        return 2 * Theme.gap + (above ? sideOf(size) + 0.5 * Theme.gap + said : Math.max(sideOf(size), leastOf(size), said))
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
