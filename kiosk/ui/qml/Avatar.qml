// The robot friend beside the board. Law: a pose is a row of numbers; this file only draws the row it is given.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes

Item {
    id: avatar

    required property string mood
    required property real mouth
    required property real gazeX
    required property real gazeY
    required property bool blinking
    required property int motion

    // The one place where moods differ. Left and right are the visitor's.
    //   tilt degrees, dx dy zoom: head;  sh: shoulders px down;  earL earR: degrees out from upright;
    //   bLi bLo bRi bRo: brow ends px up (inner, outer);  upL upR low slant: lids;  lx ly: own gaze;
    //   smile span skew wave mx: mouth;  cheek: 0 flat .. 1 lifted
    readonly property var poses: ({
        idle:      { tilt: 2, dx: 0, dy: 0, zoom: 1, sh: 0, earL: 62, earR: 62, bLi: 0, bLo: 0, bRi: 2, bRo: 2,
                     upL: 0.86, upR: 0.86, low: 0.95, slant: 3, lx: 0, ly: 0,
                     smile: 0.65, span: 62, skew: 0, wave: 0, mx: 0, cheek: 0.3 },
        happy:     { tilt: -5, dx: 0, dy: -8, zoom: 1.02, sh: -6, earL: 34, earR: 34, bLi: 13, bLo: 8, bRi: 13, bRo: 8,
                     upL: 0.82, upR: 0.82, low: 0.14, slant: 0, lx: 0, ly: -0.25,
                     smile: 1.35, span: 92, skew: 0, wave: 0, mx: 0, cheek: 1 },
        confused:  { tilt: 12, dx: 6, dy: 0, zoom: 1, sh: -3, earL: 12, earR: 112, bLi: 15, bLo: 17, bRi: -9, bRo: -1,
                     upL: 1, upR: 0.62, low: 0.9, slant: 0, lx: 0, ly: 0,
                     smile: -0.15, span: 66, skew: 5, wave: 20, mx: 3, cheek: 0 },
        sad:       { tilt: -6, dx: -4, dy: 17, zoom: 0.98, sh: 9, earL: 146, earR: 146, bLi: 14, bLo: -9, bRi: 14, bRo: -9,
                     upL: 0.68, upR: 0.68, low: 0.95, slant: 13, lx: 0, ly: 0.25,
                     smile: -0.85, span: 54, skew: 0, wave: 0, mx: 0, cheek: 0 },
        thinking:  { tilt: -8, dx: 5, dy: -2, zoom: 1, sh: 0, earL: 78, earR: 30, bLi: -3, bLo: 2, bRi: 8, bRo: 12,
                     upL: 0.8, upR: 0.95, low: 0.8, slant: 0, lx: 0.75, ly: -0.8,
                     smile: 0.05, span: 44, skew: 9, wave: 3, mx: 20, cheek: 0.1 },
        listening: { tilt: 8, dx: 8, dy: 6, zoom: 1.05, sh: 2, earL: 4, earR: 6, bLi: 9, bLo: 8, bRi: 9, bRo: 8,
                     upL: 0.98, upR: 0.98, low: 1, slant: 0, lx: 0, ly: 0,
                     smile: 0.3, span: 42, skew: 0, wave: 0, mx: 0, cheek: 0.3 }
    })
    property var origin: pick()
    property var target: pick()
    property real lead: 1           // progress of head and face
    property real lag: 1            // progress of ears and shoulders, which follow the head
    readonly property var pose: blend(lead)
    readonly property var trail: blend(lag)

    property real shut: blinking ? 1 : 0
    property real eyeX: gazeX
    property real eyeY: gazeY
    property real turnX: gazeX      // the face turns a little, after the eyes
    property real turnY: gazeY

    function pick(): var {
        return poses[mood] ?? poses.idle
    }
    function blend(k: real): var {
        const row = {}
        for (const key in target)
            row[key] = origin[key] + (target[key] - origin[key]) * k
        return row
    }

    // A new mood starts from where the old one had got to, so an interrupted move does not jump.
    onMoodChanged: {
        move.stop()
        origin = Object.assign({}, pose, { earL: trail.earL, earR: trail.earR, sh: trail.sh })
        lead = lag = motion > 0 ? 0 : 1
        target = pick()
        if (motion > 0)
            move.start()
    }

    ParallelAnimation {
        id: move
        NumberAnimation { target: avatar; property: "lead"; to: 1; duration: avatar.motion; easing.type: Easing.OutCubic }
        NumberAnimation { target: avatar; property: "lag"; to: 1; duration: avatar.motion * 1.5; easing.type: Easing.OutBack }
    }
    Behavior on shut { enabled: avatar.motion > 0; NumberAnimation { duration: Math.min(60, avatar.motion / 3) } }
    Behavior on eyeX { enabled: avatar.motion > 0; NumberAnimation { duration: avatar.motion / 3; easing.type: Easing.OutCubic } }
    Behavior on eyeY { enabled: avatar.motion > 0; NumberAnimation { duration: avatar.motion / 3; easing.type: Easing.OutCubic } }
    Behavior on turnX { enabled: avatar.motion > 0; NumberAnimation { duration: avatar.motion; easing.type: Easing.InOutQuad } }
    Behavior on turnY { enabled: avatar.motion > 0; NumberAnimation { duration: avatar.motion; easing.type: Easing.InOutQuad } }

    // An ear: a paddle with a microphone grille. It hangs on a hinge, so it can stand and droop.
    component Ear: Shape {
        id: ear
        width: 80
        height: 120
        antialiasing: true
        transformOrigin: Item.Bottom
        ShapePath {
            strokeWidth: -1
            fillColor: "#1F5F6B"
            PathSvg { path: "M 29 120 C 30 96 2 84 4 46 C 6 18 22 6 40 6 C 58 6 74 18 76 46 C 78 84 50 96 51 120 Z" }
        }
        ShapePath {
            strokeWidth: 6
            strokeColor: "#8EC3D9"
            fillColor: "transparent"
            capStyle: ShapePath.RoundCap
            PathSvg { path: "M 32 28 H 48 M 24 42 H 56 M 24 56 H 56 M 32 70 H 48" }
        }
    }
    component Hinge: ShapePath {
        required property real at
        id: hinge
        strokeWidth: 5
        strokeColor: "#1F5F6B"
        fillColor: "#F2A33A"
        PathAngleArc { centerX: hinge.at; centerY: 124; radiusX: 13; radiusY: 13; sweepAngle: 360 }
    }

    Item {
        id: stage
        width: 400
        height: 440
        anchors.centerIn: parent
        scale: Math.min(avatar.width / 400, avatar.height / 440)

        Shape { // shoulders
            y: avatar.trail.sh
            width: 400
            height: 440
            antialiasing: true
            ShapePath {
                strokeWidth: -1
                fillColor: "#C9B58B"
                PathRectangle { x: 166; y: 310; width: 68; height: 70; radius: 16 }
            }
            ShapePath {
                strokeWidth: -1
                fillColor: "#2E7784"
                PathSvg { path: "M 76 462 C 72 390 104 362 152 356 C 180 372 220 372 248 356 C 296 362 328 390 324 462 Z" }
            }
            ShapePath { // collar
                strokeWidth: 12
                strokeColor: "#F2A33A"
                fillColor: "transparent"
                capStyle: ShapePath.RoundCap
                PathSvg { path: "M 146 356 C 180 380 220 380 254 356" }
            }
            ShapePath { // the voice comes from here: a small loudspeaker
                strokeWidth: 5
                strokeColor: "#1F5F6B"
                fillColor: "transparent"
                capStyle: ShapePath.RoundCap
                PathSvg { path: "M 184 400 H 216 M 178 414 H 222 M 184 428 H 216" }
            }
        }

        Item {
            id: head
            x: avatar.pose.dx
            y: avatar.pose.dy
            width: 400
            height: 340
            transformOrigin: Item.Bottom
            rotation: avatar.pose.tilt
            scale: 0.9 * avatar.pose.zoom

            Shape {
                width: 400
                height: 340
                antialiasing: true
                ShapePath { // hood
                    strokeWidth: -1
                    fillGradient: LinearGradient {
                        x1: 0; x2: 0; y1: 70; y2: 340
                        GradientStop { position: 0; color: "#3A8794" }
                        GradientStop { position: 1; color: "#1F5F6B" }
                    }
                    PathSvg { path: "M 200 66 C 290 66 346 122 348 212 C 350 300 296 342 200 342 C 104 342 50 300 52 212 C 54 122 110 66 200 66 Z" }
                }
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

            Ear { x: 50; y: 4; rotation: -avatar.trail.earL }
            Ear { x: 270; y: 4; rotation: avatar.trail.earR }
            Shape {
                width: 400
                height: 340
                antialiasing: true
                Hinge { at: 90 }
                Hinge { at: 310 }
            }

            Item {
                id: face
                x: avatar.turnX * 6
                y: avatar.turnY * 5
                width: 400
                height: 340

                Shape { // cheeks and brows
                    width: 400
                    height: 340
                    antialiasing: true
                    ShapePath {
                        strokeWidth: -1
                        fillColor: Qt.rgba(0.894, 0.447, 0.357, 0.16 + 0.3 * avatar.pose.cheek)
                        PathAngleArc { centerX: 112; centerY: 262 - 10 * avatar.pose.cheek; radiusX: 21 + 4 * avatar.pose.cheek; radiusY: 14; sweepAngle: 360 }
                        PathAngleArc { centerX: 288; centerY: 262 - 10 * avatar.pose.cheek; radiusX: 21 + 4 * avatar.pose.cheek; radiusY: 14; sweepAngle: 360 }
                    }
                    ShapePath {
                        strokeWidth: 9
                        strokeColor: "#22313F"
                        fillColor: "transparent"
                        capStyle: ShapePath.RoundCap
                        PathSvg { path: avatar.brow(112, 168, avatar.pose.bLo, avatar.pose.bLi) }
                        PathSvg { path: avatar.brow(232, 288, avatar.pose.bRi, avatar.pose.bRo) }
                    }
                }
                AvatarEye {
                    x: 92; y: 140
                    side: -1
                    upper: avatar.pose.upL
                    lower: avatar.pose.low
                    slant: avatar.pose.slant
                    gazeX: Math.max(-1, Math.min(1, avatar.eyeX + avatar.pose.lx))
                    gazeY: Math.max(-1, Math.min(1, avatar.eyeY + avatar.pose.ly))
                    shut: avatar.shut
                }
                AvatarEye {
                    x: 208; y: 140
                    side: 1
                    upper: avatar.pose.upR
                    lower: avatar.pose.low
                    slant: avatar.pose.slant
                    gazeX: Math.max(-1, Math.min(1, avatar.eyeX + avatar.pose.lx))
                    gazeY: Math.max(-1, Math.min(1, avatar.eyeY + avatar.pose.ly))
                    shut: avatar.shut
                }
                AvatarMouth {
                    x: 200 + avatar.pose.mx
                    y: 270
                    open: avatar.mouth
                    smile: avatar.pose.smile
                    span: avatar.pose.span
                    skew: avatar.pose.skew
                    wave: avatar.pose.wave
                }
            }
        }
    }

    // A brow from x1 to x2, its ends lifted by y1 and y2, always a little arched.
    function brow(x1: real, x2: real, y1: real, y2: real): string {
        return `M ${x1} ${136 - y1} Q ${(x1 + x2) / 2} ${124 - (y1 + y2) / 2} ${x2} ${136 - y2}`
    }
}
