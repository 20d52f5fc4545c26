// Everything that is to be done, in rows of one shape: what is the matter, what to do, and at the end the button that
// does it, or shows the command to type elsewhere. What a button does here stands first.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: notice

    required property PanelScreen panel
    required property real size
    // How much higher each row is than it needs to be.
    property real more: 0
    // How high it is at least, where it ends with the actions beside it. All rows are as high then, as theirs are, unless
    // one of them needs more.
    property real lowest: 0
    readonly property real even: lowest === 0 ? 0 : Math.floor((lowest - 2 * above - head) / Math.max(1, matters.length))
    readonly property real share: matters.every(matter => high(matter, size) + 2 * between <= even) ? even : 0
    readonly property real extra: lowest === 0 || share > 0 ? 0 : Math.max(0, Math.floor((lowest - head - deep(size)) / Math.max(1, matters.length)))
    readonly property var matters: panel.health.matters
    // Whether it has a heading, and how high that is then.
    property bool titled: false
    readonly property real head: titled ? headed(size) : 0
    // The actions that answer one of them: their buttons stand here, and not among the others.
    readonly property var answered: matters.map(matter => matter.action ?? "").filter(action => action !== "")
    readonly property var rest: matters.filter(matter => !isAnswered(matter))
    readonly property var typing: matters.filter(matter => !matter.action && matter.command)
    readonly property var ordered: [...matters.filter(matter => matter.action), ...rest, ...typing]
    // The commands that are shown, until their button is pressed again.
    property list<string> opened: []
    // The bar at its edge and the marks have the colours that warn. Nothing else has: the state is what is seen first.
    readonly property real bar: 14 * Theme.unit
    readonly property real inset: Math.round(1.4 * Theme.gap)
    readonly property real across: width - 2 * inset
    readonly property real mark: 1.7 * size
    readonly property real above: Math.round(0.5 * Theme.gap)
    readonly property real between: Math.round(0.42 * Theme.gap)
    readonly property real answer: answerOf(size)
    readonly property real padding: 28 * Theme.unit
    // Letters of one width are wide.
    readonly property real typed: Math.max(25 * Theme.unit, 0.8 * size)
    readonly property real least: (Theme.upright ? 80 : 72) * Theme.unit
    // All answers are as wide as the widest needs, and stand at the end of their rows, or all of them below.
    readonly property real answering: answeringOf(size)
    readonly property bool aside: asides(size)
    readonly property var signs: ({
        backup: "M8.5 8 H20 V21 H8.5 Z M5 16 H4 V3 H15.5 V4.5",
        how: "M5 6.5 L10.5 12 L5 17.5 M13 18 H20",
        mute: "M3 9.5 H7 L12.5 5 V19 L7 14.5 H3 Z M16 9 A4.5 4.5 0 0 1 16 15 M18.8 6.2 A8.5 8.5 0 0 1 18.8 17.8",
        silence: "M3 9.5 H7 L12.5 5 V19 L7 14.5 H3 Z M16.5 9.5 L21.5 14.5 M21.5 9.5 L16.5 14.5"
    })

    function turn(command: string) {
        opened = opened.includes(command) ? opened.filter(each => each !== command) : [...opened, command]
    }
    function said(matter: var): string {
        return `${matter.name}: ${matter.message}`
    }
    function isAnswered(matter: var): bool {
        return Boolean(matter.action || matter.command)
    }
    function answerOf(size: real): real {
        return Math.min(size, Math.max(27 * Theme.unit, 0.94 * size))
    }
    function answeringOf(size: real): real {
        const pressed = matters.filter(isAnswered).map(matter => wordWidths.bold(matter.button, size))
        return Math.ceil(Math.max(0, ...pressed) * 1.01 + 1.95 * size + 2 * padding + 2 * Theme.unit)
    }
    // What the words of a matter have beside its answer.
    function beside(matter: var, size: real): real {
        return across - 1.7 * size - (isAnswered(matter) && asides(size) ? answeringOf(size) + Theme.gap : 0)
    }
    function asides(size: real): bool {
        const room = across - 1.7 * size - answeringOf(size) - Theme.gap
        return matters.filter(isAnswered).every(matter => Math.min(1.02 * wordWidths.bold(said(matter), size), 12.5 * size) <= room)
    }
    // Whether all matters have one line beside their answers if they are written so large.
    function holds(size: real): bool {
        return asides(size) && matters.filter(isAnswered).every(matter => 1.02 * wordWidths.bold(said(matter), size) <= beside(matter, size))
    }
    // How high a matter is if it is written so large.
    function high(matter: var, size: real): real {
        const line = each => Math.ceil(1.37 * each), answer = answerOf(size)
        const own = beside(matter, size), answers = isAnswered(matter) ? Math.max(least, line(size) + 18 * Theme.unit) : 0
        const words = wordWidths.lines(said(matter), size, own) * line(size) + (matter.remedy ? wordWidths.plainLines(matter.remedy, answer, own) * line(answer) : 0)
        return !asides(size) ? words + (answers > 0 ? answers + 6 * Theme.unit : 0) : Math.max(answers, words)
    }
    function headed(size: real): real {
        return Math.ceil(1.37 * heading(size)) + between
    }
    function heading(size: real): real {
        return Math.round(Math.max(27 * Theme.unit, 0.86 * size))
    }
    // How high it is if it is written so large, without its heading.
    function deep(size: real): real {
        return Math.ceil(matters.reduce((sum, matter) => sum + high(matter, size) + 2 * between + 2 * Theme.unit, 0) - 2 * between - 2 * Theme.unit + 2 * above + 2 * between)
    }
    // Give the keyboard to the button of an action, if it stands here.
    function take(action: string): bool {
        const found = [mute, backup].find(each => each.visible && each.action === action)
        found?.button.forceActiveFocus(Qt.OtherFocusReason)
        return found !== undefined
    }
    WordWidths {
        id: wordWidths
    }

    component Matter: Item {
        id: row
        property var matter: null
        readonly property bool first: matter !== null && matter.name === notice.ordered[0]?.name
        readonly property string command: matter?.command ?? ""
        readonly property bool open: command !== "" && notice.opened.includes(command)
        readonly property string action: matter?.action ?? ""
        readonly property bool answered: matter !== null && notice.isAnswered(matter)
        readonly property real foot: answered ? button.height : 0
        readonly property real room: matter === null ? 0 : notice.beside(matter, notice.size)
        property alias button: button
        visible: matter !== null
        width: notice.across
        readonly property real tall: notice.aside ? Math.max(words.height, foot) : words.height + (answered ? foot + 6 * Theme.unit : 0)
        height: Math.max(notice.share, 2 * notice.between + notice.more + notice.extra + tall)
        Rectangle {
            visible: !row.first
            width: parent.width
            height: 2 * Theme.unit
            color: Theme.edge
        }
        PanelMark {
            y: words.y
            well: false
            grown: 1.2
            size: notice.size
        }
        Column {
            id: words
            x: notice.mark
            y: Math.floor((row.height - (notice.aside ? height : row.tall)) / 2)
            width: row.room
            PlainText {
                width: parent.width
                text: row.matter === null ? "" : notice.said(row.matter)
                font { pixelSize: notice.size; bold: true }
                color: Theme.ink
                wrapMode: Text.Wrap
            }
            // The command takes the place of what to do, so that nothing below it moves.
            Item {
                visible: remedy.text !== "" || row.open
                width: parent.width
                height: Math.max(remedy.height, typed.visible ? typed.height : 0)
                Balanced {
                    id: remedy
                    visible: !row.open
                    width: parent.width
                    text: row.matter?.remedy ?? ""
                    horizontalAlignment: Text.AlignLeft
                    font.pixelSize: notice.answer
                    color: Theme.ink
                }
                PlainText {
                    id: typed
                    visible: row.open
                    width: parent.width
                    text: row.command
                    font { family: "monospace"; pixelSize: notice.typed }
                    color: Theme.ink
                    wrapMode: Text.Wrap
                    Accessible.ignored: true
                }
            }
        }
        // What is to be typed in a terminal is asked for: nothing of it can be done here.
        PanelButton {
            id: button
            objectName: row.action !== "" ? `action-${row.action}` : `how-${row.command}`
            visible: row.answered
            x: notice.aside ? row.width - width : notice.mark
            y: notice.aside ? Math.floor((row.height - height) / 2) : words.y + words.height + 6 * Theme.unit
            width: Math.min(notice.answering, row.width - (notice.aside ? 0 : notice.mark))
            enabled: row.action !== "backup" || notice.panel.choices.backup === ""
            least: notice.least
            ground: row.open ? Theme.touchable : Theme.white
            horizontalPadding: notice.padding
            words: row.matter?.button ?? ""
            drawing: notice.signs[row.action || "how"] ?? ""
            font { pixelSize: notice.size; bold: true }
            Accessible.name: row.open ? row.command : row.action !== "" ? button.words : `${button.words} ${row.matter === null ? "" : notice.said(row.matter)}`
            onClicked: {
                if (row.action !== "")
                    return notice.panel.wish(row.action, "")
                notice.turn(row.command)
                if (row.open)
                    button.Accessible.announce(row.command, Accessible.Polite)
            }
        }
    }

    // Whole pixels, so that the cards below it end level with the one beside them.
    height: Math.ceil(Math.max(lowest, rows.height + head + 2 * above))
    radius: Theme.radius
    color: Theme.amber

    Rectangle {
        x: notice.bar
        width: parent.width - notice.bar
        height: parent.height
        radius: notice.radius
        topLeftRadius: 0
        bottomLeftRadius: 0
        color: Theme.white
        border { color: Theme.edge; width: 2 * Theme.unit }
    }
    PlainText {
        visible: notice.titled
        x: notice.inset
        y: notice.above + notice.between
        width: notice.across
        text: notice.panel.words["console-to-do"] ?? ""
        font { pixelSize: notice.heading(notice.size); bold: true }
        color: Theme.faintInk
    }
    Column {
        id: rows
        anchors { left: parent.left; right: parent.right; margins: notice.inset; verticalCenter: parent.verticalCenter; verticalCenterOffset: notice.head / 2 }
        // What has a button is not made anew with the others: the keyboard, or a finger that lies on it, would lose it.
        Matter {
            id: mute
            matter: notice.matters.find(matter => matter.action === "mute") ?? null
        }
        Matter {
            id: backup
            matter: notice.matters.find(matter => matter.action === "backup") ?? null
        }
        Repeater {
            model: notice.rest
            delegate: Matter {
                required property var modelData
                matter: modelData
            }
        }
        // There are three such matters; a row that nothing is the matter with takes no room.
        Repeater {
            model: Math.max(3, notice.typing.length)
            delegate: Matter {
                required property int index
                matter: notice.typing[index] ?? null
            }
        }
    }
}
