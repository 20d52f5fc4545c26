// What the study is about.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property AboutScreen about
    required property ReturnScreen returning

    aside: sayable(about.lines)
    readonly property var read: aside === "" ? about.lines : about.lines.slice(0, -1)

    title: about.title
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
    readonly property real airySize: (upright ? [42, 40, 38, 36] : led ? [38, 37, 36] : [46, 44, 42, 40, 38, 36]).map(Theme.size).find(size => fitsAiry(size)) ?? 0
    // A line that has a heading is smaller than it, so that the headings alone tell what happens.
    readonly property bool led: read.some(line => line.text.includes("\n"))
    readonly property real larger: led ? 1.2 : 1
    // The rows take the page: the first drawing begins where the cards of other pages do, and the last one ends with them.
    readonly property real margin: 14 * Theme.unit
    readonly property real badge: Math.max(80 * Theme.unit, Math.min((upright ? 176 : 150) * Theme.unit, 0.9 * (room - 2 * margin) / Math.max(1, read.length)))
    readonly property real pitch: Math.min((upright ? 400 : 260) * Theme.unit, (room - 2 * margin - badge) / Math.max(1, read.length - 1))
    function fitsAiry(size: real): bool {
        return pitch >= badge && read.every(line => said(line.text, larger * size, size, column - badge - 1.5 * Theme.gap) <= Math.min(pitch - 0.3 * Theme.gap, badge + 2 * margin))
    }
    // How high a line is about, and its heading, if it has one.
    function said(text: string, leadSize: real, size: real, wide: real): real {
        const at = text.indexOf("\n")
        const lines = text.slice(at + 1).split("\n").reduce((sum, part) => sum + widths.plainLines(part, size, wide), 0)
        return (at < 0 ? 0 : 1.48 * leadSize * widths.lines(text.slice(0, at), leadSize, wide)) + 1.48 * size * lines
    }
    function fits(size: real): bool {
        return tall(size) + read.length * close <= (led ? 0.96 : 0.92) * room
    }
    function tall(size: real): real {
        return read.reduce((sum, line) => sum + Math.max(2.5 * size, said(line.text, size, size, (column - 2.5 * size - Theme.gap) * 0.9)), 0)
    }

    ScrollPane {
        id: pane
        y: view.airy ? view.margin : view.sink(height)
        width: parent?.width ?? 0
        room: view.room
        more: view.words["scroll-more"]
        // Further apart where the page has room for it.
        spacing: view.airy ? view.pitch - view.badge : Math.max(view.close, Math.min(3 * Theme.gap, (0.92 * view.room - view.tall(view.size)) / Math.max(1, view.read.length)))
        Repeater {
            model: view.read
            Item {
                id: row
                required property int index
                required property var modelData
                width: parent?.width ?? 0
                height: view.airy ? view.badge : line.height
                SignedLine {
                    id: line
                    y: (row.height - height) / 2
                    width: row.width
                    text: row.modelData.text
                    sign: row.modelData.sign
                    // What it takes of the visitor, by which they decide.
                    strong: !view.led && row.index > 0 && view.aside === "" && row.index === view.read.length - 1
                    size: view.airy ? view.airySize : view.size
                    leadSize: view.airy ? view.larger * size : size
                    badge: view.airy ? view.badge : 2.5 * size
                    centred: view.airy
                }
            }
        }
    }
}
