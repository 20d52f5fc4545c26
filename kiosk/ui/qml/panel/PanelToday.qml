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
    readonly property real half: Math.floor(!wide ? width : tabled && panel.alarms.length === 0 ? Math.max(0.3 * main, Math.min(0.36 * main, health.natural)) : 0.4 * main)

    // Where what stands side by side begins, and where the status ends.
    readonly property real below: first.height + space
    readonly property real foot: stacked ? sessions.y + sessions.height : below + left.height
    // What the status has of a wide screen.
    readonly property real room: wide && panel.alarms.length === 0 ? Math.floor(seen - below) : 0

    // With few checks the sessions have the whole width below; otherwise they stand below the counts, beside the checks.
    readonly property bool stacked: wide && tabled && health.visible && panel.alarms.length === 0 && health.deep <= panel.records.cells.length + 3
    readonly property real level: Math.max(health.wish, counts.wish)

    // What a wide screen has left is shared among the rows of the counts and of the sessions, and so is what it lacks.
    readonly property int rows: panel.records.cells.length + panel.records.sessions.length
    readonly property real kept: (wide ? Math.floor(seen - below) : 0) - space - sessions.frame - sessions.packed - 4 * Theme.unit
    readonly property real shared: Math.min((kept - counts.frame - counts.packed - counts.last) / (rows + 2),
        stacked ? (kept - health.frame - health.packed) / (health.lines.length + panel.records.sessions.length) : Infinity)
    // Where that is not enough, the page scrolls anyway.
    readonly property real airy: !wide ? 10 * Theme.unit + spread : !tabled || shared < 3 * Theme.unit ? 9 * Theme.unit : Math.min(26 * Theme.unit, shared)
    // The lines of the checks where they stand in two columns.
    readonly property int pairs: Math.ceil(health.lines.length / 2)
    // On an upright one it is shared among the rows of all cards, as long as there is little to tell.
    readonly property bool calm: !wide && tabled && panel.health.matters.length < 4 && panel.alarms.length === 0 && panel.records.resumable.length === 0 && !panel.choices.canBeNext && !(panel.choices.onBreak ?? false)
    readonly property real bare: first.height + 4 * space + actions.bare + health.frame + health.packed + pairs * 10 * Theme.unit
        + counts.frame + counts.packed + counts.last + sessions.frame + sessions.packed + (rows + 2) * 10 * Theme.unit + 4 * Theme.unit
    readonly property real spread: calm ? Math.floor(Math.max(0, Math.min(24 * Theme.unit, (seen - bare) / (rows + 1 + actions.lines + pairs)))) : 0

    readonly property bool tabled: Theme.textSize <= 1.15
    // On an upright screen all second columns begin in line.
    readonly property real gutter: Math.round(40 * Theme.unit)

    height: wide ? Math.max(right.height, left.y + left.height, sessions.y + sessions.height) : sessions.y + sessions.height

    Column {
        id: first
        width: today.main
        spacing: today.space
        PanelNow { width: parent.width; panel: today.panel; size: today.size; split: today.wide ? today.half + today.space : Math.floor((room + today.gutter) / 2) }
        PanelNotice { width: parent.width; size: Theme.upright ? Math.max(Theme.denser, 0.93 * today.size) : 1.12 * Theme.dense; panel: today.panel; visible: matters.length > 0 }
    }
    Column {
        id: right
        x: today.width - width
        y: today.wide ? 0 : today.below
        width: today.side
        spacing: today.space
        PanelActions {
            id: actions
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
            least: today.stacked ? today.level : today.room
            apart: today.stacked ? today.airy : Math.max(today.airy, 10 * Theme.unit)
            // Its heading is level with that of the counts beside it.
            crown: today.wide ? counts.crown : 0
        }
    }
    PanelCounts {
        id: counts
        x: today.wide ? left.width + today.space : 0
        y: today.wide ? left.y : left.y + left.height + today.space
        width: today.wide ? today.main - x : today.width
        apart: today.airy
        size: today.size
        least: today.stacked ? today.level : 0
        words: today.words
        records: today.panel.records
        like: today.stacked ? null : sessions
        named: today.panel.choices.named
        onAsked: today.panel.wish("names", "")
    }
    PanelSessions {
        id: sessions
        x: today.stacked ? 0 : counts.x
        y: counts.y + counts.height + today.space
        width: today.stacked ? today.main : counts.width
        apart: today.airy
        size: today.size
        like: today.stacked ? null : counts
        least: Math.floor((today.stacked || !today.wide ? today.seen : today.below + left.height) - y)
        words: today.words
        records: today.panel.records
    }
}
