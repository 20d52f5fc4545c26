// A part of the panel: a heading, and what stands below it.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Rectangle {
    id: section

    required property string title
    property real aside: 0     // how much room the heading leaves for what stands beside it
    default property alias content: body.data

    // How high its heading is at least, and how large what stands below it is written.
    property real crown: 0
    property real size: Theme.dense
    property real apart: 10 * Theme.unit
    // Not where it is one of several parts of a sheet.
    property bool framed: true
    readonly property real inset: Math.round(1.1 * Theme.gap)
    // How high it is at least, where it ends with another one beside it.
    property real least: 0
    // What is free above its heading, below that, and below all; and what it takes beside what stands in it.
    readonly property real above: 0.65 * Theme.gap
    readonly property real between: 0.4 * Theme.gap
    readonly property real edges: above + between + 0.85 * Theme.gap
    readonly property real frame: heading.height + edges
    readonly property real wish: body.height + frame

    // Whole pixels, so that those side by side end in line.
    height: Math.ceil(Math.max(least, wish))
    radius: Theme.radius
    color: framed ? Theme.white : "transparent"
    border { color: Theme.edge; width: framed ? 2 * Theme.unit : 0 }

    PlainText {
        id: heading
        anchors { top: parent.top; left: parent.left; right: parent.right; margins: section.inset; topMargin: section.above }
        anchors.rightMargin: section.inset + section.aside + (section.aside > 0 ? 0.5 * Theme.gap : 0)
        height: Math.max(implicitHeight, section.crown)
        verticalAlignment: Text.AlignVCenter
        text: section.title
        font { pixelSize: section.size * 1.12; bold: true }
        color: Theme.ink
        wrapMode: Text.Wrap
    }
    Column {
        id: body
        anchors { top: heading.bottom; left: parent.left; right: parent.right; margins: section.inset; topMargin: section.between }
        spacing: section.apart
    }
}
