// A button with a state: ticked or not, chosen or not. It shows and tells the state that it is given, not what a click
// would make of it; a double click is one click.
import QtQuick
import QtQuick.Controls.Basic

AbstractButton {
    id: button

    required property bool on
    // What it says. Not its text: "&" in that makes a shortcut of the letter behind.
    property string words: ""

    focusPolicy: Qt.StrongFocus
    checkable: true
    checked: on
    onCheckedChanged: if (checked !== on) checked = Qt.binding(() => button.on)
    onDoubleClicked: {}
    Accessible.onPressAction: clicked()
    Accessible.onToggleAction: clicked()
    // A key that is held down is one click.
    Keys.onReturnPressed: event => { if (!event.isAutoRepeat) clicked() }
    Keys.onEnterPressed: event => { if (!event.isAutoRepeat) clicked() }
}
