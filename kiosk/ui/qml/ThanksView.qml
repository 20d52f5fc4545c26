// The end: a word of thanks, and a way out for those who do not want to wait.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property ThanksScreen thanks
    required property KioskScreen kiosk
    required property var words

    Column {
        anchors.centerIn: parent
        spacing: 2 * Theme.gap

        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: view.width - 4 * Theme.gap
            text: view.words["thanks-title"]
            font { pixelSize: Theme.title; bold: true }
        }
        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: Math.min(1000 * Theme.unit, view.width - 4 * Theme.gap)
            text: view.words["thanks-line"]
            font.pixelSize: Theme.heading
            color: Theme.faintInk
        }
        Item {
            width: 1
            height: Theme.gap
        }
        WayOn {
            anchors.horizontalCenter: parent.horizontalCenter
            width: Math.min(900 * Theme.unit, view.width - 4 * Theme.gap)
            kiosk: view.kiosk
            words: view.words
            quiet: true
            label: view.words["thanks-continue"]
            focus: true
            onWent: view.thanks.proceed()
        }
    }
}
