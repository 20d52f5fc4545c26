// One card, turned over its upright axis: it narrows to its edge, lifts a little, and shows its other side.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Item {
    id: card

    required property url back
    required property url shadow
    required property url picture
    required property bool up
    // How much of the shadow is seen: a card that lies flat has none.
    property real shade: 1
    // How thick the rim around an open card is, and how much of it is seen.
    property real rimmed: 4 * Theme.unit
    property real rimShown: 0
    // Whether a picture that is wanted in another size is loaded beside other things; the old one is seen until then.
    property bool prepares: false

    // The width that its pictures are drawn for. A card is a square: a change of both sides would load each of them twice.
    property real drawn: width
    // 0 closed .. 1 open; the side changes half way.
    property real turn: up ? 1 : 0
    Behavior on turn { NumberAnimation { duration: Theme.motion * 1.5; easing.type: Easing.InOutSine } }

    component Side: Image {
        property bool loaded: false
        onStatusChanged: if (status === Image.Ready) loaded = true
        asynchronous: loaded && card.prepares
        retainWhileLoading: true
    }

    // How wide the card is seen, and how far it has left the table.
    readonly property real narrow: Math.max(0.015, Math.abs(Math.cos(turn * Math.PI)))
    readonly property real lift: Math.sin(turn * Math.PI)
    readonly property real rim: lift * width * 0.05
    // Towards the end of a turn the sides of a card lie left of its rim, before it right.
    readonly property real lean: turn < 0.5 ? rim / 2 : -rim / 2

    scale: 1 + 0.07 * lift

    Side {
        anchors { centerIn: parent; verticalCenterOffset: card.height * 0.05 * card.lift }
        width: parent.width * 1.1
        height: parent.height * 1.1
        opacity: card.shade * (1 - 0.4 * card.lift)
        source: card.shadow
        sourceSize: Qt.size(1.1 * card.drawn, 1.1 * card.drawn)
        transform: Scale {
            origin.x: card.width * 0.55
            xScale: card.narrow
        }
    }
    // The cut edge, as thick as the cardboard.
    Rectangle {
        visible: card.lift > 0.01
        anchors.centerIn: parent
        width: card.width * 0.95 * card.narrow + card.rim
        height: card.height * 0.95
        radius: Math.min(width / 2, card.width * 0.1)
        color: "#D3BE90"
        border { color: "#B79F6B"; width: 1 }
    }
    // Both sides are there from the start, so that no turn waits for a picture.
    Side {
        anchors.fill: parent
        visible: card.turn < 0.5
        source: card.back
        sourceSize: Qt.size(card.drawn, card.drawn)
        transform: [
            Scale { origin.x: card.width / 2; xScale: card.narrow },
            Translate { x: card.lean }
        ]
    }
    Side {
        anchors.fill: parent
        visible: card.turn >= 0.5
        source: card.picture
        sourceSize: Qt.size(card.drawn, card.drawn)
        transform: [
            Scale { origin.x: card.width / 2; xScale: card.narrow },
            Translate { x: card.lean }
        ]
        // Pictures are mostly as light as the page: the rim ends where a closed card ends, and turns with the picture.
        Rectangle {
            objectName: "rim"
            anchors { fill: parent; margins: 0.019 * card.width }
            visible: card.rimShown > 0
            radius: 0.115 * card.width
            color: "transparent"
            border { color: Theme.faintInk; width: card.rimmed }
            opacity: card.rimShown
        }
    }
    // What turns away from the light gets darker.
    Rectangle {
        visible: card.lift > 0.01
        anchors { centerIn: parent; horizontalCenterOffset: card.lean }
        width: card.width * 0.95 * card.narrow
        height: card.height * 0.95
        radius: Math.min(width / 2, card.width * 0.1)
        color: "#1B2A33"
        opacity: 0.28 * card.lift
    }
}
