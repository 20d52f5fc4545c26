// The last sessions and how they ended; what was not completed carries a mark.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelSection {
    id: sessions

    required property var words
    required property var records
    // Where its columns begin, if they share that with the counts; and how large what stands in them is written.
    property list<real> grid: []
    property real figure: size
    readonly property bool gridded: grid.length === 5

    title: words["console-sessions"]

    PanelEmpty { words: sessions.words["console-sessions-none"]; font.pixelSize: sessions.size; visible: sessions.records.sessions.length === 0 }
    component Field: PanelCell {
        required property int at
        size: sessions.figure
        headSize: sessions.headSize
        width: sessions.gridded ? sessions.ends[at] - sessions.starts[at] - sessions.step : Math.floor(sessions.room * sessions.shares[at])
    }
    readonly property real step: 8 * Theme.unit
    readonly property list<real> shares: [0.09, 0.16, 0.23, 0.2, 0.32]
    // Of the first column the mark has some.
    readonly property list<real> starts: gridded ? [size + step, ...grid.slice(1)] : []
    readonly property list<real> ends: gridded ? [...grid.slice(1), width - 2 * inset + step] : []
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
        Field { at: 0; words: sessions.words["console-sessions-number"]; heading: true }
        Field { at: 1; words: sessions.words["console-sessions-begun"]; heading: true }
        Field { at: 2; words: sessions.words["console-sessions-condition"]; heading: true }
        Field { at: 3; words: sessions.words["console-sessions-stage"]; heading: true }
        Field { at: 4; words: sessions.words["console-sessions-status"]; heading: true }
    }
    Repeater {
        model: sessions.records.sessions
        delegate: Row {
            id: row
            required property var modelData
            width: parent.width
            spacing: sessions.step
            PanelMark { width: sessions.size; well: !row.modelData.odd; running: row.modelData.under_way; size: sessions.figure }
            Field { at: 0; words: row.modelData.participant; strong: true; column: sessions.words["console-sessions-number"] }
            Field { at: 1; words: row.modelData.when; column: sessions.words["console-sessions-begun"] }
            Field { at: 2; words: row.modelData.condition; column: sessions.words["console-sessions-condition"] }
            Field { at: 3; words: row.modelData.stage; column: sessions.words["console-sessions-stage"] }
            Field {
                at: 4
                strong: true
                words: [row.modelData.status, row.modelData.reason, row.modelData.robot].filter(each => each !== "").join(" · ")
                column: sessions.words["console-sessions-status"]
            }
        }
    }
}
