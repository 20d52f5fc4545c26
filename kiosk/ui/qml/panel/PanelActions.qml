// What can be done at once: what is done all day first, then a break, and apart at the foot what ends a session.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Column {
    id: actions

    required property PanelScreen panel
    required property bool wide
    // The actions whose buttons stand elsewhere, as they answer what is not well.
    required property var answered
    // How large their words are where they fit, and how high the column is at least.
    required property real size
    property real least: 0
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    readonly property bool normal: Theme.textSize <= 1.15
    readonly property bool underWay: choices.underWay
    readonly property bool pausing: choices.onBreak ?? false
    readonly property var offered: choices.breaks ?? []

    // Whole pixels, so that all rows end in line.
    readonly property real space: Math.round((wide ? 12 : 16) * Theme.unit)
    readonly property real across: Math.floor(width)
    readonly property real edge: (wide ? 26 : 20) * Theme.unit
    readonly property real lettering: lettered(size)
    // What stands side by side on an upright page: all in one row, each below its drawing, where their words have the room.
    readonly property var named: [...(underWay ? ["console-stay-paused", "console-repeat"] : ["console-test-the-voice"]), ...(has("backup") ? ["console-backup"] : []), ...(has("mute") ? [choices.muted ? "console-heard" : "console-mute"] : [])].map(name => words[name] ?? "")
    readonly property int columns: wide ? 1 : !normal ? (named.length % 2 === 0 ? 2 : 1) : named.length === 4 && !narrow(4) ? 2 : named.length
    readonly property bool stacked: !wide && columns > 2
    readonly property real each: Math.floor((across - (columns - 1) * space) / columns)

    // How high the rows are: a column beside the rest of the page is filled.
    readonly property int mains: (pausing ? 1 : 0) + (choices.canBeNext ? 1 : 0)
    readonly property int rows: Math.ceil(named.length / columns)
    readonly property real lowest: (wide ? 68 : 84) * Theme.unit
    readonly property real parted: Math.round((wide ? 22 : 14) * Theme.unit)
    readonly property int breakRows: offered.length === 0 ? 0 : wide ? Math.ceil(offered.length / breaks.across) : 1
    readonly property real headed: wide && offered.length > 0 ? Math.ceil(1.4 * lettering * wordWidths.plainLines(words["console-break"] ?? "", lettering, across)) + breaks.spacing : 0
    readonly property int lines: rows + breakRows + (underWay ? 1 : 0)
    readonly property real share: least > 0 && normal ? (least - fixed(headed)) / (lines + 1.2 * mains) : 0
    readonly property real tall: Math.floor(Math.max(lowest, Math.min(120 * Theme.unit, share)))
    // What a column has left parts the end of a session from the rest.
    readonly property real over: wide && underWay && normal ? Math.max(0, Math.floor(least - fixed(headed) - lines * tall - mains * mainTall)) : 0
    readonly property real mainTall: Math.floor(1.2 * tall)
    readonly property real tileTall: Math.max(tall, Math.round(tiled(lettering)))

    // All words have one line in a column, where that does not make them small.
    function lettered(size: real): real {
        if (!normal)
            return size
        const room = (wide ? across : across / 2) - 2 * edge
        const needs = [...named.map((text, at) => wordWidths.plain(text, 1) + (at === 0 && underWay && wide ? 1 : 0)), wordWidths.bold(words["console-abort"] ?? "", 1)].map(each => each + 2.1)
        const fits = Math.min(...needs.map((each, at) => (room - (at === 0 && underWay ? 96 * Theme.unit : 0)) / (each + 0.2)))
        return Math.floor(Math.max(Math.min(size, 1.2 * Theme.dense), Math.min(size, fits)))
    }
    // Whether so many beside each other have the room for their longest words, if they are large.
    function narrow(many: int): bool {
        const room = (across - (many - 1) * space) / many - 2 * 14 * Theme.unit
        return named.every(text => text.split(" ").every(word => wordWidths.bold(word, 36 * Theme.unit) < room))
    }
    // How high a button with its drawing above its words is.
    function tiled(size: real): real {
        const room = (across - (columns - 1) * space) / columns - 2 * 14 * Theme.unit
        return stacked ? 2.2 * size + 1.4 * size * Math.max(...named.map(text => wordWidths.plainLines(text, size, room))) + 44 * Theme.unit : 0
    }
    function fixed(headed: real): real {
        return (rows + (breakRows > 0 ? 1 : 0) + (underWay ? 1 : 0) + mains - 1) * space + Math.max(0, breakRows - 1) * breaks.between + headed + (underWay ? parted : 0)
    }
    // How high they are at least if their words are written so large.
    function deep(size: real): real {
        const letters = lettered(size)
        const headed = wide && offered.length > 0 ? Math.ceil(1.4 * letters * wordWidths.plainLines(words["console-break"] ?? "", letters, across)) + breaks.spacing : 0
        const low = Math.max(lowest, 1.4 * letters + 18 * Theme.unit)
        return Math.ceil(fixed(headed) + (stacked ? rows * Math.max(low, tiled(letters)) + (lines - rows) * low : lines * low) + 1.2 * mains * low)
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

    // The largest: what is pressed all day.
    component Main: PanelButton {
        least: actions.mainTall
        width: actions.across
        font.pixelSize: 1.12 * actions.lettering
    }
    component Action: PanelButton {
        least: actions.stacked ? actions.tileTall : actions.tall
        width: actions.each
        stacked: actions.stacked
        ground: Theme.white
        horizontalPadding: stacked ? 14 * Theme.unit : actions.edge
        font.pixelSize: actions.lettering
    }

    Main {
        objectName: "break-end"
        filled: true
        visible: actions.pausing
        words: actions.words["console-break-end"]
        drawing: "M8 5 L19 12 L8 19 Z"
        onClicked: actions.panel.wish("break", "")
    }
    Main {
        objectName: "action-next"
        filled: !actions.pausing
        visible: actions.choices.canBeNext
        words: actions.words["console-next"]
        drawing: "M4 12 H20 M13.5 5.5 L20 12 L13.5 18.5"
        onClicked: actions.panel.wish("next", "")
    }
    Grid {
        columns: actions.columns
        spacing: actions.space
        // While a visitor is there, the voice is theirs.
        Action {
            objectName: "test-voice"
            visible: !actions.underWay
            enabled: !actions.choices.muted
            words: actions.words["console-test-the-voice"]
            drawing: "M3.5 4.5 H20.5 V16 H11.5 L7 20.5 V16 H3.5 Z"
            onClicked: actions.panel.wish("test_voice", "")
        }
        PanelSwitch {
            objectName: "action-pause"
            visible: actions.underWay
            least: actions.stacked ? actions.tileTall : actions.tall
            width: actions.each
            stacked: actions.stacked
            ground: Theme.white
            horizontalPadding: stacked ? 14 * Theme.unit : actions.edge
            font.pixelSize: actions.lettering
            words: actions.words["console-stay-paused"]
            whenOn: actions.words["console-switch-on"]
            whenOff: actions.words["console-switch-off"]
            drawing: "M8.5 5 V19 M15.5 5 V19"
            on: actions.choices.staysPaused
            onClicked: actions.panel.wish("pause", "")
        }
        Action {
            objectName: "action-again"
            visible: actions.underWay
            words: actions.words["console-repeat"]
            drawing: "M19.5 12 A7.5 7.5 0 1 1 16.6 6.1 M17.5 2 V6.8 H12.7"
            onClicked: actions.panel.wish("repeat", "")
        }
        // Why a copy has to wait may take two lines.
        Action {
            id: backup
            objectName: "action-backup"
            visible: actions.has("backup")
            enabled: actions.choices.backup === ""
            words: actions.words["console-backup"] + (enabled ? "" : ": " + actions.choices.backup)
            drawing: "M8.5 8 H20 V21 H8.5 Z M5 16 H4 V3 H15.5 V4.5"
            onClicked: actions.panel.wish("backup", "")
        }
        Action {
            id: mute
            objectName: "action-mute"
            visible: actions.has("mute")
            words: actions.choices.muted ? actions.words["console-heard"] : actions.words["console-mute"]
            drawing: "M3 9.5 H7 L12.5 5 V19 L7 14.5 H3 Z " + (actions.choices.muted ? "M16 9 A4.5 4.5 0 0 1 16 15 M18.8 6.2 A8.5 8.5 0 0 1 18.8 17.8" : "M16.5 9.5 L21.5 14.5 M21.5 9.5 L16.5 14.5")
            onClicked: actions.panel.wish("mute", "")
        }
    }
    // On an upright page its title stands beside its answers.
    Row {
        visible: actions.offered.length > 0
        spacing: actions.space
        Balanced {
            id: asked
            // In one line, where that leaves the answers the room.
            readonly property real whole: Math.ceil(1.02 * wordWidths.plain(text, font.pixelSize)) + actions.space
            visible: !actions.wide
            width: whole + actions.offered.length * (170 * Theme.unit + actions.space) <= actions.across ? whole : Math.ceil(0.66 * whole)
            horizontalAlignment: Text.AlignLeft
            anchors.verticalCenter: parent.verticalCenter
            text: breaks.title
            font.pixelSize: actions.lettering
            color: Theme.ink
            wrapMode: Text.Wrap
        }
        PanelChoice {
            id: breaks
            width: actions.wide ? actions.across : Math.floor(actions.across - asked.width - actions.space)
            action: "break"
            titled: actions.wide
            even: true
            // Four in one row of a column would have smaller letters only.
            across: actions.wide && options.length > 3 ? 2 : Math.max(1, options.length)
            between: actions.space
            least: actions.tall
            size: actions.lettering
            lettering: actions.lettering
            ground: Theme.white
            title: actions.words["console-break"]
            options: actions.offered
            chosen: actions.choices.break ?? ""
            onPicked: value => actions.panel.wish("break", value)
        }
    }
    // Apart, at the foot: it takes a game from a visitor.
    Column {
        visible: actions.underWay
        Item {
            width: actions.across
            height: actions.parted + actions.over
        }
        PanelButton {
            objectName: "action-end"
            width: actions.across
            least: actions.tall
            grave: true
            centred: !actions.wide
            ground: Theme.white
            horizontalPadding: actions.edge
            font.pixelSize: actions.lettering
            words: actions.words["console-abort"]
            drawing: "M12.5 4 H4.5 V20 H12.5 M9.5 12 H21 M16.5 7.5 L21 12 L16.5 16.5"
            onClicked: actions.panel.wish("abort", "")
        }
    }
}
