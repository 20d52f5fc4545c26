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
    readonly property var tiles: panel.today.tiles
    readonly property var stage: tiles.find(each => each.name === "stage")
    required property real size
    readonly property real figure: Theme.dense * (Theme.upright ? 1.8 : 2.1)
    readonly property real inset: Math.round(1.1 * Theme.gap)
    readonly property real room: width - 2 * inset
    // What each needs for one line of everything; the last line can be two.
    readonly property string session: panel.choices.underWay ? panel.choices.session : ""
    readonly property real stateNeed: Math.max(least(stage, plain.font), session === "" ? told(stage?.line, plain.font) : Math.max(1.22 * told(session, plain.font), valueOf(stage, bold.font) + 0.7 * size + told(stage?.line, plain.font)))
    readonly property var needs: numbers.shown.map(tile => Math.max(least(tile, plain.font), told(tile.line, plain.font)))
    readonly property var leasts: numbers.shown.map(tile => least(tile, plain.font))
    readonly property real steps: Math.max(0, needs.length - 1) * numbers.spacing
    readonly property real first: stateNeed + 1.2 * Theme.gap
    readonly property bool wide: first + sum(leasts) + steps <= room && (!Theme.upright || first + sum(needs) + steps <= room)
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
    // What is measured depends on the font, which is named for that reason alone.
    function told(text: var, _font: font): real {
        return Math.ceil(plain.advanceWidth(text ?? "")) + 2 * Theme.unit
    }
    function valueOf(tile: var, _font: font): real {
        return Math.ceil(bold.advanceWidth(tile?.value ?? "")) + 2 * Theme.unit
    }
    function least(tile: var, font: font): real {
        return Math.max(valueOf(tile, bold.font), told(tile?.title, font))
    }
    FontMetrics {
        id: plain
        font.pixelSize: now.size
    }
    FontMetrics {
        id: bold
        font { pixelSize: now.figure; bold: true }
    }

    height: numbers.y + numbers.height + 0.7 * Theme.gap
    radius: Theme.radius
    color: Theme.white
    border { color: Theme.edge; width: 2 * Theme.unit }

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
        x: now.wide ? now.inset + now.from - 0.7 * Theme.gap : now.inset
        y: now.wide ? 0.8 * Theme.gap : state.y + state.height + 0.5 * Theme.gap
        width: now.wide ? 2 * Theme.unit : now.room
        height: now.wide ? now.height - 1.6 * Theme.gap : 2 * Theme.unit
        color: Theme.edge
    }
    Row {
        id: numbers
        // Without a target, and before the first game, there is nothing to tell of it.
        readonly property var shown: now.tiles.filter(each => each.name !== "stage" && each.value !== "-")
        x: now.inset + now.from
        y: now.wide ? state.y : state.y + state.height + now.inset
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
                size: now.figure
                lettering: now.size
                title: modelData.title
                value: modelData.value
                line: modelData.line
            }
        }
    }
}
