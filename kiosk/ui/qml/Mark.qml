// The mark of a hint. Card, row and column differ in shape, not only in place: a frame with corners, a band with an
// arrow from the left, a band with an arrow from above.
import QtQuick
import QtQuick.Shapes
import "."

Item {
    id: mark

    required property int row
    required property int column
    required property real cell

    // Not named onRow and so on: QML would take such a name for a signal's handler.
    readonly property bool marksRow: row >= 0 && column < 0
    readonly property bool marksColumn: column >= 0 && row < 0
    readonly property bool marksCard: row >= 0 && column >= 0

    component Arrow: Shape {
        width: 24 * Theme.unit
        height: 34 * Theme.unit
        ShapePath {
            fillColor: Theme.amber
            strokeColor: Theme.deepAmber
            strokeWidth: 3 * Theme.unit
            joinStyle: ShapePath.RoundJoin
            startX: 2 * Theme.unit; startY: 2 * Theme.unit
            PathLine { x: 22 * Theme.unit; y: 17 * Theme.unit }
            PathLine { x: 2 * Theme.unit; y: 32 * Theme.unit }
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
        Arrow { x: -width - 5 * Theme.unit; anchors.verticalCenter: parent.verticalCenter }
    }
    Rectangle {
        visible: mark.marksColumn
        x: mark.column * mark.cell
        width: mark.cell
        height: parent.height
        radius: Theme.radius
        color: Theme.amber
        border { color: Theme.deepAmber; width: 4 * Theme.unit }
        Arrow { y: 2 * Theme.unit - height; anchors.horizontalCenter: parent.horizontalCenter; rotation: 90 }
    }
    Rectangle {
        visible: mark.marksCard
        x: mark.column * mark.cell
        y: mark.row * mark.cell
        width: mark.cell
        height: mark.cell
        radius: Theme.radius * 1.4
        color: Theme.amber
        border { color: Theme.deepAmber; width: 6 * Theme.unit }
    }
}
