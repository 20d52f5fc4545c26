// What the visitor did, in pictures: the pairs, and what they took, with one kind sentence.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes
import Recollect
import "."

PageFrame {
    id: view

    required property ResultScreen result
    // Whether pictures are loaded while other things go on.
    property bool prepares: false

    // The pairs in as many rows as the page has room for.
    readonly property int count: result.pictures.length
    readonly property int columns: Math.max(1, Math.ceil(count / (count <= 6 ? 1 : width < height && Theme.textSize <= 1.15 ? 3 : 2)))
    readonly property int rows: Math.ceil(count / columns)
    readonly property real slot: count === 0 ? 0 : Math.floor(Math.min(
        column / columns * (rows > 2 ? 1.02 : 1), (rows > 2 ? 260 : 230) * Theme.unit,
        (room - (lined ? line.implicitHeight + Theme.gap : 0) - board.height - Theme.gap) / rows))
    // Where there are many rows, the pairs have the room of the line above them.
    readonly property bool lined: count > 0 && rows <= 2
    readonly property bool hinted: result.hints !== ""
    // Where there are few, the figures are larger.
    readonly property bool roomy: width > height && Theme.textSize <= 1.15
    // What stands on the page is as far from its title and its way on as its parts are from each other.
    readonly property real spaces: lined ? 2 : count > 0 ? 1 : 0
    readonly property real air: Math.max(Theme.gap, Math.min(3 * Theme.gap, (room + Theme.gap - parts.solid - (lined ? led : -Theme.gap)) / (spaces + (lined ? 1 : 2))))
    // Where the line begins: it belongs to the title.
    readonly property real led: -0.6 * Theme.gap
    // Stands up when the screen comes, one pair after another.
    property real shown: visible ? 1 : 0
    Behavior on shown { enabled: view.visible; NumberAnimation { duration: 5 * Theme.motion; easing.type: Easing.OutQuad } }

    component Sign: Shape {
        width: 64 * Theme.unit
        height: 64 * Theme.unit
        antialiasing: true
        transform: Scale { xScale: Theme.unit; yScale: Theme.unit }
    }
    component Stroke: ShapePath {
        strokeColor: Theme.sea
        strokeWidth: 5
        fillColor: "transparent"
        capStyle: ShapePath.RoundCap
        joinStyle: ShapePath.RoundJoin
    }
    component Figure: Column {
        id: figure
        property string value
        property string label
        default property alias sign: corner.data
        // The same for those who hear it.
        property string spoken: value
        readonly property real wish: Math.max(figured.width, caption.implicitWidth)
        spacing: 0.2 * Theme.gap
        width: Math.min(figures.even > 0 ? figures.even : wish + figures.spare, figures.room)
        Row {
            id: figured
            anchors.horizontalCenter: parent.horizontalCenter
            spacing: 0.5 * Theme.gap
            Item {
                id: corner
                anchors.verticalCenter: parent.verticalCenter
                width: 64 * Theme.unit
                height: 64 * Theme.unit
            }
            PlainText {
                anchors.verticalCenter: parent.verticalCenter
                text: figure.value
                font { pixelSize: view.roomy ? Theme.size(60) : Theme.textSize <= 1.15 ? Theme.size(52) : Theme.heading; bold: true }
                color: Theme.sea
                Accessible.ignored: true
            }
        }
        PlainText {
            id: caption
            width: figure.width
            text: figure.label
            horizontalAlignment: Text.AlignHCenter
            wrapMode: Text.Wrap
            font.pixelSize: Theme.size(Theme.textSize <= 1.15 ? 36 : 28)
            color: Theme.ink
            Accessible.role: Accessible.StaticText
            Accessible.name: text + ": " + figure.spoken
        }
    }

    // As large as the thanks, where it has one line then.
    WordWidths {
        id: wordWidths
    }
    readonly property real titled: wordWidths.slack * wordWidths.bold(title, Theme.highTitle)
    titleSize: titled <= column - cornered ? Theme.highTitle : Math.max(Theme.pageTitle, Math.floor(Theme.highTitle * (column - cornered) / titled))

    title: words["result-title"]
    label: words["result-continue"]
    onWent: result.proceed()
    onVisibleChanged: way.focus = true

    Column {
        id: parts
        // How high its parts are, without what is between them.
        readonly property real solid: (view.lined ? line.implicitHeight : 0) + (shelf.visible ? shelf.height : 0) + board.height
        y: view.lined ? view.led : view.air - Theme.gap
        width: parent?.width ?? 0
        spacing: view.air

        Balanced {
            id: line
            width: parent.width
            visible: view.lined
            text: view.words["result-line"]
            font.pixelSize: Theme.size(40)
            horizontalAlignment: Text.AlignLeft
            wrapMode: Text.Wrap
            color: Theme.ink
        }
        Item {
            id: shelf
            // What is around a tile within its place. The first and the last of a row stand at the edges of the figures below
            // them, where little is missing.
            readonly property real inset: 0.04 * view.slot
            readonly property real wish: ((parent?.width ?? 0) + 2 * inset - view.slot) / Math.max(1, view.columns - 1)
            readonly property real pitch: wish > view.slot && wish < 1.08 * view.slot ? wish : view.slot
            x: view.rows > 2 && pitch !== wish ? (parent.width - width) / 2 : Theme.across(-inset, width, parent.width)
            visible: view.slot > 70 * Theme.unit
            width: pitch * (view.columns - 1) + view.slot
            height: view.slot * view.rows - 2 * inset
            Repeater {
                model: view.result.pictures
                Item {
                    id: pair
                    required property int index
                    required property string modelData
                    // Each has its share of the time, from left to right.
                    readonly property real come: Math.max(0, Math.min(1, view.shown * (view.count + 3) / 3 - index / 3))
                    x: Theme.across(index % view.columns * shelf.pitch, width, shelf.width)
                    y: Math.floor(index / view.columns) * view.slot - shelf.inset
                    width: view.slot
                    height: view.slot
                    visible: come > 0
                    scale: 0.7 + 0.3 * come
                    Rectangle {
                        anchors { fill: parent; margins: parent.width * 0.04 }
                        radius: width * 0.14
                        color: Theme.leaf
                    }
                    // Two cards, one on the other: of the lower one, which lies askew, only the corners are seen.
                    Rectangle {
                        anchors.centerIn: parent
                        width: 0.95 * picture.width
                        height: width
                        radius: 0.11 * picture.width
                        rotation: -6
                        color: Theme.white
                        border { color: Theme.slot; width: 2 * Theme.unit }
                    }
                    Image {
                        id: picture
                        anchors.centerIn: parent
                        width: Math.floor(pair.width * 0.85)
                        height: width
                        asynchronous: view.prepares
                        source: Qt.resolvedUrl(pair.modelData)
                        sourceSize: Qt.size(width, height)
                    }
                }
            }
        }
        Rectangle {
            id: board
            width: parent.width
            height: figures.height + 1.6 * Theme.gap
            radius: Theme.radius
            color: Theme.white
            border.color: Theme.edge
            border.width: 3 * Theme.unit
            Grid {
                id: figures
                // All in one row; or where that is too narrow, two and two.
                readonly property int shown: view.hinted ? 4 : 3
                readonly property real wish: pairs.wish + moves.wish + time.wish + (view.hinted ? hints.wish : 0)
                readonly property real widest: Math.max(pairs.wish + moves.wish, time.wish + (view.hinted ? hints.wish : 0))
                readonly property real room: board.width - Theme.gap
                // As wide as each other, where the widest has room in that.
                readonly property real share: room / columns
                readonly property real even: Math.max(pairs.wish, moves.wish, time.wish, hints.visible ? hints.wish : 0) + 0.5 * Theme.gap <= share ? share : 0
                readonly property real spare: Math.max(0, columns === shown ? (room - wish) / shown : (room - widest) / 2)
                anchors.centerIn: parent
                columns: wish + shown * Theme.gap <= room ? shown : 2
                rowSpacing: 0.5 * Theme.gap
                horizontalItemAlignment: Grid.AlignHCenter
                Figure {
                    id: pairs
                    value: view.result.pairs
                    label: view.words["result-pairs-label"]
                    Sign { // two cards, one behind the other
                        Stroke { PathRectangle { x: 8; y: 6; width: 34; height: 42; radius: 7 } }
                        Stroke { fillColor: Theme.amber; PathRectangle { x: 22; y: 16; width: 34; height: 42; radius: 7 } }
                    }
                }
                Figure {
                    id: moves
                    value: view.result.moves
                    label: view.words["result-moves-label"]
                    Sign { // a card that is turned over
                        Stroke { PathRectangle { x: 17; y: 20; width: 30; height: 38; radius: 7 } }
                        Stroke { PathSvg { path: "M 10 22 A 24 16 0 0 1 54 18 M 54 18 L 43 16 M 54 18 L 56 7" } }
                    }
                }
                Figure {
                    id: time
                    value: view.result.clock
                    spoken: view.result.time
                    label: view.words["result-time-label"]
                    Sign { // a clock
                        Stroke { PathAngleArc { centerX: 32; centerY: 34; radiusX: 25; radiusY: 25; sweepAngle: 360 } }
                        Stroke { PathSvg { path: "M 32 19 V 34 L 42 40 M 26 4 H 38" } }
                    }
                }
                Figure {
                    id: hints
                    visible: view.hinted
                    value: view.result.hints
                    label: view.words["result-hints-label"]
                    Sign { // a bubble with three dots
                        Stroke { PathSvg { path: "M 16 8 H 48 Q 58 8 58 18 V 34 Q 58 44 48 44 H 34 L 22 57 V 44 H 16 Q 6 44 6 34 V 18 Q 6 8 16 8 Z" } }
                        Stroke { strokeWidth: 7; PathSvg { path: "M 20 26 H 20.1 M 32 26 H 32.1 M 44 26 H 44.1" } }
                    }
                }
            }
        }
    }
}
