// A box to tick, with its words.
import QtQuick
import QtQuick.Shapes
import "."

Choosable {
    id: box

    // What it is, in a word or two, and whether it is to be ticked.
    property string note: ""
    property bool needed: false
    // Whether a heading above it says so instead; the box still tells it to those who cannot see it.
    property bool headed: false
    readonly property bool optional: headed && !needed
    // What stands there instead, once it is ticked.
    property string agreed: ""
    property string warning: ""
    // Whether its edge alone shows that.
    property bool terse: false
    // On a page with much height.
    property bool large: false

    horizontalPadding: (large ? 28 : 17) * Theme.unit
    font.pixelSize: large ? Theme.size(33) : Theme.reading
    Accessible.role: Accessible.CheckBox
    Accessible.name: words
    Accessible.description: warning || note

    background: Rectangle {
        radius: Theme.radius
        // What is ticked is darker; the pointer over it changes the edge alone. Below a heading, what need not be ticked is
        // as quiet as what is to be read, and its mark says that it is ticked.
        color: box.optional && !Theme.highContrast ? Theme.white : !box.on ? Theme.touchable : Theme.highContrast ? Theme.sand : Qt.tint(Theme.touchable, Qt.alpha(Theme.sea, box.headed ? 0.06 : 0.14))
        border {
            color: box.warning ? Theme.deepAmber : box.hovered || box.on || Theme.highContrast || box.needed ? Theme.sea : box.optional ? Theme.edge : Qt.tint(Theme.touchable, Qt.alpha(Theme.sea, 0.45))
            // Below a heading those that are to be ticked have a strong one until they are.
            width: (box.warning || box.hovered ? 4 : !box.headed || Theme.highContrast ? box.on ? 4 : 2 : box.on || !box.needed ? 2 : 4) * Theme.unit
        }
        FocusRing {
            around: box
            reach: 7 * Theme.unit
            radius: Theme.radius + reach
        }
    }
    contentItem: Item {
        id: parts
        // What the box is, at its right; where that leaves the words little room, and on an upright page, below them.
        readonly property real after: 0.9 * Theme.gap
        readonly property real room: box.availableWidth - mark.width - after
        readonly property string note: box.on && box.agreed !== "" ? box.agreed : box.note
        // As wide for either, so that a tick moves no words.
        readonly property real noteWidth: Math.max(tag.implicitWidth, unticked.advanceWidth, ticked.advanceWidth)
        TextMetrics {
            id: unticked
            font { family: tag.font.family; pixelSize: tag.font.pixelSize; bold: box.needed }
            text: box.note
        }
        TextMetrics {
            id: ticked
            font { family: tag.font.family; pixelSize: tag.font.pixelSize; bold: true }
            text: box.agreed
        }
        readonly property bool noted: box.note !== "" && box.warning === "" && !box.headed
        // How far the words keep from it.
        readonly property real clear: (box.large ? 2.5 : 1) * Theme.gap
        readonly property bool beside: noted && noteWidth + clear < 0.4 * room
        // A word that it is missed takes from the air above and below the words first: what is below moves little.
        readonly property real yields: box.warning === "" || box.terse ? 0 : Math.min(warned.height, Math.max(0, 2 * box.verticalPadding - 4 * Theme.unit))
        implicitHeight: Math.max(mark.height, told.height - yields)
        implicitWidth: mark.width
        Rectangle {
            id: mark
            x: Theme.across(0, width, parts.width)
            y: (parts.height - height) / 2
            width: (box.large ? 64 : 48) * Theme.unit
            height: width
            radius: 0.2 * width
            color: box.on ? Theme.sea : Theme.white
            border { color: box.warning ? Theme.deepAmber : Theme.sea; width: (box.warning ? 6 : 4) * Theme.unit }
            ClippedShape {
                anchors.fill: parent
                visible: box.on
                ShapePath {
                    strokeColor: Theme.white
                    strokeWidth: 0.125 * mark.width
                    fillColor: "transparent"
                    capStyle: ShapePath.RoundCap
                    joinStyle: ShapePath.RoundJoin
                    startX: 0.25 * mark.width; startY: 0.52 * mark.width
                    PathLine { x: 0.44 * mark.width; y: 0.71 * mark.width }
                    PathLine { x: 0.77 * mark.width; y: 0.31 * mark.width }
                }
            }
        }
        Column {
            id: told
            x: Theme.across(mark.width + parts.after, width, parts.width)
            y: (parts.height - height) / 2
            width: parts.room - (parts.beside ? parts.noteWidth + parts.clear : 0)
            // What no heading says is said over the words.
            PlainText {
                objectName: "tag"
                width: parent.width
                visible: box.optional
                text: box.note
                horizontalAlignment: LayoutMirroring.enabled ? Text.AlignLeft : undefined
                color: Theme.sea
                font { pixelSize: box.font.pixelSize; bold: true }
                Accessible.ignored: true
            }
            Balanced {
                width: parent.width
                text: box.words
                horizontalAlignment: LayoutMirroring.enabled ? Text.AlignLeft : undefined
                font: box.font
                Accessible.ignored: true
            }
            Text {
                id: warned
                textFormat: Text.PlainText
                width: parent.width
                visible: text !== ""
                text: box.warning && !box.terse ? box.warning : (box.headed || parts.beside ? "" : parts.note)
                horizontalAlignment: LayoutMirroring.enabled ? Text.AlignLeft : undefined
                font { pixelSize: Theme.small; bold: box.warning !== "" || box.needed }
                wrapMode: Text.Wrap
                color: box.warning ? Theme.deepAmber : Theme.faintInk
            }
        }
        // A text and no more: with a frame it would look like a button.
        Text {
            id: tag
            visible: parts.beside
            x: Theme.across(parts.width - width, width, parts.width)
            y: (parts.height - height) / 2
            textFormat: Text.PlainText
            text: parts.note
            font { pixelSize: box.large ? Theme.size(30) : Theme.small; bold: box.needed || text !== box.note }
            color: box.on || box.needed ? Theme.sea : Theme.faintInk
            Accessible.ignored: true
        }
    }
}
