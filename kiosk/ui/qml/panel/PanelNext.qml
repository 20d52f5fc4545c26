// The second page: what holds from the next session on, what was not as planned today, and what is seldom looked at.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Item {
    id: next

    required property PanelScreen panel
    required property bool wide
    required property real space
    readonly property var words: panel.words
    readonly property var choices: panel.choices
    // As large as on the first page.
    readonly property real size: (wide ? 1.15 : 1) * Theme.dense
    readonly property real crown: names.visible ? names.height : 0

    height: wide ? Math.max(left.height, right.height) : left.height + space + right.height

    component Choice: PanelChoice {
        size: next.size
        lettering: next.size
        least: 80 * Theme.unit
        broad: 92 * Theme.unit
    }

    Column {
        id: left
        width: next.wide ? Math.floor((next.width - next.space) * 0.5) : next.width
        spacing: next.space
        PanelSection {
            id: later
            width: parent.width
            title: next.words["console-next-session"]
            aside: names.visible ? names.width : 0
            crown: next.crown
            size: next.size
            apart: 22 * Theme.unit
            Choice {
                width: parent.width
                action: "condition"
                title: next.words["console-condition"]
                options: next.choices.conditions
                chosen: next.choices.condition
                onPicked: value => next.panel.wish("condition", value)
            }
            // As on the first page: beside the heading.
            PanelButton {
                id: names
                parent: later
                objectName: "names-of-choices"
                anchors { top: parent.top; right: parent.right; margins: later.inset; topMargin: later.above }
                width: Math.min(Math.ceil(implicitWidth), Math.floor(0.6 * later.width))
                visible: next.choices.conditions.length > 0
                words: next.choices.named ? next.words["console-names-hide"] : next.words["console-names-show"]
                onClicked: next.panel.wish("names", "")
            }
            Choice {
                width: parent.width
                action: "embodiment"
                title: next.words["console-embodiment"]
                options: next.choices.embodiments
                chosen: next.choices.embodiment
                onPicked: value => next.panel.wish("embodiment", value)
            }
            Choice {
                width: parent.width
                action: "language"
                title: next.words["console-language"]
                options: next.choices.languages
                chosen: next.choices.language
                onPicked: value => next.panel.wish("language", value)
            }
            Choice {
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
            size: next.size
            Repeater {
                model: next.panel.health.more
                delegate: PanelLine { required property var modelData; line: modelData; words: next.words; width: parent.width; size: next.size }
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
            size: next.size
            // Its heading is level with the one beside it.
            crown: next.wide ? next.crown : 0
            PanelEmpty {
                font.pixelSize: next.size
                words: next.words["console-deviations-none"]
                visible: next.panel.records.deviations.length === 0
            }
            Repeater {
                model: next.panel.records.deviations
                delegate: PanelDeviation {
                    required property var modelData
                    deviation: modelData
                    size: next.size
                    width: parent.width
                }
            }
            PanelEmpty { words: next.panel.records.more; font.pixelSize: next.size; visible: words !== "" }
        }
        PanelShortcuts { width: parent.width; shown: next.panel.shortcuts; size: next.size }
        // Apart from what is pressed all day.
        PanelButton {
            objectName: "action-leave"
            anchors.right: parent.right
            words: next.words["console-quit"]
            drawing: "M12 2.5 V11.5 M7.2 5.8 A8 8 0 1 0 16.8 5.8"
            grave: true
            least: 80 * Theme.unit
            font.pixelSize: next.size
            horizontalPadding: 24 * Theme.unit
            onClicked: next.panel.wish("quit", "")
        }
    }
}
