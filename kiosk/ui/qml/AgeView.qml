// Whether the visitor is old enough; both answers look the same, and say what they mean.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property AgeScreen age

    title: age.question
    // On an upright page, where the answers are as large as half of it, a short question has large letters too.
    titleSize: !upright || Theme.textSize > 1 ? Theme.pageTitle : widths.largestInOneLine(title, [...[88, 84, 80, 76, 72].map(Theme.size), Theme.pageTitle], 0.98 * (column - cornered))
    WordWidths { id: widths }
    aside: accompanied ? words["age-line"] : ""
    onVisibleChanged: yes.focus = true

    // Each answer has a picture where the page is high enough for it.
    readonly property bool upright: width < height
    readonly property bool pictured: upright ? room > 1000 * Theme.unit && Theme.textSize <= 1.15 : accompanied && room > 640 * Theme.unit
    // How large everything in an answer is, on a screen that has the room for it.
    readonly property real scaled: !pictured ? 1 : upright ? 2.1 : Math.max(1, Math.min(1.65, (room / Theme.unit - 110 - 300 * Theme.textSize) / 190))

    component Answer: BigButton {
        id: answer
        // What the short word means here.
        required property string meaning
        // Whether a child is drawn beside it.
        property bool child: false
        readonly property real inside: answers.wish - 2 * horizontalPadding
        readonly property alias lines: long.implicitHeight

        width: answers.wish
        height: answers.tall
        horizontalPadding: (view.upright ? 24 : 32) * Theme.unit
        verticalPadding: 26 * Theme.unit
        corner: view.pictured ? 2 * Theme.radius : Infinity
        font.pixelSize: Theme.size(84 * Math.min(1.45, view.scaled))
        Accessible.description: meaning
        contentItem: Item {
            implicitWidth: Math.max(short.implicitWidth, long.implicitWidth)
            implicitHeight: both.height
            Column {
                id: both
                // As much air above the picture as below the last line's letters, under which a line has room of its own.
                anchors { centerIn: parent; verticalCenterOffset: view.pictured ? 0.15 * long.font.pixelSize : 0 }
                spacing: (view.pictured && view.upright ? 1.4 : 0.5) * Theme.gap
                Item {
                    anchors.horizontalCenter: parent.horizontalCenter
                    visible: view.pictured
                    width: 190 * view.scaled * Theme.unit
                    height: width + 14 * Theme.unit
                    Rectangle {
                        width: parent.width
                        height: width
                        radius: width / 2
                        color: Theme.white
                        Person {
                            anchors.centerIn: parent
                            scale: 0.62 * view.scaled * Theme.unit
                            child: answer.child
                        }
                    }
                }
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
                    // As high in both, so that all of them stands on the same lines.
                    height: Math.max(yes.lines, no.lines)
                    horizontalAlignment: Text.AlignHCenter
                    text: answer.meaning
                    font.pixelSize: Theme.size(view.pictured && !view.upright ? 44 : 38)
                    color: Theme.white
                    Accessible.ignored: true
                }
            }
        }
    }

    Column {
        id: page
        // Close to the question that it explains.
        y: told.visible ? Math.max(0, Math.min(0.7 * Theme.gap, view.room - height)) : view.pictured ? 0.6 * Theme.gap : 0
        width: parent?.width ?? 0
        spacing: 2 * Theme.gap

        Balanced {
            id: told
            width: parent.width
            visible: view.aside === ""
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
            // With pictures they take what the page has left.
            readonly property real filling: view.upright ? Math.min(1000, (view.room - told.height - page.spacing) / Theme.unit - 34)
                : Math.min(760, view.room / Theme.unit - 30)
            readonly property real least: view.pictured ? filling : !abreast ? Math.max(260, Math.min(400, (filling - spacing / Theme.unit) / 2)) : view.width < view.height ? (airy ? 560 : 440) : airy ? 400 : 320
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
                child: true
                onClicked: view.age.answer(false)
            }
        }
    }
}
