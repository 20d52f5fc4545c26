// What can be done at once, one gap apart: what is done all day, then a break, and last what ends a session.
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
    // One gap parts them all, as it parts the cards of the page.
    required property real space
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    readonly property bool normal: Theme.textSize <= 1.15
    readonly property bool underWay: choices.underWay
    readonly property var offered: choices.breaks ?? []
    readonly property var named: [words[underWay ? "console-repeat" : "console-test-the-voice"], ...(has("mute") ? [words[choices.muted ? "console-heard" : "console-mute"]] : []), ...(has("backup") ? [words["console-backup"]] : [])].map(each => each ?? "")

    // Whole pixels, so that all rows end in line.
    readonly property real across: Math.floor(width)
    readonly property real edge: Math.round(1.4 * Theme.gap)
    readonly property real lettering: lettered(size)
    readonly property real lowest: (wide ? 72 : 88) * Theme.unit
    // The first two stand side by side on an upright page, where both have one line there.
    readonly property bool paired: pairs(size)
    readonly property real daily: paired ? Math.floor((across - spacing) / 2) : across
    readonly property int rows: rowsOf(size)
    readonly property real tall: Math.max(low(lettering), Math.min(normal ? (wide ? 4.2 : 3.1) * lettering : 0, Math.floor((least - beyond(lettering) - (rows - 1) * spacing) / rows)))

    // All words have one line, where that does not make them small. On an upright page they have the room to be larger
    // than those of the notice.
    function lettered(size: real): real {
        if (!normal)
            return size
        const most = wide ? size : Math.max(size, Math.min(1.2 * size, 36 * Theme.unit))
        const room = across - 2 * edge, half = pairs(size) ? Math.floor((across - spacing) / 2) - 2 * edge : room
        const needs = [...named, words["console-abort"] ?? ""].map((text, at) => (at < 2 ? half : room) / (wordWidths.bold(text, 1) + 2.3))
        return Math.floor(Math.max(Math.min(size, 1.2 * Theme.dense), Math.min(most, ...needs)))
    }
    function pairs(size: real): bool {
        const half = Math.floor((across - spacing) / 2) - 2 * edge
        return !wide && has("mute") && named.slice(0, 2).every(text => size * (wordWidths.bold(text, 1) + 2.3) <= half)
    }
    function rowsOf(size: real): int {
        const asked = Math.ceil(offered.length / besides())
        return named.length - (pairs(size) ? 1 : 0) + (underWay ? 1 : 0) + asked
    }
    function low(size: real): real {
        return Math.ceil(Math.max(lowest, 1.4 * size + 18 * Theme.unit))
    }
    // What the break needs beyond its rows: its title stands above its answers.
    function beyond(size: real): real {
        return offered.length === 0 ? 0 : titled(size) + below
    }
    function titled(size: real): real {
        return Math.ceil(1.4 * size * wordWidths.lines(words["console-break"] ?? "", size, across))
    }
    readonly property real below: Math.round(10 * Theme.unit)
    // How many answers stand in a row: four have two rows in a column.
    function besides(): int {
        return wide && offered.length > 3 ? 2 : Math.max(1, offered.length)
    }
    // How high they are at least if their words are written so large.
    function deep(size: real): real {
        const letters = lettered(size)
        return Math.ceil(rowsOf(size) * (low(letters) + spacing) - spacing + beyond(letters))
    }

    // Whether the button of an action stands here.
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

    spacing: space
    Accessible.role: Accessible.Grouping
    Accessible.name: words["console-actions"]

    component Action: PanelButton {
        least: actions.tall
        width: actions.across
        horizontalPadding: actions.edge
        ground: Theme.white
        ringInPlace: true
        font { pixelSize: actions.lettering; bold: true }
    }

    Grid {
        columns: actions.paired ? 2 : 1
        spacing: actions.spacing

        // While a visitor is there, the voice is theirs.
        Action {
            width: actions.daily
            objectName: "test-voice"
            visible: !actions.underWay
            enabled: !actions.choices.muted
            words: actions.words["console-test-the-voice"]
            drawing: "M3.5 4.5 H20.5 V16 H11.5 L7 20.5 V16 H3.5 Z"
            onClicked: actions.panel.wish("test_voice", "")
        }
        Action {
            width: actions.daily
            objectName: "action-again"
            visible: actions.underWay
            words: actions.words["console-repeat"]
            drawing: "M19.5 12 A7.5 7.5 0 1 1 16.6 6.1 M17.5 2 V6.8 H12.7"
            onClicked: actions.panel.wish("repeat", "")
        }
        Action {
            width: actions.daily
            id: mute
            objectName: "action-mute"
            visible: actions.has("mute")
            words: actions.choices.muted ? actions.words["console-heard"] : actions.words["console-mute"]
            drawing: actions.signs[actions.choices.muted ? "mute" : "silence"]
            onClicked: actions.panel.wish("mute", "")
        }
    }
    // Why a copy has to wait may take two lines.
    Action {
        id: backup
        objectName: "action-backup"
        visible: actions.has("backup")
        enabled: actions.choices.backup === ""
        words: actions.words["console-backup"] + (enabled ? "" : ": " + actions.choices.backup)
        drawing: actions.signs.backup
        onClicked: actions.panel.wish("backup", "")
    }
    // The heading of the break begins where its answers do.
    Column {
        visible: actions.offered.length > 0
        width: actions.across
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
            strong: true
            across: actions.besides()
            between: Math.round(12 * Theme.unit)
            least: actions.tall
            size: actions.lettering
            // A little smaller where that keeps them in their row.
            lettering: Math.floor(actions.lettering * Math.min(1, (each - 20 * Theme.unit) / Math.max(1, widest)))
            ground: Theme.white
            title: actions.words["console-break"]
            options: actions.offered
            chosen: actions.choices.break ?? ""
            onPicked: value => actions.panel.wish("break", value)
        }
    }
    // Last: it takes a game from a visitor.
    Action {
        objectName: "action-end"
        visible: actions.underWay
        grave: true
        words: actions.words["console-abort"]
        drawing: "M12.5 4 H4.5 V20 H12.5 M9.5 12 H21 M16.5 7.5 L21 12 L16.5 16.5"
        onClicked: actions.panel.wish("abort", "")
    }
}
