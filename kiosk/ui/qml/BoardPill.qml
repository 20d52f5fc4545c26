// A line under the cards: which card comes next, or with three dots what the board waits for.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Rectangle {
    id: pill

    required property var words
    required property real textSize
    // Whether the visitor is to turn a second card; otherwise they wait, while a sentence is said or cards turn back.
    required property bool asks
    required property bool speaking
    required property bool upright
    // How much room there is for it.
    required property real most

    readonly property Wording line: asks ? second : speaking ? sentence : back
    // What it takes with the longest of its lines: the cards keep their size whichever stands there.
    readonly property real reserved: Math.max(second.height, sentence.height, back.height) + padding
    readonly property real padding: (upright ? 20 : 6) * Theme.unit

    objectName: "pill"
    width: line.width + (asks ? 2.6 * Theme.gap : dots.width + 2.8 * Theme.gap)
    height: line.height + padding
    radius: height / 2
    color: Theme.sand
    opacity: visible ? 1 : 0
    Behavior on opacity { NumberAnimation { duration: Theme.motion } }

    Row {
        id: dots
        anchors { left: parent.left; leftMargin: Theme.gap; verticalCenter: parent.verticalCenter }
        visible: !pill.asks
        spacing: 6 * Theme.unit
        Repeater {
            model: 3
            Rectangle {
                width: 9 * Theme.unit
                height: width
                radius: width / 2
                color: Theme.ink
            }
        }
    }
    // Each is laid out once, and not in the frame in which it is wanted.
    component Wording: PlainText {
        // Whether it says what to do, which is bold everywhere.
        property bool does: false
        anchors { right: parent.right; rightMargin: (does ? 1.3 : 1.2) * Theme.gap; verticalCenter: parent.verticalCenter }
        visible: pill.line === this
        width: Math.min(implicitWidth, pill.most - dots.width - 5 * Theme.gap)
        wrapMode: width < implicitWidth ? Text.Wrap : Text.NoWrap
        font { pixelSize: pill.textSize; bold: does }
        color: Theme.ink
        Accessible.role: does ? Accessible.StaticText : Accessible.AlertMessage
        Accessible.name: text
    }
    Wording {
        id: second
        text: pill.words["game-second"]
        does: true
    }
    Wording {
        id: sentence
        text: pill.words["game-wait-speaking"]
    }
    Wording {
        id: back
        text: pill.words["game-wait-turning-back"]
    }
}
