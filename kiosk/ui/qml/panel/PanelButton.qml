// A button of the panel: as tall as a line, and the same by mouse, touch and keyboard. Arrows go around, as Tab does.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import ".."

Button {
    id: button

    // One of several, and the one that holds.
    property bool chosen: false
    property int alignment: Text.AlignHCenter

    focusPolicy: Qt.StrongFocus
    horizontalPadding: 18 * Theme.unit
    verticalPadding: 9 * Theme.unit
    font { pixelSize: Theme.dense; bold: chosen }
    opacity: enabled ? 1 : 0.45
    Accessible.checked: chosen

    Keys.onReturnPressed: event => { if (!event.isAutoRepeat) clicked() }
    Keys.onEnterPressed: event => { if (!event.isAutoRepeat) clicked() }
    Keys.onRightPressed: nextItemInFocusChain(true).forceActiveFocus(Qt.TabFocusReason)
    Keys.onDownPressed: nextItemInFocusChain(true).forceActiveFocus(Qt.TabFocusReason)
    Keys.onLeftPressed: nextItemInFocusChain(false).forceActiveFocus(Qt.BacktabFocusReason)
    Keys.onUpPressed: nextItemInFocusChain(false).forceActiveFocus(Qt.BacktabFocusReason)

    contentItem: Text {
        text: button.text
        font: button.font
        color: button.chosen ? Theme.white : Theme.sea
        horizontalAlignment: button.alignment
        verticalAlignment: Text.AlignVCenter
        elide: Text.ElideRight
    }
    background: Rectangle {
        radius: 12 * Theme.unit
        color: button.chosen ? Theme.sea : button.down ? Theme.sand : button.hovered ? Theme.white : Theme.paper
        border { color: Theme.sea; width: 2 * Theme.unit }
        Rectangle {
            anchors.fill: parent
            anchors.margins: -5 * Theme.unit
            radius: 15 * Theme.unit
            color: "transparent"
            border { color: Theme.ink; width: 3 * Theme.unit }
            visible: button.visualFocus
        }
    }
}
