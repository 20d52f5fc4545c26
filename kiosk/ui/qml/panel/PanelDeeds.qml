// What can be done: at once, or from the next sitting on.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Column {
    id: deeds

    required property PanelScreen panel
    required property real space
    readonly property var words: panel.words
    readonly property var choices: panel.choices

    spacing: space

    PanelSection {
        width: parent.width
        title: deeds.words["desk-next-sitting"]
        PanelChoice {
            width: parent.width
            deed: "condition"
            title: deeds.words["desk-condition"]
            options: deeds.choices.conditions
            chosen: deeds.choices.condition
            onPicked: value => deeds.panel.wish("condition", value)
        }
        PanelChoice {
            width: parent.width
            deed: "body"
            title: deeds.words["desk-body"]
            options: deeds.choices.bodies
            chosen: deeds.choices.body
            onPicked: value => deeds.panel.wish("body", value)
        }
        PanelChoice {
            width: parent.width
            deed: "language"
            title: deeds.words["desk-language"]
            options: deeds.choices.languages
            chosen: deeds.choices.language
            onPicked: value => deeds.panel.wish("language", value)
        }
        PanelChoice {
            width: parent.width
            deed: "volume"
            title: deeds.words["desk-volume"]
            options: deeds.choices.volumes
            chosen: deeds.choices.volume
            onPicked: value => deeds.panel.wish("volume", value)
        }
    }
    PanelSection {
        width: parent.width
        title: deeds.words["desk-now"]
        Flow {
            width: parent.width
            spacing: 9 * Theme.unit
            PanelButton {
                objectName: "deed-quiet"
                words: deeds.choices.quiet ? deeds.words["desk-heard"] : deeds.words["desk-quiet"]
                chosen: deeds.choices.quiet
                onClicked: deeds.panel.wish("quiet", "")
            }
            PanelButton {
                objectName: "deed-again"
                visible: deeds.choices.underWay
                words: deeds.words["desk-again"]
                onClicked: deeds.panel.wish("again", "")
            }
            PanelButton {
                objectName: "deed-pause"
                visible: deeds.choices.underWay
                words: deeds.choices.staysPaused ? deeds.words["desk-not-stay-paused"] : deeds.words["desk-stay-paused"]
                chosen: deeds.choices.staysPaused
                onClicked: deeds.panel.wish("pause", "")
            }
            PanelButton {
                objectName: "deed-end"
                visible: deeds.choices.underWay
                words: deeds.words["desk-end"]
                onClicked: deeds.panel.wish("end", "")
            }
            PanelButton {
                objectName: "deed-next"
                visible: deeds.choices.canBeNext
                words: deeds.words["desk-next"]
                onClicked: deeds.panel.wish("next", "")
            }
            PanelButton {
                objectName: "deed-backup"
                enabled: deeds.choices.backup === ""
                words: deeds.words["desk-backup"] + (enabled ? "" : ": " + deeds.choices.backup)
                onClicked: deeds.panel.wish("backup", "")
            }
            PanelButton {
                objectName: "deed-leave"
                words: deeds.words["desk-leave"]
                onClicked: deeds.panel.wish("leave", "")
            }
        }
    }
}
