// How the points stand where a study compares two things: the first leads to the second and the third, which are cards
// beside each other, and those after them are plain lines.
import QtQuick
import ".."

QtObject {
    id: pairs

    required property DebriefShape page
    required property TicketShape ticket

    readonly property var two: page.all.slice(1, 3)
    readonly property var rest: restOf(ticketed)
    // Beside a ticket, the page has all points.
    function restOf(ticketed: bool): var {
        return (ticketed ? page.all : page.fewer).slice(3)
    }
    // Two of those stand beside each other on an upright page and beside a ticket, below the cards. Otherwise each is a row
    // where all have room in one line; if not, they are one paragraph.
    readonly property bool split: splits(ticketed)
    function splits(ticketed: bool): bool {
        return (page.upright || ticketed) && restOf(ticketed).length === 2
    }
    readonly property var rows: [page.points.slice(0, 1), two, ...(rest.length === 0 ? [] : !split && runOn(size, ticketed) ? rest.map(point => [point]) : [rest])]
    // How large the headings on the cards are, how wide the drawings, and how large the code below them at most: the first
    // that has room. Headings of two lines come first, then a large code, large drawings and large letters.
    readonly property var found: !page.drawn ? undefined : chosen()
    function chosen(): var {
        // What many trials have in common is reckoned once.
        const known = new Map()
        return trials.find(trial => fits(trial, known))
    }
    function once(known: var, name: string, reckon: var): var {
        if (!known.has(name))
            known.set(name, reckon())
        return known.get(name)
    }
    readonly property real size: found === undefined ? 0 : Theme.size(found.letters)
    readonly property real side: found === undefined ? 0 : found.side * Theme.unit
    readonly property real mostCode: found === undefined ? 0 : codeOf(found)
    // Whether the code stands beside the way on of a wide page, and leaves the cards all of the height above that.
    readonly property bool footed: found?.footed ?? false
    // Whether the code stands on a ticket beside the page.
    readonly property bool ticketed: found?.ticketed ?? false
    readonly property var trials: page.upright
        ? [...tried(3, [260, 240, 220, 190], [44], [320, 300, 275, 250]), ...tried(3, [220, 180, 150], [42, 40], [300, 275, 250]),
            ...tried(3, [180, 150, 120], [38, 36, 34, 32], [250])]
        : [...(ticket.found !== null ? [...tried(2, [290, 270, 250, 230, 210, 190, 170, 150], [46, 44, 42, 40], [0], false, true),
                ...tried(3, [230, 210, 190, 170, 150, 130], [42, 40, 38, 36], [0], false, true)] : []),
            ...(page.coded ? tried(2, [240, 220, 200, 180, 160, 140], [44, 42, 40], [230, 210], true) : []),
            ...tried(2, [188, 168, 150], [42, 40, 38]), ...tried(3, [188, 150], [42, 40, 38]), ...tried(3, [150, 120], [36, 34, 32])]
    // On a small screen its squares are larger, where there is room: a telephone has to tell them apart.
    function codeOf(trial: var): real {
        return Math.max(trial.code * Theme.unit, Math.min(290 * Theme.unit, 4 * page.squares))
    }
    function tried(lines: int, sides: var, sizes: var, codes = [290, 240], footed = false, ticketed = false): var {
        const all = []
        for (const code of codes)
            for (const side of sides)
                for (const letters of sizes)
                    all.push({letters, side, code, lines, footed, ticketed})
        return all
    }
    // All else that is read is as large as each other, and smaller.
    readonly property real body: bodyOf(size)
    function bodyOf(size: real): real {
        return Math.min(Theme.size(page.upright ? 36 : 34), size)
    }
    // All parts of the page are as far apart as each other, also from the title and the way on: this is added to a gap.
    // By what their heights have become, as what was reckoned with is a little more.
    required property real taken
    required property real room
    readonly property real further: {
        const between = (rest.length > 0 ? 3 : 2) - (footed || ticketed ? 1 : 0), closer = 0.2 * Theme.gap * Math.max(0, rows.length - 3)
        return Math.max(0, Math.min(2.2 * Theme.gap, (room - taken - closer - between * Theme.gap) / (between + 2)))
    }

    readonly property real letters: lettersOf(footed)
    function lettersOf(footed: bool): real {
        return Theme.size(page.upright ? 72 : footed ? 56 : 64)
    }
    readonly property real pad: footed ? page.footPad : Theme.gap

    // The drawing on a card is above the words where a card is narrow or high.
    readonly property bool above: page.upright || footed || ticketed
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
    // How large two of them beside each other are: a little smaller, where that saves the longer one a line.
    readonly property real noteSize: noteSizeOf(size, ticketed)
    function noteSizeOf(size: real, ticketed: bool): real {
        const body = bodyOf(size), less = 0.94 * body
        const lines = tried => Math.max(...restOf(ticketed).map(point => noteLines(point.text, tried)))
        return lines(less) < lines(body) ? less : body
    }
    // How wide their drawings are, as a share of the size of their letters: on an upright page there are none, and the words
    // have all of the width.
    readonly property bool badged: !page.upright
    readonly property real noteBadge: badged ? 1.8 : 0
    function noteLines(text: string, size: real): int {
        const width = (Theme.unit < 0.9 ? 0.97 : 1) * ((page.column - Theme.gap) / 2 - (badged ? noteBadge * size + Theme.gap : 0))
        return text.split("\n").reduce((sum, part, at) => sum + (at === 0 ? page.widths.lines(part, size, width) : page.widths.plainLines(part, size, width)), 0)
    }
    // Whether all plain points below the cards have room in one line each.
    function runOn(size: real, ticketed: bool): bool {
        return restOf(ticketed).every(point => runsOn(point.text, plainSize(point.text, 2, size)))
    }
    // Whether heading and text of a plain point have room in one line.
    function runsOn(text: string, size: real): bool {
        const [lead, rest] = [...text.split("\n"), ""], words = page.widths
        return text.split("\n").length < 3 && words.bold(lead, size) + words.plain(rest, size) + 0.45 * size <= 0.995 * page.column
    }
    // Whether points and card have room in these sizes, with headings of so many lines at most. No text on a card has more
    // than two.
    function fits(trial: var, known: var): bool {
        if ((trial.ticketed ? page.all : page.fewer).length < 3)
            return false
        const size = Theme.size(trial.letters), side = trial.side * Theme.unit, code = codeOf(trial)
        const above = page.upright || trial.footed || trial.ticketed, width = wordsWidth(side, above)
        const words = once(known, ["words", size, width].join(" "), () => cardWords(size, width))
        if (words.heads > trial.lines || words.bodies > 2)
            return false
        const most = trial.ticketed ? page.room : once(known, ["most", size, code, trial.footed].join(" "), () =>
            trial.footed ? page.room + page.wayHeight - page.footHeight(code, bodyOf(size), lettersOf(true))
                : page.room - Theme.gap - page.cardHeight(code, Theme.gap, 0, bodyOf(size), lettersOf(false)))
        const others = once(known, ["others", size, trial.ticketed].join(" "), () => othersHeight(size, trial.ticketed))
        return 1.02 * (others + cardsHeight(words.tall, side, above)) <= most
    }
    // How wide the words of a card are. Small letters are set on whole pixels, which makes them wider.
    function wordsWidth(side: real, above: bool): real {
        return (Theme.unit < 0.9 ? 0.95 : 0.98) * ((page.column - Theme.gap) / 2 - 2 * Theme.gap - (!above ? side + Theme.gap : 2 * narrowed(above)))
    }
    // How much narrower they are on each side below a drawing on a wide page: two headings then have two lines each.
    function narrowed(above: bool): real {
        return above && !page.upright ? 70 * Theme.unit : 0
    }
    function headLines(point: var, size: real, width: real): int {
        return point.text.includes("\n") ? page.widths.lines(point.text.split("\n")[0], size, width) : 0
    }
    function bodyLines(point: var, size: real, width: real): int {
        return page.pointLines("\n" + point.text.slice(point.text.indexOf("\n") + 1), bodyOf(size), width)
    }
    // The lines of the card that has most, and how high the words of the higher one are.
    function cardWords(size: real, width: real): var {
        const heads = two.map(point => headLines(point, size, width)), bodies = two.map(point => bodyLines(point, size, width))
        const talls = two.map((_, at) => page.pointHeight(heads[at], size) + page.pointHeight(bodies[at], bodyOf(size)))
        return {heads: Math.max(...heads), bodies: Math.max(...bodies), tall: Math.max(...talls)}
    }
    function cardsHeight(words: real, side: real, above: bool): real {
        return 2 * Theme.gap + (above ? side + 0.5 * Theme.gap + words : Math.max(side, words))
    }
    // How high all rows but the cards are, with what is between them.
    function othersHeight(size: real, ticketed: bool): real {
        return leadHeight(page.all[0].text, size) + Theme.gap + (restOf(ticketed).length > 0 ? Theme.gap + restHeight(size, ticketed) : 0)
    }
    function leadHeight(text: string, size: real): real {
        const plain = plainSize(text, 0, size)
        return (runsOn(text, plain) ? 1 : page.pointLines(text, plain, page.column)) * page.lineHeight(plain)
    }
    function restHeight(size: real, ticketed: bool): real {
        const body = bodyOf(size), rest = restOf(ticketed)
        if (splits(ticketed)) {
            const note = noteSizeOf(size, ticketed)
            return Math.max(noteBadge * note, ...rest.map(point => page.pointHeight(noteLines(point.text, note), note)))
        }
        if (runOn(size, ticketed))
            return rest.reduce((sum, point) => sum + page.lineHeight(plainSize(point.text, 2, size)) + 0.2 * Theme.gap, -0.2 * Theme.gap)
        const whole = rest.map(point => point.text.replace(/\n/g, ". ")).join(" ")
        return page.cardLines([whole], body, 0.95 * page.column) * page.lineHeight(body)
    }
}
