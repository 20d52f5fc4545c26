// A finger that touches: drawn on a square of 24, and scaled by what shows it.
import QtQuick
import QtQuick.Shapes
import ".."

ClippedShape {
    id: sign

    property real size: 24
    readonly property real part: size / 24

    width: size
    height: size
    ShapePath {
        strokeColor: Theme.sea
        strokeWidth: 1.7 * sign.part
        capStyle: ShapePath.RoundCap
        joinStyle: ShapePath.RoundJoin
        fillColor: "transparent"
        scale: Qt.size(sign.part, sign.part)
        // A hand with its first finger up, and a ring around the tip.
        PathSvg { path: "M8.7 15 V6.2 A1.8 1.8 0 0 1 12.3 6.2 V11.6 L17 12.5 A2.4 2.4 0 0 1 18.9 15.2 L18.2 19 A3 3 0 0 1 15.2 21.6 H11.6 A3 3 0 0 1 9.2 20.4 L5.8 16.2 A1.7 1.7 0 0 1 8.7 14.4 M6.5 8 A4.4 4.4 0 1 1 14.5 8" }
    }
}
