// The robot friend beside the board. Law: a pose is a row of numbers; this file only draws the row it is given.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes

Item {
    id: avatar

    required property string mood
    required property real mouth    // how far it is open, 0 .. 1
    property string mouthShape: "open" // which sound it forms: closed, round, open, wide or teeth
    required property real gazeX
    required property real gazeY
    required property bool blinking
    required property int motion
    // What the arm points at, in this item; it only does while `points`.
    property bool points: false
    property point aim
    // Whether it breathes; something else that moves may need every frame.
    property bool breathes: true

    // The one place where moods differ. Left and right are the visitor's.
    //   tilt degrees, dx dy zoom: head;  sh: shoulders px down;  earL earR: degrees out from upright;
    //   bLi bLo bRi bRo: brow ends px up (inner, outer);  upL upR low slant: lids;  lx ly: own gaze;
    //   smile span skew wave mx: mouth;  cheek: 0 flat .. 1 lifted;  hLx hLy hRx hRy: hands, below 480 out of sight
    readonly property var poses: ({
        idle:      { tilt: 2, dx: 0, dy: 0, zoom: 1, sh: 0, earL: 62, earR: 62, bLi: 0, bLo: 0, bRi: 2, bRo: 2,
                     upL: 0.93, upR: 0.93, low: 0.95, slant: 3, lx: 0, ly: 0,
                     smile: 0.65, span: 62, skew: 0, wave: 0, mx: 0, cheek: 0.3,
                     hLx: 70, hLy: 540, hRx: 330, hRy: 540 },
        happy:     { tilt: -5, dx: 6, dy: -6, zoom: 1.02, sh: -6, earL: 38, earR: 46, bLi: 13, bLo: 8, bRi: 13, bRo: 8,
                     upL: 0.9, upR: 0.9, low: -0.16, slant: 0, lx: 0, ly: -0.4,
                     smile: 1.35, span: 92, skew: 0, wave: 0, mx: 0, cheek: 1,
                     hLx: 30, hLy: 290, hRx: 370, hRy: 290 },
        confused:  { tilt: 12, dx: -21, dy: 0, zoom: 1, sh: -3, earL: 12, earR: 118, bLi: 15, bLo: 17, bRi: -9, bRo: -1,
                     upL: 1, upR: 0.62, low: 0.9, slant: 0, lx: 0, ly: 0,
                     smile: -0.15, span: 66, skew: 5, wave: 20, mx: 3, cheek: 0,
                     hLx: 70, hLy: 540, hRx: 262, hRy: 352 },
        sad:       { tilt: -4, dx: 3, dy: 7, zoom: 0.99, sh: 4, earL: 92, earR: 92, bLi: 11, bLo: -1, bRi: 11, bRo: -1,
                     upL: 0.9, upR: 0.9, low: 0.95, slant: 7, lx: 0, ly: 0.12,
                     smile: -0.18, span: 46, skew: 0, wave: 0, mx: 0, cheek: 0.3,
                     hLx: 70, hLy: 540, hRx: 330, hRy: 540 },
        thinking:  { tilt: -8, dx: 18, dy: -2, zoom: 1, sh: 0, earL: 57, earR: 24, bLi: -7, bLo: 1, bRi: 8, bRo: 13,
                     upL: 0.8, upR: 0.95, low: 0.8, slant: 0, lx: 0.75, ly: -0.8,
                     smile: 0.05, span: 44, skew: 9, wave: 3, mx: 20, cheek: 0.1,
                     hLx: 70, hLy: 540, hRx: 246, hRy: 356 },
        listening: { tilt: 8, dx: -8, dy: 6, zoom: 1.05, sh: 2, earL: 4, earR: 6, bLi: 9, bLo: 8, bRi: 9, bRo: 8,
                     upL: 0.98, upR: 0.98, low: 1, slant: 0, lx: 0, ly: 0,
                     smile: 0.3, span: 42, skew: 0, wave: 0, mx: 0, cheek: 0.3,
                     hLx: 70, hLy: 540, hRx: 330, hRy: 540 }
    })
    readonly property string grille: "M 184 396 H 216 M 178 411 H 222 M 184 426 H 216"
    property var origin: poses.idle
    property var target: poses.idle
    property real lead: 1           // progress of head and face
    property real lag: 1            // progress of ears and shoulders, which follow the head
    // In steps, as the last bit of a slow end is drawn many times and never seen.
    readonly property var pose: blend(Math.round(lead * 24) / 24)
    readonly property var trail: blend(Math.round(lag * 24) / 24)
    property real shut: blinking ? 1 : 0
    property real eyeX: gazeX
    property real eyeY: gazeY
    property real turnX: gazeX      // the face turns a little, after the eyes
    property real turnY: gazeY
    property real reaching: points ? 1 : 0
    property real dip: 0            // a nod: px the head goes down
    property real waving: 0         // 0 at rest .. 1 the right hand is up
    property real sway: 0           // which way it waves just now, -1 .. 1
    property real jab: 0            // how far the finger pokes at what it points at, 0 .. 1
    property real air: 0            // 0 out .. 1 in
    readonly property real breath: Math.round(air * 9) / 9

    // In the drawing's own coordinates.
    readonly property real size: Math.min(width / 400, height / 440)
    readonly property point goal: Qt.point((aim.x - width / 2) / size + 200, (aim.y - height / 2) / size + 220)
    readonly property int near: goal.x < 200 ? -1 : 1
    // How steeply it points up, 0 .. 1: the arm then stays beside the face.
    readonly property real steep: Math.max(0, Math.min(1, 1.4 - Math.abs(goal.x - 200) / Math.max(1, 416 - goal.y)))
    readonly property point leftHand: Qt.point(trail.hLx, trail.hLy)
    readonly property point rightHand: Qt.point(trail.hRx + (372 + 16 * sway - trail.hRx) * waving,
                                                trail.hRy + (284 - trail.hRy) * waving)

    // Where a hand is that points: the forearm goes from beside the shoulder towards the target. To one far beside and
    // above it, the hand is raised further, nearer to the target's height; the finger still points at it.
    function pointingHand(side: int): point {
        const x = 200 + side * (108 + 52 * steep), y = 416
        const up = Math.atan2(y - goal.y, side * (goal.x - x))
        const raised = up > 0 && up < Math.PI / 2 ? Math.max(up, Math.min(1.15, 2.8 * up)) : up
        const length = 112 + 34 * Math.min(1, raised - up) + 10 * jab
        return Qt.point(x + side * Math.cos(raised) * length, y - Math.sin(raised) * length)
    }
    function reached(side: int, rest: point): point {
        if (near !== side)
            return rest
        const goal = pointingHand(side)
        return Qt.point(rest.x + (goal.x - rest.x) * reaching, rest.y + (goal.y - rest.y) * reaching)
    }
    // Small gestures; each starts anew when it is asked for again.
    function nod() {
        if (motion > 0)
            nodding.restart()
    }
    function wave() {
        if (motion > 0)
            greeting.restart()
    }

    function pick(): var {
        return poses[mood] ?? poses.idle
    }
    function blend(k: real): var {
        const row = {}
        for (const key in target)
            row[key] = origin[key] + (target[key] - origin[key]) * k
        return row
    }

    Component.onCompleted: origin = target = pick()
    // A new mood starts from where the old one had got to, so an interrupted move does not jump.
    onMoodChanged: {
        move.stop()
        origin = Object.assign({}, pose, { earL: trail.earL, earR: trail.earR, sh: trail.sh })
        lead = lag = motion > 0 ? 0 : 1
        target = pick()
        if (motion > 0) move.start()
    }

    ParallelAnimation {
        id: move
        NumberAnimation { target: avatar; property: "lead"; to: 1; duration: avatar.motion; easing.type: Easing.OutCubic }
        NumberAnimation { target: avatar; property: "lag"; to: 1; duration: avatar.motion * 1.5; easing.type: Easing.OutBack }
    }
    SequentialAnimation {
        id: nodding
        NumberAnimation { target: avatar; property: "dip"; to: 15; duration: avatar.motion > 0 ? 150 : 0; easing.type: Easing.OutQuad }
        NumberAnimation { target: avatar; property: "dip"; to: 0; duration: avatar.motion > 0 ? 190 : 0; easing.type: Easing.InOutQuad }
        NumberAnimation { target: avatar; property: "dip"; to: 9; duration: avatar.motion > 0 ? 140 : 0; easing.type: Easing.OutQuad }
        NumberAnimation { target: avatar; property: "dip"; to: 0; duration: avatar.motion > 0 ? 220 : 0; easing.type: Easing.InOutQuad }
    }
    SequentialAnimation {
        id: greeting
        NumberAnimation { target: avatar; property: "waving"; to: 1; duration: avatar.motion > 0 ? 350 : 0; easing.type: Easing.OutBack }
        SequentialAnimation {
            loops: 3
            NumberAnimation { target: avatar; property: "sway"; to: 1; duration: avatar.motion > 0 ? 170 : 0; easing.type: Easing.InOutSine }
            NumberAnimation { target: avatar; property: "sway"; to: -1; duration: avatar.motion > 0 ? 250 : 0; easing.type: Easing.InOutSine }
            NumberAnimation { target: avatar; property: "sway"; to: 0; duration: avatar.motion > 0 ? 130 : 0; easing.type: Easing.InOutSine }
        }
        NumberAnimation { target: avatar; property: "waving"; to: 0; duration: avatar.motion > 0 ? 350 : 0; easing.type: Easing.InQuad }
    }
    SequentialAnimation {
        id: poking
        running: avatar.points && avatar.visible && avatar.motion > 0
        PauseAnimation { duration: 500 }
        SequentialAnimation {
            loops: 2
            NumberAnimation { target: avatar; property: "jab"; to: 1; duration: avatar.motion > 0 ? 130 : 0; easing.type: Easing.OutQuad }
            NumberAnimation { target: avatar; property: "jab"; to: 0; duration: avatar.motion > 0 ? 220 : 0; easing.type: Easing.InOutQuad }
        }
    }
    // Breath is slow: in steps of a third of a pixel it looks the same as at every frame, at a tenth of the cost.
    SequentialAnimation {
        loops: Animation.Infinite
        running: avatar.visible && avatar.motion > 0
        paused: running && !avatar.breathes
        NumberAnimation { target: avatar; property: "air"; to: 1; duration: avatar.motion > 0 ? 1900 : 0; easing.type: Easing.InOutSine }
        NumberAnimation { target: avatar; property: "air"; to: 0; duration: avatar.motion > 0 ? 1900 : 0; easing.type: Easing.InOutSine }
    }
    Behavior on reaching { enabled: avatar.motion > 0; NumberAnimation { duration: avatar.motion * 1.2; easing.type: Easing.OutBack; easing.overshoot: 1 } }
    Behavior on shut { enabled: avatar.motion > 0; NumberAnimation { duration: Math.min(60, avatar.motion / 3) } }
    Behavior on eyeX { enabled: avatar.motion > 0; NumberAnimation { duration: avatar.motion / 3; easing.type: Easing.OutCubic } }
    Behavior on eyeY { enabled: avatar.motion > 0; NumberAnimation { duration: avatar.motion / 3; easing.type: Easing.OutCubic } }
    Behavior on turnX { enabled: avatar.motion > 0; NumberAnimation { duration: avatar.motion; easing.type: Easing.InOutQuad } }
    Behavior on turnY { enabled: avatar.motion > 0; NumberAnimation { duration: avatar.motion; easing.type: Easing.InOutQuad } }

    component Groove: ShapePath {
        strokeColor: "#1F5F6B"
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
    }

    Item { // the 400 x 440 drawing, scaled as a whole
        width: 400; height: 440
        anchors.centerIn: parent
        scale: avatar.size

        Item { // the bust ends at the lower edge of the item, however far the shoulders move
            width: 400; height: 440
            clip: true

            AvatarBust { y: avatar.trail.sh - 3 * avatar.breath }
            Shape { // the loudspeaker glows with the voice, so one sees who speaks without looking at the mouth
                y: avatar.trail.sh - 3 * avatar.breath
                antialiasing: true
                Groove {
                    strokeWidth: 9
                    PathSvg { path: avatar.grille }
                }
                Groove {
                    strokeWidth: 4
                    strokeColor: Qt.rgba(0.75, 0.91, 0.96, avatar.mouth)
                    PathSvg { path: avatar.grille }
                }
            }
        }

        Item {
            x: avatar.pose.dx; y: avatar.pose.dy + avatar.dip - 2 * avatar.breath
            width: 400; height: 340
            transformOrigin: Item.Bottom
            rotation: avatar.pose.tilt
            scale: 0.9 * avatar.pose.zoom

            AvatarHood {}
            Shape {
                antialiasing: true
                ShapePath { // face plate
                    strokeWidth: 6
                    strokeColor: "#E9D8B4"
                    fillGradient: LinearGradient {
                        x1: 0; x2: 0; y1: 100; y2: 326
                        GradientStop { position: 0; color: "#FFFBF2" }
                        GradientStop { position: 1; color: "#F1E2C2" }
                    }
                    PathSvg { path: "M 200 98 C 276 98 322 142 322 218 C 322 292 280 326 200 326 C 120 326 78 292 78 218 C 78 142 124 98 200 98 Z" }
                }
            }

            AvatarEar { side: -1; x: 44; y: 22; rotation: -avatar.trail.earL }
            AvatarEar { side: 1; x: 276; y: 22; rotation: avatar.trail.earR }

            Item {
                // In whole pixels: a face that drifts by less is drawn anew for nothing.
                x: Math.round(avatar.turnX * 6); y: Math.round(avatar.turnY * 5)

                Repeater {
                    model: [-1, 1]
                    AvatarEye {
                        required property int modelData
                        x: 150 + modelData * 58; y: 140
                        side: modelData
                        upper: modelData < 0 ? avatar.pose.upL : avatar.pose.upR
                        lower: avatar.pose.low
                        slant: avatar.pose.slant
                        gazeX: avatar.eyeX + avatar.pose.lx
                        gazeY: avatar.eyeY + avatar.pose.ly
                        shut: avatar.shut
                    }
                }
                Shape { // cheeks and brows lie over the lids
                    antialiasing: true
                    ShapePath {
                        strokeWidth: -1
                        fillColor: Qt.rgba(0.894, 0.447, 0.357, 0.16 + 0.3 * avatar.pose.cheek)
                        PathAngleArc { centerX: 112; centerY: 262 - 10 * avatar.pose.cheek; radiusX: 21 + 4 * avatar.pose.cheek; radiusY: 14; sweepAngle: 360 }
                        PathAngleArc { centerX: 288; centerY: 262 - 10 * avatar.pose.cheek; radiusX: 21 + 4 * avatar.pose.cheek; radiusY: 14; sweepAngle: 360 }
                    }
                    Groove {
                        strokeWidth: 9
                        strokeColor: "#22313F"
                        PathSvg { path: avatar.brow(112, 168, avatar.pose.bLo, avatar.pose.bLi) }
                        PathSvg { path: avatar.brow(232, 288, avatar.pose.bRi, avatar.pose.bRo) }
                    }
                }
                AvatarMouth {
                    x: 200 + avatar.pose.mx; y: 270
                    open: avatar.mouth
                    form: avatar.mouthShape
                    smile: avatar.pose.smile
                    span: avatar.pose.span
                    skew: avatar.pose.skew
                    wave: avatar.pose.wave
                }
            }
        }

        // In front of everything: a hand may come up to the chin.
        Repeater {
            model: [-1, 1]
            AvatarArm {
                required property int modelData
                side: modelData
                shoulder: Qt.point(200 + modelData * (92 + (avatar.near === modelData ? 20 * avatar.steep * avatar.reaching : 0)), 408 + avatar.trail.sh - 3 * avatar.breath)
                hand: avatar.reached(modelData, modelData < 0 ? avatar.leftHand : avatar.rightHand)
                goal: avatar.goal
                pointing: avatar.near === modelData ? Math.min(1, Math.max(0, avatar.reaching)) : 0
            }
        }
    }

    // A brow from x1 to x2, its ends lifted by y1 and y2, always a little arched.
    function brow(x1: real, x2: real, y1: real, y2: real): string {
        return `M ${x1} ${136 - y1} Q ${(x1 + x2) / 2} ${124 - (y1 + y2) / 2} ${x2} ${136 - y2}`
    }
}
