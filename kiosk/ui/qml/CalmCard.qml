// A calm word over everything: a title, a line, and perhaps something to choose.
pragma ComponentBehavior: Bound
import QtQuick
import QtQuick.Shapes
import "."

FocusScope {
    id: calm

    required property string title
    property string line: ""
    property real titleSize: Theme.figure
    property real lineSize: Theme.body
    // What is to be noted down, large on a line of its own; empty for none.
    property string code: ""
    // The lines of a drawing above the title, on a square of 24; empty for none.
    property string sign: ""
    property real thick: 2.2
    // Where the middle of the card is.
    property point middle: Qt.point(width / 2, height / 2)
    // Where the face of the one who asks begins, below the card, which then is what it says; 0 where there is no face.
    property real speaker: 0
    // Where the middle of that face is, where it is beside the card; 0 where it is not.
    property real beside: 0
    property bool atLeft: false
    readonly property bool large: speaker > 0 || beside > 0 && Theme.textSize <= 1.15
    readonly property real tail: speaker > 0 ? 34 * Theme.unit : 0
    // How high it is at least, and how wide where a face is beside it.
    property real least: 0
    property real broadest: 1100 * Theme.unit
    // How much of what is below is covered; a card that covers most of it hides the remains as well.
    property real veil: 0.94
    // What there is to choose: the name of each, its words, and whether it is quiet. The first has the keyboard.
    property var choices: []
    signal chosen(string name)
    // How long it stays, in ms; 0 where that is not known. The seconds that are left then stand in place of the
    // drawing, with their unit below, and a ring around them empties in small steps.
    property int lasts: 0
    property string second: ""
    // Whether a ring around the drawing swells and shrinks slowly, as a sign that all is well.
    property bool breathes: false
    readonly property int steps: 40
    property int msLeft: 0
    readonly property int secondsLeft: Math.ceil(msLeft / 1000)
    // Where nothing moves, the ring stays whole.
    readonly property int stepsLeft: Theme.motion === 0 ? steps : Math.ceil(steps * msLeft / Math.max(1, lasts))
    readonly property real badge: (lasts > 0 ? (speaker > 0 ? 220 : 190) : large ? 150 : 112) * Theme.unit
    onLastsChanged: {
        emptying.stop()
        msLeft = lasts
        emptying.duration = lasts
        if (lasts > 0)
            emptying.start()
    }
    // It tells the time, so the seconds go on where nothing else moves.
    NumberAnimation {
        id: emptying
        target: calm
        property: "msLeft"
        to: 0
        duration: 0
    }

    onVisibleChanged: if (visible && buttons.count > 0) buttons.itemAt(0).focus = true

    // Whatever lies below cannot be reached, and steps back.
    Rectangle {
        anchors.fill: parent
        color: Theme.paper
        opacity: calm.veil
        MouseArea { anchors.fill: parent; hoverEnabled: true; preventStealing: true; Accessible.ignored: true }
    }

    Rectangle {
        id: card
        x: Math.round(calm.middle.x - width / 2)
        y: Math.round(calm.speaker > 0 ? Math.max(2 * Theme.gap, calm.speaker - height - calm.tail - 0.5 * Theme.gap)
           : Math.max(Math.min(Theme.gap, (parent.height - height) / 2), Math.min(calm.middle.y - height / 2, parent.height - height - Theme.gap)))
        // As wide as an upright page and what the helper says below it.
        width: calm.speaker > 0 ? parent.width - 4 * Theme.gap : calm.beside > 0 ? calm.broadest : Math.min(parent.width - 4 * Theme.gap, 900 * Theme.unit)
        height: Math.max(calm.least, content.height + 5 * Theme.gap)
        radius: Theme.radius
        color: Theme.white
        border { color: Theme.sea; width: 4 * Theme.unit }
        Column {
            id: content
            anchors.centerIn: parent
            width: parent.width - 4 * Theme.gap
            spacing: 1.5 * Theme.gap
            Rectangle {
                anchors.horizontalCenter: parent.horizontalCenter
                visible: calm.sign !== "" || calm.lasts > 0
                width: calm.badge
                height: width
                radius: width / 2
                color: Theme.sand
                Shape {
                    id: ring
                    objectName: "time-left"
                    readonly property real far: parent.width / 2 + 10 * Theme.unit
                    anchors.centerIn: parent
                    visible: calm.lasts > 0
                    width: 2 * far
                    height: 2 * far
                    antialiasing: true
                    ShapePath {
                        strokeColor: Theme.sea
                        strokeWidth: 8 * Theme.unit
                        capStyle: ShapePath.FlatCap
                        fillColor: "transparent"
                        PathAngleArc {
                            centerX: ring.far
                            centerY: ring.far
                            radiusX: ring.far
                            radiusY: ring.far
                            startAngle: -90
                            sweepAngle: 360 * calm.stepsLeft / calm.steps
                        }
                    }
                }
                Rectangle {
                    id: breath
                    anchors.centerIn: parent
                    visible: calm.breathes
                    width: parent.width + 20 * Theme.unit
                    height: width
                    radius: width / 2
                    color: "transparent"
                    border { color: Theme.sand; width: 6 * Theme.unit }
                    SequentialAnimation on scale {
                        running: calm.breathes && calm.visible && Theme.motion > 0
                        loops: Animation.Infinite
                        NumberAnimation { from: 1; to: 1.16; duration: 8 * Theme.motion; easing.type: Easing.InOutSine }
                        NumberAnimation { from: 1.16; to: 1; duration: 8 * Theme.motion; easing.type: Easing.InOutSine }
                    }
                }
                // Read by the eye alone: a screen reader would speak every second.
                PlainText {
                    objectName: "seconds-left"
                    anchors { centerIn: parent; verticalCenterOffset: -0.1 * calm.badge }
                    visible: calm.lasts > 0
                    width: 0.8 * parent.width
                    text: calm.secondsLeft
                    font { pixelSize: 0.46 * calm.badge; bold: true }
                    fontSizeMode: Text.HorizontalFit
                    minimumPixelSize: Theme.body
                    horizontalAlignment: Text.AlignHCenter
                    color: Theme.ink
                    Accessible.ignored: true
                }
                PlainText {
                    objectName: "seconds-unit"
                    anchors { centerIn: parent; verticalCenterOffset: 0.26 * calm.badge }
                    visible: calm.lasts > 0
                    width: 0.66 * parent.width
                    text: calm.second
                    font.pixelSize: Math.max(24 * Theme.unit, 0.16 * calm.badge)
                    horizontalAlignment: Text.AlignHCenter
                    color: Theme.ink
                    Accessible.ignored: true
                }
                Drawing {
                    anchors.centerIn: parent
                    visible: calm.lasts === 0
                    scale: (calm.large ? 3.4 : 2.6) * Theme.unit
                    path: calm.sign
                    ink: Theme.ink
                    thick: calm.thick
                }
            }
            Balanced {
                width: parent.width
                text: calm.title
                font { pixelSize: calm.titleSize; bold: true }
                color: Theme.ink
                Accessible.role: Accessible.AlertMessage
                Accessible.name: text
                horizontalAlignment: Text.AlignHCenter
            }
            Balanced {
                anchors.horizontalCenter: parent.horizontalCenter
                // Its lines do not reach as far as the buttons.
                width: parent.width - (calm.code !== "" && calm.speaker > 0 && Theme.textSize <= 1.15 ? 4 : 0) * Theme.gap
                visible: text !== ""
                text: calm.line
                font.pixelSize: calm.lineSize
                color: Theme.faintInk
                horizontalAlignment: Text.AlignHCenter
            }
            // As if on a slip of paper: it is to be taken along.
            Rectangle {
                visible: calm.code !== ""
                width: parent.width
                height: noted.height + 0.8 * Theme.gap
                radius: Theme.radius
                color: Theme.shelf
                border { color: Theme.edge; width: 3 * Theme.unit }
                PlainText {
                    id: noted
                    objectName: "noted"
                    anchors { left: parent.left; right: parent.right; margins: Theme.gap; verticalCenter: parent.verticalCenter }
                    visible: text !== ""
                    text: calm.code
                    font { pixelSize: Theme.figure; bold: true; letterSpacing: 4 * Theme.unit }
                    fontSizeMode: Text.HorizontalFit
                    minimumPixelSize: Theme.body
                    color: Theme.sea
                    horizontalAlignment: Text.AlignHCenter
                }
            }
            Flow {
                id: flow
                // Two that fit beside each other are as wide, and far apart. The first is where the way on is on a page.
                layoutDirection: pair && !Theme.mirrored ? Qt.RightToLeft : Qt.LeftToRight
                readonly property real half: (content.width - spacing) / 2
                readonly property bool pair: buttons.count === 2 && widest <= half
                // How many there are by now: the count changes before they are made, and their widths would then be missed.
                property int made: 0
                readonly property real widest: {
                    let most = 0
                    for (let i = 0; i < made; i++)
                        most = Math.max(most, (buttons.itemAt(i) as BigButton)?.implicitWidth ?? 0)
                    return most
                }
                readonly property real needed: {
                    let sum = 0
                    for (let i = 0; i < made; i++)
                        sum += (buttons.itemAt(i) as BigButton)?.width ?? 0
                    return sum + (made - 1) * spacing
                }
                anchors.horizontalCenter: parent.horizontalCenter
                width: Math.min(content.width, Math.ceil(needed))
                spacing: (buttons.count === 2 ? 2 : 1) * Theme.gap
                visible: calm.choices.length > 0
                Repeater {
                    id: buttons
                    model: calm.choices
                    onItemAdded: flow.made++
                    onItemRemoved: flow.made--
                    BigButton {
                        required property var modelData
                        objectName: modelData.name
                        most: content.width
                        width: flow.pair ? Math.floor(flow.half) : Math.min(implicitWidth, most)
                        font.pixelSize: Theme.size(36)
                        verticalPadding: 30 * Theme.unit
                        words: modelData.words
                        quiet: modelData.quiet ?? false
                        onClicked: calm.chosen(modelData.name)
                    }
                }
            }
        }
    }
    SpeechTail {
        visible: calm.beside > 0
        rotation: calm.atLeft ? 90 : -90
        x: calm.atLeft ? card.x - 14 * Theme.unit - width / 2 : card.x + card.width + 14 * Theme.unit - width / 2
        y: Math.max(card.y + 80 * Theme.unit, Math.min(calm.beside, card.y + card.height - 80 * Theme.unit)) - height / 2
    }
    SpeechTail {
        visible: calm.tail > 0
        anchors { top: card.bottom; topMargin: -5 * Theme.unit; horizontalCenter: card.horizontalCenter }
    }
}
