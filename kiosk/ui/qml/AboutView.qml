// What the study is about.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property AboutScreen about

    title: about.title
    label: words["about-continue"]
    onWent: about.proceed()
    // Whatever the last visitor's keyboard was at, the next one's is at the button.
    onVisibleChanged: way.focus = true
    Keys.onPressed: event => pane.turn(event)

    ScrollPane {
        id: pane
        y: view.sink(height)
        width: parent?.width ?? 0
        room: view.room
        more: view.words["scroll-more"]
        spacing: 1.8 * Theme.gap
        Repeater {
            model: view.about.lines
            SignedLine {
                required property int index
                required property var modelData
                width: parent?.width ?? 0
                text: modelData.text
                sign: modelData.sign
                // What it takes of the visitor, by which they decide.
                strong: index > 0 && index === view.about.lines.length - 1
                size: Theme.size(36)
            }
        }
    }
}
