// Whether something is well, told by shape and colour: a disc, or a triangle with its word beside it.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes
import ".."

Item {
    id: mark

    required property bool well
    property real size: Theme.dense
    property color tone: well ? Theme.sea : Theme.deepAmber
    // As high as a capital, and level with those of the words beside it: drawn, for a letter may come from another font.
    readonly property real side: Math.round(0.74 * size)
    readonly property real above: Math.round(letters.ascent - 0.36 * size - side / 2)

    width: size
    height: letters.height
    Accessible.ignored: true

    FontMetrics {
        id: letters
        font.pixelSize: mark.size
    }
    Rectangle {
        visible: mark.well
        y: mark.above
        width: mark.side
        height: mark.side
        radius: mark.side / 2
        color: mark.tone
    }
    Shape {
        visible: !mark.well
        y: mark.above
        width: mark.side
        height: mark.side
        ShapePath {
            fillColor: mark.tone
            strokeWidth: -1
            PathPolyline { path: [Qt.point(0, mark.side), Qt.point(mark.side / 2, 0), Qt.point(mark.side, mark.side)] }
        }
    }
}
