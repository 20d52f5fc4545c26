// A part of the panel: a heading, and what stands below it.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Rectangle {
    id: section

    // Empty where what stands below needs none.
    required property string title
    property real aside: 0     // how much room the heading leaves for what stands beside it
    default property alias content: body.data

    // How high its heading is at least, and how large what stands below it is written.
    property real crown: 0
    property real size: Theme.dense
    property real apart: 10 * Theme.unit
    // How much larger its heading is, and how far it is moved in, for what stands before it.
    property real heightened: 1.12
    property real indent: 0
    property real inset: Math.round(1.1 * Theme.gap)
    // How high it is at least, where it ends with another one beside it.
    property real least: 0
    // Whether what stands in it has the same air above and below.
    property bool centred: false
    // What is free above its heading, below that, and below all; and what it takes beside what stands in it.
    readonly property real above: 0.65 * Theme.gap
    readonly property real between: 0.4 * Theme.gap
    readonly property real edges: above + (title === "" ? 0 : between) + 0.85 * Theme.gap
    readonly property real frame: (title === "" ? 0 : heading.height) + edges
    readonly property real wish: body.height + frame

    // Whole pixels, so that those side by side end in line.
    height: Math.ceil(Math.max(least, wish))
    radius: Theme.radius
    color: Theme.white
    border { color: Theme.edge; width: 2 * Theme.unit }

    PlainText {
        id: heading
        anchors { top: parent.top; left: parent.left; right: parent.right; margins: section.inset; topMargin: section.above }
        anchors.leftMargin: section.inset + section.indent
        anchors.rightMargin: section.inset + section.aside + (section.aside > 0 ? 0.5 * Theme.gap : 0)
        visible: section.title !== ""
        height: Math.max(implicitHeight, section.crown)
        verticalAlignment: Text.AlignVCenter
        text: section.title
        font { pixelSize: section.heightened * section.size; bold: true }
        color: Theme.ink
        wrapMode: Text.Wrap
    }
    Column {
        id: body
        anchors { top: parent.top; left: parent.left; right: parent.right; margins: section.inset; topMargin: section.frame - 0.85 * Theme.gap + (section.centred ? Math.floor((section.height - section.wish) / 2) : 0) }
        spacing: section.apart
    }
}
