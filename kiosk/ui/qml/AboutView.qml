// What the study is about.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property AboutScreen about
    required property KioskScreen kiosk
    required property var words

    // Whatever the last visitor's keyboard was at, the next one's is at the button.
    onVisibleChanged: go.focus = true
    Keys.onPressed: event => pane.turn(event)

    Column {
        anchors.centerIn: parent
        width: Math.min(1000 * Theme.unit, view.width - 4 * Theme.gap)
        spacing: 2 * Theme.gap

        PlainText {
            id: title
            width: parent.width
            text: view.about.title
            font { pixelSize: Theme.title; bold: true }
            wrapMode: Text.Wrap
            color: Theme.ink
        }
        ScrollPane {
            id: pane
            width: parent.width
            room: view.height - title.height - go.height - 8 * Theme.gap
            more: view.words["scroll-more"]
            Paragraphs {
                width: parent.width
                spacing: Theme.gap
                texts: view.about.paragraphs
                size: Theme.body
            }
        }
        WayOn {
            id: go
            width: parent.width
            kiosk: view.kiosk
            words: view.words
            label: view.words["about-continue"]
            focus: true
            onWent: view.about.proceed()
        }
    }
}
