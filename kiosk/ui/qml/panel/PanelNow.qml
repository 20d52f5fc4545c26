// What is going on now, large, and the day in numbers beside it.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: now

    required property PanelScreen panel
    // Where the second column of what stands below begins; the numbers begin there too, if they have room.
    required property real split
    // Where the line between two parts stands there: that before the numbers is level with it then.
    property real rule: 0
    readonly property var tiles: panel.today.tiles
    readonly property var stage: tiles.find(each => each.name === "stage")
    required property real size
    // How large the stage is written, and the numbers beside it.
    required property real figure
    readonly property real number: Theme.dense * (Theme.upright ? 1.8 : 2.1)
    readonly property real inset: Math.round(1.1 * Theme.gap)
    // What lies between the stage and the numbers below it.
    readonly property real apart: 0.7 * Theme.gap
    readonly property real room: width - 2 * inset
    // What each needs for one line of everything; the last line can be two.
    readonly property string session: panel.choices.underWay ? panel.choices.session : ""
    readonly property var needs: numbers.shown.map(tile => need(tile, size))
    readonly property var leasts: numbers.shown.map(tile => least(tile, number, size))
    readonly property real steps: Math.max(0, numbers.shown.length - 1) * numbers.spacing
    readonly property real first: before(size, figure)
    readonly property bool wide: besides(size, figure)
    // Where the numbers begin: beside what is going on, or below it.
    readonly property real from: wide ? Math.max(first, Math.min(split, room - sum(needs) - steps)) : 0
    readonly property var widths: {
        const spare = room - from - steps - sum(needs)
        const wishes = needs.map((need, at) => need - leasts[at])
        return needs.map((need, at) => Math.floor(spare >= 0 ? need + spare / needs.length : need + spare * wishes[at] / Math.max(1, sum(wishes))))
    }

    function sum(all: var): real {
        return all.reduce((total, each) => total + each, 0)
    }
    // Letters are drawn in whole pixels.
    function told(text: var, size: real): real {
        return Math.ceil(plain.advanceWidth(text ?? "") * Math.round(size) / 100) + 2 * Theme.unit
    }
    function valueOf(tile: var, figure: real): real {
        return Math.ceil(bold.advanceWidth(tile?.value ?? "") * Math.round(figure) / 100) + 2 * Theme.unit
    }
    function least(tile: var, figure: real, size: real): real {
        return Math.max(valueOf(tile, figure), told(tile?.title, size))
    }
    function need(tile: var, size: real): real {
        return Math.max(least(tile, number, size), told(tile.line, size))
    }
    // What the stage takes of a line beside the numbers.
    function before(size: real, figure: real): real {
        const line = told(stage?.line, size)
        return Math.max(least(stage, figure, size), session === "" ? line : Math.max(told(session, 1.22 * size), valueOf(stage, figure) + 0.7 * size + line)) + 1.2 * Theme.gap
    }
    function besides(size: real, figure: real): bool {
        const free = room - before(size, figure) - steps
        return sum(numbers.shown.map(tile => least(tile, number, size))) <= free && (!Theme.upright || sum(numbers.shown.map(tile => need(tile, size))) <= free)
    }
    // Whether nothing wraps if it is written so large, and how high it is then.
    function holds(size: real, figure: real): bool {
        return sum(numbers.shown.map(tile => need(tile, size))) + steps <= room - (besides(size, figure) ? before(size, figure) : 0)
    }
    function deep(size: real, figure: real): real {
        const lines = number => Math.ceil(plain.height * size / 100) * 2 + Math.ceil(plain.height * number / 100)
        return 1.3 * Theme.gap + lines(figure) + (session === "" ? 0 : Math.ceil(0.22 * plain.height * size / 100)) + (besides(size, figure) ? 0 : apart + lines(number))
    }
    FontMetrics {
        id: plain
        font.pixelSize: 100
    }
    FontMetrics {
        id: bold
        font { pixelSize: 100; bold: true }
    }

    height: numbers.y + numbers.height + 0.7 * Theme.gap
    radius: Theme.radius
    color: Theme.stated
    border { color: Theme.highContrast ? Theme.edge : "transparent"; width: 2 * Theme.unit }

    PanelTile {
        id: state
        objectName: "today-stage"
        x: now.inset
        y: 0.6 * Theme.gap
        width: now.wide ? now.from - 0.8 * Theme.gap : now.room
        height: implicitHeight
        size: now.figure
        lettering: now.size
        title: now.stage?.title ?? ""
        value: now.stage?.value ?? ""
        first: now.session
        line: now.stage?.line ?? ""
    }
    Rectangle {
        x: !now.wide ? now.inset : now.rule > 0 && now.from === now.split ? now.rule : now.inset + now.from - 0.7 * Theme.gap
        y: now.wide ? 0.8 * Theme.gap : state.y + state.height + 0.3 * Theme.gap
        width: now.wide ? 2 * Theme.unit : now.room
        height: now.wide ? now.height - 1.6 * Theme.gap : 2 * Theme.unit
        color: Theme.shy
    }
    Row {
        id: numbers
        // Without a target, and before the first game, there is nothing to tell of it.
        readonly property var shown: now.tiles.filter(each => each.name !== "stage" && each.value !== "-")
        x: now.inset + now.from
        y: now.wide ? state.y : state.y + state.height + now.apart
        height: Math.max(childrenRect.height, now.wide ? state.height : 0)
        spacing: Theme.gap
        Repeater {
            model: numbers.shown
            delegate: PanelTile {
                required property var modelData
                required property int index
                objectName: "today-" + modelData.name
                width: now.widths[index] ?? 0
                height: implicitHeight
                size: now.number
                // Its line is level with that of the stage.
                crown: now.wide ? now.figure : 0
                lettering: now.size
                title: modelData.title
                value: modelData.value
                line: modelData.line
            }
        }
    }
}
