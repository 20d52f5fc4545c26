// The head of a sheet of ratings: a band that is joined to the first, with the words for both ends. Each begins or ends where
// the scales below it do. A long sheet has the same at its foot.
pragma ComponentBehavior: Bound
import QtQuick
import ".."

Rectangle {
    id: head

    required property RatingRows rows
    required property string leftEnd
    required property string rightEnd
    // How far what stands on the sheet is from its edges.
    required property real inset

    // Whether it is joined to the last rating instead. What reads the screen has read the words then.
    property bool foot: false

    // Where the scales are, from the edge where reading begins.
    readonly property real span: rows.table !== null ? rows.scaleWidth - rows.beyond : width - 2 * inset - rows.beyond
    readonly property real before: rows.table !== null ? width - inset - rows.scaleWidth : inset

    readonly property real size: rows.sheet?.end ?? Theme.small

    color: Theme.band
    border { color: Theme.edge; width: 3 * Theme.unit }
    topLeftRadius: foot ? 0 : Theme.radius
    topRightRadius: topLeftRadius
    bottomLeftRadius: foot ? Theme.radius : 0
    bottomRightRadius: bottomLeftRadius

    component End: PlainText {
        anchors.verticalCenter: parent.verticalCenter
        wrapMode: Text.Wrap
        font.pixelSize: head.size
        color: Theme.ink
        Accessible.ignored: head.foot
    }
    End {
        x: Theme.across(head.before, width, head.width)
        width: head.rows.endRoom(head.leftEnd, head.rightEnd, head.size, head.span)
        text: head.leftEnd
        horizontalAlignment: Text.AlignLeft
    }
    End {
        x: Theme.across(head.before + head.span - width, width, head.width)
        width: head.rows.endRoom(head.rightEnd, head.leftEnd, head.size, head.span)
        text: head.rightEnd
        horizontalAlignment: Text.AlignRight
    }
}
