// The avatar from behind, while people rate it. It stands still, and ends where its item does.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes

Item {
    id: back

    // How much wider than high it is.
    readonly property real shape: 1.12
    width: shape * height
    clip: true

    component Seam: ShapePath {
        strokeColor: "#1A505A"
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
    }

    Item { // Avatar's drawing, without the room above its ears
        x: (back.width - width) / 2 - 16 * scale
        width: 400; height: 440
        y: -62 * scale
        transformOrigin: Item.Top
        scale: back.height / 340

        AvatarBust { turned: true }
        Rectangle { // the label in its collar
            x: 186; y: 353
            width: 28; height: 26
            radius: 3
            color: "#F1E2C2"
        }
        Item {
            y: -2
            width: 400; height: 340
            transformOrigin: Item.Bottom
            rotation: 5
            scale: 0.9

            AvatarHood {}
            Shape {
                antialiasing: true
                ShapePath { // light from above
                    strokeWidth: -1
                    fillColor: Qt.rgba(0.56, 0.76, 0.85, 0.22)
                    PathSvg { path: "M 84 170 C 90 132 106 108 128 96 C 108 124 102 148 98 178 C 96 190 82 188 84 170 Z" }
                }
                Seam { // the panels of the hood
                    strokeWidth: 4
                    strokeColor: Qt.rgba(0.1, 0.31, 0.35, 0.45)
                    PathSvg { path: "M 132 86 C 94 152 98 262 138 331 M 268 86 C 306 152 302 262 262 331" }
                }
                Seam { // from the crown to the nape
                    strokeWidth: 6
                    PathSvg { path: "M 200 69 V 339" }
                }
            }
            AvatarEar { side: -1; x: 44; y: 22; rotation: -50; turned: true }
            AvatarEar { side: 1; x: 276; y: 22; rotation: 40; turned: true }
        }
    }
}
