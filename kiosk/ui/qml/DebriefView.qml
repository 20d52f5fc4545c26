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
    readonly property real side: Math.max((texts.halved || view.signed && width > height ? 230 : 290) * Theme.unit, Math.min(350 * Theme.unit, room - texts.height - 2.6 * Theme.gap))
    // Whole pixels for each square, so that their edges are sharp.
    readonly property int square: Math.max(2, Math.floor(side / Math.max(1, debrief.squares)))

    // Lines with drawings stand below each other, as large as the page has room for above the card; on a page that has too
    // little for that, without the drawings.
    readonly property bool signed: debrief.lines.length > 0 && debrief.lines[0].sign !== "" && fits(Theme.small)
    readonly property real size: signed ? [34, 32, 29].map(Theme.size).find(size => fits(size)) ?? Theme.small
        : room < 720 * Theme.unit ? Theme.small : Theme.reading
    FontMetrics {
        id: letters
        font.pixelSize: 100
    }
    function fits(size: real): bool {
        const wide = (column - 2.5 * size - Theme.gap) * 0.9
        const tall = debrief.lines.reduce((sum, line) =>
            sum + Math.max(2.5 * size, Math.ceil(letters.advanceWidth(line.text) * size / 100 / wide) * 1.5 * size), 0)
        return tall + debrief.lines.length * 0.5 * Theme.gap + 350 * Math.max(1, Theme.textSize) * Theme.unit <= room
    }

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
        Row {
            id: texts
            readonly property var lines: view.debrief.lines
            readonly property bool halved: pane.width > 1100 * Theme.unit && lines.length > 1 && !view.signed
            readonly property int first: halved ? view.half(lines.map(line => line.text)) : lines.length
            width: pane.width
            spacing: 2 * Theme.gap
            Repeater {
                model: texts.halved ? 2 : 1
                Column {
                    id: part
                    required property int index
                    width: texts.halved ? (texts.width - texts.spacing) / 2 : texts.width
                    spacing: (view.signed ? 0.5 : 1) * Theme.gap
                    Repeater {
                        model: part.index === 0 ? texts.lines.slice(0, texts.first) : texts.lines.slice(texts.first)
                        SignedLine {
                            required property var modelData
                            width: part.width
                            text: modelData.text
                            sign: view.signed ? modelData.sign : ""
                            size: view.size
                        }
                    }
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
                PlainText {
                    width: parent.width
                    text: view.words["debrief-take-home"] + (view.labName === "" ? "" : " · " + view.labName)
                    font { pixelSize: Theme.body; bold: true }
                    horizontalAlignment: Text.AlignLeft
                    wrapMode: Text.Wrap
                }
                Item {
                    width: parent.width
                    height: Math.max(called.height, code.height)
                    visible: view.debrief.code !== ""
                    PlainText {
                        id: called
                        x: Theme.across(0, width, parent.width)
                        y: (parent.height - height) / 2
                        width: Math.min(implicitWidth, 0.45 * parent.width)
                        text: view.words["debrief-code"]
                        font.pixelSize: Theme.small
                        horizontalAlignment: Text.AlignLeft
                        wrapMode: Text.Wrap
                        color: Theme.faintInk
                    }
                    PlainText {
                        id: code
                        objectName: "code"
                        x: Theme.across(called.width + Theme.gap, width, parent.width)
                        width: parent.width - called.width - Theme.gap
                        text: view.debrief.code
                        horizontalAlignment: Text.AlignLeft
                        font { pixelSize: Theme.figure; bold: true; letterSpacing: 4 * Theme.unit }
                        fontSizeMode: Text.HorizontalFit
                        minimumPixelSize: Theme.body
                        color: Theme.sea
                    }
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
                    objectName: "returning"
                    width: parent.width
                    visible: text !== ""
                    text: view.debrief.returning
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
