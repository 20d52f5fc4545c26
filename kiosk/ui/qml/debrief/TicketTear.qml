// Where the stub of a ticket would be torn off: a line of dashes across it or down, with a notch in the edge at both ends.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: tear

    // The edge of the ticket.
    required property color edge
    required property real edgeWidth
    property bool down: false
    readonly property real length: down ? height : width
    readonly property real reach: 20 * Theme.unit
    readonly property real step: 20 * Theme.unit
    readonly property int dashes: Math.max(0, Math.floor((length - 3 * reach) / step))
    readonly property real start: (length - dashes * step + 9 * Theme.unit) / 2

    Repeater {
        model: tear.dashes
        Rectangle {
            required property int index
            readonly property real along: tear.start + index * tear.step
            x: tear.down ? -width / 2 : along
            y: tear.down ? along : -height / 2
            width: (tear.down ? 4 : 11) * Theme.unit
            height: (tear.down ? 11 : 4) * Theme.unit
            radius: Math.min(width, height) / 2
            color: Theme.edge
        }
    }
    Repeater {
        model: 2
        Item {
            id: notch
            required property int index
            // A little further out than the edge, whose line would be seen there at a fraction of a pixel.
            readonly property real along: index === 0 ? -Theme.unit : tear.length - tear.reach
            readonly property real before: index === 0 ? Theme.unit - tear.reach : 0
            x: tear.down ? -tear.reach : along
            y: tear.down ? along : -tear.reach
            width: tear.down ? 2 * tear.reach : tear.reach + Theme.unit
            height: tear.down ? tear.reach + Theme.unit : 2 * tear.reach
            clip: true
            Rectangle {
                x: tear.down ? 0 : notch.before
                y: tear.down ? notch.before : 0
                width: 2 * tear.reach
                height: width
                radius: tear.reach
                color: Theme.paper
                border { color: tear.edge; width: tear.edgeWidth }
            }
        }
    }
}
