// The second page: who has come in all, by condition, the last sessions, and what was not as planned today.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Item {
    id: stored

    required property PanelScreen panel
    required property bool wide
    required property real space
    // How much of it is seen at once.
    required property real seen
    // As on the first page: as large as goes without a cell that wraps, as long as the page does not scroll for it.
    readonly property real usual: (wide ? 1.15 : 1) * Theme.dense
    readonly property list<real> sizes: Theme.textSize > 1.15 ? [] : [38, 36, 34, 32, 30, 28, 26].map(each => Math.round(each * Theme.unit)).filter(each => each > usual)
    readonly property real size: sizes.find(each => counts.holds(each, width) && sessions.holds(each, width) && bare(each) + gaps * 9 * Theme.unit <= seen) ?? usual
    // What is left is shared among the rows, and so is what lacks.
    readonly property real gaps: panel.records.cells.length + panel.records.sessions.length + panel.records.deviations.length + 2
    readonly property real apart: Math.max(3, Math.min(22, (seen - bare(size)) / gaps / Theme.unit)) * Theme.unit

    // How high the page is if nothing lies between its rows.
    function bare(size: real): real {
        const line = Math.ceil(1.37 * size), records = panel.records, room = width - 2 * counts.inset
        const headed = Math.ceil(1.12 * line) + counts.edges + 2 * Theme.unit
        const named = Math.max(0, records.cells.length > 0 ? Math.max(58 * Theme.unit, 0.95 * line + 18 * Theme.unit) - 1.12 * line : 0)
        const lines = records.deviations.reduce((sum, each) => sum + wordWidths.plainLines(each.words + " · " + each.reason, size, room - wordWidths.plain(each.when, size) - 10 * Theme.unit), 0)
        return 3 * headed + named + 2 * space + line * (2 + records.cells.length + counts.lastLines(size, width) + Math.max(1, records.sessions.length) + Math.max(1, lines) + (records.more === "" ? 0 : 1)) + 6
    }
    WordWidths {
        id: wordWidths
    }

    height: noted.y + noted.height

    PanelCounts {
        id: counts
        width: parent.width
        apart: stored.apart
        size: stored.size
        words: stored.panel.words
        records: stored.panel.records
        like: sessions
        named: stored.panel.choices.named
        onAsked: stored.panel.wish("names", "")
    }
    PanelSessions {
        id: sessions
        y: counts.height + stored.space
        width: parent.width
        apart: stored.apart
        size: stored.size
        like: counts
        words: stored.panel.words
        records: stored.panel.records
    }
    PanelSection {
        id: noted
        y: sessions.y + sessions.height + stored.space
        width: parent.width
        size: stored.size
        apart: stored.apart
        title: stored.panel.words["console-deviations"]
        PanelEmpty {
            font.pixelSize: stored.size
            words: stored.panel.words["console-deviations-none"]
            visible: stored.panel.records.deviations.length === 0
        }
        Repeater {
            model: stored.panel.records.deviations
            delegate: PanelDeviation {
                required property var modelData
                deviation: modelData
                size: stored.size
                width: parent.width
            }
        }
        PanelEmpty { words: stored.panel.records.more; font.pixelSize: stored.size; visible: words !== "" }
    }
}
