// What can be done at once.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

PanelSection {
    id: actions

    required property PanelScreen panel
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    // Whether the buttons end in line: two in a row, or one where its words need more.
    property bool even: false

    title: words["console-actions"]

    // What is pressed in a hurry is large.
    component Action: PanelButton {
        verticalPadding: 13 * Theme.unit
        width: {
            const room = parent?.width ?? Infinity
            const half = (room - 12 * Theme.unit) / 2
            return !actions.even ? Math.min(implicitWidth, room) : implicitWidth <= half ? half : room
        }
    }

    Flow {
        width: parent.width
        spacing: 12 * Theme.unit
        Action {
            objectName: "action-mute"
            words: actions.choices.muted ? actions.words["console-heard"] : actions.words["console-mute"]
            onClicked: actions.panel.wish("mute", "")
        }
        Action {
            objectName: "action-again"
            visible: actions.choices.underWay
            words: actions.words["console-repeat"]
            onClicked: actions.panel.wish("repeat", "")
        }
        Action {
            objectName: "action-pause"
            visible: actions.choices.underWay
            words: actions.choices.staysPaused ? actions.words["console-not-stay-paused"] : actions.words["console-stay-paused"]
            chosen: actions.choices.staysPaused
            onClicked: actions.panel.wish("pause", "")
        }
        Action {
            objectName: "action-next"
            filled: true
            visible: actions.choices.canBeNext
            words: actions.words["console-next"]
            onClicked: actions.panel.wish("next", "")
        }
        Action {
            objectName: "action-backup"
            enabled: actions.choices.backup === ""
            words: actions.words["console-backup"] + (enabled ? "" : ": " + actions.choices.backup)
            onClicked: actions.panel.wish("backup", "")
        }
        Action {
            objectName: "break-end"
            filled: true
            visible: actions.choices.onBreak ?? false
            words: actions.words["console-break-end"]
            onClicked: actions.panel.wish("break", "")
        }
    }
    // On a line of its own: it takes a game from a visitor.
    Item {
        width: parent.width
        height: end.height + 24 * Theme.unit
        visible: actions.choices.underWay
        Action {
            id: end
            y: 12 * Theme.unit
            objectName: "action-end"
            width: actions.even ? parent.width : Math.min(implicitWidth, parent.width)
            words: actions.words["console-abort"]
            onClicked: actions.panel.wish("abort", "")
        }
    }
    PanelChoice {
        width: parent.width
        action: "break"
        large: true
        even: actions.even
        title: actions.words["console-break"]
        options: actions.choices.breaks ?? []
        chosen: actions.choices.break ?? ""
        onPicked: value => actions.panel.wish("break", value)
    }
}
