// What can be done at once: in two tiles what is done all day, then a break, and apart from them what ends a session.
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
    // How far the cards of the page are from each other.
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
    readonly property real each: Math.floor((across - (daily.length - 1) * between) / daily.length)
    readonly property real between: Math.round(12 * Theme.unit)
    readonly property real edge: Math.round(Theme.gap)
    readonly property real lettering: lettered(size)
    // What a page has left is shared by the tiles and by the air: before the break, and most of it before the end.
    readonly property real free: Math.max(0, least - deep(size))
    readonly property real tall: tileDeep(lettering) + Math.floor(Math.min((wide ? 0.48 : 0.4) * free, Theme.gap + 4.2 * lettering))
    readonly property real low: lowOf(lettering) + Math.floor(Math.min(0.08 * free, 0.6 * lettering))
    readonly property real apart: space + Math.floor(Math.min(0.17 * free, 2.5 * Theme.gap))
    readonly property real last: Math.round(1.3 * space)
    readonly property real below: Math.round(10 * Theme.unit)

    // All words have one line, where that does not make them small.
    function lettered(size: real): real {
        const needs = daily.map(text => (each - 2 * edge) / (wordWidths.bold(text, 1) + 0.1))
        return normal ? Math.floor(Math.max(Math.min(size, 1.2 * Theme.dense), Math.min(size, ...needs))) : size
    }
    function lowOf(letters: real): real {
        return Math.ceil(Math.max((wide ? 72 : 84) * Theme.unit, 1.4 * letters + 18 * Theme.unit))
    }
    function tileDeep(letters: real): real {
        const lines = Math.max(1, ...daily.map(text => wordWidths.lines(text, letters, each - 2 * edge)))
        return Math.ceil((2.55 + 1.37 * lines) * letters + 0.85 * Theme.gap)
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
        const copies = copying === "" ? 0 : between + Math.max(row, 1.4 * letters * wordWidths.lines(copying, letters, across - 2 * edge - 2 * letters) + 18 * Theme.unit)
        const asked = rows === 0 ? 0 : space + titled(letters) + below + rows * (row + between) - between
        const ends = underWay ? last + Math.max(row, 1.4 * letters * wordWidths.lines(words["console-abort"] ?? "", letters, across - 2 * edge - 2 * letters) + 18 * Theme.unit) : 0
        return Math.ceil(tileDeep(letters) + copies + asked + ends)
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

    Accessible.role: Accessible.Grouping
    Accessible.name: words["console-actions"]

    component Action: PanelButton {
        least: stacked ? actions.tall : actions.low
        width: stacked ? actions.each : actions.across
        horizontalPadding: actions.edge
        plain: true
        ringInPlace: true
        font { pixelSize: actions.lettering; bold: true }
    }

    Row {
        spacing: actions.between

        // While a visitor is there, the voice is theirs.
        Action {
            stacked: true
            objectName: "test-voice"
            visible: !actions.underWay
            enabled: !actions.choices.muted
            words: actions.words["console-test-the-voice"]
            drawing: "M3.5 4.5 H20.5 V16 H11.5 L7 20.5 V16 H3.5 Z"
            onClicked: actions.panel.wish("test_voice", "")
        }
        Action {
            stacked: true
            objectName: "action-again"
            visible: actions.underWay
            words: actions.words["console-repeat"]
            drawing: "M19.5 12 A7.5 7.5 0 1 1 16.6 6.1 M17.5 2 V6.8 H12.7"
            onClicked: actions.panel.wish("repeat", "")
        }
        Action {
            stacked: true
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
    // Last, and apart: it takes a game from a visitor.
    Item {
        visible: end.visible
        width: 1
        height: Math.max(actions.last, actions.least - actions.above - end.height)
    }
    Action {
        id: end
        width: Math.min(actions.across, Math.ceil(implicitWidth))
        horizontalPadding: 2 * Theme.gap
        x: Math.floor((actions.across - width) / 2)
        objectName: "action-end"
        visible: actions.underWay
        plain: false
        grave: true
        ground: "transparent"
        least: actions.lowOf(actions.lettering)
        words: actions.words["console-abort"]
        drawing: "M12.5 4 H4.5 V20 H12.5 M9.5 12 H21 M16.5 7.5 L21 12 L16.5 16.5"
        onClicked: actions.panel.wish("abort", "")
    }
    // How high all is that stands before the end.
    readonly property real above: tall + (copying === "" ? 0 : between + backup.height) + (offered.length === 0 ? 0 : apart + titled(lettering) + below + breaks.height)
}
