// Who has come, by condition, against what was planned.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelTable {
    id: counts

    required property var words
    required property var records
    required property bool named
    signal asked()

    // How many lines its last sentence has.
    function lastLines(size: real, width: real): int {
        return Math.ceil(letters.advanceWidth(records.visits) * size / 100 / (width - 2 * inset))
    }
    FontMetrics {
        id: letters
        font.pixelSize: 100
    }
    // There are as many columns of numbers as there is something for.
    readonly property list<string> columns: ["dropped", "overridden", "beyond", "withdrawn"]
    readonly property var told: columns.filter(column => records.listed || column !== "beyond")

    aside: names.visible ? names.width : 0
    crown: names.visible ? names.height : 0
    title: words[records.listed ? "console-counts" : "console-counts-unlisted"]
    shown: ({
        // Without a list there is no quota: its sessions are counted as soon as they begin.
        heads: ["", words[records.listed ? "console-counts-done" : "console-counts-begun"], ...told.map(column => words["console-counts-" + column])],
        rows: records.cells.map(cell => ({
            odd: false,
            cells: [
                { words: cell.name, strong: true },
                // In one line, as one number.
                { words: cell.done.replace(/ /g, "\u00a0"), strong: true, share: cell.listed ? cell.share : undefined },
                ...told.map(column => cell.counts[columns.indexOf(column)]).map(number => ({ words: number, strong: number !== "0" }))
            ]
        }))
    })

    // Visitors may read along, so the conditions are named only on request.
    PanelButton {
        id: names
        parent: counts
        anchors { top: parent.top; right: parent.right; margins: counts.inset; topMargin: counts.above }
        objectName: "names"
        // Lower than what is done all day.
        least: 58 * Theme.unit
        font.pixelSize: Math.max(Theme.dense, 0.95 * counts.size)
        width: Math.min(Math.ceil(implicitWidth), Math.floor(0.6 * counts.width))
        visible: counts.records.cells.length > 0
        words: counts.named ? counts.words["console-names-hide"] : counts.words["console-names-show"]
        onClicked: counts.asked()
    }
    Balanced {
        width: parent.width
        text: counts.records.visits
        horizontalAlignment: Text.AlignLeft
        font.pixelSize: counts.size
        color: Theme.faintInk
        wrapMode: Text.Wrap
    }
}
