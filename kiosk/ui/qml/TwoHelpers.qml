// The two versions of the help as a picture: one helper looks at which cards were seen, the other throws a die.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Row {
    id: pair

    required property real room     // the height that there is
    readonly property real side: Math.min((width - spacing) / 2, room)

    spacing: Theme.gap
    Accessible.ignored: true

    Repeater {
        model: [
            // An eye over two cards.
            "M2.5 8 C6 2.5 18 2.5 21.5 8 C18 13.5 6 13.5 2.5 8 Z M12 6 A2 2 0 0 1 12 10 A2 2 0 0 1 12 6 "
                + "M5 16 H10.5 V22 H5 Z M13.5 16 H19 V22 H13.5 Z",
            // A die with five on it.
            "M6 3.5 H18 Q20.5 3.5 20.5 6 V18 Q20.5 20.5 18 20.5 H6 Q3.5 20.5 3.5 18 V6 Q3.5 3.5 6 3.5 Z "
                + "M8 8 H8.1 M16 8 H16.1 M12 12 H12.1 M8 16 H8.1 M16 16 H16.1"
        ]
        Rectangle {
            id: tile
            required property string modelData
            width: pair.side
            height: pair.room
            radius: Theme.radius
            color: Theme.white
            border { color: Theme.edge; width: 3 * Theme.unit }
            Rectangle {
                id: thought
                x: tile.width * 0.42
                y: tile.height * 0.09
                width: tile.width * 0.48
                height: width
                radius: width / 2
                color: Theme.sand
                Drawing {
                    anchors.centerIn: parent
                    scale: thought.width * 0.56 / 24
                    path: tile.modelData
                    ink: Theme.ink
                }
            }
            // From who thinks to what is thought.
            Repeater {
                model: [[0.42, 0.53, 0.055], [0.36, 0.6, 0.04]]
                Rectangle {
                    required property var modelData
                    x: tile.width * modelData[0]
                    y: tile.height * modelData[1]
                    width: tile.width * modelData[2]
                    height: width
                    radius: width / 2
                    color: Theme.sand
                }
            }
            Drawing {
                x: tile.width * 0.26 - width / 2
                y: tile.height * 0.76 - height / 2
                scale: tile.width * 0.4 / 24
                path: "M6 11 A6 6 0 0 1 18 11 V14 A6 6 0 0 1 6 14 Z M9.7 11.5 H9.8 M14.2 11.5 H14.3 M9.7 15 C11 16.3 13 16.3 14.3 15 M12 5 V2.5"
                ink: Theme.sea
            }
        }
    }
}
