// A whole number: typed, or stepped to. There is none beforehand.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import ".."

Row {
    id: number

    required property string item
    required property string label
    required property int lowest
    required property int highest
    required property string range
    required property string less
    required property string more
    signal typed(string text)
    signal done()
    signal entered(Item field)

    // From nothing, up begins at the lowest and down at the highest.
    function step(by: int) {
        const now = parseInt(field.text)
        const next = isNaN(now) ? (by > 0 ? lowest : highest) : Math.max(lowest, Math.min(highest, now + by))
        field.text = next
        done()
    }

    spacing: 0.6 * Theme.gap

    component Step: AbstractButton {
        id: button
        property bool up: false
        width: field.height
        height: field.height
        focusPolicy: Qt.StrongFocus
        scale: down ? 0.94 : 1
        Keys.onReturnPressed: event => { if (!event.isAutoRepeat) clicked() }
        Keys.onEnterPressed: event => { if (!event.isAutoRepeat) clicked() }
        contentItem: Item {
            Rectangle { anchors.centerIn: parent; width: 26 * Theme.unit; height: 5 * Theme.unit; color: Theme.sea }
            Rectangle { anchors.centerIn: parent; width: 5 * Theme.unit; height: 26 * Theme.unit; color: Theme.sea; visible: button.up }
        }
        background: Rectangle {
            radius: width / 2
            color: button.hovered ? Theme.sand : Theme.white
            border { color: Theme.sea; width: 3 * Theme.unit }
            FocusRing {
                around: button
                reach: 7 * Theme.unit
            }
        }
    }

    Step {
        objectName: `less-${number.item}`
        Accessible.name: `${number.label} ${number.less}`
        onClicked: number.step(-1)
    }
    TypedField {
        id: field
        objectName: `number-${number.item}`
        focus: true
        label: `${number.label} ${number.range}`
        digits: true
        width: 170 * Theme.unit * Theme.textSize
        horizontalAlignment: TextInput.AlignHCenter
        maximumLength: String(number.highest).length
        validator: RegularExpressionValidator { regularExpression: /[0-9]*/ }
        onTextChanged: number.typed(text)
        onEditingFinished: number.done()
        onPointed: number.entered(field)
        Keys.onUpPressed: number.step(1)
        Keys.onDownPressed: number.step(-1)
    }
    Step {
        objectName: `more-${number.item}`
        up: true
        Accessible.name: `${number.label} ${number.more}`
        onClicked: number.step(1)
    }
    PlainText {
        anchors.verticalCenter: parent.verticalCenter
        leftPadding: 0.5 * Theme.gap
        text: number.range
        font.pixelSize: Theme.small
        color: Theme.faintInk
    }
}
