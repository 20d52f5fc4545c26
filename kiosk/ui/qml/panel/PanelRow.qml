// One action of a list, on the pale ground of all that can be touched.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelButton {
    id: row

    ground: grave ? Theme.white : Theme.touchable
    background: Rectangle {
        radius: Theme.radius
        color: row.down ? Theme.sand : row.hovered ? Theme.white : row.ground
        border { color: row.grave ? Theme.deepAmber : Theme.highContrast ? Theme.edge : row.hovered ? Theme.sea : "transparent"; width: 2 * Theme.unit }
        FocusRing {
            around: row
            reach: 0
            radius: Theme.radius
            border.width: 5 * Theme.unit
        }
    }
}
