// What the study is about.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property AboutScreen about
    required property ReturnScreen returning
    required property AttractScreen attract
    required property url cardBack
    required property url cardShadow

    aside: sayable(about.lines)
    readonly property var read: aside === "" ? about.lines : about.lines.slice(0, -1)

    title: about.title
    titleSize: upright && led && Theme.textSize <= 1 && widths.bold(about.title, Theme.size(80)) <= column ? Theme.size(80) : Theme.pageTitle
    label: words["about-continue"]
    other: returning.offered ? words["return-offer"] : ""
    way.otherName: "return-offer"
    onTurnedDown: kiosk.ask("code")
    onWent: about.proceed()
    // Whatever the last visitor's keyboard was at, the next one's is at the button.
    onVisibleChanged: way.focus = true
    Keys.onPressed: event => pane.turn(event)

    // Where the lines are short they are set larger: a page that is read at a glance.
    readonly property real close: (led ? 1.2 : 1.8) * Theme.gap
    WordWidths { id: widths }
    readonly property real size: (led ? [46, 42, 38, 36, 34] : [50, 46, 42, 38]).map(Theme.size).find(size => fits(size)) ?? Theme.size(led ? 32 : 36)
    // Beside the helper each line has a large drawing, where the page has room for that. Nothing is around it: it is no button.
    readonly property bool upright: width < height
    readonly property bool airy: (upright ? Theme.textSize <= 1.15 : aside !== "") && read.every(line => line.sign !== "") && airySize > 0
    readonly property real airySize: (upright ? [42, 40, 38, 36] : led ? [42, 40, 38, 37, 36] : [46, 44, 42, 40, 38, 36]).map(Theme.size).find(size => fitsAiry(size)) ?? 0
    // Headings and their texts stand closer than lines without headings, so that each row is seen as one.
    readonly property real airyLeading: led ? 0.96 : 1.08
    readonly property real airyWidth: column - badge - 1.5 * Theme.gap
    // A line that has a heading is smaller than it, so that the headings alone tell what happens.
    readonly property bool led: read.some(line => line.text.includes("\n"))
    function leadOf(size: real): real {
        return !led ? size : Math.min((upright ? 1.35 : 1.2) * size, Theme.size(upright ? 54 : 48))
    }
    // The rows take the page. The last drawing ends with the cards of other pages on a wide page, and well above the way
    // on, which is below all of it, on an upright one.
    readonly property real margin: (upright ? 14 : 24) * Theme.unit
    readonly property real under: (upright ? 80 : 38) * Theme.unit - Theme.gap
    readonly property real badge: Math.max(80 * Theme.unit, Math.min((upright ? 176 : 132) * Theme.unit, 0.9 * (room - margin - under) / Math.max(1, read.length)))
    readonly property real pitch: Math.min((upright ? 400 : 260) * Theme.unit, (room - margin - under - badge) / Math.max(1, read.length - 1))
    function fitsAiry(size: real): bool {
        const heights = read.map(line => said(line.text, leadOf(size), size, airyWidth, airyLeading))
        if (led)
            // Each heading is in one line at the top of its drawing, and the last row reaches only a little below it.
            return pitch >= badge && read.every(line => widths.lines(line.text.split("\n")[0], leadOf(size), airyWidth) === 1)
                && heights[heights.length - 1] <= badge + 36 * Theme.unit && heights.every(height => height + 0.8 * Theme.gap <= pitch)
        // Lines are in the middle of their drawings, and the first and the last row reach only a little beyond them.
        return pitch >= badge && [heights[0], heights[heights.length - 1]].every(end => end <= badge + 64 * Theme.unit)
            && heights.every((height, at) => at === 0 || (heights[at - 1] + height) / 2 + 0.8 * Theme.gap <= pitch)
    }
    // How high a line is about, and its heading, if it has one.
    function said(text: string, leadSize: real, size: real, wide: real, leading: real): real {
        const at = text.indexOf("\n")
        const lines = text.slice(at + 1).split("\n").reduce((sum, part) => sum + widths.plainLines(part, size, wide), 0)
        return leading * widths.leading * ((at < 0 ? 0 : leadSize * widths.lines(text.slice(0, at), leadSize, wide)) + size * lines)
    }
    function fits(size: real): bool {
        return tall(size) + read.length * close <= (led ? 0.96 : 0.92) * room
    }
    function tall(size: real): real {
        return read.reduce((sum, line) => sum + Math.max(2.5 * size, said(line.text, size, size, (column - 2.5 * size - Theme.gap) * 0.9, 1.08)), 0)
    }

    // Where all lines have headings, and there is room for that: the first leads, those after it are steps of the visit.
    readonly property var follow: read.slice(1, aside === "" ? -1 : read.length)
    readonly property bool staged: follow.length >= 2 && follow.length <= (upright ? 4 : 3) && visit.fits
        && read.every((line, at) => line.text.split("\n").length === 2 && (at === 0 || line.sign !== ""))

    VisitSteps {
        id: visit
        visible: view.staged
        y: (view.upright ? 0 : 4) * Theme.unit
        width: view.column
        upright: view.upright
        room: view.room - y
        widths: widths
        lead: view.read[0] ?? {text: "", sign: ""}
        steps: view.follow
        last: view.aside === "" && view.read.length > 1 ? view.read[view.read.length - 1] : null
        picture: view.attract.pictures[0] ?? ""
        cardBack: view.cardBack
        cardShadow: view.cardShadow
    }
    ScrollPane {
        id: pane
        visible: !view.staged
        y: view.airy ? view.margin : view.sink(height)
        width: parent?.width ?? 0
        room: view.room
        more: view.words["scroll-more"]
        // Further apart where the page has room for it.
        spacing: view.airy ? view.pitch - view.badge : Math.max(view.close, Math.min(3 * Theme.gap, (0.92 * view.room - view.tall(view.size)) / Math.max(1, view.read.length)))
        Repeater {
            // By number, and none where they are not seen: a list that is made anew would have all rows made anew.
            model: view.staged ? 0 : view.read.length
            Item {
                id: row
                required property int index
                readonly property var said: view.read[index] ?? {text: "", sign: ""}
                width: parent?.width ?? 0
                height: view.airy ? view.badge : line.height
                // What happens one after the other is a path: not the first line, which says what is studied, nor the last,
                // which says what all of it takes.
                Rectangle {
                    objectName: "path"
                    visible: view.airy && row.index > 0 && row.index + 1 < Math.min(view.read.length, view.about.lines.length - 1)
                    x: Theme.across((view.badge - width) / 2, width, row.width)
                    y: view.badge
                    width: 4 * Theme.unit
                    height: view.pitch - view.badge
                    color: Theme.sand
                }
                SignedLine {
                    id: line
                    y: headed ? 0 : (row.height - height) / 2
                    width: row.width
                    text: row.said.text
                    sign: row.said.sign
                    // What it takes of the visitor, by which they decide.
                    strong: !view.led && row.index > 0 && view.aside === "" && row.index === view.read.length - 1
                    size: view.airy ? view.airySize : view.size
                    leadSize: view.airy ? view.leadOf(size) : size
                    badge: view.airy ? view.badge : 2.5 * size
                    centred: view.airy
                    leading: view.airy ? view.airyLeading : 1.08
                }
            }
        }
    }
}
