// A page of a form: its items, one way on, and a keyboard while something is typed.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."
import "form"

FocusScope {
    id: view

    required property FormScreen form
    required property KioskScreen kiosk
    required property var words

    readonly property bool alone: form.items.length === 1
    readonly property bool dense: form.items.length > 4

    Keys.onPressed: event => pane.turn(event)

    Item {
        id: place
        objectName: "ground"
        anchors { left: parent.left; right: parent.right; top: parent.top; bottom: keyboard.visible ? keyboard.top : parent.bottom }

        // To tap beside everything is to have done with typing.
        TapHandler { onTapped: go.button.forceActiveFocus() }

        Column {
            id: group
            anchors.centerIn: parent
            width: Math.min((view.alone ? 1100 : 1220) * Theme.unit, parent.width - 3 * Theme.gap)
            spacing: (view.dense || keyboard.visible ? 0.8 : view.alone ? 2 : 0.9) * Theme.gap

            PlainText {
                id: progress
                anchors.horizontalCenter: parent.horizontalCenter
                visible: text !== ""
                text: view.form.progress
                font.pixelSize: Theme.small
                color: Theme.faintInk
            }
            FocusScope {
                id: home
                width: parent.width
                height: pane.height
                // At first at no item: no key of the page before may answer or skip one; Tab goes to the first.
                focus: true
                Accessible.role: Accessible.Form
                Accessible.name: view.form.progress || (view.form.items[0]?.text ?? "")
                ScrollPane {
                    id: pane
                    width: parent.width
                    room: place.height - (progress.visible ? progress.height + group.spacing : 0) - go.height - group.spacing - 2 * Theme.gap
                    more: view.words["scroll-more"]
                    spacing: (view.dense ? 10 : 18) * Theme.unit
                    Repeater {
                        id: boxes
                        model: view.form.items
                        FormItem {
                            required property int index
                            required property var modelData
                            width: parent?.width ?? 0
                            item: modelData
                            form: view.form
                            kiosk: view.kiosk
                            words: view.words
                            alone: view.alone
                            dense: view.dense
                            onEntered: field => keyboard.field = field
                        }
                    }
                }
            }
            WayOn {
                id: go
                width: parent.width
                kiosk: view.kiosk
                words: view.words
                quiet: view.form.skips
                label: view.words[quiet ? "form-skip" : "form-next"]
                onWent: view.form.proceed()
                onActiveFocusChanged: if (activeFocus) keyboard.field = null
            }
        }
    }
    ScreenKeyboard {
        id: keyboard
        anchors { left: parent.left; right: parent.right; bottom: parent.bottom }
        words: view.words
        onDone: go.button.forceActiveFocus(Qt.MouseFocusReason)
    }
    Connections {
        target: view.form
        // A new page begins at its top, for eyes and for the keyboard.
        function onTurned() {
            keyboard.field = null
            pane.rewind()
            home.focus = true
        }
        function onMissed(item: string) {
            for (let i = 0; i < boxes.count; i++) {
                const box = boxes.itemAt(i) as FormItem
                if (box.item.id === item) {
                    pane.reveal(box)
                    box.take()
                }
            }
        }
    }
}
