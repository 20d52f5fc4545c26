// The tail of a bubble: it points down, at the face of the one who speaks.
import QtQuick
import QtQuick.Shapes
import "."

Shape {
    id: tail

    width: 60 * Theme.unit
    height: 38 * Theme.unit
    // Without the bubble's line between its ends, which begins 1 unit below its top, on whole pixels.
    ShapePath {
        fillColor: Theme.white
        strokeColor: "transparent"
        startX: 4 * Theme.unit; startY: Theme.unit - 2
        PathLine { x: 4 * Theme.unit; y: 3 * Theme.unit }
        PathLine { x: tail.width / 2; y: tail.height - 4 * Theme.unit }
        PathLine { x: tail.width - 4 * Theme.unit; y: 3 * Theme.unit }
        PathLine { x: tail.width - 4 * Theme.unit; y: Theme.unit - 2 }
    }
    ShapePath {
        fillColor: "transparent"
        strokeColor: Theme.sea
        strokeWidth: 4 * Theme.unit
        joinStyle: ShapePath.RoundJoin
        capStyle: ShapePath.RoundCap
        startX: 4 * Theme.unit; startY: 3 * Theme.unit
        PathLine { x: tail.width / 2; y: tail.height - 4 * Theme.unit }
        PathLine { x: tail.width - 4 * Theme.unit; y: 3 * Theme.unit }
    }
}
