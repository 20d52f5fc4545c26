// What a point on a card is about: a card of the game with a small sign at its corner, or a large sign alone.
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
    readonly property bool open: sign === "seen"

    height: width

    Sign {
        visible: !drawing.ofCards
        width: parent.width
        sign: drawing.sign
    }
    CardFace {
        visible: drawing.ofCards
        x: Theme.across(0, width, drawing.width)
        y: drawing.height - height
        width: Math.floor(0.95 * drawing.width)
        height: width
        back: drawing.back
        shadow: drawing.shadow
        picture: drawing.picture
        up: drawing.open
        rimShown: drawing.open ? 1 : 0
    }
    Sign {
        visible: drawing.ofCards
        x: Theme.across(drawing.width - width, width, drawing.width)
        width: 0.45 * drawing.width
        border { color: Theme.white; width: 5 * Theme.unit }
        sign: drawing.open ? "eye" : drawing.sign
    }
}
