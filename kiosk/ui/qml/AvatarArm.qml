// One arm, from the shoulder to a hand that can point. Law: it only reaches where it is sent; at rest it is out of sight.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes

Shape {
    id: arm

    required property int side      // -1 left arm, 1 right arm (seen by the visitor)
    required property point shoulder
    required property point hand
    required property real pointing // 0 an open hand .. 1 one finger
    required property point goal    // what the finger points at

    // Two bones of fixed length; where they meet follows from the triangle, and elbows bend outwards.
    readonly property real upper: 64
    readonly property real lower: 92
    readonly property real dx: hand.x - shoulder.x
    readonly property real dy: hand.y - shoulder.y
    readonly property real far: Math.max(upper * 0.5, Math.min(upper + lower - 1, Math.hypot(dx, dy)))
    readonly property real bend: Math.acos(Math.max(-1, Math.min(1, (upper * upper + far * far - lower * lower) / (2 * upper * far))))
    readonly property real course: Math.atan2(dy, dx) - side * -bend
    readonly property point elbow: Qt.point(shoulder.x + Math.cos(course) * upper, shoulder.y + Math.sin(course) * upper)
    readonly property point wrist: Qt.point(shoulder.x + dx / Math.max(1, Math.hypot(dx, dy)) * far, shoulder.y + dy / Math.max(1, Math.hypot(dx, dy)) * far)
    readonly property real along: Math.atan2(wrist.y - elbow.y, wrist.x - elbow.x)
    readonly property real astray: Math.atan2(goal.y - wrist.y, goal.x - wrist.x) - along
    // By the shorter way round.
    readonly property real aim: along + pointing * Math.atan2(Math.sin(astray), Math.cos(astray))
    readonly property string sleeve: `M ${shoulder.x} ${shoulder.y} Q ${elbow.x} ${elbow.y} ${wrist.x} ${wrist.y}`
    readonly property point cuff: Qt.point(wrist.x - Math.cos(aim) * 13, wrist.y - Math.sin(aim) * 13)
    // The middle finger stays out when the others fold.
    readonly property string fingers: finger(0, 27 + 15 * pointing) + finger(-0.55, 25 - 14 * pointing)
                                      + finger(0.55, 25 - 14 * pointing) + finger(side * -1.35, 21 - 5 * pointing)

    function finger(turn: real, length: real): string {
        return `M ${wrist.x} ${wrist.y} L ${wrist.x + Math.cos(aim + turn) * length} ${wrist.y + Math.sin(aim + turn) * length} `
    }

    component Bone: ShapePath {
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        joinStyle: ShapePath.RoundJoin
    }

    antialiasing: true

    Bone { strokeWidth: 46; strokeColor: "#1F5F6B"; PathSvg { path: arm.sleeve } }
    Bone { strokeWidth: 36; strokeColor: "#2E7784"; PathSvg { path: arm.sleeve } }
    Bone { strokeWidth: 23; strokeColor: "#1F5F6B"; PathSvg { path: arm.fingers } }
    ShapePath {
        strokeWidth: 5
        strokeColor: "#1F5F6B"
        fillColor: "#FFF6E4"
        PathAngleArc { centerX: arm.wrist.x; centerY: arm.wrist.y; radiusX: 19; radiusY: 19; sweepAngle: 360 }
    }
    Bone { strokeWidth: 14; strokeColor: "#FFF6E4"; PathSvg { path: arm.fingers } }
    Bone { // the cuff, across the end of the sleeve
        strokeWidth: 12
        strokeColor: "#F2A33A"
        PathSvg {
            path: `M ${arm.cuff.x - Math.sin(arm.aim) * 17} ${arm.cuff.y + Math.cos(arm.aim) * 17}`
                  + ` L ${arm.cuff.x + Math.sin(arm.aim) * 17} ${arm.cuff.y - Math.cos(arm.aim) * 17}`
        }
    }
}
