// One eye. Law: the eye only shows what it is given (lids, gaze); it never moves by itself.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes

Shape {
    id: eye

    required property int side      // -1 left eye, 1 right eye (seen by the visitor)
    required property real upper    // how far the upper lid is up, 0 .. 1
    required property real lower    // how far the lower lid is down, 1 .. -1 (below 0 it bulges up: a smile)
    required property real slant    // upper lid: px the outer end hangs lower than the inner end
    required property real gazeX
    required property real gazeY
    required property real shut     // 0 open .. 1 blink

    readonly property real cx: 50
    readonly property real cy: 56
    readonly property real rx: 37
    readonly property real ry: 44
    readonly property real reach: 1 / Math.max(1, Math.hypot(gazeX, gazeY)) // the iris stays behind the lids
    readonly property real px: cx + gazeX * reach * 13
    readonly property real py: cy + 2 + gazeY * reach * 14
    // A blink brings the upper lid down onto the lower one, which itself only comes up a little.
    readonly property real low: lower * 40 + shut * (Math.min(lower * 40, 14) - lower * 40)
    readonly property real high: upper * 48 * (1 - shut) - low * shut
    readonly property string lidLine: curve(-high, slant * (1 - shut), 1)

    // Half an ellipse as one cubic between the two eye corners; dir 1 runs left to right, -1 back.
    function curve(y: real, lean: real, dir: int): string {
        const a = cy + 4 + (y - lean * eye.side * 0.7) * 4 / 3
        const b = cy + 4 + (y + lean * eye.side * 0.7) * 4 / 3
        const l = cx - rx, r = cx + rx
        return dir > 0 ? `C ${l} ${a} ${r} ${b} ${r} ${cy + 4}` : `C ${r} ${b} ${l} ${a} ${l} ${cy + 4}`
    }

    width: 100
    height: 112
    antialiasing: true

    ShapePath {
        strokeWidth: -1
        fillColor: "#FFFFFF"
        PathAngleArc { centerX: eye.cx; centerY: eye.cy; radiusX: eye.rx + 2; radiusY: eye.ry + 2; sweepAngle: 360 }
    }
    ShapePath {
        strokeWidth: 4
        strokeColor: "#1F5F6B"
        fillGradient: LinearGradient {
            x1: eye.px; x2: eye.px; y1: eye.py - 26; y2: eye.py + 26
            GradientStop { position: 0.1; color: "#1F5F6B" }
            GradientStop { position: 1; color: "#63ABBF" }
        }
        PathAngleArc { centerX: eye.px; centerY: eye.py; radiusX: 25; radiusY: 26; sweepAngle: 360 }
    }
    ShapePath {
        strokeWidth: -1
        fillColor: "#22313F"
        PathAngleArc { centerX: eye.px; centerY: eye.py; radiusX: 15.5; radiusY: 16.5; sweepAngle: 360 }
    }
    ShapePath { // both highlights come from the same lamp, so neither is mirrored
        strokeWidth: -1
        fillColor: "#FFFFFF"
        PathAngleArc { centerX: eye.px - 9; centerY: eye.py - 11; radiusX: 8; radiusY: 8; sweepAngle: 360 }
        PathAngleArc { centerX: eye.px + 10; centerY: eye.py + 11; radiusX: 4; radiusY: 4; sweepAngle: 360 }
    }
    ShapePath { // the lids: a skin with a hole, because the software renderer has no mask
        strokeWidth: -1
        fillRule: ShapePath.OddEvenFill
        fillGradient: LinearGradient {
            x1: 0; x2: 0; y1: eye.cy - eye.ry; y2: eye.cy + eye.ry
            GradientStop { position: 0; color: "#EAD9B5" }
            GradientStop { position: 0.5; color: "#F0E2C4" }
            GradientStop { position: 0.6; color: "#F7EDD8" }
        }
        PathAngleArc { centerX: eye.cx; centerY: eye.cy; radiusX: eye.rx + 5; radiusY: eye.ry + 5; sweepAngle: 360 }
        PathSvg { path: `M ${eye.cx - eye.rx} ${eye.cy + 4} ${eye.lidLine} ${eye.curve(eye.low, 0, -1)} Z` }
    }
    ShapePath {
        strokeWidth: 3
        strokeColor: "#C9B58B"
        fillColor: "transparent"
        PathSvg { path: `M ${eye.cx + eye.rx} ${eye.cy + 4} ${eye.curve(eye.low, 0, -1)}` }
    }
    ShapePath {
        strokeWidth: 5.5
        strokeColor: "#22313F"
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        PathSvg { path: `M ${eye.cx - eye.rx} ${eye.cy + 4} ${eye.lidLine}` }
    }
}
