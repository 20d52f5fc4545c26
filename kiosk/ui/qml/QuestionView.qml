// One question and its scale. Nothing is chosen beforehand, and nobody has to answer.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import Recollect
import "."

FocusScope {
    id: view

    required property QuestionScreen question
    required property var words

    readonly property real answerSize: Math.min(132 * Theme.unit, (width - 4 * Theme.gap) / (question.points * 1.25))

    Column {
        anchors.centerIn: parent
        spacing: 2.4 * Theme.gap

        Text {
            anchors.horizontalCenter: parent.horizontalCenter
            text: view.question.progress
            font.pixelSize: Theme.small
            color: Theme.faintInk
        }
        Line {
            anchors.horizontalCenter: parent.horizontalCenter
            room: Math.min(1100 * Theme.unit, view.width - 4 * Theme.gap)
            text: view.question.text
            font { pixelSize: Theme.heading; bold: true }
        }
        Column {
            anchors.horizontalCenter: parent.horizontalCenter
            spacing: 0.6 * Theme.gap
            Row {
                id: scale
                spacing: view.answerSize * 0.25
                Repeater {
                    model: view.question.points
                    RoundButton {
                        id: answer
                        required property int index
                        readonly property int value: index + 1
                        readonly property bool chosen: view.question.chosen === value
                        objectName: "answer-" + value
                        focus: index === 0
                        width: view.answerSize
                        height: view.answerSize
                        text: value
                        font { pixelSize: Theme.heading; bold: true }
                        scale: down ? 0.96 : 1
                        Accessible.checked: chosen
                        onClicked: view.question.choose(value)
                        Keys.onLeftPressed: nextItemInFocusChain(false).forceActiveFocus(Qt.BacktabFocusReason)
                        Keys.onRightPressed: nextItemInFocusChain().forceActiveFocus(Qt.TabFocusReason)
                        Keys.onReturnPressed: event => { if (!event.isAutoRepeat) clicked() }
                        Keys.onEnterPressed: event => { if (!event.isAutoRepeat) clicked() }
                        contentItem: Text {
                            text: answer.text
                            font: answer.font
                            color: answer.chosen ? Theme.white : Theme.ink
                            horizontalAlignment: Text.AlignHCenter
                            verticalAlignment: Text.AlignVCenter
                        }
                        background: Rectangle {
                            radius: width / 2
                            color: answer.chosen ? Theme.sea : answer.hovered ? Theme.sand : Theme.white
                            border.color: answer.visualFocus ? Theme.ink : Theme.sea
                            border.width: (answer.visualFocus ? 9 : 4) * Theme.unit
                        }
                    }
                }
            }
            Item {
                width: scale.width
                height: lowest.height
                Text {
                    id: lowest
                    anchors.left: parent.left
                    text: view.words["questions-lowest"]
                    font.pixelSize: Theme.small
                    color: Theme.faintInk
                }
                Text {
                    anchors.right: parent.right
                    text: view.words["questions-highest"]
                    font.pixelSize: Theme.small
                    color: Theme.faintInk
                }
            }
        }
        BigButton {
            objectName: "continue"
            anchors.horizontalCenter: parent.horizontalCenter
            quiet: view.question.chosen === 0
            text: view.words[quiet ? "questions-skip" : view.question.last ? "questions-finish" : "questions-next"]
            onClicked: view.question.proceed()
        }
    }
}
