// A portrait of a grown-up or a child in a disc, drawn like the animals of the cards and with the helper's colours.
import QtQuick
import QtQuick.Shapes
import "."

Shape {
    id: person

    // A child is smaller, and its head is larger for its size.
    property bool child: false

    // The disc around the middle of a square of 240. What is below its rim is not seen.
    readonly property real rim: 142
    readonly property real headX: child ? 44 : 47
    readonly property real headY: child ? 42 : 47
    readonly property real face: child ? 121 : 78
    readonly property real neck: face + headY - 7
    readonly property real crown: child ? face - headY - 20 : face - 1.16 * headY
    readonly property real half: child ? 58 : 78
    // How high the rounded shoulders begin to bend.
    readonly property real bend: neck + (child ? 34 : 46)
    readonly property color hair: child ? "#C8793A" : "#5B3A24"

    // Where the rim is, so far from the middle.
    function foot(aside: real): real {
        return 120 + Math.sqrt(rim * rim - aside * aside)
    }

    width: 240
    height: 240
    antialiasing: true

    ShapePath { // the ground that the cards' pictures have, too
        strokeWidth: -1
        fillColor: Theme.sunny
        PathAngleArc { centerX: 120; centerY: 120; radiusX: person.rim; radiusY: person.rim; sweepAngle: 360 }
    }
    ShapePath { // the body
        strokeWidth: -1
        fillColor: "#2E7784"
        PathSvg {
            path: `M 120 ${person.neck} C ${120 + 0.8 * person.half} ${person.neck} ${120 + person.half} ${person.bend - 14} ${120 + person.half} ${person.bend + 12} `
                + `V ${person.foot(person.half)} A ${person.rim} ${person.rim} 0 0 1 ${120 - person.half} ${person.foot(person.half)} V ${person.bend + 12} `
                + `C ${120 - person.half} ${person.bend - 14} ${120 - 0.8 * person.half} ${person.neck} 120 ${person.neck} Z`
        }
    }
    ShapePath { // the arms
        strokeWidth: person.child ? 4 : 5
        strokeColor: "#1F5F6B"
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        PathSvg {
            path: `M ${120 - 0.52 * person.half} ${person.foot(0.52 * person.half) - 3} V ${person.bend + 22} M ${120 + 0.52 * person.half} ${person.foot(0.52 * person.half) - 3} V ${person.bend + 22}`
        }
    }
    ShapePath { // the head
        strokeWidth: -1
        fillColor: "#FBE9D0"
        PathAngleArc { centerX: 120; centerY: person.face; radiusX: person.headX; radiusY: person.headY; sweepAngle: 360 }
    }
    ShapePath { // the collar
        strokeWidth: person.child ? 8 : 10
        strokeColor: "#F2A33A"
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        PathSvg { path: `M ${120 - 0.46 * person.half} ${person.neck + 5} C ${120 - 0.2 * person.half} ${person.neck + 14} ${120 + 0.2 * person.half} ${person.neck + 14} ${120 + 0.46 * person.half} ${person.neck + 5}` }
    }
    ShapePath { // the hair
        strokeWidth: -1
        fillColor: person.hair
        PathSvg {
            path: `M ${120 - person.headX - 3} ${person.face + 2} C ${120 - person.headX - 5} ${person.face - 1.55 * person.headY} ${120 + person.headX + 5} ${person.face - 1.55 * person.headY} ${120 + person.headX + 3} ${person.face + 2} `
                + `C ${120 + 0.9 * person.headX} ${person.face - 8} ${120 + 0.7 * person.headX} ${person.face - 14} ${120 + 0.3 * person.headX} ${person.face - 16} `
                + `C ${120 - 0.2 * person.headX} ${person.face - 10} ${120 - 0.8 * person.headX} ${person.face - 12} ${120 - person.headX - 3} ${person.face + 2} Z`
        }
    }
    ShapePath { // a child's tuft
        strokeWidth: person.child ? 6 : -1
        strokeColor: person.hair
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        PathSvg { path: `M 118 ${person.face - person.headY} C 116 ${person.face - person.headY - 12} 122 ${person.face - person.headY - 17} 129 ${person.face - person.headY - 16}` }
    }
    ShapePath { // the cheeks
        strokeWidth: -1
        fillColor: "#F2B5A0"
        PathAngleArc { centerX: 120 - 0.56 * person.headX; centerY: person.face + 12; radiusX: 6; radiusY: 4.5; sweepAngle: 360 }
        PathAngleArc { centerX: 120 + 0.56 * person.headX; centerY: person.face + 12; radiusX: 6; radiusY: 4.5; sweepAngle: 360 }
    }
    ShapePath { // the eyes
        strokeWidth: -1
        fillColor: "#22313F"
        PathAngleArc { centerX: 120 - 0.38 * person.headX; centerY: person.face + 2; radiusX: 4; radiusY: 5; sweepAngle: 360 }
        PathAngleArc { centerX: 120 + 0.38 * person.headX; centerY: person.face + 2; radiusX: 4; radiusY: 5; sweepAngle: 360 }
    }
    ShapePath { // the mouth
        strokeWidth: 3.5
        strokeColor: "#22313F"
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        PathSvg { path: `M ${120 - 0.3 * person.headX} ${person.face + 14} C ${120 - 0.14 * person.headX} ${person.face + 21} ${120 + 0.14 * person.headX} ${person.face + 21} ${120 + 0.3 * person.headX} ${person.face + 14}` }
    }
}
