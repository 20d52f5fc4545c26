// Everything that is to be done: a line for each matter, with what to do about it, or with the button that does it.
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
    // The actions that answer one of them: their buttons stand here, and not among the others.
    // On an upright page all actions stay where they are, just above or below, and the line only says what to do.
    property bool answering: true
    readonly property var answered: answering ? matters.map(matter => matter.action ?? "").filter(action => action !== "") : []
    // How much of such a button is seen; a finger reaches it above and below that, so that the lines stay close.
    readonly property real place: 42 * Theme.unit
    readonly property real past: 13 * Theme.unit
    // How high its line is at least: as high as the others, unless there are two, which a finger must tell apart.
    readonly property real row: (answered.length > 1 ? 64 : 48) * Theme.unit
    // The bar at its edge has the colour that warns; the ground is pale, so that the actions are seen first.
    readonly property real bar: 14 * Theme.unit

    // What to do stands behind what is wrong, in a column of its own, where both fit in one line; otherwise below it.
    // They are written a little smaller if they fit so. Where not all fit, each that does stands behind its own words.
    // An upright page has the height for large letters instead.
    readonly property real smallest: (Theme.upright ? 1.1 : 0.87) * usual
    readonly property real room: roomed(size)
    readonly property real inset: Math.round(1.1 * Theme.gap)
    readonly property bool beside: fitted(size) >= smallest
    readonly property real written: letters(size)
    readonly property real second: widest(bold, matters.map(matter => said(matter)), written) + 1.5 * Theme.gap
    readonly property real tall: beside ? pitch(written) : 0
    readonly property var signs: ({
        backup: "M8.5 8 H20 V21 H8.5 Z M5 16 H4 V3 H15.5 V4.5",
        mute: "M3 9.5 H7 L12.5 5 V19 L7 14.5 H3 Z M16 9 A4.5 4.5 0 0 1 16 15 M18.8 6.2 A8.5 8.5 0 0 1 18.8 17.8"
    })

    // Whether its line has the button.
    function does(matter: var): bool {
        return answering && Boolean(matter?.action)
    }
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
    // How wide the button is, or the words that say what to do.
    function answer(matter: var, size: real): real {
        return long(matter.remedy, plain, size) + (does(matter) ? 1.8 * size + 36 * Theme.unit : 0)
    }
    function roomed(size: real): real {
        return width - 2 * inset - 1.4 * size
    }
    // How large all of it fits in two columns of single lines. Small letters are a little wider than large ones made smaller.
    function fitted(size: real): real {
        const both = widest(bold, matters.map(matter => said(matter)), 100) + Math.max(0, ...matters.map(matter => long(matter.remedy, plain, 100) + (does(matter) ? 320 : 0)))
        return 99 * (roomed(size) - 1.5 * Theme.gap - 4 * Theme.unit) / both
    }
    function letters(size: real): real {
        const fits = fitted(size)
        return fits < Math.round(size) && fits >= smallest ? Math.floor(fits * Math.min(1, size / Math.round(size))) : size
    }
    // All lines have one height.
    function pitch(written: real): real {
        return Math.ceil(Math.max(48 * Theme.unit, 1.45 * written))
    }
    // How high it is if it is written so large.
    function deep(size: real): real {
        if (fitted(size) >= smallest)
            return matters.reduce((sum, matter) => sum + Math.max(does(matter) ? row : 0, pitch(letters(size))), 0) + 0.6 * Theme.gap
        const room = roomed(size), line = Math.ceil(plain.height * size / 100)
        const heights = matters.map(matter => {
            const said = long(notice.said(matter), bold, size), remedy = answer(matter, size)
            const first = line * Math.ceil(1.1 * said / room - 0.1)
            const second = does(matter) ? row : line * Math.ceil(1.1 * remedy / room - 0.1)
            return matter.remedy === "" ? first : said + Theme.gap + remedy <= room ? Math.max(first, does(matter) ? row : 0) : first + second
        })
        return heights.reduce((sum, each) => sum + each, 0) + (matters.length - 1) * 5 * Theme.unit + 0.7 * Theme.gap
    }

    // Give the keyboard to the button of an action, if it stands here.
    function take(action: string): bool {
        const found = [mute, backup].find(each => each.visible && each.action === action)
        found?.button.forceActiveFocus(Qt.OtherFocusReason)
        return found !== undefined
    }

    // A line, with its words, and what to do about it or the button that does it.
    component Matter: Row {
        id: line
        property var matter: null
        readonly property string action: notice.does(matter) ? matter.action : ""
        property alias button: button
        visible: matter !== null
        width: sentence.width
        readonly property real tall: action === "" ? notice.tall : Math.max(notice.tall, notice.row)
        height: Math.max(implicitHeight, tall)
        topPadding: Math.max(0, (tall - words.height) / 2)
        spacing: 0.4 * notice.size
        Item {
            width: mark.width
            height: told.height
            PanelMark {
                id: mark
                anchors.verticalCenter: line.action === "" ? undefined : parent.verticalCenter
                well: false
                size: notice.written
            }
        }
        // A matter's further lines stand below its words, and not below its mark.
        Flow {
            id: words
            width: notice.room
            PlainText {
                id: told
                width: notice.beside ? notice.second : Math.min(notice.room, notice.long(text, bold, notice.written) + Theme.gap)
                height: Math.max(implicitHeight, line.action === "" ? 0 : notice.place)
                verticalAlignment: Text.AlignVCenter
                text: line.matter === null ? "" : notice.said(line.matter)
                font { pixelSize: notice.written; bold: true }
                color: Theme.ink
                wrapMode: Text.Wrap
            }
            PlainText {
                visible: text !== ""
                width: notice.beside ? notice.room - notice.second : Math.min(notice.room, notice.long(text, plain, notice.written))
                text: line.action === "" ? line.matter?.remedy ?? "" : ""
                font.pixelSize: notice.written
                color: Theme.ink
                wrapMode: Text.Wrap
            }
            Item {
                visible: line.action !== ""
                width: button.width
                height: notice.place
                PanelButton {
                    id: button
                    objectName: `action-${line.action}`
                    anchors.centerIn: parent
                    width: Math.min(Math.ceil(implicitWidth), notice.room)
                    enabled: line.action !== "backup" || notice.panel.choices.backup === ""
                    least: notice.place + 2 * notice.past
                    topInset: notice.past
                    bottomInset: notice.past
                    topPadding: 0
                    bottomPadding: 0
                    ground: Theme.white
                    words: line.matter?.remedy ?? ""
                    drawing: notice.signs[line.action] ?? ""
                    sign: 1.2 * notice.written
                    font.pixelSize: notice.written
                    onClicked: notice.panel.wish(line.action, "")
                }
            }
        }
    }

    // Whole pixels, so that the cards below it end level with the one beside them.
    height: Math.ceil(sentence.height + (beside ? 0.6 : 0.7) * Theme.gap)
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
        spacing: notice.beside ? 0 : 5 * Theme.unit
        Repeater {
            model: notice.matters.filter(matter => !notice.does(matter))
            delegate: Matter {
                required property var modelData
                matter: modelData
            }
        }
        // Not made anew with the others: the keyboard, or a finger that lies on one, would lose it.
        Matter {
            id: mute
            matter: notice.matters.find(matter => notice.does(matter) && matter.action === "mute") ?? null
        }
        Matter {
            id: backup
            matter: notice.matters.find(matter => notice.does(matter) && matter.action === "backup") ?? null
        }
    }
}
