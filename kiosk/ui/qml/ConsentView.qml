// What can be agreed to. Nothing is ticked beforehand, and to decline is as easy as to agree.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property ConsentScreen consent
    required property KioskScreen kiosk
    required property var words

    onVisibleChanged: home.focus = true
    Keys.onPressed: event => pane.turn(event)

    Column {
        anchors.centerIn: parent
        width: Math.min(1240 * Theme.unit, view.width - 4 * Theme.gap)
        spacing: 0.8 * Theme.gap

        PlainText {
            id: title
            width: parent.width
            text: view.consent.title
            font { pixelSize: Theme.heading; bold: true }
            wrapMode: Text.Wrap
            color: Theme.ink
        }
        FocusScope {
            id: home
            width: parent.width
            height: pane.height
            // At first at no box: the page is read from its top, and no key ticks what was not seen. Tab goes to the first.
            focus: true
            Accessible.role: Accessible.Form
            Accessible.name: view.consent.title
            ScrollPane {
                id: pane
                width: parent.width
                room: view.height - title.height - answers.height - 4 * Theme.gap
                more: view.words["scroll-more"]
                spacing: 0.5 * Theme.gap

                Paragraphs {
                    width: parent.width
                    texts: view.consent.paragraphs
                }
                Column {
                    id: boxes
                    // The boxes stand out of the text by their padding alone; their edges are the text's.
                    x: -8 * Theme.unit
                    width: parent.width - x
                    Repeater {
                        id: purposes
                        model: view.consent.purposes
                        TickBox {
                            required property var modelData
                            objectName: "purpose-" + modelData.id
                            width: boxes.width
                            words: modelData.text
                            on: view.consent.ticks.includes(modelData.id)
                            note: view.words[modelData.required ? "consent-required" : "consent-optional"]
                            warning: view.consent.missing.includes(modelData.id) ? view.words["consent-missing"] : ""
                            onClicked: view.consent.tick(modelData.id, !on)
                        }
                    }
                }
            }
        }
        Grid {
            id: answers
            readonly property real wish: agree.implicitWidth + decline.implicitWidth
                + (back.visible ? back.implicitWidth + 2 * Theme.gap : 0) + columnSpacing
            // Side by side, or where texts are long, one above the other.
            columns: wish <= parent.width ? 3 : 1
            columnSpacing: 1.5 * Theme.gap
            rowSpacing: 0.7 * Theme.gap
            topPadding: 0.5 * Theme.gap
            BigButton {
                id: agree
                objectName: "agree"
                most: answers.parent.width
                quiet: !view.consent.complete
                words: view.words["consent-agree"]
                onClicked: view.consent.agree()
            }
            BigButton {
                id: decline
                objectName: "decline"
                most: answers.parent.width
                quiet: true
                words: view.words["consent-decline"]
                onClicked: view.consent.decline()
            }
            BigButton {
                id: back
                objectName: "back"
                visible: view.kiosk.goesBack
                most: answers.parent.width
                quiet: true
                horizontalPadding: 40 * Theme.unit
                words: view.words["control-back"]
                onClicked: view.kiosk.goBack()
            }
        }
    }
    Connections {
        target: view.consent
        function onMissed(purpose: string) {
            for (let i = 0; i < purposes.count; i++) {
                const box = purposes.itemAt(i) as TickBox
                if (box.objectName === "purpose-" + purpose) {
                    box.forceActiveFocus(Qt.TabFocusReason)
                    pane.reveal(box)
                }
            }
        }
    }
}
