// The name of a page of the panel, underlined while the page is shown.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelButton {
    id: tab

    width: implicitWidth
    choosable: true
    font.bold: true
    // Its words are level with those of the buttons beside it, which stand higher than the line below it.
    topPadding: 6 * Theme.unit
    bottomPadding: topPadding + 0.3 * Theme.gap
    least: 68 * Theme.unit + 0.3 * Theme.gap
    horizontalPadding: 14 * Theme.unit
    solid: false
    front: chosen ? Theme.ink : Theme.sea
    Accessible.role: Accessible.PageTab
    background: Item {
        Rectangle {
            anchors.fill: parent
            radius: 12 * Theme.unit
            visible: tab.hovered || tab.down
            color: tab.down ? Theme.sand : Theme.white
        }
        Rectangle {
            anchors { left: parent.left; right: parent.right; bottom: parent.bottom }
            height: 6 * Theme.unit
            radius: height / 2
            visible: tab.chosen
            color: Theme.sea
        }
        FocusRing {
            around: tab
            reach: 5 * Theme.unit
            radius: 15 * Theme.unit
            border.width: 3 * Theme.unit
        }
    }
}
