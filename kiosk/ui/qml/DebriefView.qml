// What the study was about, and the code to withdraw with: to be written down, or photographed.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

PageFrame {
    id: view

    required property DebriefScreen debrief
    required property string labName

    // As much of the height as the text leaves, so that a page that fits does not scroll.
    readonly property real side: Math.max((texts.columns > 1 ? 230 : 290) * Theme.unit, Math.min(350 * Theme.unit, room - texts.height - 2.6 * Theme.gap))
    // Whole pixels for each square, so that their edges are sharp.
    readonly property int square: Math.max(2, Math.floor(side / Math.max(1, debrief.squares)))

    title: debrief.title
    label: words["debrief-continue"]
    onWent: debrief.proceed()
    onVisibleChanged: way.focus = true
    Keys.onPressed: event => pane.turn(event)

    ScrollPane {
        id: pane
        width: parent?.width ?? 0
        y: view.sink(height)
        room: view.room
        spacing: Theme.gap
        more: view.words["scroll-more"]
        // Short lines are read with less effort than long ones: in two columns where there is room.
        Grid {
            id: texts
            readonly property var lines: view.debrief.lines
            columns: pane.width > 1100 * Theme.unit && lines.length > 1 ? 2 : 1
            columnSpacing: 2 * Theme.gap
            rowSpacing: Theme.gap
            Repeater {
                model: texts.lines
                SignedLine {
                    required property var modelData
                    width: (pane.width - (texts.columns - 1) * texts.columnSpacing) / texts.columns
                    text: modelData.text
                    sign: modelData.sign
                    size: view.room < 720 * Theme.unit ? Theme.small : Theme.reading
                }
            }
        }
        Rectangle {
            id: keepsake
            width: pane.width
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
                SignedLine {
                    width: parent.width
                    text: view.words["debrief-take-home"] + (view.labName === "" ? "" : " · " + view.labName)
                    sign: "camera"
                    strong: true
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
                PlainText {
                    objectName: "summary"
                    width: parent.width
                    visible: text !== ""
                    text: view.debrief.summary
                    font.pixelSize: Theme.small
                    wrapMode: Text.Wrap
                    color: Theme.faintInk
                }
            }
        }
    }
}
