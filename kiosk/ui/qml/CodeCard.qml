// The card on which a visitor who was here before types their code, by its own keys or a keyboard.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import Recollect
import "."

FocusScope {
    id: card

    required property ReturnScreen returning
    required property var words
    signal wentAway()

    // Whichever button the last visitor used, this one types.
    onVisibleChanged: if (visible) typed.focus = true
    Keys.onEscapePressed: card.wentAway()

    Rectangle {
        anchors.fill: parent
        color: Theme.paper
        opacity: 0.94
        MouseArea { anchors.fill: parent; hoverEnabled: true; preventStealing: true; Accessible.ignored: true }
    }

    Rectangle {
        anchors.centerIn: parent
        width: Math.min(parent.width - 2 * Theme.gap, 1100 * Theme.unit)
        height: content.height + 3 * Theme.gap
        radius: Theme.radius
        color: Theme.white
        border { color: Theme.sea; width: 4 * Theme.unit }
        Column {
            id: content
            anchors.centerIn: parent
            width: parent.width - 4 * Theme.gap
            spacing: Theme.gap
            PlainText {
                width: parent.width
                text: card.words["return-title"]
                font { pixelSize: Theme.heading; bold: true }
                color: Theme.ink
                Accessible.role: Accessible.AlertMessage
                Accessible.name: text
                horizontalAlignment: Text.AlignHCenter
                wrapMode: Text.Wrap
            }
            PlainText {
                objectName: "return-line"
                width: parent.width
                // So that nothing moves when another line is shown.
                height: Math.max(implicitHeight, 3 * Theme.small)
                text: card.returning.line
                font.pixelSize: Theme.small
                color: Theme.faintInk
                horizontalAlignment: Text.AlignHCenter
                verticalAlignment: Text.AlignVCenter
                wrapMode: Text.Wrap
            }
            FocusScope {
                id: typed
                width: parent.width
                height: shown.height
                activeFocusOnTab: true
                Accessible.role: Accessible.EditableText
                Accessible.name: card.words["return-title"]
                Accessible.description: shown.text
                PlainText {
                    id: shown
                    objectName: "return-code"
                    width: parent.width
                    text: card.returning.shown
                    font { pixelSize: Theme.figure; bold: true; letterSpacing: 4 * Theme.unit }
                    fontSizeMode: Text.HorizontalFit
                    minimumPixelSize: Theme.body
                    color: Theme.sea
                    horizontalAlignment: Text.AlignHCenter
                }
            }
            Column {
                id: keys
                // A keyboard is not turned round with the page.
                LayoutMirroring.enabled: false
                LayoutMirroring.childrenInherit: true
                anchors.horizontalCenter: parent.horizontalCenter
                spacing: 8 * Theme.unit
                readonly property real side: Math.min(92 * Theme.unit, (content.width - 7 * spacing) / 8)
                Repeater {
                    model: card.returning.keys
                    Row {
                        id: row
                        required property int index
                        required property string modelData
                        readonly property bool last: index === card.returning.keys.length - 1
                        spacing: keys.spacing
                        Repeater {
                            model: Array.from(row.modelData).concat(row.last ? ["⌫"] : [])
                            AbstractButton {
                                id: key
                                required property string modelData
                                readonly property bool wipes: modelData === "⌫"
                                objectName: wipes ? "code-delete" : "code-" + modelData
                                width: keys.side
                                height: 74 * Theme.unit
                                focusPolicy: Qt.NoFocus
                                autoRepeat: wipes
                                enabled: !card.returning.checks
                                scale: down ? 0.94 : 1
                                Accessible.name: wipes ? card.words["keyboard-delete"] : modelData
                                onClicked: wipes ? card.returning.erase() : card.returning.type(modelData)
                                contentItem: Text {
                                    textFormat: Text.PlainText
                                    text: key.wipes ? "" : key.modelData
                                    font { pixelSize: Math.min(Theme.body, 40 * Theme.unit); bold: true }
                                    color: Theme.ink
                                    horizontalAlignment: Text.AlignHCenter
                                    verticalAlignment: Text.AlignVCenter
                                }
                                background: Rectangle {
                                    radius: 10 * Theme.unit
                                    color: Theme.white
                                    border { color: key.hovered ? Theme.sea : Theme.edge; width: 2 * Theme.unit }
                                    Backspace {
                                        visible: key.wipes
                                        anchors.centerIn: parent
                                    }
                                }
                            }
                        }
                    }
                }
            }
            Flow {
                anchors.horizontalCenter: parent.horizontalCenter
                width: Math.min(content.width, Math.ceil(go.width + no.width + spacing))
                spacing: Theme.gap
                BigButton {
                    id: go
                    objectName: "return-go"
                    most: content.width
                    words: card.words["return-go"]
                    enabled: card.returning.whole
                    opacity: enabled ? 1 : 0.5
                    onClicked: card.returning.enter()
                }
                BigButton {
                    id: no
                    objectName: "return-new"
                    most: content.width
                    words: card.words["return-new"]
                    quiet: true
                    onClicked: card.wentAway()
                }
            }
        }
    }
    Keys.onPressed: event => {
        if (event.key === Qt.Key_Backspace)
            card.returning.erase()
        else if (event.key === Qt.Key_Return || event.key === Qt.Key_Enter) {
            if (!event.isAutoRepeat) card.returning.enter()
        } else if (!card.returning.type(event.text))
            return
        event.accepted = true
    }
}
