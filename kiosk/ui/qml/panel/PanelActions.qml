// What can be done at once, in buttons of one height: what is done all day, a break, and last what ends a session.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Column {
    id: actions

    required property PanelScreen panel
    required property bool wide
    // The actions whose buttons stand elsewhere, as they answer what is not well, and what all of them look like.
    required property var answered
    required property var signs
    // How large their words are where they fit, and how high the list is at least.
    required property real size
    property real least: 0
    // How far the cards of the page are from each other, and the buttons too.
    required property real space
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    readonly property bool normal: Theme.textSize <= 1.15
    readonly property bool underWay: choices.underWay
    readonly property var offered: choices.breaks ?? []
    readonly property list<string> daily: [words[underWay ? "console-repeat" : "console-test-the-voice"], ...(has("mute") ? [words[choices.muted ? "console-heard" : "console-mute"]] : [])].map(each => each ?? "")
    readonly property string copying: !has("backup") ? "" : (words["console-backup"] ?? "") + (choices.backup === "" ? "" : ": " + choices.backup)

    // Whole pixels, so that all rows end in line.
    readonly property real across: Math.floor(width)
    readonly property real between: Math.round(space)
    // Side by side, unless the words are large.
    readonly property int pairs: normal ? daily.length : 1
    readonly property real each: Math.floor((across - (pairs - 1) * between) / pairs)
    readonly property real edge: Math.round(0.8 * Theme.gap)
    readonly property real lettering: lettered(size)
    readonly property int rows: daily.length / pairs + (copying === "" ? 0 : 1) + (underWay ? 1 : 0) + (offered.length === 0 ? 0 : Math.ceil(offered.length / besides(lettering)))
    // What is left goes to all rows alike, and then to the air around the break.
    readonly property real free: Math.max(0, least - deep(size))
    readonly property real grown: Math.floor(Math.min(free / rows, mostGrown))
    readonly property real mostGrown: 40 * Theme.unit
    readonly property real low: lowOf(lettering) + grown
    readonly property real apart: between + (offered.length === 0 ? 0 : Math.floor(Math.min(0.5 * (free - rows * grown), 5 * between)))
    // How high the list is before it looks loose.
    readonly property real most: Math.floor(deep(size) + rows * mostGrown + between)
    readonly property real below: Math.round(8 * Theme.unit)

    // All words have one line, where that does not make them small.
    function lettered(size: real): real {
        const needs = daily.map(text => (each - 2 * edge) / (1.02 * wordWidths.bold(text, 1) + 2))
        return normal ? Math.floor(Math.max(Math.min(size, 1.1 * Theme.dense), Math.min(size, ...needs))) : size
    }
    function lowOf(letters: real): real {
        return Math.ceil(Math.max(84 * Theme.unit, 1.4 * letters + 18 * Theme.unit))
    }
    // How high what is done all day is: one row, or one below the other.
    function dailyDeep(letters: real): real {
        const lines = text => wordWidths.lines(text, letters, each - 2 * edge - 2 * letters)
        const high = daily.map(text => Math.max(lowOf(letters), 1.4 * lines(text) * letters + 18 * Theme.unit))
        return pairs > 1 ? Math.max(...high) : high.reduce((sum, one) => sum + one + between, -between)
    }
    function titled(letters: real): real {
        return Math.ceil(1.4 * letters * wordWidths.lines(words["console-break"] ?? "", letters, across))
    }
    // How many answers stand in a row, and how wide each is there.
    function besides(letters: real): int {
        const wish = Math.max(0, ...offered.map(option => wordWidths.bold(option.label, 0.8 * letters))) + 20 * Theme.unit
        return Math.max(1, Math.min(offered.length, Math.floor((across + between) / (wish + between))))
    }
    // How high they are at least if their words are written so large.
    function deep(size: real): real {
        const letters = lettered(size), row = lowOf(letters), rows = Math.ceil(offered.length / besides(letters))
        const copied = copying === "" ? 0 : between + Math.max(row, 1.4 * letters * wordWidths.lines(copying, letters, across - 2 * edge - 2 * letters) + 18 * Theme.unit)
        const rested = offered.length === 0 ? 0 : between + titled(letters) + below + rows * row + (rows - 1) * between
        return Math.ceil(dailyDeep(letters) + copied + rested + (underWay ? between + row : 0))
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

    Accessible.role: Accessible.Grouping
    Accessible.name: words["console-actions"]

    component Action: PanelButton {
        least: actions.low
        width: actions.across
        horizontalPadding: actions.edge
        plain: true
        ringInPlace: true
        font { pixelSize: actions.lettering; bold: true }
    }

    Grid {
        columns: actions.pairs
        spacing: actions.between

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
    Item {
        visible: backup.visible
        width: 1
        height: actions.between
    }
    // Why a copy has to wait may take two lines.
    Action {
        id: backup
        objectName: "action-backup"
        visible: actions.has("backup")
        enabled: actions.choices.backup === ""
        words: actions.copying
        drawing: actions.signs.backup
        onClicked: actions.panel.wish("backup", "")
    }
    // The heading of the break begins where its answers do.
    Column {
        visible: actions.offered.length > 0
        width: actions.across
        topPadding: actions.apart
        spacing: actions.below
        PlainText {
            width: parent.width
            height: actions.titled(actions.lettering)
            verticalAlignment: Text.AlignVCenter
            text: breaks.title
            font { pixelSize: actions.lettering; bold: true }
            color: Theme.ink
            wrapMode: Text.Wrap
        }
        PanelChoice {
            id: breaks
            readonly property real widest: Math.max(0, ...actions.offered.map(option => wordWidths.bold(option.label, actions.lettering)))
            width: actions.across
            action: "break"
            titled: false
            even: true
            plain: true
            across: actions.besides(actions.lettering)
            between: actions.between
            least: actions.low
            // A little smaller where that keeps them in their row.
            lettering: Math.floor(actions.lettering * Math.min(1, (each - 20 * Theme.unit) / Math.max(1, widest)))
            title: actions.words["console-break"]
            options: actions.offered
            chosen: actions.choices.break ?? ""
            onPicked: value => actions.panel.wish("break", value)
        }
    }
    Item {
        visible: end.visible
        width: 1
        height: actions.apart
    }
    // Last: it takes a game from a visitor.
    Action {
        id: end
        objectName: "action-end"
        visible: actions.underWay
        grave: true
        words: actions.words["console-abort"]
        drawing: "M12.5 4 H4.5 V20 H12.5 M9.5 12 H21 M16.5 7.5 L21 12 L16.5 16.5"
        onClicked: actions.panel.wish("abort", "")
    }
}
