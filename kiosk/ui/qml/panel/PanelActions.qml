// What can be done at once, in rows of one shape: what it is about, and its buttons. The last one ends the session.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: actions

    required property PanelScreen panel
    // The actions whose buttons stand elsewhere, as they answer what is not well, and what all of them look like.
    required property var answered
    required property var signs
    // How large their words are where they fit, and how high the card is at least.
    required property real size
    property real least: 0
    // Whether it has a heading, and how high that is then.
    property bool titled: false
    property real head: 0
    required property real heading
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    readonly property bool normal: Theme.textSize <= 1.15
    readonly property bool underWay: choices.underWay
    readonly property var offered: choices.breaks ?? []
    // A session goes on by itself after a break. Between visitors, the screen only says when the experimenter is back.
    readonly property string breaking: underWay ? "console-pause-row" : "console-break-row"
    readonly property list<string> daily: [words[underWay ? "console-repeat" : "console-test-the-voice"], ...(has("mute") ? [words[choices.muted ? "console-heard" : "console-mute"]] : [])].map(each => each ?? "")
    readonly property string copying: !has("backup") ? "" : (words["console-backup"] ?? "") + (choices.backup === "" ? "" : ": " + choices.backup)
    readonly property list<string> names: [words["console-sound"], ...(copying === "" ? [] : [words["console-data"]]), ...(offered.length === 0 ? [] : [words[breaking]]), ...(underWay ? [words["console-session"]] : [])].map(each => each ?? "")

    // The same as in the card of what is not well, so that the rows of both stand in line.
    readonly property real inset: Math.round(1.4 * Theme.gap)
    readonly property real above: Math.round(0.5 * Theme.gap)
    readonly property real between: Math.round(0.42 * Theme.gap)
    readonly property real across: Math.floor(width - 2 * inset)
    readonly property real apart: Math.round(0.75 * Theme.gap)
    readonly property real edge: Math.round(0.9 * Theme.gap)
    // Two buttons stand side by side, and names before them, unless the words are large.
    readonly property int pairs: normal ? daily.length : 1
    readonly property bool aside: normal && largest(true) >= Math.min(size, 1.1 * Theme.dense)
    readonly property real lettering: lettered(size)
    readonly property real before: aside ? named(lettering) + Theme.gap : 0
    readonly property real room: across - before
    readonly property real each: Math.floor((room - (pairs - 1) * apart) / pairs)
    // All rows are as high unless one of them needs more, and what is left makes the buttons a little higher.
    readonly property real even: Math.floor((least - 2 * above - head) / names.length)
    readonly property real share: rowsOf(size).every(each => each <= even) ? even : 0
    readonly property real more: Math.max(0, Math.floor((least - head - deep(size)) / names.length))
    readonly property real grown: Math.floor(Math.min(0.25 * more, (Theme.upright ? 20 : 0) * Theme.unit))
    readonly property real low: lowOf(lettering) + grown
    // How high the card is before it looks loose.
    readonly property real most: Math.floor(head + deep(size) + names.length * 84 * Theme.unit)
    readonly property real below: Math.round(6 * Theme.unit)

    // How large words are at most for the two buttons to have one line each, beside the names or below them.
    function largest(beside: bool): real {
        const wide = pairs * Math.max(...daily.map(text => 1.02 * wordWidths.bold(text, 1) + 2))
        const name = beside ? wordWidths.column(names, 100) / 100 : 0
        return (across - (beside ? Theme.gap + 16 * Theme.unit : 0) - (pairs - 1) * apart - 2 * pairs * edge) / (wide + name)
    }
    function lettered(size: real): real {
        return normal ? Math.floor(Math.max(Math.min(size, 1.1 * Theme.dense), Math.min(size, largest(aside)))) : size
    }
    function named(letters: real): real {
        return wordWidths.column(names, letters)
    }
    function roomOf(letters: real): real {
        return across - (aside ? named(letters) + Theme.gap : 0)
    }
    function lowOf(letters: real): real {
        return Math.ceil(Math.max((Theme.upright ? 80 : 72) * Theme.unit, 1.4 * letters + 18 * Theme.unit))
    }
    function high(text: string, letters: real, wide: real): real {
        return Math.max(lowOf(letters), 1.4 * letters * wordWidths.lines(text, letters, wide - 2 * edge - 1.95 * letters) + 18 * Theme.unit)
    }
    // How many lengths of a break stand in a row.
    function besides(letters: real): int {
        const wish = Math.max(0, ...offered.map(option => wordWidths.bold(option.label, 0.8 * letters))) + 20 * Theme.unit
        return Math.max(1, Math.min(offered.length, Math.floor(roomOf(letters) / wish)))
    }
    // How high its rows are at least if its words are written so large, and the whole card.
    function rowsOf(size: real): var {
        const letters = lettered(size), room = roomOf(letters), row = lowOf(letters)
        const own = Math.floor((room - (pairs - 1) * apart) / pairs), said = daily.map(text => high(text, letters, own))
        const rests = Math.ceil(offered.length / besides(letters))
        const rows = [pairs > 1 ? Math.max(...said) : said.reduce((sum, one) => sum + one + apart, -apart)]
        if (copying !== "")
            rows.push(high(copying, letters, room))
        if (rests > 0)
            rows.push(rests * row)
        if (underWay)
            rows.push(high(words["console-abort"] ?? "", letters, room))
        return rows.map(each => each + 2 * between + (aside ? 0 : Math.ceil(1.4 * letters) + below))
    }
    function deep(size: real): real {
        return Math.ceil(2 * above + rowsOf(size).reduce((sum, each) => sum + each, 0))
    }
    function has(action: string): bool {
        return !answered.includes(action)
    }
    // Give the keyboard to the button of an action.
    function take(action: string) {
        const found = [backup, mute].find(each => each.visible && each.objectName === "action-" + action)
        found?.forceActiveFocus(Qt.OtherFocusReason)
    }
    WordWidths {
        id: wordWidths
    }

    // Whole pixels, so that the cards of the page end level with each other.
    height: Math.ceil(Math.max(least, rows.height + head + 2 * above))
    radius: Theme.radius
    color: Theme.white
    border { color: Theme.edge; width: 2 * Theme.unit }
    Accessible.role: Accessible.Grouping
    Accessible.name: words["console-actions"]

    component Action: PanelButton {
        least: actions.low
        width: actions.room
        horizontalPadding: actions.edge
        ground: Theme.white
        font { pixelSize: actions.lettering; bold: true }
    }
    // What it is about, and behind that or below it what can be done.
    component Line: Item {
        id: line
        property string name: ""
        property bool first: false
        default property alias content: place.data
        width: actions.across
        height: Math.max(actions.share, 2 * actions.between + (actions.share > 0 ? 0 : actions.more - actions.grown) + place.height + (actions.aside ? 0 : label.height + actions.below))
        Rectangle {
            visible: !line.first
            width: parent.width
            height: 2 * Theme.unit
            color: Theme.edge
        }
        PlainText {
            id: label
            y: actions.aside ? Math.floor((line.height - height) / 2) : place.y - height - actions.below
            width: actions.aside ? actions.before : actions.across
            text: line.name
            font.pixelSize: actions.lettering
            color: Theme.ink
            wrapMode: Text.Wrap
        }
        Column {
            id: place
            x: actions.before
            y: Math.floor((line.height - height + (actions.aside ? 0 : label.height + actions.below)) / 2)
            width: actions.room
        }
    }

    PlainText {
        visible: actions.titled
        x: actions.inset
        y: actions.above + actions.between
        width: actions.across
        text: actions.words["console-actions"] ?? ""
        font { pixelSize: actions.heading; bold: true }
        color: Theme.faintInk
    }
    Column {
        id: rows
        anchors { left: parent.left; right: parent.right; margins: actions.inset; verticalCenter: parent.verticalCenter; verticalCenterOffset: actions.head / 2 }
        Line {
            name: actions.words["console-sound"] ?? ""
            first: true
            Grid {
                columns: actions.pairs
                spacing: actions.apart

                // While a visitor is there, the voice is theirs.
                Action {
                    width: actions.each
                    objectName: "test-voice"
                    visible: !actions.underWay
                    enabled: !actions.choices.muted
                    words: actions.words["console-test-the-voice"]
                    drawing: "M3.5 4.5 H20.5 V16 H11.5 L7 20.5 V16 H3.5 Z"
                    onClicked: actions.panel.wish("test_voice", "")
                }
                Action {
                    width: actions.each
                    objectName: "action-again"
                    visible: actions.underWay
                    words: actions.words["console-repeat"]
                    drawing: "M19.5 12 A7.5 7.5 0 1 1 16.6 6.1 M17.5 2 V6.8 H12.7"
                    onClicked: actions.panel.wish("repeat", "")
                }
                Action {
                    width: actions.each
                    id: mute
                    objectName: "action-mute"
                    visible: actions.has("mute")
                    words: actions.choices.muted ? actions.words["console-heard"] : actions.words["console-mute"]
                    drawing: actions.signs[actions.choices.muted ? "mute" : "silence"]
                    onClicked: actions.panel.wish("mute", "")
                }
            }
        }
        // Why a copy has to wait may take two lines.
        Line {
            name: actions.words["console-data"] ?? ""
            visible: actions.has("backup")
            Action {
                id: backup
                objectName: "action-backup"
                visible: actions.has("backup")
                enabled: actions.choices.backup === ""
                words: actions.copying
                drawing: actions.signs.backup
                onClicked: actions.panel.wish("backup", "")
            }
        }
        Line {
            name: actions.words[actions.breaking] ?? ""
            visible: actions.offered.length > 0
            PanelChoice {
                id: breaks
                readonly property real widest: Math.max(0, ...actions.offered.map(option => wordWidths.bold(option.label, actions.lettering)))
                width: actions.room
                action: "break"
                titled: false
                even: true
                joined: true
                across: actions.besides(actions.lettering)
                least: actions.low
                // A little smaller where that keeps them in their row.
                lettering: Math.floor(actions.lettering * Math.min(1, (each - 20 * Theme.unit) / Math.max(1, widest)))
                title: actions.words["console-break"]
                options: actions.offered
                chosen: actions.choices.break ?? ""
                onPicked: value => actions.panel.wish("break", value)
            }
        }
        // Last: it takes a game from a visitor.
        Line {
            name: actions.words["console-session"] ?? ""
            visible: actions.underWay
            Action {
                objectName: "action-end"
                visible: actions.underWay
                grave: true
                words: actions.words["console-abort"]
                drawing: "M12.5 4 H4.5 V20 H12.5 M9.5 12 H21 M16.5 7.5 L21 12 L16.5 16.5"
                onClicked: actions.panel.wish("abort", "")
            }
        }
    }
}
