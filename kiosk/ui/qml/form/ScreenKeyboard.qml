// Letters, accents and digits for a booth without a keyboard. It types into the field that it is told, and keeps no text.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import ".."

Rectangle {
    id: keyboard

    property TypedField field: null
    required property var words
    signal done()

    property bool capitals: false
    readonly property bool numbers: field !== null && field.digits
    readonly property var rows: numbers ? [field?.minus ? "-1234567890" : "1234567890"] : ["1234567890", "qwertyuiop", "asdfghjklñ", "zxcvbnmç'-", "àáèéìíòóùúü", ".,?!¿¡"]
    readonly property real keyWidth: Math.min(96 * Theme.unit, (width - 2 * Theme.gap - 12 * gap) / (numbers ? 14.4 : 11))
    readonly property real keyHeight: 60 * Theme.unit
    readonly property real gap: 8 * Theme.unit

    height: keys.height + 1.2 * Theme.gap
    color: Theme.sand
    visible: field !== null
    onVisibleChanged: capitals = false

    // Between the keys nothing happens, and nothing below is reached.
    MouseArea { anchors.fill: parent; Accessible.ignored: true }

    // Not named Key: outside of QML, that name belongs to something else.
    component ScreenKey: AbstractButton {
        id: key
        required property string words
        property bool pressedIn: false
        Accessible.name: words
        focusPolicy: Qt.NoFocus
        width: Math.max(keyboard.keyWidth, implicitWidth)
        height: keyboard.keyHeight
        horizontalPadding: 14 * Theme.unit
        scale: down ? 0.94 : 1
        contentItem: Text {
            textFormat: Text.PlainText
            text: key.words
            font { pixelSize: Math.min(Theme.body, 0.56 * keyboard.keyHeight); bold: key.pressedIn }
            color: key.pressedIn ? Theme.white : Theme.ink
            horizontalAlignment: Text.AlignHCenter
            verticalAlignment: Text.AlignVCenter
        }
        background: Rectangle {
            radius: 10 * Theme.unit
            color: key.pressedIn ? Theme.sea : Theme.white
            border { color: Theme.edge; width: 2 * Theme.unit }
        }
    }

    Column {
        id: keys
        anchors.centerIn: parent
        spacing: keyboard.gap
        Repeater {
            model: keyboard.rows
            Row {
                id: row
                required property int index
                required property string modelData
                anchors.horizontalCenter: parent.horizontalCenter
                spacing: keyboard.gap
                ScreenKey {
                    visible: !keyboard.numbers && row.index === keyboard.rows.length - 1
                    objectName: "key-shift"
                    words: keyboard.words["keyboard-shift"]
                    pressedIn: keyboard.capitals
                    checkable: true
                    checked: pressedIn
                    onCheckedChanged: if (checked !== pressedIn) checked = Qt.binding(() => keyboard.capitals)
                    onClicked: keyboard.capitals = !keyboard.capitals
                }
                Repeater {
                    model: row.modelData.length
                    ScreenKey {
                        required property int index
                        readonly property string letter: row.modelData.charAt(index)
                        objectName: "key-" + letter
                        words: keyboard.capitals ? letter.toUpperCase() : keyboard.numbers && letter === "-" ? "−" : letter
                        onClicked: {
                            keyboard.field.type(keyboard.numbers ? letter : words)
                            keyboard.capitals = false
                        }
                    }
                }
                ScreenKey {
                    visible: !keyboard.numbers && row.index === keyboard.rows.length - 1
                    objectName: "key-space"
                    width: Math.max(1.6 * keyboard.keyWidth, implicitWidth)
                    words: keyboard.words["keyboard-space"]
                    onClicked: keyboard.field.type(" ")
                }
                ScreenKey {
                    visible: row.index === keyboard.rows.length - 1
                    objectName: "key-delete"
                    words: keyboard.words["keyboard-delete"]
                    onClicked: keyboard.field.wipe()
                }
                ScreenKey {
                    visible: row.index === keyboard.rows.length - 1
                    objectName: "key-done"
                    words: keyboard.words["keyboard-done"]
                    onClicked: keyboard.done()
                }
            }
        }
    }
}
