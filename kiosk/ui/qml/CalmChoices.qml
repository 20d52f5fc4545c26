// What there is to choose on a calm card, as buttons: beside each other where they fit.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Flow {
    id: flow

    // The name of each, its words, its sign if it has one, and whether it is quiet.
    required property var choices
    required property real most
    // Whether there is room for a distance above a button alone, and whether words can be larger.
    required property bool large
    required property bool roomy
    signal chosen(string name)

    // All there is to do, perhaps in a hurry, is wide: as wide as an upright page, as the way on is there.
    readonly property bool alone: choices.length === 1
    // Two are as wide as each other: far apart, or as wide as the card where they do not fit beside each other. The first is
    // where the way on is on a page.
    readonly property bool two: choices.length === 2
    readonly property bool pair: buttons.count === 2 && widest <= half
    readonly property real half: (most - spacing) / 2
    // How many there are by now: the count changes before they are made, and their widths would then be missed.
    property int made: 0
    readonly property real widest: Math.max(0, ...all().map(button => button?.wish ?? 0))
    readonly property real needed: all().reduce((sum, button) => sum + (button?.width ?? 0), 0) + (made - 1) * spacing

    function all(): var {
        return Array.from({length: made}, (_, at) => buttons.itemAt(at) as BigButton)
    }
    // Give the keyboard to the first.
    function take() {
        if (buttons.count > 0)
            buttons.itemAt(0).focus = true
    }

    visible: choices.length > 0
    layoutDirection: pair && !Theme.mirrored ? Qt.RightToLeft : Qt.LeftToRight
    topPadding: alone && large ? Theme.gap : 0
    width: Math.min(most, Math.ceil(needed))
    spacing: (buttons.count === 2 ? 2 : 1) * Theme.gap
    Repeater {
        id: buttons
        model: flow.choices
        onItemAdded: flow.made++
        onItemRemoved: flow.made--
        BigButton {
            required property var modelData
            objectName: modelData.name
            most: flow.most
            width: flow.alone && !flow.roomy ? Math.min(most, Math.max(wish, 720 * Theme.unit)) : flow.alone || flow.two && !flow.pair ? most : flow.pair ? Math.floor(flow.half) : Math.min(wish, most)
            font.pixelSize: Theme.size(flow.alone ? (flow.roomy ? 56 : 50) : flow.roomy ? 48 : flow.large && Theme.textSize <= 1.15 ? 48 : 36)
            verticalPadding: (flow.alone ? (flow.roomy ? 42 : 36) : flow.roomy ? 36 : 30) * Theme.unit
            words: modelData.words
            quiet: modelData.quiet ?? false
            sign: modelData.sign ?? ""
            // Above the words where two stand beside each other, so that both are told apart before they are read.
            signAbove: flow.pair
            signSize: (!flow.pair ? 60 : flow.roomy ? 152 : flow.large ? 128 : 88) * Theme.unit
            horizontalPadding: (sign === "" ? 56 : 28) * Theme.unit
            corner: sign !== "" && flow.pair ? 2 * Theme.radius : Infinity
            onClicked: flow.chosen(modelData.name)
        }
    }
}
