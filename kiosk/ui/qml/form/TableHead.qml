// The head of a table of ratings: a band that is joined to the first row, with the words for both ends over the middles of
// the first point and the last.
import QtQuick
import ".."

Rectangle {
    id: head

    required property RatingRows rows
    required property string leftEnd
    required property string rightEnd
    // How far the first point is from the edge where reading begins.
    required property real before

    readonly property real point: rows.table?.point ?? 0
    readonly property real span: rows.scaleWidth - rows.beyond

    color: Theme.band
    border { color: Theme.edge; width: 3 * Theme.unit }
    topLeftRadius: Theme.radius
    topRightRadius: Theme.radius

    PlainText {
        x: Theme.across(head.before + head.point / 2 - width / 2, width, head.width)
        anchors.verticalCenter: parent.verticalCenter
        text: head.leftEnd
        font.pixelSize: head.rows.table?.end ?? Theme.small
        color: Theme.ink
    }
    PlainText {
        x: Theme.across(head.before + head.span - head.point / 2 - width / 2, width, head.width)
        anchors.verticalCenter: parent.verticalCenter
        text: head.rightEnd
        font.pixelSize: head.rows.table?.end ?? Theme.small
        color: Theme.ink
    }
}
