// The last sittings and how they ended; what was not completed carries a mark.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelSection {
    id: sittings

    required property var words
    required property var records

    title: words["desk-sittings"]

    PanelEmpty { words: sittings.words["desk-sittings-none"]; visible: sittings.records.sittings.length === 0 }
    Repeater {
        model: sittings.records.sittings
        delegate: Row {
            id: row
            required property var modelData
            width: parent.width
            spacing: 8 * Theme.unit
            PanelMark { id: mark; well: !row.modelData.odd }
            PanelCell { width: row.width * 0.07; words: row.modelData.participant }
            PanelCell { width: row.width * 0.15; words: row.modelData.when }
            PanelCell { width: row.width * 0.2; words: row.modelData.condition }
            PanelCell { width: row.width * 0.19; words: row.modelData.stage }
            PanelCell {
                width: row.width * 0.39 - mark.width - 5 * row.spacing
                words: row.modelData.status + (row.modelData.robot === "" ? "" : " · " + row.modelData.robot)
            }
        }
    }
}
