// The seconds for which a calm card stays, with their unit. A ring around them empties in small steps.
import QtQuick
import QtQuick.Shapes
import "."

Rectangle {
    id: badge

    // How long the card stays, in ms; 0 where that is not known.
    required property int lasts
    // The unit of the last of the seconds, and of those before.
    required property string second
    required property string seconds
    // How large the number is at most.
    required property real most
    readonly property real figure: Math.min(most, 96 * Theme.unit, 0.42 * width)
    readonly property real unit: Math.max(24 * Theme.unit, Math.min(44 * Theme.unit, 0.15 * width))

    readonly property int steps: 40
    property int msLeft: 0
    readonly property int secondsLeft: Math.ceil(msLeft / 1000)
    // Where nothing moves, the ring stays whole.
    readonly property int stepsLeft: Theme.motion === 0 ? steps : Math.ceil(steps * msLeft / Math.max(1, lasts))

    visible: lasts > 0
    height: width
    radius: width / 2
    color: Theme.sand
    onLastsChanged: {
        emptying.stop()
        msLeft = lasts
        emptying.duration = lasts
        if (lasts > 0)
            emptying.start()
    }
    // It tells the time, so the seconds go on where nothing else moves.
    NumberAnimation {
        id: emptying
        target: badge
        property: "msLeft"
        to: 0
        duration: 0
    }

    Shape {
        id: ring
        objectName: "time-left"
        readonly property real far: badge.width / 2 + 10 * Theme.unit
        anchors.centerIn: parent
        width: 2 * far
        height: 2 * far
        antialiasing: true
        ShapePath {
            strokeColor: Theme.sea
            strokeWidth: 8 * Theme.unit
            capStyle: ShapePath.FlatCap
            fillColor: "transparent"
            PathAngleArc {
                centerX: ring.far
                centerY: ring.far
                radiusX: ring.far
                radiusY: ring.far
                startAngle: -90
                sweepAngle: 360 * badge.stepsLeft / badge.steps
            }
        }
    }
    // Read by the eye alone: a screen reader would speak every second.
    PlainText {
        objectName: "seconds-left"
        anchors { centerIn: parent; verticalCenterOffset: -0.8 * badge.unit }
        width: 0.8 * badge.width
        text: badge.secondsLeft
        font { pixelSize: badge.figure; bold: true }
        fontSizeMode: Text.HorizontalFit
        minimumPixelSize: Theme.body
        horizontalAlignment: Text.AlignHCenter
        Accessible.ignored: true
    }
    PlainText {
        objectName: "seconds-unit"
        anchors { centerIn: parent; verticalCenterOffset: 0.05 * badge.unit + 0.5 * badge.figure }
        width: 0.8 * badge.width
        text: badge.secondsLeft === 1 ? badge.second : badge.seconds
        font.pixelSize: badge.unit
        fontSizeMode: Text.HorizontalFit
        minimumPixelSize: 24 * Theme.unit
        horizontalAlignment: Text.AlignHCenter
        Accessible.ignored: true
    }
}
