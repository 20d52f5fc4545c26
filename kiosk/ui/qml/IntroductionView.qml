// What the game is about, in three lines that can be read while the assistant says the same.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

Item {
    id: view

    required property IntroductionScreen introduction
    required property AttractScreen attract
    required property var words
    required property url cardBack
    required property url cardShadow

    readonly property real cardSize: 120 * Theme.unit

    component Line: Row {
        id: line
        property string text
        property string leftCard
        property string rightCard
        spacing: Theme.gap
        CardFace {
            width: view.cardSize
            height: view.cardSize
            back: view.cardBack
            shadow: view.cardShadow
            picture: line.leftCard
            up: line.leftCard !== ""
        }
        CardFace {
            width: view.cardSize
            height: view.cardSize
            back: view.cardBack
            shadow: view.cardShadow
            picture: line.rightCard
            up: line.rightCard !== ""
        }
        Text {
            anchors.verticalCenter: parent.verticalCenter
            width: Math.min(720 * Theme.unit, view.width - 2 * view.cardSize - 6 * Theme.gap)
            leftPadding: Theme.gap
            text: line.text
            font.pixelSize: Theme.body
            wrapMode: Text.WordWrap
            color: Theme.ink
        }
    }

    Column {
        anchors.centerIn: parent
        spacing: 1.6 * Theme.gap

        Text {
            text: view.words["introduction-title"]
            font { pixelSize: Theme.title; bold: true }
            color: Theme.ink
        }
        Line { text: view.words["introduction-turn"]; leftCard: view.attract.pictures[0] }
        Line {
            text: view.words["introduction-match"]
            leftCard: view.attract.pictures[2]
            rightCard: view.attract.pictures[2]
        }
        Line { text: view.words["introduction-help"]; leftCard: view.attract.pictures[4] }
        BigButton {
            objectName: "continue"
            text: view.words["introduction-continue"]
            focus: true
            onClicked: view.introduction.proceed()
        }
    }
}
