// How far a visit is: one dot for each of its parts, the present one longer.
pragma ComponentBehavior: Bound
import QtQuick
import "."

Row {
    id: progress

    required property int steps
    required property int step      // from 0

    objectName: "progress"
    spacing: 10 * Theme.unit
    Accessible.role: Accessible.ProgressBar
    Accessible.name: `${step + 1} / ${steps}`

    Repeater {
        model: progress.steps
        Rectangle {
            required property int index
            width: (index === progress.step ? 36 : 15) * Theme.unit
            height: 15 * Theme.unit
            radius: height / 2
            // Where nothing is pale, those to come are empty rings.
            color: index <= progress.step ? Theme.lightSea : Theme.highContrast ? Theme.white : Theme.edge
            border { color: Theme.edge; width: Theme.highContrast ? 2 * Theme.unit : 0 }
        }
    }
}
