// Everything that is to be done: a line for each matter, with what to do about it.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: notice

    required property PanelScreen panel
    required property real size
    readonly property var matters: panel.health.matters
    // The bar at its edge has the colour that warns; the ground is pale, so that the actions are seen first.
    readonly property real bar: 14 * Theme.unit

    // What to do stands behind what is wrong, in a column of its own, where both fit in one line; otherwise below it.
    // They are written a little smaller if they fit so. Where not all fit, each that does stands behind its own words.
    readonly property real room: width - 2 * inset - 1.4 * size
    readonly property real inset: Math.round(1.1 * Theme.gap)
    readonly property real whole: widest(bold, matters.map(matter => said(matter)), bold.font)
    readonly property real both: whole + widest(plain, matters.map(matter => matter.remedy), plain.font)
    readonly property real fitting: Math.min(1, (room - 1.5 * Theme.gap) / both)
    readonly property bool beside: fitting >= 0.89
    readonly property real written: beside && fitting < 1 ? Math.floor(fitting * size) : size
    readonly property real longest: Math.ceil(whole * written / size) + 2 * Theme.unit
    readonly property real second: longest + 1.5 * Theme.gap
    // Lines of a few matters stand apart; many stay close, so that the page does not scroll for them.
    readonly property real tall: beside ? Math.ceil((matters.length > 3 ? 1.5 : 1.9) * written) : 0

    function said(matter: var): string {
        return `${matter.name}: ${matter.message}`
    }
    // What is measured depends on the font, which is named for that reason alone.
    function long(text: string, letters: FontMetrics, _font: font): real {
        return Math.ceil(letters.advanceWidth(text)) + 2 * Theme.unit
    }
    function widest(letters: FontMetrics, texts: var, _font: font): real {
        return Math.ceil(Math.max(0, ...texts.map(text => letters.advanceWidth(text)))) + 2 * Theme.unit
    }

    // Whole pixels, so that the cards below it end level with the one beside them.
    height: Math.ceil(sentence.height + (beside ? 0.6 : 0.9) * Theme.gap)
    radius: Theme.radius
    color: Theme.amber

    Rectangle {
        readonly property real line: 2 * Theme.unit
        x: notice.bar
        y: line
        width: parent.width - notice.bar - line
        height: parent.height - 2 * line
        radius: notice.radius - line
        topLeftRadius: 0
        bottomLeftRadius: 0
        color: Theme.cautious
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
        anchors { left: parent.left; right: parent.right; margins: notice.inset; verticalCenter: parent.verticalCenter }
        spacing: notice.beside ? 0 : 7 * Theme.unit
        Repeater {
            model: notice.matters
            delegate: Row {
                id: matter
                required property var modelData
                width: sentence.width
                height: Math.max(implicitHeight, notice.tall)
                topPadding: Math.max(0, (notice.tall - words.height) / 2)
                spacing: 0.4 * notice.size
                PanelMark {
                    well: false
                    size: notice.written
                }
                // A matter's further lines stand below its words, and not below its mark.
                Flow {
                    id: words
                    width: notice.room
                    PlainText {
                        width: notice.beside ? notice.second : Math.min(notice.room, notice.long(text, bold, bold.font) + Theme.gap)
                        text: notice.said(matter.modelData)
                        font { pixelSize: notice.written; bold: true }
                        color: Theme.ink
                        wrapMode: Text.Wrap
                    }
                    PlainText {
                        visible: text !== ""
                        width: notice.beside ? notice.room - notice.second : Math.min(notice.room, notice.long(text, plain, plain.font))
                        text: matter.modelData.remedy
                        font.pixelSize: notice.written
                        color: Theme.ink
                        wrapMode: Text.Wrap
                    }
                }
            }
        }
    }
}
