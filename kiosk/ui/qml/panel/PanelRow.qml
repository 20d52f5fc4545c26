// One action of a list, with the outline that all buttons of the panel have.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

PanelButton {
    id: row

    ground: Theme.white
    ringInPlace: true
    font.bold: true
}
