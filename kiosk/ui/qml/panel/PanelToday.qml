// The first page: what is going on and the way back to it, what is not well, what can be done at once, and the day.
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
    readonly property bool tabled: Theme.textSize <= 1.15
    // The letters are as large as goes, up to what is read well from where the experimenter stands, as long as the page
    // does not scroll for it. In whole pixels, as letters are drawn.
    readonly property real usual: wide ? 1.15 * Theme.dense : Math.max(Theme.dense, 26 * Theme.textSize * Theme.unit)
    readonly property list<real> sizes: tabled ? [34, 32, 30, 28, 26].map(each => Math.round(each * Theme.unit)).filter(each => each > Math.round(usual)) : []
    readonly property real size: sizes.find(each => (notice.holds(each) || each <= 32 * Theme.unit) && deep(each, titled ? notice.headed(each) : 0) + (each > 30 * Theme.unit ? air : 0) <= seen - 2) ?? usual
    // An upright page keeps some room for the air between its parts before it has larger letters.
    readonly property real air: wide ? 0 : 5.5 * Theme.gap
    // Whole pixels: a card at a fraction of one would lose its right edge.
    readonly property real side: Math.floor(wide ? width * 0.44 : width)
    readonly property real main: wide ? width - side - space : width
    readonly property real below: now.height + space
    // With several matters, the notice is about as high as the actions beside it, and the day stands below both.
    readonly property bool level: wide && tabled && warned && panel.alarms.length === 0 && panel.records.resumable.length === 0
        && notice.deep(usual) > 0.5 * actions.deep(usual) && now.deep(usual) + space + Math.max(notice.deep(usual), actions.deep(usual)) + space + 10 * usual <= seen
    readonly property alias way: now.way
    // Both cards have a heading where the page has room for that.
    readonly property bool titled: tabled && deep(usual, notice.headed(usual)) <= seen - 2
    readonly property real head: titled ? notice.headed(size) : 0
    readonly property bool warned: notice.matters.length > 0
    readonly property bool allWell: panel.health.matters.length === 0 && panel.alarms.every(alarm => !alarm.holds)
    // What a page has left is shared among its parts; the last of them takes the rest.
    readonly property real free: Math.floor(seen - below)
    readonly property real spare: !tabled ? 0 : Math.max(0, free - (level ? both(size, head) : told(size, head) + (wide ? 0 : space + done(size, head))))
    readonly property real beside: Math.max(notice.deep(size) + head, Math.min(actions.most, Math.max(notice.deep(size) + head, acting) + Math.floor((health.tiled ? 0.85 : 0.65) * spare)))
    readonly property real aired: wide ? 0 : Math.floor(Math.min(0.8 * Theme.gap, 0.15 * spare))
    readonly property real acting: actions.deep(size) + head

    // The keyboard stays on an action whose button goes from one place to the other.
    readonly property var answered: notice.answered
    property string acted: ""
    readonly property Item held: today.Window.activeFocusItem
    onHeldChanged: if (held !== null && held.visible && held.objectName.startsWith("action-")) acted = held.objectName.slice(7)
        else if (held !== null && held.visible) acted = ""
    onAnsweredChanged: if (["backup", "mute"].includes(acted)) Qt.callLater(follow)
    function follow() {
        if (acted !== "" && !notice.take(acted))
            actions.take(acted)
    }
    function checked(size: real): real {
        return health.visible ? health.bare(quieter(size)) : 0
    }
    // What is read last is smaller than what is to be done.
    function quieter(size: real): real {
        return Math.min(size, Math.max(27 * Theme.unit, Math.round(0.92 * size)))
    }
    // How high the page is at least if it is written so large, with headings of this height: the words at the left, and the
    // actions.
    function deep(size: real, head: real): real {
        return now.deep(size) + space + (level ? both(size, head) : wide ? Math.max(told(size, head), done(size, head)) : told(size, head) + space + done(size, head))
    }
    function both(size: real, head: real): real {
        return Math.max(notice.deep(size) + head, done(size, head)) + space + checked(size)
    }
    function told(size: real, head: real): real {
        const line = Math.ceil(1.4 * size)
        const alarmed = panel.alarms.length === 0 ? 0 : alarms.edges + (1 + panel.alarms.length) * 1.12 * line + panel.alarms.length * alarms.apart
        const parts = [alarmed, warned ? notice.deep(size) + head : 0, checked(size)].filter(each => each > 0)
        return parts.reduce((sum, each) => sum + each + space, -space)
    }
    // Up to the page's end, where it nearly is that high.
    function filled(high: real): real {
        return high > 0.7 * free ? free : high
    }
    function done(size: real, head: real): real {
        const line = Math.ceil(1.4 * size)
        const waiting = panel.records.resumable.length
        const asked = 8 * Theme.unit + Math.ceil(1.12 * line) * wordWidths.lines(panel.words["console-resume"], 1.12 * size, side - 2 * alarms.inset)
        return actions.deep(size) + head + (waiting === 0 ? 0 : space + alarms.edges + asked + waiting * Math.max(76 * Theme.unit, line + 18 * Theme.unit) + (waiting - 1) * 9 * Theme.unit)
    }

    WordWidths {
        id: wordWidths
    }

    height: wide ? Math.max(right.y + right.height, health.visible ? health.y + health.height : left.y + left.height) : health.visible ? health.y + health.height : right.y + right.height

    PanelNow {
        id: now
        width: parent.width
        panel: today.panel
        size: today.size
        side: today.wide ? today.side : 0
    }
    Column {
        id: left
        y: today.below
        width: today.main
        spacing: today.space
        PanelAlarms {
            id: alarms
            width: parent.width
            panel: today.panel
            size: today.size
            visible: today.panel.alarms.length > 0
        }
        PanelNotice {
            id: notice
            width: parent.width
            size: today.size
            more: today.level ? 0 : Math.floor(Math.min((today.wide ? 1.2 : 0.6) * Theme.gap, 0.25 * today.spare / Math.max(1, matters.length)))
            lowest: today.level ? today.beside : 0
            titled: today.titled
            panel: today.panel
            visible: today.warned
        }
    }
    Column {
        id: right
        x: today.width - width
        y: today.wide ? today.below : left.y + left.height + (left.height > 0 ? today.space + today.aired : 0)
        width: today.side
        spacing: today.space
        PanelActions {
            id: actions
            answered: notice.answered
            signs: notice.signs
            titled: today.titled
            head: today.head
            heading: notice.heading(today.size)
            width: parent.width
            panel: today.panel
            size: today.size
            least: today.panel.records.resumable.length > 0 ? 0 : today.level ? today.beside : today.wide ? today.filled(Math.max(today.told(today.size, today.head) + notice.more * notice.matters.length, actions.most)) : today.acting + Math.floor(Math.min(0.4 * today.acting, 0.4 * today.spare))
        }
        PanelResume { width: parent.width; panel: today.panel; size: today.size }
    }
    PanelHealth {
        id: health
        y: today.level ? Math.max(left.y + left.height, right.y + right.height) + today.space : today.wide ? left.y + left.height + (left.height > 0 ? today.space : 0) : right.y + right.height + today.space + today.aired
        width: today.level ? today.width : today.main
        abreast: today.level
        panel: today.panel
        size: today.quieter(today.size)
        allWell: today.allWell
        // Beside the actions it ends where they do.
        most: today.tabled ? Math.floor((today.wide && !today.level ? Math.min(today.seen, right.y + right.height) : today.seen - 1) - y) : 0
    }
}
