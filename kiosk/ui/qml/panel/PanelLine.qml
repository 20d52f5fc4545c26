// How one thing is: a mark, its name, and words.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: row

    required property var line
    property real size: Theme.dense
    // Whether a few words are enough for what is not well, because the notice describes it.
    property bool brief: false
    // What a button behind the words says; none without.
    property string action: ""
    // What it is called for those who do not see its line.
    property string actionName: action
    property bool ready: true
    // How wide the button is, where it does not make its line higher.
    property real beside: 0
    // How high it is at least.
    property real least: 0
    readonly property real space: 10 * Theme.unit
    signal asked()

    // A finger may reach into the lines beside the button's own: all lines are at even steps.
    height: Math.max(least, said.height, button.visible && beside === 0 ? button.height : 0)

    Row {
        id: said
        anchors.verticalCenter: parent.verticalCenter
        width: row.width - (button.visible ? button.width + row.space : 0)
        spacing: row.space
        PanelMark { id: mark; well: row.line.is_ok; size: row.size }
        PlainText {
            id: name
            width: Math.min(0.29 * row.width, 9 * row.size)
            text: row.line.name
            font { pixelSize: row.size; bold: true }
            color: Theme.ink
            wrapMode: Text.Wrap
        }
        PlainText {
            id: message
            width: said.width - mark.width - name.width - 2 * row.space
            text: row.brief && !row.line.is_ok ? row.line.brief : row.line.message
            font { pixelSize: row.size; bold: !row.line.is_ok }
            color: row.line.is_ok ? Theme.faintInk : Theme.deepAmber
            wrapMode: Text.Wrap
        }
    }
    PanelButton {
        id: button
        objectName: "test-" + row.line.part
        x: Theme.across(row.width - width, width, row.width)
        anchors.verticalCenter: parent.verticalCenter
        width: row.beside > 0 ? row.beside : implicitWidth
        visible: row.action !== ""
        enabled: row.ready
        words: row.action
        Accessible.name: row.actionName
        // A finger may miss the line by as much as it needs, but what is seen of the button is no higher than the line.
        topInset: Math.max(0, (least - Math.max(row.least, 1.7 * row.size)) / 2)
        bottomInset: topInset
        onClicked: row.asked()
    }
}
