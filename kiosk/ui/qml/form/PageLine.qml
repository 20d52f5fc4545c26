// Which page of a form this is, as a line of as many parts. The part of this page is the darkest and thickest.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Row {
    id: line

    required property int pages
    required property int page          // from 1

    objectName: "page-line"
    spacing: 8 * Theme.unit
    Repeater {
        model: line.pages
        Rectangle {
            required property int index
            readonly property bool present: index === line.page - 1
            width: (line.width - (line.pages - 1) * line.spacing) / Math.max(1, line.pages)
            y: (14 * Theme.unit - height) / 2
            height: (present ? 14 : 8) * Theme.unit
            radius: height / 2
            color: present ? Theme.sea : index < line.page ? Qt.tint(Theme.paper, Qt.alpha(Theme.sea, 0.5)) : Theme.sand
        }
    }
}
