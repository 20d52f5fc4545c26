// The mark of a hint. Card, row and column differ in shape, not only in place: a frame with an arrow at both of its
// numbers, a band with an arrow from the left, a band with an arrow from above.
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
    readonly property real breadth: 44 * Theme.unit
    property real apart: 5 * Theme.unit

    // Not named onRow and so on: QML would take such a name for a signal's handler.
    readonly property bool marksRow: row >= 0 && column < 0
    readonly property bool marksColumn: column >= 0 && row < 0
    readonly property bool marksCard: row >= 0 && column >= 0

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

    Rectangle {
        visible: mark.marksRow
        y: mark.row * mark.cell
        width: parent.width
        height: mark.cell
        radius: Theme.radius
        color: Theme.amber
        border { color: Theme.deepAmber; width: 4 * Theme.unit }
    }
    Rectangle {
        visible: mark.marksColumn
        x: mark.column * mark.cell
        width: mark.cell
        height: parent.height
        radius: Theme.radius
        color: Theme.amber
        border { color: Theme.deepAmber; width: 4 * Theme.unit }
    }
    Rectangle {
        visible: mark.marksCard
        x: mark.column * mark.cell
        y: mark.row * mark.cell
        width: mark.cell
        height: mark.cell
        radius: Theme.radius * 1.4
        color: Theme.amber
        border { color: Theme.deepAmber; width: 4 * Theme.unit }
    }
    // Between a number and the cards.
    Arrow {
        visible: mark.row >= 0
        x: -width - mark.apart
        y: (mark.row + 0.5) * mark.cell - height / 2
    }
    Arrow {
        visible: mark.column >= 0
        // There is more room below a number than beside it.
        length: Math.max(mark.arrow, 26 * Theme.unit)
        x: (mark.column + 0.5) * mark.cell - width / 2
        y: -(height + width) / 2 - mark.apart
        rotation: 90
    }
}
