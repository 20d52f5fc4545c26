// What can be done: at once, or from the next session on.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Column {
    id: actions

    required property PanelScreen panel
    required property real space
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    property bool unfolded: false

    spacing: space

    PanelSection {
        width: parent.width
        title: actions.words["console-now"]
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
        }
    }
    PanelSection {
        width: parent.width
        title: actions.words["console-next-session"]
        // While a visitor is there, who may read along, the names of the conditions are folded away.
        PanelButton {
            objectName: "unfold-conditions"
            visible: actions.choices.underWay && actions.choices.conditions.length > 0
            words: actions.words["console-condition"]
            chosen: actions.unfolded
            onClicked: actions.unfolded = !actions.unfolded
        }
        PanelChoice {
            width: parent.width
            visible: options.length > 0 && (actions.unfolded || !actions.choices.underWay)
            titled: !actions.choices.underWay
            action: "condition"
            title: actions.words["console-condition"]
            options: actions.choices.conditions
            chosen: actions.choices.condition
            onPicked: value => actions.panel.wish("condition", value)
        }
        PanelChoice {
            width: parent.width
            action: "embodiment"
            title: actions.words["console-embodiment"]
            options: actions.choices.embodiments
            chosen: actions.choices.embodiment
            onPicked: value => actions.panel.wish("embodiment", value)
        }
        PanelChoice {
            width: parent.width
            action: "language"
            title: actions.words["console-language"]
            options: actions.choices.languages
            chosen: actions.choices.language
            onPicked: value => actions.panel.wish("language", value)
        }
        PanelChoice {
            width: parent.width
            action: "volume"
            title: actions.words["console-volume"]
            options: actions.choices.volumes
            chosen: actions.choices.volume
            onPicked: value => actions.panel.wish("volume", value)
        }
    }
    // Apart from what is pressed all day.
    PanelButton {
        objectName: "action-leave"
        anchors.right: parent.right
        words: actions.words["console-quit"]
        onClicked: actions.panel.wish("quit", "")
    }
}
