// The day in numbers, side by side.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import ".."

Row {
    id: day

    required property PanelScreen panel
    required property real size
    // How much of that its words have: less below an alarm, which needs the room.
    readonly property real share: panel.alarms.length > 0 ? 0.9 : 1
    // Without a target, and before the first game, there is nothing to tell of it.
    readonly property var shown: panel.today.tiles.filter(each => each.name !== "stage" && each.value !== "-")
    readonly property real figure: (Theme.textSize > 1.15 || share < 1 ? 2 : 2.3) * Theme.dense
    // How many columns there are below them, where they stand in line with these.
    property int columns: 0
    // Each has what it needs, and all of them the same of what is left.
    readonly property var widths: widthsOf(size, width)

    // At least a number and its title have one line; a long line below them has two.
    function least(tile: var, size: real): real {
        return Math.ceil(1.02 * Math.max(wordWidths.bold(tile.value, figure), wordWidths.plain(tile.title, share * size)) + 4 * Theme.unit)
    }
    function widthsOf(size: real, width: real): var {
        const wishes = shown.map(tile => Math.max(least(tile, size), Math.ceil(1.02 * Math.min(12 * size, wordWidths.plain(tile.line, share * size)) + 4 * Theme.unit)))
        const wished = wishes.reduce((sum, each) => sum + each, 0), spare = width - (shown.length - 1) * spacing - wished
        const abreast = Math.max(columns, shown.length), even = (width - (abreast - 1) * spacing) / abreast
        if (wishes.every((each, at) => (columns > 0 ? least(shown[at], size) : each) <= even))
            return wishes.map((each, at) => Math.floor(at < wishes.length - 1 ? even : even + (abreast - wishes.length) * (even + spacing)))
        const most = wished - shown.reduce((sum, tile) => sum + least(tile, size), 0)
        return wishes.map((each, at) => Math.floor(each + (spare >= 0 ? spare / wishes.length : spare * (each - least(shown[at], size)) / Math.max(1, most))))
    }
    // How high it is in so much width, if its words are written so large.
    function deep(size: real, width: real): real {
        const line = each => Math.ceil(1.37 * each), widths = widthsOf(size, width)
        return shown.length === 0 ? 0 : Math.ceil(line(figure) + Math.max(...shown.map((tile, at) => wordWidths.plainLines(tile.title, share * size, widths[at]) * line(share * size)
            + (tile.line === "" ? 0 : wordWidths.plainLines(tile.line, share * size, widths[at]) * line(share * size)))))
    }
    WordWidths {
        id: wordWidths
    }

    spacing: Math.round(1.6 * Theme.gap)
    visible: shown.length > 0

    Repeater {
        model: day.shown
        delegate: PanelTile {
            required property var modelData
            required property int index
            objectName: "today-" + modelData.name
            width: day.widths[index] ?? 0
            size: day.figure
            lettering: day.share * day.size
            lower: day.share * day.size
            title: modelData.title
            value: modelData.value
            line: modelData.line
        }
    }
}
