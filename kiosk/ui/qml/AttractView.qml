// What draws people in: a fan of cards that turn one after another, a title, and one button.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property AttractScreen attract
    required property var words
    required property url cardBack
    required property url cardShadow

    readonly property real cardSize: Math.min(width / 7.4, height / 4)

    Column {
        anchors.centerIn: parent
        spacing: 2 * Theme.gap

        Grid {
            anchors.horizontalCenter: parent.horizontalCenter
            columns: 6
            spacing: view.cardSize * 0.12
            Repeater {
                model: view.attract.pictures
                CardFace {
                    required property int index
                    required property string modelData
                    width: view.cardSize
                    height: view.cardSize
                    back: view.cardBack
                    shadow: view.cardShadow
                    picture: modelData
                    up: view.attract.shown === index
                }
            }
        }
        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: view.width - 4 * Theme.gap
            topPadding: Theme.gap
            text: view.words["attract-title"]
            font { pixelSize: Theme.title; bold: true }
        }
        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: view.width - 4 * Theme.gap
            text: view.words["attract-line"]
            font.pixelSize: Theme.body
            color: Theme.faintInk
        }
        BigButton {
            objectName: "start"
            anchors.horizontalCenter: parent.horizontalCenter
            text: view.words["attract-start"]
            font.pixelSize: Theme.heading
            focus: true
            onClicked: view.attract.start()
        }
    }
}
