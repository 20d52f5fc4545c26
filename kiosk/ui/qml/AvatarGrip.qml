// Two hands of the avatar that hold something from behind by its upper edge: fingers are seen, one hand at each side.
pragma ComponentBehavior: Bound
import QtQuick

Item {
    id: grip

    // How large the avatar is drawn, as a share of its own coordinates, and how far the hands are from the sides.
    required property real size
    required property real inset

    Repeater {
        model: 2
        Row {
            id: hand
            required property int index
            x: index === 0 ? grip.inset : grip.width - grip.inset - width
            y: -20 * grip.size
            spacing: -3 * grip.size
            Repeater {
                model: 3
                Rectangle {
                    required property int index
                    // The little finger, on the outside, is the shortest.
                    readonly property int outwards: hand.index === 0 ? 2 - index : index
                    width: 26 * grip.size
                    height: [46, 48, 42][outwards] * grip.size
                    radius: width / 2
                    color: "#FFF6E4"
                    border { color: "#1F5F6B"; width: 4 * grip.size }
                }
            }
        }
    }
}
