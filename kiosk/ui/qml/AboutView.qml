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
    readonly property real close: 1.8 * Theme.gap
    FontMetrics {
        id: letters
        font.pixelSize: 100
    }
    readonly property real size: [50, 46, 42, 38].map(Theme.size).find(size => fits(size)) ?? Theme.size(36)
    // Beside the helper each line has a large drawing, where the page has room for that. Nothing is around it: it is no button.
    readonly property bool upright: width < height
    readonly property bool airy: (upright ? Theme.textSize <= 1.15 : aside !== "") && read.every(line => line.sign !== "") && airySize > 0
    readonly property real airySize: (upright ? [42, 40, 38, 36] : [46, 44, 42, 40, 38, 36]).map(Theme.size).find(size => fitsAiry(size)) ?? 0
    // The rows are as high as each other, and take the page; their drawings are as large as that leaves.
    readonly property real rowHigh: Math.min((upright ? 400 : 260) * Theme.unit, (0.98 * room - (read.length - 1) * Theme.gap) / Math.max(1, read.length))
    readonly property real badge: Math.min((upright ? 176 : 160) * Theme.unit, 0.9 * rowHigh)
    function fitsAiry(size: real): bool {
        return badge >= 80 * Theme.unit && read.every(line => Math.ceil(letters.advanceWidth(line.text) * size / 100
            / ((column - badge - 1.5 * Theme.gap) * 0.94)) * 1.5 * size <= rowHigh)
    }
    function fits(size: real): bool {
        return tall(size) + read.length * close <= 0.92 * room
    }
    function tall(size: real): real {
        const wide = (column - 2.5 * size - Theme.gap) * 0.88
        return read.reduce((sum, line) =>
            sum + Math.max(2.5 * size, Math.ceil(letters.advanceWidth(line.text) * size / 100 / wide) * 1.5 * size), 0)
    }

    ScrollPane {
        id: pane
        y: view.airy ? 0 : view.sink(height)
        width: parent?.width ?? 0
        room: view.room
        more: view.words["scroll-more"]
        // Further apart where the page has room for it.
        spacing: view.airy ? Theme.gap : Math.max(view.close, Math.min(3 * Theme.gap, (0.92 * view.room - view.tall(view.size)) / Math.max(1, view.read.length)))
        Repeater {
            model: view.read
            Item {
                id: row
                required property int index
                required property var modelData
                width: parent?.width ?? 0
                height: view.airy ? view.rowHigh : line.height
                SignedLine {
                    id: line
                    y: (row.height - height) / 2
                    width: row.width
                    text: row.modelData.text
                    sign: row.modelData.sign
                    // What it takes of the visitor, by which they decide.
                    strong: row.index > 0 && view.aside === "" && row.index === view.read.length - 1
                    size: view.airy ? view.airySize : view.size
                    badge: view.airy ? view.badge : 2.5 * size
                    centred: view.airy
                }
            }
        }
    }
}
