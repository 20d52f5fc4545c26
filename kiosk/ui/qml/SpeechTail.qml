// The tail of a bubble: it points down, at the face of the one who speaks.
import QtQuick
import QtQuick.Shapes
import "."

Shape {
    width: 60 * Theme.unit
    height: 38 * Theme.unit
    ShapePath {
        fillColor: Theme.white
        strokeColor: Theme.sea
        strokeWidth: 4 * Theme.unit
        joinStyle: ShapePath.RoundJoin
        capStyle: ShapePath.FlatCap
        startX: 4 * Theme.unit; startY: 3 * Theme.unit
        PathLine { x: 30 * Theme.unit; y: 34 * Theme.unit }
        PathLine { x: 56 * Theme.unit; y: 3 * Theme.unit }
    }
}
