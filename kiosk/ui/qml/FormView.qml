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
    readonly property real lift: {
        if (keyboard.field === null || keyboard.numbers)
            return 0
        const above = view.height - keyboard.height - Theme.gap
        const top = keyboard.field.mapToItem(group, 0, 0).y + group.y
        const needed = Math.max(0, top + keyboard.field.height - above)
        // The way on as well, as far as the field stays in view.
        return Math.max(needed, Math.min(Math.max(0, top - Theme.gap), group.y + group.height - above))
    }
    readonly property bool dense: form.items.length > 4

    // One press of a digit answers the scale that has the keyboard, or else the first that is not answered, and goes on
    // to the next.
    function answer(digit: int): bool {
        let at = -1
        for (let i = 0; i < boxes.count && at < 0; i++)
            if ((boxes.itemAt(i) as FormItem).activeFocus)
                at = i
        for (let i = 0; i < boxes.count && at < 0; i++)
            if ((boxes.itemAt(i) as FormItem).isOpen())
                at = i
        if (at < 0 || !(boxes.itemAt(at) as FormItem).takes(digit))
            return false
        const next = boxes.itemAt(at + 1) as FormItem
        if (next)
            next.take()
        else
            go.button.forceActiveFocus(Qt.TabFocusReason)
        view.form.rate(view.form.items[at].id, digit)
        return true
    }

    Keys.onPressed: event => {
        const digit = event.text === "" ? 0 : "1234567890".indexOf(event.text) + 1
        event.accepted = digit > 0 && answer(digit)
        if (!event.accepted)
            pane.turn(event)
    }

    Item {
        id: place
        objectName: "ground"
        anchors.fill: parent

        // To tap beside everything is to have done with typing.
        TapHandler { onTapped: go.button.forceActiveFocus() }

        Column {
            id: group
            anchors.centerIn: parent
            width: Math.min((view.alone ? 1100 : view.width > 1600 * Theme.unit ? 1500 : 1220) * Theme.unit, parent.width - 3 * Theme.gap)
            // The keys move nothing, unless they would cover what is typed into.
            transform: Translate { y: -view.lift }
            spacing: (view.dense ? 0.8 : view.alone ? 2 : 0.9) * Theme.gap

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
                    spacing: (view.dense ? 10 : 14) * Theme.unit
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
        form: view.form
        wayOn: group.y + group.height - go.height
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
