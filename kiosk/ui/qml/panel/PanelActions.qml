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

    Flow {
        width: parent.width
        spacing: 9 * Theme.unit
        PanelButton {
            objectName: "action-mute"
            words: actions.choices.muted ? actions.words["console-heard"] : actions.words["console-mute"]
            onClicked: actions.panel.wish("mute", "")
        }
        PanelButton {
            objectName: "action-again"
            visible: actions.choices.underWay
            words: actions.words["console-repeat"]
            onClicked: actions.panel.wish("repeat", "")
        }
        PanelButton {
            objectName: "action-pause"
            visible: actions.choices.underWay
            words: actions.choices.staysPaused ? actions.words["console-not-stay-paused"] : actions.words["console-stay-paused"]
            chosen: actions.choices.staysPaused
            onClicked: actions.panel.wish("pause", "")
        }
        PanelButton {
            objectName: "action-end"
            filled: true
            visible: actions.choices.underWay
            words: actions.words["console-abort"]
            onClicked: actions.panel.wish("abort", "")
        }
        PanelButton {
            objectName: "action-next"
            filled: true
            visible: actions.choices.canBeNext
            words: actions.words["console-next"]
            onClicked: actions.panel.wish("next", "")
        }
        PanelButton {
            objectName: "action-backup"
            enabled: actions.choices.backup === ""
            words: actions.words["console-backup"] + (enabled ? "" : ": " + actions.choices.backup)
            onClicked: actions.panel.wish("backup", "")
        }
        PanelButton {
            objectName: "break-end"
            filled: true
            visible: actions.choices.onBreak ?? false
            words: actions.words["console-break-end"]
            onClicked: actions.panel.wish("break", "")
        }
    }
    PanelChoice {
        width: parent.width
        action: "break"
        title: actions.words["console-break"]
        options: actions.choices.breaks ?? []
        chosen: actions.choices.break ?? ""
        onPicked: value => actions.panel.wish("break", value)
    }
}
