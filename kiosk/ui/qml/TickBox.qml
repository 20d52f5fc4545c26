// A box to tick, with its words.
import QtQuick
import QtQuick.Shapes
import "."

Choosable {
    id: box

    property string note: ""
    property string warning: ""

    padding: 8 * Theme.unit
    font.pixelSize: Theme.reading
    Accessible.role: Accessible.CheckBox
    Accessible.name: words
    Accessible.description: warning || note

    background: Rectangle {
        radius: Theme.radius
        color: box.hovered || box.down ? Theme.white : "transparent"
        FocusRing {
            around: box
            reach: 0
            radius: Theme.radius
        }
    }
    contentItem: Row {
        spacing: Theme.gap
        Rectangle {
            id: mark
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
