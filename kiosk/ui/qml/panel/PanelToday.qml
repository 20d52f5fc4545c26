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
    // On an upright page what can be done stands first, unless something has failed: then the notice does.
    readonly property bool led: wide || panel.alarms.some(alarm => alarm.holds)
    // The line between two parts of the sheet.
    readonly property real seam: Math.max(1, Math.round(2 * Theme.unit))
    // The letters are as large as goes, up to what is read well from where the experimenter stands, as long as nothing
    // wraps and the page does not scroll for it. So is what goes on now. In whole pixels, as letters are drawn.
    readonly property real usual: wide ? 1.15 * Theme.dense : Math.max(Theme.dense, 26 * Theme.textSize * Theme.unit)
    readonly property var grown: !tabled || panel.alarms.length > 0 || panel.records.resumable.length > 0 ? undefined : [30, 29, 28, 27, 26].map(each => Math.round(each * Theme.unit)).filter(each => each > Math.round(usual)).find(each => holds(each) && deep(each) <= seen)
    readonly property real size: grown ?? usual
    readonly property real figure: figured(grown !== undefined)
    // Whole pixels: a card at a fraction of one would lose its right edge.
    readonly property real side: Math.floor(wide ? width * 0.265 : width)
    readonly property real main: wide ? width - side - space : width
    // The checks have what their lines need, and the tables have the rest.
    readonly property real half: halved(size)

    // Where what stands side by side begins, and where the status ends.
    readonly property real below: first.height + space
    readonly property real foot: stacked ? sessions.y + sessions.height : below + left.height
    // What the status has of a wide screen.
    readonly property real room: wide && panel.alarms.length === 0 ? Math.floor(seen - below) : 0

    // With few checks the sessions have the whole width below; otherwise they stand below the counts, beside the checks.
    readonly property bool stacked: health.visible && stacks(size)
    readonly property real level: Math.max(health.wish, counts.wish)

    // What a wide screen has left is shared among the rows of the counts and of the sessions, and so is what it lacks.
    readonly property int rows: panel.records.cells.length + panel.records.sessions.length
    readonly property real kept: (wide ? Math.floor(seen - below) : 0) - seam - sessions.frame - sessions.packed - 4 * Theme.unit
    readonly property real shared: Math.min((kept - counts.frame - counts.packed - counts.last) / (rows + 2),
        stacked ? (kept - health.frame - health.packed) / (health.lines.length + panel.records.sessions.length) : Infinity)
    // Where that is not enough, the page scrolls anyway.
    readonly property real airy: !wide ? 10 * Theme.unit + spread : !tabled || shared < 3 * Theme.unit ? 9 * Theme.unit : Math.min(26 * Theme.unit, shared)
    // The lines of the checks where they stand in two columns.
    readonly property int pairs: Math.ceil(health.lines.length / 2)
    // On an upright one it is shared among the rows of all cards, as long as there is little to tell.
    readonly property bool calm: !wide && tabled && panel.health.matters.length < 4 && panel.alarms.length === 0 && panel.records.resumable.length === 0
    readonly property real bare: now.height + (notice.visible ? notice.height + space : 0) + 2 * space + 2 * seam + actions.bare + health.frame + health.packed + pairs * 10 * Theme.unit
        + counts.frame + counts.packed + counts.last + sessions.frame + sessions.packed + (rows + 2) * 10 * Theme.unit + 4 * Theme.unit
    readonly property real spread: calm ? Math.floor(Math.max(-8 * Theme.unit, Math.min(24 * Theme.unit, (seen - bare) / (rows + 1 + actions.lines + 1.1 * actions.mains + pairs)))) : 0

    readonly property bool tabled: Theme.textSize <= 1.15
    // On an upright screen all second columns begin in line.
    readonly property real gutter: Math.round(40 * Theme.unit)

    // The keyboard stays on an action whose button goes from one place to the other.
    readonly property var answered: notice.answered
    property string acted: ""
    readonly property Item held: today.Window.activeFocusItem
    onHeldChanged: if (held !== null && held.visible && held.objectName.startsWith("action-")) acted = held.objectName.slice(7)
        else if (held !== null && held.visible) acted = ""
    readonly property bool aside: actions.beside
    onAnsweredChanged: if (["backup", "mute"].includes(acted)) Qt.callLater(follow)
    onAsideChanged: if (acted === "backup") Qt.callLater(follow)
    function follow() {
        if (acted !== "" && !notice.take(acted))
            actions.take(acted)
    }
    function figured(grown: bool): real {
        return Math.max(Theme.dense * (Theme.upright ? 1.8 : 2.1), grown ? 60 * Theme.unit : 0)
    }
    function warned(size: real): real {
        return size > usual ? size : wide ? 1.12 * Theme.dense : Math.max(Theme.denser, 0.93 * usual)
    }
    function halved(size: real): real {
        // The numbers of the day begin there too, beyond the words on what goes on.
        const told = now.before(size, figured(size > usual)) + 0.5 * Theme.gap
        return Math.floor(!wide ? width : tabled && panel.alarms.length === 0 ? Math.max(0.3 * main, Math.min(0.36 * main, Math.max(told, health.natural(size)))) : 0.4 * main)
    }
    function stacks(size: real): bool {
        return wide && tabled && panel.health.lines.length > 0 && panel.alarms.length === 0 && health.deep(size, halved(size)) <= panel.records.cells.length + 3
    }
    // Whether no number and no cell wraps if it is written so large.
    function holds(size: real): bool {
        const beside = wide ? main - halved(size) - seam : width
        return now.holds(size, figured(true)) && counts.holds(size, beside) && sessions.holds(size, stacks(size) ? main : beside)
    }
    // How high the page is then, at least.
    function deep(size: real): real {
        const line = Math.ceil(letters.height * size / 100)
        const least = (wide ? 7 : 10) * Theme.unit
        const headed = crown => Math.ceil(Math.max(1.12 * line, crown)) + counts.edges
        const crown = panel.records.cells.length > 0 ? Math.max(58 * Theme.unit, 0.95 * line + 18 * Theme.unit) : 0
        const table = (rows, crown) => headed(crown) + (1 + Math.max(1, rows)) * line + (rows + 0.4) * least + 2 * Theme.unit
        const checked = health.deep(size, halved(size))
        const checks = checked > 0 ? headed(wide ? crown : 0) + checked * line + (checked - 1) * (stacks(size) ? least : 10 * Theme.unit) : 0
        const counted = table(panel.records.cells.length, crown) + least + line * counts.lastLines(size, wide ? main - halved(size) - seam : width)
        const listed = table(panel.records.sessions.length, 0)
        const above = now.deep(size, figured(true)) + space + (panel.health.matters.length > 0 ? notice.deep(warned(size)) + space : 0)
        const acting = actions.deep(size)
        if (!wide)
            return above + acting + checks + counted + listed + space + 2 * seam
        return Math.max(acting, above + (stacks(size) ? Math.max(checks, counted) + seam + listed : Math.max(checks, counted + seam + listed)))
    }
    FontMetrics {
        id: letters
        font.pixelSize: 100
    }

    height: wide ? Math.max(right.height, left.y + left.height, sessions.y + sessions.height) : sessions.y + sessions.height

    Column {
        id: first
        width: today.main
        spacing: today.space
        PanelNow { id: now; width: parent.width; panel: today.panel; size: today.size; figure: today.figure; rule: today.wide ? today.half : 0; split: today.wide ? today.half + today.seam : Math.floor((room + today.gutter) / 2) }
        PanelNotice {
            id: notice
            parent: today.led ? first : later
            width: today.main
            answering: today.wide
            size: today.warned(today.size)
            usual: today.warned(today.usual)
            panel: today.panel
            visible: matters.length > 0
        }
    }
    Column {
        id: right
        x: today.width - width
        y: today.wide ? 0 : today.below
        width: today.side
        spacing: today.space
        PanelActions {
            id: actions
            answered: notice.answered
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
        id: later
        y: right.y + right.height + today.space
    }
    // One quiet sheet with lines between its parts.
    Rectangle {
        id: sheet
        objectName: "today-sheet"
        y: left.y
        width: today.main
        height: Math.max(left.y + left.height, sessions.y + sessions.height) - y
        radius: Theme.radius
        color: Theme.white
        border { color: Theme.edge; width: 2 * Theme.unit }
    }
    component Seam: Rectangle {
        color: Theme.edge
    }
    Seam {
        visible: today.wide && left.height > 0
        x: left.width
        y: counts.y + counts.inset
        width: today.seam
        height: (today.stacked ? left.y + left.height : sessions.y + sessions.height) - y - counts.inset
    }
    Seam {
        visible: !today.wide && left.height > 0
        x: counts.inset
        y: counts.y - today.seam
        width: today.width - 2 * x
        height: today.seam
    }
    Seam {
        x: sessions.x + sessions.inset
        y: sessions.y - today.seam
        width: sessions.width - 2 * sessions.inset
        height: today.seam
    }
    Seam {
        visible: alarms.visible && health.visible
        x: health.inset
        y: left.y + health.y - today.seam
        width: left.width - 2 * x
        height: today.seam
    }
    Column {
        id: left
        y: today.wide ? today.below : later.height > 0 ? later.y + later.height + today.space : later.y
        width: today.half
        spacing: today.seam
        PanelAlarms { id: alarms; framed: false; width: parent.width; panel: today.panel; size: today.size; visible: today.panel.alarms.length > 0 }
        PanelHealth {
            id: health
            framed: false
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
        framed: false
        x: today.wide ? left.width + today.seam : 0
        y: today.wide ? left.y : left.y + left.height + (left.height > 0 ? today.seam : 0)
        width: today.wide ? today.main - x : today.width
        apart: today.airy
        size: today.size
        least: today.stacked ? today.level : 0
        words: today.words
        records: today.panel.records
        like: today.stacked ? null : sessions
        roomy: today.size > today.usual
        named: today.panel.choices.named
        onAsked: today.panel.wish("names", "")
    }
    PanelSessions {
        id: sessions
        framed: false
        x: today.stacked ? 0 : counts.x
        y: counts.y + counts.height + today.seam
        width: today.stacked ? today.main : counts.width
        apart: today.airy
        size: today.size
        like: today.stacked ? null : counts
        least: Math.floor((today.stacked || !today.wide ? today.seen : today.below + left.height) - y)
        words: today.words
        records: today.panel.records
    }
}
