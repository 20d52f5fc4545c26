// A whole number: typed, or stepped to. There is none beforehand.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import Recollect
import ".."

Row {
    id: number

    required property real room         // how wide it may be
    required property real tall         // how high its field is
    required property string item
    required property FormScreen form
    required property string label
    required property string range
    required property bool minus        // whether a negative number is allowed
    required property string widest     // the longest number that is allowed
    required property string pattern    // what may stand in the field
    required property string less
    required property string more
    required property string hint       // what there is to do, while it is empty
    // Whether it stands beside its question, which then says what it may be.
    property bool inline: false
    // How wide it is there with its buttons, if that is given. Its digits are as large as those of the keys then.
    property real column: 0
    readonly property bool large: inline && column > 0
    // Whether it takes all of the width below its question, which then says so as well.
    property bool filling: false
    // Whether the keys on the screen type into it.
    property bool keyed: false
    // Beside its question there is nothing to step yet while it is empty, and those keys are one way to enter it: the
    // field has the room of the buttons then.
    readonly property bool bare: (inline || filling) && (keyed || field.length === 0)
    property alias text: field.text
    signal typed(string text)
    signal done()
    signal entered(Item field)

    function step(by: int) {
        field.text = form.step(item, field.text, by)
    }

    readonly property real stepSize: Math.min(tall, 96 * Theme.unit)

    spacing: 20 * Theme.unit

    TextMetrics {
        id: widest
        font: field.font
        text: number.widest
    }

    component Step: AbstractButton {
        id: button
        property bool up: false
        required property int by
        anchors.verticalCenter: parent.verticalCenter
        width: number.stepSize
        height: number.stepSize
        focusPolicy: Qt.StrongFocus
        // A number that runs while a button is held is an answer when the button is let go.
        autoRepeat: true
        property bool ran: false
        onPressedChanged: {
            if (pressed)
                ran = false
            else if (ran)
                number.done()
        }
        onClicked: {
            // To let go of a button that ran is no step more.
            if (ran && !pressed) {
                ran = false
                return
            }
            number.step(by)
            ran = pressed
            if (!pressed)
                number.done()
        }
        scale: down ? 0.94 : 1
        Keys.onReturnPressed: event => { if (!event.isAutoRepeat) clicked() }
        Keys.onEnterPressed: event => { if (!event.isAutoRepeat) clicked() }
        contentItem: Item {
            Rectangle { anchors.centerIn: parent; width: 26 * Theme.unit; height: 5 * Theme.unit; color: Theme.sea }
            Rectangle { anchors.centerIn: parent; width: 5 * Theme.unit; height: 26 * Theme.unit; color: Theme.sea; visible: button.up }
        }
        background: Rectangle {
            radius: width / 2
            color: button.down ? Theme.sand : Theme.touchable
            border { color: Theme.sea; width: (button.hovered ? 4 : 3) * Theme.unit }
            FocusRing {
                around: button
                reach: 7 * Theme.unit
            }
        }
    }

    Step {
        objectName: `less-${number.item}`
        Accessible.name: `${number.label} ${number.less}`
        by: -1
        visible: !number.bare
    }
    Step {
        objectName: `more-${number.item}`
        up: true
        Accessible.name: `${number.label} ${number.more}`
        by: 1
        visible: !number.bare
    }
    TypedField {
        id: field
        objectName: `number-${number.item}`
        focus: true
        label: `${number.label} ${number.range}`
        hint: number.hint
        Accessible.description: ""
        digits: true
        form: number.form
        minus: number.minus
        // As wide as the longest number; digits of another script may be wider still.
        settled: number.filling ? number.room - 2 * (number.stepSize + number.spacing)
            : number.large ? number.column - 2 * (number.stepSize + number.spacing)
            : Math.max(Math.max(260, 228 * Theme.textSize) * Theme.unit, Math.max(widest.advanceWidth, contentWidth) + leftPadding + rightPadding + 8 * Theme.unit)
        width: settled + (number.bare ? 2 * (number.stepSize + number.spacing) : 0)
        height: number.tall
        topPadding: 2 * Theme.unit
        bottomPadding: 2 * Theme.unit
        font { pixelSize: number.large ? Math.min(Theme.size(72), 0.5 * number.tall) : Theme.size(50); bold: true }
        verticalAlignment: TextInput.AlignVCenter
        leftPadding: (number.inline || number.filling ? 36 : 24) * Theme.unit
        rightPadding: leftPadding
        horizontalAlignment: number.large && (length > 0 || activeFocus) ? TextInput.AlignHCenter : number.inline || number.filling ? TextInput.AlignLeft : TextInput.AlignHCenter
        longest: number.widest.length
        validator: RegularExpressionValidator { regularExpression: new RegExp(number.pattern) }
        onTextChanged: number.typed(text)
        onEditingFinished: number.done()
        onPointed: number.entered(field)
        onNegated: text = number.form.negate(number.item, text)
        Keys.onUpPressed: { number.step(1); number.done() }
        Keys.onDownPressed: { number.step(-1); number.done() }
    }
    PlainText {
        id: asked
        visible: !number.inline && !number.filling
        anchors.verticalCenter: parent.verticalCenter
        leftPadding: 0.5 * Theme.gap
        width: Math.min(implicitWidth, number.room - 2 * number.stepSize - field.width - 3 * number.spacing)
        wrapMode: width < implicitWidth ? Text.Wrap : Text.NoWrap
        text: number.range
        font.pixelSize: Theme.small
        color: Theme.faintInk
    }
}
