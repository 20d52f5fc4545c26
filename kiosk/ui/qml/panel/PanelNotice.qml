// Everything that is to be done: a row for each matter, with what to do about it below, or the button that does it beside it.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: notice

    required property PanelScreen panel
    required property real size
    readonly property var matters: panel.health.matters
    // The actions that answer one of them: their buttons stand here, and not among the others.
    readonly property var answered: matters.map(matter => matter.action ?? "").filter(action => action !== "")
    readonly property var rest: matters.filter(matter => !matter.action)
    // In line with those of the checks below.
    readonly property int columns: columnsOf(size)
    readonly property real gutter: Math.round(1.6 * Theme.gap)
    // The bar at its edge has the colour that warns; the ground is pale.
    readonly property real bar: 14 * Theme.unit
    readonly property real inset: Math.round(1.4 * Theme.gap)
    readonly property real mark: 1.7 * size
    readonly property real between: 18 * Theme.unit
    readonly property real answer: 0.94 * size
    // As high as the other buttons of the page.
    readonly property real least: (Theme.upright ? 84 : 76) * Theme.unit
    readonly property var signs: ({
        backup: "M8.5 8 H20 V21 H8.5 Z M5 16 H4 V3 H15.5 V4.5",
        mute: "M3 9.5 H7 L12.5 5 V19 L7 14.5 H3 Z M16 9 A4.5 4.5 0 0 1 16 15 M18.8 6.2 A8.5 8.5 0 0 1 18.8 17.8"
    })

    function said(matter: var): string {
        return `${matter.name}: ${matter.message}`
    }
    // How wide the button of a matter is.
    function pressed(matter: var, size: real): real {
        return matter.action ? wordWidths.bold(matter.remedy, size) + 2.05 * size + 58 * Theme.unit : 0
    }
    // What its words have beside that; a button without the room for it stands below them.
    function aside(matter: var, size: real, room: real): bool {
        return pressed(matter, size) > 0 && pressed(matter, size) + Math.min(1.02 * wordWidths.bold(said(matter), size), 14 * size) + Theme.gap <= room
    }
    // Whether all matters with a button have one line beside it if it is written so large.
    function holds(size: real): bool {
        const room = width - 2 * inset - 1.7 * size
        return matters.every(matter => !matter.action || pressed(matter, size) + 1.02 * wordWidths.bold(said(matter), size) + Theme.gap <= room)
    }
    // What is done elsewhere stands in two columns, where that breaks no line of it.
    function columnsOf(size: real): int {
        const room = each(2) - 1.7 * size
        const fits = matter => 1.02 * Math.max(wordWidths.bold(said(matter), size), wordWidths.plain(matter.remedy, 0.94 * size), wordWidths.plain(matter.command ?? "", 0.94 * size)) <= room
        return !Theme.upright && rest.length > 1 && rest.every(fits) ? 2 : 1
    }
    // How wide each of so many columns is.
    function each(columns: int): real {
        return Math.floor((width - 2 * inset - (columns - 1) * gutter) / columns)
    }
    // How high it is if it is written so large.
    function deep(size: real): real {
        const line = each => Math.ceil(1.4 * each), columns = columnsOf(size)
        const high = matter => {
            const room = (matter.action ? each(1) : each(columns)) - 1.7 * size
            const beside = aside(matter, size, room), own = beside ? room - pressed(matter, size) - Theme.gap : room
            const words = wordWidths.lines(said(matter), size, own) * line(size)
            const told = matter.action || !matter.remedy ? 0 : toldLines(matter, 0.94 * size, own) * line(0.94 * size)
            const button = matter.action ? Math.max(least, line(size) + 18 * Theme.unit) : 0
            return beside ? Math.max(button, words) : words + told + button
        }
        const rows = matters.filter(matter => matter.action).map(high)
        for (let at = 0; at < rest.length; at += columns)
            rows.push(Math.max(...rest.slice(at, at + columns).map(high)))
        return Math.ceil(rows.reduce((sum, each) => sum + each, 0) + (rows.length - 1) * between + 1.3 * Theme.gap)
    }
    function toldLines(matter: var, size: real, room: real): int {
        const parts = [matter.remedy, matter.command ?? ""].filter(text => text !== "")
        const whole = parts.reduce((sum, text) => sum + 1.02 * wordWidths.plain(text, size) + 0.7 * size, 0)
        return whole <= room ? 1 : parts.reduce((sum, text) => sum + wordWidths.plainLines(text, size, room), 0)
    }
    // Give the keyboard to the button of an action, if it stands here.
    function take(action: string): bool {
        const found = [mute, backup].find(each => each.visible && each.action === action)
        found?.button.forceActiveFocus(Qt.OtherFocusReason)
        return found !== undefined
    }
    WordWidths {
        id: wordWidths
    }

    component Matter: Item {
        id: row
        property var matter: null
        readonly property string action: matter?.action ?? ""
        readonly property bool aside: matter !== null && notice.aside(matter, notice.size, row.room)
        property alias button: button
        visible: matter !== null
        width: notice.each(1)
        readonly property real room: width - notice.mark
        height: aside ? Math.max(words.height, button.height) : words.height + (action === "" ? 0 : button.height + 6 * Theme.unit)
        PanelMark {
            y: words.y
            well: false
            grown: 1.2
            size: notice.size
        }
        Column {
            id: words
            x: notice.mark
            y: row.aside ? Math.floor((row.height - height) / 2) : 0
            width: row.aside ? row.room - button.width - Theme.gap : row.room
            PlainText {
                width: parent.width
                text: row.matter === null ? "" : notice.said(row.matter)
                font { pixelSize: notice.size; bold: true }
                color: Theme.ink
                wrapMode: Text.Wrap
            }
            // What is to be typed elsewhere is quieter than what to do, and stands behind it or below.
            Grid {
                visible: row.action === "" && Boolean(row.matter?.remedy)
                columns: remedy.implicitWidth + columnSpacing + command.implicitWidth <= words.width ? 2 : 1
                columnSpacing: 0.6 * notice.size
                PlainText {
                    id: remedy
                    width: Math.min(implicitWidth, words.width)
                    text: row.matter?.remedy ?? ""
                    font.pixelSize: notice.answer
                    color: Theme.ink
                    wrapMode: Text.Wrap
                }
                PlainText {
                    id: command
                    visible: text !== ""
                    width: Math.min(implicitWidth, words.width)
                    text: row.matter?.command ?? ""
                    font.pixelSize: notice.answer
                    color: Theme.faintInk
                    wrapMode: Text.Wrap
                }
            }
        }
        PanelButton {
            id: button
            objectName: `action-${row.action}`
            visible: row.action !== ""
            x: row.aside ? row.width - width : notice.mark
            y: row.aside ? Math.floor((row.height - height) / 2) : words.height + 6 * Theme.unit
            width: Math.min(Math.ceil(implicitWidth), row.room)
            enabled: row.action !== "backup" || notice.panel.choices.backup === ""
            least: notice.least
            filled: true
            horizontalPadding: 28 * Theme.unit
            words: row.matter?.remedy ?? ""
            drawing: notice.signs[row.action] ?? ""
            font.pixelSize: notice.size
            onClicked: notice.panel.wish(row.action, "")
        }
    }

    // Whole pixels, so that the cards below it end level with the one beside them.
    height: Math.ceil(rows.height + 1.3 * Theme.gap)
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
    Column {
        id: rows
        anchors { left: parent.left; right: parent.right; margins: notice.inset; verticalCenter: parent.verticalCenter }
        spacing: notice.between
        // What a finger can do here stands first. Not made anew with the others: the keyboard, or a finger that lies on
        // one, would lose it.
        Matter {
            id: mute
            matter: notice.matters.find(matter => matter.action === "mute") ?? null
        }
        Matter {
            id: backup
            matter: notice.matters.find(matter => matter.action === "backup") ?? null
        }
        Grid {
            visible: notice.rest.length > 0
            columns: notice.columns
            columnSpacing: notice.gutter
            rowSpacing: notice.between
            Repeater {
                model: notice.rest
                delegate: Matter {
                    required property var modelData
                    matter: modelData
                    width: notice.each(notice.columns)
                }
            }
        }
    }
}
