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
    // No less than the lines above it; large texts need the room themselves.
    way.size: Theme.textSize > 1.15 ? Theme.body : Theme.size(40)
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
        y: view.sink(height)
        width: parent?.width ?? 0
        room: view.room
        more: view.words["scroll-more"]
        // Further apart where the page has room for it.
        spacing: Math.max(view.close, Math.min(3 * Theme.gap, (0.92 * view.room - view.tall(view.size)) / Math.max(1, view.read.length)))
        Repeater {
            model: view.read
            SignedLine {
                required property int index
                required property var modelData
                width: parent?.width ?? 0
                text: modelData.text
                sign: modelData.sign
                // What it takes of the visitor, by which they decide.
                strong: index > 0 && view.aside === "" && index === view.read.length - 1
                size: view.size
            }
        }
    }
}
