// How one thing is: a mark, its name, and words.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: row

    required property var line
    property real size: Theme.dense
    // What is said of a thing that is not well, where its own words stand elsewhere.
    property string notWell: ""
    // What a button behind the words says; none without.
    property string action: ""
    property bool ready: true
    // How high it is at least.
    property real least: 0
    readonly property real space: 10 * Theme.unit
    signal asked()

    height: Math.max(least, said.height, button.visible ? button.height : 0)

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
            text: row.line.is_ok || row.notWell === "" ? row.line.message : row.notWell
            font.pixelSize: row.size
            color: row.line.is_ok ? Theme.faintInk : Theme.deepAmber
            wrapMode: Text.Wrap
        }
    }
    PanelButton {
        id: button
        objectName: "test-" + row.line.part
        // Close behind the words.
        x: Theme.across(Math.min(row.width - width, mark.width + name.width + message.contentWidth + 4 * row.space), width, row.width)
        anchors.verticalCenter: parent.verticalCenter
        width: implicitWidth
        visible: row.action !== ""
        enabled: row.ready
        words: row.action
        onClicked: row.asked()
    }
}
