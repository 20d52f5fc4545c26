// The ground of an item: a card of its own, or its part of the sheet that all ratings of a page share.
import QtQuick
import ".."

Rectangle {
    id: card

    required property string item
    // Whether it has no ground, whether it is missed, and whether it is to be answered next.
    required property bool bare
    required property bool missed
    required property bool due
    // Whether another part of the sheet stands above it, or below it.
    required property bool joinsAbove
    required property bool joinsBelow

    objectName: `card-${item}`
    radius: Theme.radius
    topLeftRadius: joinsAbove ? 0 : radius
    topRightRadius: topLeftRadius
    bottomLeftRadius: joinsBelow ? 0 : radius
    bottomRightRadius: bottomLeftRadius
    color: bare ? "transparent" : Theme.white
    border { color: missed ? Theme.deepAmber : Theme.edge; width: bare ? 0 : (missed ? 5 : 3) * Theme.unit }
    Rectangle {
        objectName: `due-${card.item}`
        anchors.fill: parent
        radius: card.radius
        topLeftRadius: card.topLeftRadius
        topRightRadius: topLeftRadius
        bottomLeftRadius: card.bottomLeftRadius
        bottomRightRadius: bottomLeftRadius
        color: "transparent"
        // All edges are dark with high contrast.
        border { color: Theme.sea; width: (Theme.highContrast ? 7 : 3) * Theme.unit }
        opacity: card.due && !card.missed ? 1 : 0
        Behavior on opacity { NumberAnimation { duration: Theme.motion } }
    }
}
