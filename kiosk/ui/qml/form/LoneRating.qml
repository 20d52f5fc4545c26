// How a rating looks that is alone on its page: large, over the width of its card, with its question in the middle.
import QtQuick
import ".."

QtObject {
    required property PageShape page

    // How far its content is from the edges of the card, and the question from the scale.
    readonly property real margin: (page.tight ? 20 : page.upright ? 110 : 64) * Theme.unit
    readonly property real spacing: (page.upright ? 4.4 * Theme.textSize : page.tight ? 2 : 3.5) * Theme.gap
    // How large points are at most, how high many narrow ones are, and how far apart, as a share of their width.
    readonly property real point: 144 * Theme.unit
    readonly property real tall: page.upright ? 220 * Theme.unit : point
    readonly property real apart: page.upright ? 0.17 : 0.22
    // How large the words for the ends are.
    readonly property real end: Theme.size(page.largeText ? 38 : 48)

    // How large a question is: as large as leaves it in few lines.
    function asking(question: string): real {
        if (page.largeText)
            return Theme.heading
        const lines = size => page.widths.lines(question, size, page.inner)
        const [sizes, most] = page.upright ? [[80, 76, 72, 68, 64, 60, 56], 3] : [[64, 62, 60, 58, 56], lines(Theme.size(52))]
        return sizes.map(Theme.size).find(size => lines(size) <= most) ?? Theme.size(52)
    }
}
