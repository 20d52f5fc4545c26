// Everything that is to be done: a line for each matter, with what to do about it.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: notice

    required property PanelScreen panel
    // How large it is written where its lines have the room, and at least, if they then stand in two columns.
    required property real size
    required property real usual
    readonly property var matters: panel.health.matters
    // The bar at its edge has the colour that warns; the ground is pale, so that the actions are seen first.
    readonly property real bar: 14 * Theme.unit

    // What to do stands behind what is wrong, in a column of its own, where both fit in one line; otherwise below it.
    // They are written a little smaller if they fit so. Where not all fit, each that does stands behind its own words.
    readonly property real room: roomed(size)
    readonly property real inset: Math.round(1.1 * Theme.gap)
    readonly property bool beside: fitted(size) >= 0.87 * usual
    readonly property real written: letters(size)
    readonly property real second: widest(bold, matters.map(matter => said(matter)), written) + 1.5 * Theme.gap
    readonly property real tall: beside ? pitch(written) : 0

    function said(matter: var): string {
        return `${matter.name}: ${matter.message}`
    }
    // Letters are drawn in whole pixels.
    function long(text: string, measure: FontMetrics, size: real): real {
        return Math.ceil(measure.advanceWidth(text) * Math.round(size) / 100) + 2 * Theme.unit
    }
    function widest(measure: FontMetrics, texts: var, size: real): real {
        return Math.max(0, ...texts.map(text => long(text, measure, size)))
    }
    function roomed(size: real): real {
        return width - 2 * inset - 1.4 * size
    }
    // How large all of it fits in two columns of single lines. Small letters are a little wider than large ones made smaller.
    function fitted(size: real): real {
        const both = widest(bold, matters.map(matter => said(matter)), 100) + widest(plain, matters.map(matter => matter.remedy), 100)
        return 99 * (roomed(size) - 1.5 * Theme.gap - 4 * Theme.unit) / both
    }
    function letters(size: real): real {
        const fits = fitted(size)
        return fits < Math.round(size) && fits >= 0.87 * usual ? Math.floor(fits * Math.min(1, size / Math.round(size))) : size
    }
    // Lines of a few matters stand apart; many stay close, and so do larger letters, so that the page does not scroll for them.
    function pitch(written: real): real {
        return Math.ceil((matters.length > 3 || written > usual ? 1.5 : 1.9) * written)
    }
    // How high it is if it is written so large.
    function deep(size: real): real {
        if (fitted(size) >= 0.87 * usual)
            return matters.length * pitch(letters(size)) + 0.6 * Theme.gap
        const room = roomed(size)
        const lines = matters.map(matter => {
            const said = long(notice.said(matter), bold, size), remedy = long(matter.remedy, plain, size)
            return matter.remedy === "" || said + Theme.gap + remedy <= room ? Math.ceil(1.1 * said / room - 0.1) : Math.ceil(1.1 * said / room - 0.1) + Math.ceil(1.1 * remedy / room - 0.1)
        })
        return lines.reduce((sum, each) => sum + each, 0) * Math.ceil(plain.height * size / 100) + (matters.length - 1) * 7 * Theme.unit + 0.9 * Theme.gap
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
        font { pixelSize: 100; bold: true }
    }
    FontMetrics {
        id: plain
        font.pixelSize: 100
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
                        width: notice.beside ? notice.second : Math.min(notice.room, notice.long(text, bold, notice.written) + Theme.gap)
                        text: notice.said(matter.modelData)
                        font { pixelSize: notice.written; bold: true }
                        color: Theme.ink
                        wrapMode: Text.Wrap
                    }
                    PlainText {
                        visible: text !== ""
                        width: notice.beside ? notice.room - notice.second : Math.min(notice.room, notice.long(text, plain, notice.written))
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
