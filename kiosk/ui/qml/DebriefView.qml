// What the study was about, and the code to withdraw with: to be written down, or photographed.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

FocusScope {
    id: view

    required property DebriefScreen debrief
    required property KioskScreen kiosk
    required property var words
    required property string labName

    // Whole pixels for each square, so that their edges are sharp.
    readonly property int square: Math.max(2, Math.round(290 * Theme.unit / Math.max(1, debrief.squares)))

    onVisibleChanged: go.focus = true
    Keys.onPressed: event => pane.turn(event)

    Column {
        anchors.centerIn: parent
        width: Math.min((view.width > 1600 * Theme.unit ? 1500 : 1200) * Theme.unit, view.width - 4 * Theme.gap)
        spacing: 1.2 * Theme.gap

        PlainText {
            id: title
            width: parent.width
            text: view.debrief.title
            font { pixelSize: Theme.heading; bold: true }
            wrapMode: Text.Wrap
            color: Theme.ink
        }
        ScrollPane {
            id: pane
            width: parent.width
            room: view.height - title.height - keepsake.height - go.height - 7 * Theme.gap
            more: view.words["scroll-more"]
            Paragraphs {
                width: parent.width
                texts: view.debrief.paragraphs
            }
        }
        Rectangle {
            id: keepsake
            width: parent.width
            height: visible ? Math.max(qr.height, told.height) + 1.5 * Theme.gap : 0
            // Who is not stored has no code, and may have questions all the same.
            visible: view.debrief.code !== "" || view.debrief.questions !== ""
            radius: Theme.radius
            color: Theme.white
            border { color: Theme.amber; width: 4 * Theme.unit }

            // On white even where the theme is dark: a camera needs it.
            Rectangle {
                id: qr
                objectName: "qr"
                visible: view.debrief.code !== ""
                anchors { left: parent.left; leftMargin: 0.75 * Theme.gap; verticalCenter: parent.verticalCenter }
                width: view.square * view.debrief.squares
                height: width
                color: "white"
                Image {
                    anchors.fill: parent
                    source: view.debrief.picture
                    smooth: false
                    cache: false
                    Accessible.ignored: true
                }
            }
            Column {
                id: told
                anchors {
                    left: qr.right; leftMargin: (qr.visible ? 1.5 : 0.25) * Theme.gap
                    right: parent.right; rightMargin: Theme.gap
                    verticalCenter: parent.verticalCenter
                }
                spacing: 0.3 * Theme.gap
                PlainText {
                    width: parent.width
                    text: view.words["debrief-take-home"] + (view.labName === "" ? "" : " · " + view.labName)
                    font { pixelSize: Theme.small; bold: true }
                    wrapMode: Text.Wrap
                    color: Theme.deepAmber
                }
                PlainText {
                    objectName: "summary"
                    width: parent.width
                    visible: text !== ""
                    text: view.debrief.summary
                    font.pixelSize: Theme.small
                    wrapMode: Text.Wrap
                    color: Theme.ink
                }
                PlainText {
                    width: parent.width
                    visible: view.debrief.code !== ""
                    text: view.words["debrief-code"]
                    font.pixelSize: Theme.small
                    wrapMode: Text.Wrap
                    color: Theme.faintInk
                }
                PlainText {
                    objectName: "code"
                    width: parent.width
                    visible: text !== ""
                    text: view.debrief.code
                    font { pixelSize: Theme.figure; bold: true; letterSpacing: 4 * Theme.unit }
                    fontSizeMode: Text.HorizontalFit
                    minimumPixelSize: Theme.body
                    color: Theme.sea
                }
                PlainText {
                    width: parent.width
                    visible: text !== ""
                    text: view.debrief.withdrawing
                    font.pixelSize: Theme.small
                    wrapMode: Text.Wrap
                    color: Theme.ink
                }
                PlainText {
                    objectName: "questions"
                    width: parent.width
                    visible: text !== ""
                    text: view.debrief.questions
                    font.pixelSize: Theme.small
                    wrapMode: Text.Wrap
                    color: Theme.ink
                }
            }
        }
        WayOn {
            id: go
            width: parent.width
            kiosk: view.kiosk
            words: view.words
            label: view.words["debrief-continue"]
            focus: true
            onWent: view.debrief.proceed()
        }
    }
}
