// Whether the visitor is old enough; both answers look the same.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property AgeScreen age
    required property KioskScreen kiosk
    required property var words

    onVisibleChanged: yes.focus = true

    Column {
        anchors.centerIn: parent
        spacing: 2 * Theme.gap

        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: Math.min(1200 * Theme.unit, view.width - 4 * Theme.gap)
            text: view.age.question
            font { pixelSize: Theme.title; bold: true }
        }
        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: Math.min(900 * Theme.unit, view.width - 4 * Theme.gap)
            text: view.words["age-line"]
            font.pixelSize: Theme.body
            color: Theme.faintInk
        }
        Grid {
            id: answers
            // Both are as wide as the longer one needs; side by side, or where that is too wide, one above the other.
            readonly property real room: view.width - 4 * Theme.gap
            readonly property real wish: Math.min(room, Math.max(yes.implicitWidth, no.implicitWidth, 280 * Theme.unit))
            anchors.horizontalCenter: parent.horizontalCenter
            columns: 2 * wish + spacing <= room ? 2 : 1
            topPadding: Theme.gap
            spacing: 2 * Theme.gap
            BigButton {
                id: yes
                objectName: "age-yes"
                width: answers.wish
                words: view.words["age-yes"]
                font.pixelSize: Theme.heading
                focus: true
                onClicked: view.age.answer(true)
            }
            BigButton {
                id: no
                objectName: "age-no"
                width: answers.wish
                words: view.words["age-no"]
                font.pixelSize: Theme.heading
                onClicked: view.age.answer(false)
            }
        }
        WayOn {
            width: Math.min(900 * Theme.unit, view.width - 4 * Theme.gap)
            anchors.horizontalCenter: parent.horizontalCenter
            kiosk: view.kiosk
            words: view.words
        }
    }
}
