// A pair was found: sparks around both cards, then a copy of each flies to its place in the tray.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Item {
    id: joy

    // Between which places, how large a card is there and there, and what is on it.
    property list<point> from: []
    property point to
    property real cardSize: 0
    property real smallSize: 0
    property url picture

    // Not yet in the tray.
    property bool under: false
    property real spark: 0
    property real flight: 0

    signal landed()

    function celebrate(places: list<point>, goal: point, large: real, small: real, what: url) {
        finish()
        from = places
        to = goal
        cardSize = large
        smallSize = small
        picture = what
        if (Theme.motion === 0) {
            landed()
            return
        }
        under = true
        course.start()
    }
    // What was under way counts as done.
    function finish() {
        course.stop()
        if (under) {
            under = false
            landed()
        }
    }
    function cancel() {
        course.stop()
        under = false
    }

    SequentialAnimation {
        id: course
        PropertyAction { target: joy; properties: "spark,flight"; value: 0 }
        // Until the second card has turned and both have come forward.
        PauseAnimation { duration: Theme.motion * 2 }
        NumberAnimation { target: joy; property: "spark"; to: 1; duration: Theme.motion * 2; easing.type: Easing.OutCubic }
        NumberAnimation { target: joy; property: "flight"; to: 1; duration: Theme.motion * 2; easing.type: Easing.InOutQuad }
        ScriptAction { script: joy.finish() }
    }

    Repeater {
        model: joy.under && joy.spark > 0 && joy.spark < 1 ? 16 : 0
        Rectangle {
            required property int index
            readonly property real angle: (index % 8 + 0.5) * Math.PI / 4
            readonly property real far: joy.cardSize * (0.56 + 0.34 * joy.spark)
            readonly property point centre: joy.from[index < 8 ? 0 : 1] ?? Qt.point(0, 0)
            width: joy.cardSize * 0.13 * (1 - joy.spark * 0.8)
            height: width
            rotation: 45
            radius: width * 0.2
            x: centre.x + Math.cos(angle) * far - width / 2
            y: centre.y + Math.sin(angle) * far - height / 2
            color: index % 2 === 0 ? Theme.amber : Theme.lightSea
        }
    }
    Repeater {
        model: joy.under && joy.flight > 0 ? 2 : 0
        Image {
            required property int index
            readonly property point start: joy.from[index] ?? Qt.point(0, 0)
            readonly property real bow: Math.sin(joy.flight * Math.PI) * joy.cardSize * 0.35
            width: joy.cardSize
            height: width
            scale: 1 + (joy.smallSize / Math.max(1, joy.cardSize) - 1) * joy.flight
            x: start.x + (joy.to.x - start.x) * joy.flight + (index === 0 ? -1 : 1) * bow - width / 2
            y: start.y + (joy.to.y - start.y) * joy.flight - height / 2
            source: joy.picture
            sourceSize: Qt.size(width, height)
        }
    }
}
