// A box to tick, with its words.
import QtQuick
import QtQuick.Shapes
import "."

Choosable {
    id: box

    property string note: ""
    property string warning: ""

    horizontalPadding: 0.7 * Theme.gap
    verticalPadding: 0.45 * Theme.gap
    font.pixelSize: Theme.reading
    Accessible.role: Accessible.CheckBox
    Accessible.name: words
    Accessible.description: warning || note

    background: Rectangle {
        radius: Theme.radius
        // Only what is ticked is filled; the pointer over it changes the edge alone.
        color: box.on ? Theme.sand : Theme.white
        border { color: box.warning ? Theme.deepAmber : Theme.sea; width: (box.warning || box.hovered ? 4 : 2) * Theme.unit }
        FocusRing {
            around: box
            reach: 7 * Theme.unit
            radius: Theme.radius + reach
        }
    }
    contentItem: Row {
        spacing: Theme.gap
        Rectangle {
            id: mark
            anchors.verticalCenter: parent.verticalCenter
            width: 48 * Theme.unit
            height: width
            radius: 10 * Theme.unit
            color: box.on ? Theme.sea : Theme.white
            border { color: box.warning ? Theme.deepAmber : Theme.sea; width: (box.warning ? 6 : 4) * Theme.unit }
            Shape {
                anchors.fill: parent
                visible: box.on
                ShapePath {
                    strokeColor: Theme.white
                    strokeWidth: 6 * Theme.unit
                    fillColor: "transparent"
                    capStyle: ShapePath.RoundCap
                    joinStyle: ShapePath.RoundJoin
                    startX: 12 * Theme.unit; startY: 25 * Theme.unit
                    PathLine { x: 21 * Theme.unit; y: 34 * Theme.unit }
                    PathLine { x: 37 * Theme.unit; y: 15 * Theme.unit }
                }
            }
        }
        Column {
            anchors.verticalCenter: parent.verticalCenter
            width: box.availableWidth - mark.width - parent.spacing
            Text {
                textFormat: Text.PlainText
                width: parent.width
                text: box.words
                font: box.font
                wrapMode: Text.Wrap
                color: Theme.ink
            }
            Text {
                textFormat: Text.PlainText
                width: parent.width
                visible: text !== ""
                text: box.warning || box.note
                font { pixelSize: Theme.small; bold: box.warning !== "" }
                wrapMode: Text.Wrap
                color: box.warning ? Theme.deepAmber : Theme.faintInk
            }
        }
    }
}
