// The last sessions and how they ended; what was not completed carries a mark.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelSection {
    id: sessions

    required property var words
    required property var records

    title: words["console-sessions"]

    PanelEmpty { words: sessions.words["console-sessions-none"]; font.pixelSize: sessions.size; visible: sessions.records.sessions.length === 0 }
    component Field: PanelCell {
        required property real share
        size: sessions.size
        headSize: sessions.headSize
        width: Math.floor(sessions.room * share)
    }
    readonly property real step: 8 * Theme.unit
    // What the fields of a line share: the mark and the steps between them are not theirs.
    readonly property real room: width - 2 * inset - size - 5 * step
    // About as large as what stands below them, where the longest word fits its column.
    readonly property real headSize: Math.max(Theme.denser, Math.min(0.93 * size, 97 * 0.22 * room / letters.advanceWidth(words["console-sessions-condition"])))
    FontMetrics {
        id: letters
        font.pixelSize: 100
    }

    Row {
        visible: sessions.records.sessions.length > 0
        spacing: sessions.step
        Item { width: sessions.size; height: 1 }
        Field { share: 0.09; words: sessions.words["console-sessions-number"]; heading: true }
        Field { share: 0.16; words: sessions.words["console-sessions-begun"]; heading: true }
        Field { share: 0.23; words: sessions.words["console-sessions-condition"]; heading: true }
        Field { share: 0.2; words: sessions.words["console-sessions-stage"]; heading: true }
        Field { share: 0.32; words: sessions.words["console-sessions-status"]; heading: true }
    }
    Repeater {
        model: sessions.records.sessions
        delegate: Row {
            id: row
            required property var modelData
            width: parent.width
            spacing: sessions.step
            PanelMark { width: sessions.size; well: !row.modelData.odd; idle: row.modelData.under_way; size: sessions.size }
            Field { share: 0.09; words: row.modelData.participant; strong: true; column: sessions.words["console-sessions-number"] }
            Field { share: 0.16; words: row.modelData.when; column: sessions.words["console-sessions-begun"] }
            Field { share: 0.23; words: row.modelData.condition; column: sessions.words["console-sessions-condition"] }
            Field { share: 0.2; words: row.modelData.stage; column: sessions.words["console-sessions-stage"] }
            Field {
                share: 0.32
                strong: true
                words: [row.modelData.status, row.modelData.reason, row.modelData.robot].filter(each => each !== "").join(" · ")
                column: sessions.words["console-sessions-status"]
            }
        }
    }
}
