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
        width: Math.min((view.width > 1600 * Theme.unit ? 1500 : 1240) * Theme.unit, view.width - 4 * Theme.gap)
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
                spacing: 0.4 * Theme.gap

                Rectangle {
                    id: sheet
                    readonly property var texts: view.consent.paragraphs
                    // Short lines are read with less effort than long ones: in two columns where there is room.
                    readonly property bool halved: pane.width > 900 * Theme.unit && texts.length > 1
                    // How many paragraphs stand in the first column, so that both are about as long.
                    readonly property int first: {
                        if (!halved)
                            return texts.length
                        const lengths = texts.map(text => text.length + 40)
                        const all = lengths.reduce((sum, each) => sum + each, 0)
                        let best = 1, least = Infinity
                        for (let i = 1, sum = lengths[0]; i < texts.length; sum += lengths[i++])
                            if (Math.abs(all - 2 * sum) < least) {
                                least = Math.abs(all - 2 * sum)
                                best = i
                            }
                        return best
                    }
                    readonly property real column: halved ? (width - 4 * Theme.gap) / 2 : width - 2 * Theme.gap
                    width: pane.width
                    height: Math.max(left.height, right.visible ? right.height : 0) + 1.4 * Theme.gap
                    radius: Theme.radius
                    color: Theme.white
                    Paragraphs {
                        id: left
                        x: Theme.across(Theme.gap, width, sheet.width)
                        y: 0.7 * Theme.gap
                        width: sheet.column
                        texts: sheet.texts.slice(0, sheet.first)
                        size: Theme.small
                    }
                    Rectangle {
                        visible: sheet.halved
                        x: (parent.width - width) / 2
                        y: 0.9 * Theme.gap
                        width: 2 * Theme.unit
                        height: parent.height - 2 * y
                        color: Theme.edge
                    }
                    Paragraphs {
                        id: right
                        visible: sheet.halved
                        x: Theme.across(sheet.column + 3 * Theme.gap, width, sheet.width)
                        y: 0.7 * Theme.gap
                        width: sheet.column
                        texts: sheet.texts.slice(sheet.first)
                        size: Theme.small
                    }
                }
                Repeater {
                    id: purposes
                    model: view.consent.purposes
                    TickBox {
                        required property var modelData
                        objectName: "purpose-" + modelData.id
                        width: pane.width
                        words: modelData.text
                        on: view.consent.ticks.includes(modelData.id)
                        note: view.words[modelData.required ? "consent-required" : "consent-optional"]
                        warning: view.consent.missing.includes(modelData.id) ? view.words["consent-missing"] : ""
                        onClicked: view.consent.tick(modelData.id, !on)
                    }
                }
            }
        }
        Item {
            id: answers
            readonly property real wish: agree.implicitWidth + decline.implicitWidth + Theme.gap
                + (back.visible ? back.implicitWidth + Theme.gap : 0)
            // Side by side, the way on at the right as on every page; or where texts are long, one above the other.
            readonly property bool abreast: wish <= width
            width: parent.width
            height: abreast ? agree.height + 0.3 * Theme.gap
                            : agree.height + decline.height + (back.visible ? back.height + 0.5 * Theme.gap : 0) + 0.8 * Theme.gap
            BigButton {
                id: agree
                objectName: "agree"
                most: answers.width
                x: Theme.across(answers.width - width, width, answers.width)
                y: 0.3 * Theme.gap
                quiet: !view.consent.complete
                words: view.words["consent-agree"]
                onClicked: view.consent.agree()
            }
            BigButton {
                id: decline
                objectName: "decline"
                most: answers.width
                x: Theme.across(answers.width - width - (answers.abreast ? agree.width + Theme.gap : 0), width, answers.width)
                y: answers.abreast ? agree.y : agree.y + agree.height + 0.5 * Theme.gap
                quiet: true
                horizontalPadding: 44 * Theme.unit
                words: view.words["consent-decline"]
                onClicked: view.consent.decline()
            }
            BigButton {
                id: back
                objectName: "back"
                visible: view.kiosk.goesBack
                x: Theme.across(0, width, answers.width)
                most: answers.width
                y: answers.abreast ? agree.y + (agree.height - height) / 2 : decline.y + decline.height + 0.5 * Theme.gap
                quiet: true
                horizontalPadding: 34 * Theme.unit
                verticalPadding: 18 * Theme.unit
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
