// The window of a study's writer: what there is to see on the left, the visitor's screen, and the text clicked on below.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Controls.Basic
import QtQuick.Layouts
import QtQuick.Window
import Recollect
import "."

Window {
    id: root

    required property PreviewModel preview

    width: 1280
    height: 800
    visible: true
    color: Theme.sand
    title: root.preview.title
    onClosing: root.preview.leave()

    component Choice: ComboBox {
        required property string what
        required property string chosen
        Layout.fillWidth: true
        currentIndex: model.indexOf(chosen)
        Accessible.name: what
        onActivated: index => root.preview.pick(what, model[index])
    }

    RowLayout {
        anchors { fill: parent; margins: 12 }
        spacing: 12

        ColumnLayout {
            Layout.preferredWidth: 220
            Layout.maximumWidth: 220
            Layout.fillHeight: true
            Choice { what: "language"; model: root.preview.languages; chosen: root.preview.language }
            Choice { what: "size"; model: root.preview.sizes; chosen: root.preview.size }
            Choice { what: "condition"; model: root.preview.conditions; chosen: root.preview.condition }
            CheckBox {
                id: box
                text: root.preview.to_answer
                contentItem: Text {
                    text: box.text
                    textFormat: Text.PlainText
                    font.pixelSize: 14
                    leftPadding: box.indicator.width + box.spacing
                    verticalAlignment: Text.AlignVCenter
                    wrapMode: Text.Wrap
                }
                Layout.fillWidth: true
                checked: root.preview.answering
                onToggled: root.preview.answer(checked)
            }
            ListView {
                id: screens
                Layout.fillWidth: true
                Layout.fillHeight: true
                clip: true
                model: root.preview.screens
                ScrollBar.vertical: ScrollBar {}
                delegate: ItemDelegate {
                    id: named
                    required property string modelData
                    width: ListView.view.width
                    contentItem: Text { text: named.modelData; font.pixelSize: 14; textFormat: Text.PlainText }
                    highlighted: modelData === root.preview.screen
                    onClicked: root.preview.pick("screen", modelData)
                }
            }
        }
        ColumnLayout {
            Layout.fillWidth: true
            Layout.fillHeight: true
            PlainText {
                Layout.fillWidth: true
                visible: text !== ""
                text: root.preview.fault
                color: "#A02020"
                font.pixelSize: 15
                wrapMode: Text.Wrap
                maximumLineCount: 6
                elide: Text.ElideRight
            }
            Image {
                id: picture
                Layout.fillWidth: true
                Layout.fillHeight: true
                fillMode: Image.PreserveAspectFit
                cache: false
                source: "image://visitor/" + root.preview.number
                Accessible.role: Accessible.Graphic
                Accessible.name: root.preview.screen

                MouseArea {
                    anchors.centerIn: parent
                    width: picture.paintedWidth
                    height: picture.paintedHeight
                    cursorShape: Qt.PointingHandCursor
                    onClicked: mouse => root.preview.press(mouse.x / width, mouse.y / height)
                    onWheel: wheel => root.preview.scroll(wheel.x / width, wheel.y / height, -wheel.angleDelta.y / 600)
                }
            }
            ColumnLayout {
                Layout.fillWidth: true
                visible: root.preview.found !== ""
                PlainText {
                    Layout.fillWidth: true
                    text: root.preview.found
                    font { pixelSize: 15; bold: true }
                    wrapMode: Text.WrapAnywhere
                }
                PlainText {
                    Layout.fillWidth: true
                    visible: text !== ""
                    text: root.preview.note
                    font.pixelSize: 14
                    wrapMode: Text.Wrap
                }
                RowLayout {
                    Layout.fillWidth: true
                    TextArea {
                        id: editor
                        Layout.fillWidth: true
                        text: root.preview.text
                        readOnly: !root.preview.editable
                        textFormat: TextEdit.PlainText
                        wrapMode: TextEdit.Wrap
                        font.pixelSize: 15
                        background: Rectangle { color: Theme.white; border.color: Theme.faintInk }
                    }
                    Button {
                        visible: root.preview.editable
                        contentItem: Text { text: "✓"; font.pixelSize: 20; textFormat: Text.PlainText }
                        Accessible.name: root.preview.found
                        onClicked: root.preview.write(editor.text)
                    }
                }
            }
        }
    }
}
