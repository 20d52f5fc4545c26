// The last pair: paper snippets rain over everything for a moment. Without motion there are none.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Item {
    id: feast

    property real time: 1
    readonly property bool under: rain.running

    function begin() {
        if (Theme.motion > 0)
            rain.restart()
    }
    function end() {
        rain.stop()
        time = 1
    }

    NumberAnimation { id: rain; target: feast; property: "time"; from: 0; to: 1; duration: Theme.motion * 16 }

    Repeater {
        model: feast.under ? 96 : 0
        Rectangle {
            id: snippet
            required property int index
            // Spread evenly, as if by chance, and the same at every feast; speed and delay are drawn apart, or all
            // of them would meet in one line.
            readonly property real chance: (index * 0.618) % 1
            readonly property real other: (index * 0.755) % 1
            readonly property real third: (index * 0.57) % 1
            readonly property real fallen: feast.time * (1.45 + 0.5 * other) - 0.45 * third
            width: (16 + 18 * other) * Theme.unit
            height: width * 0.62
            // Drawn without a GPU, smooth edges cost a fifth of the frames.
            antialiasing: false
            x: feast.width * chance + Math.sin(feast.time * 9 + index) * 30 * Theme.unit
            y: -40 * Theme.unit + fallen * (feast.height + 80 * Theme.unit)
            rotation: index * 40 + feast.time * 700 * (index % 2 === 0 ? 1 : -1)
            color: [Theme.amber, "#E4725B", "#63ABBF", Theme.sea, "#8EC3D9"][index % 5]
            opacity: Math.min(1, 5 * (1 - feast.time))
        }
    }
}
