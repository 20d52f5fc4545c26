// The avatar's neck, shoulders and collar.
import QtQuick
import QtQuick.Shapes

Shape {
    id: bust

    property bool turned: false     // seen from behind, where the collar stands higher

    readonly property real dip: turned ? 348 : 372

    antialiasing: true
    ShapePath { // neck
        strokeWidth: -1
        fillColor: "#C9B58B"
        PathRectangle { x: 166; y: 310; width: 68; height: 70; radius: 16 }
    }
    ShapePath { // its bellows
        strokeWidth: 4
        strokeColor: "#AE9A70"
        capStyle: ShapePath.FlatCap
        fillColor: "transparent"
        PathSvg { path: "M 166 344 C 186 352 214 352 234 344" }
    }
    ShapePath {
        strokeWidth: -1
        fillColor: "#2E7784"
        PathSvg { path: `M 76 462 C 72 390 104 362 152 356 C 180 ${bust.dip} 220 ${bust.dip} 248 356 C 296 362 328 390 324 462 Z` }
    }
    ShapePath { // arms
        strokeWidth: 4
        strokeColor: "#1F5F6B"
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        PathSvg { path: "M 122 452 C 122 426 118 414 110 404 M 278 452 C 278 426 282 414 290 404" }
    }
    ShapePath { // collar
        strokeWidth: 12
        strokeColor: "#F2A33A"
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        PathSvg { path: `M 146 356 C 180 ${bust.dip + (bust.turned ? 0 : 8)} 220 ${bust.dip + (bust.turned ? 0 : 8)} 254 356` }
    }
}
