// A drawing of lines on a square of 24, scaled by what shows it.
import QtQuick
import QtQuick.Shapes

Shape {
    id: drawing

    required property string path
    required property color ink
    property real thick: 2

    width: 24
    height: 24
    ShapePath {
        strokeColor: drawing.ink
        strokeWidth: drawing.thick
        capStyle: ShapePath.RoundCap
        joinStyle: ShapePath.RoundJoin
        fillColor: "transparent"
        PathSvg { path: drawing.path }
    }
}
