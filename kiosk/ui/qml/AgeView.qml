// Whether the visitor is old enough; both answers look the same.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property AgeScreen age

    title: age.question
    onVisibleChanged: yes.focus = true

    Column {
        y: view.sink(height)
        width: parent?.width ?? 0
        spacing: 2 * Theme.gap

        PlainText {
            width: parent.width
            text: view.words["age-line"]
            font.pixelSize: Theme.size(view.width < view.height ? 42 : 36)
            lineHeight: 1.08
            wrapMode: Text.Wrap
            color: Theme.faintInk
        }
        Grid {
            id: answers
            // Both are as wide as the longer one needs; side by side, or where that is too wide, one above the other.
            readonly property bool abreast: 2 * Math.max(yes.implicitWidth, no.implicitWidth) + spacing <= width
            readonly property real wish: abreast ? (width - spacing) / 2 : width
            width: parent.width
            columns: abreast ? 2 : 1
            spacing: 1.5 * Theme.gap
            BigButton {
                id: yes
                objectName: "age-yes"
                width: answers.wish
                height: Math.max(implicitHeight, (!answers.abreast ? 200 : view.width < view.height ? 520 : 320) * Theme.unit)
                words: view.words["age-yes"]
                font.pixelSize: Theme.size(96)
                focus: true
                onClicked: view.age.answer(true)
            }
            BigButton {
                id: no
                objectName: "age-no"
                width: answers.wish
                height: yes.height
                words: view.words["age-no"]
                font.pixelSize: Theme.size(96)
                onClicked: view.age.answer(false)
            }
        }
    }
}
