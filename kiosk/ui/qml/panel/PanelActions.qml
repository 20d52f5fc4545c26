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

    title: words["console-actions"]

    // What is pressed in a hurry is large; two in a row, or one where its words need more.
    component Action: PanelButton {
        verticalPadding: 13 * Theme.unit
        readonly property real room: parent?.width ?? Infinity
        readonly property real half: (room - 12 * Theme.unit) / 2
        width: implicitWidth <= half ? half : room
    }

    Flow {
        width: parent.width
        spacing: 12 * Theme.unit
        Action {
            objectName: "action-pause"
            visible: actions.choices.underWay
            words: actions.choices.staysPaused ? actions.words["console-not-stay-paused"] : actions.words["console-stay-paused"]
            chosen: actions.choices.staysPaused
            onClicked: actions.panel.wish("pause", "")
        }
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
    Item { width: 1; height: 4 * Theme.unit }
    PanelChoice {
        width: parent.width
        action: "break"
        large: true
        even: true
        title: actions.words["console-break"]
        options: actions.choices.breaks ?? []
        chosen: actions.choices.break ?? ""
        onPicked: value => actions.panel.wish("break", value)
    }
    // Apart at the foot: they take a game from a visitor.
    Item {
        width: parent.width
        height: ends.height + 40 * Theme.unit
        visible: actions.choices.underWay || actions.choices.canBeNext
        Rectangle {
            y: 14 * Theme.unit
            width: parent.width
            height: 2 * Theme.unit
            color: Theme.edge
        }
        Flow {
            id: ends
            y: 32 * Theme.unit
            width: parent.width
            spacing: 12 * Theme.unit
            Action {
                objectName: "action-next"
                visible: actions.choices.canBeNext
                words: actions.words["console-next"]
                onClicked: actions.panel.wish("next", "")
            }
            Action {
                objectName: "action-end"
                visible: actions.choices.underWay
                words: actions.words["console-abort"]
                onClicked: actions.panel.wish("abort", "")
            }
        }
    }
}
