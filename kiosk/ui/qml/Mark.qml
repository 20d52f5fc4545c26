// The mark of a hint. Card, row and column differ in shape, not only in place: a frame with an arrow at both of its
// numbers, a band with an arrow from the left, a band with an arrow from above. A band leaves out the card that waits for
// its second, which no hint means.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes
import "."

Item {
    id: mark

    required property int row
    required property int column
    required property real cell
    // How long an arrow is, and how far its point stays from the cards' places.
    property real arrow: 24 * Theme.unit
    // How far it reaches out of its cells.
    property real over: 0
    // The number of the card that is left out; -1 for none.
    property int without: -1
    readonly property real breadth: 44 * Theme.unit
    property real apart: 5 * Theme.unit

    // Not named onRow and so on: QML would take such a name for a signal's handler.
    readonly property bool marksRow: row >= 0 && column < 0
    readonly property bool marksColumn: column >= 0 && row < 0
    readonly property bool marksCard: row >= 0 && column >= 0

    // The first and the last cell of each part of a band.
    readonly property var parts: {
        const all = Math.round((marksRow ? width : height) / Math.max(1, cell))
        const columns = Math.round(width / Math.max(1, cell))
        const [line, place] = marksRow ? [Math.floor(without / columns), without % columns] : [without % columns, Math.floor(without / columns)]
        if (!marksRow && !marksColumn)
            return []
        if (without < 0 || line !== (marksRow ? row : column))
            return [[0, all - 1]]
        return [[0, place - 1], [place + 1, all - 1]].filter(([first, last]) => first <= last)
    }

    component Frame: Rectangle {
        radius: Theme.radius
        color: Theme.amber
        border { color: Theme.deepAmber; width: 4 * Theme.unit }
    }
    component Arrow: Shape {
        id: pointer
        property real length: mark.arrow
        width: length
        height: mark.breadth
        ShapePath {
            fillColor: Theme.amber
            strokeColor: Theme.deepAmber
            strokeWidth: 3 * Theme.unit
            joinStyle: ShapePath.RoundJoin
            startX: 2 * Theme.unit; startY: 2 * Theme.unit
            PathLine { x: pointer.length - 2 * Theme.unit; y: mark.breadth / 2 }
            PathLine { x: 2 * Theme.unit; y: mark.breadth - 2 * Theme.unit }
            PathLine { x: 2 * Theme.unit; y: 2 * Theme.unit }
        }
    }

    Repeater {
        model: mark.parts
        Frame {
            id: band
            required property var modelData
            readonly property real long: (modelData[1] - modelData[0] + 1) * mark.cell
            x: (mark.marksRow ? modelData[0] : mark.column) * mark.cell - mark.over
            y: (mark.marksRow ? mark.row : modelData[0]) * mark.cell - mark.over
            width: (mark.marksRow ? long : mark.cell) + 2 * mark.over
            height: (mark.marksRow ? mark.cell : long) + 2 * mark.over
        }
    }
    Frame {
        visible: mark.marksCard
        x: mark.column * mark.cell - mark.over
        y: mark.row * mark.cell - mark.over
        width: mark.cell + 2 * mark.over
        height: width
        radius: Theme.radius * 1.4
    }
    // Between a number and the cards.
    Arrow {
        visible: mark.row >= 0
        x: -width - mark.over - mark.apart
        y: (mark.row + 0.5) * mark.cell - height / 2
    }
    Arrow {
        visible: mark.column >= 0
        // There is more room below a number than beside it.
        length: Math.max(mark.arrow, 26 * Theme.unit)
        x: (mark.column + 0.5) * mark.cell - width / 2
        y: -(height + width) / 2 - mark.over - mark.apart
        rotation: 90
    }
}
