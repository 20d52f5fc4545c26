// The end: a word of thanks, and a way out for those who do not want to wait.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property ThanksScreen thanks
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
        BigButton {
            objectName: "continue"
            most: view.width - 4 * Theme.gap
            anchors.horizontalCenter: parent.horizontalCenter
            quiet: true
            words: view.words["thanks-continue"]
            focus: true
            onClicked: view.thanks.proceed()
        }
    }
}
