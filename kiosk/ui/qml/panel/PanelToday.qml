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
    readonly property real half: Math.floor(wide ? main * 0.43 : width)

    // Where what stands side by side begins, and where the status ends.
    readonly property real below: first.height + space
    readonly property real foot: below + left.height
    // What the status has of a wide screen, and how high each of its lines then is; upright, as high as a button.
    readonly property real room: wide && panel.alarms.length === 0 ? Math.floor(seen - below) : 0
    readonly property real each: wide ? Math.max(0, Math.min(76 * Theme.unit, 0.97 * (room - 3.9 * size) / (panel.health.lines.length + 1) - apart)) : 36 * Theme.unit
    // A line that is as high as the button in it needs no more room around it.
    readonly property real apart: (!wide ? 5 : room > 0 ? 2 : 14) * Theme.unit

    // What a wide screen has left is shared among the rows of the counts and of the sessions.
    readonly property int rows: panel.records.cells.length + panel.records.sessions.length
    readonly property real leftOver: room > 0 && Theme.textSize <= 1.15 ? room - (370 + 45 * rows) * Theme.unit : 0
    readonly property real airy: 10 * Theme.unit + Math.max(0, Math.min(16 * Theme.unit, leftOver / (rows + 2)))

    // What a test takes of the line of the voice.
    readonly property string test: words[wide ? "console-test-voice" : "console-test-the-voice"]
    readonly property real testing: panel.choices.underWay ? 0 : Math.ceil(letters.advanceWidth + 42 * Theme.unit)
    TextMetrics {
        id: letters
        text: today.test
        font.pixelSize: Theme.dense
    }

    height: wide ? Math.max(right.height, left.y + left.height, middle.y + middle.height) : middle.y + middle.height

    Column {
        id: first
        width: today.main
        spacing: today.space
        PanelNow { width: parent.width; panel: today.panel; size: today.size; wide: today.wide || Theme.textSize <= 1.15; split: today.wide ? today.half + today.space : Math.round(0.46 * width) }
        PanelNotice { width: parent.width; health: today.panel.health }
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
            least: today.wide && today.panel.records.resumable.length === 0 ? Math.min(today.foot, today.seen) : 0
        }
        PanelResume { width: parent.width; panel: today.panel }
    }
    Column {
        id: left
        y: today.wide ? today.below : right.y + right.height + today.space
        width: today.half
        spacing: today.space
        PanelAlarms { width: parent.width; panel: today.panel; size: today.size; visible: today.panel.alarms.length > 0 }
        PanelSection {
            width: parent.width
            apart: today.apart
            size: today.size
            title: today.words["console-health"]
            least: today.room
            Repeater {
                model: today.panel.health.lines
                delegate: PanelLine {
                    required property var modelData
                    line: modelData
                    width: parent.width
                    size: today.size
                    least: today.each
                    beside: today.testing
                    brief: true
                    // While a visitor is there, the voice is theirs.
                    action: modelData.part === "voice" && !today.panel.choices.underWay ? today.test : ""
                    actionName: today.words["console-test-the-voice"]
                    ready: !today.panel.choices.muted
                    onAsked: today.panel.wish("test_voice", "")
                }
            }
            PanelLine {
                visible: today.panel.alarms.length === 0
                width: parent.width
                size: today.size
                least: today.each
                line: ({
                    name: today.words["console-alarms"],
                    message: today.words["console-alarms-none"],
                    is_ok: true,
                    part: "",
                })
            }
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
            named: today.panel.choices.named
            onAsked: today.panel.wish("names", "")
        }
        PanelSessions {
            width: parent.width
            apart: today.airy
            size: today.size
            least: today.wide ? Math.floor(today.foot - today.below - counts.height - today.space - Theme.unit) : 0
            words: today.words
            records: today.panel.records
        }
    }
}
