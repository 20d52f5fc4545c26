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
    // Each text is measured once, although many sizes are tried.
    readonly property var boldWidths: new Map()
    readonly property var plainWidths: new Map()

    // How wide a text is in one line of bold letters, as questions have them.
    function bold(text: string, size: real): real {
        if (!boldWidths.has(text))
            boldWidths.set(text, boldLetters.advanceWidth(text))
        return boldWidths.get(text) * size / 100
    }
    // The same in plain letters, as options and the ends of scales have them.
    function plain(text: string, size: real): real {
        if (!plainWidths.has(text))
            plainWidths.set(text, plainLetters.advanceWidth(text))
        return plainWidths.get(text) * size / 100
    }
    // How many lines of bold letters a text has in so much width, and how many of plain ones.
    function lines(text: string, size: real, width: real): int {
        return linesOf(text, size, width, bold)
    }
    function plainLines(text: string, size: real, width: real): int {
        return linesOf(text, size, width, plain)
    }
    function linesOf(text: string, size: real, width: real, measured: var): int {
        const room = 0.98 * width, gap = measured(" ", size)
        let count = 1, end = 0
        for (const word of text.split(" ")) {
            const wide = measured(word, size), fits = end > 0 && end + gap + wide <= room
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
