// A box to tick, with its words.
import QtQuick
import QtQuick.Shapes
import "."

Choosable {
    id: box

    property string note: ""
    property string warning: ""
    // Where there is height for it.
    property bool roomy: false
    // On an upright page with much height.
    property bool broad: false
    // On a page with much height.
    property bool large: false

    horizontalPadding: (broad ? 0.85 : 0.7) * Theme.gap
    verticalPadding: (broad ? 1.1 : roomy ? 0.7 : 0.45) * Theme.gap
    font.pixelSize: large ? Theme.size(36) : Theme.reading
    Accessible.role: Accessible.CheckBox
    Accessible.name: words
    Accessible.description: warning || note

    background: Rectangle {
        radius: Theme.radius
        // Only what is ticked is filled; the pointer over it changes the edge alone.
        color: box.on ? Theme.sand : Theme.white
        border { color: box.warning ? Theme.deepAmber : Theme.sea; width: (box.warning || box.hovered || box.on ? 4 : 2) * Theme.unit }
        FocusRing {
            around: box
            reach: 7 * Theme.unit
            radius: Theme.radius + reach
        }
    }
    contentItem: Item {
        id: parts
        // What the box is, at its right; where that leaves the words little room, below them.
        readonly property real after: (box.broad ? 0.7 : 1) * Theme.gap
        readonly property real room: box.availableWidth - mark.width - after
        readonly property bool beside: tag.visible
        implicitHeight: Math.max(box.large ? 76 * Theme.unit : mark.height, told.height)
        implicitWidth: mark.width
        Rectangle {
            id: mark
            x: Theme.across(0, width, parts.width)
            y: (parts.height - height) / 2
            width: 48 * Theme.unit
            height: width
            radius: 10 * Theme.unit
            color: box.on ? Theme.sea : Theme.white
            border { color: box.warning ? Theme.deepAmber : Theme.sea; width: (box.warning ? 6 : 4) * Theme.unit }
            ClippedShape {
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
            id: told
            x: Theme.across(mark.width + parts.after, width, parts.width)
            y: (parts.height - height) / 2
            width: parts.room - (parts.beside ? tag.implicitWidth + Theme.gap : 0)
            Balanced {
                width: parent.width
                text: box.words
                horizontalAlignment: LayoutMirroring.enabled ? Text.AlignLeft : undefined
                font: box.font
                Accessible.ignored: true
            }
            Text {
                textFormat: Text.PlainText
                width: parent.width
                visible: text !== ""
                text: box.warning || (parts.beside ? "" : box.note)
                horizontalAlignment: LayoutMirroring.enabled ? Text.AlignLeft : undefined
                font { pixelSize: Theme.small; bold: box.warning !== "" }
                wrapMode: Text.Wrap
                color: box.warning ? Theme.deepAmber : Theme.faintInk
            }
        }
        Text {
            id: tag
            visible: box.note !== "" && box.warning === "" && implicitWidth + Theme.gap < 0.4 * parts.room
            textFormat: Text.PlainText
            x: Theme.across(parts.width - width, width, parts.width)
            y: (parts.height - height) / 2
            text: box.note
            // It has been done; its place stays, so that the words do not move.
            opacity: box.on ? 0 : 1
            font { pixelSize: Theme.small; bold: true }
            color: Theme.faintInk
        }
    }
}
