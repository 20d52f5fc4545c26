// A drawing on a round ground, by its name.
import QtQuick
import QtQuick.Shapes
import "."

Rectangle {
    id: mark

    required property string sign
    // How thick its lines are, and how wide the ground is, as the drawing measures them.
    property real thick: 2
    property real reach: 35

    // On a square of 24.
    readonly property var drawings: ({
        helper: "M6 11 A6 6 0 0 1 18 11 V14 A6 6 0 0 1 6 14 Z M9.7 11.5 H9.8 M14.2 11.5 H14.3 M9.7 15 C11 16.3 13 16.3 14.3 15 M12 5 V2.5",
        cards: "M5 3.5 H12.5 Q14 3.5 14 5 V14.5 Q14 16 12.5 16 H5 Q3.5 16 3.5 14.5 V5 Q3.5 3.5 5 3.5 Z "
            + "M17.5 8 H19 Q20.5 8 20.5 9.5 V19 Q20.5 20.5 19 20.5 H11.5 Q10 20.5 10 19.3",
        person: "M12 4 A3.6 3.6 0 0 1 12 11.2 A3.6 3.6 0 0 1 12 4 M4.8 20.5 C5.3 16.3 8.5 14.4 12 14.4 C15.5 14.4 18.7 16.3 19.2 20.5",
        clock: "M12 3 A9 9 0 0 1 12 21 A9 9 0 0 1 12 3 M12 7.5 V12 L15 14",
        questions: "M4 4.5 H20 V16 H12.5 L8 20.5 V16 H4 Z M8.5 10.2 H8.6 M12 10.2 H12.1 M15.5 10.2 H15.6",
        no_name: "M12 4.5 A3.3 3.3 0 0 1 12 11.1 A3.3 3.3 0 0 1 12 4.5 M5.5 20 C6 16 9 14.2 12 14.2 C15 14.2 18 16 18.5 20 M3.5 3.5 L20.5 20.5",
        delete: "M4.5 7 H19.5 M9.5 7 V4 H14.5 V7 M6.8 7 L7.6 20.5 H16.4 L17.2 7 M10.3 10.5 V17 M13.7 10.5 V17",
        leave: "M12.5 4 H4.5 V20 H12.5 M9.5 12 H21 M16.5 7.5 L21 12 L16.5 16.5",
        play: "M8 4.5 L19.5 12 L8 19.5 Z",
        lock: "M5.5 11 H18.5 V20.5 H5.5 Z M8.5 11 V7.5 A3.5 3.5 0 0 1 15.5 7.5 V11 M12 15 V16.5",
        compare: "M3.5 6 H10 V18 H3.5 Z M14 6 H20.5 V18 H14 Z M12 3 V21",
        eye: "M2.5 12 C6 5.5 18 5.5 21.5 12 C18 18.5 6 18.5 2.5 12 Z M12 9.4 A2.6 2.6 0 0 1 12 14.6 A2.6 2.6 0 0 1 12 9.4",
        // An eye over two cards, and a die with five on it.
        seen: "M2.5 8 C6 2.5 18 2.5 21.5 8 C18 13.5 6 13.5 2.5 8 Z M12 6 A2 2 0 0 1 12 10 A2 2 0 0 1 12 6 "
            + "M5 16 H10.5 V22 H5 Z M13.5 16 H19 V22 H13.5 Z",
        chance: "M6 3.5 H18 Q20.5 3.5 20.5 6 V18 Q20.5 20.5 18 20.5 H6 Q3.5 20.5 3.5 18 V6 Q3.5 3.5 6 3.5 Z "
            + "M8 8 H8.1 M16 8 H16.1 M12 12 H12.1 M8 16 H8.1 M16 16 H16.1",
        letter: "M3.5 6 H20.5 V18 H3.5 Z M4 6.5 L12 13 L20 6.5",
        camera: "M3.5 8 H8 L9.5 5 H14.5 L16 8 H20.5 V19 H3.5 Z M12 10 A3.4 3.4 0 0 1 12 16.8 A3.4 3.4 0 0 1 12 10"
    })
    height: width
    radius: width / 2
    color: Theme.sand
    ClippedShape {
        anchors.centerIn: parent
        width: 24
        height: 24
        scale: mark.width / mark.reach
        ShapePath {
            strokeColor: Theme.sea
            strokeWidth: mark.thick
            capStyle: ShapePath.RoundCap
            joinStyle: ShapePath.RoundJoin
            fillColor: "transparent"
            PathSvg { path: mark.drawings[mark.sign] ?? "" }
        }
    }
}
