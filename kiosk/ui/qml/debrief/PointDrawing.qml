// What a point on a card is about: cards of the game with a small sign at a lower corner, or a large sign alone.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Item {
    id: drawing

    required property string sign
    required property bool ofCards
    // What was seen lies open, as a picture that the visitor knows; what is left to chance is closed.
    required property url picture
    required property url back
    required property url shadow
    // How large one card is, and whether two closed ones lie behind it, among which it is chosen.
    required property real side
    required property bool fanned
    // How far their middles are from its own: they stay on the card that is drawn on.
    readonly property real reach: Math.min(0.52 * side, (width + Theme.gap - 0.96 * side) / 2)
    readonly property bool open: sign === "seen"

    component Face: CardFace {
        anchors.centerIn: parent
        width: Math.floor(0.95 * drawing.side)
        height: width
        back: drawing.back
        shadow: drawing.shadow
        picture: ""
        up: false
    }

    Sign {
        visible: !drawing.ofCards
        anchors.horizontalCenter: parent.horizontalCenter
        width: drawing.side
        sign: drawing.sign
    }
    Repeater {
        model: drawing.ofCards && drawing.fanned ? 2 : 0
        Face {
            required property int index
            readonly property int way: index === 0 ? -1 : 1
            anchors { horizontalCenterOffset: way * drawing.reach; verticalCenterOffset: 0.05 * drawing.side }
            scale: 0.88
            rotation: 9 * way
        }
    }
    Face {
        visible: drawing.ofCards
        picture: drawing.picture
        up: drawing.open
        rimShown: drawing.open ? 1 : 0
    }
    // The heads of animals are in the upper half of their pictures.
    Sign {
        visible: drawing.ofCards
        x: Theme.across((drawing.width + drawing.side) / 2 - (drawing.fanned ? 0.72 : 0.95) * width, width, drawing.width)
        y: drawing.height - 0.86 * height
        width: 0.4 * drawing.side
        border { color: Theme.white; width: 5 * Theme.unit }
        sign: drawing.open ? "eye" : drawing.sign
    }
}
