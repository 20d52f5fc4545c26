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

    // It is below the edge of the avatar's body, and nothing of it is worked out.
    readonly property bool hangs: hand.y >= 480
    // Worked out at once: as properties that follow from each other, most of it would be worked out many times over.
    readonly property var pose: hangs ? { x: 0, y: 0, sleeve: "", fingers: "", cuff: "" } : posed(shoulder, hand, goal, pointing)

    // Where its hand is, and how its parts are drawn.
    function posed(shoulder: point, hand: point, goal: point, pointing: real): var {
        // Two bones of fixed length; where they meet follows from the triangle, and elbows bend outwards.
        const upper = 64, lower = 92
        const dx = hand.x - shoulder.x, dy = hand.y - shoulder.y, reach = Math.hypot(dx, dy)
        const far = Math.max(upper * 0.5, Math.min(upper + lower - 1, reach))
        const bend = Math.acos(Math.max(-1, Math.min(1, (upper * upper + far * far - lower * lower) / (2 * upper * far))))
        const course = Math.atan2(dy, dx) + side * bend
        const elbow = Qt.point(shoulder.x + Math.cos(course) * upper, shoulder.y + Math.sin(course) * upper)
        const wrist = Qt.point(shoulder.x + dx / Math.max(1, reach) * far, shoulder.y + dy / Math.max(1, reach) * far)
        const along = Math.atan2(wrist.y - elbow.y, wrist.x - elbow.x)
        const astray = Math.atan2(goal.y - wrist.y, goal.x - wrist.x) - along
        // By the shorter way round.
        const aim = along + pointing * Math.atan2(Math.sin(astray), Math.cos(astray))
        const finger = (turn, length) =>
            `M ${wrist.x} ${wrist.y} L ${wrist.x + Math.cos(aim + turn) * length} ${wrist.y + Math.sin(aim + turn) * length} `
        const cuff = Qt.point(wrist.x - Math.cos(aim) * 13, wrist.y - Math.sin(aim) * 13)
        return {
            x: wrist.x,
            y: wrist.y,
            sleeve: `M ${shoulder.x} ${shoulder.y} Q ${elbow.x} ${elbow.y} ${wrist.x} ${wrist.y}`,
            // The middle finger stays out when the others fold.
            fingers: finger(0, 27 + 15 * pointing) + finger(-0.55, 25 - 14 * pointing)
                + finger(0.55, 25 - 14 * pointing) + finger(side * -1.35, 21 - 5 * pointing),
            cuff: `M ${cuff.x - Math.sin(aim) * 17} ${cuff.y + Math.cos(aim) * 17}`
                + ` L ${cuff.x + Math.sin(aim) * 17} ${cuff.y - Math.cos(aim) * 17}`
        }
    }

    component Bone: ShapePath {
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        joinStyle: ShapePath.RoundJoin
    }

    visible: !hangs
    antialiasing: true

    Bone { strokeWidth: 46; strokeColor: "#1F5F6B"; PathSvg { path: arm.pose.sleeve } }
    Bone { strokeWidth: 36; strokeColor: "#2E7784"; PathSvg { path: arm.pose.sleeve } }
    Bone { strokeWidth: 23; strokeColor: "#1F5F6B"; PathSvg { path: arm.pose.fingers } }
    ShapePath {
        strokeWidth: 5
        strokeColor: "#1F5F6B"
        fillColor: "#FFF6E4"
        PathAngleArc { centerX: arm.pose.x; centerY: arm.pose.y; radiusX: 19; radiusY: 19; sweepAngle: 360 }
    }
    Bone { strokeWidth: 14; strokeColor: "#FFF6E4"; PathSvg { path: arm.pose.fingers } }
    Bone { // the cuff, across the end of the sleeve
        strokeWidth: 12
        strokeColor: "#F2A33A"
        PathSvg { path: arm.pose.cuff }
    }
}
