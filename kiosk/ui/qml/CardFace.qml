// One card as a picture: its back or its face, turned by squeezing its width, which looks like a turn at half the cost.
import QtQuick
import "."

Item {
    id: card

    required property url back
    required property url shadow
    required property url picture
    required property bool up

    // 0 closed .. 1 open; the side changes half way.
    property real turn: up ? 1 : 0
    Behavior on turn { NumberAnimation { duration: Theme.motion; easing.type: Easing.InOutQuad } }

    Image {
        anchors.centerIn: parent
        width: parent.width * 1.1
        height: parent.height * 1.1
        source: card.shadow
        sourceSize: Qt.size(width, height)
    }
    Image {
        anchors.fill: parent
        source: card.turn < 0.5 ? card.back : card.picture
        sourceSize: Qt.size(width, height)
        transform: Scale {
            origin.x: card.width / 2
            xScale: Math.max(0.02, Math.abs(1 - 2 * card.turn))
        }
    }
}
