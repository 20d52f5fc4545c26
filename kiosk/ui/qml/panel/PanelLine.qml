// How one thing is: a mark, its name, and words.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Row {
    id: row

    required property var line
    // What a button behind the words says; none without.
    property string action: ""
    property bool ready: true
    signal asked()

    spacing: 10 * Theme.unit
    PanelMark { id: mark; well: row.line.is_ok }
    PlainText {
        id: name
        width: row.width * 0.29
        text: row.line.name
        font { pixelSize: Theme.dense; bold: true }
        color: Theme.ink
        wrapMode: Text.Wrap
    }
    PlainText {
        width: row.width - mark.width - name.width - 2 * row.spacing - (button.visible ? button.width + row.spacing : 0)
        text: row.line.message
        font.pixelSize: Theme.dense
        color: row.line.is_ok ? Theme.faintInk : Theme.deepAmber
        wrapMode: Text.Wrap
    }
    PanelButton {
        id: button
        objectName: "test-" + row.line.part
        width: implicitWidth
        visible: row.action !== ""
        enabled: row.ready
        verticalPadding: 6 * Theme.unit
        words: row.action
        onClicked: row.asked()
    }
}
