// The first page: what is going on, what is not well, what can be done at once, and then who has come.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Item {
    id: today

    required property PanelScreen panel
    required property bool wide
    required property real space
    // How much of it is seen at once.
    required property real seen
    readonly property var words: panel.words
    readonly property real size: wide ? 1.15 * Theme.dense : Math.max(Theme.dense, 26 * Theme.textSize * Theme.unit)
    // Whole pixels: a card at a fraction of one would lose its right edge.
    readonly property real side: Math.floor(wide ? width * 0.265 : width)
    readonly property real main: wide ? width - side - space : width
    // The checks have what their lines need, and the tables have the rest.
    readonly property real half: Math.floor(!wide ? width : tabled && panel.alarms.length === 0 ? Math.max(0.32 * main, Math.min(0.43 * main, health.natural)) : 0.43 * main)

    // Where what stands side by side begins, and where the status ends.
    readonly property real below: first.height + space
    readonly property real foot: below + left.height
    // What the status has of a wide screen.
    readonly property real room: wide && panel.alarms.length === 0 ? Math.floor(seen - below) : 0

    // What a wide screen has left is shared among the rows of the counts and of the sessions, and so is what it lacks.
    readonly property int rows: panel.records.cells.length + panel.records.sessions.length
    readonly property real leftOver: room > 0 && Theme.textSize <= 1.15 ? room - counts.further - (370 + 45 * rows) * Theme.unit : 0
    readonly property real airy: 10 * Theme.unit + (wide ? Math.max(-5 * Theme.unit, Math.min(16 * Theme.unit, leftOver / (rows + 2))) : Math.max(spread, slack))
    // The lines of the checks where they stand in two columns.
    readonly property int pairs: Math.ceil(health.lines.length / 2)
    // On an upright one it is shared among all, as long as there is little to tell.
    readonly property bool calm: !wide && Theme.textSize <= 1.15 && panel.health.matters.length < 4 && panel.alarms.length === 0 && panel.records.resumable.length === 0 && !panel.choices.canBeNext && !(panel.choices.onBreak ?? false)
    readonly property real spread: calm ? Math.floor(Math.max(0, Math.min(24 * Theme.unit, (seen - first.height - (1043 + 66 * rows + 49 * pairs) * Theme.unit) / (rows + 9)))) : 0
    // What is too little to be shared by all of it goes between the rows of the tables.
    readonly property real slack: calm ? Math.floor(Math.max(0, Math.min(14 * Theme.unit, (over - counts.further - 8 * spread) / (rows + 1)))) : 0
    readonly property real over: seen - first.height - (933 + 66 * rows + 49 * pairs) * Theme.unit
    // Words that need more lines than usual take what they lack from between the checks.
    readonly property real lack: wide ? 0 : Math.max(-14 * Theme.unit, Math.min(0, over / 2))

    // On an upright screen all second columns begin in line, and with them the fourth of the grid that both tables share.
    readonly property real gutter: Math.round(40 * Theme.unit)
    readonly property bool tabled: Theme.textSize <= 1.15
    readonly property real across: Math.floor(counts.width - 2 * counts.inset)
    readonly property real fourth: Math.floor((across - gutter) / 2) + gutter
    readonly property list<real> grid: (!tabled ? [] : wide ? [0, 0.142, 0.3, 0.49, 0.775].map(each => each * across) : [0, fourth / 3, 2 * fourth / 3, fourth, fourth + 0.235 * across]).map(each => Math.round(each))
    readonly property real figure: tabled && !wide && panel.health.matters.length < 4 && panel.records.sessions.length < 6 ? 30 * Theme.textSize * Theme.unit : size

    height: wide ? Math.max(right.height, left.y + left.height, middle.y + middle.height) : middle.y + middle.height

    Column {
        id: first
        width: today.main
        spacing: today.space
        PanelNow { width: parent.width; panel: today.panel; size: today.size; wide: today.wide || Theme.textSize <= 1.15; split: today.wide ? today.half + today.space + (today.tabled ? today.grid[1] : 0) : Math.round(0.46 * width) }
        PanelNotice { width: parent.width; size: Theme.upright ? today.size : 1.12 * Theme.dense; panel: today.panel; visible: matters.length > 0 }
    }
    Column {
        id: right
        x: today.width - width
        y: today.wide ? 0 : today.below
        width: today.side
        spacing: today.space
        PanelActions {
            width: parent.width
            panel: today.panel
            wide: today.wide
            size: today.size
            // Beside the others it ends with them, if what stands at its foot is seen then.
            spread: today.spread
            least: today.wide && today.panel.records.resumable.length === 0 ? Math.floor(Math.min(today.foot, today.seen)) : 0
        }
        PanelResume { width: parent.width; panel: today.panel }
    }
    Column {
        id: left
        y: today.wide ? today.below : right.y + right.height + today.space
        width: today.half
        spacing: today.space
        PanelAlarms { width: parent.width; panel: today.panel; size: today.size; visible: today.panel.alarms.length > 0 }
        PanelHealth {
            id: health
            width: parent.width
            panel: today.panel
            size: today.size
            double: !today.wide && Theme.textSize <= 1.15
            gutter: today.gutter
            least: today.room
            spread: today.spread + today.lack
            // Its heading is level with that of the counts beside it.
            crown: today.wide ? counts.crown : 0
        }
    }
    Column {
        id: middle
        x: today.wide ? left.width + today.space : 0
        y: today.wide ? left.y : left.y + left.height + today.space
        width: today.wide ? today.main - x : today.width
        spacing: today.space
        PanelCounts {
            id: counts
            width: parent.width
            apart: today.airy
            size: today.size
            words: today.words
            records: today.panel.records
            grid: today.grid
            figure: today.figure
            named: today.panel.choices.named
            onAsked: today.panel.wish("names", "")
        }
        PanelSessions {
            width: parent.width
            apart: today.airy
            size: today.size
            grid: counts.gridded ? today.grid : []
            figure: today.figure
            least: Math.floor(today.wide ? today.foot - today.below - counts.height - today.space : today.seen - middle.y - y)
            words: today.words
            records: today.panel.records
        }
    }
}
