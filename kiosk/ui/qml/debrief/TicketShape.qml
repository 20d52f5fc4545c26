// How what a visitor takes home stands on a ticket beside a wide page, in the helper's place: the first layout that has
// room there.
import QtQuick
import ".."

QtObject {
    id: ticket

    required property WordWidths widths
    // Where it may stand, as the page sees it; empty where the helper has no place beside the page.
    required property rect slot
    required property string codeName
    required property string code
    required property list<string> notes
    required property int squares

    readonly property var texts: notes.filter(text => text !== "")
    readonly property real pad: 32 * Theme.unit
    readonly property real inner: slot.width - 2 * pad
    readonly property real apart: 14 * Theme.unit
    // How large what is said about the code is, its picture, and its letters at most.
    readonly property var trials: [[33, 370, 66], [33, 350, 66], [32, 330, 66], [32, 310, 64], [31, 310, 62], [30, 290, 60], [29, 290, 58],
        [28, 270, 56], [28, 250, 54], [26, 235, 50], [26, 220, 46]]
    // The layout; null without a code, and where that has no room.
    readonly property var found: {
        if (code === "" || slot.width <= 0 || widest === undefined)
            return null
        for (const [note, side, letters] of trials) {
            const tried = {note: Theme.size(note), side: Theme.sharpSide(side * Theme.unit, squares), letters: Math.min(widest, Theme.size(letters))}
            if (fits(tried.note) && heightOf(tried) <= slot.height)
                return tried
        }
        return null
    }
    readonly property real note: found?.note ?? 0
    readonly property real side: found?.side ?? 0
    readonly property real letters: found?.letters ?? Theme.body
    // What to do with the code stands above it, in one line if that makes it only a little smaller.
    readonly property real heading: [38, 36, 34, 32].map(Theme.size).find(size => widths.bold(codeName, size) <= 0.98 * inner) ?? Theme.size(34)
    readonly property real spread: 3 * Theme.unit
    readonly property var widest: [66, 64, 62, 60, 58, 56, 54, 52, 50, 48, 46, 44, 42, 40].map(Theme.size)
        .find(size => widths.bold(code, size) + code.length * spread <= 0.98 * inner)

    // How much of the white around the code's squares is beyond the height that it takes: it may come close to letters.
    function spare(side: real): real {
        return 2.5 * side / Math.max(1, squares)
    }
    // Whether no word of what is said is longer than a line.
    function fits(size: real): bool {
        return texts.every(text => text.split(" ").every(word => widths.plain(word, size) <= 0.98 * inner))
    }
    function heightOf(tried: var): real {
        const told = texts.reduce((sum, text) => sum + widths.plainLines(text, tried.note, 0.97 * inner), 0)
        return 2 * pad + widths.lines(codeName, heading, inner) * widths.leading * heading + apart + tried.side - spare(tried.side)
            + 1.2 * tried.letters + 2.6 * apart + told * widths.leading * tried.note + Math.max(0, texts.length - 1) * apart
    }
}
