// That all is well, or what is not: a line for each matter, and what to do about it.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Rectangle {
    id: notice

    required property var health
    required property real size
    readonly property color front: Theme.ink
    readonly property color sign: health.well ? Theme.sea : Theme.deepAmber
    // The bar at its edge has the colour that warns; the ground is pale, so that the actions are seen first.
    readonly property real bar: 14 * Theme.unit

    // What to do stands behind what is wrong, in a column of its own, where both fit in one line; otherwise below it.
    // They are written a little smaller if they fit so.
    readonly property real room: width - 2 * inset - 1.4 * size
    readonly property real inset: Math.round(1.1 * Theme.gap)
    readonly property real whole: widest(bold, health.matters.map(matter => said(matter)), bold.font)
    readonly property real both: whole + widest(plain, health.matters.map(matter => matter.remedy), plain.font)
    readonly property real fitting: Math.min(1, (room - 1.5 * Theme.gap) / both)
    readonly property bool beside: fitting >= 0.89
    readonly property real written: beside && fitting < 1 ? Math.floor(fitting * size) : size
    readonly property real longest: Math.ceil(whole * written / size) + 2 * Theme.unit

    function said(matter: var): string {
        return `${matter.name}: ${matter.message}`
    }
    // What is measured depends on the font, which is named for that reason alone.
    function widest(letters: FontMetrics, texts: var, _font: font): real {
        return Math.ceil(Math.max(0, ...texts.map(text => letters.advanceWidth(text)))) + 2 * Theme.unit
    }

    height: sentence.height + 1.2 * Theme.gap
    radius: Theme.radius
    color: health.well ? Theme.sea : Theme.amber

    Rectangle {
        readonly property real line: 2 * Theme.unit
        x: Theme.across(notice.bar, width, parent.width)
        y: line
        width: parent.width - notice.bar - line
        height: parent.height - 2 * line
        radius: notice.radius - line
        topLeftRadius: Theme.mirrored ? radius : 0
        bottomLeftRadius: Theme.mirrored ? radius : 0
        topRightRadius: Theme.mirrored ? 0 : radius
        bottomRightRadius: Theme.mirrored ? 0 : radius
        color: notice.health.well ? Theme.white : Theme.cautious
    }
    FontMetrics {
        id: bold
        font { pixelSize: notice.size; bold: true }
    }
    FontMetrics {
        id: plain
        font.pixelSize: notice.size
    }
    Column {
        id: sentence
        objectName: "panel-summary"
        anchors { left: parent.left; right: parent.right; margins: notice.inset; verticalCenter: parent.verticalCenter }
        spacing: (notice.beside ? 4 : 10) * Theme.unit
        Row {
            visible: notice.health.well
            spacing: 0.4 * notice.size
            PanelMark {
                well: true
                size: notice.size
                tone: notice.sign
            }
            PlainText {
                width: notice.room
                text: notice.health.summary
                font { pixelSize: notice.size; bold: true }
                color: notice.front
                wrapMode: Text.Wrap
            }
        }
        Repeater {
            model: notice.health.matters
            delegate: Row {
                id: matter
                required property var modelData
                width: sentence.width
                spacing: 0.4 * notice.size
                PanelMark {
                    well: false
                    size: notice.written
                    tone: notice.sign
                }
                // A matter's further lines stand below its words, and not below its mark.
                Flow {
                    width: notice.room
                    PlainText {
                        width: notice.beside ? notice.longest + 1.5 * Theme.gap : parent.width
                        text: notice.said(matter.modelData)
                        font { pixelSize: notice.written; bold: true }
                        color: notice.front
                        wrapMode: Text.Wrap
                    }
                    PlainText {
                        visible: text !== ""
                        width: notice.beside ? notice.room - notice.longest - 1.5 * Theme.gap : parent.width
                        text: matter.modelData.remedy
                        font.pixelSize: notice.written
                        color: notice.front
                        wrapMode: Text.Wrap
                    }
                }
            }
        }
    }
}
