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
    // Beside the helper each line is a card with a large drawing, where the page has room for that.
    readonly property bool upright: width < height
    readonly property bool framed: (upright ? Theme.textSize <= 1.15 : aside !== "") && read.every(line => line.sign !== "") && framedSize > 0
    readonly property real framedSize: (upright ? [52, 50, 48, 46, 44, 42, 40, 38, 36] : [44, 42, 40, 38, 36]).map(Theme.size).find(size => fitsFramed(size)) ?? 0
    // The cards are as high as each other, and take the page; their drawings are as large as that leaves.
    readonly property real cardHigh: Math.min((upright ? 400 : 260) * Theme.unit, (0.98 * room - (read.length - 1) * Theme.gap) / Math.max(1, read.length))
    readonly property real badge: Math.min((upright ? 150 : 168) * Theme.unit, 0.74 * cardHigh)
    readonly property real margin: Math.min(1.5 * Theme.gap, 0.2 * cardHigh)
    function fitsFramed(size: real): bool {
        return badge >= 80 * Theme.unit && read.every(line => Math.ceil(letters.advanceWidth(line.text) * size / 100
            / ((column - badge - 2 * margin - Theme.gap) * 0.94)) * 1.5 * size + 0.16 * cardHigh <= cardHigh)
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
        y: view.framed ? 0 : view.sink(height)
        width: parent?.width ?? 0
        room: view.room
        more: view.words["scroll-more"]
        // Further apart where the page has room for it.
        spacing: view.framed ? Theme.gap : Math.max(view.close, Math.min(3 * Theme.gap, (0.92 * view.room - view.tall(view.size)) / Math.max(1, view.read.length)))
        Repeater {
            model: view.read
            Rectangle {
                id: card
                required property int index
                required property var modelData
                width: parent?.width ?? 0
                height: view.framed ? view.cardHigh : line.height
                radius: Theme.radius
                color: view.framed ? Theme.white : "transparent"
                border { color: Theme.edge; width: view.framed ? 3 * Theme.unit : 0 }
                SignedLine {
                    id: line
                    x: view.framed ? view.margin : 0
                    y: (card.height - height) / 2
                    width: card.width - 2 * x
                    text: card.modelData.text
                    sign: card.modelData.sign
                    // What it takes of the visitor, by which they decide.
                    strong: card.index > 0 && view.aside === "" && card.index === view.read.length - 1
                    size: view.framed ? view.framedSize : view.size
                    badge: view.framed ? view.badge : 2.5 * size
                    centred: view.framed
                }
            }
        }
    }
}
