// The pairs that were found, in their order: places that fill up, so that one sees how far the game is.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Item {
    id: tray

    required property int places
    required property list<string> pictures
    required property int lines
    // Whether the places take all of its width.
    property bool spreads: false
    // Whether there is room for the two cards of a pair beside each other.
    readonly property bool paired: grid.paired
    // How many of the pictures have arrived.
    required property int landed
    required property url back
    required property url shadow

    // Whether it is about to get another size: then its places are laid out when it has that.
    property bool resizes: false
    readonly property var fitting: laidOut(places, width, height, lines, spreads)
    property var grid: fitting
    onFittingChanged: if (!resizes) grid = fitting
    onResizesChanged: if (!resizes) grid = fitting
    function laidOut(places: int, width: real, height: real, lines: int, spreads: bool): var {
        const columns = Math.ceil(places / Math.max(1, lines))
        // Some of the shelf is seen around the places.
        const rim = spreads ? 0 : 0.1
        const slot = Math.floor(Math.min(width / (Math.max(1, columns) + 2 * rim), height / Math.max(1, lines)))
        const pitch = spreads ? width / Math.max(1, columns) : slot
        return { width, height, lines, columns, rim, slot, pitch, paired: spreads && pitch > 1.3 * slot }
    }
    readonly property real slot: grid.slot

    // A whole number, as the board loads them beforehand.
    readonly property int card: Math.round(grid.slot * (grid.paired ? 0.8 : 0.76))
    // How far one card of a pair lies from the middle of its place, where they lie on each other.
    readonly property real behind: Math.max(1, Math.round(0.03 * grid.slot))

    // Where the picture with this number lies, in the tray.
    function middle(number: int): point {
        const { width, height, columns, lines, pitch, slot } = grid
        return Qt.point((width - pitch * columns) / 2 + (number % columns + 0.5) * pitch,
                        (height - slot * lines) / 2 + (Math.floor(number / columns) + 0.5) * slot)
    }

    // One shelf, in which the places are no more than hinted at until something lies there.
    Rectangle {
        anchors.centerIn: parent
        visible: tray.places > 0
        width: tray.spreads ? tray.width : (tray.grid.columns + 2 * tray.grid.rim) * tray.slot
        height: Math.min(tray.slot * tray.grid.lines + 0.2 * tray.slot, tray.height + (tray.spreads ? 12 : 0) * Theme.unit)
        radius: 0.24 * tray.slot
        color: Theme.shelf
        border { color: Theme.edge; width: Theme.highContrast ? 2 * Theme.unit : 0 }
    }
    Repeater {
        model: tray.places
        Item {
            id: place
            required property int index
            readonly property bool filled: index < tray.landed
            readonly property point centre: tray.middle(index)
            x: centre.x - width / 2
            y: centre.y - tray.slot / 2
            width: tray.paired ? Math.min(tray.grid.pitch - 14 * Theme.unit, 2.1 * tray.slot) : tray.slot
            height: tray.slot
            // How far the two cards of a pair lie from its middle, where they lie side by side.
            readonly property real aside: Math.max(0.05 * tray.slot, Math.min(0.5 * tray.card + 0.03 * tray.slot, (width - tray.card) / 2 - 0.09 * tray.slot))

            // What is empty is lighter than the shelf. Where the two cards of a pair lie side by side, their place is one
            // shape: two outlines in each would make the shelf look like a second board.
            Rectangle {
                visible: place.filled || tray.paired
                anchors { fill: parent; margins: parent.height * 0.07 }
                radius: height * 0.18
                color: place.filled ? Theme.leaf : Theme.paper
                border { color: Theme.highContrast ? Theme.slot : Theme.edge; width: place.filled ? 0 : Math.max(1, 3 * Theme.unit) }
            }
            // The two cards are hinted at in it: an empty box would look like a field to be filled in.
            Repeater {
                model: !place.filled && tray.paired ? 2 : 0
                Rectangle {
                    required property int index
                    anchors { centerIn: parent; horizontalCenterOffset: (index === 0 ? -1 : 1) * place.aside }
                    width: 0.9 * tray.card
                    height: width
                    radius: 0.11 * tray.card
                    color: Theme.shelf
                    border { color: Theme.edge; width: Theme.highContrast ? Math.max(1, Theme.unit) : 0 }
                }
            }
            // Elsewhere the shapes of the two cards, so far apart that both are seen.
            Repeater {
                model: place.filled || tray.paired ? 0 : 2
                Rectangle {
                    required property int index
                    anchors {
                        centerIn: parent
                        horizontalCenterOffset: (index === 0 ? -1 : 1) * 2.4 * tray.behind
                        verticalCenterOffset: (index === 0 ? -1 : 1) * 2.4 * tray.behind
                    }
                    width: 0.82 * tray.card
                    height: width
                    radius: 0.11 * tray.card
                    color: Theme.paper
                    border { color: Theme.slot; width: Math.max(1, 3 * Theme.unit) }
                }
            }
            // Two cards side by side; or one on the other, of which only the edge is seen.
            Rectangle {
                visible: place.filled && !tray.paired
                anchors { centerIn: parent; horizontalCenterOffset: -tray.behind; verticalCenterOffset: -tray.behind }
                width: 0.95 * tray.card
                height: width
                radius: 0.11 * tray.card
                color: Theme.white
                border { color: Theme.slot; width: Math.max(1, Theme.unit) }
            }
            Repeater {
                model: !place.filled ? 0 : tray.paired ? 2 : 1
                Image {
                    required property int index
                    readonly property int side: index === 0 ? -1 : 1
                    anchors {
                        centerIn: parent
                        horizontalCenterOffset: !tray.paired ? tray.behind : side * place.aside
                        verticalCenterOffset: tray.paired ? 0 : tray.behind
                    }
                    width: tray.card
                    height: width
                    source: Qt.resolvedUrl(tray.pictures[place.index] ?? "")
                    sourceSize: Qt.size(width, height)
                }
            }
            scale: 1
            onFilledChanged: if (filled && Theme.motion > 0) arrive.restart()
            SequentialAnimation {
                id: arrive
                NumberAnimation { target: place; property: "scale"; to: 1.25; duration: Theme.motion / 2; easing.type: Easing.OutQuad }
                NumberAnimation { target: place; property: "scale"; to: 1; duration: Theme.motion; easing.type: Easing.OutBack }
            }
        }
    }
}
