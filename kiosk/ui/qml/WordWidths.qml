// How wide words are and how many lines they take, before they are laid out: the one place where pages measure
// words.
import QtQuick
import "."

QtObject {
    id: widths

    // How much higher a line is than its letters are large.
    readonly property real leading: 1.37
    // A text that is laid out takes a little more than its letters: small ones are set on whole pixels.
    readonly property real slack: 1.01

    readonly property FontMetrics boldLetters: FontMetrics {
        font { pixelSize: 100; bold: true }
    }
    readonly property FontMetrics plainLetters: FontMetrics {
        font.pixelSize: 100
    }
    // Each text is measured once, although many sizes are tried: of a text its width, and those of its words.
    readonly property var boldTexts: new Map()
    readonly property var plainTexts: new Map()
    // Each page measures for itself, and sees codes, numbers and sentences of every visitor: more than it has at once are
    // not kept, or the kiosk would grow for hundreds of visits.
    property int mostKept: 100

    function measured(text: string, letters: FontMetrics, kept: var): var {
        let found = kept.get(text)
        if (found === undefined) {
            const words = text.split(" ").map(word => letters.advanceWidth(word))
            found = {whole: words.length > 1 ? letters.advanceWidth(text) : words[0], words: words}
            if (kept.size >= mostKept)
                kept.clear()
            kept.set(text, found)
        }
        return found
    }
    // How wide a text is in one line of bold letters, as questions have them.
    function bold(text: string, size: real): real {
        return measured(text, boldLetters, boldTexts).whole * size / 100
    }
    // The same in plain letters, as options and the ends of scales have them.
    function plain(text: string, size: real): real {
        return measured(text, plainLetters, plainTexts).whole * size / 100
    }
    // The largest of these sizes with which a text is in one line of bold letters, or else the last.
    function largestInOneLine(text: string, sizes: var, width: real): real {
        return sizes.find(size => bold(text, size) <= width) ?? sizes[sizes.length - 1]
    }
    // How many lines of bold letters a text has in so much width, and how many of plain ones.
    function lines(text: string, size: real, width: real): int {
        return linesOf(measured(text, boldLetters, boldTexts).words, bold(" ", size), size, width)
    }
    function plainLines(text: string, size: real, width: real): int {
        return linesOf(measured(text, plainLetters, plainTexts).words, plain(" ", size), size, width)
    }
    function linesOf(words: var, gap: real, size: real, width: real): int {
        const room = 0.98 * width
        let count = 1, end = 0
        for (const word of words) {
            const wide = word * size / 100, fits = end > 0 && end + gap + wide <= room
            // A word that is longer than a line, as in languages without spaces, is broken.
            count += (end > 0 && !fits ? 1 : 0) + Math.max(0, Math.ceil(wide / room) - 1)
            end = fits ? end + gap + wide : wide
        }
        return count
    }
    // How wide a column of such plain texts is, each in two lines if it is long. In steps: so pages with almost the same
    // words have columns of one width.
    function column(texts: list<string>, size: real): real {
        const step = 16 * Theme.unit, folded = texts.map(text => {
            const whole = plain(text, size), words = text.split(" ")
            return whole <= 5.4 * size ? whole : Math.min(...words.map((_, at) =>
                Math.max(plain(words.slice(0, at).join(" "), size), plain(words.slice(at).join(" "), size))))
        })
        return Math.ceil(1.03 * Math.max(0, ...folded) / step) * step
    }
}
