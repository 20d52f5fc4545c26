// The hood around the avatar's head, which also is its outline from behind.
import QtQuick
import QtQuick.Shapes

Shape {
    antialiasing: true
    ShapePath {
        strokeWidth: -1
        fillGradient: LinearGradient {
            x1: 0; x2: 0; y1: 70; y2: 340
            GradientStop { position: 0; color: "#3A8794" }
            GradientStop { position: 1; color: "#1F5F6B" }
        }
        PathSvg { path: "M 200 66 C 290 66 346 122 348 212 C 350 300 296 342 200 342 C 104 342 50 300 52 212 C 54 122 110 66 200 66 Z" }
    }
}
