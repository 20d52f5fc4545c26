// A question of the panel with its answers: one of them holds.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Column {
    id: choice

    required property string title
    required property var options
    required property string chosen
    required property string action
    property bool titled: true
    // Whether they take all of the width, in one row where their words fit.
    property bool even: false
    property real least: 68 * Theme.unit
    // How wide each answer is at least, however short its words.
    property real broad: 0
    // How large its title and its answers are written.
    property real size: Theme.dense
    property real lettering: Theme.dense
    readonly property real each: (width - (options.length - 1) * 9 * Theme.unit) / Math.max(1, options.length) - 0.5
    signal picked(string value)

    spacing: 8 * Theme.unit
    visible: options.length > 0

    PlainText {
        width: parent.width
        visible: choice.titled
        text: choice.title
        font.pixelSize: choice.size
        color: Theme.faintInk
        wrapMode: Text.Wrap
    }
    Flow {
        width: parent.width
        spacing: 9 * Theme.unit
        Repeater {
            model: choice.options
            delegate: PanelButton {
                required property var modelData
                objectName: choice.action + "-" + modelData.value
                words: modelData.label
                chosen: modelData.value === choice.chosen
                choosable: true
                least: choice.least
                horizontalPadding: (choice.even ? 8 : 18) * Theme.unit
                font.pixelSize: choice.lettering
                width: choice.even && implicitWidth <= choice.each ? choice.each : Math.min(Math.max(choice.broad, Math.ceil(implicitWidth)), choice.width)
                Accessible.role: Accessible.RadioButton
                Accessible.name: `${choice.title} ${words}`
                onClicked: choice.picked(modelData.value)
            }
        }
    }
}
