// Whether the visitor is old enough; both answers look the same, and say what they mean.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property AgeScreen age

    title: age.question
    onVisibleChanged: yes.focus = true

    component Answer: BigButton {
        id: answer
        // What the short word means here.
        required property string meaning
        readonly property real inside: answers.wish - 2 * horizontalPadding

        width: answers.wish
        height: answers.tall
        horizontalPadding: 32 * Theme.unit
        font.pixelSize: Theme.size(84)
        Accessible.description: meaning
        contentItem: Item {
            implicitWidth: Math.max(short.implicitWidth, long.implicitWidth)
            implicitHeight: both.height
            Column {
                id: both
                anchors.centerIn: parent
                spacing: 0.5 * Theme.gap
                PlainText {
                    id: short
                    anchors.horizontalCenter: parent.horizontalCenter
                    text: answer.words
                    font: answer.font
                    color: Theme.white
                    Accessible.ignored: true
                }
                Balanced {
                    id: long
                    width: answer.inside
                    horizontalAlignment: Text.AlignHCenter
                    text: answer.meaning
                    font.pixelSize: Theme.size(38)
                    color: Theme.white
                    Accessible.ignored: true
                }
            }
        }
    }

    Column {
        // Close to the question that it explains.
        y: Math.max(0, Math.min(0.7 * Theme.gap, view.room - height))
        width: parent?.width ?? 0
        spacing: 2 * Theme.gap

        Balanced {
            width: parent.width
            text: view.words["age-line"]
            horizontalAlignment: Text.AlignLeft
            font.pixelSize: Theme.size(view.width < view.height ? 42 : 36)
            lineHeight: 1.08
            color: Theme.faintInk
        }
        Grid {
            id: answers
            // Side by side, or where large words are too wide for that, one above the other.
            readonly property bool abreast: Theme.textSize <= 1.15 || view.column > 1000 * Theme.unit
            readonly property real wish: abreast ? (width - spacing) / 2 : width
            // How high they are at least; large texts need the room themselves.
            readonly property bool airy: Theme.textSize <= 1.15
            readonly property real least: !abreast ? 260 : view.width < view.height ? (airy ? 560 : 440) : airy ? 400 : 320
            readonly property real tall: Math.max(yes.implicitHeight, no.implicitHeight, least * Theme.unit)
            width: parent.width
            columns: abreast ? 2 : 1
            spacing: 1.5 * Theme.gap
            Answer {
                id: yes
                objectName: "age-yes"
                words: view.words["age-yes"]
                meaning: view.age.older
                focus: true
                onClicked: view.age.answer(true)
            }
            Answer {
                id: no
                objectName: "age-no"
                words: view.words["age-no"]
                meaning: view.age.younger
                onClicked: view.age.answer(false)
            }
        }
    }
}
