// A line to type in, with keys of a keyboard or with those on the screen.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import Recollect
import ".."

TextField {
    id: field

    required property FormScreen form
    required property string label
    // What there is to do, while nothing is typed. Not its placeholder text: that is drawn as markup if it looks like it.
    property string hint: ""
    property bool digits: false
    property bool minus: false          // whether a number may be negative
    property int longest: 32767         // in characters; some take two places of Qt's own count
    property real settled: width        // how wide it is once something is typed
    // By touch, or by mouse where the study says so: a person who comes by keyboard has one.
    signal pointed()
    // The minus key on the screen was pressed.
    signal negated()

    // What the keys on the screen do. A number grows and shrinks at its end: they have no arrows, and a finger that
    // fell before a digit could never delete it.
    function type(letters: string) {
        if (selectedText !== "")
            remove(selectionStart, selectionEnd)
        if (digits && letters === "-")
            negated()
        else
            insert(digits ? length : cursorPosition, letters)
    }
    function wipe() {
        const at = digits ? length : cursorPosition
        if (selectedText !== "")
            remove(selectionStart, selectionEnd)
        else if (at > 0)
            remove(form.before(text, at), at)
    }
    // What is too much goes again, from where it came, and never half a character.
    onTextChanged: {
        const kept = form.fitting(text, cursorPosition, longest)
        if (kept < cursorPosition)
            remove(kept, cursorPosition)
    }
    maximumLength: 2 * longest
    font.pixelSize: Theme.body
    color: Theme.ink
    selectionColor: Theme.sea
    selectedTextColor: Theme.white
    padding: 16 * Theme.unit
    leftPadding: 24 * Theme.unit
    rightPadding: 24 * Theme.unit
    focusPolicy: Qt.StrongFocus
    activeFocusOnTab: true
    inputMethodHints: digits ? (minus ? Qt.ImhFormattedNumbersOnly : Qt.ImhDigitsOnly) | Qt.ImhNoPredictiveText : Qt.ImhNoPredictiveText
    Accessible.name: label
    Accessible.description: hint
    onActiveFocusChanged: {
        if (activeFocus && (focusReason === Qt.TabFocusReason || focusReason === Qt.BacktabFocusReason))
            Theme.byKeyboard = true
    }
    // The keys come when the finger is lifted: they may move the field, and it would be lifted beside it.
    property bool touched: false
    function lifted() {
        // What is typed next takes the place of the number that stands there.
        if (digits)
            Qt.callLater(selectAll)
        if (Theme.screenKeys === "always" || (Theme.screenKeys === "touch" && touched))
            pointed()
    }
    // A click that the system made of a touch is one as well.
    onPressed: event => touched = touch.active || event.source !== Qt.MouseEventNotSynthesized
    onReleased: lifted()
    PointHandler {
        id: touch
        acceptedDevices: PointerDevice.TouchScreen
        onActiveChanged: if (active) field.touched = true
    }

    // The field of a number shows that a tap brings keys with digits.
    Rectangle {
        id: keys
        objectName: "keys-sign"
        anchors.verticalCenter: parent.verticalCenter
        x: Theme.across(parent.width - width - (parent.height - height) / 2, width, parent.width)
        // A narrow field needs its width for the words.
        visible: field.digits && prompt.visible && field.width >= 400 * Theme.unit
        height: Math.min(parent.height - 28 * Theme.unit, 140 * Theme.unit)
        width: height
        radius: 0.6 * Theme.radius
        color: Theme.touchable
        Grid {
            anchors.centerIn: parent
            columns: 3
            spacing: 0.05 * keys.height
            Repeater {
                model: 9
                Rectangle {
                    width: 0.1 * keys.height
                    height: width
                    radius: 0.2 * width
                    color: Theme.sea
                }
            }
        }
    }
    Text {
        id: prompt
        readonly property real after: field.digits && field.width >= 400 * Theme.unit ? field.height - (field.height - keys.height) / 2 : 0
        readonly property real margin: field.leftPadding
        anchors {
            fill: parent
            leftMargin: margin
            rightMargin: margin + after
        }
        // A number's is large, and the cursor would cross it.
        visible: field.length === 0 && field.preeditText === "" && !(field.digits && field.activeFocus)
        textFormat: Text.PlainText
        text: field.hint
        horizontalAlignment: field.digits ? field.horizontalAlignment : undefined
        font.pixelSize: field.digits ? Math.min(Theme.size(Theme.upright ? 46 : 38), 0.47 * field.height) : Theme.body
        fontSizeMode: Text.HorizontalFit
        minimumPixelSize: Theme.size(24)
        color: Theme.faintInk
        verticalAlignment: Text.AlignVCenter
        Accessible.ignored: true
    }
    background: Rectangle {
        radius: Theme.radius
        // Of the colour of the keys on the screen that type into it. Options, which are tinted, are no fields.
        color: field.digits ? Theme.white : field.activeFocus && !Theme.byKeyboard ? Theme.sand : Theme.white
        border { color: Theme.sea; width: (field.activeFocus ? 6 : field.digits ? 4 : 3) * Theme.unit }
        // Inside of a number, which has buttons beside it.
        FocusRing {
            visible: field.activeFocus && Theme.byKeyboard
            reach: (field.digits ? -8 : 8) * Theme.unit
            radius: Theme.radius + reach
        }
    }
}
