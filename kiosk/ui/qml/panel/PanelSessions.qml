// The last sessions and how they ended; what was not completed carries a mark.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelSection {
    id: sessions

    required property var words
    required property var records

    title: words["console-sessions"]

    PanelEmpty { words: sessions.words["console-sessions-none"]; visible: sessions.records.sessions.length === 0 }
    Repeater {
        model: sessions.records.sessions
        delegate: Row {
            id: row
            required property var modelData
            width: parent.width
            spacing: 8 * Theme.unit
            PanelMark { id: mark; well: !row.modelData.odd; size: sessions.size }
            PanelCell { size: sessions.size; width: row.width * 0.12; words: row.modelData.participant }
            PanelCell { size: sessions.size; width: row.width * 0.13; words: row.modelData.when }
            PanelCell { size: sessions.size; width: row.width * 0.13; words: row.modelData.condition }
            PanelCell { size: sessions.size; width: row.width * 0.19; words: row.modelData.stage }
            PanelCell {
                size: sessions.size
                width: row.width * 0.43 - mark.width - 5 * row.spacing
                words: [row.modelData.status, row.modelData.reason, row.modelData.robot].filter(each => each !== "").join(" · ")
            }
        }
    }
}
