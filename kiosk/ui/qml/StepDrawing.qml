// What a step of the visit is about, on a round ground: a person, two cards of the game, what a visitor says, or a sign.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes
import "."

Item {
    id: drawing

    required property string sign
    required property url picture
    required property url back
    required property url shadow

    height: width

    Rectangle {
        anchors.fill: parent
        radius: width / 2
        color: Theme.sunny
    }
    Sign {
        visible: !["person", "cards", "questions"].includes(drawing.sign)
        width: parent.width
        color: "transparent"
        thick: 1.6
        reach: 40
        sign: drawing.sign
    }
    Person {
        visible: drawing.sign === "person"
        anchors.centerIn: parent
        scale: drawing.width / (2 * rim)
    }
    component Lying: CardFace {
        visible: drawing.sign === "cards"
        width: Math.round(0.46 * drawing.width)
        height: width
        back: drawing.back
        shadow: drawing.shadow
        picture: drawing.picture
        rimShown: up ? 1 : 0
    }
    Lying {
        x: 0.12 * drawing.width
        y: 0.19 * drawing.width
        rotation: -8
        up: false
    }
    Lying {
        x: 0.42 * drawing.width
        y: 0.35 * drawing.width
        rotation: 7
        up: true
    }
    Shape {
        visible: drawing.sign === "questions"
        anchors.centerIn: parent
        width: 240
        height: 240
        scale: drawing.width / 210
        antialiasing: true
        ShapePath {
            strokeColor: Theme.sea
            strokeWidth: 6
            joinStyle: ShapePath.RoundJoin
            fillColor: Theme.white
            PathSvg { path: "M 68 66 H 172 Q 190 66 190 84 V 136 Q 190 154 172 154 H 124 L 92 184 V 154 H 68 Q 50 154 50 136 V 84 Q 50 66 68 66 Z" }
        }
        ShapePath {
            strokeWidth: -1
            fillColor: Theme.sea
            PathAngleArc { centerX: 86; centerY: 110; radiusX: 11; radiusY: 11; sweepAngle: 360 }
            PathAngleArc { centerX: 120; centerY: 110; radiusX: 11; radiusY: 11; sweepAngle: 360 }
            PathAngleArc { centerX: 154; centerY: 110; radiusX: 11; radiusY: 11; sweepAngle: 360 }
        }
    }
}
