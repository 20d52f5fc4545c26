// What a replay shows below the screens: what is remembered, and the bar that drives it. A kiosk has neither.
pragma ComponentBehavior: Bound
import QtQuick
import Recollect
import "."

Item {
    id: foot

    required property ReplayControls replay
    // The same, where what is remembered is shown.
    required property ReplayControls memory
    required property var words

    // Not by anchors: pictures are also taken before the window's content has its size.
    height: drawing.height + bar.height

    Loader {
        id: drawing
        width: foot.width
        height: foot.memory === null ? 0 : 176
        active: foot.memory !== null
        sourceComponent: Rectangle {
            color: Theme.ink
            MemoryDrawing {
                anchors.fill: parent
                replay: foot.memory
            }
        }
    }
    Loader {
        id: bar
        y: drawing.height
        width: foot.width
        height: foot.replay === null ? 0 : 48
        active: foot.replay !== null
        sourceComponent: ReplayBar { replay: foot.replay; words: foot.words }
    }
}
