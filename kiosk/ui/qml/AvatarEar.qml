// An ear: a folded leaf on a hinge. Ears carry the mood into the silhouette.
import QtQuick
import QtQuick.Shapes

Shape {
    id: ear

    required property int side      // the light half faces inwards
    property bool turned: false     // seen from behind, where neither half is light

    width: 80; height: 110
    antialiasing: true
    transformOrigin: Item.Bottom
    ShapePath {
        strokeWidth: 8
        strokeColor: "#1F5F6B"
        fillColor: "#1F5F6B"
        joinStyle: ShapePath.RoundJoin
        PathSvg { path: "M 40 110 C 0 96 -2 44 40 6 C 82 44 80 96 40 110 Z" }
    }
    ShapePath {
        strokeWidth: -1
        fillColor: ear.turned ? "#3A8794" : "#8EC3D9"
        PathSvg { path: `M 40 110 C ${40 - ear.side * 34} 92 ${40 - ear.side * 36} 46 40 12 C ${40 - ear.side * 6} 46 ${40 - ear.side * 6} 80 40 110 Z` }
    }
    ShapePath {
        strokeWidth: 5
        strokeColor: "#1F5F6B"
        fillColor: "#F2A33A"
        PathAngleArc { centerX: 40; centerY: 110; radiusX: 13; radiusY: 13; sweepAngle: 360 }
    }
}
