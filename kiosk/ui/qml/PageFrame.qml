// The frame of every page that is read or filled in: its title at the top, its content below that, and at the bottom the
// way back and the way on. They stand at the same places on all pages.
import QtQuick
import Recollect
import "."

FocusScope {
    id: frame

    required property KioskScreen kiosk
    required property var words
    property string title: ""
    property real titleSize: Theme.pageTitle
    // What the way on says; see WayOn.
    property alias label: ways.label
    property alias quiet: ways.quiet
    property alias other: ways.other
    property alias way: ways
    // How far above their usual place the ways stand, where the content leaves height.
    property real raised: 0
    // How far title and content are moved up, for a keyboard at the bottom.
    property real lift: 0
    // How much of the bottom that keyboard covers; the ways then stand above it.
    property real covered: 0
    // What stands at the end of the title's line, if anything.
    property Item beside: null
    // How much of the end of the title's line is not the page's: the controls stand there.
    property real cornered: 0
    // Whether it does. That it is seen depends on the page as well.
    property bool besides: false
    // Whether the helper stands beside this page on a wide screen, and what is then read in its bubble instead of here.
    property bool accompanied: false
    property string aside: ""
    default property alias content: body.data
    signal went()
    signal turnedDown()

    // Whether a wide screen's width is used, as for a table.
    property bool wider: false
    // Whether the pages before and after it leave the helper room beside them: a wider one then begins where they do.
    property bool aligned: false
    readonly property real column: Math.min((width <= 1600 * Theme.unit ? 1240 : wider ? aligned ? 1787 : 1560 : 1300) * Theme.unit, width - 4 * Theme.gap)
    // The height that there is for the content.
    readonly property real room: usualFoot - begin - Theme.gap
    // Where the content begins and the ways are, while nothing is moved up.
    readonly property alias begin: body.y
    readonly property alias foot: ways.y
    readonly property real usualFoot: height - ways.height - below
    readonly property real titleWidth: heading.contentWidth
    // The middle of the capitals of the title's last line, as seen from the content, and whether it is the only one.
    readonly property real titleMiddle: heading.y + heading.height - capitals.descent - 0.36 * heading.font.pixelSize - body.y
    readonly property bool titleInOneLine: heading.lineCount === 1
    // A wide page keeps about as far from the upper edge as from the lower one: a title has air above its capitals.
    readonly property real above: (width < height ? 48 : 32) * Theme.unit
    readonly property real below: (width < height ? 36 : 40) * Theme.unit

    // How far below the title a content of this height stands: a little lower where there is much room.
    function sink(tall: real): real {
        return Math.max(0, Math.min((room - tall) / 3, (width < height ? 6 : 2.5) * Theme.gap))
    }

    // A heading and its text, each as a sentence: a heading has no full stop of its own.
    function sentences(text: string): var {
        return text.replace(/([^.,;:!?…。！？])\n/, "$1.\n").split("\n")
    }

    // The last of several lines, if the helper can say it: a bubble holds a short text only.
    function sayable(lines: var): string {
        const last = lines.length > 1 ? sentences(lines[lines.length - 1].text).join(" ") : ""
        return accompanied && last.length <= 130 ? last : ""
    }

    // How many of these texts stand in the first of two columns, so that both are about as long.
    function half(texts: var): int {
        const lengths = texts.map(text => text.length + 40)
        const all = lengths.reduce((sum, each) => sum + each, 0)
        let best = 1, least = Infinity
        for (let i = 1, sum = lengths[0]; i < texts.length; sum += lengths[i++])
            if (Math.abs(all - 2 * sum) < least) {
                least = Math.abs(all - 2 * sum)
                best = i
            }
        return best
    }

    FontMetrics {
        id: capitals
        font: heading.font
    }
    PlainText {
        id: heading
        objectName: "page-title"
        // The controls stand at the right of a mirrored page, too.
        x: body.x + Theme.across(0, width, frame.column - frame.cornered)
        y: frame.above
        transform: Translate { y: -frame.lift }
        width: frame.column - frame.cornered - (frame.besides ? frame.beside.width + Theme.gap : 0)
        visible: text !== ""
        text: frame.title
        horizontalAlignment: Text.AlignLeft
        font { pixelSize: frame.titleSize; bold: true }
        wrapMode: Text.Wrap
        color: Theme.ink
    }
    Item {
        id: body
        x: (frame.width - width) / 2
        y: heading.y + (frame.title !== "" ? Math.max(heading.height, frame.besides ? frame.beside.height : 0) + Theme.gap : 0)
        width: frame.column
        height: frame.room
        transform: Translate { y: -frame.lift }
    }
    // What lies under the ways while they stand above a keyboard is neither seen nor pressed.
    Rectangle {
        visible: frame.covered > 0
        width: frame.width
        y: frame.foot + rise.y - 0.5 * Theme.gap
        height: frame.height - y
        color: Theme.paper
        MouseArea { anchors.fill: parent; Accessible.ignored: true }
    }
    WayOn {
        id: ways
        x: body.x
        y: frame.usualFoot - frame.raised
        transform: Translate {
            id: rise
            y: frame.covered > 0 ? frame.below - 0.5 * Theme.gap - frame.covered : 0
        }
        width: frame.column
        kiosk: frame.kiosk
        words: frame.words
        fills: frame.width < frame.height
        onWent: frame.went()
        onTurnedDown: frame.turnedDown()
    }
}
