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
    // Whether the line is what matters most, and is then as large as a title.
    property bool lineFirst: false
    // What is to be noted down, large on a line of its own; empty for none.
    property string code: ""
    // The lines of a drawing above the title, on a square of 24; empty for none.
    property string sign: ""
    // Where the face of the one who asks is, at which the card then stands; null where there is none.
    property WindowLayout windowLayout: null
    // Where that face begins below the card, which then is what it says; 0 where there is none.
    readonly property real speaker: windowLayout?.faceBelow ?? 0
    // Where its middle is beside the card; 0 where it is not.
    readonly property real beside: windowLayout?.faceBeside ?? 0
    readonly property bool atLeft: windowLayout?.boardOnRight ?? false
    // The edge of its place, which the card reaches.
    readonly property real bound: windowLayout?.helperEdge ?? 0
    // Where the middle of the card is at no face.
    property point middle: Qt.point(width / 2, (windowLayout?.room ?? height) / 2)
    readonly property bool large: speaker > 0 || beside > 0 && Theme.textSize <= 1.15
    // Whether there is so much height above a face that words and drawing can be larger.
    readonly property bool roomy: speaker > 0.65 * height && Theme.textSize <= 1
    readonly property real tail: speaker > 0 ? 34 * Theme.unit : 0
    // How high it is at least, and how wide where a face is beside it, or where none is.
    property real least: 0
    readonly property real broadest: 1214 * Theme.unit
    readonly property real broad: 900 * Theme.unit
    // How much of what is below is covered; a card that covers most of it hides the remains as well.
    readonly property real veil: speaker > 0 || beside > 0 ? 1 : 0.94
    // What lies there face down instead of a drawing; empty for none.
    property url cardBack: ""
    property url cardShadow: ""
    readonly property bool lies: String(cardBack) !== ""
    // Whether they lie on the page above the card, and not on it.
    readonly property bool spread: lies && roomy && card.y > 600 * Theme.unit
    // What there is to choose: the name of each, its words, and whether it is quiet. The first has the keyboard.
    property var choices: []
    signal chosen(string name)
    // How long it stays, in ms; 0 where that is not known. The seconds that are left then stand in place of the
    // drawing, with their unit below, and a ring around them empties in small steps.
    property int lasts: 0
    property string second: ""
    readonly property int steps: 40
    property int msLeft: 0
    readonly property int secondsLeft: Math.ceil(msLeft / 1000)
    // Where nothing moves, the ring stays whole.
    readonly property int stepsLeft: Theme.motion === 0 ? steps : Math.ceil(steps * msLeft / Math.max(1, lasts))
    readonly property real badge: (lasts > 0 ? (roomy ? 360 : speaker > 0 ? 220 : 200) : roomy ? 190 : large ? 150 : 112) * Theme.unit
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

    // A card that is not turned meanwhile, at its place in a row of so many.
    component Lying: Item {
        id: lying
        required property int index
        property int many: 3
        required property real slot
        readonly property real place: index - (many - 1) / 2
        width: Math.round(slot)
        height: 1.08 * width
        CardFace {
            y: 0.08 * lying.place * lying.place * width
            width: lying.width
            height: width
            rotation: 6 * lying.place
            back: calm.cardBack
            shadow: calm.cardShadow
            picture: ""
            up: false
        }
    }

    // Whatever lies below cannot be reached, and steps back.
    Rectangle {
        anchors.fill: parent
        color: Theme.paper
        opacity: calm.veil
        MouseArea { anchors.fill: parent; hoverEnabled: true; preventStealing: true; Accessible.ignored: true }
    }

    Column {
        anchors.horizontalCenter: parent.horizontalCenter
        y: (card.y - height) / 2
        visible: calm.spread
        spacing: 1.5 * Theme.gap
        Repeater {
            model: calm.spread ? [3, 2] : []
            Row {
                id: row
                required property int modelData
                anchors.horizontalCenter: parent?.horizontalCenter
                spacing: 1.5 * Theme.gap
                Repeater {
                    model: row.modelData
                    Lying {
                        many: row.modelData
                        slot: Math.min(270 * Theme.unit, 0.36 * card.y)
                    }
                }
            }
        }
    }
    Rectangle {
        id: card
        x: Math.round(calm.beside === 0 ? calm.middle.x - width / 2 : calm.atLeft ? calm.bound - 6 * Theme.unit : calm.bound + 6 * Theme.unit - width)
        y: Math.round(calm.speaker > 0 ? Math.max(2 * Theme.gap, calm.speaker - height - calm.tail - 0.5 * Theme.gap)
           : Math.max(Math.min(Theme.gap, (parent.height - height) / 2), Math.min(calm.middle.y - height / 2, parent.height - height - Theme.gap)))
        // As wide as an upright page and what the helper says below it.
        width: calm.speaker > 0 ? parent.width - 4 * Theme.gap : calm.beside > 0 ? calm.broadest : Math.min(parent.width - 4 * Theme.gap, calm.broad)
        height: Math.max(calm.least, content.height + 5 * Theme.gap)
        radius: Theme.radius
        color: Theme.white
        border { color: Theme.sea; width: 4 * Theme.unit }
        Column {
            id: content
            anchors.centerIn: parent
            width: parent.width - 4 * Theme.gap
            spacing: (calm.roomy || calm.large && flow.alone ? 2 : 1.5) * Theme.gap
            Row {
                anchors.horizontalCenter: parent.horizontalCenter
                visible: calm.lies && !calm.spread
                topPadding: 0.5 * Theme.gap
                bottomPadding: 0.5 * Theme.gap
                spacing: 1.2 * Theme.gap
                Repeater {
                    model: calm.lies && !calm.spread ? 3 : 0
                    Lying { slot: (calm.beside > 0 && calm.large ? 240 : calm.large ? 200 : 130) * Theme.unit }
                }
            }
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
                    scale: (calm.roomy ? 4.2 : calm.large ? 3.4 : 2.6) * Theme.unit
                    path: calm.sign
                    ink: Theme.ink
                    thick: 2.2
                }
            }
            Balanced {
                width: parent.width
                text: calm.title
                font { pixelSize: calm.lineFirst ? calm.lineSize : calm.titleSize; bold: true }
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
                font { pixelSize: calm.lineFirst ? calm.titleSize : calm.lineSize; bold: calm.lineFirst }
                color: calm.lineFirst ? Theme.sea : Theme.faintInk
                horizontalAlignment: Text.AlignHCenter
            }
            // Apart from what can be pressed, and nothing around it: it is no button.
            Item {
                visible: calm.code !== ""
                width: parent.width
                height: noted.height + (calm.roomy ? 0.5 : 1) * Theme.gap
                PlainText {
                    id: noted
                    objectName: "noted"
                    width: parent.width
                    visible: text !== ""
                    text: calm.code
                    font { pixelSize: calm.roomy ? Theme.size(84) : calm.large ? Theme.size(72) : Theme.figure; bold: true; letterSpacing: 4 * Theme.unit }
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
                // All there is to do, perhaps in a hurry, is as wide as the card.
                readonly property bool alone: calm.choices.length === 1
                readonly property bool pair: buttons.count === 2 && widest <= half
                // How many there are by now: the count changes before they are made, and their widths would then be missed.
                property int made: 0
                readonly property real widest: {
                    let most = 0
                    for (let i = 0; i < made; i++)
                        most = Math.max(most, (buttons.itemAt(i) as BigButton)?.wish ?? 0)
                    return most
                }
                readonly property real needed: {
                    let sum = 0
                    for (let i = 0; i < made; i++)
                        sum += (buttons.itemAt(i) as BigButton)?.width ?? 0
                    return sum + (made - 1) * spacing
                }
                anchors.horizontalCenter: parent.horizontalCenter
                topPadding: alone && calm.large ? Theme.gap : 0
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
                        width: flow.alone ? most : flow.pair ? Math.floor(flow.half) : Math.min(wish, most)
                        font.pixelSize: Theme.size(flow.alone ? 50 : calm.roomy ? 40 : 36)
                        verticalPadding: (flow.alone ? 36 : 30) * Theme.unit
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
