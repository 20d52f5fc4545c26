// What can be done at once: what is done all day first, and apart at the foot what ends a session.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

PanelSection {
    id: actions

    required property PanelScreen panel
    required property bool wide
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    readonly property real space: apart
    // How high they are: higher where they have a column of their own.
    readonly property bool ample: wide && least > 0 && !choices.canBeNext && !(choices.onBreak && choices.underWay) && Theme.textSize <= 1.15
    readonly property real tall: (ample ? 92 : wide ? 84 : 92) * Theme.unit
    readonly property real mainTall: (ample ? 120 : wide ? 108 : 104) * Theme.unit

    readonly property real lettering: (Theme.textSize > 1.15 ? 1 : wide ? 1.2 : 1.1) * Theme.dense

    title: words["console-actions"]
    apart: (wide ? 12 : 18) * Theme.unit

    // The largest: what alone is pressed all day.
    component Main: PanelButton {
        least: actions.mainTall
        width: parent?.width ?? implicitWidth
        font.pixelSize: 1.12 * actions.lettering
    }
    // Upright two stand in a row; one, where its words need more, or where it would be alone.
    component Action: PanelButton {
        property bool alone: false
        readonly property real room: parent?.width ?? Infinity
        readonly property real each: (room - actions.space) / 2 - 0.5
        least: actions.tall
        width: actions.wide || alone || implicitWidth > each ? room : each
        horizontalPadding: 24 * Theme.unit
        font { pixelSize: actions.lettering; bold: true }
    }

    Flow {
        width: parent.width
        spacing: actions.space
        Main {
            objectName: "break-end"
            filled: true
            visible: actions.choices.onBreak ?? false
            words: actions.words["console-break-end"]
            drawing: "M8 5 L19 12 L8 19 Z"
            onClicked: actions.panel.wish("break", "")
        }
        Main {
            objectName: "action-next"
            filled: !(actions.choices.onBreak ?? false)
            visible: actions.choices.canBeNext
            words: actions.words["console-next"]
            drawing: "M4 12 H20 M13.5 5.5 L20 12 L13.5 18.5"
            onClicked: actions.panel.wish("next", "")
        }
        PanelSwitch {
            id: pause
            objectName: "action-pause"
            visible: actions.choices.underWay
            least: actions.tall
            width: actions.wide || Theme.textSize > 1.15 ? parent.width : (parent.width - actions.space) / 2 - 0.5
            font.pixelSize: actions.lettering
            words: actions.words["console-stay-paused"]
            drawing: "M8.5 5 V19 M15.5 5 V19"
            on: actions.choices.staysPaused
            onClicked: actions.panel.wish("pause", "")
        }
        Action {
            objectName: "action-again"
            visible: actions.choices.underWay
            // As high as what it stands beside.
            least: actions.wide ? actions.tall : pause.height
            words: actions.words["console-repeat"]
            drawing: "M19.5 12 A7.5 7.5 0 1 1 16.6 6.1 M17.5 2 V6.8 H12.7"
            onClicked: actions.panel.wish("repeat", "")
        }
        // While a visitor is there, the voice is theirs.
        Action {
            objectName: "test-voice"
            visible: !actions.choices.underWay
            enabled: !actions.choices.muted
            words: actions.words["console-test-the-voice"]
            drawing: "M3.5 4.5 H20.5 V16 H11.5 L7 20.5 V16 H3.5 Z"
            onClicked: actions.panel.wish("test_voice", "")
        }
        Action {
            objectName: "action-backup"
            enabled: actions.choices.backup === ""
            words: actions.words["console-backup"] + (enabled ? "" : ": " + actions.choices.backup)
            drawing: "M8.5 8 H20 V21 H8.5 Z M5 16 H4 V3 H15.5 V4.5"
            onClicked: actions.panel.wish("backup", "")
        }
        Action {
            objectName: "action-mute"
            alone: !actions.choices.underWay
            words: actions.choices.muted ? actions.words["console-heard"] : actions.words["console-mute"]
            drawing: "M3 9.5 H7 L12.5 5 V19 L7 14.5 H3 Z " + (actions.choices.muted ? "M16 9 A4.5 4.5 0 0 1 16 15 M18.8 6.2 A8.5 8.5 0 0 1 18.8 17.8" : "M16.5 9.5 L21.5 14.5 M21.5 9.5 L16.5 14.5")
            onClicked: actions.panel.wish("mute", "")
        }
    }
    Item { width: 1; height: 2 * Theme.unit }
    PanelChoice {
        id: breaks
        width: actions.wide || !actions.choices.underWay ? parent.width : (parent.width - actions.space) / 2 - 0.5
        action: "break"
        even: true
        least: actions.tall
        size: actions.size
        // Four of them fit one row of the column in smaller letters only.
        lettering: actions.wide && options.length > 3 ? Theme.dense : actions.lettering
        title: actions.words["console-break"]
        options: actions.choices.breaks ?? []
        chosen: actions.choices.break ?? ""
        onPicked: value => actions.panel.wish("break", value)
    }
    // Apart, at the foot or beside the break: it takes a game from a visitor.
    Item {
        visible: actions.choices.underWay && actions.wide
        width: parent.width
        height: end.height + then.height + 2 * Theme.gap
    }
    Rectangle {
        parent: actions
        visible: end.visible
        x: actions.wide ? end.x : (actions.width - width) / 2
        y: actions.wide ? then.y - Theme.gap : end.y + end.height - height
        width: actions.wide ? end.width : 2 * Theme.unit
        height: actions.wide ? 2 * Theme.unit : breaks.height
        color: Theme.edge
    }
    PlainText {
        id: then
        parent: actions
        visible: end.visible
        x: end.x
        y: end.y - height - 8 * Theme.unit
        width: end.width
        text: actions.words["console-abort-then"]
        font.pixelSize: actions.size
        color: Theme.faintInk
        horizontalAlignment: Text.AlignLeft
        wrapMode: Text.Wrap
    }
    PanelButton {
        id: end
        parent: actions
        objectName: "action-end"
        visible: actions.choices.underWay
        anchors { right: parent.right; bottom: parent.bottom; margins: actions.inset }
        width: actions.wide ? actions.width - 2 * actions.inset : (actions.width - actions.space) / 2 - actions.inset - 0.5
        least: actions.tall
        grave: true
        horizontalPadding: 24 * Theme.unit
        font.pixelSize: actions.lettering
        words: actions.words["console-abort"]
        drawing: "M12.5 4 H4.5 V20 H12.5 M9.5 12 H21 M16.5 7.5 L21 12 L16.5 16.5"
        onClicked: actions.panel.wish("abort", "")
    }
}
