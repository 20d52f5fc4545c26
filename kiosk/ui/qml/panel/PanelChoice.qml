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
    // Whether the answers of a row stand on one bar.
    property bool joined: false
    property real least: 68 * Theme.unit
    // How wide each answer is at least, however short its words.
    property real broad: 0
    // How large its title and its answers are written.
    property real size: Theme.dense
    property real lettering: Theme.dense
    // How many stand in a row then, and how far from each other, in whole pixels: the row ends where its neighbours do.
    property int across: options.length
    property real between: joined ? -seam : Math.round(9 * Theme.unit)
    // How thick the line is that those on one bar share.
    readonly property int seam: Math.max(1, Math.round(2 * Theme.unit))
    readonly property real each: Math.floor((width - (across - 1) * between) / Math.max(1, across))
    signal picked(string value)

    spacing: 8 * Theme.unit
    visible: options.length > 0

    PlainText {
        id: asked
        width: parent.width
        visible: choice.titled
        text: choice.title
        font.pixelSize: choice.size
        color: Theme.faintInk
        wrapMode: Text.Wrap
    }
    Flow {
        width: parent.width
        spacing: choice.between
        Repeater {
            model: choice.options
            delegate: PanelButton {
                required property var modelData
                required property int index
                readonly property real last: Math.floor(choice.width) - (choice.across - 1) * (choice.each + choice.between)
                objectName: choice.action + "-" + modelData.value
                words: modelData.label
                chosen: modelData.value === choice.chosen
                choosable: true
                least: choice.least
                joinedBefore: choice.joined && index % choice.across > 0
                joinedAfter: choice.joined && index % choice.across < choice.across - 1 && index < choice.options.length - 1
                ringInPlace: choice.joined
                ground: choice.joined ? Theme.white : Theme.paper
                horizontalPadding: (choice.even ? 8 : 24) * Theme.unit
                font { pixelSize: choice.lettering; bold: choice.joined || solid }
                width: choice.even && implicitWidth <= choice.each ? (index % choice.across === choice.across - 1 ? last : choice.each) : Math.min(Math.max(choice.broad, Math.ceil(implicitWidth)), choice.width)
                Accessible.role: Accessible.RadioButton
                Accessible.name: `${choice.title} ${words}`
                onClicked: choice.picked(modelData.value)
            }
        }
    }
}
