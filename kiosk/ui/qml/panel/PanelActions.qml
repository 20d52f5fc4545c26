// What can be done at once: what is done all day first and largest, and apart at the foot what ends a session.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

PanelSection {
    id: actions

    required property PanelScreen panel
    required property bool wide
    // The actions whose buttons stand elsewhere, as they answer what is not well.
    required property var answered
    // What each row of an upright screen has beside its own.
    property real spread: 0
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    // Whole pixels, so that all rows end in line. Side by side, two stand so far apart that neither is touched for the other.
    readonly property real space: Math.round(apart)
    readonly property real across: Math.floor(width - 2 * inset)
    readonly property real gutter: wide ? space : Math.round(40 * Theme.unit)
    readonly property real half: Math.floor((across - gutter) / 2)
    readonly property real edge: (wide ? 24 : 20) * Theme.unit
    readonly property bool normal: Theme.textSize <= 1.15

    // How high they are: in a column of their own they share what it has.
    readonly property bool underWay: choices.underWay
    readonly property bool pausing: choices.onBreak ?? false
    readonly property int mains: (pausing ? 1 : 0) + (choices.canBeNext ? 1 : 0)
    readonly property int others: (underWay ? 5 : 3) - answered.length + (breaks.visible ? breaks.rows : 0)
    readonly property real fixed: frame + (mains + others - 1) * space + lower.words
    // Whether an upright page has much to tell.
    readonly property bool full: panel.health.matters.length > 3 || panel.records.sessions.length > 3
    // The rows of an upright page beside the main ones, and how high they are without the spread.
    readonly property int lines: (pairs.fits ? Math.ceil(pairs.many / 2) : pairs.many) + (breaks.visible ? 1 : 0) + (underWay && !lower.halves ? 1 : 0)
    // Between sessions an upright page has three of them: the copy stands beside the break then, so that no row has one alone.
    readonly property bool beside: !wide && normal && !underWay && breaks.visible && pairs.fits
    readonly property real bare: frame + (lines + 1.1 * mains) * lowest + (lines + mains - 1) * space + lower.topPadding + (breaks.visible ? breaks.heading + breaks.spacing : 0) + (underWay && !lower.halves ? end.above : 0)
    readonly property real lowest: (wide ? (mains > 0 ? 76 : 80) : full ? 76 : 90) * Theme.unit
    readonly property real share: wide && least > 0 && normal ? (least - fixed) / (others + 1.25 * mains) : 0
    readonly property real tall: Math.floor(Math.max(lowest + spread, Math.min(128 * Theme.unit, share)))
    readonly property real mainTall: Math.floor((wide ? 1.25 : 1.1) * tall)

    // What stands above buttons is not larger than their words.
    readonly property real label: normal ? Math.min(size, lettering) : size
    readonly property real lettering: (normal ? wide ? 1.32 : 1.1 : 1) * Theme.dense

    // How high it is at least if what stands above its buttons is written so large.
    function deep(size: real): real {
        const tall = Math.ceil(letters.height * size / 100)
        const lines = text => Math.ceil(1.1 * letters.advanceWidth(text) * size / 100 / lower.each - 0.1)
        const asked = breaks.visible ? tall * lines(breaks.title) + breaks.spacing : 0
        const parted = underWay && !lower.halves ? line.height + tall * lines(then.text) + 2 * end.spacing : 0
        const rows = wide ? others + 1.25 * mains : actions.lines + 1.1 * mains
        return Math.ceil(1.12 * tall) + edges + rows * lowest + ((wide ? others : actions.lines) + mains - 1) * space + lower.topPadding + asked + parted
    }
    FontMetrics {
        id: letters
        font.pixelSize: 100
    }

    // Whether the button of an action stands here.
    function has(action: string): bool {
        return !answered.includes(action)
    }
    // Give the keyboard to the button of an action.
    function take(action: string) {
        const found = [backup, mute, lastBackup].find(each => each.visible && each.objectName === "action-" + action)
        found?.forceActiveFocus(Qt.OtherFocusReason)
    }

    title: words["console-actions"]
    apart: (wide ? 12 : full ? 14 : 18) * Theme.unit

    // The largest: what is pressed all day.
    component Main: PanelButton {
        least: actions.mainTall
        width: actions.across
        font.pixelSize: 1.12 * actions.lettering
    }
    component Action: PanelButton {
        least: actions.tall
        horizontalPadding: actions.edge
        font.pixelSize: actions.lettering
    }

    // Not of Action: PySide 6.11 crashes on a component of a file that is made of another one of that file.
    component Backup: PanelButton {
        least: actions.tall
        horizontalPadding: actions.edge
        font.pixelSize: actions.lettering
        objectName: "action-backup"
        enabled: actions.choices.backup === ""
        words: actions.words["console-backup"] + (enabled ? "" : ": " + actions.choices.backup)
        drawing: "M8.5 8 H20 V21 H8.5 Z M5 16 H4 V3 H15.5 V4.5"
        onClicked: actions.panel.wish("backup", "")
    }
    component Mute: PanelButton {
        least: actions.tall
        horizontalPadding: actions.edge
        font.pixelSize: actions.lettering
        objectName: "action-mute"
        words: actions.choices.muted ? actions.words["console-heard"] : actions.words["console-mute"]
        drawing: "M3 9.5 H7 L12.5 5 V19 L7 14.5 H3 Z " + (actions.choices.muted ? "M16 9 A4.5 4.5 0 0 1 16 15 M18.8 6.2 A8.5 8.5 0 0 1 18.8 17.8" : "M16.5 9.5 L21.5 14.5 M21.5 9.5 L16.5 14.5")
        onClicked: actions.panel.wish("mute", "")
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
    // Upright in two columns, unless the words of one need more. Why a copy has to wait may take two lines.
    Grid {
        id: pairs
        readonly property var those: [...(actions.underWay ? [pause, again] : [test]), ...(actions.has("backup") ? [backup] : []), ...(actions.has("mute") ? [mute] : [])]
        readonly property int many: those.length - (actions.beside ? 1 : 0)
        readonly property bool fits: those.every(each => !each.enabled || each.implicitWidth <= actions.half)
        readonly property real each: columns === 1 ? actions.across : actions.half
        columns: !actions.wide && fits ? 2 : 1
        columnSpacing: actions.gutter
        rowSpacing: actions.space
        // While a visitor is there, the voice is theirs.
        Action {
            id: test
            objectName: "test-voice"
            width: pairs.each
            visible: !actions.underWay
            enabled: !actions.choices.muted
            words: actions.words["console-test-the-voice"]
            drawing: "M3.5 4.5 H20.5 V16 H11.5 L7 20.5 V16 H3.5 Z"
            onClicked: actions.panel.wish("test_voice", "")
        }
        PanelSwitch {
            id: pause
            objectName: "action-pause"
            visible: actions.underWay
            least: actions.tall
            width: pairs.each
            horizontalPadding: actions.edge
            rightPadding: actions.edge - 6 * Theme.unit
            font.pixelSize: actions.lettering
            words: actions.words["console-stay-paused"]
            whenOn: actions.words["console-switch-on"]
            whenOff: actions.words["console-switch-off"]
            drawing: "M8.5 5 V19 M15.5 5 V19"
            on: actions.choices.staysPaused
            onClicked: actions.panel.wish("pause", "")
        }
        Action {
            id: again
            objectName: "action-again"
            visible: actions.underWay
            width: pairs.each
            words: actions.words["console-repeat"]
            drawing: "M19.5 12 A7.5 7.5 0 1 1 16.6 6.1 M17.5 2 V6.8 H12.7"
            onClicked: actions.panel.wish("repeat", "")
        }
        Backup {
            id: backup
            visible: actions.has("backup") && !actions.beside
            width: pairs.each
        }
        Mute {
            id: mute
            visible: actions.has("mute")
            width: pairs.each
        }
    }
    // Apart, at the foot or beside the break: it takes a game from a visitor.
    Grid {
        id: lower
        readonly property bool halves: !actions.wide && actions.normal && breaks.visible && (actions.underWay || actions.beside)
        readonly property real each: halves ? actions.half : actions.across
        // How much of its height are words, and the lines between.
        readonly property real words: topPadding + (breaks.visible ? breaks.heading + breaks.spacing : 0) + (actions.underWay ? end.above : 0)
        topPadding: (actions.wide && !actions.underWay ? 20 : 8) * Theme.unit
        columns: halves ? 2 : 1
        columnSpacing: actions.gutter
        rowSpacing: actions.space
        PanelChoice {
            id: breaks
            // Four in one row of a column would have smaller letters only.
            readonly property int rows: Math.ceil(options.length / across)
            width: lower.each
            action: "break"
            even: true
            across: actions.wide && options.length > 3 ? 2 : options.length
            between: actions.space
            least: actions.tall
            size: actions.label
            crown: lower.halves && actions.underWay ? then.implicitHeight : 0
            lettering: actions.lettering
            title: actions.words["console-break"]
            options: actions.choices.breaks ?? []
            chosen: actions.choices.break ?? ""
            onPicked: value => actions.panel.wish("break", value)
        }
        Column {
            spacing: breaks.spacing
            visible: actions.beside
            Item {
                width: lower.each
                height: breaks.heading
            }
            Backup {
                id: lastBackup
                width: lower.each
            }
        }
        Column {
            id: end
            readonly property real above: spacing + then.height + (line.visible ? line.height + spacing : 0)
            spacing: breaks.spacing
            visible: actions.underWay
            Item {
                id: line
                visible: !lower.halves
                width: lower.each
                height: 14 * Theme.unit
                Rectangle {
                    anchors.bottom: parent.bottom
                    width: parent.width
                    height: 2 * Theme.unit
                    color: Theme.edge
                }
            }
            PlainText {
                id: then
                width: lower.each
                height: Math.max(implicitHeight, lower.halves ? breaks.heading : 0)
                verticalAlignment: Text.AlignBottom
                text: actions.words["console-abort-then"]
                font.pixelSize: actions.label
                color: Theme.faintInk
                horizontalAlignment: Text.AlignLeft
                wrapMode: Text.Wrap
            }
            PanelButton {
                objectName: "action-end"
                width: lower.each
                least: actions.tall
                grave: true
                horizontalPadding: actions.edge
                font.pixelSize: actions.lettering
                words: actions.words["console-abort"]
                drawing: "M12.5 4 H4.5 V20 H12.5 M9.5 12 H21 M16.5 7.5 L21 12 L16.5 16.5"
                onClicked: actions.panel.wish("abort", "")
            }
        }
    }
}
