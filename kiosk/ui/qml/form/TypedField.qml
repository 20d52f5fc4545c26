// A line to type in, with keys of a keyboard or with those on the screen.
import QtQuick
import QtQuick.Controls.Basic
import ".."

TextField {
    id: field

    required property string label
    property bool digits: false
    // By mouse or touch: whoever comes by keyboard has one.
    signal pointed()

    // What the keys on the screen do. A number grows and shrinks at its end: they have no arrows, and a finger that
    // fell before a digit could never delete it.
    function type(letters: string) {
        insert(digits ? length : cursorPosition, letters)
    }
    function wipe() {
        if (selectedText !== "")
            remove(selectionStart, selectionEnd)
        else if (digits)
            remove(length - 1, length)
        else
            remove(cursorPosition - 1, cursorPosition)
    }
    font.pixelSize: Theme.body
    color: Theme.ink
    placeholderTextColor: Theme.faintInk
    selectionColor: Theme.sea
    selectedTextColor: Theme.white
    padding: 16 * Theme.unit
    leftPadding: 24 * Theme.unit
    rightPadding: 24 * Theme.unit
    focusPolicy: Qt.StrongFocus
    activeFocusOnTab: true
    inputMethodHints: digits ? Qt.ImhDigitsOnly | Qt.ImhNoPredictiveText : Qt.ImhNoPredictiveText
    Accessible.name: label
    onPressed: pointed()

    background: Rectangle {
        radius: Theme.radius
        color: Theme.white
        border { color: field.activeFocus ? Theme.ink : Theme.sea; width: (field.activeFocus ? 5 : 3) * Theme.unit }
        FocusRing {
            visible: field.activeFocus
            reach: 8 * Theme.unit
            radius: Theme.radius + reach
        }
    }
}
