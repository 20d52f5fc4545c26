// A button of the panel: as tall as a finger needs, and the same by mouse, touch and keyboard. Arrows go around, as Tab does.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import ".."

Button {
    id: button

    // What it says, and to those who cannot see it too. Not its text: "&" in that makes a shortcut of the letter behind.
    required property string words
    // The one of several that holds; or what is on, and whose words then say how to end it.
    property bool chosen: false
    property bool choosable: false
    // What is pressed most, and must be found at a glance.
    property bool filled: false
    // The keyboard's ring takes the place of the edge, where the button ends at the page's margin.
    property bool ringInPlace: false
    // What takes something from a visitor.
    property bool grave: false
    // Whether the next one before it or after it goes on at once: it has no round corners there.
    property bool joinedBefore: false
    property bool joinedAfter: false
    property real least: 68 * Theme.unit
    readonly property color tone: grave ? Theme.deepAmber : Theme.sea
    property bool solid: chosen || (filled && enabled)
    // What lies below its words while it is not solid.
    property color ground: Theme.paper
    readonly property real corner: Math.min(height / 2, 60 * Theme.unit)
    property int alignment: Text.AlignHCenter
    // The lines of a small drawing before its words, on a square of 24; none without.
    property string drawing: ""
    property real sign: drawing === "" ? 0 : 1.45 * font.pixelSize
    property color front: solid ? Theme.white : enabled ? tone : Theme.faintInk

    width: Math.min(Math.ceil(implicitWidth), parent?.width ?? Infinity)
    height: Math.max(least, implicitHeight)
    Accessible.name: words
    focusPolicy: Qt.StrongFocus
    horizontalPadding: 24 * Theme.unit
    verticalPadding: 9 * Theme.unit
    font { pixelSize: Theme.dense; bold: solid || grave }
    checkable: choosable
    checked: choosable && chosen
    onCheckedChanged: if (checked !== (choosable && chosen)) checked = Qt.binding(() => button.choosable && button.chosen)
    Accessible.onPressAction: clicked()
    Accessible.onToggleAction: clicked()

    Keys.onReturnPressed: event => { if (!event.isAutoRepeat) clicked() }
    Keys.onEnterPressed: event => { if (!event.isAutoRepeat) clicked() }
    Keys.onRightPressed: nextItemInFocusChain(true).forceActiveFocus(Qt.TabFocusReason)
    Keys.onDownPressed: nextItemInFocusChain(true).forceActiveFocus(Qt.TabFocusReason)
    Keys.onLeftPressed: nextItemInFocusChain(false).forceActiveFocus(Qt.BacktabFocusReason)
    Keys.onUpPressed: nextItemInFocusChain(false).forceActiveFocus(Qt.BacktabFocusReason)

    contentItem: Item {
        id: parts
        readonly property real before: button.sign > 0 ? button.sign + 0.5 * button.font.pixelSize : 0
        readonly property real start: Math.max(0, (width - before - needed) / 2)
        readonly property real needed: wide(button.words, natural.font)
        implicitWidth: before + needed
        implicitHeight: Math.max(button.sign, letters.implicitHeight)
        // What is measured depends on the font, which is named for that reason alone.
        function wide(text: string, _font: font): real {
            return Math.ceil(natural.advanceWidth(text)) + 1
        }
        FontMetrics {
            id: natural
            font: button.font
        }
        Drawing {
            visible: button.drawing !== ""
            x: parts.start + (button.sign - width) / 2
            y: (parts.height - height) / 2
            scale: button.sign / 24
            path: button.drawing
            ink: button.front
        }
        Balanced {
            id: letters
            x: button.drawing === "" ? 0 : parts.start + parts.before
            // Level with those of its neighbours, however many lines they have.
            y: (parts.height - height) / 2
            width: parts.width - x - (x > 0 ? parts.start : 0)
            text: button.words
            font: button.font
            color: button.front
            horizontalAlignment: button.alignment
            // Not where it fits: a width less the paddings can lack the last fraction of what the words need.
            wrapMode: width < parts.needed - 2 ? Text.Wrap : Text.NoWrap
            Accessible.ignored: true
        }
    }
    background: Rectangle {
        topLeftRadius: button.joinedBefore ? 0 : button.corner
        bottomLeftRadius: topLeftRadius
        topRightRadius: button.joinedAfter ? 0 : button.corner
        bottomRightRadius: topRightRadius
        color: button.solid ? (button.filled && button.hovered ? Theme.lightSea : Theme.sea) : button.down ? Theme.sand : button.hovered ? Theme.white : button.ground
        // What cannot be pressed now has a pale edge.
        border { color: button.enabled ? button.tone : Theme.edge; width: 2 * Theme.unit }
        FocusRing {
            around: button
            reach: (button.ringInPlace ? 0 : 5) * Theme.unit
            radius: button.corner + reach
            border.width: (button.ringInPlace ? 5 : 3) * Theme.unit
        }
    }
}
