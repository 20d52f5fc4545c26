// The button with which a visitor says that an item does not apply.
import QtQuick
import ".."

Choosable {
    id: nothing

    // What the item asks.
    required property string label
    required property bool dense
    // Whether it stands in a row of a table.
    required property bool tabled

    font.pixelSize: Theme.small
    leftPadding: 18 * Theme.unit
    rightPadding: 18 * Theme.unit
    verticalPadding: (dense ? 4 : tabled ? 14 : 8) * Theme.unit
    Accessible.role: Accessible.CheckBox
    Accessible.name: `${label} ${words}`
    contentItem: Text {
        textFormat: Text.PlainText
        text: nothing.words
        font: nothing.font
        color: nothing.on ? Theme.white : Theme.ink
    }
    background: Rectangle {
        radius: height / 2
        color: nothing.on ? Theme.sea : Theme.touchable
        border { color: Theme.sea; width: (nothing.hovered ? 4 : 2) * Theme.unit }
        FocusRing {
            around: nothing
            reach: 6 * Theme.unit
            radius: height / 2
        }
    }
}
