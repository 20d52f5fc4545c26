// The second page: what holds from the next session on, what was not as planned today, and what is seldom looked at.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect

Item {
    id: next

    required property PanelScreen panel
    required property bool wide
    required property real space
    readonly property var words: panel.words
    readonly property var choices: panel.choices

    height: wide ? Math.max(left.height, right.height) : left.height + space + right.height

    Column {
        id: left
        width: next.wide ? Math.floor((next.width - next.space) * 0.5) : next.width
        spacing: next.space
        PanelSection {
            width: parent.width
            title: next.words["console-next-session"]
            PanelChoice {
                width: parent.width
                action: "condition"
                title: next.words["console-condition"]
                options: next.choices.conditions
                chosen: next.choices.condition
                onPicked: value => next.panel.wish("condition", value)
            }
            PanelButton {
                objectName: "names-of-choices"
                visible: next.choices.conditions.length > 0
                words: next.choices.named ? next.words["console-names-hide"] : next.words["console-names-show"]
                onClicked: next.panel.wish("names", "")
            }
            PanelChoice {
                width: parent.width
                action: "embodiment"
                title: next.words["console-embodiment"]
                options: next.choices.embodiments
                chosen: next.choices.embodiment
                onPicked: value => next.panel.wish("embodiment", value)
            }
            PanelChoice {
                width: parent.width
                action: "language"
                title: next.words["console-language"]
                options: next.choices.languages
                chosen: next.choices.language
                onPicked: value => next.panel.wish("language", value)
            }
            PanelChoice {
                width: parent.width
                action: "volume"
                title: next.words["console-volume"]
                options: next.choices.volumes
                chosen: next.choices.volume
                onPicked: value => next.panel.wish("volume", value)
            }
        }
        PanelSection {
            width: parent.width
            title: next.words["console-booth"]
            Repeater {
                model: next.panel.health.more
                delegate: PanelLine { required property var modelData; line: modelData; width: parent.width }
            }
        }
    }
    Column {
        id: right
        x: next.width - width
        y: next.wide ? 0 : left.height + next.space
        width: left.width
        spacing: next.space
        PanelSection {
            width: parent.width
            title: next.words["console-deviations"]
            PanelEmpty {
                words: next.words["console-deviations-none"]
                visible: next.panel.records.deviations.length === 0
            }
            Repeater {
                model: next.panel.records.deviations
                delegate: PanelDeviation {
                    required property var modelData
                    deviation: modelData
                    width: parent.width
                }
            }
            PanelEmpty { words: next.panel.records.more; visible: words !== "" }
        }
        PanelShortcuts { width: parent.width; shown: next.panel.shortcuts }
        // Apart from what is pressed all day.
        PanelButton {
            objectName: "action-leave"
            anchors.right: parent.right
            words: next.words["console-quit"]
            onClicked: next.panel.wish("quit", "")
        }
    }
}
