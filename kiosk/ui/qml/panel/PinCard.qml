// A small card in the corner that asks the experimenter for the PIN or for a reason, and says nothing else.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: pin

    required property CardScreen card
    required property var words
    // The keys of a PIN, for a booth without a keyboard.
    readonly property bool pad: card.byTouch && !listing
    readonly property bool listing: card.step === "reason"

    objectName: "pin-card"
    visible: card.step !== ""
    width: 430 * Theme.unit * Math.max(1, Theme.textSize)
    height: content.height + 2 * Theme.gap
    radius: Theme.radius
    color: Theme.white
    border { color: Theme.sea; width: 3 * Theme.unit }

    Accessible.role: Accessible.Dialog
    Accessible.name: card.title

    // Nothing below it is pressed through it.
    MouseArea { anchors.fill: parent; Accessible.ignored: true }

    Column {
        id: content
        anchors { top: parent.top; left: parent.left; right: parent.right; margins: Theme.gap }
        spacing: 12 * Theme.unit

        PlainText {
            width: parent.width
            text: pin.card.title
            wrapMode: Text.Wrap
            font { pixelSize: Theme.body; bold: true }
            color: Theme.ink
        }
        Rectangle {
            visible: !pin.listing
            width: parent.width
            height: 64 * Theme.unit * Theme.textSize
            radius: 12 * Theme.unit
            color: Theme.paper
            border { color: pin.card.step === "wait" ? Theme.deepAmber : Theme.sea; width: 2 * Theme.unit }
            // The keys come here wherever the keyboard is; of a PIN it shows only how long it is.
            Accessible.role: Accessible.EditableText
            Accessible.name: pin.card.title
            Accessible.description: pin.card.text
            Accessible.readOnly: pin.card.step === "wait"
            PlainText {
                anchors { fill: parent; leftMargin: 16 * Theme.unit; rightMargin: 16 * Theme.unit }
                text: pin.card.text
                Accessible.ignored: true
                font { pixelSize: Theme.body; letterSpacing: pin.card.step === "pin" ? 8 * Theme.unit : 0 }
                color: Theme.ink
                elide: Text.ElideLeft
                verticalAlignment: Text.AlignVCenter
            }
        }
        Repeater {
            model: pin.card.reasons
            delegate: PanelButton {
                id: reason
                required property int index
                required property string modelData
                objectName: "reason-" + (reason.index + 1)
                width: content.width
                height: Math.max(implicitHeight, pin.card.byTouch ? 72 * Theme.unit : 0)
                words: (reason.index + 1) + "   " + reason.modelData
                alignment: Text.AlignLeft
                focusPolicy: Qt.NoFocus
                onClicked: pin.card.choose(reason.index + 1)
            }
        }
        Grid {
            id: keys
            visible: pin.pad
            width: parent.width
            columns: 3
            spacing: 10 * Theme.unit
            Repeater {
                model: ["1", "2", "3", "4", "5", "6", "7", "8", "9", "delete", "0", "enter"]
                delegate: PanelButton {
                    id: key
                    required property string modelData
                    readonly property bool digit: modelData.length === 1
                    objectName: "pin-" + modelData
                    width: (keys.width - 2 * keys.spacing) / 3
                    height: 96 * Theme.unit
                    words: digit ? modelData : pin.words["console-key-" + modelData] ?? ""
                    font { pixelSize: digit ? Theme.body : Theme.dense; bold: digit }
                    horizontalPadding: 8 * Theme.unit
                    filled: modelData === "enter"
                    enabled: pin.card.step !== "wait"
                    focusPolicy: Qt.NoFocus
                    onClicked: {
                        if (digit)
                            pin.card.type(modelData)
                        else if (modelData === "delete")
                            pin.card.erase()
                        else
                            pin.card.enter()
                    }
                }
            }
        }
        PanelButton {
            objectName: "pin-cancel"
            visible: pin.card.byTouch
            width: parent.width
            height: 72 * Theme.unit
            words: pin.words["console-cancel"] ?? ""
            focusPolicy: Qt.NoFocus
            onClicked: pin.card.cancel()
        }
        PlainText {
            objectName: "pin-line"
            visible: text !== ""
            width: parent.width
            text: pin.card.line
            font.pixelSize: Theme.dense
            color: pin.card.step === "wait" ? Theme.deepAmber : Theme.faintInk
            Accessible.role: Accessible.AlertMessage
            Accessible.name: text
            wrapMode: Text.Wrap
        }
    }
}
