// The mark of a hint. Card, row and column differ in shape, not only in place: a frame, a band from the left, a band from
// above. A band begins at its number; where there are no numbers, an arrow points along it.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes
import "."

Item {
    id: mark

    required property int row
    required property int column
    required property real cell
    // How far it reaches out of its cells.
    property real over: 0
    // How far the number of a column lies above the cards, and that of a row beside them; 0 where there is none.
    property real above: 0
    property real before: 0

    // Not named onRow and so on: QML would take such a name for a signal's handler.
    readonly property bool marksRow: row >= 0 && column < 0
    readonly property bool marksColumn: column >= 0 && row < 0

    component Frame: Rectangle {
        color: Theme.amber
        border { color: Theme.deepAmber; width: 4 * Theme.unit }
    }
    component Arrow: Shape {
        id: pointer
        readonly property real breadth: 44 * Theme.unit
        width: 26 * Theme.unit
        height: breadth
        ShapePath {
            fillColor: Theme.amber
            strokeColor: Theme.deepAmber
            strokeWidth: 3 * Theme.unit
            joinStyle: ShapePath.RoundJoin
            startX: 2 * Theme.unit; startY: 2 * Theme.unit
            PathLine { x: pointer.width - 2 * Theme.unit; y: pointer.breadth / 2 }
            PathLine { x: 2 * Theme.unit; y: pointer.breadth - 2 * Theme.unit }
            PathLine { x: 2 * Theme.unit; y: 2 * Theme.unit }
        }
    }

    Frame {
        readonly property real before: mark.marksRow ? Math.max(mark.before, mark.over) : mark.over
        readonly property real above: mark.marksColumn ? Math.max(mark.above, mark.over) : mark.over
        visible: mark.row >= 0 || mark.column >= 0
        x: Math.max(0, mark.column) * mark.cell - before
        y: Math.max(0, mark.row) * mark.cell - above
        width: (mark.marksRow ? mark.width : mark.cell) + before + mark.over
        height: (mark.marksColumn ? mark.height : mark.cell) + above + mark.over
        radius: Theme.radius * (mark.marksRow || mark.marksColumn ? 1 : 1.4)
    }
    Arrow {
        visible: mark.marksRow && mark.before === 0
        x: -width - 5 * Theme.unit
        y: (mark.row + 0.5) * mark.cell - height / 2
    }
    Arrow {
        visible: mark.marksColumn && mark.above === 0
        x: (mark.column + 0.5) * mark.cell - width / 2
        y: -(height + width) / 2 - 5 * Theme.unit
        rotation: 90
    }
}
