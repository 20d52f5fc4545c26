// How something is, told by shape and colour: a tick, a dash for what is not in use, a disc for what is under way, or a
// triangle for what is not well or to be done.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes
import ".."

Item {
    id: mark

    required property bool well
    property bool idle: false
    property bool running: false
    readonly property real stroke: 0.16 * grown * size
    // What it says to those who cannot see it, where no words beside it do.
    property string words: ""
    property real size: Theme.dense
    // How much larger it is than a capital.
    property real grown: 1
    property color tone: !well ? Theme.deepAmber : idle ? Theme.faintInk : Theme.sea
    // About as high as a capital, and level with those of the words beside it: drawn, for a letter may come from another font.
    readonly property real side: Math.round(0.74 * grown * size)
    readonly property real above: Math.round(letters.ascent - 0.36 * size - side / 2)

    width: grown * size
    height: letters.height
    Accessible.ignored: words === ""
    Accessible.role: Accessible.Graphic
    Accessible.name: words

    FontMetrics {
        id: letters
        font.pixelSize: mark.size
    }
    Rectangle {
        visible: mark.well && (mark.idle || mark.running)
        y: mark.above + (mark.side - height) / 2
        width: mark.side
        height: mark.running ? mark.side : mark.stroke
        radius: height / 2
        color: mark.tone
    }
    Shape {
        visible: mark.well && !mark.idle && !mark.running
        y: mark.above
        width: mark.side
        height: mark.side
        ShapePath {
            fillColor: "transparent"
            strokeColor: mark.tone
            strokeWidth: mark.stroke
            capStyle: ShapePath.RoundCap
            joinStyle: ShapePath.RoundJoin
            PathPolyline { path: [Qt.point(0.08 * mark.side, 0.55 * mark.side), Qt.point(0.38 * mark.side, 0.86 * mark.side), Qt.point(0.95 * mark.side, 0.16 * mark.side)] }
        }
    }
    Shape {
        visible: !mark.well
        y: mark.above
        width: mark.side
        height: mark.side
        ShapePath {
            fillColor: mark.tone
            strokeWidth: -1
            PathPolyline { path: [Qt.point(0, mark.side), Qt.point(mark.side / 2, 0), Qt.point(mark.side, mark.side)] }
        }
    }
}
