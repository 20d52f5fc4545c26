// What the game is about, in three lines that can be read while the assistant says the same.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property IntroductionScreen introduction
    required property AttractScreen attract
    required property KioskScreen kiosk
    required property var words
    required property url cardBack
    required property url cardShadow

    readonly property real cardSize: 120 * Theme.unit

    component Rule: Row {
        id: rule
        property string text
        property string leftCard
        property string rightCard
        spacing: Theme.gap
        CardFace {
            width: view.cardSize
            height: view.cardSize
            back: view.cardBack
            shadow: view.cardShadow
            picture: rule.leftCard
            up: rule.leftCard !== ""
        }
        CardFace {
            width: view.cardSize
            height: view.cardSize
            back: view.cardBack
            shadow: view.cardShadow
            picture: rule.rightCard
            up: rule.rightCard !== ""
        }
        PlainText {
            anchors.verticalCenter: parent.verticalCenter
            width: Math.min(720 * Theme.unit, view.width - 2 * view.cardSize - 6 * Theme.gap)
            leftPadding: Theme.gap
            text: rule.text
            font.pixelSize: Theme.body
            wrapMode: Text.Wrap
            color: Theme.ink
        }
    }

    Column {
        anchors.centerIn: parent
        spacing: 1.6 * Theme.gap

        Line {
            id: title
            room: view.width - 4 * Theme.gap
            text: view.words["introduction-title"]
            font { pixelSize: Theme.title; bold: true }
        }
        Rule { id: turn; text: view.words["introduction-turn"]; leftCard: view.attract.pictures[0] }
        Rule {
            text: view.words["introduction-match"]
            leftCard: view.attract.pictures[2]
            rightCard: view.attract.pictures[2]
        }
        Rule {
            visible: view.introduction.helped
            text: view.words["introduction-help"]
            leftCard: view.attract.pictures[4]
        }
        WayOn {
            // Not the column's: that follows the widest of what it holds, and would never become narrower again.
            width: Math.max(title.width, turn.width)
            kiosk: view.kiosk
            words: view.words
            label: view.words["introduction-continue"]
            focus: true
            onWent: view.introduction.proceed()
        }
    }
}
