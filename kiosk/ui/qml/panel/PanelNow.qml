// What is going on now, large, and the day in numbers beside it.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Rectangle {
    id: now

    required property PanelScreen panel
    required property bool wide
    // Where the second of the cards below begins, so that the numbers stand above what it says.
    required property real split
    readonly property var tiles: panel.today.tiles
    readonly property var stage: tiles.find(each => each.name === "stage")
    required property real size
    readonly property real figure: Theme.dense * (Theme.upright ? 1.8 : 2.1)
    readonly property real inset: Math.round(1.1 * Theme.gap)
    readonly property real room: width - 2 * inset
    // Where the numbers begin: beside what is going on, or below it.
    readonly property real from: wide ? split : 0

    height: numbers.y + numbers.height + 0.7 * Theme.gap
    radius: Theme.radius
    color: Theme.white
    border { color: Theme.edge; width: 2 * Theme.unit }

    PanelTile {
        id: state
        objectName: "today-stage"
        x: now.inset
        y: 0.6 * Theme.gap
        width: now.wide ? now.from - now.inset - 0.5 * Theme.gap : now.room
        height: implicitHeight
        size: now.figure
        lettering: now.size
        title: now.stage?.title ?? ""
        value: now.stage?.value ?? ""
        first: now.panel.choices.underWay ? now.panel.choices.session : ""
        line: now.stage?.line ?? ""
    }
    Rectangle {
        x: now.wide ? now.from + (Theme.upright ? 0.1 : -0.4) * Theme.gap : now.inset
        y: now.wide ? 0.8 * Theme.gap : state.y + state.height + 0.5 * Theme.gap
        width: now.wide ? 2 * Theme.unit : now.room
        height: now.wide ? now.height - 1.6 * Theme.gap : 2 * Theme.unit
        color: Theme.edge
    }
    Row {
        id: numbers
        // Without a target, and before the first game, there is nothing to tell of it.
        readonly property var shown: now.tiles.filter(each => each.name !== "stage" && each.value !== "-")
        readonly property real each: (now.room - now.from - Math.max(0, shown.length - 1) * spacing) / Math.max(1, shown.length)
        x: now.inset + now.from
        y: now.wide ? state.y : state.y + state.height + now.inset
        height: Math.max(childrenRect.height, now.wide ? state.height : 0)
        spacing: Theme.gap
        Repeater {
            model: numbers.shown
            delegate: PanelTile {
                required property var modelData
                objectName: "today-" + modelData.name
                width: numbers.each
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
