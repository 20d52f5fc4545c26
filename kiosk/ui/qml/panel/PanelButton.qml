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
    property real least: 68 * Theme.unit
    readonly property color tone: grave ? Theme.deepAmber : Theme.sea
    property bool solid: chosen || (filled && enabled)
    // What lies below its words while it is not solid.
    property color ground: Theme.paper
    property int alignment: Text.AlignHCenter
    // The lines of a small drawing before its words, on a square of 24; none without.
    property string drawing: ""
    property real sign: drawing === "" ? 0 : 1.45 * font.pixelSize
    // Whether drawing and words stand in its middle, beside each other.
    property bool centred: false
    property color front: solid ? Theme.white : enabled ? tone : Theme.faintInk

    width: Math.min(Math.ceil(implicitWidth), parent?.width ?? Infinity)
    height: Math.max(least, implicitHeight)
    Accessible.name: words
    focusPolicy: Qt.StrongFocus
    horizontalPadding: 18 * Theme.unit
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
        readonly property real before: button.sign > 0 ? button.sign + 0.6 * button.font.pixelSize : 0
        readonly property real start: button.centred ? Math.max(0, (width - implicitWidth) / 2) : 0
        implicitWidth: before + Math.ceil(natural.advanceWidth) + 1
        implicitHeight: Math.max(button.sign, letters.implicitHeight)
        TextMetrics {
            id: natural
            text: button.words
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
            x: parts.start + parts.before
            // Level with those of its neighbours, however many lines they have.
            y: (parts.height - height) / 2
            width: parts.width - parts.before - parts.start
            text: button.words
            font: button.font
            color: button.front
            horizontalAlignment: button.drawing === "" ? button.alignment : Text.AlignLeft
            // Not where it fits: a width less the paddings can lack the last fraction of what the words need.
            wrapMode: width < Math.floor(natural.advanceWidth) ? Text.Wrap : Text.NoWrap
            Accessible.ignored: true
        }
    }
    background: Rectangle {
        radius: 12 * Theme.unit
        color: button.solid ? (button.filled && button.hovered ? Theme.lightSea : Theme.sea) : button.down ? Theme.sand : button.hovered ? Theme.white : button.ground
        // What cannot be pressed now has a pale edge.
        border { color: button.enabled ? button.tone : Theme.edge; width: (button.grave ? 3 : 2) * Theme.unit }
        FocusRing {
            around: button
            reach: (button.ringInPlace ? 0 : 5) * Theme.unit
            radius: (button.ringInPlace ? 12 : 15) * Theme.unit
            border.width: (button.ringInPlace ? 5 : 3) * Theme.unit
        }
    }
}
