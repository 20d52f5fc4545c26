// What is going on now, in the largest letters of the panel, and the day in numbers beside or below it.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: now

    required property PanelScreen panel
    // How large its words are; the stage and the numbers are larger, as far as they have one line.
    required property real size
    // How wide the column at the right end of the page is; the numbers begin where it does, if that is enough for them.
    property real side: 0
    readonly property var tiles: panel.today.tiles
    readonly property var stage: tiles.find(each => each.name === "stage")
    // Without a target, and before the first game, there is nothing to tell of it.
    readonly property var shown: tiles.filter(each => each.name !== "stage" && each.value !== "-")
    readonly property string session: panel.choices.underWay ? panel.choices.session : ""
    readonly property bool resting: session === ""
    readonly property bool tabled: Theme.textSize <= 1.15

    readonly property real inset: Math.round(1.4 * Theme.gap)
    readonly property real step: Math.round(1.2 * Theme.gap)
    readonly property real room: width - 2 * inset
    // A number and its title have one line each beside the stage, or the whole width below it.
    readonly property bool beside: besides(size)
    readonly property real numbers: numbersOf(size)
    readonly property real stageRoom: roomOf(size)
    readonly property string told: stage?.line ?? ""
    // Where they have one line, its minutes stand behind the stage, and not behind what is said of the session.
    readonly property bool behind: behinds(size)
    readonly property real figure: (tabled ? 3.1 : 2.4) * Theme.dense
    // Smaller where the stage has a long name, and in two lines only where even small letters do not fit.
    readonly property real crown: crownOf(size)
    readonly property real sign: resting ? 0 : Math.round((tabled ? 2.9 : 2.4) * Theme.dense)
    readonly property real signGap: resting ? 0 : Math.round(1.1 * Theme.gap)
    readonly property real title: 0.88 * size
    readonly property real line: 0.82 * size
    // Each has what it needs, and all of them the same of what is left.
    readonly property var widths: widthsOf(size)

    function roomOf(size: real): real {
        return (besides(size) ? room - numbersOf(size) - 2 * step : room) - sign - signGap
    }
    function crownOf(size: real): real {
        const most = (Theme.upright ? 4.3 : 4.8) * Theme.dense, whole = wordWidths.bold(stage?.value ?? "", 100)
        return Math.floor(Math.max(0.5 * most, Math.min(most, 98 * roomOf(size) / Math.max(1, whole))))
    }
    function leastOfStage(size: real): real {
        return sign + signGap + step + Math.max(wordWidths.bold(stage?.value ?? "", 2.4 * Theme.dense), wordWidths.plain(session || told, 1.1 * size), 16 * size)
    }
    // At least a number and its title have one line; a long line below them has two.
    function least(tile: var, size: real): real {
        return Math.ceil(1.02 * Math.max(wordWidths.bold(tile.value, figure), wordWidths.plain(tile.title, 0.88 * size)) + 4 * Theme.unit)
    }
    function needs(size: real): var {
        return shown.map(tile => Math.max(least(tile, size), Math.ceil(1.02 * Math.min(12 * size, wordWidths.plain(tile.line, 0.82 * size)) + 4 * Theme.unit)))
    }
    function numbered(size: real): real {
        return needs(size).reduce((sum, each) => sum + each, 0) + (shown.length - 1) * step
    }
    function widthsOf(size: real): var {
        const wishes = needs(size), spare = numbersOf(size) - numbered(size)
        const leasts = shown.map(tile => least(tile, size)), most = wishes.reduce((sum, each, at) => sum + each - leasts[at], 0)
        return wishes.map((each, at) => Math.floor(each + (spare >= 0 ? spare / wishes.length : spare * (each - leasts[at]) / Math.max(1, most))))
    }
    function besides(size: real): bool {
        return !Theme.upright && numbered(size) + step + leastOfStage(size) <= room
    }
    function numbersOf(size: real): real {
        return besides(size) ? Math.max(numbered(size), side - inset) : room
    }
    function behinds(size: real): bool {
        const crown = crownOf(size)
        return wordWidths.bold(stage?.value ?? "", crown) * 1.02 + 0.3 * crown + wordWidths.plain(told, 1.1 * size) <= roomOf(size)
    }
    // How high it is if its words are written so large.
    function deep(size: real): real {
        const line = each => Math.ceil(1.37 * each), widths = widthsOf(size)
        const below = (behinds(size) ? [] : [told]).concat([session]).filter(text => text !== "")
        const first = Math.max(sign, 0.92 * line(crownOf(size)) * wordWidths.lines(stage?.value ?? "", crownOf(size), 1.03 * roomOf(size)) + below.length * line(1.1 * size))
        const second = 0.95 * line(figure) + Math.max(0, ...shown.map((tile, at) => wordWidths.plainLines(tile.title, 0.88 * size, widths[at]) * line(0.88 * size)
            + (tile.line === "" ? 0 : wordWidths.plainLines(tile.line, 0.82 * size, widths[at]) * line(0.82 * size))))
        return Math.ceil(1.4 * Theme.gap + 3 + (besides(size) ? Math.max(first, second) : first + (shown.length > 0 ? 1.2 * Theme.gap + second : 0)))
    }
    WordWidths {
        id: wordWidths
    }

    height: Math.ceil(1.4 * Theme.gap + (beside ? Math.max(state.height, day.height) : state.height + (shown.length > 0 ? 1.2 * Theme.gap + day.height : 0)))
    radius: Theme.radius
    color: Theme.stated
    border { color: Theme.highContrast ? Theme.edge : "transparent"; width: 2 * Theme.unit }

    // The sign of a pause: two bars, and no disc around them, which would look like a button.
    Drawing {
        visible: !now.resting
        x: now.inset + (now.sign - width) / 2 - 0.14 * now.sign
        y: state.y + (state.height - height) / 2
        scale: 1.55 * now.sign / 24
        thick: 3.6
        path: "M8.6 5 V19 M15.4 5 V19"
        ink: Theme.sea
    }
    Item {
        id: state
        objectName: "today-stage"
        x: now.inset + now.sign + now.signGap
        y: now.beside ? Math.floor((now.height - height) / 2) : 0.7 * Theme.gap
        width: now.stageRoom
        height: Math.max(now.sign, words.height)
        Accessible.role: Accessible.Grouping
        Accessible.name: now.stage?.title ?? ""
        Column {
            id: words
            // Large letters have more room above them than below.
            y: Math.floor((parent.height - height) / 2 - 0.07 * now.crown)
            width: parent.width
            PlainText {
                width: parent.width
                text: now.stage?.value ?? ""
                font { pixelSize: now.crown; bold: true }
                lineHeight: 0.92
                color: Theme.ink
                wrapMode: Text.Wrap
                PlainText {
                    visible: now.behind
                    x: parent.implicitWidth + 0.3 * now.crown
                    y: parent.baselineOffset - baselineOffset
                    text: now.told
                    font.pixelSize: 1.1 * now.size
                    color: Theme.faintInk
                }
            }
            PlainText {
                visible: !now.behind && text !== ""
                width: parent.width
                text: now.told
                font.pixelSize: 1.1 * now.size
                color: Theme.faintInk
                wrapMode: Text.Wrap
            }
            PlainText {
                visible: text !== ""
                width: parent.width
                text: now.session
                font { pixelSize: 1.1 * now.size; bold: true }
                color: Theme.sea
                wrapMode: Text.Wrap
            }
        }
    }
    Rectangle {
        visible: now.shown.length > 0 && !now.beside
        x: now.inset
        y: state.y + state.height + 0.6 * Theme.gap
        width: now.room
        height: 2 * Theme.unit
        color: Theme.shy
    }
    Row {
        id: day
        x: now.beside ? now.width - now.inset - now.numbers : now.inset
        y: now.beside ? Math.floor((now.height - height) / 2 - 0.05 * now.figure) : state.y + state.height + 1.1 * Theme.gap
        spacing: now.step
        Repeater {
            model: now.shown
            delegate: PanelTile {
                required property var modelData
                required property int index
                objectName: "today-" + modelData.name
                width: now.widths[index] ?? 0
                size: now.figure
                lettering: now.title
                lower: now.line
                title: modelData.title
                value: modelData.value
                line: modelData.line
            }
        }
    }
}
